//! Splits lines into cells, and reads cells as numbers.

use std::borrow::Cow;

/// Separator of the cells in a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Separator {
    Semicolon,
    Comma,
    Tab,
    Blank,
}

impl Separator {
    /// Whether a character ends a cell.
    fn ends(self, c: char) -> bool {
        match self {
            Self::Semicolon => c == ';',
            Self::Comma => c == ',',
            Self::Tab => c == '\t',
            Self::Blank => c.is_whitespace(),
        }
    }
}

/// Line and column, both from 1; columns count characters.
pub(crate) fn position(line: usize, text: &str, byte: usize) -> (usize, usize) {
    (line, text[..byte].chars().count() + 1)
}

/// The number in a cell; `comma` allows a decimal comma.
pub(crate) fn number(cell: &str, comma: bool) -> Option<f64> {
    // `inf` and `nan` are not numbers here.
    if !cell.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b) || (comma && b == b',')) {
        return None;
    }
    let value: f64 = match cell.split_once(',') {
        Some((whole, fraction))
            if !whole.contains('.') && fraction.starts_with(|c: char| c.is_ascii_digit()) =>
        {
            format!("{whole}.{fraction}").parse().ok()?
        }
        Some(_) => return None,
        None => cell.parse().ok()?,
    };
    value.is_finite().then_some(value)
}

/// The number without what sets off its thousands: `1 234,5`, also with a no-break space, a thin
/// space or an apostrophe. `None` if there is nothing of the kind, or not between groups of three
/// digits.
pub(super) fn without_gaps(cell: &str) -> Option<String> {
    let gap = |c: char| c == ' ' || is_no_break(c) || matches!(c, '\'' | '\u{2019}');
    let (whole, fraction) = cell.split_at(cell.find(['.', ',']).unwrap_or(cell.len()));
    let mut groups = whole.trim_start_matches(['+', '-']).split(gap);
    let digits = |group: &str| group.bytes().all(|b| b.is_ascii_digit());
    let first = groups.next().is_some_and(|group| (1..=3).contains(&group.len()) && digits(group));
    let mut others = groups.peekable();
    let regular = first && others.peek().is_some() && others.all(|group| group.len() == 3 && digits(group));
    (regular && !fraction.contains(gap)).then(|| cell.chars().filter(|c| !gap(*c)).collect())
}

/// A space that does not end a line: spreadsheets set off thousands with it.
fn is_no_break(c: char) -> bool {
    matches!(c, '\u{a0}' | '\u{2007}' | '\u{2009}' | '\u{202f}')
}

/// What stands between a cell's quotation marks, if it has them.
pub(super) fn unquoted(cell: &str) -> Option<&str> {
    cell.strip_prefix('"')?.strip_suffix('"').map(str::trim)
}

/// Whether a line is skipped: only separators, or a comment that starts with a semicolon and a
/// word.
pub(crate) fn is_passed_over(text: &str) -> bool {
    let rest = text.trim_start();
    let comment =
        rest.strip_prefix(';').is_some_and(|words| words.trim_start().starts_with(char::is_alphabetic));
    comment || rest.chars().all(|c| c.is_whitespace() || c == ',' || c == ';')
}

/// Splits a line into cells, each with its byte offset. A trailing separator is allowed. Between
/// quotation marks nothing separates.
pub(crate) fn separate<'a>(text: &'a str, cells: &mut Vec<(usize, &'a str)>) -> Separator {
    separate_by(None, text, cells)
}

/// Splits a line at the separator that the text states, if it states one.
pub(super) fn separate_by<'a>(
    stated: Option<Separator>,
    text: &'a str,
    cells: &mut Vec<(usize, &'a str)>,
) -> Separator {
    let separator = stated.unwrap_or_else(|| separator_of(&masked(text)));
    cut(text, cells, |c| separator.ends(c), separator == Separator::Blank);
    // A space that sets off thousands is within a number; others separate like all blanks.
    if separator == Separator::Blank && text.contains(is_no_break) {
        cut(text, cells, |c| c.is_whitespace() && !is_no_break(c), true);
        if cells.iter().any(|(_, cell)| cell.contains(is_no_break) && without_gaps(cell).is_none()) {
            cut(text, cells, char::is_whitespace, true);
        }
    }
    separator
}

fn cut<'a>(text: &'a str, cells: &mut Vec<(usize, &'a str)>, ends: impl Fn(char) -> bool, drop_empty: bool) {
    cells.clear();
    let shape = masked(text);
    let mut start = shape.len() - shape.trim_start().len();
    for piece in shape.trim().split_inclusive(&ends) {
        let length = piece.strip_suffix(&ends).unwrap_or(piece).len();
        let cell = &text[start..start + length];
        let lead = cell.len() - cell.trim_start().len();
        if !drop_empty || !cell.trim().is_empty() {
            cells.push((start + lead, cell.trim()));
        }
        start += piece.len();
    }
}

/// The line with a digit for each byte of what quotation marks enclose.
fn masked(text: &str) -> Cow<'_, str> {
    // A single quotation mark encloses nothing.
    if !text.contains('"') || text.matches('"').count() % 2 == 1 {
        return text.into();
    }
    let mask =
        |(index, part): (usize, &str)| if index % 2 == 1 { "0".repeat(part.len()) } else { part.into() };
    text.split('"').enumerate().map(mask).collect::<Vec<_>>().join("\"").into()
}

fn separator_of(text: &str) -> Separator {
    if text.contains(';') {
        return Separator::Semicolon;
    }
    if text.contains('\t') && text.trim().split('\t').all(is_one_cell) {
        return Separator::Tab;
    }
    // Commas are decimal signs if blanks separate the cells and each comma has a digit on both
    // sides: in `1,5 2,5`, but not in `1, 2`.
    let inner_blank = |cell: &str| cell.trim().contains(char::is_whitespace);
    let digit = |byte: Option<&u8>| byte.is_some_and(u8::is_ascii_digit);
    let bytes = text.as_bytes();
    let between_digits =
        |(at, _): (usize, &str)| at > 0 && digit(bytes.get(at - 1)) && digit(bytes.get(at + 1));
    if text.split(',').any(inner_blank) && text.match_indices(',').all(between_digits) {
        return Separator::Blank;
    }
    if text.contains(',') { Separator::Comma } else { Separator::Blank }
}

/// Whether what stands between two tabs is one cell, and not several numbers between which blanks or
/// commas separate as well.
fn is_one_cell(between: &str) -> bool {
    let several = |cell: &str| {
        let mut parts = cell.split_whitespace();
        cell.contains(char::is_whitespace)
            && parts.all(|part| number(part, true).is_some())
            && without_gaps(cell).is_none()
    };
    let cell = between.trim();
    !cell.ends_with(',') && !several(cell)
}
