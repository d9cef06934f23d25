//! What a measured pass teaches.

use crate::chart::learned::LearnedChart;
use crate::error::Error;
use crate::export::archive;
use crate::learn::frame::FRAMES;
use crate::learn::log::Clock;
use crate::learn::{
    Commanded, LearnSummary, LearnedCorrection, LearningGain, Log, MeasuredPass, NextPass, PassOptions,
    dynamometer,
};
use crate::report::Report;
use crate::setup::Setup;
use crate::simulation::judged;
use crate::units::MM;
use crate::verification::Programs;
use crate::wasm::error::thrown;
use crate::wasm::{chart, export, object, options};
use crate::{Job, Progress};
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
/** How a log is read; what is absent is recognised. `learned` is the text of a learned correction. */
export interface LearnOptions {
  commanded?: "corrected" | "desired"; learned?: string; frame?: "workpiece" | "base" | "world";
  shift?: number; corner_hz?: number; gain?: number;
}
export interface LearnSummary {
  log: {
    commanded: "corrected" | "desired"; learned_before: boolean; frame: "workpiece" | "base" | "world";
    shift_s?: number; shift_mm?: number; distance_mm?: number; correlation?: number; corner_hz: number; noise_mm: number;
    covered_percent: number; recognised: string[]; remarks: string[];
  };
  next?: {
    measured_mm: Statistics; expected_mm: Statistics; largest_change_mm: number; gain: number; converges_below: number;
    noise_floor_mm: number;
  };
  factors: {
    factors: { input: string; value: number; interval: [number, number]; before: [number, number] }[];
    estimator: string; explained_percent?: [number, number]; force_explained_percent?: [number, number]; learned: Learned;
  };
  unexplained: string[];
}
/** The section `learned` of a job. */
export interface Learned { compliance_factors: number[]; force_factors: number[]; covariance: number[][]; source?: string; }
export interface FittedCut {
  coefficients: { key: string; value: number; interval?: [number, number] }[]; r_squared: [number, number, number];
  peak_check?: { ratio: number; worst_percent: number }; cuts: number; remarks: string[];
}
"#;

/// A measured pass and what it teaches.
#[wasm_bindgen]
#[derive(Debug)]
pub struct LearnedPass {
    report: Report,
    measured: MeasuredPass,
    next: Option<(NextPass, LearningGain)>,
    summary: LearnSummary,
}

/// Lays a log over the run of a job. Throws an error with line and column of what cannot be read, or if the log does not lie
/// over the run. `shift` is in s, or of a log over arc length in mm.
#[wasm_bindgen]
#[allow(clippy::too_many_arguments, reason = "the fields of LearnOptions, one by one")]
pub fn learn_pass(
    job: &str,
    log: &str,
    commanded: Option<String>,
    learned: Option<String>,
    frame: Option<String>,
    shift: Option<f64>,
    corner_hz: Option<f64>,
    gain: Option<f64>,
) -> Result<LearnedPass, JsValue> {
    let learn = || {
        let job = Job::from_json(job)?;
        let log = Log::read(log)?;
        let gain = gain.map_or(Ok(LearningGain::USUAL), LearningGain::new)?;
        if let Some(corner) = corner_hz.filter(|corner| !(0.01..=1000.0).contains(corner)) {
            return Err(Error::invalid("corner_hz", corner, "0.01 to 1000 Hz"));
        }
        let frame = frame.map(|name| {
            let known = FRAMES.into_iter().find(|known| *known == name);
            known.ok_or_else(|| Error::unknown_name("frame", &name, "the frames are", FRAMES))
        });
        let report = judged(&job, &mut Progress::none())?;
        let commanded = match (learned, commanded.as_deref()) {
            (Some(text), _) => LearnedCorrection::from_json(&text)?.commanded(&report),
            (None, None | Some("corrected")) => Commanded { corrected: true, learned: vec![] },
            (None, Some("desired")) => Commanded { corrected: false, learned: vec![] },
            (None, Some(other)) => return Err(Error::invalid("commanded", other, "corrected or desired")),
        };
        let scale = if matches!(log.clock, Clock::Length(_)) { MM } else { 1.0 };
        let shift = shift.map(|shift| shift * scale);
        let options = PassOptions { commanded, frame: frame.transpose()?, shift, corner: corner_hz };
        let measured = MeasuredPass::of(&report, &log, &options)?;
        let next = match measured.error.is_empty() {
            true => None,
            false => Some((NextPass::of(&report, &measured, gain)?, gain)),
        };
        let of_next = next.as_ref().map(|(next, gain)| (next, *gain));
        let summary = LearnSummary::of(&report, job.learned.as_ref(), &measured, of_next);
        Ok(LearnedPass { report, measured, next, summary })
    };
    learn().map_err(|error: Error| thrown(&error))
}

