//! The contour error at a place for the part, for a map of places.
//!
//! A place is evaluated at [`STATIONS`] stations along the path instead of all samples, and where a
//! larger force acts between two of them, such as in a plunge; and with the cutting force alone: the
//! shaper's contribution hardly depends on the place. The part keeps its orientation and the tool its
//! fixed spin (for a free spin, the angle it is compared with).
//!
//! After compensation, what is left is how far a drawn plant's tip is from the nominal one's, for the
//! commands take the nominal deflection back. It is measured across the path, at the stations with the
//! largest deflection and a few others. Left out are the shaper with the spread of its frequency, and
//! what the compensation leaves of the nominal error. On smooth paths it agrees with a whole run within
//! 5 %, on one with drilled holes within 12 % (tests/placement.rs).

use crate::cutting::along;
use crate::deviation::contour::MeanMax;
use crate::deviation::{Reference, Source, Sources, simulate};
use crate::error::Error;
use crate::job::Job;
use crate::math::Pose;
use crate::motion::{Shaper, Trajectory};
use crate::path::{Path, Roll};
use crate::placement::drawn::DrawnPlants;
use crate::placement::part::{PartBox, RobotBase};
use crate::plan::Plan;
use crate::progress::Progress;
use crate::report::singularity::{ANGLE_MARGIN, JUMP, SHOULDER_MARGIN};
use crate::robot::Joints;
use crate::robot::inverse::Margin;
use crate::setup::Setup;
use crate::units::MM;
use nalgebra::Vector3;
use std::sync::Arc;

/// Number of stations along the path. On smooth paths the largest error agrees with that over all
/// samples within 2 % (tests/placement.rs).
pub const STATIONS: usize = 121;
/// Places between two stations at which the force is looked at.
const BETWEEN: usize = 128;
/// A force so much larger than at both stations around it has a station of its own, if it is at least
/// this share of the largest.
const LARGER: f64 = 1.02;
const LARGE: f64 = 0.3;
/// A joint that turns further from one station to the next has changed its branch [rad].
const STATION_JUMP: f64 = 12.0 * JUMP;

/// Whether a place is suitable, and if not, why.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PlacementStatus {
    /// Suitable.
    Good,
    /// The arm comes near a singularity, or changes branch.
    Singular,
    /// A joint leaves its range.
    Limit,
    /// The arm cannot reach the whole path on the branch that it starts on.
    Unreachable,
    /// The part's box would be in the robot's base, see [`RobotBase`].
    InBase,
}

/// A place on the map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Largest contour error by the cutting force, before compensation [m]; NaN where the path is
    /// out of reach.
    pub max: f64,
    /// Mean contour error by the cutting force, before compensation [m].
    pub mean: f64,
    /// 95 % quantile, over the drawn plants, of the largest contour error after compensation [m]; NaN
    /// where the path is out of reach. If the job does not compensate cutting forces, that with the
    /// desired path commanded.
    pub p95: f64,
    /// Whether the place is suitable.
    pub status: PlacementStatus,
}

/// A job prepared for moving its part.
#[derive(Debug, Clone)]
pub struct PlacementMap {
    /// The job's plan as it is, at stations.
    plan: Plan,
    /// Arc lengths of the stations [m], rising.
    stations: Vec<f64>,
    /// Current origin of the workpiece frame, in the cell [m].
    origin: Vector3<f64>,
    plants: DrawnPlants,
    /// Corners of the part's box from that origin, along the cell's axes [m].
    part: [Vector3<f64>; 8],
    base: RobotBase,
}

/// The arm bent by the cutting force along the path at a place.
struct Bent {
    plan: Plan,
    q: Arc<Vec<Joints>>,
    errors: Vec<Vector3<f64>>,
}

/// The stations of a path.
fn trajectory(path: &Path, setup: &Setup, stations: &[f64]) -> Arc<Trajectory> {
    Arc::new(Trajectory::stations_at(path, &setup.limits, stations))
}

/// Arc lengths of the stations [m], rising: even ones, and where the force is larger between them.
fn stations(setup: &Setup) -> Vec<f64> {
    let dense = Trajectory::stations(&setup.path, &setup.limits, (STATIONS - 1) * BETWEEN + 1);
    let forces = along::forces(&setup.path, &dense.timing, &setup.mean_force, &setup.loading);
    let size: Vec<f64> = forces.iter().map(Vector3::norm).collect();
    let largest = size.iter().copied().fold(0.0, f64::max);
    let mut chosen = vec![0.0];
    for from in (0..size.len() - 1).step_by(BETWEEN) {
        let to = from + BETWEEN;
        let most = (from..=to).fold(from, |most, k| if size[k] > size[most] { k } else { most });
        if size[most] > LARGER * size[from].max(size[to]) && size[most] > LARGE * largest {
            chosen.push(dense.timing.arc_length[most]);
        }
        chosen.push(dense.timing.arc_length[to]);
    }
    chosen
}

/// Mean of values along the path, by length.
fn mean(arc_lengths: &[f64], values: &[Vector3<f64>]) -> f64 {
    let steps = arc_lengths.windows(2).zip(values.windows(2));
    let sum: f64 = steps.map(|(s, e)| (s[1] - s[0]) * (e[0].norm() + e[1].norm()) / 2.0).sum();
    sum / arc_lengths[arc_lengths.len() - 1]
}

