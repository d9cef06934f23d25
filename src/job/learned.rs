//! The job's section `learned`: what a measured pass taught of arm and cut.

use crate::job::json::keys;
use serde::Serialize;

/// Factors on what the rest of the job says, with what is still unknown of them. Written by Armill, for no person to type.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Learned {
    /// On the compliance of each joint.
    pub compliance_factors: [f64; 6],
    /// On the tangential, radial and axial part of the cutting force.
    pub force_factors: [f64; 3],
    /// Covariance of the logarithms of what is still unknown: six compliances, the cutting force, and its radial and axial
    /// ratio.
    pub covariance: [[f64; 9]; 9],
    /// From which log.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
}

impl Default for Learned {
    fn default() -> Self {
        Self {
            compliance_factors: [1.0; 6],
            force_factors: [1.0; 3],
            covariance: [[0.0; 9]; 9],
            source: None,
        }
    }
}

keys!(new Learned {
    compliance_factors, force_factors, covariance, source
} required compliance_factors, force_factors, covariance);
