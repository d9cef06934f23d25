//! A log laid over the run that it was measured on: the error at each sample.

use crate::compensation::commands;
use crate::deviation::{Deviation, Reference, Sources, contour, simulate};
use crate::error::Error;
use crate::learn::alignment::{Alignment, Sampled, place};
use crate::learn::log::{Clock, FIELD, Log};
use crate::learn::{frame, low_pass};
use crate::progress::Progress;
use crate::report::Report;
use crate::robot::{Joints, forward, jacobian};
use crate::units::{INCH, MM};
use nalgebra::Vector3;
use std::borrow::Cow;
use std::sync::Arc;

/// Which commands the pass ran.
#[derive(Debug, Clone, PartialEq)]
pub struct Commanded {
    /// Whether the program was corrected by the model, or the desired path.
    pub corrected: bool,
    /// What earlier passes have taught, added to that [m], a value for each sample; empty before the first.
    pub learned: Vec<Vector3<f64>>,
}

/// What is known of a log.
#[derive(Debug, Clone, PartialEq)]
pub struct PassOptions {
    /// What ran.
    pub commanded: Commanded,
    /// The frame of positions, deviations and forces, by its name in [`frame::FRAMES`]; recognised if it is not given.
    pub frame: Option<&'static str>,
    /// From the first row until the run begins [s], or along the path [m]; recognised if it is not given.
    pub shift: Option<f64>,
    /// Corner of the low pass [Hz]; by the noise if it is not given.
    pub corner: Option<f64>,
}

/// In which directions an error was measured.
#[derive(Debug, Clone, PartialEq)]
pub enum Seen {
    /// In all three.
    Everywhere,
    /// Across the path, whose directions these are, one for each sample: along it, a position says when rather than where
    /// the tool was.
    Across(Vec<Vector3<f64>>),
    /// Along the normal of a probed surface, one for each sample.
    Along(Vec<Vector3<f64>>),
}

/// What was measured, by samples of the run.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredPass {
    /// Joint commands of the pass [rad].
    pub q: Arc<Vec<Joints>>,
    /// Its commands, from the desired path [m].
    pub correction: Vec<Vector3<f64>>,
    /// What ran.
    pub commanded: Commanded,
    /// Actual less desired tip in the base frame, as it was read [m]; `None` where nothing was. Empty of a log of forces.
    pub error: Vec<Option<Vector3<f64>>>,
    /// The same through the low pass.
    pub smooth: Vec<Option<Vector3<f64>>>,
    /// What the model expects of the commands [m].
    pub expected: Vec<Vector3<f64>>,
    /// In which directions it was measured.
    pub seen: Seen,
    /// Whether only the deflection of the joints was measured: not what the shaper does.
    pub only_joints: bool,
    /// Force on the tool in the base frame [N], through the low pass; empty if none was measured.
    pub force: Vec<Option<Vector3<f64>>>,
    /// Where the log lies on the run; `None` of points in any order.
    pub alignment: Option<Alignment>,
    /// Whether the log's clock is the time.
    pub by_time: bool,
    /// The frame in which it was measured.
    pub frame: &'static str,
    /// Corner of the low pass [Hz].
    pub corner: f64,
    /// Standard deviation along an axis of what changes from row to row: noise at the most [m].
    pub noise: f64,
    /// Share of the run's samples at which something was measured.
    pub covered: f64,
    /// What was recognised, and what is odd.
    pub said: Said,
}

/// What a log leaves open.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Said {
    /// What was recognised.
    pub recognised: Vec<String>,
    /// What is odd.
    pub odd: Vec<String>,
}

/// Corners of the low pass [Hz]; the highest that keeps the noise small is taken.
const CORNERS: [f64; 6] = [20.0, 10.0, 5.0, 2.0, 1.0, 0.5];
/// Share of the error's root mean square that the noise may have after the low pass.
const NOISY: f64 = 0.05;
/// Arc lengths of a log are rounded to this [m].
const ROUNDED: f64 = 0.1 * MM;
/// LoggedRows that lie further apart leave a gap [s].
const GAP: f64 = 0.25;

