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

/// A job to be run for all values of a number; with two, for all pairs, the second varying faster.
#[derive(Debug, Clone)]
pub struct Sweep {
    varied: VariedJob,
    first: ValueRange,
    second: Option<ValueRange>,
}

impl Sweep {
    /// Of a job, over one range or two.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there are no numbers, more than two, or too many runs; [`Error::UnknownKey`]
    /// and the like if a path is that of no number.
    pub fn new(job: &Job, ranges: &[ValueRange]) -> Result<Self, Error> {
        let (first, second) = match ranges {
            [first] => (first.clone(), None),
            [first, second] => (first.clone(), Some(second.clone())),
            _ => return Err(Error::invalid("vary", ranges.len(), "one number or two")),
        };
        let sweep = Self { varied: VariedJob::new(job)?, first, second };
        if sweep.count() > MOST {
            return Err(Error::invalid("vary", sweep.count(), format!("at most {MOST} runs")));
        }
        sweep.varied.check(sweep.changes(0))?;
        Ok(sweep)
    }

    /// Number of its runs.
    pub fn count(&self) -> usize {
        self.first.count * self.inner()
    }

    /// One of its runs; a value that the job refuses is a row with an error.
    pub fn row(&self, index: usize) -> SweepRow {
        let (value, second) = self.numbers(index);
        let outcome = Outcome::of_varied(self.varied.with(self.changes(index)));
        SweepRow { value, second, outcome }
    }

    fn inner(&self) -> usize {
        self.second.as_ref().map_or(1, |range| range.count)
    }

    fn numbers(&self, index: usize) -> (f64, Option<f64>) {
        let inner = self.inner();
        (self.first.at(index / inner), self.second.as_ref().map(|range| range.at(index % inner)))
    }

    fn changes(&self, index: usize) -> impl Iterator<Item = (&str, f64)> {
        let (value, second) = self.numbers(index);
        let other = self.second.as_ref().zip(second).map(|(range, value)| (range.path.as_str(), value));
        std::iter::once((self.first.path.as_str(), value)).chain(other)
    }
}

/// All rows of a [`Sweep`], in their order.
///
/// # Errors
/// See [`Sweep::new`].
pub fn sweep(job: &Job, ranges: &[ValueRange]) -> Result<Vec<SweepRow>, Error> {
    let sweep = Sweep::new(job, ranges)?;
    Ok(at_once(sweep.count(), |index| sweep.row(index)))
}
