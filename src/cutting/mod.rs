//! Milling forces from tool, material and engagement (thesis section 4.2), and their direction
//! along the path (eq. 4.11).

pub mod material;
pub mod kienzle;
pub mod oblique;
pub mod engagement;
pub mod tool;
pub mod force;
pub mod peak;
pub mod spindle;
pub mod largest_chip;
pub mod surface;
pub mod run_in;
pub mod load;
pub mod in_stock;
pub mod mean_forces;
pub mod stiffness;
pub mod constant_force;
pub mod along;

pub use constant_force::{ConstantForceFeed, CutAlong};
pub use engagement::Engagement;
pub use force::{Cut, LinearForce};
pub use in_stock::PlaceFigures;
pub use kienzle::Kienzle;
pub use load::{ChipLoad, CutLoad, Loading, Loads};
pub use material::Coefficients;
pub use mean_forces::{HeaviestPlace, MeanForces, PartForces};
pub use stiffness::{CutStiffness, StiffnessAlong};
pub use tool::{Bending, Hand};
