//! The course that dense or rounded points stand for.
//!
//! A program is written in steps of 0.01 mm, often finer. Where its points are dense, a step to the
//! side turns a short move by far more than the course turns: a circle of 10 mm in points every
//! 0.05 mm, to two decimals, has a corner of up to 16 deg at most of them. A junction with a short
//! move is therefore a corner only if the course itself turns there: as it arrives and as it leaves,
//! each a parabola within [`BESIDE`] of the points, over as long a stretch as there is one.

use crate::math;
use crate::path::{Corner, Move, Path};
use crate::units::MM;
use nalgebra::Vector3;

/// A point of a program lies no further beside the course that it stands for [m]: half a step of
/// 0.01 mm in two coordinates at once is 0.0071 mm.
pub const BESIDE: f64 = 0.01 * MM;

/// Longest stretch looked at on either side of a corner [m].
pub const LONGEST: f64 = 5.0 * MM;

/// Points looked at on an arc.
const ON_ARC: usize = 16;

/// What may be left out of a course next to a corner [m].
const SKIPPED: f64 = 5.0 * BESIDE;

/// Corners nearer to each other than this are one corner of the course [m].
const ONE_CORNER: f64 = 10.0 * BESIDE;

/// The junctions at which the moves turn by more than `limit` [rad], each with the index of the move
/// that ends there.
pub fn of_moves(path: &Path, limit: f64) -> Vec<(usize, Corner)> {
    path.corners().enumerate().filter(|(_, corner)| corner.angle > limit).collect()
}

/// Those of them at which the course turns as well. What is in doubt counts as smooth.
pub fn corners(path: &Path, limit: f64) -> Vec<(usize, Corner)> {
    let mut corners: Vec<(usize, Corner)> = Vec::new();
    // Where the corner of the course that was found last begins [m].
    let mut begins = f64::NEG_INFINITY;
    for (index, corner) in of_moves(path, limit) {
        if !turns(path, index, &corner, limit) {
            continue;
        }
        if corner.s - begins >= ONE_CORNER {
            begins = corner.s;
            corners.push((index, corner));
        } else if let Some(last) = corners.last_mut().filter(|last| corner.angle > last.1.angle) {
            // The sharpest of them is nearest to the corner of the course.
            *last = (index, corner);
        }
    }
    corners
}

/// Whether the course turns by more than `limit` [rad] at a `corner`, the one between the moves
/// `index` and `index + 1`; see [`Direction`]. Both directions together are in doubt by half of
/// `limit` where there is room for that and `limit` is at least 3.7 deg.
fn turns(path: &Path, index: usize, corner: &Corner, limit: f64) -> bool {
    let (arriving, leaving) = path.moves().split_at(index + 1);
    let reach = (32.0 * BESIDE / limit).min(LONGEST);
    let short = |step: &Move| step.segment.length() < reach / 4.0;
    if !(short(&arriving[index]) || short(&leaving[0])) {
        return corner.angle > limit;
    }
    let arriving = Direction::surest(&points(arriving.iter().rev(), reach, |length, s| length - s));
    let leaving = Direction::surest(&points(leaving.iter(), reach, |_, s| s));
    let turn = math::angle_between(&-arriving.tangent, &leaving.tangent);
    // A bend of the radius r may have turned by the angle b before it is further than r b^2 / 2 from
    // the straight course before it.
    let hidden = (2.0 * BESIDE * arriving.curvature.max(leaving.curvature)).sqrt();
    turn - arriving.doubt - leaving.doubt - hidden > limit
}

/// The direction in which a course leaves its first point.
///
/// With ends up to [`BESIDE`] on either side, that of a straight move of the length L is known to
/// 2 `BESIDE` / L. At the end of a parabola that strays by up to `BESIDE` over the length L it may be
/// off by four times as much (Markov's inequality for polynomials).
struct Direction {
    /// Unit tangent.
    tangent: Vector3<f64>,
    /// How far it may be off [rad].
    doubt: f64,
    /// Curvature of the course [1/m].
    curvature: f64,
}

