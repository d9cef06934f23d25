//! Joint commands along the trajectory: the inverse model at every sample, on one continuous branch
//! (thesis Fig. 5.4).

use crate::error::Error;
use crate::math::Pose;
use crate::motion::{Trajectory, turns};
use crate::path::{Axes, Path};
use crate::progress::Progress;
use crate::robot::inverse::{self, Margin, Solution};
use crate::robot::{Joints, Robot, forward};
use crate::units::DEG;
use nalgebra::{Matrix3, Vector3};
use std::sync::Arc;

/// Which of the up to eight solutions the motion starts from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StartBranch {
    /// The arm faces the point.
    pub front: bool,
    /// The elbow angle, measured from the stretched arm, is positive.
    pub elbow_positive: bool,
    /// The wrist with the smaller |q4|.
    pub wrist_near: bool,
}

/// Joint commands, one per sample.
#[derive(Debug, Clone, PartialEq)]
pub struct JointTrajectory {
    /// Joint values [rad]; continuous beyond full turns.
    pub q: Arc<Vec<Joints>>,
    /// Distance from the singularities at each sample.
    pub margin: Vec<Margin>,
    /// Branch at the start.
    pub start: inverse::Branch,
}

/// Target TCPs, one per sample.
#[derive(Clone, Copy)]
pub struct Targets<'a> {
    /// The path, for orientation and roll.
    pub path: &'a Path,
    /// Arc length of each sample along the path [m].
    pub arc_length: &'a [f64],
    /// Positions in the base frame [m].
    pub position: &'a [Vector3<f64>],
    /// Tool axes in the base frame.
    pub axis: &'a Axes,
}

impl<'a> Targets<'a> {
    /// The positions and axes of a trajectory along a path.
    pub fn desired(path: &'a Path, trajectory: &'a Trajectory) -> Self {
        let Trajectory { timing, position, axis, .. } = trajectory;
        Self { path, arc_length: &timing.arc_length, position, axis }
    }

    /// The TCP at the sample `k`.
    fn tcp(&self, k: usize) -> Pose {
        let s = self.arc_length[k];
        let rotation = self.path.orientation(s, self.axis.at(k), self.path.roll(s));
        Pose { rotation, position: self.position[k] }
    }
}

/// Turn of a joint from one sample to the next that is no motion of the arm [rad]. Beside a wrist
/// singularity the nearer of the two wrists turns by a quarter turn at most; another branch, by
/// nearly half a turn.
const HALF_TURN: f64 = 120.0 * DEG;
/// The same where the arm changes shoulder or elbow: through their singularities it turns smoothly
/// [rad].
const CHANGED: f64 = 30.0 * DEG;

/// Solves the inverse model for each target, with each solution nearest to the one before, in the
/// whole turns of the joints that suit their ranges.
///
/// # Errors
/// [`Error::Unreachable`] with the sample and its arc length; [`Error::BranchEnds`] where only
/// another branch goes on; [`Error::Invalid`] if the start has no solution on the requested branch.
pub fn joint_trajectory(
    robot: &Robot,
    targets: &Targets,
    start: StartBranch,
    progress: &mut Progress,
) -> Result<JointTrajectory, Error> {
    let first = start_solution(robot, targets, start)?;
    let mut joints = follow(robot, targets, first, progress)?;
    turns::into_ranges(robot, Arc::make_mut(&mut joints.q).as_mut_slice());
    Ok(joints)
}

/// As [`joint_trajectory`], from the solution nearest to given joint values [rad], in their whole
/// turns.
///
/// # Errors
/// See [`joint_trajectory`].
pub fn joint_trajectory_from(
    robot: &Robot,
    targets: &Targets,
    start: &Joints,
    progress: &mut Progress,
) -> Result<JointTrajectory, Error> {
    let first = nearest_start(robot, targets, start)?;
    follow(robot, targets, first, progress)
}

/// The solutions from the first on.
fn follow(
    robot: &Robot,
    targets: &Targets,
    first: Solution,
    progress: &mut Progress,
) -> Result<JointTrajectory, Error> {
    let Targets { path, arc_length, position: positions, axis: axes } = *targets;
    let mut q = Vec::with_capacity(positions.len());
    let mut margin = Vec::with_capacity(positions.len());
    q.push(first.q);
    margin.push(first.margin);
    progress.sample(0, positions.len());
    let mut last = first;
    // What gives the orientation of the last sample, and it; mostly the next sample has the same.
    let mut held = ((Vector3::zeros(), 0.0, path.roll_zero(0.0)), Matrix3::zeros());
    for (k, position) in positions.iter().enumerate().skip(1) {
        let s = arc_length[k];
        let (axis, roll, zero) = (axes.at(k), path.roll(s), path.roll_zero(s));
        if held.0 != (*axis, roll, zero) {
            held = ((*axis, roll, zero), zero.orientation(axis, roll));
        }
        let tcp = Pose { rotation: held.1, position: *position };
        let next = next_solution(robot, &tcp, &last).map_err(|error| error.at(k, s))?;
        if jumps(&last, &next) {
            return Err(branch_ends(targets, k, &(next.q - last.q)));
        }
        q.push(next.q);
        margin.push(next.margin);
        last = next;
        progress.sample(k, positions.len());
    }
    Ok(JointTrajectory { q: Arc::new(q), margin, start: first.branch })
}

