//! Job input: its check, its fields, the libraries.

use crate::export::FORMATS;
use crate::job::fields as table;
use crate::job::presets as libraries;
use crate::report::scene;
use crate::robot::Joints;
use crate::setup::{self, Setup};
use crate::wasm::error::thrown;
use crate::wasm::object;
use crate::{Job, Progress, placement};
use js_sys::Float64Array;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
export interface Field {
  path: string; group: string; label: string; unit: string;
  kind: "number" | "integer" | "choice" | "vector" | "table" | "text" | "set";
  choices?: { value: string; label: string; heading?: string }[];
  min?: number; max?: number; usual?: [number, number]; default: FieldValue; defaults?: Record<string, FieldValue>;
  help: string; when?: { path: string; is: string[] };
}
export interface DhRow {
  alpha_deg: number; a_mm: number; d_mm: number; theta_offset_deg: number; joint_sign: number;
}
export interface Opw {
  a1_mm: number; a2_mm: number; b_mm: number; c1_mm: number; c2_mm: number; c3_mm: number; c4_mm: number;
  joint_sign: number[]; joint_offset_deg: number[];
}
export type FieldValue = number | string | number[] | number[][] | string[] | DhRow[] | Opw | null;
export interface RobotPreset {
  id: string; name: string; maker: string; note: string; stiffness_note: string; stiffness_assumed: boolean;
  payload_kg: number; reach_mm: number; stiffness: "measured" | "published" | "guessed";
  world_mm: number | null; world_note: string;
  joint_3: "serial" | "pendant"; modified_dh: DhRow[]; opw: Opw;
  joint_limits_deg: [number, number][] | null; joint_compliance_rad_per_nm: number[];
}
export interface MaterialPreset {
  id: string; name: string; note: string; spread_percent: number; confidence: string;
  ktc_n_mm2?: number; krc_n_mm2?: number; kac_n_mm2?: number;
  kte_n_mm?: number; kre_n_mm?: number; kae_n_mm?: number; kc11_n_mm2?: number; mc?: number; orthogonal?: boolean;
}
export interface Presets { robots: RobotPreset[]; materials: MaterialPreset[]; }
export interface Stock {
  kind: "none" | "box" | "cylinder" | "extents" | "outline" | "stl";
  from_mm?: [number, number, number]; to_mm?: [number, number, number];
  center_mm?: [number, number, number]; radius_mm?: number; height_mm?: number; allowance_mm?: number;
  points_mm?: [number, number][]; bottom_mm?: number; top_mm?: number; stl?: string;
  earlier?: { text: string; diameter_mm: number; corner_radius_mm?: number }[];
}
export interface ProposedCutting { spindle_rpm: number; feed_per_tooth_mm: "from_feed"; }
export interface Format { id: string; name: string; extension: string; note: string; }
"#;

/// The default job (the thesis's case) as JSON text.
#[wasm_bindgen]
pub fn default_job() -> String {
    Job::default().to_json()
}

/// The job that the page opens with, a bracket on a KUKA KR 500-3 MT, as JSON text.
#[wasm_bindgen]
pub fn opening_job() -> Result<String, JsValue> {
    Job::opening().map(|job| job.to_json()).map_err(|error| thrown(&error))
}

/// Checks a job without computing it; throws an error if it is invalid.
#[wasm_bindgen]
pub fn check(json: &str) -> Result<(), JsValue> {
    let setup = Job::from_json(json).and_then(|job| Setup::of(&job, &mut Progress::none()));
    setup.map(|_| ()).map_err(|error| thrown(&error))
}

/// Every input of a job, for building a form.
#[wasm_bindgen(unchecked_return_type = "Field[]")]
pub fn fields() -> Result<JsValue, JsValue> {
    object(&table::fields())
}

/// Robots and materials of the library, with the source of their numbers.
#[wasm_bindgen(unchecked_return_type = "Presets")]
pub fn presets() -> Result<JsValue, JsValue> {
    object(&libraries::presets())
}

/// Every export format.
#[wasm_bindgen(unchecked_return_type = "Format[]")]
pub fn formats() -> Result<JsValue, JsValue> {
    object(&FORMATS.to_vec())
}

/// Frames of a job's arm with all joint values zero: base, six joints and TCP in the base frame,
/// each as origin [mm] and x, y, z axes (12 numbers). Throws an error if the robot is invalid.
#[wasm_bindgen]
pub fn arm(json: &str) -> Result<Float64Array, JsValue> {
    let robot = Job::from_json(json).and_then(|job| setup::robot(&job)).map_err(|error| thrown(&error))?;
    Ok(Float64Array::from(scene::arm(&robot, &Joints::zeros()).as_slice()))
}

/// The x, y, z [mm] of the workpiece frame that bring the path in front of the robot. Throws an
/// error if it fits no place there.
#[wasm_bindgen]
pub fn place_in_front(json: &str) -> Result<Float64Array, JsValue> {
    let place = Job::from_json(json).and_then(|job| placement::in_front(&job));
    Ok(Float64Array::from(place.map_err(|error| thrown(&error))?.as_slice()))
}

/// The stock that a job may give its program if it knows none: the program's extents. Undefined where
/// a stock cannot be followed. Throws an error if the path cannot be read.
#[wasm_bindgen(unchecked_return_type = "Stock | undefined")]
pub fn proposed_stock(json: &str) -> Result<JsValue, JsValue> {
    let stock = Job::from_json(json).and_then(|job| setup::proposed_stock(&job));
    stock.map_err(|error| thrown(&error))?.map_or(Ok(JsValue::UNDEFINED), |stock| object(&stock))
}

/// The cut that a job's program states, as keys of the job's `cutting`. Undefined if it states no
/// spindle speed. Throws an error if the path cannot be read.
#[wasm_bindgen(unchecked_return_type = "ProposedCutting | undefined")]
pub fn proposed_cutting(json: &str) -> Result<JsValue, JsValue> {
    let cutting = Job::from_json(json).and_then(|job| setup::proposed_cutting(&job));
    cutting.map_err(|error| thrown(&error))?.map_or(Ok(JsValue::UNDEFINED), |cutting| object(&cutting))
}
