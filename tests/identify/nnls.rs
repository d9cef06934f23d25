//! Non-negative least squares against its optimality conditions and against every set of free
//! unknowns.

use armill::identify::nnls::solve;
use nalgebra::{DMatrix, DVector, Matrix6, Vector6};

/// A random problem; columns of very different length, some of them dependent or empty.
fn problem(random: &mut fastrand::Rng, case: usize) -> (DMatrix<f64>, DVector<f64>) {
    let rows = 6 + random.usize(0..20);
    let mut a = DMatrix::from_fn(rows, 6, |_, _| random.f64() - 0.4);
    for mut column in a.column_iter_mut() {
        column *= 10f64.powi(random.i32(-4..4));
    }
    if case.is_multiple_of(5) {
        let copy = a.column(1) * 3.0;
        a.set_column(4, &copy);
    }
    if case.is_multiple_of(7) {
        a.column_mut(2).fill(0.0);
    }
    let b = DVector::from_fn(rows, |_, _| random.f64() - 0.5);
    (a, b)
}

fn normal(a: &DMatrix<f64>, b: &DVector<f64>) -> (Matrix6<f64>, Vector6<f64>) {
    let (g, h) = (a.transpose() * a, a.transpose() * b);
    (Matrix6::from_fn(|i, j| g[(i, j)]), Vector6::from_fn(|i, _| h[i]))
}

#[test]
fn the_optimality_conditions_hold() {
    let mut random = fastrand::Rng::with_seed(1974);
    for case in 0..3000 {
        let (a, b) = problem(&mut random, case);
        let (g, h) = normal(&a, &b);
        let solution = solve(&g, &h);
        // Karush-Kuhn-Tucker: x >= 0, gradient A^T (A x - b) >= 0, and zero where x > 0; each
        // column's gradient by its own length.
        let residual = &a * DVector::from_column_slice(solution.x.as_slice()) - &b;
        for i in 0..6 {
            let length = a.column(i).norm().max(1e-300);
            let gradient = a.column(i).dot(&residual) / length / b.norm();
            assert!(solution.x[i] >= 0.0, "case {case}: {solution:?}");
            assert!(gradient > -1e-9, "case {case}, unknown {i}: gradient {gradient}");
            if solution.x[i] > 0.0 {
                assert!(solution.free[i] && gradient < 1e-9, "case {case}, unknown {i}: gradient {gradient}");
            }
        }
    }
}

#[test]
fn no_other_set_of_free_unknowns_is_better() {
    let mut random = fastrand::Rng::with_seed(64);
    for case in 0..400 {
        let (a, b) = problem(&mut random, case);
        let (g, h) = normal(&a, &b);
        let x = DVector::from_column_slice(solve(&g, &h).x.as_slice());
        let ours = (&a * x - &b).norm_squared();
        let mut best = b.norm_squared();
        for set in 1..64_usize {
            let columns: Vec<usize> = (0..6).filter(|i| set >> i & 1 == 1).collect();
            let part = a.select_columns(&columns);
            // By singular values of A itself, not by the normal equations.
            let lengths: Vec<f64> = part.column_iter().map(|c| c.norm().max(1e-300)).collect();
            let scaled = DMatrix::from_fn(part.nrows(), part.ncols(), |i, j| part[(i, j)] / lengths[j]);
            let y = scaled.clone().svd(true, true).solve(&b, 1e-9).unwrap();
            if y.iter().all(|y| *y >= 0.0) {
                best = best.min((scaled * y - &b).norm_squared());
            }
        }
        assert!((ours - best).abs() <= 1e-9 * b.norm_squared(), "case {case}: {ours} against {best}");
    }
}
