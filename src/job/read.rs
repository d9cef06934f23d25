//! Reads a [`Job`] from JSON text and writes it back.

use crate::error::Error;
use crate::job::Job;
use crate::job::json::{Node, Read};
use serde_json::Value;

impl Job {
    /// Reads a job. Absent keys take the default job's value.
    ///
    /// # Errors
    /// [`Error::Json`] or [`Error::UnknownKey`], with line and column. Values are not checked here:
    /// see [`Setup::of`](crate::setup::Setup::of).
    pub fn from_json(text: &str) -> Result<Self, Error> {
        Job::read_json(text).map(|(job, _)| job)
    }

    /// Reads a job and lists the keys left to the default, as JSON paths: whole sections, or keys
    /// within a given section.
    ///
    /// # Errors
    /// See [`Job::from_json`].
    pub fn read_json(text: &str) -> Result<(Self, Vec<String>), Error> {
        let node = Node::of(text)?;
        let mut job = Job::default();
        job.read(&node)?;
        Ok((job, not_given(&node)?))
    }

    /// The job as indented JSON text.
    pub fn to_json(&self) -> String {
        // A job is plain data: serde_json cannot fail on it.
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}

/// The keys of the default job that are absent from a text.
fn not_given(given: &Node) -> Result<Vec<String>, Error> {
    let mut missing = Vec::new();
    let Ok(Value::Object(default)) = serde_json::to_value(Job::default()) else { return Ok(missing) };
    for (section, content) in default {
        match (given.get(&section)?, content) {
            (None, _) => missing.push(section),
            // These sections are all or nothing; a missing key is an error, not a default.
            (Some(_), _) if ["robot", "path", "material", "shaper"].contains(&section.as_str()) => {}
            (Some(given), Value::Object(content)) => {
                for key in content.keys() {
                    if given.get(key)?.is_none() {
                        missing.push(format!("{section}.{key}"));
                    }
                }
            }
            _ => {}
        }
    }
    Ok(missing)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_job_survives_its_own_json() {
        let job = Job::default();
        assert_eq!(Job::from_json(&job.to_json()), Ok(job));
        assert_eq!(Job::from_json("{}"), Ok(Job::default()));
    }

    #[test]
    fn mistakes_in_the_text_are_placed() {
        let at = |text: &str| {
            let error = Job::from_json(text).unwrap_err();
            (error.code(), error.field().map(str::to_owned), error.place().unwrap())
        };
        assert_eq!(at("{\"motion\":\n {\"feed\": 3}}"), ("unknown-key", Some("motion.feed".into()), (2, 3)));
        assert_eq!(at("{\"motoin\": {}}"), ("unknown-key", Some("motoin".into()), (1, 2)));
        // Written with escapes, a key is longer than what it means.
        assert_eq!(at("{\"m\\u006ftoin\": 1}"), ("unknown-key", Some("motoin".into()), (1, 2)));
        assert_eq!(at("{\"tool\": {\"a\\\"b\": 1}}"), ("unknown-key", Some("tool.a\"b".into()), (1, 11)));
        assert_eq!(
            at("{\"motion\": {\"feed_mm_s\": \"fast\"}}"),
            ("json", Some("motion.feed_mm_s".into()), (1, 31))
        );
        assert_eq!(
            at("{\"tool\": {\n \"flutes\": 4, \"flutes\": 5}}"),
            ("json", Some("tool".into()), (2, 24))
        );
        assert_eq!(
            at("{\"path\": {\"kind\": \"line\", \"from_mm\": [1,2]}}"),
            ("json", Some("path.from_mm".into()), (1, 42))
        );
        assert_eq!(at("{\"path\":\n {}}"), ("json", Some("path".into()), (2, 3)));
        assert_eq!(at("{\"shaper\": 3}"), ("json", Some("shaper".into()), (1, 12)));
        assert_eq!(at("{\n\"motion\": {\"feed_mm_s\": }}"), ("json", None, (2, 25)));
        assert_eq!(at("{\"tool\": {\"flutes\": 2.5}}").1, Some("tool.flutes".into()));
        assert_eq!(at("{} x"), ("json", None, (1, 4)));
        assert_eq!(at(""), ("json", None, (1, 1)));
        assert_eq!(at("{\n"), ("json", None, (2, 1)));
        assert_eq!(at("{\"robot\": {\"name\": \"äöü\"}, \"ü\": 1}").2, (1, 28));
        assert_eq!(at("{\"path\": {\"kind\": \"spiral\"}}").1, Some("path.kind".into()));
        assert_eq!(at("{\"shaper\": {\"kind\": \"zvd\", \"damp\": 1}}").1, Some("shaper.damp".into()));
        assert_eq!(
            at("{\"robot\": {\"modified_dh\": [{\"alpha\": 1}]}}").1,
            Some("robot.modified_dh[0].alpha".into())
        );
    }

    #[test]
    fn lists_are_no_objects() {
        for (text, field) in [
            ("[]", None),
            ("{\"motion\": [100, 200]}", Some("motion")),
            (
                "{\"robot\": {\"modified_dh\": [[0,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,0]]}}",
                Some("robot.modified_dh[0]"),
            ),
        ] {
            assert_eq!(Job::from_json(text).unwrap_err().field(), field, "{text}");
        }
    }

    #[test]
    fn an_unknown_key_is_answered_with_the_nearest() {
        let nearest = |text: &str| match Job::from_json(text) {
            Err(Error::UnknownKey { nearest, .. }) => nearest,
            other => panic!("{other:?}"),
        };
        assert_eq!(nearest("{\"motion\": {\"feed_mms\": 3}}").as_deref(), Some("motion.feed_mm_s"));
        assert_eq!(nearest("{\"compensaton\": {}}").as_deref(), Some("compensation"));
        assert_eq!(nearest("{\"qqqqq\": 1}"), None);
    }

    #[test]
    fn what_is_not_given_is_listed() {
        let given = "{\"version\":1,\"robot\":{},\"motion\":{\"feed_mm_s\":1},\"path\":{}}";
        let missing = not_given(&Node::of(given).unwrap()).unwrap();
        assert!(
            missing.contains(&"cutting".to_owned()) && missing.contains(&"motion.sample_time_s".to_owned())
        );
        assert!(!missing.iter().any(|key| key.starts_with("path") || key.starts_with("robot")));
        assert!(Job::read_json(&Job::default().to_json()).unwrap().1.is_empty());
    }
}
