//! Why a job is refused: each error carries the data needed to fix it.

use serde::ser::{Serialize, SerializeMap, Serializer};
use std::fmt;

/// Why a job was refused.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// The job's text is not JSON, or a value has the wrong type.
    Json {
        /// JSON path of the value, if the parser knows it.
        field: Option<String>,
        /// Message of the parser.
        message: String,
        /// Line in the text, from 1.
        line: usize,
        /// Column in the text, from 1.
        column: usize,
    },
    /// A key that does not exist in a job.
    UnknownKey {
        /// JSON path of the key.
        field: String,
        /// The most similar known key.
        nearest: Option<String>,
        /// Line in the text, from 1.
        line: usize,
        /// Column in the text, from 1.
        column: usize,
    },
    /// A number outside its range.
    OutOfRange {
        /// JSON path of the value.
        field: String,
        /// The value, in the field's unit.
        value: f64,
        /// Smallest allowed value.
        min: f64,
        /// Largest allowed value.
        max: f64,
        /// The field's unit.
        unit: &'static str,
    },
    /// A value that conflicts with the rest of the job.
    Invalid {
        /// JSON path of the value.
        field: String,
        /// The value as given.
        value: String,
        /// What is allowed.
        expected: String,
    },
    /// A sample time too short for how long the path takes.
    TooManySamples {
        /// JSON path of the sample time.
        field: String,
        /// The sample time [s].
        value: f64,
        /// The number of samples that it would give.
        samples: f64,
        /// The largest number of samples that is computed.
        most: f64,
        /// A sample time that gives few enough [s].
        least: f64,
    },
    /// A required key is missing.
    Missing {
        /// JSON path of the key.
        field: String,
        /// Why it is needed.
        expected: String,
    },
    /// A text (pasted points, a program) that cannot be read past one place.
    Text {
        /// JSON path of the text.
        field: String,
        /// Line in the text, from 1.
        line: usize,
        /// Column in the line, from 1.
        column: usize,
        /// The text at that place.
        found: String,
        /// What is allowed.
        expected: String,
    },
    /// A pose that is out of reach for every branch of the arm.
    Unreachable {
        /// Sample along the trajectory, from 0; `None` for a single pose.
        sample: Option<usize>,
        /// Arc length along the path [m], if the pose lies on one.
        arc_length: Option<f64>,
        /// The requested TCP position in the base frame [m].
        position: [f64; 3],
        /// Distance of the wrist centre from the shoulder axis [m].
        distance: f64,
        /// Smallest reach of the arm [m].
        reach_min: f64,
        /// Largest reach of the arm [m].
        reach_max: f64,
    },
    /// A pose that the arm reaches, but not on the branch that it comes on: a joint would have to
    /// turn far from one sample to the next.
    BranchEnds {
        /// Sample along the trajectory, from 0.
        sample: usize,
        /// Arc length along the path [m].
        arc_length: f64,
        /// Line of the program, from 1; 0 if the path has none.
        line: usize,
        /// The requested TCP position in the base frame [m].
        position: [f64; 3],
        /// The joint that would turn furthest, from 1.
        joint: usize,
        /// How far it would turn [rad].
        turn: f64,
    },
}

impl Error {
    /// A value that conflicts with the rest of the job: its JSON path, the value as given, and what
    /// is allowed.
    pub fn invalid(field: impl Into<String>, value: impl ToString, expected: impl Into<String>) -> Error {
        Error::Invalid { field: field.into(), value: value.to_string(), expected: expected.into() }
    }

    /// A required key is missing: its JSON path and why it is needed.
    pub fn missing(field: impl Into<String>, expected: impl Into<String>) -> Error {
        Error::Missing { field: field.into(), expected: expected.into() }
    }

