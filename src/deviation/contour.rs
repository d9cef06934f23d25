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
        let mut tally = Tally::default();
        errors.iter().for_each(|error| tally.add(error.norm()));
        tally.mean_max()
    }
}

/// Errors [m] as they come, for their mean and maximum.
#[derive(Debug, Clone, Copy, Default)]
pub struct Tally {
    count: usize,
    sum: f64,
    max: f64,
}

impl Tally {
    /// Adds one.
    pub fn add(&mut self, error: f64) {
        self.count += 1;
        self.sum += error;
        self.max = self.max.max(error);
    }

    /// Mean and largest.
    pub fn mean_max(&self) -> MeanMax {
        MeanMax { mean: self.sum / self.count.max(1) as f64, max: self.max }
    }
}
