//! Milling force in the cutting frame {T} (thesis eqs. 4.1-4.7).
//!
//! {T}: x = feed direction across the tool axis, z = tool axis from tip to spindle, y = z x x. The spindle turns
//! clockwise seen from itself; the immersion angle phi counts clockwise from +y. Forces act on the tool.
//! Not modelled: runout, vibration, wear, the tool's bottom edges, deflection's own effect on the chip.

use crate::cutting::Coefficients;
use crate::math::{self, TAU};
use nalgebra::Vector3;

/// A cut: tool, material and engagement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cut {
    /// Tool diameter D [m].
    pub diameter: f64,
    /// Number of flutes N.
    pub flutes: u32,
    /// Helix angle beta [rad].
    pub helix: f64,
    /// Cutting coefficients.
    pub coefficients: Coefficients,
    /// Axial depth of cut a [m].
    pub axial_depth: f64,
    /// Immersion angle at which a tooth enters [rad].
    pub entry: f64,
    /// Immersion angle at which it leaves [rad].
    pub exit: f64,
}

/// Force averaged over a revolution, in {T}: linear in the feed per tooth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanForce {
    /// Cutting part: force for each metre of feed per tooth [N/m].
    pub cutting: Vector3<f64>,
    /// Edge part [N].
    pub edge: Vector3<f64>,
}

impl MeanForce {
    /// Mean force [N] in {T} at the feed per tooth `c` [m] (eqs. 4.6, 4.7).
    pub fn at(&self, c: f64) -> Vector3<f64> {
        self.cutting * c + self.edge
    }
}

impl Cut {
    /// Lag of the edge per height: 2 tan(beta) / D [rad/m].
    fn lag(&self) -> f64 {
        2.0 * math::tan(self.helix) / self.diameter
    }

    /// Force per height [N/m] on one edge at the immersion angle `phi`, for 1 m of feed per tooth and for the edge (eqs. 4.1-4.3).
    fn density(&self, phi: f64) -> (Vector3<f64>, Vector3<f64>) {
        let (sin, cos) = math::sin_cos(phi);
        let project = |t: f64, r: f64, a: f64| Vector3::new(-t * cos - r * sin, t * sin - r * cos, a);
        let k = &self.coefficients;
        (project(k.ktc * sin, k.krc * sin, k.kac * sin), project(k.kte, k.kre, k.kae))
    }

    /// Antiderivative of [`Cut::density`] over phi.
    fn primitive(&self, phi: f64) -> (Vector3<f64>, Vector3<f64>) {
        let (sin, cos) = math::sin_cos(phi);
        let (sin_2, cos_2) = math::sin_cos(2.0 * phi);
        // Integrals of sin cos, sin^2 and sin.
        let (mixed, square) = (-cos_2 / 4.0, phi / 2.0 - sin_2 / 4.0);
        let k = &self.coefficients;
        let cutting =
            Vector3::new(-k.ktc * mixed - k.krc * square, k.ktc * square - k.krc * mixed, -k.kac * cos);
        let edge = Vector3::new(-k.kte * sin + k.kre * cos, -k.kte * cos - k.kre * sin, k.kae * phi);
        (cutting, edge)
    }

    /// Mean force over a revolution in closed form (eqs. 4.6, 4.7); the helix does not change it.
    pub fn mean_force(&self) -> MeanForce {
        let (cutting_in, edge_in) = self.primitive(self.entry);
        let (cutting_out, edge_out) = self.primitive(self.exit);
        let scale = f64::from(self.flutes) * self.axial_depth / TAU;
        MeanForce { cutting: (cutting_out - cutting_in) * scale, edge: (edge_out - edge_in) * scale }
    }

    /// Force [N] in {T} at the instant when the first tooth's tip is at the immersion angle `phi`, for the feed per tooth `c` [m].
    ///
    /// All teeth and the whole height add up (eq. 4.4), integrated over the height in closed form.
    pub fn force(&self, phi: f64, c: f64) -> Vector3<f64> {
        let pitch = TAU / f64::from(self.flutes);
        let swept = self.lag() * self.axial_depth;
        let mut total = Vector3::zeros();
        for tooth in 0..self.flutes {
            let tip = phi + pitch * f64::from(tooth);
            let tip = tip - TAU * (tip / TAU).floor();
            if swept < 1e-9 {
                if tip >= self.entry && tip <= self.exit {
                    let (cutting, edge) = self.density(tip);
                    total += (cutting * c + edge) * self.axial_depth;
                }
                continue;
            }
            // The edge covers the angles from tip - swept to tip; count each turn of the engagement that it meets.
            let mut turn = 0.0;
            while self.exit - turn * TAU > tip - swept {
                let from = (self.entry - turn * TAU).max(tip - swept);
                let to = (self.exit - turn * TAU).min(tip);
                if to > from {
                    let (cutting_in, edge_in) = self.primitive(from);
                    let (cutting_out, edge_out) = self.primitive(to);
                    total += ((cutting_out - cutting_in) * c + (edge_out - edge_in)) / self.lag();
                }
                turn += 1.0;
            }
        }
        total
    }

