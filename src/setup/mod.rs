//! From the job's keys to the validated model in SI, with one file per section of the job.

mod robot;
mod path;
mod cutting;
mod statics;
mod stock;
mod feed_rule;
mod learned;
mod motion;
mod uncertainty;
mod reserved;
mod proposal;
pub mod program;

use stock::StockEngagement;

pub use cutting::ResolvedMaterial;
pub use feed_rule::{FeedByForce, PathInStock};
pub use program::{Controller, ProgramOptions};
pub(crate) use proposal::spindle_speeds;
pub use proposal::{ProposedCutting, proposed_cutting};
pub use robot::robot;
pub(crate) use stock::bounds_of_cuts;
pub use stock::proposed as proposed_stock;

use crate::cutting::{Bending, Cut, HeaviestPlace, Loading, MeanForces, StiffnessAlong};
use crate::error::Error;
use crate::job::{CompensateAt, Frame, Job, Motion, Source, Sources, fields};
use crate::math::Pose;
use crate::model::MODEL;
use crate::motion::joints::StartBranch;
use crate::motion::roll::RollRange;
use crate::motion::trajectory::MotionLimits;
use crate::motion::{Shaper, Trajectory};
use crate::path::{Path, Roll, SourceProgram};
use crate::progress::Progress;
use crate::robot::{Joints, Robot, World};
use crate::spread::Spreads;
use crate::stock::{Blank, Contacts};
use crate::units::{DEG, KILOWATT, MM, RPM};
use nalgebra::Vector3;
use std::sync::Arc;

/// Most samples in a job; half an hour at 1 ms.
const MAX_SAMPLES: f64 = 2e6;

/// The checked job in SI: the input of a run.
#[derive(Debug, Clone)]
pub struct Setup {
    /// The arm with its tool.
    pub robot: Robot,
    /// Source of its compliance, and how far to trust it.
    pub stiffness_note: String,
    /// Whether its compliance is only an order of magnitude.
    pub stiffness_assumed: bool,
    /// Where the controller counts from.
    pub world: World,
    /// Largest speeds of the joints' drives [rad/s], if known.
    pub joint_speeds: Option<Joints>,
    /// Mass that the arm is rated to carry [kg], if known.
    pub payload: Option<f64>,
    /// The desired path in the base frame.
    pub path: Path,
    /// The robot's base in the cell, whose z axis points up.
    pub base: Pose,
    /// The workpiece in the base frame; for the controller, see
    /// [`workpiece_in_world`](Setup::workpiece_in_world).
    pub workpiece: Pose,
    /// The program that the path was read from; `None` for a shape.
    pub program: Option<SourceProgram>,
    /// Range and goal of the tool's roll, if it is free. Until it is chosen, the path has the fixed
    /// roll.
    pub roll_range: Option<RollRange>,
    /// The fixed roll [rad]; the reference for a free one.
    pub roll: f64,
    /// Limits of the motion along the path.
    pub limits: MotionLimits,
    /// The shaper of the joint commands.
    pub shaper: Shaper,
    /// Undamped natural frequency [rad/s] and damping ratio of the shaper's mode; `None` without a
    /// shaper.
    pub mode: Option<(f64, f64)>,
    /// The cut.
    pub cut: Cut,
    /// Mean milling force in {T}.
    pub mean_force: MeanForces,
    /// Stiffness of the cut, if its force follows the deflection.
    pub stiffness: Option<StiffnessAlong>,
    /// What the tool meets along the path, if the engagement follows from a stock.
    pub contacts: Option<Arc<Contacts>>,
    /// That stock.
    pub blank: Option<Arc<Blank>>,
    /// The same in words.
    pub stock: Option<String>,
    /// Whether a stock cannot be followed because the tool axis is not the workpiece's z axis.
    pub tilted_in_stock: bool,
    /// The rule that sets the feeds of the path by the force, and the path as programmed.
    pub feed_rule: Option<FeedByForce>,
    /// Where the force in the stock is largest.
    pub heaviest: Option<HeaviestPlace>,
    /// The material, and how its coefficients were derived.
    pub material: ResolvedMaterial,
    /// Normal rake of the tool [rad].
    pub rake: f64,
    /// How the tool bends, if it does.
    pub bending: Option<Bending>,
    /// Rated spindle power [W], if it is given.
    pub spindle_power: Option<f64>,
    /// Rated spindle torque [N m], if it is given.
    pub spindle_torque: Option<f64>,
    /// Least and largest chip thickness of the tool [m], as far as they are given.
    pub chip_limits: [Option<f64>; 2],
    /// What the load of the cut depends on along the path.
    pub loading: Loading,
    /// Tooth passing frequency [1/s].
    pub teeth_per_second: f64,
    /// Branch at the start.
    pub start: StartBranch,
    /// Stopping criterion of the compensation.
    pub goal: Goal,
    /// What is compensated.
    pub sources: Sources,
    /// How far the true values may be from these.
    pub spreads: Spreads,
    /// What of the tool is brought onto its desired place.
    pub compensate_at: CompensateAt,
    /// What leaves.
    pub output: ProgramOptions,
    /// Time from one correction of a running program to the next [s].
    pub correction_cycle: f64,
    /// From when such a correction is sent until it begins to act [s].
    pub correction_delay: f64,
}

