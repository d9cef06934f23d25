//! Results as charts: data in, SVG text out, the same bytes natively and in every browser.
//!
//! [`catalog`] names every chart and `figures` builds their content in the requested [units](unit);
//! the rest draws: [`plot`] over two axes, [`space`] in three dimensions.
//!
//! plotters gives the mesh of axes and grid, and the shapes to draw with. Scales, decimation,
//! legend and the [`svg`] backend are our own: plotters searches ticks with the platform's
//! logarithm, rounds to whole pixels, draws every sample, and measures text through the DOM, which
//! a Worker does not have.

#[allow(clippy::module_inception, reason = "the chart itself can be saved as a file")]
pub mod chart;
pub mod cases;
pub mod catalog;
pub mod error_grid;
pub mod evidence;
pub mod identified;
pub mod intervals;
pub mod learned;
pub mod over;
pub mod plot;
pub mod space;
pub mod svg;
pub mod sweep;
pub mod unit;
mod content;
mod cut_in_stock;
mod figures;
mod frame;
mod loops;
mod scale;
mod trace;

pub use catalog::{CATALOG, Entry, chart, charts_of, data};
pub use chart::{Chart, ChartOptions, Scaling};
pub use over::Over;
pub use unit::{ForceUnit, Units};
