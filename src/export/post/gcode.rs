//! The compensated path as G-code (RS-274, ISO 6983).
//!
//! Points are absolute, in the workpiece frame, in the original's unit of length: they already
//! include its work offsets and tool lengths. I, J and K count from the start of the arc (G91.1); P
//! counts turns where an arc has more than one.

use super::{Dialect, PostedStep};
use crate::error::Error;
use crate::export::arc::Step;
use crate::export::command::{Command, CommandedMove};
use crate::export::header::number;
use crate::job::CompensateAt;
use crate::report::Report;
use crate::units::{INCH, MM, RPM};
use nalgebra::Vector3;
use std::fmt::Write;

/// The plane across each axis.
const PLANES: [&str; 3] = ["G19", "G18", "G17"];

/// A plain G-code program.
pub(super) struct Gcode {
    words: MoveWords,
}

impl Gcode {
    /// # Errors
    /// See [`MoveWords::new`].
    pub(super) fn new(report: &Report, command: &Command) -> Result<Self, Error> {
        Ok(Self { words: MoveWords::new(report, command)? })
    }
}

impl Dialect for Gcode {
    fn opening(&mut self, _report: &Report, command: &Command, header: &[String]) -> Vec<String> {
        let mut lines = vec!["%".to_owned()];
        lines.extend(header.iter().map(|line| comment(line)));
        lines.extend([self.words.modes(), self.words.start(command)]);
        lines
    }

    fn comment(&self, text: &str) -> String {
        comment(text)
    }

    fn spindle(&self, rpm: f64) -> String {
        format!("S{} M3", number(rpm, 2))
    }

    fn wait(&self, time: f64) -> String {
        wait(time)
    }

    fn step(&mut self, target: &PostedStep) -> String {
        self.words.step(target.step, target.commanded)
    }

    fn closing(&self) -> Vec<String> {
        ["M5", "M30", "%"].map(String::from).into()
    }
}

/// Text in the brackets of a comment.
pub(super) fn comment(text: &str) -> String {
    format!("({text})")
}

/// A dwell [s].
pub(super) fn wait(time: f64) -> String {
    format!(
        "G4 P{} (seconds at rest, until the shaped command has settled or as programmed)",
        number(time, 4)
    )
}

/// Whether three axes can express a command.
///
/// # Errors
/// [`Error::Invalid`] if the tool axis differs from +Z anywhere: of the field `compensation.at` if
/// only the correction tilts it.
pub(super) fn expressible(report: &Report, command: &Command) -> Result<(), Error> {
    let tilts = report.setup().compensate_at == CompensateAt::Axis;
    if tilts && command.is_tilted() && !command.is_desired_tilted() {
        return Err(Error::invalid(
            "compensation.at",
            "\"axis\"",
            "\"tip\" or \"middle\" for G-code, whose three axes cannot tilt the tool; \
             apt, path-csv, krl, rapid, val3 and fanuc give the tool axis",
        ));
    }
    if command.is_tilted() {
        return Err(Error::invalid(
            "format",
            "\"gcode\"",
            "the tool axis is not +Z throughout, which this G-code cannot express: use apt",
        ));
    }
    Ok(())
}

/// Writes the words of one move after another; a word that is still in force is left out.
pub(super) struct MoveWords {
    inch: bool,
    /// Where the tool is [m].
    at: Vector3<f64>,
    /// G0 to G3, as last written.
    motion: &'static str,
    /// G17, G18 or G19, as last written.
    plane: &'static str,
    /// Feed word as last written.
    feed: String,
}

impl MoveWords {
    /// The words before the first move.
    ///
    /// # Errors
    /// See [`expressible`].
    pub(super) fn new(report: &Report, command: &Command) -> Result<Self, Error> {
        expressible(report, command)?;
        let (inch, at) = (command.style.inch, command.start.position);
        Ok(Self { inch, at, motion: "", plane: PLANES[2], feed: String::new() })
    }

    /// Unit of length [m].
    fn size(&self) -> f64 {
        if self.inch { INCH } else { MM }
    }

    /// The modes that the moves rely on.
    pub(super) fn modes(&self) -> String {
        let unit = if self.inch { "G20" } else { "G21" };
        format!("{unit} G17 G40 G49 G80 G90 G94")
    }

    /// The rapid to the start of the command.
    pub(super) fn start(&mut self, command: &Command) -> String {
        self.words(&Step { to: command.start, arc: None }, None)
    }

    /// One step of a move.
    pub(super) fn step(&mut self, step: &Step, commanded: &CommandedMove) -> String {
        self.words(step, (!commanded.rapid).then_some(commanded.feed))
    }

    /// A step at a feed [m/s], or as a rapid.
    fn words(&mut self, step: &Step, feed: Option<f64>) -> String {
        let mut words = String::new();
        let motion = match step.arc {
            None if feed.is_none() => "G0",
            None => "G1",
            Some(arc) if arc.sweep < 0.0 => "G2",
            Some(_) => "G3",
        };
        if let Some(arc) = step.arc
            && self.plane != PLANES[arc.normal]
        {
            self.plane = PLANES[arc.normal];
            words.push_str(self.plane);
            words.push(' ');
        }
        if self.motion != motion {
            words.push_str(motion);
            self.motion = motion;
        }
        let (size, decimals) = (self.size(), if self.inch { 6 } else { 5 });
        // Writing to a string cannot fail.
        let mut length = |letter: char, value: f64| {
            let _ = write!(words, " {letter}{}", number(value / size, decimals));
        };
        for (letter, value) in ['X', 'Y', 'Z'].into_iter().zip(step.to.position.iter()) {
            length(letter, *value);
        }
        if let Some(arc) = step.arc {
            let offset = arc.center - self.at;
            let in_plane = |(axis, _): &(usize, char)| *axis != arc.normal;
            for (axis, letter) in ['I', 'J', 'K'].into_iter().enumerate().filter(in_plane) {
                length(letter, offset[axis]);
            }
            let turns = arc.turns();
            if turns > 1.0 {
                let _ = write!(words, " P{turns}");
            }
        }
        self.at = step.to.position;
        if let Some(feed) = feed {
            let feed = format!(" F{}", number(feed / (size * RPM), 4));
            if self.feed != feed {
                words.push_str(&feed);
                self.feed = feed;
            }
        }
        words.trim().to_owned()
    }
}
