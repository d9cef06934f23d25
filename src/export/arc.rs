//! Arcs through commanded points, in the form of G2 and G3: about one of the workpiece's axes, with
//! an even rise.
//!
//! From each point, doubling and halving finds the longest arc and the longest straight move within
//! the tolerance; the one that reaches further is used. Both ends are kept as written, which leaves
//! one unknown, the distance of the centre from the chord: a linear least-squares problem (Kasa, "A
//! circle fitting procedure and its error analysis", IEEE Transactions on Instrumentation and
//! Measurement IM-25(1), 1976). The distance of the points from the arc is then measured.

use crate::export::thin::{LEVER, Point};
use crate::math::{self, FRAC_PI_2, TAU};
use crate::path::Segment;
use nalgebra::{Matrix2, Vector2, Vector3};

/// Ends of an arc are at least this far apart, or the same point [m]. In between, a control's
/// rounding would decide between nothing and a full turn.
const APART: f64 = 5e-5;
/// An arc of a larger radius is straight enough [m].
const LARGEST: f64 = 100.0;

/// A move to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Its end.
    pub to: Point,
    /// The arc, if it is not straight.
    pub arc: Option<ArcMove>,
}

/// An arc about one of the workpiece's axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcMove {
    /// The axis: 0 is X (G19), 1 is Y (G18), 2 is Z (G17).
    pub normal: usize,
    /// Centre, at the height of the start [m].
    pub center: Vector3<f64>,
    /// Angle swept [rad], positive if counter-clockwise seen from the axis's positive end (G3); a
    /// full turn where the ends are the same.
    pub sweep: f64,
}

impl ArcMove {
    /// Number of turns begun: 1 for most arcs.
    pub fn turns(&self) -> f64 {
        // A full circle is a whole number of turns.
        (self.sweep.abs() / TAU - 1e-9).ceil()
    }
}

impl Step {
    /// The move from `from`, where the tool is.
    pub fn segment(&self, from: &Point) -> Segment {
        let Some(ArcMove { normal, center, sweep }) = self.arc else {
            return Segment::Line { from: from.position, to: self.to.position };
        };
        let mut spoke = from.position - center;
        spoke[normal] = 0.0;
        let (radius, u) = (spoke.norm(), spoke.normalize());
        let up = Vector3::ith(normal, sweep.signum());
        let rise = (self.to.position - from.position).dot(&up);
        let center = center + up * (from.position - center).dot(&up);
        Segment::Arc { center, u, v: up.cross(&u), radius, sweep: sweep.abs(), rise }
    }
}

/// A point as written, in steps of `resolution` [m].
pub(super) fn rounded(point: &Point, resolution: f64) -> Point {
    Point { position: point.position.map(|x| (x / resolution).round() * resolution), ..*point }
}

/// Straight moves and arcs from the first of `points`, which is as written, to the last, and the
/// largest distance of the points from them [m].
pub(super) fn steps(points: &[Point], normal: usize, tolerance: f64, resolution: f64) -> (Vec<Step>, f64) {
    let mut points = points.to_vec();
    let mut steps = Vec::new();
    let (mut from, mut deviation) = (0, 0.0_f64);
    while from + 1 < points.len() {
        let ahead = &points[from..];
        let straight = |to: usize| {
            let end = rounded(&ahead[to], resolution);
            let worst = ahead[..=to].iter().map(|point| point.distance(&ahead[0], &end)).fold(0.0, f64::max);
            (worst <= tolerance || to == 1).then_some((Step { to: end, arc: None }, worst))
        };
        let turned = |to: usize| around(&ahead[..=to], normal, tolerance, resolution);
        let near = |to: usize| (ahead[to].position - ahead[0].position).norm() < APART;
        let line = longest(ahead.len() - 1, |to| straight(to).is_some());
        let arc = longest(ahead.len() - 1, |to| near(to) || turned(to).is_some());
        // Where the longest arc would nearly close, half of it will do as well.
        let arc =
            [arc, arc / 2].into_iter().filter(|to| *to > line).find_map(|to| turned(to).map(|arc| (to, arc)));
        let Some((reach, (step, worst))) = arc.or_else(|| straight(line).map(|step| (line, step))) else {
            break;
        };
        from += reach;
        deviation = deviation.max(worst);
        if step.arc.is_some() || step.to != ahead[0] {
            steps.push(step);
        }
        points[from] = step.to;
    }
    (steps, deviation)
}

