//! Options from JavaScript: read into a type, or refused with an error that names the wrong key.

use crate::chart::{self, ForceUnit, Over, Units};
use crate::error::Error;
use crate::path::unit::LengthUnit;
use crate::wasm::error::thrown;
use js_sys::{JSON, Object, Reflect};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsCast, JsValue};

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
export interface ChartUnits { length?: "mm" | "inch"; force?: "N" | "lbf"; }
/** First axis of a chart of kind "time"; a chart's entry lists those that it has. */
export type Over = "time" | "length" | "line";
export interface ChartValues extends ChartUnits { over?: Over; }
/** `scale` "auto" is "log" where all curves but the highest peak below a tenth of it; left out, the chart's own. */
export interface ChartOptions extends ChartValues {
  width: number; height: number; x_range?: [number, number]; y_range?: [number, number]; hidden?: string[];
  scale?: "linear" | "log" | "auto";
}
"#;

/// The keys of the options, and what each may be.
const KEYS: [(&str, &str); 9] = [
    ("width", "a number of pixels"),
    ("height", "a number of pixels"),
    ("x_range", "two numbers: the ends of the range"),
    ("y_range", "two numbers: the ends of the range"),
    ("hidden", "a list of keys of series"),
    ("length", "mm or inch"),
    ("force", "N or lbf"),
    ("scale", "linear, log or auto"),
    ("over", "time, length or line"),
];

/// The choices of `length`.
#[derive(Clone, Copy, Default, Deserialize)]
enum Length {
    #[default]
    #[serde(rename = "mm")]
    Mm,
    #[serde(rename = "inch")]
    Inch,
}

/// The choices of `force`.
#[derive(Clone, Copy, Default, Deserialize)]
enum Force {
    #[default]
    N,
    #[serde(rename = "lbf")]
    Lbf,
}

/// Reads the units of `ChartUnits`; those of a chart's whole options serve as well.
pub(super) fn units(options: JsValue) -> Result<Units, JsValue> {
    let options = Options::of(options).map_err(|error| thrown(&error))?;
    options.units().map_err(|error| thrown(&error))
}

/// Reads `ChartValues`; a chart's whole options serve as well.
pub(super) fn values(options: JsValue) -> Result<(Units, Over), JsValue> {
    let read = |options: JsValue| {
        let options = Options::of(options)?;
        Ok((options.units()?, options.get("over")?.unwrap_or_default()))
    };
    read(options).map_err(|error: Error| thrown(&error))
}

/// Reads `ChartOptions`.
pub(super) fn chart(options: JsValue) -> Result<chart::ChartOptions, JsValue> {
    let read = |options: JsValue| {
        let options = Options::of(options)?;
        Ok(chart::ChartOptions {
            width: options.required("width")?,
            height: options.required("height")?,
            x_range: options.range("x_range")?,
            y_range: options.range("y_range")?,
            hidden: options.get("hidden")?.unwrap_or_default(),
            units: options.units()?,
            scaling: options.get("scale")?,
            over: options.get("over")?.unwrap_or_default(),
        })
    };
    read(options).map_err(|error: Error| thrown(&error))
}

/// An object with known keys only.
struct Options(JsValue);

impl Options {
    /// Options from JavaScript; undefined and null count as none.
    fn of(options: JsValue) -> Result<Self, Error> {
        if options.is_undefined() || options.is_null() {
            return Ok(Self(Object::new().into()));
        }
        let Some(object) = options.dyn_ref::<Object>() else {
            return Err(Error::invalid("options", shown(&options), "an object is expected"));
        };
        let known = |key: &String| KEYS.iter().any(|(name, _)| name == key);
        let mut keys =
            Object::keys(object).iter().filter_map(|key| key.as_string()).collect::<Vec<_>>().into_iter();
        match keys.find(|key| !known(key)) {
            Some(key) => {
                let names = KEYS.map(|(name, _)| name).join(", ");
                Err(Error::invalid(key, "given", format!("the keys are {names}")))
            }
            None => Ok(Self(options)),
        }
    }

    /// The value of a key; `None` if it is absent, undefined or null.
    fn get<T: DeserializeOwned>(&self, key: &str) -> Result<Option<T>, Error> {
        let value = Reflect::get(&self.0, &key.into()).unwrap_or(JsValue::UNDEFINED);
        if value.is_undefined() || value.is_null() {
            return Ok(None);
        }
        let wrong = || Error::invalid(key, shown(&value), format!("{} is expected", expected(key)));
        serde_wasm_bindgen::from_value(value.clone()).map(Some).map_err(|_| wrong())
    }

    /// The value of a key that must be there.
    fn required<T: DeserializeOwned>(&self, key: &str) -> Result<T, Error> {
        self.get(key)?.ok_or_else(|| Error::missing(key, expected(key)))
    }

    /// Two numbers.
    fn range(&self, key: &str) -> Result<Option<(f64, f64)>, Error> {
        match self.get::<Vec<f64>>(key)?.as_deref() {
            None => Ok(None),
            Some(&[from, to]) => Ok(Some((from, to))),
            Some(other) => {
                Err(Error::invalid(key, format!("{other:?}"), format!("{} are expected", expected(key))))
            }
        }
    }

    fn units(&self) -> Result<Units, Error> {
        let length = match self.get("length")?.unwrap_or_default() {
            Length::Mm => LengthUnit::Mm,
            Length::Inch => LengthUnit::Inch,
        };
        let force = match self.get("force")?.unwrap_or_default() {
            Force::N => ForceUnit::Newton,
            Force::Lbf => ForceUnit::PoundForce,
        };
        Ok(Units { length, force })
    }
}

/// What a key may be.
fn expected(key: &str) -> &'static str {
    KEYS.iter().find(|(name, _)| *name == key).map_or("", |(_, expected)| expected)
}

/// A value as it is written in JavaScript, or its type where that cannot be written.
fn shown(value: &JsValue) -> String {
    let plain = !(value.is_undefined() || value.is_function() || value.is_symbol());
    let text = plain.then(|| JSON::stringify(value).ok()).flatten();
    text.map_or_else(|| value.js_typeof().as_string().unwrap_or_default(), String::from)
}
