//! Spreads of the inputs: how far from its number the true value may be (JCGM 100:2008, 4.3; JCGM
//! 101:2008, 6.4).

use crate::math;
use nalgebra::{Matrix6, SMatrix};

/// Standard normal quantile of 97.5 %: half a 95 % range in standard deviations.
pub const COVERAGE: f64 = 1.959_963_984_540_054;

/// Standard normal quantile of 95 %.
const ONE_SIDED: f64 = 1.644_853_626_951_472;

/// The distribution of a factor: true value over assumed value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum InputSpread {
    /// Normal about 1, with this standard deviation.
    Normal(f64),
    /// Lognormal about 1: the standard deviation of the factor's logarithm.
    Lognormal(f64),
}

impl InputSpread {
    /// A 95 % range of `percent` to each side.
    pub fn percent(percent: f64) -> Self {
        Self::Normal(percent / 100.0 / COVERAGE)
    }

    /// A 95 % range from 1 / `factor` to `factor`.
    pub fn factor(factor: f64) -> Self {
        Self::Lognormal(math::ln(factor) / COVERAGE)
    }

    /// The factor at the standard normal deviate `z`.
    pub fn at(&self, z: f64) -> f64 {
        match self {
            Self::Normal(deviation) => 1.0 + deviation * z,
            Self::Lognormal(deviation) => math::exp(deviation * z),
        }
    }

    /// The factors below and above which 5 % lie.
    pub fn ends(&self) -> [f64; 2] {
        [self.at(-ONE_SIDED), self.at(ONE_SIDED)]
    }

    /// Relative standard deviation; of a lognormal, that of the logarithm.
    pub fn deviation(&self) -> f64 {
        let (Self::Normal(deviation) | Self::Lognormal(deviation)) = self;
        *deviation
    }

    /// The 95 % range in words.
    pub fn words(&self) -> String {
        match self {
            Self::Normal(deviation) => format!("±{} %", shortest(100.0 * COVERAGE * deviation, 1)),
            Self::Lognormal(deviation) => {
                format!("a factor of {}", shortest(math::exp(COVERAGE * deviation), 2))
            }
        }
    }
}