impl MeasuredPass {
    /// Lays a log over a run.
    ///
    /// # Errors
    /// [`Error::Invalid`] if it does not lie over the run, or the commands that ran are out of reach.
    pub fn of(report: &Report, log: &Log, options: &PassOptions) -> Result<Self, Error> {
        let pass = RanPass::of(report, &options.commanded)?;
        let mut said = Said::default();
        let log = &*pass.clocked(log, &mut said);
        let mut read = frame::read(&pass, log, options, &mut said)?;
        let places = pass.places(&log.clock, read.alignment.as_ref(), &mut read.errors);
        let step = report.plan.trajectory.sample_time;
        let error = pass.by_sample(&places, &read.errors);
        let normals = read.normals.take().map(|normals| pass.by_sample(&places, &normals));
        let seen = match (normals, read.across) {
            (Some(normals), _) => Seen::Along(normals.into_iter().map(Option::unwrap_or_default).collect()),
            (None, true) => Seen::Across(pass.tangents()),
            (None, false) => Seen::Everywhere,
        };
        let noise = noise(&read.errors);
        let row_step = step * error.len() as f64 / read.errors.values.len().max(1) as f64;
        let size = root_mean_square(error.iter().flatten());
        let quiet = |corner: &f64| noise * low_pass::noise_left(*corner, row_step.max(step)) <= NOISY * size;
        let corner = options.corner.or(CORNERS.into_iter().find(quiet)).unwrap_or(CORNERS[CORNERS.len() - 1]);
        let width = low_pass::width(corner) / step;
        let smooth = low_pass::smoothed(&error, width);
        let force = match &read.forces {
            Some(forces) => low_pass::smoothed(&pass.by_sample(&places, forces), width),
            None => vec![],
        };
        let counted = if error.is_empty() { &force } else { &error };
        let covered = counted.iter().flatten().count() as f64 / counted.len().max(1) as f64;
        if covered < 0.05 {
            let found = format!("{:.0} % of the run", 100.0 * covered);
            return Err(Error::invalid(FIELD, found, "a log that covers at least 5 % of the run"));
        }
        if covered < 0.95 {
            said.odd.push(format!(
                "{:.0} % of the run has no measurement; nothing is learned there",
                100.0 * (1.0 - covered)
            ));
        }
        let expected =
            pass.result.actual.iter().zip(&*pass.reference.target).map(|(tip, target)| tip - target);
        Ok(Self {
            expected: expected.collect(),
            q: pass.q,
            correction: pass.correction,
            commanded: options.commanded.clone(),
            error,
            smooth,
            seen,
            only_joints: log.load.is_some(),
            force,
            alignment: read.alignment,
            by_time: matches!(log.clock, Clock::Time(_)),
            frame: read.frame,
            corner,
            noise,
            covered,
            said,
        })
    }
}

/// The commands of the pass, and what the model makes of them.
pub(super) struct RanPass<'a> {
    pub(super) report: &'a Report,
    pub(super) reference: Reference<'a>,
    pub(super) q: Arc<Vec<Joints>>,
    correction: Vec<Vector3<f64>>,
    pub(super) result: Arc<Deviation>,
    /// Times [s] of the samples.
    pub(super) times: Vec<f64>,
}

impl<'a> RanPass<'a> {
    fn of(report: &'a Report, commanded: &Commanded) -> Result<Self, Error> {
        let plan = &report.plan;
        let reference = Reference::along(plan, Sources::ALL);
        let zero = || vec![Vector3::zeros(); report.samples()];
        let (mut q, mut result) = match commanded.corrected {
            true => (report.compensation.q.clone(), report.after.clone()),
            false => (report.q.clone(), report.before.clone()),
        };
        let mut correction =
            if commanded.corrected { report.compensation.correction.clone() } else { zero() };
        if !commanded.learned.is_empty() {
            for (known, learned) in correction.iter_mut().zip(&commanded.learned) {
                *known += learned;
            }
            let axis = if commanded.corrected { &report.compensation.axis } else { &plan.trajectory.axis };
            q = commands(plan, &report.q[0], (&correction, axis), &mut Progress::none())?;
            result = simulate(plan, &reference, &q, &mut Progress::none()).into();
        }
        let step = plan.trajectory.sample_time;
        let times = (0..report.samples()).map(|k| k as f64 * step).collect();
        Ok(Self { report, reference, q, correction, result, times })
    }

