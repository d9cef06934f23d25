//! Stiffness and vibration of a robot from measurements.

use crate::Job;
use crate::chart::identified;
use crate::error::Error;
use crate::identify::{Convention, Fit, Mode, measurement, response, stiffness, summary};
use crate::setup;
use crate::wasm::error::thrown;
use crate::wasm::{chart, object, options};
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
export interface JointSummary {
  joint: number; compliance_rad_per_nm: number; interval_rad_per_nm: [number | null, number | null];
  stiffness_nm_per_rad: number | null; variance_inflation: number | null; direction_shares: number[];
  mixed_with: number[]; load_factor: number | null; verdict: string; sentence: string;
}
export interface StiffnessSummary {
  robot: string; source: string; rows: number; degrees_of_freedom: number;
  joint_compliance_rad_per_nm: number[]; compliance_covariance: number[][] | null;
  explained: number; residual_rms_mm: number; standard_deviation_mm: number; mean_relative_residual: number;
  mean_relative_left_out: number; condition: number | null; joints: JointSummary[];
  residuals: { line: number; measured_mm: number; fitted_mm: number; residual_mm: number; left_out_mm: number }[];
  worst_lines: number[]; sentence: string; remarks: string[];
}
export interface ResponseSummary {
  frequency_rad_s: number; frequency_interval_rad_s: [number | null, number | null];
  frequency_hz: number; frequency_interval_hz: [number | null, number | null];
  damping: number; damping_interval: [number | null, number | null];
  decrement?: { frequency_rad_s: number; damping: number };
  other: { frequency_hz: number; damping: number; amplitude_share: number } | null;
  from_s: number; to_s: number; cycles: number; samples_per_cycle: number; explained: number; passes: number;
  sentence: string; remarks: { code: string; message: string }[];
}
export type Identification = StiffnessSummary | ResponseSummary;
"#;

/// A result identified from measurements.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Identified {
    found: Found,
}

#[derive(Debug)]
enum Found {
    Stiffness(Box<(Fit, summary::StiffnessSummary)>),
    Response(Box<(response::Signal, Mode, summary::ResponseSummary)>),
}

/// Joint compliances of a job's robot from rows of joint angles, force and displacement;
/// `convention` is `table` or `coupled-j3`.
#[wasm_bindgen]
pub fn identify_stiffness(job: &str, text: &str, convention: &str) -> Result<Identified, JsValue> {
    let identify = || {
        let robot = setup::robot(&Job::from_json(job)?)?;
        let convention = Convention::of(convention)?;
        convention.suits(&robot)?;
        let measurements = measurement::read(text, convention)?;
        let fit = stiffness::fit(&robot, &measurements.rows)?;
        let summary = summary::stiffness(&robot, &measurements, &fit);
        Ok(Identified { found: Found::Stiffness(Box::new((fit, summary))) })
    };
    identify().map_err(|error: Error| thrown(&error))
}

/// Frequency and damping from rows of time and signal, from the instant `from_s` on (by default
/// from the largest excursion).
#[wasm_bindgen]
pub fn identify_response(text: &str, from_s: Option<f64>) -> Result<Identified, JsValue> {
    let identify = || {
        let signal = response::Signal::read(text)?;
        let mode = response::mode(&signal, from_s)?;
        let summary = summary::response(&mode);
        Ok(Identified { found: Found::Response(Box::new((signal, mode, summary))) })
    };
    identify().map_err(|error: Error| thrown(&error))
}

#[wasm_bindgen]
impl Identified {
    /// The result: joint compliances, or a vibration.
    #[wasm_bindgen(unchecked_return_type = "Identification")]
    pub fn summary(&self) -> Result<JsValue, JsValue> {
        match &self.found {
            Found::Stiffness(both) => object(&both.1),
            Found::Response(all) => object(&all.2),
        }
    }

    /// Measurements and fit, drawn at the requested size.
    #[wasm_bindgen(unchecked_return_type = "Chart")]
    pub fn chart(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ChartOptions")] options: JsValue,
    ) -> Result<JsValue, JsValue> {
        let options = options::chart(options)?;
        object(&self.found.drawn().chart(&options).map_err(|error| thrown(&error))?)
    }

    /// The values that the chart shows.
    #[wasm_bindgen(unchecked_return_type = "ChartColumn[]")]
    pub fn chart_data(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ChartUnits")] units: JsValue,
    ) -> Result<JsValue, JsValue> {
        chart::columns(self.found.drawn().data(options::units(units)?))
    }
}

impl Found {
    fn drawn(&self) -> identified::Fitted<'_> {
        match self {
            Found::Stiffness(both) => identified::Fitted::Stiffness(&both.0),
            Found::Response(all) => identified::Fitted::Response(&all.0, &all.1),
        }
    }
}
