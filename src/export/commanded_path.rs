//! The path to command, sample by sample.

use crate::compensation::Compensation;
use crate::path::Axes;
use crate::report::Report;
use nalgebra::Vector3;

/// The commanded path at each of the report's samples: the correction added to the desired
/// positions [m], and the tool axis, base frame.
#[derive(Debug, Clone, PartialEq)]
pub struct CommandedPath {
    /// Correction of the desired position [m].
    pub correction: Vec<Vector3<f64>>,
    /// Tool axis from tip to spindle.
    pub axis: Axes,
}

impl CommandedPath {
    /// The commanded path that the report found.
    pub fn of(report: &Report) -> Self {
        let Compensation { correction, axis, .. } = &report.compensation;
        Self { correction: correction.clone(), axis: axis.clone() }
    }

    /// Its positions, base frame [m].
    pub fn positions(&self, report: &Report) -> Vec<Vector3<f64>> {
        report.plan.trajectory.position.iter().zip(&self.correction).map(|(p, c)| p + c).collect()
    }
}
