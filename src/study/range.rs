//! The values that a number takes.

use crate::error::Error;
use crate::math;
use serde::Serialize;

/// Most values of a range.
const MOST: usize = 10_000;

/// A number as it is typed on a command line.
pub(super) fn finite(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

/// Values of one number of a job, evenly spaced or in equal ratios.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ValueRange {
    /// The number's dotted path in the job.
    pub path: String,
    /// First value, in the field's unit.
    pub from: f64,
    /// Last value.
    pub to: f64,
    /// How many.
    pub count: usize,
    /// Whether the values are in equal ratios.
    pub logarithmic: bool,
}

impl ValueRange {
    /// Reads `path=from:to:count`, with `:log` at the end for equal ratios.
    ///
    /// # Errors
    /// [`Error::Invalid`] with the text and what is wrong with it.
    pub fn read(text: &str) -> Result<Self, Error> {
        let wrong = || {
            Error::invalid(
                "vary",
                text,
                "path=from:to:count, such as cutting.axial_depth_mm=0.5:5:20, or with :log; path=number,number; for a choice \
                 path=word,word or path=all, such as material.preset=all",
            )
        };
        let (path, rest) = text.split_once('=').ok_or_else(wrong)?;
        let parts: Vec<&str> = rest.split(':').collect();
        let (from, to, count, logarithmic) = match parts.as_slice() {
            [from, to, count] => (from, to, count, false),
            [from, to, count, "log"] => (from, to, count, true),
            _ => return Err(wrong()),
        };
        let number = |text: &str| finite(text).ok_or_else(wrong);
        let count: usize = count.parse().map_err(|_| wrong())?;
        Self { path: path.to_owned(), from: number(from)?, to: number(to)?, count, logarithmic }.checked()
    }

    /// The range, if it can be walked.
    ///
    /// # Errors
    /// [`Error::Invalid`] if it has no values or too many, or ratios of numbers that are not above zero.
    pub fn checked(self) -> Result<Self, Error> {
        if !(1..=MOST).contains(&self.count) {
            return Err(Error::invalid(self.path, self.count, format!("1 to {MOST} values")));
        }
        if self.logarithmic && !(self.from > 0.0 && self.to > 0.0) {
            return Err(Error::invalid(
                self.path,
                format!("{}:{}", self.from, self.to),
                "numbers above 0 for equal ratios",
            ));
        }
        Ok(self)
    }

    /// The value of this index; the ends are exact.
    pub fn at(&self, index: usize) -> f64 {
        let last = self.count - 1;
        if index == 0 {
            return self.from;
        }
        if index == last {
            return self.to;
        }
        let share = index as f64 / last as f64;
        if self.logarithmic {
            math::exp(math::ln(self.from) + (math::ln(self.to) - math::ln(self.from)) * share)
        } else {
            self.from + (self.to - self.from) * share
        }
    }
}
