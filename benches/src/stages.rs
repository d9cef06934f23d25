//! The stages of the default job, each timed alone on the output of the earlier ones.

use std::hint::black_box;
use std::sync::Arc;

use armill::compensation::{Question, compensate};
use armill::cutting::along;
use armill::deviation::{Deviation, Reference, Sources, contour, simulate};
use armill::motion::joints::JointTrajectory;
use armill::motion::{TimingLaw, Trajectory};
use armill::plan::Plan;
use armill::setup::Setup;
use armill::uncertainty::{NominalErrors, band};
use armill::{Error, Job, Progress, Report};

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
    plan: Plan,
    joints: JointTrajectory,
    timing: TimingLaw,
    before: Arc<Deviation>,
    report: Report,
}

/// The stages in order of execution. Deviation contains shaper, force and contour error, as in the
/// job; the passes contain all of them.
pub const STAGES: [Work<Stages>; 10] = [
    ("reading the job", |s| drop(black_box(read(&s.text)))),
    ("path: sampling", |s| drop(black_box(Trajectory::new(&s.plan.path, &s.plan.setup.limits)))),
    ("motion: joint commands", |s| drop(black_box(s.plan.joints(&mut Progress::none())))),
    ("motion: shaper", |s| {
        drop(black_box((
            s.plan.shaper().apply(&s.joints.q, s.plan.trajectory.sample_time),
            s.plan.timing(Sources::ALL),
        )));
    }),
    ("cutting: force", |s| {
        let Setup { mean_force, loading, .. } = &*s.plan.setup;
        drop(black_box(along::forces(&s.plan.path, &s.timing, mean_force, loading)));
    }),
    ("deviation: contour error", |s| {
        let reference = s.reference();
        let places = reference.arc_length.iter().copied().zip(reference.target.iter());
        let errors = places.zip(&s.before.actual);
        drop(black_box(
            errors.map(|(at, tip)| contour::closest(&s.plan.path, at, tip).point - tip).collect::<Vec<_>>(),
        ));
    }),
    ("deviation: whole", |s| {
        drop(black_box(simulate(&s.plan, &s.reference(), &s.joints.q, &mut Progress::none())));
    }),
    ("compensation: all passes", |s| {
        let (reference, goal) = (&s.reference(), s.plan.setup.goal);
        let question = Question { reference, q: &s.joints.q, before: &s.before, goal };
        drop(black_box(compensate(&s.plan, &question, &mut Progress::none())));
    }),
    ("uncertainty: band", |s| {
        let Report { plan, q, before, compensation, after, deflection_only, .. } = &s.report;
        let errors = NominalErrors {
            before: &before.contour_error,
            after: &after.contour_error,
            deflection: &deflection_only.contour_error,
            missed: s.report.missed(),
        };
        drop(black_box(band(plan, (q, &compensation.q), &errors)));
    }),
    // A report keeps its fingerprint, so that is computed apart.
    ("report: summary", |s| drop(black_box((s.report.hash(), s.report.summary())))),
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
        let plan = report.plan.clone();
        let joints = plan.joints(&mut Progress::none())?;
        let (before, timing) = (report.before.clone(), plan.timing(Sources::ALL).into_owned());
        Ok(Self { text, plan, joints, timing, before, report })
    }

    /// The tool's poses, and the force on it.
    fn reference(&self) -> Reference<'_> {
        Reference::by(&self.plan, self.timing.clone(), Sources::ALL)
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
    Setup::of(&Job::from_json(text)?, &mut Progress::none())
}
