//! The reference: where the tool should be over time, and the force on it there.

use crate::cutting::{CutStiffness, along};
use crate::job::Sources;
use crate::motion::{TimingLaw, Trajectory};
use crate::path::{Axes, Path};
use crate::plan::Plan;
use crate::setup::Setup;
use nalgebra::Vector3;
use std::borrow::Cow;
use std::sync::Arc;

/// Where the tool is along the path over time, and what depends on that alone, not on the commands.
#[derive(Debug, Clone)]
pub struct Reference<'a> {
    /// Which sources act.
    pub acting: Sources,
    /// Arc length of the tool [m].
    pub arc_length: Cow<'a, [f64]>,
    /// The path's points there [m].
    pub target: Cow<'a, [Vector3<f64>]>,
    /// The path's tool axes there.
    pub axis: Axes,
    /// Force on the tool there in the base frame [N]; empty if deflection does not act.
    pub force: Arc<Vec<Vector3<f64>>>,
    /// Stiffness of the cut there; empty if the force does not follow the deflection.
    pub stiffness: Arc<Vec<CutStiffness>>,
}

/// Force on the tool as planned [N] and stiffness of the cut, one per sample or empty; see
/// [`Reference`].
pub type SampledCut = (Vec<Vector3<f64>>, Vec<CutStiffness>);

impl<'a> Reference<'a> {
    /// The reference along a plan's motion: delayed by the shaper if shaping acts.
    pub fn along(plan: &'a Plan, acting: Sources) -> Self {
        let Trajectory { timing, position, axis, .. } = &*plan.trajectory;
        if acting.shaping {
            return Self::by(plan, plan.timing(acting).into_owned(), acting);
        }
        let (force, stiffness) = cut_along(plan, timing, acting);
        Self {
            acting,
            arc_length: Cow::Borrowed(&timing.arc_length),
            target: Cow::Borrowed(position),
            axis: axis.clone(),
            force: force.into(),
            stiffness: stiffness.into(),
        }
    }

    /// The reference for another timing law.
    pub fn by(plan: &Plan, timing: TimingLaw, acting: Sources) -> Self {
        let cut = cut_along(plan, &timing, acting);
        Self::under(&plan.path, timing, acting, cut)
    }

    /// The reference for a timing law with a known cut.
    pub fn under(path: &Path, timing: TimingLaw, acting: Sources, (force, stiffness): SampledCut) -> Self {
        let target = timing.points(path).into();
        let axis = Axes::along(path, &timing.arc_length, &timing.index);
        let arc_length = timing.arc_length.into();
        Self { acting, arc_length, target, axis, force: force.into(), stiffness: stiffness.into() }
    }

    /// This reference without force.
    pub fn without_force(&self) -> Self {
        let acting = Sources { deflection: false, ..self.acting };
        Self { acting, force: Arc::default(), stiffness: Arc::default(), ..self.clone() }
    }
}

/// The cut along a timing law; empty if deflection does not act.
pub(crate) fn cut_along(plan: &Plan, timing: &TimingLaw, acting: Sources) -> SampledCut {
    if !acting.deflection {
        return Default::default();
    }
    let Setup { mean_force, stiffness, loading, .. } = &*plan.setup;
    let force = along::forces(&plan.path, timing, mean_force, loading);
    let stiffness =
        stiffness.iter().flat_map(|stiffness| along::stiffness(&plan.path, timing, stiffness, loading));
    (force, stiffness.collect())
}
