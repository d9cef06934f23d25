//! Chart of an answer with a range of the error for each case.

use crate::chart::cases::{CasesDrawing, NAMES, named, refused, words};
use crate::chart::chart::PlotArea;
use crate::chart::frame::{BOTTOM, PlotFrame, TOP, size};
use crate::chart::scale::Scale;
use crate::chart::svg::{Canvas, Layer};
use crate::chart::{ChartOptions, Units};
use crate::error::Error;
use crate::report::length_text;
use crate::units::MM;
use plotters::style::text_anchor::{HPos, VPos};

/// Share of its row that an interval is high.
const THICK: f64 = 0.55;
/// So many cases are described one by one.
const FEW: usize = 4;
/// Least width of an interval [SVG units].
const THIN: f64 = 2.0;

/// A case and the range of its error.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Its name.
    pub name: String,
    /// Both ends of the range [mm], in any order; NaN without a result.
    pub range_mm: [f64; 2],
    /// Whether it rests on a guess: then it is drawn hollow.
    pub is_guess: bool,
}

/// A range of the error for each of several cases, the first at the top.
#[derive(Debug, Clone, PartialEq)]
pub struct Intervals {
    /// What it shows.
    pub title: String,
    /// What both ends of a range are, as the name of the axis.
    pub quantity: String,
    /// The job's tolerance [mm].
    pub tolerance_mm: f64,
    /// The error of the job as it is, if that is one number [mm].
    pub now_mm: Option<f64>,
    /// The cases.
    pub cases: Vec<Case>,
}

impl Intervals {
    /// Draws them.
    ///
    /// # Errors
    /// [`Error::Invalid`] for options that cannot be drawn, and without cases.
    pub fn draw(&self, options: &ChartOptions) -> Result<CasesDrawing, Error> {
        if self.cases.is_empty() {
            return Err(refused("at least one case".into()));
        }
        self.drawn(options).map_err(refused)
    }

    fn drawn(&self, options: &ChartOptions) -> Result<CasesDrawing, String> {
        let (width, height) = size(options)?;
        let unit = options.units.length.in_m() / MM;
        // Upwards from the last.
        let rows: Vec<&Case> = self.cases.iter().rev().collect();
        let names: Vec<String> = rows.iter().map(|case| case.name.clone()).collect();
        let y = words(&names, NAMES * f64::from(width));
        let left = (y.label_width() + 12.0).ceil();
        let (area_width, area_height) = (f64::from(width) - left - 14.0, f64::from(height) - TOP - BOTTOM);
        let ends = rows.iter().flat_map(|case| case.range_mm).filter(|end| end.is_finite());
        let most = ends.chain(self.now_mm).fold(self.tolerance_mm, f64::max) / unit;
        let frame = PlotFrame {
            width,
            height,
            area: PlotArea { left, top: TOP, width: area_width, height: area_height },
            x: Scale::new((0.0, 1.04 * most), false, None).with_ticks_across(area_width, false),
            y,
            full: [(0.0, 1.04 * most), (0.0, rows.len() as f64)],
        };
        let canvas = Canvas::new(width, height);
        let at = |x: f64, y: f64| frame.place(x / unit, y);
        canvas.layer(Layer::Band, || {
            canvas.rectangle(at(0.0, rows.len() as f64), at(self.tolerance_mm, 0.0))
        })?;
        for (k, case) in rows.iter().enumerate().filter(|(_, case)| case.range_mm[1].is_finite()) {
            let class = if case.is_guess { "guess" } else { "known" };
            canvas.layer(Layer::Series { class, key: &case.name }, || interval(&canvas, &at, k, case))?;
        }
        if let Some(now) = self.now_mm {
            let line = [at(now, 0.0), at(now, rows.len() as f64)];
            canvas.layer(Layer::Series { class: "desired", key: "now" }, || canvas.line(&line))?;
        }
        let axis = format!("{}, {}", self.quantity, options.units.length.name());
        canvas.layer(Layer::Axis, || {
            frame.mesh(&canvas, &named(&axis), false)?;
            canvas.text("tolerance", at(0.0, rows.len() as f64), HPos::Left, VPos::Bottom)
        })?;
        let description = self.description(options.units);
        Ok(CasesDrawing::finished(canvas, (width, height), &self.title, description))
    }

