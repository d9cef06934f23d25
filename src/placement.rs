//! Where to put the part: the error that a place would give, for a map of places.
//!
//! A place is judged by [`STATIONS`] stations along the path instead of all samples, by the cutting force alone: the shaper's part
//! hardly depends on the place. The part keeps its orientation, the tool its fixed spin (a free one: the angle it is compared with).

use crate::deviation::{Plan, Source, Sources, contour, deviate};
use crate::error::Error;
use crate::job::{Job, Setup};
use crate::math::Pose;
use crate::motion::Trajectory;
use crate::motion::joints::joint_trajectory;
use crate::report::warning::{ANGLE_MARGIN, JUMP, SHOULDER_MARGIN};
use crate::robot::Joints;
use crate::robot::inverse::Margin;
use crate::units::MM;
use nalgebra::Vector3;

/// Stations along the path: against all samples the largest error is met within 2 % on smooth paths (tests/placement.rs).
pub const STATIONS: usize = 121;
/// No joint turns this much from one station to the next without a change of branch [rad].
const STATION_JUMP: f64 = 12.0 * JUMP;

/// What is the matter with a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mark {
    /// Nothing.
    Good,
    /// The arm comes near a singularity, or changes its branch.
    Singular,
    /// A joint leaves its range.
    Limit,
    /// The arm does not reach all of the path.
    Unreachable,
}

/// A place on the map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Largest contour error by the cutting force, before compensation [m]; not a number where the path is out of reach.
    pub max: f64,
    /// Its mean [m].
    pub mean: f64,
    /// What is the matter.
    pub mark: Mark,
}

/// A job whose part is to be moved.
#[derive(Debug, Clone)]
pub struct Survey {
    setup: Setup,
    /// Where the part is now, in the cell [m].
    origin: Vector3<f64>,
}

impl Survey {
    /// Reads the job's path once, for any number of places.
    ///
    /// # Errors
    /// See [`Job::setup`].
    pub fn new(job: &Job) -> Result<Self, Error> {
        let setup = job.setup()?;
        let origin = Vector3::from(job.workpiece_frame.xyz_mm) * MM;
        Ok(Self { setup, origin })
    }

    /// What becomes of the path if the workpiece frame's origin stands at `xyz` in the cell [m].
    pub fn at(&self, xyz: Vector3<f64>) -> Place {
        let setup = &self.setup;
        let shift = setup.base.inverse().direction(&(xyz - self.origin));
        let path = setup.path.placed(&Pose { position: shift, ..Pose::identity() });
        let plan = Plan {
            robot: setup.robot.clone(),
            trajectory: Trajectory::stations(&path, &setup.tempo, STATIONS),
            path,
            shaper: setup.shaper.clone(),
            mean_force: setup.cut.mean_force(),
            chip: setup.chip,
            bending: setup.bending,
        };
        let desired = (plan.trajectory.position.as_slice(), &plan.trajectory.axis);
        let Ok(joints) = joint_trajectory(&plan.robot, &plan.path, &plan.trajectory, desired, setup.start)
        else {
            return Place { max: f64::NAN, mean: f64::NAN, mark: Mark::Unreachable };
        };
        let acting = Sources::only(Source::Deflection);
        let bent = deviate(&plan, &plan.passage(acting), &joints.q);
        let (mean, max) = contour::mean_and_max(&bent.contour_error);
        let outside = |q: &Joints| {
            let ranges = plan.robot.limits().into_iter().flatten();
            ranges.zip(q.iter()).any(|((low, high), q)| !(low..=high).contains(&q))
        };
        let near = |margin: &Margin| {
            margin.wrist < ANGLE_MARGIN || margin.elbow < ANGLE_MARGIN || margin.shoulder < SHOULDER_MARGIN
        };
        let jumps = joints.q.windows(2).any(|pair| (pair[1] - pair[0]).amax() > STATION_JUMP);
        let mark = if joints.q.iter().any(outside) {
            Mark::Limit
        } else if jumps || joints.margin.iter().any(near) {
            Mark::Singular
        } else {
            Mark::Good
        };
        Place { max, mean, mark }
    }

    /// Places worth a look, smallest and largest x, y, z of the workpiece frame's origin in the cell [m]: those that bring the middle of
    /// the path within the arm's length of axis 2.
    pub fn extent(&self) -> [[f64; 2]; 3] {
        let setup = &self.setup;
        let ends = Trajectory::stations(&setup.path, &setup.tempo, STATIONS).position;
        let (mut low, mut high) = (ends[0], ends[0]);
        for point in &ends {
            (low, high) = (low.inf(point), high.sup(point));
        }
        let shoulder = Vector3::new(0.0, 0.0, setup.robot.links()[0].d);
        let home = self.origin + setup.base.direction(&(shoulder - (low + high) / 2.0));
        let reach = setup.robot.reach().1;
        [0, 1, 2].map(|axis| [home[axis] - reach, home[axis] + reach])
    }
}
