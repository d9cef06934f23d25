//! What a move sweeps, seen along the tool axis: all points within the tool's radius of its spine.

use crate::math::{self, TAU};
use crate::path::Segment;
use crate::stock::circle::{HalfCircle, Region, left_of};
use nalgebra::Vector2;

/// The way of the tool axis in a move, seen along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Spine {
    /// A point: the tool only rises or dives.
    Point(Vector2<f64>),
    /// A line.
    Line {
        /// Start [m].
        from: Vector2<f64>,
        /// Unit vector along it.
        along: Vector2<f64>,
        /// Length [m].
        length: f64,
    },
    /// An arc, counter-clockwise.
    Arc {
        /// Centre [m].
        center: Vector2<f64>,
        /// Radius [m].
        radius: f64,
        /// Unit vectors from the centre to its ends.
        ends: [Vector2<f64>; 2],
        /// Angle swept [rad], at most a turn.
        sweep: f64,
    },
}

/// The spine of a move with the heights of its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Swept {
    /// Its spine.
    pub(super) spine: Spine,
    /// Whether the move goes along the spine backwards (arcs are kept counter-clockwise).
    backwards: bool,
    /// Turns of the whole move; more than one of a helix.
    turns: f64,
    /// Height of the tip at its start and its end [m].
    pub(super) heights: [f64; 2],
}

/// A length that is none [m].
const NONE: f64 = 1e-9;

impl Spine {
    /// Distance of a point from the spine [m].
    pub(super) fn distance(&self, point: &Vector2<f64>) -> f64 {
        match self {
            Self::Point(at) => (point - at).norm(),
            Self::Line { from, along, length } => {
                let offset = point - from;
                (offset - along * offset.dot(along).clamp(0.0, *length)).norm()
            }
            Self::Arc { center, radius, ends: [from, to], sweep } => {
                let offset = point - center;
                let (after, before) = (from.perp(&offset) >= 0.0, offset.perp(to) >= 0.0);
                let beside = if *sweep <= math::PI { after && before } else { after || before };
                if beside || *sweep >= TAU {
                    return (offset.norm() - radius).abs();
                }
                (offset - from * *radius).norm().min((offset - to * *radius).norm())
            }
        }
    }

    /// Whether a point is nearer than `distance` [m]; cheaper than [`Spine::distance`] for a line.
    pub(super) fn is_within(&self, point: &Vector2<f64>, distance: f64) -> bool {
        let Self::Line { from, along, length } = self else { return self.distance(point) < distance };
        let offset = point - from;
        (offset - along * offset.dot(along).clamp(0.0, *length)).norm_squared() < distance * distance
    }

    /// Smallest box that holds it: lower and upper corner [m].
    pub(super) fn bounds(&self) -> [Vector2<f64>; 2] {
        match self {
            Self::Point(at) => [*at, *at],
            Self::Line { from, along, length } => {
                let to = from + along * *length;
                [from.inf(&to), from.sup(&to)]
            }
            Self::Arc { center, radius, .. } => {
                let reach = Vector2::repeat(*radius);
                [center - reach, center + reach]
            }
        }
    }
}

/// All points within `reach` [m] of a spine.
pub(super) struct Capsule<'a> {
    pub(super) spine: &'a Spine,
    pub(super) reach: f64,
}

impl Region for Capsule<'_> {
    fn holds(&self, point: &Vector2<f64>) -> bool {
        self.spine.distance(point) < self.reach
    }

    fn meet(&self, half: &HalfCircle, places: &mut Vec<f64>) {
        match self.spine {
            Spine::Point(at) => half.meet_circle(at, self.reach, places),
            Spine::Line { from, along, length } => {
                let beside = left_of(along) * self.reach;
                half.meet_line(&(from + beside), along, places);
                half.meet_line(&(from - beside), along, places);
                half.meet_circle(from, self.reach, places);
                half.meet_circle(&(from + along * *length), self.reach, places);
            }
            Spine::Arc { center, radius, ends, sweep } => {
                half.meet_circle(center, radius + self.reach, places);
                half.meet_circle(center, (radius - self.reach).abs(), places);
                if *sweep < TAU {
                    for end in ends {
                        half.meet_circle(&(center + end * *radius), self.reach, places);
                    }
                }
            }
        }
    }
}

