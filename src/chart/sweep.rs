//! Chart of a study: the error over one number of the job, with its band and the tolerance.

use crate::chart::chart::{Axis, Band, Caption, Chart, ChartOptions, LinePlot, PlotSeries};
use crate::chart::plot::line_chart;
use crate::chart::unit::Units;
use crate::column::Column;
use crate::error::Error;
use crate::report::decapitalised;
use crate::study::Outcome;
use crate::units::MM;

/// What a series is of a run [mm].
type OfRun = fn(&Outcome) -> Option<f64>;
/// Series: key, label, class, whether it bounds a band, and what it is of a run.
const SERIES: [(&str, &str, &str, bool, OfRun); 4] = [
    ("before", "Before compensation", "before", false, |run| run.before_max_mm),
    ("p95", "After it, 95 of 100", "p95", true, |run| run.p95_mm),
    ("p50", "After it, half of the cases", "after", false, |run| run.p50_mm),
    ("nominal", "After it, if every number is exact", "shaping", false, |run| run.after_max_mm),
];

/// Errors over one number.
#[derive(Debug, Clone)]
pub struct SweepCurves {
    /// What the number is called.
    pub label: String,
    /// Its unit as printed; empty for a pure number.
    pub unit: String,
    /// The value that it has in the job.
    pub now: Option<f64>,
    /// The job's tolerance [mm].
    pub tolerance_mm: f64,
    /// The values, rising.
    pub values: Vec<f64>,
    /// What the run at each of them says.
    pub outcomes: Vec<Outcome>,
}

impl SweepCurves {
    /// Draws them.
    ///
    /// # Errors
    /// [`Error::Invalid`] for options that cannot be drawn, and for fewer than two runs.
    pub fn chart(&self, options: &ChartOptions) -> Result<Chart, Error> {
        let x = &self.values;
        if x.len() < 2 {
            return Err(Error::invalid("rows", x.len(), "at least two values"));
        }
        let curves = self.curves(options.units);
        let size = options.units.length.in_m() / MM;
        let tolerance = self.tolerance_mm / size;
        let top =
            curves.iter().flatten().copied().filter(|value| value.is_finite()).fold(tolerance, f64::max);
        let now = self.now.map_or_else(Vec::new, |now| vec![now, now]);
        let upright = if now.is_empty() { vec![] } else { vec![0.0, top] };
        let mut series: Vec<PlotSeries> = SERIES
            .iter()
            .zip(&curves)
            .map(|(&(key, label, class, bound, _), y)| PlotSeries {
                key,
                label,
                class,
                x,
                y,
                markers: !bound && x.len() < 60,
                bound,
            })
            .collect();
        if !now.is_empty() {
            let label = "As the job is";
            series.push(PlotSeries {
                key: "now",
                label,
                class: "desired",
                x: &now,
                y: &upright,
                markers: false,
                bound: false,
            });
        }
        let description = self.description(options.units, &curves[1]);
        let title = format!("Largest contour error by {}", decapitalised(&self.label));
        let caption = Caption { name: "sweep", title: &title, description: &description };
        let ends = (x[0].min(x[x.len() - 1]), x[0].max(x[x.len() - 1]));
        let plot = LinePlot {
            caption,
            x: Axis {
                label: &self.label,
                unit: &self.unit,
                range: (ends.0 < ends.1).then_some(ends),
                ..Axis::default()
            },
            y: Axis {
                label: "Largest contour error",
                unit: options.units.length.name(),
                zero: true,
                floor: Some(1e-4 / size),
                ..Axis::default()
            },
            series: &series,
            bands: &[Band { from: 0.0, to: tolerance, label: "tolerance" }],
        };
        line_chart(&plot, options).map_err(|expected| Error::invalid("chart", "\"sweep\"", expected))
    }

    /// The values drawn.
    pub fn data(&self, units: Units) -> Vec<Column> {
        let values = self.values.clone();
        // What the number is in is its field's own.
        let first = Column::new("value", self.label.clone(), "", values);
        let unit = units.length.name();
        let rest = SERIES
            .iter()
            .zip(self.curves(units))
            .map(|(&(key, label, ..), values)| Column::new(format!("{key}_{unit}"), label, unit, values));
        std::iter::once(first).chain(rest).collect()
    }

    /// The series in a unit of length; NaN where a run has no result.
    fn curves(&self, units: Units) -> [Vec<f64>; 4] {
        let size = units.length.in_m() / MM;
        SERIES.map(|(_, _, _, _, of)| {
            self.outcomes.iter().map(|run| of(run).map_or(f64::NAN, |v| v / size)).collect()
        })
    }

    fn description(&self, units: Units, p95: &[f64]) -> String {
        let known = || self.values.iter().zip(p95).filter(|(_, error)| error.is_finite());
        let least = known().min_by(|a, b| a.1.total_cmp(b.1));
        let most = known().max_by(|a, b| a.1.total_cmp(b.1));
        let (Some(least), Some(most)) = (least, most) else { return String::from("No value has a result.") };
        let (length, unit) = (units.length.name(), self.unit.as_str());
        let at = |(value, error): (&f64, &f64)| {
            let value = (value * 1e4).round() / 1e4;
            format!("{error:.3} {length} at {}", format!("{value} {unit}").trim_end())
        };
        format!("In 95 of 100 cases at most {}, and {}.", at(least), at(most))
    }
}
