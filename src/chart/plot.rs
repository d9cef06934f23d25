//! Charts over two axes: curves, steps, marked points.

use serde::Serialize;

use super::frame::{BOTTOM, Frame, TOP, size};
use super::scale::{Scale, extent, widened};
use super::trace::Window;
use super::unit::Units;
use crate::math;

/// What a chart is called.
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
pub struct Series<'a> {
    /// Stable name, e.g. a column's key.
    pub key: &'a str,
    /// What the legend says.
    pub label: &'a str,
    /// How it looks: a class of the page's style sheet.
    pub class: &'static str,
    /// Values along the first axis.
    pub x: &'a [f64],
    /// Values along the second axis.
    pub y: &'a [f64],
    /// Whether every point gets a dot: for few points.
    pub markers: bool,
}

/// What an axis shows.
#[derive(Clone, Copy, Debug, Default)]
pub struct Axis<'a> {
    /// Quantity.
    pub label: &'a str,
    /// Unit as printed; empty for a pure number.
    pub unit: &'a str,
    /// Ends of the axis; from the data if none.
    pub range: Option<(f64, f64)>,
    /// Whether a range from the data includes zero.
    pub zero: bool,
    /// Whether the scale is logarithmic; values that are not positive are then left out.
    pub log: bool,
    /// Whether ticks stand at whole numbers only: for counts.
    pub whole: bool,
}

impl Axis<'_> {
    /// As printed: the quantity, a comma, the unit.
    pub(super) fn text(&self) -> String {
        if self.unit.is_empty() { self.label.into() } else { format!("{}, {}", self.label, self.unit) }
    }
}

/// What the page asks for.
#[derive(Clone, Debug)]
pub struct Options {
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
}

impl Options {
    /// The whole chart in this size, in mm and N.
    pub fn sized(width: f64, height: f64) -> Self {
        Self { width, height, x_range: None, y_range: None, hidden: Vec::new(), units: Units::default() }
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
    /// What it is.
    pub label: &'static str,
}

/// A drawn chart and what a page needs to put a legend, a cursor and zoom over it.
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

impl PlotArea {
    pub(super) fn window(&self) -> Window {
        Window {
            left: self.left,
            top: self.top,
            right: self.left + self.width,
            bottom: self.top + self.height,
        }
    }
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
    /// Both ends where nothing is zoomed.
    pub full: (f64, f64),
}

/// A line of the legend.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Legend {
    /// Stable name: `data-key` of the series' group in the drawing.
    pub key: String,
    /// What the legend says.
    pub label: String,
    /// Class of the series' group in the drawing.
    pub class: String,
}

/// Curves over x with bands behind them. Zooming in x alone fits y to what is seen.
///
/// # Errors
/// A sentence if the size, a range or the length of a series makes no chart.
pub fn line_chart(
    caption: Caption,
    x: Axis,
    y: Axis,
    series: &[Series],
    bands: &[Band],
    options: &Options,
) -> Result<Chart, String> {
    let (width, height) = size(options)?;
    check_lengths(series)?;
    let full_x = match x.range {
        Some(range) => valid(&x, range)?,
        None => fitted(&x, series.iter().flat_map(|s| s.x.iter().copied()), 0.0),
    };
    let x_range = options.x_range.map_or(Ok(full_x), |range| valid(&x, range))?;
    let full_y = match y.range {
        Some(range) => valid(&y, range)?,
        None => {
            let seen = |x: f64| (x_range.0..=x_range.1).contains(&x);
            let shown = series.iter().filter(|s| options.shows(s.key));
            let values = shown.flat_map(|s| s.x.iter().zip(s.y));
            let values: Vec<f64> = values.filter(|(x, _)| seen(**x)).map(|(_, y)| *y).collect();
            fitted(&y, with_bands(&y, values, bands), 0.05)
        }
    };
    let y_range = options.y_range.map_or(Ok(full_y), |range| valid(&y, range))?;
    let plot_height = f64::from(height) - TOP - BOTTOM;
    let y_scale = Scale::new(y_range, y.log).with_ticks(((plot_height / 36.0) as usize).clamp(2, 9), y.whole);
    let left = (y_scale.label_width() + 12.0).ceil();
    let x_scale =
        |right: f64| Scale::new(x_range, x.log).with_ticks_across(f64::from(width) - left - right, x.whole);
    let right = (x_scale(12.0).label_width() / 2.0 + 2.0).max(12.0).ceil();
    let plot = PlotArea { left, top: TOP, width: f64::from(width) - left - right, height: plot_height };
    let frame = Frame { width, height, plot, x: x_scale(right), y: y_scale, full: [full_x, full_y] };
    frame.draw(caption, &x, &y, series, bands, options)
}

