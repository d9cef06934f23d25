//! What pushes: milling forces from tool, material and engagement (thesis section 4.2), and their direction along the path (eq. 4.11).

pub mod material;
pub mod force;
pub mod along;

pub use force::{Cut, MeanForce};
pub use material::Coefficients;
