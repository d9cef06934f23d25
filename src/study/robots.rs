//! The same job on every arm of the library.

use crate::at_once::at_once;
use crate::error::Error;
use crate::job::Job;
use crate::math;
use crate::placement;
use crate::progress::Progress;
use crate::report::Report;
use crate::robot::library::{self, Preset};
use crate::study::{Outcome, VariedJob};
use crate::units::DEG;
use serde::Serialize;
use serde_json::json;

/// Where the part is for each arm.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PartPlace {
    /// Where the job has it.
    Kept,
    /// In front of each arm, as [`placement::in_front`] finds it.
    InFront,
    /// Where [`placement::sought`] finds the least error, with the tool turned as it finds best.
    Sought,
}

impl PartPlace {
    /// The place of this name.
    ///
    /// # Errors
    /// [`Error::Invalid`] with all names.
    pub fn named(name: &str) -> Result<Self, Error> {
        match name {
            "kept" => Ok(Self::Kept),
            "front" => Ok(Self::InFront),
            "sought" => Ok(Self::Sought),
            _ => Err(Error::unknown_name("place", name, "one of", ["kept", "front", "sought"])),
        }
    }
}

/// What the job comes to on one arm.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RobotRow {
    /// Key of the arm.
    pub id: &'static str,
    /// Its name.
    pub name: String,
    /// Rated payload [kg].
    pub payload_kg: f64,
    /// Reach of the wrist centre [mm].
    pub reach_mm: f64,
    /// `measured` on it, `published` for it in part or for its type, or `guessed`.
    pub stiffness: &'static str,
    /// Origin of the workpiece frame [mm].
    pub workpiece_mm: [f64; 3],
    /// Turn of the tool about its axis [deg].
    pub spin_deg: f64,
    /// Time of the run [s].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// Mean force [N].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_n: Option<f64>,
    /// Least distance of a joint from its limits [deg]; negative beyond them, none if they are unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit_room_deg: Option<f64>,
    /// Least angle of elbow and wrist from where they are singular, at places along the path [deg].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub singularity_deg: Option<f64>,
    /// What the run says.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// A job to be run on every arm of the library, in its order.
#[derive(Debug)]
pub struct EveryRobot {
    varied: VariedJob,
    job: Job,
    arms: Vec<Preset>,
    place: PartPlace,
}

impl EveryRobot {
    /// Of a job.
    ///
    /// # Errors
    /// Never for a job that was read: an arm that cannot do it is a row with an error.
    pub fn new(job: &Job, place: PartPlace) -> Result<Self, Error> {
        Ok(Self { varied: VariedJob::new(job)?, job: job.clone(), arms: library::robots().collect(), place })
    }

    /// Number of arms.
    pub fn count(&self) -> usize {
        self.arms.len()
    }

    /// What the job comes to on one of them.
    pub fn row(&self, index: usize) -> RobotRow {
        row(&self.varied, &self.job, &self.arms[index], self.place)
    }
}

/// All rows of [`EveryRobot`].
///
/// # Errors
/// See [`EveryRobot::new`].
pub fn robots(job: &Job, place: PartPlace) -> Result<Vec<RobotRow>, Error> {
    let every = EveryRobot::new(job, place)?;
    Ok(at_once(every.count(), |index| every.row(index)))
}

fn row(varied: &VariedJob, job: &Job, arm: &Preset, place: PartPlace) -> RobotRow {
    let mut row = RobotRow {
        id: arm.id,
        name: arm.name(),
        payload_kg: arm.payload_kg,
        reach_mm: arm.wrist_reach_mm(),
        stiffness: match (arm.stiffness_measured, arm.stiffness_assumed) {
            (true, _) => "measured",
            (false, false) => "published",
            (false, true) => "guessed",
        },
        workpiece_mm: job.workpiece_frame.xyz_mm,
        spin_deg: job.spin.angle_deg,
        duration_s: None,
        force_n: None,
        limit_room_deg: None,
        singularity_deg: None,
        outcome: Outcome::default(),
    };
    let on_arm = || -> Result<_, Error> {
        let mut job = varied.with_section("robot", json!({ "preset": arm.id }))?;
        match place {
            PartPlace::Kept => {}
            PartPlace::InFront => job.workpiece_frame.xyz_mm = placement::in_front(&job)?,
            PartPlace::Sought => {
                let sought = placement::sought(&job)?;
                (job.workpiece_frame.xyz_mm, job.spin.angle_deg) = (sought.xyz_mm, sought.spin_deg);
            }
        }
        let report = crate::simulation::judged(&job, &mut Progress::none())?;
        Ok((job, report))
    };
    match on_arm() {
        Ok((job, report)) => {
            row.workpiece_mm = job.workpiece_frame.xyz_mm;
            row.spin_deg = job.spin.angle_deg;
            row.duration_s = Some(report.duration());
            row.force_n = Some(report.mean_force().norm());
            row.limit_room_deg = limit_room(&report).map(|room| room / DEG);
            row.singularity_deg = singularity(&report).map(|angle| angle / DEG);
            row.outcome = Outcome::of_report(&report);
        }
        Err(error) => row.outcome = Outcome::of_error(&error),
    }
    row
}

/// Least distance of a joint from its limits [rad].
fn limit_room(report: &Report) -> Option<f64> {
    let robot = &report.plan.robot;
    robot.limits()?;
    Some(report.q.iter().map(|q| robot.limit_room(q)).fold(f64::INFINITY, f64::min))
}

/// Least angle of elbow and wrist from where they are singular [rad].
fn singularity(report: &Report) -> Option<f64> {
    let stations = report.plan.at_stations(report.plan.path.clone(), placement::STATIONS);
    let joints = stations.joints(&mut Progress::none()).ok()?;
    let sines = joints.margin.iter().map(|margin| margin.elbow.min(margin.wrist));
    Some(math::FRAC_PI_2 - math::acos(sines.fold(1.0, f64::min)))
}
