//! Quantiles of a sample, and how sure they are.

use crate::spread::COVERAGE;

/// Median and 95 % quantile of a length [m].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Quantiles {
    /// Half of the draws are below.
    pub p50: f64,
    /// 95 % of the draws are below.
    pub p95: f64,
    /// 95 % interval of that quantile itself, for the number of draws.
    pub p95_interval: [f64; 2],
}

impl Quantiles {
    /// Of a sample, in any order.
    pub fn of(mut sample: Vec<f64>) -> Self {
        sample.sort_by(f64::total_cmp);
        let n = sample.len() as f64;
        // The number of draws below the quantile is binomial; normal approximation.
        let half = COVERAGE * (0.95 * 0.05 / n).sqrt();
        Self {
            p50: quantile(&sample, 0.5),
            p95: quantile(&sample, 0.95),
            p95_interval: [quantile(&sample, 0.95 - half), quantile(&sample, (0.95 + half).min(1.0))],
        }
    }
}

/// The quantile of a sorted sample, linear between its values (JCGM 101:2008, 7.7, D.1).
pub fn quantile(sorted: &[f64], share: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return 0.0 };
    let place = (share * sorted.len() as f64 - 0.5).clamp(0.0, last as f64);
    let below = place.floor() as usize;
    let above = (below + 1).min(last);
    sorted[below] + (sorted[above] - sorted[below]) * (place - below as f64)
}

/// The same of a sample in any order, which it changes.
pub fn of_unsorted(sample: &mut [f64], share: f64) -> f64 {
    let Some(last) = sample.len().checked_sub(1) else { return 0.0 };
    let place = (share * sample.len() as f64 - 0.5).clamp(0.0, last as f64);
    let (_, below, above) = sample.select_nth_unstable_by(place.floor() as usize, f64::total_cmp);
    let above = above.iter().copied().min_by(f64::total_cmp).unwrap_or(*below);
    *below + (above - *below) * (place - place.floor())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_does_not_matter() {
        let mut random = fastrand::Rng::with_seed(4);
        for count in [1, 2, 19, 20, 21, 1000] {
            let mut sample: Vec<f64> = (0..count).map(|_| random.f64()).collect();
            let mut sorted = sample.clone();
            sorted.sort_by(f64::total_cmp);
            for share in [0.0, 0.5, 0.95, 1.0] {
                assert_eq!(of_unsorted(&mut sample, share).to_bits(), quantile(&sorted, share).to_bits());
            }
        }
        assert_eq!(of_unsorted(&mut [], 0.5), 0.0);
    }

    #[test]
    fn quantiles_of_even_steps_are_the_steps() {
        let sample: Vec<f64> = (0..1000).rev().map(|k| (f64::from(k) + 0.5) / 1000.0).collect();
        let Quantiles { p50, p95, p95_interval: [low, high] } = Quantiles::of(sample);
        assert!((p50 - 0.5).abs() < 1e-12 && (p95 - 0.95).abs() < 1e-12);
        assert!((high - low - 2.0 * COVERAGE * (0.0475_f64 / 1000.0).sqrt()).abs() < 1e-9);
    }
}
