//! A free roll about the tool axis in the pipeline: chosen before the run, compared with the fixed
//! one after it.

use crate::deviation::{Deviation, Reference, Source, Sources, simulate};
use crate::motion::roll::{self, RollGoal, RollRange};
use crate::path::{Path, Roll};
use crate::plan::Plan;
use crate::progress::Progress;
use crate::report::{RollGain, RollOutcome};
use crate::robot::Joints;
use crate::units::DEG;

/// The path with the roll that suits it best. It is the fixed roll if the roll is not free, or if
/// no other leads to the end, so that the error says where. Reports progress before each roll
/// tried.
pub(super) fn chosen(plan: &Plan, progress: &mut Progress) -> Path {
    let Some(range) = plan.setup.roll_range else { return plan.path.clone() };
    progress.at(0.0);
    let fixed = plan.setup.roll;
    let coarse = plan.at_stations(plan.path.clone(), roll::STATIONS);
    let stations = &*coarse.trajectory;
    let acting = Sources::only(Source::Deflection);
    let errors = |at: &[usize], q: &[Joints]| {
        let reference = Reference::by(plan, stations.timing.at(at), acting);
        let errors = simulate(plan, &reference, q, &mut Progress::none()).contour_error;
        errors.iter().map(|error| error.norm_squared()).collect()
    };
    let best = |smoothness| {
        let (robot, path, start) = (&plan.robot, &plan.path, plan.setup.start);
        roll::Search { robot, path, stations, start, range, smoothness, errors: &errors }.best(fixed)
    };
    let nearest = Roll::fixed(fixed.clamp(range.low, range.high));
    let chosen = match range.goal {
        RollGoal::SmoothJoints => best(1.0),
        RollGoal::LeastError => {
            // Stations have no timing for a shaper to act on, so the whole model decides.
            let candidates = held(&coarse, &range).into_iter();
            let candidates = candidates.chain(roll::SMOOTHNESS.into_iter().filter_map(best));
            Some(least_error(plan, nearest.clone(), candidates, progress))
        }
    };
    plan.path.clone().with_roll(chosen.unwrap_or(nearest))
}

/// The roll with the least contour error; `first` is replaced only by a clearly better one.
fn least_error(
    plan: &Plan,
    first: Roll,
    candidates: impl Iterator<Item = Roll>,
    progress: &mut Progress,
) -> Roll {
    let mut best = (outcome(plan, Sources::ALL, &first), first);
    for roll in candidates {
        progress.at(0.0);
        let (beyond, error) = outcome(plan, Sources::ALL, &roll);
        let (best_beyond, least) = best.0;
        if (best_beyond && !beyond) || (beyond == best_beyond && error < 0.999 * least) {
            best = ((beyond, error), roll);
        }
    }
    best.1
}

/// The best constant angle, in steps of about 10 deg, judged at the stations of `coarse`.
fn held(coarse: &Plan, range: &RollRange) -> Option<Roll> {
    let RollRange { low, high, .. } = *range;
    let steps = ((high - low) / (10.0 * DEG)).ceil().max(1.0);
    let angles = (0..=steps as usize).map(|i| Roll::fixed(low + (high - low) * i as f64 / steps));
    let judged = angles.map(|roll| (outcome(coarse, Sources::only(Source::Deflection), &roll), roll));
    judged.min_by(|(a, _), (b, _)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))).map(|(_, roll)| roll)
}

/// Whether a joint leaves its range with a roll, and the largest contour error before compensation
/// [m]; infinite if it leads out of reach.
fn outcome(plan: &Plan, acting: Sources, roll: &Roll) -> (bool, f64) {
    let tried = Plan { path: plan.path.clone().with_roll(roll.clone()), ..plan.clone() };
    let Ok(joints) = tried.joints(&mut Progress::none()) else { return (true, f64::INFINITY) };
    let before = simulate(&tried, &Reference::along(&tried, acting), &joints.q, &mut Progress::none());
    (!joints.q.iter().all(|q| tried.is_within_limits(q)), before.statistics.max)
}

/// The gain by the roll of a plan's path over the fixed one, if it is free; `q` and `before` belong
/// to the plan.
pub(super) fn gain(plan: &Plan, q: &[Joints], before: &Deviation) -> Option<RollGain> {
    let range = plan.setup.roll_range?;
    let fixed = Plan { path: plan.setup.path.clone(), ..plan.clone() };
    let compared = fixed.joints(&mut Progress::none()).ok().map(|held| {
        let reference = Reference::along(&fixed, Sources::ALL);
        let before = simulate(&fixed, &reference, &held.q, &mut Progress::none());
        RollOutcome::of(&fixed, &held.q, &before)
    });
    Some(RollGain::new(plan, &range, RollOutcome::of(plan, q, before), compared))
}
