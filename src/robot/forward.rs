//! Forward kinematics: from joint values to the TCP (thesis eqs. 3.1-3.6).

use crate::math::{Pose, Turn};
use crate::robot::{Joints, Robot};
use nalgebra::{Matrix3, Vector3};

/// The frames 1 to 6 in the base frame for the joint values `q` [rad]: 0T1, 0T2, ... 0T6 (eqs. 3.1,
/// 3.2).
pub fn frames(robot: &Robot, q: &Joints) -> [Pose; 6] {
    let q = robot.to_serial(q);
    let mut frame = Pose::identity();
    std::array::from_fn(|i| {
        frame = next(robot, i, &frame, Turn::of(robot.links()[i].theta(q[i])));
        frame
    })
}

/// The frame after the link `i` (from 0), from its angle theta about z.
// WebAssembly copies a frame twice when a call returns it, which takes as long as computing it.
#[inline(always)]
pub(crate) fn next(robot: &Robot, i: usize, outer: &Pose, theta: Turn) -> Pose {
    let link = &robot.links()[i];
    let rotation = turned(&outer.rotation, robot.twists[i], theta);
    let position = outer.position + outer.rotation.column(0) * link.a + rotation.column(2) * link.d;
    Pose { rotation, position }
}

/// The rotation after one more link, from its twist (cosine, sine) about x and its angle about z:
/// eq. 3.1, multiplied out by columns.
pub(crate) fn turned(outer: &Matrix3<f64>, (cos_alpha, sin_alpha): (f64, f64), theta: Turn) -> Matrix3<f64> {
    let (x, y, z) = (outer.column(0), outer.column(1), outer.column(2));
    let y_turned: Vector3<f64> = y * cos_alpha + z * sin_alpha;
    let z_turned: Vector3<f64> = z * cos_alpha - y * sin_alpha;
    let x_new: Vector3<f64> = x * theta.cos + y_turned * theta.sin;
    let y_new: Vector3<f64> = y_turned * theta.cos - x * theta.sin;
    Matrix3::from([x_new.into(), y_new.into(), z_turned.into()])
}

/// The TCP in the base frame for the joint values `q` [rad] (eq. 3.2, then the tool on the flange).
pub fn forward(robot: &Robot, q: &Joints) -> Pose {
    frames(robot, q)[5].compose(robot.tool())
}
