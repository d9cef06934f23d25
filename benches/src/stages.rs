//! The stages of the default job, each timed alone on the output of the earlier ones.

use std::hint::black_box;
use std::sync::Arc;

use armill::compensation::compensate;
use armill::cutting::along;
use armill::deviation::{Deviation, Passage, Plan, Sources, contour, deviate};
use armill::job::Setup;
use armill::motion::joints::{JointTrajectory, joint_trajectory};
use armill::motion::{Pace, Trajectory};
use armill::{Error, Job, Report};

use crate::Work;

/// The default job as JSON text, sampled so finely that it has roughly this many samples. Path,
/// physics and passes stay the same, so that sizes differ in nothing else.
pub fn job(samples: usize) -> String {
    // The default job takes 19.7 s.
    format!("{{\"version\":1,\"motion\":{{\"sample_time_s\":{}}}}}", 20.0 / samples as f64)
}

/// A job, and the input of each of its stages.
pub struct Stages {
    text: String,
    setup: Setup,
    plan: Plan,
    joints: JointTrajectory,
    pace: Pace,
    before: Arc<Deviation>,
    report: Report,
}

/// The stages in order of execution. Deviation contains shaper, force and contour error, as in the
/// job; the passes contain all of them.
pub const STAGES: [Work<Stages>; 9] = [
    ("reading the job", |s| drop(black_box(read(&s.text)))),
    ("path: sampling", |s| drop(black_box(Trajectory::new(&s.setup.path, &s.setup.tempo)))),
    ("motion: joint commands", |s| drop(black_box(joints(&s.setup, &s.plan)))),
    ("motion: shaper", |s| {
        drop(black_box((
            s.plan.shaper.apply(&s.joints.q, s.plan.trajectory.sample_time),
            s.plan.pace(Sources::ALL),
        )));
    }),
    ("cutting: force", |s| {
        drop(black_box(along::forces(&s.plan.path, &s.pace, &s.plan.mean_force, &s.plan.chip)));
    }),
    ("deviation: contour error", |s| {
        let passage = s.passage();
        let places = passage.arc_length.iter().copied().zip(passage.target.iter());
        let errors = places.zip(&s.before.actual);
        drop(black_box(
            errors.map(|(at, tip)| contour::contour_error(&s.plan.path, at, tip)).collect::<Vec<_>>(),
        ));
    }),
    ("deviation: whole", |s| drop(black_box(deviate(&s.plan, &s.passage(), &s.joints.q)))),
    ("compensation: all passes", |s| {
        let Setup { start, goal, .. } = s.setup;
        drop(black_box(compensate(&s.plan, &s.passage(), start, &s.joints.q, &s.before, goal, &mut |_| {})));
    }),
    ("report: summary", |s| drop(black_box(s.report.summary()))),
];

/// A whole job: from its text to the main figures.
///
/// # Errors
/// If the job is invalid.
pub fn whole(text: &str) -> Result<Report, Error> {
    let report = armill::run_json(text, &mut Progress::none())?;
    drop(black_box(report.summary()));
    Ok(report)
}

impl Stages {
    /// Prepares the inputs of the stages of the default job with roughly this many samples.
    ///
    /// # Errors
    /// If the job does not run.
    pub fn new(samples: usize) -> Result<Self, Error> {
        let text = job(samples);
        let report = whole(&text)?;
        let (setup, plan) = (report.setup().clone(), report.plan.clone());
        let joints = joints(&setup, &plan)?;
        let (before, pace) = (report.before.clone(), plan.pace(Sources::ALL).into_owned());
        Ok(Self { text, setup, plan, joints, pace, before, report })
    }

    /// The tool's poses, and the force on it.
    fn passage(&self) -> Passage<'_> {
        Passage::new(&self.plan, self.pace.clone(), Sources::ALL)
    }

    /// The number of samples.
    pub fn samples(&self) -> usize {
        self.report.samples()
    }

    /// The job as text.
    pub fn text(&self) -> &str {
        &self.text
    }
}

fn read(text: &str) -> Result<Setup, Error> {
    Job::from_json(text)?.setup()
}

fn joints(setup: &Setup, plan: &Plan) -> Result<JointTrajectory, Error> {
    let desired = (plan.trajectory.position.as_slice(), &plan.trajectory.axis);
    joint_trajectory(&plan.robot, &plan.path, &plan.trajectory, desired, setup.start)
}
