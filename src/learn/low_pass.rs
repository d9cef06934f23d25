//! A low pass without delay, for what a sensor read all along a run.

use crate::math::{self, TAU};
use nalgebra::Vector3;

/// The kernel ends at so many standard deviations.
const REACH: f64 = 4.0;

/// Width of the Gaussian kernel [s], a standard deviation, whose response is 1 / sqrt(2) at the `corner` [Hz]:
/// exp(-(2 pi f w)^2 / 2).
pub fn width(corner: f64) -> f64 {
    math::ln(2.0).sqrt() / (TAU * corner)
}

/// Values at even times, smoothed by a Gaussian of this width in samples. It is as wide to both sides, so it does not delay.
/// Where values are missing the others count; what has none within the kernel stays missing.
pub fn smoothed(values: &[Option<Vector3<f64>>], width: f64) -> Vec<Option<Vector3<f64>>> {
    let reach = (REACH * width).ceil() as usize;
    if reach == 0 {
        return values.to_vec();
    }
    let weights: Vec<f64> =
        (0..=reach).map(|k| math::exp(-0.5 * (k as f64 / width) * (k as f64 / width))).collect();
    let at = |sample: usize| {
        let (mut sum, mut weight) = (Vector3::zeros(), 0.0);
        for k in sample.saturating_sub(reach)..(sample + reach + 1).min(values.len()) {
            if let Some(value) = values[k] {
                let own = weights[k.abs_diff(sample)];
                sum += value * own;
                weight += own;
            }
        }
        (weight > 0.0).then(|| sum / weight)
    };
    (0..values.len()).map(at).collect()
}

/// Share of a white noise's standard deviation that stays: values stand `step` [s] apart.
pub fn noise_left(corner: f64, step: f64) -> f64 {
    (step / (2.0 * math::PI.sqrt() * width(corner))).sqrt().min(1.0)
}
