//! The reference: where the tool should be over time, and the force on it there.

use crate::cutting::along;
use crate::job::Sources;
use crate::motion::{TimingLaw, Trajectory};
use crate::path::{Axes, Path};
use crate::plan::Plan;
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
}

impl<'a> Reference<'a> {
    /// The reference along a plan's motion: delayed by the shaper if shaping acts.
    pub fn along(plan: &'a Plan, acting: Sources) -> Self {
        let Trajectory { timing, position, axis, .. } = &*plan.trajectory;
        if acting.shaping {
            return Self::by(plan, plan.timing(acting).into_owned(), acting);
        }
        Self {
            acting,
            arc_length: Cow::Borrowed(&timing.arc_length),
            target: Cow::Borrowed(position),
            axis: axis.clone(),
            force: force(plan, timing, acting).into(),
        }
    }

    /// The reference for another timing law.
    pub fn by(plan: &Plan, timing: TimingLaw, acting: Sources) -> Self {
        let force = force(plan, &timing, acting);
        Self::under(&plan.path, timing, acting, force)
    }

    /// The reference for a timing law with known forces [N].
    pub fn under(path: &Path, timing: TimingLaw, acting: Sources, force: Vec<Vector3<f64>>) -> Self {
        let target = timing.points(path).into();
        let axis = Axes::along(path, &timing.arc_length, &timing.index);
        Self { acting, arc_length: timing.arc_length.into(), target, axis, force: force.into() }
    }

    /// This reference without force.
    pub fn without_force(&self) -> Self {
        let acting = Sources { deflection: false, ..self.acting };
        Self { acting, force: Arc::default(), ..self.clone() }
    }
}

/// Force on the tool [N]; empty if deflection does not act.
fn force(plan: &Plan, timing: &TimingLaw, acting: Sources) -> Vec<Vector3<f64>> {
    if !acting.deflection {
        return Vec::new();
    }
    along::forces(&plan.path, timing, &plan.setup.mean_force, &plan.setup.loading)
}
