//! Files of a run, and how accurate its programs are.

use crate::export::{self, ExportOptions};
use crate::units::MM;
use crate::verification;
use crate::wasm::error::thrown;
use crate::wasm::{Run, object};
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
export interface Promised { max_mm: number; met: boolean; sentence: string; }
"#;

#[wasm_bindgen]
impl Run {
    /// The file in one of [`formats`](super::formats); `thinning_mm` is how far its points may
    /// stray from the samples (by default a tenth of the tolerance).
    pub fn export(&self, format: &str, thinning_mm: Option<f64>) -> Result<String, JsValue> {
        let options = ExportOptions { thinning: thinning_mm.map(|thinning| thinning * MM) };
        let file = self.programs.export(&self.report, format, &options);
        file.map(|file| file.text).map_err(|error| thrown(&error))
    }

    /// Rows of `columns-csv` for the samples `from` up to, but not including, `to`; rows from
    /// sample 0 include the header.
    pub fn columns_csv(&self, from: usize, to: usize) -> String {
        export::csv::rows(&self.report, from..to)
    }

    /// Accuracy of the path as a program of a format (`gcode` by default), timed by its own moves.
    #[wasm_bindgen(unchecked_return_type = "Promised")]
    pub fn promise(&self, format: Option<String>) -> Result<JsValue, JsValue> {
        let accuracy = self.programs.accuracy(&self.report, format.as_deref().unwrap_or("gcode"));
        object(&accuracy.map_err(|error| thrown(&error))?)
    }

    /// Contour error [mm] of a program (`gcode`, `apt` or `path-csv`), read back and simulated.
    #[wasm_bindgen(unchecked_return_type = "Statistics")]
    pub fn replay(&self, format: &str) -> Result<JsValue, JsValue> {
        let outcome =
            verification::read_back(&self.report, &self.programs, format, &ExportOptions::default());
        object(&outcome.map_err(|error| thrown(&error))?.statistics())
    }
}
