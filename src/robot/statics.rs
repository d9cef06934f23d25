//! What loads the joints at rest and how their springs give way to it.

use crate::robot::{Load, Spring};
use nalgebra::Vector3;

/// Springs and weight of an arm, where they are more than six compliances.
#[derive(Debug, Clone, PartialEq)]
pub struct JointStatics {
    /// One for each joint.
    pub springs: [Spring; 6],
    /// What the joints carry.
    pub loads: Vec<Load>,
    /// Acceleration of gravity in the base frame [m/s^2].
    pub gravity: Vector3<f64>,
    /// Whether the sag at the start of the path is no error: the workpiece was touched off there.
    pub touched_off: bool,
}
