//! Geometric Jacobian (thesis eqs. 3.23-3.40).
//!
//! Eq. 3.34 uses axis i-1 for joint i. With modified Denavit-Hartenberg frames joint i turns about
//! z_i, so the axes k_i and origins p_i are used here. Eqs. 3.35-3.40 agree with that, except for
//! the sign of J_4's x row.

use crate::math::Pose;
use crate::robot::{Elbow, Joints, Robot, forward};
use nalgebra::{Matrix6, Vector3, Vector6};

/// The 6x6 Jacobian of the TCP in the base frame, with respect to the controller's joint values:
/// rows v_x, v_y, v_z [m/rad], omega_x, omega_y, omega_z [1].
pub fn jacobian(robot: &Robot, q: &Joints) -> Matrix6<f64> {
    let (frames, tip) = frames_and_tip(robot, q);
    let mut j = columns(robot, frames.each_ref().map(|frame| turn(frame, &tip)));
    if robot.elbow() != Elbow::Serial {
        let coupled = j.column(2) * robot.elbow_coupling();
        j.set_column(1, &(j.column(1) + coupled));
    }
    j
}

/// The Jacobian of the joint springs, one column for each drive. Where a parallelogram holds the
/// forearm, the spring of joint 2 turns only the upper arm. Where joint 3 is merely measured from
/// the base, the springs are those of the serial arm.
pub fn spring_jacobian(robot: &Robot, q: &Joints) -> Matrix6<f64> {
    let (frames, tip) = frames_and_tip(robot, q);
    columns(robot, springs(robot, &frames, &tip))
}

/// The frames and the TCP's position.
fn frames_and_tip(robot: &Robot, q: &Joints) -> ([Pose; 6], Vector3<f64>) {
    let frames = forward::frames(robot, q);
    let tip = frames[5].compose(robot.tool()).position;
    (frames, tip)
}

/// The Jacobian from rotation and displacement per unit turn of each axis, with the joint signs
/// applied.
fn columns(robot: &Robot, parts: [(Vector3<f64>, Vector3<f64>); 6]) -> Matrix6<f64> {
    let mut j = Matrix6::zeros();
    for (i, (k, v)) in parts.into_iter().enumerate() {
        let (k, v) = (k * robot.links()[i].sign, v * robot.links()[i].sign);
        j.set_column(i, &Vector6::new(v.x, v.y, v.z, k.x, k.y, k.z));
    }
    j
}

/// Rotation [1] and displacement [m] of the point `tip` per unit turn about a frame's z axis.
pub(crate) fn turn(frame: &Pose, tip: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
    let k: Vector3<f64> = frame.rotation.column(2).into();
    (k, k.cross(&(tip - frame.position)))
}

/// Rotation [1] and displacement [m] of the point `tip` per unit turn of each spring about its
/// joint's axis, base frame.
pub(crate) fn springs(
    robot: &Robot,
    frames: &[Pose; 6],
    tip: &Vector3<f64>,
) -> [(Vector3<f64>, Vector3<f64>); 6] {
    let mut springs = frames.each_ref().map(|frame| turn(frame, tip));
    if robot.elbow() == Elbow::Parallelogram {
        let share = parallelogram_coupling(robot);
        let (k, v) = springs[2];
        springs[1].0 += k * share;
        springs[1].1 += v * share;
    }
    springs
}

/// Turn of axis 3, about its own direction, per unit turn of axis 2 while a parallelogram holds the
/// forearm; 0 without a parallelogram.
pub(crate) fn parallelogram_coupling(robot: &Robot) -> f64 {
    let [_, second, third, ..] = robot.links();
    if robot.elbow() == Elbow::Parallelogram {
        robot.elbow_coupling() * second.sign * third.sign
    } else {
        0.0
    }
}

/// Each joint's axis k_i and the lever from it to the point `tip`, both in the base frame (eq.
/// 3.34, corrected).
pub(crate) fn levers(frames: &[Pose; 6], tip: &Vector3<f64>) -> [(Vector3<f64>, Vector3<f64>); 6] {
    frames.each_ref().map(|frame| (frame.rotation.column(2).into_owned(), tip - frame.position))
}
