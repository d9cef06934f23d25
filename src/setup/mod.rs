//! From the job's keys to the validated model in SI: one file for each section of the job.

mod robot;
mod path;
mod cutting;
mod statics;
mod motion;

pub use cutting::ResolvedMaterial;
pub use robot::robot;

use crate::cutting::along::ChipLoad;
use crate::cutting::{Bending, Cut, LinearForce};
use crate::error::Error;
use crate::job::{Choice, Frame, Job, Source, Sources, fields};
use crate::math::Pose;
use crate::motion::joints::StartBranch;
use crate::motion::roll::RollRange;
use crate::motion::trajectory::MotionLimits;
use crate::motion::{Shaper, Trajectory};
use crate::path::{Path, Roll, SourceProgram};
use crate::progress::Progress;
use crate::robot::Robot;
use crate::units::{DEG, KILOWATT, MM, RPM};
use nalgebra::Vector3;

/// Most samples a job may have; a 1 ms trajectory of half an hour.
const MAX_SAMPLES: f64 = 2e6;

/// The question in SI, checked: what a run starts from.
#[derive(Debug, Clone)]
pub struct Setup {
    /// The arm with its tool.
    pub robot: Robot,
    /// Where its compliance comes from and how far to trust it.
    pub stiffness_note: String,
    /// Whether its compliance is only an order of magnitude.
    pub stiffness_assumed: bool,
    /// The desired path in the base frame.
    pub path: Path,
    /// The robot's base in the cell, whose z axis points up.
    pub base: Pose,
    /// The workpiece in the base frame.
    pub workpiece: Pose,
    /// The program that the path was read from, if it was not drawn from a shape.
    pub program: Option<SourceProgram>,
    /// Range and goal of the tool's roll, if it is free; until it is chosen, the path has the fixed one.
    pub roll_range: Option<RollRange>,
    /// The fixed roll [rad]; a free one is compared with it.
    pub roll: f64,
    /// How the path is travelled.
    pub limits: MotionLimits,
    /// The shaper of the joint commands.
    pub shaper: Shaper,
    /// Undamped natural frequency [rad/s] and damping ratio of the mode it is made for; `None` without
    /// a shaper.
    pub mode: Option<(f64, f64)>,
    /// The cut.
    pub cut: Cut,
    /// Its mean milling force in {T}.
    pub mean_force: LinearForce,
    /// What is cut, and how its coefficients were made.
    pub material: ResolvedMaterial,
    /// Normal rake of the tool [rad].
    pub rake: f64,
    /// How the tool bends, if it does.
    pub bending: Option<Bending>,
    /// Rated power of the spindle [W], if it is known.
    pub spindle_power: Option<f64>,
    /// What sets the chip.
    pub chip: ChipLoad,
    /// Teeth that pass in a second [1/s].
    pub teeth_per_second: f64,
    /// Branch at the start.
    pub start: StartBranch,
    /// When compensation stops.
    pub goal: Goal,
    /// What is compensated.
    pub sources: Sources,
}

/// When compensation stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goal {
    /// Largest contour error to reach [m].
    pub tolerance: f64,
    /// Most passes.
    pub max_passes: usize,
}

impl Setup {
    /// Checks a job and turns it into SI; reports the share of a program that is read.
    ///
    /// # Errors
    /// The first thing that is not legal, with its field, value and what would be legal.
    pub fn of(job: &Job, progress: &mut Progress) -> Result<Self, Error> {
        if job.version != 1 {
            return Err(Error::invalid("version", job.version, "this Armill reads version 1"));
        }
        fields::check_ranges(job)?;
        let robot::BareArm { robot, stiffness_note, stiffness_assumed } = robot::arm(&job.robot)?;
        let robot = robot.with_tool(frame(&job.tool_frame));
        let base = frame(&job.base_frame);
        let statics = statics::of(&job.robot, robot.compliance(), &base)?;
        let robot = statics.into_iter().fold(robot, Robot::with_statics);
        let workpiece = base.inverse().compose(&frame(&job.workpiece_frame));
        let (path, program) = path::desired(job, progress)?;
        let roll = job.spin.angle_deg * DEG;
        let path = path.placed(&workpiece).with_roll(Roll::fixed(roll));
        let roll_range = motion::roll_range(&job.spin)?;
        let (shaper, mode) = motion::shaper(&job.shaper)?;
        let (cut, material) = cutting::cut(job)?;
        let bending = cutting::bending(&job.tool)?;
        let limits = motion::limits(&job.motion, &shaper);
        check_samples(&path, &limits)?;
        let goal = Goal {
            tolerance: job.compensation.tolerance_mm * MM,
            max_passes: job.compensation.max_passes as usize,
        };
        let sources = sources(&job.compensation.sources)?;
        Ok(Self {
            robot,
            stiffness_note,
            stiffness_assumed,
            path,
            base,
            workpiece,
            program,
            roll_range,
            roll,
            limits,
            shaper,
            mode,
            mean_force: cut.mean_force(),
            cut,
            material,
            rake: job.tool.rake_deg.unwrap_or(0.0) * DEG,
            bending,
            spindle_power: match job.cutting.spindle_power_kw {
                Some(Choice::Value(power, _)) => Some(power * KILOWATT),
                _ => None,
            },
            chip: cutting::chip_load(job),
            teeth_per_second: job.cutting.spindle_rpm * RPM * f64::from(job.tool.flutes),
            start: motion::start(job.start_branch),
            goal,
            sources,
        })
    }
}

/// Refuses a job of more samples than are computed.
fn check_samples(path: &Path, limits: &MotionLimits) -> Result<(), Error> {
    let samples = Trajectory::count(path, limits);
    if samples <= MAX_SAMPLES {
        return Ok(());
    }
    let shortest = limits.sample_time * samples / MAX_SAMPLES;
    let expected = format!(
        "the path would take {samples:.0} samples, at most {MAX_SAMPLES:.0} are computed: from {shortest:.4} s on"
    );
    Err(Error::invalid("motion.sample_time_s", limits.sample_time, expected))
}

/// The sources to compensate as a set.
fn sources(list: &[Source]) -> Result<Sources, Error> {
    let has = |source| list.contains(&source);
    let sources = Sources { deflection: has(Source::Deflection), shaping: has(Source::Shaping) };
    if list.len() > usize::from(sources.deflection) + usize::from(sources.shaping) {
        return Err(Error::invalid(
            "compensation.sources",
            "a list with a source twice",
            "name each of deflection and shaping once at most",
        ));
    }
    Ok(sources)
}

/// A frame in SI.
fn frame(given: &Frame) -> Pose {
    Pose::from_xyz_rpy(Vector3::from(given.xyz_mm) * MM, given.rpy_deg.map(|angle| angle * DEG))
}
