//! A feed rule in the pipeline: its run is compared with one at the programmed feed.

use crate::cutting::StiffnessAlong;
use crate::deviation::{Deviation, Reference, Sources, simulate};
use crate::error::Error;
use crate::motion::Trajectory;
use crate::plan::Plan;
use crate::progress::Progress;
use crate::report::{FeedOutcome, FeedRuleGain};
use crate::setup::Setup;
use nalgebra::Vector3;
use std::sync::Arc;

/// The gain of a plan's feed rule, if it has one; the forces [N] and the deviation `before`
/// compensation belong to the plan.
pub(super) fn gain(
    plan: &Plan,
    forces: &[Vector3<f64>],
    before: &Deviation,
) -> Result<Option<FeedRuleGain>, Error> {
    let Some(programmed) = programmed(plan) else { return Ok(None) };
    let q = programmed.joints(&mut Progress::none())?.q;
    let reference = Reference::along(&programmed, Sources::ALL);
    let deviation = simulate(&programmed, &reference, &q, &mut Progress::none());
    let outcome = FeedOutcome::of(&programmed, &reference.force, &deviation);
    Ok(FeedRuleGain::new(plan, outcome, FeedOutcome::of(plan, forces, before)))
}

/// The plan at the programmed feed, if a rule sets another.
fn programmed(plan: &Plan) -> Option<Plan> {
    let own = &plan.setup.feed_rule.as_ref()?.programmed;
    let setup = Setup {
        path: own.path.clone(),
        contacts: Some(own.contacts.clone()),
        mean_force: own.mean_force.clone(),
        stiffness: plan.setup.stiffness.as_ref().map(|_| StiffnessAlong::of(&plan.setup.cut, &own.contacts)),
        heaviest: own.mean_force.heaviest(&plan.setup.loading, &own.path),
        feed_rule: None,
        ..(*plan.setup).clone()
    };
    let trajectory = Arc::new(Trajectory::new(&own.path, &setup.limits));
    let path = own.path.clone().rolled_as(&plan.path);
    Some(Plan { setup: setup.into(), robot: plan.robot.clone(), path, trajectory })
}
