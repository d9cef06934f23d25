//! The thesis's printed figures beside ours.

use crate::report::thesis;
use crate::wasm::error::thrown;
use crate::wasm::object;
use crate::{Job, simulation};
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
export interface ThesisRow {
  quantity: string; source: string; printed: string; ours: string; agrees: boolean; reason: string;
}
"#;

/// The thesis's printed figures beside ours, for the default job.
#[wasm_bindgen(unchecked_return_type = "ThesisRow[]")]
pub fn thesis_recomputed() -> Result<JsValue, JsValue> {
    let report = crate::run(&Job::default(), &mut simulation::Progress::none());
    let rows = report.and_then(|report| thesis::rows(&report));
    object(&rows.map_err(|error| thrown(&error))?)
}
