//! The arm's posture at the points of a program, from which each controller's own words for it follow.

use crate::error::Error;
use crate::export::command::Command;
use crate::report::Report;
use crate::robot::{Joints, Robot, forward, inverse};
use nalgebra::Vector3;

/// Joint values at the start of a command and at the end of each of its steps [rad], each set the
/// nearest to the one before; the first, to the start of the simulated motion.
///
/// # Errors
/// See [`inverse::inverse`].
pub fn joints(report: &Report, command: &Command) -> Result<Vec<Joints>, Error> {
    let robot = &report.plan.robot;
    let mut near = report.compensation.q[0];
    let points = command.moves.iter().flat_map(|commanded| commanded.points());
    let mut all = Vec::with_capacity(command.points());
    for point in std::iter::once(&command.start).chain(points) {
        let tcp = report.setup().workpiece.compose(&command.pose(point));
        near = inverse::inverse(robot, &tcp, &near)?.nearest(&near).map_or(near, |solution| solution.q);
        all.push(near);
    }
    Ok(all)
}

/// Which of the arm's shapes it is in, seen in the plane of its upper arm and forearm.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Posture {
    /// The wrist centre is behind axis 1, seen along the arm.
    pub behind: bool,
    /// The wrist centre is in front of the line through axes 2 and 3.
    pub bent_forward: bool,
    /// Joint 5 is negative.
    pub wrist_negative: bool,
}

impl Posture {
    /// For the joint values `q` [rad].
    pub fn of(robot: &Robot, q: &Joints) -> Self {
        let frames = forward::frames(robot, q);
        let ahead: Vector3<f64> = frames[0].rotation.column(0).into();
        let [foot, shoulder, elbow, wrist] = [0, 1, 2, 3].map(|i| frames[i].position);
        let in_plane = |v: Vector3<f64>| (v.dot(&ahead), v.z);
        let (upper, fore) = (in_plane(elbow - shoulder), in_plane(wrist - elbow));
        Self {
            behind: (wrist - foot).dot(&ahead) < 0.0,
            bent_forward: upper.1 * fore.0 - upper.0 * fore.1 > 0.0,
            wrist_negative: q[4] < 0.0,
        }
    }
}

/// Turns of an axis at an angle [deg]: 0 from -180 to 180, 1 to 540, and so on.
pub fn turns(angle: f64) -> i32 {
    let whole = ((angle.abs() + 180.0) / 360.0).floor() as i32;
    if angle < 0.0 { -whole } else { whole }
}
