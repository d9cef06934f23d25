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
    let parts = PartForces::of(&plan.setup.cut, plan.setup.contacts.as_ref());
    // The timing of one filter at a time, for memory is scarce.
    let node = |(factor, plan): &(f64, Plan)| {
        (*factor, places(plan, (&plan.timing(Sources::ALL), &parts), (q, at), 0.0))
    };
    let outcomes = Outcomes { plan, nodes: filtered(plan).iter().map(node).collect() };
    let drawn = |z| {
        let draw = Draw::at(spreads, z);
        (0..at.len()).map(|place| size(place, &outcomes.drawn(place, &draw).1)).fold(0.0, f64::max)
    };
    Quantiles::of(deviates(spreads.seed, spreads.draws).iter().map(drawn).collect())
}
