//! Where the roll about the tool axis counts from: one reference for the whole path.
//!
//! The TCP's x axis follows a direction of the workpiece, projected across the tool axis. Near that
//! direction a small turn of the axis turns the projection far, and on its way through by half a
//! turn at once. So the direction is one that the axis stays clear of along the whole path.

use crate::math::{self, Pose, Turn};
use crate::path::Move;
use crate::path::axes::AxisArc;
use crate::units::DEG;
use nalgebra::{Matrix3, Vector3};
use std::sync::Arc;

/// Least angle between the tool axis and either way along a direction that is chosen [rad].
pub const CLEAR: f64 = 15.0 * DEG;

/// What the TCP's x axis follows along a path.
#[derive(Debug, Clone, PartialEq)]
pub enum RollReference {
    /// The first axis of the workpiece that keeps clear of the tool axis: 0 for x, 1 for y, 2 for z.
    Chosen(usize, RollZero),
    /// A direction that the job sets.
    Set(RollZero),
    /// None keeps clear: the TCP's x axis is carried along without twist. One x axis for the start
    /// of each move.
    Carried(Arc<[Vector3<f64>]>),
}

impl RollReference {
    /// The reference for moves in the workpiece frame.
    pub(super) fn chosen(moves: &[Move]) -> Self {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        if let Some(i) = axes.iter().position(|axis| clearance(moves, axis).0 >= CLEAR) {
            return Self::Chosen(i, RollZero::along(&axes[i]));
        }
        let first = moves[0].axis_from;
        // No tool axis is near two of the three.
        let start = axes.iter().find(|axis| axis.dot(&first).abs() < math::cos(CLEAR)).unwrap_or(&axes[0]);
        Self::carried(moves, RollZero::along(start).x_axis(&first), &[axes[0], axes[1]])
    }

    /// The x axis `x` at the start, carried along moves; an axis that is reversed goes by one of
    /// `ways`.
    pub(super) fn carried(moves: &[Move], mut x: Vector3<f64>, ways: &[Vector3<f64>; 2]) -> Self {
        let mut axis = moves[0].axis_from;
        let at_start = |step: &Move| {
            x = AxisArc::by(&axis, &step.axis_from, ways).carried_to_its_end(&x);
            axis = step.axis_to;
            let end = AxisArc::by(&step.axis_from, &step.axis_to, ways).carried_to_its_end(&x);
            std::mem::replace(&mut x, end)
        };
        Self::Carried(moves.iter().map(at_start).collect())
    }

    /// The reference, expressed in the frame in which `frame` is given.
    pub(super) fn placed(&self, frame: &Pose) -> Self {
        match self {
            Self::Chosen(i, zero) => Self::Chosen(*i, zero.placed(frame)),
            Self::Set(zero) => Self::Set(zero.placed(frame)),
            Self::Carried(starts) => Self::Carried(starts.iter().map(|x| frame.direction(x)).collect()),
        }
    }
}

/// Where the roll is zero, for any tool axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollZero {
    /// Direction that is projected across the tool axis.
    direction: Vector3<f64>,
    /// Turn about the tool axis from the projection to the TCP's x axis.
    turn: Turn,
}

impl RollZero {
    /// Follows a direction in the workpiece frame. The turn is such that an upright tool has its x
    /// axis on workpiece +X, whatever the direction; there is none for a vertical one.
    pub fn along(direction: &Vector3<f64>) -> Self {
        let level = math::hypot(direction.x, direction.y);
        let turn = match level > 0.0 {
            true => Turn { sin: -direction.y / level, cos: direction.x / level },
            false => Turn::NONE,
        };
        Self { direction: direction.normalize(), turn }
    }

    /// Follows an x axis as it is.
    pub(super) fn of_x_axis(x: &Vector3<f64>) -> Self {
        Self { direction: *x, turn: Turn::NONE }
    }

    /// The TCP's x axis at zero roll, for a tool axis.
    pub fn x_axis(&self, axis: &Vector3<f64>) -> Vector3<f64> {
        // Only a direction along the axis itself needs another; paths keep clear of it.
        let other = Vector3::ith(axis.iamin(), 1.0);
        turned(math::across(&-axis, &self.direction, &other), axis, self.turn)
    }

    /// Orientation of the TCP for a tool axis: z = approach (against the axis), x = that of zero
    /// roll, rotated by `roll` [rad], counter-clockwise seen from the spindle.
    pub fn orientation(&self, axis: &Vector3<f64>, roll: f64) -> Matrix3<f64> {
        let z = -axis;
        let mut x = self.x_axis(axis);
        if roll != 0.0 {
            x = turned(x, axis, Turn::of(roll));
        }
        Matrix3::from_columns(&[x, z.cross(&x), z])
    }

    fn placed(&self, frame: &Pose) -> Self {
        Self { direction: frame.direction(&self.direction), ..*self }
    }
}

/// A vector across `axis`, turned about it.
fn turned(x: Vector3<f64>, axis: &Vector3<f64>, turn: Turn) -> Vector3<f64> {
    if turn == Turn::NONE { x } else { x * turn.cos + axis.cross(&x) * turn.sin }
}

/// The least angle between the tool axis of moves and either way along a direction [rad], in [0,
/// pi/2], and the index of the move where it is met.
pub(super) fn clearance(moves: &[Move], direction: &Vector3<f64>) -> (f64, usize) {
    let mut least = (f64::INFINITY, 0);
    let mut last = None;
    for (index, step) in moves.iter().enumerate() {
        // Most programs keep one axis over many moves.
        let axes = (step.axis_from, step.axis_to);
        if last.replace(axes) == Some(axes) {
            continue;
        }
        let angle = AxisArc::between(&step.axis_from, &step.axis_to).clearance(direction);
        if angle < least.0 {
            least = (angle, index);
        }
    }
    least
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_upright_tool_keeps_its_roll_with_every_direction() {
        let up = Vector3::z();
        for direction in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-2.0, 0.0, 0.0], [1.0, -3.0, 2.0]] {
            let zero = RollZero::along(&Vector3::from(direction));
            assert!((zero.x_axis(&up) - Vector3::x()).norm() < 1e-15, "{direction:?}");
        }
        // To the bit where it is +X or +Y, so that the choice changes no number of an upright job.
        for direction in [Vector3::x(), Vector3::y()] {
            assert_eq!(
                RollZero::along(&direction).orientation(&up, 0.3),
                RollZero::along(&Vector3::x()).orientation(&up, 0.3)
            );
        }
        // A vertical one is for tools that lie: their x axis is up.
        assert_eq!(RollZero::along(&up).x_axis(&Vector3::x()), up);
    }

    #[test]
    fn the_y_axis_of_the_tcp_lies_against_a_reference_y() {
        let axis = Vector3::new(-0.8, 0.36, 0.48);
        let across = (Vector3::y() - axis * axis.y).normalize();
        let orientation = RollZero::along(&Vector3::y()).orientation(&axis, 0.0);
        assert!((orientation.column(1) + across).norm() < 1e-15);
        assert!((orientation.determinant() - 1.0).abs() < 1e-15);
    }
}
