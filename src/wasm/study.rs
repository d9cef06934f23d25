//! Questions about a job. Ranges and questions are texts, the same as on the script's command line.

use crate::study::{
    self, ErrorMeasure, EveryChoice, EveryLoop, EveryRobot, LargestQuestion, PartPlace, Sweep, Variation,
};
use crate::wasm::error::thrown;
use crate::wasm::object;
use crate::{Error, Job, Progress};
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
/** What a run comes to: figures, or `error`, why there are none. */
export interface StudyOutcome {
  before_max_mm?: number; after_max_mm?: number; p50_mm?: number; p95_mm?: number;
  verdict_state?: "cannot-run" | "met" | "met-if-nominal" | "not-met"; cannot_run?: string; error?: string;
}
/** What was varied takes a number, or the word of a choice. */
export interface SweepRow extends StudyOutcome { value: number | string; second?: number | string; }
export interface RobotRow extends StudyOutcome {
  id: string; name: string; payload_kg: number; reach_mm: number; stiffness: "measured" | "published" | "guessed";
  workpiece_mm: [number, number, number]; spin_deg: number; duration_s?: number; force_n?: number;
  limit_room_deg?: number; singularity_deg?: number;
}
/** `patch` is a JSON merge patch of the job. */
export interface ChoiceRow extends StudyOutcome {
  choice: "as-is" | "direction" | "milling" | "both" | "start" | "turn"; label: string; patch: object;
}
export interface LargestAnswer {
  path: string; largest: number | null; quantity: "nominal" | "p95" | "uncompensated"; tolerance_mm: number;
  holds: "nowhere" | "partly" | "everywhere"; crossings: number[]; at_largest?: StudyOutcome; runs: number;
  wanted?: number[];
}
export interface LoopError { p50: number; p95: number; }
/** Largest contour errors [mm] with a loop on top of the path; `verdict` says them in words. */
export interface LoopRow {
  measures: "position" | "load-side-angle" | "force"; preset: string; name: string; cannot_run?: string;
  without: LoopError; offline: LoopError; online?: LoopError; both?: LoopError;
  helps_below_hz?: number; slow_share: number; stable: boolean; gain: number; largest_stable_gain?: number; verdict: string;
}
export interface TornadoBar {
  input: string; factors: [number, number]; after_mm: [number, number]; before_mm: [number, number];
}
export interface Tornado { after_mm: number; before_mm: number; bars: TornadoBar[]; }
export type StudyRow = SweepRow | RobotRow | ChoiceRow | LoopRow;
"#;

/// A question whose answer is many runs, each by itself: Workers share them among each other.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Study {
    runs: Runs,
}

#[derive(Debug)]
enum Runs {
    Sweep(Sweep),
    Robots(EveryRobot),
    Choices(EveryChoice),
    Loops(Box<EveryLoop>),
}

#[wasm_bindgen]
impl Study {
    /// A job over one number or choice, or two: each `path=from:to:count`, with `:log` at the end for equal
    /// ratios, or `path=number,number`, or for a choice `path=word,word` or `path=all`.
    /// Throws an error if the job cannot be read, or a range names no number of it.
    pub fn sweep(json: &str, ranges: Vec<String>) -> Result<Study, JsValue> {
        let of = || Ok(Runs::Sweep(Sweep::new(&Job::from_json(json)?, &read_ranges(&ranges)?)?));
        of().map(Study::of).map_err(|error: Error| thrown(&error))
    }

    /// The scan of `largest`.
    pub fn scan(json: &str, question: &str) -> Result<Study, JsValue> {
        let of = || {
            let range = LargestQuestion::read(question, ErrorMeasure::P95)?.scan();
            Ok(Runs::Sweep(Sweep::new(&Job::from_json(json)?, &[range.into()])?))
        };
        of().map(Study::of).map_err(|error: Error| thrown(&error))
    }

