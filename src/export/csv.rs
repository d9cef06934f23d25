//! Columns as CSV: a header of keys, one row per sample, numbers in full precision, comma and
//! decimal point. Also the path to command as points, and as joint values at the sample time, after
//! header lines that start with `#`.

use crate::column::Column;
use crate::export::command::Command;
use crate::export::header::{self, number};
use crate::export::thin::Point;
use crate::report::Report;
use crate::report::columns::Series;
use crate::units::MM;
use std::fmt::Write;
use std::ops::Range;

/// All columns of the report.
pub fn columns(report: &Report) -> String {
    rows(report, 0..report.samples())
}

/// A range of samples of all columns; the header comes with sample 0. A long run is a gigabyte of
/// text, so it is written in parts.
pub fn rows(report: &Report, samples: Range<usize>) -> String {
    let part = |series: &Series| Column::new(series.key.as_str(), "", "", series.values(samples.clone()));
    let columns: Vec<_> = report.series().iter().map(part).collect();
    let text = table(&columns);
    match text.split_once('\n') {
        Some((_, rows)) if samples.start > 0 => rows.to_owned(),
        _ => text,
    }
}

/// The path to command: time, compensated position in the base frame, joint commands.
pub fn compensated(report: &Report) -> String {
    table(&chosen(report, "compensated_"))
}

/// The path to command as points in the workpiece frame with the tool axis (tip to spindle) and the
/// speed of the move that ends there; the first row is the start. Waits are left out: a reader
/// stops at corners by its own rule.
pub fn path(report: &Report, command: &Command) -> String {
    let mut text = remarks(&header::lines(report, Some(command)));
    text.push_str("x_mm,y_mm,z_mm,i,j,k,feed_mm_s\n");
    let mut row = |point: &Point, feed: f64| {
        let lengths = point.position.iter().map(|x| number(x / MM, 5));
        let cells = lengths.chain(point.axis.iter().map(|x| number(*x, 9))).chain([number(feed / MM, 6)]);
        text.push_str(&cells.collect::<Vec<_>>().join(","));
        text.push('\n');
    };
    let feed = command.moves.first().map_or(report.setup().limits.feed, |commanded| commanded.feed);
    row(&command.start, feed);
    for commanded in &command.moves {
        for point in commanded.points() {
            row(point, commanded.feed);
        }
    }
    text
}

/// The joint commands at the sample time, not thinned.
pub fn joints(report: &Report) -> String {
    let mut columns = chosen(report, "compensated_q");
    for column in &mut columns {
        column.key = column.key.replace("compensated_", "");
    }
    remarks(&header::lines(report, None)) + &table(&columns)
}

/// The time, and the columns whose keys start with `start`.
fn chosen(report: &Report, start: &str) -> Vec<Column> {
    let wanted = |series: &&Series| series.key == "time_s" || series.key.starts_with(start);
    report.series().iter().filter(wanted).map(Series::column).collect()
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
