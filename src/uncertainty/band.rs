//! The band of the largest contour error over the drawn plants, what widens it, and what it would
//! be otherwise.

use crate::cutting::PartForces;
use crate::deviation::Largest;
use crate::job::Sources;
use crate::math;
use crate::plan::Plan;
use crate::robot::Joints;
use crate::spread::{COVERAGE, InputSpread, Spreads, Stiffness};
use crate::uncertainty::column::DrawnColumn;
use crate::uncertainty::draw::{self, Deviates, Draw};
use crate::uncertainty::outcomes::{Outcomes, Plants, filtered};
use crate::uncertainty::{Quantiles, chosen, quantile};
use nalgebra::Vector3;

/// Most places at which every draw is evaluated.
const PLACES: usize = 256;
/// Places that decide where only the largest error counts.
const DECISIVE: usize = 48;
/// 95 % ranges after a measurement [%]: stiffness identified from loaded poses, coefficients from a
/// dynamometer, the filter's frequency read from the controller.
const MEASURED: [f64; 3] = [5.0, 10.0, 1.0];

/// A measurement is worth it if it leaves at most this share of the band.
const WORTH: f64 = 0.95;

/// What the drawn plants leave.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorBand {
    /// The samples that were evaluated, rising.
    pub samples: Vec<usize>,
    /// 95 % quantile of the contour error at each of them [m].
    pub p95: Vec<f64>,
    /// A first estimate of it at every sample [m].
    pub estimate: Vec<f64>,
    /// Largest contour error with the commands kept.
    pub after: Quantiles,
    /// The same at the top of the cut.
    pub wall: Quantiles,
    /// The same with the desired path commanded.
    pub before: Quantiles,
    /// 95 % quantile of what of the path the tip never reaches with the commands kept [m]; a bound:
    /// the nominal tip misses so much, and a drawn one is elsewhere by so much there.
    pub missed_p95: f64,
    /// What the band consists of where it is widest; the shares add up to 1.
    pub shares: Vec<Share>,
    /// What each measurement would bring, the one that narrows the band most first.
    pub measures: Vec<Measure>,
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
    /// The measurement that narrows the band most, if one does.
    pub fn measure_first(&self) -> Option<&Measure> {
        self.measures.first().filter(|measure| measure.p95 < WORTH * self.after.p95)
    }

    /// 95 % quantile of the contour error at a sample [m]: at the places as computed; in between, it
    /// differs from the estimate by a straight line.
    pub fn p95_at(&self, sample: usize) -> f64 {
        let above = self.samples.partition_point(|&k| k < sample);
        let Some(&to) = self.samples.get(above) else { return self.p95.last().copied().unwrap_or(0.0) };
        if to == sample || above == 0 {
            return self.p95[above].min(self.after.p95);
        }
        let from = self.samples[above - 1];
        let part = (sample - from) as f64 / (to - from) as f64;
        let beyond = |place: usize| self.p95[place] - self.estimate[self.samples[place]];
        let line = beyond(above - 1) + (beyond(above) - beyond(above - 1)) * part;
        (self.estimate[sample] + line).clamp(0.0, self.after.p95)
    }
}

/// Nominal contour errors [m].
#[derive(Debug, Clone, Copy)]
pub struct NominalErrors<'a> {
    /// With the desired path commanded.
    pub before: &'a [Vector3<f64>],
    /// With the kept commands.
    pub after: &'a [Vector3<f64>],
    /// With the desired path commanded and only forces acting.
    pub deflection: &'a [Vector3<f64>],
    /// What of the path the tip never reaches with the kept commands.
    pub missed: Largest,
}

