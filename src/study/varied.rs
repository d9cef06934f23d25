//! A job with some of its numbers replaced.

use crate::error::Error;
use crate::job::Job;
use serde_json::{Map, Value};

/// A job whose numbers are replaced by their dotted path, such as `cutting.axial_depth_mm` or
/// `workpiece_frame.xyz_mm.0`.
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

    /// The job with these numbers at their paths. Keys that the job does not state are added.
    ///
    /// # Errors
    /// If a path leads into something that is neither an object nor a list, or beyond the end of a
    /// list; otherwise see [`Job::from_json`], which names keys that do not exist.
    pub fn with<'a>(&self, numbers: impl IntoIterator<Item = (&'a str, f64)>) -> Result<Job, Error> {
        let mut varied = self.0.clone();
        for (path, number) in numbers {
            *place(&mut varied, path)? = written(number);
        }
        Job::from_json(&varied.to_string())
    }

    /// What is wrong with a path, if it is that of no number of a job: an error for all values.
    ///
    /// # Errors
    /// That one. What a job refuses of this value alone is none.
    pub fn check<'a>(&self, numbers: impl IntoIterator<Item = (&'a str, f64)>) -> Result<(), Error> {
        match self.with(numbers) {
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
