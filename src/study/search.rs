//! Which values a search for crossings of the tolerance tries next.
//!
//! First a scan. Where the error turns back before it reaches the tolerance, the middles beside it too: it may cross
//! and come back. Then two values about each crossing, by inverse interpolation through the runs that came closest (as
//! in Alefeld, Potra and Shi, ACM TOMS 21, 1995), or at thirds where that does not halve the bracket in a round. The
//! values of a round do not depend on each other's errors, so they can be run at once.

use crate::math;

/// Values of the scan.
pub(super) const SCAN: usize = 9;
/// Width of a bracket, as a share of the larger end, at which it is narrow enough.
const NARROW: f64 = 2e-4;
/// What is left to both sides of the last value, so that its bracket is narrow enough.
const BESIDE: f64 = 0.4 * NARROW;
/// Most rounds: thirds alone take about 9.
const MOST: usize = 40;
/// Most runs through which the error is interpolated, and from how many to each side they are chosen.
const THROUGH: usize = 4;

/// One run: its value, and how far the error is above the tolerance; infinite without a result.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tried {
    pub(super) value: f64,
    pub(super) excess: f64,
}

impl Tried {
    pub(super) fn meets(self) -> bool {
        self.excess <= 0.0
    }
}

/// All runs of a search so far.
#[derive(Debug, Clone)]
pub(super) struct CrossingSearch {
    scan: [f64; SCAN],
    /// By their values, rising.
    tried: Vec<Tried>,
    rounds: usize,
}

impl CrossingSearch {
    /// A search that begins with these values, rising.
    pub(super) fn new(scan: [f64; SCAN]) -> Self {
        Self { scan, tried: Vec::new(), rounds: 0 }
    }

    /// The values to try next; empty once every crossing is narrow.
    pub(super) fn wanted(&self) -> Vec<f64> {
        match self.rounds {
            0 => self.scan.to_vec(),
            MOST => Vec::new(),
            1 => [self.turns(), self.about_crossings()].concat(),
            _ => self.about_crossings(),
        }
    }

    /// Takes the runs of the values that were wanted.
    pub(super) fn take(&mut self, runs: &[Tried]) {
        for run in runs {
            let at = self.tried.partition_point(|other| other.value <= run.value);
            self.tried.insert(at, *run);
        }
        self.rounds += 1;
    }

    /// All runs, rising.
    pub(super) fn tried(&self) -> &[Tried] {
        &self.tried
    }

    /// The values where meeting turns into missing or back, on the side that meets.
    pub(super) fn crossings(&self) -> Vec<f64> {
        let side = |[low, high]: [Tried; 2]| if low.meets() { low.value } else { high.value };
        self.changes().into_iter().map(|at| side([self.tried[at - 1], self.tried[at]])).collect()
    }

    fn changes(&self) -> Vec<usize> {
        (1..self.tried.len()).filter(|&at| self.tried[at - 1].meets() != self.tried[at].meets()).collect()
    }

    /// The middles beside values that come closer to the tolerance than both neighbors, on the same side of it.
    fn turns(&self) -> Vec<f64> {
        let mut middles = Vec::new();
        for three in self.tried.windows(3) {
            let [left, turn, right] = [three[0], three[1], three[2]];
            let closer = |other: Tried| {
                turn.meets() == other.meets()
                    && other.excess.is_finite()
                    && turn.excess.abs() < other.excess.abs()
            };
            if closer(left) && closer(right) {
                middles.extend([0.5 * (left.value + turn.value), 0.5 * (turn.value + right.value)]);
            }
        }
        middles
    }

    fn about_crossings(&self) -> Vec<f64> {
        self.changes().into_iter().flat_map(|at| self.about(at)).flatten().collect()
    }

    /// Two values between the runs `at - 1` and `at`; `None` if they are close enough.
    fn about(&self, at: usize) -> Option<[f64; 2]> {
        let (low, high) = (self.tried[at - 1].value, self.tried[at].value);
        let (size, width) = (low.abs().max(high.abs()), high - low);
        if width <= NARROW * size {
            return None;
        }
        let third = width / 3.0;
        let beside = (BESIDE * size).min(third);
        let around = &self.tried[at.saturating_sub(THROUGH)..self.tried.len().min(at + THROUGH)];
        let root = interpolated(around)
            .filter(|(root, _)| *root > low && *root < high && self.is_on_course(width, low));
        let Some((root, unsure)) = root else { return Some([low + third, high - third]) };
        let reach = (2.0 * unsure).clamp(beside, third);
        let first = (root - reach).max(low + beside).min(high - 2.0 * beside);
        Some([first, (root + reach).min(high - beside).max(first + beside)])
    }

