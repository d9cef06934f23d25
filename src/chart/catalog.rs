//! Every chart that Armill shows, by name: the thesis's figures, recomputed for the job at hand.

use crate::chart::plot::{Chart, Options};
use crate::chart::sheet::Sheet;
use crate::deviation::Source;
use crate::error::Error;
use crate::report::Report;
use crate::units::MM;
use serde::Serialize;

/// What a chart is and where it belongs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Entry {
    /// Stable name.
    pub name: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// View of the page.
    pub view: &'static str,
    /// Figure of the thesis; empty for a chart of our own.
    pub figure: &'static str,
    /// `curve` or `space`.
    pub kind: &'static str,
}

const fn entry(
    name: &'static str,
    title: &'static str,
    view: &'static str,
    figure: &'static str,
    kind: &'static str,
) -> Entry {
    Entry { name, title, view, figure, kind }
}

/// All charts, in the order of the page.
pub const CATALOG: [Entry; 25] = [
    entry("before-after", "Contour error before and after compensation", "overview", "5.18", "curve"),
    entry("actual-path", "Desired and actual path, deviation magnified", "overview", "5.7", "space"),
    entry("convergence", "Contour error left after each pass", "overview", "", "curve"),
    entry("path", "Desired path in space", "path", "5.1", "space"),
    entry("coordinates", "Desired position over time", "path", "5.3", "curve"),
    entry("distorted-path", "Path bent by the shaper alone, deviation magnified", "path", "4.12", "space"),
    entry("compensated-path", "Path to command, correction magnified", "path", "5.11", "space"),
    entry("revolution", "Milling force over one revolution", "forces", "4.2, 4.3", "curve"),
    entry("force", "Milling force in the base frame", "forces", "4.6", "curve"),
    entry("deflection", "Tip deflection by the milling force", "deflection", "4.8", "curve"),
    entry(
        "deviation",
        "Path bent by the milling force alone, deviation magnified",
        "deflection",
        "5.6",
        "space",
    ),
    entry("error-deflection", "Contour error by cutting forces alone", "error", "5.8", "curve"),
    entry("error-shaping", "Contour error by the shaper alone", "error", "5.9", "curve"),
    entry("combined", "Contour error of each source and of both", "error", "5.17", "curve"),
    entry("after-deflection", "Forces alone, before and after compensation", "error", "5.13", "curve"),
    entry("after-shaping", "Shaping alone, before and after compensation", "error", "5.15", "curve"),
    entry("joints", "Joint commands for the desired path", "joints", "5.4", "curve"),
    entry("joint-1", "Joint 1, original and shaped", "joints", "4.11", "curve"),
    entry("joint-2", "Joint 2, original and shaped", "joints", "4.11", "curve"),
    entry("joint-3", "Joint 3, original and shaped", "joints", "4.11", "curve"),
    entry("joint-4", "Joint 4, original and shaped", "joints", "4.11", "curve"),
    entry("joint-5", "Joint 5, original and shaped", "joints", "4.11", "curve"),
    entry("joint-6", "Joint 6, original and shaped", "joints", "4.11", "curve"),
    entry("shaper-step", "Unit step, original and shaped", "shaper", "4.10", "curve"),
    entry("shaper-robustness", "Vibration left if the frequency is misjudged", "shaper", "", "curve"),
];

/// Draws the chart `name` of a report.
///
/// # Errors
/// [`Error::Invalid`] for a name that is not in [`CATALOG`], or for options that cannot be drawn.
pub fn chart(report: &Report, name: &str, options: &Options) -> Result<Chart, Error> {
    let refuse = |value: String, expected: String| Error::Invalid { field: "chart".into(), value, expected };
    let Some(entry) = CATALOG.iter().find(|entry| entry.name == name) else {
        let names: Vec<_> = CATALOG.iter().map(|entry| entry.name).collect();
        return Err(refuse(format!("\"{name}\""), format!("the charts are {}", names.join(", "))));
    };
    let sheet = Sheet { report, entry, options };
    let drawn = match name {
        "before-after" => sheet.before_and_after(&report.before.contour_error, &report.after.contour_error),
        "after-deflection" => {
            let after = &report.alone(Source::Deflection).result.contour_error;
            sheet.before_and_after(&report.deflection_only.contour_error, after)
        }
        "after-shaping" => {
            let after = &report.alone(Source::Shaping).result.contour_error;
            sheet.before_and_after(&report.shaping_only.contour_error, after)
        }
        "convergence" => sheet.convergence(),
        "path" => sheet.path(),
        "coordinates" => sheet.vectors("Position", "mm", &report.plan.trajectory.position, MM),
        "actual-path" => sheet.bent(&report.before.actual, &report.before.contour_error, "Actual", "both"),
        "distorted-path" => {
            sheet.bent(&report.shaping_only.actual, &report.shaping_only.contour_error, "Shaped", "shaping")
        }
        "deviation" => sheet.bent(
            &report.deflection_only.actual,
            &report.deflection_only.contour_error,
            "Bent",
            "deflection",
        ),
        "compensated-path" => sheet.compensated(),
        "revolution" => sheet.revolution(),
        "force" => sheet.vectors("Force", "N", &report.before.force, 1.0),
        "deflection" => sheet.vectors("Deflection", "mm", &report.before.deflection, MM),
        "error-deflection" => sheet.errors(&[(
            "deflection",
            "Forces alone",
            "deflection",
            &report.deflection_only.contour_error,
        )]),
        "error-shaping" => {
            sheet.errors(&[("shaping", "Shaping alone", "shaping", &report.shaping_only.contour_error)])
        }
        "combined" => sheet.errors(&[
            ("deflection", "Forces alone", "deflection", &report.deflection_only.contour_error),
            ("shaping", "Shaping alone", "shaping", &report.shaping_only.contour_error),
            ("both", "Both together", "both", &report.before.contour_error),
        ]),
        "joints" => sheet.joints(),
        "shaper-step" => sheet.step(),
        "shaper-robustness" => sheet.robustness(),
        _ => match name.strip_prefix("joint-").and_then(|joint| joint.parse::<usize>().ok()) {
            Some(joint @ 1..=6) => sheet.shaped_joint(joint - 1),
            _ => Err("a chart without a drawing".to_owned()),
        },
    };
    drawn.map_err(|expected| refuse(format!("\"{name}\""), expected))
}