/// Whether the arm cannot go from one solution to the next within a sample.
pub(crate) fn jumps(last: &Solution, next: &Solution) -> bool {
    let (from, to) = (last.branch, next.branch);
    let changed = from.front != to.front || from.elbow_positive != to.elbow_positive;
    (next.q - last.q).amax() > if changed { CHANGED } else { HALF_TURN }
}

/// The error for a turn of the joints at a sample.
fn branch_ends(targets: &Targets, sample: usize, turn: &Joints) -> Error {
    let (arc_length, position) = (targets.arc_length[sample], targets.position[sample]);
    let joint = turn.iamax();
    Error::BranchEnds {
        sample,
        arc_length,
        line: targets.path.moves()[targets.path.locate(arc_length).0].line,
        position: position.into(),
        joint: joint + 1,
        turn: turn[joint].abs(),
    }
}

/// Sine of the wrist angle below which a start counts as singular: what is left of a singular pose
/// that is typed with seven decimals of the tool axis.
const NEARLY_SINGULAR: f64 = 3e-6;

/// The solution that the motion along targets starts from. In the wrist singularity, where any q4
/// will do, it has that of the first sample beyond.
fn start_solution(robot: &Robot, targets: &Targets, start: StartBranch) -> Result<Solution, Error> {
    let solution = |k: usize| {
        let place = |error: Error| error.at(k, targets.arc_length[k]);
        first_solution(robot, &targets.tcp(k), start).map_err(place)
    };
    let first = solution(0)?;
    if first.margin.wrist > NEARLY_SINGULAR {
        return Ok(first);
    }
    let next = (1..targets.position.len()).map_while(|k| solution(k).ok());
    match next.into_iter().find(|next| next.margin.wrist > NEARLY_SINGULAR) {
        Some(regular) if first.margin.wrist > inverse::WRIST_SINGULAR => {
            Ok(turned_wrist(robot, &first, regular.q[3]))
        }
        Some(regular) => nearest_start(robot, targets, &regular.q),
        None => Ok(first),
    }
}

/// A nearly singular solution with another q4 [rad]: axes 4 and 6 lie along each other, so joint 6
/// takes back what joint 4 turns. The tool axis is off by twice the sine of the wrist angle at most.
fn turned_wrist(robot: &Robot, solution: &Solution, q4: f64) -> Solution {
    let frames = forward::frames(robot, &solution.q);
    let [_, _, _, four, _, six] = robot.links();
    let same_way = frames[3].rotation.column(2).dot(&frames[5].rotation.column(2)).signum();
    let mut q = solution.q;
    q[5] += same_way * four.sign * six.sign * (q[3] - q4);
    q[3] = q4;
    Solution { q, ..*solution }
}

/// The solution at the start nearest to joint values [rad].
fn nearest_start(robot: &Robot, targets: &Targets, q: &Joints) -> Result<Solution, Error> {
    let tcp = targets.tcp(0);
    let solutions = inverse::inverse(robot, &tcp, q).map_err(|error| error.at(0, targets.arc_length[0]))?;
    solutions.nearest(q).copied().ok_or_else(|| inverse::unclosed(&tcp))
}

/// The solution that a motion starts from, each joint in its range if a whole turn brings it there.
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
    let mut chosen = chosen.copied().ok_or_else(|| {
        Error::invalid(
            "start_branch",
            format!(
                "shoulder {}, elbow {}",
                if start.front { "front" } else { "back" },
                if start.elbow_positive { "positive" } else { "negative" }
            ),
            "the path's first point has no solution on it; choose another",
        )
    })?;
    turns::into_ranges(robot, std::slice::from_mut(&mut chosen.q));
    Ok(chosen)
}

/// The solution nearest to the one before.
pub(crate) fn next_solution(robot: &Robot, tcp: &Pose, last: &Solution) -> Result<Solution, Error> {
    if let Some(solution) = inverse::continued(robot, tcp, last) {
        return Ok(solution);
    }
    let solutions = inverse::inverse(robot, tcp, &last.q)?;
    solutions.nearest(&last.q).copied().ok_or_else(|| inverse::unclosed(tcp))
}
