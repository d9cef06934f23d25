//! Feedback of a measured position by integral action: u(k) = u(k-1) - ki e(k).
//!
//! Open loop ki z^-d / (1 - z^-1) times the lags of arm and filter; sensitivity S = 1 / (1 + open loop), what is left of an
//! error of one frequency.

use crate::math::TAU;
use crate::online::{Lag, LoopTimes, ahead, argument, modulus};
use nalgebra::Complex;

/// Frequencies at which a response is looked at, from this share of the highest on, in equal ratios.
const LOOKED_AT: usize = 600;
const LOWEST: f64 = 1e-5;
/// Halvings of a bracket.
const HALVINGS: usize = 60;

/// A loop that is closed by a measured position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Feedback {
    pub(super) cycle: f64,
    /// Dead time in cycles.
    pub(super) dead: usize,
    pub(super) filter: Lag,
    pub(super) arm: Lag,
}

impl Feedback {
    /// With these times: a correction is held for its cycle. The dead time is the nearest number of whole cycles, and at
    /// least one: what is measured in a cycle moves the arm in the next.
    pub fn new(times: &LoopTimes) -> Self {
        let LoopTimes { cycle, dead_time, arm_lag, filter } = *times;
        Self {
            cycle,
            dead: ((dead_time / cycle).round_ties_even() as usize).max(1),
            filter: Lag::held(filter, cycle),
            arm: Lag::held(arm_lag, cycle),
        }
    }

    /// The open loop at a frequency [Hz], for the gain 1.
    fn open(&self, frequency: f64) -> Complex<f64> {
        let z = ahead(frequency, self.cycle);
        let dead = ahead(frequency, -(self.dead as f64) * self.cycle);
        dead / (Complex::from(1.0) - z.inv()) * self.arm.response(z) * self.filter.response(z)
    }

    /// What is left of an error of one frequency [Hz]: |S|.
    pub fn left(&self, gain: f64, frequency: f64) -> f64 {
        modulus(self.open(frequency) * gain + 1.0).recip()
    }

    /// The gain from which on the loop is not stable (Nyquist): where the open loop first lags by half a turn, it is to be
    /// less than 1 there. Its modulus falls all the way up to half the frequency of the cycles.
    pub fn largest_stable_gain(&self) -> f64 {
        let crossing = first_crossing(0.5 / self.cycle, |frequency| -0.5 * TAU - self.phase(frequency));
        modulus(self.open(crossing.unwrap_or(0.5 / self.cycle))).recip()
    }

    /// Phase of the open loop [rad], without jumps of a turn.
    fn phase(&self, frequency: f64) -> f64 {
        let z = ahead(frequency, self.cycle);
        let turn = TAU * frequency * self.cycle;
        let lags = argument(self.arm.response(z)) + argument(self.filter.response(z));
        lags - turn * self.dead as f64 + 0.5 * turn - 0.25 * TAU
    }

    /// The gain for which no error grows by more than this factor: the largest |S|, above 1, is this.
    pub fn gain_for_peak(&self, peak: f64) -> f64 {
        let (mut low, mut high) = (0.0, self.largest_stable_gain());
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.peak(middle) < peak {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    /// The largest |S| of a stable loop.
    pub fn peak(&self, gain: f64) -> f64 {
        let highest = 0.5 / self.cycle;
        let at = |index: usize| self.left(gain, looked_at(highest, index));
        let top = (0..=LOOKED_AT).fold(0, |top, index| if at(index) > at(top) { index } else { top });
        // Between its neighbors by the golden section.
        let ends = [top.saturating_sub(1), (top + 1).min(LOOKED_AT)];
        let [mut low, mut high] = ends.map(|index| looked_at(highest, index));
        for _ in 0..HALVINGS {
            let part = 0.381_966_011_250_105_1 * (high - low);
            if self.left(gain, low + part) > self.left(gain, high - part) {
                high -= part;
            } else {
                low += part;
            }
        }
        self.left(gain, 0.5 * (low + high))
    }

    /// The frequency [Hz] below which it leaves less than there was.
    pub fn helps_below(&self, gain: f64) -> Option<f64> {
        first_crossing(0.5 / self.cycle, |frequency| self.left(gain, frequency) - 1.0)
    }

    /// Standard deviation of the motion that noise causes, by the standard deviation of the noise, of a stable loop: the
    /// root of the mean of |1 - S|^2 up to half the frequency of the cycles.
    pub fn noise_gain(&self, gain: f64) -> f64 {
        let highest = 0.5 / self.cycle;
        let square = |frequency: f64| {
            let open = self.open(frequency) * gain;
            (open / (open + 1.0)).norm_sqr()
        };
        let mut sum = square(looked_at(highest, 0)) * looked_at(highest, 0);
        for index in 0..LOOKED_AT {
            let [low, high] = [index, index + 1].map(|index| looked_at(highest, index));
            let middle = 0.5 * (low + high);
            sum += (high - low) / 6.0 * (square(low) + 4.0 * square(middle) + square(high));
        }
        (sum / highest).sqrt()
    }
}

/// One of the frequencies that are looked at [Hz].
fn looked_at(highest: f64, index: usize) -> f64 {
    highest * crate::math::pow(LOWEST, 1.0 - index as f64 / LOOKED_AT as f64)
}

/// The lowest frequency [Hz] at which a function that is negative at first becomes positive; `None` if it is positive at
/// once, or never.
pub(super) fn first_crossing(highest: f64, of: impl Fn(f64) -> f64) -> Option<f64> {
    let above =
        (0..=LOOKED_AT).find(|&index| of(looked_at(highest, index)) >= 0.0).filter(|&index| index > 0)?;
    let [mut low, mut high] = [above - 1, above].map(|index| looked_at(highest, index));
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if of(middle) >= 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(high)
}
