//! Inverse kinematics in closed form (thesis eqs. 3.9-3.21) for every arm of the RX-90's family.
//!
//! Two shoulders (the arm faces the point or turns its back), two elbows and two wrists give up to eight solutions.
//! The thesis's eqs. 3.13-3.21 have misprinted arc tangents; the derivation here follows the same steps
//! with the twist signs and the offsets a_1, a_3 and b kept as parameters. Other arms are solved numerically, with the same answers.

use crate::error::Error;
use crate::math::{self, PI, Pose, Turn};
use crate::robot::model::Geometry;
use crate::robot::{Joints, Robot, forward, numerical};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::FRAC_PI_4;

/// Which of the eight arms: each field picks one sign in the closed form.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Branch {
    /// The arm faces the wrist centre (eq. 3.13, upper sign); `false`: it reaches over its back.
    pub front: bool,
    /// The elbow angle, from the stretched arm, is positive (eq. 3.15, upper sign; on the RX-90 it is q3).
    pub elbow_positive: bool,
    /// sin(q5) has the sign that makes `wrist_positive` (eq. 3.20, upper sign); the other wrist is turned by 180 degrees.
    pub wrist_positive: bool,
}

/// One set of joint values that puts the TCP where it was asked for.
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
    pub(crate) fn none() -> Self {
        Self { all: [None; 8] }
    }

    /// Whether there was room for another one.
    pub(crate) fn add(&mut self, solution: Solution) -> bool {
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

/// Position error that a solution may show when it is put back into the forward model [m]; rotations: the same number, no unit.
const CLOSURE: f64 = 1e-9;
/// |sin q5| below which only the sum of q4 and q6 is determined.
const WRIST_SINGULAR: f64 = 1e-10;

const NUMERICAL: &str = "an arm without a closed form";

/// All joint values that put the TCP at `tcp` (base frame); each is checked by the forward model (1e-9 m, 1e-9).
///
/// Each angle is the one of its full turns that is nearest to `near` [rad]; at a wrist singularity q4 is taken from `near`.
///
/// # Errors
/// [`Error::Unreachable`] with the distance and the reach if no branch gets there; [`Error::Invalid`] if some do and none closes.
pub fn inverse(robot: &Robot, tcp: &Pose, near: &Joints) -> Result<Solutions, Error> {
    let solutions = match robot.geometry() {
        Ok(geometry) => {
            let mut solutions = Solutions::none();
            each(robot, geometry, tcp, near, None, &mut |solution| {
                solutions.add(solution);
            })?;
            solutions
        }
        Err(_) => {
            Error::unless_full(NUMERICAL)?;
            numerical::solutions(robot, tcp, near)?
        }
    };
    match solutions.iter().next() {
        Some(_) => Ok(solutions),
        None => Err(unclosed(tcp)),
    }
}

/// Whether the forward model puts the TCP where it was asked for.
pub(crate) fn closes(robot: &Robot, tcp: &Pose, q: &Joints) -> bool {
    is_near(tcp, &forward::forward(robot, q))
}

fn is_near(tcp: &Pose, reached: &Pose) -> bool {
    (reached.position - tcp.position).norm() <= CLOSURE && (reached.rotation - tcp.rotation).norm() <= CLOSURE
}

/// The solution on the branch `last` is on, if it is certain that no other branch comes nearer to it.
///
/// Another wrist turns q4 by half a turn; another elbow turns q3 by twice the elbow angle; another shoulder turns q1 by more than a
/// quarter turn where the wrist centre is further ahead than beside. What is less than half as far from `last` is the nearest.
pub(crate) fn continued(robot: &Robot, tcp: &Pose, last: &Solution) -> Option<Solution> {
    let Ok(geometry) = robot.geometry() else {
        Error::unless_full(NUMERICAL).ok()?;
        return numerical::continued(robot, tcp, last);
    };
    let mut found = None;
    each(robot, geometry, tcp, &last.q, Some(last.branch), &mut |solution| found = Some(solution)).ok()?;
    found.filter(|solution| {
        solution.margin.shoulder >= geometry.lateral.abs()
            && (solution.q - last.q).norm() < solution.margin.elbow.min(FRAC_PI_4)
    })
}

/// The closed form itself: calls `take` with the solution of every branch, or of one, that the forward model confirms.
///
/// Angles are carried as sines and cosines; what they are in radians is asked once, at the end.
fn each(
    robot: &Robot,
    g: &Geometry,
    tcp: &Pose,
    near: &Joints,
    only: Option<Branch>,
    take: &mut dyn FnMut(Solution),
) -> Result<(), Error> {
    let links = robot.links();
    let serial = robot.serial(near);
    let flange = tcp.compose(robot.flange());

    // Wrist centre (eq. 3.9), in frame 0 turned by alpha_0 and moved to axis 1.
    let wrist = flange.position - flange.rotation.column(2) * links[5].d;
    let (cos_0, sin_0) = robot.twists[0];
    let x = wrist.x - links[0].a;
    let y = cos_0 * wrist.y + sin_0 * wrist.z;
    let z = cos_0 * wrist.z - sin_0 * wrist.y - links[0].d;

    // Theta_1 (eq. 3.13): turned back by it, the wrist centre lies in the arm's plane, at `lateral` beside axis 1.
    let beside = -g.sin_1 * g.lateral;
    let radius_squared = x * x + y * y;
    let forward_squared = radius_squared - beside * beside;
    if forward_squared < -1e-12 {
        return Err(unreachable(tcp, radius_squared.sqrt(), (beside.abs(), f64::INFINITY)));
    }
    let forward_reach = forward_squared.max(0.0).sqrt();

    let mut reached = false;
    let mut nearest_miss: Option<f64> = None;
    for (front, sign) in [(true, 1.0), (false, -1.0)] {
        if only.is_some_and(|branch| branch.front != front) {
            continue;
        }
        let ahead = sign * forward_reach;
        let theta_1 = Turn::between((ahead, beside), (x, y));
        // The wrist centre in the plane of the arm, from axis 2.
        let (px, py) = (ahead - links[1].a, g.sin_1 * z);
        let distance_squared = px * px + py * py;

        // Theta_3 (eq. 3.15): the law of cosines between upper arm and forearm.
        let cos_elbow = (distance_squared - g.upper * g.upper - g.fore * g.fore) / (2.0 * g.upper * g.fore);
        if cos_elbow.abs() > 1.0 + 1e-12 {
            let distance = distance_squared.sqrt();
            let miss = |d: f64| if d > g.upper.abs() { d - robot.reach().1 } else { robot.reach().0 - d };
            if nearest_miss.is_none_or(|d| miss(distance) < miss(d)) {
                nearest_miss = Some(distance);
            }
            continue;
        }
        reached = true;
        let cos_elbow = cos_elbow.clamp(-1.0, 1.0);
        let sin_elbow = (1.0 - cos_elbow * cos_elbow).sqrt();
        let angle_1 = theta_1.angle();
        for (elbow_positive, sin_elbow) in [(true, sin_elbow), (false, -sin_elbow)] {
            if only.is_some_and(|branch| branch.elbow_positive != elbow_positive) {
                continue;
            }
            let theta_3 = Turn::between(g.fore_direction, (cos_elbow, sin_elbow));
            // Theta_2 (eq. 3.14): the direction to the wrist centre less the arm's own.
            let own = (g.upper + g.fore * cos_elbow, g.cos_2 * g.fore * sin_elbow);
            let theta_2 = Turn::between(own, (px, py));
            let arm = [theta_1, theta_2, theta_3].into_iter().enumerate();
            let arm = arm.fold(Pose::identity(), |outer, (i, theta)| forward::next(robot, i, &outer, theta));
            // Frame 3 turned by alpha_3, so that joint 4 turns about its z axis (eqs. 3.16-3.18, left side).
            let turned = forward::turned(&arm.rotation, robot.twists[3], Turn { sin: 0.0, cos: 1.0 });
            let angles = [angle_1, theta_2.angle(), theta_3.angle()];
            let (wrist, sin_wrist) = wrist_turns(robot, g, &(turned.transpose() * flange.rotation), near);
            let wrist_angles = wrist.map(Turn::angle);
            for wrist_positive in [true, false] {
                if only.is_some_and(|branch| branch.wrist_positive != wrist_positive) {
                    continue;
                }
                let [mut theta_4, mut theta_5, mut theta_6] = wrist;
                let mut theta =
                    [angles[0], angles[1], angles[2], wrist_angles[0], wrist_angles[1], wrist_angles[2]];
                // The other wrist: joints 4 and 6 half a turn on, joint 5 bent the other way.
                if !wrist_positive && sin_wrist > WRIST_SINGULAR {
                    theta_4 = Turn { sin: -theta_4.sin, cos: -theta_4.cos };
                    theta_5 = Turn { sin: -theta_5.sin, ..theta_5 };
                    theta_6 = Turn { sin: -theta_6.sin, cos: -theta_6.cos };
                    theta = [theta[0], theta[1], theta[2], theta[3] - PI, -theta[4], theta[5] - PI];
                }
                let hand = [theta_4, theta_5, theta_6].into_iter().enumerate();
                let reached = hand.fold(arm, |outer, (i, theta)| forward::next(robot, 3 + i, &outer, theta));
                if !is_near(tcp, &reached.compose(robot.tool())) {
                    continue;
                }
                let q = Joints::from_fn(|i, _| math::nearest_turn(links[i].joint(theta[i]), serial[i]));
                take(Solution {
                    q: robot.told(&q),
                    branch: Branch { front, elbow_positive, wrist_positive },
                    margin: Margin { shoulder: forward_reach, elbow: sin_elbow.abs(), wrist: sin_wrist },
                });
            }
        }
    }
    match nearest_miss {
        Some(distance) if !reached => Err(unreachable(tcp, distance, robot.reach())),
        _ => Ok(()),
    }
}

/// Theta_4, theta_5, theta_6 from M = Rz(theta_4) Rx(alpha_4) Rz(theta_5) Rx(alpha_5) Rz(theta_6) (eqs. 3.17-3.21) with the positive
/// wrist, and |sin theta_5|.
///
/// With alpha_5 = -alpha_4 the middle is Ry(b), b = -sin(alpha_4) theta_5, and M are Euler angles ZYZ;
/// with equal twists a half turn about x follows, which also turns theta_6 round.
fn wrist_turns(robot: &Robot, g: &Geometry, m: &Matrix3<f64>, near: &Joints) -> ([Turn; 3], f64) {
    let equal = g.sin_4 == g.sin_5;
    let m = if equal { m * Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0)) } else { *m };
    let sin_b = (m[(0, 2)] * m[(0, 2)] + m[(1, 2)] * m[(1, 2)]).sqrt();
    let theta_4 = if sin_b > WRIST_SINGULAR {
        Turn { sin: m[(1, 2)] / sin_b, cos: m[(0, 2)] / sin_b }
    } else {
        Turn::of(robot.links()[3].theta(near[3]))
    };
    // Rz(-theta_4) M = Ry(b) Rz(theta_6): exact whatever theta_4, so the pose closes near the singularity too.
    let Turn { sin: sin_4, cos: cos_4 } = theta_4;
    let ahead = (1.0, 0.0);
    let b = Turn::between(ahead, (m[(2, 2)], cos_4 * m[(0, 2)] + sin_4 * m[(1, 2)]));
    let across = (cos_4 * m[(1, 1)] - sin_4 * m[(0, 1)], cos_4 * m[(1, 0)] - sin_4 * m[(0, 0)]);
    let theta_6 = Turn::between(ahead, if equal { (across.0, -across.1) } else { across });
    ([theta_4, Turn { sin: -g.sin_4 * b.sin, ..b }, theta_6], sin_b)
}

