//! Programs for machines and robots.
//!
//! For machines there is one driver, and one `Dialect` for each language. The driver walks the moves
//! of a [`Command`] once and tracks what changes from one to the next: the line of the original
//! program, the spindle, the feed, a wait. A dialect provides the words for each of these. Robots'
//! controllers take packages of files: see [`robot`].
//!
//! A program that was read from G-code is not written from scratch but `rewritten`: it keeps its
//! lines.

mod apt;
mod fanuc;
mod gcode;
mod krl;
mod rapid;
mod rewritten;
pub mod robot;
mod val3;

use crate::error::Error;
use crate::export::arc::Step;
use crate::export::command::{Command, CommandedMove};
use crate::export::header::{self, number};
use crate::export::posture;
use crate::report::Report;
use crate::setup::Controller;

/// Writes the program of the format `id`.
///
/// # Errors
/// [`Error::Invalid`] for a format that is not a program, and for G-code if the tool axis differs
/// from +Z anywhere.
pub fn program(report: &Report, command: &Command, id: &str) -> Result<String, Error> {
    Ok(match id {
        "gcode" => match rewritten::original(report, command) {
            Some(original) => rewritten::program(report, command, original)?,
            None => write(report, command, &mut gcode::Gcode::new(report, command)?),
        },
        "apt" => write(report, command, &mut apt::Apt::new(command)),
        "krl" => main_file(report, command, Controller::Kuka, "src")?,
        "rapid" => main_file(report, command, Controller::Abb, "mod")?,
        "val3" => main_file(report, command, Controller::Staubli, "pgx")?,
        "fanuc" => main_file(report, command, Controller::Fanuc, "LS")?,
        _ => return Err(super::unknown_format(id)),
    })
}

/// The main program of a package, with all moves in it.
fn main_file(
    report: &Report,
    command: &Command,
    controller: Controller,
    extension: &str,
) -> Result<String, Error> {
    let joints = posture::joints(report, command)?;
    let files = robot::package(report, command, &joints, controller, true)?;
    let main = files.into_iter().find(|file| file.path.ends_with(extension));
    Ok(main.map_or_else(String::new, |file| file.text))
}

/// Whether the format `id` can express a command.
///
/// # Errors
/// [`Error::Invalid`] for G-code if the tool axis differs from +Z anywhere.
pub fn expressible(report: &Report, command: &Command, id: &str) -> Result<(), Error> {
    if id == "gcode" { gcode::expressible(report, command) } else { Ok(()) }
}

/// The language of a controller. Each text is one or more lines of the program, without the final
/// line break.
trait Dialect {
    /// Everything before the first move: `header` as comments, the frames, the approach to the
    /// start.
    fn opening(&mut self, report: &Report, command: &Command, header: &[String]) -> Vec<String>;

    /// A comment among the moves.
    fn comment(&self, text: &str) -> String;

    /// A change of spindle speed [rev/min].
    fn spindle(&self, rpm: f64) -> String {
        self.comment(&format!("spindle clockwise at {} rpm: switch it with your own signals", number(rpm, 2)))
    }

    /// A dwell [s].
    fn wait(&self, time: f64) -> String;

    /// The feed of a move, where it differs from the last one written. `None` if it needs no line
    /// of its own here; the next move then gets another chance.
    fn feed(&self, _commanded: &CommandedMove) -> Option<String> {
        None
    }

    /// A step, from where the tool is.
    fn step(&mut self, target: &PostedStep) -> String;

    /// Everything after the last move.
    fn closing(&self) -> Vec<String>;

    /// The file that holds these lines.
    fn file(&self, lines: &[String]) -> String {
        lines.join("\n") + "\n"
    }
}

/// A step of a move for a dialect to write.
struct PostedStep<'a> {
    /// Its end, and the arc to it if it is not straight.
    step: &'a Step,
    /// The move that it belongs to.
    commanded: &'a CommandedMove,
}

/// Writes the command in a dialect.
fn write(report: &Report, command: &Command, dialect: &mut dyn Dialect) -> String {
    let mut lines = dialect.opening(report, command, &header::lines(report, Some(command)));
    let (mut line, mut spindle, mut feed) = (0, None, None);
    for commanded in &command.moves {
        if line != commanded.line {
            line = commanded.line;
            lines.push(dialect.comment(&format!("line {line} of the original")));
        }
        if spindle != Some(commanded.spindle) {
            spindle = Some(commanded.spindle);
            lines.push(dialect.spindle(commanded.rpm()));
        }
        if commanded.wait > 0.0 {
            lines.push(dialect.wait(commanded.wait));
        }
        if feed != Some(commanded.feed)
            && let Some(text) = dialect.feed(commanded)
        {
            feed = Some(commanded.feed);
            lines.push(text);
        }
        lines.extend(commanded.steps.iter().map(|step| dialect.step(&PostedStep { step, commanded })));
    }
    lines.extend(dialect.closing());
    dialect.file(&lines)
}
