//! The simulated part: an STL mesh, and maps of heights for a picture.

use crate::error::Error;
use crate::report::PartKind;
use crate::surface::deviation_map::DeviationMap;
use crate::surface::mesh::PartMesh;
use crate::surface::part::PartMap;
use crate::units::MM;
use crate::wasm::error::thrown;
use crate::wasm::{Run, object};
use js_sys::{Float32Array, Uint32Array};
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
/** A mesh of the nominal part without its bottom: x, y, z of its places, `triangles` of three places each.
 * `before_mm` and `after_mm` have four numbers for each place: how far it is moved along x, y and z, and the excess
 * of the wall there, or of the nearest one. `largest_mm` is the largest excess of the surface left. */
export interface PartMesh {
  places_mm: Float32Array; before_mm: Float32Array; after_mm: Float32Array; triangles: Uint32Array; largest_mm: number;
}
/** Pairs of numbers: distance to the left of the tip across the feed, and height in the workpiece frame.
 * `before_mm` and `after_mm` say how far each pair of `nominal_mm` is moved. */
export interface PartSection {
  nominal_mm: Float32Array; before_mm: Float32Array; after_mm: Float32Array; tool_mm: Float32Array; bottom_mm: number;
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

/// A mesh whose numbers cross as arrays.
#[derive(Serialize)]
struct MeshArrays {
    #[serde(with = "serde_wasm_bindgen::preserve")]
    places_mm: Float32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    before_mm: Float32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    after_mm: Float32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    triangles: Uint32Array,
    largest_mm: f64,
}

/// A section whose numbers cross as arrays.
#[derive(Serialize)]
struct SectionArrays {
    #[serde(with = "serde_wasm_bindgen::preserve")]
    nominal_mm: Float32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    before_mm: Float32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    after_mm: Float32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    tool_mm: Float32Array,
    bottom_mm: f64,
}

/// Most heights of the map behind meshes and sections: as many as stay smooth on a phone.
const MOST_HEIGHTS: usize = 30_000;

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

    /// The nominal part as a mesh in the workpiece frame, with its deviation before and after compensation to be
    /// magnified. Throws an error if the job has no stock that is followed.
    #[wasm_bindgen(unchecked_return_type = "PartMesh")]
    pub fn part_mesh(&self) -> Result<JsValue, JsValue> {
        let map = self.deviation_map().map_err(|error| thrown(&error))?;
        let mesh = PartMesh::of(map);
        object(&MeshArrays {
            places_mm: array(mesh.places.iter().flatten().copied()),
            before_mm: array(mesh.before.iter().flatten().copied()),
            after_mm: array(mesh.after.iter().flatten().copied()),
            triangles: Uint32Array::from(mesh.triangles.as_flattened()),
            largest_mm: map.largest / MM,
        })
    }

    /// A section through the finished part across the feed, where the tool is at a sample. Throws an error if
    /// the job has no stock that is followed.
    #[wasm_bindgen(unchecked_return_type = "PartSection")]
    pub fn part_section(&self, sample: usize) -> Result<JsValue, JsValue> {
        let map = self.deviation_map().map_err(|error| thrown(&error))?;
        let section = self.report.part_section(map, sample);
        let pairs = |pairs: &[[f64; 2]]| array(pairs.iter().flatten().map(|length| *length as f32));
        object(&SectionArrays {
            nominal_mm: pairs(&section.nominal),
            before_mm: pairs(&section.before),
            after_mm: pairs(&section.after),
            tool_mm: pairs(&section.tool),
            bottom_mm: section.bottom / MM,
        })
    }
}

impl Run {
    /// The map behind meshes and sections, made on first use.
    fn deviation_map(&self) -> Result<&DeviationMap, Error> {
        if let Some(map) = self.deviations.get() {
            return Ok(map);
        }
        let map = self.report.deviation_map(MOST_HEIGHTS)?;
        Ok(self.deviations.get_or_init(|| map))
    }

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