impl PlacementMap {
    /// Reads the job's path once, for any number of places.
    ///
    /// # Errors
    /// See [`Setup::of`].
    pub fn new(job: &Job) -> Result<Self, Error> {
        let setup = Setup::of(job, &mut Progress::none())?;
        let setup = Arc::new(Setup { shaper: Shaper::none(), ..setup });
        let stations = stations(&setup);
        let trajectory = trajectory(&setup.path, &setup, &stations);
        let in_cell = setup.base.compose(&setup.workpiece);
        Ok(Self {
            origin: Vector3::from(job.workpiece_frame.xyz_mm) * MM,
            plants: DrawnPlants::of(&setup),
            part: PartBox::of(&setup).corners().map(|corner| in_cell.direction(&corner)),
            base: RobotBase::of(&setup),
            plan: Plan { robot: setup.robot.clone(), path: setup.path.clone(), trajectory, setup },
            stations,
        })
    }

    /// The same with the tool at another fixed spin [rad], counted as in the job.
    pub fn turned(&self, spin: f64) -> Self {
        let path = self.plan.path.clone().with_roll(Roll::fixed(spin));
        Self { plan: Plan { path, ..self.plan.clone() }, ..self.clone() }
    }

    /// The job's setup, without its shaper.
    pub fn setup(&self) -> &Setup {
        &self.plan.setup
    }

    /// Corners of the part's box from the workpiece frame's origin, along the cell's axes [m], see
    /// [`PartBox`].
    pub fn part(&self) -> &[Vector3<f64>; 8] {
        &self.part
    }

    /// The room that the robot's base takes.
    pub fn base(&self) -> &RobotBase {
        &self.base
    }

    /// Evaluates the path with the workpiece frame's origin at `xyz` in the cell [m].
    pub fn at(&self, xyz: Vector3<f64>) -> Place {
        let (place, bent) = self.bent(xyz);
        let p95 = bent.map_or(f64::NAN, |bent| self.plants.p95(&bent.plan, &bent.q, &bent.errors));
        Place { p95, ..place }
    }

    /// The largest contour error before compensation at a suitable place [m]: it takes a third of the time.
    pub(super) fn largest_before(&self, xyz: Vector3<f64>) -> Option<f64> {
        let (place, _) = self.bent(xyz);
        (place.status == PlacementStatus::Good).then_some(place.max)
    }

    /// A place without its quantile, and what that is found from.
    fn bent(&self, xyz: Vector3<f64>) -> (Place, Option<Bent>) {
        let shift = self.plan.setup.base.inverse().direction(&(xyz - self.origin));
        let path = self.plan.path.placed(&Pose { position: shift, ..Pose::identity() });
        let trajectory = trajectory(&path, &self.plan.setup, &self.stations);
        let plan = Plan { path, trajectory, ..self.plan.clone() };
        let Ok(joints) = plan.joints(&mut Progress::none()) else {
            let none = f64::NAN;
            let status = PlacementStatus::Unreachable;
            return (Place { max: none, mean: none, p95: none, status }, None);
        };
        let reference = Reference::along(&plan, Sources::only(Source::Deflection));
        let bent = simulate(&plan, &reference, &joints.q, &mut Progress::none());
        let MeanMax { max, .. } = bent.statistics;
        let mean = mean(&self.stations, &bent.contour_error);
        let near = |margin: &Margin| {
            margin.wrist < ANGLE_MARGIN || margin.elbow < ANGLE_MARGIN || margin.shoulder < SHOULDER_MARGIN
        };
        let jumps = joints.q.windows(2).any(|pair| (pair[1] - pair[0]).amax() > STATION_JUMP);
        let status = if self.base.is_in(&self.part.map(|corner| corner + xyz)) {
            PlacementStatus::InBase
        } else if !joints.q.iter().all(|q| plan.is_within_limits(q)) {
            PlacementStatus::Limit
        } else if jumps || joints.margin.iter().any(near) {
            PlacementStatus::Singular
        } else {
            PlacementStatus::Good
        };
        (
            Place { max, mean, p95: f64::NAN, status },
            Some(Bent { plan, q: joints.q, errors: bent.contour_error }),
        )
    }

    /// Range of places worth mapping: smallest and largest x, y, z of the workpiece frame's origin
    /// in the cell [m] that bring the middle of the path within the arm's reach of axis 2.
    pub fn extent(&self) -> [[f64; 2]; 3] {
        let setup = &self.plan.setup;
        let ends = &self.plan.trajectory.position;
        let (mut low, mut high) = (ends[0], ends[0]);
        for point in ends {
            (low, high) = (low.inf(point), high.sup(point));
        }
        let shoulder = Vector3::new(0.0, 0.0, setup.robot.links()[0].d);
        let home = self.origin + setup.base.direction(&(shoulder - (low + high) / 2.0));
        let reach = setup.robot.reach().1;
        [0, 1, 2].map(|axis| [home[axis] - reach, home[axis] + reach])
    }
}
