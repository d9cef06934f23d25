//! Milling force along the path, in the base frame (thesis eq. 4.11, Fig. 4.6).

use crate::cutting::{LinearForce, Loading, MeanForces};
use crate::motion::TimingLaw;
use crate::path::Path;
use nalgebra::Vector3;

/// Mean force on the tool [N] in the base frame, one per sample, where the tool is by `timing`;
/// zero on rapid moves. Its size is that of the [load](Loading) there.
///
/// {T} follows the local feed: x = feed across the tool axis, z = tool axis, y = z x x (eq. 4.11).
/// Where the tool moves along its own axis, x is undefined: the last direction is kept (at the
/// start, the first one that follows), and the report warns.
pub fn forces(path: &Path, timing: &TimingLaw, mean: &MeanForces, loading: &Loading) -> Vec<Vector3<f64>> {
    let mut forces = Vec::with_capacity(timing.heading.len());
    let loads = loading.along(path);
    each(path, timing, |k, x, axis| {
        let f = mean_at(mean, path, timing, k).under(&loads.at(timing, k));
        forces.push(in_base(&f, &x, &axis));
    });
    forces
}

/// As [`forces`], split into `parts` that add up to the mean force, at the samples `at` only, which
/// rise.
pub fn parts<const N: usize>(
    path: &Path,
    timing: &TimingLaw,
    parts: &[MeanForces; N],
    loading: &Loading,
    at: &[usize],
) -> Vec<[Vector3<f64>; N]> {
    let mut forces = Vec::with_capacity(at.len());
    let loads = loading.along(path);
    each(path, timing, |k, x, axis| {
        if at.get(forces.len()) == Some(&k) {
            let load = loads.at(timing, k);
            let part = |part: &MeanForces| in_base(&mean_at(part, path, timing, k).under(&load), &x, &axis);
            forces.push(parts.each_ref().map(part));
        }
    });
    forces
}

/// The mean force where the tool is at the sample `k`.
pub fn mean_at(mean: &MeanForces, path: &Path, timing: &TimingLaw, k: usize) -> LinearForce {
    let index = timing.index[k] as usize;
    mean.at(index, timing.arc_length[k] - path.start(index))
}

/// A force in {T}, whose x and z point along `x` and `axis`, in the base frame (eq. 4.11).
fn in_base(force: &Vector3<f64>, x: &Vector3<f64>, axis: &Vector3<f64>) -> Vector3<f64> {
    x * force.x + axis.cross(x) * force.y + axis * force.z
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
