//! The largest value of a number for which the error meets the tolerance.
//!
//! The range is scanned, and each change between meeting and missing is narrowed by false position
//! in the Illinois variant (Dowell and Jarratt, BIT 11, 1971), with bisection where that stalls or a
//! side has no result. Changes that begin and end between two values of the scan are not seen.

use crate::error::Error;
use crate::job::Job;
use crate::progress::Progress;
use crate::study::range::finite;
use crate::study::{Outcome, Sweep, ValueRange, VariedJob, at_once};
use serde::Serialize;

/// Values of the scan.
const SCAN: usize = 17;
/// Ratio of the ends from which on the scan is in equal ratios.
const DECADE: f64 = 10.0;
/// Width of a bracket, as a share of the larger end, at which it is narrow enough.
const NARROW: f64 = 2e-4;
/// Most runs to narrow one change: bisection alone takes about 13.
const MOST: usize = 40;

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

/// One run: its value, and how far the error is above the tolerance; infinite without a result.
#[derive(Debug, Clone, Copy)]
struct Tried {
    value: f64,
    excess: f64,
}

impl Tried {
    fn meets(self) -> bool {
        self.excess <= 0.0
    }
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
        let scan = Sweep::new(job, &[self.scan()])?;
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
        let changes: Vec<[Tried; 2]> = scan
            .windows(2)
            .filter(|pair| pair[0].meets() != pair[1].meets())
            .map(|pair| [pair[0], pair[1]])
            .collect();
        let tried = |value: f64| judged(value, self.quantity.of(&outcome(value)));
        let narrowed = at_once(changes.len(), |index| narrowed(changes[index], &tried));
        let crossings: Vec<f64> = narrowed.iter().map(|(value, _)| *value).collect();
        let meeting = scan.iter().filter(|tried| tried.meets()).count();
        let holds = match meeting {
            0 => Holds::Nowhere,
            SCAN => Holds::Everywhere,
            _ => Holds::Partly,
        };
        let at_end = scan.last().is_some_and(|last| last.meets());
        let largest = if at_end { Some(self.to) } else { crossings.last().copied() };
        Ok(LargestAnswer {
            path: self.path.clone(),
            largest,
            quantity: self.quantity,
            tolerance_mm: tolerance,
            holds,
            crossings,
            at_largest: largest.map(outcome),
            runs: SCAN
                + narrowed.iter().map(|(_, runs)| runs).sum::<usize>()
                + usize::from(largest.is_some()),
        })
    }
}

/// The meeting end of a change, once its bracket is narrow, and the number of runs.
fn narrowed([mut low, mut high]: [Tried; 2], tried: &impl Fn(f64) -> Tried) -> (f64, usize) {
    let mut runs = 0;
    // Which end was kept by the last step: false position halves the excess of one that is kept twice.
    let mut kept = 0_i8;
    let mut width = f64::INFINITY;
    while high.value - low.value > NARROW * high.value.abs().max(low.value.abs()) && runs < MOST {
        let now = high.value - low.value;
        let shrinks = now < 0.6 * width;
        width = now;
        let middle = 0.5 * (low.value + high.value);
        let chord = low.value - low.excess * now / (high.excess - low.excess);
        // Near an end the next bracket is wide: keep a tenth of the goal away from it.
        let room = 0.1 * NARROW * high.value.abs().max(low.value.abs());
        let inside = chord.is_finite() && chord > low.value && chord < high.value;
        let next = if inside && (runs < 2 || shrinks) {
            chord.clamp(low.value + room, high.value - room)
        } else {
            middle
        };
        let found = tried(next);
        runs += 1;
        if found.meets() == low.meets() {
            low = found;
            high.excess = if kept == 1 { high.excess / 2.0 } else { high.excess };
            kept = 1;
        } else {
            high = found;
            low.excess = if kept == -1 { low.excess / 2.0 } else { low.excess };
            kept = -1;
        }
    }
    (if low.meets() { low.value } else { high.value }, runs)
}
