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

/// What the default job, the thesis's, says for its own robot and cut only: key and value.
const OF_THE_THESIS: [(&str, &str); 3] = [
    ("shaper", "ZVD at 18 rad/s, of a Stäubli RX-90"),
    ("material", "ktc 1800 N/mm²"),
    ("cutting.feed_per_tooth_mm", "0.1 mm"),
];

/// A robot or path of one's own under values that belong to the thesis's. A key counts as not given
/// if its section is not.
pub(super) fn thesis(not_given: &[String]) -> Option<Warning> {
    let missing = |key: &str| {
        let within = |section: &String| key.strip_prefix(section).is_some_and(|rest| rest.starts_with('.'));
        not_given.iter().any(|other| other == key || within(other))
    };
    if missing("robot") && missing("path") {
        return None;
    }
    let left = OF_THE_THESIS.iter().filter(|(key, _)| missing(key));
    let left: Vec<_> = left.map(|(key, value)| format!("{key} ({value})")).collect();
    let message = format!(
        "not given, so the thesis's values are used, which belong to its own robot and cut: {}",
        left.join(", ")
    );
    (!left.is_empty()).then(|| Warning::new("thesis-default", message))
}

/// The keys that a job's text leaves at their defaults.
pub(super) fn defaults(not_given: &[String]) -> Option<Warning> {
    let message = format!("not given, so the default job's values are used: {}", not_given.join(", "));
    (!not_given.is_empty()).then(|| Warning::new("default-used", message))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Progress;
    use crate::setup::Setup;
    use crate::units::N_PER_MM2;
    use serde_json::json;

    #[test]
    fn what_is_said_of_the_thesis_is_what_the_default_job_has() {
        let job = Job::default();
        assert_eq!(json!(job)["shaper"], json!({"kind":"zvd","frequency_rad_s":18.0,"damping":0.1}));
        assert_eq!(json!(job)["cutting"]["feed_per_tooth_mm"], 0.1);
        let setup = Setup::of(&job, &mut Progress::none()).unwrap();
        assert_eq!(setup.robot.name(), "Stäubli RX-90");
        assert_eq!(setup.cut.coefficients.ktc / N_PER_MM2, 1800.0);
    }
}
