//! Singularities: where the arm comes near one, and where a joint turns far within a sample.

use crate::math;
use crate::plan::Plan;
use crate::report::span::spans;
use crate::report::warning::angle_of_sine;
use crate::report::{Severity, Warning};
use crate::robot::Joints;
use crate::robot::inverse::Margin;
use crate::units::{DEG, MM};

/// Distance of the wrist centre from the shoulder singularity below which a warning is given [m].
pub(crate) const SHOULDER_MARGIN: f64 = 10.0 * MM;
/// Angle from the elbow or wrist singularity below which a warning is given [rad].
pub(crate) const ANGLE_MARGIN: f64 = 5.0 * DEG;
/// Turn of a joint from one sample to the next above which a warning is given [rad].
pub(crate) const JUMP: f64 = 5.0 * DEG;
/// Speed of a joint that no arm reaches [rad/s]: the library's fastest joint turns at 885 deg/s.
const FASTEST: f64 = 1000.0 * DEG;
/// Distance of the wrist centre from the shoulder singularity below which no controller passes it
/// [m].
const SHOULDER_LEAST: f64 = MM;
/// Angle from the elbow or wrist singularity below which no controller passes it [rad].
const ANGLE_LEAST: f64 = 0.1 * DEG;

/// Whether a margin is one that a warning is given for.
pub(crate) fn is_near(margin: &Margin) -> bool {
    let angle = math::sin(ANGLE_MARGIN);
    margin.shoulder < SHOULDER_MARGIN || margin.elbow < angle || margin.wrist < angle
}

/// Where the joint commands `q` pass singularities or jump.
pub(crate) fn singularities(plan: &Plan, q: &[Joints], margins: &[Margin]) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let dt = plan.trajectory.sample_time;
    let mut remark =
        |code, margin: fn(&Margin) -> f64, (near, least): (f64, f64), message: fn(f64) -> String| {
            let spans = spans(margins.len(), |k| margin(&margins[k]) < near);
            let nearest = margins.iter().map(margin).fold(f64::INFINITY, f64::min);
            let severity = if nearest < least { Severity::CannotRun } else { Severity::Matters };
            let warning = Warning { severity, ..Warning::new(code, message(nearest)) };
            warnings.extend(warning.within(&spans, dt));
        };
    let angles = (math::sin(ANGLE_MARGIN), math::sin(ANGLE_LEAST));
    remark(
        "singularity-shoulder",
        |margin| margin.shoulder,
        (SHOULDER_MARGIN, SHOULDER_LEAST),
        |least| {
            format!(
                "the wrist centre comes within {:.1} mm of axis 1, where turning joint 1 does not move it (shoulder singularity)",
                least / MM
            )
        },
    );
    remark(
        "singularity-elbow",
        |margin| margin.elbow,
        angles,
        |least| {
            format!(
                "the arm is stretched or folded to within {:.1} deg (elbow singularity)",
                angle_of_sine(least) / DEG
            )
        },
    );
    remark(
        "singularity-wrist",
        |margin| margin.wrist,
        angles,
        |least| {
            format!(
                "axes 4 and 6 come within {:.1} deg of each other (wrist singularity): \
                 there, small changes of the tool axis turn joints 4 and 6 a long way",
                angle_of_sine(least) / DEG
            )
        },
    );
    let turn = |k: usize| if k > 0 { (q[k] - q[k - 1]).amax() } else { 0.0 };
    let jumps = |k: usize| turn(k) > JUMP;
    let message = format!(
        "a joint turns more than {:.0} deg from one sample to the next: the arm passes a singularity, the tool axis \
         passes close to the direction of spin.reference, or the samples are far apart",
        JUMP / DEG
    );
    // With samples far apart, a joint may turn that far at a speed that it has.
    let runs = (0..q.len()).all(|k| turn(k) <= FASTEST * dt);
    let severity = if runs { Severity::Matters } else { Severity::CannotRun };
    let warning = Warning { severity, ..Warning::new("joint-jump", message) };
    warnings.extend(warning.within(&spans(q.len(), jumps), dt));
    warnings
}
