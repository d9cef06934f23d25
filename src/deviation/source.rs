//! The actual path under each source of error, alone or together (thesis sections 4.3-4.5, 5.2).

use crate::cutting::along::{self, ChipLoad};
use crate::cutting::{Bending, LinearForce};
use crate::deviation::contour;
use crate::math;
use crate::motion::{Pace, Shaper, Trajectory};
use crate::path::Path;
use crate::robot::{Joints, Robot, compliance, forward};
use nalgebra::Vector3;
use std::borrow::Cow;
use std::sync::Arc;

/// A source of error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// Cutting forces bend the arm.
    Deflection,
    /// The input shaper bends the path.
    Shaping,
}

/// Which sources act.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sources {
    /// Cutting forces.
    pub deflection: bool,
    /// Input shaping.
    pub shaping: bool,
}

impl Sources {
    /// Every source.
    pub const ALL: Self = Self { deflection: true, shaping: true };

    /// One source alone.
    pub fn only(source: Source) -> Self {
        Self { deflection: source == Source::Deflection, shaping: source == Source::Shaping }
    }
}

/// Everything that is known before the robot moves: arm, path, motion and cut.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The arm with its tool.
    pub robot: Robot,
    /// The desired path in the base frame.
    pub path: Path,
    /// The desired motion.
    pub trajectory: Trajectory,
    /// The shaper of the joint commands.
    pub shaper: Shaper,
    /// Mean milling force in {T}.
    pub mean_force: LinearForce,
    /// What sets the chip.
    pub chip: ChipLoad,
    /// How the tool bends, if it does.
    pub bending: Option<Bending>,
}

/// What becomes of joint commands.
#[derive(Debug, Clone, PartialEq)]
pub struct Deviation {
    /// Joint values after the shaper, as far as it acts [rad].
    pub q: Arc<Vec<Joints>>,
    /// Force on the tool in the base frame [N]; empty if it does not act.
    pub force: Arc<Vec<Vector3<f64>>>,
    /// Displacement of the tip by the force [m]; empty if it does not act.
    pub deflection: Vec<Vector3<f64>>,
    /// Actual tip in the base frame [m].
    pub actual: Vec<Vector3<f64>>,
    /// Actual tool axis, from tip to spindle, in the base frame; empty along a path with one axis all along.
    pub axis: Vec<Vector3<f64>>,
    /// Contour error, from the actual tip to the closest point of the desired path [m].
    pub contour_error: Vec<Vector3<f64>>,
    /// Angle between the actual and the desired tool axis where the tool is along the path [rad].
    pub axis_error: Vec<f64>,
}

impl Plan {
    /// Where along the path the tool is over time: behind the command if shaping acts.
    pub fn pace(&self, acting: Sources) -> Cow<'_, Pace> {
        if acting.shaping {
            Cow::Owned(self.shaper.pace(&self.trajectory.pace, self.trajectory.sample_time))
        } else {
            Cow::Borrowed(&self.trajectory.pace)
        }
    }

    /// The passage of the tool under the cut.
    pub fn passage(&self, acting: Sources) -> Passage<'_> {
        Passage::new(self, self.pace(acting), acting)
    }
}

/// Where the tool is along the path over time, and what follows from that alone: the same whatever is commanded.
#[derive(Debug, Clone)]
pub struct Passage<'a> {
    /// Which sources act.
    pub acting: Sources,
    /// Progress along the path.
    pub pace: Cow<'a, Pace>,
    /// The path's points there [m].
    pub target: Vec<Vector3<f64>>,
    /// Force on the tool there in the base frame [N]; empty if it does not act.
    pub force: Arc<Vec<Vector3<f64>>>,
}

impl<'a> Passage<'a> {
    /// The passage at a pace under the plan's cut.
    pub fn new(plan: &Plan, pace: Cow<'a, Pace>, acting: Sources) -> Self {
        let force = if acting.deflection {
            along::forces(&plan.path, &pace, &plan.mean_force, &plan.chip)
        } else {
            Vec::new()
        };
        Self::under(&plan.path, pace, acting, force.into())
    }

    /// The same under forces that are known.
    pub fn under(path: &Path, pace: Cow<'a, Pace>, acting: Sources, force: Arc<Vec<Vector3<f64>>>) -> Self {
        let target = pace.arc_length.iter().map(|&s| path.point(s)).collect();
        Self { acting, pace, target, force }
    }

