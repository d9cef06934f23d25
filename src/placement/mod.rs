//! Where to put the part: a map of the error at each place, and a first place in front of the
//! robot.

mod in_front;
mod map;

pub use in_front::{in_front, in_front_of};
pub use map::{Place, PlacementMap, PlacementStatus, STATIONS};
