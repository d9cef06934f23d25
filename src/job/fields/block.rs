//! Parses the blocks of `fields.txt` into fields. The file's first lines explain the format.

use super::{ChoiceWord, DefaultValue, Field, When, dh_rows, opw};
use crate::cutting::material::{self, Material};
use crate::job::Job;
use crate::robot::library;
use std::collections::BTreeMap;

/// A block of the table: its first line, and the lines of each key.
pub(super) struct FieldBlock {
    head: &'static str,
    keys: Vec<(&'static str, Vec<&'static str>)>,
}

/// The blocks of a text. Empty lines and lines that begin with # are skipped.
pub(super) fn blocks(text: &'static str) -> Vec<FieldBlock> {
    let mut blocks: Vec<FieldBlock> = Vec::new();
    for line in text.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        let content = line.trim_start();
        match (line.len() - content.len(), blocks.last_mut()) {
            (2, Some(block)) => {
                let (key, value) = content.split_once(':').unwrap_or((content, ""));
                let value = Some(value.trim_start()).filter(|value| !value.is_empty());
                block.keys.push((key, Vec::from_iter(value)));
            }
            (4, Some(block)) => {
                block.keys.last_mut().into_iter().for_each(|(_, lines)| lines.push(content));
            }
            // Any other indentation starts a new block, which is not a field.
            _ => blocks.push(FieldBlock { head: line, keys: Vec::new() }),
        }
    }
    blocks
}

impl FieldBlock {
    /// The field; `None` if the block breaks the rules at the top of the file.
    pub(super) fn field(&self) -> Option<Field> {
        let (path, kind) = self.head.split_once(": ")?;
        let (kind, unit) = match kind.split_once(" [") {
            Some((kind, unit)) => (kind, unit.strip_suffix(']')?),
            None => (kind, ""),
        };
        let (mut label, mut help, mut when) = (None, None, None);
        let (mut range, mut usual, mut choices) = (None, None, Vec::new());
        let (mut default, mut defaults) = (None, BTreeMap::new());
        for (key, lines) in &self.keys {
            match (*key, lines.as_slice()) {
                ("label", [line]) => label = Some(*line),
                ("help", lines) => help = Some(lines.join(" ")),
                ("range", [line]) => range = Some(span(line)?),
                ("usual", [line]) => usual = Some(span(line)?),
                ("words", lines) => choices = words(path, lines)?,
                ("when", [line]) => {
                    let (path, is) = line.split_once(" = ")?;
                    when = Some(When { path, is: is.split(", ").collect() });
                }
                ("default", lines) => default = Some(default_value(path, lines)?),
                (key, lines) => {
                    let value = default_value(path, lines)?;
                    default.get_or_insert_with(|| value.clone());
                    defaults.insert(key.strip_prefix("default of ")?, value);
                }
            }
        }
        Some(Field {
            path,
            group: group(path),
            label: label?,
            unit,
            kind: serde_json::from_value(kind.into()).ok()?,
            choices,
            min: range.map(|[min, _]| min),
            max: range.map(|[_, max]| max),
            usual,
            default: default?,
            defaults: (!defaults.is_empty()).then_some(defaults),
            help: help?,
            when,
        })
    }
}

/// The numbers of "1 to 10".
fn span(line: &str) -> Option<[f64; 2]> {
    let (low, high) = line.split_once(" to ")?;
    Some([low.parse().ok()?, high.parse().ok()?])
}