/// A range that somebody asked for.
pub(super) fn valid(axis: &Axis, (min, max): (f64, f64)) -> Result<(f64, f64), String> {
    let drawable = min.is_finite() && max.is_finite() && widened((min, max)) == (min, max);
    if drawable && min < max && (!axis.log || min > 0.0) {
        Ok((min, max))
    } else {
        Err(format!("The axis \"{}\" cannot run from {min} to {max}.", axis.label))
    }
}

fn check_lengths(series: &[Series]) -> Result<(), String> {
    match series.iter().find(|s| s.x.len() != s.y.len()) {
        Some(s) => Err(format!("Series {} has {} x but {} y.", s.key, s.x.len(), s.y.len())),
        None => Ok(()),
    }
}

/// The range that shows these values, with some headroom as a share of it; whole decades if logarithmic.
fn fitted(axis: &Axis, values: impl IntoIterator<Item = f64>, headroom: f64) -> (f64, f64) {
    let found = extent(values, axis.log);
    if axis.log {
        let (min, max) = found.unwrap_or((1.0, 1.0));
        let (low, high) = (math::log10(min).floor(), math::log10(max).ceil());
        return (math::pow(10.0, low), math::pow(10.0, if high > low { high } else { low + 1.0 }));
    }
    let (mut min, mut max) = found.unwrap_or((0.0, 1.0));
    if axis.zero {
        (min, max) = (min.min(0.0), max.max(0.0));
    }
    let wide = widened((min, max));
    if axis.zero && wide != (min, max) {
        return (0.0, 1.0);
    }
    let room = headroom * (wide.1 - wide.0);
    let keep = |end: f64, moved: f64| if axis.zero && end == 0.0 { end } else { moved };
    (keep(wide.0, wide.0 - room), keep(wide.1, wide.1 + room))
}

