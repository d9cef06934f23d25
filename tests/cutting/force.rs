//! Mean and instantaneous force: golden cases, laws, and thin slices as an independent computation.

use crate::common::{column, run};
use crate::{CHIP, DEG, average, brute, coefficients, golden, half};
use armill::cutting::{Coefficients, Cut, Engagement};
use nalgebra::Vector3;
use serde_json::json;
use std::f64::consts::{PI, TAU};

#[test]
fn golden_forces_and_torques() {
    let mut seen = 0;
    for case in golden("cases").iter().filter(|case| case["kind"] == "milling_mean_and_peak_force") {
        let (inputs, expected) = (&case["inputs"], &case["expected"]);
        let number = |key: &str| inputs[key].as_f64().unwrap();
        let cut = Cut {
            diameter: number("D_mm") / 1e3,
            flutes: number("N") as u32,
            helix: number("helix_deg") * DEG,
            coefficients: coefficients(inputs),
            axial_depth: number("axial_depth_mm") / 1e3,
            engagement: Engagement::Angles {
                entry: number("phi_st_deg") * DEG,
                exit: number("phi_ex_deg") * DEG,
            },
            ..half()
        };
        let c = number("feed_per_tooth_mm") / 1e3;
        let mean = cut.mean_force().at(c);
        let peaks = &expected["peaks_numeric_N"];
        for axis in 0..3 {
            // Five decimals are printed; 1e-4 is the record's own tolerance.
            assert!((mean[axis] - expected["mean_Fx_Fy_Fz_N"][axis].as_f64().unwrap()).abs() < 1e-4);
        }
        assert!((cut.torque(c) - peaks["torque_mean_Nm"].as_f64().unwrap()).abs() < 5.1e-5, "four decimals");
        let (_, forces) = cut.revolution(3600, c);
        let least = |f: fn(&Vector3<f64>) -> f64| forces.iter().map(f).fold(f64::INFINITY, f64::min);
        let most = |f: fn(&Vector3<f64>) -> f64| forces.iter().map(f).fold(f64::NEG_INFINITY, f64::max);
        let largest = peaks["F_res_xy_max"].as_f64().unwrap();
        for (key, ours) in [
            ("Fx_min", least(|f| f.x)),
            ("Fx_max", most(|f| f.x)),
            ("Fy_min", least(|f| f.y)),
            ("Fy_max", most(|f| f.y)),
            ("Fz_max", most(|f| f.z)),
            ("F_res_xy_max", most(|f| f.xy().norm())),
        ] {
            // The record was made with 400 slices: 0.5 % of the largest force.
            let golden = peaks[key].as_f64().unwrap();
            assert!((ours - golden).abs() < 0.005 * largest, "{key}: {ours} against {golden}");
        }
        // The largest force lies in the plane of the feed, with some axial force on top.
        let (peak, above) = (cut.peak_force(c), peaks["Fz_max"].as_f64().unwrap());
        assert!((0.995 * largest..1.005 * f64::hypot(largest, above)).contains(&peak), "{peak} N");
        seen += 1;
    }
    assert_eq!(seen, 3);
}

#[test]
fn the_mean_is_the_average_over_a_revolution() {
    for (flutes, helix, depth, entry, exit) in [
        (4, 30.0, 2.0, 90.0, 180.0),
        (3, 45.0, 20.0, 20.0, 110.0),
        (1, 10.0, 5.0, 0.0, 60.0),
        (5, 60.0, 60.0, 0.0, 180.0),
    ] {
        let cut = Cut {
            flutes,
            helix: helix * DEG,
            axial_depth: depth / 1e3,
            engagement: Engagement::Angles { entry: entry * DEG, exit: exit * DEG },
            ..half()
        };
        let mean = cut.mean_force().at(CHIP);
        // Rectangle rule on a force with kinks: error of second order in the step.
        assert!((average(&cut, CHIP, 36_000) - mean).norm() < 1e-5 * mean.norm(), "{cut:?}");
    }
}

