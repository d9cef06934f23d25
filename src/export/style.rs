//! How a format writes a path.

use crate::export::Format;
use crate::report::Report;
use crate::units::{INCH, MM};

/// How a language writes a path.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PostStyle {
    /// Whether it has arcs.
    pub arcs: bool,
    /// Whether lengths are in inches, with six decimals, instead of in mm with five.
    pub inch: bool,
    /// Whether it holds only points and feeds: no waits, no rapids.
    pub points_only: bool,
}

impl PostStyle {
    /// Number of values of [`PostStyle::index`].
    pub const COUNT: usize = 8;

    /// How a format writes the path of a report; `None` for a table of samples.
    pub fn of(format: &Format, report: &Report) -> Option<Self> {
        let inches = report.setup().program.as_ref().is_some_and(|source| source.program.unit == "inch");
        match format.id {
            "columns-csv" | "compensated-csv" | "joints-csv" => None,
            id => Some(Self {
                arcs: id == "gcode",
                inch: inches && ["gcode", "apt"].contains(&id),
                points_only: id == "path-csv",
            }),
        }
    }

    /// Its number among all styles.
    pub fn index(self) -> usize {
        usize::from(self.arcs) + 2 * usize::from(self.inch) + 4 * usize::from(self.points_only)
    }

    /// Positions are written in steps of this size [m].
    pub fn resolution(self) -> f64 {
        if self.inch { INCH * 1e-6 } else { MM * 1e-5 }
    }
}
