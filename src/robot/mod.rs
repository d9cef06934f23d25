//! The robot: its kinematics and its compliance (thesis chapter 3).
//!
//! [`Robot`] is the geometry (modified Denavit-Hartenberg) with the compliance of its joints;
//! [`forward`](forward::forward) and [`inverse`](inverse::inverse) kinematics, the
//! [Jacobian](jacobian::jacobian) and the [Cartesian compliance](compliance::cartesian_compliance)
//! follow from it.

pub mod model;
pub mod opw;
pub mod forward;
pub mod inverse;
pub mod jacobian;
pub mod compliance;
pub mod spring;
pub mod load;
pub mod statics;
pub mod equilibrium;
pub mod world;
pub mod library;

pub use load::Load;
pub use model::{Elbow, Joints, Link, Robot};
pub use opw::Opw;
pub use spring::Spring;
pub use statics::JointStatics;
pub use world::World;
