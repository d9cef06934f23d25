//! The closed form (thesis eqs. 3.9-3.21) for every arm of the RX-90's family.
//!
//! Two shoulders (the arm faces the point or turns its back), two elbows and two wrists give up to
//! eight solutions. The thesis's eqs. 3.13-3.21 have misprinted arc tangents; the derivation here
//! follows the same steps with the twist signs and the offsets a_1, a_3 and b kept as parameters.

use super::solution::{Branch, Margin, Solution, is_near, unreachable};
use crate::error::Error;
use crate::math::{self, PI, Pose, Turn};
use crate::robot::model::Geometry;
use crate::robot::{Joints, Robot, forward};
use nalgebra::{Matrix3, Vector3};

/// |sin q5| below which only the sum of q4 and q6 is determined.
pub(crate) const WRIST_SINGULAR: f64 = 1e-10;

/// Calls `take` with each solution that the forward model confirms, on every branch or on `only`
/// one.
///
/// Works on sines and cosines; angles in radians are computed only at the end.
///
/// # Errors
/// [`Error::Unreachable`] if the wrist centre is too close to axis 1, or out of the arm's reach.
pub(super) fn each(
    robot: &Robot,
    geometry: &Geometry,
    tcp: &Pose,
    near: &Joints,
    only: Option<Branch>,
    take: &mut dyn FnMut(Solution),
) -> Result<(), Error> {
    let flange = tcp.compose(robot.flange());
    let problem = PoseProblem { robot, geometry, tcp, flange, near, serial: robot.to_serial(near), only };
    let [x, y, z] = problem.wrist_centre();
    let beside = -geometry.sin_1 * geometry.lateral;
    let forward_reach = problem.forward_reach((x, y), beside)?;

    let mut reached = false;
    let mut nearest_miss: Option<f64> = None;
    for (front, sign) in [(true, 1.0), (false, -1.0)] {
        if only.is_some_and(|branch| branch.front != front) {
            continue;
        }
        let ahead = sign * forward_reach;
        let shoulder = Shoulder {
            front,
            forward_reach,
            theta_1: Turn::between((ahead, beside), (x, y)),
            wrist: (ahead - robot.links()[1].a, geometry.sin_1 * z),
        };
        match problem.elbow_cosine(&shoulder) {
            Ok(cos_elbow) => {
                reached = true;
                problem.elbows(&shoulder, cos_elbow, take);
            }
            Err(distance) => {
                let is_nearer = |known| problem.miss(distance) < problem.miss(known);
                if nearest_miss.is_none_or(is_nearer) {
                    nearest_miss = Some(distance);
                }
            }
        }
    }
    match nearest_miss {
        Some(distance) if !reached => Err(unreachable(tcp, distance, robot.reach())),
        _ => Ok(()),
    }
}

/// The target pose, and the arm that should reach it.
struct PoseProblem<'a> {
    robot: &'a Robot,
    geometry: &'a Geometry,
    tcp: &'a Pose,
    /// Flange frame with the TCP at `tcp`.
    flange: Pose,
    /// Joint values [rad] that select the full turn of each angle.
    near: &'a Joints,
    /// `near` with joint 3 measured from the upper arm.
    serial: Joints,
    /// The only branch wanted; all if `None`.
    only: Option<Branch>,
}

/// The arm facing the wrist centre, or with its back to it.
struct Shoulder {
    front: bool,
    /// Distance of the wrist centre from the plane through axis 1 along axis 2 [m].
    forward_reach: f64,
    /// Turn of axis 1 that brings the arm's plane onto the wrist centre.
    theta_1: Turn,
    /// Wrist centre in the arm's plane, relative to axis 2 [m].
    wrist: (f64, f64),
}

/// Upper arm and forearm placed to reach the wrist centre.
struct ShoulderAndElbow {
    front: bool,
    elbow_positive: bool,
    /// Theta_1, theta_2, theta_3.
    turns: [Turn; 3],
    /// The same three angles [rad].
    angles: [f64; 3],
    /// Margins of the shoulder [m] and of the elbow.
    margins: (f64, f64),
}

