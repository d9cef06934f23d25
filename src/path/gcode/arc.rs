//! Geometry of G2 and G3: from a centre or a radius to arcs that join their ends exactly.

use crate::math::{self, PI, TAU};
use crate::path::Segment;
use nalgebra::Vector3;

/// The plane of arcs, canned cycles, and I, J and K.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Plane {
    /// G17.
    Xy,
    /// G18.
    Zx,
    /// G19.
    Yz,
}

impl Plane {
    /// Indices of the plane's first axis, second axis and normal, right-handed. For G18 these are
    /// Z, X and Y, so counter-clockwise is seen from +Y.
    pub(super) fn axes(self) -> [usize; 3] {
        match self {
            Plane::Xy => [0, 1, 2],
            Plane::Zx => [2, 0, 1],
            Plane::Yz => [1, 2, 0],
        }
    }
}

/// An arc or helix as given by G2 and G3; lengths in m.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arc {
    /// The plane of the arc.
    pub(super) plane: Plane,
    /// Start.
    pub(super) from: Vector3<f64>,
    /// End.
    pub(super) to: Vector3<f64>,
    /// Counter-clockwise (G3) seen from the plane's normal.
    pub(super) counter_clockwise: bool,
    /// Full turns beyond the first pass of the end (P - 1).
    pub(super) extra_turns: f64,
}

/// Ends of an arc closer than this in the plane make a full circle [m].
pub(super) const SAME: f64 = 1e-9;

/// The centre may move this far to keep an arc in one piece [m].
const NEGLIGIBLE: f64 = 1e-6;

/// Why an arc is impossible.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Misfit {
    /// The centre coincides with the start.
    NoRadius,
    /// Distance of the centre from the start and from the end, and their largest allowed difference
    /// [m].
    Radii(f64, f64, f64),
    /// A radius without a centre for a full circle, which leaves the centre open.
    NoChord,
    /// The ends are farther apart than twice the radius; their distance [m].
    TooShort(f64),
}

impl Arc {
    /// End of the segments [m]: `to`, except for a full circle, which closes exactly.
    pub(super) fn end(&self) -> Vector3<f64> {
        let [_, _, n] = self.plane.axes();
        let mut end = if self.is_full() { self.from } else { self.to };
        end[n] = self.to[n];
        end
    }

    /// The centre of the arc with this radius [m]. A negative radius selects the arc of more than
    /// half a turn.
    ///
    /// If the radius is less than half the chord by at most `tolerance(radius)`, the arc is a
    /// semicircle.
    pub(super) fn center_for(
        &self,
        radius: f64,
        tolerance: impl Fn(f64) -> f64,
    ) -> Result<Vector3<f64>, Misfit> {
        let [a, b, _] = self.plane.axes();
        let (along, across) = (self.to[a] - self.from[a], self.to[b] - self.from[b]);
        let chord = self.chord();
        if self.is_full() {
            return Err(Misfit::NoChord);
        }
        let half = chord / 2.0;
        if half - radius.abs() > tolerance(radius.abs()) {
            return Err(Misfit::TooShort(chord));
        }
        let height = (radius * radius - half * half).max(0.0).sqrt();
        // Left of the chord for a counter-clockwise arc of less than half a turn.
        let side = if self.counter_clockwise == (radius > 0.0) { height } else { -height };
        let mut center = self.from;
        center[a] += along / 2.0 - side * across / chord;
        center[b] += across / 2.0 + side * along / chord;
        Ok(center)
    }

    /// The arc about `center` [m].
    ///
    /// The programmed ends are kept. The centre, which CAM systems round, moves along the chord
    /// until both radii are equal. If that would move the far side of the arc by more than the
    /// radii differ (nearly full circles), the arc becomes a spiral of pieces of at most half a
    /// turn. Either way, no point is farther from the programmed circle than the difference of the
    /// radii, or a micrometre.
    pub(super) fn about(
        &self,
        center: &Vector3<f64>,
        tolerance: impl Fn(f64) -> f64,
    ) -> Result<Vec<Segment>, Misfit> {
        let (at_start, at_end) = (self.radius(center, &self.from), self.radius(center, &self.to));
        if at_start <= SAME {
            return Err(Misfit::NoRadius);
        }
        let (mismatch, allowed) = ((at_start - at_end).abs(), tolerance(at_start));
        if mismatch > allowed {
            return Err(Misfit::Radii(at_start, at_end, allowed));
        }
        let chord = self.chord();
        if self.is_full() {
            return Ok(vec![self.turn(center, TAU * (1.0 + self.extra_turns))]);
        }
        let sweep = self.sweep(center) + TAU * self.extra_turns;
        let (centred, shift) = self.centred(center, chord);
        if sweep <= PI || shift <= mismatch.max(NEGLIGIBLE) {
            return Ok(vec![self.turn(&centred, self.sweep(&centred) + TAU * self.extra_turns)]);
        }
        Ok(self.spiral(center, sweep, (at_start, at_end)))
    }

