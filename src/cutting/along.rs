//! Milling force along the path, in the base frame (thesis eq. 4.11, Fig. 4.6).

use crate::cutting::MeanForce;
use crate::motion::Pace;
use crate::path::Path;
use nalgebra::Vector3;

/// What sets the chip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ChipLoad {
    /// The same feed per tooth all along [m], as the thesis has it.
    Fixed(f64),
    /// The local speed divided by the teeth that pass in a second (flutes times revolutions) [1/s].
    FromFeed(f64),
}

impl ChipLoad {
    /// Feed per tooth [m] at the speed `v` [m/s].
    pub fn at(&self, v: f64) -> f64 {
        match self {
            ChipLoad::Fixed(c) => *c,
            ChipLoad::FromFeed(teeth_per_second) => v / teeth_per_second,
        }
    }
}

/// Mean force on the tool [N] in the base frame, one a sample, where `pace` says the tool is.
///
/// {T} is turned with the local feed: x = feed across the tool axis, z = tool axis, y = z x x (eq. 4.11). Where the tool moves
/// along its own axis x is undefined; the last direction holds (at the start: the first one that follows), and the report warns.
pub fn forces(path: &Path, pace: &Pace, mean: &MeanForce, chip: &ChipLoad) -> Vec<Vector3<f64>> {
    let axis = path.tool_axis();
    let across = |heading: &Vector3<f64>| (heading - axis * axis.dot(heading)).try_normalize(1e-6);
    let first = pace.heading.iter().find_map(across);
    let mut x = first.unwrap_or_else(|| path.tool_orientation().column(0).into_owned());
    let mut forces = Vec::with_capacity(pace.heading.len());
    for (heading, &speed) in pace.heading.iter().zip(&pace.speed) {
        x = across(heading).unwrap_or(x);
        let f = mean.at(chip.at(speed));
        forces.push(x * f.x + axis.cross(&x) * f.y + axis * f.z);
    }
    forces
}
