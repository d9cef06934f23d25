//! Chart of an answer over two things that vary, as a grid of cells.

use crate::chart::ChartOptions;
use crate::chart::cases::{CasesDrawing, NAMES, named, refused, words};
use crate::chart::chart::PlotArea;
use crate::chart::frame::{BOTTOM, PlotFrame, TOP, size};
use crate::chart::svg::{Canvas, FONT_SIZE, Layer, text_width};
use crate::error::Error;
use crate::report::length_text;
use crate::units::MM;
use plotters::style::text_anchor::{HPos, VPos};

/// Ratios to the tolerance at which the shade of a cell changes.
const SHADES: [f64; 5] = [0.5, 1.0, 2.0, 4.0, 8.0];
/// Half the width, and the height, of the marks on the axes where the job is [SVG units].
const MARK: (f64, f64) = (5.0, 8.0);

/// The error over two things that vary, as a grid.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorGrid {
    /// What it shows.
    pub title: String,
    /// What varies from left to right, and from the bottom up, with its unit.
    pub names: [String; 2],
    /// The values of each, as printed.
    pub values: [Vec<String>; 2],
    /// Where the job is, counted in values from 0, for each; none where it is not among them.
    pub now: [Option<f64>; 2],
    /// The job's tolerance [mm].
    pub tolerance_mm: f64,
    /// The error for each pair, the second varying faster [mm]; NaN without a result.
    pub errors_mm: Vec<f64>,
}

impl ErrorGrid {
    /// Draws it.
    ///
    /// # Errors
    /// [`Error::Invalid`] for options that cannot be drawn, and if there are more or fewer errors than pairs.
    pub fn draw(&self, options: &ChartOptions) -> Result<CasesDrawing, Error> {
        let [columns, rows] = self.counts();
        if columns * rows == 0 || self.errors_mm.len() != columns * rows {
            return Err(refused(format!("{} errors, one for each pair", columns * rows)));
        }
        self.drawn(options).map_err(refused)
    }

    fn counts(&self) -> [usize; 2] {
        [self.values[0].len(), self.values[1].len()]
    }

    fn error(&self, column: usize, row: usize) -> f64 {
        self.errors_mm[column * self.values[1].len() + row]
    }

    fn meets(&self, column: usize, row: usize) -> bool {
        self.error(column, row) <= self.tolerance_mm
    }

    fn drawn(&self, options: &ChartOptions) -> Result<CasesDrawing, String> {
        let (width, height) = size(options)?;
        let [columns, rows] = self.counts();
        let y = words(&self.values[1], NAMES * f64::from(width));
        let left = (y.label_width() + 12.0).ceil();
        let area = PlotArea {
            left,
            top: TOP,
            width: f64::from(width) - left - 14.0,
            height: f64::from(height) - TOP - BOTTOM,
        };
        let (cell_width, cell_height) = (area.width / columns as f64, area.height / rows as f64);
        let full = [(0.0, columns as f64), (0.0, rows as f64)];
        let frame = PlotFrame { width, height, area, x: words(&self.values[0], cell_width - 4.0), y, full };
        let canvas = Canvas::new(width, height);
        let at = |x: f64, y: f64| frame.place(x, y);
        let cells = || (0..columns).flat_map(|column| (0..rows).map(move |row| (column, row)));
        for shade in 0..=SHADES.len() {
            let mut of = cells().filter(|(column, row)| self.shade(*column, *row) == Some(shade));
            canvas.layer(Layer::Cell { shade }, || {
                of.try_for_each(|(column, row)| {
                    let (x, y) = (column as f64, row as f64);
                    canvas.rectangle(at(x, y + 1.0), at(x + 1.0, y))
                })
            })?;
        }
        let unit = options.units.length;
        let text = |column: usize, row: usize| match self.error(column, row) {
            error if error.is_finite() => length_text(error * MM, unit.in_m(), 3),
            _ => "–".to_owned(),
        };
        let widest = cells().map(|(column, row)| text_width(&text(column, row))).fold(0.0, f64::max);
        let is_roomy = widest + 4.0 < cell_width && cell_height > FONT_SIZE + 2.0;
        canvas.layer(Layer::Series { class: "limit", key: "tolerance" }, || self.limit(&canvas, &at))?;
        if let [Some(x), Some(y)] = self.now {
            canvas.layer(Layer::Series { class: "now", key: "now" }, || {
                let ((x, bottom), (left, y)) = (at(x + 0.5, 0.0), at(0.0, y + 0.5));
                let (half, high) = MARK;
                canvas.polygon(&[(x - half, bottom), (x + half, bottom), (x, bottom - high)])?;
                canvas.polygon(&[(left, y - half), (left, y + half), (left + high, y)])
            })?;
        }
        canvas.layer(Layer::Axis, || {
            frame.mesh(&canvas, &named(&self.names[0]), false)?;
            canvas.text(&self.names[1], (0.0, 2.0), HPos::Left, VPos::Top)
        })?;
        if is_roomy {
            canvas.layer(Layer::Label, || {
                cells().try_for_each(|(column, row)| {
                    let middle = at(column as f64 + 0.5, row as f64 + 0.5);
                    canvas.text(&text(column, row), middle, HPos::Center, VPos::Center)
                })
            })?;
        }
        let description = self.description(unit.name(), &text);
        Ok(CasesDrawing::finished(canvas, (width, height), &self.title, description))
    }

