//! Rows of numbers with an optional header: the cells of a pasted measurement, with the place of
//! each.

use crate::error::Error;
use crate::path::csv::cell::{is_passed_over, number, position, separate};

/// Largest number of rows: an hour at 1 kHz.
const MOST_ROWS: usize = 4_000_000;

/// A text of numbers, all rows as wide as the first.
pub(crate) struct Table<'a> {
    text: &'a str,
    field: &'static str,
    /// The names of the columns in lower case, split into words; empty without a header.
    pub(crate) names: Vec<Vec<String>>,
    header_line: usize,
    /// Number of cells in a row.
    pub(crate) width: usize,
    /// The numbers row by row; NaN for an empty cell.
    numbers: Vec<f64>,
    /// Line of each row, from 1.
    pub(crate) lines: Vec<usize>,
}

impl<'a> Table<'a> {
    /// Reads a text; `#` starts a comment.
    pub(crate) fn read(text: &'a str, field: &'static str) -> Result<Self, Error> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut table =
            Self { text, field, names: vec![], header_line: 0, width: 0, numbers: vec![], lines: vec![] };
        let mut cells = Vec::new();
        for (index, line) in text.lines().enumerate() {
            let line = line.split('#').next().unwrap_or_default();
            if is_passed_over(line) {
                continue;
            }
            separate(line, &mut cells);
            let place = |start: usize| position(index + 1, line, start);
            let named = |cell: &str| cell.trim_matches('"').starts_with(char::is_alphabetic);
            if table.width == 0 && cells.iter().any(|(_, cell)| named(cell)) {
                // A unit in brackets after a blank belongs to the name before it.
                for (start, cell) in &cells {
                    match table.names.last_mut() {
                        Some(name) if cell.starts_with(['[', '(']) => name.extend(words(cell)),
                        _ if named(cell) => table.names.push(words(cell)),
                        _ => return Err(table.error(place(*start), cell, "a name such as q1_deg")),
                    }
                }
                (table.width, table.header_line) = (table.names.len(), index + 1);
                continue;
            }
            if table.width == 0 {
                table.width = cells.len();
            }
            if cells.len() + 1 == table.width && line.trim_end().ends_with([',', ';']) {
                // A separator may end a line, but here the last cell is empty.
                cells.push((line.trim_end().len(), ""));
            }
            if cells.len() != table.width {
                let expected = format!("a row has {} cells here, as the first line says", table.width);
                let start = cells.get(table.width).or(cells.last()).map_or(0, |(start, _)| *start);
                return Err(table.error(place(start), &format!("{} cells", cells.len()), &expected));
            }
            if table.lines.len() >= MOST_ROWS {
                return Err(table.error(place(0), "one row more", "at most 4 million rows are read"));
            }
            let comma = table.width == 1 || cells.iter().all(|(_, cell)| !cell.is_empty());
            for (start, cell) in &cells {
                let value = if cell.is_empty() { Some(f64::NAN) } else { number(cell, comma) };
                let wrong = || table.error(place(*start), &format!("\"{cell}\""), "a number, such as 12.5");
                let value = value.ok_or_else(wrong)?;
                table.numbers.push(value);
            }
            table.lines.push(index + 1);
        }
        Ok(table)
    }

    /// The numbers of a row.
    pub(crate) fn row(&self, row: usize) -> &[f64] {
        &self.numbers[row * self.width..(row + 1) * self.width]
    }

    /// Number of rows.
    pub(crate) fn len(&self) -> usize {
        self.lines.len()
    }

    /// The error of a cell.
    pub(crate) fn cell_error(&self, row: usize, cell: usize, expected: &str) -> Error {
        self.line_error(self.lines[row], cell, expected)
    }

    /// The error of a name in the header.
    pub(crate) fn name_error(&self, name: usize, expected: &str) -> Error {
        self.line_error(self.header_line, name, expected)
    }

    fn line_error(&self, number: usize, cell: usize, expected: &str) -> Error {
        let line = self.text.lines().nth(number.saturating_sub(1)).unwrap_or_default();
        let line = line.split('#').next().unwrap_or_default();
        let mut cells = Vec::new();
        separate(line, &mut cells);
        let (start, found) = cells.get(cell).copied().unwrap_or((line.trim_end().len(), ""));
        let found = if found.is_empty() { "an empty cell".to_owned() } else { format!("\"{found}\"") };
        self.error(position(number, line, start), &found, expected)
    }

    /// The error of the text as a whole, at its end.
    pub(crate) fn end_error(&self, found: &str, expected: &str) -> Error {
        self.error((self.text.lines().count().max(1), 1), found, expected)
    }

    fn error(&self, (line, column): (usize, usize), found: &str, expected: &str) -> Error {
        Error::Text {
            field: self.field.into(),
            line,
            column,
            found: found.to_owned(),
            expected: expected.to_owned(),
        }
    }
}

/// A name in lower case, split at every character that is not a letter, digit, `µ` or slash.
fn words(name: &str) -> Vec<String> {
    let cut = name.to_lowercase();
    let apart = |c: char| !(c.is_alphanumeric() || c == '/');
    cut.split(apart).filter(|word| !word.is_empty()).map(str::to_owned).collect()
}
