//! How fast an error changes.

use crate::math::{self, TAU, pow};
use nalgebra::{Complex, Vector3};

/// Share of the mean square of a series, a value a cycle [s], at frequencies up to `frequency` [Hz], the mean included
/// (Parseval's theorem). 1 if all values are 0.
pub fn share_below(series: &[Vector3<f64>], cycle: f64, frequency: f64) -> f64 {
    let count = series.len();
    let whole: f64 = series.iter().map(Vector3::norm_squared).sum();
    if whole == 0.0 {
        return 1.0;
    }
    let highest = count / 2;
    let most = ((frequency * cycle * count as f64 + 1e-9).floor() as usize).min(highest);
    let below: f64 = (0..=most).map(|line| twice(line, count) * line_square(series, line)).sum();
    (below / (whole * count as f64)).min(1.0)
}

/// Bands of frequencies for a whole decade.
const BANDS_PER_DECADE: f64 = 12.0;

/// Frequencies [Hz] and the root mean square of a series, a value a cycle [s], in a band about each: a line of the spectrum
/// by itself where lines are scarce, and bands of equal ratio where there are many. The mean is left out.
pub fn amplitudes(series: &[Vector3<f64>], cycle: f64) -> Vec<(f64, f64)> {
    let count = series.len();
    let highest = count / 2;
    let mut bands = Vec::new();
    let mut line = 1;
    while line <= highest {
        let next = ((line as f64 * pow(10.0, 1.0 / BANDS_PER_DECADE)).ceil() as usize).max(line + 1);
        let within = line..next.min(highest + 1);
        let middle = 0.5 * (within.start + within.end - 1) as f64;
        let square: f64 = within.map(|line| twice(line, count) * line_square(series, line)).sum();
        bands.push((middle / (count as f64 * cycle), square.sqrt() / count as f64));
        line = next;
    }
    bands
}

/// Each line but the mean, and half the frequency of the cycles, stands twice in the whole spectrum.
fn twice(line: usize, count: usize) -> f64 {
    if line == 0 || 2 * line == count { 1.0 } else { 2.0 }
}

/// Square of the modulus of one line of the discrete Fourier transform, all axes together.
fn line_square(series: &[Vector3<f64>], line: usize) -> f64 {
    let (sin, cos) = math::sin_cos(-TAU * line as f64 / series.len() as f64);
    let turn = Complex::new(cos, sin);
    let mut sums = [Complex::new(0.0, 0.0); 3];
    let mut phase = Complex::new(1.0, 0.0);
    for (k, value) in series.iter().enumerate() {
        // Rounding does not add up over a long series.
        if k % 1024 == 0 {
            let part = (line as u128 * k as u128 % series.len() as u128) as f64 / series.len() as f64;
            let (sin, cos) = math::sin_cos(-TAU * part);
            phase = Complex::new(cos, sin);
        }
        for (sum, v) in sums.iter_mut().zip(value.iter()) {
            *sum += phase * *v;
        }
        phase *= turn;
    }
    sums.iter().map(|sum| sum.norm_sqr()).sum()
}
