//! Functions and frames that give the same bits natively and in every browser.
//!
//! The standard library leaves the precision of its transcendental functions to the platform, so
//! all of ours go through the `libm` crate. Only `+ - * /` and `sqrt`, which IEEE 754 fixes, come
//! from the language.

use nalgebra::{Matrix3, Vector3};
pub use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Sine of `x` [rad].
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// Cosine of `x` [rad].
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}

/// Sine and cosine of `x` [rad].
pub fn sin_cos(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

/// Tangent of `x` [rad].
pub fn tan(x: f64) -> f64 {
    libm::tan(x)
}

/// Angle of the point (x, y) from the x axis [rad], in (-pi, pi].
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Arc cosine [rad]; the argument is clamped to [-1, 1], which rounding may exceed slightly.
pub fn acos(x: f64) -> f64 {
    libm::acos(x.clamp(-1.0, 1.0))
}

/// e to the power `x`.
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// Natural logarithm.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// Length of the hypotenuse, without overflow.
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// Decimal logarithm.
pub fn log10(x: f64) -> f64 {
    libm::log10(x)
}

/// `x` to the power `y`.
pub fn pow(x: f64, y: f64) -> f64 {
    libm::pow(x, y)
}

/// The angle equal to `angle` modulo a full turn that is nearest to `near` [rad].
pub fn nearest_turn(angle: f64, near: f64) -> f64 {
    let turns = (angle - near) / TAU;
    // WebAssembly has an instruction for `trunc`; `round` is a function call there.
    angle - TAU * (turns + 0.5_f64.copysign(turns)).trunc()
}

/// An angle [deg] from -180, which is left out, to 180, without the noise of a sum.
pub fn within_half_turn(angle_deg: f64) -> f64 {
    let angle = angle_deg - 360.0 * ((angle_deg - 180.0) / 360.0).ceil();
    (angle * 1e9).round() / 1e9
}

/// An angle as its sine and cosine: what a closed form yields and a rotation needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// Sine.
    pub sin: f64,
    /// Cosine.
    pub cos: f64,
}

impl Turn {
    /// No turn.
    pub const NONE: Self = Self { sin: 0.0, cos: 1.0 };

    /// The turn by an angle [rad].
    pub fn of(angle: f64) -> Self {
        let (sin, cos) = sin_cos(angle);
        Self { sin, cos }
    }

    /// The turn from the direction of one point (x, y) to that of another; zero if a point is the
    /// origin.
    pub fn between(from: (f64, f64), to: (f64, f64)) -> Self {
        let (dot, cross) = (from.0 * to.0 + from.1 * to.1, from.0 * to.1 - from.1 * to.0);
        let size = (dot * dot + cross * cross).sqrt();
        if size > 0.0 { Self { sin: cross / size, cos: dot / size } } else { Self::NONE }
    }

    /// The angle [rad], in (-pi, pi].
    pub fn angle(self) -> f64 {
        atan2(self.sin, self.cos)
    }
}

/// Angle between two directions [rad], in [0, pi]; neither needs unit length.
pub fn angle_between(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    atan2(a.cross(b).norm(), a.dot(b))
}

/// Rotation by `angle` [rad] about the unit vector `axis` (Rodrigues' formula).
pub fn rotation_about(axis: &Vector3<f64>, angle: f64) -> Matrix3<f64> {
    let (s, c) = sin_cos(angle);
    let k = axis.cross_matrix();
    Matrix3::identity() + k * s + k * k * (1.0 - c)
}

/// A unit vector across `axis` (a unit vector): the projection of `preferred`, or of `other` if the
/// two are parallel.
pub fn across(axis: &Vector3<f64>, preferred: &Vector3<f64>, other: &Vector3<f64>) -> Vector3<f64> {
    let projection = preferred - axis * axis.dot(preferred);
    if projection.norm() > 1e-6 * preferred.norm() {
        projection.normalize()
    } else {
        (other - axis * axis.dot(other)).normalize()
    }
}

/// Position and orientation of one frame in another: the homogeneous transformation of eq. 3.3
/// without its last row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// The frame's axes (n, s, a of eq. 3.3) as columns.
    pub rotation: Matrix3<f64>,
    /// The frame's origin [m].
    pub position: Vector3<f64>,
}

