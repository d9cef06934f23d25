//! The programs of a report. One rehearsal of each serves its accuracy, its header and its file.

use crate::error::Error;
use crate::export::style::PostStyle;
use crate::export::{self, Export, ExportOptions, Format};
use crate::report::{Report, millimetres};
use crate::units::MM;
use crate::verification::rehearsal::{Rehearsal, rehearse};
use serde::Serialize;
use std::sync::OnceLock;

/// Rehearsals of one report's path with the default thinning; formats that write a path in the same
/// style share one.
#[derive(Debug, Default)]
pub struct Programs {
    rehearsed: [OnceLock<Result<Rehearsal, Error>>; PostStyle::COUNT],
}

/// Accuracy of the report's path as a program. Programs hold no times, so the controller times them
/// itself; only joint commands keep the run's timing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProgramAccuracy {
    /// Largest contour error when the program runs [mm].
    pub max_mm: f64,
    /// Whether that is within the job's tolerance.
    pub met: bool,
    /// The accuracy in words.
    pub sentence: String,
}

/// The file of the format `id`.
///
/// # Errors
/// See [`Programs::export`].
pub fn export(report: &Report, id: &str, options: &ExportOptions) -> Result<Export, Error> {
    Programs::default().export(report, id, options)
}

impl Programs {
    /// The file of the format `id`.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a format that is not in [`export::FORMATS`] or cannot express the
    /// path; otherwise see [`rehearse`].
    pub fn export(&self, report: &Report, id: &str, options: &ExportOptions) -> Result<Export, Error> {
        let format = export::format(id)?;
        let Some(style) = PostStyle::of(format, report) else { return Ok(export::table(report, format)) };
        let own;
        let Rehearsal { commanded_path, command, .. } = match options.thinning {
            None => self.rehearsal(report, style)?,
            thinning => {
                own = rehearse(report, thinning, style)?;
                &own
            }
        };
        export::program(report, format, commanded_path, command)
    }

    /// Accuracy of the path as a program of the format `id` with the default thinning.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a format that is not a program; otherwise see [`rehearse`].
    pub fn accuracy(&self, report: &Report, id: &str) -> Result<ProgramAccuracy, Error> {
        let format = export::format(id)?;
        let style = PostStyle::of(format, report)
            .ok_or_else(|| Error::invalid("format", format!("\"{id}\""), "a program, not a table"))?;
        let reached = self.rehearsal(report, style)?.reached;
        let tolerance = report.setup().goal.tolerance;
        let met = reached <= tolerance;
        let sentence = format!(
            "As {}, with its own timing: at most {} mm, {} the tolerance of {} mm.",
            in_words(format),
            millimetres(reached),
            if met { "within" } else { "beyond" },
            millimetres(tolerance)
        );
        Ok(ProgramAccuracy { max_mm: reached / MM, met, sentence })
    }

    fn rehearsal(&self, report: &Report, style: PostStyle) -> Result<&Rehearsal, Error> {
        let rehearsed = self.rehearsed[style.index()].get_or_init(|| rehearse(report, None, style));
        rehearsed.as_ref().map_err(Clone::clone)
    }
}

/// A format as a sentence names it.
fn in_words(format: &Format) -> String {
    let article = if format.name.starts_with('A') { "an" } else { "a" };
    match format.id {
        "path-csv" => "a list of points".to_owned(),
        _ => format!("{article} {} program", format.name),
    }
}
