//! What a robot's springs and vibration are, from measurements on it.
//!
//! [`stiffness`] fits the six joint compliances to loaded poses ([`measurement`]) by non-negative least squares ([`nnls`]);
//! [`response`] fits frequency and damping to a measured step or impact response. Both say how far their numbers go.

pub mod measurement;
pub mod nnls;
pub mod stiffness;
pub mod response;
pub mod student;
pub mod summary;
mod eigen;
mod table;

pub use measurement::{Convention, Measurement};
pub use response::Mode;
pub use stiffness::Fit;