    /// A word that is not one of `names`. `known` introduces the list of names in the message, as
    /// in "the charts are".
    pub fn unknown_name<'a>(
        field: impl Into<String>,
        given: &str,
        known: &str,
        names: impl IntoIterator<Item = &'a str>,
    ) -> Error {
        let names: Vec<_> = names.into_iter().collect();
        Error::invalid(field, format!("\"{given}\""), format!("{known} {}", names.join(", ")))
    }

    /// Stable slug for scripts, tests and links.
    pub fn code(&self) -> &'static str {
        match self {
            Error::Json { .. } => "json",
            Error::UnknownKey { .. } => "unknown-key",
            Error::OutOfRange { .. } => "out-of-range",
            Error::Invalid { .. } | Error::TooManySamples { .. } => "invalid",
            Error::Missing { .. } => "missing",
            Error::Text { .. } => "text",
            Error::Unreachable { .. } => "unreachable",
            Error::BranchEnds { .. } => "branch-ends",
        }
    }

    /// JSON path of the field at fault, if there is one.
    pub fn field(&self) -> Option<&str> {
        match self {
            Error::Json { field, .. } => field.as_deref(),
            Error::UnknownKey { field, .. }
            | Error::OutOfRange { field, .. }
            | Error::Invalid { field, .. }
            | Error::TooManySamples { field, .. }
            | Error::Missing { field, .. }
            | Error::Text { field, .. } => Some(field),
            Error::Unreachable { .. } | Error::BranchEnds { .. } => None,
        }
    }

    /// Line and column (both from 1) of the text at fault: the job's JSON, or the text in
    /// [`Error::field`].
    pub fn place(&self) -> Option<(usize, usize)> {
        match self {
            Error::Json { line, column, .. }
            | Error::UnknownKey { line, column, .. }
            | Error::Text { line, column, .. } => Some((*line, *column)),
            _ => None,
        }
    }

    /// The error with its place along the path.
    pub(crate) fn at(self, index: usize, s: f64) -> Self {
        match self {
            Error::Unreachable { position, distance, reach_min, reach_max, .. } => Error::Unreachable {
                sample: Some(index),
                arc_length: Some(s),
                position,
                distance,
                reach_min,
                reach_max,
            },
            other => other,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Json { message, .. } => write!(f, "{message}"),
            Error::UnknownKey { field, nearest, .. } => {
                write!(f, "unknown key {}", Short(field))?;
                match nearest {
                    Some(key) => write!(f, "; did you mean {key}?"),
                    None => Ok(()),
                }
            }
            Error::OutOfRange { field, value, min, max, unit } => {
                let space = if unit.is_empty() { "" } else { " " };
                let size = value.abs();
                // Avoids printing f64::MAX with all its 309 digits.
                let value = if size != 0.0 && !(1e-9..1e15).contains(&size) {
                    format!("{value:e}")
                } else {
                    value.to_string()
                };
                write!(f, "{field} is {value}{space}{unit}; it must be {min} to {max}{space}{unit}")
            }
            Error::Invalid { field, value, expected } => write!(f, "{field} is {}; {expected}", Short(value)),
            Error::TooManySamples { field, value, samples, most, least } => write!(
                f,
                "{field} is {value}; the path would take {} samples, but at most {} are computed: use {least} s or more",
                grouped(*samples),
                grouped(*most)
            ),
            Error::Missing { field, expected } => write!(f, "{field} is missing: {expected}"),
            Error::Text { line, column, found, expected, .. } => {
                write!(f, "line {line}, column {column}: found {}; {expected}", Short(found))
            }
            Error::Unreachable {
                sample,
                arc_length,
                position: [x, y, z],
                distance,
                reach_min,
                reach_max,
            } => {
                write!(f, "out of reach: ")?;
                if let Some(sample) = sample {
                    write!(f, "sample {sample}")?;
                    if let Some(s) = arc_length {
                        write!(f, ", {:.1} mm along the path", s * 1e3)?;
                    }
                    write!(f, ", ")?;
                }
                write!(
                    f,
                    "TCP at ({:.1}, {:.1}, {:.1}) mm in the base frame: the wrist would be {:.1} mm from the \
                     shoulder, but the arm reaches {:.1} to {:.1} mm; move the workpiece {} (workpiece_frame), turn the tool \
                     or choose another arm",
                    x * 1e3,
                    y * 1e3,
                    z * 1e3,
                    distance * 1e3,
                    reach_min * 1e3,
                    reach_max * 1e3,
                    if *distance > (reach_min + reach_max) / 2.0 { "closer" } else { "further away" }
                )
            }
            Error::BranchEnds { sample, arc_length, line, position: [x, y, z], joint, turn } => {
                write!(
                    f,
                    "the arm's branch ends: sample {sample}, {:.1} mm along the path",
                    arc_length * 1e3
                )?;
                if *line > 0 {
                    write!(f, ", line {line}")?;
                }
                write!(
                    f,
                    ", TCP at ({:.1}, {:.1}, {:.1}) mm in the base frame: joint {joint} would turn by {:.0} deg \
                     from one sample to the next; try another start_branch or spin (angle, reference, \
                     or free), turn the tool over a longer move, use shorter samples, or move the part",
                    x * 1e3,
                    y * 1e3,
                    z * 1e3,
                    turn.to_degrees()
                )
            }
        }
    }
}

impl std::error::Error for Error {}

/// Serialized for scripts: one object with `code` and `message`, plus `field`, `line` and `column`
/// where they apply.
impl Serialize for Error {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_map(None)?;
        object.serialize_entry("code", self.code())?;
        object.serialize_entry("message", &self.to_string())?;
        if let Some(field) = self.field() {
            object.serialize_entry("field", field)?;
        }
        if let Some((line, column)) = self.place() {
            object.serialize_entry("line", &line)?;
            object.serialize_entry("column", &column)?;
        }
        if let Error::OutOfRange { value, min, max, unit, .. } = self {
            object.serialize_entry("value", value)?;
            object.serialize_entry("min", min)?;
            object.serialize_entry("max", max)?;
            object.serialize_entry("unit", unit)?;
        }
        if let Error::TooManySamples { value, least, .. } = self {
            object.serialize_entry("value", value)?;
            object.serialize_entry("min", least)?;
            object.serialize_entry("unit", "s")?;
        }
        object.end()
    }
}

/// User input, truncated to fit in a sentence: it may be a whole file without a line break.
pub(crate) struct Short<'a>(pub(crate) &'a str);

impl fmt::Display for Short<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.char_indices().nth(300) {
            Some((end, _)) => write!(f, "{}...", &self.0[..end]),
            None => f.write_str(self.0),
        }
    }
}

/// A count with its thousands set off by narrow no-break spaces, as the page writes numbers.
pub(crate) fn grouped(count: f64) -> String {
    let digits = format!("{count:.0}");
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}
