//! The forward model: joint commands sent through shaper, arm and cut (Figs. 4.7, 5.14, 5.16).
//!
//! Actual tip = shaped pose + C F. Eq. 5.3 subtracts the displacement; a force pushes the tip its own
//! way, so it is added here. Force and compliance are taken where the shaped command puts the arm; where
//! deflection does not act, nothing gives way to force or weight.

use crate::deviation::{Deviation, DeviationBuilder, Reference, TipAndAxis};
use crate::job::{Source, Sources};
use crate::motion::Shaper;
use crate::plan::Plan;
use crate::progress::Progress;
use crate::robot::{Joints, compliance, forward};
use nalgebra::Vector3;
use std::sync::Arc;

/// The outcome of joint commands while every source acts, taken apart.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorsBySource {
    /// By every source.
    pub total: Arc<Deviation>,
    /// By the shaper, if nothing gave way to forces.
    pub shaping: Arc<Deviation>,
    /// Displacement of the tip by the force [m].
    pub deflection: Vec<Vector3<f64>>,
}

/// The deviation that joint commands end in, under the sources that act in the reference; `q` has one
/// row for each of its samples.
pub fn simulate(plan: &Plan, reference: &Reference, q: &[Joints], progress: &mut Progress) -> Deviation {
    let mut total = DeviationBuilder::new(&plan.path, reference, reference.acting);
    send(plan, reference, q, progress, |k, pose, given_way| total.push(k, pose, given_way));
    total.finish()
}

/// The same for a reference where every source acts and, from the same poses, the shaper alone and how
/// far forces move the shaped tip.
pub fn simulate_by_source(
    plan: &Plan,
    reference: &Reference,
    q: &[Joints],
    progress: &mut Progress,
) -> ErrorsBySource {
    let mut total = DeviationBuilder::new(&plan.path, reference, reference.acting);
    let mut shaping = DeviationBuilder::new(&plan.path, reference, Sources::only(Source::Shaping));
    let mut deflection = Vec::with_capacity(reference.force.len());
    send(plan, reference, q, progress, |k, pose, given_way| {
        shaping.push(k, pose, &Default::default());
        total.push(k, pose, given_way);
        deflection.push(given_way.0);
    });
    ErrorsBySource { total: total.finish().into(), shaping: shaping.finish().into(), deflection }
}

/// Calls `arrived` for each sample with its number, the shaped tip with the tool axis, and how far they
/// give way: moved [m] and turned [rad].
fn send(
    plan: &Plan,
    reference: &Reference,
    q: &[Joints],
    progress: &mut Progress,
    mut arrived: impl FnMut(usize, &TipAndAxis, &TipAndAxis),
) {
    let none = Shaper::none();
    let shaper = if reference.acting.shaping { plan.shaper() } else { &none };
    let shaped = shaper.shaped(q, plan.trajectory.sample_time);
    progress.at(0.0);
    for k in 0..q.len() {
        let q = shaped.at(k);
        let frames = forward::frames(&plan.robot, &q);
        let tcp = frames[5].compose(plan.robot.tool());
        let axis: Vector3<f64> = -tcp.rotation.column(2);
        let mut given_way = Default::default();
        if reference.acting.deflection {
            let force = &reference.force[k];
            given_way = compliance::deflection(&plan.robot, &q, &frames, &tcp.position, force);
            if let Some(bending) = &plan.setup.bending {
                let (moved, turned) = bending.deflection(&axis, force);
                given_way = (given_way.0 + moved, given_way.1 + turned);
            }
        }
        arrived(k, &(tcp.position, axis), &given_way);
        progress.sample(k, reference.arc_length.len());
    }
}
