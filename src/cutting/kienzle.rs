//! Kienzle's specific cutting force, and its linear form near one chip thickness.
//!
//! F_c = k_c1.1 b h^(1 - m_c) (O. Kienzle, VDI-Z 94, 1952). Catalogues give it for thousands of
//! alloys, but only in the direction of the cut; the user gives the radial and axial shares.

use crate::cutting::Coefficients;
use crate::math;
use crate::units::{MM, N_PER_MM2};

/// k_c1.1 and m_c, with the shares that a catalogue does not give.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kienzle {
    /// Specific cutting force of a chip of 1 mm by 1 mm [N/m^2].
    pub kc11: f64,
    /// Exponent m_c: how fast the specific force rises for thin chips.
    pub mc: f64,
    /// Ratio of radial to tangential force.
    pub radial: f64,
    /// Ratio of axial to tangential force.
    pub axial: f64,
    /// Whether the line is the secant through zero instead of the tangent.
    pub secant: bool,
}

/// Ratio of radial to tangential force if none is given. Tables of identified coefficients have
/// 0.16 to 0.6, mostly 0.2 to 0.4.
pub const RADIAL: f64 = 0.3;
/// Ratio of axial to tangential force if none is given. The same tables have 0.01 to 0.44 (thesis:
/// 0.44).
pub const AXIAL: f64 = 0.3;

impl Kienzle {
    /// From k_c1.1 [N/mm^2] and m_c, with the usual shares.
    pub fn of_table(kc11: f64, mc: f64) -> Self {
        Self { kc11: kc11 * N_PER_MM2, mc, radial: RADIAL, axial: AXIAL, secant: false }
    }

    /// The straight line that approximates the curve near the chip thickness `h0` [m], for a tool
    /// with this rake [rad].
    ///
    /// Tangent: F and its slope are exact at h0, k_tc = k_c (1 - m_c), k_te = k_c m_c h0, with k_c
    /// = k_c1.1 h0^-m_c (h0 in mm). Secant: F is exact at h0 and zero without a chip, k_tc = k_c,
    /// k_te = 0. The force falls by 1 % per degree of rake, from zero rake (rule of tool
    /// catalogues, after Kienzle).
    pub fn linear(&self, h0: f64, rake: f64) -> Coefficients {
        let kc = self.kc11 * math::pow(h0 / MM, -self.mc) * (1.0 - rake / crate::units::DEG / 100.0);
        let (ktc, kte) = if self.secant { (kc, 0.0) } else { (kc * (1.0 - self.mc), kc * self.mc * h0) };
        Coefficients {
            ktc,
            krc: ktc * self.radial,
            kac: ktc * self.axial,
            kte,
            kre: kte * self.radial,
            kae: kte * self.axial,
        }
    }
}
