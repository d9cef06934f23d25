//! The end mill: its profile in slices, and how its shank bends.

use crate::cutting::{Coefficients, Cut};
use crate::math;
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, PI};

/// A piece of every edge that cuts like a cylinder's, with its own coefficients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slice {
    /// Height of its lower end above the tip [m].
    pub(super) from: f64,
    /// Height of the piece [m].
    pub(super) height: f64,
    /// Length of the edge in the plane of the axis [m].
    pub(super) edge: f64,
    /// Distance of the edge from the axis [m].
    pub(super) radius: f64,
    /// Coefficients for force per height.
    pub(super) coefficients: Coefficients,
    /// Entry and exit [rad].
    pub(super) entry: f64,
    pub(super) exit: f64,
}

impl Cut {
    /// Radius of the tool's cylinder [m].
    pub fn radius(&self) -> f64 {
        self.diameter / 2.0
    }

    /// The engaged edge from the tip up: the corner in `count` slices, then the cylinder in
    /// `above`.
    ///
    /// On a corner of radius r_c the edge's normal is at the angle kappa to the tool axis: height
    /// r_c (1 - cos kappa), chip h = c sin(phi) sin(kappa), chip width dz / sin(kappa). A slice of
    /// height dz thus takes the chip section c sin(phi) dz of a cylinder. Radial force acts along
    /// the normal, axial force along the profile (P. Lee, Y. Altintas, Int. J. Mach. Tools
    /// Manufact. 36 (1996), eqs. 8 to 14; Altintas 2012, section 2.9; the axial force has the
    /// thesis's sign). Turned by kappa, they are those of a cylinder with other coefficients.
    pub(super) fn slices(&self, count: usize, above: usize) -> Vec<Slice> {
        let (outer, corner, depth) = (self.radius(), self.corner_radius, self.axial_depth);
        let mut slices = Vec::new();
        let mut add = |from: f64, height: f64, edge: f64, radius: f64, coefficients: Coefficients| {
            if let Some((entry, exit)) = self.engagement.at(radius, outer)
                && height > 0.0
            {
                slices.push(Slice { from, height, edge, radius, coefficients, entry, exit });
            }
        };
        if corner > 0.0 {
            // Below this the corner does not reach the part's plane.
            let short = ((self.engagement.plane(outer) - (outer - corner)) / corner).clamp(0.0, 1.0);
            let low = FRAC_PI_2 - math::acos(short);
            let high = math::acos((1.0 - depth / corner).max(0.0));
            let height = |kappa: f64| corner * (1.0 - math::cos(kappa));
            let step = (high - low) / count as f64;
            for k in 0..count {
                let kappa = low + step * (k as f64 + 0.5);
                let from = height(kappa - step / 2.0);
                let (sin, cos) = math::sin_cos(kappa);
                let tall = height(kappa + step / 2.0) - from;
                let edge = corner * step / tall;
                let own = &self.coefficients;
                let turned = Coefficients {
                    ktc: own.ktc,
                    krc: own.krc * sin - own.kac * cos,
                    kac: own.kac * sin + own.krc * cos,
                    kte: own.kte * edge,
                    kre: (own.kre * sin - own.kae * cos) * edge,
                    kae: (own.kae * sin + own.kre * cos) * edge,
                };
                add(from, tall, corner * step, outer - corner + corner * sin, turned);
            }
        }
        let rest = depth - corner;
        for k in 0..above {
            let tall = rest / above as f64;
            add(corner + tall * k as f64, tall, tall, outer, self.coefficients);
        }
        slices
    }
}

/// Compliance of the tool in its holder to a force on the tip across the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bending {
    /// Displacement of the tip per newton [m/N].
    pub displacement: f64,
    /// Rotation of the tip per newton [rad/N].
    pub turn: f64,
}

/// Diameter of the bar that bends like the fluted part, as a share of the tool's diameter (L. Kops,
/// D. T. Vo, CIRP Annals 39 (1990): about 0.8 for end mills with two to four flutes).
pub const FLUTED: f64 = 0.8;

impl Bending {
    /// A bar clamped in its holder: `length` is the length out of the holder [m], `modulus` Young's
    /// modulus [N/m^2]. It is fluted over `flute_length` [m] from the tip, on the tool's `diameter`
    /// [m], then round with the diameter `shank` [m].
    ///
    /// The sum over both parts of the integrals of x^2 / (E I) and x / (E I) from the tip, with I =
    /// pi d^4 / 64. A single part gives F L^3 / (3 E I) (S. Timoshenko, Strength of Materials I,
    /// section 36).
    pub fn of(modulus: f64, length: f64, flute_length: f64, diameter: f64, shank: f64) -> Self {
        let stiffness = |d: f64| modulus * PI * d * d * d * d / 64.0;
        let (fluted, round) = (stiffness(FLUTED * diameter), stiffness(shank));
        let border = flute_length.min(length);
        let sum = |inner: f64, whole: f64| inner / fluted + (whole - inner) / round;
        let square = |x: f64| x * x;
        Self {
            displacement: sum(border * square(border), length * square(length)) / 3.0,
            turn: sum(square(border), square(length)) / 2.0,
        }
    }

    /// Displacement [m] and rotation [rad] of the tip under a force [N] on it, for a tool along
    /// `axis` (from tip to spindle): only the part of the force across the axis bends it.
    pub fn deflection(&self, axis: &Vector3<f64>, force: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let across = force - axis * axis.dot(force);
        // The tip moves with the force; the axis, seen from the tip, then leans the other way.
        (across * self.displacement, axis.cross(&across) * -self.turn)
    }
}
