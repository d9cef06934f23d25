//! The largest value of a number for which the error meets the tolerance.
//!
//! The range is scanned, and each crossing between meeting and missing is narrowed, see the module `search`.

use crate::at_once::at_once;
use crate::error::Error;
use crate::job::Job;
use crate::progress::Progress;
use crate::study::range::finite;
use crate::study::search::{CrossingSearch, SCAN, Tried};
use crate::study::{Outcome, ValueRange, VariedJob};
use serde::Serialize;

/// Ratio of the ends from which on the scan is in equal ratios.
const DECADE: f64 = 10.0;

/// The error that the tolerance applies to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ErrorMeasure {
    /// After compensation, if every number is exact.
    Nominal,
    /// After compensation, what 95 % of the plants leave at most.
    P95,
    /// Before compensation.
    Uncompensated,
}

impl ErrorMeasure {
    /// The quantity of this name.
    ///
    /// # Errors
    /// [`Error::Invalid`] with all names.
    pub fn named(name: &str) -> Result<Self, Error> {
        match name {
            "nominal" => Ok(Self::Nominal),
            "p95" => Ok(Self::P95),
            "uncompensated" => Ok(Self::Uncompensated),
            _ => Err(Error::unknown_name("quantity", name, "one of", ["nominal", "p95", "uncompensated"])),
        }
    }

    /// Its value [mm]; `None` without a result.
    pub fn of(self, outcome: &Outcome) -> Option<f64> {
        match self {
            Self::Nominal => outcome.after_max_mm,
            Self::P95 => outcome.p95_mm,
            Self::Uncompensated => outcome.before_max_mm,
        }
    }
}

/// For how much of a range the tolerance is met.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Holds {
    /// At none of the values that were tried.
    Nowhere,
    /// At some of them.
    Partly,
    /// At every one.
    Everywhere,
}

/// Which value is the largest that meets the job's tolerance?
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LargestQuestion {
    /// The number's dotted path in the job.
    pub path: String,
    /// Smallest value to consider, in the field's unit.
    pub from: f64,
    /// Largest value to consider.
    pub to: f64,
    /// The error that the tolerance applies to.
    pub quantity: ErrorMeasure,
}

/// The answer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LargestAnswer {
    /// The number's dotted path.
    pub path: String,
    /// The largest value that meets the tolerance; `None` if there is none.
    pub largest: Option<f64>,
    /// The error that the tolerance applies to.
    pub quantity: ErrorMeasure,
    /// The job's tolerance [mm].
    pub tolerance_mm: f64,
    /// For how much of the range it is met.
    pub holds: Holds,
    /// Every change between meeting and missing, rising: the value on the side that meets.
    pub crossings: Vec<f64>,
    /// What the run at the largest value says, if it was made here.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_largest: Option<Outcome>,
    /// Number of runs.
    pub runs: usize,
    /// Values whose errors are still wanted, in the field's unit: they can be run at once. None once it is the answer.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub wanted: Vec<f64>,
}

impl LargestQuestion {
    /// Reads `path=from:to`.
    ///
    /// # Errors
    /// [`Error::Invalid`] with the text and what is legal.
    pub fn read(text: &str, quantity: ErrorMeasure) -> Result<Self, Error> {
        let wrong = || Error::invalid("largest", text, "path=from:to, such as cutting.axial_depth_mm=0.1:10");
        let (path, rest) = text.split_once('=').ok_or_else(wrong)?;
        let (from, to) = rest.split_once(':').ok_or_else(wrong)?;
        let number = |text: &str| finite(text).ok_or_else(wrong);
        let (from, to) = (number(from)?, number(to)?);
        if from >= to {
            return Err(wrong());
        }
        Ok(Self { path: path.to_owned(), from, to, quantity })
    }

    /// The values at which it is looked where the error crosses the tolerance.
    pub fn scan(&self) -> ValueRange {
        let logarithmic = self.from > 0.0 && self.to / self.from >= DECADE;
        ValueRange { path: self.path.clone(), from: self.from, to: self.to, count: SCAN, logarithmic }
    }

