//! The places along the path at which the band is computed.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Samples to look at, rising: the first, the last, all local maxima of the signals, then always the
/// sample where straight lines between those chosen miss a signal most. At most `count`; of more
/// maxima, the highest.
pub(super) fn places(signals: &[&[f64]], count: usize) -> Vec<usize> {
    let samples = signals.iter().map(|signal| signal.len()).min().unwrap_or(0);
    if samples <= count {
        return (0..samples).collect();
    }
    let mut maxima: Vec<(f64, usize)> = signals
        .iter()
        .flat_map(|signal| {
            let top = signal.iter().copied().fold(0.0, f64::max);
            let is_maximum = |k: &usize| {
                let [before, here, after] = [signal[k - 1], signal[*k], signal[k + 1]];
                here > 0.0 && here >= before && here >= after && (here > before || here > after)
            };
            (1..samples - 1).filter(is_maximum).map(move |k| (signal[k] / top, k))
        })
        .collect();
    maxima.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut chosen = vec![0, samples - 1];
    chosen.extend(maxima.iter().map(|(_, k)| *k).take(count * 3 / 4));
    chosen.sort_unstable();
    chosen.dedup();
    let mut gaps: BinaryHeap<(u64, Reverse<usize>, usize, usize)> = BinaryHeap::new();
    let offer = |gaps: &mut BinaryHeap<_>, from: usize, to: usize| {
        if let Some((missed, k)) = worst(signals, from, to) {
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

/// By how much a straight line between two samples misses the signals in between, and where most.
fn worst(signals: &[&[f64]], from: usize, to: usize) -> Option<(f64, usize)> {
    let mut worst: Option<(f64, usize)> = None;
    for signal in signals {
        let slope = (signal[to] - signal[from]) / (to - from) as f64;
        for k in from + 1..to {
            let missed = (signal[k] - signal[from] - slope * (k - from) as f64).abs();
            if worst.is_none_or(|(most, _)| missed > most) {
                worst = Some((missed, k));
            }
        }
    }
    worst
}
