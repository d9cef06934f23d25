//! The commanded_path of a program, tuned to the program's own timing.
//!
//! The report's correction belongs to the clock of the desired path. A program tells positions and feeds; what runs it plans the
//! motion anew along the commanded path, which bends and is longer, so it comes a little earlier or later to each place, and a shaper or a force
//! that follows the feed makes an error of that. Each pass runs the program as it would be written and adds what is missing, as
//! [`compensate`](crate::compensation::compensate) does, filed under the instants that its samples stand for.

use crate::compensation;
use crate::cutting::along::ChipLoad;
use crate::error::Error;
use crate::export::command::Command;
use crate::export::commanded_path::CommandedPath;
use crate::export::style::PostStyle;
use crate::motion::Trajectory;
use crate::report::Report;
use crate::verification::replay::{self, Replay};
use nalgebra::Vector3;

/// A pass that leaves more than this share of the error is no improvement.
const IMPROVEMENT: f64 = 0.99;
/// Where the force follows the feed, a bend of the commanded path changes the speed along the desired one, so the force and the next bend: what is
/// shorter than this [s] would feed on itself and is smoothed out. Tried on lines, arcs and circles: half of it grows, twice of it hardly corrects.
const SMOOTHING: f64 = 0.01;

/// A program that was tried: where it sends the tool, and what is written for it.
#[derive(Debug, Clone)]
pub struct Rehearsal {
    /// Where the tool is sent at each of the report's samples.
    pub commanded_path: CommandedPath,
    /// The moves as written.
    pub command: Command,
    /// Largest contour error that comes out of them, run with their own timing [m].
    pub reached: f64,
}

/// The commanded_path and what is written for it, with the largest contour error it reaches: the report's own, if that keeps the job's tolerance as a
/// program or nothing was compensated; else the best of as many passes as the job allows.
///
/// # Errors
/// See [`Command::new`] and [`replay::run`].
pub fn rehearse(report: &Report, thinning: Option<f64>, style: PostStyle) -> Result<Rehearsal, Error> {
    let attempt = |commanded_path: CommandedPath| {
        let mut command = Command::new(report, &commanded_path, thinning, style)?;
        let outcome = replay::run(report, &commanded_path, &command.program())?;
        let reached = outcome.largest();
        command.reached = Some(reached);
        Ok::<_, Error>((Rehearsal { commanded_path, command, reached }, outcome))
    };
    let mut best = attempt(CommandedPath::of(report))?;
    let goal = report.setup().goal;
    let passes = if report.compensation.passes > 0 { goal.max_passes } else { 0 };
    for _ in 0..passes {
        let (Rehearsal { commanded_path, reached: least, .. }, outcome) = &best;
        if *least <= goal.tolerance {
            break;
        }
        // A pass that bends the path too far to be reached or written is no improvement either.
        let Ok(next) = attempt(corrected(report, commanded_path, outcome)) else { break };
        if next.0.reached >= least * IMPROVEMENT {
            break;
        }
        best = next;
    }
    Ok(best.0)
}

/// The commanded_path with what was missing when its program was run.
fn corrected(report: &Report, commanded_path: &CommandedPath, outcome: &Replay) -> CommandedPath {
    let Trajectory { sample_time, moving, .. } = *outcome.trajectory;
    let undone = |missing: Vec<Vector3<f64>>| {
        let change = report.plan.shaper().undo(&missing, sample_time, moving);
        let change = match report.setup().chip {
            ChipLoad::Fixed(_) => change,
            ChipLoad::FromFeed { .. } => smoothed(change, SMOOTHING / sample_time),
        };
        filed(&change, &outcome.instants, report)
    };
    let known = (commanded_path.correction.as_slice(), &commanded_path.axis);
    let Replay { target, axis, deviation, .. } = outcome;
    let path = &report.plan.path;
    let (correction, axis) = compensation::corrected(path, (target, axis), deviation, known, undone);
    CommandedPath { correction, axis }
}

/// Values that follow the given ones with a lag of so many samples, forwards and then backwards, so that none is late.
fn smoothed(mut values: Vec<Vector3<f64>>, lag: f64) -> Vec<Vector3<f64>> {
    let share = 1.0 / (1.0 + lag);
    for k in 1..values.len() {
        values[k] = values[k - 1].lerp(&values[k], share);
    }
    for k in (1..values.len()).rev() {
        values[k - 1] = values[k].lerp(&values[k - 1], share);
    }
    values
}

/// Values at a program's samples as values at the report's; from the end of its motion on they rest.
fn filed(values: &[Vector3<f64>], instants: &[f64], report: &Report) -> Vec<Vector3<f64>> {
    let last = values.len() - 1;
    let mut k = 0;
    let at = |instant: usize| {
        let t = instant as f64;
        while k < last && instants[k + 1] < t {
            k += 1;
        }
        let next = (k + 1).min(last);
        let span = instants[next] - instants[k];
        let part = if span > 0.0 { ((t - instants[k]) / span).clamp(0.0, 1.0) } else { 0.0 };
        values[k].lerp(&values[next], part)
    };
    let mut filed: Vec<_> = (0..report.samples()).map(at).collect();
    let moving = report.plan.trajectory.moving;
    let arrived = filed[moving - 1];
    filed[moving..].fill(arrived);
    filed
}
