//! A first-order lag, cycle by cycle.

use crate::math;
use nalgebra::{Complex, Vector3};

/// y(k) = p y(k-1) + c0 x(k) + c1 x(k-1), with p = e^(-Ts/T): exact for what goes in, held or straight between cycles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lag {
    keep: f64,
    now: f64,
    before: f64,
}

impl Lag {
    /// With the time constant T [s], for an input that is held for each cycle [s]: c0 = 1 - p, c1 = 0.
    pub fn held(time: f64, cycle: f64) -> Self {
        let keep = kept(time, cycle);
        Self { keep, now: 1.0 - keep, before: 0.0 }
    }

    /// The same for an input that goes straight from cycle to cycle: c0 = 1 - (1 - p) T/Ts, c1 = (1 - p) T/Ts - p.
    pub fn straight(time: f64, cycle: f64) -> Self {
        let keep = kept(time, cycle);
        let mean = (1.0 - keep) * time / cycle;
        Self { keep, now: 1.0 - mean, before: mean - keep }
    }

    /// (c0 + c1 / z) / (1 - p / z).
    pub fn response(&self, z: Complex<f64>) -> Complex<f64> {
        (z.inv() * self.before + self.now) / (-z.inv() * self.keep + 1.0)
    }

    /// Standard deviation of what comes out, by that of white noise going in: the root of the sum of squares of its
    /// answer to one pulse.
    pub fn noise_gain(&self) -> f64 {
        let second = self.keep * self.now + self.before;
        (self.now * self.now + second * second / (1.0 - self.keep * self.keep)).sqrt()
    }

    /// The next output; `state` holds the last output and the last input.
    pub fn next(&self, [output, input]: &mut [Vector3<f64>; 2], next: Vector3<f64>) -> Vector3<f64> {
        *output = *output * self.keep + next * self.now + *input * self.before;
        *input = next;
        *output
    }
}

/// e^(-Ts/T); 0 without a lag.
fn kept(time: f64, cycle: f64) -> f64 {
    if time > 0.0 { math::exp(-cycle / time) } else { 0.0 }
}
