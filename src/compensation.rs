//! What to command: the path bent the other way until the actual one comes out right (thesis eq. 5.4, Figs. 5.12, 5.16).
//!
//! Each pass sends the commands through the whole model and adds the contour error that is left to the correction.
//! Shaping delays the motion, so an error seen now belongs to commands that were given a while (on the thesis's circle 15 mm)
//! ago: [`Shaper::undo`] files it under them. The error corrected is the tip's way to the point of the path where the shaped
//! motion should be, not only eq. 5.2's way to the closest point: it is smooth around corners and brings ends and corners where
//! they belong, which the contour error cannot see. What is reported stays the contour error. Along a path whose tool axis turns, the
//! axis is corrected in the same way. Once it has arrived at the end the command rests, so that a program can say it.
//!
//! [`Shaper::undo`]: crate::motion::Shaper::undo

use crate::deviation::{Deviation, Passage, Plan, contour, deviate};
use crate::error::Error;
use crate::motion::Trajectory;
use crate::motion::joints::{StartBranch, joint_trajectory};
use crate::path::Path;
use crate::robot::Joints;
use nalgebra::Vector3;
use std::sync::Arc;

/// When to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goal {
    /// Largest contour error to reach [m].
    pub tolerance: f64,
    /// Most passes.
    pub max_passes: usize,
}

/// The path to command and how it was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Compensation {
    /// Correction of the desired position, one a sample, base frame [m].
    pub correction: Vec<Vector3<f64>>,
    /// Tool axis to command, one a sample, base frame; the desired one where the path keeps one axis all along.
    pub axis: Vec<Vector3<f64>>,
    /// Joint commands for the corrected path [rad].
    pub q: Arc<Vec<Joints>>,
    /// What becomes of them: the same model, sent through again.
    pub result: Arc<Deviation>,
    /// Largest contour error before the first pass and after each [m].
    pub history_max: Vec<f64>,
    /// Mean contour error before the first pass and after each [m].
    pub history_mean: Vec<f64>,
    /// Number of the pass whose path is commanded (0: the desired path itself).
    pub passes: usize,
    /// Whether the tolerance was reached.
    pub converged: bool,
    /// Why a pass could not be carried out, if one could not.
    pub stopped: Option<Error>,
}

/// Share of the tolerance at which the passes end: the rest is left to what no model knows, and costs a pass or two.
const AIM: f64 = 0.1;
/// A pass that leaves more than this share of the error is no improvement.
const IMPROVEMENT: f64 = 0.99;

/// Corrects the path for the sources that act in `passage` until the largest contour error is well within the tolerance (a tenth of it), the
/// passes are used up, or a pass no longer improves; the best pass is kept. A path that is within the tolerance is left alone. `before` is [`deviate`] of the joint commands `q` with the same sources.
///
/// `on_pass` is told the number of passes done.
pub fn compensate(
    plan: &Plan,
    passage: &Passage,
    start: StartBranch,
    q: &Arc<Vec<Joints>>,
    before: &Arc<Deviation>,
    goal: Goal,
    mut on_pass: impl FnMut(usize),
) -> Compensation {
    let (mean, max) = contour::mean_and_max(&before.contour_error);
    let mut best = Compensation {
        correction: vec![Vector3::zeros(); q.len()],
        axis: plan.trajectory.axis.clone(),
        q: q.clone(),
        result: before.clone(),
        history_max: vec![max],
        history_mean: vec![mean],
        passes: 0,
        converged: max <= goal.tolerance,
        stopped: None,
    };
    for pass in 1..=goal.max_passes {
        if best.history_max[best.passes] <= goal.tolerance * if best.passes == 0 { 1.0 } else { AIM } {
            break;
        }
        let Trajectory { sample_time, moving, .. } = plan.trajectory;
        let undone = |missing: Vec<Vector3<f64>>| {
            if passage.acting.shaping { plan.shaper.undo(&missing, sample_time, moving) } else { missing }
        };
        let (correction, axis) =
            corrected(&plan.path, passage, &best.result, (&best.correction, &best.axis), undone);
        let positions: Vec<_> =
            plan.trajectory.position.iter().zip(&correction).map(|(desired, c)| desired + c).collect();
        let commands =
            match joint_trajectory(&plan.robot, &plan.path, &plan.trajectory, (&positions, &axis), start) {
                Ok(joints) => joints.q,
                Err(error) => {
                    best.stopped = Some(error);
                    break;
                }
            };
        drop(positions);
        let result = Arc::new(deviate(plan, passage, &commands));
        let (mean, max) = contour::mean_and_max(&result.contour_error);
        on_pass(pass);
        let least = best.history_max[best.passes];
        best.history_max.push(max);
        best.history_mean.push(mean);
        if max >= least * IMPROVEMENT {
            break;
        }
        best = Compensation {
            correction,
            axis,
            q: commands,
            result,
            passes: pass,
            converged: max <= goal.tolerance,
            ..best
        };
    }
    best
}

/// A correction [m] and tool axes, one a sample, with what `result` is missing at the places of `passage`: `undone` turns the vectors that are
/// missing into those to add to the commands.
pub(crate) fn corrected(
    path: &Path,
    passage: &Passage,
    result: &Deviation,
    (correction, axis): (&[Vector3<f64>], &[Vector3<f64>]),
    undone: impl Fn(Vec<Vector3<f64>>) -> Vec<Vector3<f64>>,
) -> (Vec<Vector3<f64>>, Vec<Vector3<f64>>) {
    let missing = passage.target.iter().zip(&result.actual).map(|(target, actual)| target - actual);
    let more = undone(missing.collect());
    let correction = correction.iter().zip(&more).map(|(c, more)| c + more).collect();
    if !path.is_multi_axis() {
        return (correction, axis.to_vec());
    }
    // The turn that is missing, as a rotation vector: its size is the sine of the angle, small and soon exact.
    let wanted = passage.pace.arc_length.iter().map(|&s| path.axis(s));
    let missing = wanted.zip(&result.axis).map(|(wanted, actual)| actual.cross(&wanted));
    let turns = undone(missing.collect());
    let turned = axis.iter().zip(&turns).map(|(axis, turn)| (axis + turn.cross(axis)).normalize());
    (correction, turned.collect())
}
