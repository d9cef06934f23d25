//! Milling force along the path, in the base frame (thesis eq. 4.11, Fig. 4.6).

use crate::cutting::LinearForce;
use crate::motion::TimingLaw;
use crate::path::Path;
use nalgebra::Vector3;

/// What sets the feed per tooth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ChipLoad {
    /// A constant feed per tooth [m], as in the thesis.
    Fixed(f64),
    /// The local speed divided by the number of teeth that pass per second.
    FromFeed {
        /// Number of flutes.
        flutes: f64,
        /// Spindle speed [1/s], if the program states none.
        spindle: f64,
    },
}

impl ChipLoad {
    /// Feed per tooth [m] at the speed `v` [m/s] and the program's spindle speed [1/s], if it
    /// states one.
    pub fn at(&self, v: f64, programmed: Option<f64>) -> f64 {
        match self {
            ChipLoad::Fixed(c) => *c,
            ChipLoad::FromFeed { flutes, spindle } => v / (flutes * programmed.unwrap_or(*spindle)),
        }
    }
}

/// Mean force on the tool [N] in the base frame, one per sample, where the tool is by `timing`;
/// zero on rapid moves.
///
/// {T} follows the local feed: x = feed across the tool axis, z = tool axis, y = z x x (eq. 4.11).
/// Where the tool moves along its own axis, x is undefined: the last direction is kept (at the
/// start, the first one that follows), and the report warns.
pub fn forces(path: &Path, timing: &TimingLaw, mean: &LinearForce, chip: &ChipLoad) -> Vec<Vector3<f64>> {
    let mut forces = Vec::with_capacity(timing.heading.len());
    each(path, timing, |k, x, axis| {
        let spindle = path.moves()[timing.index[k] as usize].spindle;
        let f = mean.at(chip.at(timing.speed[k], spindle)) * timing.engaged[k];
        forces.push(x * f.x + axis.cross(&x) * f.y + axis * f.z);
    });
    forces
}

/// Calls `at` for every sample with its number and the directions x and z of {T} there, in the base
/// frame.
pub fn each(path: &Path, timing: &TimingLaw, mut at: impl FnMut(usize, Vector3<f64>, Vector3<f64>)) {
    let across = |heading: &Vector3<f64>, axis: &Vector3<f64>| {
        (heading - axis * axis.dot(heading)).try_normalize(1e-6)
    };
    let samples = || timing.heading.iter().enumerate();
    let first = samples().find_map(|(k, heading)| across(heading, &timing.axis(path, k)));
    let mut x = first.unwrap_or_else(|| path.reference(&path.axis(0.0)));
    for (k, heading) in samples() {
        let axis = timing.axis(path, k);
        x = across(heading, &axis).or_else(|| across(&x, &axis)).unwrap_or(x);
        at(k, x, axis);
    }
}
