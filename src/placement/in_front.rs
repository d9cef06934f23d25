//! A place for the workpiece in front of the robot, where the whole path is within reach.

use crate::error::Error;
use crate::job::Job;
use crate::math::Pose;
use crate::motion::joints::{StartBranch, first_solution, jumps, next_solution};
use crate::progress::Progress;
use crate::robot::inverse::Solution;
use crate::robot::{Joints, Robot, forward};
use crate::setup::Setup;
use crate::units::{DEG, MM};
use nalgebra::{Matrix3, Vector3};

/// Number of poses checked along the path.
const POSES: usize = 60;
/// Positions tried for the middle of the path, as shares of the reach: ahead of axis 2, above it.
const AHEAD: [f64; 6] = [0.6, 0.7, 0.5, 0.8, 0.4, 0.9];
const ABOVE: [f64; 5] = [-0.2, 0.0, -0.4, 0.2, -0.6];
/// Room to a joint limit that counts as much as the best distance from a singularity [rad].
const ROOM: f64 = 45.0 * DEG;

/// The position of the workpiece frame [mm] that brings the path in front of the robot: of 30
/// places in its plane of symmetry, the one with the most room to joint limits and singularities.
/// Orientations are kept.
///
/// # Errors
/// Any error of the job's setup; [`Error::Invalid`] if the path fits none of the places.
pub fn in_front(job: &Job) -> Result<[f64; 3], Error> {
    in_front_of(&Setup::of(job, &mut Progress::none())?, job.workpiece_frame.xyz_mm)
}

/// The same for a setup whose workpiece frame is at `from` [mm].
///
/// # Errors
/// [`Error::Invalid`] if the path fits none of the places.
pub fn in_front_of(setup: &Setup, from: [f64; 3]) -> Result<[f64; 3], Error> {
    let poses = poses(setup);
    let mut best: Option<(f64, Vector3<f64>)> = None;
    for shift in shifts(setup) {
        if let Some(room) = room(&setup.robot, &poses, &shift, setup.start)
            && best.is_none_or(|(most, _)| room > most)
        {
            best = Some((room, shift));
        }
    }
    let (_, shift) = best.ok_or_else(|| no_place(setup))?;
    let moved = setup.base.direction(&shift) / MM;
    let [x, y, z] = from;
    Ok([(x + moved.x).round(), (y + moved.y).round(), (z + moved.z).round()])
}

/// Poses along the path.
fn poses(setup: &Setup) -> Vec<(Vector3<f64>, Matrix3<f64>)> {
    let path = &setup.path;
    let along = |k: usize| path.length() * k as f64 / (POSES - 1) as f64;
    let pose = |s: f64| (path.point(s), path.orientation(s, &path.axis(s), path.roll(s)));
    (0..POSES).map(|k| pose(along(k))).collect()
}

/// Corners of the path's box [m], by its poses.
fn extent(setup: &Setup) -> (Vector3<f64>, Vector3<f64>) {
    let path = &setup.path;
    let first = path.point(0.0);
    let along = (0..POSES).map(|k| path.point(path.length() * k as f64 / (POSES - 1) as f64));
    along.fold((first, first), |(low, high), point| (low.inf(&point), high.sup(&point)))
}

/// The shifts in the base frame [m] that bring the middle of the path to each of the places tried.
pub(super) fn shifts(setup: &Setup) -> impl Iterator<Item = Vector3<f64>> {
    let robot = &setup.robot;
    let (low, high) = extent(setup);
    let shoulder = forward::frames(robot, &Joints::zeros())[0].position.z;
    let (first, reach) = (robot.links()[1].a.abs(), robot.reach().1);
    ABOVE.into_iter().flat_map(|above| AHEAD.map(|ahead| (above, ahead))).map(move |(above, ahead)| {
        let place = Vector3::new(first + ahead * reach, 0.0, shoulder + above * reach);
        place - (low + high) * 0.5
    })
}

/// What is said where none of the places fits.
pub(super) fn no_place(setup: &Setup) -> Error {
    let (low, high) = extent(setup);
    let size = (high - low) / MM;
    Error::invalid(
        "workpiece_frame.xyz_mm",
        "without a place in front of this robot",
        format!(
            "no place within reach and joint limits fits a path of {:.0} \
             x {:.0} x {:.0} mm with this tool; choose a larger robot or another start branch, or turn the workpiece",
            size.x, size.y, size.z
        ),
    )
}

/// The least room along the path to singularities, and to joint limits where they are known; `None`
/// if a pose has no solution within the joint ranges, or the branch ends.
fn room(
    robot: &Robot,
    poses: &[(Vector3<f64>, Matrix3<f64>)],
    shift: &Vector3<f64>,
    start: StartBranch,
) -> Option<f64> {
    let mut last: Option<Solution> = None;
    let mut least = f64::INFINITY;
    for (point, rotation) in poses {
        let tcp = Pose { rotation: *rotation, position: point + shift };
        let solution = match &last {
            None => first_solution(robot, &tcp, start),
            Some(last) => next_solution(robot, &tcp, last),
        };
        let solution = solution.ok()?;
        if last.is_some_and(|last| jumps(&last, &solution)) {
            return None;
        }
        least = least.min(solution.margin.elbow).min(solution.margin.wrist);
        for (q, (low, high)) in solution.q.iter().zip(robot.limits().into_iter().flatten()) {
            least = least.min((q - low).min(high - q) / ROOM);
        }
        last = Some(solution);
    }
    (least > 0.0).then_some(least)
}