impl PoseProblem<'_> {
    /// Wrist centre (eq. 3.9), in frame 0 turned by alpha_0 and moved to axis 1.
    fn wrist_centre(&self) -> [f64; 3] {
        let links = self.robot.links();
        let wrist = self.flange.position - self.flange.rotation.column(2) * links[5].d;
        let (cos_0, sin_0) = self.robot.twists[0];
        let x = wrist.x - links[0].a;
        let y = cos_0 * wrist.y + sin_0 * wrist.z;
        let z = cos_0 * wrist.z - sin_0 * wrist.y - links[0].d;
        [x, y, z]
    }

    /// Distance of the wrist centre ahead of axis 1 [m] after turning it back by theta_1 (eq. 3.13)
    /// into the arm's plane, which is offset from axis 1 by `beside` [m].
    fn forward_reach(&self, (x, y): (f64, f64), beside: f64) -> Result<f64, Error> {
        let radius_squared = x * x + y * y;
        let forward_squared = radius_squared - beside * beside;
        if forward_squared < -1e-12 {
            return Err(unreachable(self.tcp, radius_squared.sqrt(), (beside.abs(), f64::INFINITY)));
        }
        Ok(forward_squared.max(0.0).sqrt())
    }

    /// Cosine of the elbow angle, by the law of cosines for upper arm and forearm (eq. 3.15). If
    /// the wrist centre is out of their reach, the error is its distance from axis 2 [m].
    fn elbow_cosine(&self, shoulder: &Shoulder) -> Result<f64, f64> {
        let g = self.geometry;
        let (px, py) = shoulder.wrist;
        let distance_squared = px * px + py * py;
        let cos_elbow = (distance_squared - g.upper * g.upper - g.fore * g.fore) / (2.0 * g.upper * g.fore);
        if cos_elbow.abs() > 1.0 + 1e-12 {
            return Err(distance_squared.sqrt());
        }
        Ok(cos_elbow.clamp(-1.0, 1.0))
    }

    /// How far out of reach a wrist centre at this distance from axis 2 [m] is [m].
    fn miss(&self, distance: f64) -> f64 {
        let (nearest, furthest) = self.robot.reach();
        if distance > self.geometry.upper.abs() { distance - furthest } else { nearest - distance }
    }

    /// Theta_3 (eq. 3.15) and theta_2 (eq. 3.14) of both elbows.
    fn elbows(&self, shoulder: &Shoulder, cos_elbow: f64, take: &mut dyn FnMut(Solution)) {
        let g = self.geometry;
        let &Shoulder { front, forward_reach, theta_1, wrist } = shoulder;
        let sin_elbow = (1.0 - cos_elbow * cos_elbow).sqrt();
        let angle_1 = theta_1.angle();
        for (elbow_positive, sin_elbow) in [(true, sin_elbow), (false, -sin_elbow)] {
            if self.only.is_some_and(|branch| branch.elbow_positive != elbow_positive) {
                continue;
            }
            let theta_3 = Turn::between(g.fore_direction, (cos_elbow, sin_elbow));
            // The direction to the wrist centre, minus the arm's own direction.
            let own = (g.upper + g.fore * cos_elbow, g.cos_2 * g.fore * sin_elbow);
            let theta_2 = Turn::between(own, wrist);
            let turns = [theta_1, theta_2, theta_3];
            let angles = [angle_1, theta_2.angle(), theta_3.angle()];
            let margins = (forward_reach, sin_elbow.abs());
            self.wrists(&ShoulderAndElbow { front, elbow_positive, turns, angles, margins }, take);
        }
    }

    /// Theta_4, theta_5 and theta_6 (eqs. 3.16-3.21) of both wrists, checked with the forward
    /// model.
    fn wrists(&self, arm: &ShoulderAndElbow, take: &mut dyn FnMut(Solution)) {
        let robot = self.robot;
        let frame_3 = chain(robot, 0, Pose::identity(), arm.turns);
        // Frame 3 turned by alpha_3, so that joint 4 turns about its z axis (eqs. 3.16-3.18, left
        // side).
        let turned = forward::turned(&frame_3.rotation, robot.twists[3], Turn { sin: 0.0, cos: 1.0 });
        let m = turned.transpose() * self.flange.rotation;
        let (turns, sin_wrist) = wrist_turns(robot, self.geometry, &m, self.near);
        let angles = turns.map(Turn::angle);
        for wrist_positive in [true, false] {
            if self.only.is_some_and(|branch| branch.wrist_positive != wrist_positive) {
                continue;
            }
            let (turns, angles) = if !wrist_positive && sin_wrist > WRIST_SINGULAR {
                other_wrist(turns, angles)
            } else {
                (turns, angles)
            };
            let reached = chain(robot, 3, frame_3, turns);
            if !is_near(self.tcp, &reached.compose(robot.tool())) {
                continue;
            }
            let (shoulder, elbow) = arm.margins;
            take(Solution {
                q: self.joints(arm.angles, angles),
                branch: Branch { front: arm.front, elbow_positive: arm.elbow_positive, wrist_positive },
                margin: Margin { shoulder, elbow, wrist: sin_wrist },
            });
        }
    }

    /// The joint values for theta_1 to theta_6 [rad], each in the full turn nearest to `near`.
    fn joints(&self, arm: [f64; 3], wrist: [f64; 3]) -> Joints {
        let theta = [arm[0], arm[1], arm[2], wrist[0], wrist[1], wrist[2]];
        let links = self.robot.links();
        let q = Joints::from_fn(|i, _| math::nearest_turn(links[i].joint(theta[i]), self.serial[i]));
        self.robot.to_controller(&q)
    }
}

