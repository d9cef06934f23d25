//! What a loop leaves of an error, cycle by cycle.

use crate::online::{FeedForward, Feedback};
use crate::uncertainty::draw;
use nalgebra::Vector3;
use std::collections::VecDeque;

/// What measures, and how far the arm may be corrected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensor {
    /// Standard deviation of the noise along each axis, as a length [m].
    pub noise: f64,
    /// Seed of the noise.
    pub seed: u64,
    /// Step of what is measured, as a length [m]; 0 for none.
    pub resolution: f64,
    /// Largest correction [m]: a longer one is shortened.
    pub largest_correction: f64,
}

impl Sensor {
    /// Without noise, steps or limits.
    pub const IDEAL: Self = Self { noise: 0.0, seed: 0, resolution: 0.0, largest_correction: f64::INFINITY };

    /// What is read of a true value; noise is drawn in the order of the readings.
    fn read(&self, random: &mut fastrand::Rng, true_value: &Vector3<f64>) -> Vector3<f64> {
        let noisy =
            true_value.map(|v| if self.noise > 0.0 { v + self.noise * draw::normal(random) } else { v });
        if self.resolution > 0.0 {
            noisy.map(|v| (v / self.resolution).round() * self.resolution)
        } else {
            noisy
        }
    }

    fn limited(&self, correction: Vector3<f64>) -> Vector3<f64> {
        let length = correction.norm();
        if length > self.largest_correction {
            correction * (self.largest_correction / length)
        } else {
            correction
        }
    }
}

/// What is left of an `error` [m], a value a cycle, with its measured position fed back.
pub fn fed_back(
    feedback: &Feedback,
    gain: f64,
    sensor: &Sensor,
    error: &[Vector3<f64>],
) -> Vec<Vector3<f64>> {
    let mut random = fastrand::Rng::with_seed(sensor.seed);
    let mut sent = Sent::new(feedback.dead);
    let (mut moved, mut filtered) = ([Vector3::zeros(); 2], [Vector3::zeros(); 2]);
    let mut correction = Vector3::zeros();
    let cycle = |error: &Vector3<f64>| {
        let left = error + feedback.arm.next(&mut moved, sent.arriving(0));
        let measured = feedback.filter.next(&mut filtered, sensor.read(&mut random, &left));
        correction = sensor.limited(correction - measured * gain);
        sent.push(correction);
        left
    };
    error.iter().map(cycle).collect()
}

/// What is left of an `error` [m], a value a cycle, with a deflection fed forward: `assumed` [m] is what the measured
/// force bends the arm by, as the controller believes.
pub fn fed_forward(
    forward: &FeedForward,
    sensor: &Sensor,
    (error, assumed): (&[Vector3<f64>], &[Vector3<f64>]),
) -> Vec<Vector3<f64>> {
    let mut random = fastrand::Rng::with_seed(sensor.seed);
    let (whole, part) = forward.dead;
    let mut sent = Sent::new(whole + 2);
    let (mut moved, mut filtered) = ([Vector3::zeros(); 2], [Vector3::zeros(); 2]);
    let cycle = |(error, assumed): (&Vector3<f64>, &Vector3<f64>)| {
        let measured = forward.filter.next(&mut filtered, sensor.read(&mut random, assumed));
        sent.push(sensor.limited(-measured * forward.gain));
        let arriving = sent.arriving(1) * (1.0 - part) + sent.arriving(0) * part;
        error + forward.arm.next(&mut moved, arriving)
    };
    error.iter().zip(assumed).map(cycle).collect()
}

/// Corrections on their way, the oldest first.
struct Sent(VecDeque<Vector3<f64>>);

impl Sent {
    fn new(cycles: usize) -> Self {
        Self(std::iter::repeat_n(Vector3::zeros(), cycles).collect())
    }

    /// The correction that is this many cycles younger than the oldest.
    fn arriving(&self, younger: usize) -> Vector3<f64> {
        self.0.get(younger).copied().unwrap_or_default()
    }

    /// Sends one, and lets go of the oldest.
    fn push(&mut self, correction: Vector3<f64>) {
        self.0.push_back(correction);
        self.0.pop_front();
    }
}