/// The band of the commands `kept`, and of those for the `desired` path [rad].
pub fn band(plan: &Plan, (desired, kept): (&[Joints], &[Joints]), errors: &NominalErrors) -> ErrorBand {
    let spreads = &plan.setup.spreads;
    let deviates = draw::deviates(spreads.seed, spreads.draws);
    let draws: Vec<Draw> = deviates.iter().map(|z| Draw::at(spreads, z)).collect();
    let before = errors.before;
    let is_same = std::ptr::eq(desired, kept);
    let estimate = estimate(errors, reach(plan));
    let first = chosen::places(&estimate, errors, spreads.frequency.deviation() > 0.0, PLACES / 2);

    let plans = filtered(plan);
    let timings: Vec<_> = plans.iter().map(|(_, plan)| plan.timing(Sources::ALL)).collect();
    let filtered = plans.iter().zip(&timings).map(|((factor, plan), timing)| (*factor, plan, &**timing));
    let plants = Plants {
        filtered: filtered.collect(),
        parts: PartForces::of(&plan.setup.cut, plan.setup.contacts.as_ref()),
    };
    let DrawnColumn { samples, p95, largest, outcomes: compensated } =
        DrawnColumn::new(&plants, (kept, &draws), (first, &estimate), PLACES);
    let decisive = most(&p95, |_| true);
    let at = |places: Vec<usize>| {
        let mut at: Vec<usize> = places.into_iter().map(|place| samples[place]).collect();
        at.sort_unstable();
        at
    };
    let engaged = &plants.nominal().2.engaged;
    let cutting = at(most(&p95, |place| engaged[samples[*place]] > 0.0));
    let top = plants.send(kept, &cutting, plan.setup.cut.axial_depth);
    let nominal: Vec<f64> = samples.iter().map(|&k| before[k].norm()).collect();
    let uncompensated = plants.send(desired, &at(most(&nominal, |_| true)), 0.0);
    let largest_before: Vec<f64> = draws.iter().map(|draw| uncompensated.largest(draw)).collect();
    let worse = largest.iter().zip(&largest_before).filter(|(after, before)| after > before).count();
    let at_decisive = |draw: &Draw| compensated.largest_at(&decisive, draw);
    let break_even = break_even(at_decisive, |draw| uncompensated.largest(draw));
    let missed_p95 = missed_p95(&plants, kept, errors.missed, &draws);
    let after = Quantiles::of(largest);
    ErrorBand {
        measures: measures(spreads, &deviates, plants.filtered.len() > 1, at_decisive),
        shares: decisive.first().map(|&widest| shares(&compensated, widest)).unwrap_or_default(),
        wall: Quantiles::of(draws.iter().map(|draw| top.largest(draw)).collect()),
        // The same commands leave the same.
        before: if is_same { after } else { Quantiles::of(largest_before) },
        missed_p95,
        samples,
        p95,
        estimate,
        after,
        break_even,
        worse: if is_same { 0.0 } else { worse as f64 / draws.len() as f64 },
    }
}

/// 95 % quantile of what of the path the tip never reaches [m], see [`ErrorBand::missed_p95`]. It is
/// largest at the lower or the upper end of the frequencies of the filter.
fn missed_p95(plants: &Plants, kept: &[Joints], nominal: Largest, draws: &[Draw]) -> f64 {
    let (_, plan, timing) = plants.nominal();
    let arc_length = &timing.arc_length;
    let sample = arc_length.partition_point(|s| *s < nominal.at).min(arc_length.len() - 1);
    let there = plants.send(kept, &[sample], 0.0);
    let tip = |draw: &Draw| there.tip(0, &Draw { frequency: 1.0, ..*draw });
    let nominal_tip = tip(&Draw::NOMINAL);
    let mut moved: Vec<f64> = draws.iter().map(|draw| (tip(draw) - nominal_tip).norm()).collect();
    let missed = plan.setup.spreads.frequency.ends().into_iter().map(|factor| plants.missed(kept, factor));
    let largest = if plants.filtered.len() > 1 { missed.fold(nominal.max, f64::max) } else { nominal.max };
    largest + quantile::of_unsorted(&mut moved, 0.95)
}