/// Stopping criterion of the compensation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goal {
    /// Largest error to reach [m]: the contour error of what is brought onto the path.
    pub tolerance: f64,
    /// How many times as large as simulated the error may be, at 95 %. A path stays as it is only if
    /// it is within the tolerance even so.
    pub margin: f64,
    /// Largest number of passes.
    pub max_passes: usize,
}

/// Longest name of a job [characters].
const LONGEST_NAME: usize = 100;

impl Setup {
    /// Checks a job and converts it to SI. Reports the fraction of the program that has been read.
    ///
    /// # Errors
    /// The first invalid value, with its field and what is allowed.
    pub fn of(job: &Job, progress: &mut Progress) -> Result<Self, Error> {
        if job.version != 1 {
            return Err(Error::invalid("version", job.version, "this Armill reads version 1"));
        }
        if let Some(model) = job.model.filter(|model| !(1..=MODEL).contains(model)) {
            return Err(Error::invalid("model", model, format!("1 to {MODEL}, the model of this Armill")));
        }
        check_name(job.name.as_deref())?;
        fields::check_ranges(job)?;
        let robot::BareArm {
            robot,
            world,
            joint_speeds,
            maker,
            payload,
            stiffness_note,
            stiffness_assumed,
            spread,
        } = robot::arm(&job.robot)?;
        if let Some(learned) = &job.learned {
            learned::checked(learned)?;
        }
        let stiffness_note = match &job.learned {
            Some(_) => format!("{stiffness_note} Corrected by factors that a measured pass taught."),
            None => stiffness_note,
        };
        let softer = job.learned.as_ref().map_or([1.0; 6], |learned| learned.compliance_factors);
        let robot = robot.softened(&softer).with_tool(frame(&job.tool_frame));
        let base = frame(&job.base_frame);
        let statics = statics::of(&job.robot, (robot.compliance(), &softer), &base)?;
        let robot = statics.into_iter().fold(robot, Robot::with_statics);
        let workpiece = base.inverse().compose(&frame(&job.workpiece_frame));
        // A stock takes about as long to follow as its program to read.
        let read = if job.stock.is_none() { 1.0 } else { 0.5 };
        let (path, program) = path::desired(job, &mut progress.part("", 0.0, read))?;
        let cutter = cutting::cutter(&job.tool)?;
        let (contacts, blank, stock, tilted_in_stock) = match stock::engagement(
            job,
            &path,
            &cutter,
            &mut progress.part("cut in the stock", read, 1.0),
        )? {
            StockEngagement::Stated => (None, None, None, false),
            StockEngagement::Tilted => (None, None, None, true),
            StockEngagement::Followed(contacts, blank, words) => {
                (Some(Arc::new(contacts)), Some(blank), Some(words), false)
            }
        };
        let roll = job.spin.angle_deg * DEG;
        let path = motion::with_reference(path, &job.spin)?;
        let path = path.placed(&workpiece).with_roll(Roll::fixed(roll));
        let roll_range = motion::roll_range(&job.spin)?;
        let (shaper, mode) = motion::shaper(&job.shaper)?;
        let (cut, material) = cutting::cut(job, contacts.as_deref())?;
        let loading = cutting::loading(job, &cut);
        // The stock says where a cut begins.
        let loading = if contacts.is_some() { Loading { run_in: 0.0, ..loading } } else { loading };
        let mean_force = MeanForces::of(&cut, contacts.as_ref());
        let bending = cutting::bending(&job.tool)?;
        let sampled = |sample_time_s| motion::limits(&Motion { sample_time_s, ..job.motion }, &shaper);
        let limits = sampled(job.motion.sample_time_s);
        check_samples(&path, limits.sample_time, sampled)?;
        let (path, contacts, mean_force, feed_rule) =
            match feed_rule::held(job, &path, &mean_force, &loading)? {
                Some((PathInStock { path, contacts, mean_force }, rule)) => {
                    check_samples(&path, limits.sample_time, sampled)?;
                    (path, Some(contacts), mean_force, Some(rule))
                }
                None => (path, contacts, mean_force, None),
            };
        let follows = cutting::follows_deflection(job, contacts.is_some())?;
        let stiffness =
            contacts.as_ref().filter(|_| follows).map(|contacts| StiffnessAlong::of(&cut, contacts));
        let sources = sources(&job.compensation.sources)?;
        let compliance = (*robot.compliance()).into();
        let spreads = uncertainty::spreads(&job.uncertainty, &compliance, spread, &material)?;
        let spreads = match &job.learned {
            Some(learned) => spreads.learned(learned::spread(learned)?),
            None => spreads,
        };
        let goal = Goal {
            margin: spreads.margin(&compliance),
            tolerance: job.compensation.tolerance_mm * MM,
            max_passes: job.compensation.max_passes as usize,
        };
        Ok(Self {
            robot,
            world,
            joint_speeds,
            payload,
            stiffness_note,
            stiffness_assumed,
            heaviest: mean_force.heaviest(&loading, &path),
            path,
            base,
            workpiece,
            program,
            roll_range,
            roll,
            limits,
            shaper,
            mode,
            mean_force,
            stiffness,
            material,
            rake: job.tool.rake_deg.unwrap_or(0.0) * DEG,
            bending,
            spindle_power: job.cutting.spindle_power_kw.and_then(|power| Some(power.number()? * KILOWATT)),
            spindle_torque: job.cutting.spindle_torque_nm.and_then(|torque| torque.number()),
            chip_limits: cutting::chip_limits(&job.tool)?,
            loading,
            contacts,
            feed_rule,
            blank,
            stock,
            tilted_in_stock,
            cut,
            teeth_per_second: job.cutting.spindle_rpm * RPM * f64::from(job.tool.flutes),
            start: motion::start(job.start_branch),
            goal,
            sources,
            spreads,
            compensate_at: job.compensation.at.unwrap_or_default(),
            output: program::options(&job.program, maker)?,
            correction_cycle: job.online.cycle_s,
            correction_delay: job.online.dead_time_s,
        })
    }

