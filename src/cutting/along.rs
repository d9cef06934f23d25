//! Milling force along the path, in the base frame (thesis eq. 4.11, Fig. 4.6).

use crate::cutting::{CutStiffness, LinearForce, Loading, MeanForces, PartForces, StiffnessAlong};
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

/// The stiffness of the cut in the base frame, one per sample, under the same load as the
/// [`forces`]; none on rapid moves.
pub fn stiffness(
    path: &Path,
    timing: &TimingLaw,
    stiffness: &StiffnessAlong,
    loading: &Loading,
) -> Vec<CutStiffness> {
    let mut all = Vec::with_capacity(timing.heading.len());
    let loads = loading.along(path);
    each(path, timing, |k, x, axis| {
        let (index, within) = place(path, timing, k);
        all.push(CutStiffness::under(&loads.at(timing, k), &stiffness.at(index, within), (&x, &axis)));
    });
    all
}

/// As [`forces`] and [`stiffness`], split into `parts` that add up to them, at the samples `at` only,
/// which rise.
pub fn parts(
    path: &Path,
    timing: &TimingLaw,
    parts: &PartForces,
    loading: &Loading,
    at: &[usize],
) -> Vec<([Vector3<f64>; 3], [CutStiffness; 3])> {
    let mut all = Vec::with_capacity(at.len());
    let loads = loading.along(path);
    each(path, timing, |k, x, axis| {
        if at.get(all.len()) == Some(&k) {
            let load = loads.at(timing, k);
            let (index, within) = place(path, timing, k);
            let force = |part: LinearForce| in_base(&part.under(&load), &x, &axis);
            let grown = |by: [LinearForce; 2]| CutStiffness::under(&load, &by, (&x, &axis));
            all.push((parts.at(index, within).map(force), parts.stiffness_at(index, within).map(grown)));
        }
    });
    all
}

/// The mean force where the tool is at the sample `k`.
pub fn mean_at(mean: &MeanForces, path: &Path, timing: &TimingLaw, k: usize) -> LinearForce {
    let (index, within) = place(path, timing, k);
    mean.at(index, within)
}

/// The move where the tool is at the sample `k`, and the arc length within it [m].
fn place(path: &Path, timing: &TimingLaw, k: usize) -> (usize, f64) {
    let index = timing.index[k] as usize;
    (index, timing.arc_length[k] - path.start(index))
}

/// A force in {T}, whose x and z point along `x` and `axis`, in the base frame (eq. 4.11).
pub(super) fn in_base(force: &Vector3<f64>, x: &Vector3<f64>, axis: &Vector3<f64>) -> Vector3<f64> {
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
