//! Static equilibrium of the joints under force and weight, for springs that are not linear.
//!
//! The torques depend on the deflected pose, so the rotations are iterated until they no longer
//! change: each pass applies the last rotations to the arm and evaluates the springs again. A pass
//! shrinks the error by about compliance x force x reach (1e-3 for a milling robot), so a few are
//! enough. An arm too soft to settle is reported as not converged.

use crate::math::Pose;
use crate::robot::{Elbow, JointStatics, Joints, Robot, forward, jacobian, load};
use nalgebra::Vector3;

/// Joint rotations at which springs, force and weight are in balance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equilibrium {
    /// Rotation of each joint about its axis [rad].
    pub turns: [f64; 6],
    /// Displacement [m] and rotation [rad] of the TCP by each joint, base frame. Their sum takes
    /// the TCP to where the rotated joints put it.
    pub parts: [(Vector3<f64>, Vector3<f64>); 6],
    /// Number of passes.
    pub passes: usize,
    /// Largest change of a rotation in the last pass [rad].
    pub residual: f64,
    /// Whether the residual is at most [`SETTLED`].
    pub converged: bool,
}

/// Residual that ends the iteration [rad]: a nanometre at a kilometre.
pub const SETTLED: f64 = 1e-12;
/// Maximum number of passes.
const ROUNDS: usize = 60;

/// The arm in its equilibrium with its levers held: what is left is linear but for the springs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldArm {
    /// Lever of a force on the TCP about each joint in the deflected pose [m].
    pub levers: [Vector3<f64>; 6],
    /// Torque of the weight about each joint there [N m].
    pub weight: [f64; 6],
    /// Rotation [1] and displacement [m] of the TCP per unit turn of each joint, half way.
    pub moves: [(Vector3<f64>, Vector3<f64>); 6],
}

/// The equilibrium for joint commands `q` [rad] and a force on the TCP [N], base frame.
pub fn equilibrium(robot: &Robot, statics: &JointStatics, q: &Joints, force: &Vector3<f64>) -> Equilibrium {
    let bent = |turns: &[f64; 6], share: f64| bent(robot, q, turns, share);
    let mut turns = [0.0; 6];
    let (mut passes, mut residual) = (0, f64::INFINITY);
    while residual > SETTLED && passes < ROUNDS {
        let (frames, tip) = bent(&turns, 1.0);
        let weight = weight(robot, statics, &frames);
        let mut next = [0.0; 6];
        for (joint, (_, v)) in jacobian::springs(robot, &frames, &tip).into_iter().enumerate() {
            // Eq. 3.47 with the weight added.
            next[joint] = statics.springs[joint].turn(v.dot(force) + weight[joint]);
        }
        residual = (0..6).map(|i| (next[i] - turns[i]).abs()).fold(0.0, f64::max);
        turns = next;
        passes += 1;
    }
    // Half way, the levers are the mean of those before and after, so the sum over the joints is
    // exact to the third power of the rotations.
    let (frames, tip) = bent(&turns, 0.5);
    let mut joint = turns.iter();
    let parts = jacobian::springs(robot, &frames, &tip).map(|(k, v)| {
        let turn = joint.next().copied().unwrap_or_default();
        (v * turn, k * turn)
    });
    Equilibrium { turns, parts, passes, residual, converged: residual <= SETTLED }
}

/// The arm with its levers held as they are in the equilibrium under `force` [N].
pub fn held(robot: &Robot, statics: &JointStatics, q: &Joints, force: &Vector3<f64>) -> HeldArm {
    let Equilibrium { turns, .. } = equilibrium(robot, statics, q, force);
    let (frames, tip) = bent(robot, q, &turns, 1.0);
    let (half, half_tip) = bent(robot, q, &turns, 0.5);
    HeldArm {
        levers: jacobian::springs(robot, &frames, &tip).map(|(_, v)| v),
        weight: weight(robot, statics, &frames),
        moves: jacobian::springs(robot, &half, &half_tip),
    }
}

/// Frames and tip with a share of the joint rotations applied.
fn bent(robot: &Robot, q: &Joints, turns: &[f64; 6], share: f64) -> ([Pose; 6], Vector3<f64>) {
    let turned = Joints::from_fn(|i, _| robot.links()[i].sign * turns[i] * share);
    // A parallelogram's springs turn the controller's joint values; other springs turn those of the
    // serial arm.
    let q = if robot.elbow() == Elbow::Pendant { q + robot.to_controller(&turned) } else { q + turned };
    let frames = forward::frames(robot, &q);
    let tip = frames[5].compose(robot.tool()).position;
    (frames, tip)
}

/// Torque of the weight about each spring [N m].
fn weight(robot: &Robot, statics: &JointStatics, frames: &[Pose; 6]) -> [f64; 6] {
    let mut weight = load::torques(frames, &statics.loads, &statics.gravity);
    weight[1] += weight[2] * jacobian::parallelogram_coupling(robot);
    weight
}
