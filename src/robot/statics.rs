//! Static loads on the joints, and the springs that yield to them.

use crate::robot::{Load, Spring};
use nalgebra::Vector3;

/// Springs and weight of an arm that takes more than six compliances to describe.
#[derive(Debug, Clone, PartialEq)]
pub struct JointStatics {
    /// One spring for each joint.
    pub springs: [Spring; 6],
    /// Masses that the joints carry.
    pub loads: Vec<Load>,
    /// Acceleration of gravity in the base frame [m/s^2].
    pub gravity: Vector3<f64>,
    /// Whether the workpiece was touched off at the start of the path, so that the sag there is no
    /// error.
    pub touched_off: bool,
}
