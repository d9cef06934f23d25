//! How a format writes a path.

use crate::export::Format;
use crate::report::Report;
use crate::units::{INCH, MM};

/// What happens between two moves of a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Junctions {
    /// A stop at a sharp corner; else the moves follow each other as written.
    #[default]
    AsWritten,
    /// The path leaves one for the next at a distance.
    Distance,
    /// The speed of one falls while that of the next rises, by a share.
    Share,
}

/// How a language writes a path.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PostStyle {
    /// Whether it has arcs.
    pub arcs: bool,
    /// Whether lengths are in inches, with six decimals, instead of in mm with five.
    pub inch: bool,
    /// Whether it holds only points and feeds: no waits, no rapids.
    pub points_only: bool,
    /// What happens between two moves.
    pub junctions: Junctions,
}

impl PostStyle {
    /// Number of values of [`PostStyle::index`].
    pub const COUNT: usize = 24;

    /// How a format writes the path of a report; `None` for a table of samples.
    pub fn of(format: &Format, report: &Report) -> Option<Self> {
        let inches = report.setup().program.as_ref().is_some_and(|source| source.program.unit == "inch");
        match format.id {
            "columns-csv" | "compensated-csv" | "joints-csv" | "correction-csv" => None,
            id => Some(Self {
                arcs: ["gcode", "krl", "rapid", "val3", "fanuc"].contains(&id),
                inch: inches && ["gcode", "apt"].contains(&id),
                points_only: id == "path-csv",
                junctions: match id {
                    "krl" | "rapid" | "val3" => Junctions::Distance,
                    "fanuc" => Junctions::Share,
                    _ => Junctions::AsWritten,
                },
            }),
        }
    }

    /// Whether a robot's controller runs it: consecutive moves may be written as one, and nearby
    /// points are merged.
    pub fn is_robot(self) -> bool {
        self.junctions != Junctions::AsWritten
    }

    /// Its number among all styles.
    pub fn index(self) -> usize {
        usize::from(self.arcs)
            + 2 * usize::from(self.inch)
            + 4 * usize::from(self.points_only)
            + 8 * self.junctions as usize
    }

    /// Positions are written in steps of this size [m].
    pub fn resolution(self) -> f64 {
        match self.junctions {
            // FANUC's listings have three decimals.
            Junctions::Share => MM * 1e-3,
            _ if self.inch => INCH * 1e-6,
            _ => MM * 1e-5,
        }
    }

    /// A speed as it is written [m/s]: FANUC's in whole mm/s from 10 on and tenths below, at least one
    /// tenth and at most 2000 mm/s; others as they are.
    pub fn speed(self, speed: f64) -> f64 {
        match (self.junctions, speed / MM) {
            (Junctions::Share, mm) if mm < 10.0 => (mm * 10.0).round().max(1.0) / 10.0 * MM,
            (Junctions::Share, mm) => mm.round().min(2000.0) * MM,
            _ => speed,
        }
    }
}
