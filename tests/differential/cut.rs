//! The cut by sums over small steps of height and angle (eqs. 4.1 to 4.7), and the tool as a beam
//! of small slices.

use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Position of the part.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Part {
    /// Between two immersion angles [rad].
    Angles(f64, f64),
    /// Right of the feed, overlapping the tool's path by this much [m].
    Right(f64),
    /// Left of the feed.
    Left(f64),
    /// On both sides.
    Both,
}

/// Cutting coefficients as stated by a job.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Stock {
    /// Tangential, radial and axial [N/m^2]; the edge coefficients [N/m].
    Linear([f64; 3], [f64; 3]),
    /// k_c1.1 [N/mm^2], m_c, radial and axial share, whether the line is the secant, and the chip
    /// thickness it is fitted at [m], if stated.
    Kienzle { kc11: f64, mc: f64, radial: f64, axial: f64, secant: bool, chip: Option<f64> },
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct Cut {
    /// [m]
    pub(crate) diameter: f64,
    pub(crate) flutes: f64,
    /// 1: right-hand helix; -1: left-hand.
    pub(crate) hand: f64,
    /// [m]
    pub(crate) corner: f64,
    /// [m]
    pub(crate) depth: f64,
    pub(crate) part: Part,
    pub(crate) stock: Stock,
    /// [deg]
    pub(crate) rake: f64,
    /// Feed per tooth [m]; `None`: from the feed.
    pub(crate) chip: Option<f64>,
    /// Revolutions in a second.
    pub(crate) spindle: f64,
    /// Feed of the job [m/s].
    pub(crate) feed: f64,
}

/// Force per 1 m of feed per tooth, and at zero feed, in the cutting frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Force {
    pub(crate) cutting: Vector3<f64>,
    pub(crate) edge: Vector3<f64>,
}

impl Cut {
    /// Feed per tooth [m] at a programmed feed.
    pub(crate) fn per_tooth(&self, feed: f64, spindle: Option<f64>) -> f64 {
        self.chip.unwrap_or(feed / (self.flutes * spindle.unwrap_or(self.spindle)))
    }

    /// How far the axis is before the part's front when the tool first touches it [m]: the point of
    /// its edge that is furthest ahead of those beside the part.
    pub(crate) fn run_in(&self) -> f64 {
        let outer = self.diameter / 2.0;
        let width = match self.part {
            Part::Angles(from, to) => outer * (from.cos() - to.cos()),
            Part::Left(depth) | Part::Right(depth) => depth,
            Part::Both => self.diameter,
        };
        // From the side up to the height of the part's edge, the circle leads by this.
        let beside = f64::max(outer - width, 0.0);
        (outer * outer - beside * beside).sqrt()
    }

    /// Calls `each` for every element of one edge and every angle at which it is in the part:
    /// immersion angle, angle of the edge's normal to the axis, height, length of the edge, step of
    /// the angle.
    fn sweep(&self, mut each: impl FnMut(f64, f64, f64, f64, f64)) {
        let outer = self.diameter / 2.0;
        let mut bits = Vec::new();
        if self.corner > 0.0 {
            let radius = |kappa: f64| outer - self.corner + self.corner * kappa.sin();
            let top = (1.0 - self.depth / self.corner).clamp(0.0, 1.0).acos();
            // Where the pass before leaves less than a slot: below, the edge is in the part all round.
            let beside = match self.part {
                Part::Left(depth) | Part::Right(depth) => depth / 2.0,
                _ => f64::INFINITY,
            };
            let border = ((beside - outer + self.corner) / self.corner).clamp(0.0, 1.0).asin().min(top);
            // Steps that grow linearly from there: the engagement angle changes like a square root.
            let count = 300;
            for (from, to) in [(border, 0.0), (border, top)] {
                for k in 0..count {
                    let (a, b) = (f64::from(k) / f64::from(count), f64::from(k + 1) / f64::from(count));
                    let kappa = from + (to - from) * ((a + b) / 2.0).powi(2);
                    let edge = self.corner * (to - from).abs() * (b * b - a * a);
                    bits.push((radius(kappa), kappa, edge * kappa.sin(), edge));
                }
            }
        }
        if self.depth > self.corner {
            let rest = self.depth - self.corner;
            bits.push((outer, FRAC_PI_2, rest, rest));
        }
        let steps = if self.corner > 0.0 { 300 } else { 3000 };
        for (radius, kappa, height, edge) in bits {
            // A tooth at the angle phi is at the height radius cos(phi) above the plane through the
            // axis along the feed; the pass before left the same radius, the depth further.
            let (from, to) = match self.part {
                Part::Angles(from, to) => (from, to),
                Part::Both => (0.0, PI),
                Part::Left(depth) | Part::Right(depth) => {
                    let angle = (1.0 - depth / radius).max(-1.0).acos();
                    if matches!(self.part, Part::Left(_)) { (0.0, angle) } else { (PI - angle, PI) }
                }
            };
            let step = (to - from) / f64::from(steps);
            for k in 0..steps {
                each(from + step * (f64::from(k) + 0.5), kappa, height, edge, step);
            }
        }
    }

