//! The only file that knows JavaScript: JSON text in, small objects and `Float64Array` columns out.
//!
//! Errors cross as `Error` objects with `code`, `message` and, where they apply, `field`, `line`, `column`.

#[cfg(feature = "full")]
mod full;
#[cfg(feature = "full")]
pub use full::{
    default_job, fields, formats, identify_response, identify_stiffness, presets, thesis_recomputed,
};

use crate::chart::{self, ChartOptions as Options, ForceUnit, Units};
use crate::column::Column;
use crate::error::Error;
use crate::path::unit::LengthUnit;
use crate::report::{Report, scene};
use crate::robot::Joints;
use crate::{Job, Stage};
use js_sys::{Array, Float64Array, Function, Object, Reflect};
use serde::Serialize;
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsCast, JsValue};

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
export interface ArmillError extends Error { code: string; field?: string; line?: number; column?: number; }
export interface Statistics { mean: number; max: number; }
export interface Promised { max_mm: number; met: boolean; sentence: string; }
export interface Warning { code: string; message: string; from_sample?: number; to_sample?: number; from_s?: number; to_s?: number; }
export interface Parts { joints: number[]; tool: number; shaping: number; total: number; }
export interface Budget { sample: number; time_s: number; worst_mm: Parts; mean_mm: Parts; sentence: string; }
export interface Understood {
  language: "gcode" | "apt" | "csv"; unit: string; lines: number; cutting_moves: number; rapid_moves: number; multi_axis: boolean;
  lowest_mm: [number, number, number]; highest_mm: [number, number, number]; feeds_mm_s?: [number, number]; ignored: { word: string; lines: number[] }[];
}
export interface Effort { joint_travel_deg: number; joint_speed_deg_s: number; error_mm: number; }
export interface SpinGain { used_deg: [number, number]; fixed_deg: number; free: Effort; fixed?: Effort; sentence: string; }
export interface Summary {
  fingerprint: string; samples: number; duration_s: number; path_length_mm: number; mean_force_n: [number, number, number];
  material: string; material_note: string; cut: Record<string, number>; walls: Record<string, number>[];
  before_mm: { deflection: Statistics; shaping: Statistics; both: Statistics }; after_mm: Statistics; budget: Budget;
  before_axis_deg: Statistics; after_axis_deg: Statistics; program?: Understood; spin?: SpinGain;
  passes: number; converged: boolean; tolerance_mm: number; history_max_mm: number[]; history_mean_mm: number[];
  verdict: string; robot: string; inverse: "closed form" | "numerically"; stiffness: string; branch: string; warnings: Warning[];
}
export interface Field {
  path: string; group: string; label: string; unit: string; kind: "number" | "integer" | "choice" | "vector" | "table" | "text" | "set";
  choices?: { value: string; label: string; heading?: string }[]; min?: number; max?: number; default: unknown; defaults?: Record<string, unknown>; help: string; when?: { path: string; is: string[] };
}
export interface Presets {
  robots: { id: string; name: string; maker: string; note: string; stiffness_note: string; stiffness_assumed: boolean; joint_3: "serial" | "pendant";
            modified_dh: { alpha_deg: number; a_mm: number; d_mm: number; theta_offset_deg: number; joint_sign: number }[];
            opw: { a1_mm: number; a2_mm: number; b_mm: number; c1_mm: number; c2_mm: number; c3_mm: number; c4_mm: number; joint_sign: number[]; joint_offset_deg: number[] };
            joint_limits_deg: [number, number][] | null; joint_compliance_rad_per_nm: number[] }[];
  materials: { id: string; name: string; note: string; ktc_n_mm2?: number; krc_n_mm2?: number; kac_n_mm2?: number; kte_n_mm?: number; kre_n_mm?: number;
               kae_n_mm?: number; kc11_n_mm2?: number; mc?: number; orthogonal?: boolean }[];
}
export interface ChartEntry { name: string; title: string; view: string; figure: string; kind: "time" | "curve" | "space"; }
export interface ChartUnits { length?: "mm" | "inch"; force?: "N" | "lbf"; }
export interface ChartOptions extends ChartUnits { width: number; height: number; x_range?: [number, number]; y_range?: [number, number]; hidden?: string[]; }
export interface ChartColumn { key: string; label: string; unit: string; values: Float64Array; }
export interface Axis { label: string; unit: string; min: number; max: number; log: boolean; full: [number, number]; }
export interface Chart {
  name: string; title: string; description: string; svg: string; width: number; height: number;
  plot: { left: number; top: number; width: number; height: number }; x: Axis; y: Axis; series: { key: string; label: string; class: string }[];
  camera?: [[number, number, number], [number, number, number]];
}
export interface Format { id: string; name: string; extension: string; note: string; }
export interface Identification { sentence: string; [key: string]: unknown; }
export interface ThesisRow { quantity: string; source: string; printed: string; ours: string; agrees: boolean; reason: string; }
"#;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = console, js_name = error)]
    fn console_error(text: &str);
}

