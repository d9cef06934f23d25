//! The boundary to JavaScript, the only folder that knows it; its files mirror the core's modules.
//!
//! A job comes in as JSON text, so that every error keeps its line and column. Options come in and
//! results go out as small typed objects (serde-wasm-bindgen), columns as `Float64Array`, drawings
//! as strings. Errors cross as `Error` objects with `code`, `message` and, where they apply,
//! `field`, `line` and `column`.

mod error;
mod options;
mod job;
mod run;
mod chart;
mod evidence;
mod export;
mod identify;
mod learn;
mod placement;
mod part;
mod scene;
mod study;
mod answer;
mod thesis;

pub use answer::{StudyCurves, StudyGrid, StudyIntervals};
pub use evidence::{evidence_encoders, evidence_loads, evidence_slots};
pub use export::zip;
pub use identify::{Identified, identify_gear, identify_response, identify_stiffness};
pub use job::{
    arm, check, default_job, fields, formats, opening_job, place_in_front, presets, proposed_cutting,
    proposed_stock,
};
pub use learn::{LearnedPass, fit_cuts, learn_pass};
pub use placement::Survey;
pub use run::{Run, run};
pub use study::{Study, largest, tornado};
pub use thesis::thesis_recomputed;

use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = console, js_name = error)]
    fn console_error(text: &str);
}

/// Reports a panic on the console before the instance traps.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|info| console_error(&format!("armill: internal error: {info}"))));
}

/// Version of the core.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

/// Number of the model that figures are computed with.
#[wasm_bindgen]
pub fn model() -> u32 {
    crate::model::MODEL
}

/// Panics on purpose, so that the page's recovery can be tested.
#[wasm_bindgen]
pub fn trap() {
    #[allow(clippy::panic, reason = "the caller asks for a panic")]
    {
        panic!("asked for");
    }
}

/// Plain data as a JavaScript object; absent values are `null` unless their type omits them.
fn object<T: Serialize>(value: &T) -> Result<JsValue, JsValue> {
    Ok(value.serialize(&Serializer::json_compatible())?)
}