    /// Pieces of at most half a turn whose ends lie on a spiral from one radius to the other.
    fn spiral(&self, center: &Vector3<f64>, sweep: f64, (at_start, at_end): (f64, f64)) -> Vec<Segment> {
        let [_, _, n] = self.plane.axes();
        let [u, v] = self.directions(center);
        let pieces = (sweep / PI).ceil() as usize;
        let mut from = self.from;
        let chain = (1..=pieces).map(|piece| {
            let part = piece as f64 / pieces as f64;
            let (sin, cos) = math::sin_cos(sweep * part);
            let mut to = center + (u * cos + v * sin) * (at_start + (at_end - at_start) * part);
            to[n] = self.from[n] + (self.to[n] - self.from[n]) * part;
            if piece == pieces {
                to = self.to;
            }
            let arc = Arc { from, to, extra_turns: 0.0, ..*self };
            let (center, _) = arc.centred(center, arc.chord());
            from = to;
            arc.turn(&center, arc.sweep(&center))
        });
        chain.collect()
    }

    /// Whether the segments make almost a full circle between ends no more than `apart` [m] from
    /// each other.
    pub(super) fn is_nearly_full(&self, segments: &[Segment], apart: f64) -> bool {
        let turned = |segment: &Segment| if let Segment::Arc { sweep, .. } = segment { *sweep } else { 0.0 };
        !self.is_full() && self.chord() <= apart && segments.iter().map(turned).sum::<f64>() > PI
    }

    /// Distance of the ends in the plane [m].
    fn chord(&self) -> f64 {
        let [a, b, _] = self.plane.axes();
        math::hypot(self.to[a] - self.from[a], self.to[b] - self.from[b])
    }

    /// Whether the ends coincide in the plane: a full circle.
    fn is_full(&self) -> bool {
        self.chord() <= SAME
    }

    /// Distance of a point from the axis through `center` [m].
    fn radius(&self, center: &Vector3<f64>, point: &Vector3<f64>) -> f64 {
        let [a, b, _] = self.plane.axes();
        math::hypot(point[a] - center[a], point[b] - center[b])
    }

    /// Unit vectors from the centre to the start, and in the direction of travel there.
    fn directions(&self, center: &Vector3<f64>) -> [Vector3<f64>; 2] {
        let [a, b, _] = self.plane.axes();
        let radius = self.radius(center, &self.from);
        let (cos, sin) = ((self.from[a] - center[a]) / radius, (self.from[b] - center[b]) / radius);
        let forward = if self.counter_clockwise { 1.0 } else { -1.0 };
        let (mut u, mut v) = (Vector3::zeros(), Vector3::zeros());
        (u[a], u[b]) = (cos, sin);
        (v[a], v[b]) = (-sin * forward, cos * forward);
        [u, v]
    }

    /// Angle from the start to the end about `center`, in (0, 2 pi].
    fn sweep(&self, center: &Vector3<f64>) -> f64 {
        let [a, b, _] = self.plane.axes();
        let (start, end) = (self.from - center, self.to - center);
        let forward = if self.counter_clockwise { 1.0 } else { -1.0 };
        let cross = (start[a] * end[b] - start[b] * end[a]) * forward;
        let angle = math::atan2(cross, start[a] * end[a] + start[b] * end[b]);
        if angle > 0.0 { angle } else { angle + TAU }
    }

    /// The centre moved along the chord until it is equidistant from start and end, and the
    /// distance it moved [m].
    fn centred(&self, center: &Vector3<f64>, chord: f64) -> (Vector3<f64>, f64) {
        let [a, b, _] = self.plane.axes();
        let (along, across) = ((self.to[a] - self.from[a]) / chord, (self.to[b] - self.from[b]) / chord);
        let shift = (self.from[a] + self.to[a] - 2.0 * center[a]) / 2.0 * along
            + (self.from[b] + self.to[b] - 2.0 * center[b]) / 2.0 * across;
        let mut centred = *center;
        centred[a] += shift * along;
        centred[b] += shift * across;
        (centred, shift.abs())
    }

    /// The arc about a centre equidistant from both ends.
    fn turn(&self, center: &Vector3<f64>, sweep: f64) -> Segment {
        let [_, _, n] = self.plane.axes();
        let [u, v] = self.directions(center);
        let mut center = *center;
        center[n] = self.from[n];
        let climb = self.to[n] - self.from[n];
        // A segment rises along u x v, which is opposite to the normal on a clockwise arc.
        let rise = if self.counter_clockwise { climb } else { 0.0 - climb };
        Segment::Arc { center, u, v, radius: self.radius(&center, &self.from), sweep, rise }
    }
}
