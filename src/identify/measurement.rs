//! Loaded poses as text: joint angles, force and displacement, one pose per row.
//!
//! The first line names the columns, in any order, with or without units: `q1_deg` to `q6_deg` (or
//! `_rad`), `fx_n`, `fy_n`, `fz_n`, optionally `mx_nm`, `my_nm`, `mz_nm`, and those of `dx_mm`,
//! `dy_mm`, `dz_mm` (or `_m`, `_um`) that were measured. Without a header, twelve numbers are
//! angles [deg], force [N] and displacement [mm]; fifteen have moments [N m] before the
//! displacement. An empty cell is a displacement that was not measured. Cells are separated as in a
//! path's CSV; `#` starts a comment.
//!
//! Force, moment and displacement are given at the TCP, in the robot's base frame; the displacement
//! is how far the load moves the TCP. Where a row is the difference between two loads, its force is
//! the difference too.

use crate::error::Error;
use crate::identify::table::Table;
use crate::robot::{Elbow, Joints, Robot};
use crate::units::{DEG, INCH, MM};
use nalgebra::Vector6;

/// JSON path of the text, for errors.
const FIELD: &str = "measurements";
/// Largest plausible displacement [m].
const FARTHEST: f64 = 1.0;
/// Largest plausible force [N] or moment [N m].
const STRONGEST: f64 = 1e6;
/// Largest plausible joint angle [rad].
const TURNED: f64 = 7200.0 * DEG;

/// One loaded pose.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// Line of the text, from 1.
    pub line: usize,
    /// Joint values [rad], in the convention of the robot's table.
    pub q: Joints,
    /// Force [N] and moment [N m] on the TCP, in the base frame.
    pub wrench: Vector6<f64>,
    /// Displacement of the TCP along the base's axes [m]; none along an axis that was not measured.
    pub displacement: [Option<f64>; 3],
}

/// The contents of a text.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurements {
    /// The poses in the order of the text.
    pub rows: Vec<Measurement>,
    /// Oddities of the text that did not keep it from being read.
    pub remarks: Vec<String>,
}

/// Convention of the joint angles in the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Convention {
    /// That of the robot's table.
    #[default]
    Table,
    /// That of the pendants of FANUC and others: joint 3 is measured from the horizontal, so its
    /// reading does not change when joint 2 alone turns the upper arm. The table's angle is q2 +
    /// q3. The direction of each joint stays the table's (`joint_sign`).
    CoupledJ3,
}