/// Panics say what happened before the instance traps.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|info| console_error(&format!("armill: internal error: {info}"))));
}

/// Version of the core.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

/// Checks a job without computing it; throws what is wrong.
#[wasm_bindgen]
pub fn check(json: &str) -> Result<(), JsValue> {
    Job::from_json(json).and_then(|job| job.setup()).map(|_| ()).map_err(|error| thrown(&error))
}

/// Where a job's arm stands with all joint values zero: base, six joints and TCP in the base frame, each as origin [mm] and x, y, z axes (12
/// numbers). Throws what is wrong with the robot.
#[wasm_bindgen]
pub fn arm(json: &str) -> Result<Float64Array, JsValue> {
    let robot = Job::from_json(json).and_then(|job| job.robot()).map_err(|error| thrown(&error))?;
    Ok(Float64Array::from(scene::arm(&robot, &Joints::zeros()).as_slice()))
}

/// The x, y, z [mm] of the workpiece frame that bring the path in front of the robot. Throws if no place there holds it.
#[wasm_bindgen]
pub fn place_in_front(json: &str) -> Result<Float64Array, JsValue> {
    let place = Job::from_json(json).and_then(|job| job.place_in_front()).map_err(|error| thrown(&error))?;
    Ok(Float64Array::from(place.as_slice()))
}

/// Computes a job; `on_progress(fraction, stage)` is called in between. Throws what is wrong.
#[wasm_bindgen]
pub fn run(
    json: &str,
    #[wasm_bindgen(unchecked_optional_param_type = "(fraction: number, stage: string) => void")] on_progress: Option<Function>,
) -> Result<Run, JsValue> {
    let tell = |stage: Stage| {
        if let Some(callback) = &on_progress {
            // What the listener throws is its own affair.
            let _ = callback.call2(&JsValue::NULL, &stage.fraction.into(), &stage.name.into());
        }
    };
    crate::run_json(json, tell).map(|report| Run { report }).map_err(|error| thrown(&error))
}

/// Panics on purpose, so that the page's recovery can be tried.
#[wasm_bindgen]
pub fn trap() {
    #[allow(clippy::panic, reason = "a panic is what is asked for")]
    {
        panic!("asked for");
    }
}

/// A computed job.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Run {
    report: Report,
}

#[wasm_bindgen]
impl Run {
    /// The figures a person reads first.
    #[wasm_bindgen(unchecked_return_type = "Summary")]
    pub fn summary(&self) -> Result<JsValue, JsValue> {
        object(&self.report.summary())
    }

    /// Key, label and unit of every column.
    #[wasm_bindgen(unchecked_return_type = "{ key: string; label: string; unit: string }[]")]
    pub fn columns(&self) -> Result<JsValue, JsValue> {
        #[derive(Serialize)]
        struct Head {
            key: String,
            label: String,
            unit: &'static str,
        }
        let heads: Vec<_> = self
            .report
            .series()
            .into_iter()
            .map(|series| Head { key: series.key, label: series.label, unit: series.unit })
            .collect();
        object(&heads)
    }

    /// One column, one value a sample.
    pub fn column(&self, key: &str) -> Result<Float64Array, JsValue> {
        match self.report.series().into_iter().find(|series| series.key == key) {
            Some(series) => Ok(Float64Array::from(series.column().values.as_slice())),
            None => Err(thrown(&Error::Invalid {
                field: "column".into(),
                value: format!("\"{key}\""),
                expected: "columns() lists the keys".into(),
            })),
        }
    }

    /// Where the arm stands at a sample: base, six joints, TCP and workpiece in the base frame, each as origin [mm] and x, y, z axes (12 numbers).
    pub fn frames(&self, sample: usize) -> Float64Array {
        Float64Array::from(self.report.frames(sample).as_slice())
    }

    /// The paths for a picture in space, in at most about `most` rows of 17 numbers: sample, whether it cuts, then x, y, z [mm] of desired point, closest
    /// point of the desired path, ways from there to the actual tip before and after compensation, correction to command.
    pub fn track(&self, most: usize) -> Float64Array {
        Float64Array::from(self.report.track(most).as_slice())
    }

    /// Every chart that has something to show.
    #[wasm_bindgen(unchecked_return_type = "ChartEntry[]")]
    pub fn charts(&self) -> Result<JsValue, JsValue> {
        object(&chart::charts_of(&self.report))
    }

