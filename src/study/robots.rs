//! The same job on every arm of the library.

use crate::error::Error;
use crate::job::Job;
use crate::placement;
use crate::progress::Progress;
use crate::robot::library::{self, Preset};
use crate::study::{Outcome, VariedJob, at_once};
use serde::Serialize;
use serde_json::json;

/// Where the part is for each arm.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PartPlace {
    /// Where the job has it.
    Kept,
    /// In front of each arm, as [`placement::in_front`] finds it.
    InFront,
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
    /// Time of the run [s].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// Mean force [N].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_n: Option<f64>,
    /// What the run says.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// Runs a job on every arm of the library, in its order.
///
/// # Errors
/// Never for a job that was read: an arm that cannot do it is a row with an error.
pub fn robots(job: &Job, place: PartPlace) -> Result<Vec<RobotRow>, Error> {
    let varied = VariedJob::new(job)?;
    let arms: Vec<Preset> = library::robots().collect();
    Ok(at_once(arms.len(), |index| row(&varied, job, &arms[index], place)))
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
        duration_s: None,
        force_n: None,
        outcome: Outcome::default(),
    };
    let on_arm = || -> Result<_, Error> {
        let mut job = varied.with_section("robot", json!({ "preset": arm.id }))?;
        if place == PartPlace::InFront {
            job.workpiece_frame.xyz_mm = placement::in_front(&job)?;
        }
        let report = crate::simulation::run(&job, &mut Progress::none())?;
        Ok((job.workpiece_frame.xyz_mm, report))
    };
    match on_arm() {
        Ok((xyz_mm, report)) => {
            row.workpiece_mm = xyz_mm;
            row.duration_s = Some(report.duration());
            row.force_n = Some(report.mean_force().norm());
            row.outcome = Outcome::of_report(&report);
        }
        Err(error) => row.outcome = Outcome::of_error(&error),
    }
    row
}
