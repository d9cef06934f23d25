//! Linear least squares in a few unknowns.

use nalgebra::{SMatrix, SVector};

/// Columns are told apart if each keeps at least this share of its length beside those before it.
const APART: f64 = 1e-4;

/// Values, and the inverse of A^T A: their covariance for rows with a variance of 1.
pub(crate) struct LeastSquares<const N: usize> {
    pub(crate) values: SVector<f64, N>,
    pub(crate) inverse: SMatrix<f64, N, N>,
}

impl<const N: usize> LeastSquares<N> {
    /// Of rows of A x = b; `None` where the columns cannot be told apart. They are scaled to unit length, because units
    /// lie orders of magnitude apart.
    pub(crate) fn of(rows: impl Iterator<Item = (SVector<f64, N>, f64)>) -> Option<Self> {
        let (mut square, mut side) = (SMatrix::<f64, N, N>::zeros(), SVector::<f64, N>::zeros());
        for (row, value) in rows {
            square += row * row.transpose();
            side += row * value;
        }
        Self::solved(square, side)
    }

    /// Of the normal equations A^T A x = A^T b, likewise.
    pub(crate) fn solved(square: SMatrix<f64, N, N>, side: SVector<f64, N>) -> Option<Self> {
        let length = square.diagonal().map(f64::sqrt);
        if length.iter().any(|length| *length <= 0.0) {
            return None;
        }
        let scaled = SMatrix::<f64, N, N>::from_fn(|i, j| square[(i, j)] / (length[i] * length[j]));
        let factor = crate::spread::cholesky(&scaled)?;
        if factor.diagonal().iter().any(|pivot| *pivot < APART) {
            return None;
        }
        let inverse = scaled.try_inverse()?;
        let inverse = SMatrix::<f64, N, N>::from_fn(|i, j| inverse[(i, j)] / (length[i] * length[j]));
        Some(Self { values: inverse * side, inverse })
    }
}
