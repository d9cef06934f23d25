//! What a free spin brings, compared with the fixed one.

use crate::deviation::{Deviation, Plan, contour};
use crate::motion::spin::{Freedom, Goal, effort};
use crate::report::millimetres;
use crate::robot::Joints;
use crate::units::{DEG, MM};
use serde::Serialize;

/// What a spin asks of the joints, and what the arm makes of it before compensation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Effort {
    /// Way of all joints together [deg].
    pub joint_travel_deg: f64,
    /// Largest speed of a joint [deg/s].
    pub joint_speed_deg_s: f64,
    /// Largest contour error before compensation, every source acting [mm].
    pub error_mm: f64,
}

impl Effort {
    /// Of joint commands and what becomes of them.
    pub fn of(plan: &Plan, q: &[Joints], before: &Deviation) -> Self {
        let (travel, speed) = effort(q, plan.trajectory.sample_time);
        let (_, error) = contour::mean_and_max(&before.contour_error);
        Self { joint_travel_deg: travel / DEG, joint_speed_deg_s: speed / DEG, error_mm: error / MM }
    }
}

/// The gain of a free spin.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpinGain {
    /// Smallest and largest angle that is used [deg].
    pub used_deg: [f64; 2],
    /// The fixed angle that it is compared with [deg].
    pub fixed_deg: f64,
    /// With the free spin.
    pub free: Effort,
    /// With the fixed one; none if the arm does not reach all of the path with it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fixed: Option<Effort>,
    /// The same in words.
    pub sentence: String,
}

impl SpinGain {
    pub(crate) fn new(
        plan: &Plan,
        freedom: &Freedom,
        fixed_angle: f64,
        free: Effort,
        fixed: Option<Effort>,
    ) -> Self {
        let angles = plan.trajectory.pace.arc_length.iter().map(|&s| plan.path.spin(s) / DEG);
        let (low, high) =
            angles.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), a| (low.min(a), high.max(a)));
        let goal = match freedom.goal {
            Goal::SmoothJoints => "smooth joints",
            Goal::LeastError => "least error",
        };
        let mm = |effort: &Effort| millimetres(effort.error_mm * MM);
        let gain = match &fixed {
            None => {
                format!("with {:.1} deg all along the arm does not reach the whole path", fixed_angle / DEG)
            }
            Some(fixed) => format!(
                "against {:.1} deg all along, the joints travel {:.0} deg instead of {:.0}, the fastest turns at {:.1} deg/s instead of {:.1}, and the largest contour error before compensation is {} mm instead of {}",
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