    /// The log with its clock in s or m: a unit that is not stated is that with which it is most nearly as long as the run.
    fn clocked<'l>(&self, log: &'l Log, said: &mut Said) -> Cow<'l, Log> {
        let (at, units): (&[f64], &[(f64, &str)]) = match &log.clock {
            Clock::Time(at) => (at, &[(1.0, "s"), (1e-3, "ms"), (1e-6, "us")]),
            // Read as if they were mm.
            Clock::Length(at) => (at, &[(1.0, "mm"), (1.0 / MM, "m"), (INCH / MM, "in")]),
            Clock::None => return Cow::Borrowed(log),
        };
        let own = |of: &[f64]| of.last().zip(of.first()).map_or(0.0, |(last, first)| last - first);
        let ratio = own(at) / own(self.clock(&log.clock));
        let misses = |unit: f64| if ratio > 0.0 { crate::math::ln(ratio * unit).abs() } else { 0.0 };
        let likest = units.iter().min_by(|a, b| misses(a.0).total_cmp(&misses(b.0)));
        let Some((unit, name)) = likest.filter(|(unit, _)| !log.clock_is_stated && *unit != 1.0) else {
            return Cow::Borrowed(log);
        };
        said.recognised.push(format!("the unit of the first axis is not stated; {name} fits"));
        let at = at.iter().map(|at| at * unit).collect();
        let clock = if matches!(log.clock, Clock::Time(_)) { Clock::Time(at) } else { Clock::Length(at) };
        Cow::Owned(Log { clock, ..log.clone() })
    }

    /// Times [s] or arc lengths [m] of the samples, as the log's clock counts.
    pub(super) fn clock(&self, clock: &Clock) -> &[f64] {
        if matches!(clock, Clock::Time(_)) { &self.times } else { &self.reference.arc_length }
    }

    /// The sample at which each row was measured, with the share of the way to the next; rows outside the run have none.
    /// The errors of rows that the run begins before are left.
    fn places(
        &self,
        clock: &Clock,
        alignment: Option<&Alignment>,
        rows: &mut LoggedRows,
    ) -> Vec<Option<f64>> {
        // A row just before the run, or just after it, is of its first sample or its last.
        let slack = match clock {
            Clock::Time(_) => self.report.plan.trajectory.sample_time,
            _ => ROUNDED,
        };
        let along = |at: f64, on: &[f64]| {
            let (first, last) = (*on.first()?, *on.last()?);
            let held = at.clamp(first, last);
            let (below, share) = place(on, held)?;
            ((held - at).abs() <= slack).then_some(below as f64 + share)
        };
        match (clock, alignment) {
            (Clock::Time(at) | Clock::Length(at), Some(alignment)) => {
                let on = self.clock(clock);
                at.iter().map(|own| along(own - at[0] - alignment.shift, on)).collect()
            }
            _ => rows.s.iter().map(|s| along(*s, &self.reference.arc_length)).collect(),
        }
    }

    /// Values of rows by sample: the mean of those that are nearest to it, else between the next ones before and after.
    fn by_sample(&self, places: &[Option<f64>], rows: &LoggedRows) -> Vec<Option<Vector3<f64>>> {
        let count = self.times.len();
        if rows.values.is_empty() {
            return vec![];
        }
        let mut sums = vec![(Vector3::zeros(), 0u32); count];
        let mut known: Vec<(f64, Vector3<f64>)> = Vec::with_capacity(places.len());
        for (place, value) in places.iter().zip(&rows.values) {
            let (Some(place), Some(value)) = (place, value) else { continue };
            let (sum, rows) = &mut sums[place.round() as usize];
            *sum += value;
            *rows += 1;
            known.push((*place, *value));
        }
        let known = crate::math::rising(known, |(place, _)| *place);
        let widest = GAP / self.report.plan.trajectory.sample_time;
        let mut next = 0;
        let value = |(sample, (sum, rows)): (usize, &(Vector3<f64>, u32))| {
            if *rows > 0 {
                return Some(sum / f64::from(*rows));
            }
            while known.get(next).is_some_and(|(place, _)| *place < sample as f64) {
                next += 1;
            }
            let (before, after) = (known.get(next.checked_sub(1)?)?, known.get(next)?);
            let gap = after.0 - before.0;
            (gap <= widest.max(2.0)).then(|| before.1.lerp(&after.1, (sample as f64 - before.0) / gap))
        };
        sums.iter().enumerate().map(value).collect()
    }

    /// Actual less desired tip [m] of tips at places on the run, across the path.
    pub(super) fn off_path(&self, place: f64, tip: &Vector3<f64>) -> Vector3<f64> {
        let sample = (place.floor() as usize).min(self.times.len() - 1);
        let next = (sample + 1).min(self.times.len() - 1);
        let share = place - sample as f64;
        let s = self.reference.arc_length[sample] * (1.0 - share) + self.reference.arc_length[next] * share;
        let target = self.reference.target[sample].lerp(&self.reference.target[next], share);
        tip - contour::closest(&self.report.plan.path, (s, &target), tip).point
    }

    /// How far bent joints take the tip [m]: at motors' angles, those behind the gears less these [rad].
    pub(super) fn bent(&self, motor: &Joints, turns: &Joints) -> Vector3<f64> {
        let robot = &self.report.plan.robot;
        let frames = forward::frames(robot, motor);
        let tip = frames[5].compose(robot.tool()).position;
        let moves = jacobian::springs(robot, &frames, &tip);
        moves.iter().zip(turns.iter()).map(|((_, moved), turn)| moved * *turn).sum()
    }

    /// What the force of the model and the shaper do where the desired path is commanded [m]: the course that an error
    /// follows, whatever is corrected of it.
    pub(super) fn pattern(&self) -> Vec<Vector3<f64>> {
        let before = &self.report.before.actual;
        before.iter().zip(&*self.reference.target).map(|(tip, target)| tip - target).collect()
    }

    /// Directions of the path where the tool is, one for each sample.
    fn tangents(&self) -> Vec<Vector3<f64>> {
        let path = &self.report.plan.path;
        self.reference.arc_length.iter().map(|s| path.tangent(*s)).collect()
    }

    /// A series of the run by the log's clock.
    pub(super) fn sampled<'s>(&'s self, clock: &Clock, values: &'s [Vector3<f64>]) -> Sampled<'s> {
        Sampled { at: self.clock(clock), values }
    }
}

