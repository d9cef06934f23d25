//! Points typed or pasted as text: one `x, y, z` row a line.

use crate::error::Error;
use crate::units::MM;
use nalgebra::Vector3;

/// Reads rows of x, y, z [mm], separated by comma, semicolon, tab or blanks, into points [m].
///
/// A first row of words is a header and must name x, y and z in this order; blank lines and lines from `#` on are passed over.
///
/// # Errors
/// [`Error::Text`] with line and column of the first thing that is not a number, or of a row that has not three of them.
pub fn points(text: &str, field: &str) -> Result<Vec<Vector3<f64>>, Error> {
    let mut points = Vec::new();
    let mut header_allowed = true;
    for (index, line) in text.lines().enumerate() {
        let error = |column: usize, found: &str, expected: &str| Error::Text {
            field: field.into(),
            line: index + 1,
            column,
            found: found.into(),
            expected: expected.into(),
        };
        let cells = cells(line.split('#').next().unwrap_or_default());
        if cells.is_empty() {
            continue;
        }
        if header_allowed
            && cells.iter().all(|(_, cell)| cell.chars().next().is_some_and(char::is_alphabetic))
        {
            let first = |cell: &str| cell.chars().next().map(|c| c.to_ascii_lowercase());
            if cells.len() != 3
                || cells.iter().zip("xyz".chars()).any(|((_, cell), axis)| first(cell) != Some(axis))
            {
                return Err(error(
                    1,
                    &format!("the header \"{}\"", line.trim()),
                    "the columns are x, y, z in mm",
                ));
            }
            header_allowed = false;
            continue;
        }
        header_allowed = false;
        let mut numbers = [0.0; 3];
        for (number, (column, cell)) in numbers.iter_mut().zip(&cells) {
            *number = match cell.parse::<f64>() {
                Ok(value) if value.is_finite() => value,
                _ => {
                    let expected = "a row is x, y, z in mm, numbers with a decimal point";
                    return Err(error(*column, &format!("\"{cell}\""), expected));
                }
            };
        }
        if cells.len() != 3 {
            let column = cells.get(3).or(cells.last()).map_or(1, |(column, _)| *column);
            return Err(error(
                column,
                &format!("{} numbers", cells.len()),
                "a row is three numbers: x, y, z in mm",
            ));
        }
        points.push(Vector3::from(numbers) * MM);
    }
    Ok(points)
}

/// The cells of a row, each with its column (from 1, in characters).
fn cells(line: &str) -> Vec<(usize, &str)> {
    let separator = [';', ','].into_iter().find(|&c| line.contains(c));
    let mut cells = Vec::new();
    let mut start = 0;
    let ends = |c: char| separator.map_or(c.is_whitespace(), |s| c == s);
    for piece in line.split_inclusive(ends) {
        let cell = piece.trim_end_matches(ends);
        let lead = cell.len() - cell.trim_start().len();
        let trimmed = cell.trim();
        if separator.is_some() || !trimmed.is_empty() {
            cells.push((line[..start + lead].chars().count() + 1, trimmed));
        }
        start += piece.len();
    }
    if line.trim().is_empty() {
        cells.clear();
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<[f64; 3]>, (usize, usize)> {
        points(text, "path.text")
            .map(|points| points.iter().map(|p| [p.x * 1e3, p.y * 1e3, p.z * 1e3].map(f64::round)).collect())
            .map_err(|error| error.place().unwrap())
    }

    #[test]
    fn rows_are_read_with_any_separator() {
        let expected = Ok(vec![[1.0, 2.0, 3.0], [4.0, -5.0, 6.0]]);
        for text in [
            "1,2,3\n4,-5,6",
            "x,y,z\n1, 2, 3\n4,-5,6\n",
            "1;2;3\n4;-5;6",
            "X\tY\tZ\n1\t2\t3\n\n4 -5  6 # end",
            "1e0 2. 3\r\n4 -5 6",
        ] {
            assert_eq!(read(text), expected, "{text:?}");
        }
    }

    #[test]
    fn mistakes_are_placed() {
        for (text, place) in [
            ("1,2,3\n1,2", (2, 3)),
            ("1,2,3,4", (1, 7)),
            ("1,2,3\n 1, two, 3", (2, 5)),
            ("y,x,z\n1,2,3", (1, 1)),
            ("1,2,3\nx,y,z", (2, 1)),
            ("1,nan,3", (1, 3)),
            ("1,,3", (1, 3)),
            ("1,inf,3", (1, 3)),
        ] {
            assert_eq!(read(text), Err(place), "{text:?}");
        }
    }
}
