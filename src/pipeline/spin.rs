//! A free spin in the pipeline: chosen before the run, compared with the fixed one after it.

use crate::deviation::{Deviation, Passage, Plan, Source, Sources, contour, deviate};
use crate::error::Error;
use crate::job::Setup;
use crate::motion::Trajectory;
use crate::motion::joints::{JointTrajectory, joint_trajectory};
use crate::motion::spin::{self, Freedom};
use crate::path::{Path, Spin};
use crate::report::{Effort, SpinGain};
use crate::robot::Joints;
use crate::units::DEG;

/// The path with the spin that suits it best; with the fixed one where none leads to its end, so that the error says where.
/// `on_try` is called before each spin that is tried.
pub(super) fn chosen(plan: &Plan, setup: &Setup, freedom: &Freedom, on_try: &mut dyn FnMut()) -> Path {
    on_try();
    let stations = Trajectory::stations(&plan.path, &setup.tempo, spin::STATIONS);
    let acting = Sources::only(Source::Deflection);
    let errors = |at: &[usize], q: &[Joints]| {
        let passage = Passage::new(plan, stations.pace.at(at), acting);
        let errors = deviate(plan, &passage, q).contour_error;
        errors.iter().map(|error| error.norm_squared()).collect()
    };
    let best = |calm| {
        let (robot, path, stations, start) = (&plan.robot, &plan.path, &stations, setup.start);
        spin::Search { robot, path, stations, start, freedom: *freedom, calm, errors: &errors }
            .best(setup.spin)
    };
    let nearest = Spin::fixed(setup.spin.clamp(freedom.low, freedom.high));
    let chosen = match freedom.goal {
        spin::Goal::SmoothJoints => best(1.0),
        // Stations have no timing that a shaper could bend: the whole model decides.
        spin::Goal::LeastError => {
            let mut known = (nearest.clone(), outcome(plan, setup, Sources::ALL, &nearest));
            let held = held(&Plan { trajectory: stations.clone(), ..plan.clone() }, setup, freedom);
            // A little better is no reason to leave the fixed angle.
            for spin in held.into_iter().chain(spin::CALM.into_iter().filter_map(best)) {
                on_try();
                let (beyond, error) = outcome(plan, setup, Sources::ALL, &spin);
                let (now_beyond, now) = known.1;
                if (now_beyond && !beyond) || (beyond == now_beyond && error < 0.999 * now) {
                    known = (spin, (beyond, error));
                }
            }
            Some(known.0)
        }
    };
    plan.path.clone().with_spin(chosen.unwrap_or(nearest))
}

/// The best angle to be held all along, in steps of about 10 deg, by the stations that `plan` travels.
fn held(plan: &Plan, setup: &Setup, freedom: &Freedom) -> Option<Spin> {
    let Freedom { low, high, .. } = *freedom;
    let steps = ((high - low) / (10.0 * DEG)).ceil().max(1.0);
    let angles = (0..=steps as usize).map(|i| Spin::fixed(low + (high - low) * i as f64 / steps));
    let judged = angles.map(|spin| (outcome(plan, setup, Sources::only(Source::Deflection), &spin), spin));
    judged.min_by(|(a, _), (b, _)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))).map(|(_, spin)| spin)
}

/// What the spin of `plan`'s path brings; `q` and `before` are of it.
pub(super) fn gain(
    plan: &Plan,
    setup: &Setup,
    freedom: &Freedom,
    q: &[Joints],
    before: &Deviation,
) -> SpinGain {
    let fixed = Plan { path: setup.path.clone(), ..plan.clone() };
    let compared = commanded(&fixed, setup).ok().map(|held| {
        let before = deviate(&fixed, &fixed.passage(Sources::ALL), &held.q);
        Effort::of(&fixed, &held.q, &before)
    });
    SpinGain::new(plan, freedom, setup.spin, Effort::of(plan, q, before), compared)
}

/// Joint commands for the desired path.
fn commanded(plan: &Plan, setup: &Setup) -> Result<JointTrajectory, Error> {
    let desired = (plan.trajectory.position.as_slice(), &plan.trajectory.axis);
    joint_trajectory(&plan.robot, &plan.path, &plan.trajectory, desired, setup.start)
}

/// What becomes of a spin before compensation: whether a joint leaves its range, and the largest contour error [m];
/// infinite where it leads out of reach.
fn outcome(plan: &Plan, setup: &Setup, acting: Sources, spin: &Spin) -> (bool, f64) {
    let tried = Plan { path: plan.path.clone().with_spin(spin.clone()), ..plan.clone() };
    let Ok(joints) = commanded(&tried, setup) else { return (true, f64::INFINITY) };
    let inside = |q: &Joints| {
        let ranges = tried.robot.limits().into_iter().flatten();
        ranges.zip(q.iter()).all(|((low, high), q)| (low..=high).contains(&q))
    };
    let before = deviate(&tried, &tried.passage(acting), &joints.q);
    (!joints.q.iter().all(inside), contour::mean_and_max(&before.contour_error).1)
}