    /// One chart, drawn in the size asked for.
    #[wasm_bindgen(unchecked_return_type = "Chart")]
    pub fn chart(
        &self,
        name: &str,
        #[wasm_bindgen(unchecked_param_type = "ChartOptions")] options: JsValue,
    ) -> Result<JsValue, JsValue> {
        let options = chart_options(&options)?;
        object(&chart::chart(&self.report, name, &options).map_err(|error| thrown(&error))?)
    }

    /// The values that a chart shows, every sample of them: what stands along its first axis (in space: the time), then each series.
    #[wasm_bindgen(unchecked_return_type = "ChartColumn[]")]
    pub fn chart_data(
        &self,
        name: &str,
        #[wasm_bindgen(unchecked_param_type = "ChartUnits")] options: JsValue,
    ) -> Result<Array, JsValue> {
        let columns = chart::data(&self.report, name, units(&options)?).map_err(|error| thrown(&error))?;
        Ok(columns_of(columns))
    }

    /// Hash over the bits of all columns.
    pub fn fingerprint(&self) -> String {
        self.report.fingerprint()
    }
}

/// How a chart is to be drawn.
fn chart_options(options: &JsValue) -> Result<Options, JsValue> {
    let number = |value: JsValue| value.as_f64().unwrap_or(f64::NAN);
    let range = |key: &str| {
        let pair = get(options, key);
        pair.is_object().then(|| (number(get(&pair, "0")), number(get(&pair, "1"))))
    };
    let hidden = get(options, "hidden");
    let keys = if hidden.is_object() { Array::from(&hidden) } else { Array::new() };
    Ok(Options {
        width: number(get(options, "width")),
        height: number(get(options, "height")),
        x_range: range("x_range"),
        y_range: range("y_range"),
        hidden: keys.iter().filter_map(|key| key.as_string()).collect(),
        units: units(options)?,
    })
}

/// Columns as objects with a `Float64Array` each.
fn columns_of(columns: Vec<Column>) -> Array {
    let plain = |column: Column| {
        let object = Object::new();
        let values: JsValue = Float64Array::from(column.values.as_slice()).into();
        for (key, value) in [
            ("key", column.key.into()),
            ("label", column.label.into()),
            ("unit", column.unit.into()),
            ("values", values),
        ] {
            // Setting a property of a fresh object cannot fail.
            let _ = Reflect::set(&object, &key.into(), &value);
        }
        object
    };
    columns.into_iter().map(plain).collect()
}

/// A property; undefined where there is none.
fn get(object: &JsValue, key: &str) -> JsValue {
    Reflect::get(object, &key.into()).unwrap_or(JsValue::UNDEFINED)
}

/// The units asked for; mm and N where none are.
fn units(options: &JsValue) -> Result<Units, JsValue> {
    let inch = second(options, "length", [LengthUnit::Mm.name(), LengthUnit::Inch.name()])?;
    let pound = second(options, "force", [ForceUnit::Newton.name(), ForceUnit::PoundForce.name()])?;
    Ok(Units {
        length: if inch { LengthUnit::Inch } else { LengthUnit::Mm },
        force: if pound { ForceUnit::PoundForce } else { ForceUnit::Newton },
    })
}

/// Whether the second of two choices is made; the first holds where none is.
fn second(options: &JsValue, key: &str, choices: [&str; 2]) -> Result<bool, JsValue> {
    let value = get(options, key);
    let text = value.as_string().unwrap_or_default();
    if value.is_undefined() || choices.contains(&text.as_str()) {
        return Ok(text == choices[1]);
    }
    let expected = format!("legal are {} and {}", choices[0], choices[1]);
    Err(thrown(&Error::Invalid { field: key.into(), value: format!("\"{text}\""), expected }))
}

/// Plain data as a JavaScript object; maps become objects, not `Map`s.
fn object<T: Serialize>(value: &T) -> Result<JsValue, JsValue> {
    // As text: one serializer does for jobs, errors and results, and the browser's own parser is the fastest way to objects.
    let text = serde_json::to_string(value).map_err(|error| JsValue::from(error.to_string()))?;
    js_sys::JSON::parse(&text)
}

fn thrown(error: &Error) -> JsValue {
    let thrown: JsValue = js_sys::Error::new(&error.to_string()).into();
    let set = |key: &str, value: JsValue| {
        // Setting a property of a fresh Error cannot fail.
        let _ = Reflect::set(thrown.unchecked_ref(), &key.into(), &value);
    };
    set("code", error.code().into());
    if let Some(field) = error.field() {
        set("field", field.into());
    }
    if let Some((line, column)) = error.place() {
        set("line", (line as f64).into());
        set("column", (column as f64).into());
    }
    thrown
}
