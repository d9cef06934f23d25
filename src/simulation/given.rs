//! Warnings about a job as it was given.

use crate::job::Job;
use crate::model::MODEL;
use crate::report::Warning;

/// A job whose figures were computed with an earlier model.
pub(super) fn earlier_model(job: &Job) -> Option<Warning> {
    let model = job.model.filter(|model| *model < MODEL)?;
    let message = format!(
        "the job was computed with an earlier model; figures differ (model {model}, this Armill's is {MODEL})"
    );
    Some(Warning::new("earlier-model", message))
}

/// The keys that a job's text leaves at their defaults.
pub(super) fn defaults(not_given: &[String]) -> Option<Warning> {
    let message = format!("not given, so the default job's value holds: {}", not_given.join(", "));
    (!not_given.is_empty()).then(|| Warning::new("default-used", message))
}
