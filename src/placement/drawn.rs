//! What may be left at a place after compensation: the drawn plants there.

use crate::cutting::PartForces;
use crate::plan::Plan;
use crate::robot::Joints;
use crate::setup::Setup;
use crate::uncertainty::draw::{Draw, deviates};
use crate::uncertainty::place::{DrawnPlace, places};
use crate::uncertainty::quantile;
use nalgebra::Vector3;

/// Stations that are looked at: those with the largest deflection, and others all along the path,
/// where another plant may err more.
const LARGEST: usize = 16;
const ALONG: usize = 20;
/// Every so many of them, and those with the largest deflection, are where draws are screened.
const EVERY: usize = 4;
const SCREENED: usize = 4;
/// Share of the draws, those with the largest error to first order there, that are evaluated. The 5 %
/// above the quantile are nearly all among them; one that is not makes the quantile a little low.
const EVALUATED: f64 = 0.15;
/// Of those draws, the stations where the error is at least this share of its largest to first order
/// are looked at.
const NEAR: f64 = 0.85;
/// Step of a factor for that first order, about a standard deviation.
const STEP: f64 = 0.1;

/// The plants that are drawn, the same for every place.
#[derive(Debug, Clone)]
pub(super) struct DrawnPlants {
    draws: Vec<Draw>,
    parts: PartForces,
}

impl DrawnPlants {
    /// Those of a job: its own draws, as many as it asks for.
    pub(super) fn of(setup: &Setup) -> Self {
        let spreads = &setup.spreads;
        let draws = deviates(spreads.seed, spreads.draws).iter().map(|z| Draw::at(spreads, z)).collect();
        Self { draws, parts: PartForces::of(&setup.cut, setup.contacts.as_ref()) }
    }

    /// The 95 % quantile of the largest contour error with compensated commands [m]; `q` [rad] are the
    /// desired ones and `bent` [m] the contour errors with these, at the plan's stations.
    pub(super) fn p95(&self, plan: &Plan, q: &[Joints], bent: &[Vector3<f64>]) -> f64 {
        let timing = &plan.trajectory.timing;
        let worst = worst(bent);
        let last = bent.len() - 1;
        let along = |k: &usize| (0..ALONG).any(|n| n * last / (ALONG - 1) == *k);
        let at: Vec<usize> = (0..=last).filter(|k| worst.contains(k) || along(k)).collect();
        let taken_back = plan.sought().deflection;
        let places: Vec<DrawnPlace> = places(plan, (timing, &self.parts), (q, &at), 0.0)
            .into_iter()
            .map(|place| if taken_back { place.compensated(plan) } else { place })
            .collect();
        // Squares, until one is chosen.
        let across = |off: Vector3<f64>, station: usize| {
            let along = timing.heading[station].dot(&off);
            (off.norm_squared() - along * along).max(0.0)
        };
        let all: Vec<ScreenedStation> =
            at.iter().zip(&places).map(|(&k, place)| ScreenedStation::of(plan, place, k)).collect();
        let few: Vec<ScreenedStation> = (all.iter().enumerate())
            .filter(|(n, each)| n % EVERY == 0 || worst[..SCREENED.min(worst.len())].contains(&each.station))
            .map(|(_, each)| *each)
            .collect();
        let first = |each: &ScreenedStation, draw: &Draw| across(each.off(draw), each.station);
        let most = |screen: &[ScreenedStation], draw: &Draw| {
            screen.iter().map(|each| first(each, draw)).fold(0.0, f64::max)
        };
        let scores: Vec<f64> = self.draws.iter().map(|draw| most(&few, draw)).collect();
        let least = quantile::of_unsorted(&mut scores.clone(), 1.0 - EVALUATED);
        let largest = |draw: &Draw| {
            let enough = NEAR * NEAR * most(&all, draw);
            let near = all.iter().zip(&places).filter(|(each, _)| first(each, draw) >= enough);
            let sizes = near.map(|(each, place)| across(place.tip(plan, draw) - place.target, each.station));
            sizes.fold(0.0, f64::max)
        };
        // The others are below the quantile, however far.
        let evaluated =
            |(draw, score): (&Draw, &f64)| if *score < least { 0.0 } else { largest(draw).sqrt() };
        let mut errors: Vec<f64> = self.draws.iter().zip(&scores).map(evaluated).collect();
        quantile::of_unsorted(&mut errors, 0.95)
    }
}

/// The tip at a station, to first order in the factors of a draw.
#[derive(Clone, Copy)]
struct ScreenedStation {
    station: usize,
    /// From where it should be to the nominal tip [m].
    nominal: Vector3<f64>,
    /// Growth with the factors on six compliances and three parts of the force [m].
    growth: [Vector3<f64>; 9],
}

impl ScreenedStation {
    fn of(plan: &Plan, place: &DrawnPlace, station: usize) -> Self {
        let nominal = place.tip(plan, &Draw::NOMINAL);
        let growth = std::array::from_fn(|k| {
            let mut draw = Draw::NOMINAL;
            let Draw { compliance, force, .. } = &mut draw;
            if let Some(factor) = compliance.iter_mut().chain(force).nth(k) {
                *factor += STEP;
            }
            (place.tip(plan, &draw) - nominal) / STEP
        });
        Self { station, nominal: nominal - place.target, growth }
    }

    /// From where it should be to the tip with a drawn plant [m].
    fn off(&self, draw: &Draw) -> Vector3<f64> {
        let factors = draw.compliance.iter().chain(&draw.force);
        self.growth
            .iter()
            .zip(factors)
            .fold(self.nominal, |off, (growth, factor)| off + growth * (factor - 1.0))
    }
}

/// The stations with the largest contour errors, the largest first; by looking at all again for each,
/// which takes less room in the core than to sort them.
fn worst(bent: &[Vector3<f64>]) -> Vec<usize> {
    let mut size: Vec<f64> = bent.iter().map(Vector3::norm_squared).collect();
    let mut chosen = Vec::with_capacity(LARGEST);
    for _ in 0..LARGEST.min(size.len()) {
        let most = (1..size.len()).fold(0, |most, k| if size[k] > size[most] { k } else { most });
        chosen.push(most);
        size[most] = -1.0;
    }
    chosen
}