    /// Axial depth of cut [m] at a place of the path: its move, and the arc length within it [m].
    pub fn axial_depth_at(&self, (index, within): (usize, f64)) -> f64 {
        let Some(contacts) = &self.contacts else { return self.cut.axial_depth };
        let around = contacts.around(index, within);
        around.map_or(0.0, |(from, to, _)| contacts.at(from).axial_depth().max(contacts.at(to).axial_depth()))
    }

    /// The workpiece as the controller counts: its base, work object or user frame.
    pub fn workpiece_in_world(&self) -> Pose {
        self.world.of_base(&self.workpiece)
    }
}

/// Refuses a name that no file or title can bear.
fn check_name(name: Option<&str>) -> Result<(), Error> {
    let Some(name) = name else { return Ok(()) };
    if name.trim().is_empty() || name.chars().count() > LONGEST_NAME || name.chars().any(char::is_control) {
        let expected = format!("1 to {LONGEST_NAME} characters on one line, or no name");
        return Err(Error::invalid("name", format!("\"{name}\""), expected));
    }
    Ok(())
}

/// Refuses a job with too many samples, with the least sample time that gives few enough, to two
/// digits. Waits in corners may grow with the sample time, so that twice the time is not always half
/// the samples: `limits` has them for each.
fn check_samples(path: &Path, sample_time: f64, limits: impl Fn(f64) -> MotionLimits) -> Result<(), Error> {
    let count = |time| Trajectory::count(path, &limits(time));
    let samples = count(sample_time);
    let mut least = sample_time;
    let mut still = samples;
    while still > MAX_SAMPLES && least <= 1.0 {
        least = two_digits_up(least * still / MAX_SAMPLES);
        still = count(least);
    }
    if samples <= MAX_SAMPLES {
        return Ok(());
    }
    Err(Error::TooManySamples {
        field: "motion.sample_time_s".into(),
        value: sample_time,
        samples,
        most: MAX_SAMPLES,
        least,
    })
}

/// A time [s] rounded up to two digits. Powers of ten from 1 on are exact, so the result is the
/// number that its decimals mean.
fn two_digits_up(time: f64) -> f64 {
    let mut per_second = 1e9;
    while time * per_second > 100.0 && per_second > 1.0 {
        per_second /= 10.0;
    }
    (time * per_second).ceil() / per_second
}

/// The sources to compensate as a set.
fn sources(list: &[Source]) -> Result<Sources, Error> {
    let has = |source| list.contains(&source);
    let sources = Sources { deflection: has(Source::Deflection), shaping: has(Source::Shaping) };
    if list.len() > usize::from(sources.deflection) + usize::from(sources.shaping) {
        return Err(Error::invalid(
            "compensation.sources",
            "a list that names a source twice",
            "name each of deflection and shaping at most once",
        ));
    }
    Ok(sources)
}

/// A frame in SI.
fn frame(given: &Frame) -> Pose {
    Pose::from_xyz_rpy(Vector3::from(given.xyz_mm) * MM, given.rpy_deg.map(|angle| angle * DEG))
}