    /// Force over one revolution in `steps` even steps of the immersion angle (Fig. 4.2): angles [rad] and forces [N] in {T}.
    pub fn revolution(&self, steps: usize, c: f64) -> (Vec<f64>, Vec<Vector3<f64>>) {
        let angle = |step: usize| TAU * step as f64 / steps as f64;
        (0..=steps).map(|step| (angle(step), self.force(angle(step), c))).unzip()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::{DEG, MM, N_PER_MM, N_PER_MM2};

    /// golden.json: millforce_al7075_half_down, millforce_al7075_slot, millforce_al6061_slot_zero_edge.
    fn golden() -> [(Cut, [f64; 3], [f64; 7]); 3] {
        let al7075 = Coefficients {
            ktc: 767.01 * N_PER_MM2,
            krc: 168.8 * N_PER_MM2,
            kac: 222.0 * N_PER_MM2,
            kte: 27.7 * N_PER_MM,
            kre: 26.6 * N_PER_MM,
            kae: 0.7 * N_PER_MM,
        };
        let half = Cut {
            diameter: 12.0 * MM,
            flutes: 4,
            helix: 30.0 * DEG,
            coefficients: al7075,
            axial_depth: 2.0 * MM,
            entry: 90.0 * DEG,
            exit: 180.0 * DEG,
        };
        let slot = Cut { entry: 0.0, ..half };
        let al6061 = Coefficients {
            ktc: 796.0 * N_PER_MM2,
            krc: 168.0 * N_PER_MM2,
            kac: 80.0 * N_PER_MM2,
            ..Coefficients::default()
        };
        let straight = Cut {
            diameter: 10.0 * MM,
            flutes: 2,
            helix: 0.0,
            coefficients: al6061,
            axial_depth: 1.0 * MM,
            entry: 0.0,
            exit: 180.0 * DEG,
        };
        [
            (half, [33.34994, 156.58405, 29.66592], [-66.07, 79.98, 63.28, 218.42, 0.0, 45.52, 224.88]),
            (slot, [-101.49634, 223.93947, 59.33184], [-141.46, -41.99, 166.14, 261.54, 0.0, 65.49, 265.53]),
            (straight, [-8.4, 39.8, 5.09296], [-49.08, 32.28, -0.88, 80.48, 0.0, 8.0, 81.35]),
        ]
    }

    #[test]
    fn mean_and_peaks_of_the_golden_cuts() {
        for (cut, mean, [x_min, x_max, y_min, y_max, _, z_max, xy_max]) in golden() {
            // Five decimals are printed; 1e-4 is the record's own tolerance.
            assert!((cut.mean_force().at(0.1 * MM) - Vector3::from(mean)).norm() < 1e-4, "mean of {cut:?}");
            let (_, forces) = cut.revolution(3600, 0.1 * MM);
            let least = |f: fn(&Vector3<f64>) -> f64| forces.iter().map(f).fold(f64::INFINITY, f64::min);
            let most = |f: fn(&Vector3<f64>) -> f64| forces.iter().map(f).fold(f64::NEG_INFINITY, f64::max);
            for (ours, golden) in [
                (least(|f| f.x), x_min),
                (most(|f| f.x), x_max),
                (least(|f| f.y), y_min),
                (most(|f| f.y), y_max),
                (most(|f| f.z), z_max),
                (most(|f| f.xy().norm()), xy_max),
            ] {
                // The record was made with 400 slices: 0.5 % of the largest force.
                assert!((ours - golden).abs() < 0.005 * xy_max, "{ours} against {golden}");
            }
        }
    }

    #[test]
    fn the_mean_is_the_average_over_a_revolution() {
        let (mut cut, ..) = golden()[0];
        for (flutes, helix, depth, entry, exit) in [
            (4, 30.0, 2.0, 90.0, 180.0),
            (3, 45.0, 20.0, 20.0, 110.0),
            (1, 10.0, 5.0, 0.0, 60.0),
            (5, 60.0, 60.0, 0.0, 180.0),
        ] {
            cut.flutes = flutes;
            cut.helix = helix * DEG;
            cut.axial_depth = depth * MM;
            (cut.entry, cut.exit) = (entry * DEG, exit * DEG);
            let steps = 36_000;
            let (_, forces) = cut.revolution(steps, 0.1 * MM);
            let average = forces[..steps].iter().sum::<Vector3<f64>>() / steps as f64;
            let mean = cut.mean_force().at(0.1 * MM);
            // Rectangle rule on a force with kinks: error of second order in the step.
            assert!((average - mean).norm() < 1e-5 * mean.norm(), "{average} against {mean}");
        }
    }

    #[test]
    fn the_closed_form_over_the_height_equals_thin_slices() {
        let (cut, ..) = golden()[0];
        for phi in [0.3, 1.7, 2.9, 4.0, 6.0] {
            let slices = 40_000;
            let dz = cut.axial_depth / f64::from(slices);
            let mut sum = Vector3::zeros();
            for tooth in 0..cut.flutes {
                for slice in 0..slices {
                    let z = (f64::from(slice) + 0.5) * dz;
                    let angle = phi + TAU * f64::from(tooth) / f64::from(cut.flutes) - cut.lag() * z;
                    let angle = angle.rem_euclid(TAU);
                    if angle >= cut.entry && angle <= cut.exit {
                        let (cutting, edge) = cut.density(angle);
                        sum += (cutting * 0.1 * MM + edge) * dz;
                    }
                }
            }
            // One slice more or less at entry and exit.
            assert!((sum - cut.force(phi, 0.1 * MM)).norm() < 1e-3 * sum.norm().max(1.0), "at {phi}");
        }
    }
}
