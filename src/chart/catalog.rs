//! Every chart that Armill shows, by name: the thesis's figures, recomputed for the job at hand.

use crate::chart::chart::{Chart, ChartOptions};
use crate::chart::content::Content;
use crate::chart::cut_in_stock::{ENGAGEMENT, REMOVAL, SURFACE};
use crate::chart::figures::{BOTH, DEFLECTION, Figures, SHAPING};
use crate::chart::loops::{DELAY, SPECTRUM};
use crate::chart::over::Over;
use crate::chart::unit::Units;
use crate::column::Column;
use crate::deviation::Source;
use crate::error::Error;
use crate::report::Report;
use serde::Serialize;

/// A chart and its place on the page.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Entry {
    /// Stable name.
    pub name: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// View of the page that shows it.
    pub view: &'static str,
    /// Figure of the thesis; empty for a chart of our own.
    pub figure: &'static str,
    /// `time` for curves over the time of the run, `curve` for others, `space` for paths.
    pub kind: &'static str,
    /// What it can be drawn over, for curves over the run.
    pub over: &'static [Over],
}

const fn entry(
    name: &'static str,
    title: &'static str,
    view: &'static str,
    figure: &'static str,
    kind: &'static str,
) -> Entry {
    Entry { name, title, view, figure, kind, over: &[] }
}

/// Kind of the charts over the run.
const RUN: &str = "time";

/// Shown only if the spin is free.
const SPIN: &str = "spin";

/// All charts, in the order of the page.
pub const CATALOG: [Entry; 33] = [
    entry("before-after", "Contour error before and after compensation", "overview", "5.18", "time"),
    entry("actual-path", "Desired and actual path, deviation magnified", "overview", "5.7", "space"),
    entry("convergence", "Contour error left after each pass", "overview", "", "curve"),
    entry("path", "Desired path in space", "path", "5.1", "space"),
    entry("coordinates", "Desired position over time", "path", "5.3", "time"),
    entry("distorted-path", "Path bent by the shaper alone, deviation magnified", "path", "4.12", "space"),
    entry("compensated-path", "Commanded path, correction magnified", "path", "5.11", "space"),
    entry("revolution", "Milling force over one revolution", "forces", "4.2, 4.3", "curve"),
    entry("force", "Milling force in the base frame", "forces", "4.6", "time"),
    entry(ENGAGEMENT, "Engagement in the stock", "forces", "", "time"),
    entry(REMOVAL, "Material removal rate", "forces", "", "time"),
    entry("deflection", "Tip deflection by the milling force", "deflection", "4.8", "time"),
    entry(
        "deviation",
        "Path bent by the milling force alone, deviation magnified",
        "deflection",
        "5.6",
        "space",
    ),
    entry("error-deflection", "Contour error by cutting forces alone", "error", "5.8", "time"),
    entry("error-shaping", "Contour error by the shaper alone", "error", "5.9", "time"),
    entry("combined", "Contour error of each source and of both", "error", "5.17", "time"),
    entry("after-deflection", "Forces alone, before and after compensation", "error", "5.13", "time"),
    entry("after-shaping", "Shaping alone, before and after compensation", "error", "5.15", "time"),
    entry("after-both", "Both together, before and after compensation", "error", "5.18", "time"),
    entry(SURFACE, "Surface left, before and after compensation", "error", "", "time"),
    entry(SPECTRUM, "How fast the error changes, and what the loop leaves of it", "error", "", "curve"),
    entry(DELAY, "What a loop leaves, by its dead time", "error", "", "curve"),
    entry("axis-error", "Tool axis error before and after compensation", "error", "", "time"),
    entry("joints", "Joint commands for the desired path", "joints", "5.4", "time"),
    entry("joint-1", "Joint 1, original and shaped", "joints", "4.11", "time"),
    entry("joint-2", "Joint 2, original and shaped", "joints", "4.11", "time"),
    entry("joint-3", "Joint 3, original and shaped", "joints", "4.11", "time"),
    entry("joint-4", "Joint 4, original and shaped", "joints", "4.11", "time"),
    entry("joint-5", "Joint 5, original and shaped", "joints", "4.11", "time"),
    entry("joint-6", "Joint 6, original and shaped", "joints", "4.11", "time"),
    entry(SPIN, "Spin about the tool axis", "joints", "", "time"),
    entry("shaper-step", "Unit step, original and shaped", "shaper", "4.10", "curve"),
    entry("shaper-robustness", "Residual vibration if the frequency is misjudged", "shaper", "", "curve"),
];

