//! What others measured, beside what the model says of it.

use crate::Job;
use crate::error::Error;
use crate::evidence::{self, Evidence};
use crate::wasm::Identified;
use crate::wasm::error::thrown;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
/** Measured values beside predicted ones; `heads` are the table's headings, the first one of the rows' names. */
export interface Evidence {
  key: string; title: string; sentence: string; rests_on: string; source: string;
  heads: string[]; rows: { name: string; values: number[] }[];
}
"#;

/// Displacements of a loaded arm, each predicted from the others; `job` has the arm.
#[wasm_bindgen]
pub fn evidence_loads(job: &str, text: &str) -> Result<Identified, JsValue> {
    found(Job::from_json(job).and_then(|job| evidence::loads(&job, text)))
}

/// Encoders behind a gear: the run `other` predicted from the run `fitted`.
#[wasm_bindgen]
pub fn evidence_encoders(fitted: &str, other: &str) -> Result<Identified, JsValue> {
    found(evidence::encoders(fitted, other))
}

/// Cutting forces in ten slots.
#[wasm_bindgen]
pub fn evidence_slots() -> Result<Identified, JsValue> {
    found(Ok(evidence::slots()))
}

fn found(evidence: Result<Evidence, Error>) -> Result<Identified, JsValue> {
    evidence.map(Identified::of_evidence).map_err(|error| thrown(&error))
}
