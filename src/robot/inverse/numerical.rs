//! Inverse kinematics by iteration, for six-joint arms outside the closed form: wrists whose axes
//! do not meet, bent twists.
//!
//! Levenberg-Marquardt with damping proportional to the squared error, after Sugihara
//! ("Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt method", IEEE Trans.
//! Robotics 27(5), 2011, eqs. 12-16). The matrix is never singular, and near the solution the
//! method becomes Newton's, which doubles the correct digits at every step. Starting points are
//! fixed, so the same pose gives the same bits.

use super::solution::{Branch, CLOSURE, Margin, Solution, Solutions, closes, place_mm, unreachable};
use crate::error::Error;
use crate::math::{self, Pose, TAU};
use crate::robot::{Joints, Robot, forward, jacobian};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// Maximum steps of one search.
const STEPS: usize = 50;
/// Starting points tried to find all solutions of a pose.
const STARTS: usize = 160;
/// Squared error (positions over the arm's length) below which a step changes only the last digits.
const DONE: f64 = 1e-29;
/// Joint values closer together than this are the same solution [rad].
const SAME: f64 = 1e-5;
/// A continuation that turns a joint further may not be the nearest solution [rad].
const TRUSTED: f64 = 0.3;
/// The positive root of x^7 = x + 1: its powers spread points evenly over six dimensions (M.
/// Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018).
const SPREAD: f64 = 1.112_775_684_278_706;

/// All solutions found from the starting points, of which `near` is the first; at most eight.
pub(super) fn solutions(robot: &Robot, tcp: &Pose, near: &Joints) -> Result<Solutions, Error> {
    let wrist = wrist_of(robot, tcp);
    let shoulder = forward::frames(robot, near)[0].position;
    let (distance, reach) = ((wrist - shoulder).norm(), robot.reach());
    // An arm whose axes 3 to 6 meet has its wrist centre exactly there in every pose.
    if distance > reach.1 + CLOSURE {
        return Err(unreachable(tcp, distance, reach));
    }
    let mut found = Solutions::none();
    for k in 0..STARTS {
        let start = if k == 0 { *near } else { start(k) };
        let Some(q) = search(robot, tcp, &start) else { continue };
        let q = Joints::from_fn(|i, _| math::nearest_turn(q[i], near[i]));
        let new = found.iter().all(|known| (known.q - q).amax() > SAME);
        if new && !found.add(described(robot, q)) {
            break;
        }
    }
    if found.iter().next().is_none() {
        let expected = format!(
            "no joint values were found that put the tool there with this \
             axis (numerical inverse, {STARTS} starting points); move or turn the path"
        );
        return Err(Error::invalid("path", place_mm(tcp), expected));
    }
    Ok(found)
}

/// The solution that continues `last`, if it is close enough to be the nearest.
pub(super) fn continued(robot: &Robot, tcp: &Pose, last: &Solution) -> Option<Solution> {
    let q = search(robot, tcp, &last.q)?;
    ((q - last.q).amax() < TRUSTED).then(|| described(robot, q))
}

/// Joint values that put the TCP at `tcp`, from a starting point.
fn search(robot: &Robot, tcp: &Pose, start: &Joints) -> Option<Joints> {
    let scale = 1.0 / robot.reach().1;
    let mut q = *start;
    let mut error = error(robot, tcp, &q, scale);
    let mut caution = 1.0;
    for _ in 0..STEPS {
        let squared = error.norm_squared();
        if squared < DONE {
            break;
        }
        let mut j = jacobian::jacobian(robot, &q);
        j.fixed_rows_mut::<3>(0).scale_mut(scale);
        let damping = Matrix6::from_diagonal_element(caution * squared + 1e-15);
        let step = (j.tr_mul(&j) + damping).cholesky()?.solve(&j.tr_mul(&error));
        let next = q + step;
        let next_error = self::error(robot, tcp, &next, scale);
        if next_error.norm_squared() < squared {
            (q, error) = (next, next_error);
            caution = f64::max(caution * 0.25, 1e-3);
        } else if squared < 1e-24 {
            break;
        } else {
            caution *= 10.0;
        }
    }
    closes(robot, tcp, &q).then_some(q)
}

/// The error from the pose at `q` to `tcp`: position (over the arm's length) and rotation vector.
fn error(robot: &Robot, tcp: &Pose, q: &Joints, scale: f64) -> Vector6<f64> {
    let now = forward::forward(robot, q);
    let offset = (tcp.position - now.position) * scale;
    let turn = rotation_vector(&(tcp.rotation * now.rotation.transpose()));
    Vector6::new(offset.x, offset.y, offset.z, turn.x, turn.y, turn.z)
}

/// Axis times angle of a rotation (its logarithm). At half a turn, where the axis has no sign, it
/// is nearly zero.
fn rotation_vector(r: &Matrix3<f64>) -> Vector3<f64> {
    let sine = Vector3::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]) * 0.5;
    let size = sine.norm();
    if size < 1e-9 { sine } else { sine * (math::atan2(size, (r.trace() - 1.0) * 0.5) / size) }
}

/// The `k`-th starting point: six angles within half a turn of zero.
fn start(k: usize) -> Joints {
    let mut power = 1.0;
    Joints::from_fn(|_, _| {
        power /= SPREAD;
        let share: f64 = 0.5 + k as f64 * power;
        TAU * (share - share.floor() - 0.5)
    })
}

