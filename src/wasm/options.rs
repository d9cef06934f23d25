//! Options from JavaScript: read into a type, or refused with an error that names the wrong key.

use crate::chart::{self, ForceUnit, Units};
use crate::error::Error;
use crate::path::unit::LengthUnit;
use crate::wasm::error::thrown;
use js_sys::{JSON, Object, Reflect};
use serde::de::{DeserializeOwned, Deserializer, Error as _, Visitor};
use serde::{Deserialize, forward_to_deserialize_any};
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsCast, JsValue};

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
export interface ChartUnits { length?: "mm" | "inch"; force?: "N" | "lbf"; }
export interface ChartOptions extends ChartUnits {
  width: number; height: number; x_range?: [number, number]; y_range?: [number, number]; hidden?: string[];
}
"#;

/// `length` of the options.
#[derive(Clone, Copy, Default, Deserialize)]
enum Length {
    #[default]
    #[serde(rename = "mm")]
    Mm,
    #[serde(rename = "inch")]
    Inch,
}

/// `force` of the options.
#[derive(Clone, Copy, Default, Deserialize)]
enum Force {
    #[default]
    N,
    #[serde(rename = "lbf")]
    Lbf,
}

/// Units of a chart; mm and N by default.
#[derive(Deserialize)]
#[serde(default)]
#[derive(Default)]
struct Reading {
    length: Length,
    force: Force,
}

/// How to draw a chart.
#[derive(Deserialize)]
struct Drawing {
    width: f64,
    height: f64,
    x_range: Option<(f64, f64)>,
    y_range: Option<(f64, f64)>,
    #[serde(default)]
    hidden: Vec<String>,
    #[serde(default)]
    length: Length,
    #[serde(default)]
    force: Force,
}

/// Reads `ChartUnits`.
pub(super) fn units(options: JsValue) -> Result<Units, JsValue> {
    read(options).map(|Reading { length, force }| chosen(length, force))
}

/// Reads `ChartOptions`.
pub(super) fn chart(options: JsValue) -> Result<chart::ChartOptions, JsValue> {
    let Drawing { width, height, x_range, y_range, hidden, length, force } = read(options)?;
    Ok(chart::ChartOptions { width, height, x_range, y_range, hidden, units: chosen(length, force) })
}

fn chosen(length: Length, force: Force) -> Units {
    let length = match length {
        Length::Mm => LengthUnit::Mm,
        Length::Inch => LengthUnit::Inch,
    };
    let force = match force {
        Force::N => ForceUnit::Newton,
        Force::Lbf => ForceUnit::PoundForce,
    };
    Units { length, force }
}

/// Reads a struct; `undefined` counts as an empty object.
fn read<T: DeserializeOwned>(options: JsValue) -> Result<T, JsValue> {
    let options = if options.is_undefined() { Object::new().into() } else { options };
    serde_path_to_error::deserialize(Strict(&options)).map_err(|error| {
        let path = error.path().to_string();
        thrown(&refused(&path, &error.into_inner().to_string(), &options))
    })
}

/// The error for a key, from serde's message: `invalid type: string "wide", expected f64`.
fn refused(path: &str, message: &str, options: &JsValue) -> Error {
    let message = message.trim_start_matches("Error: ");
    let quoted = message.split('`').nth(1);
    let (problem, expected) = message.split_once(", expected ").unwrap_or((message, ""));
    let expected = expected.replace("f64", "a number");
    match (quoted, problem.split(' ').next()) {
        (Some(key), Some("missing")) => Error::missing(key, "these options need it"),
        (Some(key), Some("unknown")) if problem.starts_with("unknown field") => {
            Error::invalid(key, "given", format!("the keys are {expected}"))
        }
        _ => {
            let key = path.split(['.', '[']).next().unwrap_or(path);
            let value = Reflect::get(options, &key.into()).and_then(|value| JSON::stringify(&value));
            let value = value.map_or_else(|_| "unreadable".to_owned(), String::from);
            Error::invalid(path, value, format!("expected {expected}"))
        }
    }
}

/// serde-wasm-bindgen's deserializer ignores keys that a struct does not have; this one refuses
/// them.
struct Strict<'a>(&'a JsValue);

impl<'de> Deserializer<'de> for Strict<'_> {
    type Error = serde_wasm_bindgen::Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Self::Error> {
        serde_wasm_bindgen::Deserializer::from(self.0.clone()).deserialize_any(visitor)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Self::Error> {
        let keys = self.0.dyn_ref::<Object>().map(Object::keys).unwrap_or_default();
        let mut keys = keys.iter().filter_map(|key| key.as_string());
        if let Some(key) = keys.find(|key| !fields.contains(&key.as_str())) {
            return Err(Self::Error::unknown_field(&key, fields));
        }
        serde_wasm_bindgen::Deserializer::from(self.0.clone()).deserialize_struct(name, fields, visitor)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 u8 u16 u32 u64 f32 f64 char str string bytes byte_buf option unit
        unit_struct newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}
