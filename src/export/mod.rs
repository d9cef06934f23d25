//! Files to download: tables of numbers, and the compensated path as a program for a machine or a
//! robot.

pub mod thin;
pub mod fillet;
pub mod arc;
pub mod orientation;
pub mod command;
pub mod header;
pub mod csv;
pub mod post;
pub mod replay;
pub mod rehearsal;

pub use crate::report::format::{FORMATS, Format};
pub use rehearsal::{Promise, promise};

use crate::error::Error;
use crate::report::Report;
use command::{Course, Style};
use rehearsal::rehearse;

/// What a person may choose.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Options {
    /// Thinning tolerance [m]; `None`: a tenth of the job's tolerance, from [`command::FINEST`] to
    /// [`command::COARSEST`].
    pub thinning: Option<f64>,
}

/// A file.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// Its text.
    pub text: String,
    /// A name for it.
    pub file_name: String,
    /// Number of points, or of samples where nothing is thinned.
    pub points: usize,
    /// Largest distance of a commanded sample from the moves written [m], measured; 0 where nothing
    /// is thinned.
    pub deviation: f64,
    /// Where it sends the tool at each of the report's samples.
    pub course: Course,
}

/// Writes the file of the format `id`.
///
/// # Errors
/// [`Error::Invalid`] for a format that is not in [`FORMATS`] or cannot say the path; else see
/// [`rehearse`].
pub fn export(report: &Report, id: &str, options: &Options) -> Result<Export, Error> {
    let Some(format) = FORMATS.iter().find(|format| format.id == id) else { return Err(unknown_format(id)) };
    let file_name = format!("armill-{id}.{}", format.extension);
    let table = |text| {
        let (file_name, course) = (file_name.clone(), Course::of(report));
        Ok(Export { text, file_name, points: report.samples(), deviation: 0.0, course })
    };
    match id {
        "columns-csv" => return table(csv::columns(report)),
        "compensated-csv" => return table(csv::compensated(report)),
        "joints-csv" => return table(csv::joints(report)),
        _ => {}
    }
    let inches = report.setup.listing.as_ref().is_some_and(|listing| listing.program.unit == "inch");
    let style = Style {
        arcs: id == "gcode",
        inch: inches && ["gcode", "apt"].contains(&id),
        points_only: id == "path-csv",
    };
    let (course, command) = rehearse(report, options.thinning, style)?;
    let text = match id {
        "path-csv" => csv::path(report, &command),
        _ => post::program(report, &command, id)?,
    };
    Ok(Export { text, file_name, points: command.points(), deviation: command.deviation, course })
}

fn unknown_format(id: &str) -> Error {
    let known: Vec<_> = FORMATS.iter().map(|format| format.id).collect();
    Error::Invalid {
        field: "format".into(),
        value: format!("\"{id}\""),
        expected: format!("there are {}", known.join(", ")),
    }
}
