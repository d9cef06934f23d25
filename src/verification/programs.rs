//! The programs of a report. One rehearsal of each serves its accuracy, its header and its file.

use crate::error::Error;
use crate::export::post;
use crate::export::style::PostStyle;
use crate::export::{self, Export, ExportOptions, Format};
use crate::report::{Report, VerdictState, millimetres};
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
    /// Largest contour error when the program runs, if every number is exact [mm].
    pub max_mm: f64,
    /// Whether the job's tolerance is met at 95 %.
    pub met: bool,
    /// The verdict on the program; see [`Report::verdict_state_at`].
    pub verdict_state: VerdictState,
    /// 95 % quantile of the largest contour error [mm].
    pub p95_mm: f64,
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
        let Rehearsal { command, reached, .. } = self.rehearsal(report, style)?;
        post::expressible(report, command, id)?;
        let (state, p95) = (report.verdict_state_at(*reached), report.p95_at(*reached));
        let figures =
            format!("up to {} mm at 95 %, nominally {} mm", millimetres(p95), millimetres(*reached));
        let tolerance = report.setup().goal.tolerance;
        let tolerance_text = millimetres(tolerance);
        let judged = match state {
            VerdictState::CannotRun => format!("cannot run; if it could, {figures}."),
            _ if p95 > tolerance => format!("{figures}; beyond the tolerance of {tolerance_text} mm."),
            _ => match report.decisive(state, *reached) {
                Some(but) => format!("{figures}, but {but}; beyond the tolerance of {tolerance_text} mm."),
                None => format!("{figures}; within the tolerance of {tolerance_text} mm."),
            },
        };
        let sentence = format!("As {}: {judged}", in_words(format));
        let met = state == VerdictState::Met;
        Ok(ProgramAccuracy { max_mm: reached / MM, met, verdict_state: state, p95_mm: p95 / MM, sentence })
    }

    /// The same for the format that most controllers read: G-code, or APT where three axes cannot
    /// express the path.
    ///
    /// # Errors
    /// See [`Programs::accuracy`].
    pub fn usual_accuracy(&self, report: &Report) -> Result<ProgramAccuracy, Error> {
        self.accuracy(report, "gcode").or_else(|_| self.accuracy(report, "apt"))
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
