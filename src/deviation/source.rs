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
    pub q: Vec<Joints>,
    /// Force on the tool in the base frame [N]; zero if it does not act.
    pub force: Vec<Vector3<f64>>,
    /// Displacement of the tip by the force [m].
    pub deflection: Vec<Vector3<f64>>,
    /// Actual tip in the base frame [m].
    pub actual: Vec<Vector3<f64>>,
    /// Actual tool axis, from tip to spindle, in the base frame.
    pub axis: Vec<Vector3<f64>>,
    /// Contour error, from the actual tip to the closest point of the desired path [m].
    pub contour_error: Vec<Vector3<f64>>,
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
}

/// Where the tool is along the path over time, and what follows from that alone: the same whatever is commanded.
#[derive(Debug, Clone)]
pub struct Passage<'a> {
    /// Which sources act.
    pub acting: Sources,
    /// Progress along the path.
    pub pace: &'a Pace,
    /// The path's points there [m].
    pub target: Vec<Vector3<f64>>,
    /// Force on the tool there in the base frame [N]; zero if it does not act.
    pub force: Vec<Vector3<f64>>,
}

impl<'a> Passage<'a> {
    /// The passage at a pace under the plan's cut.
    pub fn new(plan: &Plan, pace: &'a Pace, acting: Sources) -> Self {
        let force = if acting.deflection {
            along::forces(&plan.path, pace, &plan.mean_force, &plan.chip)
        } else {
            vec![Vector3::zeros(); pace.arc_length.len()]
        };
        Self::under(&plan.path, pace, acting, force)
    }

    /// The same under forces that are known.
    pub fn under(path: &Path, pace: &'a Pace, acting: Sources, force: Vec<Vector3<f64>>) -> Self {
        let target = pace.arc_length.iter().map(|&s| path.point(s)).collect();
        Self { acting, pace, target, force }
    }
}

/// Sends joint commands through shaper, arm and cut (Figs. 4.7, 5.14, 5.16): actual tip = shaped pose + C F.
///
/// Eq. 5.3 subtracts the displacement; a force pushes the tip its own way, so it is added here. Force and compliance are taken where the
/// shaped command puts the arm; where deflection does not act, nothing gives way to force or weight. `q` has one row for each sample of the passage.
pub fn deviate(plan: &Plan, passage: &Passage, q: &[Joints]) -> Deviation {
    bent(plan, passage, q, |_, _| {})
}

/// The same and, from the same poses, what shaping does without deflection.
pub fn deviate_and_shape(plan: &Plan, passage: &Passage, q: &[Joints]) -> (Deviation, Deviation) {
    let (mut actual, mut axis) = (Vec::with_capacity(q.len()), Vec::with_capacity(q.len()));
    let deviation = bent(plan, passage, q, |tip, along| {
        actual.push(tip);
        axis.push(along);
    });
    let none = vec![Vector3::zeros(); q.len()];
    let contour_error = contour::contour_errors(&plan.path, passage, &actual);
    let q = deviation.q.clone();
    (deviation, Deviation { q, force: none.clone(), deflection: none, actual, axis, contour_error })
}

/// Where deflection takes the shaped poses; `shaped` is told the tip and axis of each before it gives way.
fn bent(
    plan: &Plan,
    passage: &Passage,
    q: &[Joints],
    mut shaped: impl FnMut(Vector3<f64>, Vector3<f64>),
) -> Deviation {
    let Passage { acting, force, .. } = passage;
    let q = if acting.shaping { plan.shaper.joints(q, plan.trajectory.sample_time) } else { q.to_vec() };
    let mut deflection = Vec::with_capacity(q.len());
    let mut actual = Vec::with_capacity(q.len());
    let mut axis = Vec::with_capacity(q.len());
    for (q, force) in q.iter().zip(force) {
        let frames = forward::frames(&plan.robot, q);
        let tcp = frames[5].compose(plan.robot.tool());
        let along: Vector3<f64> = -tcp.rotation.column(2);
        let placed = |moved: Vector3<f64>, turned: Vector3<f64>| {
            (tcp.position + moved, (along + turned.cross(&along)).normalize())
        };
        let (mut displacement, mut rotation) = (Vector3::zeros(), Vector3::zeros());
        let (tip, direction) = placed(displacement, rotation);
        shaped(tip, direction);
        if acting.deflection {
            (displacement, rotation) = compliance::deflection(&plan.robot, q, &frames, &tcp.position, force);
            if let Some(bending) = &plan.bending {
                let (moved, turned) = bending.deflection(&along, force);
                displacement += moved;
                rotation += turned;
            }
        }
        let (tip, direction) = placed(displacement, rotation);
        deflection.push(displacement);
        actual.push(tip);
        axis.push(direction);
    }
    let contour_error = contour::contour_errors(&plan.path, passage, &actual);
    Deviation { q, force: force.clone(), deflection, actual, axis, contour_error }
}

impl Deviation {
    /// Angle between the actual and the desired tool axis where the tool is along the path [rad], one a sample.
    pub fn axis_errors(&self, path: &Path, pace: &Pace) -> Vec<f64> {
        let tilt = |(axis, &s): (&Vector3<f64>, &f64)| math::angle_between(axis, &path.axis(s));
        self.axis.iter().zip(&pace.arc_length).map(tilt).collect()
    }
}
