//! The distance from the path where a single move is all there is of it nearby: known without a
//! search.

use crate::deviation::contour;
use crate::path::{Path, Segment};
use nalgebra::Vector3;

/// The move around a point of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearMove {
    /// Arc length of the point [m].
    s: f64,
    /// The point [m].
    target: Vector3<f64>,
    /// Length of the move to its nearer end [m].
    room: f64,
    shape: NearShape,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum NearShape {
    Line { along: Vector3<f64> },
    Circle { center: Vector3<f64>, normal: Vector3<f64>, radius: f64 },
    Helix,
}

impl NearMove {
    /// The move with the point `target` [m] at the arc length `within` [m] from its start; `s` [m] is
    /// that from the start of the path.
    pub fn new(segment: &Segment, within: f64, (s, target): (f64, Vector3<f64>)) -> Self {
        let shape = match segment {
            Segment::Line { .. } => NearShape::Line { along: segment.tangent(within) },
            Segment::Arc { center, u, v, radius, rise: 0.0, .. } => {
                NearShape::Circle { center: *center, normal: u.cross(v), radius: *radius }
            }
            Segment::Arc { .. } => NearShape::Helix,
        };
        Self { s, target, room: within.min(segment.length() - within), shape }
    }

    /// Length of the contour error of a tip [m] that should be at the point.
    ///
    /// If the point is at the distance d from the tip, the closest point is at most 2 d from it, and
    /// no more than pi d along an arc.
    pub fn error(&self, path: &Path, tip: &Vector3<f64>) -> f64 {
        let offset = tip - self.target;
        if self.room > 4.0 * offset.norm() {
            match self.shape {
                NearShape::Line { along } => return (offset - along * along.dot(&offset)).norm(),
                NearShape::Circle { center, normal, radius } => {
                    let offset = tip - center;
                    let height = normal.dot(&offset);
                    let across = (offset - normal * height).norm() - radius;
                    return (height * height + across * across).sqrt();
                }
                NearShape::Helix => {}
            }
        }
        (contour::closest(path, (self.s, &self.target), tip).point - tip).norm()
    }
}
