//! The meaning and unit of each column.

use crate::path::builder::Fault;
use crate::path::unit::{FeedUnit, LengthUnit};

/// How many columns a text may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Width {
    /// x, y, z only.
    Points,
    /// x, y, z, optionally an axis and a feed.
    Any,
}

/// Largest number of columns: x, y, z, i, j, k, a feed and an index.
pub(super) const MOST: usize = 8;

/// The cells that hold the parts of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Columns {
    pub(super) count: usize,
    pub(super) point: [usize; 3],
    pub(super) axis: Option<[usize; 3]>,
    pub(super) feed: Option<usize>,
    /// The rows' numbers or names, which are left out.
    pub(super) index: Option<usize>,
    /// Unit of length in the header.
    pub(super) unit: Option<LengthUnit>,
    /// Unit of feed in the header.
    pub(super) feed_unit: Option<FeedUnit>,
    /// Whether a header names the columns.
    pub(super) named: bool,
}

/// Column names in lower case, in the order of the parts of a row without a header.
const NAMES: [&[&str]; MOST] = [
    &["x", "px", "posx"],
    &["y", "py", "posy"],
    &["z", "pz", "posz"],
    &["i", "nx", "ax", "ux", "axisi", "axisx"],
    &["j", "ny", "ay", "uy", "axisj", "axisy"],
    &["k", "nz", "az", "uz", "axisk", "axisz"],
    &["feed", "f", "feedrate"],
    // An empty name as tables of Python write it.
    &["n", "no", "nr", "num", "number", "index", "idx", "id", "point", "pt", "line", "row", ""],
];

/// The part of a row that is left out.
const INDEX: usize = 7;

/// Names of angles, in lower case: of the robot's makers, of CAM systems, and of quaternions.
const ANGLES: [&str; 23] = [
    "a", "b", "c", "w", "p", "r", "rx", "ry", "rz", "o", "t", "roll", "pitch", "yaw", "alpha", "beta",
    "gamma", "qw", "qx", "qy", "qz", "q1", "q2",
];

/// What is allowed where angles of a robot are found.
pub(super) const NO_ANGLES: &str = "robot angles (A, B, C; W, P, R; RX, RY, RZ) are not \
    supported: give the tool axis as i, j, k, a unit vector (within 5 %) from tip to spindle, or leave these columns out";

impl Columns {
    /// The columns of a text without a header.
    pub(super) fn of_count(count: usize, width: Width) -> Result<Self, Fault> {
        let (axis, feed) = match (count, width) {
            (3, _) => (None, None),
            (4, Width::Any) => (None, Some(3)),
            (6, Width::Any) => (Some([3, 4, 5]), None),
            (7, Width::Any) => (Some([3, 4, 5]), Some(6)),
            (_, Width::Points) => {
                return Err(Fault::new(format!("{count} numbers"), "a row is three numbers: x, y, z"));
            }
            (_, Width::Any) => {
                let expected = "a row is x, y, z, then i, j, k or not, then a feed or not; a header may name the columns";
                return Err(Fault::new(format!("{count} numbers"), expected));
            }
        };
        Ok(Self {
            count,
            point: [0, 1, 2],
            axis,
            feed,
            index: None,
            unit: None,
            feed_unit: None,
            named: false,
        })
    }

    /// The columns of a text without a header whose first column counts the rows.
    pub(super) fn after_index(count: usize, width: Width) -> Result<Self, Fault> {
        let Self { point, axis, .. } = Self::of_count(count - 1, width)?;
        let next = |cells: [usize; 3]| cells.map(|cell| cell + 1);
        let columns = Self::of_count(count, width)?;
        Ok(Self { point: next(point), axis: axis.map(next), feed: None, index: Some(0), ..columns })
    }

