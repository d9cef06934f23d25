//! The commanded path of a program, tuned to the program's own timing.
//!
//! The report's correction follows the timing of the desired path. A program holds positions and
//! feeds, and the controller re-times it along the commanded path, which bends and is longer. It
//! reaches each place a little earlier or later, and a shaper or a force that follows the feed
//! turns that into an error. Each pass simulates the program as it would be written and adds the
//! missing correction, as [`compensate`](crate::compensation::compensate) does, at the instants of
//! the report's run that its samples correspond to. Only the sources that the job compensates act
//! in it, so that a file corrects these and no other; the figure stated is that of the file with
//! every source acting.

use crate::compensation;
use crate::deviation::Sources;
use crate::error::Error;
use crate::export::command::{Command, ProgramRun};
use crate::export::commanded_path::CommandedPath;
use crate::export::style::{Junctions, PostStyle};
use crate::motion::Trajectory;
use crate::motion::trajectory::MotionLimits;
use crate::path::Program;
use crate::report::Report;
use crate::setup::program::Blending;
use crate::verification::as_run::as_run;
use crate::verification::replay::{self, Replay};
use nalgebra::Vector3;

/// A pass that leaves more than this share of the error does not count as an improvement.
const IMPROVEMENT: f64 = 0.99;
/// Time constant of the smoothing [s]. Where the force follows the feed, a bend in the commanded
/// path changes the speed along the desired one, hence the force and the next bend. Anything
/// shorter than this would feed back on itself. Found by trial on lines, arcs and circles: with
/// half of it the error grows, with twice of it hardly anything is corrected.
const SMOOTHING: f64 = 0.01;

/// Blending distances that are tried, the least first [m].
const DISTANCES: [f64; 4] = [0.1e-3, 0.3e-3, 1e-3, 3e-3];
/// Shares of the speed that are tried, the least first.
const SHARES: [f64; 4] = [0.05, 0.2, 0.5, 1.0];
/// A longer blending may not add more than this share of the error where the tolerance is not met
/// anyway.
const WORSE: f64 = 1.02;

/// A rehearsed program: the commanded path, and the moves written for it.
#[derive(Debug, Clone)]
pub struct Rehearsal {
    /// The commanded path at each of the report's samples.
    pub commanded_path: CommandedPath,
    /// The moves as written.
    pub command: Command,
    /// How they run with their own timing, every source acting.
    pub run: ProgramRun,
}

/// An attempt at a program: its path, its moves, and its outcome under the sources to compensate.
type Attempt = (CommandedPath, Command, Replay);

/// Rehearses a report's path as a program. The report's own commanded path is kept if it meets the
/// job's tolerance as a program, under the sources to compensate, or if nothing was compensated.
/// Otherwise the result is the best of as many passes as the job allows.
///
/// A robot's moves are blended as the job says, or as far before their ends as the tolerance allows.
///
/// # Errors
/// See [`Command::new`] and [`replay::run_under`].
pub fn rehearse(report: &Report, thinning: Option<f64>, style: PostStyle) -> Result<Rehearsal, Error> {
    match (style.junctions, report.setup().output.blending) {
        (Junctions::AsWritten, _) => blended(report, thinning, style, 0.0),
        (Junctions::Distance, Blending::At(distance)) => blended(report, thinning, style, distance),
        (Junctions::Distance, Blending::Sought) => longest(report, thinning, style, &DISTANCES),
        (Junctions::Share, Blending::At(distance)) => {
            // The share whose ramps take this distance at the job's feed; the whole speed at most.
            let MotionLimits { feed, acceleration, .. } = report.setup().limits;
            let share = (distance * 2.0 * acceleration / (feed * feed)).min(1.0);
            // CNT takes whole numbers, and 0 is a stop.
            let least = if distance > 0.0 { 0.01 } else { 0.0 };
            blended(report, thinning, style, ((share * 100.0).round() / 100.0).max(least))
        }
        (Junctions::Share, Blending::Sought) => longest(report, thinning, style, &SHARES),
    }
}

