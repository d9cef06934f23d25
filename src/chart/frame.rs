//! The frame round a plot: axes, ticks, grid and bands by plotters, and the curves inside.

use plotters::chart::{ChartBuilder, LabelAreaPosition};
use plotters::style::BLACK;
use plotters::style::text_anchor::{HPos, VPos};

use super::chart::{Axis, AxisInfo, Band, Chart, ChartOptions, Legend, LinePlot, PlotArea, PlotSeries};
use super::scale::{Scale, widened};
use super::svg::{Canvas, FONT_SIZE, Layer, TENTHS, text_width};
use super::trace::{SheetPoint, Window, lines};

/// Room above the plot area, for the name of the y axis [SVG units].
pub(super) const TOP: f64 = 26.0;
/// Room below, for ticks and the name of the x axis [SVG units].
pub(super) const BOTTOM: f64 = 42.0;
/// Length of a tick mark; plotters puts its label as far again from its end [SVG units].
const TICK: f64 = 4.0;
/// Length of a tick mark without a label [SVG units].
const MINOR_TICK: f64 = 3.0;
/// Places along a band at which its name may stand, besides the first.
const NAME_PLACES: u32 = 12;
/// Radius of the dot at a marked point [SVG units].
const DOT: f64 = 3.5;

/// The size as whole SVG units.
pub(super) fn size(options: &ChartOptions) -> Result<(u32, u32), String> {
    let whole = |name: &str, value: f64| {
        if (120.0..=8000.0).contains(&value) {
            Ok(value as u32)
        } else {
            Err(format!("A chart's {name} must be between 120 and 8000 px, not {value}."))
        }
    };
    Ok((whole("width", options.width)?, whole("height", options.height)?))
}

/// Checks a requested range.
pub(super) fn valid(axis: &Axis, (min, max): (f64, f64)) -> Result<(f64, f64), String> {
    let drawable = min.is_finite() && max.is_finite() && widened((min, max)) == (min, max);
    if drawable && min < max && (!axis.log || min > 0.0) {
        Ok((min, max))
    } else {
        Err(format!("The axis \"{}\" cannot run from {min} to {max}.", axis.label))
    }
}

/// The smallest ranges around these that fill the plot area with the same scale in both directions.
pub(super) fn equal_aspect(x: (f64, f64), y: (f64, f64), plot: &PlotArea) -> ((f64, f64), (f64, f64)) {
    let unit = ((x.1 - x.0) / plot.width).max((y.1 - y.0) / plot.height);
    let around = |range: (f64, f64), length: f64| {
        let (middle, half) = ((range.0 + range.1) / 2.0, unit * length / 2.0);
        (middle - half, middle + half)
    };
    (around(x, plot.width), around(y, plot.height))
}

/// The part of the canvas that shows data.
pub(super) fn window(area: &PlotArea) -> Window {
    let PlotArea { left, top, width, height } = *area;
    Window { left, top, right: left + width, bottom: top + height }
}

/// A chart with fixed size and scales.
pub(super) struct PlotFrame {
    /// Width of the chart [SVG units].
    pub(super) width: u32,
    /// Height of the chart [SVG units].
    pub(super) height: u32,
    /// Where the data goes.
    pub(super) area: PlotArea,
    /// From left to right.
    pub(super) x: Scale,
    /// From bottom to top.
    pub(super) y: Scale,
    /// Ends of both axes where nothing is zoomed.
    pub(super) full: [(f64, f64); 2],
}

impl PlotFrame {
    /// Draws bands, grid, curves and axes, in this order.
    pub(super) fn draw(&self, plot: &LinePlot, options: &ChartOptions) -> Result<Chart, String> {
        let LinePlot { caption, x, y, series, bands } = plot;
        let canvas = Canvas::new(self.width, self.height);
        for band in *bands {
            canvas.layer(Layer::Band, || self.band(&canvas, band))?;
        }
        canvas.layer(Layer::Grid, || self.mesh(&canvas, x, true))?;
        let shown = series.iter().filter(|one| options.shows(one.key));
        let drawn: Vec<_> = shown.map(|one| (one, self.lines(one))).collect();
        for (one, lines) in drawn.iter().filter(|(one, _)| one.bound) {
            canvas.layer(Layer::Bound { class: one.class }, || self.below(&canvas, lines))?;
        }
        for (one, lines) in &drawn {
            let layer = Layer::Series { class: one.class, key: one.key };
            canvas.layer(layer, || self.series(&canvas, one, lines))?;
        }
        let curves: Vec<&Vec<SheetPoint>> = drawn.iter().flat_map(|(_, lines)| lines).collect();
        canvas.layer(Layer::Axis, || {
            self.mesh(&canvas, x, false)?;
            self.minor_ticks(&canvas)?;
            bands.iter().try_for_each(|band| self.band_name(&canvas, band, &curves))?;
            canvas.text(&y.text(), (0.0, 2.0), HPos::Left, VPos::Top)
        })?;
        let legend =
            |s: &PlotSeries| Legend { key: s.key.into(), label: s.label.into(), class: s.class.into() };
        Ok(Chart {
            name: caption.name.into(),
            title: caption.title.into(),
            description: caption.description.into(),
            svg: canvas.finish(caption.title, caption.description),
            width: f64::from(self.width),
            height: f64::from(self.height),
            plot: self.area,
            x: info(x, &self.x, self.full[0]),
            y: info(y, &self.y, self.full[1]),
            series: series.iter().map(legend).collect(),
            camera: None,
        })
    }

