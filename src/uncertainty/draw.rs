//! Random plants: one draw of every input.

use crate::math::{self, TAU};
use crate::spread::Spreads;

/// Deviates beyond this many standard deviations are drawn again: two in a thousand, so the 95 %
/// ranges hold, and no factor of a range up to 60 % comes near zero or turns its sign.
pub(super) const CUT_OFF: f64 = 3.09;

/// The true plant, as factors on what is assumed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Draw {
    /// On the joint compliances.
    pub compliance: [f64; 6],
    /// On the parts of the force by tangential, radial and axial coefficients.
    pub force: [f64; 3],
    /// On the filter's frequency.
    pub frequency: f64,
}

/// Standard normal deviates behind one draw: six joints, the force, two ratios, the filter.
pub type Deviates = [f64; 10];

impl Draw {
    /// The plant as assumed.
    pub const NOMINAL: Self = Self { compliance: [1.0; 6], force: [1.0; 3], frequency: 1.0 };

    /// The plant at given deviates.
    pub fn at(spreads: &Spreads, z: &Deviates) -> Self {
        let [joints @ .., cutting, radial, axial, frequency] = z;
        let frequency = spreads.frequency.at(*frequency);
        if let Some(together) = &spreads.together {
            let [compliance @ .., cutting, radial, axial] = together.at(&std::array::from_fn(|i| z[i]));
            return Self { compliance, force: [cutting, cutting * radial, cutting * axial], frequency };
        }
        let cutting = spreads.cutting.at(*cutting);
        let [radial, axial] = [radial, axial].map(|z| cutting * spreads.ratios.at(*z));
        Self { compliance: spreads.stiffness.at(joints), force: [cutting, radial, axial], frequency }
    }
}

/// `count` sets of deviates from a seed.
pub fn deviates(seed: u64, count: usize) -> Vec<Deviates> {
    let mut random = fastrand::Rng::with_seed(seed);
    (0..count).map(|_| std::array::from_fn(|_| normal(&mut random))).collect()
}

/// The next standard normal deviate, by the Box-Muller transform; none lies beyond 3.09.
pub fn normal(random: &mut fastrand::Rng) -> f64 {
    // A uniform number in (0, 1) from the upper 53 bits.
    let mut uniform = || ((random.u64(..) >> 11) as f64 + 0.5) / 9_007_199_254_740_992.0;
    loop {
        let radius = (-2.0 * math::ln(uniform())).sqrt();
        let z = radius * math::cos(TAU * uniform());
        if z.abs() <= CUT_OFF {
            return z;
        }
    }
}
