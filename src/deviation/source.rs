//! The actual path under each source of error, alone or together (thesis sections 4.3-4.5, 5.2).

use crate::cutting::along::{self, ChipLoad};
use crate::cutting::{Bending, LinearForce};
use crate::deviation::contour;
use crate::math;
use crate::motion::joints::tell_share;
use crate::motion::{Pace, Shaper, Trajectory};
use crate::path::{Axes, Path};
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
    /// Actual tip in the base frame [m].
    pub actual: Vec<Vector3<f64>>,
    /// Actual tool axis, from tip to spindle, in the base frame; empty along a path with one axis all along.
    pub axis: Vec<Vector3<f64>>,
    /// Contour error, from the actual tip to the closest point of the desired path [m].
    pub contour_error: Vec<Vector3<f64>>,
    /// Angle between the actual and the desired tool axis where the tool is along the path [rad]; empty unless every source acts.
    pub axis_error: Vec<f64>,
}

/// What becomes of joint commands while every source acts, taken apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Parted {
    /// By every source.
    pub whole: Deviation,
    /// The same if nothing gave way to forces.
    pub shaping: Deviation,
    /// Displacement of the tip by the force [m].
    pub deflection: Vec<Vector3<f64>>,
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
        let Trajectory { pace, position, axis, .. } = &self.trajectory;
        if acting.shaping {
            return Passage::new(self, self.pace(acting).into_owned(), acting);
        }
        Passage {
            acting,
            arc_length: Cow::Borrowed(&pace.arc_length),
            target: Cow::Borrowed(position),
            axis: axis.clone(),
            force: Passage::force(self, pace, acting).into(),
        }
    }
}

/// Where the tool is along the path over time, and what follows from that alone: the same whatever is commanded.
#[derive(Debug, Clone)]
pub struct Passage<'a> {
    /// Which sources act.
    pub acting: Sources,
    /// Arc length where the tool is [m].
    pub arc_length: Cow<'a, [f64]>,
    /// The path's points there [m].
    pub target: Cow<'a, [Vector3<f64>]>,
    /// The path's tool axes there.
    pub axis: Axes,
    /// Force on the tool there in the base frame [N]; empty if it does not act.
    pub force: Arc<Vec<Vector3<f64>>>,
}

impl<'a> Passage<'a> {
    /// The passage at a pace under the plan's cut.
    pub fn new(plan: &Plan, pace: Pace, acting: Sources) -> Self {
        let force = Self::force(plan, &pace, acting);
        Self::under(&plan.path, Cow::Owned(pace.arc_length), acting, force.into())
    }

    fn force(plan: &Plan, pace: &Pace, acting: Sources) -> Vec<Vector3<f64>> {
        if !acting.deflection {
            return Vec::new();
        }
        along::forces(&plan.path, pace, &plan.mean_force, &plan.chip)
    }

