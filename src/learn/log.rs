//! A log of a measured pass as text: rows of numbers under a header.
//!
//! Columns in any order: `time_s` (or `_ms`) or `s_mm`, and any of `x_mm y_mm z_mm` (tip; with `nx ny nz` a probed
//! point and its normal, out of the material), `dx_mm dy_mm dz_mm` (actual less desired tip), `fx_n fy_n fz_n` (force on the tool),
//! `q1_deg` to `q6_deg` (motor side) and `load1_deg` to `load6_deg` (behind the gear). Cells are separated as in a path's
//! CSV; `#` starts a comment. A row whose cells of a quantity are all empty is a gap of it.

use crate::error::Error;
use crate::identify::table::Table;
use crate::learn::columns::{KNOWN, Logged, LoggedColumn, named};
use crate::robot::Joints;
use nalgebra::Vector3;

/// JSON path of the text, for errors.
pub const FIELD: &str = "log";

/// A vector for each row; `None` where nothing was measured.
pub type LoggedVectors = Vec<Option<Vector3<f64>>>;

/// Along what the rows stand.
#[derive(Debug, Clone, PartialEq)]
pub enum Clock {
    /// Time [s], rising.
    Time(Vec<f64>),
    /// Arc length [m], not falling.
    Length(Vec<f64>),
    /// Nothing: points in any order.
    None,
}

/// What the rows hold, where a column's unit is not stated in the unit of the numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Log {
    /// Along what they stand.
    pub clock: Clock,
    /// Whether the clock's unit is stated; else it is taken to be s or mm.
    pub clock_is_stated: bool,
    /// Positions of the tip or of probed points, with the size of their unit [m] if it is stated.
    pub position: Option<(LoggedVectors, Option<f64>)>,
    /// Normals of probed points, of length 1.
    pub normal: Option<Vec<Vector3<f64>>>,
    /// Actual less desired tips [m], and whether their unit is stated; else they are taken to be in mm.
    pub deviation: Option<(LoggedVectors, bool)>,
    /// Forces on the tool [N].
    pub force: Option<LoggedVectors>,
    /// Joint angles at the motors [rad].
    pub motor: Option<Vec<Joints>>,
    /// Joint angles behind the gears [rad]; of a joint that was not measured, the motor's.
    pub load: Option<Vec<Joints>>,
    /// Number of rows.
    pub rows: usize,
}

impl Log {
    /// Reads a text.
    ///
    /// # Errors
    /// [`Error::Text`] with line and column of the first cell or name that cannot be read.
    pub fn read(text: &str) -> Result<Self, Error> {
        let table = Table::read(text, FIELD)?;
        if table.names.is_empty() {
            return Err(if table.width == 0 {
                table.end_error("a text without numbers", "a header and one row for each measurement")
            } else {
                table.cell_error(0, 0, KNOWN)
            });
        }
        let columns = columns(&table)?;
        let read = ReadTable { table: &table, columns: &columns };
        let (clock, clock_is_stated) = read.clock()?;
        let log = Self {
            clock,
            clock_is_stated,
            position: read.vectors(Logged::Position, None)?,
            normal: read.normals()?,
            deviation: read
                .vectors(Logged::Deviation, Some(crate::units::MM))?
                .map(|(v, unit)| (v, unit.is_some())),
            force: read.vectors(Logged::Force, Some(1.0))?.map(|(v, _)| v),
            motor: read.joints(Logged::Motor)?,
            load: read.joints(Logged::Load)?,
            rows: table.len(),
        };
        log.checked(&table)
    }

    /// Refuses what cannot be told apart or laid over a run.
    fn checked(self, table: &Table) -> Result<Self, Error> {
        let refused = |expected: &str| Err(table.name_error(table.width - 1, expected));
        if self.rows < 2 {
            return Err(table.end_error("fewer than two rows", "one row for each measurement"));
        }
        let [position, deviation] = [self.position.is_some(), self.deviation.is_some()];
        if !(position || deviation || self.force.is_some() || self.load.is_some()) {
            return refused(KNOWN);
        }
        if [position, deviation, self.load.is_some()].into_iter().filter(|given| *given).count() > 1 {
            return refused(
                "one of positions, deviations and angles behind the gears, as each says where the tip is",
            );
        }
        if self.load.is_some() && self.motor.is_none() {
            return refused("angles behind the gears need those of the motors beside them: q1_deg to q6_deg");
        }
        if self.normal.is_some() && !position {
            return refused("normals belong to points: x_mm, y_mm, z_mm");
        }
        if self.clock == Clock::None && !position {
            return refused("time_s or s_mm is needed, to know where on the path each row was measured");
        }
        Ok(self)
    }
}

fn columns(table: &Table) -> Result<Vec<LoggedColumn>, Error> {
    let mut columns: Vec<LoggedColumn> = Vec::with_capacity(table.width);
    for (index, words) in table.names.iter().enumerate() {
        let column = named(words).map_err(|expected| table.name_error(index, expected))?;
        let same =
            |other: &&LoggedColumn| (other.logged, other.component) == (column.logged, column.component);
        if columns.iter().any(|other| same(&other)) {
            return Err(table.name_error(index, "each column may appear only once"));
        }
        columns.push(column);
    }
    Ok(columns)
}

