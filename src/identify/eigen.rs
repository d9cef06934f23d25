//! Eigenvalues of a symmetric 6x6 matrix.

use nalgebra::Matrix6;

/// Eigenvalues and eigenvectors (columns of the matrix) by cyclic Jacobi rotations (G. Golub, C.
/// Van Loan, Matrix Computations, 4th ed. 2013, section 8.5): only + - * / and square roots, so the
/// bits are the same on every platform.
pub(super) fn eigen(matrix: &Matrix6<f64>) -> ([f64; 6], Matrix6<f64>) {
    let (mut a, mut v) = (*matrix, Matrix6::identity());
    for _sweep in 0..30 {
        let off: f64 = (0..6).flat_map(|p| (0..p).map(move |q| (p, q))).map(|at| a[at] * a[at]).sum();
        if off <= 1e-32 * a.norm_squared() {
            break;
        }
        for q in 1..6 {
            for p in 0..q {
                if a[(p, q)] == 0.0 {
                    continue;
                }
                let tau = (a[(q, q)] - a[(p, p)]) / (2.0 * a[(p, q)]);
                let sign = if tau < 0.0 { -1.0 } else { 1.0 };
                let t = sign / (tau.abs() + (1.0 + tau * tau).sqrt());
                let cos = 1.0 / (1.0 + t * t).sqrt();
                let sin = t * cos;
                for k in 0..6 {
                    let (x, y) = (a[(k, p)], a[(k, q)]);
                    (a[(k, p)], a[(k, q)]) = (cos * x - sin * y, sin * x + cos * y);
                }
                for k in 0..6 {
                    let (x, y) = (a[(p, k)], a[(q, k)]);
                    (a[(p, k)], a[(q, k)]) = (cos * x - sin * y, sin * x + cos * y);
                    let (x, y) = (v[(k, p)], v[(k, q)]);
                    (v[(k, p)], v[(k, q)]) = (cos * x - sin * y, sin * x + cos * y);
                }
            }
        }
    }
    ([0, 1, 2, 3, 4, 5].map(|i| a[(i, i)]), v)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_as_by_tridiagonal_qr() {
        let mut random = fastrand::Rng::with_seed(6);
        for case in 0..200 {
            let half = Matrix6::from_fn(|_, _| random.f64() - 0.5);
            let mut matrix = half * half.transpose();
            if case % 4 == 0 {
                matrix.set_row(2, &matrix.row(1).into_owned());
                matrix.set_column(2, &matrix.column(1).into_owned());
                matrix[(2, 2)] = matrix[(1, 1)];
            }
            let (mut values, vectors) = eigen(&matrix);
            let back = vectors * Matrix6::from_diagonal(&values.into()) * vectors.transpose();
            assert!((back - matrix).norm() < 1e-14 * matrix.norm(), "case {case}");
            let mut theirs: Vec<f64> = matrix.symmetric_eigenvalues().iter().copied().collect();
            values.sort_by(f64::total_cmp);
            theirs.sort_by(f64::total_cmp);
            for (ours, theirs) in values.iter().zip(theirs) {
                assert!((ours - theirs).abs() < 1e-14 * matrix.norm(), "case {case}: {ours} {theirs}");
            }
        }
    }
}
