//! The data for a picture of the run in space.

use crate::math::Pose;
use crate::report::Report;
use crate::robot::{Joints, Robot, forward};
use crate::units::MM;

/// Numbers in a frame of [`Report::frames`].
pub const FRAME: usize = 12;
/// Numbers in a row of [`Report::track`].
pub const ROW: usize = 17;

/// Frames of an arm at the joint values `q` [rad]: the base, the six joints and the TCP, each as
/// origin [mm] and x, y, z axes.
pub fn arm(robot: &Robot, q: &Joints) -> Vec<f64> {
    let joints = forward::frames(robot, q);
    let tcp = joints[5].compose(robot.tool());
    [Pose::identity()].into_iter().chain(joints).chain([tcp]).flat_map(|pose| frame(&pose)).collect()
}

fn frame(pose: &Pose) -> Vec<f64> {
    pose.position.iter().map(|v| v / MM).chain(pose.rotation.iter().copied()).collect()
}

impl Report {
    /// Frames at a sample under the shaped commands, in the base frame: the base, the six joints,
    /// the TCP and the workpiece, each as origin [mm] and x, y, z axes. A sample past the end
    /// stands for the last one.
    pub fn frames(&self, sample: usize) -> Vec<f64> {
        let mut numbers = arm(&self.plan.robot, &self.shaped(&self.q).at(sample.min(self.samples() - 1)));
        numbers.extend(frame(&self.setup().workpiece));
        numbers
    }

    /// The paths in at most about `most` rows. Each row holds the sample, whether it cuts, the
    /// desired point, the point of the desired path closest to the actual tip before compensation,
    /// the vector from there to that tip, that vector after compensation, and the correction to
    /// command (points and vectors as x, y, z in the base frame [mm]).
    ///
    /// A long run is divided into stretches. Each keeps its first sample, the sample farthest from
    /// its chord (a corner) and the sample with the largest error.
    pub fn track(&self, most: usize) -> Vec<f64> {
        let samples = self.samples();
        let kept: Vec<usize> = if samples <= most {
            (0..samples).collect()
        } else {
            let stretch = (3 * samples).div_ceil(most.max(3));
            let starts = (0..samples).step_by(stretch);
            starts
                .flat_map(|start| self.representative(start, (start + stretch).min(samples - 1)))
                .chain([samples - 1])
                .collect()
        };
        let mut rows = Vec::with_capacity(kept.len() * ROW);
        for k in kept {
            let error = self.before.contour_error[k];
            let (after, correction) = (self.after.contour_error[k], self.compensation.correction[k]);
            let position = self.plan.trajectory.position[k];
            rows.extend([k as f64, self.plan.trajectory.timing.engaged[k]]);
            for vector in [position, self.before.actual[k] + error, -error, -after, correction] {
                rows.extend(vector.iter().map(|v| v / MM));
            }
        }
        rows
    }

    /// The representative samples from `start` up to, but not including, `end`, in order.
    fn representative(&self, start: usize, end: usize) -> Vec<usize> {
        let position = &self.plan.trajectory.position;
        let chord = (position[end] - position[start]).try_normalize(0.0).unwrap_or_default();
        let beside = |k: &usize| (position[*k] - position[start]).cross(&chord).norm();
        let error = |k: &usize| self.before.contour_error[*k].norm();
        let corner = (start..end).max_by(|a, b| beside(a).total_cmp(&beside(b)));
        let worst = (start..end).max_by(|a, b| error(a).total_cmp(&error(b)));
        let mut kept: Vec<usize> = (start..end).take(1).chain(corner).chain(worst).collect();
        kept.sort_unstable();
        kept.dedup();
        kept
    }
}
