//! How the arm gives way: joint springs seen at the tool tip (thesis eqs. 3.41-3.50).

use crate::math::Pose;
use crate::robot::{Joints, Robot, jacobian};
use nalgebra::{Matrix6, Vector3};

/// Cartesian compliance C_x = J C_theta J^T (eq. 3.48), 6x6, in the base frame:
/// translations [m] and rotations [rad] of the TCP from forces [N] and moments [N m] on it.
pub fn cartesian_compliance(robot: &Robot, q: &Joints) -> Matrix6<f64> {
    let j = jacobian::jacobian(robot, q);
    j * Matrix6::from_diagonal(robot.compliance()) * j.transpose()
}

/// Displacement of the TCP [m] under the force `force` [N] on it, both in the base frame (eqs. 3.47, 4.8-4.10).
///
/// The same as the translational block of [`cartesian_compliance`] times the force, without building the matrix:
/// joint torque tau_i = v_i . F (eq. 3.47), joint rotation c_i tau_i (eq. 3.42), displacement sum of v_i c_i tau_i (eq. 3.41).
pub(crate) fn deflection(
    robot: &Robot,
    frames: &[Pose; 6],
    tip: &Vector3<f64>,
    force: &Vector3<f64>,
) -> Vector3<f64> {
    let mut displacement = Vector3::zeros();
    for (i, (k, lever)) in jacobian::levers(frames, tip).into_iter().enumerate() {
        let v = k.cross(&lever);
        displacement += v * (robot.compliance()[i] * v.dot(force));
    }
    displacement
}
