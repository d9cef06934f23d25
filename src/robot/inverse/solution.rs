//! Joint values for a pose, with their branch, their distance from singularities, and the check by
//! the forward model.

use crate::error::Error;
use crate::math::Pose;
use crate::robot::{Joints, Robot, forward};
use crate::units::MM;

/// Which of the eight arm configurations: each field is one sign of the closed form.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Branch {
    /// The arm faces the wrist centre (eq. 3.13, upper sign); `false`: it reaches over backwards.
    pub front: bool,
    /// The elbow angle, measured from the stretched arm, is positive (eq. 3.15, upper sign; on the
    /// RX-90 it is q3).
    pub elbow_positive: bool,
    /// sin(q5) has the sign of eq. 3.20 with its upper sign; the other wrist is turned by 180
    /// degrees.
    pub wrist_positive: bool,
}

/// One set of joint values that puts the TCP at the requested pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solution {
    /// Joint values [rad].
    pub q: Joints,
    /// The branch they belong to.
    pub branch: Branch,
    /// How far the pose is from each singularity.
    pub margin: Margin,
}

/// Distance from the three singularities of the family; zero is singular.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Margin {
    /// Distance of the wrist centre from the plane through axis 1 along axis 2 [m]: shoulder.
    pub shoulder: f64,
    /// |sin| of the elbow angle: 0 where the arm is stretched or folded.
    pub elbow: f64,
    /// |sin q5|: 0 where axes 4 and 6 are in line.
    pub wrist: f64,
}

/// Up to eight solutions, without allocation.
#[derive(Debug, Clone, Copy)]
pub struct Solutions {
    all: [Option<Solution>; 8],
}

impl Solutions {
    pub(super) fn none() -> Self {
        Self { all: [None; 8] }
    }

    /// Adds a solution; returns whether there was room for it.
    pub(super) fn add(&mut self, solution: Solution) -> bool {
        match self.all.iter_mut().find(|slot| slot.is_none()) {
            Some(slot) => {
                *slot = Some(solution);
                true
            }
            None => false,
        }
    }

    /// The solutions, in the order front/back, elbow +/-, wrist +/-.
    pub fn iter(&self) -> impl Iterator<Item = &Solution> {
        self.all.iter().flatten()
    }

    /// The solution nearest to `q` in joint space (smallest sum of squared differences).
    pub fn nearest(&self, q: &Joints) -> Option<&Solution> {
        self.iter().min_by(|a, b| (a.q - q).norm_squared().total_cmp(&(b.q - q).norm_squared()))
    }
}

/// Largest position error that a solution may have in the forward model [m]; for rotation matrices
/// the same number without a unit.
pub(super) const CLOSURE: f64 = 1e-9;

/// Whether the forward model puts the TCP at the requested pose.
pub(super) fn closes(robot: &Robot, tcp: &Pose, q: &Joints) -> bool {
    is_near(tcp, &forward::forward(robot, q))
}

/// Whether the pose reached is the requested one.
pub(super) fn is_near(tcp: &Pose, reached: &Pose) -> bool {
    (reached.position - tcp.position).norm() <= CLOSURE && (reached.rotation - tcp.rotation).norm() <= CLOSURE
}

/// A position in words, for messages.
pub(super) fn place_mm(tcp: &Pose) -> String {
    let [x, y, z] = [tcp.position.x, tcp.position.y, tcp.position.z].map(|v| v / MM);
    format!("at ({x:.1}, {y:.1}, {z:.1}) mm in the base frame")
}

/// The error for a wrist centre at `distance` [m], with the arm's smallest and largest reach [m].
pub(super) fn unreachable(tcp: &Pose, distance: f64, (reach_min, reach_max): (f64, f64)) -> Error {
    let position = [tcp.position.x, tcp.position.y, tcp.position.z];
    Error::Unreachable { sample: None, arc_length: None, position, distance, reach_min, reach_max }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn a_pose_is_near_in_position_and_in_rotation() {
        let at = |x: f64, turn: f64| Pose::from_xyz_rpy(Vector3::new(x, 0.0, 0.0), [turn, 0.0, 0.0]);
        let near = |x: f64, turn: f64| is_near(&at(0.1, 0.2), &at(0.1 + x, 0.2 + turn));
        assert!(near(1e-10, 1e-10) && !near(1e-8, 0.0) && !near(0.0, 1e-8));
    }
}
