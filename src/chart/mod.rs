//! Results as charts: data in, SVG text out, the same bytes natively and in every browser.
//!
//! [`catalog`] names every chart and `sheet` says what each shows, in the [units](unit) asked for; the rest draws: [`plot`] over two axes, [`space`] in three
//! dimensions, through plotters onto our own [`svg`] surface (plotters' own rounds to whole pixels and measures text in the page).

pub mod catalog;
pub mod identified;
pub mod plot;
pub mod space;
pub mod svg;
pub mod unit;
mod content;
mod sheet;
mod frame;
mod scale;
mod trace;

pub use catalog::{CATALOG, Entry, chart, charts_of, data};
pub use plot::{Chart, Options};
pub use unit::{ForceUnit, Units};
