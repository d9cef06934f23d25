//! Programs for machines and robots: one driver, one `Dialect` for each controller.
//!
//! The driver walks the moves of a [`Command`] once and tracks what changes from one to the next:
//! the line of the original program, the spindle, the feed, a wait. A dialect provides the words
//! for each of these. To support another controller, add a file with its dialect here, a line in
//! [`program`], and a row in [`FORMATS`](crate::export::FORMATS).
//!
//! A program that was read from G-code is not written from scratch but `rewritten`: it keeps its
//! lines.

mod apt;
mod fanuc;
mod gcode;
mod krl;
mod rapid;
mod rewritten;
mod val3;

use crate::error::Error;
use crate::export::arc::Step;
use crate::export::command::{Command, CommandedMove};
use crate::export::header::{self, number};
use crate::math::Pose;
use crate::report::Report;

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
        "krl" => write(report, command, &mut krl::Krl),
        "rapid" => write(report, command, &mut rapid::Rapid::default()),
        "val3" => write(report, command, &mut val3::Val3),
        "fanuc" => write(report, command, &mut fanuc::Fanuc::default()),
        _ => return Err(super::unknown_format(id)),
    })
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
        self.comment(&format!("spindle clockwise at {} rpm: switch it by your own signals", number(rpm, 2)))
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
    /// The TCP at its end, in the workpiece frame.
    pose: Pose,
    /// Whether the tool comes to rest there.
    stops: bool,
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
        for (index, step) in commanded.steps.iter().enumerate() {
            let stops = commanded.stops && index + 1 == commanded.steps.len();
            lines.push(dialect.step(&PostedStep { step, commanded, pose: command.pose(&step.to), stops }));
        }
    }
    lines.extend(dialect.closing());
    dialect.file(&lines)
}
