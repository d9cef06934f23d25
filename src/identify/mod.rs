//! Joint springs and vibration of a robot, identified from measurements.
//!
//! [`stiffness`] fits the six joint compliances to loaded poses ([`measurement`]) by non-negative
//! least squares ([`nnls`]); [`response`] fits frequency and damping to a measured step or impact
//! response. Both state how far to trust their results.

pub mod gear;
pub mod measurement;
pub mod nnls;
pub mod stiffness;
pub mod response;
pub mod student;
pub mod summary;
pub mod trials;
pub(crate) mod least_squares;
mod eigen;
pub(crate) mod table;

pub use measurement::{Convention, Measurement};
pub use response::Mode;
pub use stiffness::Fit;
