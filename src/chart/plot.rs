//! Charts over two axes: curves, steps, marked points.

use super::chart::{Axis, Band, Caption, Chart, ChartOptions, LinePlot, PlotArea, PlotSeries, Scaling};
use super::frame::{BOTTOM, PlotFrame, TOP, size, valid};
use super::scale::{Scale, extent, widened};
use crate::math;

/// Curves over x with bands behind them. Zooming in x alone fits y to the visible part.
///
/// # Errors
/// A sentence if the size, a range or the length of a series cannot be drawn.
pub fn line_chart(plot: &LinePlot, options: &ChartOptions) -> Result<Chart, String> {
    let LinePlot { caption, x, series, bands, .. } = *plot;
    let (width, height) = size(options)?;
    check_lengths(series)?;
    let y = Axis { log: by_decades(plot, options.scaling), ..plot.y };
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
    let y_scale =
        Scale::new(y_range, y.log, y.floor).with_ticks(((plot_height / 36.0) as usize).clamp(2, 9), y.whole);
    let left = (y_scale.label_width() + 12.0).ceil();
    // A part of the axis ends anywhere; only the whole has an end worth reading.
    let ended = options.x_range.is_none() && !x.whole;
    let x_scale = |right: f64| {
        let length = f64::from(width) - left - right;
        let scale = Scale::new(x_range, x.log, x.floor).with_ticks_across(length, x.whole);
        if ended { scale.with_end(length) } else { scale }
    };
    let right = (x_scale(12.0).label_width() / 2.0 + 2.0).max(12.0).ceil();
    let area = PlotArea { left, top: TOP, width: f64::from(width) - left - right, height: plot_height };
    let frame = PlotFrame { width, height, area, x: x_scale(right), y: y_scale, full: [full_x, full_y] };
    let description = format!("{}{}", caption.description, raised(&y, series, options));
    let caption = Caption { description: &description, ..caption };
    frame.draw(&LinePlot { caption, y, ..*plot }, options)
}

/// Whether the second axis is divided by decades.
fn by_decades(plot: &LinePlot, scaling: Option<Scaling>) -> bool {
    match scaling {
        None => plot.y.log,
        Some(Scaling::Linear) => false,
        Some(Scaling::Log) => true,
        Some(Scaling::Auto) => {
            plot.y.log || plot.y.floor.is_some_and(|floor| others_lie_low(plot.series, floor))
        }
    }
}

/// Whether all curves but the highest peak below a tenth of it, and above `floor`. One that stands out
/// can be read on an even scale, and the eye compares heights better there.
fn others_lie_low(series: &[PlotSeries], floor: f64) -> bool {
    let peaks = series.iter().filter_map(|s| extent(s.y.iter().copied(), true)).map(|(_, peak)| peak);
    let mut peaks: Vec<f64> = peaks.filter(|peak| *peak > floor).collect();
    peaks.sort_by(f64::total_cmp);
    matches!(peaks[..], [.., second, highest] if second < highest / 10.0)
}

/// A sentence about values that are drawn higher than they are, if there are any.
fn raised(y: &Axis, series: &[PlotSeries], options: &ChartOptions) -> String {
    let Some(floor) = y.floor.filter(|_| y.log) else { return String::new() };
    let mut shown = series.iter().filter(|s| options.shows(s.key));
    if shown.any(|s| s.y.iter().any(|&value| value < floor)) {
        format!(" Values below {floor} {} are drawn at {floor}.", y.unit)
    } else {
        String::new()
    }
}

fn check_lengths(series: &[PlotSeries]) -> Result<(), String> {
    match series.iter().find(|s| s.x.len() != s.y.len()) {
        Some(s) => Err(format!("Series {} has {} x but {} y.", s.key, s.x.len(), s.y.len())),
        None => Ok(()),
    }
}