/// The wrist centre: the point of axis 6 nearest to axis 5. The links limit its distance from the
/// shoulder.
fn wrist_of(robot: &Robot, tcp: &Pose) -> Vector3<f64> {
    let flange = tcp.compose(&robot.tool().inverse());
    flange.position - flange.rotation.column(2) * robot.links()[5].d
}

/// Joint values with their branch and margin, which generalise those of the closed form.
fn described(robot: &Robot, q: Joints) -> Solution {
    let frames = forward::frames(robot, &q);
    let axis = |i: usize| frames[i].rotation.column(2);
    let ahead = frames[0].rotation.column(0).dot(&(frames[4].position - frames[0].position));
    // The forearm, projected across axis 3, and the side of the upper arm that it points to.
    let fore = frames[3].position - frames[2].position;
    let fore = fore - axis(2) * axis(2).dot(&fore);
    let bend = axis(2).dot(&frames[1].rotation.column(0).cross(&fore));
    let (sin_5, _) = math::sin_cos(robot.links()[4].theta(q[4]));
    Solution {
        q,
        branch: Branch {
            front: ahead >= 0.0,
            elbow_positive: bend >= 0.0,
            wrist_positive: -robot.twists[4].1 * sin_5 >= 0.0,
        },
        margin: Margin {
            shoulder: ahead.abs(),
            elbow: bend.abs() / fore.norm().max(f64::MIN_POSITIVE),
            wrist: axis(3).cross(&axis(5)).norm(),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_about_an_axis_is_that_axis_times_its_angle() {
        for angle in [0.0, 1e-12, 1e-6, 0.1, 1.0, 2.0, 3.1, -0.5, -3.0] {
            for i in 0..3 {
                let mut rpy = [0.0; 3];
                rpy[i] = angle;
                let turn = rotation_vector(&Pose::from_xyz_rpy(Vector3::zeros(), rpy).rotation);
                // Near half a turn the sine is small and its rounding matters.
                assert!(
                    (turn - Vector3::ith(i, angle)).norm()
                        < 1e-15 * (1.0 + 1.0 / math::sin(angle).abs().max(1e-2)),
                    "{turn}"
                );
            }
        }
    }

    /// Where axes 3 to 6 or axes 1 to 4 meet, the wrist centre is always as far from the shoulder as
    /// the links reach.
    #[test]
    fn four_axes_through_one_point_are_within_reach() {
        let preset = crate::robot::library::robot("staubli-rx90").unwrap();
        let [mut no_forearm, mut no_upper_arm] = [preset.links(), preset.links()];
        no_forearm[3].d = 0.0;
        no_upper_arm[2].a = 0.0;
        for links in [no_forearm, no_upper_arm] {
            let robot = Robot::new("degenerate", links, None, [0.0; 6]).unwrap();
            assert!(robot.closed_form().is_err());
            for k in 1..60 {
                let tcp = forward::forward(&robot, &start(k));
                let found = solutions(&robot, &tcp, &Joints::zeros());
                assert!(found.is_ok(), "pose {k}: {found:?}");
                // 1 um further out, it is out of reach.
                let shoulder = forward::frames(&robot, &start(k))[0].position;
                let outwards = (wrist_of(&robot, &tcp) - shoulder).normalize() * 1e-6;
                let beyond = Pose { position: tcp.position + outwards, ..tcp };
                let refused = solutions(&robot, &beyond, &Joints::zeros());
                assert!(matches!(refused, Err(Error::Unreachable { .. })), "pose {k}: {refused:?}");
            }
        }
    }

    #[test]
    fn small_steps_continue_and_large_ones_are_searched() {
        let preset = crate::robot::library::robot("staubli-rx90").unwrap();
        let mut links = preset.links();
        links[0].alpha += 0.5;
        let robot = Robot::new("tilted", links, None, [0.0; 6]).unwrap();
        let mut met = 0;
        for last in (1..60).map(|k| described(&robot, start(k))) {
            if last.margin.elbow.min(last.margin.wrist).min(last.margin.shoulder) < 0.3 {
                continue;
            }
            met += 1;
            let at = |step: f64| last.q + Joints::new(step, -step, step, step, -step, step);
            let to = |step: f64| continued(&robot, &forward::forward(&robot, &at(step)), &last);
            assert!((to(0.05).unwrap().q - at(0.05)).amax() < 1e-9);
            assert!(to(0.6).is_none_or(|found| (found.q - last.q).amax() < TRUSTED));
        }
        assert!(met > 10, "{met} poses");
    }

    #[test]
    fn starting_points_are_spread_evenly_within_half_a_turn() {
        let all: Vec<_> = (1..STARTS).map(start).collect();
        assert!(all.iter().all(|q| q.amax() <= TAU / 2.0));
        for i in 0..6 {
            // Nearly the same number in each quarter turn; an even spread of 159 has 40.
            let mut quarters = [0; 4];
            for q in &all {
                quarters[((q[i] / TAU + 0.5) * 4.0) as usize] += 1;
            }
            assert!(quarters.iter().all(|count| (34..=46).contains(count)), "{quarters:?}");
        }
    }
}
