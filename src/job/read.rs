//! From JSON text to a [`Job`] and back.

use crate::error::Error;
use crate::job::Job;
use serde_json::Value;

impl Job {
    /// Reads a job. Keys that are not given take the default job's value; [`Job::not_given`] tells which.
    ///
    /// # Errors
    /// [`Error::Json`] or [`Error::UnknownKey`], with line and column. Values are not checked yet: see [`Job::setup`].
    pub fn from_json(text: &str) -> Result<Self, Error> {
        let mut deserializer = serde_json::Deserializer::from_str(text);
        let mut track = serde_path_to_error::Track::new();
        let tracked = serde_path_to_error::Deserializer::new(&mut deserializer, &mut track);
        let job = <Job as serde::Deserialize>::deserialize(tracked).map_err(|error| {
            let path = track.path().to_string();
            read_error(&error, (path != ".").then_some(path))
        })?;
        deserializer.end().map_err(|error| read_error(&error, None))?;
        check_shape(text)?;
        Ok(job)
    }

    /// The job as indented JSON text.
    pub fn to_json(&self) -> String {
        // A job is plain data: serde_json cannot fail on it.
        serde_json::to_string_pretty(self).unwrap_or_default()
    }

    /// The keys that a job's text leaves to the default, as JSON paths: whole sections, or keys within a given section.
    pub fn not_given(text: &str) -> Vec<String> {
        let (Ok(given), Ok(default)) = (serde_json::from_str(text), serde_json::to_value(Job::default()))
        else {
            return Vec::new();
        };
        let mut missing = Vec::new();
        let (Value::Object(given), Value::Object(default)) = (given, default) else { return missing };
        for (section, content) in default {
            match (given.get(&section), content) {
                (None, _) => missing.push(section),
                // These sections are all or nothing; what they lack is an error, not a default.
                (Some(_), _) if ["robot", "path", "material", "shaper"].contains(&section.as_str()) => {}
                (Some(Value::Object(keys)), Value::Object(content)) => {
                    missing.extend(
                        content
                            .keys()
                            .filter(|key| !keys.contains_key(*key))
                            .map(|key| format!("{section}.{key}")),
                    );
                }
                _ => {}
            }
        }
        missing
    }
}

/// Refuses lists where an object belongs: serde would take their items for the keys in order.
fn check_shape(text: &str) -> Result<(), Error> {
    let Ok(given) = serde_json::from_str::<Value>(text) else { return Ok(()) };
    let list = |field: &str| Error::Json {
        field: (!field.is_empty()).then(|| field.to_owned()),
        message: format!(
            "{}a list stands where an object with named keys belongs",
            if field.is_empty() { String::new() } else { format!("{field}: ") }
        ),
        line: 1,
        column: 1,
    };
    let Value::Object(sections) = &given else { return Err(list("")) };
    for (key, section) in sections {
        if section.is_array() {
            return Err(list(key));
        }
    }
    let rows = given.pointer("/robot/modified_dh").and_then(Value::as_array);
    match rows.into_iter().flatten().position(Value::is_array) {
        Some(row) => Err(list(&format!("robot.modified_dh[{row}]"))),
        None => Ok(()),
    }
}

/// An error of serde_json in our words: unknown keys with the nearest known one, types with the field.
fn read_error(error: &serde_json::Error, field: Option<String>) -> Error {
    let (line, column) = (error.line(), error.column());
    let whole = error.to_string();
    let message = whole.split(" at line ").next().unwrap_or(&whole).to_owned();
    let mut quoted = message.split('`').skip(1).step_by(2);
    if message.starts_with("unknown field")
        && let Some(key) = quoted.next()
    {
        // The path ends with the unknown key where the parser got as far as its value.
        let parent =
            field.as_deref().map_or("", |path| path.strip_suffix(key).unwrap_or(path)).trim_end_matches('.');
        let join = |key: &str| if parent.is_empty() { key.to_owned() } else { format!("{parent}.{key}") };
        let nearest = quoted
            .map(|known| (strsim::normalized_damerau_levenshtein(key, known), known))
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .filter(|(similarity, _)| *similarity > 0.4)
            .map(|(_, known)| join(known));
        // The parser stands behind the key; the reader looks for where it begins.
        let column = column.saturating_sub(key.chars().count() + 1);
        return Error::UnknownKey { field: join(key), nearest, line, column };
    }
    let place = field.as_ref().map_or_else(String::new, |path| format!("{path}: "));
    Error::Json { field, message: format!("{place}{message} (line {line}, column {column})"), line, column }
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
        assert_eq!(
            at("{\"motion\": {\"feed_mm_s\": \"fast\"}}"),
            ("json", Some("motion.feed_mm_s".into()), (1, 31))
        );
        assert_eq!(at("{\"tool\": {\"flutes\": 2.5}}").1, Some("tool.flutes".into()));
        assert_eq!(at("{} x"), ("json", None, (1, 4)));
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
        let missing = Job::not_given(given);
        assert!(
            missing.contains(&"cutting".to_owned()) && missing.contains(&"motion.sample_time_s".to_owned())
        );
        assert!(!missing.iter().any(|key| key.starts_with("path") || key.starts_with("robot")));
        assert!(Job::not_given(&Job::default().to_json()).is_empty());
    }
}
