//! The command of the next pass, by iterative learning: what was left is taken back where it was caused.
//!
//! v' = Q (v - a L e) over the samples, with what earlier passes have taught v, the measured error e (actual less desired),
//! the gain a, the shaper undone L ([`Shaper::undo`](crate::motion::Shaper::undo)) and the low pass Q. Where a correction moves
//! the tip by g times as much as is commanded, it converges while |Q (1 - a g)| < 1 (D. Bristow, M. Tharayil, A. Alleyne, A survey of
//! iterative learning control, IEEE Control Syst. Mag. 26(3), 2006): at every frequency that Q lets pass for 0 < a g < 2. Noise
//! n of each pass leaves an error of a g sd(n) / sqrt(1 - (1 - a g)^2). The correction by the model stays as it is, sharp where
//! the cut begins; only what was learned goes through Q.

use crate::compensation::commands;
use crate::deviation::contour::MeanMax;
use crate::error::Error;
use crate::learn::{MeasuredPass, low_pass};
use crate::motion::Trajectory;
use crate::progress::Progress;
use crate::report::Report;
use crate::robot::Joints;
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
        Ok(Self { learned, correction, q, before: MeanMax::of(&seen), after: MeanMax::of(&left) })
    }
}
