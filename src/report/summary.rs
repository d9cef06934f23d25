//! The figures of a report that a person reads first, as one small object.

use crate::deviation::{Deviation, contour};
use crate::report::{Report, Warning};
use crate::units::MM;
use nalgebra::Vector3;
use serde::Serialize;

/// Mean and largest contour error [mm] over all samples.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Statistics {
    /// Mean [mm].
    pub mean: f64,
    /// Largest [mm].
    pub max: f64,
}

impl Statistics {
    /// Of contour errors [m].
    pub fn of(errors: &[Vector3<f64>]) -> Self {
        let (mean, max) = contour::mean_and_max(errors);
        Self { mean: mean / MM, max: max / MM }
    }
}

/// Contour error before compensation, each source alone and both together.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Before {
    /// Only cutting forces act.
    pub deflection: Statistics,
    /// Only the shaper acts.
    pub shaping: Statistics,
    /// Both act.
    pub both: Statistics,
}

/// The summary, as scripts and the page get it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Hash over the bits of all columns.
    pub fingerprint: String,
    /// Number of samples.
    pub samples: usize,
    /// Time from the first to the last sample [s].
    pub duration_s: f64,
    /// Length of the desired path [mm].
    pub path_length_mm: f64,
    /// Mean milling force in {T} at full feed [N].
    pub mean_force_n: [f64; 3],
    /// Contour error before compensation [mm].
    pub before_mm: Before,
    /// Contour error after compensation, every source acting [mm].
    pub after_mm: Statistics,
    /// Number of the pass whose path is commanded.
    pub passes: usize,
    /// Whether the loop reached the tolerance for the sources it compensates.
    pub converged: bool,
    /// The tolerance [mm].
    pub tolerance_mm: f64,
    /// Largest contour error before the first pass and after each [mm].
    pub history_max_mm: Vec<f64>,
    /// Mean contour error before the first pass and after each [mm].
    pub history_mean_mm: Vec<f64>,
    /// The verdict in words.
    pub verdict: String,
    /// Name of the robot.
    pub robot: String,
    /// The arm's branch at the start, in words.
    pub branch: String,
    /// What is odd but workable.
    pub warnings: Vec<Warning>,
}

impl Report {
    /// Mean milling force in {T} [N], at the feed per tooth of the job (of the full feed, if the chip follows it).
    pub fn mean_force(&self) -> Vector3<f64> {
        self.plan.mean_force.at(self.plan.chip.at(self.setup.tempo.feed, None))
    }

    /// The figures a person reads first.
    pub fn summary(&self) -> Summary {
        let statistics = |deviation: &Deviation| Statistics::of(&deviation.contour_error);
        let mm = |values: &[f64]| values.iter().map(|v| v / MM).collect();
        let start = self.joints.start;
        let branch = format!(
            "{}, elbow {}, q4 = {:.1} deg",
            if start.front { "arm facing the point" } else { "arm over its back" },
            if start.elbow_positive { "positive" } else { "negative" },
            self.joints.q.first().map_or(0.0, |q| q[3] / crate::units::DEG)
        );
        Summary {
            fingerprint: self.fingerprint(),
            samples: self.samples(),
            duration_s: self.duration(),
            path_length_mm: self.plan.path.length() / MM,
            mean_force_n: self.mean_force().into(),
            before_mm: Before {
                deflection: statistics(&self.deflection_only),
                shaping: statistics(&self.shaping_only),
                both: statistics(&self.before),
            },
            after_mm: statistics(&self.after),
            passes: self.compensation.passes,
            converged: self.compensation.converged,
            tolerance_mm: self.setup.goal.tolerance / MM,
            history_max_mm: mm(&self.compensation.history_max),
            history_mean_mm: mm(&self.compensation.history_mean),
            verdict: self.verdict(),
            robot: self.plan.robot.name().to_owned(),
            branch,
            warnings: self.warnings.clone(),
        }
    }
}