/// The stage of a key of the job.
fn group(path: &'static str) -> &'static str {
    match path.split('.').next().unwrap_or(path) {
        "tool_frame" | "base_frame" | "workpiece_frame" | "spin" | "start_branch" => "frames",
        section => section,
    }
}

/// The words that a field accepts. Those of presets come from the libraries.
fn words(path: &str, lines: &[&'static str]) -> Option<Vec<ChoiceWord>> {
    if lines != ["of the library"] {
        let words = lines.iter().flat_map(|line| line.trim_end_matches(';').split("; "));
        let word = |(value, label): (_, &str)| ChoiceWord { value, label: label.into(), heading: None };
        return words.map(|text| text.split_once(" = ").map(word)).collect();
    }
    let robot = |[value, maker, model]: [&'static str; 3]| ChoiceWord {
        value,
        label: format!("{maker} {model}"),
        heading: Some(maker),
    };
    let material = |material: &Material| ChoiceWord {
        value: material.id,
        label: material.name.into(),
        heading: Some(material.model.heading()),
    };
    match path {
        "robot.preset" => Some(library::names().map(robot).collect()),
        "material.preset" => Some(material::library().iter().map(material).collect()),
        _ => None,
    }
}

/// The value of a new field: a text, a value of the default job's robot, or a JSON value.
fn default_value(path: &str, lines: &[&str]) -> Option<DefaultValue> {
    let text = |line: &&str| Some(format!("{}\n", line.strip_prefix('|')?.trim_start()));
    if let Some(text) = lines.iter().map(text).collect() {
        return Some(DefaultValue::Text(text));
    }
    if lines != ["of the default robot"] {
        return serde_json::from_str(&lines.join(" ")).ok();
    }
    let robot = library::robot(&Job::default().robot.preset?).ok()?;
    match path {
        "robot.modified_dh" => Some(DefaultValue::ModifiedDh(dh_rows(&robot))),
        "robot.opw" => Some(DefaultValue::Opw(opw(&robot))),
        "robot.joint_limits_deg" => {
            let ranges = robot.joint_limits_deg?;
            Some(DefaultValue::Rows(ranges.iter().map(|range| range.to_vec()).collect()))
        }
        "robot.joint_compliance_rad_per_nm" => Some(DefaultValue::Numbers(robot.joint_compliance.to_vec())),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutting::kienzle::{AXIAL, RADIAL};
    use crate::error::Error;
    use crate::job::fields::{FieldKind, TEXT, table};
    use serde_json::{Value, json};

    fn field(path: &str) -> &'static Field {
        table().iter().find(|field| field.path == path).unwrap()
    }

    /// Whether a job accepts this value, regardless of other missing keys.
    fn is_read(path: &str, value: &Value) -> bool {
        let (section, key) = path.split_once('.').unwrap();
        match Job::from_json(&json!({ section: { key: value } }).to_string()) {
            Ok(_) => true,
            Err(Error::Json { field: Some(field), .. }) => !field.starts_with(path),
            Err(_) => false,
        }
    }

    #[test]
    fn every_block_of_the_data_file_is_a_field() {
        let heads = TEXT.lines().filter(|line| !line.is_empty() && !line.starts_with(['#', ' ']));
        let heads: Vec<_> = heads.collect();
        for block in blocks(TEXT) {
            assert!(block.field().is_some(), "{} does not follow the rules of the file", block.head);
            for (k, (key, lines)) in block.keys.iter().enumerate() {
                assert!(!lines.is_empty(), "{}: nothing after {key}", block.head);
                assert!(block.keys[..k].iter().all(|(other, _)| other != key), "{}: {key} twice", block.head);
            }
        }
        assert_eq!(blocks(TEXT).iter().map(|block| block.head).collect::<Vec<_>>(), heads);
        assert_eq!(table().len(), heads.len());
        assert!(heads.len() >= 85);
        assert!(TEXT.lines().all(|line| line.chars().count() <= 100));
    }

    #[test]
    fn a_block_against_the_rules_is_no_field() {
        let is_field = |text| blocks(text).iter().all(|block| block.field().is_some());
        assert!(is_field("a.b: number [mm]\n  label: A\n  default: 1\n  range: 0 to 2\n  help: A\n    b."));
        for text in [
            "a.b\n  label: A\n  default: 1\n  help: B.",
            "a.b: figure\n  label: A\n  default: 1\n  help: B.",
            "a.b: number [mm\n  label: A\n  default: 1\n  help: B.",
            "a.b: number\n  default: 1\n  help: B.",
            "a.b: number\n  label: A\n    B\n  default: 1\n  help: B.",
            "a.b: number\n  label: A\n  help: B.",
            "a.b: number\n  label: A\n  default: one\n  help: B.",
            "a.b: number\n  label: A\n  default: of the default robot\n  help: B.",
            "a.b: number\n  label: A\n  default: 1\n  range: 0 till 2\n  help: B.",
            "a.b: choice\n  label: A\n  default: \"c\"\n  words: c\n  help: B.",
            "a.b: choice\n  label: A\n  default: \"c\"\n  words: of the library\n  help: B.",
            "a.b: number\n  label: A\n  default: 1\n  when: c\n  help: B.",
            "a.b: number\n  label: A\n  default: 1\n  help: B.\n  remark: C.",
            "a.b: number\n  label: A\n  default: 1\n  help: B.\n   when: c.d = e",
        ] {
            assert!(!is_field(text), "{text}");
        }
    }

    #[test]
    fn every_field_is_a_key_of_the_job_and_shows_what_it_reads() {
        for (k, field) in table().iter().enumerate() {
            let path = field.path;
            assert!(table()[..k].iter().all(|other| other.path != path), "{path} twice");
            assert!(!field.label.is_empty() && !field.help.is_empty(), "{path}");
            let defaults = field.defaults.iter().flat_map(BTreeMap::values).chain([&field.default]);
            for value in defaults {
                assert!(is_read(path, &json!(value)), "{path}: {value:?}");
            }
            assert!(!is_read(&format!("{path}s"), &json!(field.default)), "{path}s is none");
        }
    }

    #[test]
    fn every_range_has_numbers_and_its_default() {
        for Field { path, kind, min, max, default, choices, .. } in table() {
            let numeric = matches!(kind, FieldKind::Number | FieldKind::Integer | FieldKind::Vector);
            assert!(min.is_some() || !numeric, "{path} has no range");
            assert!(min.zip(*max).is_none_or(|(min, max)| min < max), "{path}");
            let inside = |value: &f64| min.zip(*max).is_none_or(|(min, max)| (min..=max).contains(value));
            let fits = match default {
                DefaultValue::Number(value) => {
                    inside(value) && matches!(kind, FieldKind::Number | FieldKind::Integer)
                }
                DefaultValue::Numbers(values) => {
                    values.iter().all(inside) && matches!(kind, FieldKind::Vector | FieldKind::Table)
                }
                DefaultValue::Rows(rows) => rows.iter().flatten().all(inside) && *kind == FieldKind::Table,
                DefaultValue::ModifiedDh(_) | DefaultValue::Opw(_) => *kind == FieldKind::Table,
                DefaultValue::Text(_) if *kind == FieldKind::Text => choices.is_empty(),
                DefaultValue::Text(word) => choices.iter().any(|choice| choice.value == word),
                DefaultValue::Words(words) => {
                    let known = |word| choices.iter().any(|choice| choice.value == word);
                    words.iter().all(known) && *kind == FieldKind::Set
                }
            };
            assert!(fits, "{path}: {default:?}");
        }
    }

    #[test]
    fn every_word_is_one_that_the_job_reads() {
        for Field { path, kind, choices, defaults, when, .. } in table() {
            assert!(
                !choices.is_empty() || !matches!(kind, FieldKind::Choice | FieldKind::Set),
                "{path} has no words"
            );
            for (k, ChoiceWord { value, label, .. }) in choices.iter().enumerate() {
                assert!(choices[..k].iter().all(|other| other.value != *value), "{path}: {value} twice");
                assert!(!label.is_empty(), "{path}: {value}");
                let given = if *kind == FieldKind::Set { json!([value]) } else { json!(value) };
                // No shaper is a word in place of the section.
                let none = *path == "shaper.kind" && *value == "none";
                assert!(none || is_read(path, &given), "{path}: {value}");
            }
            let Some(When { path: other, is }) = when else { continue };
            assert!(!is.is_empty(), "{path}");
            // A section stands for the input forms that the page offers for it.
            if other.contains('.') {
                let known = |word: &&str| field(other).choices.iter().any(|choice| choice.value == *word);
                assert!(is.iter().all(known), "{path}: {is:?}");
            } else {
                assert!(table().iter().any(|field| field.group == *other), "{path}: {other}");
            }
            assert!(defaults.iter().flatten().all(|(word, _)| is.contains(word)), "{path}: {defaults:?}");
        }
    }

    #[test]
    fn the_usual_shares_of_the_force_are_kienzle_s() {
        assert_eq!(field("material.radial_ratio").default, DefaultValue::Number(RADIAL));
        assert_eq!(field("material.axial_ratio").default, DefaultValue::Number(AXIAL));
    }
}
