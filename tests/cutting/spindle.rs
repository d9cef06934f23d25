//! Torque, power and removal rate.

use super::{CHIP, half};
use crate::common::run;
use armill::cutting::{Coefficients, Cut, Engagement};
use serde_json::json;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

#[test]
fn energy_goes_through_the_spindle() {
    for corner in [0.0, 0.002, 0.006] {
        for engagement in [Engagement::Climb(0.005), Engagement::Slot] {
            let cut = Cut { corner_radius: corner, axial_depth: 0.004, engagement, ..half() };
            let k = cut.coefficients;
            let free = Cut { coefficients: Coefficients { kte: 0.0, kre: 0.0, kae: 0.0, ..k }, ..cut };
            // Without edge forces, power over removal rate is exactly k_tc: P = torque 2 pi n, rate
            // = section N c n.
            let specific = free.torque(CHIP) * TAU / (free.section() * 4.0 * CHIP);
            // Exact on a cylinder, 1e-4 on a corner.
            assert!((specific - k.ktc).abs() < 1e-4 * k.ktc, "{specific} against {}", k.ktc);
            assert!(cut.torque(CHIP) > free.torque(CHIP));
        }
    }
    // A cylinder's section is radial times axial depth.
    assert!((Cut { engagement: Engagement::Climb(0.005), ..half() }.section() - 0.005 * 0.002).abs() < 1e-15);
    assert!((Cut { engagement: Engagement::Slot, ..half() }.section() - 0.012 * 0.002).abs() < 1e-15);
    // A ball at half immersion: half a disc.
    let ball = Cut { corner_radius: 0.006, axial_depth: 0.006, engagement: Engagement::Slot, ..half() };
    let disc = FRAC_PI_2 * 0.006 * 0.006;
    assert!((ball.section() - disc).abs() < 1e-4 * disc);
    assert!((half().mean_chip(CHIP) - CHIP * 2.0 / PI).abs() < 1e-12, "Altintas's mean over a quarter turn");
    assert_eq!(Cut { axial_depth: 0.0, ..half() }.mean_chip(CHIP), 0.0, "no cut, no chip");
}

#[test]
fn power_torque_and_removal_rate_belong_together() {
    let report = run(&[("cutting.spindle_power_kw", json!(1.5))]);
    let cut = report.summary().cut;
    // Without edge forces the specific energy is k_tc: 1800 N/mm^2 on 5 mm x 10 mm x 0.1 mm x 4 x
    // 4000 / min = 80 cm^3/min is 2.4 kW.
    assert!((cut.removal_cm3_min - 80.0).abs() < 1e-9);
    assert!((cut.power_kw - 2.4).abs() < 1e-9);
    assert!((cut.torque_nm - 2400.0 / (TAU * 4000.0 / 60.0)).abs() < 1e-9);
    assert!(report.warnings.iter().any(|warning| warning.code == "spindle-power"));
    assert!(
        !run(&[("cutting.spindle_power_kw", json!("unknown"))])
            .warnings
            .iter()
            .any(|w| w.code == "spindle-power")
    );
    let enough = run(&[("cutting.spindle_power_kw", json!(2.5))]);
    assert!(!enough.warnings.iter().any(|warning| warning.code == "spindle-power"));
}
