//! Force follows deflection: a tool that the cut pushes out of its place cuts less, or more.
//!
//! With the shift u of the tip from where it should be, the mean force is F(u) = F0 + G P u, with P
//! the parts of a shift that the cut feels (to the left of the feed, and up the axis) and G the growth
//! of the force with them. The tip yields by D(F), so that P u = w solves
//! w = P u0 + P D(F0 + G w),
//! with u0 the shift of the commanded tip. For one direction alone and a linear arm this is
//! w = k w0 / (k + Kc), with the arm's stiffness k, that of the cut Kc = -G, and w0 the shift without
//! coupling.

use crate::cutting::CutStiffness;
use crate::deviation::TipAndAxis;
use nalgebra::{Matrix2, Vector2, Vector3};

/// Force and deflection of the tool in balance with the cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SettledCut {
    /// Force on the tool [N].
    pub force: Vector3<f64>,
    /// Displacement of the tip [m] and rotation of the tool [rad] under it.
    pub deflected: TipAndAxis,
    /// Displacement of the tip that the planned force would add [m].
    pub spared: Vector3<f64>,
    /// Whether there is such a balance. If not, the cut pulls the tool in about as hard as the arm holds it
    /// back, or harder, and force and deflection are those of the cut as planned.
    pub converged: bool,
}

impl SettledCut {
    /// The planned force with its deflection.
    pub fn planned(force: Vector3<f64>, deflected: TipAndAxis) -> Self {
        Self { force, deflected, spared: Vector3::zeros(), converged: true }
    }
}

/// Change of a shift that ends the iteration [m]; a linear arm settles at once.
const SETTLED: f64 = 1e-10;
/// Largest number of steps.
const STEPS: usize = 30;
/// Largest size of (1 - A)^-1, by which a shift grows as force and deflection settle: nearer to the limit the balance
/// lies many times as far off as the linear growth of the cut holds.
const MOST: f64 = 5.0;
/// Shift from which the arm's response to the growth of the force is taken [m].
const SMALL: f64 = 1e-5;

/// The balance of a cut that exerts `planned` [N] on a tool in its place, with its stiffness and the
/// shift `commanded` [m] of the undeflected tip; `deflect` gives the arm's deflection under a force. The
/// growth is linear, so it is trusted to the size of the planned force: the force falls to zero at most, where the
/// tool leaves the material, and doubles at most, which counts as no balance.
pub fn settled(
    planned: &Vector3<f64>,
    stiffness: &CutStiffness,
    commanded: &Vector3<f64>,
    deflect: impl Fn(&Vector3<f64>) -> TipAndAxis,
) -> SettledCut {
    let under_planned = deflect(planned);
    let as_planned = |converged| SettledCut { converged, ..SettledCut::planned(*planned, under_planned) };
    let balance = |force: Vector3<f64>, deflected: TipAndAxis| SettledCut {
        force,
        deflected,
        spared: under_planned.0 - deflected.0,
        converged: true,
    };
    if stiffness.growth == [Vector3::zeros(); 2] {
        return as_planned(true);
    }
    let felt = |tip: &Vector3<f64>| Vector2::from(stiffness.felt(&(commanded + tip)));
    let response = |way: usize| {
        let shift = deflect(&(planned + stiffness.growth[way] * SMALL)).0 - under_planned.0;
        Vector2::from(stiffness.felt(&shift)) / SMALL
    };
    let response = Matrix2::from_columns(&[response(0), response(1)]);
    let inverse = inverse_if_stable(&response).filter(|inverse| inverse.norm() <= MOST);
    let Some(inverse) = inverse else { return as_planned(false) };
    let mut shift = inverse * (felt(&under_planned.0));
    for _ in 0..STEPS {
        let grown = stiffness.grown(shift.into());
        let deflected = deflect(&(planned + grown));
        let change = inverse * (felt(&deflected.0) - shift);
        shift += change;
        if change.norm() <= SETTLED {
            return if grown.norm() <= planned.norm() {
                balance(planned + grown, deflected)
            } else {
                let force = planned + grown * (planned.norm() / grown.norm());
                // A tool without force has left the material, which is a balance.
                SettledCut { converged: grown.dot(planned) <= 0.0, ..balance(force, deflect(&force)) }
            };
        }
    }
    as_planned(false)
}

/// Inverse of 1 - A for the response A of the shift to itself; `None` if a shift would grow by
/// itself: A has a real eigenvalue of 1 or more.
pub fn inverse_if_stable(response: &Matrix2<f64>) -> Option<Matrix2<f64>> {
    let (half, determinant) = (response.trace() / 2.0, response.determinant());
    let discriminant = half * half - determinant;
    let is_stable = discriminant < 0.0 || half + discriminant.sqrt() < 1.0;
    is_stable.then(|| (Matrix2::identity() - response).try_inverse()).flatten()
}
