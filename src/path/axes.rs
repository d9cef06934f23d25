//! Tool axes along a path, one per sample.

use crate::path::Path;
use nalgebra::Vector3;

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
