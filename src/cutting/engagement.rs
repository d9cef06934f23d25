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
    /// Entry and exit [rad] of an edge at the radius `r` on a tool of the radius `outer` [m];
    /// `None` if it does not reach the material.
    ///
    /// The part ends at a plane along the feed, at `outer` minus the radial depth from the axis.
    /// Climb milling at the full radius thus enters at pi - acos(1 - 2 a_e / D) (Altintas 2012,
    /// section 2.7).
    pub fn at(&self, r: f64, outer: f64) -> Option<(f64, f64)> {
        // The angle from the wall's side at which the edge crosses that plane.
        let reach = |depth: f64| {
            let plane = outer - depth;
            (plane < r).then(|| math::acos((plane / r).clamp(-1.0, 1.0)))
        };
        match *self {
            Self::Angles { entry, exit } => Some((entry, exit)),
            Self::Slot => Some((0.0, PI)),
            Self::Climb(depth) => reach(depth).map(|angle| (PI - angle, PI)),
            Self::Conventional(depth) => reach(depth).map(|angle| (0.0, angle)),
        }
    }

    /// Distance of the part's plane from the tool's axis [m], minus infinity without a plane. Edges
    /// at a smaller radius do not reach it.
    pub fn plane(&self, outer: f64) -> f64 {
        match *self {
            Self::Climb(depth) | Self::Conventional(depth) => outer - depth,
            _ => f64::NEG_INFINITY,
        }
    }

    /// Immersion angles [rad] of the walls that a tooth at the full radius leaves: 0 (left of the
    /// feed) or pi (right of it).
    pub fn walls(&self, outer: f64) -> Vec<f64> {
        let Some((entry, exit)) = self.at(outer, outer) else { return Vec::new() };
        [0.0, PI]
            .into_iter()
            .filter(|wall| (wall - entry).abs() < AT_WALL || (wall - exit).abs() < AT_WALL)
            .collect()
    }
}