/// A first estimate of the 95 % quantile at each sample [m]: a softer and a stiffer plant add the
/// part `reach` of the deflection to what is left, or take it away.
fn estimate(NominalErrors { after, deflection, .. }: &NominalErrors, reach: f64) -> Vec<f64> {
    let errors = after.iter().zip(*deflection);
    errors.map(|(after, bent)| (after + bent * reach).norm().max((after - bent * reach).norm())).collect()
}

/// The part of the deflection by which a plant at the end of the 95 % ranges differs, to first order.
fn reach(plan: &Plan) -> f64 {
    let spreads = &plan.setup.spreads;
    let covariance = spreads.covariance();
    // A rigid joint adds nothing, however little is known of it.
    let soft = (0..6).filter(|joint| plan.robot.compliance()[*joint] > 0.0);
    let tied = |joint: usize| covariance[(joint, joint)] + 2.0 * covariance[(joint, 6)];
    let stiffness = soft.map(tied).reduce(f64::max).unwrap_or(0.0).max(-covariance[(6, 6)]);
    COVERAGE * (stiffness + covariance[(6, 6)]).sqrt()
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
    let joints = place.by_joint(plan).map(across);
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
    let covariance = spreads.covariance();
    let forces = [[1.0, 1.0, 1.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let grown: Vec<Vector3<f64>> = joints.into_iter().chain(forces.map(|force| -moved(force, 0.0))).collect();
    let square = |i: usize| (0..9).map(|j| covariance[(i, j)] * grown[i].dot(&grown[j])).sum();
    let names = ["cutting", "radial-ratio", "axial-ratio"].map(str::to_owned);
    let names = (1..=6).map(|joint| format!("joint-{joint}")).chain(names);
    let mut squares: Vec<(String, f64)> = names.enumerate().map(|(i, name)| (name, square(i))).collect();
    let deviation = spreads.frequency.deviation();
    let size = if deviation > 0.0 { moved([0.0; 3], 1.0).norm() * deviation } else { 0.0 };
    squares.push(("frequency".to_owned(), size * size));
    let total: f64 = squares.iter().map(|(_, square)| square).sum();
    let share = |square: f64| if total > 0.0 { square / total } else { 0.0 };
    squares.into_iter().map(|(input, square)| Share { input, share: share(square) }).collect()
}

/// What each measurement brings, by the same draws with that input's spread narrowed.
fn measures(
    spreads: &Spreads,
    deviates: &[Deviates],
    is_filtered: bool,
    largest: impl Fn(&Draw) -> f64,
) -> Vec<Measure> {
    let [stiffness, cutting, frequency] = MEASURED.map(InputSpread::percent);
    let narrowed = |known: InputSpread, better: InputSpread| {
        if known.deviation() > better.deviation() { better } else { known }
    };
    // What a measured pass has tied is not measured again by itself.
    let with_stiffness = match &spreads.stiffness {
        Stiffness::Each(each) => Stiffness::Each(each.map(|known| narrowed(known, stiffness))),
        fitted => fitted.clone(),
    };
    let cut = if spreads.together.is_some() { spreads.cutting } else { narrowed(spreads.cutting, cutting) };
    let ratios = if spreads.together.is_some() { spreads.ratios } else { cut };
    let tried = [
        ("stiffness", MEASURED[0], Spreads { stiffness: with_stiffness, ..spreads.clone() }),
        ("cutting", MEASURED[1], Spreads { cutting: cut, ratios, ..spreads.clone() }),
        (
            "frequency",
            MEASURED[2],
            Spreads { frequency: narrowed(spreads.frequency, frequency), ..spreads.clone() },
        ),
    ];
    let measures = tried
        .into_iter()
        .filter(|(input, _, tried)| tried != spreads && (is_filtered || *input != "frequency"))
        .map(|(input, percent, tried)| {
            let errors = deviates.iter().map(|z| largest(&Draw::at(&tried, z))).collect();
            Measure { input, percent, p95: Quantiles::of(errors).p95 }
        });
    math::rising(measures, |measure| measure.p95)
}
