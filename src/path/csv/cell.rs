//! Splits lines into cells, and reads cells as numbers.

/// Separator of the cells in a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Separator {
    Semicolon,
    Comma,
    Blank,
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

/// Whether a line is skipped: only separators, or a comment that starts with a semicolon and a
/// word.
pub(crate) fn is_passed_over(text: &str) -> bool {
    let rest = text.trim_start();
    let comment =
        rest.strip_prefix(';').is_some_and(|words| words.trim_start().starts_with(char::is_alphabetic));
    comment || rest.chars().all(|c| c.is_whitespace() || c == ',' || c == ';')
}

/// Splits a line into cells, each with its byte offset. A trailing separator is allowed.
pub(crate) fn separate<'a>(text: &'a str, cells: &mut Vec<(usize, &'a str)>) -> Separator {
    let mut cut = |separator: Separator| {
        cells.clear();
        let ends = |c: char| match separator {
            Separator::Semicolon => c == ';',
            Separator::Comma => c == ',',
            Separator::Blank => c.is_whitespace(),
        };
        let mut start = 0;
        for piece in text.trim_end().split_inclusive(ends) {
            let cell = piece.strip_suffix(ends).unwrap_or(piece);
            let lead = cell.len() - cell.trim_start().len();
            if separator != Separator::Blank || !cell.trim().is_empty() {
                cells.push((start + lead, cell.trim()));
            }
            start += piece.len();
        }
        separator
    };
    if text.contains(';') {
        return cut(Separator::Semicolon);
    }
    // Commas are decimal signs if blanks separate the cells and each comma has a digit on both
    // sides: in `1,5 2,5`, but not in `1, 2`.
    let inner_blank = |cell: &str| cell.trim().contains(char::is_whitespace);
    let digit = |byte: Option<&u8>| byte.is_some_and(u8::is_ascii_digit);
    let bytes = text.as_bytes();
    let between_digits =
        |(at, _): (usize, &str)| at > 0 && digit(bytes.get(at - 1)) && digit(bytes.get(at + 1));
    if text.split(',').any(inner_blank) && text.match_indices(',').all(between_digits) {
        return cut(Separator::Blank);
    }
    if text.contains(',') { cut(Separator::Comma) } else { cut(Separator::Blank) }
}
