//! The gain from a free roll about the tool axis, compared with a fixed one.

use crate::deviation::Deviation;
use crate::motion::roll::{RollGoal, RollRange};
use crate::plan::Plan;
use crate::report::millimetres;
use crate::robot::Joints;
use crate::units::{DEG, MM};
use serde::Serialize;

/// Joint motion that a roll requires, and the error of the arm before compensation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RollOutcome {
    /// Total travel of all joints [deg].
    pub joint_travel_deg: f64,
    /// Largest speed of a joint [deg/s].
    pub joint_speed_deg_s: f64,
    /// Largest contour error before compensation, every source acting [mm].
    pub error_mm: f64,
}

impl RollOutcome {
    /// The outcome of joint commands `q` and their deviation `before` compensation.
    pub fn of(plan: &Plan, q: &[Joints], before: &Deviation) -> Self {
        let (travel, speed) = effort(q, plan.trajectory.sample_time);
        Self {
            joint_travel_deg: travel / DEG,
            joint_speed_deg_s: speed / DEG,
            error_mm: before.statistics.max / MM,
        }
    }
}

/// The gain of a free roll.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RollGain {
    /// Smallest and largest angle used [deg].
    pub used_deg: [f64; 2],
    /// The fixed angle for comparison [deg].
    pub fixed_deg: f64,
    /// Outcome with the free roll.
    pub free: RollOutcome,
    /// Outcome with the fixed roll; none if the arm cannot reach the whole path with it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fixed: Option<RollOutcome>,
    /// The comparison in words.
    pub sentence: String,
}

impl RollGain {
    pub(crate) fn new(plan: &Plan, range: &RollRange, free: RollOutcome, fixed: Option<RollOutcome>) -> Self {
        let fixed_angle = plan.setup.roll;
        let angles = plan.trajectory.timing.arc_length.iter().map(|&s| plan.path.roll(s) / DEG);
        let (low, high) =
            angles.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), a| (low.min(a), high.max(a)));
        let goal = match range.goal {
            RollGoal::SmoothJoints => "smooth joints",
            RollGoal::LeastError => "least error",
        };
        let mm = |effort: &RollOutcome| millimetres(effort.error_mm * MM);
        let gain = match &fixed {
            None => {
                format!("at a constant {:.1} deg the arm does not reach the whole path", fixed_angle / DEG)
            }
            Some(fixed) => format!(
                "compared with a constant {:.1} deg, the joints travel {:.0} deg instead of {:.0}, \
                 the fastest turns at {:.1} deg/s instead of {:.1}, and \
                 the largest contour error before compensation is {} mm instead of {}",
                fixed_angle / DEG,
                free.joint_travel_deg,
                fixed.joint_travel_deg,
                free.joint_speed_deg_s,
                fixed.joint_speed_deg_s,
                mm(&free),
                mm(fixed)
            ),
        };
        let sentence = format!("Spin chosen for {goal}, from {low:.1} to {high:.1} deg: {gain}.");
        Self { used_deg: [low, high], fixed_deg: fixed_angle / DEG, free, fixed, sentence }
    }
}

/// Total travel of all joints [rad] and largest joint speed [rad/s] over samples `sample_time` [s]
/// apart.
fn effort(q: &[Joints], sample_time: f64) -> (f64, f64) {
    let steps = q.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    steps.fold((0.0, 0.0), |(way, fastest), step| {
        (way + step.sum(), f64::max(fastest, step.amax() / sample_time))
    })
}
