//! Compliance of the arm: joint springs seen at the tool tip (thesis eqs. 3.41-3.50).

use crate::math::Pose;
use crate::robot::equilibrium::equilibrium;
use crate::robot::{Elbow, Joints, Robot, jacobian};
use nalgebra::{Matrix6, Vector3};

/// Cartesian compliance C_x = J C_theta J^T (eq. 3.48), 6x6, in the base frame: translations [m]
/// and rotations [rad] of the TCP from forces [N] and moments [N m] on it.
pub fn cartesian_compliance(robot: &Robot, q: &Joints) -> Matrix6<f64> {
    let j = jacobian::spring_jacobian(robot, q);
    j * Matrix6::from_diagonal(robot.compliance()) * j.transpose()
}

/// Displacement [m] and rotation [rad] of the TCP under the force `force` [N] on it, all in the
/// base frame (eqs. 3.47, 4.8-4.10).
///
/// Equal to the first three columns of [`cartesian_compliance`] times the force, without building
/// the matrix.
pub(crate) fn deflection(
    robot: &Robot,
    q: &Joints,
    frames: &[Pose; 6],
    tip: &Vector3<f64>,
    force: &Vector3<f64>,
) -> (Vector3<f64>, Vector3<f64>) {
    let (mut displacement, mut rotation) = (Vector3::zeros(), Vector3::zeros());
    if robot.statics().is_none() && robot.elbow() != Elbow::Parallelogram {
        // The usual arm needs no array of its joints: this runs for every sample of every pass.
        for (frame, c) in frames.iter().zip(robot.compliance().iter()) {
            let (k, v) = jacobian::turn(frame, tip);
            let turned = c * v.dot(force);
            displacement += v * turned;
            rotation += k * turned;
        }
        return (displacement, rotation);
    }
    for (moved, turned) in by_joint(robot, q, frames, tip, force) {
        displacement += moved;
        rotation += turned;
    }
    (displacement, rotation)
}

/// Contribution of each joint's spring to [`deflection`]: J C_theta J^T F is the sum over the
/// joints of J_i c_i J_i^T F.
///
/// Joint torque tau_i = v_i . F (eq. 3.47), joint rotation c_i tau_i (eq. 3.42), so v_i c_i tau_i
/// and k_i c_i tau_i (eq. 3.41). With other springs or with weight, the joint rotations are those
/// of the [equilibrium](crate::robot::equilibrium), minus the sag where the part was touched off.
pub(crate) fn by_joint(
    robot: &Robot,
    q: &Joints,
    frames: &[Pose; 6],
    tip: &Vector3<f64>,
    force: &Vector3<f64>,
) -> [(Vector3<f64>, Vector3<f64>); 6] {
    if let Some(statics) = robot.statics() {
        let mut sag = robot.sag().iter();
        return equilibrium(robot, statics, q, force).parts.map(|(moved, turned)| {
            sag.next().map_or((moved, turned), |(zero, twist)| (moved - zero, turned - twist))
        });
    }
    let mut parts = jacobian::springs(robot, frames, tip);
    for (part, c) in parts.iter_mut().zip(robot.compliance().iter()) {
        let (k, v) = *part;
        let turned = c * v.dot(force);
        *part = (v * turned, k * turned);
    }
    parts
}
