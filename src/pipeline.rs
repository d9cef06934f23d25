//! The pipeline, end to end: from a job to its report.

#[cfg(feature = "full")]
mod spin;

use crate::compensation::{Goal, compensate};
use crate::deviation::{Plan, Source, Sources, contour, deviate, deviate_and_shape};
use crate::error::Error;
use crate::job::Job;
use crate::motion::Trajectory;
use crate::motion::joints::joint_trajectory;
use crate::report::{Report, Warning, warning};
use std::sync::Arc;

/// How far a run has come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stage {
    /// Share of the work done, from 0 to 1, if every pass is needed.
    pub fraction: f64,
    /// What is done next.
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
    // Reading, if there is a program to read; inverse, two deviations, the passes and the final run: weighed alike.
    let reading = if job.path.text.is_some() { 1.0 } else { 0.0 };
    let steps = reading + 4.0 + job.compensation.max_passes as f64;
    let setup =
        job.setup_with(|share| on_progress(Stage { fraction: share / steps, name: "reading the program" }))?;
    let mut tell = |step: usize, name| on_progress(Stage { fraction: (reading + step as f64) / steps, name });
    tell(0, "joint commands");
    let mut plan = Plan {
        robot: setup.robot.clone(),
        trajectory: Trajectory::new(&setup.path, &setup.tempo),
        path: setup.path.clone(),
        shaper: setup.shaper.clone(),
        mean_force: setup.cut.mean_force(),
        chip: setup.chip,
        bending: setup.bending,
    };
    #[cfg(feature = "full")]
    if let Some(freedom) = &setup.freedom {
        tell(0, "spin about the tool axis");
        plan.path = spin::chosen(&plan, &setup, freedom);
    }
    let desired = (plan.trajectory.position.as_slice(), plan.trajectory.axis.as_slice());
    let joints = joint_trajectory(&plan.robot, &plan.path, &plan.trajectory, desired, setup.start)?;
    plan.robot = plan.robot.touched_off_at(&joints.q[0]);
    let plan = plan;
    tell(1, "deflection");
    let on_time = plan.passage(Sources::only(Source::Deflection));
    let deflection_only = Arc::new(deviate(&plan, &on_time, &joints.q));
    tell(2, "shaping");
    let passage = plan.passage(Sources::ALL);
    let (before, shaping_only) = deviate_and_shape(&plan, &passage, &joints.q);
    let (before, shaping_only) = (Arc::new(before), Arc::new(shaping_only));
    tell(3, "compensation");
    let without_force;
    // What acts while the correction is sought: what is to be compensated; all, if nothing is.
    let (known, sought) = match setup.sources {
        Sources { deflection: true, shaping: false } => (&deflection_only, &on_time),
        Sources { deflection: false, shaping: true } => {
            without_force = passage.without_force();
            (&shaping_only, &without_force)
        }
        _ => (&before, &passage),
    };
    let goal = match setup.sources {
        Sources { deflection: false, shaping: false } => Goal { max_passes: 0, ..setup.goal },
        _ => setup.goal,
    };
    let on_pass = |pass| tell(3 + pass, "compensation");
    let compensation = compensate(&plan, sought, setup.start, &joints.q, known, goal, on_pass);
    let after = if sought.acting == Sources::ALL {
        compensation.result.clone()
    } else {
        Arc::new(deviate(&plan, &passage, &compensation.q))
    };
    #[cfg(feature = "full")]
    let spin = setup.freedom.map(|freedom| spin::gain(&plan, &setup, &freedom, &joints.q, &before));
    #[cfg(not(feature = "full"))]
    let spin = None;
    let (_, after_max) = contour::mean_and_max(&after.contour_error);
    let warnings = warning::warnings(&setup, &plan, &joints, &shaping_only, &compensation, after_max);
    let mut report = Report {
        setup,
        plan,
        joints,
        spin,
        deflection_only,
        shaping_only,
        before,
        compensation,
        after,
        warnings,
        alone: Default::default(),
    };
    report.warnings.extend(warning::spindle(&report));
    Ok(report)
}
