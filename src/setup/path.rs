//! The job's path: a shape, or a program in one of the supported languages.

use crate::error::Error;
use crate::job::{self, FeedUnit, Job, PathKind, ProgramDialect, Unit, fields};
use crate::model::{MODEL, stamped};
use crate::path::gcode::GcodeDialect;
use crate::path::unit::{self, LengthUnit};
use crate::path::{Path, Program, Remark, SourceProgram, apt, csv, gcode, shape};
use crate::progress::Progress;
use crate::units::{DEG, MM};
use nalgebra::Vector3;
use std::sync::Arc;

/// JSON path of a program's text.
const TEXT: &str = "path.text";
/// Lines read between two progress reports.
const STRIDE: usize = 2048;

/// The desired path in the workpiece frame, and the program it was read from, if any.
pub(super) fn desired(job: &Job, progress: &mut Progress) -> Result<(Path, Option<SourceProgram>), Error> {
    fields::check_path_keys(job)?;
    let given = &job.path;
    let language = match given.kind {
        PathKind::Csv => "csv",
        PathKind::Gcode => "gcode",
        PathKind::Apt => "apt",
        _ => return shape(given).map(|path| (path, None)),
    };
    let text = given.text.as_ref().ok_or_else(|| need("text"))?;
    let mut program = program(given, text, progress)?;
    let text = with_line_feeds(text.shared());
    program.remarks.extend(earlier_model(&text));
    let path = Path::of_program(&program)
        .ok_or_else(|| Error::invalid(TEXT, "a text without a move", "at least two different positions"))?;
    Ok((path, Some(SourceProgram { language, text, program })))
}

/// A text as typed, or with LF after each line if some end in a bare CR: so its lines are those that the
/// reader counts.
fn with_line_feeds(text: Arc<str>) -> Arc<str> {
    let unified = text.replace("\r\n", "\n").replace('\r', "\n");
    if unified.lines().count() == text.lines().count() { text } else { unified.into() }
}

