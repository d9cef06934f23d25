//! Files of a run, and how accurate its programs are.

use crate::error::Error;
use crate::export::post::robot::PackageFile;
use crate::export::superposed::{self, Interface};
use crate::export::{self, ExportOptions, archive};
use crate::report::Report;
use crate::setup::Controller;
use crate::units::MM;
use crate::verification::{self, Package};
use crate::wasm::error::thrown;
use crate::wasm::{Run, object};
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &'static str = r#"
export interface Promised {
  max_mm: number; met: boolean; p95_mm: number; sentence: string;
  verdict_state: "cannot-run" | "met" | "met-if-nominal" | "not-met";
}
export type Controller = "kuka" | "abb" | "staubli" | "fanuc" | "gcode" | "apt" | "csv";
export interface Package {
  controller: Controller; name: string; files: { path: string; text: string }[];
  max_mm: number; missed_mm: number; p95_mm: number; met: boolean; duration_s: number; points: number; stops: number;
  blending: number; remarks: string[]; sentence: string;
}
"#;

#[wasm_bindgen]
impl Run {
    /// The file in one of the `formats()`; `thinning_mm` is how far its points may
    /// stray from the samples (by default a tenth of the tolerance).
    pub fn export(&self, format: &str, thinning_mm: Option<f64>) -> Result<String, JsValue> {
        let options = ExportOptions { thinning: thinning_mm.map(|thinning| thinning * MM) };
        self.reserve();
        let file = self.programs.export(&self.report, format, &options);
        file.map(|file| file.text).map_err(|error| thrown(&error))
    }

    /// Rows of `columns-csv` for the samples `from` up to, but not including, `to`; rows from
    /// sample 0 include the header.
    pub fn columns_csv(&self, from: usize, to: usize) -> String {
        export::csv::rows(&self.report, from..to.max(from))
    }

    /// Accuracy of the path as a program of a format, timed by its own moves. By default that is
    /// `gcode`, or `apt` where three axes cannot express the path.
    #[wasm_bindgen(unchecked_return_type = "Promised")]
    pub fn promise(&self, format: Option<String>) -> Result<JsValue, JsValue> {
        self.reserve();
        let accuracy = match format {
            Some(format) => self.programs.accuracy(&self.report, &format),
            None => self.programs.usual_accuracy(&self.report),
        };
        object(&accuracy.map_err(|error| thrown(&error))?)
    }

    /// The path as the files that a controller loads (by default the job's), and how they run.
    #[wasm_bindgen(unchecked_return_type = "Package")]
    pub fn package(&self, controller: Option<String>) -> Result<JsValue, JsValue> {
        object(&self.packaged(controller)?)
    }

    /// The same files as one zip archive.
    pub fn package_zip(&self, controller: Option<String>) -> Result<Vec<u8>, JsValue> {
        let package = self.packaged(controller)?;
        archive::zip(&package.name, &package.files).map_err(|error| thrown(&error))
    }

    /// The correction for an interface that adds it to the running desired program (`kuka-rsi` or `abb-egm`), with the files that
    /// the interface needs, in one zip archive.
    pub fn interface_zip(&self, interface: &str) -> Result<Vec<u8>, JsValue> {
        interface_zip(&self.report, interface).map_err(|error| thrown(&error))
    }

    /// Contour error [mm] of a program (`gcode`, `apt` or `path-csv`), read back and simulated.
    #[wasm_bindgen(unchecked_return_type = "Statistics")]
    pub fn replay(&self, format: &str) -> Result<JsValue, JsValue> {
        self.reserve();
        let outcome =
            verification::read_back(&self.report, &self.programs, format, &ExportOptions::default());
        object(&outcome.map_err(|error| thrown(&error))?.statistics())
    }
}

/// Memory that a program's rehearsal takes for each move of its path [bytes].
const REHEARSAL_BYTES: usize = 2048;

impl Run {
    fn packaged(&self, controller: Option<String>) -> Result<Package, JsValue> {
        self.reserve();
        let controller = controller.map(|id| Controller::named(&id)).transpose();
        let package = controller.and_then(|controller| self.programs.package(&self.report, controller));
        package.map_err(|error| thrown(&error))
    }

    /// Grows the WebAssembly memory once for a rehearsal. Its many small allocations would grow it in
    /// hundreds of steps, and after each the JavaScript engine may collect garbage: a first export of
    /// 180,000 moves took five times as long.
    fn reserve(&self) {
        let bytes = self.report.plan.path.moves().len() * REHEARSAL_BYTES;
        let mut room = Vec::<u8>::new();
        // Where this much is not to be had at once, the rehearsal may still fit in pieces.
        let _ = room.try_reserve_exact(bytes);
        drop(std::hint::black_box(room));
    }
}

/// The files of an interface, in one archive.
pub(super) fn interface_zip(report: &Report, interface: &str) -> Result<Vec<u8>, Error> {
    let interface = Interface::named(interface)?;
    let files = superposed::package(report, interface)?;
    archive::zip(&format!("{}-{}", report.setup().output.name, interface.id()), &files)
}

/// Texts as one zip archive, each at its path in a folder; the same texts give the same bytes.
#[wasm_bindgen]
pub fn zip(folder: &str, paths: Vec<String>, texts: Vec<String>) -> Result<Vec<u8>, JsValue> {
    let files: Vec<_> = paths.into_iter().zip(texts).map(|(path, text)| PackageFile { path, text }).collect();
    archive::zip(folder, &files).map_err(|error| thrown(&error))
}
