//! A joint's spring: rotation under a torque, either linear or as a table with lost motion and
//! hardening.

use crate::error::Error;

/// Rotation against torque, the same in both directions. It is linear from zero to the first point
/// and between points; beyond them the last piece is extrapolated.
#[derive(Debug, Clone, PartialEq)]
pub struct Spring {
    /// Torque [N m] and rotation [rad]. Torques are positive and rise; rotations do not fall.
    points: Vec<(f64, f64)>,
}

impl Spring {
    /// The spring of eq. 3.42: rotation = compliance [rad/(N m)] times torque.
    pub fn linear(compliance: f64) -> Self {
        Self { points: vec![(1.0, compliance)] }
    }

    /// A spring through points of torque [N m] and rotation [rad]. Backlash is a first point at the
    /// small torque that takes it up; hardening is a last piece that is steeper in torque.
    ///
    /// # Errors
    /// [`Error::Invalid`] with `field` and the point if there are no points, if torques do not rise
    /// from above 0, or if a rotation falls.
    pub fn through(field: &str, points: Vec<(f64, f64)>) -> Result<Self, Error> {
        if points.is_empty() {
            return Err(Error::invalid(field, "no point", "at least one torque with its angle"));
        }
        let mut last = (0.0, 0.0);
        for &(torque, turn) in &points {
            if !(torque.is_finite() && torque > last.0) {
                return Err(Error::invalid(
                    field,
                    format!("torque {torque} N m after {} N m", last.0),
                    "the torques of a joint must rise from row to row, starting above 0",
                ));
            }
            if !(turn.is_finite() && turn >= last.1) {
                return Err(Error::invalid(
                    field,
                    format!("an angle of {turn} rad after {} rad", last.1),
                    "the angle must not fall as the torque rises",
                ));
            }
            last = (torque, turn);
        }
        Ok(Self { points })
    }

    /// The spring that turns `factor` times as far.
    pub fn softened(mut self, factor: f64) -> Self {
        self.points.iter_mut().for_each(|(_, turn)| *turn *= factor);
        self
    }

    /// Rotation of the joint [rad] under a torque [N m].
    pub fn turn(&self, torque: f64) -> f64 {
        let load = torque.abs();
        let behind = self.points.partition_point(|point| point.0 < load).min(self.points.len() - 1);
        let (to, from) =
            (self.points[behind], if behind == 0 { (0.0, 0.0) } else { self.points[behind - 1] });
        let turn = from.1 + (to.1 - from.1) * ((load - from.0) / (to.0 - from.0));
        turn.copysign(torque)
    }
}