#[test]
fn every_shape_of_tool_equals_thin_slices() {
    let engagements = [
        Engagement::Climb(0.003),
        Engagement::Conventional(0.0095),
        Engagement::Slot,
        Engagement::Angles { entry: 30.0 * DEG, exit: 130.0 * DEG },
    ];
    for engagement in engagements {
        for (corner, depth) in [(0.0, 0.002), (0.002, 0.005), (0.006, 0.003), (0.006, 0.010)] {
            let cut = Cut { corner_radius: corner, axial_depth: depth, engagement, ..half() };
            let steps = 720;
            let mut mean = Vector3::zeros();
            for step in 0..steps {
                let phi = TAU * (f64::from(step) + 0.5) / f64::from(steps);
                mean += brute(&cut, phi, CHIP, 600) / f64::from(steps);
            }
            let ours = cut.mean_force().at(CHIP);
            // 600 slices, the lowest with an edge 1 / sin(kappa) long: 1.5 % of the edge force at
            // the very tip of a ball.
            assert!((ours - mean).norm() < 0.015 * mean.norm(), "mean {ours} against {mean} of {cut:?}");
            let straight = Cut { helix: 0.0, ..cut };
            for (cut, phi) in
                [cut, straight].into_iter().flat_map(|cut| [0.4, 1.7, 2.9, 4.4].map(|phi| (cut, phi)))
            {
                let (ours, slices) = (cut.force(phi, CHIP), brute(&cut, phi, CHIP, 20_000));
                // Our slices enter and leave a plane part as a whole; a cylinder's angles are in
                // closed form.
                let share = if corner > 0.0 { 0.01 } else { 1e-4 };
                let close = share * (mean.norm() + slices.norm());
                assert!((ours - slices).norm() < close, "{ours} against {slices} at {phi} of {cut:?}");
            }
        }
    }
}

#[test]
fn a_corner_that_vanishes_leaves_a_flat_end_mill() {
    for engagement in [Engagement::Climb(0.004), Engagement::Slot] {
        let flat = Cut { engagement, ..half() };
        let mean = flat.mean_force().at(CHIP);
        let away = |corner: f64| {
            let nearly = Cut { corner_radius: corner, ..flat };
            (nearly.mean_force().at(CHIP) - mean).norm() / mean.norm()
        };
        // The corner changes the force in proportion to its height.
        assert!(away(2e-5) < 0.02 && away(2e-7) < 2e-4 && away(2e-9) < 2e-6);
        if let Engagement::Climb(_) = engagement {
            let angle = PI - (1.0 - 2.0 * 0.004 / 0.012_f64).acos();
            let by_angles = Cut { engagement: Engagement::Angles { entry: angle, exit: PI }, ..flat };
            assert!((by_angles.mean_force().at(CHIP) - mean).norm() < 1e-9 * mean.norm());
        }
    }
}

#[test]
fn means_over_a_corner_keep_their_tolerance() {
    // 256 slices against 20,000 of the definition over the corner of a ball, in a slot.
    let ball = Cut { corner_radius: 0.006, axial_depth: 0.004, engagement: Engagement::Slot, ..half() };
    let k = &ball.coefficients;
    let high = (1.0 - 0.004 / 0.006_f64).acos();
    let n = 20_000;
    let mut fz = 0.0;
    for step in 0..n {
        let kappa = high * (f64::from(step) + 0.5) / f64::from(n);
        let (sin, cos) = kappa.sin_cos();
        let ds = 0.006 * high / f64::from(n);
        // Slot: the integral of sin over half a turn is 2, of 1 is pi.
        fz += ((k.kac * sin + k.krc * cos) * CHIP * 2.0 * sin + (k.kae * sin + k.kre * cos) * PI) * ds;
    }
    let fz = fz * 4.0 / TAU;
    let ours = ball.mean_force().at(CHIP).z;
    assert!((ours - fz).abs() < 1e-4 * fz, "{ours} against {fz}");
}

#[test]
fn the_force_is_linear_in_the_chip_and_edges_add() {
    for corner in [0.0, 0.003] {
        let cut = Cut { corner_radius: corner, axial_depth: 0.004, ..half() };
        let k = cut.coefficients;
        let no_edge = Cut { coefficients: Coefficients { kte: 0.0, kre: 0.0, kae: 0.0, ..k }, ..cut };
        let only_edge = Cut { coefficients: Coefficients { ktc: 0.0, krc: 0.0, kac: 0.0, ..k }, ..cut };
        for phi in [0.3, 2.0, 2.8] {
            let sum = no_edge.force(phi, CHIP) + only_edge.force(phi, CHIP);
            assert!((cut.force(phi, CHIP) - sum).norm() < 1e-9);
            assert!((no_edge.force(phi, 3.0 * CHIP) - no_edge.force(phi, CHIP) * 3.0).norm() < 1e-9);
        }
        let mean = cut.mean_force();
        assert!((mean.at(0.0) - only_edge.mean_force().at(CHIP)).norm() < 1e-9);
    }
}