/// A number with at most `decimals` decimal places.
fn shortest(value: f64, decimals: usize) -> String {
    format!("{value:.decimals$}").trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// How the joint compliances vary.
#[derive(Debug, Clone, PartialEq)]
pub enum Stiffness {
    /// The stiffness of each joint separately.
    Each([InputSpread; 6]),
    /// Compliances from one fit, which vary together: lower triangular factor L of the covariance
    /// of their logarithms, and half its diagonal, which keeps the means.
    Together(Box<(Matrix6<f64>, [f64; 6])>),
}

impl Stiffness {
    /// Compliances with the means `compliance` [rad/(N m)] and a covariance [(rad/(N m))^2],
    /// lognormal so that none is negative. With S_ij = ln(1 + V_ij / (c_i c_j)), the exponential of
    /// normal deviates with covariance S and mean -S_ii / 2 has exactly the means 1 and the
    /// covariance V_ij / (c_i c_j). Where compliances are so closely tied that no deviates have this
    /// S, it is V_ij / (c_i c_j) itself: the same to first order. `None` if no set of compliances has
    /// this covariance.
    pub fn together(compliance: &[f64; 6], covariance: &[[f64; 6]; 6]) -> Option<Self> {
        let mut relative = Matrix6::zeros();
        for i in 0..6 {
            for j in 0..6 {
                let scale = compliance[i] * compliance[j];
                let value = covariance[i][j];
                if scale > 0.0 {
                    relative[(i, j)] = value / scale;
                } else if value != 0.0 {
                    return None;
                }
            }
        }
        let whole = cholesky(&relative)?;
        let logarithms = relative.map(|value| math::ln((1.0 + value).max(0.0)));
        let (factor, variance) = match cholesky(&logarithms) {
            Some(factor) => (factor, logarithms.diagonal()),
            None => (whole, relative.diagonal()),
        };
        let half = std::array::from_fn(|i| variance[i] / 2.0);
        Some(Self::Together(Box::new((factor, half))))
    }

    /// Factors on the joint compliances at six standard normal deviates.
    pub fn at(&self, z: &[f64; 6]) -> [f64; 6] {
        match self {
            Self::Each(spreads) => std::array::from_fn(|i| 1.0 / spreads[i].at(z[i])),
            Self::Together(both) => {
                let (factor, half) = &**both;
                std::array::from_fn(|i| {
                    let sum: f64 = (0..=i).map(|j| factor[(i, j)] * z[j]).sum();
                    math::exp(sum - half[i])
                })
            }
        }
    }

    /// The factor on one joint's compliance at the standard normal deviate `z` of that joint alone.
    pub fn alone(&self, joint: usize, z: f64) -> f64 {
        match self {
            Self::Each(spreads) => 1.0 / spreads[joint].at(z),
            Self::Together(both) => {
                let row = both.0.row(joint);
                math::exp(z * row.dot(&row).sqrt())
            }
        }
    }

    /// The factor on the compliance of the joint that may be softest, at 95 %, among those that give
    /// way.
    fn softest(&self, compliance: &[f64; 6]) -> f64 {
        let factors = match self {
            Self::Each(spreads) => spreads.map(|spread| 1.0 / spread.at(-ONE_SIDED)),
            Self::Together(both) => {
                let covariance = both.0 * both.0.transpose();
                std::array::from_fn(|i| math::exp(ONE_SIDED * covariance[(i, i)].sqrt()))
            }
        };
        let soft = factors.into_iter().zip(compliance).filter(|(_, compliance)| **compliance > 0.0);
        soft.map(|(factor, _)| factor).fold(1.0, f64::max)
    }

    /// Covariance of the factors, to first order.
    pub fn covariance(&self) -> Matrix6<f64> {
        match self {
            Self::Each(spreads) => Matrix6::from_fn(|i, j| {
                let deviation = if i == j { spreads[i].deviation() } else { 0.0 };
                deviation * deviation
            }),
            Self::Together(both) => both.0 * both.0.transpose(),
        }
    }
}

/// Share of a variance below which a pivot counts as zero.
const ROUNDING: f64 = 1e-9;

/// Lower triangular L with L L^T = `matrix`, which may have rows of zeros; `None` if it is not
/// positive semidefinite.
pub(crate) fn cholesky<const N: usize>(matrix: &SMatrix<f64, N, N>) -> Option<SMatrix<f64, N, N>> {
    let mut factor = SMatrix::<f64, N, N>::zeros();
    for j in 0..N {
        let pivot = matrix[(j, j)] - (0..j).map(|k| factor[(j, k)] * factor[(j, k)]).sum::<f64>();
        let slack = ROUNDING * matrix[(j, j)].abs();
        if !pivot.is_finite() || pivot < -slack {
            return None;
        }
        let root = if pivot > slack { pivot.sqrt() } else { 0.0 };
        factor[(j, j)] = root;
        for i in j + 1..N {
            let rest = matrix[(i, j)] - (0..j).map(|k| factor[(i, k)] * factor[(j, k)]).sum::<f64>();
            if !rest.is_finite()
                || (root == 0.0 && rest * rest > ROUNDING * matrix[(i, i)].abs() * matrix[(j, j)].abs())
            {
                return None;
            }
            factor[(i, j)] = if root > 0.0 { rest / root } else { 0.0 };
        }
    }
    Some(factor)
}

/// Factors on six joint compliances, on the cutting force, and on its radial and axial ratio, which a measurement ties to
/// each other: their logarithms are normal about 0.
#[derive(Debug, Clone, PartialEq)]
pub struct JointSpread {
    covariance: SMatrix<f64, 9, 9>,
    /// Lower triangular factor of it.
    factor: SMatrix<f64, 9, 9>,
}

impl JointSpread {
    /// With the covariance of the logarithms; `None` if it is none.
    pub fn of(covariance: &[[f64; 9]; 9]) -> Option<Self> {
        let covariance = SMatrix::<f64, 9, 9>::from_fn(|i, j| covariance[i][j]);
        Some(Self { covariance, factor: cholesky(&covariance)? })
    }

    /// The factors at nine standard normal deviates.
    pub fn at(&self, z: &[f64; 9]) -> [f64; 9] {
        std::array::from_fn(|i| math::exp((0..=i).map(|j| self.factor[(i, j)] * z[j]).sum()))
    }

    /// The compliances alone: their factor is the leading part of the whole one. Their medians are 1.
    fn stiffness(&self) -> Stiffness {
        Stiffness::Together(Box::new((self.factor.fixed_view::<6, 6>(0, 0).into_owned(), [0.0; 6])))
    }

    fn deviation(&self, index: usize) -> f64 {
        self.covariance[(index, index)].sqrt()
    }
}

/// The spreads of a job's inputs, and how they are drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Spreads {
    /// Of the joint compliances.
    pub stiffness: Stiffness,
    /// Of all cutting coefficients together.
    pub cutting: InputSpread,
    /// Of the ratios of radial to tangential and of axial to tangential force, each separately.
    pub ratios: InputSpread,
    /// Of the frequency of the filter that runs in the controller.
    pub frequency: InputSpread,
    /// Number of draws.
    pub draws: usize,
    /// Seed of the draws.
    pub seed: u64,
    /// Of compliances and cutting force together, if a measurement has tied them; the three above are then what is unknown
    /// of each by itself.
    pub together: Option<Box<JointSpread>>,
}