/// The values and the bands' ends, but no band so far away that the curves would lie flat.
fn with_bands(axis: &Axis, mut values: Vec<f64>, bands: &[Band]) -> Vec<f64> {
    let data = extent(values.iter().copied(), axis.log);
    let near = |end: f64| match data {
        Some((min, max)) if !axis.log => end.abs() <= 4.0 * min.abs().max(max.abs()),
        _ => true,
    };
    values.extend(bands.iter().flat_map(|band| [band.from, band.to]).filter(|&end| near(end)));
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::ForceUnit;
    use crate::path::unit::LengthUnit;

    const CAPTION: Caption = Caption { name: "n", title: "t", description: "d" };
    const OPTIONS: Options = Options {
        width: 860.0,
        height: 420.0,
        x_range: None,
        y_range: None,
        hidden: Vec::new(),
        units: Units { length: LengthUnit::Mm, force: ForceUnit::Newton },
    };
    const TIME: Axis = Axis { label: "Time", unit: "s", range: None, zero: false, log: false, whole: false };
    const ERROR: Axis = Axis { label: "Contour error", unit: "mm", zero: true, ..TIME };

    fn series<'a>(x: &'a [f64], y: &'a [f64]) -> Series<'a> {
        Series { key: "e", label: "E", class: "before", x, y, markers: false }
    }

    fn line(x: &[f64], y: &[f64], options: &Options) -> Chart {
        line_chart(CAPTION, TIME, ERROR, &[series(x, y)], &[], options).unwrap()
    }

    #[test]
    fn the_drawing_is_plain_and_repeatable() {
        let x: Vec<f64> = (0..1000).map(f64::from).collect();
        let y: Vec<f64> = x.iter().map(|x| x * x % 17.0).collect();
        let chart = line(&x, &y, &OPTIONS);
        assert_eq!(chart.svg, line(&x, &y, &OPTIONS).svg);
        assert!(!chart.svg.contains("style="), "inline style breaks the page's security policy");
        assert!(chart.svg.contains(r#"<g class="series before" data-key="e""#));
        assert!(chart.svg.contains(">Contour error, mm</text>") && chart.svg.contains(">Time, s</text>"));
    }

    #[test]
    fn labels_are_text_not_markup() {
        let axis = Axis { label: "<script>", ..TIME };
        let chart =
            line_chart(CAPTION, axis, axis, &[series(&[0.0, 1.0], &[0.0, 1.0])], &[], &OPTIONS).unwrap();
        assert!(!chart.svg.contains("<script>"));
    }

    #[test]
    fn degenerate_data_makes_a_sane_chart() {
        let constant = line(&[0.0, 1.0, 2.0], &[5.0; 3], &OPTIONS);
        assert!(constant.y.min == 0.0 && constant.y.max > 5.0);
        assert_eq!((line(&[], &[], &OPTIONS).y.min, line(&[0.0], &[0.0], &OPTIONS).y.max), (0.0, 1.0));
        assert!(line(&[3.0], &[2.0], &OPTIONS).svg.contains("<circle"));
        let gap = line(&[0.0, 1.0, 2.0, 3.0, 4.0], &[1.0, 2.0, f64::NAN, 1.0, 2.0], &OPTIONS);
        let drawn = gap.svg.split("data-key").nth(1).unwrap().split("</g>").next().unwrap();
        assert_eq!(drawn.matches("<polyline").count(), 2);
        assert!(!gap.svg.contains("NaN"));
    }

    #[test]
    fn data_stands_where_the_plot_area_says() {
        let chart = line(&[0.0, 1.0], &[0.0, 1.0], &Options { y_range: Some((0.0, 1.0)), ..OPTIONS });
        let PlotArea { left, top, width, height } = chart.plot;
        let diagonal = format!(r#"points="{left},{} {},{top}""#, top + height, left + width);
        assert!(chart.svg.contains(&diagonal), "{diagonal} is not in {}", chart.svg);
    }

    #[test]
    fn zoom_in_x_fits_y_to_what_is_seen() {
        let x = [0.0, 1.0, 2.0, 3.0];
        let chart = line(&x, &[0.0, 1.0, 2.0, 100.0], &Options { x_range: Some((0.0, 2.0)), ..OPTIONS });
        assert_eq!((chart.x.min, chart.x.max), (0.0, 2.0));
        assert!(chart.y.max < 3.0, "{}", chart.y.max);
    }

    #[test]
    fn a_near_band_is_shown_whole_and_a_far_one_does_not_flatten_the_curve() {
        let shown = |to: f64| {
            let bands = [Band { from: 0.0, to, label: "tolerance" }];
            line_chart(CAPTION, TIME, ERROR, &[series(&[0.0, 1.0], &[0.0, 1.0])], &bands, &OPTIONS)
                .unwrap()
                .y
                .max
        };
        assert!(shown(2.0) > 2.0 && shown(100.0) < 2.0);
    }

    #[test]
    fn logarithmic_ranges_are_whole_decades() {
        let y = Axis { log: true, ..ERROR };
        let points = Series { markers: true, ..series(&[0.0, 1.0, 2.0], &[1.3, 0.0, 0.004]) };
        let chart = line_chart(CAPTION, TIME, y, &[points], &[], &OPTIONS).unwrap();
        assert_eq!((chart.y.min, chart.y.max, chart.y.log), (1e-3, 10.0, true));
        assert!(!chart.svg.contains("NaN"));
    }

    #[test]
    fn a_hidden_series_is_in_the_legend_only_and_leaves_its_room() {
        let (x, low, high) = ([0.0, 1.0], [0.0, 0.5], [0.0, 50.0]);
        let both = [series(&x, &low), Series { key: "high", ..series(&x, &high) }];
        let options = Options { hidden: vec!["high".into()], ..Options::sized(860.0, 420.0) };
        let chart = line_chart(CAPTION, TIME, ERROR, &both, &[], &options).unwrap();
        assert!(chart.y.max < 1.0 && !chart.svg.contains(r#"data-key="high""#));
        assert_eq!(chart.series.len(), 2);
        assert_eq!(chart.x.full, (0.0, 1.0));
    }

    #[test]
    fn what_cannot_be_drawn_is_an_error() {
        let x = [0.0, 1.0];
        let draw =
            |series: Series, options: Options| line_chart(CAPTION, TIME, TIME, &[series], &[], &options);
        assert!(draw(series(&x, &x[..1]), OPTIONS).is_err());
        assert!(draw(series(&x, &x), Options { width: f64::NAN, ..OPTIONS }).is_err());
        assert!(draw(series(&x, &x), Options { x_range: Some((2.0, 1.0)), ..OPTIONS }).is_err());
    }
}
