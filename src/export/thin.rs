//! Thins a line: leaves out points without any sample straying further than a tolerance.
//!
//! Points are chosen by the farthest-point rule (Douglas and Peucker, "Algorithms for the reduction
//! of the number of points required to represent a digitized line or its caricature", Cartographica
//! 10(2), 1973), with a list of open spans instead of recursion. The actual distance of the samples
//! from the thinned line is then measured, not assumed.

use crate::math;
use nalgebra::Vector3;

/// A tool position: tip, axis, and spin about it, with the place on the path that it stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Tip [m].
    pub position: Vector3<f64>,
    /// Unit vector from tip to spindle.
    pub axis: Vector3<f64>,
    /// How far the TCP is turned about the axis [rad].
    pub spin: f64,
    /// Arc length along the path [m].
    pub s: f64,
}

/// The axis is held to the same tolerance as the tip, at this height above it [m].
pub const LEVER: f64 = 0.1;

/// The spin is held to the same tolerance at this distance from the axis [m]: it does not move the
/// tip, and hardly changes how the arm bends.
pub const SPIN_LEVER: f64 = 0.001;

impl Point {
    /// Distance from the straight move `from`-`to` [m]: of the tip, or of the point of the axis
    /// [`LEVER`] above it, whichever is larger. Along the move the axis is assumed to change in
    /// step with the tip.
    pub fn distance(&self, from: &Point, to: &Point) -> f64 {
        let along = to.position - from.position;
        let length = along.norm_squared();
        let axis_at = |t: f64| {
            let spin = (self.spin - from.spin * (1.0 - t) - to.spin * t).abs() * SPIN_LEVER;
            ((self.axis - from.axis * (1.0 - t) - to.axis * t).norm() * LEVER).max(spin)
        };
        if length > 0.0 {
            let t = ((self.position - from.position).dot(&along) / length).clamp(0.0, 1.0);
            (self.position - from.position - along * t).norm().max(axis_at(t))
        } else {
            // The tip stands still while the axis turns.
            let turn = to.axis - from.axis;
            let turned = turn.norm_squared();
            let t = if turned > 0.0 {
                ((self.axis - from.axis).dot(&turn) / turned).clamp(0.0, 1.0)
            } else {
                0.0
            };
            (self.position - from.position).norm().max(axis_at(t))
        }
    }
}

/// Indices of points that suffice to keep every point within `tolerance` [m] of the straight moves
/// between them, in order; the first and the last are among them.
pub fn thin(points: &[Point], tolerance: f64) -> Vec<usize> {
    let Some(last) = points.len().checked_sub(1) else { return Vec::new() };
    let mut kept = vec![0];
    let mut ends = vec![last];
    while let Some(&to) = ends.last() {
        let from = kept[kept.len() - 1];
        let mut farthest = (tolerance, None);
        for index in from + 1..to {
            let distance = points[index].distance(&points[from], &points[to]);
            if distance > farthest.0 {
                farthest = (distance, Some(index));
            }
        }
        match farthest.1 {
            Some(index) => ends.push(index),
            None => {
                ends.pop();
                if to > from {
                    kept.push(to);
                }
            }
        }
    }
    kept
}

/// Those of `kept` without the ones whose neighbours alone keep every point within `tolerance` [m]: the
/// rule of the farthest point leaves some that later ones have made redundant.
pub fn pruned(points: &[Point], kept: &[usize], tolerance: f64) -> Vec<usize> {
    let mut pruned: Vec<usize> = Vec::with_capacity(kept.len());
    for (i, &index) in kept.iter().enumerate() {
        let needless = match (pruned.last(), kept.get(i + 1)) {
            (Some(&from), Some(&to)) => {
                (from + 1..to).all(|k| points[k].distance(&points[from], &points[to]) <= tolerance)
            }
            _ => false,
        };
        if !needless {
            pruned.push(index);
        }
    }
    pruned
}

/// Those of `kept` that are at least `least` [m] from the one before and from the last, or whose axis
/// differs from theirs by more than `tolerance` [m] at the height [`LEVER`]; the first and the last are
/// among them, unless they are not apart themselves: then the first alone.
pub fn spaced(points: &[Point], kept: &[usize], (tolerance, least): (f64, f64)) -> Vec<usize> {
    let (Some(&first), Some(&last)) = (kept.first(), kept.last()) else { return Vec::new() };
    let apart = |a: usize, b: usize| {
        let (a, b) = (&points[a], &points[b]);
        (a.position - b.position).norm() >= least || (a.axis - b.axis).norm() * LEVER > tolerance
    };
    let mut spaced = vec![first];
    let mut from = first;
    for &index in &kept[1..kept.len() - 1] {
        if apart(from, index) && apart(index, last) {
            spaced.push(index);
            from = index;
        }
    }
    if spaced.len() > 1 || apart(first, last) {
        spaced.push(last);
    }
    spaced
}

/// As [`thin`], with enough extra points that no straight move turns from the previous one by more
/// than `limit` [rad] where the points themselves do not: a controller would stop there. Turns
/// among the first `resting` points are allowed.
pub fn smooth(points: &[Point], tolerance: f64, resting: usize, limit: f64) -> Vec<usize> {
    let turn = |a: usize, b: usize, c: usize| {
        let at = |index: usize| points[index].position;
        math::angle_between(&(at(b) - at(a)), &(at(c) - at(b)))
    };
    let mut kept = thin(points, tolerance);
    loop {
        let mut wanted = kept.clone();
        for corner in kept.windows(3) {
            let [a, b, c] = [corner[0], corner[1], corner[2]];
            if a >= resting && turn(a, b, c) > limit && turn(b - 1, b, b + 1) <= limit {
                wanted.extend([usize::midpoint(a, b), usize::midpoint(b, c)]);
            }
        }
        wanted.sort_unstable();
        wanted.dedup();
        if wanted.len() == kept.len() {
            return kept;
        }
        // A point in between may leave others further from the shorter moves than they were from
        // the long one.
        let between = |ends: &[usize]| {
            let part = thin(&points[ends[0]..=ends[1]], tolerance);
            part.into_iter().skip(1).map(|index| ends[0] + index).collect::<Vec<_>>()
        };
        kept = [0].into_iter().chain(wanted.windows(2).flat_map(between)).collect();
    }
}

/// Largest distance [m] of `points` from the moves as written: `written[i]` replaces
/// `points[kept[i]]` by one point or several.
pub fn deviation(points: &[Point], kept: &[usize], written: &[Vec<Point>]) -> f64 {
    let mut largest = 0.0_f64;
    for (ends, standing) in kept.windows(2).zip(written.windows(2)) {
        let chain: Vec<&Point> = standing.iter().flatten().collect();
        for point in &points[ends[0]..=ends[1]] {
            let from = |ends: &[&Point]| point.distance(ends[0], ends[1]);
            largest = largest.max(chain.windows(2).map(from).fold(f64::INFINITY, f64::min));
        }
    }
    largest
}
