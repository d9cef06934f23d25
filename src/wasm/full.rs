//! What only the full core answers: the page loads it when one of these is asked for, or a job that the small one refuses with
//! [`Error::NeedsFull`](crate::Error::NeedsFull). The page fetches it anyway once the first result is shown.
//!
//! To place code here: `#[cfg(feature = "full")]` before its module, its wasm-bindgen function in this file, and its name in `FULL` of
//! `web/js/answers.js`; or, in a function of both cores, `Error::unless_full` before what only the full one is to have. What `Run` holds is
//! computed again in the full core, with the same bits.

use super::{Run, chart_options, columns_of, object, thrown, units};
use crate::chart::identified;
use crate::identify::{Convention, Fit, Mode, measurement, response, stiffness, summary};
use crate::job::fields as table;
use crate::job::presets as libraries;
use crate::report::format::FORMATS;
use crate::report::thesis;
use crate::units::MM;
use crate::{Job, export, placement};
use js_sys::{Array, Float64Array};
use nalgebra::Vector3;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

/// The default job (the thesis's case) as JSON text.
#[wasm_bindgen]
pub fn default_job() -> String {
    Job::default().to_json()
}

/// Every input of a job, for building a form.
#[wasm_bindgen(unchecked_return_type = "Field[]")]
pub fn fields() -> Result<JsValue, JsValue> {
    object(&table::fields())
}

/// Every kind of file that a run can be exported to.
#[wasm_bindgen(unchecked_return_type = "Format[]")]
pub fn formats() -> Result<JsValue, JsValue> {
    object(&FORMATS.to_vec())
}

/// Robots and materials of the library, with the source of their numbers.
#[wasm_bindgen(unchecked_return_type = "Presets")]
pub fn presets() -> Result<JsValue, JsValue> {
    object(&libraries::presets())
}

/// The thesis's printed figures beside ours, for the default job.
#[wasm_bindgen(unchecked_return_type = "ThesisRow[]")]
pub fn thesis_recomputed() -> Result<JsValue, JsValue> {
    let rows = crate::run(&Job::default())
        .and_then(|report| thesis::rows(&report))
        .map_err(|error| thrown(&error))?;
    object(&rows)
}

#[wasm_bindgen]
impl Run {
    /// A file to take away, in one of [`formats`]; `thinning_mm` is how far its points may stray from the samples (a tenth of the tolerance, if it is not given).
    pub fn export(&self, format: &str, thinning_mm: Option<f64>) -> Result<String, JsValue> {
        let options = export::Options { thinning: thinning_mm.map(|thinning| thinning * MM) };
        match export::export(&self.report, format, &options) {
            Ok(export) => Ok(export.text),
            Err(error) => Err(thrown(&error)),
        }
    }

    /// Some rows of `columns-csv`, of the samples `from` up to but without `to`; the first comes with the header.
    pub fn columns_csv(&self, from: usize, to: usize) -> String {
        export::csv::rows(&self.report, from..to)
    }

    /// What comes out of the path as a G-code program: its timing is its own.
    #[wasm_bindgen(unchecked_return_type = "Promised")]
    pub fn promise(&self) -> Result<JsValue, JsValue> {
        object(&export::promise(&self.report).map_err(|error| thrown(&error))?)
    }

    /// Contour error [mm] that comes out of a program (`gcode`, `apt` or `path-csv`), read back and sent through the model.
    #[wasm_bindgen(unchecked_return_type = "Statistics")]
    pub fn replay(&self, format: &str) -> Result<JsValue, JsValue> {
        let outcome = export::replay::replay(&self.report, format, &export::Options::default());
        object(&outcome.map_err(|error| thrown(&error))?.statistics())
    }
}

/// Something identified from measurements.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Identified {
    found: Found,
    summary: serde_json::Value,
}

#[derive(Debug)]
enum Found {
    Stiffness(Box<Fit>),
    Response(response::Signal, Box<Mode>),
}