#[test]
fn slots_and_sides_are_mirrors() {
    // Climb and conventional milling at the same depth are mirror images: the components across and
    // along the feed swap sign with the side.
    let (climb, conventional) = (
        Cut { engagement: Engagement::Climb(0.004), ..half() },
        Cut { engagement: Engagement::Conventional(0.004), ..half() },
    );
    let (a, b) = (climb.mean_force(), conventional.mean_force());
    let k = half().coefficients;
    let radial_only = |cut: Cut| {
        let coefficients = Coefficients { ktc: 0.0, kte: 0.0, ..k };
        Cut { coefficients, ..cut }.mean_force().at(CHIP)
    };
    let (r, s) = (radial_only(climb), radial_only(conventional));
    assert!((r.x - s.x).abs() < 1e-9 && (r.y + s.y).abs() < 1e-9 && (r.z - s.z).abs() < 1e-9);
    assert!((a.cutting.z - b.cutting.z).abs() < 1e-6);
    assert!((climb.torque(CHIP) - conventional.torque(CHIP)).abs() < 1e-9);
    // The two halves of the tool add up to a slot; half the tool's width from either side is the
    // whole slot.
    let halves = [Engagement::Climb(0.006), Engagement::Conventional(0.006)]
        .map(|engagement| Cut { engagement, ..half() }.mean_force().at(CHIP));
    let slot = Cut { engagement: Engagement::Slot, ..half() }.mean_force().at(CHIP);
    assert!((halves[0] + halves[1] - slot).norm() < 1e-9);
    // In a slot, radial force cancels across the feed and tangential force along it.
    let slot_radial = radial_only(Cut { engagement: Engagement::Slot, ..half() });
    assert!(slot_radial.y.abs() < 1e-9);
}

#[test]
fn force_falls_while_the_arm_accelerates() {
    let report = run(&[
        ("cutting.feed_per_tooth_mm", json!("from_feed")),
        ("material", json!({"preset":"al-7075-t6"})),
        ("path", json!({"kind":"line","from_mm":[600,-100,100],"to_mm":[600,100,100]})),
        ("shaper", json!("none")),
    ]);
    let speed = column(&report, "feed_mm_s");
    let force: Vec<f64> = report.force.iter().map(|force| force.norm()).collect();
    let full = report.mean_force().norm();
    let mut rising = 0;
    for k in 1..report.plan.trajectory.moving / 3 {
        if speed[k] > speed[k - 1] {
            assert!(force[k] > force[k - 1], "at {} mm/s", speed[k]);
            rising += 1;
        }
    }
    assert!(rising > 400, "{rising} samples of acceleration");
    // At rest only the edge force remains.
    let edge = report.setup().mean_force.edge.norm();
    assert!((force[0] - edge).abs() < 1e-9 && edge < 0.2 * full);
}

#[test]
fn means_keep_their_tolerance_where_a_corner_only_just_reaches_the_part() {
    // Against the definition where the engagement starts half way up a ball, and where a bull nose
    // cuts deeper than its corner.
    for (corner, radial, axial) in
        [(0.006, 0.0004, 0.006), (0.006, 0.00002, 0.006), (0.006, 0.002, 0.004), (0.002, 0.0005, 0.005)]
    {
        let cut = Cut {
            corner_radius: corner,
            axial_depth: axial,
            engagement: Engagement::Climb(radial),
            ..half()
        };
        let (outer, k) = (0.006, &cut.coefficients);
        let mut expected = Vector3::zeros();
        let mut add = |radius: f64, sin_k: f64, cos_k: f64, edge: f64| {
            // Entry where the edge crosses the part's plane; integrals over the immersion by hand.
            let share = (outer - radial) / radius;
            if share >= 1.0 {
                return;
            }
            let entry = PI - share.acos();
            let (s, c) = entry.sin_cos();
            let (sin, cos, mixed, square) = (1.0 + c, -s, -s * s / 2.0, (PI - entry) / 2.0 + s * c / 2.0);
            let radial_force = |chip: f64, whole: f64| {
                (k.krc * chip + k.kre * whole) * sin_k - (k.kac * chip + k.kae * whole) * cos_k
            };
            let axial_force = |chip: f64, whole: f64| {
                (k.kac * chip + k.kae * whole) * sin_k + (k.krc * chip + k.kre * whole) * cos_k
            };
            let h = CHIP * sin_k;
            let tangential = |chip: f64, whole: f64| k.ktc * chip + k.kte * whole;
            expected.x += (-tangential(h * mixed, cos) - radial_force(h * square, sin)) * edge;
            expected.y += (tangential(h * square, sin) - radial_force(h * mixed, cos)) * edge;
            expected.z += axial_force(h * sin, PI - entry) * edge;
        };
        let high = (1.0 - f64::min(axial / corner, 1.0)).acos();
        let n = 400_000;
        for step in 0..n {
            let (sin, cos) = (high * (f64::from(step) + 0.5) / f64::from(n)).sin_cos();
            add(outer - corner + corner * sin, sin, cos, corner * high / f64::from(n));
        }
        if axial > corner {
            add(outer, 1.0, 0.0, axial - corner);
        }
        let expected = expected * f64::from(cut.flutes) / TAU;
        let ours = cut.mean_force().at(CHIP);
        assert!((ours - expected).norm() < 1e-4 * expected.norm(), "{ours} against {expected}");
    }
}
