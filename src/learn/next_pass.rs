//! The command of the next pass, by iterative learning: what was left is taken back where it was caused.
//!
//! v' = Q (v - a L e) over the samples, with what earlier passes have taught v, the measured error e (actual less desired),
//! the gain a, the shaper undone L ([`Shaper::undo`](crate::motion::Shaper::undo)) and the low pass Q. Where a correction moves
//! the tip by g times as much as is commanded, it converges while |Q (1 - a g)| < 1 (D. Bristow, M. Tharayil, A. Alleyne, A survey of
//! iterative learning control, IEEE Control Syst. Mag. 26(3), 2006): at every frequency that Q lets pass for 0 < a g < 2. Noise
//! n of each pass leaves an error of a g sd(n) / sqrt(1 - (1 - a g)^2). The correction by the model stays as it is, sharp where
//! the cut begins; only what was learned goes through Q.

use crate::compensation::{Compensation, commands};
use crate::deviation::contour::MeanMax;
use crate::deviation::{Reference, Sources, simulate};
use crate::error::Error;
use crate::learn::{MeasuredPass, low_pass};
use crate::motion::Trajectory;
use crate::progress::Progress;
use crate::report::{Report, Taught};
use crate::robot::Joints;
use crate::units::{DEG, MM};
use nalgebra::Vector3;
use std::sync::Arc;

/// How much of an error is taken back at once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LearningGain(f64);

impl LearningGain {
    /// 0.7: two thirds of an error are gone after a pass, and noise is hardly larger than it was.
    pub const USUAL: Self = Self(0.7);

    /// A gain a.
    ///
    /// # Errors
    /// [`Error::Invalid`] unless it is above 0 and at most 1.
    pub fn new(gain: f64) -> Result<Self, Error> {
        if gain > 0.0 && gain <= 1.0 {
            return Ok(Self(gain));
        }
        Err(Error::invalid("gain", gain, "above 0, at most 1"))
    }

    /// The number.
    pub fn value(self) -> f64 {
        self.0
    }

    /// Share of an error that a pass leaves where corrections move the tip by `g` times as much as is commanded: |1 - a g|.
    pub fn left(self, g: f64) -> f64 {
        (1.0 - self.0 * g).abs()
    }

    /// The g from which on the passes do not converge.
    pub fn converges_below(self) -> f64 {
        2.0 / self.0
    }

    /// Standard deviation of the error that white noise of every pass leaves in the end, by that of the noise.
    pub fn noise_floor(self, g: f64) -> f64 {
        let step = self.0 * g;
        step / (1.0 - (1.0 - step) * (1.0 - step)).sqrt()
    }
}

/// The next pass.
#[derive(Debug, Clone, PartialEq)]
pub struct NextPass {
    /// What all passes so far have taught [m], a value for each sample.
    pub learned: Vec<Vector3<f64>>,
    /// The commands, from the desired path [m].
    pub correction: Vec<Vector3<f64>>,
    /// The joint commands [rad].
    pub q: Arc<Vec<Joints>>,
    /// What the low pass saw of the error of the pass that was measured [m].
    pub before: MeanMax,
    /// What would be left of it if it comes back and corrections move the tip as they are commanded [m].
    pub after: MeanMax,
    /// That, at the samples that were measured [m].
    pub left: Vec<Vector3<f64>>,
}

/// What was learned after a pass: `learned` [m] before it, its `error` (actual less desired [m], zero where none was measured), the
/// gain, and the width of the low pass in samples; 0 for none.
pub fn learned(
    report: &Report,
    (learned, error): (&[Vector3<f64>], &[Vector3<f64>]),
    gain: LearningGain,
    width: f64,
) -> Vec<Vector3<f64>> {
    let Trajectory { sample_time, moving, .. } = *report.plan.trajectory;
    let wanted: Vec<Vector3<f64>> = error.iter().map(|error| error * -gain.0).collect();
    let change = report.plan.shaper().undo(&wanted, sample_time, moving);
    let sum = |(k, change): (usize, &Vector3<f64>)| learned.get(k).copied().unwrap_or_default() + change;
    let sum: Vec<_> = change.iter().enumerate().map(|(k, change)| Some(sum((k, change)))).collect();
    let mut passed: Vec<_> =
        low_pass::smoothed(&sum, width).into_iter().map(Option::unwrap_or_default).collect();
    // The command rests once it has arrived.
    if let Some(arrived) = passed.get(moving - 1).copied() {
        passed[moving..].fill(arrived);
    }
    passed
}

