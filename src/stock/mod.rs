//! The stock: what is left of it along a path, and where the tool is in it.
//!
//! The tool axis is the workpiece's z axis. At each height a tool that is cylindrical there has
//! cleared all points within its radius of where it was at that height or below. What it meets is
//! thus the part of a circle about its axis that lies in the solid and in no earlier move: exact for
//! lines and arcs at a height, and by layers along ramps. A path that mostly climbs and dives is
//! followed on a map of heights instead.
//!
//! Left of `cutting`: nothing here knows a force.

pub mod solid;
mod circle;
mod swept;
mod strokes;
mod grid;
pub mod contact;
mod pieces;
mod holder;
mod place;
mod height_map;
mod mapped;
mod along;
mod blank;
mod remaining;

pub use along::{Earlier, contacts};
pub use blank::Blank;
pub use contact::{Collider, Collision, Contact, Contacts, FloorArc, SideArc};
pub use height_map::{HeightMap, Stamp};
pub use holder::{Holder, with_holder};
pub use place::Cutter;
pub use remaining::Remaining;
pub use solid::{Outline, Solid};