    /// Answers it for a job.
    ///
    /// # Errors
    /// If the path is that of no number of the job, or no value of the scan has a result: the error of
    /// the first. Other values without a result miss the tolerance.
    pub fn answer(&self, job: &Job) -> Result<LargestAnswer, Error> {
        self.answer_from(job, &[])
    }

    /// The same if some errors are known already, see [`partial`](Self::partial).
    ///
    /// # Errors
    /// As for [`answer`](Self::answer) and [`partial`](Self::partial).
    pub fn answer_from(&self, job: &Job, known: &[Option<f64>]) -> Result<LargestAnswer, Error> {
        let varied = VariedJob::new(job)?;
        varied.check([(self.path.as_str(), self.from)])?;
        let mut known = known.to_vec();
        let mut outcomes: Vec<(f64, Outcome)> = Vec::new();
        loop {
            let answer = self.partial(job, &known)?;
            if answer.wanted.is_empty() {
                let made = outcomes.into_iter().find(|(value, _)| Some(*value) == answer.largest);
                return Ok(LargestAnswer { at_largest: made.map(|(_, outcome)| outcome), ..answer });
            }
            let run = |value: f64| Outcome::of_varied(varied.with([(self.path.as_str(), value)]));
            let made = at_once(answer.wanted.len(), |k| run(answer.wanted[k]));
            known.extend(made.iter().map(|outcome| self.quantity.of(outcome)));
            outcomes.extend(answer.wanted.into_iter().zip(made));
        }
    }

    /// The answer as far as these errors go [mm], and which are wanted next: those at the values of the
    /// [`scan`](Self::scan), then those that were wanted, in this order; `None` without a result.
    ///
    /// # Errors
    /// [`Error::Invalid`] if they end within a round; if none has a result, the error of the first value.
    pub fn partial(&self, job: &Job, known: &[Option<f64>]) -> Result<LargestAnswer, Error> {
        let tolerance = job.compensation.tolerance_mm;
        let search = self.searched(tolerance, known)?;
        let tried = search.tried();
        if !tried.is_empty() && known.iter().all(Option::is_none) {
            // Nothing can be said of the tolerance: what is wrong is not the value.
            let job = VariedJob::new(job)?.with([(self.path.as_str(), self.from)])?;
            crate::simulation::run(&job, &mut Progress::none())?;
        }
        let crossings = search.crossings();
        let meeting = tried.iter().filter(|tried| tried.meets()).count();
        let holds = match meeting {
            0 => Holds::Nowhere,
            _ if meeting == tried.len() => Holds::Everywhere,
            _ => Holds::Partly,
        };
        let at_end = tried.last().is_some_and(|last| last.meets());
        Ok(LargestAnswer {
            path: self.path.clone(),
            largest: if at_end { Some(self.to) } else { crossings.last().copied() },
            quantity: self.quantity,
            tolerance_mm: tolerance,
            holds,
            crossings,
            at_largest: None,
            runs: tried.len(),
            wanted: search.wanted(),
        })
    }

    /// The search after the rounds whose errors are known.
    fn searched(&self, tolerance: f64, known: &[Option<f64>]) -> Result<CrossingSearch, Error> {
        let range = self.scan();
        let mut search = CrossingSearch::new(std::array::from_fn(|index| range.at(index)));
        let mut rest = known;
        loop {
            if rest.is_empty() {
                return Ok(search);
            }
            let wanted = search.wanted();
            let whole = known.len() - rest.len();
            let legal = || format!("{whole} or {} errors", whole + wanted.len());
            if rest.len() < wanted.len() || wanted.is_empty() {
                return Err(Error::invalid("scan", known.len(), legal()));
            }
            let (round, after) = rest.split_at(wanted.len());
            let tried = |(value, error): (&f64, &Option<f64>)| Tried {
                value: *value,
                excess: excess(*error, tolerance),
            };
            let runs: Vec<Tried> = wanted.iter().zip(round).map(tried).collect();
            search.take(&runs);
            rest = after;
        }
    }
}

/// How far an error is above the tolerance [mm]: infinitely without a result.
fn excess(error: Option<f64>, tolerance: f64) -> f64 {
    error.map_or(f64::INFINITY, |error| error - tolerance)
}
