//! Chart of a measured pass over what the model expects of it.

use crate::chart::chart::{Axis, Chart, ChartOptions};
use crate::chart::content::{Content, Curve, Shape};
use crate::chart::unit::Units;
use crate::column::Column;
use crate::error::Error;
use crate::learn::{MeasuredPass, NextPass};
use crate::report::{Report, length_text};
use nalgebra::Vector3;

/// A measured pass to draw.
#[derive(Debug, Clone, Copy)]
pub struct LearnedChart<'a> {
    /// The run.
    pub report: &'a Report,
    /// What was measured on it.
    pub measured: &'a MeasuredPass,
    /// The next pass, if there is one.
    pub next: Option<&'a NextPass>,
}

impl LearnedChart<'_> {
    /// Draws it.
    ///
    /// # Errors
    /// [`Error::Invalid`] for options that cannot be drawn.
    pub fn chart(&self, options: &ChartOptions) -> Result<Chart, Error> {
        let title = if self.measured.smooth.is_empty() {
            "Measured force over the planned one"
        } else {
            "Measured error over the expected one"
        };
        self.content(options.units).draw("learned", title, options)
    }

    /// The values drawn.
    pub fn data(&self, units: Units) -> Vec<Column> {
        self.content(units).columns()
    }

    fn content(&self, units: Units) -> Content {
        if self.measured.smooth.is_empty() { self.force(units) } else { self.errors(units) }
    }

    fn at(&self) -> (Vec<f64>, Axis<'static>) {
        let trajectory = &self.report.plan.trajectory;
        let times = (0..self.report.samples()).map(|k| k as f64 * trajectory.sample_time).collect();
        (times, Axis { label: "Time", unit: "s", ..Axis::default() })
    }

    fn errors(&self, units: Units) -> Content {
        let (size, unit) = (units.length.in_m(), units.length.name());
        let Self { report, measured, next } = self;
        let known = |k: usize, value: f64| if measured.smooth[k].is_some() { value / size } else { f64::NAN };
        let norms =
            |of: &dyn Fn(usize) -> f64| (0..report.samples()).map(|k| known(k, of(k))).collect::<Vec<f64>>();
        let mut left = next.map_or(&[] as &[Vector3<f64>], |next| &next.left).iter();
        let after: Vec<f64> = (0..report.samples())
            .map(|k| measured.smooth[k].and_then(|_| left.next()).map_or(f64::NAN, |left| left.norm() / size))
            .collect();
        let read = norms(&|k| measured.smooth[k].map_or(0.0, |error| error.norm()));
        let mut curves = vec![
            Curve { key: "measured", label: "Measured", class: "before", values: read.clone() },
            Curve {
                key: "expected",
                label: "Expected by the model",
                class: "s3",
                values: norms(&|k| measured.seen.part(k, &measured.expected[k]).norm()),
            },
        ];
        if measured.commanded.corrected && measured.commanded.learned.is_empty() {
            let band = norms(&|k| report.band.p95_at(k));
            curves.push(Curve { key: "p95", label: "95 %", class: "p95", values: band });
        }
        if next.is_some() {
            curves.push(Curve {
                key: "next",
                label: "Next pass, if it comes back",
                class: "after",
                values: after,
            });
        }
        let most = |values: &[f64]| values.iter().copied().filter(|v| v.is_finite()).fold(0.0, f64::max);
        let text = |value: f64| length_text(value * size, size, 4);
        let next_text = match next {
            Some(_) => format!(
                "; {} {unit} after the next pass, if it comes back",
                text(most(&curves[curves.len() - 1].values))
            ),
            None => String::new(),
        };
        let description = format!("Measured up to {} {unit}{next_text}.", text(most(&read)));
        let (at, x) = self.at();
        let y = Axis { label: "Error", unit, zero: true, ..Axis::default() };
        Content { description, at, shape: Shape::Curves { x, y, curves, markers: false, bands: vec![] } }
    }

    fn force(&self, units: Units) -> Content {
        let size = units.force.in_n();
        let measured = self.measured.force.iter();
        let values = measured.map(|force| force.map_or(f64::NAN, |force| force.norm() / size)).collect();
        let planned = self.report.force.iter().map(|force| force.norm() / size).collect();
        let curves = vec![
            Curve { key: "measured", label: "Measured", class: "before", values },
            Curve { key: "expected", label: "Expected by the model", class: "s3", values: planned },
        ];
        let (at, x) = self.at();
        let y = Axis { label: "Force", unit: units.force.name(), zero: true, ..Axis::default() };
        let description = "Force on the tool, through the low pass.".to_owned();
        Content { description, at, shape: Shape::Curves { x, y, curves, markers: false, bands: vec![] } }
    }
}
