//! What a picture of the run in space is drawn from.

use crate::math::Pose;
use crate::report::Report;
use crate::robot::{Joints, Robot, forward};
use crate::units::MM;

/// Numbers in a frame of [`Report::frames`].
pub const FRAME: usize = 12;
/// Numbers in a row of [`Report::track`].
pub const ROW: usize = 17;

/// An arm with the joint values `q` [rad]: the base, the six joints and the TCP, each as origin [mm] and x, y, z axes.
pub fn arm(robot: &Robot, q: &Joints) -> Vec<f64> {
    let joints = forward::frames(robot, q);
    let tcp = joints[5].compose(robot.tool());
    [Pose::identity()].into_iter().chain(joints).chain([tcp]).flat_map(|pose| frame(&pose)).collect()
}

fn frame(pose: &Pose) -> Vec<f64> {
    pose.position.iter().map(|v| v / MM).chain(pose.rotation.iter().copied()).collect()
}

impl Report {
    /// Where the arm stands at a sample under the shaped commands, in the base frame: the base, the six joints, the TCP and the workpiece, each
    /// as origin [mm] and x, y, z axes. A sample past the end means the last one.
    pub fn frames(&self, sample: usize) -> Vec<f64> {
        let mut numbers = arm(&self.plan.robot, &self.shaped(&self.q).at(sample.min(self.samples() - 1)));
        numbers.extend(frame(&self.setup().workpiece));
        numbers
    }

    /// The paths in at most about `most` rows: sample, whether it cuts, desired point, closest point of the desired path to the actual tip before
    /// compensation, way from the path to that tip, the same way after compensation, correction to command (points and ways as x, y, z in the base
    /// frame [mm]).
    ///
    /// A long run is cut into stretches; of each stay its first sample, the one farthest from its chord (a corner) and the one with the largest
    /// error.
    pub fn track(&self, most: usize) -> Vec<f64> {
        let samples = self.samples();
        let kept: Vec<usize> = if samples <= most {
            (0..samples).collect()
        } else {
            let stretch = (3 * samples).div_ceil(most.max(3));
            let starts = (0..samples).step_by(stretch);
            starts
                .flat_map(|start| self.telling(start, (start + stretch).min(samples - 1)))
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

    /// The samples from `start` up to but without `end` that show what happens there, in their order.
    fn telling(&self, start: usize, end: usize) -> Vec<usize> {
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
