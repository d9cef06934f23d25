//! Non-negative least squares for six unknowns.

use nalgebra::{Matrix6, Vector6};

/// A column nearer than this to the span of the others, as a share of its length, counts as
/// dependent on them.
const DEPENDENT: f64 = 1e-5;
/// A gradient below this share of the largest component of the scaled A^T b counts as zero.
const FLAT: f64 = 1e-12;

/// The non-negative least squares solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NnlsSolution {
    /// The unknowns, zero or positive.
    pub x: Vector6<f64>,
    /// Which of them are free; the others are held at zero.
    pub free: [bool; 6],
}

/// Minimises |A x - b| over x >= 0 from the normal equations `g` = A^T A and `h` = A^T b.
///
/// Active set method of C. Lawson, R. Hanson, Solving Least Squares Problems (1974), chapter 23,
/// algorithm NNLS, on the normal equations as R. Bro, S. de Jong, J. Chemometrics 11 (1997) do;
/// with six columns of unit length this keeps enough digits. A column that depends on those already
/// free stays at zero.
pub fn solve(g: &Matrix6<f64>, h: &Vector6<f64>) -> NnlsSolution {
    let length = Vector6::from_fn(|i, _| g[(i, i)].sqrt());
    let inverse = length.map(|length| if length > 0.0 { 1.0 / length } else { 0.0 });
    let scale = Matrix6::from_diagonal(&inverse);
    let (g, h) = (scale * g * scale, h.component_mul(&inverse));
    let flat = FLAT * h.amax();
    let (mut x, mut free, mut refused) = (Vector6::zeros(), [false; 6], length.map(|length| length == 0.0));
    // Each change lowers the residual, so none of the 2^6 sets of free unknowns recurs; between two
    // changes, up to six may be refused.
    for _ in 0..64 * 7 {
        let pull = h - g * x;
        let best = (0..6).filter(|&i| !free[i] && !refused[i] && pull[i] > flat);
        let Some(enters) = best.max_by(|&i, &j| pull[i].total_cmp(&pull[j])) else { break };
        free[enters] = true;
        let Some(mut candidate) = least_squares(&g, &h, &free).filter(|s| s[enters] > 0.0) else {
            (free[enters], refused[enters]) = (false, true);
            continue;
        };
        // The step towards the candidate ends where the first free unknown reaches zero.
        while let Some((step, leaves)) = (0..6)
            .filter(|&i| free[i] && candidate[i] <= 0.0)
            .map(|i| (x[i] / (x[i] - candidate[i]), i))
            .min_by(|(a, _), (b, _)| a.total_cmp(b))
        {
            x += (candidate - x) * step;
            (free[leaves], x[leaves]) = (false, 0.0);
            candidate = least_squares(&g, &h, &free).unwrap_or(x);
        }
        x = candidate;
        refused = length.map(|length| length == 0.0);
    }
    NnlsSolution { x: x.component_mul(&inverse), free }
}

/// Least squares over the free unknowns; the others are zero. None if a column depends on the
/// others.
fn least_squares(g: &Matrix6<f64>, h: &Vector6<f64>, free: &[bool; 6]) -> Option<Vector6<f64>> {
    let only = Vector6::from_fn(|i, _| if free[i] { h[i] } else { 0.0 });
    let factor = restricted(g, free).cholesky()?;
    let independent = (0..6).all(|i| factor.l_dirty()[(i, i)] > DEPENDENT);
    independent.then(|| factor.solve(&only))
}

/// `g` restricted to the free unknowns; the rows and columns of the others are the identity's.
pub(super) fn restricted(g: &Matrix6<f64>, free: &[bool; 6]) -> Matrix6<f64> {
    Matrix6::from_fn(|i, j| {
        let identity = if i == j { 1.0 } else { 0.0 };
        if free[i] && free[j] { g[(i, j)] } else { identity }
    })
}
