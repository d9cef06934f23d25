//! The program that a job's path is given as, read.

use crate::error::Error;
use crate::job::path::TEXT;
use crate::job::setup::invalid;
use crate::job::{FeedUnit, Job, PathKind, Unit};
use crate::path::unit::{self, LengthUnit};
use crate::path::{Program, apt, csv, gcode};
use crate::units::MM;
use nalgebra::Vector3;

/// Lines from one word about progress to the next.
const TELL_LINES: usize = 2048;

impl Job {
    /// The moves of the text, in the workpiece frame; `on_read` hears which share of it is read.
    pub(super) fn program(
        &self,
        kind: PathKind,
        text: &str,
        mut on_read: impl FnMut(f64),
    ) -> Result<Program, Error> {
        let lines = text.lines().count() as f64;
        let mut next = TELL_LINES;
        let on_line = |line: usize| {
            if line >= next {
                next = line + TELL_LINES;
                on_read(line as f64 / lines);
            }
        };
        let given = &self.path;
        let unit = match given.unit.unwrap_or_default() {
            Unit::Mm => LengthUnit::Mm,
            Unit::Inch => LengthUnit::Inch,
        };
        match kind {
            PathKind::Apt => apt::program(text, &apt::Options { field: TEXT, unit }, on_line),
            PathKind::Gcode => {
                let lengths = given.tool_length_offsets_mm.iter().flatten();
                let mut work_offsets = [None; 9];
                let given_offsets = given.work_offsets_mm.as_deref().unwrap_or_default();
                if given_offsets.len() > work_offsets.len() {
                    let value = format!("{} offsets", given_offsets.len());
                    return Err(invalid(
                        "path.work_offsets_mm",
                        value,
                        "G54 to G59, G59.1, G59.2, G59.3: nine at most",
                    ));
                }
                for (place, offset) in work_offsets.iter_mut().zip(given_offsets) {
                    *place = Some(Vector3::from(*offset) * MM);
                }
                let options = gcode::Options {
                    field: TEXT.into(),
                    work_offsets,
                    tool_length_offsets: lengths.map(|&(number, length)| (number, length * MM)).collect(),
                    block_delete: given.block_delete.unwrap_or(true),
                    ..gcode::Options::default()
                };
                gcode::program(text, &options, on_line)
            }
            _ => {
                let feed_unit = match given.feed_unit.unwrap_or_default() {
                    FeedUnit::MmPerS => unit::FeedUnit::MmPerS,
                    FeedUnit::MmPerMin => unit::FeedUnit::MmPerMin,
                    FeedUnit::InchPerMin => unit::FeedUnit::InchPerMin,
                };
                csv::program(text, &csv::Options { field: TEXT, unit, feed_unit }, on_line)
            }
        }
    }
}
