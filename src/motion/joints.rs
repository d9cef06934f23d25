//! Joint commands along the trajectory: the inverse model at every sample, on one continuous branch (thesis Fig. 5.4).

use crate::error::Error;
use crate::math::Pose;
use crate::motion::Trajectory;
use crate::path::{Axes, Path};
use crate::robot::inverse::{self, Margin, Solution};
use crate::robot::{Joints, Robot};
use nalgebra::{Matrix3, Vector3};
use std::sync::Arc;

/// Which of the up to eight solutions the motion starts on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StartBranch {
    /// The arm faces the point.
    pub front: bool,
    /// The elbow angle from the stretched arm is positive.
    pub elbow_positive: bool,
    /// The wrist with the smaller |q4|.
    pub wrist_near: bool,
}

/// Joint commands, one a sample.
#[derive(Debug, Clone, PartialEq)]
pub struct JointTrajectory {
    /// Joint values [rad]; they run on beyond full turns rather than jump.
    pub q: Arc<Vec<Joints>>,
    /// Distance from the singularities at each sample.
    pub margin: Vec<Margin>,
    /// Branch at the start.
    pub start: inverse::Branch,
}

/// Tells now and then, after the sample `k` of `count`, which share of them is done.
pub(crate) fn tell_share(on_share: &mut dyn FnMut(f64), k: usize, count: usize) {
    const STRIDE: usize = 1 << 15;
    if (k + 1).is_multiple_of(STRIDE) {
        on_share((k + 1) as f64 / count as f64);
    }
}

/// Solves the inverse model for TCPs at `positions` [m] with the tool axes `axes` (base frame), each sample nearest to the one before.
///
/// # Errors
/// [`Error::Unreachable`] with the sample and its arc length; [`Error::Invalid`] if the start has no solution on the branch asked for.
pub fn joint_trajectory(
    robot: &Robot,
    path: &Path,
    trajectory: &Trajectory,
    desired: (&[Vector3<f64>], &Axes),
    start: StartBranch,
) -> Result<JointTrajectory, Error> {
    joint_trajectory_with(robot, path, trajectory, desired, start, &mut |_| {})
}

/// The same; `on_share` is told now and then which share of the samples is done.
///
/// # Errors
/// See [`joint_trajectory`].
pub fn joint_trajectory_with(
    robot: &Robot,
    path: &Path,
    trajectory: &Trajectory,
    (positions, axes): (&[Vector3<f64>], &Axes),
    start: StartBranch,
    on_share: &mut dyn FnMut(f64),
) -> Result<JointTrajectory, Error> {
    let mut q = Vec::with_capacity(positions.len());
    let mut margin = Vec::with_capacity(positions.len());
    let mut previous: Option<Solution> = None;
    let mut first = None;
    // Axis, spin and orientation of the last sample: mostly the next one's too.
    let mut held = (Vector3::zeros(), 0.0, Matrix3::zeros());
    for (k, position) in positions.iter().enumerate() {
        let s = trajectory.pace.arc_length[k];
        let (axis, spin) = (axes.at(k), path.spin(s));
        if (held.0, held.1) != (*axis, spin) {
            held = (*axis, spin, path.orientation(axis, spin));
        }
        let tcp = Pose { rotation: held.2, position: *position };
        let place = |error: Error| error.at(k, s);
        let solution = match &previous {
            None => first_solution(robot, &tcp, start).map_err(place)?,
            Some(last) => next_solution(robot, &tcp, last).map_err(place)?,
        };
        first.get_or_insert(solution.branch);
        q.push(solution.q);
        margin.push(solution.margin);
        previous = Some(solution);
        tell_share(on_share, k, positions.len());
    }
    match first {
        Some(start) => Ok(JointTrajectory { q: Arc::new(q), margin, start }),
        None => Err(Error::Missing { field: "path".into(), expected: "a path has points".into() }),
    }
}

/// The solution that a motion starts on.
pub(crate) fn first_solution(robot: &Robot, tcp: &Pose, start: StartBranch) -> Result<Solution, Error> {
    let solutions = inverse::inverse(robot, tcp, &Joints::zeros())?;
    let (near, flipped) = {
        let mut wrists: Vec<&Solution> = solutions
            .iter()
            .filter(|s| s.branch.front == start.front && s.branch.elbow_positive == start.elbow_positive)
            .collect();
        wrists.sort_by(|a, b| a.q[3].abs().total_cmp(&b.q[3].abs()));
        (wrists.first().copied(), wrists.last().copied())
    };
    let chosen = if start.wrist_near { near } else { flipped };
    chosen.copied().ok_or_else(|| Error::Invalid {
        field: "start_branch".into(),
        value: format!(
            "shoulder {}, elbow {}",
            if start.front { "front" } else { "back" },
            if start.elbow_positive { "positive" } else { "negative" }
        ),
        expected: "the path's first point has no solution on it; choose another".into(),
    })
}

/// The solution nearest to the one before.
pub(crate) fn next_solution(robot: &Robot, tcp: &Pose, last: &Solution) -> Result<Solution, Error> {
    if let Some(solution) = inverse::continued(robot, tcp, last) {
        return Ok(solution);
    }
    let solutions = inverse::inverse(robot, tcp, &last.q)?;
    solutions.nearest(&last.q).copied().ok_or_else(|| inverse::unclosed(tcp))
}
