//! Where a cut sets in faster than a shaped command can follow.

use crate::report::{Report, Warning, millimetres};
use crate::units::MM;

/// What is left of the error where a cut begins, if that is beyond the tolerance.
pub(super) fn warning(report: &Report) -> Option<Warning> {
    let (setup, trajectory) = (report.setup(), &report.plan.trajectory);
    let (duration, dt) = (report.plan.shaper().duration(), trajectory.sample_time);
    if duration == 0.0 || report.compensation.passes == 0 || report.after_max() <= setup.goal.tolerance {
        return None;
    }
    // The correction for a sample is commanded up to the shaper's duration earlier; what it lacks
    // shows up to two durations later.
    let reach = (duration / dt).ceil() as usize;
    let share = report.run_in();
    let begins: Vec<usize> = (0..report.samples()).filter(|&k| share[k] > 0.0 && share[k] < 1.0).collect();
    let errors = &report.after.contour_error;
    let left = |k: &usize| errors[*k].norm();
    let near = |k: &usize| {
        let from = begins.partition_point(|begin| begin + 2 * reach < *k);
        begins.get(from).is_some_and(|begin| *begin <= k + reach)
    };
    let beyond: Vec<usize> =
        (0..report.samples()).filter(|k| left(k) > setup.goal.tolerance && near(k)).collect();
    let worst = beyond.iter().max_by(|a, b| left(a).total_cmp(&left(b)))?;
    let message = format!(
        "where a cut begins, an error of {} mm is left at {:.3} s: the force sets in within {:.1} mm, faster than a \
         command can follow that the shaper spreads over {duration:.2} s. An exact inverse of the shaper could, \
         but would undo it and shake the arm, so it is not used; lead in more slowly or with less depth",
        millimetres(left(worst)),
        *worst as f64 * dt,
        setup.loading.run_in / MM,
    );
    let range = (*beyond.first()?, *beyond.last()?);
    Some(Warning::new("run-in", message).within(range, dt))
}
