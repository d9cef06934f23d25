//! The simulated part: a mesh to take away, and maps of heights for a picture.

use crate::error::Error;
use crate::report::PartKind;
use crate::surface::part::PartMap;
use crate::units::MM;
use crate::wasm::error::thrown;
use crate::wasm::{Run, object};
use js_sys::Float32Array;
use serde::Serialize;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
/** Heights row by row from `origin_mm`, whose z is the bottom; `before_mm` and `after_mm` are those of the actual
 * part above the nominal one. */
export interface PartMap {
  width: number; height: number; cell_mm: number; origin_mm: [number, number, number];
  nominal_mm: Float32Array; before_mm: Float32Array; after_mm: Float32Array;
}
"#;

/// Maps of a part whose heights cross as arrays.
#[derive(Serialize)]
struct PartMaps {
    width: usize,
    height: usize,
    cell_mm: f64,
    origin_mm: [f64; 3],
    #[serde(with = "serde_wasm_bindgen::preserve")]
    nominal_mm: Float32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    before_mm: Float32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    after_mm: Float32Array,
}

#[wasm_bindgen]
impl Run {
    /// The simulated part as a binary STL file in millimetres, in the workpiece frame: `before` or `after`
    /// compensation, or `nominal`. Its heights are `cell_mm` apart; if not given, so far that the file stays
    /// below about 30 MB. Throws an error if the job has no stock that is followed.
    pub fn simulated_part(&self, part: &str, cell_mm: Option<f64>) -> Result<Vec<u8>, JsValue> {
        let stl = PartKind::named(part)
            .and_then(|kind| self.report.simulated_part(kind, cell_mm.map(|cell| cell * MM)));
        stl.map_err(|error| thrown(&error))
    }

    /// Heights of the nominal part in the workpiece frame, and how much higher or lower the actual one is
    /// before and after compensation. Where a wall stands elsewhere, that is its whole height.
    #[wasm_bindgen(unchecked_return_type = "PartMap")]
    pub fn part_map(&self, cell_mm: Option<f64>) -> Result<JsValue, JsValue> {
        object(&self.maps(cell_mm.map(|cell| cell * MM)).map_err(|error| thrown(&error))?)
    }
}

impl Run {
    fn maps(&self, cell: Option<f64>) -> Result<PartMaps, Error> {
        let nominal = self.report.part(PartKind::Nominal, cell)?;
        let above = |kind| {
            let map: PartMap = self.report.part(kind, cell)?;
            let pairs = map.heights.iter().zip(&nominal.heights);
            Ok(array(pairs.map(|(actual, nominal)| actual - nominal)))
        };
        Ok(PartMaps {
            width: nominal.columns,
            height: nominal.rows(),
            cell_mm: nominal.cell / MM,
            origin_mm: (nominal.origin / MM).into(),
            before_mm: above(PartKind::Before)?,
            after_mm: above(PartKind::After)?,
            nominal_mm: array(nominal.heights.iter().copied()),
        })
    }
}

/// Lengths [m] as an array in mm.
fn array(lengths: impl Iterator<Item = f32>) -> Float32Array {
    Float32Array::from(lengths.map(|length| length / MM as f32).collect::<Vec<f32>>().as_slice())
}