/// The program in the text, in the workpiece frame.
fn program(given: &job::Path, text: &str, progress: &mut Progress) -> Result<Program, Error> {
    let lines = text.lines().count() as f64;
    let mut next = STRIDE;
    let on_line = |line: usize| {
        if line >= next {
            next = line + STRIDE;
            // A bare CR ends a line for some readers.
            progress.at((line as f64 / lines).min(1.0));
        }
    };
    let unit = length_unit(given);
    match given.kind {
        PathKind::Apt => apt::program(text, &apt::Options { field: TEXT, unit }, on_line),
        PathKind::Gcode => gcode::program(text, &gcode_options(given, TEXT)?, on_line),
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

/// How a job's G-code is read; `field` is the JSON path of its text.
fn gcode_options(given: &job::Path, field: &str) -> Result<gcode::Options, Error> {
    let unit = length_unit(given);
    let lengths = given.tool_length_offsets_mm.iter().flatten();
    let mut work_offsets = [None; 9];
    let given_offsets = given.work_offsets_mm.as_deref().unwrap_or_default();
    if given_offsets.len() > work_offsets.len() {
        let value = format!("{} offsets", given_offsets.len());
        let expected = "G54 to G59, G59.1, G59.2, G59.3: at most nine";
        return Err(Error::invalid("path.work_offsets_mm", value, expected));
    }
    for (place, offset) in work_offsets.iter_mut().zip(given_offsets) {
        *place = Some(Vector3::from(*offset) * MM);
    }
    Ok(gcode::Options {
        field: field.into(),
        work_offsets,
        tool_length_offsets: lengths.map(|&(number, length)| (number, length * MM)).collect(),
        block_delete: given.block_delete.unwrap_or(true),
        dialect: dialect(given.dialect.unwrap_or_default()),
        unit: given.unit.map(|_| unit),
        start: given.start_mm.map(|start| Vector3::from(start) * MM),
        ..gcode::Options::default()
    })
}

/// Unit of length of texts that do not give their own.
fn length_unit(given: &job::Path) -> LengthUnit {
    match given.unit.unwrap_or_default() {
        Unit::Mm => LengthUnit::Mm,
        Unit::Inch => LengthUnit::Inch,
    }
}

/// The path of a G-code program that was cut before, read as the job's own.
pub(super) fn earlier(job: &Job, text: &str, field: &str) -> Result<Path, Error> {
    let program = gcode::program(text, &gcode_options(&job.path, field)?, |_| {})?;
    Path::of_program(&program)
        .ok_or_else(|| Error::invalid(field, "a text without a move", "at least two different positions"))
}

/// The controller of the job as the reader names it.
fn dialect(given: ProgramDialect) -> Option<GcodeDialect> {
    match given {
        ProgramDialect::Auto => None,
        ProgramDialect::Fanuc => Some(GcodeDialect::Fanuc),
        ProgramDialect::LinuxCnc => Some(GcodeDialect::LinuxCnc),
        ProgramDialect::Grbl => Some(GcodeDialect::Grbl),
        ProgramDialect::Siemens => Some(GcodeDialect::Siemens),
        ProgramDialect::Mach => Some(GcodeDialect::Mach),
    }
}

/// A remark on a program that Armill wrote with an earlier model. One that was read and written again
/// keeps the comments it had: the newest header is that of its moves.
fn earlier_model(text: &str) -> Option<Remark> {
    let stamps = text.lines().zip(1..).filter_map(|(line, number)| Some((stamped(line)?, number)));
    let (_, line) = stamps.max().filter(|(model, _)| *model < MODEL)?;
    let message = "this program was computed with an earlier model; figures differ".into();
    Some(Remark { code: "earlier-model", message, line })
}

/// A path from a shape.
fn shape(given: &job::Path) -> Result<Path, Error> {
    let vector =
        |value: Option<[f64; 3]>, key: &str| value.ok_or_else(|| need(key)).map(|v| Vector3::from(v) * MM);
    let length = |value: Option<f64>, key: &str| value.ok_or_else(|| need(key)).map(|v| v * MM);
    let normal = Vector3::from(given.normal.unwrap_or([0.0, 0.0, 1.0]));
    if normal.norm() < 1e-9 {
        return Err(Error::invalid("path.normal", "(0, 0, 0)", "a direction other than zero, of any length"));
    }
    let segments = match given.kind {
        PathKind::Circle => {
            let center = vector(given.center_mm, "center_mm")?;
            vec![shape::circle(center, length(given.radius_mm, "radius_mm")?, normal)]
        }
        PathKind::Arc => {
            let center = vector(given.center_mm, "center_mm")?;
            let sweep = given.sweep_deg.ok_or_else(|| need("sweep_deg"))? * DEG;
            let start = given.start_deg.unwrap_or(0.0) * DEG;
            vec![shape::arc(center, length(given.radius_mm, "radius_mm")?, normal, start, sweep)]
        }
        PathKind::Line => {
            shape::polyline(&[vector(given.from_mm, "from_mm")?, vector(given.to_mm, "to_mm")?])
        }
        PathKind::Rectangle => {
            let (width, height) =
                (length(given.width_mm, "width_mm")?, length(given.height_mm, "height_mm")?);
            let radius = given.corner_radius_mm.unwrap_or(0.0) * MM;
            let largest = width.min(height) / 2.0;
            if radius > largest {
                let (value, max) = (radius / MM, largest / MM);
                let field = "path.corner_radius_mm".into();
                return Err(Error::OutOfRange { field, value, min: 0.0, max, unit: "mm" });
            }
            shape::rectangle(vector(given.center_mm, "center_mm")?, width, height, radius)
        }
        _ => {
            let points = given.points_mm.as_ref().ok_or_else(|| need("points_mm"))?;
            let points: Vec<_> = points.iter().map(|point| Vector3::from(*point) * MM).collect();
            shape::polyline(&points)
        }
    };
    Path::new(segments).ok_or_else(|| {
        let (field, expected) = match given.kind {
            PathKind::Polyline => ("path.points_mm", "at least two different points"),
            PathKind::Line => ("path.to_mm", "a point other than from_mm"),
            _ => ("path.sweep_deg", "a sweep that is not zero"),
        };
        Error::invalid(field, "a path without length", expected)
    })
}

fn need(key: &str) -> Error {
    Error::missing(format!("path.{key}"), "this kind of path needs it")
}
