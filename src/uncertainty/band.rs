//! The band of the largest contour error over the drawn plants, what widens it, and what it would
//! be otherwise.

use crate::cutting::LinearForce;
use crate::deviation::contour;
use crate::job::Sources;
use crate::motion::TimingLaw;
use crate::plan::Plan;
use crate::robot::Joints;
use crate::setup::Setup;
use crate::spread::{InputSpread, Spreads, Stiffness};
use crate::uncertainty::draw::{self, Deviates, Draw};
use crate::uncertainty::place::{DrawnPlace, places};
use crate::uncertainty::{Quantiles, chosen, quantile};
use nalgebra::Vector3;
use std::sync::Arc;

/// Most places at which every draw is evaluated.
const PLACES: usize = 256;
/// Places that decide where only the largest error counts.
const DECISIVE: usize = 48;
/// Frequencies at which the filtered motion is computed; in between it is interpolated.
const FREQUENCIES: usize = 9;
/// 95 % ranges after a measurement [%]: stiffness identified from loaded poses, coefficients from a
/// dynamometer, the filter's frequency read from the controller.
const MEASURED: [f64; 3] = [5.0, 10.0, 1.0];

/// What the drawn plants leave.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorBand {
    /// The samples that were evaluated, rising.
    pub samples: Vec<usize>,
    /// 95 % quantile of the contour error at each of them [m].
    pub p95: Vec<f64>,
    /// Largest contour error with the commands kept.
    pub after: Quantiles,
    /// The same at the top of the cut.
    pub wall: Quantiles,
    /// The same with the desired path commanded.
    pub before: Quantiles,
    /// What the band consists of where it is widest; the shares add up to 1.
    pub shares: Vec<Share>,
    /// The measurement that narrows the band most, if one does.
    pub measure_first: Option<Measure>,
    /// How wrong the model may be.
    pub break_even: BreakEven,
    /// Share of the draws in which compensating makes the largest error larger.
    pub worse: f64,
}

/// An input's share of the variance of the tip where the band is widest, to first order (JCGM
/// 100:2008, 5.1.2 and 5.2.2).
#[derive(Debug, Clone, PartialEq)]
pub struct Share {
    /// Stable slug: `joint-1` to `joint-6`, `cutting`, `radial-ratio`, `axial-ratio`, `frequency`.
    pub input: String,
    /// Its share; with a covariance it may be negative.
    pub share: f64,
}

/// A measurement and what it would bring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measure {
    /// Stable slug: `stiffness`, `cutting` or `frequency`.
    pub input: &'static str,
    /// 95 % range after the measurement, to each side [%].
    pub percent: f64,
    /// 95 % quantile of the largest contour error after it [m].
    pub p95: f64,
}

/// While the true deflection is how much of the assumed one does compensating pay, that is, leave a
/// smaller largest error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BreakEven {
    /// However small it is.
    Always,
    /// While it is more than this share.
    Above(f64),
    /// Not even where it is as assumed.
    Never,
}

impl ErrorBand {
    /// 95 % quantile of the contour error at a sample [m], straight between the places.
    pub fn p95_at(&self, sample: usize) -> f64 {
        let above = self.samples.partition_point(|&k| k < sample);
        let Some(&to) = self.samples.get(above) else { return self.p95.last().copied().unwrap_or(0.0) };
        if to == sample || above == 0 {
            return self.p95[above];
        }
        let from = self.samples[above - 1];
        let part = (sample - from) as f64 / (to - from) as f64;
        self.p95[above - 1] + (self.p95[above] - self.p95[above - 1]) * part
    }
}

/// The plant with one of a few frequencies of its filter: factor on the frequency, plan, and timing of
/// the tool.
type Filtered<'a> = (f64, &'a Plan, &'a TimingLaw);

