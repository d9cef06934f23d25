//! Columns as CSV: a header of keys, one row a sample, numbers in full precision, comma and decimal point; and the path to command as
//! points, and as joint values at the sample time, behind lines that start with `#`.

use crate::column::Column;
use crate::export::command::{Block, Command};
use crate::export::header::{self, number};
use crate::export::thin::Point;
use crate::report::Report;
use crate::units::MM;
use std::fmt::Write;

/// All columns of the report.
pub fn columns(report: &Report) -> String {
    table(&report.columns())
}

/// The path to command: time, compensated position in the base frame, joint commands.
pub fn compensated(report: &Report) -> String {
    let wanted = |column: &Column| column.key == "time_s" || column.key.starts_with("compensated_");
    table(&report.columns().into_iter().filter(wanted).collect::<Vec<_>>())
}

/// The path to command as points in the workpiece frame with the tool axis (tip to spindle) and the speed of the move that ends there;
/// the first row is the start. Waits are left out: a reader stops at corners by its own rule.
pub fn path(report: &Report, command: &Command) -> String {
    let mut text = remarks(&header::lines(report, Some(command)));
    text.push_str("x_mm,y_mm,z_mm,i,j,k,feed_mm_s\n");
    let mut row = |point: &Point, feed: f64| {
        let lengths = point.position.iter().map(|x| number(x / MM, 5));
        let cells = lengths.chain(point.axis.iter().map(|x| number(*x, 9))).chain([number(feed / MM, 6)]);
        text.push_str(&cells.collect::<Vec<_>>().join(","));
        text.push('\n');
    };
    row(&command.start, command.blocks.first().map_or(report.setup.tempo.feed, |block: &Block| block.feed));
    for block in &command.blocks {
        for point in block.points() {
            row(point, block.feed);
        }
    }
    text
}

/// The joint commands at the sample time, not thinned.
pub fn joints(report: &Report) -> String {
    let wanted = |column: &Column| column.key == "time_s" || column.key.starts_with("compensated_q");
    let columns: Vec<_> = report
        .columns()
        .into_iter()
        .filter(wanted)
        .map(|column| Column { key: column.key.replace("compensated_", ""), ..column })
        .collect();
    remarks(&header::lines(report, None)) + &table(&columns)
}

fn remarks(lines: &[String]) -> String {
    lines.iter().map(|line| format!("# {line}\n")).collect()
}

/// Any columns of equal length. Numbers are the shortest text that reads back to the same bits.
pub fn table(columns: &[Column]) -> String {
    let rows = columns.iter().map(|column| column.values.len()).min().unwrap_or(0);
    let mut text = String::with_capacity((rows + 1) * columns.len() * 20);
    for (i, column) in columns.iter().enumerate() {
        text.push_str(if i == 0 { "" } else { "," });
        text.push_str(&column.key);
    }
    text.push('\n');
    for row in 0..rows {
        for (i, column) in columns.iter().enumerate() {
            text.push_str(if i == 0 { "" } else { "," });
            // Writing to a string cannot fail.
            let _ = write!(text, "{}", column.values[row]);
        }
        text.push('\n');
    }
    text
}
