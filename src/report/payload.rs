//! Whether the arm may carry the force of the cut.

use crate::report::span::spans;
use crate::report::{Report, Warning};

/// Standard acceleration of gravity [m/s²] (3rd CGPM, 1901).
const GRAVITY: f64 = 9.80665;

/// A mean cutting force above the weight that the arm is rated to carry; none for an arm without a
/// known rated load.
///
/// This assumes that drives and brakes hold at the flange what the rated mass weighs, and no more.
/// The tool's own weight, which takes a part of that, is not counted. The rated load includes a
/// reserve for accelerating the mass, which a slow cut leaves free, so the limit is on the safe
/// side for all but a heavy spindle.
pub(super) fn warning(report: &Report) -> Option<Warning> {
    let payload = report.setup().payload?;
    let rated = payload * GRAVITY;
    let force = |k: usize| report.planned_force[k].norm();
    let spans = spans(report.samples(), |k| force(k) > rated);
    let worst = (0..report.samples()).max_by(|&a, &b| force(a).total_cmp(&force(b)))?;
    let dt = report.plan.trajectory.sample_time;
    let message = format!(
        "the cut pushes with {:.0} N on average, more than the {rated:.0} N that the arm is rated to carry \
         ({payload} kg): take a lighter cut (less depth or width, a smaller feed per tooth) or a larger arm",
        force(worst)
    );
    Warning::new("force-payload", message).within(&spans, dt)
}
