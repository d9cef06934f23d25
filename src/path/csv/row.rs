//! Rows of numbers: lines split into cells, and the meaning of commas.

use super::cell::{Separator, is_passed_over, number, position, separate_by, unquoted, without_gaps};
use super::header::{Columns, MOST, Width};
use super::index;
use crate::error::Error;
use crate::path::builder::{self, Fault};
use crate::path::lines::TextLines;
use crate::path::unit::LengthUnit;
use nalgebra::Vector3;

/// Meaning of the commas in the rows so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Comma {
    Separator,
    Decimal,
}

/// One row of numbers.
pub(super) struct Row<'a> {
    /// Line of the text, from 1.
    pub(super) line: usize,
    pub(super) columns: Columns,
    /// The numbers in the order of the text; only the first `columns.count` are used.
    pub(super) numbers: [f64; MOST],
    /// x, y, z [m].
    pub(super) point: Vector3<f64>,
    text: &'a str,
    starts: [usize; MOST],
}

impl Row<'_> {
    /// Line and column of a cell.
    pub(super) fn position(&self, cell: usize) -> (usize, usize) {
        position(self.line, self.text, self.starts[cell])
    }
}

/// The rows of a text, in order.
pub(super) struct Rows<'a> {
    lines: std::iter::Enumerate<TextLines<'a>>,
    count: usize,
    field: &'a str,
    unit: LengthUnit,
    width: Width,
    columns: Option<Columns>,
    /// The separator that a first line `sep=;` states.
    stated: Option<Separator>,
    comma: Option<Comma>,
    /// Whether a decimal point has been seen.
    decimal_point: bool,
    /// Whether a decimal comma has been seen, perhaps between quotation marks.
    decimal_comma: bool,
    /// Whether a row has shown that its commas are separators.
    settled: bool,
    /// The first row whose commas may be either, with its position.
    ambiguous: Option<((usize, usize), &'a str)>,
    cells: Vec<(usize, &'a str)>,
}

impl<'a> Rows<'a> {
    pub(super) fn new(text: &'a str, field: &'a str, unit: LengthUnit, width: Width) -> Self {
        Self {
            lines: TextLines::of(text).enumerate(),
            count: 0,
            field,
            unit,
            width,
            columns: None,
            stated: None,
            comma: None,
            decimal_point: false,
            decimal_comma: false,
            settled: false,
            ambiguous: None,
            cells: Vec::with_capacity(8),
        }
    }

    /// Number of lines read.
    pub(super) fn lines(&self) -> usize {
        self.count
    }

    /// The unit of length in effect.
    pub(super) fn unit(&self) -> LengthUnit {
        self.columns.and_then(|columns| columns.unit).unwrap_or(self.unit)
    }

    pub(super) fn error(&self, position: (usize, usize), found: &str, expected: &str) -> Error {
        Fault::new(found, expected).at(self.field, position)
    }

    /// The next row of numbers.
    pub(super) fn next_row(&mut self) -> Result<Option<Row<'a>>, Error> {
        while let Some((index, line)) = self.lines.next() {
            self.count = index + 1;
            let text = line.split('#').next().unwrap_or_default();
            if is_passed_over(text) && !(self.columns.is_none() && is_header_after_index(text)) {
                continue;
            }
            if let (None, None, Some(stated)) = (self.columns, self.stated, stated_separator(text)) {
                self.settled = stated == Separator::Comma;
                self.stated = Some(stated);
                continue;
            }
            let separator = separate_by(self.stated, text, &mut self.cells);
            let columns = match self.columns {
                Some(columns) => columns,
                None => {
                    let (columns, header) = self.columns_of(text)?;
                    self.columns = Some(columns);
                    if header {
                        continue;
                    }
                    columns
                }
            };
            return self.row(text, separator, columns).map(Some);
        }
        self.ambiguity().map_or(Ok(None), Err)
    }

    /// The error of the first row whose commas may be either, unless a row has shown what they are.
    pub(super) fn ambiguity(&self) -> Option<Error> {
        let (position, row) = self.ambiguous?;
        let expected = "the text does not show whether the commas are decimal signs: name the columns in a first line (x,y,z,feed), \
                        or separate the cells by semicolons";
        Some(self.error(position, &format!("\"{row}\""), expected))
    }

    /// The columns given by the first line, and whether it is a header.
    fn columns_of(&mut self, text: &'a str) -> Result<(Columns, bool), Error> {
        let line = self.count;
        let named = |cell: &str| cell.trim_matches('"').chars().next().is_some_and(char::is_alphabetic);
        let unit = |cell: &str| cell.starts_with(['[', '(']);
        // The first name may be missing, before an index.
        let nameless = self.cells.first().is_some_and(|(_, cell)| cell.trim_matches('"').is_empty());
        if !self.cells.iter().skip(usize::from(nameless)).all(|(_, cell)| named(cell) || unit(cell))
            || !self.cells.iter().any(|(_, cell)| named(cell))
        {
            let lines = self.lines.clone().map(|(_, line)| line);
            if self.width == Width::Any && index::is_first(&self.cells, self.stated, lines) {
                return Columns::after_index(self.cells.len(), self.width)
                    .map(|columns| (columns, false))
                    .map_err(|fault| self.miscounted(text, MOST, fault));
            }
            let columns = Columns::of_count(self.cells.len(), self.width);
            let most = if self.width == Width::Points { 3 } else { MOST - 1 };
            return columns
                .map(|columns| (columns, false))
                .map_err(|fault| self.miscounted(text, most, fault));
        }
        // With blanks as separators, a unit in brackets belongs to the name before it.
        let mut names: Vec<(usize, &str)> = Vec::new();
        for (start, cell) in &self.cells {
            match names.last_mut() {
                Some((first, name)) if unit(cell) => *name = text[*first..start + cell.len()].trim(),
                _ => names.push((*start, cell)),
            }
        }
        let texts: Vec<&str> = names.iter().map(|(_, name)| name.trim_matches('"')).collect();
        Columns::of_names(&texts, self.width).map(|columns| (columns, true)).map_err(|(cell, fault)| {
            let start = names.get(cell).map_or(0, |(start, _)| *start);
            fault.at(self.field, position(line, text, start))
        })
    }

    /// The error for a line with the wrong number of cells. A cell that is not a number is reported
    /// in preference to the count.
    fn miscounted(&self, text: &str, count: usize, fault: Fault) -> Error {
        let of = |start: usize| position(self.count, text, start);
        let wrong = self.cells.iter().find(|(_, cell)| value(cell, Separator::Blank).is_err());
        match (wrong, self.cells.get(count).or(self.cells.last())) {
            (Some((start, cell)), _) => not_a_number(cell).at(self.field, of(*start)),
            (None, last) => fault.at(self.field, of(last.map_or(0, |(start, _)| *start))),
        }
    }

    fn row(&mut self, text: &'a str, separator: Separator, columns: Columns) -> Result<Row<'a>, Error> {
        let line = self.count;
        if self.cells.len() != columns.count {
            let mut expected = format!("a row has {} cells here, as the first line says", columns.count);
            if separator == Separator::Comma {
                expected.push_str("; if commas are decimal signs, separate the cells by semicolons");
            }
            let fault = Fault::new(format!("{} cells", self.cells.len()), expected);
            return Err(self.miscounted(text, columns.count, fault));
        }
        let (mut numbers, mut starts) = ([0.0; MOST], [0; MOST]);
        for (index, (start, cell)) in self.cells.iter().enumerate() {
            let fail = |fault: Fault| fault.at(self.field, position(line, text, *start));
            starts[index] = *start;
            if columns.index == Some(index) {
                continue;
            }
            numbers[index] = value(cell, separator).map_err(&fail)?;
            self.decimal_point |= cell.contains('.');
            self.decimal_comma |= cell.contains(',');
            let comma = match separator {
                Separator::Comma => Some(Comma::Separator),
                _ => cell.contains(',').then_some(Comma::Decimal),
            };
            if comma.is_some_and(|comma| *self.comma.get_or_insert(comma) != comma) {
                let expected = "commas must be either decimal signs or separators throughout the text";
                return Err(fail(Fault::new(format!("\"{}\"", text.trim()), expected)));
            }
            if self.decimal_comma && self.decimal_point {
                return Err(fail(Fault::new(
                    format!("\"{cell}\""),
                    "decimal signs must be either points or commas throughout the text",
                )));
            }
        }
        if separator == Separator::Comma && !columns.named && columns.count.is_multiple_of(2) && !self.settled
        {
            // A decimal point, an exponent, or a sign where the fraction would be.
            let shows = |(index, (_, cell)): (usize, &(usize, &str))| {
                cell.contains(['.', 'e', 'E', '"']) || (index % 2 == 1 && cell.starts_with(['-', '+']))
            };
            self.settled = self.cells.iter().enumerate().any(shows);
            let here = (position(line, text, self.cells[0].0), text.trim());
            self.ambiguous = if self.settled { None } else { self.ambiguous.or(Some(here)) };
        }
        let mut point = Vector3::zeros();
        for (value, cell) in point.iter_mut().zip(columns.point) {
            let fail = |fault: Fault| fault.at(self.field, position(line, text, starts[cell]));
            *value = builder::coordinate(numbers[cell] * self.unit().in_m()).map_err(fail)?;
        }
        Ok(Row { line, columns, numbers, point, text, starts })
    }
}

/// Whether a line that looks like a comment is a header with a nameless first column: `;x;y;z`.
fn is_header_after_index(text: &str) -> bool {
    let names: Vec<&str> = text.split(';').map(str::trim).collect();
    Columns::of_names(&names, Width::Any).is_ok()
}

/// The separator that a line `sep=;` states, as spreadsheets write it for themselves.
fn stated_separator(text: &str) -> Option<Separator> {
    let text = text.trim_start().trim_start_matches('"');
    let stated = text.get(..4).filter(|start| start.eq_ignore_ascii_case("sep="))?;
    match text[stated.len()..].trim_end_matches(['"', ' ', '\r']) {
        ";" => Some(Separator::Semicolon),
        "," => Some(Separator::Comma),
        "\t" => Some(Separator::Tab),
        "" => Some(Separator::Blank),
        _ => None,
    }
}

/// The number in a cell, perhaps between quotation marks or with its thousands set off.
fn value(cell: &str, separator: Separator) -> Result<f64, Fault> {
    let inner = unquoted(cell);
    let comma = separator != Separator::Comma || inner.is_some();
    let text = inner.unwrap_or(cell);
    let thousands = |text: &str| text.split_once(',').is_some_and(|(_, fraction)| fraction.len() == 3);
    if separator == Separator::Comma && inner.is_some_and(thousands) {
        let expected = "the text does not show whether this comma is a decimal sign: write 1234 or 1.234";
        return Err(Fault::new(cell, expected));
    }
    let grouped = || number(&without_gaps(text).filter(|_| comma)?, comma);
    number(text, comma).or_else(grouped).ok_or_else(|| not_a_number(cell))
}

fn not_a_number(cell: &str) -> Fault {
    Fault::new(format!("\"{}\"", unquoted(cell).unwrap_or(cell)), "a number, such as 12.5")
}
