//! The largest value of a number for which the error meets the tolerance.
//!
//! The range is scanned, and each [`Crossing`] between meeting and missing is narrowed. Those that begin and
//! end between two values of the scan are not seen.

use crate::error::Error;
use crate::job::Job;
use crate::progress::Progress;
use crate::study::crossing::{Crossing, Tried};
use crate::study::range::finite;
use crate::study::{Outcome, Sweep, ValueRange, VariedJob, at_once};
use serde::Serialize;

/// Values of the scan.
const SCAN: usize = 17;
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
    /// At no value of the scan.
    Nowhere,
    /// At some.
    Partly,
    /// At every value of the scan.
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
    /// What the run at the largest value says.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_largest: Option<Outcome>,
    /// Number of runs.
    pub runs: usize,
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
        let scan = Sweep::new(job, &[self.scan().into()])?;
        self.answer_from(job, &at_once(SCAN, |index| self.quantity.of(&scan.row(index).outcome)))
    }

    /// The same if the errors at the values of the [`scan`](Self::scan) are known [mm]; `None` without a result.
    ///
    /// # Errors
    /// As for [`answer`](Self::answer), and if there are more or fewer of them than values.
    pub fn answer_from(&self, job: &Job, scanned: &[Option<f64>]) -> Result<LargestAnswer, Error> {
        if scanned.len() != SCAN {
            return Err(Error::invalid("scan", scanned.len(), format!("{SCAN} errors")));
        }
        let varied = VariedJob::new(job)?;
        let tolerance = job.compensation.tolerance_mm;
        let varied_to = |value: f64| [(self.path.as_str(), value)];
        let outcome = |value: f64| Outcome::of_varied(varied.with(varied_to(value)));
        let judged = |value: f64, error: Option<f64>| Tried {
            value,
            excess: error.map_or(f64::INFINITY, |error| error - tolerance),
        };
        let range = self.scan();
        let scan: Vec<Tried> =
            scanned.iter().enumerate().map(|(index, error)| judged(range.at(index), *error)).collect();
        if scan.iter().all(|tried| tried.excess == f64::INFINITY) {
            // Nothing can be said of the tolerance: what is wrong is not the value.
            let job = varied.with(varied_to(self.from))?;
            crate::simulation::run(&job, &mut Progress::none())?;
        }
        let changes: Vec<usize> =
            (1..SCAN).filter(|&index| scan[index - 1].meets() != scan[index].meets()).collect();
        let run = |value: f64| {
            let outcome = outcome(value);
            (judged(value, self.quantity.of(&outcome)), outcome)
        };
        let found = at_once(changes.len(), |index| Crossing::narrowed(&scan, changes[index], &run));
        let meeting = scan.iter().filter(|tried| tried.meets()).count();
        let holds = match meeting {
            0 => Holds::Nowhere,
            SCAN => Holds::Everywhere,
            _ => Holds::Partly,
        };
        let at_end = scan.last().is_some_and(|last| last.meets());
        let last = found.last().filter(|_| !at_end);
        let largest = if at_end { Some(self.to) } else { last.map(|crossing| crossing.value) };
        let known = last.and_then(|crossing| crossing.outcome.clone());
        let more = usize::from(largest.is_some() && known.is_none());
        Ok(LargestAnswer {
            path: self.path.clone(),
            largest,
            quantity: self.quantity,
            tolerance_mm: tolerance,
            holds,
            crossings: found.iter().map(|crossing| crossing.value).collect(),
            at_largest: largest.map(|value| known.unwrap_or_else(|| outcome(value))),
            runs: SCAN + found.iter().map(|crossing| crossing.runs).sum::<usize>() + more,
        })
    }
}
