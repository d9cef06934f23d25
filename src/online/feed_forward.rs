//! Feed-forward of a measured force: u = -C^ F, with the compliance C^ that the controller assumes.

use crate::online::{Lag, LoopTimes, ahead, modulus};
use nalgebra::Complex;

/// What is measured goes through filter, dead time and arm, and is not changed by what it does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedForward {
    /// Cycle [s].
    pub(super) cycle: f64,
    /// Whole cycles of the dead time, and the part of one that is left.
    pub(super) dead: (usize, f64),
    pub(super) filter: Lag,
    pub(super) arm: Lag,
    /// Share of the assumed deflection that is taken back.
    pub(super) gain: f64,
}

impl FeedForward {
    /// With these times: forces and corrections change little by little, so both lags are those of straight inputs.
    pub fn new(times: &LoopTimes) -> Self {
        let LoopTimes { cycle, dead_time, arm_lag, filter } = *times;
        let cycles = (dead_time / cycle).max(0.0);
        Self {
            cycle,
            dead: (cycles.floor() as usize, cycles.fract()),
            filter: Lag::straight(filter, cycle),
            arm: Lag::straight(arm_lag, cycle),
            gain: 1.0,
        }
    }

    /// The same with another gain than 1: share of the assumed deflection that is taken back.
    pub fn with_gain(self, gain: f64) -> Self {
        Self { gain, ..self }
    }

    /// What is left of an error of one frequency [Hz], |1 - r H(z)|, with the ratio r of assumed to true compliance.
    /// For short cycles H is e^(-j w Td) / ((1 + j w Tr) (1 + j w Tf)).
    pub fn left(&self, ratio: f64, frequency: f64) -> f64 {
        let z = ahead(frequency, self.cycle);
        let (whole, part) = self.dead;
        let dead = ahead(frequency, -(whole as f64) * self.cycle) * (z.inv() * part + (1.0 - part));
        modulus(
            Complex::from(1.0) - dead * self.filter.response(z) * self.arm.response(z) * (ratio * self.gain),
        )
    }

    /// Standard deviation of the correction by that of what is measured, both as lengths: close to sqrt(Ts / 2 Tf) for a
    /// filter that is slow beside the cycle. The arm's lag, which smooths it further, is left out.
    pub fn noise_gain(&self) -> f64 {
        self.filter.noise_gain() * self.gain
    }

    /// The frequency [Hz] below which it leaves less than there was; `None` if it helps at none.
    pub fn helps_below(&self, ratio: f64) -> Option<f64> {
        super::feedback::first_crossing(0.5 / self.cycle, |frequency| self.left(ratio, frequency) - 1.0)
    }
}
