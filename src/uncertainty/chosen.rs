//! The places along the path at which the band is computed.

use crate::uncertainty::NominalErrors;
use nalgebra::Vector3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// What straight lines between the places may miss of the deflection, as a share of its maximum, and
/// the share of the largest estimate below which a maximum decides nothing.
const MISSED: f64 = 0.01;

/// Places all along the path, where another plant may err without the nominal one.
const ALONG: usize = 24;

/// Samples to look at, rising: the first, the last, the largest error without compensation, all local
/// maxima of the estimated quantile [m] and of the nominal rest, then always the sample where
/// straight lines between those chosen miss the deflection most. At most `count`; of more maxima,
/// the highest.
pub(super) fn places(
    estimate: &[f64],
    errors: &NominalErrors,
    varies_filter: bool,
    count: usize,
) -> Vec<usize> {
    let samples = estimate.len();
    if samples <= count {
        return (0..samples).collect();
    }
    let rest: Vec<f64> = errors.after.iter().map(Vector3::norm).collect();
    // With another frequency of the filter, the shaping error grows where it is already present.
    let varied = if varies_filter { errors.before } else { errors.deflection };
    let deflection: Vec<f64> = varied.iter().map(Vector3::norm).collect();
    let scale = if varies_filter { largest(&deflection).0 } else { 0.0 };
    let least = MISSED * largest(estimate).0.max(scale);
    let mut maxima: Vec<(f64, usize)> = [estimate, &rest, &deflection[..]]
        .into_iter()
        .flat_map(|signal| {
            let is_maximum = |k: &usize| {
                let [before, here, after] = [signal[k - 1], signal[*k], signal[k + 1]];
                here > least && here >= before && here >= after && (here > before || here > after)
            };
            (1..samples - 1).filter(is_maximum).map(move |k| (signal[k], k))
        })
        .collect();
    maxima.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let before: Vec<f64> = errors.before.iter().map(Vector3::norm).collect();
    let mut chosen = vec![0, largest(&before).1, samples - 1];
    chosen.extend((1..ALONG).map(|k| k * (samples - 1) / ALONG));
    chosen.extend(maxima.iter().map(|(_, k)| *k).take(count * 3 / 4));
    chosen.sort_unstable();
    chosen.dedup();
    let least = MISSED * largest(&deflection).0;
    let mut gaps: BinaryHeap<(u64, Reverse<usize>, usize, usize)> = BinaryHeap::new();
    let offer = |gaps: &mut BinaryHeap<_>, from: usize, to: usize| {
        if let Some((missed, k)) = worst(&deflection, from, to).filter(|(missed, _)| *missed > least) {
            // Positive floats order like their bits.
            gaps.push((missed.to_bits(), Reverse(from), k, to));
        }
    };
    for pair in chosen.windows(2) {
        offer(&mut gaps, pair[0], pair[1]);
    }
    while chosen.len() < count {
        let Some((_, Reverse(from), k, to)) = gaps.pop() else { break };
        chosen.push(k);
        offer(&mut gaps, from, k);
        offer(&mut gaps, k, to);
    }
    chosen.sort_unstable();
    chosen
}

/// The largest value, and where.
fn largest(signal: &[f64]) -> (f64, usize) {
    let (mut top, mut at) = (0.0, 0);
    for (k, &value) in signal.iter().enumerate() {
        if value > top {
            (top, at) = (value, k);
        }
    }
    (top, at)
}

/// By how much a straight line between two samples misses a signal in between, and where most.
fn worst(signal: &[f64], from: usize, to: usize) -> Option<(f64, usize)> {
    let slope = (signal[to] - signal[from]) / (to - from) as f64;
    let missed = |k: usize| (signal[k] - signal[from] - slope * (k - from) as f64).abs();
    let mut worst: Option<(f64, usize)> = None;
    for k in from + 1..to {
        let missed = missed(k);
        if worst.is_none_or(|(most, _)| missed > most) {
            worst = Some((missed, k));
        }
    }
    worst
}