impl Spreads {
    /// The same with what a measurement has left of compliances and cutting force.
    pub fn learned(self, together: JointSpread) -> Self {
        let stiffness = together.stiffness();
        let cutting = InputSpread::Lognormal(together.deviation(6));
        let ratios = InputSpread::Lognormal(together.deviation(7).max(together.deviation(8)));
        Self { stiffness, cutting, ratios, together: Some(Box::new(together)), ..self }
    }

    /// Covariance of the factors, to first order: six compliances, cutting force, radial and axial ratio.
    pub fn covariance(&self) -> SMatrix<f64, 9, 9> {
        if let Some(together) = &self.together {
            return together.covariance;
        }
        let mut covariance = SMatrix::<f64, 9, 9>::zeros();
        covariance.fixed_view_mut::<6, 6>(0, 0).copy_from(&self.stiffness.covariance());
        for (index, spread) in [(6, self.cutting), (7, self.ratios), (8, self.ratios)] {
            covariance[(index, index)] = spread.deviation() * spread.deviation();
        }
        covariance
    }

    /// How many times as large as assumed the deflection of an arm with these compliances may be, at
    /// 95 %: its softest joint's, under the largest force. A bound, because not all of the deflection
    /// comes from that joint.
    pub fn margin(&self, compliance: &[f64; 6]) -> f64 {
        if let Some(together) = &self.together {
            let grown = |i: usize| {
                let covariance = &together.covariance;
                (covariance[(i, i)] + 2.0 * covariance[(i, 6)] + covariance[(6, 6)]).max(0.0).sqrt()
            };
            let soft = (0..6).filter(|i| compliance[*i] > 0.0);
            return soft.map(|i| math::exp(ONE_SIDED * grown(i))).fold(1.0, f64::max);
        }
        self.stiffness.softest(compliance) * self.cutting.at(ONE_SIDED)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_covariance_comes_back_from_its_factor() {
        let compliance = [1.0, 2.0, 3.0, 0.0, 5.0, 6.0].map(|c| c * 1e-7);
        let roots = Matrix6::from_fn(|i, j| {
            if i == 3 { 0.0 } else { 0.03 * compliance[i] * (1.0 + (i * 3 + j * 5) as f64 % 7.0) }
        });
        let matrix = roots * roots.transpose();
        let covariance: [[f64; 6]; 6] = std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)]));
        let spread = Stiffness::together(&compliance, &covariance).unwrap().covariance();
        for i in 0..6 {
            for j in 0..6 {
                let scale = compliance[i] * compliance[j];
                let wanted = if scale > 0.0 { math::ln(1.0 + covariance[i][j] / scale) } else { 0.0 };
                assert!((spread[(i, j)] - wanted).abs() < 1e-12, "{i} {j}");
            }
        }
    }

    #[test]
    fn what_is_no_covariance_is_refused() {
        let compliance = [1e-7; 6];
        let mut covariance = [[0.0; 6]; 6];
        covariance[0][0] = -1e-16;
        assert!(Stiffness::together(&compliance, &covariance).is_none());
        covariance[0] = [1e-16, 2e-16, 0.0, 0.0, 0.0, 0.0];
        covariance[1] = [2e-16, 1e-16, 0.0, 0.0, 0.0, 0.0];
        assert!(Stiffness::together(&compliance, &covariance).is_none());
    }

    #[test]
    fn a_range_of_95_percent_ends_where_it_says() {
        assert!((InputSpread::percent(20.0).at(COVERAGE) - 1.2).abs() < 1e-15);
        assert!((InputSpread::factor(4.0).at(-COVERAGE) - 0.25).abs() < 1e-15);
    }
}