#[wasm_bindgen]
impl LearnedPass {
    /// What was learned.
    #[wasm_bindgen(unchecked_return_type = "LearnSummary")]
    pub fn summary(&self) -> Result<JsValue, JsValue> {
        object(&self.summary)
    }

    /// Measured and expected error, drawn at the requested size.
    #[wasm_bindgen(unchecked_return_type = "Chart")]
    pub fn chart(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ChartOptions")] options: JsValue,
    ) -> Result<JsValue, JsValue> {
        let options = options::chart(options)?;
        object(&self.drawn().chart(&options).map_err(|error| thrown(&error))?)
    }

    /// The values that the chart shows.
    #[wasm_bindgen(unchecked_return_type = "ChartColumn[]")]
    pub fn chart_data(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ChartUnits")] units: JsValue,
    ) -> Result<JsValue, JsValue> {
        chart::columns(self.drawn().data(options::units(units)?))
    }

    /// What all passes so far have taught of the commands, as JSON to keep beside the job. Throws an error of a log of
    /// forces.
    pub fn correction(&self) -> Result<String, JsValue> {
        let next = self.next()?;
        let kept = Commanded { corrected: self.measured.commanded.corrected, learned: next.learned.clone() };
        serde_json::to_string(&LearnedCorrection::of(&self.report, &kept))
            .map_err(|error| thrown(&Error::invalid("correction", error, "numbers")))
    }

    /// The commands of the next pass as CSV, one row for each sample.
    pub fn command_csv(&self) -> Result<String, JsValue> {
        Ok(self.next()?.table(&self.report))
    }

    /// The next pass as the files that the job's controller loads, in one zip archive.
    pub fn package_zip(&self) -> Result<Vec<u8>, JsValue> {
        let report = self.next()?.report(&self.report);
        let zipped = || {
            let package = Programs::default().package(&report, None)?;
            archive::zip(&package.name, &package.files)
        };
        zipped().map_err(|error: Error| thrown(&error))
    }

    /// The next pass for an interface that adds it to the running desired program; see `Run.interface_zip`.
    pub fn interface_zip(&self, interface: &str) -> Result<Vec<u8>, JsValue> {
        let report = self.next()?.report(&self.report);
        export::interface_zip(&report, interface).map_err(|error| thrown(&error))
    }

    fn next(&self) -> Result<&NextPass, JsValue> {
        let missing =
            || thrown(&Error::invalid("log", "a log of forces alone", "a log that says where the tip was"));
        self.next.as_ref().map(|(next, _)| next).ok_or_else(missing)
    }

    fn drawn(&self) -> LearnedChart<'_> {
        LearnedChart {
            report: &self.report,
            measured: &self.measured,
            next: self.next.as_ref().map(|(next, _)| next),
        }
    }
}

/// Cutting coefficients from the mean forces of several cuts with the job's tool and engagement. Throws an error with line
/// and column of what cannot be read.
#[wasm_bindgen(unchecked_return_type = "FittedCut")]
pub fn fit_cuts(job: &str, cuts: &str) -> Result<JsValue, JsValue> {
    let fit = || {
        let setup = Setup::of(&Job::from_json(job)?, &mut Progress::none())?;
        dynamometer::fit(&setup.cut, &dynamometer::read(cuts)?)
    };
    object(&fit().map_err(|error: Error| thrown(&error))?)
}
