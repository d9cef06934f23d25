//! Engagement: the part of a revolution that a tooth spends in the material.
//!
//! Immersion angles count from +y of {T}, clockwise seen from the spindle: 0 is left of the feed,
//! 90 deg ahead, 180 deg right of it.

use crate::math;
use std::f64::consts::PI;

/// Where the material is around the tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Engagement {
    /// Between two immersion angles [rad], at every height.
    Angles {
        /// Where a tooth enters.
        entry: f64,
        /// Where it leaves.
        exit: f64,
    },
    /// Down milling: the part is right of the feed, with this radial depth [m].
    Climb(f64),
    /// Up milling: the part is left of the feed, with this radial depth [m].
    Conventional(f64),
    /// Material on both sides.
    Slot,
}

/// Angles closer than this to a wall's angle are the wall's [rad].
const AT_WALL: f64 = 1e-9;

impl Engagement {
    /// Entry and exit [rad] of an edge at the radius `r` [m].
    ///
    /// The pass before left the same profile, the radial depth a_e further. At each height the part
    /// thus ends at a plane along the feed, at r - a_e from the axis: climb milling enters at pi -
    /// acos(1 - a_e / r) (Altintas 2012, section 2.7, at the local radius). Where a_e exceeds 2 r,
    /// as near the tip of a ball, the edge cuts a slot.
    pub fn at(&self, r: f64) -> (f64, f64) {
        // The angle from the wall's side at which the edge crosses that plane; at the very tip r is 0.
        let reach = |depth: f64| if depth < 2.0 * r { math::acos(1.0 - depth / r) } else { PI };
        match *self {
            Self::Angles { entry, exit } => (entry, exit),
            Self::Slot => (0.0, PI),
            Self::Climb(depth) => (PI - reach(depth), PI),
            Self::Conventional(depth) => (0.0, reach(depth)),
        }
    }

    /// The radius below which an edge has material all round ahead because the pass before left some
    /// there [m]; 0 if that is the same at every radius.
    pub(super) fn slot_below(&self) -> f64 {
        match *self {
            Self::Angles { .. } | Self::Slot => 0.0,
            Self::Climb(depth) | Self::Conventional(depth) => depth / 2.0,
        }
    }

    /// Immersion angles [rad] of the walls that a tooth at the radius `outer` [m] leaves: 0 (left of
    /// the feed) or pi (right of it).
    pub fn walls(&self, outer: f64) -> Vec<f64> {
        let (entry, exit) = self.at(outer);
        [0.0, PI]
            .into_iter()
            .filter(|wall| (wall - entry).abs() < AT_WALL || (wall - exit).abs() < AT_WALL)
            .collect()
    }
}