/// The range that shows these values, with some headroom as a share of it; whole decades if
/// logarithmic.
fn fitted(axis: &Axis, values: impl IntoIterator<Item = f64>, headroom: f64) -> (f64, f64) {
    let found = extent(values, axis.log);
    if axis.log {
        let least = axis.floor.unwrap_or(0.0);
        let (min, max) = found.map_or((1.0, 1.0), |(min, max)| (min.max(least), max.max(least)));
        // The floor is a power of ten but for rounding.
        let (low, high) = ((math::log10(min) + 1e-9).floor(), (math::log10(max) - 1e-9).ceil());
        // A curve along the floor must not fall off the axis by a rounding error.
        let bottom = math::pow(10.0, low).max(least);
        return (bottom, math::pow(10.0, if high > low { high } else { low + 1.0 }));
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

/// The values and the bands' ends, except bands so far away that they would flatten the curves.
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
    use crate::chart::chart::Caption;
    use crate::chart::{ForceUnit, Over, Units};
    use crate::path::unit::LengthUnit;

    const CAPTION: Caption = Caption { name: "n", title: "t", description: "d" };
    const OPTIONS: ChartOptions = ChartOptions {
        width: 860.0,
        height: 420.0,
        x_range: None,
        y_range: None,
        hidden: Vec::new(),
        units: Units { length: LengthUnit::Mm, force: ForceUnit::Newton },
        scaling: None,
        over: Over::Time,
    };
    const TIME: Axis =
        Axis { label: "Time", unit: "s", range: None, zero: false, log: false, floor: None, whole: false };
    const ERROR: Axis = Axis { label: "Contour error", unit: "mm", zero: true, ..TIME };

    fn series<'a>(x: &'a [f64], y: &'a [f64]) -> PlotSeries<'a> {
        PlotSeries { key: "e", label: "E", class: "before", x, y, markers: false, bound: false }
    }

    fn over_time(
        y: Axis,
        series: &[PlotSeries],
        bands: &[Band],
        options: &ChartOptions,
    ) -> Result<Chart, String> {
        line_chart(&LinePlot { caption: CAPTION, x: TIME, y, series, bands }, options)
    }

    fn line(x: &[f64], y: &[f64], options: &ChartOptions) -> Chart {
        over_time(ERROR, &[series(x, y)], &[], options).unwrap()
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
        let series = [series(&[0.0, 1.0], &[0.0, 1.0])];
        let plot = LinePlot { caption: CAPTION, x: axis, y: axis, series: &series, bands: &[] };
        let chart = line_chart(&plot, &OPTIONS).unwrap();
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
        let chart = line(&[0.0, 1.0], &[0.0, 1.0], &ChartOptions { y_range: Some((0.0, 1.0)), ..OPTIONS });
        let PlotArea { left, top, width, height } = chart.plot;
        let diagonal = format!(r#"points="{left},{} {},{top}""#, top + height, left + width);
        assert!(chart.svg.contains(&diagonal), "{diagonal} is not in {}", chart.svg);
    }

    #[test]
    fn zoom_in_x_fits_y_to_what_is_seen() {
        let x = [0.0, 1.0, 2.0, 3.0];
        let chart = line(&x, &[0.0, 1.0, 2.0, 100.0], &ChartOptions { x_range: Some((0.0, 2.0)), ..OPTIONS });
        assert_eq!((chart.x.min, chart.x.max), (0.0, 2.0));
        assert!(chart.y.max < 3.0, "{}", chart.y.max);
    }

    #[test]
    fn a_near_band_is_shown_whole_and_a_far_one_does_not_flatten_the_curve() {
        let shown = |to: f64| {
            let bands = [Band { from: 0.0, to, label: "tolerance" }];
            over_time(ERROR, &[series(&[0.0, 1.0], &[0.0, 1.0])], &bands, &OPTIONS).unwrap().y.max
        };
        assert!(shown(2.0) > 2.0 && shown(100.0) < 2.0);
    }

    #[test]
    fn what_a_bound_encloses_is_shaded_down_to_the_axis() {
        let one = PlotSeries { bound: true, ..series(&[0.0, 1.0], &[1.0, 1.0]) };
        let chart =
            over_time(ERROR, &[one], &[], &ChartOptions { y_range: Some((0.0, 1.0)), ..OPTIONS }).unwrap();
        let PlotArea { left, top, width, height } = chart.plot;
        let (right, bottom) = (left + width, top + height);
        let corners = format!(r#"points="{left},{top} {right},{top} {right},{bottom} {left},{bottom}""#);
        assert!(chart.svg.contains(&corners), "{corners} is not in {}", chart.svg);
        let hidden = ChartOptions { hidden: vec!["e".into()], ..OPTIONS };
        assert!(!over_time(ERROR, &[one], &[], &hidden).unwrap().svg.contains("polygon"));
    }

    #[test]
    fn a_band_s_name_stands_where_no_curve_is() {
        let x: Vec<f64> = (0..=100).map(f64::from).collect();
        let y: Vec<f64> = x.iter().map(|x| if *x < 50.0 { 0.2 } else { 5.0 }).collect();
        let bands = [Band { from: 0.0, to: 0.1, label: "tolerance" }];
        let chart = over_time(ERROR, &[series(&x, &y)], &bands, &OPTIONS).unwrap();
        let before = chart.svg.split(">tolerance</text>").next().unwrap();
        let left: f64 = before.rsplit("x=\"").next().unwrap().split('"').next().unwrap().parse().unwrap();
        let middle = chart.plot.left + chart.plot.width / 2.0;
        assert!(left > middle, "{left} is under the curve, which is low up to {middle}");
    }

    #[test]
    fn logarithmic_ranges_are_whole_decades() {
        let y = Axis { log: true, ..ERROR };
        let points = PlotSeries { markers: true, ..series(&[0.0, 1.0, 2.0], &[1.3, 0.0, 0.004]) };
        let chart = over_time(y, &[points], &[], &OPTIONS).unwrap();
        assert_eq!((chart.y.min, chart.y.max, chart.y.log), (1e-3, 10.0, true));
        assert!(!chart.svg.contains("NaN"));
    }

    #[test]
    fn nothing_is_drawn_below_the_floor_of_a_logarithmic_scale() {
        let y = Axis { log: true, floor: Some(1e-3), ..ERROR };
        let over = |values: &[f64; 4]| {
            over_time(y, &[series(&[0.0, 1.0, 2.0, 3.0], values)], &[], &OPTIONS).unwrap()
        };
        let chart = over(&[0.0, 1e-9, 0.5, -1.0]);
        assert_eq!((chart.y.min, chart.y.max, chart.y.floor), (1e-3, 1.0, Some(1e-3)));
        assert_eq!(chart.description, "d Values below 0.001 mm are drawn at 0.001.");
        let low = format!(",{}", chart.plot.top + chart.plot.height);
        let drawn = chart.svg.split("data-key").nth(1).unwrap().split("</g>").next().unwrap();
        assert_eq!(drawn.matches(&low).count(), 3, "{drawn}");
        assert_eq!(over(&[0.1, 0.2, 0.5, 0.001]).description, "d");
    }

    #[test]
    fn decades_are_chosen_where_all_but_one_curve_would_lie_on_the_axis() {
        let x = [0.0, 1.0];
        let log = |low: f64, scaling: Option<Scaling>, floor: Option<f64>| {
            let (whole, lower) = ([0.0, 1.0], [low, 0.0]);
            let least = [1e-3, 1e-3];
            let both = [
                series(&x, &whole),
                PlotSeries { key: "low", ..series(&x, &lower) },
                PlotSeries { key: "least", ..series(&x, &least) },
            ];
            let options = ChartOptions { scaling, ..OPTIONS };
            over_time(Axis { floor, ..ERROR }, &both, &[], &options).unwrap().y.log
        };
        let (auto, floor) = (Some(Scaling::Auto), Some(1e-4));
        assert!(log(0.09, auto, floor) && !log(0.11, auto, floor));
        assert!(!log(1e-5, auto, Some(1e-3)), "what is below the floor cannot be read anyway");
        assert!(!log(0.09, auto, None), "without a floor it may be negative");
        assert!(!log(0.09, None, floor) && !log(0.09, Some(Scaling::Linear), floor));
        assert!(log(0.5, Some(Scaling::Log), floor));
    }

    #[test]
    fn a_hidden_series_is_in_the_legend_only_and_leaves_its_room() {
        let (x, low, high) = ([0.0, 1.0], [0.0, 0.5], [0.0, 50.0]);
        let both = [series(&x, &low), PlotSeries { key: "high", ..series(&x, &high) }];
        let options = ChartOptions { hidden: vec!["high".into()], ..ChartOptions::sized(860.0, 420.0) };
        let chart = over_time(ERROR, &both, &[], &options).unwrap();
        assert!(chart.y.max < 1.0 && !chart.svg.contains(r#"data-key="high""#));
        assert_eq!(chart.series.len(), 2);
        assert_eq!(chart.x.full, (0.0, 1.0));
    }

    #[test]
    fn what_cannot_be_drawn_is_an_error() {
        let x = [0.0, 1.0];
        let draw = |series: PlotSeries, options: ChartOptions| over_time(TIME, &[series], &[], &options);
        assert!(draw(series(&x, &x[..1]), OPTIONS).is_err());
        assert!(draw(series(&x, &x), ChartOptions { width: f64::NAN, ..OPTIONS }).is_err());
        assert!(draw(series(&x, &x), ChartOptions { x_range: Some((2.0, 1.0)), ..OPTIONS }).is_err());
    }
}
