//! The part as a box, the room that the robot's base takes, and whether one is in the other.

use crate::math::{self, Pose, TAU};
use crate::setup::{Setup, bounds_of_cuts};
use crate::units::MM;
use nalgebra::Vector3;

/// Least radius of the base [m]: that of a small arm whose second axis meets the first.
const LEAST_RADIUS: f64 = 100.0 * MM;
/// Directions in which a box is compared with the base; between two of them it is judged as if the
/// base were 0.5 % wider.
const DIRECTIONS: usize = 32;
/// A base turned no further than this stands on a floor: cosine of its tilt.
const UPRIGHT: f64 = 0.999;

/// A box along the axes of the workpiece frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartBox {
    /// Smallest coordinates in the workpiece frame [m].
    pub low: Vector3<f64>,
    /// Largest coordinates in the workpiece frame [m].
    pub high: Vector3<f64>,
}

impl PartBox {
    /// The box of a job's stock; without one that is cut, of the tool's tip on the moves that cut.
    pub fn of(setup: &Setup) -> Self {
        if let Some(blank) = &setup.blank {
            let [low, high] = blank.solid.outline.bounds();
            return Self { low: low.push(blank.solid.bottom), high: high.push(blank.solid.top) };
        }
        let path = setup.path.placed(&setup.workpiece.inverse());
        let (low, high) = bounds_of_cuts(&path).unwrap_or_else(|| (path.point(0.0), path.point(0.0)));
        Self { low, high }
    }

    /// Its corners [m], from the frame's origin; x changes fastest, z slowest.
    pub fn corners(&self) -> [Vector3<f64>; 8] {
        std::array::from_fn(|k| {
            let side = |axis: usize| if k >> axis & 1 == 0 { self.low[axis] } else { self.high[axis] };
            Vector3::new(side(0), side(1), side(2))
        })
    }
}

/// The room that a robot's base takes, in a coarse form that every robot has: a cylinder about joint
/// 1's axis, as wide as axis 2 is off it, from the ground up to axis 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RobotBase {
    /// The base frame in the cell.
    pub frame: Pose,
    /// Radius [m].
    pub radius: f64,
    /// Height of axis 2 above the base frame's origin [m].
    pub height: f64,
    /// Height of the floor in the cell [m]: that of the base, or of the cell's zero if the base stands
    /// above it, as on a pedestal. `None` if the robot does not stand upright.
    pub floor: Option<f64>,
}

impl RobotBase {
    /// The base of a job's robot.
    pub fn of(setup: &Setup) -> Self {
        let links = setup.robot.links();
        let frame = setup.base;
        Self {
            frame,
            radius: links[1].a.abs().max(LEAST_RADIUS),
            height: links[0].d,
            floor: (frame.rotation[(2, 2)] > UPRIGHT).then(|| frame.position.z.min(0.0)),
        }
    }

    /// Whether a convex body with these corners in the cell [m] is in the base.
    pub fn is_in(&self, corners: &[Vector3<f64>; 8]) -> bool {
        let to_base = self.frame.inverse();
        let corners = corners.map(|corner| to_base.point(&corner));
        let beyond = |k: usize| {
            let (sine, cosine) = math::sin_cos(TAU * k as f64 / DIRECTIONS as f64);
            corners.iter().all(|corner| corner.x * cosine + corner.y * sine > self.radius)
        };
        corners.iter().any(|corner| corner.z < self.height) && !(0..DIRECTIONS).any(beyond)
    }
}
