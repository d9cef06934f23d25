//! Charts of a loop on top of the path, for jobs with one.

use crate::chart::chart::Axis;
use crate::chart::content::{Content, Curve, Shape};
use crate::chart::figures::{Figures, digits};
use crate::error::Error;
use crate::online::{Comparison, OnlineLoop};
use crate::uncertainty::Quantiles;

/// Shown only if the job has a loop.
pub(super) const SPECTRUM: &str = "loop-spectrum";
/// Shown only if the job has a loop.
pub(super) const DELAY: &str = "loop-delay";
/// Dead times that are compared.
const DELAYS: usize = 11;
/// The longest of them is at least this [s].
const LONGEST: f64 = 0.2;

impl Figures<'_> {
    fn looped(&self, name: &str) -> Result<&(OnlineLoop, Comparison), Error> {
        let expected = "a chart of jobs in which a sensor measures (`online.measures`)";
        self.report.online.as_ref().ok_or_else(|| Error::invalid("chart", format!("\"{name}\""), expected))
    }

    /// How fast the error changes, how much of it the loop leaves at each frequency, and what that makes.
    pub(super) fn loop_spectrum(&self) -> Result<Content, Error> {
        let (online, compared) = self.looped(SPECTRUM)?;
        let spectrum = self.report.looped().spectrum(online)?;
        let whole = spectrum.amplitude.iter().map(|v| v * v).sum::<f64>().sqrt();
        let share = |v: f64| if whole > 0.0 { 100.0 * v / whole } else { 0.0 };
        let error: Vec<f64> = spectrum.amplitude.iter().map(|v| share(*v)).collect();
        let rest = error.iter().zip(&spectrum.left).map(|(error, left)| error * left).collect();
        let left = spectrum.left.iter().map(|left| 100.0 * left).collect();
        let description = compared.summary().verdict;
        let curves = vec![
            Curve { key: "error", label: "Error without the loop", class: "before", values: error },
            Curve { key: "rest", label: "Error with the loop", class: "after", values: rest },
            Curve { key: "left", label: "Left of each frequency, |S|", class: "s3", values: left },
        ];
        let x = Axis { label: "Frequency", unit: "Hz", log: true, ..Axis::default() };
        let y = Axis {
            label: "Share of the whole error",
            unit: "%",
            log: true,
            floor: Some(0.1),
            ..Axis::default()
        };
        let shape = Shape::Curves { x, y, curves, markers: false, bands: vec![] };
        Ok(Content { description, at: spectrum.frequency, shape })
    }

    /// The largest error at 95 % over the loop's dead time.
    pub(super) fn loop_delay(&self) -> Result<Content, Error> {
        let (online, _) = self.looped(DELAY)?;
        let longest = LONGEST.max(2.0 * online.times.dead_time);
        let at: Vec<f64> = (0..DELAYS).map(|k| longest * k as f64 / (DELAYS - 1) as f64).collect();
        let compared = self.report.looped().by_dead_time(online, &at)?;
        let (size, unit) = (self.units.length.in_m(), self.units.length.name());
        let over = |of: fn(&Comparison) -> Option<Quantiles>| -> Vec<f64> {
            compared.iter().map(|row| of(row).map_or(f64::NAN, |left| left.p95 / size)).collect()
        };
        let curves = vec![
            Curve {
                key: "nothing",
                label: "Nothing corrects",
                class: "before",
                values: over(|row| Some(row.without)),
            },
            Curve {
                key: "corrected",
                label: "Corrected commands",
                class: "after",
                values: over(|row| Some(row.offline)),
            },
            Curve { key: "loop", label: "The loop", class: "s4", values: over(|row| row.online) },
            Curve { key: "both", label: "Both", class: "s3", values: over(|row| row.both) },
        ];
        let both = |row: &Comparison| row.both.map(|both| self.read(both.p95));
        let ends = compared.first().and_then(both).zip(compared.last().and_then(both));
        let description = match ends {
            Some((first, last)) => format!(
                "Largest error at 95 % with corrected commands and the loop: {first} {unit} without dead time, {last} {unit} with {} s.",
                digits(longest)
            ),
            None => "The loop is not stable at every dead time.".to_owned(),
        };
        let x = Axis { label: "Dead time", unit: "s", zero: true, ..Axis::default() };
        let y = Axis { label: "Largest error at 95 %", unit, zero: true, ..Axis::default() };
        let (_, bands) = self.tolerance();
        Ok(Content { description, at, shape: Shape::Curves { x, y, curves, markers: true, bands } })
    }
}
