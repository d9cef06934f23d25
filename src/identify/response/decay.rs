//! One damped sinusoid and its least squares fit.

use super::Measured;
use crate::math;
use nalgebra::{Matrix3, Matrix5, Vector3, Vector5};

/// Maximum number of passes of a fit.
const MOST_PASSES: usize = 60;
/// A step smaller than this share of the frequency ends the fit.
const AT_REST: f64 = 1e-12;

/// A part of a signal.
#[derive(Clone, Copy)]
pub(super) struct Samples<'a> {
    /// [s]
    pub(super) time: &'a [f64],
    pub(super) value: &'a [f64],
}

/// exp(-rate t) (cosine cos(damped t) + sine sin(damped t)) + offset, with t counted from `start`.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Decay {
    /// [s]
    pub(super) start: f64,
    pub(super) cosine: f64,
    pub(super) sine: f64,
    pub(super) offset: f64,
    /// zeta w [1/s].
    pub(super) rate: f64,
    /// w_d [rad/s].
    pub(super) damped: f64,
}

impl Decay {
    /// Undamped natural frequency [rad/s] and damping ratio.
    pub(super) fn undamped(&self) -> (f64, f64) {
        let frequency = math::hypot(self.rate, self.damped);
        (frequency, self.rate / frequency)
    }

    pub(super) fn amplitude(&self) -> f64 {
        math::hypot(self.cosine, self.sine)
    }

    /// The factors of cosine and sine.
    fn waves(&self, time: f64) -> (f64, f64) {
        let t = time - self.start;
        let envelope = math::exp(-self.rate * t);
        let (sin, cos) = math::sin_cos(self.damped * t);
        (envelope * cos, envelope * sin)
    }

    pub(super) fn at(&self, time: f64) -> f64 {
        let (cos, sin) = self.waves(time);
        self.cosine * cos + self.sine * sin + self.offset
    }

    /// Derivatives by cosine, sine, offset, rate and damped frequency.
    fn slopes(&self, time: f64) -> Vector5<f64> {
        let (cos, sin) = self.waves(time);
        let t = time - self.start;
        let (wave, quarter) = (self.cosine * cos + self.sine * sin, self.sine * cos - self.cosine * sin);
        Vector5::new(cos, sin, 1.0, -t * wave, t * quarter)
    }

    /// Undamped natural frequency and damping ratio with their intervals; `reach` is the standard
    /// deviation of a sample times Student's t. The variances of rate and damped frequency are
    /// propagated through w^2 = rate^2 + w_d^2, zeta = rate / w to first order.
    pub(super) fn uncertain(&self, samples: &Samples<'_>, reach: f64) -> (Measured, Measured) {
        let (frequency, damping) = self.undamped();
        let mut normal = Matrix5::zeros();
        for &time in samples.time {
            let slopes = self.slopes(time);
            normal += slopes * slopes.transpose();
        }
        let half = |by_rate: f64, by_damped: f64| {
            let direction = Vector5::new(0.0, 0.0, 0.0, by_rate, by_damped);
            let solved = normal.cholesky().map(|factor| direction.dot(&factor.solve(&direction)));
            solved.map_or(f64::INFINITY, |variance| reach * variance.sqrt())
        };
        let cube = frequency * frequency * frequency;
        let of_frequency = half(self.rate / frequency, self.damped / frequency);
        let of_damping = half(self.damped * self.damped / cube, -self.rate * self.damped / cube);
        (Measured { value: frequency, half: of_frequency }, Measured { value: damping, half: of_damping })
    }
}

impl<'a> Samples<'a> {
    pub(super) fn len(&self) -> usize {
        self.time.len()
    }

    pub(super) fn part(&self, from: usize, to: usize) -> Samples<'a> {
        let from = from.min(to);
        Samples { time: &self.time[from..to], value: &self.value[from..to] }
    }

    /// [s]
    pub(super) fn span(&self) -> f64 {
        match self.time {
            [first, .., last] => last - first,
            _ => 0.0,
        }
    }

    pub(super) fn mean(&self) -> f64 {
        self.value.iter().sum::<f64>() / self.len().max(1) as f64
    }

    /// Sum of squares about the mean.
    pub(super) fn variance(&self) -> f64 {
        let mean = self.mean();
        self.value.iter().map(|v| (v - mean) * (v - mean)).sum()
    }

    pub(super) fn minus(&self, decay: &Decay) -> Vec<f64> {
        self.time.iter().zip(self.value).map(|(t, v)| v - decay.at(*t)).collect()
    }

    fn left(&self, decay: &Decay) -> f64 {
        self.time.iter().zip(self.value).map(|(t, v)| (v - decay.at(*t)) * (v - decay.at(*t))).sum()
    }

    /// Fits amplitudes and offset at fixed rate and frequency by linear least squares.
    fn with_amplitudes(&self, mut decay: Decay) -> Decay {
        let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for (&time, &value) in self.time.iter().zip(self.value) {
            let (cos, sin) = decay.waves(time);
            let row = Vector3::new(cos, sin, 1.0);
            normal += row * row.transpose();
            right += row * value;
        }
        if let Some(factor) = normal.cholesky() {
            let solved = factor.solve(&right);
            (decay.cosine, decay.sine, decay.offset) = (solved.x, solved.y, solved.z);
        }
        decay
    }

    /// Least squares by Gauss-Newton steps with Marquardt's damping (D. Marquardt, J. SIAM 11,
    /// 1963): the fit, its passes, and whether it converged.
    pub(super) fn fit(&self, guess: Decay) -> (Decay, usize, bool) {
        let mut decay = self.with_amplitudes(Decay { start: self.time[0], ..guess });
        let mut left = self.left(&decay);
        let mut caution = 1e-3;
        for pass in 1..=MOST_PASSES {
            let (mut normal, mut right) = (Matrix5::zeros(), Vector5::zeros());
            for (&time, &value) in self.time.iter().zip(self.value) {
                let slopes = decay.slopes(time);
                normal += slopes * slopes.transpose();
                right += slopes * (value - decay.at(time));
            }
            for i in 0..5 {
                normal[(i, i)] *= 1.0 + caution;
            }
            let Some(factor) = normal.cholesky() else { return (decay, pass, false) };
            let step = factor.solve(&right);
            let moved = Decay { rate: decay.rate + step[3], damped: (decay.damped + step[4]).abs(), ..decay };
            let tried = self.with_amplitudes(moved);
            let now = self.left(&tried);
            let small = math::hypot(step[3], step[4]) <= AT_REST * decay.damped;
            if now <= left {
                (decay, left) = (tried, now);
                caution *= 0.1;
            } else if !small {
                caution = (caution * 10.0).max(1e-9);
            }
            if small || caution >= 1e12 {
                return (decay, pass, true);
            }
        }
        (decay, MOST_PASSES, false)
    }
}
