//! Forward and inverse kinematics and the Jacobian of the default robot, over many poses.

use std::hint::black_box;

use armill::math::Pose;
use armill::robot::inverse::inverse;
use armill::robot::jacobian::jacobian;
use armill::robot::{Joints, Robot, forward};
use armill::{Error, Job};

use crate::Work;

/// Poses in one round: few enough to stay in the caches, as along a path.
pub const COUNT: usize = 1000;

/// The default robot without a tool, joint values over its whole range, and the flange poses there.
pub struct Poses {
    /// The robot.
    pub robot: Robot,
    /// Joint values [rad].
    pub joints: Vec<Joints>,
    /// Flange poses for these values.
    pub flanges: Vec<Pose>,
}

/// The operations timed at every pose.
pub const WORK: [Work<Poses>; 3] = [
    ("forward", |p| each(p, |robot, q, _| forward::forward(robot, q))),
    ("inverse, every solution", |p| each(p, |robot, q, flange| inverse(robot, flange, q))),
    ("Jacobian", |p| each(p, |robot, q, _| jacobian(robot, q))),
];

impl Poses {
    /// The default job's robot and its poses.
    ///
    /// # Errors
    /// If the robot does not exist.
    pub fn new() -> Result<Self, Error> {
        let robot = armill::setup::robot(&Job::default())?.with_tool(Pose::identity());
        // Spread evenly over a cube of joint values by the roots of primes; two turns either way
        // reach every branch.
        let spread = |k: usize, root: f64| ((k as f64 + 0.5) * root).fract() * 5.0 - 2.5;
        let roots = [2.0_f64, 3.0, 5.0, 7.0, 11.0, 13.0].map(f64::sqrt);
        let joints: Vec<_> = (0..COUNT).map(|k| Joints::from_fn(|i, _| spread(k, roots[i]))).collect();
        let flanges = joints.iter().map(|q| forward::forward(&robot, q)).collect();
        Ok(Self { robot, joints, flanges })
    }
}

fn each<T>(poses: &Poses, work: impl Fn(&Robot, &Joints, &Pose) -> T) {
    for (q, flange) in poses.joints.iter().zip(&poses.flanges) {
        black_box(work(&poses.robot, q, flange));
    }
}
