//! Where a cut sets in or fades faster than a shaped command can follow, and cuts that are shorter
//! than their run-in.

use crate::report::span::spans;
use crate::report::{Report, Warning, millimetres};
use crate::units::MM;

/// All warnings about where a cut begins and ends.
pub(super) fn warnings(report: &Report) -> Vec<Warning> {
    let share = report.run_in();
    short(report, &share).into_iter().chain(left(report, &share)).collect()
}

/// A path on which no cut reaches the full force.
fn short(report: &Report, share: &[f64]) -> Option<Warning> {
    let most = share.iter().copied().fold(0.0, f64::max);
    if most == 0.0 || most >= 1.0 || report.mean_force().norm() == 0.0 {
        return None;
    }
    let message = format!(
        "no cut is as long as its run-in of {:.1} mm, so the force reaches at most {:.0} %. The run-in assumes a \
         straight front of the part; if the tool starts inside material, the force is larger",
        report.setup().loading.run_in / MM,
        100.0 * most
    );
    Some(Warning::new("run-in-short", message))
}

/// What is left of the error beyond the tolerance where a cut begins and where the path ends.
fn left(report: &Report, share: &[f64]) -> Vec<Warning> {
    let (setup, trajectory) = (report.setup(), &report.plan.trajectory);
    let (duration, dt) = (report.plan.shaper().duration(), trajectory.sample_time);
    if duration == 0.0 || report.compensation.passes == 0 || report.after_max() <= setup.goal.tolerance {
        return Vec::new();
    }
    // The correction for a sample is commanded up to the shaper's duration earlier; what it lacks
    // shows up to two durations later.
    let reach = (duration / dt).ceil() as usize;
    let begins: Vec<usize> = (0..report.samples()).filter(|&k| share[k] > 0.0 && share[k] < 1.0).collect();
    let near = |k: usize| {
        let from = begins.partition_point(|begin| begin + 2 * reach < k);
        begins.get(from).is_some_and(|begin| *begin <= k + reach)
    };
    let begin = |worst: String, at: f64| {
        format!(
            "where a cut begins, an error of {worst} mm is left at {at:.3} s: the force builds up within {:.1} \
             mm, faster than a command that the shaper spreads over {duration:.2} s. An exact inverse of the shaper \
             could, but would undo it and shake the arm, so it is not used; lead in more slowly or with less depth",
            setup.loading.run_in / MM
        )
    };
    let end = |worst: String, at: f64| {
        format!(
            "where the path ends, an error of {worst} mm is left at {at:.3} s: the command stops when it arrives, \
             but the shaped tool keeps moving for {duration:.2} s while the force fades; add a lead-out"
        )
    };
    let arrived = trajectory.moving;
    [
        remark(report, "run-in", |k| k < arrived && near(k), begin),
        remark(report, "run-out", |k| k >= arrived, end),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The warning `code` where an error beyond the tolerance is left at some samples; `text` gets the
/// largest [mm] and its time [s].
fn remark(
    report: &Report,
    code: &'static str,
    at: impl Fn(usize) -> bool,
    text: impl Fn(String, f64) -> String,
) -> Option<Warning> {
    let dt = report.plan.trajectory.sample_time;
    let size = |k: usize| report.after.contour_error[k].norm();
    let tolerance = report.setup().goal.tolerance;
    let beyond = |k: usize| size(k) > tolerance && at(k);
    let spans = spans(report.samples(), beyond);
    let worst = (0..report.samples()).filter(|&k| beyond(k)).max_by(|&a, &b| size(a).total_cmp(&size(b)))?;
    let message = text(millimetres(size(worst)), worst as f64 * dt);
    Warning::new(code, message).within(&spans, dt)
}
