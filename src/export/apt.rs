//! The compensated path as APT cutter location text (CLDATA, ISO 3592 in its readable form).
//!
//! `UNITS`, `MULTAX` where the tool axis is given, `SPINDL`, `RAPID` before each move that it is for, `FEDRAT` where it changes, `DELAY` in
//! seconds, `GOTO` with x, y, z and, where the axis is not +Z all along, i, j, k. Comments start with `$$`.

use crate::export::command::Command;
use crate::export::header::{self, number};
use crate::export::thin::Point;
use crate::report::Report;
use crate::units::{INCH, MM, RPM};

/// The program, in mm or, if the original is, in inches.
pub fn program(report: &Report, command: &Command) -> String {
    let (unit, size, decimals, per_minute) =
        if command.style.inch { ("INCHES", INCH, 6, "IPM") } else { ("MM", MM, 5, "MMPM") };
    let tilted = command.is_tilted();
    let goto = |point: &Point| {
        let [x, y, z] = point.position.map(|x| number(x / size, decimals)).into();
        let [i, j, k] = point.axis.map(|x| number(x, 9)).into();
        if tilted { format!("GOTO/{x},{y},{z},{i},{j},{k}") } else { format!("GOTO/{x},{y},{z}") }
    };
    let mut lines = vec!["PARTNO/ARMILL".to_owned()];
    lines.extend(
        header::wrapped(&header::lines(report, Some(command)), 68).iter().map(|line| format!("$$ {line}")),
    );
    lines.push(format!("UNITS/{unit}"));
    if tilted {
        lines.push("MULTAX/ON".into());
    }
    let (mut spindle, mut feed, mut line) = (None, None, 0);
    lines.extend(["RAPID".into(), goto(&command.start)]);
    for block in &command.blocks {
        if block.line != line {
            line = block.line;
            lines.push(format!("$$ line {line} of the original"));
        }
        if spindle != Some(block.spindle) {
            spindle = Some(block.spindle);
            lines.push(format!("SPINDL/{},RPM,CLW", number(block.rpm(), 2)));
        }
        if block.wait > 0.0 {
            lines.push(format!("DELAY/{}", number(block.wait, 4)));
        }
        if !block.rapid && feed != Some(block.feed) && !block.steps.is_empty() {
            feed = Some(block.feed);
            lines.push(format!("FEDRAT/{},{per_minute}", number(block.feed / (size * RPM), 4)));
        }
        for point in block.points() {
            if block.rapid {
                lines.push("RAPID".into());
            }
            lines.push(goto(point));
        }
    }
    lines.extend(["SPINDL/OFF".into(), "FINI".into(), String::new()]);
    lines.join("\n")
}