/// The charts that apply to a report.
pub fn charts_of(report: &Report) -> Vec<Entry> {
    let applies = |entry: &Entry| match entry.name {
        SPIN => report.roll.is_some(),
        ENGAGEMENT | REMOVAL | SURFACE => report.setup().contacts.is_some(),
        SPECTRUM | DELAY => report.online.is_some(),
        _ => true,
    };
    let over =
        |entry: Entry| Entry { over: if entry.kind == RUN { Over::all(report) } else { &[] }, ..entry };
    CATALOG.into_iter().filter(applies).map(over).collect()
}

/// Draws the chart `name` of a report.
///
/// # Errors
/// [`Error::Invalid`] for a name that is not in [`CATALOG`], for one that does not apply to the report,
/// or for options that cannot be drawn.
pub fn chart(report: &Report, name: &str, options: &ChartOptions) -> Result<Chart, Error> {
    let content = content(report, name, options.units, options.over)?;
    let title = CATALOG.iter().find(|entry| entry.name == name).map_or("", |entry| entry.title);
    content.draw(name, title, options)
}

/// All values that the chart `name` shows: those along its first axis (in space, the time), then
/// each series.
///
/// # Errors
/// [`Error::Invalid`] for a name that is not in [`CATALOG`], or that does not apply to the report, or
/// for a first axis that the chart does not have.
pub fn data(report: &Report, name: &str, units: Units, over: Over) -> Result<Vec<Column>, Error> {
    Ok(content(report, name, units, over)?.columns())
}

/// Refuses a first axis that the chart does not have.
fn check_over(report: &Report, name: &str, over: Over) -> Result<(), Error> {
    let of_run = CATALOG.iter().any(|entry| entry.name == name && entry.kind == RUN);
    let legal = if of_run { Over::all(report) } else { &[Over::Time] };
    if legal.contains(&over) {
        return Ok(());
    }
    let names: Vec<_> = legal.iter().map(|over| format!("\"{}\"", over.name())).collect();
    let expected = format!("the chart \"{name}\" of this job can be drawn over {}", names.join(" or "));
    Err(Error::invalid("over", format!("\"{}\"", over.name()), expected))
}

fn content(report: &Report, name: &str, units: Units, over: Over) -> Result<Content, Error> {
    check_over(report, name, over)?;
    let figures = Figures { report, units, over };
    let (forces, shaping) = (&report.deflection_only, &report.shaping_only);
    let content = match name {
        "before-after" | "after-both" => figures.expected(),
        "after-deflection" => {
            let after = &report.alone(Source::Deflection).result.contour_error;
            figures.before_and_after(&forces.contour_error, after)
        }
        "after-shaping" => {
            let after = &report.alone(Source::Shaping).result.contour_error;
            figures.before_and_after(&shaping.contour_error, after)
        }
        "axis-error" => figures.axis_errors(),
        "convergence" => figures.convergence(),
        "path" => figures.path(),
        "coordinates" => figures.lengths("Position", &report.plan.trajectory.position),
        "actual-path" => figures.bent(&report.before.actual, &report.before.contour_error, "Actual", "both"),
        "distorted-path" => figures.bent(&shaping.actual, &shaping.contour_error, "Shaped", "shaping"),
        "deviation" => figures.bent(&forces.actual, &forces.contour_error, "Bent", "deflection"),
        "compensated-path" => figures.compensated(),
        "revolution" => figures.revolution(),
        "force" => figures.forces(),
        ENGAGEMENT => figures.engagement()?,
        REMOVAL => figures.removal()?,
        SURFACE => figures.surface()?,
        SPECTRUM => figures.loop_spectrum()?,
        DELAY => figures.loop_delay()?,
        "deflection" => figures.lengths("Deflection", &report.deflection),
        "error-deflection" => figures.errors(&[(DEFLECTION, &forces.contour_error)]),
        "error-shaping" => figures.errors(&[(SHAPING, &shaping.contour_error)]),
        "combined" => figures.errors(&[
            (DEFLECTION, &forces.contour_error),
            (SHAPING, &shaping.contour_error),
            (BOTH, &report.before.contour_error),
        ]),
        "joints" => figures.joints(),
        SPIN => figures.spin(),
        "shaper-step" => figures.step(),
        "shaper-robustness" => figures.robustness(),
        _ => match name.strip_prefix("joint-").and_then(|joint| joint.parse::<usize>().ok()) {
            Some(joint @ 1..=6) => figures.shaped_joint(joint - 1),
            _ => {
                let names = CATALOG.iter().map(|entry| entry.name);
                return Err(Error::unknown_name("chart", name, "the charts are", names));
            }
        },
    };
    Ok(content)
}