    /// Both ends of each of a few cases; of many, the least and the largest upper end.
    fn description(&self, units: Units) -> String {
        if self.cases.len() <= FEW {
            return self.cases.iter().map(|case| range_text(case, units)).collect();
        }
        let known = || self.cases.iter().filter(|case| case.range_mm[1].is_finite());
        let end = |case: &Case| case.range_mm[0].max(case.range_mm[1]);
        let least = known().min_by(|a, b| end(a).total_cmp(&end(b)));
        let most = known().max_by(|a, b| end(a).total_cmp(&end(b)));
        let text = |case: &Case| {
            format!(
                "{} {} ({})",
                length_text(end(case) * MM, units.length.in_m(), 3),
                units.length.name(),
                case.name
            )
        };
        match least.zip(most) {
            Some((least, most)) => format!("Upper ends from {} to {}.", text(least), text(most)),
            None => "No case has a result.".into(),
        }
    }
}

/// A case's range as a sentence with a space after it.
fn range_text(case: &Case, units: Units) -> String {
    let [low, high] = case.range_mm.map(|end| length_text(end * MM, units.length.in_m(), 3));
    if case.range_mm[1].is_finite() {
        format!("{}: {low} to {high} {}. ", case.name, units.length.name())
    } else {
        format!("{}: no result. ", case.name)
    }
}

/// A case's interval, and a thin line that leads to it.
fn interval(
    canvas: &Canvas,
    at: &impl Fn(f64, f64) -> (f64, f64),
    row: usize,
    case: &Case,
) -> Result<(), String> {
    let [a, b] = case.range_mm;
    let (low, high) = (if a.is_finite() { a.min(b) } else { b }, if a.is_finite() { a.max(b) } else { b });
    let middle = row as f64 + 0.5;
    let ((left, top), (right, bottom)) = (at(low, middle + THICK / 2.0), at(high, middle - THICK / 2.0));
    let right = right.max(left + THIN);
    let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
    canvas.line(&[at(0.0, middle), (left, at(0.0, middle).1)])?;
    if case.is_guess {
        return canvas.line(&[corners[0], corners[1], corners[2], corners[3], corners[0]]);
    }
    canvas.polygon(&corners)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::cases::group;

    fn case(name: &str, low: f64, high: f64, is_guess: bool) -> Case {
        Case { name: name.into(), range_mm: [low, high], is_guess }
    }

    fn intervals(cases: Vec<Case>) -> Intervals {
        Intervals { title: "t".into(), quantity: "Error".into(), tolerance_mm: 0.1, now_mm: None, cases }
    }

    #[test]
    fn intervals_stand_where_their_numbers_are() {
        let cases = vec![
            case("a", 0.05, 0.2, false),
            case("b", 0.4, 0.1, true),
            case("c", f64::NAN, f64::NAN, false),
        ];
        let drawing = intervals(cases).draw(&ChartOptions::sized(600.0, 300.0)).unwrap();
        assert!(!drawing.svg.contains("NaN"));
        assert_eq!(drawing.description, "a: 0.05 to 0.2 mm. b: 0.4 to 0.1 mm. c: no result. ");
        let many = (1..=9).map(|k| case(&format!("no {k}"), 0.05, 0.1 * f64::from(k), false)).collect();
        let long = intervals(many).draw(&ChartOptions::sized(600.0, 300.0)).unwrap();
        assert_eq!(long.description, "Upper ends from 0.1 mm (no 1) to 0.9 mm (no 9).");
        let known = group(&drawing.svg, "series known");
        let points = known.split("<polygon points=\"").nth(1).unwrap().split('"').next().unwrap();
        let x: Vec<f64> = points.split(' ').map(|p| p.split(',').next().unwrap().parse().unwrap()).collect();
        let hollow = group(&drawing.svg, "series guess");
        let last = hollow.rsplit("points=\"").next().unwrap().split('"').next().unwrap();
        let right: f64 = last.split(' ').nth(1).unwrap().split(',').next().unwrap().parse().unwrap();
        // The axis begins at zero: equal parts of it are equal lengths, up to the tenth that is written.
        let zero = known.split("<polyline points=\"").nth(1).unwrap().split(',').next().unwrap();
        let zero: f64 = zero.parse().unwrap();
        assert!(((x[1] - zero) / (x[0] - zero) - 4.0).abs() < 0.02, "{x:?} {zero}");
        assert!(((right - zero) / (x[1] - zero) - 2.0).abs() < 0.01, "{right} {zero}");
    }

    #[test]
    fn long_names_are_shortened_and_none_are_refused() {
        let long = "a robot whose name is longer than any maker would print on its arm";
        let drawing =
            intervals(vec![case(long, 0.1, 0.2, false)]).draw(&ChartOptions::sized(320.0, 200.0)).unwrap();
        assert!(drawing.svg.contains("…</text>") && !drawing.svg.contains(&format!("{long}</text>")));
        assert!(intervals(vec![]).draw(&ChartOptions::sized(320.0, 200.0)).is_err());
    }
}
