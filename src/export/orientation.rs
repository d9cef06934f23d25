//! Orientations as controllers write them, from a rotation matrix.

use crate::math;
use nalgebra::Matrix3;

/// Roll, pitch and yaw [rad] about the fixed x, y and z axes in this order: R = Rz(yaw) Ry(pitch)
/// Rx(roll), as in [`Pose::from_xyz_rpy`](crate::math::Pose::from_xyz_rpy).
///
/// FANUC's W, P, R are these; KUKA's C, B, A too, since turning about z, then the new y, then the
/// new x is the same. Where pitch is +-90 deg and roll and yaw turn about the same line, any split
/// between them is correct; the result still multiplies back to R.
pub fn roll_pitch_yaw(r: &Matrix3<f64>) -> [f64; 3] {
    let yaw = math::atan2(r[(1, 0)], r[(0, 0)]);
    let pitch = math::atan2(-r[(2, 0)], math::hypot(r[(0, 0)], r[(1, 0)]));
    // Roll is computed after undoing yaw, so that it is consistent with the yaw found.
    let (sin, cos) = math::sin_cos(yaw);
    let roll = math::atan2(sin * r[(0, 2)] - cos * r[(1, 2)], cos * r[(1, 1)] - sin * r[(0, 1)]);
    [roll, pitch, yaw]
}

/// Rotations [rad] about x, then the new y, then the new z: R = Rx Ry Rz (Staubli's rx, ry, rz).
pub fn about_moving_xyz(r: &Matrix3<f64>) -> [f64; 3] {
    // The transpose is Rz(-rz) Ry(-ry) Rx(-rx).
    roll_pitch_yaw(&r.transpose()).map(|angle| -angle)
}

/// Unit quaternion, scalar first (ABB's q1 to q4), by the method of Shepperd ("Quaternion from
/// rotation matrix", Journal of Guidance and Control 1(3), 1978): the largest component is taken by
/// its root, the others by division.
pub fn quaternion(r: &Matrix3<f64>) -> [f64; 4] {
    let trace = r.trace();
    let squares = [trace, r[(0, 0)], r[(1, 1)], r[(2, 2)]];
    let mut largest = 0;
    for i in 1..4 {
        if squares[i] > squares[largest] {
            largest = i;
        }
    }
    let mut q = [0.0; 4];
    if largest == 0 {
        let double = (1.0 + trace).sqrt();
        q[0] = double / 2.0;
        q[1] = (r[(2, 1)] - r[(1, 2)]) / (2.0 * double);
        q[2] = (r[(0, 2)] - r[(2, 0)]) / (2.0 * double);
        q[3] = (r[(1, 0)] - r[(0, 1)]) / (2.0 * double);
    } else {
        let i = largest - 1;
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let double = (1.0 + 2.0 * r[(i, i)] - trace).sqrt();
        q[0] = (r[(k, j)] - r[(j, k)]) / (2.0 * double);
        q[1 + i] = double / 2.0;
        q[1 + j] = (r[(i, j)] + r[(j, i)]) / (2.0 * double);
        q[1 + k] = (r[(i, k)] + r[(k, i)]) / (2.0 * double);
    }
    q
}
