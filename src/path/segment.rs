//! One piece of a path: a straight line or an arc, which may be a helix.

use crate::math::{self, Pose, TAU};
use nalgebra::Vector3;

/// A line or an arc, parametrized by the arc length from its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Segment {
    /// Straight from one point to another [m].
    Line {
        /// Start [m].
        from: Vector3<f64>,
        /// End [m].
        to: Vector3<f64>,
    },
    /// Part of a circle, or several turns; a helix if `rise` is not 0.
    Arc {
        /// Centre of the starting circle [m].
        center: Vector3<f64>,
        /// Unit vector from the centre to the start.
        u: Vector3<f64>,
        /// Unit vector normal to `u`, in the direction of travel at the start.
        v: Vector3<f64>,
        /// Radius [m].
        radius: f64,
        /// Angle swept [rad], positive.
        sweep: f64,
        /// Rise along u x v over the whole sweep [m].
        rise: f64,
    },
}

impl Segment {
    /// Length along the segment [m].
    pub fn length(&self) -> f64 {
        match self {
            Segment::Line { from, to } => (to - from).norm(),
            Segment::Arc { radius, sweep, rise: 0.0, .. } => radius * sweep,
            Segment::Arc { radius, sweep, rise, .. } => math::hypot(radius * sweep, *rise),
        }
    }

    /// The point at the arc length `s` [m].
    pub fn point(&self, s: f64) -> Vector3<f64> {
        match self {
            Segment::Line { from, to } => {
                let length = self.length();
                // The second half is computed from the end, so the end point is exact.
                if s * 2.0 < length {
                    from + (to - from) * (s / length)
                } else {
                    to - (to - from) * ((length - s) / length)
                }
            }
            Segment::Arc { center, u, v, radius, sweep, rise } => {
                let part = s / self.length();
                let (sin, cos) = math::sin_cos(part * sweep);
                center + (u * cos + v * sin) * *radius + u.cross(v) * (part * rise)
            }
        }
    }

    /// Unit tangent at the arc length `s` [m].
    pub fn tangent(&self, s: f64) -> Vector3<f64> {
        match self {
            Segment::Line { from, to } => (to - from) / self.length(),
            Segment::Arc { u, v, radius, sweep, rise, .. } => {
                let length = self.length();
                let (sin, cos) = math::sin_cos(s / length * sweep);
                (v * cos - u * sin) * (radius * sweep / length) + u.cross(v) * (rise / length)
            }
        }
    }

    /// Curvature [1/m]: 0 on a line.
    pub fn curvature(&self) -> f64 {
        match self {
            Segment::Line { .. } => 0.0,
            Segment::Arc { radius, sweep, rise, .. } => {
                let pitch = rise / sweep;
                radius / (radius * radius + pitch * pitch)
            }
        }
    }

    /// Arc lengths [m] at which a coordinate may be at its maximum or minimum: the ends, and on an
    /// arc the points where the derivative of a coordinate is zero.
    ///
    /// A rise along a coordinate axis, as in programs, does not shift these points.
    pub fn extremes(&self) -> Vec<f64> {
        let length = self.length();
        let mut places = vec![0.0, length];
        if let Segment::Arc { u, v, sweep, .. } = self {
            for axis in 0..3 {
                let mut angle = math::atan2(v[axis], u[axis]).rem_euclid(math::PI);
                while angle < *sweep {
                    places.push(angle / sweep * length);
                    angle += math::PI;
                }
            }
        }
        places
    }

    /// The segment, expressed in the frame in which `frame` is given.
    pub fn placed(&self, frame: &Pose) -> Self {
        match *self {
            Segment::Line { from, to } => Segment::Line { from: frame.point(&from), to: frame.point(&to) },
            Segment::Arc { center, u, v, radius, sweep, rise } => Segment::Arc {
                center: frame.point(&center),
                u: frame.direction(&u),
                v: frame.direction(&v),
                radius,
                sweep,
                rise,
            },
        }
    }

    /// The part between two arc lengths [m].
    pub fn part(&self, from: f64, to: f64) -> Self {
        match *self {
            Segment::Line { .. } => Segment::Line { from: self.point(from), to: self.point(to) },
            Segment::Arc { center, u, v, radius, sweep, rise } => {
                let length = self.length();
                let (sin, cos) = math::sin_cos(from / length * sweep);
                Segment::Arc {
                    center: center + u.cross(&v) * (rise * from / length),
                    u: u * cos + v * sin,
                    v: v * cos - u * sin,
                    radius,
                    sweep: sweep * (to - from) / length,
                    rise: rise * (to - from) / length,
                }
            }
        }
    }

    /// Arc length [m] in [`from`, `to`] of the point closest to `p`.
    pub fn closest(&self, p: &Vector3<f64>, from: f64, to: f64) -> f64 {
        match self {
            Segment::Line { from: start, to: end } => {
                let along = (end - start) / self.length();
                (p - start).dot(&along).clamp(from, to)
            }
            Segment::Arc { center, u, v, sweep, rise, .. } => {
                let offset = p - center;
                let per_angle = self.length() / sweep;
                let bearing = math::atan2(offset.dot(v), offset.dot(u));
                if *rise == 0.0 {
                    // The turn of the bearing that lies in the window, or the nearer end.
                    let middle = (from + to) / 2.0;
                    let s = math::nearest_turn(bearing, middle / per_angle) * per_angle;
                    // No point on the circle is closer than the one at the bearing.
                    if (from..=to).contains(&s) {
                        return s;
                    }
                    self.nearer_of(p, [s.clamp(from, to), from, to])
                } else {
                    self.closest_on_helix(p, bearing, (from, to))
                }
            }
        }
    }

    /// Closest point on a helix. Each turn of the bearing in the window is the start of a Newton
    /// iteration on the derivative of the distance.
    fn closest_on_helix(&self, p: &Vector3<f64>, bearing: f64, (from, to): (f64, f64)) -> f64 {
        let Segment::Arc { sweep, .. } = self else { return from };
        let per_angle = self.length() / sweep;
        let first = math::nearest_turn(bearing, from / per_angle);
        let turns = ((to - from) / (TAU * per_angle)).ceil() as usize + 1;
        let mut best = self.nearer_of(p, [from, to, to]);
        for turn in 0..=turns {
            let mut s = ((first + TAU * turn as f64) * per_angle).clamp(from, to);
            for _ in 0..20 {
                let offset = p - self.point(s);
                let tangent = self.tangent(s);
                let ahead = (self.tangent(s + per_angle * 1e-4) - tangent) / (per_angle * 1e-4);
                let slope = 1.0 - offset.dot(&ahead);
                if slope <= 1e-3 {
                    break;
                }
                let step = offset.dot(&tangent) / slope;
                s = (s + step).clamp(from, to);
                if step.abs() < 1e-13 {
                    break;
                }
            }
            best = self.nearer_of(p, [best, s, s]);
        }
        best
    }

    fn nearer_of(&self, p: &Vector3<f64>, places: [f64; 3]) -> f64 {
        let mut best = places[0];
        let mut least = (p - self.point(best)).norm_squared();
        for s in &places[1..] {
            let distance = (p - self.point(*s)).norm_squared();
            if distance < least {
                (best, least) = (*s, distance);
            }
        }
        best
    }
}
