//! Stiffness and vibration of a robot from measurements.

use crate::chart::evidence;
use crate::chart::identified::{Fitted, GearRun};
use crate::chart::{Chart, ChartOptions, Units};
use crate::column::Column;
use crate::error::Error;
use crate::evidence::Evidence;
use crate::identify::gear::{self, Gear, GearLog, GearSummary, MeasuredJoint};
use crate::identify::{Convention, Fit, Mode, measurement, response, stiffness, summary};
use crate::setup::{self, Setup};
use crate::wasm::error::thrown;
use crate::wasm::{chart, object, options};
use crate::{Job, Progress};
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
export interface GearSummary {
  joint: number; stiffness_nm_per_rad?: number; stiffness_interval_nm_per_rad?: [number, number];
  delay_ms: number; delay_interval_ms: [number, number];
  hysteresis_urad: number; hysteresis_interval_urad: [number, number];
  explained: number; rest_urad: number; rest_without_spring_urad: number; blocks: number;
  predicted?: { explained: number; rest_urad: number; rest_without_spring_urad: number };
  sentence: string; remarks: string[];
}
/** The gears; `in_job` has the compliances of the job's robot with each of them, or null where the spring does not show. */
export interface GearSummaries {
  robot: string; joints: GearSummary[];
  in_job: ({ joint_compliance_rad_per_nm: number[]; compliance_covariance: number[][] } | null)[];
}
export type Identification = StiffnessSummary | ResponseSummary | GearSummaries | Evidence;
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
    Gears(Box<Gears>),
    Evidence(Box<Evidence>),
}

/// The gears of one log, and another run of the same joints.
#[derive(Debug)]
struct Gears {
    setup: Setup,
    logs: Vec<GearLog>,
    others: Vec<GearLog>,
    gears: Vec<Gear>,
    /// Which is drawn, from 0.
    drawn: usize,
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

/// Springs of joints from their angles at motor and load, for the robot of a job; `other` is another run to predict, `joint`,
/// from 1, the one that is drawn, by default the first.
#[wasm_bindgen]
pub fn identify_gear(
    job: &str,
    text: &str,
    other: Option<String>,
    joint: Option<usize>,
) -> Result<Identified, JsValue> {
    let identify = || {
        let setup = Setup::of(&Job::from_json(job)?, &mut Progress::none())?;
        let logs = gear::read(text)?;
        let others = other.map_or(Ok(vec![]), |other| gear::read_as(&other, "other"))?;
        if !others.is_empty() && !logs.iter().any(|log| others.iter().any(|other| other.joint == log.joint)) {
            let value = format!("joint {}", others[0].joint + 1);
            return Err(Error::invalid("other", value, "a joint of the first run"));
        }
        let gears = logs.iter().map(GearLog::fit).collect::<Result<Vec<_>, Error>>()?;
        let drawn = match joint {
            None => Some(0),
            Some(joint) => logs.iter().position(|log| log.joint + 1 == joint),
        };
        let known = || logs.iter().map(|log| (log.joint + 1).to_string()).collect::<Vec<_>>().join(", ");
        let drawn = drawn.ok_or_else(|| Error::invalid("joint", joint.unwrap_or_default(), known()))?;
        Ok(Identified { found: Found::Gears(Box::new(Gears { setup, logs, others, gears, drawn })) })
    };
    identify().map_err(|error: Error| thrown(&error))
}

#[wasm_bindgen]
impl Identified {
    /// The result: joint compliances, a vibration, springs of gears, or evidence.
    #[wasm_bindgen(unchecked_return_type = "Identification")]
    pub fn summary(&self) -> Result<JsValue, JsValue> {
        match &self.found {
            Found::Stiffness(both) => object(&both.1),
            Found::Response(all) => object(&all.2),
            Found::Gears(all) => object(&all.summaries()),
            Found::Evidence(evidence) => object(evidence),
        }
    }

    /// Measurements and fit, drawn at the requested size.
    #[wasm_bindgen(unchecked_return_type = "Chart")]
    pub fn chart(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ChartOptions")] options: JsValue,
    ) -> Result<JsValue, JsValue> {
        let options = options::chart(options)?;
        object(&self.found.chart(&options).map_err(|error| thrown(&error))?)
    }

    /// The values that the chart shows.
    #[wasm_bindgen(unchecked_return_type = "ChartColumn[]")]
    pub fn chart_data(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ChartUnits")] units: JsValue,
    ) -> Result<JsValue, JsValue> {
        chart::columns(self.found.data(options::units(units)?))
    }
}

impl Identified {
    /// Holds evidence.
    pub(super) fn of_evidence(evidence: Evidence) -> Self {
        Self { found: Found::Evidence(Box::new(evidence)) }
    }
}

impl Found {
    fn chart(&self, options: &ChartOptions) -> Result<Chart, Error> {
        match self {
            Found::Stiffness(both) => Fitted::Stiffness(&both.0).chart(options),
            Found::Response(all) => Fitted::Response(&all.0, &all.1).chart(options),
            Found::Gears(all) => all.drawn().chart(options),
            Found::Evidence(evidence) => evidence::chart(evidence, options),
        }
    }

    fn data(&self, units: Units) -> Vec<Column> {
        match self {
            Found::Stiffness(both) => Fitted::Stiffness(&both.0).data(units),
            Found::Response(all) => Fitted::Response(&all.0, &all.1).data(units),
            Found::Gears(all) => all.drawn().data(units),
            Found::Evidence(evidence) => evidence::data(evidence),
        }
    }
}

#[derive(serde::Serialize)]
struct GearSummaries<'a> {
    robot: &'a str,
    joints: Vec<GearSummary>,
    in_job: Vec<Option<MeasuredJoint>>,
}

impl Gears {
    fn other(&self, gear: &Gear) -> Option<&GearLog> {
        self.others.iter().find(|other| other.joint == gear.joint)
    }

    fn drawn(&self) -> Fitted<'_> {
        let gear = &self.gears[self.drawn];
        match self.other(gear) {
            Some(other) => Fitted::Gear(gear, other, GearRun::Predicted),
            None => Fitted::Gear(gear, &self.logs[self.drawn], GearRun::Fitted),
        }
    }

    fn summaries(&self) -> GearSummaries<'_> {
        let Setup { robot, spreads, .. } = &self.setup;
        let compliance: [f64; 6] = (*robot.compliance()).into();
        GearSummaries {
            robot: robot.name(),
            joints: self.gears.iter().map(|gear| gear.summary(self.other(gear))).collect(),
            in_job: self.gears.iter().map(|gear| gear.in_arm(&compliance, &spreads.stiffness)).collect(),
        }
    }
}
