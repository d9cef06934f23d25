//! Columns as CSV: a header of keys, one row a sample, numbers in full precision, comma and decimal point.

use crate::column::Column;
use crate::report::Report;
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
