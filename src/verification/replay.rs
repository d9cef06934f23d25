//! Simulates a program itself, not the samples it was made from, through the whole model.
//!
//! The run has its own timing: the program's moves, feeds, corners and waits, under the job's
//! acceleration. The cut, however, belongs to the part, not to the command: the force follows the
//! direction of the desired path at the place reached, as in the run that made the program. Each
//! point of the program corresponds to the instant of that run at which the same point was
//! commanded. Thinned moves stray from those points by no more than the thinning tolerance.

use crate::deviation::missed::missed;
use crate::deviation::reference::{SampledCut, cut_along};
use crate::deviation::{Deviation, Reference, Sources, simulate};
use crate::error::Error;
use crate::export::commanded_path::CommandedPath;
use crate::export::{Export, ExportOptions};
use crate::motion::joints::{Targets, joint_trajectory_from};
use crate::motion::trajectory::{self, MotionLimits};
use crate::motion::{Shaper, TimingLaw, Trajectory};
use crate::path::unit::{FeedUnit, LengthUnit};
use crate::path::{self, Axes, Path, Program, Segment};
use crate::plan::Plan;
use crate::progress::Progress;
use crate::report::{Report, Statistics};
use crate::verification::Programs;
use nalgebra::Vector3;
use std::sync::Arc;

/// The outcome of a simulated program.
#[derive(Debug, Clone, PartialEq)]
pub struct Replay {
    /// The desired motion that its samples correspond to.
    pub trajectory: Arc<Trajectory>,
    /// Points of the desired path at the shaped motion [m].
    pub target: Vec<Vector3<f64>>,
    /// Tool axes of the desired path at these points.
    pub axis: Axes,
    /// Deviation of its commands from the original desired path, under the sources that act.
    pub deviation: Deviation,
    /// For each sample, the corresponding instant of the report's run, in samples; never
    /// decreasing.
    pub instants: Vec<f64>,
}

impl Replay {
    /// Largest contour error [m].
    pub fn largest(&self) -> f64 {
        self.deviation.statistics.max
    }

    /// Largest distance from a point of the desired `path` to the nearest place that the tip passes [m].
    pub fn missed(&self, path: &Path) -> f64 {
        missed(path, &self.trajectory.timing.arc_length, &self.deviation.actual).max
    }

    /// Largest error by which the compensation judges [m].
    pub fn judged(&self) -> f64 {
        self.deviation.judged.max
    }

    /// Mean and largest contour error [mm].
    pub fn statistics(&self) -> Statistics {
        self.deviation.statistics.into()
    }
}

/// Reads back the file of the format `id` (`gcode`, `apt` or `path-csv`) and simulates it.
///
/// # Errors
/// [`Error::Invalid`] for a format that has no reader; otherwise see [`Programs::export`], the
/// readers and [`run`].
pub fn read_back(
    report: &Report,
    programs: &Programs,
    id: &str,
    options: &ExportOptions,
) -> Result<Replay, Error> {
    if !["gcode", "apt", "path-csv"].contains(&id) {
        let expected = "gcode, apt and path-csv can be read back";
        return Err(Error::invalid("format", format!("\"{id}\""), expected));
    }
    let Export { text, commanded_path, .. } = programs.export(report, id, options)?;
    run(report, &commanded_path, &read(id, &text)?)
}

/// Reads a program written in the format `id`.
fn read(id: &str, text: &str) -> Result<Program, Error> {
    match id {
        "gcode" => {
            let options = path::gcode::Options { field: id.into(), ..Default::default() };
            path::gcode::program(text, &options, |_| {})
        }
        "apt" => path::apt::program(text, &path::apt::Options { field: id, unit: LengthUnit::Mm }, |_| {}),
        _ => {
            let (unit, feed_unit) = (LengthUnit::Mm, FeedUnit::MmPerS);
            path::csv::program(text, &path::csv::Options { field: id, unit, feed_unit }, |_| {})
        }
    }
}

