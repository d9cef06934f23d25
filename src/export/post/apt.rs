//! The compensated path as APT cutter location text (CLDATA, ISO 3592 in its readable form).
//!
//! `UNITS`, `MULTAX` where the tool axis is given, `SPINDL`, `RAPID` before each rapid move,
//! `FEDRAT` where the feed changes, `DELAY` in seconds, `GOTO` with x, y, z and, unless the axis is
//! +Z throughout, i, j, k. Comments start with `$$`.

use super::{Dialect, PostedStep};
use crate::export::command::{Command, CommandedMove};
use crate::export::header::{self, number};
use crate::export::thin::Point;
use crate::report::Report;
use crate::units::{INCH, MM, RPM};

/// Longest line of the header [characters].
const WIDTH: usize = 68;

/// APT, in mm or, if the original is, in inches.
pub(super) struct Apt {
    inch: bool,
    /// Whether the tool axis is given.
    tilted: bool,
}

impl Apt {
    pub(super) fn new(command: &Command) -> Self {
        Self { inch: command.style.inch, tilted: command.is_tilted() }
    }

    /// Unit of length [m].
    fn size(&self) -> f64 {
        if self.inch { INCH } else { MM }
    }

    fn goto(&self, point: &Point) -> String {
        let decimals = if self.inch { 6 } else { 5 };
        let [x, y, z] = point.position.map(|x| number(x / self.size(), decimals)).into();
        let [i, j, k] = point.axis.map(|x| number(x, 9)).into();
        if self.tilted { format!("GOTO/{x},{y},{z},{i},{j},{k}") } else { format!("GOTO/{x},{y},{z}") }
    }
}

impl Dialect for Apt {
    fn opening(&mut self, _report: &Report, command: &Command, header: &[String]) -> Vec<String> {
        let mut lines = vec!["PARTNO/ARMILL".to_owned()];
        lines.extend(header::wrapped(header, WIDTH).iter().map(|line| self.comment(line)));
        lines.push(format!("UNITS/{}", if self.inch { "INCHES" } else { "MM" }));
        if self.tilted {
            lines.push("MULTAX/ON".into());
        }
        lines.extend(["RAPID".into(), self.goto(&command.start)]);
        lines
    }

    fn comment(&self, text: &str) -> String {
        format!("$$ {text}")
    }

    fn spindle(&self, rpm: f64) -> String {
        format!("SPINDL/{},RPM,CLW", number(rpm, 2))
    }

    fn wait(&self, time: f64) -> String {
        format!("DELAY/{}", number(time, 4))
    }

    /// A rapid has none: the previous feed stays in force.
    fn feed(&self, commanded: &CommandedMove) -> Option<String> {
        let unit = if self.inch { "IPM" } else { "MMPM" };
        let feed = number(commanded.feed / (self.size() * RPM), 4);
        (!commanded.rapid && !commanded.steps.is_empty()).then(|| format!("FEDRAT/{feed},{unit}"))
    }

    fn step(&mut self, target: &PostedStep) -> String {
        let rapid = if target.commanded.rapid { "RAPID\n" } else { "" };
        format!("{rapid}{}", self.goto(&target.step.to))
    }

    fn closing(&self) -> Vec<String> {
        vec!["SPINDL/OFF".into(), "FINI".into()]
    }
}