/// Joint compliances of a job's robot from rows of joint angles, force and displacement; `convention` is `table` or `coupled-j3`.
#[wasm_bindgen]
pub fn identify_stiffness(job: &str, text: &str, convention: &str) -> Result<Identified, JsValue> {
    let identify = || {
        let robot = Job::from_json(job)?.robot()?;
        let convention = Convention::of(convention)?;
        convention.suits(&robot)?;
        let measurements = measurement::read(text, convention)?;
        let fit = stiffness::fit(&robot, &measurements.rows)?;
        let summary = serde_json::json!(summary::stiffness(&robot, &measurements, &fit));
        Ok(Identified { found: Found::Stiffness(Box::new(fit)), summary })
    };
    identify().map_err(|error| thrown(&error))
}

/// Frequency and damping from rows of time and signal, from the instant `from_s` on (from the largest excursion, if it is not given).
#[wasm_bindgen]
pub fn identify_response(text: &str, from_s: Option<f64>) -> Result<Identified, JsValue> {
    let identify = || {
        let signal = response::Signal::read(text)?;
        let mode = response::mode(&signal, from_s)?;
        let summary = serde_json::json!(summary::response(&mode));
        Ok(Identified { found: Found::Response(signal, Box::new(mode)), summary })
    };
    identify().map_err(|error| thrown(&error))
}

#[wasm_bindgen]
impl Identified {
    /// What was found.
    #[wasm_bindgen(unchecked_return_type = "Identification")]
    pub fn summary(&self) -> Result<JsValue, JsValue> {
        object(&self.summary)
    }

    /// Measurements and fit, drawn in the size asked for.
    #[wasm_bindgen(unchecked_return_type = "Chart")]
    pub fn chart(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ChartOptions")] options: JsValue,
    ) -> Result<JsValue, JsValue> {
        object(&self.found.drawn().chart(&chart_options(&options)?).map_err(|error| thrown(&error))?)
    }

    /// The values that the chart shows.
    #[wasm_bindgen(unchecked_return_type = "ChartColumn[]")]
    pub fn chart_data(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ChartUnits")] options: JsValue,
    ) -> Result<Array, JsValue> {
        Ok(columns_of(self.found.drawn().data(units(&options)?)))
    }
}

impl Found {
    fn drawn(&self) -> identified::Identified<'_> {
        match self {
            Found::Stiffness(fit) => identified::Identified::Stiffness(fit),
            Found::Response(signal, mode) => identified::Identified::Response(signal, mode),
        }
    }
}

/// A job whose part is moved over a map of places.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Survey {
    survey: placement::Survey,
}

#[wasm_bindgen]
impl Survey {
    /// Reads a job once, for any number of places. Throws what is wrong with it.
    #[wasm_bindgen(constructor)]
    pub fn new(json: &str) -> Result<Survey, JsValue> {
        let survey = Job::from_json(json).and_then(|job| placement::Survey::new(&job));
        survey.map(|survey| Survey { survey }).map_err(|error| thrown(&error))
    }

    /// Smallest and largest x, y, z of places worth a look [mm].
    pub fn extent(&self) -> Float64Array {
        let numbers: Vec<f64> = self.survey.extent().iter().flatten().map(|v| v / MM).collect();
        Float64Array::from(numbers.as_slice())
    }

    /// For each place, three numbers x, y, z of the workpiece frame in the cell [mm]: largest and mean contour error by the cutting
    /// force [mm], and 0 if all is well, 1 near a singularity, 2 where a joint leaves its range, 3 out of reach.
    pub fn places(&self, xyz_mm: &[f64]) -> Float64Array {
        let places = xyz_mm.chunks_exact(3).flat_map(|at| {
            let place = self.survey.at(Vector3::new(at[0], at[1], at[2]) * MM);
            [place.max / MM, place.mean / MM, f64::from(place.mark as u8)]
        });
        Float64Array::from(places.collect::<Vec<f64>>().as_slice())
    }
}
