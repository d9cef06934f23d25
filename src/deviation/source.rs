//! The actual path under each source of error, alone or together (thesis sections 4.3-4.5, 5.2).

use crate::cutting::along::{self, ChipLoad};
use crate::cutting::{Bending, LinearForce};
use crate::deviation::contour;
use crate::math;
use crate::motion::{Pace, Shaper, Trajectory};
use crate::path::Path;
use crate::robot::{Joints, Robot, compliance, forward};
use nalgebra::Vector3;

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
    /// Angle between the actual and the desired tool axis where the tool is along the path [rad].
    pub axis_error: Vec<f64>,
}

impl Plan {
    /// Where along the path the tool is over time: behind the command if shaping acts.
    pub fn pace(&self, acting: Sources) -> Pace {
        if acting.shaping {
            self.shaper.pace(&self.trajectory.pace, self.trajectory.sample_time)
        } else {
            self.trajectory.pace.clone()
        }
    }
}

/// Sends joint commands through shaper, arm and cut (Figs. 4.7, 5.14, 5.16): actual tip = shaped pose + C F.
///
/// Eq. 5.3 subtracts the displacement; a force pushes the tip its own way, so it is added here.
/// Force and compliance are taken where the shaped command puts the arm. `q` has one row for each sample of the trajectory.
pub fn deviate(plan: &Plan, pace: &Pace, q: &[Joints], acting: Sources) -> Deviation {
    let force = if acting.deflection {
        along::forces(&plan.path, pace, &plan.mean_force, &plan.chip)
    } else {
        vec![Vector3::zeros(); q.len()]
    };
    deviate_under(plan, pace, q, force, acting)
}

/// The same under forces that are known [N], one a sample, base frame; where deflection does not act, nothing gives way to them or to weight.
pub fn deviate_under(
    plan: &Plan,
    pace: &Pace,
    q: &[Joints],
    force: Vec<Vector3<f64>>,
    acting: Sources,
) -> Deviation {
    let q = if acting.shaping { plan.shaper.joints(q, plan.trajectory.sample_time) } else { q.to_vec() };
    let mut deflection = Vec::with_capacity(q.len());
    let mut actual = Vec::with_capacity(q.len());
    let mut axis = Vec::with_capacity(q.len());
    for (q, force) in q.iter().zip(&force) {
        let frames = forward::frames(&plan.robot, q);
        let tcp = frames[5].compose(plan.robot.tool());
        let (mut displacement, mut rotation) = (Vector3::zeros(), Vector3::zeros());
        let shaped: Vector3<f64> = -tcp.rotation.column(2);
        if acting.deflection {
            (displacement, rotation) = compliance::deflection(&plan.robot, q, &frames, &tcp.position, force);
            if let Some(bending) = &plan.bending {
                let (moved, turned) = bending.deflection(&shaped, force);
                displacement += moved;
                rotation += turned;
            }
        }
        deflection.push(displacement);
        actual.push(tcp.position + displacement);
        axis.push((shaped + rotation.cross(&shaped)).normalize());
    }
    let contour_error = contour::contour_errors(&plan.path, pace, &actual);
    let tilt = |(axis, &s): (&Vector3<f64>, &f64)| math::angle_between(axis, &plan.path.axis(s));
    let axis_error = axis.iter().zip(&pace.arc_length).map(tilt).collect();
    Deviation { q, force, deflection, actual, axis, contour_error, axis_error }
}
