//! What a measured pass teaches: how to command the next one, and how stiff the arm and how hard the material really is.
//!
//! A [`Log`](log::Log) of positions, deviations, forces, joint angles or probed points is laid over the run that it was
//! measured on ([`alignment`]), and becomes an error at each sample ([`measured`]). From that follow
//!
//! - the command of the next pass ([`next_pass`]): iterative learning, which needs no model of the error, only that it
//!   comes back;
//! - factors on the joint compliances and on the cutting forces ([`factors`]), with the intervals that are left to them;
//! - what the model does not explain even then ([`summary`]).
//!
//! A dynamometer's means over several feeds give the cutting coefficients themselves ([`dynamometer`]).

pub mod alignment;
pub mod correction;
pub mod dynamometer;
pub mod factors;
pub mod frame;
pub mod log;
pub mod low_pass;
pub mod measured;
pub mod next_pass;
pub mod summary;
mod columns;

pub use alignment::Alignment;
pub use correction::LearnedCorrection;
pub use factors::LearnedFactors;
pub use log::Log;
pub use measured::{Commanded, MeasuredPass, PassOptions};
pub use next_pass::{LearningGain, NextPass};
pub use summary::LearnSummary;
