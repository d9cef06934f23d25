//! A loop on top of the path: a sensor measures while the arm mills, and every cycle a correction is sent to the arm.
//!
//! A measured force is fed forward ([`FeedForward`]): the deflection that it should cause is taken back. A measured
//! position is fed back ([`Feedback`]): what is left is summed up and taken back, as much in each cycle as stays
//! stable. Both act late, by the cycle, by the dead time between measurement and motion, and by the lags of filter and
//! arm ([`LoopTimes`]); so they help where the error is slow, and a loop with feedback makes fast errors larger. What
//! they leave of an error is computed cycle by cycle ([`simulated`]); how much of it at one frequency, in closed form. The
//! drawn plants are as many as the band has, or an even choice of them.
//!
//! Frequencies f in Hz enter as z = e^(j 2 pi f Ts), with the cycle Ts. Left out: the arm's own modes, which limit a loop at
//! 8 to 25 Hz, jitter of the cycle, and lost measurements.

pub mod compared;
mod cycles;
mod drawn_run;
mod feed_forward;
mod feedback;
mod lag;
mod preset;
pub mod simulated;
pub mod spectrum;
mod summary;

pub use compared::{Comparison, LoopSpectrum, LoopedRun, Measures, OnlineLoop};
pub use feed_forward::FeedForward;
pub use feedback::Feedback;
pub use lag::Lag;
pub use preset::{LoopPreset, PRESETS, SENSORS, SensorPreset};
pub use simulated::Sensor;
pub use summary::{LoopError, OnlineSummary};

use crate::math::{self, TAU};
use nalgebra::Complex;

/// How late a loop acts [s].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoopTimes {
    /// Cycle of the correction, Ts.
    pub cycle: f64,
    /// From the measurement until the arm begins to move, Td.
    pub dead_time: f64,
    /// Lag of the arm's following, Tr.
    pub arm_lag: f64,
    /// Time constant of the filter of what is measured, Tf.
    pub filter: f64,
}

/// Modulus of a complex number: the same bits everywhere, which that of the platform is not.
fn modulus(z: Complex<f64>) -> f64 {
    math::hypot(z.re, z.im)
}

/// Its argument [rad], likewise.
fn argument(z: Complex<f64>) -> f64 {
    math::atan2(z.im, z.re)
}

/// e^(j 2 pi f `delay`): by how much a frequency [Hz] is ahead of a delay [s].
fn ahead(frequency: f64, delay: f64) -> Complex<f64> {
    let (sin, cos) = math::sin_cos(TAU * frequency * delay);
    Complex::new(cos, sin)
}