/// The plan with each frequency of the filter at which it is computed, rising; the nominal one is in
/// the middle.
fn filtered(plan: &Plan) -> Vec<(f64, Plan)> {
    let spread = plan.setup.spreads.frequency;
    if spread.deviation() == 0.0 || plan.shaper().duration() == 0.0 {
        return vec![(1.0, plan.clone())];
    }
    let tuned = |k: usize| {
        let factor = spread.at(draw::CUT_OFF * (2.0 * k as f64 / (FREQUENCIES - 1) as f64 - 1.0));
        let setup = Setup { shaper: plan.shaper().tuned(factor), ..(*plan.setup).clone() };
        (factor, Plan { setup: Arc::new(setup), ..plan.clone() })
    };
    (0..FREQUENCIES).map(tuned).collect()
}

/// What every set of commands is sent through.
struct Plants<'a> {
    filtered: Vec<Filtered<'a>>,
    parts: [LinearForce; 3],
}

impl Plants<'_> {
    fn nominal(&self) -> Filtered<'_> {
        self.filtered[self.filtered.len() / 2]
    }

    /// The outcome of joint commands [rad] at samples, at a height above the tip [m].
    fn send(&self, q: &[Joints], at: &[usize], height: f64) -> Outcomes<'_> {
        let node = |(factor, plan, timing): &Filtered| {
            (*factor, places(plan, (timing, &self.parts), (q, at), height))
        };
        Outcomes { plan: self.nominal().1, nodes: self.filtered.iter().map(node).collect() }
    }
}

/// Where commands take the tip at a few places.
struct Outcomes<'a> {
    plan: &'a Plan,
    /// Factors on the filter's frequency, rising, and the places with each.
    nodes: Vec<(f64, Vec<DrawnPlace>)>,
}

impl Outcomes<'_> {
    /// Contour error at a place with a drawn plant [m].
    fn error(&self, place: usize, draw: &Draw) -> Vector3<f64> {
        let (path, node) = (&self.plan.path, |k: usize| &self.nodes[k].1[place]);
        let above = self.nodes.partition_point(|(factor, _)| *factor < draw.frequency);
        if above == 0 || above == self.nodes.len() {
            let place = node(above.min(self.nodes.len() - 1));
            let tip = place.tip(self.plan, draw);
            return contour::closest(path, (place.arc_length, &place.target), &tip).point - tip;
        }
        let (from, to) = (node(above - 1), node(above));
        let (low, high) = (self.nodes[above - 1].0, self.nodes[above].0);
        let part = (draw.frequency - low) / (high - low);
        let s = from.arc_length + (to.arc_length - from.arc_length) * part;
        let tip = from.tip(self.plan, draw).lerp(&to.tip(self.plan, draw), part);
        contour::closest(path, (s, &path.point(s)), &tip).point - tip
    }

    /// Largest contour error with a drawn plant [m], at some of the places.
    fn largest_at(&self, places: &[usize], draw: &Draw) -> f64 {
        places.iter().map(|&place| self.error(place, draw).norm()).fold(0.0, f64::max)
    }

    /// Largest contour error with a drawn plant [m].
    fn largest(&self, draw: &Draw) -> f64 {
        (0..self.nodes[0].1.len()).map(|place| self.error(place, draw).norm()).fold(0.0, f64::max)
    }
}

