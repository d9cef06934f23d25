//! Inverse kinematics: joint values for a pose of the TCP.
//!
//! Arms of the RX-90's family are solved in closed form, others by iteration. Both give results of
//! the same form.

mod solution;
mod closed_form;
mod numerical;

pub(crate) use closed_form::WRIST_SINGULAR;
pub use solution::{Branch, Margin, Solution, Solutions};

use crate::error::Error;
use crate::math::Pose;
use crate::robot::{Joints, Robot};
use solution::place_mm;
use std::f64::consts::FRAC_PI_4;

/// All joint values that put the TCP at `tcp` (base frame); each is checked by the forward model
/// (1e-9 m, 1e-9).
///
/// Each angle is taken in the full turn nearest to `near` [rad]. At a wrist singularity q4 is taken
/// from `near`.
///
/// # Errors
/// [`Error::Unreachable`] with the distance and the reach if the pose is out of reach;
/// [`Error::Invalid`] if it is within reach but no solution passes the check.
pub fn inverse(robot: &Robot, tcp: &Pose, near: &Joints) -> Result<Solutions, Error> {
    let solutions = match robot.geometry() {
        Ok(geometry) => {
            let mut solutions = Solutions::none();
            closed_form::each(robot, geometry, tcp, near, None, &mut |solution| {
                solutions.add(solution);
            })?;
            solutions
        }
        Err(_) => numerical::solutions(robot, tcp, near)?,
    };
    match solutions.iter().next() {
        Some(_) => Ok(solutions),
        None => Err(unclosed(tcp)),
    }
}

/// The solution on the branch of `last`, if it is certain that no other branch comes nearer to
/// `last`.
///
/// Switching the wrist turns q4 by half a turn. Switching the elbow turns q3 by twice the elbow
/// angle. Switching the shoulder turns q1 by more than a quarter turn if the wrist centre is
/// further ahead of axis 1 than beside it. A solution less than half as far from `last` is
/// therefore the nearest.
pub(crate) fn continued(robot: &Robot, tcp: &Pose, last: &Solution) -> Option<Solution> {
    let Ok(geometry) = robot.geometry() else {
        return numerical::continued(robot, tcp, last);
    };
    let mut found = None;
    let take = &mut |solution| found = Some(solution);
    closed_form::each(robot, geometry, tcp, &last.q, Some(last.branch), take).ok()?;
    found.filter(|solution| {
        solution.margin.shoulder >= geometry.lateral.abs()
            && (solution.q - last.q).norm() < solution.margin.elbow.min(FRAC_PI_4)
    })
}

/// The error for a pose within reach that every branch misses by rounding.
pub(crate) fn unclosed(tcp: &Pose) -> Error {
    let expected = "no solution of the inverse model closes there; move the path a little";
    Error::invalid("path", place_mm(tcp), expected)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::library;
    use nalgebra::Vector3;

    #[test]
    fn what_continues_is_the_nearest_of_all() {
        // Steps of up to 9 cm, with the wrist near axis 1, where another shoulder may be nearer;
        // the second arm's plane lies beside that axis.
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
                // The arm whose plane lies beside axis 1 cannot reach that axis.
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