/// The pose is within reach, but rounding keeps every branch from it.
pub(crate) fn unclosed(tcp: &Pose) -> Error {
    let expected = "no solution of the inverse model closes there; move the path a little";
    Error::invalid("path", place_mm(tcp), expected)
}

/// A place in words.
pub(crate) fn place_mm(tcp: &Pose) -> String {
    let [x, y, z] = [tcp.position.x, tcp.position.y, tcp.position.z].map(|v| v / crate::units::MM);
    format!("at ({x:.1}, {y:.1}, {z:.1}) mm in the base frame")
}

pub(crate) fn unreachable(tcp: &Pose, distance: f64, (reach_min, reach_max): (f64, f64)) -> Error {
    let position = [tcp.position.x, tcp.position.y, tcp.position.z];
    Error::Unreachable { sample: None, arc_length: None, position, distance, reach_min, reach_max }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::library;

    #[test]
    fn a_pose_is_near_in_position_and_in_rotation() {
        let at = |x: f64, turn: f64| Pose::from_xyz_rpy(Vector3::new(x, 0.0, 0.0), [turn, 0.0, 0.0]);
        let near = |x: f64, turn: f64| is_near(&at(0.1, 0.2), &at(0.1 + x, 0.2 + turn));
        assert!(near(1e-10, 1e-10) && !near(1e-8, 0.0) && !near(0.0, 1e-8));
    }

    #[test]
    fn what_continues_is_the_nearest_of_all() {
        // Steps of up to 9 cm, with the wrist near axis 1, where another shoulder may be nearer; the second arm's plane lies beside that axis.
        for id in ["staubli-rx90", "staubli-tx90"] {
            let preset = library::robot(id).unwrap();
            let robot = Robot::new(id, preset.links(), None, [0.0; 6]).unwrap();
            let (mut certain, mut open) = (0, 0);
            for k in 0..1000 {
                let share = |n: u32| f64::from(k * n % 1009) / 1009.0;
                let around = |n: u32, size: f64| size * (share(n) - 0.5);
                let place = Vector3::new(around(17, 0.2), around(19, 0.2), 1.0 + around(13, 0.2));
                let from = Pose::from_xyz_rpy(place, [3.0 * share(5), 1.5 * share(7), 6.0 * share(11)]);
                let step = Vector3::new(around(23, 0.1), around(29, 0.1), around(31, 0.1)) * share(37);
                let to = Pose { position: place + step, ..from };
                // The arm that stands beside axis 1 does not reach it.
                let Ok(before) = inverse(&robot, &from, &Joints::zeros()) else { continue };
                for last in before.iter() {
                    let Ok(all) = inverse(&robot, &to, &last.q) else { continue };
                    match continued(&robot, &to, last) {
                        Some(found) => {
                            let nearest = all.nearest(&last.q).unwrap();
                            assert!((found.q - nearest.q).amax() < 1e-9, "{found:?}, not {nearest:?}");
                            certain += 1;
                        }
                        None => open += 1,
                    }
                }
            }
            assert!(certain > 4 * open, "{id}: all are asked for {open} times, for {certain} one is enough");
        }
    }
}