/// The frame after three links, starting with `link` (from 0), from their angles about z.
///
/// Inlined, because the first chain starts from the identity, which then costs nothing.
#[inline(always)]
fn chain(robot: &Robot, link: usize, frame: Pose, [first, second, third]: [Turn; 3]) -> Pose {
    let frame = forward::next(robot, link, &frame, first);
    let frame = forward::next(robot, link + 1, &frame, second);
    forward::next(robot, link + 2, &frame, third)
}

/// Theta_4, theta_5, theta_6 from M = Rz(theta_4) Rx(alpha_4) Rz(theta_5) Rx(alpha_5) Rz(theta_6)
/// (eqs. 3.17-3.21) with the positive wrist, and |sin theta_5|.
///
/// With alpha_5 = -alpha_4 the middle is Ry(b), b = -sin(alpha_4) theta_5, and M is a ZYZ Euler
/// rotation. With equal twists a half turn about x follows, which also reverses theta_6.
fn wrist_turns(robot: &Robot, g: &Geometry, m: &Matrix3<f64>, near: &Joints) -> ([Turn; 3], f64) {
    let equal = g.sin_4 == g.sin_5;
    let m = if equal { m * Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0)) } else { *m };
    let sin_b = (m[(0, 2)] * m[(0, 2)] + m[(1, 2)] * m[(1, 2)]).sqrt();
    let theta_4 = if sin_b > WRIST_SINGULAR {
        Turn { sin: m[(1, 2)] / sin_b, cos: m[(0, 2)] / sin_b }
    } else {
        Turn::of(robot.links()[3].theta(near[3]))
    };
    // Rz(-theta_4) M = Ry(b) Rz(theta_6): exact for any theta_4, so the pose closes near the
    // singularity too.
    let Turn { sin: sin_4, cos: cos_4 } = theta_4;
    let ahead = (1.0, 0.0);
    let b = Turn::between(ahead, (m[(2, 2)], cos_4 * m[(0, 2)] + sin_4 * m[(1, 2)]));
    let across = (cos_4 * m[(1, 1)] - sin_4 * m[(0, 1)], cos_4 * m[(1, 0)] - sin_4 * m[(0, 0)]);
    let theta_6 = Turn::between(ahead, if equal { (across.0, -across.1) } else { across });
    ([theta_4, Turn { sin: -g.sin_4 * b.sin, ..b }, theta_6], sin_b)
}

/// The other wrist: joints 4 and 6 turned by half a turn, joint 5 bent the other way.
fn other_wrist(
    [theta_4, theta_5, theta_6]: [Turn; 3],
    [angle_4, angle_5, angle_6]: [f64; 3],
) -> ([Turn; 3], [f64; 3]) {
    let half_turn = |theta: Turn| Turn { sin: -theta.sin, cos: -theta.cos };
    (
        [half_turn(theta_4), Turn { sin: -theta_5.sin, ..theta_5 }, half_turn(theta_6)],
        [angle_4 - PI, -angle_5, angle_6 - PI],
    )
}
