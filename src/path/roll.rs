//! Roll: rotation of the TCP about the tool axis along the path, the degree of freedom that milling
//! leaves open. The cut does not depend on it; the joint values do. A job calls it `spin`.

use std::cmp::Ordering;

/// Angle about the tool axis as a function of the arc length.
#[derive(Debug, Clone, PartialEq)]
pub struct Roll {
    /// Arc length [m], angle [rad] and its slope [rad/m], in order of arc length. Outside the knots
    /// the angle is constant.
    knots: Vec<[f64; 3]>,
}

impl Roll {
    /// A constant angle [rad].
    pub fn fixed(angle: f64) -> Self {
        Self { knots: vec![[0.0, angle, 0.0]] }
    }

    /// A smooth curve through points (arc length [m], ascending; angle [rad]) that stays within the
    /// range of neighbouring points.
    ///
    /// Cubic Hermite pieces with slopes limited to keep each one monotone (F. Fritsch, J. Butland,
    /// "A method for constructing local monotone piecewise cubic interpolants", SIAM J. Sci. Stat.
    /// Comput. 5(2), 1984). The first derivative is continuous.
    pub fn through(points: &[(f64, f64)]) -> Self {
        let secant = |k: usize| (points[k + 1].1 - points[k].1) / (points[k + 1].0 - points[k].0);
        let slope = |k: usize| {
            if k == 0 || k + 1 >= points.len() {
                return 0.0;
            }
            let (before, after) = (secant(k - 1), secant(k));
            if before * after <= 0.0 {
                return 0.0;
            }
            let (wide, narrow) = (points[k + 1].0 - points[k].0, points[k].0 - points[k - 1].0);
            let part = (1.0 + wide / (wide + narrow)) / 3.0;
            before * after / (part * after + (1.0 - part) * before)
        };
        Self { knots: points.iter().enumerate().map(|(k, &(s, angle))| [s, angle, slope(k)]).collect() }
    }

    /// The roll stretched to a path `factor` times as long.
    pub fn stretched(&self, factor: f64) -> Self {
        Self {
            knots: self.knots.iter().map(|[s, angle, slope]| [s * factor, *angle, slope / factor]).collect(),
        }
    }

    /// The angle at the arc length `s` [m], in rad.
    pub fn at(&self, s: f64) -> f64 {
        let after = self.knots.partition_point(|knot| knot[0].total_cmp(&s) != Ordering::Greater);
        match (self.knots.get(after.wrapping_sub(1)), self.knots.get(after)) {
            (Some(&[from, angle, slope]), Some(&[to, next, next_slope])) => {
                let (width, t) = (to - from, (s - from) / (to - from));
                let u = 1.0 - t;
                let curve = angle * u * u * (1.0 + 2.0 * t)
                    + next * t * t * (3.0 - 2.0 * t)
                    + width * t * u * (slope * u - next_slope * t);
                // Rounding could push it out of the range.
                curve.clamp(angle.min(next), angle.max(next))
            }
            (Some(knot), None) | (None, Some(knot)) => knot[1],
            (None, None) => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_meets_its_points_and_overshoots_none() {
        let points = [(0.0, 0.3), (0.1, 0.5), (0.25, 2.0), (0.3, 2.0), (0.5, -1.0), (1.0, -0.9)];
        let roll = Roll::through(&points);
        for pair in points.windows(2) {
            let [(from, a), (to, b)] = [pair[0], pair[1]];
            assert!((roll.at(from) - a).abs() < 1e-15 && (roll.at(to) - b).abs() < 1e-15);
            for i in 0..=200 {
                let s = from + (to - from) * f64::from(i) / 200.0;
                assert!(roll.at(s) >= a.min(b) - 1e-12 && roll.at(s) <= a.max(b) + 1e-12, "at {s}");
            }
        }
        assert_eq!((roll.at(-1.0), roll.at(2.0)), (0.3, -0.9));
        assert_eq!(Roll::fixed(0.7).at(0.4), 0.7);
        // The slope is continuous at every point.
        for (s, _) in points {
            let h = 1e-7;
            let (left, right) = ((roll.at(s) - roll.at(s - h)) / h, (roll.at(s + h) - roll.at(s)) / h);
            assert!((left - right).abs() < 1e-3, "at {s}: {left} and {right}");
        }
    }

    #[test]
    fn evenly_rising_points_give_a_straight_line_inside() {
        let points: Vec<_> = (0..6).map(|k| (f64::from(k) * 0.1, f64::from(k) * 0.2)).collect();
        let roll = Roll::through(&points);
        for i in 100..=400 {
            let s = f64::from(i) * 1e-3;
            assert!((roll.at(s) - 2.0 * s).abs() < 1e-12, "at {s}");
        }
    }
}
