//! Angles of joints at the motor and behind the gear, read from a text.

use crate::error::Error;
use crate::identify::table::Table;
use crate::units::DEG;

/// JSON path of the text, for errors.
pub(super) const FIELD: &str = "gear";
/// Length of a block [s].
pub(super) const BLOCK: f64 = 0.5;
/// Fewest rows in a block.
const FEWEST: f64 = 10.0;
/// What is read, for errors.
const KNOWN: &str = "time_s, and of one joint or several motor_side_q3_deg, load_side_q3_deg and model_load_3_nm; reference and torque \
                     columns are passed over";

/// A joint's angles at motor and load over time.
#[derive(Debug, Clone, PartialEq)]
pub struct GearLog {
    /// The joint, from 0.
    pub joint: usize,
    /// Times [s], rising.
    pub time: Vec<f64>,
    /// Angle at the motor, counted behind the gear's ratio [rad].
    pub motor: Vec<f64>,
    /// Angle behind the gear [rad].
    pub load: Vec<f64>,
    /// Torque of a model on the joint [N m].
    pub torque: Vec<f64>,
}

/// What a column of the text is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum GearColumn {
    Time,
    Motor(usize),
    Load(usize),
    Torque(usize),
    Other,
}

/// The column of a name, and its unit in SI.
fn named(words: &[String]) -> Option<(GearColumn, f64)> {
    let unit = words.last().map(String::as_str).filter(|last| ["deg", "rad", "s", "ms", "nm"].contains(last));
    let bare = words[..words.len() - usize::from(unit.is_some())].concat();
    let angle = match unit {
        None | Some("deg") => Some(DEG),
        Some("rad") => Some(1.0),
        _ => None,
    };
    let torque = matches!(unit, None | Some("nm")).then_some(1.0);
    if ["time", "t"].contains(&bare.as_str()) {
        let second = match unit {
            None | Some("s") => 1.0,
            Some("ms") => 1e-3,
            _ => return None,
        };
        return Some((GearColumn::Time, second));
    }
    let joint = bare.chars().last()?.to_digit(10).filter(|joint| (1..=6).contains(joint))? as usize - 1;
    match (&bare[..bare.len() - 1], unit) {
        ("load", Some("nm")) => Some((GearColumn::Torque(joint), 1.0)),
        ("motor", Some("nm")) => Some((GearColumn::Other, 1.0)),
        ("motorsideq" | "motorq" | "motor", _) => Some((GearColumn::Motor(joint), angle?)),
        ("loadsideq" | "loadq" | "load", _) => Some((GearColumn::Load(joint), angle?)),
        ("modelload" | "loadtorque", _) => Some((GearColumn::Torque(joint), torque?)),
        ("referenceq" | "reference" | "torque", _) => Some((GearColumn::Other, 1.0)),
        _ => None,
    }
}

/// Reads a text: one log for each joint that is in it.
///
/// # Errors
/// [`Error::Text`] with line and column of what cannot be read.
pub fn read(text: &str) -> Result<Vec<GearLog>, Error> {
    read_as(text, FIELD)
}

/// The same for the text of a field of another name.
///
/// # Errors
/// See [`read`].
pub fn read_as(text: &str, field: &'static str) -> Result<Vec<GearLog>, Error> {
    let table = Table::read(text, field)?;
    if table.names.is_empty() {
        return Err(table.end_error("a text without a header", KNOWN));
    }
    let mut columns: Vec<(GearColumn, f64)> = Vec::with_capacity(table.width);
    for (index, words) in table.names.iter().enumerate() {
        let column = named(words).ok_or_else(|| table.name_error(index, KNOWN))?;
        if column.0 != GearColumn::Other && columns.iter().any(|(own, _)| *own == column.0) {
            return Err(table.name_error(index, "each column once"));
        }
        columns.push(column);
    }
    let place = |wanted: GearColumn| columns.iter().position(|(own, _)| *own == wanted);
    let values = |cell: usize| {
        let value = |row: usize| {
            let value = table.row(row)[cell];
            if value.is_finite() {
                Ok(value * columns[cell].1)
            } else {
                Err(table.cell_error(row, cell, "a number"))
            }
        };
        (0..table.len()).map(value).collect::<Result<Vec<f64>, Error>>()
    };
    let mut complete = Vec::new();
    for joint in 0..6 {
        let wanted =
            [GearColumn::Motor(joint), GearColumn::Load(joint), GearColumn::Torque(joint)].map(place);
        if let [Some(motor), Some(load), Some(torque)] = wanted {
            complete.push((joint, [motor, load, torque]));
        } else if let Some(present) = wanted.into_iter().flatten().next() {
            let name = joint + 1;
            let names = [
                format!("motor_side_q{name}_deg"),
                format!("load_side_q{name}_deg"),
                format!("model_load_{name}_nm"),
            ];
            let missing =
                names.into_iter().zip(wanted).filter(|(_, own)| own.is_none()).map(|(name, _)| name);
            let missing: Vec<_> = missing.collect();
            return Err(table.name_error(present, &format!("beside it {}", missing.join(" and "))));
        }
    }
    if complete.is_empty() {
        return Err(table.name_error(0, KNOWN));
    }
    let time = place(GearColumn::Time).ok_or_else(|| table.name_error(0, "a column time_s beside it"))?;
    let seconds = values(time)?;
    if let Some(row) = seconds.windows(2).position(|pair| pair[1] <= pair[0]) {
        return Err(table.cell_error(row + 1, time, "times must increase from row to row"));
    }
    let whole = seconds.last().zip(seconds.first()).map_or(0.0, |(last, first)| last - first);
    if whole < 4.0 * BLOCK {
        return Err(table.end_error("a short text", "at least two seconds, better ten"));
    }
    let step = whole / (seconds.len() - 1) as f64;
    if BLOCK / step < FEWEST {
        let found = format!("rows that are {step:.3} s apart");
        let expected = "at least ten rows in half a second; name the column time_ms if it is in milliseconds";
        return Err(table.end_error(&found, expected));
    }
    let log = |(joint, [motor, load, torque]): (usize, [usize; 3])| {
        let [motor, load, torque] = [values(motor)?, values(load)?, values(torque)?];
        Ok(GearLog { joint, time: seconds.clone(), motor, load, torque })
    };
    complete.into_iter().map(log).collect()
}
