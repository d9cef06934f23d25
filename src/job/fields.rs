//! Every input of a job as shown to the user: label, unit, range, default and a line of help.
//!
//! The page builds its form from this table and the job is checked against it, so each range is
//! written only once. The table itself is in `fields.txt`.

mod block;

use crate::error::Error;
use crate::job::{DhRow, Job, Opw, PathKind};
use crate::robot::library::Preset;
use block::FieldBlock;
use serde::{Deserialize, Serialize, Serializer};
use serde_json::Value;
use std::collections::BTreeMap;
use std::sync::OnceLock;

const TEXT: &str = include_str!("fields.txt");

/// How a value is entered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FieldKind {
    /// A number.
    Number,
    /// A whole number.
    Integer,
    /// One of a few words.
    Choice,
    /// Three numbers.
    Vector,
    /// A table of numbers.
    Table,
    /// Free text.
    Text,
    /// Any of a few words.
    Set,
}

/// One input.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Field {
    /// JSON path in the job.
    pub path: &'static str,
    /// Stage in the pipeline.
    pub group: &'static str,
    /// Name shown to the user.
    pub label: &'static str,
    /// Unit shown to the user.
    pub unit: &'static str,
    /// How it is entered.
    pub kind: FieldKind,
    /// Words it accepts, with their labels; a number or vector takes them in addition to numbers.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub choices: Vec<ChoiceWord>,
    /// Smallest number it accepts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min: Option<f64>,
    /// Largest number it accepts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<f64>,
    /// Smallest and largest number of usual jobs: what a slider covers, on a logarithmic scale.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub usual: Option<[f64; 2]>,
    /// Value of a new field.
    pub default: DefaultValue,
    /// Values of a new field by the word of the field in `when`, if they differ.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub defaults: Option<BTreeMap<&'static str, DefaultValue>>,
    /// Its meaning, and where to find its value.
    pub help: String,
    /// Shown only if another field has one of these values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub when: Option<When>,
}

/// The value of a new field, in the form of its JSON key.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum DefaultValue {
    /// A number, in the field's unit.
    #[serde(serialize_with = "plain")]
    Number(f64),
    /// The word of a choice, or a text.
    Text(String),
    /// Rows of numbers: points, or the range of each joint.
    Rows(Vec<Vec<f64>>),
    /// A few numbers: a vector, or one for each joint.
    Numbers(Vec<f64>),
    /// Words of a set.
    Words(Vec<String>),
    /// A modified DH table.
    #[serde(skip_deserializing)]
    ModifiedDh([DhRow; 6]),
    /// Ortho-parallel parameters.
    #[serde(skip_deserializing)]
    Opw(Opw),
}

/// Writes whole numbers without a decimal point, as keys that hold counts need them.
fn plain<S: Serializer>(number: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    if number.fract() == 0.0 && number.abs() < 1e15 {
        serializer.serialize_i64(*number as i64)
    } else {
        serializer.serialize_f64(*number)
    }
}

/// A word that a field accepts.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChoiceWord {
    /// As in the JSON.
    pub value: &'static str,
    /// Label shown to the user.
    pub label: String,
    /// Heading in a long list.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub heading: Option<&'static str>,
}

/// The condition under which a field belongs to the job.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct When {
    /// The other field.
    pub path: &'static str,
    /// Its values.
    pub is: Vec<&'static str>,
}

/// A robot's modified DH table as in the JSON.
pub(crate) fn dh_rows(preset: &Preset) -> [DhRow; 6] {
    let (rows, signs) = (preset.opw.modified_dh(), preset.opw.joint_sign);
    std::array::from_fn(|i| {
        let [alpha_deg, a_mm, d_mm, theta_offset_deg] = rows[i];
        DhRow { alpha_deg, a_mm, d_mm, theta_offset_deg, joint_sign: signs[i] }
    })
}

/// A robot's ortho-parallel parameters as in the JSON.
pub(crate) fn opw(preset: &Preset) -> Opw {
    let [a1_mm, a2_mm, b_mm, c1_mm, c2_mm, c3_mm, c4_mm] = preset.opw.lengths_mm;
    let (joint_sign, joint_offset_deg) = (preset.opw.joint_sign, preset.opw.joint_offset_deg);
    Opw { a1_mm, a2_mm, b_mm, c1_mm, c2_mm, c3_mm, c4_mm, joint_sign, joint_offset_deg }
}