    /// The shade of a cell, from far within the tolerance to far beyond it; `None` without a result.
    fn shade(&self, column: usize, row: usize) -> Option<usize> {
        let ratio = self.error(column, row) / self.tolerance_mm;
        let shade = || SHADES.iter().position(|most| ratio <= *most).unwrap_or(SHADES.len());
        (!ratio.is_nan()).then(shade)
    }

    /// The edges between cells that meet the tolerance and cells that do not.
    fn limit(&self, canvas: &Canvas, at: &impl Fn(f64, f64) -> (f64, f64)) -> Result<(), String> {
        let [columns, rows] = self.counts();
        for column in 0..columns {
            for row in 0..rows {
                let (x, y) = (column as f64, row as f64);
                if column + 1 < columns && self.meets(column, row) != self.meets(column + 1, row) {
                    canvas.line(&[at(x + 1.0, y), at(x + 1.0, y + 1.0)])?;
                }
                if row + 1 < rows && self.meets(column, row) != self.meets(column, row + 1) {
                    canvas.line(&[at(x, y + 1.0), at(x + 1.0, y + 1.0)])?;
                }
            }
        }
        Ok(())
    }

    fn description(&self, unit: &str, text: &impl Fn(usize, usize) -> String) -> String {
        let [columns, rows] = self.counts();
        let pairs = || (0..columns).flat_map(|column| (0..rows).map(move |row| (column, row)));
        let meeting = pairs().filter(|(column, row)| self.meets(*column, *row)).count();
        let known = pairs().filter(|(column, row)| self.error(*column, *row).is_finite());
        let least = known.min_by(|a, b| self.error(a.0, a.1).total_cmp(&self.error(b.0, b.1)));
        let least = least.map(|(column, row)| {
            let [x, y] = [&self.values[0][column], &self.values[1][row]];
            format!(" The least error is {} {unit}, at {x} and {y}.", text(column, row))
        });
        format!("{meeting} of {} pairs meet the tolerance.{}", columns * rows, least.unwrap_or_default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::cases::group;

    fn grid(errors_mm: Vec<f64>) -> ErrorGrid {
        ErrorGrid {
            title: "t".into(),
            names: ["Depth, mm".into(), "Feed, mm/s".into()],
            values: [vec!["1".into(), "2".into()], vec!["10".into(), "20".into(), "40".into()]],
            now: [Some(0.5), Some(1.0)],
            tolerance_mm: 0.1,
            errors_mm,
        }
    }

    #[test]
    fn a_grid_has_a_cell_for_each_pair_and_a_line_at_the_tolerance() {
        let drawing = grid(vec![0.04, 0.09, 0.3, 0.07, 0.5, f64::NAN])
            .draw(&ChartOptions::sized(600.0, 300.0))
            .unwrap();
        let cells =
            |shade: usize| group(&drawing.svg, &format!("cell shade-{shade}")).matches("<rect").count();
        assert_eq!([0, 1, 2, 3, 4, 5].map(cells), [1, 2, 0, 1, 1, 0]);
        // Three pairs of neighbours lie on both sides: two along the second number, one along the first.
        assert_eq!(group(&drawing.svg, "series limit").matches("<polyline").count(), 3);
        assert!(drawing.svg.contains(">0.09</text>") && drawing.svg.contains(">–</text>"));
        assert!(
            drawing
                .description
                .starts_with("3 of 6 pairs meet the tolerance. The least error is 0.04 mm, at 1 and 10.")
        );
        assert!(!drawing.svg.contains("NaN") && !drawing.svg.contains("style="));
        assert_eq!(group(&drawing.svg, "series now").matches("<polygon").count(), 2);
    }

    #[test]
    fn a_grid_of_another_size_is_refused() {
        let error = grid(vec![0.1; 5]).draw(&ChartOptions::sized(600.0, 300.0)).unwrap_err();
        assert!(error.to_string().contains("6 errors"), "{error}");
    }
}
