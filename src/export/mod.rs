//! Files to download: tables of numbers, and the compensated path as a program for a machine or a
//! robot.

pub mod thin;
pub mod fillet;
pub mod arc;
pub mod orientation;
pub mod style;
pub mod commanded_path;
mod sampled;
pub mod chain;
pub mod command;
pub mod header;
pub mod posture;
pub mod csv;
pub mod post;
pub mod archive;
pub mod superposed;
pub mod format;

pub use format::{FORMATS, Format};

use crate::error::Error;
use crate::report::Report;
use command::Command;
use commanded_path::CommandedPath;

/// Export options.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ExportOptions {
    /// Thinning tolerance [m]; `None`: a tenth of the job's tolerance, from [`command::FINEST`] to
    /// [`command::COARSEST`].
    pub thinning: Option<f64>,
}

/// An exported file.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// Its text.
    pub text: String,
    /// Suggested file name.
    pub file_name: String,
    /// Number of points, or of samples where nothing is thinned.
    pub points: usize,
    /// Largest distance of a commanded sample from the moves written [m], measured; 0 where nothing
    /// is thinned.
    pub deviation: f64,
    /// The commanded path at each of the report's samples.
    pub commanded_path: CommandedPath,
}

/// The format `id`.
///
/// # Errors
/// [`Error::Invalid`] if there is none.
pub fn format(id: &str) -> Result<&'static Format, Error> {
    FORMATS.iter().find(|format| format.id == id).ok_or_else(|| unknown_format(id))
}

/// A table of numbers, one row per sample.
pub fn table(report: &Report, format: &Format) -> Export {
    let text = match format.id {
        "compensated-csv" => csv::compensated(report),
        "joints-csv" => csv::joints(report),
        "correction-csv" => superposed::csv(report),
        _ => csv::columns(report),
    };
    let (points, commanded_path) = (report.samples(), CommandedPath::of(report));
    Export { text, file_name: file_name(format), points, deviation: 0.0, commanded_path }
}

/// A program file for a command that follows `commanded_path`.
///
/// # Errors
/// [`Error::Invalid`] if the format cannot express it.
pub fn program(
    report: &Report,
    format: &Format,
    commanded_path: &CommandedPath,
    command: &Command,
) -> Result<Export, Error> {
    let text = match format.id {
        "path-csv" => csv::path(report, command),
        _ => post::program(report, command, format.id)?,
    };
    let (points, deviation) = (command.points(), command.deviation);
    Ok(Export {
        text,
        file_name: file_name(format),
        points,
        deviation,
        commanded_path: commanded_path.clone(),
    })
}

fn file_name(format: &Format) -> String {
    format!("armill-{}.{}", format.id, format.extension)
}

fn unknown_format(id: &str) -> Error {
    Error::unknown_name("format", id, "there are", FORMATS.iter().map(|format| format.id))
}
