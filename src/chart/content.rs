//! The content of a chart before it is drawn: the same values become a drawing or columns.

use nalgebra::Vector3;

use crate::chart::chart::{Axis, Band, Caption, Chart, ChartOptions, LinePlot, PlotSeries, Scaling};
use crate::chart::plot::line_chart;
use crate::chart::space::{SpaceSeries, View, space_chart};
use crate::column::Column;
use crate::error::Error;
use crate::path::unit::LengthUnit;

/// The values of one chart and their description.
pub(super) struct Content {
    /// One sentence with the extremes: the text alternative.
    pub(super) description: String,
    /// Values along the first axis; in space, the time of each point.
    pub(super) at: Vec<f64>,
    pub(super) shape: Shape,
}

pub(super) enum Shape {
    /// Over two axes.
    Curves { x: Axis<'static>, y: Axis<'static>, curves: Vec<Curve>, markers: bool, bands: Vec<Band> },
    /// In the three of the base frame.
    Paths { unit: LengthUnit, paths: Vec<SpacePath> },
}

/// One curve: a value for each of the content's [`Content::at`].
pub(super) struct Curve {
    pub(super) key: &'static str,
    pub(super) label: &'static str,
    pub(super) class: &'static str,
    pub(super) values: Vec<f64>,
}

/// One path, in the displayed unit.
pub(super) struct SpacePath {
    pub(super) key: &'static str,
    pub(super) label: String,
    pub(super) class: &'static str,
    pub(super) points: Vec<[f64; 3]>,
}

/// Class of a curve that bounds what can be.
pub(super) const BOUND: &str = "p95";

pub(super) const TIME: Axis<'static> =
    Axis { label: "Time", unit: "s", range: None, zero: false, log: false, floor: None, whole: false };

impl Content {
    pub(super) fn draw(&self, name: &str, title: &str, options: &ChartOptions) -> Result<Chart, Error> {
        if options.scaling == Some(Scaling::Log) && !self.has_decades() {
            let expected =
                format!("\"linear\" or \"auto\", for the values of the chart \"{name}\" may be negative");
            return Err(Error::invalid("scale", "\"log\"", expected));
        }
        let caption = Caption { name, title, description: &self.description };
        let drawn = match &self.shape {
            Shape::Curves { x, y, curves, markers, bands } => {
                let series: Vec<_> = curves
                    .iter()
                    .map(|&Curve { key, label, class, ref values }| PlotSeries {
                        key,
                        label,
                        class,
                        x: &self.at,
                        y: values,
                        markers: *markers,
                        bound: class == BOUND,
                    })
                    .collect();
                line_chart(&LinePlot { caption, x: *x, y: *y, series: &series, bands }, options)
            }
            Shape::Paths { paths, .. } => {
                let paths: Vec<_> = paths
                    .iter()
                    .map(|SpacePath { key, label, class, points }| SpaceSeries { key, label, class, points })
                    .collect();
                space_chart(caption, &paths, View::default(), options)
            }
        };
        drawn.map_err(|expected| Error::invalid("chart", format!("\"{name}\""), expected))
    }

    /// Whether its values may stand on a logarithmic scale.
    fn has_decades(&self) -> bool {
        match &self.shape {
            Shape::Curves { y, .. } => y.log || y.floor.is_some(),
            Shape::Paths { .. } => false,
        }
    }

    /// All samples: the values along the first axis, then each series; a path is three columns.
    pub(super) fn columns(self) -> Vec<Column> {
        match self.shape {
            Shape::Curves { x, y, curves, .. } => {
                let first = column(x.label, x.label, x.unit, self.at);
                let rest =
                    curves.into_iter().map(|curve| column(curve.key, curve.label, y.unit, curve.values));
                std::iter::once(first).chain(rest).collect()
            }
            Shape::Paths { unit, paths } => {
                let first = column(TIME.label, TIME.label, TIME.unit, self.at);
                let rest = paths.iter().flat_map(|path| {
                    [0, 1, 2].map(|axis| {
                        let name = ["x", "y", "z"][axis];
                        let values = path.points.iter().map(|point| point[axis]).collect();
                        let (key, label) = (format!("{} {name}", path.key), format!("{} {name}", path.label));
                        column(&key, &label, unit.name(), values)
                    })
                });
                std::iter::once(first).chain(rest).collect()
            }
        }
    }
}

/// A column whose key includes the unit.
fn column(key: &str, label: &str, unit: &'static str, values: Vec<f64>) -> Column {
    let spelled = if unit == "%" { "percent" } else { unit };
    let text = format!("{key} {spelled}").to_ascii_lowercase();
    let words: Vec<_> = text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    Column::new(words.join("_"), label, unit, values)
}

/// Points in the displayed unit.
pub(super) fn points(positions: &[Vector3<f64>], unit: f64) -> Vec<[f64; 3]> {
    positions.iter().map(|p| (p / unit).into()).collect()
}
