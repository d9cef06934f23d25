//! Where an error crosses the tolerance, by inverse interpolation through the runs that came closest (as in Alefeld,
//! Potra and Shi, ACM TOMS 21, 1995), and by bisection where that leaves the bracket or does not halve it in two
//! steps.

use crate::math;
use crate::study::Outcome;

/// Width of a bracket, as a share of the larger end, at which it is narrow enough.
const NARROW: f64 = 2e-4;
/// Most runs to narrow one crossing: bisection alone takes about 13.
const MOST: usize = 40;
/// Most runs through which the error is interpolated.
const THROUGH: usize = 4;

/// One run: its value, and how far the error is above the tolerance; infinite without a result.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tried {
    pub(super) value: f64,
    pub(super) excess: f64,
}

impl Tried {
    pub(super) fn meets(self) -> bool {
        self.excess <= 0.0
    }
}

/// A crossing: the value on the side that meets the tolerance, and what the run there says unless it is one of the
/// scan.
#[derive(Debug, Clone)]
pub(super) struct Crossing {
    pub(super) value: f64,
    pub(super) outcome: Option<Outcome>,
    pub(super) runs: usize,
}

impl Crossing {
    /// The crossing between the runs `at - 1` and `at` of a scan; `run` makes another.
    pub(super) fn narrowed(scan: &[Tried], at: usize, run: &impl Fn(f64) -> (Tried, Outcome)) -> Self {
        let (mut low, mut high) = (scan[at - 1], scan[at]);
        let around = &scan[at.saturating_sub(2)..scan.len().min(at + 2)];
        let mut known: Vec<Tried> = around.iter().copied().filter(|one| one.excess.is_finite()).collect();
        let (mut runs, mut outcome) = (0, None);
        let mut widths = [f64::INFINITY; 2];
        loop {
            let size = high.value.abs().max(low.value.abs());
            let width = high.value - low.value;
            if width <= NARROW * size || runs >= MOST {
                return Self { value: if low.meets() { low.value } else { high.value }, outcome, runs };
            }
            let halves = width <= 0.5 * widths[0];
            widths = [widths[1], width];
            let root = interpolated(&known).filter(|root| halves && *root > low.value && *root < high.value);
            // Close to an end, go a little beyond the root, so that the next bracket is narrow enough.
            let beyond = 0.4 * NARROW * size;
            let next = match root {
                Some(root) if root - low.value < beyond => root + beyond,
                Some(root) if high.value - root < beyond => root - beyond,
                Some(root) => root,
                None => 0.5 * (low.value + high.value),
            };
            let (tried, what) = run(next);
            runs += 1;
            if tried.excess.is_finite() {
                known.push(tried);
            }
            if tried.meets() {
                outcome = Some(what);
            }
            if tried.meets() == low.meets() {
                low = tried;
            } else {
                high = tried;
            }
        }
    }
}

/// Where a polynomial through the runs that came closest says that the excess is zero: the value as a function of the
/// excess, by Neville's scheme. `None` if two of them have the same excess.
fn interpolated(known: &[Tried]) -> Option<f64> {
    let nearest = math::rising(known.iter().copied(), |one| one.excess.abs());
    let nearest = &nearest[..nearest.len().min(THROUGH)];
    let mut values: Vec<f64> = nearest.iter().map(|one| one.value).collect();
    for step in 1..nearest.len() {
        for k in 0..nearest.len() - step {
            let (a, b) = (nearest[k].excess, nearest[k + step].excess);
            values[k] = (b * values[k] - a * values[k + 1]) / (b - a);
        }
    }
    values.first().copied().filter(|root| root.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A scan of a function at 17 places, and the crossing after its first change of sign.
    fn crossing(of: impl Fn(f64) -> f64, [from, to]: [f64; 2]) -> (Crossing, [f64; 2]) {
        let tried = |value: f64| Tried { value, excess: of(value) };
        let scan: Vec<Tried> = (0..17).map(|k| tried(from + (to - from) * f64::from(k) / 16.0)).collect();
        let at = (1..17).find(|&k| scan[k - 1].meets() != scan[k].meets()).unwrap();
        let found = Crossing::narrowed(&scan, at, &|value| (tried(value), Outcome::default()));
        (found, [scan[at - 1].value, scan[at].value])
    }

    #[test]
    fn smooth_errors_take_a_few_runs() {
        for (of, root) in [
            ((|x| 0.3 * x - 1.0) as fn(f64) -> f64, 1.0 / 0.3),
            (|x| x * x - 5.0, 5.0_f64.sqrt()),
            (|x| 0.05 + 0.1 * x / (0.5 + 0.02 * x) - 0.7, 0.65 * 0.5 / (0.1 - 0.65 * 0.02)),
            (|x| 1.0 / x - 0.4, 2.5),
        ] {
            let (found, _) = crossing(of, [0.5, 8.0]);
            assert!((found.value / root - 1.0).abs() < NARROW, "{} instead of {root}", found.value);
            assert!(of(found.value) <= 0.0 && found.outcome.is_some());
            assert!(found.runs <= 4, "{} runs to {root}", found.runs);
        }
    }

    #[test]
    fn steps_kinks_and_missing_results_are_bracketed() {
        let step = |x: f64| if x < 3.3 { -1.0 } else { 2.0 };
        let kink = |x: f64| if x < 3.3 { -1e-9 } else { 1e3 * (x - 3.3) };
        let ends = |x: f64| if x < 3.3 { -0.5 } else { f64::INFINITY };
        for of in [&step as &dyn Fn(f64) -> f64, &kink, &ends] {
            let (found, [low, high]) = crossing(of, [0.5, 8.0]);
            assert!(found.value > low && found.value < high && found.runs < MOST, "{found:?}");
            assert!(found.value <= 3.3 && found.value > 3.3 * (1.0 - NARROW), "{found:?}");
        }
    }
}