/// Simulates a program that sends the tool along `commanded_path`, every source acting.
///
/// # Errors
/// See [`run_under`].
pub fn run(report: &Report, commanded_path: &CommandedPath, program: &Program) -> Result<Replay, Error> {
    run_under(report, commanded_path, program, Sources::ALL)
}

/// As [`run`], under the sources that act.
///
/// # Errors
/// [`Error::Missing`] for a program without a move; [`Error::Unreachable`] where it is out of
/// reach.
pub fn run_under(
    report: &Report,
    commanded_path: &CommandedPath,
    program: &Program,
    acting: Sources,
) -> Result<Replay, Error> {
    let empty = || Error::missing("program", "a move");
    let commanded = Path::of_program(program).ok_or_else(empty)?.placed(&report.setup().workpiece);
    // A program of points does not define the roll: the report's own is used, at the same fraction
    // of the path.
    let commanded = commanded.rolled_as(&report.plan.path);
    let own = Trajectory::new(&commanded, &MotionLimits { rounded: false, ..report.setup().limits });
    let targets = Targets::desired(&commanded, &own);
    let start = &report.q[0];
    let q = joint_trajectory_from(&report.plan.robot, &targets, start, &mut Progress::none())?.q;
    let instants = instants(&commanded_path.positions(report), &own).ok_or_else(empty)?;
    let (trajectory, share) = standing_for(report, &own, &instants);
    let plan = Plan { trajectory: trajectory.into(), ..report.plan.clone() };
    let timing = plan.timing(acting).into_owned();
    let cut = cut(&plan, &timing, &share, acting);
    let reference = Reference::under(&plan.path, timing, acting, cut);
    let deviation = simulate(&plan, &reference, &q, &mut Progress::none());
    let Reference { target, axis, .. } = reference;
    let target = target.into_owned();
    Ok(Replay { target, axis, deviation, instants, trajectory: plan.trajectory })
}

/// The cut along a timing law, of whose force `share` acts across the tool axis.
fn cut(plan: &Plan, timing: &TimingLaw, share: &[f64], acting: Sources) -> SampledCut {
    let none = Shaper::none();
    let shaper = if acting.shaping { plan.shaper() } else { &none };
    let share = shaper.apply(share, plan.trajectory.sample_time);
    let (mut force, mut stiffness) = cut_along(plan, timing, acting);
    let shrink = |force: &mut Vector3<f64>, axis: &Vector3<f64>, share: f64| {
        let along = axis * axis.dot(force);
        *force = along + (*force - along) * share;
    };
    for (k, share) in share.into_iter().enumerate() {
        let axis = timing.axis(&plan.path, k);
        let grown = stiffness.get_mut(k).map(|stiffness| &mut stiffness.growth);
        force
            .get_mut(k)
            .into_iter()
            .chain(grown.into_iter().flatten())
            .for_each(|force| shrink(force, &axis, share));
    }
    (force, stiffness)
}

/// A command may turn back by so much while a correction changes [m]; further, it is the path that
/// comes back.
const BEHIND: f64 = 0.2e-3;