    /// Whether each round since the scan halved the bracket of this width that begins at `low`.
    fn is_on_course(&self, width: f64, low: f64) -> bool {
        let above = self.scan.partition_point(|value| *value <= low).clamp(1, self.scan.len() - 1);
        let began = self.scan[above] - self.scan[above - 1];
        width <= began * 0.5_f64.powi(i32::try_from(self.rounds).unwrap_or(i32::MAX) - 1)
    }
}

/// Where a polynomial through the runs that came closest says that the excess is zero: the value as a function of the
/// excess, by Neville's scheme, and by how much the last of them changed it. `None` if two of them have the same excess,
/// or there are fewer than two.
fn interpolated(around: &[Tried]) -> Option<(f64, f64)> {
    let nearest =
        math::rising(around.iter().copied().filter(|one| one.excess.is_finite()), |one| one.excess.abs());
    let nearest = &nearest[..nearest.len().min(THROUGH)];
    let mut values: Vec<f64> = nearest.iter().map(|one| one.value).collect();
    let mut change = f64::INFINITY;
    for step in 1..nearest.len() {
        let former = values[0];
        for k in 0..nearest.len() - step {
            let (a, b) = (nearest[k].excess, nearest[k + step].excess);
            values[k] = (b * values[k] - a * values[k + 1]) / (b - a);
        }
        change = (values[0] - former).abs();
    }
    values.first().map(|root| (*root, change)).filter(|(root, change)| root.is_finite() && change.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The crossings of a function, and the runs and rounds that it took.
    fn search(of: impl Fn(f64) -> f64, [from, to]: [f64; 2]) -> (Vec<f64>, usize, usize) {
        let mut search = CrossingSearch::new(std::array::from_fn(|k| from + (to - from) * k as f64 / 8.0));
        loop {
            let wanted = search.wanted();
            if wanted.is_empty() {
                return (search.crossings(), search.tried().len(), search.rounds);
            }
            assert!(wanted.iter().all(|value| (from..=to).contains(value)), "{wanted:?}");
            search.take(
                &wanted.into_iter().map(|value| Tried { value, excess: of(value) }).collect::<Vec<_>>(),
            );
        }
    }

    #[test]
    fn smooth_errors_take_two_rounds_or_three() {
        for (of, root) in [
            ((|x| 0.3 * x - 1.0) as fn(f64) -> f64, 1.0 / 0.3),
            (|x| x * x - 5.0, 5.0_f64.sqrt()),
            (|x| 0.05 + 0.1 * x / (0.5 + 0.02 * x) - 0.7, 0.65 * 0.5 / (0.1 - 0.65 * 0.02)),
            (|x| 1.0 / x - 0.4, 2.5),
        ] {
            let (found, runs, rounds) = search(of, [0.5, 8.0]);
            assert_eq!(found.len(), 1);
            assert!((found[0] / root - 1.0).abs() < NARROW, "{} instead of {root}", found[0]);
            assert!(of(found[0]) <= 0.0);
            assert!(runs <= 15 && rounds <= 4, "{runs} runs in {rounds} rounds to {root}");
        }
    }

    #[test]
    fn steps_kinks_and_missing_results_are_bracketed() {
        let step = |x: f64| if x < 3.3 { -1.0 } else { 2.0 };
        let kink = |x: f64| if x < 3.3 { -1e-9 } else { 1e3 * (x - 3.3) };
        let ends = |x: f64| if x < 3.3 { -0.5 } else { f64::INFINITY };
        let cubic = |x: f64| (x - 3.3).powi(3);
        for of in [&step as &dyn Fn(f64) -> f64, &kink, &ends, &cubic] {
            let (found, _, rounds) = search(of, [0.5, 8.0]);
            assert!(found.len() == 1 && rounds < 15, "{found:?} in {rounds} rounds");
            assert!(found[0] <= 3.3 && found[0] > 3.3 * (1.0 - NARROW), "{found:?}");
        }
    }

    /// A bump between two values of the scan that reaches the tolerance is found by its foot.
    #[test]
    fn an_error_that_crosses_and_comes_back_is_seen() {
        for middle in [3.1, 3.4, 3.7, 4.0] {
            let (found, ..) = search(|x| (x - middle).powi(2) - 0.16, [0.5, 8.0]);
            assert_eq!(found.len(), 2, "{middle}: {found:?}");
            assert!((found[0] - middle + 0.4).abs() < 2e-3 && (found[1] - middle - 0.4).abs() < 2e-3);
        }
        // It does not reach it: two runs more, no crossing.
        let (found, runs, rounds) = search(|x| (x - 3.4).powi(2) + 0.1, [0.5, 8.0]);
        assert_eq!((found.len(), runs, rounds), (0, 11, 2));
    }
}
