//! The programs of a report. One rehearsal of each serves its accuracy, its header and its file.

use crate::error::Error;
use crate::export::command::ProgramRun;
use crate::export::post::robot::PackageFile;
use crate::export::style::{Junctions, PostStyle};
use crate::export::{self, Export, ExportOptions, Format};
use crate::export::{post, posture};
use crate::report::{Report, VerdictState, millimetres};
use crate::setup::Controller;
use crate::units::MM;
use crate::verification::rehearsal::{Rehearsal, rehearse};
use crate::verification::remarks::remarks;
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

/// The files that a controller loads, and how they run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Package {
    /// Its controller.
    pub controller: &'static str,
    /// Name of the program.
    pub name: String,
    /// The files; the main program first.
    pub files: Vec<PackageFile>,
    /// Largest contour error when it runs, if every number is exact [mm].
    pub max_mm: f64,
    /// Largest distance of a point of the desired path from the tip's way [mm]: of corners that are
    /// blended.
    pub missed_mm: f64,
    /// 95 % quantile of the larger of these errors [mm].
    pub p95_mm: f64,
    /// Whether the job's tolerance is met at 95 %.
    pub met: bool,
    /// Time from the start to the end of the path [s].
    pub duration_s: f64,
    /// Number of points, the start included.
    pub points: usize,
    /// Number of full stops on the way.
    pub stops: usize,
    /// Distance before a point at which the path leaves for the next [mm], or, of a FANUC program, the
    /// number after CNT; 0 is an exact stop at every point.
    pub blending: f64,
    /// What to look out for before running it.
    pub remarks: Vec<String>,
    /// How it runs, in words.
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
        let Rehearsal { command, run, .. } = self.rehearsal(report, style)?;
        post::expressible(report, command, id)?;
        let (state, p95) = (report.verdict_state_at(run.worst()), report.p95_at(run.worst()));
        let sentence = format!("As {}: {}", in_words(format), judged(report, run));
        let met = state == VerdictState::Met;
        Ok(ProgramAccuracy {
            max_mm: run.reached / MM,
            met,
            verdict_state: state,
            p95_mm: p95 / MM,
            sentence,
        })
    }

    /// The same for the format that most controllers read: G-code, or APT where three axes cannot
    /// express the path.
    ///
    /// # Errors
    /// See [`Programs::accuracy`].
    pub fn usual_accuracy(&self, report: &Report) -> Result<ProgramAccuracy, Error> {
        self.accuracy(report, "gcode").or_else(|_| self.accuracy(report, "apt"))
    }

    /// The path as a package for a controller; by default the job's.
    ///
    /// # Errors
    /// [`Error::Invalid`] for G-code if the tool axis differs from +Z anywhere, and for a name that the
    /// controller does not take; otherwise see [`rehearse`].
    pub fn package(&self, report: &Report, controller: Option<Controller>) -> Result<Package, Error> {
        let options = &report.setup().output;
        let controller = controller.unwrap_or(options.controller);
        let format = export::format(format_of(controller))?;
        let style = PostStyle::of(format, report)
            .ok_or_else(|| Error::invalid("controller", controller.id(), "one that runs programs"))?;
        let Rehearsal { commanded_path, command, run } = self.rehearsal(report, style)?;
        let joints = if style.is_robot() { posture::joints(report, command)? } else { Vec::new() };
        let files = if style.is_robot() {
            post::robot::package(report, command, &joints, controller, false)?
        } else {
            let text = export::program(report, format, commanded_path, command)?.text;
            vec![PackageFile { path: format!("{}.{}", options.name, format.extension), text }]
        };
        let blending = match style.junctions {
            Junctions::Share => (command.blend * 100.0).round(),
            _ => command.blend / MM,
        };
        Ok(Package {
            controller: controller.id(),
            name: options.name.clone(),
            files,
            max_mm: run.reached / MM,
            p95_mm: report.p95_at(run.worst()) / MM,
            missed_mm: run.missed / MM,
            met: report.verdict_state_at(run.worst()) == VerdictState::Met,
            duration_s: run.duration,
            points: command.points(),
            stops: run.stops,
            blending,
            remarks: remarks(report, command, &joints, controller),
            sentence: format!(
                "As {}: {:.1} s with {} {}, {}",
                in_words(format),
                run.duration,
                run.stops,
                if run.stops == 1 { "stop" } else { "stops" },
                judged(report, run)
            ),
        })
    }

    fn rehearsal(&self, report: &Report, style: PostStyle) -> Result<&Rehearsal, Error> {
        let rehearsed = self.rehearsed[style.index()].get_or_init(|| rehearse(report, None, style));
        rehearsed.as_ref().map_err(Clone::clone)
    }
}

/// Id of the format in which a controller takes a program.
fn format_of(controller: Controller) -> &'static str {
    match controller {
        Controller::Kuka => "krl",
        Controller::Abb => "rapid",
        Controller::Staubli => "val3",
        Controller::Fanuc => "fanuc",
        Controller::Gcode => "gcode",
        Controller::Apt => "apt",
        Controller::Csv => "path-csv",
    }
}

/// A program's errors in words, compared with the tolerance.
fn judged(report: &Report, run: &ProgramRun) -> String {
    let worst = run.worst();
    let (state, p95) = (report.verdict_state_at(worst), report.p95_at(worst));
    let of_corners = if run.missed > run.reached { " (of blended corners)" } else { "" };
    let figures =
        format!("up to {} mm at 95 %, nominally {} mm{of_corners}", millimetres(p95), millimetres(worst));
    let tolerance = report.setup().goal.tolerance;
    let tolerance_text = millimetres(tolerance);
    match state {
        VerdictState::CannotRun => format!("cannot run; if it could, {figures}."),
        _ if p95 > tolerance => format!("{figures}; beyond the tolerance of {tolerance_text} mm."),
        _ => match report.decisive(state, worst) {
            Some(but) => format!("{figures}, but {but}; beyond the tolerance of {tolerance_text} mm."),
            None => format!("{figures}; within the tolerance of {tolerance_text} mm."),
        },
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
