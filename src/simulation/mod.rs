//! The pipeline, end to end: from a job to its report.

mod feed_rule;
mod given;
mod remedy;
mod roll;

pub use crate::progress::{Progress, Stage};

use crate::compensation::{Compensation, Question, compensate};
use crate::deviation::{
    Deviation, ErrorsBySource, Largest, Reference, Source, Sources, missed, simulate, simulate_by_source,
};
use crate::error::Error;
use crate::job::Job;
use crate::online::OnlineLoop;
use crate::plan::Plan;
use crate::report::{Report, singularity, warning};
use crate::robot::Joints;
use crate::setup::{Goal, Setup};
use crate::surface::surface;
use crate::uncertainty::{NominalErrors, band};
use std::sync::Arc;

/// Computes a job.
///
/// # Errors
/// An [`Error`] with the invalid field of the job, or the place where its path is out of reach.
pub fn run(job: &Job, progress: &mut Progress) -> Result<Report, Error> {
    let online = OnlineLoop::of(job)?;
    let mut report = judged(job, progress)?;
    let runs = (&*report.before, &*report.after);
    report.surface = surface(&report.plan, runs, (&report.q, &report.compensation.q));
    if let Some(online) = online {
        report.online = Some((online, report.looped().with(&online)?));
    }
    remedy::offer(job, &mut report);
    Ok(report)
}

/// The same as far as the verdict needs it: without the surface that is left, which takes as long as everything
/// else, and without remedies, which take up to a third of it to look for.
///
/// # Errors
/// See [`run`].
pub(crate) fn judged(job: &Job, progress: &mut Progress) -> Result<Report, Error> {
    let steps = Steps::of(job);
    let setup = Setup::of(job, &mut steps.reading(progress))?;
    // Reported before the motion is sampled, which takes a while on a long run.
    steps.part(progress, "joint commands", 0.0, 1.0).at(0.0);
    let mut plan = Plan::new(Arc::new(setup));
    plan.path = roll::chosen(&plan, &mut steps.part(progress, "spin about the tool axis", 0.0, 0.0));
    let joints = plan.joints(&mut steps.part(progress, "joint commands", 0.0, 1.0))?;
    plan.robot = plan.robot.touched_off_at(&joints.q[0]);
    let singular = singularity::singularities(&plan, &joints.q, &joints.margin);
    let (q, branch) = (joints.q, joints.start);
    // Memory is scarce for a long run in a browser, so drop what is no longer needed.
    drop(joints.margin);
    let reference = Reference::along(&plan, Sources::ALL);
    let mut model = steps.part(progress, "deflection and shaping", 1.0, 2.0);
    let before = simulate_by_source(&plan, &reference, &q, &mut model);
    let planned_force = reference.force.clone();
    let (compensation, after, deflection_only) = correct(&plan, reference, &q, &before, &steps, progress);
    let roll = roll::gain(&plan, &q, &before.total);
    let feed_rule = feed_rule::gain(&plan, &planned_force, &before.total)?;
    let ErrorsBySource { total: before, shaping: shaping_only, deflection, force, unsettled } = before;
    let force = if force.is_empty() { planned_force.clone() } else { Arc::new(force) };
    let errors = NominalErrors {
        before: &before.contour_error,
        after: &after.contour_error,
        deflection: &deflection_only.contour_error,
        missed: missed_by(&plan, &after),
    };
    let missed = errors.missed;
    let band = band(&plan, (&q, &compensation.q), &errors);
    let mut report = Report {
        plan,
        q,
        branch,
        roll,
        feed_rule,
        planned_force,
        force,
        unsettled,
        deflection,
        deflection_only,
        shaping_only,
        before,
        compensation,
        after,
        band,
        surface: None,
        taught: None,
        online: None,
        warnings: singular,
        alone: Default::default(),
        fingerprint: Default::default(),
        missed,
    };
    report.warnings = warning::warnings(&report);
    report.warn(given::earlier_model(job));
    Ok(report)
}

/// What of the desired path the tip of a run never reaches.
fn missed_by(plan: &Plan, run: &Deviation) -> Largest {
    let trajectory = &plan.trajectory;
    let due = plan.shaper().apply(&trajectory.timing.arc_length, trajectory.sample_time);
    missed::missed(&plan.path, &due, &run.actual)
}