/// A value for each row of the log, and its arc length [m] where the rows are points in any order.
#[derive(Debug, Clone, Default)]
pub(super) struct LoggedRows {
    pub(super) values: Vec<Option<Vector3<f64>>>,
    pub(super) s: Vec<f64>,
}

/// Standard deviation of white noise along an axis, from how far rows lie off the straight line between their neighbors;
/// what the error itself bends there is in it, so it is a bound.
fn noise(rows: &LoggedRows) -> f64 {
    let bends = rows.values.windows(3).filter_map(|row| Some(row[0]? - row[1]? * 2.0 + row[2]?));
    let (sum, count) = bends.fold((0.0, 0), |(sum, count), bend| (sum + bend.norm_squared(), count + 1));
    if count == 0 { 0.0 } else { (sum / (18 * count) as f64).sqrt() }
}

/// Root of the mean square of lengths.
pub(super) fn root_mean_square<'v>(values: impl Iterator<Item = &'v Vector3<f64>>) -> f64 {
    let (sum, count) = values.fold((0.0, 0usize), |(sum, count), v| (sum + v.norm_squared(), count + 1));
    (sum / count.max(1) as f64).sqrt()
}

/// A length as text.
pub(super) fn millimetres(length: f64) -> String {
    format!("{:.3} mm", length / MM)
}

impl Seen {
    /// What of a vector at a sample of the run is seen.
    pub fn part(&self, sample: usize, vector: &Vector3<f64>) -> Vector3<f64> {
        match self {
            Self::Everywhere => *vector,
            Self::Across(tangents) => vector - tangents[sample] * tangents[sample].dot(vector),
            Self::Along(normals) => normals[sample] * normals[sample].dot(vector),
        }
    }

    /// Number of directions.
    pub(super) fn directions(&self) -> usize {
        match self {
            Self::Everywhere => 3,
            Self::Across(_) => 2,
            Self::Along(_) => 1,
        }
    }
}
