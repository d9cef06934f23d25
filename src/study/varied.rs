//! A job with some of its numbers and choices replaced.

use crate::error::Error;
use crate::job::Job;
use crate::job::fields::fields;
use crate::study::Taken;
use serde_json::{Map, Value, json};

/// A job whose numbers and choices are replaced by their dotted path, such as `cutting.axial_depth_mm`,
/// `workpiece_frame.xyz_mm.0` or `material.preset`.
#[derive(Debug, Clone)]
pub struct VariedJob(Value);

impl VariedJob {
    /// The job that is varied.
    ///
    /// # Errors
    /// Never for a job that was read; the type is that of its text.
    pub fn new(job: &Job) -> Result<Self, Error> {
        serde_json::from_str(&job.to_json()).map(Self).map_err(|error| Error::Json {
            field: None,
            message: error.to_string(),
            line: error.line(),
            column: error.column(),
        })
    }

    /// The job with these values at their paths. Keys that the job does not state are added. A preset
    /// replaces all that its section says, and keys that a chosen word does not have go.
    ///
    /// # Errors
    /// If a path leads into something that is neither an object nor a list, or beyond the end of a
    /// list; otherwise see [`Job::from_json`], which names keys that do not exist.
    pub fn with<'a, V: Into<Taken>>(
        &self,
        values: impl IntoIterator<Item = (&'a str, V)>,
    ) -> Result<Job, Error> {
        let mut varied = self.0.clone();
        for (path, value) in values {
            match value.into() {
                Taken::Number(number) => *place(&mut varied, path)? = written(number),
                Taken::Word(word) => choose(&mut varied, path, word)?,
            }
        }
        Job::from_json(&varied.to_string())
    }

    /// What is wrong with a path, if it is that of no number of a job: an error for all values.
    ///
    /// # Errors
    /// That one. What a job refuses of this value alone is none.
    pub fn check<'a, V: Into<Taken>>(
        &self,
        values: impl IntoIterator<Item = (&'a str, V)>,
    ) -> Result<(), Error> {
        match self.with(values) {
            Err(error @ (Error::UnknownKey { .. } | Error::Json { .. })) => Err(error),
            _ => Ok(()),
        }
    }

    /// The job with another section.
    ///
    /// # Errors
    /// See [`Job::from_json`].
    pub fn with_section(&self, name: &str, section: Value) -> Result<Job, Error> {
        let mut varied = self.0.clone();
        *place(&mut varied, name)? = section;
        Job::from_json(&varied.to_string())
    }
}

/// A number as a person would write it: whole ones without a point, as counts and seeds are read.
fn written(number: f64) -> Value {
    let whole = number as i64;
    if whole as f64 == number { Value::from(whole) } else { Value::from(number) }
}

/// Writes a word of a choice. A section that has no keys yet, such as a shaper that is none, gets those
/// that the word needs with the values of a new field, as the page's form does it.
fn choose(job: &mut Value, path: &str, word: String) -> Result<(), Error> {
    let (section, key) = path.rsplit_once('.').unwrap_or((path, ""));
    let at = place(job, section)?;
    if path == "shaper.kind" && word == "none" {
        *at = Value::from(word);
        return Ok(());
    }
    let is_new = !at.is_object();
    if is_new || key == "preset" {
        *at = json!({});
    }
    for field in fields() {
        let Some(when) = field.when.as_ref().filter(|when| when.path == path) else { continue };
        let own = field.path.rsplit_once('.').map_or("", |(_, own)| own);
        let has = when.is.contains(&word.as_str());
        if is_new && has {
            at[own] = json!(field.default);
        } else if let (false, Some(keys)) = (has, at.as_object_mut()) {
            keys.remove(own);
        }
    }
    at[key] = Value::from(word);
    Ok(())
}

/// The place of a path.
fn place<'v>(value: &'v mut Value, path: &str) -> Result<&'v mut Value, Error> {
    let mut at = value;
    for key in path.split('.') {
        if at.is_null() {
            *at = Value::Object(Map::new());
        }
        at = match at {
            Value::Object(members) => members.entry(key).or_insert(Value::Null),
            Value::Array(items) => {
                let count = items.len();
                let item = key.parse::<usize>().ok().and_then(|index| items.get_mut(index));
                item.ok_or_else(|| {
                    Error::invalid(
                        path,
                        key,
                        format!("an index of its list, 0 to {}", count.saturating_sub(1)),
                    )
                })?
            }
            other => return Err(Error::invalid(path, &*other, "the dotted path of a number of the job")),
        };
    }
    Ok(at)
}
