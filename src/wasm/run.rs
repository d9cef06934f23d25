//! A run: a computed job, its figures and columns.

use crate::error::Error;
use crate::report::Report;
use crate::simulation::{Progress, Stage};
use crate::surface::deviation_map::DeviationMap;
use crate::verification::Programs;
use crate::wasm::error::thrown;
use crate::wasm::object;
use js_sys::{Float64Array, Function};
use serde::Serialize;
use std::cell::OnceCell;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
export interface Statistics { mean: number; max: number; }
/** `patch` is a JSON merge patch (RFC 7386) of the job. */
export interface Remedy { label: string; patch: { [key: string]: unknown }; }
export interface Warning {
  code: string; severity: "cannot-run" | "matters" | "note"; message: string;
  from_sample?: number; to_sample?: number; from_s?: number; to_s?: number;
  spans_samples?: [number, number][]; spans_s?: [number, number][];
  remedy?: Remedy;
}
export interface Parts { joints: number[]; tool: number; shaping: number; total: number; }
export interface Budget { sample: number; time_s: number; worst_mm: Parts; mean_mm: Parts; sentence: string; }
export interface Understood {
  language: "gcode" | "apt" | "csv"; unit: string; lines: number;
  dialect?: "fanuc" | "linuxcnc" | "grbl" | "siemens" | "mach" | "unknown"; cutting_moves: number; rapid_moves: number;
  multi_axis: boolean;
  lowest_mm: [number, number, number]; highest_mm: [number, number, number]; feeds_mm_s?: [number, number];
  spindle_rpm?: [number, number];
  ignored: { word: string; lines: number[] }[];
}
export interface Effort { joint_travel_deg: number; joint_speed_deg_s: number; error_mm: number; }
export interface SpinGain {
  used_deg: [number, number]; fixed_deg: number; free: Effort; fixed?: Effort; sentence: string;
}
export interface CutFigures {
  ktc_n_mm2: number; krc_n_mm2: number; kac_n_mm2: number;
  kte_n_mm: number; kre_n_mm: number; kae_n_mm: number;
  diameter_mm: number; corner_radius_mm: number; axial_depth_mm: number;
  feed_per_tooth_mm: number; mean_chip_mm: number; largest_chip_mm: number; section_mm2: number; removal_cm3_min: number;
  peak_force_n: number; torque_nm: number; tooth_passing_hz: number; power_kw: number;
  entry_deg: number; exit_deg: number; radial_depth_mm: number;
  stock?: string; removed_cm3?: number; air_share?: number; largest_engaged_deg?: number; stock_cell_mm?: number;
  spindle_power_kw?: number; spindle_torque_nm?: number; tool_bending_um_n?: number;
  made_at_chip_mm?: number; spread_percent?: number; kc11_n_mm2?: number; mc?: number;
}
export interface WallFigures {
  side: number; mean_force_n: number; instant_force_n: number; instant_force_max_n: number;
  by_mean_force_mm: number; by_mean_force_max_mm: number; at_instant_mm: number; at_instant_max_mm: number;
}
export interface FeedOutcome {
  largest_force_n: number; mean_force_n: number; peak_force_n: number;
  largest_error_mm: number; mean_error_mm: number; time_s: number;
}
export interface FeedRuleGain {
  force_n: number; least_percent: number; most_percent: number; share_at_least: number; share_at_most: number;
  programmed: FeedOutcome; constant_force: FeedOutcome; sentence: string;
}
export interface SurfaceSpot {
  kind: "wall" | "floor" | "corner"; sample: number; line?: number; at_arc_length_mm: number;
  place_mm: [number, number, number]; height_mm: number; before_mm: number; after_mm: number; sentence: string;
}
export interface SurfaceFigures {
  worst_before_mm?: number; worst_after_mm?: number; before_p95_mm?: number; after_p95_mm?: number; worst: SurfaceSpot[];
}
export interface WorstPlace { max: number; at_arc_length_mm: number }
export interface Summary {
  fingerprint: string; model: number; samples: number; duration_s: number; path_length_mm: number;
  stops: { count: number; corners_s: number }; controller: Controller;
  mean_force_n: [number, number, number];
  material: string; material_note: string; cut: CutFigures; walls: WallFigures[];
  before_mm: { deflection: Statistics; shaping: Statistics; both: Statistics };
  after_mm: Statistics; missed_mm: WorstPlace; wall_mm: WorstPlace; surface?: SurfaceFigures; budget: Budget;
  before_axis_deg: Statistics; after_axis_deg: Statistics;
  program?: Understood; spin?: SpinGain; feed_rule?: FeedRuleGain;
  passes: number; converged: boolean; tolerance_mm: number;
  history_max_mm: number[]; history_mean_mm: number[]; verdict: string;
  verdict_state: "cannot-run" | "met" | "met-if-nominal" | "not-met";
  expected_mm: { p50: number; p95: number; p95_interval: [number, number] };
  how_sure: {
    sentence: string; stiffness: string; cutting: string; frequency: string; draws: number;
    shares: { input: string; percent: number }[];
    measure_first?: { input: string; percent: number; p95_mm: number; sentence: string };
    measures: { input: string; percent: number; p95_mm: number; sentence: string }[];
    without_compensation_mm: { p50: number; p95: number; p95_interval: [number, number] };
    wall_mm: { p50: number; p95: number; p95_interval: [number, number] };
    break_even_percent?: number; break_even: string; worse_percent: number; left_out: string;
  };
  robot: string; inverse: "closed form" | "numerically"; stiffness: string; branch: string;
  warnings: Warning[];
}
"#;

