//! Armill predicts where the tool tip of a milling robot really goes: cutting forces bend the arm,
//! and command shaping bends the path. It returns the path to command instead, so that the part
//! comes out right.
//!
//! A path point travels one way, through the modules in this order:
//!
//! ```text
//! Job ─► Path ─► Trajectory ─► JointTrajectory ─► Forces ─► Deviation ─► Compensation ─► Report
//!       (where)  (when)       (which joints,     (cutting  (deflection, (what to
//!                              shaped)            forces)   contour      command)
//!                                                           error)
//! ```
//!
//! Charts and files are made from the report. Inside, everything is in SI; text and files carry the
//! unit in the name. "Thesis" in these pages is *Modelling and Compensation of Positioning Errors
//! in Robotic Machining Systems*; equation numbers refer to it.
//!
//! ```
//! let report = armill::run(&armill::Job::default(), &mut armill::Progress::none())?;
//! assert!(report.summary().after_mm.max < 0.05 && report.summary().before_mm.both.max > 1.0);
//! # Ok::<(), armill::Error>(())
//! ```
//!
//! Try it here:
//!
//! <script type="module" src="../../calculator/js/armill-calculator.js"></script>
//! <armill-calculator inputs="motion shaper" charts="before-after">
//! The calculator shows here in pages made by `cargo xtask docs`, once they are served: a browser
//! loads no module from disk.
//! </armill-calculator>

#[doc = include_str!("../README.md")]
#[cfg(doctest)]
pub struct Readme;

pub mod math;
pub mod units;
pub mod spread;
pub mod model;
pub mod error;
pub mod column;
pub mod progress;
pub mod at_once;
pub mod robot;
pub mod path;
pub mod motion;
pub mod stock;
pub mod cutting;
pub mod job;
pub mod setup;
pub mod plan;
pub mod deviation;
pub mod compensation;
pub mod uncertainty;
pub mod surface;
pub mod online;
pub mod report;
pub mod placement;
pub mod simulation;
pub mod study;
pub mod identify;
pub mod learn;
pub mod evidence;
pub mod chart;
pub mod export;
pub mod verification;
#[cfg(target_arch = "wasm32")]
pub mod wasm;

pub use error::Error;
pub use job::Job;
pub use progress::{Progress, Stage};
pub use report::Report;
pub use simulation::{run, run_json};
