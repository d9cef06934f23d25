//! A first guess from the extrema of a vibration.

use super::decay::{Decay, Samples};
use crate::math;

/// Smallest excursion that counts, as a share of the largest, so that noise below it makes no
/// extrema. The lower shares are used where too few count.
const COUNTS: [f64; 3] = [0.15, 0.05, 0.02];
/// Number of extrema that a guess needs: one and a half cycles.
const FEWEST: usize = 4;

/// The sample furthest from the signal's mean.
pub(super) fn largest(samples: &Samples<'_>) -> usize {
    let mean = samples.mean();
    let far = |k: &usize| (samples.value[*k] - mean).abs();
    (0..samples.len()).max_by(|a, b| far(a).total_cmp(&far(b)).then(b.cmp(a))).unwrap_or(0)
}

/// Frequency from the time between extrema, decay rate from a straight line through the logarithms
/// of their heights.
pub(super) fn guess(samples: &Samples<'_>) -> Option<Decay> {
    let mean = samples.mean();
    let height = samples.value.iter().map(|v| (v - mean).abs()).fold(0.0, f64::max);
    if height <= 0.0 {
        return None;
    }
    let mut extrema = COUNTS
        .iter()
        .map(|share| beyond(samples, mean, share * height))
        .find(|extrema| extrema.len() >= FEWEST)?;
    if extrema.len() > FEWEST && extrema[0].0 <= samples.time[0] {
        // The signal was already falling: this is its beginning, not an extremum.
        extrema.remove(0);
    }
    let n = extrema.len() as f64;
    let half = (extrema.last()?.0 - extrema[0].0) / (n - 1.0);
    let logs: Vec<(f64, f64)> = extrema.iter().map(|(t, v)| (*t, math::ln(v.abs()))).collect();
    let (t_mean, l_mean) =
        (logs.iter().map(|l| l.0).sum::<f64>() / n, logs.iter().map(|l| l.1).sum::<f64>() / n);
    let fall: f64 = logs.iter().map(|(t, l)| (t - t_mean) * (l - l_mean)).sum();
    let run: f64 = logs.iter().map(|(t, _)| (t - t_mean) * (t - t_mean)).sum();
    Some(Decay { start: samples.time[0], rate: -fall / run, damped: math::PI / half, ..Decay::default() })
}

/// One extremum (time and height) for each run on one side of the mean; a run ends where the signal
/// exceeds `least` on the other side.
fn beyond(samples: &Samples<'_>, mean: f64, least: f64) -> Vec<(f64, f64)> {
    let mut extrema: Vec<(f64, f64)> = Vec::new();
    for (t, v) in samples.time.iter().zip(samples.value) {
        let v = v - mean;
        match extrema.last_mut() {
            Some(last) if last.1 * v > 0.0 && v.abs() > last.1.abs() => *last = (*t, v),
            Some(last) if last.1 * v > 0.0 => {}
            _ if v.abs() > least => extrema.push((*t, v)),
            _ => {}
        }
    }
    extrema
}

/// Slope of the straight line through values by least squares [1/s].
pub(super) fn slope(time: &[f64], value: &[f64]) -> f64 {
    let count = time.len().max(1) as f64;
    let (mean_time, mean) = (time.iter().sum::<f64>() / count, value.iter().sum::<f64>() / count);
    let both: f64 = time.iter().zip(value).map(|(t, v)| (t - mean_time) * (v - mean)).sum();
    let square: f64 = time.iter().map(|t| (t - mean_time) * (t - mean_time)).sum();
    if square > 0.0 { both / square } else { 0.0 }
}
