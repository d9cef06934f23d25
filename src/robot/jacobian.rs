//! Geometric Jacobian (thesis eqs. 3.23-3.40).
//!
//! Eq. 3.34 takes axis i-1 for joint i; with modified Denavit-Hartenberg frames joint i turns about z_i,
//! so the axes k_i and origins p_i are used. Eqs. 3.35-3.40 agree with that, but for the sign of J_4's x row.

use crate::math::Pose;
use crate::robot::{Joints, Robot, forward};
use nalgebra::{Matrix6, Vector3, Vector6};

/// The 6x6 Jacobian of the TCP in the base frame: rows v_x, v_y, v_z [m/rad], omega_x, omega_y, omega_z [1].
pub fn jacobian(robot: &Robot, q: &Joints) -> Matrix6<f64> {
    let frames = forward::frames(robot, q);
    let tcp = frames[5].compose(robot.tool()).position;
    let mut j = Matrix6::zeros();
    for (i, (k, lever)) in levers(&frames, &tcp).into_iter().enumerate() {
        let k = k * robot.links()[i].sign;
        let v = k.cross(&lever);
        j.set_column(i, &Vector6::new(v.x, v.y, v.z, k.x, k.y, k.z));
    }
    j
}

/// Each joint's axis k_i and the lever from it to the point `tip`, both in the base frame (eq. 3.34, corrected).
pub(crate) fn levers(frames: &[Pose; 6], tip: &Vector3<f64>) -> [(Vector3<f64>, Vector3<f64>); 6] {
    frames.each_ref().map(|frame| (frame.rotation.column(2).into_owned(), tip - frame.position))
}
