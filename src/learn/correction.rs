//! What passes have taught of the command, to be kept beside the job.

use crate::error::Error;
use crate::learn::Commanded;
use crate::learn::alignment::Sampled;
use crate::report::Report;
use crate::units::MM;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Most rows that are kept: a longer run keeps every second sample, or every third.
const ROWS: usize = 20_000;

/// A correction along the path, on top of the program that ran.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LearnedCorrection {
    /// Whether that program was corrected by the model, or the desired path.
    pub corrected: bool,
    /// Arc length of the command [mm], and the correction along the workpiece's x, y and z [mm].
    pub s_dx_dy_dz_mm: Vec<[f64; 4]>,
}

impl LearnedCorrection {
    /// What was learned, with the samples of a run.
    pub fn of(report: &Report, commanded: &Commanded) -> Self {
        let into = report.setup().workpiece.inverse();
        let arc_length = &report.plan.trajectory.timing.arc_length;
        let step = commanded.learned.len().div_ceil(ROWS).max(1);
        let row = |k: usize| {
            let v = into.direction(&commanded.learned[k]) / MM;
            [arc_length[k] / MM, v.x, v.y, v.z]
        };
        let s_dx_dy_dz_mm = (0..commanded.learned.len()).step_by(step).map(row).collect();
        Self { corrected: commanded.corrected, s_dx_dy_dz_mm }
    }

    /// From JSON.
    ///
    /// # Errors
    /// [`Error::Json`] with line and column, [`Error::Invalid`] if arc lengths fall or numbers are missing.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        let read: Self = serde_json::from_str(text).map_err(|error| Error::Json {
            field: None,
            message: error.to_string(),
            line: error.line(),
            column: error.column(),
        })?;
        let rows = &read.s_dx_dy_dz_mm;
        if let Some(row) = rows.windows(2).position(|pair| pair[1][0] < pair[0][0]) {
            let field = format!("s_dx_dy_dz_mm[{}]", row + 1);
            return Err(Error::invalid(field, rows[row + 1][0], "arc lengths that do not fall"));
        }
        Ok(read)
    }

    /// The commands with it, at the samples of a run.
    pub fn commanded(&self, report: &Report) -> Commanded {
        let frame = report.setup().workpiece;
        let (at, values): (Vec<f64>, Vec<Vector3<f64>>) = self
            .s_dx_dy_dz_mm
            .iter()
            .map(|[s, x, y, z]| (s * MM, frame.direction(&(Vector3::new(*x, *y, *z) * MM))))
            .unzip();
        let known = Sampled { at: &at, values: &values };
        let ends = values.first().zip(values.last());
        let value = |s: &f64| {
            let beyond = || ends.map(|(first, last)| if *s < at[0] { *first } else { *last });
            known.value(*s).or_else(beyond).unwrap_or_default()
        };
        let learned = report.plan.trajectory.timing.arc_length.iter().map(value).collect();
        Commanded { corrected: self.corrected, learned }
    }
}
