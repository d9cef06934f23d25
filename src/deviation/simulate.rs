//! The forward model: joint commands sent through shaper, arm and cut (Figs. 4.7, 5.14, 5.16).
//!
//! Actual tip = shaped pose + C F. Eq. 5.3 subtracts the displacement; a force moves the tip in its
//! own direction, so it is added here. Force and compliance are those at the shaped pose. If
//! deflection does not act, the arm yields to neither force nor weight. Where the force follows the
//! deflection, both are those of the [balance](crate::deviation::coupling).

use crate::deviation::coupling::{SettledCut, settled};
use crate::deviation::{Deviation, DeviationBuilder, Reference, TipAndAxis};
use crate::job::{Source, Sources};
use crate::motion::Shaper;
use crate::plan::Plan;
use crate::progress::Progress;
use crate::robot::{Joints, compliance, forward};
use nalgebra::Vector3;
use std::sync::Arc;

/// The result of joint commands while every source acts, split by source.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorsBySource {
    /// Deviation by every source.
    pub total: Arc<Deviation>,
    /// Deviation by the shaper alone, without deflection.
    pub shaping: Arc<Deviation>,
    /// Displacement of the tip by the force [m].
    pub deflection: Vec<Vector3<f64>>,
    /// That force [N], if it follows the deflection; else empty.
    pub force: Vec<Vector3<f64>>,
    /// Samples at which force and deflection find no balance.
    pub unsettled: Vec<usize>,
}

/// Simulates joint commands under the sources that act in the reference; `q` has one row for each
/// sample of the reference.
pub fn simulate(plan: &Plan, reference: &Reference, q: &[Joints], progress: &mut Progress) -> Deviation {
    let mut total = DeviationBuilder::new(plan, reference, reference.acting);
    send(plan, reference, q, progress, |k, pose, cut| total.push_cut(k, pose, cut));
    total.finish()
}

/// Simulates joint commands with every source acting. The same poses also give the deviation by the
/// shaper alone and the displacement of the shaped tip by forces.
pub fn simulate_by_source(
    plan: &Plan,
    reference: &Reference,
    q: &[Joints],
    progress: &mut Progress,
) -> ErrorsBySource {
    let mut total = DeviationBuilder::new(plan, reference, reference.acting);
    let mut shaping = DeviationBuilder::new(plan, reference, Sources::only(Source::Shaping));
    let mut deflection = Vec::with_capacity(reference.force.len());
    let (mut force, mut unsettled) = (Vec::with_capacity(reference.stiffness.len()), Vec::new());
    send(plan, reference, q, progress, |k, pose, cut| {
        shaping.push(k, pose, &Default::default());
        total.push_cut(k, pose, cut);
        deflection.push(cut.deflected.0);
        if !reference.stiffness.is_empty() {
            force.push(cut.force);
        }
        if !cut.converged {
            unsettled.push(k);
        }
    });
    let (total, shaping) = (total.finish().into(), shaping.finish().into());
    ErrorsBySource { total, shaping, deflection, force, unsettled }
}

/// Calls `arrived` for each sample with its number, the shaped tip with the tool axis, and the cut
/// there.
fn send(
    plan: &Plan,
    reference: &Reference,
    q: &[Joints],
    progress: &mut Progress,
    mut arrived: impl FnMut(usize, &TipAndAxis, &SettledCut),
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
        let deflect = |force: &Vector3<f64>| {
            let deflected = compliance::deflection(&plan.robot, &q, &frames, &tcp.position, force);
            let Some(bending) = &plan.setup.bending else { return deflected };
            let (moved, turned) = bending.deflection(&axis, force);
            (deflected.0 + moved, deflected.1 + turned)
        };
        let cut = match (reference.force.get(k), reference.stiffness.get(k)) {
            // No deflection acts.
            (None, _) => SettledCut::planned(Vector3::zeros(), Default::default()),
            (Some(force), None) => SettledCut::planned(*force, deflect(force)),
            (Some(force), Some(stiffness)) => {
                settled(force, stiffness, &(tcp.position - reference.target[k]), deflect)
            }
        };
        arrived(k, &(tcp.position, axis), &cut);
        progress.sample(k, reference.arc_length.len());
    }
}
