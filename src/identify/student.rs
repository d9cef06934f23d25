//! Student's t: how many standard errors a 95 % interval reaches to each side.

use crate::math;
use crate::spread::COVERAGE;

/// The 0.975 quantile of Student's t with `freedom` degrees of freedom.
///
/// Exact for one and two; from three on M. Abramowitz, I. Stegun, Handbook of Mathematical
/// Functions (1964), 26.7.5, whose error is largest at three: 0.12 %.
pub fn quantile_975(freedom: usize) -> f64 {
    let n = match freedom {
        0 => return f64::INFINITY,
        1 => return math::tan(math::PI * 0.475),
        2 => return 0.95 * (2.0_f64 / (0.975 * 0.025 * 4.0)).sqrt(),
        n => n as f64,
    };
    let x = COVERAGE;
    let s = x * x;
    let g1 = x * (s + 1.0) / 4.0;
    let g2 = x * ((5.0 * s + 16.0) * s + 3.0) / 96.0;
    let g3 = x * (((3.0 * s + 19.0) * s + 17.0) * s - 15.0) / 384.0;
    let g4 = x * ((((79.0 * s + 776.0) * s + 1482.0) * s - 1920.0) * s - 945.0) / 92160.0;
    x + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Probability within +-t by integrating the density (1 + x^2/n)^(-(n+1)/2), scaled by its
    /// integral over a very wide range.
    fn within(t: f64, n: f64) -> f64 {
        // x = sqrt(n) tan(u): the density becomes cos(u)^(n-1).
        let area = |to: f64| {
            let steps = 20_000;
            let h = to / f64::from(steps);
            let f = |k: i32| math::pow(math::cos(f64::from(k) * h).abs(), n - 1.0);
            let inner: f64 = (1..steps).map(|k| if k % 2 == 1 { 4.0 * f(k) } else { 2.0 * f(k) }).sum();
            (f(0) + inner + f(steps)) * h / 3.0
        };
        area(math::atan2(t, n.sqrt())) / area(math::FRAC_PI_2)
    }

    /// The series' own error, 0.12 % of the quantile at three, leaves 1.5e-4 of probability there
    /// and falls fast.
    #[test]
    fn the_quantiles_hold_95_percent() {
        for (freedom, tolerance) in
            [(1, 1e-9), (2, 1e-9), (3, 1.5e-4), (4, 4.5e-5), (5, 1.7e-5), (10, 1e-6), (37, 1e-7), (123, 1e-7)]
        {
            let within = within(quantile_975(freedom), freedom as f64);
            assert!((within - 0.95).abs() < tolerance, "{freedom}: {within}");
        }
        assert!(quantile_975(0).is_infinite());
    }
}
