//! Errors as JavaScript `Error` objects with data.

use crate::error::Error;
use js_sys::Object;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
export interface ArmillError extends Error {
  code: string; field?: string; line?: number; column?: number;
  value?: number; min?: number; max?: number; unit?: string; // of a number that has to be within min and max
}
"#;

/// The value to throw for an error: an `Error` with its code and, where they apply, field and place.
pub(super) fn thrown(error: &Error) -> JsValue {
    let object = js_sys::Error::new(&error.to_string());
    match super::object(error) {
        Ok(data) => Object::assign(&object, &data.into()).into(),
        Err(failure) => failure,
    }
}