impl Swept {
    /// The same, moved across the tool axis by `by` [m].
    pub(super) fn moved(&self, by: &Vector2<f64>) -> Self {
        let spine = match self.spine {
            Spine::Point(at) => Spine::Point(at + by),
            Spine::Line { from, along, length } => Spine::Line { from: from + by, along, length },
            Spine::Arc { center, radius, ends, sweep } => {
                Spine::Arc { center: center + by, radius, ends, sweep }
            }
        };
        Self { spine, ..*self }
    }

    /// What a move along a segment sweeps; the tool axis is z. `None` for an arc that does not lie
    /// across it.
    pub(super) fn of(segment: &Segment) -> Option<Self> {
        match segment {
            Segment::Line { from, to } => {
                let across = (to - from).xy();
                let length = across.norm();
                let spine = if length > NONE {
                    Spine::Line { from: from.xy(), along: across / length, length }
                } else {
                    Spine::Point(from.xy())
                };
                Some(Self { spine, backwards: false, turns: 0.0, heights: [from.z, to.z] })
            }
            Segment::Arc { center, u, v, radius, sweep, rise } => {
                let normal = u.cross(v).z;
                if normal.abs() < 1.0 - 1e-12 {
                    return None;
                }
                let (sin, cos) = math::sin_cos(*sweep);
                let (from, to) = (u.xy(), (u * cos + v * sin).xy());
                let ends = if normal > 0.0 { [from, to] } else { [to, from] };
                let heights = [center.z, center.z + rise * normal];
                let spine = Spine::Arc { center: center.xy(), radius: *radius, ends, sweep: sweep.min(TAU) };
                Some(Self { spine, backwards: normal < 0.0, turns: sweep / TAU, heights })
            }
        }
    }

    /// Length of the way of its tip [m], at least.
    pub(super) fn length(&self) -> f64 {
        let along = match self.spine {
            Spine::Point(_) => 0.0,
            Spine::Line { length, .. } => length,
            Spine::Arc { radius, sweep, .. } => radius * sweep,
        };
        along.max((self.heights[1] - self.heights[0]).abs())
    }

    /// Number of pieces of an eighth of a turn or less.
    pub(super) fn pieces(&self) -> usize {
        (8.0 * self.turns).ceil().max(1.0) as usize
    }

    /// Lowest and highest tip [m].
    pub(super) fn range(&self) -> (f64, f64) {
        let [from, to] = self.heights;
        (from.min(to), from.max(to))
    }

    /// The spine of the part of the move at the height `height` [m] or below, up to the share `share`
    /// of its length.
    pub(super) fn below(&self, height: f64, share: f64) -> Option<Spine> {
        let [start, end] = self.heights;
        if start.min(start + (end - start) * share) > height {
            return None;
        }
        // The share of the length at which the tip crosses the height.
        let crossing = ((height - start) / (end - start)).clamp(0.0, share);
        match (start <= height, start + (end - start) * share <= height) {
            (true, true) => Some(self.part(0.0, share)),
            (true, false) => Some(self.part(0.0, crossing)),
            _ => Some(self.part(crossing, share)),
        }
    }

    /// The spine between two shares of the move's length.
    pub(super) fn part(&self, from: f64, to: f64) -> Spine {
        match self.spine {
            Spine::Point(_) => self.spine,
            Spine::Line { from: start, along, length } => {
                Spine::Line { from: start + along * (from * length), along, length: (to - from) * length }
            }
            Spine::Arc { center, radius, ends, .. } => {
                let sweep = self.turns * TAU;
                if from == 0.0 && to == 1.0 {
                    return self.spine;
                }
                let (first, sign) = if self.backwards { (ends[1], -1.0) } else { (ends[0], 1.0) };
                let at = |share: f64| {
                    let (sin, cos) = math::sin_cos(sign * share * sweep);
                    first * cos + left_of(&first) * sin
                };
                let ends = if self.backwards { [at(to), at(from)] } else { [at(from), at(to)] };
                Spine::Arc { center, radius, ends, sweep: ((to - from) * sweep).min(TAU) }
            }
        }
    }
}