/// The band of the commands `kept`, and of those for the `desired` path [rad]; `before` and `after`
/// are their nominal contour errors [m].
pub fn band(
    plan: &Plan,
    (desired, kept): (&[Joints], &[Joints]),
    (before, after): (&[Vector3<f64>], &[Vector3<f64>]),
) -> ErrorBand {
    let spreads = &plan.setup.spreads;
    let norms = |errors: &[Vector3<f64>]| errors.iter().map(Vector3::norm).collect::<Vec<_>>();
    let signals = [norms(before), norms(after)];
    let samples = chosen::places(&[&signals[0], &signals[1]], PLACES);
    let deviates = draw::deviates(spreads.seed, spreads.draws);
    let draws: Vec<Draw> = deviates.iter().map(|z| Draw::at(spreads, z)).collect();

    let plans = filtered(plan);
    let timings: Vec<_> = plans.iter().map(|(_, plan)| plan.timing(Sources::ALL)).collect();
    let filtered = plans.iter().zip(&timings).map(|((factor, plan), timing)| (*factor, plan, &**timing));
    let plants = Plants { filtered: filtered.collect(), parts: plan.setup.cut.mean_force_parts() };
    let compensated = plants.send(kept, &samples, 0.0);
    let mut largest = vec![0.0_f64; draws.len()];
    let mut errors = Vec::with_capacity(draws.len());
    let p95: Vec<f64> = (0..samples.len())
        .map(|place| {
            errors.clear();
            errors.extend(draws.iter().map(|draw| compensated.error(place, draw).norm()));
            for (largest, error) in largest.iter_mut().zip(&errors) {
                *largest = largest.max(*error);
            }
            errors.sort_unstable_by(f64::total_cmp);
            quantile::quantile(&errors, 0.95)
        })
        .collect();
    let decisive = most(&p95, |_| true);
    let at = |places: Vec<usize>| {
        let mut at: Vec<usize> = places.into_iter().map(|place| samples[place]).collect();
        at.sort_unstable();
        at
    };
    let engaged = &plants.nominal().2.engaged;
    let cutting = at(most(&p95, |place| engaged[samples[*place]] > 0.0));
    let top = plants.send(kept, &cutting, plan.setup.cut.axial_depth);
    let nominal: Vec<f64> = samples.iter().map(|&k| signals[0][k]).collect();
    let uncompensated = plants.send(desired, &at(most(&nominal, |_| true)), 0.0);
    let largest_before: Vec<f64> = draws.iter().map(|draw| uncompensated.largest(draw)).collect();
    let worse = largest.iter().zip(&largest_before).filter(|(after, before)| after > before).count();
    let at_decisive = |draw: &Draw| compensated.largest_at(&decisive, draw);
    let break_even = break_even(at_decisive, |draw| uncompensated.largest(draw));
    let after = Quantiles::of(largest);
    ErrorBand {
        measure_first: measure_first(spreads, &deviates, after.p95, at_decisive),
        shares: decisive.first().map(|&widest| shares(&compensated, widest)).unwrap_or_default(),
        wall: Quantiles::of(draws.iter().map(|draw| top.largest(draw)).collect()),
        before: Quantiles::of(largest_before),
        samples,
        p95,
        after,
        break_even,
        worse: worse as f64 / draws.len() as f64,
    }
}

/// The places with the largest values, the largest first, and as many all along the path: with
/// another spread, the worst may lie elsewhere.
fn most(values: &[f64], counts: impl Fn(&usize) -> bool) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).filter(counts).collect();
    let along: Vec<usize> =
        order.iter().copied().step_by(order.len().div_ceil(DECISIVE / 2).max(1)).collect();
    order.sort_by(|a, b| values[*b].total_cmp(&values[*a]).then(a.cmp(b)));
    order.truncate(DECISIVE / 2);
    for place in along {
        if !order.contains(&place) {
            order.push(place);
        }
    }
    order
}