    /// Position of a pair of values on the canvas; NaN where a scale has no place for it.
    pub(super) fn place(&self, x: f64, y: f64) -> SheetPoint {
        let PlotArea { left, top, width, height } = self.area;
        (left + width * self.x.position(x), top + height * (1.0 - self.y.position(y)))
    }

    /// Draws plotters' mesh: either the grid alone, or the axes with ticks and the name of x.
    pub(super) fn mesh(&self, canvas: &Canvas, x: &Axis, grid: bool) -> Result<(), String> {
        let PlotArea { left, top, width, height } = self.area;
        let pixels = |units: f64| (units * TENTHS).round() as u32;
        let mut chart = ChartBuilder::on(&canvas.area)
            .margin_top(pixels(top))
            .margin_right(pixels(f64::from(self.width) - left - width))
            .set_label_area_size(LabelAreaPosition::Left, pixels(left))
            .set_label_area_size(LabelAreaPosition::Bottom, pixels(f64::from(self.height) - top - height))
            .build_cartesian_2d(self.x.clone(), self.y.clone())
            .map_err(|e| e.to_string())?;
        let mut mesh = chart.configure_mesh();
        mesh.bold_line_style(BLACK).label_style(canvas.text.clone());
        mesh.set_all_tick_mark_size(TICK * TENTHS);
        if grid {
            mesh.disable_axes().disable_x_mesh();
        } else {
            mesh.disable_mesh().axis_style(BLACK).x_desc(x.text());
        }
        mesh.draw().map_err(|e| e.to_string())
    }

    /// Short ticks between the decades of y, which show that its steps are not even.
    fn minor_ticks(&self, canvas: &Canvas) -> Result<(), String> {
        let left = self.area.left;
        self.y.minor_ticks().into_iter().try_for_each(|value| {
            let y = self.place(self.x.min, value).1;
            canvas.line(&[(left - MINOR_TICK, y), (left, y)])
        })
    }

    /// The part of the plot that a band covers, as its upper and lower edge: at least one unit
    /// high.
    fn covered(&self, band: &Band) -> Option<(f64, f64)> {
        let Window { top, bottom, .. } = window(&self.area);
        let (from, to) = (band.from.min(band.to), band.from.max(band.to));
        let edge = |value: f64| {
            let y = self.place(self.x.min, value).1;
            if y.is_nan() { bottom } else { y.clamp(top, bottom) }
        };
        (from <= self.y.max && to >= self.y.min).then(|| (edge(to).min(edge(from) - 1.0), edge(from)))
    }

    fn band(&self, canvas: &Canvas, band: &Band) -> Result<(), String> {
        let Window { left, right, .. } = window(&self.area);
        self.covered(band).map_or(Ok(()), |(high, low)| canvas.rectangle((left, high), (right, low)))
    }

    /// A band's name, inside if the band is high enough, otherwise above it: as far left as no curve
    /// runs through it, or where the fewest do.
    fn band_name(&self, canvas: &Canvas, band: &Band, curves: &[&Vec<SheetPoint>]) -> Result<(), String> {
        let Some((high, low)) = self.covered(band) else { return Ok(()) };
        let inside = low - high > 1.5 * FONT_SIZE;
        let (anchor, gap) = if inside { (VPos::Top, 4.0) } else { (VPos::Bottom, -1.0) };
        let top = if inside { high + gap } else { high + gap - FONT_SIZE };
        let (width, first) = (text_width(band.label), self.area.left + 6.0);
        let step = (self.area.width - width - 12.0).max(0.0) / f64::from(NAME_PLACES);
        let crossed = |left: f64| -> usize {
            let label = Window { left, top, right: left + width, bottom: top + FONT_SIZE };
            curves.iter().map(|line| label.pieces(line)).sum()
        };
        let places = (0..=NAME_PLACES).map(|k| (first + f64::from(k) * step).round());
        let left = places.min_by_key(|&left| crossed(left)).unwrap_or(first);
        canvas.text(band.label, (left, high + gap), HPos::Left, anchor)
    }

    /// Fills what lies between curves and the axis.
    fn below(&self, canvas: &Canvas, lines: &[Vec<SheetPoint>]) -> Result<(), String> {
        let bottom = window(&self.area).bottom;
        lines.iter().try_for_each(|line| {
            let ends = [line.last(), line.first()].into_iter().flatten();
            let feet = ends.map(|&(x, _)| (x, bottom));
            canvas.polygon(&line.iter().copied().chain(feet).collect::<Vec<_>>())
        })
    }

    /// The curve as it is drawn.
    fn lines(&self, series: &PlotSeries) -> Vec<Vec<SheetPoint>> {
        let points = series.x.iter().zip(series.y).map(|(&x, &y)| self.place(x, y));
        lines(points, window(&self.area))
    }

    fn series(&self, canvas: &Canvas, series: &PlotSeries, lines: &[Vec<SheetPoint>]) -> Result<(), String> {
        lines.iter().try_for_each(|line| canvas.line(line))?;
        if series.markers {
            let window = window(&self.area);
            let points = series.x.iter().zip(series.y).map(|(&x, &y)| self.place(x, y));
            points.filter(|&p| window.contains(p)).try_for_each(|p| canvas.dot(p, DOT))?;
        }
        Ok(())
    }
}

fn info(axis: &Axis, scale: &Scale, full: (f64, f64)) -> AxisInfo {
    AxisInfo {
        label: axis.label.into(),
        unit: axis.unit.into(),
        min: scale.min,
        max: scale.max,
        log: scale.log,
        floor: axis.floor,
        full,
    }
}