impl Convention {
    /// Every convention with its key.
    pub const ALL: [(&'static str, Convention); 2] =
        [("table", Convention::Table), ("coupled-j3", Convention::CoupledJ3)];

    /// The convention with the key `id`.
    ///
    /// # Errors
    /// [`Error::Invalid`] with the available keys.
    pub fn of(id: &str) -> Result<Self, Error> {
        let found = Self::ALL.iter().find(|(key, _)| *key == id);
        let refused =
            || Error::unknown_name("convention", id, "the conventions are", Self::ALL.map(|(key, _)| key));
        found.map(|(_, convention)| *convention).ok_or_else(refused)
    }

    /// Checks that rows in this convention can apply to the robot.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the robot itself measures joint 3 from the base: it would be converted
    /// twice.
    pub fn suits(self, robot: &Robot) -> Result<(), Error> {
        if self == Convention::CoupledJ3 && robot.elbow() != Elbow::Serial {
            let expected = "table: this robot's own joint 3 is already measured from the base";
            return Err(Error::invalid("convention", "\"coupled-j3\"", expected));
        }
        Ok(())
    }

    /// Joint values in the table's convention.
    pub fn joints(self, q: Joints) -> Joints {
        match self {
            Convention::Table => q,
            Convention::CoupledJ3 => Joints::new(q[0], q[1], q[1] + q[2], q[3], q[4], q[5]),
        }
    }
}

/// The quantity in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Quantity {
    Angle,
    Force,
    Moment,
    Displacement,
}

/// A column: its quantity, component, and unit in SI.
#[derive(Debug, Clone, Copy)]
struct MeasuredColumn {
    quantity: Quantity,
    component: usize,
    unit: f64,
    /// Whether the text states the unit.
    stated: bool,
}

/// Reads loaded poses.
///
/// # Errors
/// [`Error::Text`] with line and column of the first invalid cell or name.
pub fn read(text: &str, convention: Convention) -> Result<Measurements, Error> {
    let table = Table::read(text, FIELD)?;
    let columns = columns(&table)?;
    let mut rows = Vec::with_capacity(table.len());
    let mut largest_angle: f64 = 0.0;
    for (row, &line) in table.lines.iter().enumerate() {
        let mut q = Joints::zeros();
        let mut wrench = Vector6::zeros();
        let mut displacement = [None; 3];
        for (cell, (number, column)) in table.row(row).iter().zip(&columns).enumerate() {
            let value = number * column.unit;
            let wrong = |expected: &str| Err(table.cell_error(row, cell, expected));
            let (place, most, expected) = match column.quantity {
                Quantity::Displacement if number.is_nan() => continue,
                Quantity::Displacement => (
                    None,
                    FARTHEST,
                    "a displacement is at most 1 m; name its unit in the header: dx_mm, dx_um",
                ),
                Quantity::Angle => {
                    (Some(&mut q[column.component]), TURNED, "a joint angle is at most 7200 deg")
                }
                Quantity::Force => {
                    (Some(&mut wrench[column.component]), STRONGEST, "a force is at most 1e6 N")
                }
                Quantity::Moment => {
                    (Some(&mut wrench[3 + column.component]), STRONGEST, "a moment is at most 1e6 N m")
                }
            };
            if number.is_nan() {
                return wrong("every row needs angles, forces and moments");
            }
            if value.abs() > most {
                return wrong(expected);
            }
            match place {
                Some(place) => *place = value,
                None => displacement[column.component] = Some(value),
            }
        }
        largest_angle = q.amax().max(largest_angle);
        rows.push(Measurement { line, q: convention.joints(q), wrench, displacement });
    }
    if rows.is_empty() {
        return Err(table.end_error("a text without numbers", "one row for each loaded pose"));
    }
    let mut remarks = Vec::new();
    let unstated = columns.iter().any(|column| column.quantity == Quantity::Angle && !column.stated);
    if unstated && largest_angle < 7.0 * DEG {
        remarks.push(
            "no joint angle is larger than 7: if they are in rad, name the columns q1_rad to q6_rad in a first line"
                .to_owned(),
        );
    }
    Ok(Measurements { rows, remarks })
}

fn columns(table: &Table) -> Result<Vec<MeasuredColumn>, Error> {
    if table.names.is_empty() {
        return unnamed(table);
    }
    let mut columns: Vec<MeasuredColumn> = Vec::with_capacity(table.width);
    for (index, words) in table.names.iter().enumerate() {
        let column = named(words).map_err(|expected| table.name_error(index, expected))?;
        let same =
            |other: &MeasuredColumn| (other.quantity, other.component) == (column.quantity, column.component);
        if columns.iter().any(same) {
            return Err(table.name_error(index, "each column may appear only once"));
        }
        columns.push(column);
    }
    let count = |quantity| columns.iter().filter(|column| column.quantity == quantity).count();
    let wanted = if count(Quantity::Angle) != 6 {
        "the columns q1 to q6 are needed"
    } else if count(Quantity::Force) != 3 {
        "the columns fx, fy and fz are needed"
    } else if count(Quantity::Displacement) == 0 {
        "at least one of the columns dx, dy and dz is needed"
    } else if ![0, 3].contains(&count(Quantity::Moment)) {
        "give all of mx, my and mz, or none"
    } else {
        return Ok(columns);
    };
    Err(table.name_error(table.width - 1, wanted))
}

/// The columns of a text without a header.
fn unnamed(table: &Table) -> Result<Vec<MeasuredColumn>, Error> {
    let moments = match table.width {
        0 => return Ok(vec![]),
        12 => 0,
        15 => 3,
        _ => {
            let expected = "a row without a header is q1 to q6 [deg], fx, fy, fz [N], if there are any \
                            mx, my, mz [N m], then dx, dy, dz [mm]";
            return Err(table.cell_error(0, 0, expected));
        }
    };
    let groups = [
        (Quantity::Angle, 6, DEG),
        (Quantity::Force, 3, 1.0),
        (Quantity::Moment, moments, 1.0),
        (Quantity::Displacement, 3, MM),
    ];
    let column = |(quantity, count, unit)| {
        (0..count).map(move |component| MeasuredColumn { quantity, component, unit, stated: false })
    };
    Ok(groups.into_iter().flat_map(column).collect())
}

/// Names of each quantity that may precede the component, in lower case.
const NAMES: [(Quantity, &[&str]); 4] = [
    (Quantity::Angle, &["q", "j", "joint", "theta", "axis"]),
    (Quantity::Force, &["f", "force"]),
    (Quantity::Moment, &["m", "moment"]),
    (Quantity::Displacement, &["d", "displacement", "deflection", "delta"]),
];

/// Reads quantity, component and unit from a column's name.
fn named(words: &[String]) -> Result<MeasuredColumn, &'static str> {
    const UNKNOWN: &str = "the columns are q1 to q6, fx, fy, fz, mx, my, mz, dx, dy, dz, with or without a unit: q1_deg, fx_n, dx_mm";
    let part = |name: &str| {
        let component = name.chars().last()?;
        let stem = &name[..name.len() - component.len_utf8()];
        let (quantity, _) = NAMES.iter().find(|(_, stems)| stems.contains(&stem))?;
        let components = if *quantity == Quantity::Angle { "123456" } else { "xyz" };
        Some((*quantity, components.find(component)?))
    };
    // Two words may be one name: force x, joint 1.
    let joined = words.get(..2).map(<[String]>::concat);
    let (quantity, component, rest) = match (joined.and_then(|name| part(&name)), words.first()) {
        (Some((quantity, component)), _) => (quantity, component, &words[2..]),
        (None, Some(first)) => {
            let (quantity, component) = part(first).ok_or(UNKNOWN)?;
            (quantity, component, &words[1..])
        }
        (None, None) => return Err(UNKNOWN),
    };
    // The base frame is implied; other words, such as "tool", would change the meaning.
    let rest: Vec<&str> = rest.iter().map(String::as_str).filter(|word| *word != "base").collect();
    let (unit, stated) = match (quantity, rest.concat().as_str()) {
        (Quantity::Angle, "") => (DEG, false),
        (Quantity::Displacement, "") => (MM, false),
        (_, "") => (1.0, false),
        (Quantity::Angle, "deg" | "degree" | "degrees") => (DEG, true),
        (Quantity::Angle, "rad" | "radian" | "radians") => (1.0, true),
        (Quantity::Force, "n") | (Quantity::Moment, "nm") | (Quantity::Displacement, "m") => (1.0, true),
        (Quantity::Force, "kn") => (1e3, true),
        (Quantity::Displacement, "mm") => (MM, true),
        (Quantity::Displacement, "um" | "µm" | "μm") => (1e-3 * MM, true),
        (Quantity::Displacement, "in" | "inch") => (INCH, true),
        (Quantity::Angle, _) => return Err("joint angles are in deg or rad"),
        (Quantity::Force, _) => return Err("forces are in N or kN, in the base frame"),
        (Quantity::Moment, _) => return Err("moments are in Nm, in the base frame"),
        (Quantity::Displacement, _) => return Err("displacements are in mm, um, m or in, in the base frame"),
    };
    Ok(MeasuredColumn { quantity, component, unit, stated })
}
