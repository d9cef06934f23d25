//! A job over the values of one of its numbers or choices, or of two.

use crate::at_once::at_once;
use crate::error::Error;
use crate::job::Job;
use crate::study::{Outcome, Taken, Variation, VariedJob};
use serde::Serialize;

/// Most runs of a sweep.
const MOST: usize = 100_000;

/// One run of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SweepRow {
    /// What the first takes: a number, or the word of a choice.
    pub value: Taken,
    /// What the second takes, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub second: Option<Taken>,
    /// What the run says.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// A job to be run for all values of a number or choice; with two, for all pairs, the second varying faster.
#[derive(Debug, Clone)]
pub struct Sweep {
    varied: VariedJob,
    first: Variation,
    second: Option<Variation>,
}

impl Sweep {
    /// Of a job, over one number or choice, or two.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there are no numbers, more than two, or too many runs; [`Error::UnknownKey`]
    /// and the like if a path is that of no number.
    pub fn new(job: &Job, over: &[Variation]) -> Result<Self, Error> {
        let (first, second) = match over {
            [first] => (first.clone(), None),
            [first, second] => (first.clone(), Some(second.clone())),
            _ => return Err(Error::invalid("vary", over.len(), "one number or choice, or two")),
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
        self.first.count() * self.inner()
    }

    /// One of its runs; a value that the job refuses is a row with an error.
    pub fn row(&self, index: usize) -> SweepRow {
        let (value, second) = self.taken(index);
        let outcome = Outcome::of_varied(self.varied.with(self.changes(index)));
        SweepRow { value, second, outcome }
    }

    fn inner(&self) -> usize {
        self.second.as_ref().map_or(1, Variation::count)
    }

    fn taken(&self, index: usize) -> (Taken, Option<Taken>) {
        let inner = self.inner();
        (self.first.at(index / inner), self.second.as_ref().map(|second| second.at(index % inner)))
    }

    fn changes(&self, index: usize) -> impl Iterator<Item = (&str, Taken)> {
        let (value, second) = self.taken(index);
        let other = self.second.as_ref().map(Variation::path).zip(second);
        std::iter::once((self.first.path(), value)).chain(other)
    }
}

/// All rows of a [`Sweep`], in their order.
///
/// # Errors
/// See [`Sweep::new`].
pub fn sweep(job: &Job, over: &[Variation]) -> Result<Vec<SweepRow>, Error> {
    let sweep = Sweep::new(job, over)?;
    Ok(at_once(sweep.count(), |index| sweep.row(index)))
}
