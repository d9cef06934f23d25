//! What gives way: deflection by cutting forces, distortion by the input shaper, and the contour error of both.

pub mod contour;
pub mod source;

pub use source::{Deviation, Parted, Passage, Plan, Source, Sources, deviate, deviate_apart, deviate_with};