    /// Mean chip thickness [m] at the feed per tooth `c`.
    fn mean_chip(&self, c: f64) -> f64 {
        let (mut sum, mut way) = (0.0, 0.0);
        self.sweep(|phi, kappa, _, edge, step| {
            sum += c * phi.sin() * kappa.sin() * edge * step;
            way += edge * step;
        });
        sum / way
    }

    /// Whether coefficients are fitted at a mean chip below a micrometre, where no table reaches.
    pub(crate) fn too_thin(&self) -> bool {
        let made = matches!(self.stock, Stock::Kienzle { chip: None, .. });
        made && self.mean_chip(self.per_tooth(self.feed, None)) < 1e-6
    }

    /// Cutting [N/m^2] and edge coefficients [N/m].
    fn coefficients(&self) -> ([f64; 3], [f64; 3]) {
        match self.stock {
            Stock::Linear(cutting, edge) => (cutting, edge),
            Stock::Kienzle { kc11, mc, radial, axial, secant, chip } => {
                let at = chip.unwrap_or_else(|| self.mean_chip(self.per_tooth(self.feed, None)));
                // Force per metre of edge [N/m] over the chip [m], and its slope by central
                // differences.
                let force = |h: f64| kc11 * 1e3 * (h * 1e3).powf(1.0 - mc) * (1.0 - self.rake / 100.0);
                let slope = (force(at * 1.00001) - force(at * 0.99999)) / (at * 2e-5);
                let (k, e) = if secant { (force(at) / at, 0.0) } else { (slope, force(at) - slope * at) };
                ([k, k * radial, k * axial], [e, e * radial, e * axial])
            }
        }
    }

    /// Mean force of all teeth over a revolution.
    pub(crate) fn mean_force(&self) -> Force {
        let ([ktc, krc, kac], [kte, kre, kae]) = self.coefficients();
        let mut force = Force { cutting: Vector3::zeros(), edge: Vector3::zeros() };
        self.sweep(|phi, kappa, _, edge, step| {
            let (sin, cos) = phi.sin_cos();
            let (out, along) = (Vector3::new(sin, cos, 0.0), Vector3::new(-cos, sin, 0.0));
            // Away from the part along the normal; along the profile a right-hand helix is pulled
            // inwards and to the tip (Engin and Altintas 2001, eq. 19).
            let normal = -(out * kappa.sin() - Vector3::z() * kappa.cos());
            let profile = -(out * kappa.cos() + Vector3::z() * kappa.sin()) * self.hand;
            let push = |[t, r, a]: [f64; 3]| along * t + normal * r + profile * a;
            let share = self.flutes * edge * step / TAU;
            force.cutting += push([ktc, krc, kac]) * (sin * kappa.sin() * share);
            force.edge += push([kte, kre, kae]) * share;
        });
        force
    }
}

/// A bar clamped in its holder.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Beam {
    /// [Pa]
    pub(crate) modulus: f64,
    /// Length, fluted length, diameter of the tool, diameter of the shank [m].
    pub(crate) lengths: [f64; 4],
}

impl Beam {
    /// Displacement [m/N] and rotation [rad/N] of the tip: the moment's curvature, summed from the
    /// holder on.
    pub(crate) fn tip(&self) -> (f64, f64) {
        let [length, fluted, tool, shank] = self.lengths;
        let border = fluted.min(length);
        let (mut way, mut turn) = (0.0, 0.0);
        for (from, to, diameter) in [(0.0, border, 0.8 * tool), (border, length, shank)] {
            let count = 2000;
            let step = (to - from) / f64::from(count);
            for k in 0..count {
                let x = from + step * (f64::from(k) + 0.5);
                let curvature = x / (self.modulus * PI * diameter.powi(4) / 64.0);
                way += curvature * x * step;
                turn += curvature * step;
            }
        }
        (way, turn)
    }
}
