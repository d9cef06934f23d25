//! Joint ranges: where the commands leave them or come near.

use crate::compensation::Compensation;
use crate::report::span::spans;
use crate::report::{Report, Warning};
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
        let worst = |k: usize| beyond((*low, *high), desired[k][i], compensated[k][i]);
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

impl Report {
    /// How far the command to each joint is beyond its range at a sample [rad], the desired or the
    /// compensated one, whichever is farther; negative within it. `None` if no ranges are known. A
    /// sample past the end stands for the last one.
    pub fn joint_excess(&self, sample: usize) -> Option<[f64; 6]> {
        let limits = self.plan.robot.limits()?;
        let k = sample.min(self.samples() - 1);
        let (desired, compensated) = (&self.q[k], &self.compensation.q[k]);
        Some(std::array::from_fn(|i| beyond(limits[i], desired[i], compensated[i])))
    }
}

/// How far the farther of two joint values is beyond a range.
fn beyond((low, high): (f64, f64), a: f64, b: f64) -> f64 {
    (low - a.min(b)).max(a.max(b) - high)
}