/// The longest of the blendings `tried` that keeps the tolerance at 95 %, or, where none does, that
/// adds next to nothing to the error.
fn longest(
    report: &Report,
    thinning: Option<f64>,
    style: PostStyle,
    tried: &[f64],
) -> Result<Rehearsal, Error> {
    let mut best = blended(report, thinning, style, tried[0])?;
    let (tolerance, next_to_nothing) = (report.setup().goal.tolerance, best.run.worst() * WORSE);
    let within = |run: &ProgramRun| report.p95_at(run.worst()) <= tolerance || run.worst() <= next_to_nothing;
    for &blend in &tried[1..] {
        let command = Command { blend, ..best.command.clone() };
        let next = run(report, best.commanded_path.clone(), command)?;
        if !within(&next.run) || next.run.duration > best.run.duration {
            break;
        }
        best = next;
    }
    Ok(best)
}

/// The program blended by `blend`, with the best of as many passes as the job allows.
fn blended(report: &Report, thinning: Option<f64>, style: PostStyle, blend: f64) -> Result<Rehearsal, Error> {
    let sought = report.plan.sought();
    let attempt = |commanded_path: CommandedPath| {
        let command = Command { blend, ..Command::new(report, &commanded_path, thinning, style)? };
        let outcome = replay::run_under(report, &commanded_path, &as_it_runs(report, &command), sought)?;
        Ok::<Attempt, Error>((commanded_path, command, outcome))
    };
    let mut best = attempt(CommandedPath::of(report))?;
    let goal = report.setup().goal;
    // What a measured pass has taught is no error that the model should take back.
    let corrects = report.compensation.passes > 0 && report.taught.is_none();
    let passes = if corrects { goal.max_passes } else { 0 };
    for _ in 0..passes {
        let (commanded_path, _, outcome) = &best;
        let least = outcome.judged();
        if least <= goal.tolerance {
            break;
        }
        // A pass that bends the path too far to be reached or written is no improvement either.
        let Ok(next) = attempt(corrected(report, commanded_path, outcome)) else { break };
        if next.2.judged() >= least * IMPROVEMENT {
            break;
        }
        best = next;
    }
    let (commanded_path, command, outcome) = best;
    match sought {
        Sources::ALL => Ok(rehearsed(report, commanded_path, command, &outcome)),
        _ => run(report, commanded_path, command),
    }
}

/// The program as its controller runs it.
fn as_it_runs(report: &Report, command: &Command) -> Program {
    if command.style.is_robot() { as_run(command, &report.setup().limits) } else { command.program() }
}

/// A command, run with every source acting.
fn run(report: &Report, commanded_path: CommandedPath, command: Command) -> Result<Rehearsal, Error> {
    let outcome = replay::run(report, &commanded_path, &as_it_runs(report, &command))?;
    Ok(rehearsed(report, commanded_path, command, &outcome))
}

/// How a command ran.
fn rehearsed(
    report: &Report,
    commanded_path: CommandedPath,
    command: Command,
    outcome: &Replay,
) -> Rehearsal {
    let Trajectory { moving, sample_time, ref stops, .. } = *outcome.trajectory;
    let duration = (moving - 1) as f64 * sample_time;
    let missed = if command.style.is_robot() { outcome.missed(&report.plan.path) } else { 0.0 };
    let run = ProgramRun { reached: outcome.largest(), missed, duration, stops: stops.len() };
    Rehearsal { commanded_path, command: Command { run: Some(run), ..command }, run }
}

/// The commanded path with the correction that was missing when its program ran.
fn corrected(report: &Report, commanded_path: &CommandedPath, outcome: &Replay) -> CommandedPath {
    let Trajectory { sample_time, moving, .. } = *outcome.trajectory;
    let undone = |missing: Vec<Vector3<f64>>| {
        let shaping = report.plan.sought().shaping;
        let change = if shaping { report.plan.shaper().undo(&missing, sample_time, moving) } else { missing };
        resampled(&smoothed(change, SMOOTHING / sample_time), &outcome.instants, report)
    };
    let known = (commanded_path.correction.as_slice(), &commanded_path.axis);
    let Replay { target, axis, deviation, .. } = outcome;
    let (correction, axis) = compensation::corrected((target, axis), deviation, known, undone);
    CommandedPath { correction, axis }
}

/// Values smoothed by a first-order lag of `lag` samples, forwards and then backwards, so that none
/// is delayed.
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

/// Resamples values from a program's samples to the report's; after the end of the motion they stay
/// constant.
fn resampled(values: &[Vector3<f64>], instants: &[f64], report: &Report) -> Vec<Vector3<f64>> {
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
    let mut resampled: Vec<_> = (0..report.samples()).map(at).collect();
    let moving = report.plan.trajectory.moving;
    let arrived = resampled[moving - 1];
    resampled[moving..].fill(arrived);
    resampled
}