impl NextPass {
    /// After a measured pass.
    ///
    /// # Errors
    /// [`Error::Invalid`] of a log without positions; [`Error::Unreachable`] if the commands are.
    pub fn of(report: &Report, measured: &MeasuredPass, gain: LearningGain) -> Result<Self, Error> {
        if measured.error.is_empty() {
            let expected = "positions, deviations, angles behind the gears or probed points: a force does not say where the tip was";
            return Err(Error::invalid("log", "a log of forces alone", expected));
        }
        let plan = &report.plan;
        let step = plan.trajectory.sample_time;
        let error: Vec<Vector3<f64>> = measured.error.iter().map(|error| error.unwrap_or_default()).collect();
        let width = low_pass::width(measured.corner) / step;
        let before = &measured.commanded.learned;
        let learned = learned(report, (before, &error), gain, width);
        let change: Vec<Vector3<f64>> =
            learned.iter().enumerate().map(|(k, v)| v - before.get(k).copied().unwrap_or_default()).collect();
        let correction: Vec<Vector3<f64>> =
            measured.correction.iter().zip(&change).map(|(c, more)| c + more).collect();
        let axis =
            if measured.commanded.corrected { &report.compensation.axis } else { &plan.trajectory.axis };
        let q = commands(plan, &report.q[0], (&correction, axis), &mut Progress::none())?;
        let moved = plan.shaper().apply(&change, step);
        let known = || measured.smooth.iter().enumerate().filter_map(|(k, error)| Some((k, (*error)?)));
        let seen: Vec<_> = known().map(|(_, error)| error).collect();
        let left: Vec<_> = known().map(|(k, error)| error + measured.seen.part(k, &moved[k])).collect();
        Ok(Self { learned, correction, q, before: MeanMax::of(&seen), after: MeanMax::of(&left), left })
    }

    /// The run with these commands, to be written as programs. Its figures are the model's, which does not know why the
    /// commands are as they are; [`Taught`] has those that count.
    pub fn report(&self, report: &Report) -> Report {
        let reference = Reference::along(&report.plan, Sources::ALL);
        let result = Arc::new(simulate(&report.plan, &reference, &self.q, &mut Progress::none()));
        let compensation = Compensation {
            correction: self.correction.clone(),
            q: self.q.clone(),
            result: result.clone(),
            ..report.compensation.clone()
        };
        Report {
            compensation,
            after: result,
            taught: Some(Taught { measured: self.before, expected: self.after }),
            alone: Default::default(),
            fingerprint: Default::default(),
            ..report.clone()
        }
    }

    /// The commands as a table, one row for each sample: time, arc length, position and correction in the frame of the workpiece,
    /// joint angles.
    pub fn table(&self, report: &Report) -> String {
        let trajectory = &report.plan.trajectory;
        let into = report.setup().workpiece.inverse();
        let mut text = String::from(
            "time_s,s_mm,x_mm,y_mm,z_mm,dx_mm,dy_mm,dz_mm,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n",
        );
        for (k, q) in self.q.iter().enumerate() {
            let point = into.point(&(trajectory.position[k] + self.correction[k])) / MM;
            let shift = into.direction(&self.correction[k]) / MM;
            let first = [k as f64 * trajectory.sample_time, trajectory.timing.arc_length[k] / MM];
            let lengths = first.iter().chain(point.iter()).chain(shift.iter()).map(|v| number(*v, 5));
            let cells: Vec<String> = lengths.chain(q.iter().map(|q| number(q / DEG, 6))).collect();
            text.push_str(&cells.join(","));
            text.push('\n');
        }
        text
    }
}

/// A number with at most so many decimals, without zeros at its end.
fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.trim_end_matches('0').trim_end_matches('.') {
        "-0" => "0".to_owned(),
        short => short.to_owned(),
    }
}
