//! The end mill: its profile in slices, and how its shank bends.

use crate::cutting::{Coefficients, Cut};
use crate::math;
use crate::stock::Cutter;
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Hand of the helix of a tool that turns clockwise, seen from the spindle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Hand {
    /// The chip rises towards the spindle and pulls the tool out of its holder.
    #[default]
    Right,
    /// The chip is pushed down and the tool up, into its holder.
    Left,
}

impl Hand {
    /// 1 for right, -1 for left.
    pub(super) fn sign(self) -> f64 {
        match self {
            Hand::Right => 1.0,
            Hand::Left => -1.0,
        }
    }
}

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
    /// Coefficients for force per height, those of the axial force for the one towards the spindle.
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

    /// Radius at a height above the tip [m].
    pub fn radius_at(&self, height: f64) -> f64 {
        let cutter = Cutter { radius: self.radius(), corner: self.corner_radius, flutes: f64::INFINITY };
        cutter.radius_at(height)
    }

    /// The engaged edge from the tip up: the corner in `count` slices, then the cylinder in
    /// `above`.
    ///
    /// On a corner of radius r_c the edge's normal is at the angle kappa to the tool axis: height
    /// r_c (1 - cos kappa), chip h = c sin(phi) sin(kappa), chip width dz / sin(kappa). A slice of
    /// height dz thus takes the chip section c sin(phi) dz of a cylinder. Radial force acts along
    /// the normal, axial force along the profile: inward F_r sin kappa + F_a cos kappa, towards the
    /// spindle F_r cos kappa - F_a sin kappa for a right-hand helix (P. Lee, Y. Altintas, Int. J.
    /// Mach. Tools Manufact. 36 (1996), eqs. 8 to 14; S. Engin, Y. Altintas, Int. J. Mach. Tools
    /// Manufact. 41 (2001), eq. 19). A left-hand helix turns F_a round. Turned by kappa, the forces
    /// are those of a cylinder with other coefficients.
    pub(super) fn slices(&self, count: usize, above: usize) -> Vec<Slice> {
        let (outer, corner, depth) = (self.radius(), self.corner_radius, self.axial_depth);
        let own = self.towards_spindle();
        let mut slices = Vec::new();
        let mut add = |from: f64, height: f64, edge: f64, radius: f64, coefficients: Coefficients| {
            if height > 0.0 {
                let (entry, exit) = self.engagement.at(radius);
                slices.push(Slice { from, height, edge, radius, coefficients, entry, exit });
            }
        };
        if corner > 0.0 {
            let height = |kappa: f64| corner * (1.0 - math::cos(kappa));
            for pair in self.corner_angles(count).windows(2) {
                let (low, high) = (pair[0], pair[1]);
                let from = height(low);
                let tall = height(high) - from;
                let (turned, sin) = self.turned(&own, (low, high), tall);
                add(from, tall, corner * (high - low), outer - corner + corner * sin, turned);
            }
        }
        let rest = depth - corner;
        for k in 0..above {
            let tall = rest / above as f64;
            add(corner + tall * k as f64, tall, tall, outer, own);
        }
        slices
    }

    /// The coefficients with those of the axial force for the one towards the spindle.
    pub(super) fn towards_spindle(&self) -> Coefficients {
        let down = self.hand.sign();
        Coefficients {
            kac: -down * self.coefficients.kac,
            kae: -down * self.coefficients.kae,
            ..self.coefficients
        }
    }

    /// The coefficients `own` on the corner between two angles kappa [rad], `tall` [m] apart in height,
    /// and the sine of their middle.
    pub(super) fn turned(
        &self,
        own: &Coefficients,
        (low, high): (f64, f64),
        tall: f64,
    ) -> (Coefficients, f64) {
        let (sin, cos) = math::sin_cos((low + high) / 2.0);
        let edge = self.corner_radius * (high - low) / tall;
        let turned = Coefficients {
            ktc: own.ktc,
            krc: own.krc * sin - own.kac * cos,
            kac: own.kac * sin + own.krc * cos,
            kte: own.kte * edge,
            kre: (own.kre * sin - own.kae * cos) * edge,
            kae: (own.kae * sin + own.kre * cos) * edge,
        };
        (turned, sin)
    }

    /// The borders of `count` slices of the corner as angles kappa [rad].
    ///
    /// Where the engagement begins to leave the slot it changes like a square root, so the slices
    /// grow from there.
    fn corner_angles(&self, count: usize) -> Vec<f64> {
        let (outer, corner) = (self.radius(), self.corner_radius);
        let top = math::acos((1.0 - self.axial_depth / corner).max(0.0));
        let reached = (self.engagement.slot_below() - (outer - corner)) / corner;
        let slot = (FRAC_PI_2 - math::acos(reached.clamp(0.0, 1.0))).min(top);
        let even = |from: f64, to: f64, count: usize| {
            (0..count).map(move |k| from + (to - from) * k as f64 / count as f64)
        };
        if slot <= 0.0 || slot >= top {
            return even(0.0, top, count).chain([top]).collect();
        }
        let below = count / 4;
        let above = even(0.0, 1.0, count - below).map(|part| slot + (top - slot) * part * part);
        even(0.0, slot, below).chain(above).chain([top]).collect()
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