/// The compensation, its result under every source, and that of the desired path under forces
/// alone.
///
/// Deflection alone is simulated last, unless the passes start from it.
fn correct(
    plan: &Plan,
    reference: Reference,
    q: &Arc<Vec<Joints>>,
    before: &ErrorsBySource,
    steps: &Steps,
    progress: &mut Progress,
) -> (Compensation, Arc<Deviation>, Arc<Deviation>) {
    let sought = plan.sought();
    let early = (sought == Sources::only(Source::Deflection))
        .then(|| deflection_alone(plan, q, &mut steps.part(progress, "deflection", 2.0, 3.0)));
    let without_force = (sought == Sources::only(Source::Shaping)).then(|| reference.without_force());
    let (sought_along, known) = match (&early, &without_force) {
        (Some((on_time, errors)), _) => (on_time, errors),
        (None, Some(without_force)) => (without_force, &before.shaping),
        (None, None) => (&reference, &before.total),
    };
    let question = Question { reference: sought_along, q, before: known, goal: goal(plan) };
    let compensation = compensate(plan, &question, &mut steps.passes(progress, early.is_some()));
    let mut last = steps.part(progress, "all that acts", steps.last(), steps.last() + 1.0);
    let after = match sought {
        Sources::ALL => compensation.result.clone(),
        _ => Arc::new(simulate(plan, &reference, &compensation.q, &mut last.part("", 0.0, 0.5))),
    };
    drop((reference, without_force));
    let deflection_only = match early {
        Some((_, errors)) => errors,
        None => deflection_alone(plan, q, &mut last.part("deflection", 0.5, 1.0)).1,
    };
    (compensation, after, deflection_only)
}

/// The desired path under cutting forces alone: its reference and its result.
fn deflection_alone<'a>(
    plan: &'a Plan,
    q: &[Joints],
    progress: &mut Progress,
) -> (Reference<'a>, Arc<Deviation>) {
    let on_time = Reference::along(plan, Sources::only(Source::Deflection));
    let errors = Arc::new(simulate(plan, &on_time, q, progress));
    (on_time, errors)
}

/// The job's goal, without passes if nothing is to be compensated.
fn goal(plan: &Plan) -> Goal {
    match plan.setup.sources {
        Sources::NONE => Goal { max_passes: 0, ..plan.setup.goal },
        _ => plan.setup.goal,
    }
}

/// The parts of a run, weighted by the time they take. Reading a program, the inverse model, all
/// sources together and deflection alone count 1 each; a pass is an inverse and a forward model and
/// counts 2.
struct Steps {
    reading: f64,
    passes: f64,
}

impl Steps {
    fn of(job: &Job) -> Self {
        let program = if job.path.text.is_some() { 1.0 } else { 0.0 };
        let reading = program + if job.stock.is_none() { 0.0 } else { 1.0 };
        Self { reading, passes: f64::from(job.compensation.max_passes) }
    }

    /// Where deflection alone begins if it comes last, relative to the end of reading.
    fn last(&self) -> f64 {
        2.0 + 2.0 * self.passes
    }

    fn reading<'b>(&self, progress: &'b mut Progress) -> Progress<'b> {
        self.part(progress, "reading the program", -self.reading, 0.0)
    }

    /// The passes, with deflection alone before them or not.
    fn passes<'b>(&self, progress: &'b mut Progress, after_deflection: bool) -> Progress<'b> {
        let from = if after_deflection { 3.0 } else { 2.0 };
        self.part(progress, "compensation", from, from + 2.0 * self.passes)
    }

    /// The part between two steps, relative to the end of reading.
    fn part<'b>(&self, progress: &'b mut Progress, name: &'static str, from: f64, to: f64) -> Progress<'b> {
        let share = |step: f64| (self.reading + step) / (self.reading + self.last() + 1.0);
        progress.part(name, share(from), share(to))
    }
}

/// Reads a job from JSON text and computes it; the report lists the keys that the text leaves at
/// their defaults.
///
/// # Errors
/// See [`Job::from_json`] and [`run`].
pub fn run_json(text: &str, progress: &mut Progress) -> Result<Report, Error> {
    let (job, not_given) = Job::read_json(text)?;
    let mut report = run(&job, progress)?;
    report.warn(given::thesis(&not_given).into_iter().chain(given::defaults(&not_given)));
    Ok(report)
}
