//! Deviation from the path: deflection by cutting forces, distortion by the input shaper, and the
//! contour error of both (thesis sections 4.3-4.5, 5.2).

pub mod contour;
pub mod coupling;
pub mod missed;
pub mod near;
pub mod reference;
pub mod simulate;
pub mod wall;

use crate::job::CompensateAt;
pub use crate::job::{Source, Sources};
pub use reference::Reference;
pub use simulate::{ErrorsBySource, simulate, simulate_by_source};

use crate::math;
use crate::plan::Plan;
use contour::{MeanMax, Tally};
use coupling::SettledCut;
use nalgebra::Vector3;

/// The result of joint commands.
#[derive(Debug, Clone, PartialEq)]
pub struct Deviation {
    /// Actual tip in the base frame [m].
    pub actual: Vec<Vector3<f64>>,
    /// Actual place of the middle of the cut in the base frame, moved down the desired tool axis by
    /// half the axial depth onto the path [m]; empty unless the job compensates there.
    pub middle: Vec<Vector3<f64>>,
    /// Displacement of the tip that the planned force would add [m]; empty unless the force follows the
    /// deflection.
    pub spared: Vec<Vector3<f64>>,
    /// Actual tool axis, from tip to spindle, in the base frame; empty unless it is corrected: the
    /// path turns it, or the job compensates it.
    pub axis: Vec<Vector3<f64>>,
    /// Contour error, from the actual tip to the closest point of the desired path [m].
    pub contour_error: Vec<Vector3<f64>>,
    /// Mean and largest length of the contour error.
    pub statistics: MeanMax,
    /// Mean and largest error by which the compensation judges: the contour error of the tip or of
    /// the middle of the cut, or if the axis is compensated that of the tip or the top of the cut,
    /// whichever is larger.
    pub judged: MeanMax,
    /// Angle between the actual tool axis and the desired one at the tool's place on the path
    /// [rad]; empty unless every source acts.
    pub axis_error: Vec<f64>,
    /// Largest error at the top of the cut, see [`wall`]; 0 unless every source acts.
    pub wall: Largest,
}

impl Deviation {
    /// What the compensation brings onto the path [m], at the sample `k`: the tip, or the middle of the
    /// cut, as it would be under the planned force. Once that is in its place, so is the actual one.
    pub fn brought(&self, k: usize) -> Vector3<f64> {
        let actual = if self.middle.is_empty() { self.actual[k] } else { self.middle[k] };
        self.spared.get(k).map_or(actual, |spared| actual + spared)
    }
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
    judged: Tally,
    deviation: Deviation,
}

impl<'a> DeviationBuilder<'a> {
    fn new(plan: &'a Plan, reference: &'a Reference<'a>, acting: Sources) -> Self {
        let samples = reference.arc_length.len();
        let at = plan.setup.compensate_at;
        let keeps_axes = plan.path.is_multi_axis() || at == CompensateAt::Axis;
        let keeps_angles = acting == Sources::ALL;
        let room = |kept: bool| if kept { samples } else { 0 };
        let deviation = Deviation {
            actual: Vec::with_capacity(samples),
            middle: Vec::with_capacity(room(at == CompensateAt::Middle)),
            spared: Vec::with_capacity(reference.stiffness.len()),
            axis: Vec::with_capacity(room(keeps_axes)),
            contour_error: Vec::with_capacity(samples),
            statistics: MeanMax::default(),
            judged: MeanMax::default(),
            axis_error: Vec::with_capacity(room(keeps_angles)),
            wall: Largest::default(),
        };
        Self { plan, reference, keeps_axes, keeps_angles, judged: Tally::default(), deviation }
    }

    /// Adds the sample `k`: the shaped pose, displaced by the deflection of a cut.
    fn push_cut(&mut self, k: usize, pose: &TipAndAxis, cut: &SettledCut) {
        self.push(k, pose, &cut.deflected);
        if !self.reference.stiffness.is_empty() {
            self.deviation.spared.push(cut.spared);
        }
    }

    /// Adds the sample `k`: the shaped pose, displaced [m] and rotated [rad] by deflection.
    fn push(&mut self, k: usize, (tip, axis): &TipAndAxis, (moved, turned): &TipAndAxis) {
        let Self { plan, reference, deviation, .. } = self;
        let at = plan.setup.compensate_at;
        let tip = tip + moved;
        let place = (reference.arc_length[k], &reference.target[k]);
        let closest = contour::closest(&plan.path, place, &tip);
        let error = closest.point - tip;
        deviation.contour_error.push(error);
        deviation.actual.push(tip);
        if !(self.keeps_axes || self.keeps_angles || at == CompensateAt::Middle) {
            self.judged.add(error.norm());
            return;
        }
        let axis = (axis + turned.cross(axis)).normalize();
        let depth = plan.setup.cut.axial_depth;
        let top = wall::error_at_height(&plan.path, &closest, (&tip, &axis), |place| {
            plan.setup.axial_depth_at(place)
        });
        let top = top.map_or(0.0, |error| error.norm());
        self.judged.add(match at {
            CompensateAt::Tip => error.norm(),
            CompensateAt::Middle => {
                let middle = tip + (axis - reference.axis.at(k)) * (depth / 2.0);
                deviation.middle.push(middle);
                (contour::closest(&plan.path, place, &middle).point - middle).norm()
            }
            CompensateAt::Axis => error.norm().max(top),
        });
        if self.keeps_angles {
            deviation.axis_error.push(math::angle_between(&axis, reference.axis.at(k)));
            deviation.wall.raise(top, closest.s_on(&plan.path));
        }
        if self.keeps_axes {
            deviation.axis.push(axis);
        }
    }

    fn finish(mut self) -> Deviation {
        self.deviation.statistics = MeanMax::of(&self.deviation.contour_error);
        self.deviation.judged = self.judged.mean_max();
        self.deviation
    }
}