    /// A job on every robot of the library, with its part where the job has it (`kept`), in front of each
    /// (`front`), or where the error is least there, with the tool turned as is best (`sought`).
    pub fn robots(json: &str, place: &str) -> Result<Study, JsValue> {
        let of = || Ok(Runs::Robots(EveryRobot::new(&Job::from_json(json)?, PartPlace::named(place)?)?));
        of().map(Study::of).map_err(|error: Error| thrown(&error))
    }

    /// A job with every choice that it leaves open.
    pub fn choices(json: &str) -> Result<Study, JsValue> {
        let job = Job::from_json(json).map_err(|error| thrown(&error))?;
        Ok(Study::of(Runs::Choices(EveryChoice::new(&job))))
    }

    /// A job with every sensor and controller of a loop on top of the path. Throws an error if it cannot be computed.
    pub fn loops(json: &str) -> Result<Study, JsValue> {
        let of = || Ok(Runs::Loops(Box::new(EveryLoop::new(&Job::from_json(json)?)?)));
        of().map(Study::of).map_err(|error: Error| thrown(&error))
    }

    /// Number of runs.
    pub fn count(&self) -> usize {
        match &self.runs {
            Runs::Sweep(sweep) => sweep.count(),
            Runs::Robots(robots) => robots.count(),
            Runs::Choices(choices) => choices.count(),
            Runs::Loops(loops) => loops.count(),
        }
    }

    /// What one run comes to. Throws an error if there are fewer runs.
    #[wasm_bindgen(unchecked_return_type = "StudyRow")]
    pub fn row(&self, index: usize) -> Result<JsValue, JsValue> {
        if index >= self.count() {
            return Err(thrown(&Error::invalid("index", index, format!("less than {}", self.count()))));
        }
        match &self.runs {
            Runs::Sweep(sweep) => object(&sweep.row(index)),
            Runs::Robots(robots) => object(&robots.row(index)),
            Runs::Choices(choices) => object(&choices.row(index)),
            Runs::Loops(loops) => object(&loops.row(index).map_err(|error| thrown(&error))?),
        }
    }

    fn of(runs: Runs) -> Self {
        Self { runs }
    }
}

/// The largest value of a number for which the error meets the tolerance: `question` is `path=from:to`, and
/// `quantity` the error, `nominal`, `p95` or `uncompensated`. `scanned` may hold that error [mm], NaN without a result,
/// at each value of [`Study::scan`], then at those that were `wanted`. With `partial`, the answer is as far as these
/// errors go, and what it still wants can be run at once, as a sweep over `path=number,number`; without, it is run here.
#[wasm_bindgen(unchecked_return_type = "LargestAnswer")]
pub fn largest(
    json: &str,
    question: &str,
    quantity: &str,
    scanned: Option<Vec<f64>>,
    partial: Option<bool>,
) -> Result<JsValue, JsValue> {
    let known: Vec<Option<f64>> =
        scanned.unwrap_or_default().iter().map(|error| (!error.is_nan()).then_some(*error)).collect();
    let answer = || {
        let job = Job::from_json(json)?;
        let question = LargestQuestion::read(question, ErrorMeasure::named(quantity)?)?;
        if partial == Some(true) {
            question.partial(&job, &known)
        } else {
            question.answer_from(&job, &known)
        }
    };
    object(&answer().map_err(|error: Error| thrown(&error))?)
}

/// Which input moves the largest error most, over its own spread. Throws an error if the job cannot be computed.
#[wasm_bindgen(unchecked_return_type = "Tornado")]
pub fn tornado(json: &str) -> Result<JsValue, JsValue> {
    let report = Job::from_json(json).and_then(|job| crate::run(&job, &mut Progress::none()));
    object(&study::tornado(&report.map_err(|error| thrown(&error))?))
}

fn read_ranges(texts: &[String]) -> Result<Vec<Variation>, Error> {
    texts.iter().map(|text| Variation::read(text)).collect()
}
