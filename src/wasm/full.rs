//! What only the full core answers: the page loads it when one of these is asked for, or a job that the small one refuses with
//! [`Error::NeedsFull`](crate::Error::NeedsFull).
//!
//! To place code here: `#[cfg(feature = "full")]` before its module, its wasm-bindgen function in this file, and its name in `FULL` of
//! `web/js/answers.js`. What `Run` holds is computed again in the full core, with the same bits.

use super::{Run, object, thrown};
use crate::report::thesis;
use crate::units::MM;
use crate::{Job, export};
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

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

    /// Contour error [mm] that comes out of a program (`gcode`, `apt` or `path-csv`), read back and sent through the model.
    #[wasm_bindgen(unchecked_return_type = "Statistics")]
    pub fn replay(&self, format: &str) -> Result<JsValue, JsValue> {
        let outcome = export::replay::replay(&self.report, format, &export::Options::default());
        object(&outcome.map_err(|error| thrown(&error))?.statistics())
    }
}
