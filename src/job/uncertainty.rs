//! The job's section `uncertainty`: how well the inputs are known.

use crate::job::choice::{Choice, SpreadPercent};
use crate::job::json::keys;
use serde::Serialize;

/// How far from their numbers the true values may be. What is not given follows from what the
/// library says of robot and material.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Uncertainty {
    /// 95 % range of each joint's stiffness, to each side.
    pub stiffness_percent: SpreadPercent,
    /// Instead: 95 % range from 1 / this to this times the stiffness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_factor: Option<f64>,
    /// Instead: covariance of the six joint compliances [(rad/(N m))^2], from an identification.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compliance_covariance: Option<[[f64; 6]; 6]>,
    /// 95 % range of the cutting coefficients, to each side.
    pub cutting_percent: SpreadPercent,
    /// 95 % range of the frequency of the filter that runs in the controller, to each side.
    pub frequency_percent: f64,
    /// Number of draws.
    pub draws: u32,
    /// Seed of the draws.
    pub seed: u32,
}

impl Default for Uncertainty {
    fn default() -> Self {
        Self {
            stiffness_percent: Choice::Word,
            stiffness_factor: None,
            compliance_covariance: None,
            cutting_percent: Choice::Word,
            frequency_percent: 0.0,
            draws: 1000,
            seed: 1,
        }
    }
}

keys!(Uncertainty {
    stiffness_percent,
    stiffness_factor,
    compliance_covariance,
    cutting_percent,
    frequency_percent,
    draws,
    seed
});
