//! Deviation from the path: deflection by cutting forces, distortion by the input shaper, and the
//! contour error of both (thesis sections 4.3-4.5, 5.2).

pub mod contour;
pub mod missed;
pub mod reference;
pub mod simulate;
pub mod wall;

pub use crate::job::{Source, Sources};
pub use reference::Reference;
pub use simulate::{ErrorsBySource, simulate, simulate_by_source};

use crate::math;
use crate::plan::Plan;
use contour::MeanMax;
use nalgebra::Vector3;

/// The result of joint commands.
#[derive(Debug, Clone, PartialEq)]
pub struct Deviation {
    /// Actual tip in the base frame [m].
    pub actual: Vec<Vector3<f64>>,
    /// Actual tool axis, from tip to spindle, in the base frame; empty if the path keeps a constant
    /// axis.
    pub axis: Vec<Vector3<f64>>,
    /// Contour error, from the actual tip to the closest point of the desired path [m].
    pub contour_error: Vec<Vector3<f64>>,
    /// Mean and largest length of the contour error.
    pub statistics: MeanMax,
    /// Angle between the actual tool axis and the desired one at the tool's place on the path
    /// [rad]; empty unless every source acts.
    pub axis_error: Vec<f64>,
    /// Largest error at the top of the cut, see [`wall`]; 0 unless every source acts.
    pub wall: Largest,
}

/// The largest value of a length along the path, and where.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Largest {
    /// The value [m].
    pub max: f64,
    /// Arc length of its place on the path [m].
    pub at: f64,
}

impl Largest {
    /// Takes a value [m] at the arc length `s` [m] if it is larger.
    fn raise(&mut self, value: f64, s: f64) {
        if value > self.max {
            *self = Self { max: value, at: s };
        }
    }
}

/// A tip [m] with its tool axis, or their displacement [m] and rotation [rad] by deflection.
type TipAndAxis = (Vector3<f64>, Vector3<f64>);

/// Collects a [`Deviation`] sample by sample.
struct DeviationBuilder<'a> {
    plan: &'a Plan,
    reference: &'a Reference<'a>,
    keeps_axes: bool,
    keeps_angles: bool,
    deviation: Deviation,
}

impl<'a> DeviationBuilder<'a> {
    fn new(plan: &'a Plan, reference: &'a Reference<'a>, acting: Sources) -> Self {
        let samples = reference.arc_length.len();
        let (keeps_axes, keeps_angles) = (plan.path.is_multi_axis(), acting == Sources::ALL);
        let deviation = Deviation {
            actual: Vec::with_capacity(samples),
            axis: Vec::with_capacity(if keeps_axes { samples } else { 0 }),
            contour_error: Vec::with_capacity(samples),
            statistics: MeanMax::default(),
            axis_error: Vec::with_capacity(if keeps_angles { samples } else { 0 }),
            wall: Largest::default(),
        };
        Self { plan, reference, keeps_axes, keeps_angles, deviation }
    }

    /// Adds the sample `k`: the shaped pose, displaced [m] and rotated [rad] by deflection.
    fn push(&mut self, k: usize, (tip, axis): &TipAndAxis, (moved, turned): &TipAndAxis) {
        let Self { plan, reference, deviation, .. } = self;
        let tip = tip + moved;
        let place = (reference.arc_length[k], &reference.target[k]);
        let closest = contour::closest(&plan.path, place, &tip);
        deviation.contour_error.push(closest.point - tip);
        deviation.actual.push(tip);
        if !(self.keeps_axes || self.keeps_angles) {
            return;
        }
        let axis = (axis + turned.cross(axis)).normalize();
        if self.keeps_angles {
            deviation.axis_error.push(math::angle_between(&axis, reference.axis.at(k)));
            let top = plan.setup.cut.axial_depth;
            if let Some(error) = wall::error_at_height(&plan.path, &closest, (&tip, &axis), top) {
                deviation.wall.raise(error.norm(), closest.s_on(&plan.path));
            }
        }
        if self.keeps_axes {
            deviation.axis.push(axis);
        }
    }

    fn finish(mut self) -> Deviation {
        self.deviation.statistics = MeanMax::of(&self.deviation.contour_error);
        self.deviation
    }
}