    /// The passage by these arc lengths [m] under forces that are known.
    pub fn under(
        path: &Path,
        arc_length: Cow<'a, [f64]>,
        acting: Sources,
        force: Arc<Vec<Vector3<f64>>>,
    ) -> Self {
        let target = arc_length.iter().map(|&s| path.point(s)).collect();
        let axis = Axes::along(path, &arc_length);
        Self { acting, arc_length, target, axis, force }
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
pub fn deviate(plan: &Plan, passage: &Passage, q: &[Joints]) -> Deviation {
    deviate_with(plan, passage, q, &mut |_| {})
}

/// The same; `on_share` is told now and then which share of the samples is done.
pub fn deviate_with(
    plan: &Plan,
    passage: &Passage,
    q: &[Joints],
    on_share: &mut dyn FnMut(f64),
) -> Deviation {
    let mut whole = Arrivals::new(plan, passage, passage.acting);
    send(plan, passage, q, on_share, |k, pose, given_way| whole.push(k, pose, given_way));
    whole.deviation
}

/// The same for a passage where every source acts and, from the same poses, what shaping does alone and how far forces move the shaped tip.
pub fn deviate_apart(plan: &Plan, passage: &Passage, q: &[Joints], on_share: &mut dyn FnMut(f64)) -> Parted {
    let (mut whole, mut shaping) = (
        Arrivals::new(plan, passage, passage.acting),
        Arrivals::new(plan, passage, Sources::only(Source::Shaping)),
    );
    let mut deflection = Vec::with_capacity(passage.force.len());
    send(plan, passage, q, on_share, |k, pose, given_way| {
        shaping.push(k, pose, &Default::default());
        whole.push(k, pose, given_way);
        deflection.push(given_way.0);
    });
    Parted { whole: whole.deviation, shaping: shaping.deviation, deflection }
}

/// Calls `arrived` for each sample with its number, the shaped tip with the tool axis, and how far they give way: moved [m] and turned [rad].
fn send(
    plan: &Plan,
    passage: &Passage,
    q: &[Joints],
    on_share: &mut dyn FnMut(f64),
    mut arrived: impl FnMut(usize, &(Vector3<f64>, Vector3<f64>), &(Vector3<f64>, Vector3<f64>)),
) {
    let none = Shaper::none();
    let shaper = if passage.acting.shaping { &plan.shaper } else { &none };
    let shaped = shaper.shaped(q, plan.trajectory.sample_time);
    for k in 0..q.len() {
        let q = shaped.at(k);
        let frames = forward::frames(&plan.robot, &q);
        let tcp = frames[5].compose(plan.robot.tool());
        let axis: Vector3<f64> = -tcp.rotation.column(2);
        let mut given_way = Default::default();
        if passage.acting.deflection {
            let force = &passage.force[k];
            given_way = compliance::deflection(&plan.robot, &q, &frames, &tcp.position, force);
            if let Some(bending) = &plan.bending {
                let (moved, turned) = bending.deflection(&axis, force);
                given_way = (given_way.0 + moved, given_way.1 + turned);
            }
        }
        arrived(k, &(tcp.position, axis), &given_way);
        tell_share(on_share, k, passage.arc_length.len());
    }
}

/// Tips and tool axes while they are collected.
struct Arrivals<'a> {
    path: &'a Path,
    passage: &'a Passage<'a>,
    keeps_axes: bool,
    keeps_angles: bool,
    deviation: Deviation,
}

impl<'a> Arrivals<'a> {
    fn new(plan: &'a Plan, passage: &'a Passage<'a>, acting: Sources) -> Self {
        let samples = passage.arc_length.len();
        let (keeps_axes, keeps_angles) = (plan.path.is_multi_axis(), acting == Sources::ALL);
        let deviation = Deviation {
            actual: Vec::with_capacity(samples),
            axis: Vec::with_capacity(if keeps_axes { samples } else { 0 }),
            contour_error: Vec::with_capacity(samples),
            axis_error: Vec::with_capacity(if keeps_angles { samples } else { 0 }),
        };
        Self { path: &plan.path, passage, keeps_axes, keeps_angles, deviation }
    }

    /// The tip and axis of the sample `k` that have moved [m] and turned [rad].
    fn push(
        &mut self,
        k: usize,
        (tip, axis): &(Vector3<f64>, Vector3<f64>),
        (moved, turned): &(Vector3<f64>, Vector3<f64>),
    ) {
        let Self { path, passage, deviation, .. } = self;
        let tip = tip + moved;
        let place = (passage.arc_length[k], &passage.target[k]);
        deviation.contour_error.push(contour::contour_error(path, place, &tip));
        deviation.actual.push(tip);
        if !(self.keeps_axes || self.keeps_angles) {
            return;
        }
        let axis = (axis + turned.cross(axis)).normalize();
        if self.keeps_angles {
            deviation.axis_error.push(math::angle_between(&axis, passage.axis.at(k)));
        }
        if self.keeps_axes {
            deviation.axis.push(axis);
        }
    }
}
