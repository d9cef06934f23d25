//! Charts of a run: their list, drawings, and the values drawn.

use crate::chart;
use crate::column::Column;
use crate::wasm::error::thrown;
use crate::wasm::{Run, object, options};
use js_sys::Float64Array;
use serde::Serialize;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
export interface ChartEntry {
  name: string; title: string; view: string; figure: string; kind: "time" | "curve" | "space"; over: Over[];
}
export interface ChartColumn { key: string; label: string; unit: string; values: Float64Array; }
export interface Axis {
  label: string; unit: string; min: number; max: number; log: boolean; floor?: number; full: [number, number];
}
export interface Chart {
  name: string; title: string; description: string; svg: string; width: number; height: number;
  plot: { left: number; top: number; width: number; height: number }; x: Axis; y: Axis;
  series: { key: string; label: string; class: string }[];
  camera?: [[number, number, number], [number, number, number]];
}
"#;

/// A column whose values cross as one array.
#[derive(Serialize)]
struct ChartColumn {
    key: String,
    label: String,
    unit: &'static str,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    values: Float64Array,
}

/// Columns as objects with a `Float64Array` each.
pub(super) fn columns(columns: Vec<Column>) -> Result<JsValue, JsValue> {
    let columns = columns.into_iter().map(|Column { key, label, unit, values }| ChartColumn {
        key,
        label,
        unit,
        values: Float64Array::from(values.as_slice()),
    });
    object(&columns.collect::<Vec<_>>())
}

#[wasm_bindgen]
impl Run {
    /// Every chart that has something to show.
    #[wasm_bindgen(unchecked_return_type = "ChartEntry[]")]
    pub fn charts(&self) -> Result<JsValue, JsValue> {
        object(&chart::charts_of(&self.report))
    }

    /// One chart, drawn at the requested size.
    #[wasm_bindgen(unchecked_return_type = "Chart")]
    pub fn chart(
        &self,
        name: &str,
        #[wasm_bindgen(unchecked_param_type = "ChartOptions")] options: JsValue,
    ) -> Result<JsValue, JsValue> {
        let options = options::chart(options)?;
        object(&chart::chart(&self.report, name, &options).map_err(|error| thrown(&error))?)
    }

    /// All values that a chart shows: those along its first axis (in space, the time), then each
    /// series.
    #[wasm_bindgen(unchecked_return_type = "ChartColumn[]")]
    pub fn chart_data(
        &self,
        name: &str,
        #[wasm_bindgen(unchecked_param_type = "ChartValues")] values: JsValue,
    ) -> Result<JsValue, JsValue> {
        let (units, over) = options::values(values)?;
        columns(chart::data(&self.report, name, units, over).map_err(|error| thrown(&error))?)
    }
}
