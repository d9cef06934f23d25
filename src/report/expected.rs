//! What to expect on the part, as the summary states it.

use crate::math;
use crate::report::Report;
use crate::spread::Stiffness;
use crate::uncertainty::{BreakEven, Measure, Quantiles, Share};
use crate::units::MM;
use serde::Serialize;

/// Median and 95 % quantile of a largest error [mm].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ExpectedError {
    /// Half of the plants leave less.
    pub p50: f64,
    /// 95 % of the plants leave less.
    pub p95: f64,
    /// 95 % interval of that quantile itself, for the number of draws.
    pub p95_interval: [f64; 2],
}

impl From<Quantiles> for ExpectedError {
    fn from(Quantiles { p50, p95, p95_interval }: Quantiles) -> Self {
        Self { p50: p50 / MM, p95: p95 / MM, p95_interval: p95_interval.map(|p95| p95 / MM) }
    }
}

/// How sure the figures are.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HowSure {
    /// What to expect on the part, in words.
    pub sentence: String,
    /// How well joint stiffness is known, in words.
    pub stiffness: String,
    /// How well the cutting forces are known, in words.
    pub cutting: String,
    /// How well the filter's frequency is known, in words.
    pub frequency: String,
    /// Number of draws.
    pub draws: usize,
    /// Share of each input in the variance where the band is widest.
    pub shares: Vec<InputShare>,
    /// What to measure first, if that narrows the band.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measure_first: Option<MeasureFirst>,
    /// Everything that could be measured, what leaves the least error first.
    pub measures: Vec<MeasureFirst>,
    /// The same band without compensation [mm].
    pub without_compensation_mm: ExpectedError,
    /// The same band at the top of the cut [mm].
    pub wall_mm: ExpectedError,
    /// Compensation pays off while the true deflection is more than this share of the assumed one [%];
    /// absent if there is no such share, see `break_even`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub break_even_percent: Option<f64>,
    /// When compensating pays, in words.
    pub break_even: String,
    /// Share of the draws in which compensating makes the largest error larger [%].
    pub worse_percent: f64,
    /// What the band leaves out.
    pub left_out: &'static str,
}

/// An input's share.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InputShare {
    /// Stable slug.
    pub input: String,
    /// Its share of the variance [%].
    pub percent: f64,
}

/// A measurement and what it would bring.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasureFirst {
    /// Stable slug: `stiffness`, `cutting`, `frequency` or `pass`.
    pub input: &'static str,
    /// Its 95 % range after the measurement, to each side [%]; of a pass 0, because what it shows is corrected.
    pub percent: f64,
    /// 95 % quantile of the largest contour error after it [mm].
    pub p95_mm: f64,
    /// What to do and what it would bring.
    pub sentence: String,
}

impl MeasureFirst {
    fn of(measure: &Measure) -> Self {
        let p95 = crate::report::length_text(measure.p95, MM, 3);
        let how = match measure.input {
            "stiffness" => "the joint stiffness in a few loaded poses (Identify)",
            "cutting" => "the cutting forces with a dynamometer",
            _ => "the filter's frequency",
        };
        let sentence = format!(
            "Measure {how}: if it is known to ±{} %, expect at most {p95} mm in 95 of 100 cases.",
            measure.percent
        );
        Self { input: measure.input, percent: measure.percent, p95_mm: measure.p95 / MM, sentence }
    }
}

/// What no spread covers.
const LEFT_OUT: &str = "Friction and lost motion in the gears, the arm's calibration, heat, tool wear and the \
                        arm's own frequency are not in the band.";

impl Report {
    /// What to expect on the part, in words.
    fn expectation(&self) -> String {
        let expect = match self.impossible() {
            Some(_) => "The arm cannot run this. If it could, expect",
            None => "Expect",
        };
        let expected = self.expected_text();
        if self.setup().spreads.together.is_some() {
            return format!("{expect} {expected} (arm and cut as a measured pass has them).");
        }
        let cutting = self.setup().spreads.cutting.words();
        format!("{expect} {expected} (stiffness {}, cutting forces {cutting}).", self.stiffness_known())
    }

    /// How well stiffness is known, in words; a rigid joint has none.
    fn stiffness_known(&self) -> String {
        let compliance = self.plan.robot.compliance();
        if self.setup().spreads.together.is_some() {
            return "from a measured pass".to_owned();
        }
        match &self.setup().spreads.stiffness {
            Stiffness::Together(_) => "from the covariance of an identification".to_owned(),
            Stiffness::Each(spreads) => {
                let soft = spreads.iter().zip(compliance).filter(|(_, compliance)| **compliance > 0.0);
                let mut words: Vec<String> = soft.map(|(spread, _)| spread.words()).collect();
                words.sort();
                words.dedup();
                if words.is_empty() { "infinite".to_owned() } else { words.join(" or ") }
            }
        }
    }

    /// The share of the assumed deflection above which compensating pays [%], and when it pays in
    /// words.
    fn break_even(&self) -> (Option<f64>, String) {
        let words = match self.band.break_even {
            _ if self.compensation.passes == 0 => "Nothing is compensated.",
            BreakEven::Above(share) => {
                let percent = 100.0 * share;
                let words = format!(
                    "Compensation pays off if the true deflection is more than {percent:.0} % of the assumed one."
                );
                return (Some(percent), words);
            }
            BreakEven::Always => "Compensation pays off however small the true deflection is.",
            BreakEven::Never => "Compensation does not pay off: it does not reduce the largest error.",
        };
        (None, words.to_owned())
    }

    /// What each measurement would bring, what leaves the least error first. A pass that is measured shows what
    /// all inputs do together; once that is corrected, what is left is what would be if every number were exact.
    fn measures(&self) -> Vec<MeasureFirst> {
        let measures = self.band.measures.iter().map(MeasureFirst::of);
        if self.compensation.passes == 0 {
            return measures.collect();
        }
        let left = self.after_max();
        let sentence = format!(
            "Mill a pass, measure it and correct what it shows: {} mm is left, and what does not repeat and what \
             the gauge cannot tell.",
            crate::report::length_text(left, MM, 3)
        );
        let pass = MeasureFirst { input: "pass", percent: 0.0, p95_mm: left / MM, sentence };
        math::rising(measures.chain([pass]), |measure| measure.p95_mm)
    }

    /// How sure the figures are.
    pub fn how_sure(&self) -> HowSure {
        let (band, spreads) = (&self.band, &self.setup().spreads);
        let measure_first = band.measure_first().map(MeasureFirst::of);
        let (break_even_percent, break_even) = self.break_even();
        let shares = band
            .shares
            .iter()
            .map(|Share { input, share }| InputShare { input: input.clone(), percent: 100.0 * share });
        HowSure {
            sentence: self.expectation(),
            stiffness: self.stiffness_known(),
            cutting: spreads.cutting.words(),
            frequency: spreads.frequency.words(),
            draws: spreads.draws,
            shares: shares.collect(),
            measure_first,
            measures: self.measures(),
            without_compensation_mm: band.before.into(),
            wall_mm: band.wall.into(),
            break_even_percent,
            break_even,
            worse_percent: 100.0 * band.worse,
            left_out: LEFT_OUT,
        }
    }
}
