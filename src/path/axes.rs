//! Tool axes along a path, one a sample.

use crate::path::Path;
use nalgebra::Vector3;

/// Unit vectors from the tool's tip to the spindle, one a sample; kept once where the path has one axis all along.
#[derive(Debug, Clone, PartialEq)]
pub enum Axes {
    /// The same at every sample.
    One(Vector3<f64>),
    /// One for each sample.
    Each(Vec<Vector3<f64>>),
}

impl Axes {
    /// The path's axes at these arc lengths [m], each in the move `index`.
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
