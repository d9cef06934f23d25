//! The 95 % quantile of the contour error along the path: computed at more places where an estimate,
//! corrected at those before, misses it.

use crate::robot::Joints;
use crate::uncertainty::outcomes::{Outcomes, Plants};
use crate::uncertainty::{Draw, quantile};

/// What may be missed of the quantile, as a share of its maximum.
const MISSED: f64 = 0.01;
/// Most rounds in which gaps between places are halved.
const ROUNDS: usize = 6;

/// The quantile at places along the path.
pub(super) struct DrawnColumn<'a> {
    /// The samples that were evaluated, rising.
    pub(super) samples: Vec<usize>,
    /// 95 % quantile of the contour error at each of them [m].
    pub(super) p95: Vec<f64>,
    /// Largest contour error of each draw [m].
    pub(super) largest: Vec<f64>,
    /// The places, in the order of the samples.
    pub(super) outcomes: Outcomes<'a>,
}

/// A stretch between two places, by their numbers, and what a straight line missed around it [m].
struct Gap {
    from: usize,
    to: usize,
    missed: f64,
}

impl<'a> DrawnColumn<'a> {
    /// The column for joint commands [rad] over the draws: at the places `first`, in the middle of
    /// each gap between them, and again in the middle of those gaps where an `estimate` for each
    /// sample [m], corrected by a straight line, missed it; at most `count` places.
    pub(super) fn new(
        plants: &'a Plants,
        (q, draws): (&[Joints], &[Draw]),
        (first, estimate): (Vec<usize>, &[f64]),
        count: usize,
    ) -> Self {
        let (p95, largest) = (Vec::new(), vec![0.0; draws.len()]);
        let outcomes = plants.send(q, &first, 0.0);
        let mut column = Self { samples: first, p95, largest, outcomes };
        column.evaluate(draws);
        let all = 1..column.samples.len();
        let mut gaps: Vec<Gap> = all.map(|to| Gap { from: to - 1, to, missed: f64::INFINITY }).collect();
        for _ in 0..ROUNDS {
            gaps.retain(|gap| column.samples[gap.to] - column.samples[gap.from] > 1);
            gaps.sort_by(|a, b| b.missed.total_cmp(&a.missed).then(a.from.cmp(&b.from)));
            gaps.truncate(count.saturating_sub(column.samples.len()));
            // A stable order along the path is what the forces are computed in.
            gaps.sort_by_key(|gap| column.samples[gap.from]);
            if gaps.is_empty() {
                break;
            }
            let known = column.samples.len();
            let middles: Vec<usize> = gaps.iter().map(|gap| column.middle(gap)).collect();
            column.outcomes.extend(plants.send(q, &middles, 0.0));
            column.samples.extend(middles);
            column.evaluate(draws);
            let top = column.p95.iter().copied().fold(0.0, f64::max);
            let halves = gaps.iter().enumerate().flat_map(|(i, &Gap { from, to, .. })| {
                let middle = known + i;
                let missed = column.missed((from, middle, to), estimate);
                [Gap { from, to: middle, missed }, Gap { from: middle, to, missed }]
            });
            gaps = halves.filter(|gap| gap.missed > MISSED * top).collect();
        }
        column.sorted()
    }

    /// Evaluates the places that have no quantile yet.
    fn evaluate(&mut self, draws: &[Draw]) {
        let mut errors = Vec::with_capacity(draws.len());
        for place in self.p95.len()..self.samples.len() {
            errors.clear();
            errors.extend(draws.iter().map(|draw| self.outcomes.size(place, draw)));
            for (largest, error) in self.largest.iter_mut().zip(&errors) {
                *largest = largest.max(*error);
            }
            self.p95.push(quantile::of_unsorted(&mut errors, 0.95));
        }
    }

    /// The sample in the middle of a gap.
    fn middle(&self, gap: &Gap) -> usize {
        self.samples[gap.from].midpoint(self.samples[gap.to])
    }

    /// By how much the estimate, corrected by a straight line between two places, misses the quantile
    /// at one in between [m].
    fn missed(&self, places: (usize, usize, usize), estimate: &[f64]) -> f64 {
        let (from, middle, to) = places;
        let [a, k, b] = [from, middle, to].map(|place| self.samples[place] as f64);
        let [start, here, end] =
            [from, middle, to].map(|place| self.p95[place] - estimate[self.samples[place]]);
        (here - start - (end - start) * ((k - a) / (b - a))).abs()
    }

    /// The same with the places in the order of the path.
    fn sorted(mut self) -> Self {
        let mut order: Vec<usize> = (0..self.samples.len()).collect();
        order.sort_by_key(|&place| self.samples[place]);
        self.outcomes.reorder(&order);
        self.samples = order.iter().map(|&place| self.samples[place]).collect();
        self.p95 = order.iter().map(|&place| self.p95[place]).collect();
        self
    }
}