/// The table, in the order of the pipeline.
pub fn fields() -> Vec<Field> {
    table().to_vec()
}

/// The data file, read once.
fn table() -> &'static [Field] {
    static TABLE: OnceLock<Vec<Field>> = OnceLock::new();
    TABLE.get_or_init(|| block::blocks(TEXT).iter().filter_map(FieldBlock::field).collect())
}

/// The job with its texts, which may be megabytes long, replaced by empty ones.
fn outline(job: &Job) -> Job {
    let mut outline = job.clone();
    outline.path.text = job.path.text.as_ref().map(|_| "".into());
    outline.stock.stl = job.stock.stl.as_ref().map(|_| "".into());
    for earlier in outline.stock.earlier.iter_mut().flatten() {
        earlier.text = "".into();
    }
    outline
}

/// Checks every number in the job against the table.
pub(crate) fn check_ranges(job: &Job) -> Result<(), Error> {
    let Ok(values) = serde_json::to_value(outline(job)) else { return Ok(()) };
    for field in table() {
        let Some((min, max)) = field.min.zip(field.max) else { continue };
        let value = field.path.split('.').try_fold(&values, |value, key| value.get(key));
        if let Some(value) = value {
            check(field.path.to_owned(), value, min, max, field.unit)?;
        }
    }
    Ok(())
}

fn check(field: String, value: &Value, min: f64, max: f64, unit: &'static str) -> Result<(), Error> {
    match value {
        Value::Array(items) => items
            .iter()
            .enumerate()
            .try_for_each(|(index, item)| check(format!("{field}[{index}]"), item, min, max, unit)),
        Value::Object(parts) => {
            parts.iter().try_for_each(|(key, part)| check(format!("{field}.{key}"), part, min, max, unit))
        }
        // serde_json writes non-finite numbers as null.
        Value::Null => Err(Error::invalid(field, "not a finite number", format!("{min} to {max} {unit}"))),
        Value::Number(number) => match number.as_f64() {
            Some(value) if value >= min && value <= max => Ok(()),
            number => Err(Error::OutOfRange { field, value: number.unwrap_or(f64::NAN), min, max, unit }),
        },
        _ => Ok(()),
    }
}

/// Refuses keys of the path that its kind does not use, as they would be ignored silently.
pub(crate) fn check_path_keys(job: &Job) -> Result<(), Error> {
    let Ok(given) = serde_json::to_value(outline(job).path) else { return Ok(()) };
    let kind = job.path.kind.word();
    check_keys("path", &given, kind)?;
    // They have no field in the form.
    for key in ["block_delete", "start_mm"] {
        if given.get(key).is_some() && job.path.kind != PathKind::Gcode {
            let expected = format!("a path of kind {kind} has no {key}; only gcode has it");
            return Err(Error::invalid(format!("path.{key}"), "given", expected));
        }
    }
    Ok(())
}

/// Refuses keys of the stock that its kind does not use.
pub(crate) fn check_stock_keys(job: &Job) -> Result<(), Error> {
    let Ok(given) = serde_json::to_value(outline(job).stock) else { return Ok(()) };
    check_keys("stock", &given, job.stock.kind.word())
}

/// Refuses keys of a section that its kind does not use.
fn check_keys(section: &str, given: &Value, kind: &str) -> Result<(), Error> {
    for field in table() {
        let key = field.path.strip_prefix(section).and_then(|rest| rest.strip_prefix('.'));
        let Some((key, when)) = key.zip(field.when.as_ref()) else { continue };
        if given.get(key).is_some() && !when.is.contains(&kind) {
            let kinds = when.is.join(", ");
            return Err(Error::invalid(
                field.path,
                "given",
                format!("a {section} of kind {kind} has no {key}; only {kinds} has it"),
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outline_is_the_job_without_its_program() {
        let mut job = Job::default();
        assert_eq!(outline(&job), job);
        job.path.text = Some("G21 G90".into());
        let mut outline = outline(&job);
        assert_eq!(outline.path.text.as_deref(), Some(""));
        outline.path.text.clone_from(&job.path.text);
        assert_eq!(outline, job);
    }
}
