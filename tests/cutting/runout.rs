//! Radial runout of the teeth.

use super::{CHIP, average, half};
use crate::common::between;
use armill::cutting::{Coefficients, Cut, Engagement};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

#[test]
fn runout_shifts_force_from_tooth_to_tooth() {
    let true_running = half();
    let off = Cut { runout: 5e-6, ..true_running };
    let mean = true_running.mean_force().at(CHIP);
    // While every tooth cuts throughout, the radius differences sum to zero. Near the exit, where
    // chips are thinner than the differences, a tooth may pass without cutting, so its edge force
    // is missing. Without edge forces nothing is missing.
    let k = true_running.coefficients;
    let free = Cut { coefficients: Coefficients { kte: 0.0, kre: 0.0, kae: 0.0, ..k }, ..off };
    let expected = free.mean_force().at(CHIP);
    let error = (average(&free, CHIP, 3600) - expected).norm() / expected.norm();
    assert!(error < 3e-3, "the mean moves by {error}");
    let error = (average(&off, CHIP, 3600) - mean).norm() / mean.norm();
    assert!(error < 0.03, "with edges by {error}");
    assert!(off.peak_force(CHIP) > 1.03 * true_running.peak_force(CHIP));
    let pitch = FRAC_PI_2;
    let period = |cut: &Cut| (cut.force(2.0, CHIP) - cut.force(2.0 + pitch, CHIP)).norm();
    assert!(period(&true_running) < 1e-9 && period(&off) > 1.0, "teeth are no longer alike");
    // With so much runout that one of two teeth never cuts, the other takes both chips and all the
    // power.
    let two = Cut { flutes: 2, helix: 0.0, runout: 2e-4, engagement: Engagement::Slot, ..free };
    let one = Cut { flutes: 1, runout: 0.0, ..two };
    assert!((two.force(1.0, CHIP) - one.force(1.0, 2.0 * CHIP)).norm() < 1e-9);
    assert!(two.force(1.0 + PI, CHIP).norm() < 1e-9);
    // Zero runout is the limit of small runout.
    let little = Cut { runout: 1e-12, ..true_running };
    let apart = (little.force(2.0, CHIP) - true_running.force(2.0, CHIP)).norm();
    assert!(apart < 0.03 * mean.norm(), "{apart}: 48 slices of the height");
}

/// The force at `phi` from the wall itself: in every direction the wall stands where the last tooth
/// left it, and the feed brings it nearer between teeth.
pub(crate) fn by_the_wall(
    cut: &Cut,
    (entry, exit): (f64, f64),
    phi: f64,
    c: f64,
    slices: u32,
) -> Vector3<f64> {
    let mut total = Vector3::zeros();
    let dz = cut.axial_depth / f64::from(slices);
    let pitch = TAU / f64::from(cut.flutes);
    for slice in 0..slices {
        let lag = 2.0 * cut.helix.tan() / cut.diameter * (f64::from(slice) + 0.5) * dz;
        for tooth in 0..cut.flutes {
            let angle = (phi + pitch * f64::from(tooth) - lag).rem_euclid(TAU);
            if angle < entry || angle > exit {
                continue;
            }
            // Distances from the axis, less the radius. Clockwise, the next tooth passes first.
            let off = |tooth: u32| cut.runout * (pitch * f64::from(tooth) - lag).cos();
            let (mut wall, mut chip) = (-1.0, 0.0);
            for passing in (tooth..=tooth + 4 * cut.flutes).rev() {
                wall -= c * angle.sin();
                chip = off(passing) - wall;
                wall = f64::max(wall, off(passing));
            }
            if chip <= 0.0 {
                continue;
            }
            let k = &cut.coefficients;
            let out = Vector3::new(angle.sin(), angle.cos(), 0.0);
            let along = Vector3::new(-angle.cos(), angle.sin(), 0.0);
            total += along * ((k.ktc * chip + k.kte) * dz) - out * ((k.krc * chip + k.kre) * dz);
            total.z -= (k.kac * chip + k.kae) * dz;
        }
    }
    total
}

#[test]
fn teeth_with_runout_cut_what_those_before_them_left() {
    let mut random = fastrand::Rng::with_seed(61);
    for _ in 0..400 {
        let (entry, exit) = (between(&mut random, 0.0, 1.5), between(&mut random, 1.6, PI));
        let cut = Cut {
            flutes: random.u32(1..7),
            helix: between(&mut random, 0.0, 0.9),
            runout: between(&mut random, 0.0, 6e-5).max(1e-9),
            axial_depth: between(&mut random, 1e-3, 1e-2),
            engagement: Engagement::Angles { entry, exit },
            ..half()
        };
        let (phi, c) = (between(&mut random, 0.0, TAU), between(&mut random, 5e-6, 1.5e-4));
        let (ours, wall) = (cut.force(phi, c), by_the_wall(&cut, (entry, exit), phi, c, 48));
        // As many slices as Armill uses for one instant.
        // Rounding of sums of some hundred products, of forces up to 1 kN.
        assert!((ours - wall).norm() < 1e-9, "{cut:?} at {phi}, {c}: {ours} and {wall}");
    }
}
