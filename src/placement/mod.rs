//! Where to put the part: a map of the error at each place, and a first place in front of the
//! robot.

mod drawn;
mod in_front;
mod map;
mod part;

pub use in_front::{in_front, in_front_of};
pub use map::{Place, PlacementMap, PlacementStatus, STATIONS};
pub use part::{PartBox, RobotBase};
