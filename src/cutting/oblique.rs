//! From orthogonal cutting tests to an oblique edge: coefficients for any helix and rake.
//!
//! E. Budak, Y. Altintas, E. J. A. Armarego, Prediction of Milling Force Coefficients From
//! Orthogonal Cutting Data, ASME J. Manuf. Sci. Eng. 118 (1996), eqs. 8 to 11, with Stabler's rule:
//! the chip flow angle equals the obliquity, which is the helix angle.

use crate::cutting::Coefficients;
use crate::math;
use crate::units::{DEG, MINUTE, MM, N_PER_MM, N_PER_MM2};

/// Orthogonal cutting data of a material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orthogonal {
    /// The numbers of the data file, in its order and units.
    pub numbers: [f64; 16],
}

impl Orthogonal {
    /// Coefficients at the chip thickness `h` [m] and cutting speed `v` [m/s], for an edge with
    /// this rake and helix [rad].
    pub fn linear(&self, h: f64, v: f64, rake: f64, helix: f64) -> Coefficients {
        let [t0, t_rake, b0, b_h, b_v, b_rake, p0, p_h, p_v, p_rake, r0, r_rake, a0, a_rake, kte, kre] =
            self.numbers;
        let (h_mm, v_min, degrees) = (h / MM, v * MINUTE, rake / DEG);
        let shear_stress = (t0 + t_rake * degrees) * N_PER_MM2;
        let friction = (b0 + b_h * h_mm + b_v * v_min + b_rake * degrees) * DEG;
        let shear_angle = if p0 > 0.0 {
            (p0 + p_h * h_mm + p_v * v_min + p_rake * degrees) * DEG
        } else {
            // Merchant: tan(phi) = r cos(rake) / (1 - r sin(rake)).
            let ratio = (r0 + r_rake * degrees) * math::pow(h_mm, a0 + a_rake * degrees);
            let (sin, cos) = math::sin_cos(rake);
            math::atan2(ratio * cos, 1.0 - ratio * sin)
        };
        let cutting = oblique(shear_stress, shear_angle, friction, rake, helix);
        Coefficients { kte: kte * N_PER_MM, kre: kre * N_PER_MM, ..cutting }
    }
}

/// Cutting coefficients of an oblique edge from the shear stress [N/m^2], shear angle, friction
/// angle, normal rake and obliquity [rad].
pub fn oblique(
    shear_stress: f64,
    shear_angle: f64,
    friction: f64,
    rake: f64,
    obliquity: f64,
) -> Coefficients {
    let (sin_i, cos_i) = math::sin_cos(obliquity);
    let tan_i = sin_i / cos_i;
    // Stabler: the chip flow angle is the obliquity.
    let tan_flow = tan_i;
    let normal_friction = math::atan2(math::tan(friction) * cos_i, 1.0);
    let (sin_b, _) = math::sin_cos(normal_friction);
    let (sin_br, cos_br) = math::sin_cos(normal_friction - rake);
    let spread = math::cos(shear_angle + normal_friction - rake);
    let scale = shear_stress
        / math::sin(shear_angle)
        / (spread * spread + tan_flow * tan_flow * sin_b * sin_b).sqrt();
    Coefficients {
        ktc: scale * (cos_br + tan_i * tan_flow * sin_b),
        krc: scale * sin_br / cos_i,
        kac: scale * (cos_br * tan_i - tan_flow * sin_b),
        ..Coefficients::default()
    }
}
