//! Tool axes along a path, one per sample, and their way along a move.

use crate::math::{self, PI};
use crate::path::Path;
use nalgebra::Vector3;

/// The way of the tool axis from one direction to another: an arc of a great circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisArc {
    from: Vector3<f64>,
    /// Direction in which it leaves, across `from`.
    side: Vector3<f64>,
    /// Its length [rad], in [0, pi].
    angle: f64,
}

impl AxisArc {
    /// The shorter way. An axis that is reversed goes by the x axis of the frame, or by its y axis
    /// if it lies on that one.
    pub fn between(from: &Vector3<f64>, to: &Vector3<f64>) -> Self {
        Self::by(from, to, &[Vector3::x(), Vector3::y()])
    }

    /// The shorter way; an axis that is reversed goes by the first of two directions at right
    /// angles that it does not lie on.
    pub(super) fn by(from: &Vector3<f64>, to: &Vector3<f64>, ways: &[Vector3<f64>; 2]) -> Self {
        let [first, second] = ways;
        let way = if from.dot(first).abs() < 0.999 { first } else { second };
        Self { from: *from, side: math::across(from, to, way), angle: math::angle_between(from, to) }
    }

    /// Its length [rad], in [0, pi].
    pub fn angle(&self) -> f64 {
        self.angle
    }

    /// The axis after a turn by `angle` [rad].
    pub fn at(&self, angle: f64) -> Vector3<f64> {
        let (sin, cos) = math::sin_cos(angle);
        self.from * cos + self.side * sin
    }

    /// The least angle between the axis and either way along a direction [rad], in [0, pi/2].
    pub fn clearance(&self, direction: &Vector3<f64>) -> f64 {
        let direction = direction.normalize();
        let (ahead, aside) = (self.from.dot(&direction), self.side.dot(&direction));
        // The great circle comes nearest to the direction's line twice, half a turn apart.
        let nearest = math::atan2(aside, ahead);
        let nearest = if nearest < 0.0 { nearest + PI } else { nearest };
        let passes = nearest <= self.angle || nearest == PI;
        let ends = ahead.abs().max(self.at(self.angle).dot(&direction).abs());
        math::acos(if passes { math::hypot(ahead, aside) } else { ends })
    }

    /// A vector across the axis, carried along a turn by `angle` [rad] without twist: it keeps its
    /// angle with the great circle.
    pub fn carried(&self, vector: &Vector3<f64>, angle: f64) -> Vector3<f64> {
        let (sin, cos) = math::sin_cos(angle);
        let normal = self.from.cross(&self.side);
        normal * normal.dot(vector) + (self.side * cos - self.from * sin) * self.side.dot(vector)
    }

    /// A vector across the axis, carried all the way.
    pub fn carried_to_its_end(&self, vector: &Vector3<f64>) -> Vector3<f64> {
        self.carried(vector, self.angle)
    }
}

/// Unit vectors from the tool tip to the spindle, one per sample. A constant axis is stored once.
#[derive(Debug, Clone, PartialEq)]
pub enum Axes {
    /// One axis for every sample.
    One(Vector3<f64>),
    /// One axis per sample.
    Each(Vec<Vector3<f64>>),
}

impl Axes {
    /// The path's axes at the arc lengths `arc_length` [m], each in the move `index`.
    pub fn along(path: &Path, arc_length: &[f64], index: &[u32]) -> Self {
        let first = path.moves()[0].axis_from;
        if path.moves().iter().all(|step| step.axis_from == first && step.axis_to == first) {
            Self::One(first)
        } else {
            let places = index.iter().zip(arc_length).map(|(&index, &s)| path.within(index as usize, s));
            Self::Each(places.map(|place| path.axis_at(place)).collect())
        }
    }

    /// The axis at the sample `k`.
    pub fn at(&self, k: usize) -> &Vector3<f64> {
        match self {
            Self::One(axis) => axis,
            Self::Each(axes) => &axes[k],
        }
    }
}
