//! What to command: the path, bent the opposite way until the actual one comes out right (thesis
//! eq. 5.4, Figs. 5.12, 5.16).
//!
//! Each pass simulates the commands with the whole model and adds the remaining error to the
//! correction. Shaping delays the motion, so an error seen now was caused by earlier commands (15
//! mm earlier on the thesis's circle); [`Shaper::undo`] attributes it to them. The error corrected
//! is the distance from the tip to the path point where the shaped motion should be, not eq. 5.2's
//! distance to the closest point. It is smooth around corners and puts ends and corners where they
//! belong, which the contour error cannot see. The report still states the contour error. If the
//! tool axis turns along the path, or the job says so, it is corrected in the same way. If the job
//! compensates in the middle of the cut, that point takes the place of the tip. The command rests once it has
//! arrived at the end, so that a program can express it.
//!
//! [`Shaper::undo`]: crate::motion::Shaper::undo

use crate::deviation::contour::MeanMax;
use crate::deviation::{Deviation, Reference, simulate};
use crate::error::Error;
use crate::motion::Trajectory;
use crate::motion::joints::{Targets, joint_trajectory_from};
use crate::path::Axes;
use crate::plan::Plan;
use crate::progress::Progress;
use crate::robot::Joints;
use crate::setup::Goal;
use nalgebra::Vector3;
use std::sync::Arc;

/// The input of a compensation.
#[derive(Debug, Clone, Copy)]
pub struct Question<'a> {
    /// Where the tool should be; the sources that act in it are compensated.
    pub reference: &'a Reference<'a>,
    /// Joint commands for the desired path [rad].
    pub q: &'a Arc<Vec<Joints>>,
    /// Their result under the same sources, from [`simulate`].
    pub before: &'a Arc<Deviation>,
    /// When to stop.
    pub goal: Goal,
}

/// The path to command and how it was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Compensation {
    /// Correction of the desired position, one per sample, base frame [m].
    pub correction: Vec<Vector3<f64>>,
    /// Tool axis to command, base frame; the desired one if only tips are corrected.
    pub axis: Axes,
    /// Joint commands for the corrected path [rad].
    pub q: Arc<Vec<Joints>>,
    /// Their result in the same model.
    pub result: Arc<Deviation>,
    /// Largest error (see [`Deviation::judged`]) before the first pass and after each pass [m].
    pub history_max: Vec<f64>,
    /// Mean of that error before the first pass and after each pass [m].
    pub history_mean: Vec<f64>,
    /// Number of the pass whose path is commanded (0: the desired path itself).
    pub passes: usize,
    /// Whether the tolerance was reached.
    pub converged: bool,
    /// Why a pass failed, if one did.
    pub stopped: Option<Error>,
}

/// Share of the tolerance at which the passes end. The rest is left for what no model covers.
/// Reaching the aim costs a pass or two.
const AIM: f64 = 0.1;
/// A pass that leaves more than this share of the error does not count as an improvement.
const IMPROVEMENT: f64 = 0.99;
/// A pass that leaves more than this share of the error is the last: what the shaper lets through
/// only slowly is not worth the passes.
const STALLED: f64 = 0.8;

/// Corrects the path until the largest error is well within the tolerance (a tenth of it),
/// the passes are used up, or a pass brings no more improvement. The best pass is kept. A path
/// already within the tolerance at 95 % stays as it is.
pub fn compensate(plan: &Plan, question: &Question, progress: &mut Progress) -> Compensation {
    let Question { reference, q, before, goal } = *question;
    let mut best = Compensation {
        correction: vec![Vector3::zeros(); q.len()],
        axis: plan.trajectory.axis.clone(),
        q: q.clone(),
        result: before.clone(),
        history_max: vec![before.judged.max],
        history_mean: vec![before.judged.mean],
        passes: 0,
        converged: before.judged.max <= goal.tolerance,
        stopped: None,
    };
    for pass in 1..=goal.max_passes {
        let aim = if best.passes == 0 { 1.0 / goal.margin } else { AIM };
        if best.history_max[best.passes] <= goal.tolerance * aim {
            break;
        }
        let mut progress = progress.part(
            "",
            (pass - 1) as f64 / goal.max_passes as f64,
            pass as f64 / goal.max_passes as f64,
        );
        let (correction, axis) = next_correction(plan, reference, &best);
        // Half of a pass is the inverse model, the other half everything after it.
        let commands = match commands(plan, &q[0], (&correction, &axis), &mut progress.part("", 0.0, 0.5)) {
            Ok(commands) => commands,
            Err(error) => {
                best.stopped = Some(error);
                break;
            }
        };
        let result = Arc::new(simulate(plan, reference, &commands, &mut progress.part("", 0.5, 1.0)));
        let MeanMax { mean, max } = result.judged;
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
        if max > least * STALLED {
            break;
        }
    }
    best
}

/// The correction [m] and tool axes of the next pass.
fn next_correction(plan: &Plan, reference: &Reference, best: &Compensation) -> (Vec<Vector3<f64>>, Axes) {
    let Trajectory { sample_time, moving, .. } = *plan.trajectory;
    let undone = |missing: Vec<Vector3<f64>>| {
        if reference.acting.shaping { plan.shaper().undo(&missing, sample_time, moving) } else { missing }
    };
    let wanted = (&*reference.target, &reference.axis);
    corrected(wanted, &best.result, (&best.correction, &best.axis), undone)
}

/// Joint commands for the desired path with a correction [m] and tool axes, from near `start` [rad].
pub(crate) fn commands(
    plan: &Plan,
    start: &Joints,
    (correction, axis): (&[Vector3<f64>], &Axes),
    progress: &mut Progress,
) -> Result<Arc<Vec<Joints>>, Error> {
    progress.at(0.0);
    let position: Vec<_> =
        plan.trajectory.position.iter().zip(correction).map(|(desired, c)| desired + c).collect();
    let targets = Targets { position: &position, axis, ..Targets::desired(&plan.path, &plan.trajectory) };
    Ok(joint_trajectory_from(&plan.robot, &targets, start, progress)?.q)
}

/// A correction [m] and tool axes, one per sample, plus what `result` lacks of the desired tips and
/// axes. `undone` converts the missing vectors into those to add to the commands.
pub(crate) fn corrected(
    (target, wanted): (&[Vector3<f64>], &Axes),
    result: &Deviation,
    (correction, axis): (&[Vector3<f64>], &Axes),
    undone: impl Fn(Vec<Vector3<f64>>) -> Vec<Vector3<f64>>,
) -> (Vec<Vector3<f64>>, Axes) {
    let missing = target.iter().enumerate().map(|(k, target)| target - result.brought(k));
    let mut bent = undone(missing.collect());
    for (more, known) in bent.iter_mut().zip(correction) {
        *more = known + *more;
    }
    if result.axis.is_empty() {
        return (bent, axis.clone());
    }
    // The missing turn as a rotation vector. Its length is the sine of the angle, nearly exact for
    // small angles.
    let missing = result.axis.iter().enumerate().map(|(k, actual)| actual.cross(wanted.at(k)));
    let turns = undone(missing.collect());
    let turned = turns.iter().enumerate().map(|(k, turn)| {
        let axis = axis.at(k);
        (axis + turn.cross(axis)).normalize()
    });
    (bent, Axes::Each(turned.collect()))
}
