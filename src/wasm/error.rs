//! Errors as JavaScript `Error` objects with data.

use crate::error::Error;
use js_sys::Object;
use serde::Serialize;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
export interface ArmillError extends Error { code: string; field?: string; line?: number; column?: number; }
"#;

/// Data of an `Error` object besides its message.
#[derive(Serialize)]
struct Data<'a> {
    code: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    field: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    column: Option<usize>,
}

/// The value to throw for an error.
pub(super) fn thrown(error: &Error) -> JsValue {
    let (line, column) = error.place().unzip();
    let data = Data { code: error.code(), field: error.field(), line, column };
    let object = js_sys::Error::new(&error.to_string());
    match super::object(&data) {
        Ok(data) => Object::assign(&object, &data.into()).into(),
        Err(failure) => failure,
    }
}
