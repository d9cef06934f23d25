//! The largest of any measure of the tip over the drawn plants.

use crate::cutting::PartForces;
use crate::job::Sources;
use crate::plan::Plan;
use crate::robot::Joints;
use crate::uncertainty::Quantiles;
use crate::uncertainty::draw::{Draw, deviates};
use crate::uncertainty::outcomes::{Outcomes, filtered};
use crate::uncertainty::place::places;
use nalgebra::Vector3;

/// Quantiles, over the drawn plants, of the largest `size` [m] at the samples `at`, which rise, with the joint
/// commands `q` [rad]; `size` gets the number of the place in `at` and the tip there [m].
pub fn largest(
    plan: &Plan,
    (q, at): (&[Joints], &[usize]),
    size: impl Fn(usize, &Vector3<f64>) -> f64,
) -> Quantiles {
    let spreads = &plan.setup.spreads;
    let plans = filtered(plan);
    let outcomes = outcomes(plan, &plans, (q, at));
    let drawn = |z| {
        let draw = Draw::at(spreads, z);
        (0..at.len()).map(|place| size(place, &outcomes.drawn(place, &draw).1)).fold(0.0, f64::max)
    };
    Quantiles::of(deviates(spreads.seed, spreads.draws).iter().map(drawn).collect())
}

/// The largest contour error [m] at the samples `at`, which rise, with the joint commands `q` [rad] and each of
/// the plants `draws`.
pub fn largest_errors(plan: &Plan, (q, at): (&[Joints], &[usize]), draws: &[Draw]) -> Vec<f64> {
    let plans = filtered(plan);
    let outcomes = outcomes(plan, &plans, (q, at));
    draws.iter().map(|draw| outcomes.largest(draw)).collect()
}

/// Where the commands take the tip at the samples `at`, with each frequency of the filter.
fn outcomes<'a>(plan: &'a Plan, plans: &[(f64, Plan)], (q, at): (&[Joints], &[usize])) -> Outcomes<'a> {
    let parts = PartForces::of(&plan.setup.cut, plan.setup.contacts.as_ref());
    // The timing of one filter at a time, for memory is scarce.
    let node = |(factor, plan): &(f64, Plan)| {
        (*factor, places(plan, (&plan.timing(Sources::ALL), &parts), (q, at), 0.0))
    };
    Outcomes { plan, nodes: plans.iter().map(node).collect() }
}
