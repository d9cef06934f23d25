//! A job over the values of one number, or of two.

use crate::error::Error;
use crate::job::Job;
use crate::study::{Outcome, ValueRange, VariedJob, at_once};
use serde::Serialize;

/// Most runs of a sweep.
const MOST: usize = 100_000;

/// One run of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SweepRow {
    /// Value of the first number.
    pub value: f64,
    /// Value of the second, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub second: Option<f64>,
    /// What the run says.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// Runs a job for all values of a number; with two, for all pairs, the second varying faster.
///
/// # Errors
/// [`Error::Invalid`] if there are no numbers, more than two, or too many runs; [`Error::UnknownKey`]
/// and the like if a path is that of no number. Values that a job refuses are rows with an error.
pub fn sweep(job: &Job, ranges: &[ValueRange]) -> Result<Vec<SweepRow>, Error> {
    let (first, second) = match ranges {
        [first] => (first, None),
        [first, second] => (first, Some(second)),
        _ => return Err(Error::invalid("vary", ranges.len(), "one number or two")),
    };
    let inner = second.map_or(1, |range| range.count);
    let count = first.count * inner;
    if count > MOST {
        return Err(Error::invalid("vary", count, format!("at most {MOST} runs")));
    }
    let varied = VariedJob::new(job)?;
    let numbers = |index: usize| (first.at(index / inner), second.map(|range| range.at(index % inner)));
    let changes = |index: usize| {
        let (value, other) = numbers(index);
        let second = second.zip(other).map(|(range, value)| (range.path.as_str(), value));
        [(first.path.as_str(), value)].into_iter().chain(second)
    };
    varied.check(changes(0))?;
    Ok(at_once(count, |index| {
        let (value, second) = numbers(index);
        let outcome = Outcome::of_varied(varied.with(changes(index)));
        SweepRow { value, second, outcome }
    }))
}
