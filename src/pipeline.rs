//! The pipeline, end to end: from a job to its report.

mod spin;

use crate::compensation::{Goal, compensate};
use crate::deviation::{Parted, Plan, Source, Sources, deviate_apart, deviate_with};
use crate::error::Error;
use crate::job::Job;
use crate::motion::Trajectory;
use crate::motion::joints::{JointTrajectory, joint_trajectory_with};
use crate::report::{Report, Warning, warning};
use std::sync::Arc;

/// How far a run has come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stage {
    /// Share of the work done, from 0 to 1, if every pass is needed.
    pub fraction: f64,
    /// What is being done.
    pub name: &'static str,
}

/// Computes a job.
///
/// # Errors
/// What is wrong with the job, or where its path is out of reach.
pub fn run(job: &Job) -> Result<Report, Error> {
    run_with(job, |_| {})
}

/// Reads a job from JSON text and computes it; keys that the text leaves to their default are remarked in the report.
///
/// # Errors
/// See [`Job::from_json`] and [`run`].
pub fn run_json(text: &str, on_progress: impl FnMut(Stage)) -> Result<Report, Error> {
    let mut report = run_with(&Job::from_json(text)?, on_progress)?;
    let missing = Job::not_given(text);
    if !missing.is_empty() {
        let message = format!("not given, so the default job's value holds: {}", missing.join(", "));
        report.warnings.push(Warning::new("default-used", message));
    }
    Ok(report)
}

/// Computes a job and tells how far it has come.
///
/// # Errors
/// See [`run`].
pub fn run_with(job: &Job, mut on_progress: impl FnMut(Stage)) -> Result<Report, Error> {
    // By the time it takes: reading, if there is a program to read, inverse, all sources together and deflection alone; a pass is as
    // much as inverse and deviation.
    let reading = if job.path.text.is_some() { 1.0 } else { 0.0 };
    let steps = reading + 3.0 + 2.0 * job.compensation.max_passes as f64;
    let setup =
        job.setup_with(|share| on_progress(Stage { fraction: share / steps, name: "reading the program" }))?;
    let mut tell = |step: f64, name| on_progress(Stage { fraction: (reading + step) / steps, name });
    tell(0.0, "joint commands");
    let mut plan = Plan {
        robot: setup.robot.clone(),
        trajectory: Trajectory::new(&setup.path, &setup.tempo),
        path: setup.path.clone(),
        shaper: setup.shaper.clone(),
        mean_force: setup.cut.mean_force(),
        chip: setup.chip,
        bending: setup.bending,
    };
    if let Some(freedom) = &setup.freedom {
        plan.path = spin::chosen(&plan, &setup, freedom, &mut || tell(0.0, "spin about the tool axis"));
    }
    let desired = (plan.trajectory.position.as_slice(), &plan.trajectory.axis);
    let on_share = &mut |share| tell(share, "joint commands");
    let JointTrajectory { q, margin, start: branch } =
        joint_trajectory_with(&plan.robot, &plan.path, &plan.trajectory, desired, setup.start, on_share)?;
    plan.robot = plan.robot.touched_off_at(&q[0]);
    let plan = plan;
    let singular = warning::singularities(&plan, &q, &margin);
    // What is not needed any more makes room: in a browser a long run has to do with little.
    drop(margin);
    tell(1.0, "deflection and shaping");
    let passage = plan.passage(Sources::ALL);
    let on_share = &mut |share| tell(1.0 + share, "deflection and shaping");
    let Parted { whole, shaping, deflection } = deviate_apart(&plan, &passage, &q, on_share);
    let (before, shaping_only) = (Arc::new(whole), Arc::new(shaping));
    // Deflection alone comes after the passes, unless they start from it.
    let by_deflection = |on_share: &mut dyn FnMut(f64)| {
        on_share(0.0);
        let on_time = plan.passage(Sources::only(Source::Deflection));
        (Arc::new(deviate_with(&plan, &on_time, &q, on_share)), on_time)
    };
    let (on_time, without_force);
    let mut deflection_only = None;
    // What acts while the correction is sought: what is to be compensated; all, if nothing is.
    let (known, sought) = match setup.sources {
        Sources { deflection: true, shaping: false } => {
            let known;
            (known, on_time) = by_deflection(&mut |share| tell(2.0 + share, "deflection"));
            (deflection_only.insert(known).clone(), &on_time)
        }
        Sources { deflection: false, shaping: true } => {
            without_force = passage.without_force();
            (shaping_only.clone(), &without_force)
        }
        _ => (before.clone(), &passage),
    };
    let goal = match setup.sources {
        Sources { deflection: false, shaping: false } => Goal { max_passes: 0, ..setup.goal },
        _ => setup.goal,
    };
    let first = if deflection_only.is_some() { 3.0 } else { 2.0 };
    let on_pass = &mut |passes| tell(first + 2.0 * passes, "compensation");
    let compensation = compensate(&plan, sought, setup.start, &q, &known, goal, on_pass);
    let after = if sought.acting == Sources::ALL {
        compensation.result.clone()
    } else {
        let on_share = &mut |_| tell(steps - reading - 1.0, "all that acts");
        Arc::new(deviate_with(&plan, &passage, &compensation.q, on_share))
    };
    let force = passage.force.clone();
    drop(passage);
    let last = steps - reading - 1.0;
    let deflection_only =
        deflection_only.unwrap_or_else(|| by_deflection(&mut |share| tell(last + share, "deflection")).0);
    let spin = setup.freedom.map(|freedom| spin::gain(&plan, &setup, &freedom, &q, &before));
    let mut report = Report {
        setup,
        plan,
        q,
        branch,
        spin,
        force,
        deflection,
        deflection_only,
        shaping_only,
        before,
        compensation,
        after,
        warnings: Vec::new(),
        alone: Default::default(),
    };
    report.warnings = warning::warnings(&report, singular);
    Ok(report)
}
