//! Motion in time: speed along the path, trajectory, joint trajectory and input shaper.

pub mod profile;
pub mod course;
pub mod trajectory;
pub mod shaper;
pub mod joints;
pub mod turns;
pub mod roll;

pub use profile::Profile;
pub use shaper::Shaper;
pub use trajectory::{TimingLaw, Trajectory};