/// Computes a job; `on_progress(fraction, stage)` is called at intervals. Throws an error if the
/// job is invalid or cannot be computed.
#[wasm_bindgen]
pub fn run(
    json: &str,
    #[wasm_bindgen(unchecked_optional_param_type = "(fraction: number, stage: string) => void")]
    on_progress: Option<Function>,
) -> Result<Run, JsValue> {
    let mut listener = |stage: Stage| {
        if let Some(callback) = &on_progress {
            // An error that the listener throws does not stop the run.
            let _ = callback.call2(&JsValue::NULL, &stage.fraction.into(), &stage.name.into());
        }
    };
    let report = crate::run_json(json, &mut Progress::new(&mut listener));
    let run = |report| Run { report, programs: Programs::default(), deviations: OnceCell::new() };
    report.map(run).map_err(|error| thrown(&error))
}

/// A computed job.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Run {
    pub(super) report: Report,
    /// Its path as programs, each rehearsed once.
    pub(super) programs: Programs,
    /// What meshes and sections of the part are made from.
    pub(super) deviations: OnceCell<DeviationMap>,
}

/// Key, label and unit of a column.
#[derive(Serialize)]
struct Head {
    key: String,
    label: String,
    unit: &'static str,
}

#[wasm_bindgen]
impl Run {
    /// The headline figures.
    #[wasm_bindgen(unchecked_return_type = "Summary")]
    pub fn summary(&self) -> Result<JsValue, JsValue> {
        object(&self.report.summary())
    }

    /// Key, label and unit of every column.
    #[wasm_bindgen(unchecked_return_type = "{ key: string; label: string; unit: string }[]")]
    pub fn columns(&self) -> Result<JsValue, JsValue> {
        let series = self.report.series().into_iter();
        let heads = series.map(|series| Head { key: series.key, label: series.label, unit: series.unit });
        object(&heads.collect::<Vec<_>>())
    }

    /// One column, one value per sample.
    pub fn column(&self, key: &str) -> Result<Float64Array, JsValue> {
        let series = self.report.series().into_iter().find(|series| series.key == key);
        let series = series.ok_or_else(|| {
            thrown(&Error::invalid("column", format!("\"{key}\""), "columns() lists the keys"))
        })?;
        Ok(Float64Array::from(series.column().values.as_slice()))
    }

    /// Hash over the bits of all columns.
    pub fn fingerprint(&self) -> String {
        self.report.fingerprint()
    }
}
