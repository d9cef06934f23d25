//! The change of a job that cures a warning.

use crate::error::Error;
use crate::job::Job;
use serde::Serialize;
use serde_json::{Map, Value};

/// A change of the job that removes a warning.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Remedy {
    /// What to do, a short imperative.
    pub label: String,
    /// The change as a JSON merge patch of the job (IETF RFC 7386, 2014).
    pub patch: Value,
}

impl Remedy {
    /// The label without its figures, for a headline.
    pub fn brief(&self) -> &str {
        self.label.split(',').next().unwrap_or(&self.label)
    }

    /// The job with this change.
    ///
    /// # Errors
    /// See [`Job::from_json`]; none for the job that the remedy was found for.
    pub fn applied(&self, job: &Job) -> Result<Job, Error> {
        // By way of the text: a second way to write all of a job would weigh 100 kB in the browser.
        let mut text = serde_json::from_str(&job.to_json()).unwrap_or_default();
        merge(&mut text, &self.patch);
        Job::from_json(&text.to_string())
    }
}

/// Applies a merge patch (RFC 7386, section 2).
fn merge(target: &mut Value, patch: &Value) {
    let Value::Object(changes) = patch else {
        *target = patch.clone();
        return;
    };
    if !target.is_object() {
        *target = Value::Object(Map::new());
    }
    let Value::Object(members) = target else { return };
    for (key, change) in changes {
        if change.is_null() {
            members.remove(key);
        } else {
            merge(members.entry(key.as_str()).or_insert(Value::Null), change);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_examples_of_the_standard_hold() {
        // RFC 7386, appendix A.
        for (mut target, patch, result) in [
            (json!({"a":"b"}), json!({"a":"c"}), json!({"a":"c"})),
            (json!({"a":"b"}), json!({"b":"c"}), json!({"a":"b","b":"c"})),
            (json!({"a":"b"}), json!({"a":null}), json!({})),
            (json!({"a":["b"]}), json!({"a":"c"}), json!({"a":"c"})),
            (json!({"a":"c"}), json!({"a":["b"]}), json!({"a":["b"]})),
            (json!({"a":{"b":"c"}}), json!({"a":{"b":"d","c":null}}), json!({"a":{"b":"d"}})),
            (json!(["a", "b"]), json!(["c", "d"]), json!(["c", "d"])),
            (json!({"e":null}), json!({"a":1}), json!({"e":null,"a":1})),
            (json!([1, 2]), json!({"a":"b","c":null}), json!({"a":"b"})),
            (json!({}), json!({"a":{"bb":{"ccc":null}}}), json!({"a":{"bb":{}}})),
        ] {
            merge(&mut target, &patch);
            assert_eq!(target, result);
        }
    }
}
