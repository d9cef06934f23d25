//! A chart as values: the input of a drawing, and its output besides the drawing.

use serde::{Deserialize, Serialize};

use super::over::Over;
use super::unit::Units;

/// Name, title and description of a chart.
#[derive(Clone, Copy, Debug)]
pub struct Caption<'a> {
    /// Stable name.
    pub name: &'a str,
    /// What it shows, as the heading above it.
    pub title: &'a str,
    /// One sentence with the extremes: the text alternative.
    pub description: &'a str,
}

/// One curve; the same index of `x` and `y` is one point. A value that is not finite leaves a gap.
#[derive(Clone, Copy, Debug)]
pub struct PlotSeries<'a> {
    /// Stable name, e.g. a column's key.
    pub key: &'a str,
    /// Text of the legend.
    pub label: &'a str,
    /// Its appearance: a class of the page's style sheet.
    pub class: &'static str,
    /// Values along the first axis.
    pub x: &'a [f64],
    /// Values along the second axis.
    pub y: &'a [f64],
    /// Whether every point gets a dot: for few points.
    pub markers: bool,
    /// Whether the range from the axis up to it is shaded: it bounds what can be.
    pub bound: bool,
}

/// Quantity, unit and range of an axis.
#[derive(Clone, Copy, Debug, Default)]
pub struct Axis<'a> {
    /// Quantity.
    pub label: &'a str,
    /// Unit as printed; empty for a pure number.
    pub unit: &'a str,
    /// Ends of the axis; taken from the data if none.
    pub range: Option<(f64, f64)>,
    /// Whether a range from the data includes zero.
    pub zero: bool,
    /// Whether the scale is logarithmic unless another is asked for.
    pub log: bool,
    /// Where a logarithmic scale ends at the bottom: nothing less is known. Smaller values are drawn
    /// there; without it, those that are not positive are left out.
    pub floor: Option<f64>,
    /// Whether ticks stand at whole numbers only: for counts.
    pub whole: bool,
}

impl Axis<'_> {
    /// As printed: the quantity, a comma, the unit.
    pub(super) fn text(&self) -> String {
        if self.unit.is_empty() { self.label.into() } else { format!("{}, {}", self.label, self.unit) }
    }
}

/// How the second axis is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Scaling {
    /// In even steps.
    Linear,
    /// By decades, where no value can be negative.
    Log,
    /// By decades if all curves but the highest would otherwise lie on the axis: if they peak below a
    /// tenth of it.
    Auto,
}

/// Options of the page.
#[derive(Clone, Debug)]
pub struct ChartOptions {
    /// Width of the whole chart [px].
    pub width: f64,
    /// Height of the whole chart [px].
    pub height: f64,
    /// The part of the first axis to show: zoom.
    pub x_range: Option<(f64, f64)>,
    /// The part of the second axis to show: zoom.
    pub y_range: Option<(f64, f64)>,
    /// Keys of the series that are not drawn; the legend still has them.
    pub hidden: Vec<String>,
    /// Units of the axes.
    pub units: Units,
    /// Scale of the second axis; the chart's own if none.
    pub scaling: Option<Scaling>,
    /// First axis of a chart over the run.
    pub over: Over,
}

impl ChartOptions {
    /// The whole chart at this size over time, in mm and N.
    pub fn sized(width: f64, height: f64) -> Self {
        Self {
            width,
            height,
            x_range: None,
            y_range: None,
            hidden: Vec::new(),
            units: Units::default(),
            scaling: None,
            over: Over::Time,
        }
    }

    pub(super) fn shows(&self, key: &str) -> bool {
        !self.hidden.iter().any(|hidden| hidden == key)
    }
}

/// A range of y drawn behind the curves, such as a tolerance.
#[derive(Clone, Copy, Debug)]
pub struct Band {
    /// Lower end, in units of y.
    pub from: f64,
    /// Upper end, in units of y.
    pub to: f64,
    /// Its name.
    pub label: &'static str,
}

/// Curves over two axes, before their scales are settled.
#[derive(Clone, Copy, Debug)]
pub struct LinePlot<'a> {
    /// Its name, title and description.
    pub caption: Caption<'a>,
    /// The axis from left to right.
    pub x: Axis<'a>,
    /// The axis from bottom to top.
    pub y: Axis<'a>,
    /// The curves.
    pub series: &'a [PlotSeries<'a>],
    /// Ranges of y behind them.
    pub bands: &'a [Band],
}

/// A drawn chart, with what a page needs to add a legend, a cursor and zoom.
#[derive(Clone, Debug, Serialize)]
pub struct Chart {
    /// Stable name.
    pub name: String,
    /// What it shows.
    pub title: String,
    /// One sentence with the extremes: the text alternative.
    pub description: String,
    /// The drawing: one `svg` element.
    pub svg: String,
    /// Width of the drawing [SVG units].
    pub width: f64,
    /// Height of the drawing [SVG units].
    pub height: f64,
    /// Where the data is.
    pub plot: PlotArea,
    /// Values from left to right of the plot area.
    pub x: AxisInfo,
    /// Values from bottom to top of the plot area.
    pub y: AxisInfo,
    /// The legend.
    pub series: Vec<Legend>,
    /// Unit vectors of a picture of space, to its right and up; its axes count along them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<[[f64; 3]; 2]>,
}

/// The part of a chart between its axes [SVG units].
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PlotArea {
    /// From the left side of the drawing.
    pub left: f64,
    /// From the top of the drawing.
    pub top: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
}

/// An axis as drawn.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AxisInfo {
    /// Quantity.
    pub label: String,
    /// Unit as printed.
    pub unit: String,
    /// Value at the beginning.
    pub min: f64,
    /// Value at the end.
    pub max: f64,
    /// Whether the scale between them is logarithmic.
    pub log: bool,
    /// What smaller values count as on a logarithmic scale; none where there cannot be one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub floor: Option<f64>,
    /// Both ends where nothing is zoomed.
    pub full: (f64, f64),
}

/// A line of the legend.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Legend {
    /// Stable name: `data-key` of the series' group in the drawing.
    pub key: String,
    /// Text of the legend.
    pub label: String,
    /// Class of the series' group in the drawing.
    pub class: String,
}