    /// The same without force.
    pub fn without_force(&self) -> Self {
        let acting = Sources { deflection: false, ..self.acting };
        Self { acting, force: Arc::default(), ..self.clone() }
    }
}

/// Sends joint commands through shaper, arm and cut (Figs. 4.7, 5.14, 5.16): actual tip = shaped pose + C F.
///
/// Eq. 5.3 subtracts the displacement; a force pushes the tip its own way, so it is added here. Force and compliance are taken where the
/// shaped command puts the arm; where deflection does not act, nothing gives way to force or weight. `q` has one row for each sample of the passage.
pub fn deviate(plan: &Plan, passage: &Passage, q: &Arc<Vec<Joints>>) -> Deviation {
    sent(plan, passage, q, None)
}

/// The same and, from the same poses, what shaping does without deflection.
pub fn deviate_and_shape(plan: &Plan, passage: &Passage, q: &Arc<Vec<Joints>>) -> (Deviation, Deviation) {
    let mut shaped = Poses::new(plan, q.len());
    let deviation = sent(plan, passage, q, Some(&mut shaped));
    let shaping = shaped.deviation(plan, passage, deviation.q.clone(), Arc::default(), Vec::new());
    (deviation, shaping)
}

/// What becomes of the commands; `shaped` gets the poses before they give way.
fn sent(plan: &Plan, passage: &Passage, q: &Arc<Vec<Joints>>, mut shaped: Option<&mut Poses>) -> Deviation {
    let q = match passage.acting.shaping {
        true => Arc::new(plan.shaper.joints(q, plan.trajectory.sample_time)),
        false => q.clone(),
    };
    let mut bent = Poses::new(plan, q.len());
    let mut deflection = Vec::with_capacity(passage.force.len());
    for (k, q) in q.iter().enumerate() {
        let frames = forward::frames(&plan.robot, q);
        let tcp = frames[5].compose(plan.robot.tool());
        let axis: Vector3<f64> = -tcp.rotation.column(2);
        let desired = plan.path.axis(passage.pace.arc_length[k]);
        let still = (Vector3::zeros(), Vector3::zeros());
        if let Some(shaped) = &mut shaped {
            shaped.push((&tcp.position, &axis), still, &desired);
        }
        let mut given_way = still;
        if passage.acting.deflection {
            let force = &passage.force[k];
            given_way = compliance::deflection(&plan.robot, q, &frames, &tcp.position, force);
            if let Some(bending) = &plan.bending {
                let (moved, turned) = bending.deflection(&axis, force);
                given_way = (given_way.0 + moved, given_way.1 + turned);
            }
            deflection.push(given_way.0);
        }
        bent.push((&tcp.position, &axis), given_way, &desired);
    }
    bent.deviation(plan, passage, q, passage.force.clone(), deflection)
}

/// Tips and tool axes while they are collected.
struct Poses {
    actual: Vec<Vector3<f64>>,
    axis: Option<Vec<Vector3<f64>>>,
    axis_error: Vec<f64>,
}

impl Poses {
    fn new(plan: &Plan, samples: usize) -> Self {
        let axis = plan.path.is_multi_axis().then(|| Vec::with_capacity(samples));
        Self { actual: Vec::with_capacity(samples), axis, axis_error: Vec::with_capacity(samples) }
    }

    /// A tip with its axis that has moved [m] and turned [rad].
    fn push(
        &mut self,
        (tip, axis): (&Vector3<f64>, &Vector3<f64>),
        (moved, turned): (Vector3<f64>, Vector3<f64>),
        desired: &Vector3<f64>,
    ) {
        self.actual.push(tip + moved);
        let axis = (axis + turned.cross(axis)).normalize();
        self.axis_error.push(math::angle_between(&axis, desired));
        if let Some(all) = &mut self.axis {
            all.push(axis);
        }
    }

    fn deviation(
        self,
        plan: &Plan,
        passage: &Passage,
        q: Arc<Vec<Joints>>,
        force: Arc<Vec<Vector3<f64>>>,
        deflection: Vec<Vector3<f64>>,
    ) -> Deviation {
        let Self { actual, axis, axis_error } = self;
        let contour_error = contour::contour_errors(&plan.path, passage, &actual);
        Deviation { q, force, deflection, actual, axis: axis.unwrap_or_default(), contour_error, axis_error }
    }
}
