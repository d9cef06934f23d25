//! Contour error: distance of the tip from the desired path, regardless of timing (thesis eqs. 5.1,
//! 5.2).

use crate::path::{Closest, Path};
use nalgebra::Vector3;

/// The point P_c of the path closest to a tip P_a that should be at `target`, the path's point at
/// the arc length `s` [m]. The contour error is epsilon = P_c - P_a (eq. 5.2).
///
/// It is searched near `target`. If the target is at the distance d from the tip, the closest
/// point is no further away, so the two are at most 2 d apart; 3 d allows for the path's bends.
pub fn closest(path: &Path, (s, target): (f64, &Vector3<f64>), tip: &Vector3<f64>) -> Closest {
    let distance = (tip - target).norm();
    path.closest(tip, s, 3.0 * distance + 1e-6)
}

/// Mean and largest length of contour errors.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MeanMax {
    /// Mean over all samples [m].
    pub mean: f64,
    /// Largest [m].
    pub max: f64,
}

impl MeanMax {
    /// Mean and largest length of error vectors [m].
    pub fn of(errors: &[Vector3<f64>]) -> Self {
        let (mut sum, mut max) = (0.0, 0.0_f64);
        for error in errors {
            let norm = error.norm();
            sum += norm;
            max = max.max(norm);
        }
        Self { mean: sum / errors.len().max(1) as f64, max }
    }
}