/// The factor on the arm's compliance below which the kept commands err more than the desired ones,
/// by bisection.
fn break_even(kept: impl Fn(&Draw) -> f64, desired: impl Fn(&Draw) -> f64) -> BreakEven {
    let loses = |factor: f64| {
        let draw = Draw { compliance: [factor; 6], ..Draw::NOMINAL };
        kept(&draw) > desired(&draw)
    };
    let (mut low, mut high) = (0.0, 1.0);
    if loses(high) {
        return BreakEven::Never;
    }
    if !loses(low) {
        return BreakEven::Always;
    }
    for _ in 0..20 {
        let middle = 0.5 * (low + high);
        if loses(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    BreakEven::Above(0.5 * (low + high))
}

/// What each input contributes where the band is widest: the derivative of the tip across the path,
/// times the input's standard deviation.
fn shares(outcomes: &Outcomes, widest: usize) -> Vec<Share> {
    let Outcomes { plan, nodes } = outcomes;
    let place = &nodes[nodes.len() / 2].1[widest];
    let spreads = &plan.setup.spreads;
    let tangent = plan.path.tangent(place.arc_length);
    let across = |v: Vector3<f64>| v - tangent * tangent.dot(&v);
    let joints = place.by_joint(plan, &[1.0; 3]).map(across);
    let covariance = spreads.stiffness.covariance();
    let mut squares: Vec<(String, f64)> = (0..6)
        .map(|i| {
            let square = (0..6).map(|j| covariance[(i, j)] * joints[i].dot(&joints[j])).sum();
            (format!("joint-{}", i + 1), square)
        })
        .collect();
    // A step small enough to be a derivative, even with springs that are not linear.
    let step = 1e-3;
    let moved = |force: [f64; 3], frequency: f64| {
        let at = |sign: f64| {
            let draw = Draw {
                force: force.map(|share| 1.0 + sign * step * share),
                frequency: 1.0 + sign * step * frequency,
                ..Draw::NOMINAL
            };
            outcomes.error(widest, &draw)
        };
        across(at(1.0) - at(-1.0)) / (2.0 * step)
    };
    for (input, force, frequency, spread) in [
        ("cutting", [1.0, 1.0, 1.0], 0.0, spreads.cutting),
        ("radial-ratio", [0.0, 1.0, 0.0], 0.0, spreads.ratios),
        ("axial-ratio", [0.0, 0.0, 1.0], 0.0, spreads.ratios),
        ("frequency", [0.0; 3], 1.0, spreads.frequency),
    ] {
        let deviation = spread.deviation();
        let size = if deviation > 0.0 { moved(force, frequency).norm() * deviation } else { 0.0 };
        squares.push((input.to_owned(), size * size));
    }
    let total: f64 = squares.iter().map(|(_, square)| square).sum();
    let share = |square: f64| if total > 0.0 { square / total } else { 0.0 };
    squares.into_iter().map(|(input, square)| Share { input, share: share(square) }).collect()
}

/// The measurement that brings most, by the same draws with that input's spread narrowed.
fn measure_first(
    spreads: &Spreads,
    deviates: &[Deviates],
    p95: f64,
    largest: impl Fn(&Draw) -> f64,
) -> Option<Measure> {
    let [stiffness, cutting, frequency] = MEASURED.map(InputSpread::percent);
    let narrowed = |known: InputSpread, better: InputSpread| {
        if known.deviation() > better.deviation() { better } else { known }
    };
    let with_stiffness = match &spreads.stiffness {
        Stiffness::Each(each) => Stiffness::Each(each.map(|known| narrowed(known, stiffness))),
        fitted => fitted.clone(),
    };
    let cut = narrowed(spreads.cutting, cutting);
    let tried = [
        ("stiffness", MEASURED[0], Spreads { stiffness: with_stiffness, ..spreads.clone() }),
        ("cutting", MEASURED[1], Spreads { cutting: cut, ratios: cut, ..spreads.clone() }),
        (
            "frequency",
            MEASURED[2],
            Spreads { frequency: narrowed(spreads.frequency, frequency), ..spreads.clone() },
        ),
    ];
    tried
        .into_iter()
        .filter(|(_, _, tried)| tried != spreads)
        .map(|(input, percent, tried)| {
            let errors = deviates.iter().map(|z| largest(&Draw::at(&tried, z))).collect();
            Measure { input, percent, p95: Quantiles::of(errors).p95 }
        })
        .filter(|measure| measure.p95 < p95)
        .min_by(|a, b| a.p95.total_cmp(&b.p95))
}