impl Direction {
    /// The one with the least doubt, from the first of `points` or from one of those that follow within
    /// [`SKIPPED`]: a step of 0.01 mm to the side says nothing about where a course goes.
    fn surest(points: &[Vector3<f64>]) -> Self {
        let first = Self::of(points);
        let further = (2..points.len().saturating_sub(2)).step_by(2);
        further
            .take_while(|&k| (points[k] - points[0]).norm() <= SKIPPED)
            .map(|k| {
                let skipped = (points[k] - points[0]).norm();
                let from_there = Self::of(&points[k..]);
                Self { doubt: from_there.doubt + from_there.curvature * skipped, ..from_there }
            })
            .fold(first, |best, next| if next.doubt < best.doubt { next } else { best })
    }

    /// By the longest parabola from the first of `points`, or by the first move, the first three,
    /// whichever leaves less doubt.
    fn of(points: &[Vector3<f64>]) -> Self {
        let chord = |last: usize| points[last] - points[0];
        let length = |last: usize| chord(last).norm();
        let first = Self { tangent: chord(2).normalize(), doubt: 2.0 * BESIDE / length(2), curvature: 0.0 };
        let mut last = points.len() - 1;
        while last > 2 {
            if let Some((tangent, curvature)) = parabola(&points[..=last]) {
                let doubt = 8.0 * BESIDE / length(last);
                let smooth = Self { tangent: tangent.normalize(), doubt, curvature };
                return if smooth.doubt < first.doubt { smooth } else { first };
            }
            last -= last.div_ceil(4);
        }
        first
    }
}

/// Direction at its start and curvature [1/m] of the parabola through the first and the last point that is nearest to
/// the others; `None` if it is further than [`BESIDE`] from any of them.
fn parabola(points: &[Vector3<f64>]) -> Option<(Vector3<f64>, f64)> {
    let (first, last) = (points.first()?, points.last()?);
    let chord = (last - first).try_normalize(BESIDE)?;
    let length = (last - first).norm();
    // Part of the length, and the way from the chord to the point.
    let place = |point: &Vector3<f64>| {
        let along = (point - first).dot(&chord);
        (along / length, point - first - chord * along)
    };
    // The parabola is bend x (1 - x) beside the chord at the part x of its length.
    let (mut sum, mut squares) = (Vector3::zeros(), 0.0);
    for (x, aside) in points.iter().map(place) {
        let weight = x * (1.0 - x);
        sum += aside * weight;
        squares += weight * weight;
    }
    let bend = if squares > 0.0 { sum / squares } else { Vector3::zeros() };
    let near = |(x, aside): (f64, Vector3<f64>)| {
        let beyond = (x - x.clamp(0.0, 1.0)) * length;
        math::hypot((aside - bend * (x * (1.0 - x))).norm(), beyond) <= BESIDE
    };
    points.iter().map(place).all(near).then(|| (chord + bend / length, 2.0 * bend.norm() / (length * length)))
}

/// The junction that `moves` lead away from, and points along them over the length `reach` [m]: the
/// middle and the end of lines, more on arcs. `from_start` turns a distance from the junction into
/// one from the start of a move of a given length.
fn points<'m>(
    moves: impl Iterator<Item = &'m Move>,
    reach: f64,
    from_start: fn(f64, f64) -> f64,
) -> Vec<Vector3<f64>> {
    let mut points = Vec::new();
    let mut left = reach;
    for Move { segment, .. } in moves {
        let length = segment.length();
        let at = |s: f64| segment.point(from_start(length, s));
        let (count, looked_at) = (if segment.curvature() == 0.0 { 2 } else { ON_ARC }, length.min(left));
        points.extend(points.is_empty().then(|| at(0.0)));
        points.extend((1..=count).map(|i| at(looked_at * i as f64 / count as f64)));
        left -= length;
        if left <= 0.0 {
            break;
        }
    }
    points
}
