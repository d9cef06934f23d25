//! Whether the first column of a text without a header numbers the rows.

use super::cell::{Separator, is_passed_over, separate_by, unquoted};

/// How far the length of a tool axis may lie off 1: CAM systems round it to a few digits.
pub(super) const OFF_UNIT: f64 = 0.05;

/// Whether the first of four or seven cells counts 1, 2, 3, ... in this line and all others, two at
/// least. Of seven cells the last three must be an axis; of four, some point must differ from the
/// first, or it is x that counts along a straight line.
pub(super) fn is_first<'a>(
    cells: &[(usize, &'a str)],
    stated: Option<Separator>,
    lines: impl Iterator<Item = &'a str>,
) -> bool {
    let [(_, first), rest @ ..] = cells else { return false };
    if !is_count(first, 1) || !matches!(rest.len(), 3 | 6) || (rest.len() == 6 && !is_axis(&rest[3..])) {
        return false;
    }
    let (mut count, mut moves) = (1, rest.len() == 6);
    let mut others = Vec::with_capacity(cells.len());
    for line in lines {
        let text = line.split('#').next().unwrap_or_default();
        if is_passed_over(text) {
            continue;
        }
        separate_by(stated, text, &mut others);
        count += 1;
        if others.len() != cells.len() || !is_count(others[0].1, count) {
            return false;
        }
        moves |= rest.iter().zip(&others[1..]).any(|((_, a), (_, b))| a != b);
    }
    count > 1 && moves
}

/// Whether a cell is this whole number, without a decimal sign.
fn is_count(cell: &str, count: usize) -> bool {
    let digits = unquoted(cell).unwrap_or(cell);
    digits.bytes().all(|b| b.is_ascii_digit()) && digits.parse() == Ok(count)
}

fn is_axis(cells: &[(usize, &str)]) -> bool {
    let squared: Option<f64> = cells
        .iter()
        .map(|(_, cell)| unquoted(cell).unwrap_or(cell).replace(',', ".").parse::<f64>().ok().map(|x| x * x))
        .sum();
    squared.is_some_and(|squared| (squared.sqrt() - 1.0).abs() <= OFF_UNIT)
}
