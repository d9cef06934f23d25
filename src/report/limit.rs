//! Joint ranges: where the commands leave them or come near.

use crate::compensation::Compensation;
use crate::report::span::spans;
use crate::report::{Report, Warning};
use crate::robot::Joints;
use crate::units::DEG;

/// Margin to a joint limit below which a warning is given [rad].
pub(crate) const LIMIT_MARGIN: f64 = 2.0 * DEG;

/// All warnings about the joint ranges.
pub(super) fn warnings(report: &Report) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let Report { plan, q: desired, compensation: Compensation { q: compensated, .. }, .. } = report;
    let Some(limits) = plan.robot.limits() else {
        let message = "no joint ranges are given, so they are not checked";
        return vec![Warning::new("joint-limits-unknown", message)];
    };
    let dt = plan.trajectory.sample_time;
    for (i, (low, high)) in limits.iter().enumerate() {
        // Excess over the range, by the desired or by the compensated command.
        let beyond = |q: &Joints| (low - q[i]).max(q[i] - high);
        let worst = |k: usize| beyond(&desired[k]).max(beyond(&compensated[k]));
        let count = desired.len();
        let extreme = (0..count).map(worst).fold(f64::NEG_INFINITY, f64::max);
        let (code, threshold, what) = if extreme > 0.0 {
            ("joint-limit", 0.0, format!("leaves its range by up to {:.1} deg", extreme / DEG))
        } else if extreme > -LIMIT_MARGIN {
            (
                "joint-limit-near",
                -LIMIT_MARGIN,
                format!("comes within {:.1} deg of its limit", -extreme / DEG),
            )
        } else {
            continue;
        };
        let message = format!("joint {} {what} (range {:.1} to {:.1} deg)", i + 1, low / DEG, high / DEG);
        let spans = spans(count, |k| worst(k) > threshold);
        warnings.extend(Warning::new(code, message).within(&spans, dt));
    }
    warnings
}
