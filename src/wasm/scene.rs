//! What a picture of the run in space is drawn from.

use crate::units::{DEG, MM};
use crate::wasm::{Run, object};
use js_sys::{Float32Array, Float64Array};
use serde::Serialize;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
/** The stock in the workpiece frame: pairs x, y around its outline, the heights of bottom and top, and of a mesh the
 * triangles whose upper side is its top, nine numbers each. */
export interface StockSolid {
  outline_mm: Float64Array; bottom_mm: number; top_mm: number; relief_mm: Float32Array;
}
"#;

/// A solid whose numbers cross as arrays.
#[derive(Serialize)]
struct StockSolid {
    #[serde(with = "serde_wasm_bindgen::preserve")]
    outline_mm: Float64Array,
    bottom_mm: f64,
    top_mm: f64,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    relief_mm: Float32Array,
}

/// Corners of the polygon that stands for a circle: it lies within 0.1 % of the radius.
const CIRCLE_CORNERS: usize = 72;

/// Most triangles of a mesh that a picture has to draw; a finer one is shown as its box.
const MOST_TRIANGLES: usize = 50_000;

#[wasm_bindgen]
impl Run {
    /// Frames at a sample: base, six joints, TCP and workpiece in the base frame, each as origin
    /// [mm] and x, y, z axes (12 numbers).
    pub fn frames(&self, sample: usize) -> Float64Array {
        Float64Array::from(self.report.frames(sample).as_slice())
    }

    /// How far the command to each of the six joints is beyond its range at a sample [deg], the desired
    /// or the compensated one, whichever is farther; negative within it. Empty if no ranges are known.
    pub fn joint_excess(&self, sample: usize) -> Float64Array {
        let excess = self.report.joint_excess(sample);
        Float64Array::from(excess.map_or(Vec::new(), |joints| joints.map(|q| q / DEG).to_vec()).as_slice())
    }

    /// The paths for a picture in space, in at most about `most` rows of 17 numbers: sample,
    /// whether it cuts, then x, y, z [mm] of the desired point, the closest point of the desired
    /// path, the vectors from the path to the actual tip before and after compensation, and the
    /// correction to command.
    pub fn track(&self, most: usize) -> Float64Array {
        Float64Array::from(self.report.track(most).as_slice())
    }

    /// The stock before the first cut, if the engagement follows from it. Of a mesh with more than 50,000
    /// triangles it has only the box.
    #[wasm_bindgen(unchecked_return_type = "StockSolid | undefined")]
    pub fn stock_solid(&self) -> Result<JsValue, JsValue> {
        let Some(blank) = &self.report.setup().blank else { return Ok(JsValue::UNDEFINED) };
        let solid = &blank.solid;
        let outline: Vec<f64> =
            solid.outline.corners(CIRCLE_CORNERS).iter().flat_map(|p| [p.x / MM, p.y / MM]).collect();
        let fine = solid.relief.len() > MOST_TRIANGLES;
        let corners = solid.relief.iter().filter(|_| !fine).flatten();
        let relief: Vec<f32> = corners.flat_map(|p| [p.x, p.y, p.z].map(|v| (v / MM) as f32)).collect();
        object(&StockSolid {
            outline_mm: Float64Array::from(outline.as_slice()),
            bottom_mm: solid.bottom / MM,
            top_mm: solid.top / MM,
            relief_mm: Float32Array::from(relief.as_slice()),
        })
    }
}