/// The largest number up to `last` that `fits`, provided that all smaller ones do; 1 is assumed to
/// fit.
fn longest(last: usize, fits: impl Fn(usize) -> bool) -> usize {
    let (mut low, mut stride) = (1, 1);
    let mut high = last + 1;
    while low < last {
        let next = (low + stride).min(last);
        if !fits(next) {
            high = next;
            break;
        }
        low = next;
        stride *= 2;
    }
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if fits(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// The arc from the first point to the last, and the largest distance of the points from it [m];
/// `None` if that is more than `tolerance`.
fn around(points: &[Point], normal: usize, tolerance: f64, resolution: f64) -> Option<(Step, f64)> {
    let [a, b] = [(normal + 1) % 3, (normal + 2) % 3];
    let start = points[0];
    let mut end = rounded(points.last()?, resolution);
    let flat = |p: &Vector3<f64>| Vector2::new(p[a] - start.position[a], p[b] - start.position[b]);
    let closed = flat(&end.position).norm() <= tolerance;
    if closed {
        (end.position[a], end.position[b]) = (start.position[a], start.position[b]);
    }
    let chord = flat(&end.position);
    if !closed && chord.norm() < APART {
        return None;
    }
    let beside = center(points.iter().map(|point| flat(&point.position)), &chord)?;
    let center = beside.map(|x| (x / resolution).round() * resolution);
    let (first, last) = (-center, chord - center);
    let (at_start, at_end) = (first.norm(), last.norm());
    if !(at_start > tolerance && at_start < LARGEST) {
        return None;
    }
    let bearing = |spoke: &Vector2<f64>| math::atan2(first.perp(spoke), first.dot(spoke));
    let mut angles = Vec::with_capacity(points.len());
    let mut angle = 0.0;
    for point in points {
        let next = math::nearest_turn(bearing(&(flat(&point.position) - center)), angle);
        if (next - angle).abs() > FRAC_PI_2 {
            return None;
        }
        angle = next;
        angles.push(angle);
    }
    let sweep = if closed { (angle / TAU).round() * TAU } else { math::nearest_turn(bearing(&last), angle) };
    if sweep == 0.0 {
        return None;
    }
    let mut worst = 0.0_f64;
    for (point, angle) in points.iter().zip(&angles) {
        let part = (angle / sweep).clamp(0.0, 1.0);
        let (sin, cos) = math::sin_cos(part * sweep);
        // Rounding may leave the ends at slightly different radii: the radius changes evenly from
        // one to the other.
        let radius = at_start + (at_end - at_start) * part;
        let spoke =
            Vector2::new(first.x * cos - first.y * sin, first.x * sin + first.y * cos) * (radius / at_start);
        let aside = flat(&point.position) - center - spoke;
        let rise = end.position[normal] - start.position[normal];
        let above = point.position[normal] - start.position[normal] - rise * part;
        let turned = (point.axis - start.axis).norm() * LEVER;
        worst = worst.max(math::hypot(aside.norm(), above)).max(turned);
        if worst > tolerance {
            return None;
        }
    }
    let mut at = start.position;
    (at[a], at[b]) = (at[a] + center.x, at[b] + center.y);
    Some((Step { to: end, arc: Some(ArcMove { normal, center: at, sweep }) }, worst))
}

/// Centre of the circle through the origin and the end of `chord` that is nearest to the points;
/// through the origin alone where there is no chord.
fn center(points: impl Iterator<Item = Vector2<f64>>, chord: &Vector2<f64>) -> Option<Vector2<f64>> {
    let length = chord.norm();
    if length == 0.0 {
        let (mut squares, mut sums) = (Matrix2::zeros(), Vector2::zeros());
        for p in points {
            squares += p * p.transpose();
            sums += p * (p.norm_squared() / 2.0);
        }
        return squares.try_inverse().map(|inverse| inverse * sums);
    }
    let across = Vector2::new(-chord.y, chord.x) / length;
    let (mut squares, mut sums) = (0.0, 0.0);
    for p in points {
        let beside = p.dot(&across);
        squares += beside * beside;
        // |p|^2 - p . chord is |p - middle|^2 - (length / 2)^2.
        sums += beside * (p.norm_squared() - p.dot(chord)) / 2.0;
    }
    let height = sums / squares;
    height.is_finite().then(|| chord / 2.0 + across * height)
}
