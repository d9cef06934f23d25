//! Where to put the part: a map of the error at each place, a first place in front of the robot, and the
//! best one there.

mod drawn;
mod in_front;
mod map;
mod part;
mod sought;

pub use in_front::{in_front, in_front_of};
pub use map::{Place, PlacementMap, PlacementStatus, STATIONS};
pub use part::{PartBox, RobotBase};
pub use sought::{SoughtPlace, sought};
