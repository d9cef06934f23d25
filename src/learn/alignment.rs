//! When, or where on the path, the first row of a log was measured.

use nalgebra::Vector3;

/// Correlation from which on two courses are alike.
const ALIKE: f64 = 0.5;
/// Positions that are so far from where they are expected are another run's [m]: a controller lags by less.
const FAR: f64 = 5e-3;
/// Shifts that are looked at before the best is closed in on.
const SHIFTS: usize = 1500;
/// Rows by which a shift is judged while it is searched.
const JUDGED_BY: usize = 250;
/// Steps of the golden section that closes in.
const PASSES: usize = 40;
/// Share of the shorter of log and run that lies over the other at the least.
const OVERLAP: f64 = 0.5;

/// Values at rising times [s] or arc lengths [m].
#[derive(Debug, Clone, Copy)]
pub struct Sampled<'a> {
    /// The times or arc lengths.
    pub at: &'a [f64],
    /// A value for each.
    pub values: &'a [Vector3<f64>],
}

impl Sampled<'_> {
    /// The value between the two next to `at`; `None` outside.
    pub fn value(&self, at: f64) -> Option<Vector3<f64>> {
        let (below, share) = place(self.at, at)?;
        let above = (below + 1).min(self.values.len() - 1);
        Some(self.values[below].lerp(&self.values[above], share))
    }

    fn span(&self) -> f64 {
        self.at.last().zip(self.at.first()).map_or(0.0, |(last, first)| last - first)
    }

    /// At most `count` of them, evenly.
    fn thinned(&self, count: usize) -> (Vec<f64>, Vec<Vector3<f64>>) {
        let step = self.at.len().div_ceil(count).max(1);
        (self.at.iter().copied().step_by(step).collect(), self.values.iter().copied().step_by(step).collect())
    }
}

/// The index at or below a place in rising numbers, and the share of the way to the next; `None` outside.
pub fn place(rising: &[f64], at: f64) -> Option<(usize, f64)> {
    let (first, last) = (*rising.first()?, *rising.last()?);
    if !(first..=last).contains(&at) {
        return None;
    }
    let below = rising.partition_point(|other| *other <= at).saturating_sub(1).min(rising.len() - 1);
    let above = (below + 1).min(rising.len() - 1);
    let step = rising[above] - rising[below];
    Some((below, if step > 0.0 { (at - rising[below]) / step } else { 0.0 }))
}

/// How log and run are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ComparedBy {
    /// By how far apart positions are: the root mean square [m], negative.
    Distance,
    /// By how alike two courses are: the correlation coefficient of all axes together, whatever its sign.
    Likeness,
}

/// Where a log begins on a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Alignment {
    /// From the first row until the run begins [s], or along the path [m]; below 0 if the log begins later than the run.
    pub shift: f64,
    /// How well the two agree there, see [`ComparedBy`]; with [`ComparedBy::Likeness`] negative if they are opposite.
    pub agreement: f64,
    /// The shift at which they agree best.
    pub best: f64,
    /// How well they do there.
    pub best_agreement: f64,
    /// How they were compared.
    pub by: ComparedBy,
}

impl Alignment {
    /// Of a log over a run: at the shift that is `asked`, or where they agree best.
    /// `None` if at no shift half of the shorter one lies over the other.
    pub fn of(log: Sampled, run: Sampled, by: ComparedBy, asked: Option<f64>) -> Option<Self> {
        let overlap = OVERLAP * log.span().min(run.span());
        let ends = |of: &[f64]| Some((*of.first()?, *of.last()?));
        let ((log_from, log_to), (run_from, run_to)) = (ends(log.at)?, ends(run.at)?);
        let (from, to) = (log_from + overlap - run_to, log_to - overlap - run_from);
        let (at, values) = log.thinned(JUDGED_BY);
        let few = Sampled { at: &at, values: &values };
        let size = |shift: f64| agreement(few, run, by, shift).map_or(f64::NEG_INFINITY, |v| worth(by, v));
        let step = (to - from) / SHIFTS as f64;
        let shift = |k: usize| from + step * k as f64;
        let best = (0..=SHIFTS).fold((0, f64::NEG_INFINITY), |best, k| {
            let worth = size(shift(k));
            if worth > best.1 { (k, worth) } else { best }
        });
        if best.1 == f64::NEG_INFINITY {
            return None;
        }
        let (mut low, mut high) = (shift(best.0) - step, shift(best.0) + step);
        for _ in 0..PASSES {
            let part = 0.381_966_011_250_105_1 * (high - low);
            if size(low + part) > size(high - part) { high -= part } else { low += part }
        }
        let closed = 0.5 * (low + high);
        let best = if size(closed) >= best.1 { closed } else { shift(best.0) };
        let best_agreement = agreement(log, run, by, best)?;
        let shift = asked.unwrap_or(best);
        let agreement = if asked.is_some() { agreement(log, run, by, shift)? } else { best_agreement };
        Some(Self { shift, agreement, best, best_agreement, by })
    }

    /// Whether another shift fits clearly better than the one that was asked for.
    pub fn is_doubtful(&self) -> bool {
        match self.by {
            ComparedBy::Distance => -self.agreement > 1.5 * -self.best_agreement + 1e-5,
            ComparedBy::Likeness => {
                let best = self.best_agreement.abs();
                best > ALIKE && self.agreement.abs() < best - 0.05
            }
        }
    }

    /// Whether the log hardly follows the run at all.
    pub fn is_unlike(&self) -> bool {
        match self.by {
            ComparedBy::Distance => -self.agreement > FAR,
            ComparedBy::Likeness => self.agreement.abs() < ALIKE,
        }
    }
}

fn worth(by: ComparedBy, agreement: f64) -> f64 {
    if by == ComparedBy::Likeness { agreement.abs() } else { agreement }
}

/// How well log and run agree at a shift; `None` where too few rows lie over the run.
fn agreement(log: Sampled, run: Sampled, by: ComparedBy, shift: f64) -> Option<f64> {
    let pairs =
        log.at.iter().zip(log.values).filter_map(|(at, value)| Some((*value, run.value(at - shift)?)));
    let pairs: Vec<_> = pairs.collect();
    // Rows may be thicker in one part of a log than in another.
    let expected = log.at.len() as f64 * (run.span() / log.span().max(f64::MIN_POSITIVE)).min(1.0);
    if (pairs.len() as f64) < 0.4 * OVERLAP * expected || pairs.len() < 2 {
        return None;
    }
    let count = pairs.len() as f64;
    Some(match by {
        ComparedBy::Distance => {
            let squares: f64 = pairs.iter().map(|(own, other)| (own - other).norm_squared()).sum();
            -(squares / count).sqrt()
        }
        ComparedBy::Likeness => {
            let means = pairs.iter().fold([Vector3::zeros(); 2], |[a, b], (own, other)| [a + own, b + other]);
            let [own_mean, other_mean] = means.map(|sum| sum / count);
            let sums = pairs.iter().fold([0.0; 3], |[both, own, other], (a, b)| {
                let (a, b) = (a - own_mean, b - other_mean);
                [both + a.dot(&b), own + a.norm_squared(), other + b.norm_squared()]
            });
            if sums[1] * sums[2] > 0.0 { sums[0] / (sums[1] * sums[2]).sqrt() } else { 0.0 }
        }
    })
}