impl Pose {
    /// The identity: the frame itself.
    pub fn identity() -> Self {
        Self { rotation: Matrix3::identity(), position: Vector3::zeros() }
    }

    /// A frame at `position` [m], turned by roll, pitch and yaw [rad] about the fixed x, y and z
    /// axes in this order.
    pub fn from_xyz_rpy(position: Vector3<f64>, rpy: [f64; 3]) -> Self {
        let rotation = rotation_about(&Vector3::z(), rpy[2])
            * rotation_about(&Vector3::y(), rpy[1])
            * rotation_about(&Vector3::x(), rpy[0]);
        Self { rotation, position }
    }

    /// This transformation after `inner`: from the inner frame to the outer one.
    pub fn compose(&self, inner: &Pose) -> Pose {
        Pose { rotation: self.rotation * inner.rotation, position: self.point(&inner.position) }
    }

    /// The inverse transformation.
    pub fn inverse(&self) -> Pose {
        let rotation = self.rotation.transpose();
        Pose { rotation, position: -(rotation * self.position) }
    }

    /// A point [m] given in this frame, in the outer frame.
    pub fn point(&self, p: &Vector3<f64>) -> Vector3<f64> {
        self.rotation * p + self.position
    }

    /// A direction given in this frame, in the outer frame.
    pub fn direction(&self, v: &Vector3<f64>) -> Vector3<f64> {
        self.rotation * v
    }
}

/// A few items in rising order of a key; equal ones stay as they come. For lists so short that a sort would only
/// make the core heavier.
pub fn rising<T>(items: impl IntoIterator<Item = T>, key: impl Fn(&T) -> f64) -> Vec<T> {
    let mut sorted: Vec<T> = Vec::new();
    for item in items {
        let at = sorted.partition_point(|other| key(other) <= key(&item));
        sorted.insert(at, item);
    }
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_turn_stays_within_half_a_turn() {
        for (angle, near, expected) in [(0.1, 6.2, 0.1 + TAU), (-3.0, 3.0, -3.0 + TAU), (1.0, 0.5, 1.0)] {
            assert!((nearest_turn(angle, near) - expected).abs() < 1e-15, "{angle} near {near}");
        }
    }

    #[test]
    fn degrees_stay_within_half_a_turn() {
        for (angle, expected) in [
            (180.0, 180.0),
            (-180.0, 180.0),
            (190.0, -170.0),
            (0.0, 0.0),
            (-540.0, 180.0),
            (360.1 + 0.2, 0.3),
        ] {
            assert_eq!(within_half_turn(angle), expected, "{angle}");
        }
    }

    #[test]
    fn a_turn_is_its_angle() {
        for (from, to) in [(0.3, 2.0), (-3.0, 3.0), (1.0, 1.0), (2.0, -1.5)] {
            let at = |angle: f64, size: f64| (size * cos(angle), size * sin(angle));
            let turn = Turn::between(at(from, 1e-3), at(to, 2e3));
            assert!((turn.angle() - nearest_turn(to - from, 0.0)).abs() < 1e-15, "{from} to {to}");
            assert!((turn.sin - Turn::of(to - from).sin).abs() < 1e-15);
        }
        assert_eq!(Turn::between((0.0, 0.0), (1.0, 2.0)).angle(), 0.0);
    }

    #[test]
    fn roll_pitch_yaw_turn_about_fixed_axes() {
        // Roll 90 deg about x, then yaw 90 deg about z: y goes to z and stays there.
        let pose = Pose::from_xyz_rpy(Vector3::zeros(), [FRAC_PI_2, 0.0, FRAC_PI_2]);
        assert!((pose.direction(&Vector3::y()) - Vector3::z()).norm() < 1e-15);
        assert!((pose.direction(&Vector3::x()) - Vector3::y()).norm() < 1e-15);
    }

    #[test]
    fn a_pose_and_its_inverse_cancel() {
        let pose = Pose::from_xyz_rpy(Vector3::new(0.1, -0.2, 0.3), [0.4, -0.5, 0.6]);
        let round = pose.compose(&pose.inverse());
        assert!((round.rotation - Matrix3::identity()).norm() < 1e-15);
        assert!(round.position.norm() < 1e-15);
    }
}
