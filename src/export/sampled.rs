//! The commanded samples of a path, move by move.

use crate::export::commanded_path::CommandedPath;
use crate::export::thin::Point;
use crate::math::Pose;
use crate::path::Path;
use crate::report::Report;
use nalgebra::Vector3;

/// A commanded move's feed is at most this many times the desired one's.
const STRETCH: f64 = 2.0;

/// The commanded samples of one move, or of several that are written as one, from its start to its
/// end.
#[derive(Debug, Clone)]
pub(super) struct MoveSamples {
    /// The commanded points.
    pub(super) points: Vec<Point>,
    /// Rest before it [s].
    pub(super) wait: f64,
    /// Number of points at rest in a corner.
    pub(super) resting: usize,
    /// Length of the commanded move [m], the rest left out.
    commanded: f64,
    /// Length of the desired move over the same samples [m].
    desired: f64,
}

impl MoveSamples {
    /// Length of the commanded move divided by that of the desired one.
    pub(super) fn stretch(&self) -> f64 {
        // On a move shorter than the change of its correction, the ratio says nothing about speed.
        (self.commanded / self.desired).clamp(1.0 / STRETCH, STRETCH)
    }

    /// This move and the one that follows it without a rest, as one.
    pub(super) fn followed_by(mut self, next: Self) -> Self {
        self.points.extend(next.points.into_iter().skip(1));
        self.commanded += next.commanded;
        self.desired += next.desired;
        self
    }
}

/// The samples of each of the path's moves.
pub(super) fn sampled_moves(
    report: &Report,
    commanded_path: &CommandedPath,
    path: &Path,
    back: &Pose,
) -> Vec<MoveSamples> {
    let trajectory = &report.plan.trajectory;
    let arc_length = &trajectory.timing.arc_length;
    let correction = &commanded_path.correction;
    let sample = |k: usize| Point {
        position: back.point(&(trajectory.position[k] + correction[k])),
        axis: back.direction(commanded_path.axis.at(k)),
        spin: path.roll(arc_length[k]),
        s: arc_length[k],
    };
    let last = arc_length.len() - 1;
    let mut k = 0;
    let mut previous_end = None;
    let mut sampled_moves = Vec::with_capacity(path.moves().len());
    for index in 0..path.moves().len() {
        let (start, end) = (path.start(index), path.start(index + 1));
        let is_last = index + 1 == path.moves().len();
        let mut points: Vec<Point> = previous_end.into_iter().collect();
        let mut desired: Vec<_> = previous_end.iter().map(|_| path.point(start)).collect();
        let mut resting = 0;
        while k <= last && (is_last || arc_length[k] < end) {
            if index > 0 && arc_length[k] == start && trajectory.timing.speed[k] == 0.0 {
                resting += 1;
            }
            points.push(sample(k));
            desired.push(back.point(&trajectory.position[k]));
            k += 1;
        }
        if !is_last && k > 0 && k <= last {
            // Samples seldom fall on the end of a move: the correction there is interpolated
            // between its neighbours.
            let (before, after) = (arc_length[k - 1], arc_length[k]);
            let t = ((end - before) / (after - before)).clamp(0.0, 1.0);
            let turned = sample(k - 1).axis * (1.0 - t) + sample(k).axis * t;
            points.push(Point {
                position: path.point(end)
                    + back.direction(&(correction[k - 1] * (1.0 - t) + correction[k] * t)),
                axis: turned.normalize(),
                spin: path.roll(end),
                s: end,
            });
            desired.push(path.point(end));
        }
        previous_end = points.last().copied();
        // A single sample that happens to fall on a corner is not a wait.
        let wait = if resting > 1 { resting as f64 * trajectory.sample_time } else { 0.0 };
        let travelled = resting.min(points.len() - 1);
        let commanded = length(points[travelled..].iter().map(|point| point.position));
        // Measured over the same samples, so that a move without a correction keeps its feed to the
        // last digit.
        let desired = length(desired[travelled..].iter().copied()).max(f64::MIN_POSITIVE);
        sampled_moves.push(MoveSamples { points, wait, resting: travelled, commanded, desired });
    }
    sampled_moves
}

/// Length of the straight moves between points [m].
fn length(mut points: impl Iterator<Item = Vector3<f64>>) -> f64 {
    let Some(mut last) = points.next() else { return 0.0 };
    points.map(|point| (point - std::mem::replace(&mut last, point)).norm()).sum()
}
