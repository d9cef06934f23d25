//! Forward kinematics: from joint values to the TCP (thesis eqs. 3.1-3.6).

use crate::math::{self, Pose};
use crate::robot::{Joints, Robot};
use nalgebra::{Matrix3, Vector3};

/// The frames 1 to 6 in the base frame for the joint values `q` [rad]: 0T1, 0T2, ... 0T6 (eqs. 3.1, 3.2).
pub fn frames(robot: &Robot, q: &Joints) -> [Pose; 6] {
    let q = robot.serial(q);
    let mut frames = [Pose::identity(); 6];
    let mut outer = Pose::identity();
    for (i, link) in robot.links().iter().enumerate() {
        let (sin_theta, cos_theta) = math::sin_cos(link.theta(q[i]));
        let (cos_alpha, sin_alpha) = robot.twists[i];
        // Eq. 3.1, multiplied out onto the columns of the outer frame.
        let rotation = outer.rotation;
        let (x, y, z) = (rotation.column(0), rotation.column(1), rotation.column(2));
        let y_turned: Vector3<f64> = y * cos_alpha + z * sin_alpha;
        let z_turned: Vector3<f64> = z * cos_alpha - y * sin_alpha;
        let position = outer.position + x * link.a + z_turned * link.d;
        let rotation = Matrix3::from_columns(&[
            x * cos_theta + y_turned * sin_theta,
            y_turned * cos_theta - x * sin_theta,
            z_turned,
        ]);
        outer = Pose { rotation, position };
        frames[i] = outer;
    }
    frames
}

/// The TCP in the base frame for the joint values `q` [rad] (eq. 3.2, then the tool on the flange).
pub fn forward(robot: &Robot, q: &Joints) -> Pose {
    frames(robot, q)[5].compose(robot.tool())
}