    /// The columns of a header. A fault comes with the index of its cell.
    pub(super) fn of_names(names: &[&str], width: Width) -> Result<Self, (usize, Fault)> {
        let mut places = [None; MOST];
        let (mut unit, mut feed_unit) = (None, None);
        for (index, name) in names.iter().enumerate() {
            let fault = |expected: &str| (index, Fault::new(format!("the column \"{name}\""), expected));
            let unknown = match width {
                Width::Points => "the columns are x, y, z",
                Width::Any => {
                    "the columns are x, y, z, i, j, k and feed, with or without a unit: x [mm], y_in"
                }
            };
            let (part, stated) =
                part_and_unit(name).ok_or_else(|| fault(if is_angle(name) { NO_ANGLES } else { unknown }))?;
            if width == Width::Points && part > 2 {
                return Err(fault(unknown));
            }
            if places[part].replace(index).is_some() {
                return Err(fault("each column may appear only once"));
            }
            match (part, stated.as_str()) {
                (_, "") | (INDEX, _) => {}
                (0..3, stated) => {
                    let read = length_unit(stated).ok_or_else(|| fault("lengths are in mm or in"))?;
                    if unit.replace(read).is_some_and(|before| before != read) {
                        return Err(fault("x, y and z have the same unit"));
                    }
                }
                (6, stated) => {
                    feed_unit =
                        Some(speed_unit(stated).ok_or_else(|| fault("feeds are in mm/s, mm/min or in/min"))?);
                }
                _ => return Err(fault("i, j and k have no unit")),
            }
        }
        let all = |part: usize| Some([places[part]?, places[part + 1]?, places[part + 2]?]);
        let end =
            |expected: &str| (names.len().saturating_sub(1), Fault::new("the end of the header", expected));
        let point = all(0).ok_or_else(|| end("the columns x, y and z are needed"))?;
        let axis = all(3);
        if axis.is_none() && places[3..6].iter().any(Option::is_some) {
            return Err(end("give all of i, j and k, or none"));
        }
        Ok(Self {
            count: names.len(),
            point,
            axis,
            feed: places[6],
            index: places[INDEX],
            unit,
            feed_unit,
            named: true,
        })
    }
}

/// The part of a row that a name stands for, and its unit: `x_mm`, `Feed rate [mm/min]`.
fn part_and_unit(name: &str) -> Option<(usize, String)> {
    let name = name.to_lowercase();
    let apart = |c: char| c.is_whitespace() || "_-/.,:[]()".contains(c);
    let mut words: Vec<&str> = name.split(apart).filter(|word| !word.is_empty() && *word != "per").collect();
    if name.is_empty() {
        words.push("");
    }
    let part_of = |name: &str| NAMES.iter().position(|names| names.contains(&name));
    // A name may have two words: axis i, pos x, feed rate.
    let joined = words.get(..2).map(<[&str]>::concat);
    let part = match joined.and_then(|joined| part_of(&joined)) {
        Some(part) => {
            words.drain(..2);
            part
        }
        None => {
            let part = part_of(words.first()?)?;
            words.remove(0);
            part
        }
    };
    Some((part, words.join("/")))
}

/// Whether a column's name is that of an angle or of a part of a quaternion: `A`, `rx [deg]`.
fn is_angle(name: &str) -> bool {
    let name = name.to_lowercase();
    let first = name.split(|c: char| !c.is_alphanumeric()).find(|word| !word.is_empty());
    first.is_some_and(|word| ANGLES.contains(&word))
}

fn length_unit(text: &str) -> Option<LengthUnit> {
    match text {
        "mm" => Some(LengthUnit::Mm),
        "in" | "inch" | "inches" => Some(LengthUnit::Inch),
        _ => None,
    }
}

fn speed_unit(text: &str) -> Option<FeedUnit> {
    match text {
        "mm/s" | "mm/sec" => Some(FeedUnit::MmPerS),
        "mm/min" | "mmpm" => Some(FeedUnit::MmPerMin),
        "in/min" | "inch/min" | "inches/min" | "ipm" => Some(FeedUnit::InchPerMin),
        _ => None,
    }
}
