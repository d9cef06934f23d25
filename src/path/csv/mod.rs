//! Points typed or pasted as text, one row per line: `x, y, z[, i, j, k][, feed]`.
//!
//! Cells are separated by semicolons, tabs, commas or blanks; a first line `sep=;` may say by which.
//! A comma is the decimal sign if something else separates the cells (`1,5; 2,5; 3,5`), or within
//! quotation marks. Spaces may set off thousands (`1 234,5`) where blanks do not separate. A header
//! row names the columns, in any order, and may give units: `x [mm]`, `feed_mm_min`. Without a
//! header, three cells are x, y, z; a fourth is a feed; six end with an axis; seven have both. Blank
//! lines and text after `#` are skipped, and so are lines that start with `;` and a word.
//!
//! A column of row numbers is left out: one that a header names (`n`, `no`, `index`, `point`,
//! `line`), or the first of four or seven without a header if it counts 1, 2, 3, ... in all rows.
//!
//! The path runs straight from row to row. The axis (i, j, k) points from tip to spindle and has the
//! length 1, within 5 %: three angles of a robot have another. A row's feed applies to the move that
//! ends there.

pub(crate) mod cell;
mod header;
mod index;
mod row;

use crate::error::Error;
use crate::path::builder::{self, Fault, ProgramBuilder, Target};
use crate::path::program::{MovePace, Program};
use crate::path::unit::{FeedUnit, LengthUnit};
use header::{NO_ANGLES, Width};
use nalgebra::Vector3;
use row::{Row, Rows};

/// Settings that the text may leave open.
#[derive(Debug, Clone, Copy)]
pub struct Options<'a> {
    /// JSON path of the text, for errors.
    pub field: &'a str,
    /// Unit of x, y and z; a unit in the header takes precedence.
    pub unit: LengthUnit,
    /// Unit of the feed; a unit in the header takes precedence.
    pub feed_unit: FeedUnit,
}

/// Reads rows of points, with or without tool axis and feed, into a program of straight moves.
/// `on_line` is called after each row with the number of lines read.
///
/// A row at the point of the previous one makes no move. Rows of whole numbers such as `1,5,2,5`
/// without a header are refused if nothing in the text shows whether the commas are decimal signs.
///
/// # Errors
/// [`Error::Text`] with line and column of the first cell that does not fit its column.
pub fn program(text: &str, options: &Options<'_>, mut on_line: impl FnMut(usize)) -> Result<Program, Error> {
    let mut builder = ProgramBuilder::default();
    let mut rows = Rows::new(text, options.field, options.unit, Width::Any);
    while let Some(row) = rows.next_row()? {
        let columns = row.columns;
        let unit = columns.unit.unwrap_or(options.unit);
        let feed_unit = columns.feed_unit.unwrap_or(options.feed_unit);
        if (unit, feed_unit) != (options.unit, options.feed_unit) && builder.pose.is_none() {
            builder.remark("header-unit", row.line, || {
                format!(
                    "the header's units are used: lengths in {}, feeds in {}",
                    unit.name(),
                    feed_unit.name()
                )
            });
        }
        if columns.index.is_some() && builder.pose.is_none() {
            builder.remark("index-column", row.line, || match columns.named {
                true => "the column of row numbers is ignored".into(),
                false => "the first column looks like row numbers \
                          and is ignored; if it is x, name the columns in a first line: x,y,z,feed"
                    .into(),
            });
        }
        let axis = match columns.axis {
            // Six cells may be three numbers with decimal commas.
            Some(cells) => axis(&mut builder, &row, cells).map_err(|fault| {
                rows.ambiguity().unwrap_or_else(|| fault.at(options.field, row.position(cells[0])))
            })?,
            None => Vector3::z(),
        };
        let pace = match columns.feed {
            Some(cell) => builder::feed(row.numbers[cell] * feed_unit.in_m_per_s())
                .map(MovePace::Feed)
                .map_err(|fault| fault.at(options.field, row.position(cell)))?,
            None => MovePace::JobFeed,
        };
        builder
            .line_to(Target { point: row.point, axis, pace, spindle: None, line: row.line })
            .map_err(|fault| fault.at(options.field, row.position(columns.axis.map_or(0, |axis| axis[0]))))?;
        on_line(rows.lines());
    }
    if builder.program.moves.is_empty() {
        let expected = "a path needs at least two rows with different points";
        return Err(rows.error((rows.lines().max(1), 1), "the end of a text without a move", expected));
    }
    Ok(builder.finish(rows.unit().name(), rows.lines()))
}

/// The tool's axis in three cells of a row.
fn axis(builder: &mut ProgramBuilder, row: &Row<'_>, [i, j, k]: [usize; 3]) -> Result<Vector3<f64>, Fault> {
    let ijk = Vector3::new(row.numbers[i], row.numbers[j], row.numbers[k]);
    let length = ijk.norm();
    if (length - 1.0).abs() > index::OFF_UNIT {
        let found = format!("the tool axis ({}, {}, {}) of the length {length:.4}", ijk.x, ijk.y, ijk.z);
        return Err(Fault::new(found, NO_ANGLES));
    }
    builder.direction(ijk, row.line)
}

/// Reads rows of x, y, z [mm unless the header gives another unit] into points [m].
///
/// # Errors
/// [`Error::Text`] with line and column of the first cell that is not a number, or of a row that
/// does not have three cells.
pub fn points(text: &str, field: &str) -> Result<Vec<Vector3<f64>>, Error> {
    let mut points = Vec::new();
    let mut rows = Rows::new(text, field, LengthUnit::Mm, Width::Points);
    while let Some(row) = rows.next_row()? {
        points.push(row.point);
    }
    Ok(points)
}
