//! What one run of a study says.

use crate::error::Error;
use crate::job::Job;
use crate::progress::Progress;
use crate::report::{Report, VerdictState};
use crate::units::MM;
use serde::Serialize;

/// What one run of a study says: figures, or why there are none.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Outcome {
    /// Largest contour error before compensation [mm].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub before_max_mm: Option<f64>,
    /// Largest contour error after it, if every number is exact [mm].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub after_max_mm: Option<f64>,
    /// What half of the plants leave at most, after compensation [mm].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub p50_mm: Option<f64>,
    /// What 95 % of the plants leave at most, after compensation [mm].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub p95_mm: Option<f64>,
    /// The verdict's state.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verdict_state: Option<VerdictState>,
    /// Why the arm cannot run it, if it cannot.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cannot_run: Option<String>,
    /// Why there is no result, if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
}

impl Outcome {
    /// The outcome of a job.
    pub fn of(job: &Job) -> Self {
        Self::of_result(crate::simulation::judged(job, &mut Progress::none()))
    }

    /// The outcome of a job that may have been refused.
    pub(super) fn of_varied(job: Result<Job, Error>) -> Self {
        Self::of_result(job.and_then(|job| crate::simulation::judged(&job, &mut Progress::none())))
    }

    fn of_result(result: Result<Report, Error>) -> Self {
        result.map_or_else(|error| Self::of_error(&error), |report| Self::of_report(&report))
    }

    pub(super) fn of_report(report: &Report) -> Self {
        Self {
            before_max_mm: Some(report.before.statistics.max / MM),
            after_max_mm: Some(report.after_max() / MM),
            p50_mm: Some(report.band.after.p50 / MM),
            p95_mm: Some(report.band.after.p95 / MM),
            verdict_state: Some(report.verdict_state()),
            cannot_run: report.impossible().map(|warning| warning.message.clone()),
            error: None,
        }
    }

    pub(super) fn of_error(error: &Error) -> Self {
        Self { error: Some(error.to_string()), ..Self::default() }
    }
}