/// The rows of a table by what they hold.
struct ReadTable<'a> {
    table: &'a Table<'a>,
    columns: &'a [LoggedColumn],
}

impl ReadTable<'_> {
    fn find(&self, logged: Logged, component: usize) -> Option<usize> {
        self.columns.iter().position(|column| (column.logged, column.component) == (logged, component))
    }

    /// The clock, which must rise, and whether its unit is stated.
    fn clock(&self) -> Result<(Clock, bool), Error> {
        let (cell, unit, is_time) = match (self.find(Logged::Time, 0), self.find(Logged::Length, 0)) {
            (Some(cell), _) => (cell, 1.0, true),
            (None, Some(cell)) => (cell, crate::units::MM, false),
            (None, None) => return Ok((Clock::None, true)),
        };
        let stated = self.columns[cell].unit;
        let mut values = Vec::with_capacity(self.table.len());
        for row in 0..self.table.len() {
            let value = self.number(row, cell)? * stated.unwrap_or(unit);
            let last = values.last().copied().unwrap_or(f64::NEG_INFINITY);
            if value < last || (is_time && value == last) {
                let expected =
                    if is_time { "time rises from row to row" } else { "arc length does not fall" };
                return Err(self.table.cell_error(row, cell, expected));
            }
            values.push(value);
        }
        Ok((if is_time { Clock::Time(values) } else { Clock::Length(values) }, stated.is_some()))
    }

    fn number(&self, row: usize, cell: usize) -> Result<f64, Error> {
        let number = self.table.row(row)[cell];
        if number.is_finite() { Ok(number) } else { Err(self.table.cell_error(row, cell, "a number")) }
    }

    /// Three columns as vectors, in SI or where no unit is stated in `otherwise`, with the unit that is stated.
    fn vectors(
        &self,
        logged: Logged,
        otherwise: Option<f64>,
    ) -> Result<Option<(LoggedVectors, Option<f64>)>, Error> {
        let cells = [0, 1, 2].map(|component| self.find(logged, component));
        let given: Vec<usize> = cells.iter().flatten().copied().collect();
        let [Some(x), Some(y), Some(z)] = cells else {
            return match given.first() {
                None => Ok(None),
                Some(cell) => Err(self.table.name_error(*cell, "all three of x, y and z are needed")),
            };
        };
        let units = [x, y, z].map(|cell| self.columns[cell].unit);
        if units.iter().any(|unit| *unit != units[0]) {
            return Err(self.table.name_error(y, "x, y and z in the same unit"));
        }
        let size = units[0].or(otherwise).unwrap_or(1.0);
        let vector = |row: usize| {
            if [x, y, z].iter().all(|cell| self.table.row(row)[*cell].is_nan()) {
                return Ok(None);
            }
            let [x, y, z] = [self.number(row, x)?, self.number(row, y)?, self.number(row, z)?];
            Ok(Some(Vector3::new(x, y, z) * size))
        };
        let vectors = (0..self.table.len()).map(vector).collect::<Result<Vec<_>, Error>>()?;
        Ok(Some((vectors, units[0])))
    }

    fn normals(&self) -> Result<Option<Vec<Vector3<f64>>>, Error> {
        let Some((normals, _)) = self.vectors(Logged::Normal, Some(1.0))? else { return Ok(None) };
        let cell = self.find(Logged::Normal, 0).unwrap_or(0);
        let unit = |(row, normal): (usize, Option<Vector3<f64>>)| {
            let length = normal.map_or(0.0, |normal| normal.norm());
            if (length - 1.0).abs() > 0.02 {
                return Err(self.table.cell_error(row, cell, "a normal of length 1"));
            }
            Ok(normal.unwrap_or_default() / length)
        };
        normals.into_iter().enumerate().map(unit).collect::<Result<Vec<_>, _>>().map(Some)
    }

    /// Angles of those joints that have a column; the others' are 0.
    fn joints(&self, logged: Logged) -> Result<Option<Vec<Joints>>, Error> {
        let cells: Vec<(usize, usize)> =
            (0..6).filter_map(|joint| Some((joint, self.find(logged, joint)?))).collect();
        if cells.is_empty() {
            return Ok(None);
        }
        // Behind the gears, only what was measured differs from the motors.
        let motors = |joint: usize| self.find(Logged::Motor, joint);
        let mut all = Vec::with_capacity(self.table.len());
        for row in 0..self.table.len() {
            let mut q = Joints::zeros();
            for joint in 0..6 {
                let own = cells.iter().find(|(of, _)| *of == joint).map(|(_, cell)| *cell);
                let Some(cell) = own.or_else(|| motors(joint)) else { continue };
                q[joint] = self.number(row, cell)? * self.columns[cell].unit.unwrap_or(crate::units::DEG);
            }
            all.push(q);
        }
        if logged == Logged::Motor && cells.len() < 6 {
            return Err(self.table.name_error(cells[0].1, "all of q1 to q6 are needed"));
        }
        Ok(Some(all))
    }
}