/// For each sample of the program's own motion, the corresponding instant of the report's run, in
/// samples.
fn instants(commanded: &[Vector3<f64>], own: &Trajectory) -> Option<Vec<f64>> {
    let mut along = Vec::with_capacity(commanded.len());
    let mut segments = Vec::with_capacity(commanded.len());
    let mut length = 0.0;
    along.push(0.0);
    for pair in commanded.windows(2) {
        let step = (pair[1] - pair[0]).norm();
        // Path::new skips segments of zero length, and so does this.
        if step > 0.0 {
            segments.push(Segment::Line { from: pair[0], to: pair[1] });
            length += step;
        }
        along.push(length);
    }
    let path = Path::new(segments)?;
    let rests = rests(own);
    let (mut near, mut furthest) = (0.0, 0.0_f64);
    let mut last = own.position[0];
    let instant = |(k, position): (usize, &Vector3<f64>)| {
        let radius = 3.0 * ((position - last).norm() + (position - path.point(near)).norm()) + 1e-6;
        near = path.closest(position, near, radius).s.clamp(0.0, length);
        // The program goes on: where it comes back the way it went, the way out is behind it.
        let behind = furthest - near;
        if behind > BEHIND {
            let ahead = behind + radius / 2.0;
            near = path.closest(position, furthest + ahead, ahead).s.clamp(0.0, length);
        }
        furthest = furthest.max(near);
        last = *position;
        // Where the report's command rests, many instants share one place: they elapse in step with
        // the program's own rest.
        let first = along.partition_point(|&l| l < near - 1e-9);
        let end = along.partition_point(|&l| l <= near + 1e-9);
        if end > first {
            first as f64 + rests[k] * (end - 1 - first) as f64
        } else {
            let (before, after) = (along[first - 1], along[first]);
            (first - 1) as f64 + (near - before) / (after - before)
        }
    };
    let mut latest = 0.0_f64;
    let forward = |instant: f64| {
        latest = latest.max(instant);
        latest
    };
    Some(own.position.iter().enumerate().map(instant).map(forward).collect())
}

/// For each sample at rest, the elapsed share of that rest; 0 for samples in motion.
fn rests(own: &Trajectory) -> Vec<f64> {
    let speed = &own.timing.speed;
    let mut rests = vec![0.0; speed.len()];
    let mut k = 0;
    while k < speed.len() {
        let end = (k..speed.len()).find(|&i| speed[i] != 0.0).unwrap_or(speed.len());
        for (i, rest) in rests[k..end].iter_mut().enumerate() {
            *rest = i as f64 / (end - k) as f64;
        }
        k = end.max(k + 1);
    }
    rests
}

/// The desired motion that a run of the program corresponds to, and for each sample the share of
/// the force across the tool axis.
///
/// Where the direction jumps from one instant to the next, the force is interpolated as a vector:
/// halfway it is the mean of the two, and thus smaller than either.
fn standing_for(report: &Report, own: &Trajectory, instants: &[f64]) -> (Trajectory, Vec<f64>) {
    let original = &*report.plan.trajectory;
    let last = original.len() - 1;
    let between = |values: &[f64], t: f64| {
        let i = (t.floor() as usize).min(last);
        let next = (i + 1).min(last);
        values[i] + (values[next] - values[i]) * (t - i as f64)
    };
    let arc_length: Vec<f64> = instants.iter().map(|&t| between(&original.timing.arc_length, t)).collect();
    let turned = |&t: &f64| {
        let i = (t.floor() as usize).min(last);
        let (from, to) = (original.timing.heading[i], original.timing.heading[(i + 1).min(last)]);
        let heading = from.lerp(&to, t - i as f64);
        let size = from.norm() + (to.norm() - from.norm()) * (t - i as f64);
        (heading, if size > 0.0 { heading.norm() / size } else { 1.0 })
    };
    let (heading, share) = instants.iter().map(turned).unzip();
    let end = arc_length.len() - 1;
    let speed = (0..=end).map(|k| {
        let (from, to) = (k.saturating_sub(1), (k + 1).min(end));
        (arc_length[to] - arc_length[from]) / ((to - from).max(1) as f64 * own.sample_time)
    });
    let path = &report.plan.path;
    let timing = TimingLaw {
        index: trajectory::indices(path, &arc_length),
        speed: speed.collect(),
        engaged: own.timing.engaged.clone(),
        heading,
        arc_length,
    };
    let position = timing.points(path);
    let axis = Axes::along(path, &timing.arc_length, &timing.index);
    let Trajectory { sample_time, ref stops, time_of_corners, moving, .. } = *own;
    (Trajectory { sample_time, timing, position, axis, stops: stops.clone(), time_of_corners, moving }, share)
}
