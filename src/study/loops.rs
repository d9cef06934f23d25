//! A job with every sensor and every controller that is known.

use crate::error::Error;
use crate::job::Job;
use crate::online::compared::EVEN_PLANTS;
use crate::online::{Measures, OnlineLoop, OnlineSummary, PRESETS, Sensor};
use crate::progress::Progress;
use crate::report::Report;
use serde::Serialize;

/// What may be measured, the tip first.
const MEASURED: [Measures; 3] = [Measures::Position, Measures::LoadSideAngle, Measures::Force];

/// What one of them would bring.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoopRow {
    /// What is measured.
    pub measures: Measures,
    /// Id of the controller.
    pub preset: &'static str,
    /// Its name.
    pub name: &'static str,
    /// Why the arm cannot run the job, if it cannot.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cannot_run: Option<String>,
    /// What it would bring, by an ideal sensor.
    #[serde(flatten)]
    pub outcome: OnlineSummary,
}

/// A job to be run with every loop.
#[derive(Debug)]
pub struct EveryLoop {
    report: Report,
}

impl EveryLoop {
    /// For a job.
    ///
    /// # Errors
    /// If it cannot be computed.
    pub fn new(job: &Job) -> Result<Self, Error> {
        Ok(Self { report: crate::simulation::judged(job, &mut Progress::none())? })
    }

    /// Number of loops.
    pub fn count(&self) -> usize {
        MEASURED.len() * PRESETS.len()
    }

    /// One of them.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the run has too many cycles.
    pub fn row(&self, index: usize) -> Result<LoopRow, Error> {
        let (measures, preset) = (MEASURED[index / PRESETS.len()], PRESETS[index % PRESETS.len()]);
        let online = OnlineLoop {
            measures,
            times: preset.times,
            sensor: Sensor::IDEAL,
            gain: None,
            plants: EVEN_PLANTS,
        };
        Ok(LoopRow {
            measures,
            preset: preset.id,
            name: preset.name,
            cannot_run: self.report.impossible().map(|warning| warning.message.clone()),
            outcome: self.report.looped().with(&online)?.summary(),
        })
    }
}
