//! Answers to questions about a job, to be drawn.

use crate::chart::error_grid::ErrorGrid;
use crate::chart::intervals::{Case, Intervals};
use crate::chart::sweep::SweepCurves;
use crate::study::Outcome;
use crate::wasm::error::thrown;
use crate::wasm::{chart, object, options};
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
/** A drawing of an answer: `svg` is one element. */
export interface AnswerDrawing { title: string; description: string; svg: string; width: number; height: number; }
"#;

/// The rows of a sweep over one number, to be drawn.
#[wasm_bindgen]
#[derive(Debug)]
pub struct StudyCurves {
    curves: SweepCurves,
}

#[wasm_bindgen]
impl StudyCurves {
    /// Of a number called `label`, in `unit`, which is `now` in the job. `errors_mm` has four values for each of
    /// `values`: before compensation, after it if every number is exact, at 50 % and at 95 %; NaN without a result.
    #[wasm_bindgen(constructor)]
    pub fn new(
        label: &str,
        unit: &str,
        tolerance_mm: f64,
        now: Option<f64>,
        values: &[f64],
        errors_mm: &[f64],
    ) -> StudyCurves {
        let known = |error: f64| (!error.is_nan()).then_some(error);
        let outcome = |errors: &[f64]| Outcome {
            before_max_mm: known(errors[0]),
            after_max_mm: known(errors[1]),
            p50_mm: known(errors[2]),
            p95_mm: known(errors[3]),
            ..Outcome::default()
        };
        let outcomes: Vec<Outcome> = errors_mm.chunks_exact(4).map(outcome).collect();
        let values = values[..values.len().min(outcomes.len())].to_vec();
        let (label, unit) = (label.to_owned(), unit.to_owned());
        StudyCurves { curves: SweepCurves { label, unit, now, tolerance_mm, values, outcomes } }
    }

    /// The curves, drawn at the requested size.
    #[wasm_bindgen(unchecked_return_type = "Chart")]
    pub fn chart(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ChartOptions")] options: JsValue,
    ) -> Result<JsValue, JsValue> {
        let options = options::chart(options)?;
        object(&self.curves.chart(&options).map_err(|error| thrown(&error))?)
    }

    /// The values that the chart shows.
    #[wasm_bindgen(unchecked_return_type = "ChartColumn[]")]
    pub fn chart_data(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ChartUnits")] units: JsValue,
    ) -> Result<JsValue, JsValue> {
        chart::columns(self.curves.data(options::units(units)?))
    }
}

/// Ranges of the error for several cases, to be drawn, the first at the top.
#[wasm_bindgen]
#[derive(Debug)]
pub struct StudyIntervals {
    intervals: Intervals,
}

#[wasm_bindgen]
impl StudyIntervals {
    /// Of the cases called `names`: `ranges_mm` has both ends for each, NaN without a result, and `guesses` a 1
    /// for those that rest on a guess. `quantity` names the axis; `now_mm` is the error of the job as it is.
    #[wasm_bindgen(constructor)]
    pub fn new(
        title: &str,
        quantity: &str,
        tolerance_mm: f64,
        now_mm: Option<f64>,
        names: Vec<String>,
        ranges_mm: &[f64],
        guesses: &[u8],
    ) -> StudyIntervals {
        let case = |((name, range), guess): ((String, &[f64]), &u8)| Case {
            name,
            range_mm: [range[0], range[1]],
            is_guess: *guess != 0,
        };
        let cases = names.into_iter().zip(ranges_mm.chunks_exact(2)).zip(guesses).map(case).collect();
        let (title, quantity) = (title.to_owned(), quantity.to_owned());
        StudyIntervals { intervals: Intervals { title, quantity, tolerance_mm, now_mm, cases } }
    }

    /// The intervals, drawn at the requested size.
    #[wasm_bindgen(unchecked_return_type = "AnswerDrawing")]
    pub fn draw(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ChartOptions")] options: JsValue,
    ) -> Result<JsValue, JsValue> {
        let options = options::chart(options)?;
        object(&self.intervals.draw(&options).map_err(|error| thrown(&error))?)
    }
}

/// The error over two things that vary, to be drawn as a grid.
#[wasm_bindgen]
#[derive(Debug)]
pub struct StudyGrid {
    grid: ErrorGrid,
}

#[wasm_bindgen]
impl StudyGrid {
    /// Of two `names` and the values of each, as printed, from left to right and from the bottom up.
    /// `errors_mm` has one for each pair, the second varying faster, NaN without a result; `now` is where the
    /// job is, counted in values from 0, with two numbers or none.
    #[wasm_bindgen(constructor)]
    pub fn new(
        title: &str,
        names: Vec<String>,
        values: Vec<String>,
        second_values: Vec<String>,
        now: &[f64],
        tolerance_mm: f64,
        errors_mm: &[f64],
    ) -> StudyGrid {
        let name = |k: usize| names.get(k).cloned().unwrap_or_default();
        StudyGrid {
            grid: ErrorGrid {
                title: title.to_owned(),
                names: [name(0), name(1)],
                values: [values, second_values],
                now: [now.first().copied(), now.get(1).copied()],
                tolerance_mm,
                errors_mm: errors_mm.to_vec(),
            },
        }
    }

    /// The grid, drawn at the requested size.
    #[wasm_bindgen(unchecked_return_type = "AnswerDrawing")]
    pub fn draw(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ChartOptions")] options: JsValue,
    ) -> Result<JsValue, JsValue> {
        let options = options::chart(options)?;
        object(&self.grid.draw(&options).map_err(|error| thrown(&error))?)
    }
}
