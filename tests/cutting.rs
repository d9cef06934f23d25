//! Cutting: golden cases, the laws of the force model, and brute-force sums as the second way.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod common;

use armill::cutting::{Bending, Coefficients, Cut, Engagement, Kienzle, material, oblique};
use common::{refused, run};
use nalgebra::Vector3;
use serde_json::{Value, json};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const DEG: f64 = PI / 180.0;

fn golden(part: &str) -> Vec<Value> {
    let text =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/golden_cutting.json"))
            .unwrap();
    let golden: Value = serde_json::from_str(&text).unwrap();
    golden[part].as_array().unwrap().clone()
}

/// The coefficients of a golden case.
fn coefficients(case: &Value) -> Coefficients {
    Coefficients::of_table(
        ["Ktc", "Krc", "Kac", "Kte", "Kre", "Kae"].map(|key| case[key].as_f64().unwrap_or(0.0)),
    )
}

/// Half immersion in aluminium with a 12 mm tool.
fn half() -> Cut {
    Cut {
        diameter: 0.012,
        flutes: 4,
        helix: 30.0 * DEG,
        corner_radius: 0.0,
        runout: 0.0,
        coefficients: Coefficients::of_table([767.01, 168.8, 222.0, 27.7, 26.6, 0.7]),
        axial_depth: 0.002,
        engagement: Engagement::Angles { entry: 90.0 * DEG, exit: 180.0 * DEG },
    }
}

/// Feed per tooth of the golden cases [m].
const CHIP: f64 = 1e-4;

/// Mean over a revolution, and the force at `phi`, of thin slices of the edge, chip by chip: the definitions, without any closed form.
fn brute(cut: &Cut, phi: f64, c: f64, slices: usize) -> Vector3<f64> {
    let (outer, corner) = (cut.diameter / 2.0, cut.corner_radius);
    let mut total = Vector3::zeros();
    let dz = cut.axial_depth / slices as f64;
    for slice in 0..slices {
        let z = (slice as f64 + 0.5) * dz;
        let (radius, sin_k) = if z < corner {
            let out = (corner * corner - (corner - z) * (corner - z)).sqrt();
            (outer - corner + out, out / corner)
        } else {
            (outer, 1.0)
        };
        let cos_k = (1.0 - sin_k * sin_k).max(0.0).sqrt();
        for tooth in 0..cut.flutes {
            let lag = 2.0 * cut.helix.tan() * z / cut.diameter;
            let angle = (phi + TAU * f64::from(tooth) / f64::from(cut.flutes) - lag).rem_euclid(TAU);
            // The part as a half plane, not as angles.
            let y = radius * angle.cos();
            let ahead = angle < PI;
            let engaged = match cut.engagement {
                Engagement::Angles { entry, exit } => angle >= entry && angle <= exit,
                Engagement::Slot => ahead,
                Engagement::Climb(depth) => ahead && y <= -(outer - depth),
                Engagement::Conventional(depth) => ahead && y >= outer - depth,
            };
            if !engaged {
                continue;
            }
            let (h, db) = (c * angle.sin() * sin_k, dz / sin_k);
            let k = &cut.coefficients;
            let (t, r, a) = ((k.ktc * h + k.kte) * db, (k.krc * h + k.kre) * db, (k.kac * h + k.kae) * db);
            let out = Vector3::new(angle.sin(), angle.cos(), 0.0);
            let along = Vector3::new(-angle.cos(), angle.sin(), 0.0);
            let normal = out * sin_k - Vector3::z() * cos_k;
            total += along * t - normal * r + (out * cos_k + Vector3::z() * sin_k) * a;
        }
    }
    total
}

fn average(cut: &Cut, c: f64, steps: usize) -> Vector3<f64> {
    let (_, forces) = cut.revolution(steps, c);
    forces[..steps].iter().sum::<Vector3<f64>>() / steps as f64
}

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
        seen += 1;
    }
    assert_eq!(seen, 3);
}

#[test]
fn golden_conversion_of_kienzle_constants() {
    let mut seen = 0;
    for case in golden("cases").iter().filter(|case| case["kind"] == "material_conversion") {
        let (inputs, expected) = (&case["inputs"], &case["expected"]);
        let (kc11, mc) = (inputs["kc11"].as_f64().unwrap(), inputs["mc"].as_f64().unwrap());
        let h0 = inputs["h0_mm"].as_f64().unwrap();
        let tangent = Kienzle::of_table(kc11, mc).linear(h0 / 1e3, 0.0);
        let close = |ours: f64, key: &str| {
            let golden = expected[key].as_f64().unwrap();
            // Seven digits are printed.
            assert!((ours - golden).abs() < 1e-6 * golden, "{key}: {ours} against {golden}");
        };
        close(tangent.ktc / 1e6, "Ktc_tangent");
        close(tangent.kte / 1e3, "Kte_tangent");
        close(tangent.ktc / 1e6 * h0 + tangent.kte / 1e3, "Fc_per_mm_width_N");
        let secant = Kienzle { secant: true, ..Kienzle::of_table(kc11, mc) }.linear(h0 / 1e3, 0.0);
        close(secant.ktc / 1e6, "kc_N_mm2");
        assert_eq!(secant.kte, 0.0);
        seen += 1;
    }
    assert_eq!(seen, 1);
    for row in golden("conversions") {
        let id = row["group"].as_str().unwrap().trim_start_matches("iscar_").to_lowercase();
        let material = material::library().iter().find(|material| material.id == id).unwrap();
        let material::Model::Kienzle(kienzle) = material.model else { panic!("{material:?}") };
        let line = kienzle.linear(row["h0_mm"].as_f64().unwrap() / 1e3, 0.0);
        for (key, ours, last) in [("Ktc", line.ktc / 1e6, 0.005), ("Kte", line.kte / 1e3, 0.0005)] {
            assert!((ours - row[key].as_f64().unwrap()).abs() < 1.01 * last, "{id} {key}: {ours}");
        }
        seen += 1;
    }
    assert_eq!(seen, 10);
    // Both lines meet the curve at h0; the tangent has its slope there (central difference), for any constants.
    for (kc11, mc, h0) in [(1500.0, 0.22, 0.02), (2110.0, 0.22, 0.1), (31.25, 0.5, 0.3)] {
        let force = |h: f64| kc11 * f64::powf(h, 1.0 - mc);
        let line = Kienzle { radial: 0.4, axial: -0.1, ..Kienzle::of_table(kc11, mc) }.linear(h0 / 1e3, 0.0);
        let (ktc, kte) = (line.ktc / 1e6, line.kte / 1e3);
        let slope = (force(h0 * 1.001) - force(h0 * 0.999)) / (0.002 * h0);
        assert!((ktc * h0 + kte - force(h0)).abs() < 1e-9 * force(h0));
        assert!((ktc - slope).abs() < 1e-6 * slope);
        assert!((line.krc / line.ktc - 0.4).abs() < 1e-12 && (line.kae / line.kte + 0.1).abs() < 1e-12);
        let raked = Kienzle::of_table(kc11, mc).linear(h0 / 1e3, 10.0 * DEG);
        assert!((raked.ktc / line.ktc - 0.9).abs() < 1e-12, "1 % a degree");
    }
}

#[test]
fn golden_oblique_cutting() {
    let mut seen = 0;
    for case in golden("cases").iter().filter(|case| case["kind"] == "orthogonal_to_oblique") {
        let (inputs, expected) = (&case["inputs"], &case["expected"]);
        let number = |key: &str| inputs[key].as_f64().unwrap();
        let k = if inputs.get("material").is_some() {
            let titanium = material::library().iter().find(|material| material.id == "ti-6al-4v").unwrap();
            let material::Model::Orthogonal(orthogonal) = titanium.model else { panic!("{titanium:?}") };
            let k = orthogonal.linear(
                number("h_mm") / 1e3,
                1.0,
                number("rake_deg") * DEG,
                number("helix_deg") * DEG,
            );
            assert_eq!([k.kte, k.kre].map(|k| (k / 1e3).round()), [24.0, 43.0]);
            k
        } else {
            let angle = |key: &str| number(key) * DEG;
            oblique::oblique(
                number("tau_s_MPa") * 1e6,
                angle("phi_c_deg"),
                angle("beta_a_deg"),
                angle("rake_n_deg"),
                angle("helix_deg"),
            )
        };
        for (key, ours) in [("Ktc", k.ktc), ("Krc", k.krc), ("Kac", k.kac)] {
            let golden = expected[key].as_f64().unwrap();
            // Six digits are printed.
            assert!((ours / 1e6 - golden).abs() < 2e-6 * golden, "{key}: {ours} against {golden}");
        }
        seen += 1;
    }
    assert_eq!(seen, 2);
    // Without helix and rake: Merchant's circle, F_c / b = tau h cos(beta - rake) / (sin(phi) cos(phi + beta - rake)).
    let (phi, beta): (f64, f64) = (0.5, 0.4);
    let k = oblique::oblique(1e8, phi, beta, 0.0, 0.0);
    assert!((k.ktc - 1e8 * beta.cos() / (phi.sin() * (phi + beta).cos())).abs() < 1e-6 * k.ktc);
    assert!(k.kac.abs() < 1e-6);
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
            // 600 slices whose lowest ones have the edge 1 / sin(kappa) long: 1.5 % of the edge force at the very tip of a ball.
            assert!((ours - mean).norm() < 0.015 * mean.norm(), "mean {ours} against {mean} of {cut:?}");
            for phi in [0.4, 1.7, 2.9, 4.4] {
                let (ours, slices) = (cut.force(phi, CHIP), brute(&cut, phi, CHIP, 20_000));
                // Whole slices of ours enter and leave the part at once where it is a plane.
                let close = 0.01 * mean.norm() + 0.01 * slices.norm();
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
    // Climb and conventional at the same depth are mirror images: the chip's share across and along the feed swaps its sign with the side.
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
    // Both halves of the tool together are a slot; half the tool's width from either side is the whole slot.
    let halves = [Engagement::Climb(0.006), Engagement::Conventional(0.006)]
        .map(|engagement| Cut { engagement, ..half() }.mean_force().at(CHIP));
    let slot = Cut { engagement: Engagement::Slot, ..half() }.mean_force().at(CHIP);
    assert!((halves[0] + halves[1] - slot).norm() < 1e-9);
    // In a slot, radial force cancels across the feed and tangential force along it.
    let slot_radial = radial_only(Cut { engagement: Engagement::Slot, ..half() });
    assert!(slot_radial.y.abs() < 1e-9);
}

#[test]
fn energy_goes_through_the_spindle() {
    for corner in [0.0, 0.002, 0.006] {
        for engagement in [Engagement::Climb(0.005), Engagement::Slot] {
            let cut = Cut { corner_radius: corner, axial_depth: 0.004, engagement, ..half() };
            let k = cut.coefficients;
            let free = Cut { coefficients: Coefficients { kte: 0.0, kre: 0.0, kae: 0.0, ..k }, ..cut };
            // Power over removal rate is k_tc exactly if there are no edge forces: P = torque 2 pi n, rate = section N c n.
            let specific = free.torque(CHIP) * TAU / (free.section() * 4.0 * CHIP);
            // Exact on a cylinder, 1e-4 on a corner.
            assert!((specific - k.ktc).abs() < 1e-4 * k.ktc, "{specific} against {}", k.ktc);
            assert!(cut.torque(CHIP) > free.torque(CHIP));
        }
    }
    // A cylinder's section is radial times axial depth.
    assert!((Cut { engagement: Engagement::Climb(0.005), ..half() }.section() - 0.005 * 0.002).abs() < 1e-15);
    assert!((Cut { engagement: Engagement::Slot, ..half() }.section() - 0.012 * 0.002).abs() < 1e-15);
    // A ball that is half in: half a disc.
    let ball = Cut { corner_radius: 0.006, axial_depth: 0.006, engagement: Engagement::Slot, ..half() };
    let disc = FRAC_PI_2 * 0.006 * 0.006;
    assert!((ball.section() - disc).abs() < 1e-4 * disc);
    assert!((half().mean_chip(CHIP) - CHIP * 2.0 / PI).abs() < 1e-12, "Altintas's mean over a quarter turn");
}

#[test]
fn runout_shifts_force_from_tooth_to_tooth() {
    let true_running = half();
    let off = Cut { runout: 5e-6, ..true_running };
    let mean = true_running.mean_force().at(CHIP);
    // While every tooth cuts all along, the differences of radius add up to nothing: but near the exit, where chips are thinner
    // than the differences, a tooth may pass without cutting, and its edge force is missing. Without edges nothing is.
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
    // So far off that one of two teeth never cuts: the other takes two chips at once, and all the power.
    let two = Cut { flutes: 2, helix: 0.0, runout: 2e-4, engagement: Engagement::Slot, ..free };
    let one = Cut { flutes: 1, runout: 0.0, ..two };
    assert!((two.force(1.0, CHIP) - one.force(1.0, 2.0 * CHIP)).norm() < 1e-9);
    assert!(two.force(1.0 + PI, CHIP).norm() < 1e-9);
    // No runout is the limit of little runout.
    let little = Cut { runout: 1e-12, ..true_running };
    let apart = (little.force(2.0, CHIP) - true_running.force(2.0, CHIP)).norm();
    assert!(apart < 0.03 * mean.norm(), "{apart}: 48 slices of the height");
}

#[test]
fn a_tool_bends_like_a_bar() {
    let (e, d, length) = (6e11, 0.01, 0.05);
    let inertia = |d: f64| PI * f64::powi(d, 4) / 64.0;
    // A round bar (no flutes): F L^3 / (3 E I) and F L^2 / (2 E I).
    let bar = Bending::of(e, length, 0.0, d, d);
    assert!((bar.displacement - length.powi(3) / (3.0 * e * inertia(d))).abs() < 1e-12 * bar.displacement);
    assert!((bar.turn - length.powi(2) / (2.0 * e * inertia(d))).abs() < 1e-12 * bar.turn);
    // Fluted all along: 0.8 of the diameter.
    let fluted = Bending::of(e, length, length, d, d);
    assert!((fluted.displacement * f64::powi(0.8, 4) / bar.displacement - 1.0).abs() < 1e-12);
    // Stepped: the curvature M / (E I) integrated from the clamp, in small pieces.
    let stepped = Bending::of(e, length, 0.02, d, 0.012);
    let n = 200_000;
    let dx = length / f64::from(n);
    let (mut slope, mut moved) = (0.0, 0.0);
    for piece in 0..n {
        let from_tip = length - (f64::from(piece) + 0.5) * dx;
        let i = inertia(if from_tip < 0.02 { 0.008 } else { 0.012 });
        slope += from_tip / (e * i) * dx;
        moved += slope * dx;
    }
    // Rectangle rule.
    assert!(
        (stepped.displacement - moved).abs() < 1e-4 * moved && (stepped.turn - slope).abs() < 1e-6 * slope
    );
    // Only what acts across the axis bends; the tip leans as it moves: a point further up moves less.
    let (moved, turned) = bar.deflection(&Vector3::z(), &Vector3::new(10.0, 0.0, 500.0));
    assert!((moved - Vector3::new(10.0 * bar.displacement, 0.0, 0.0)).norm() < 1e-15);
    let above = moved + turned.cross(&Vector3::new(0.0, 0.0, 0.01));
    assert!(above.x < moved.x && above.x > 0.0);
}

#[test]
fn both_ways_of_giving_the_engagement_are_one() {
    let force = |changes: &[(&str, Value)]| run(changes).mean_force();
    // The thesis's quarter turn of a 10 mm tool is 5 mm of climb milling.
    let climb = [("cutting.engagement", json!("climb")), ("cutting.radial_depth_mm", json!(5))];
    assert!((force(&climb) - force(&[])).norm() < 1e-9 * force(&[]).norm());
    let summary = run(&climb).summary();
    assert!((summary.cut["entry_deg"] - 90.0).abs() < 1e-9 && (summary.cut["exit_deg"] - 180.0).abs() < 1e-9);
    let summary = run(&[("cutting.entry_deg", json!(0)), ("cutting.exit_deg", json!(60))]).summary();
    assert!((summary.cut["radial_depth_mm"] - 2.5).abs() < 1e-9, "5 (1 - cos 60)");
    let up = [("cutting.engagement", json!("conventional")), ("cutting.radial_depth_mm", json!(2.5))];
    assert!((run(&up).summary().cut["exit_deg"] - 60.0).abs() < 1e-9);
    let slot = force(&[("cutting.engagement", json!("slot"))]);
    assert!((slot - force(&[("cutting.entry_deg", json!(0))])).norm() < 1e-9 * slot.norm());
}

#[test]
fn what_is_missing_or_contradicts_is_named() {
    let cases: [(&str, Value, &str, &str); 16] = [
        ("cutting.radial_depth_mm", json!(5), "missing", "cutting.engagement"),
        ("cutting.engagement", json!("climb"), "missing", "cutting.radial_depth_mm"),
        ("cutting.engagement", json!("down"), "json", "cutting.engagement"),
        ("tool.corner_radius_mm", json!(5.1), "out-of-range", "tool.corner_radius_mm"),
        ("tool.corner_radius_mm", json!("bull"), "json", "tool.corner_radius_mm"),
        ("tool.stickout_mm", json!(40), "missing", "tool.bending"),
        ("tool.bending", json!("cantilever"), "missing", "tool.stickout_mm"),
        ("tool.runout_mm", json!(-0.1), "out-of-range", "tool.runout_mm"),
        ("material", json!({"kc11_n_mm2":1500}), "missing", "material.mc"),
        ("material", json!({"mc":0.2}), "missing", "material.kc11_n_mm2"),
        ("material", json!({"kc11_n_mm2":1500,"mc":1}), "out-of-range", "material.mc"),
        ("material", json!({"kc11_n_mm2":1500,"mc":0.2,"ktc_n_mm2":1}), "invalid", "material.kc11_n_mm2"),
        ("material", json!({"preset":"p1","mc":0.2}), "invalid", "material.preset"),
        ("material", json!({"preset":"thesis","radial_ratio":0.2}), "invalid", "material.radial_ratio"),
        (
            "material",
            json!({"preset":"p1","chip_thickness_mm":0}),
            "out-of-range",
            "material.chip_thickness_mm",
        ),
        ("material", json!({"preset":"p1","line":"chord"}), "json", "material.line"),
    ];
    for (path, value, code, field) in cases {
        let error = refused(&[(path, value.clone())]);
        assert_eq!((error.code(), error.field()), (code, Some(field)), "{path} = {value}: {error}");
    }
    let deep = [("cutting.engagement", json!("climb")), ("cutting.radial_depth_mm", json!(10.5))];
    assert_eq!(refused(&deep).field(), Some("cutting.radial_depth_mm"));
    let thin = [("material", json!({"preset":"p1"})), ("cutting.feed_per_tooth_mm", json!(0.001))];
    assert_eq!(refused(&thin).field(), Some("material.chip_thickness_mm"));
}

#[test]
fn every_material_of_the_library_cuts() {
    for material in material::library() {
        let report = run(&[
            ("material", json!({ "preset": material.id })),
            ("path", json!({"kind":"line","from_mm":[600,0,100],"to_mm":[610,0,100]})),
            ("compensation.max_passes", json!(0)),
        ]);
        let summary = report.summary();
        assert_eq!(summary.material, material.name);
        assert!(
            summary.material_note.contains(material.source) && summary.material_note.contains("confidence")
        );
        assert!(report.mean_force().y > 0.0 && report.mean_force().norm() < 5e3, "{}", material.id);
        // Between wood and superalloys.
        let specific = summary.cut["power_kw"] * 6e4 / summary.cut["removal_cm3_min"];
        assert!((50.0..8000.0).contains(&specific), "{}: {specific} N/mm^2", material.id);
    }
}

#[test]
fn conversion_follows_the_mean_chip_of_the_cut() {
    let steel = |more: &[(&str, Value)]| {
        let mut changes = vec![("material", json!({"kc11_n_mm2":1500,"mc":0.22}))];
        changes.extend_from_slice(more);
        run(&changes).summary().cut
    };
    let cut = steel(&[]);
    // 0.1 mm a tooth over a quarter turn: 0.2 / pi.
    let h0 = 0.2 / PI;
    assert!((cut["made_at_chip_mm"] - h0).abs() < 1e-12);
    assert!((cut["ktc_n_mm2"] - 1500.0 * 0.78 * h0.powf(-0.22)).abs() < 1e-6);
    assert!((cut["krc_n_mm2"] / cut["ktc_n_mm2"] - 0.3).abs() < 1e-12);
    let fast = steel(&[("cutting.feed_per_tooth_mm", json!("from_feed"))]);
    assert!((fast["made_at_chip_mm"] - 3.75 * h0).abs() < 1e-12, "100 mm/s, 4000 rpm, 4 flutes");
    let raked = steel(&[("tool.rake_deg", json!(8))]);
    assert!((raked["ktc_n_mm2"] / cut["ktc_n_mm2"] - 0.92).abs() < 1e-12);
    let codes =
        |changes: &[(&str, Value)]| -> Vec<&str> { run(changes).warnings.iter().map(|w| w.code).collect() };
    assert!(codes(&[("tool.rake_deg", json!(8))]).contains(&"rake-unused"));
    assert!(codes(&[("tool.runout_mm", json!(0.01))]).contains(&"runout"));
}

#[test]
fn power_torque_and_removal_rate_belong_together() {
    let report = run(&[("cutting.spindle_power_kw", json!(1.5))]);
    let cut = report.summary().cut;
    // Without edge forces the specific energy is k_tc: 1800 N/mm^2 on 5 mm x 10 mm x 0.1 mm x 4 x 4000 / min = 80 cm^3/min is 2.4 kW.
    assert!((cut["removal_cm3_min"] - 80.0).abs() < 1e-9);
    assert!((cut["power_kw"] - 2.4).abs() < 1e-9);
    assert!((cut["torque_nm"] - 2400.0 / (TAU * 4000.0 / 60.0)).abs() < 1e-9);
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

#[test]
fn force_falls_while_the_arm_accelerates() {
    let report = run(&[
        ("cutting.feed_per_tooth_mm", json!("from_feed")),
        ("material", json!({"preset":"al-7075-t6"})),
        ("path", json!({"kind":"line","from_mm":[600,-100,100],"to_mm":[600,100,100]})),
        ("shaper", json!("none")),
    ]);
    let speed = common::column(&report, "feed_mm_s");
    let force: Vec<f64> = report.before.force.iter().map(|force| force.norm()).collect();
    let full = report.mean_force().norm();
    let mut rising = 0;
    for k in 1..report.plan.trajectory.moving / 3 {
        if speed[k] > speed[k - 1] {
            assert!(force[k] > force[k - 1], "at {} mm/s", speed[k]);
            rising += 1;
        }
    }
    assert!(rising > 400, "{rising} samples of acceleration");
    // At rest only the edges rub.
    let edge = report.plan.mean_force.edge.norm();
    assert!((force[0] - edge).abs() < 1e-9 && edge < 0.2 * full);
}

#[test]
fn the_wall_is_left_by_the_instant_that_makes_it() {
    let line = ("path", json!({"kind":"line","from_mm":[600,-20,100],"to_mm":[600,20,100]}));
    let report = run(&[line.clone(), ("shaper", json!("none"))]);
    let walls = report.walls();
    assert_eq!(walls.len(), 1, "climb milling leaves the wall on the right");
    let wall = &walls[0];
    assert_eq!(wall["side"], -1.0);
    let mean = report.mean_force();
    assert!((wall["mean_force_n"] + mean.y).abs() < 1e-9);
    // Static, with the pose hardly changing: the deviation by the mean force is the deflection's part across the feed (here x of the base).
    let across = common::column(&report, "deflection_x_mm");
    let average = across.iter().sum::<f64>() / across.len() as f64;
    // Feed along +y, so y of {T} is -x of the base, and into the part on the right is +x; the resting sample at the end counts for both.
    assert!((wall["by_mean_force_mm"] - average).abs() < 1e-9 * average.abs().max(1.0), "{wall:?} {average}");
    // Force when the edge passes 180 deg at the height z: another tooth is at 90 deg plus the lag; brute force over thin slices.
    let cut = report.setup.cut;
    let lag = 2.0 * cut.helix.tan() / cut.diameter;
    let heights = 24;
    let mut sum = 0.0;
    for k in 0..heights {
        let z = 0.010 * (f64::from(k) + 0.5) / f64::from(heights);
        sum -= brute(&cut, PI + lag * z, 1e-4, 20_000).y / f64::from(heights);
    }
    let ours = wall["instant_force_n"];
    assert!((ours - sum).abs() < 1e-3 * sum.abs(), "{ours} against {sum}");
    // With straight flutes the wall is made when the tooth that makes it no longer cuts and its next one is just entering.
    let cut = Cut { helix: 0.0, ..cut };
    let one = Cut { flutes: 2, ..cut };
    assert!(one.walls()[0].instants.iter().all(|force| force.at(1e-4).norm() < 1e-6), "nothing cuts then");
    // A part of a turn that ends on no side leaves no wall; a slot leaves two.
    let count = |entry: f64, exit: f64| {
        let engagement = Engagement::Angles { entry: entry * DEG, exit: exit * DEG };
        Cut { engagement, ..cut }.walls().len()
    };
    assert_eq!([count(30.0, 150.0), count(0.0, 150.0), count(0.0, 180.0)], [0, 1, 2]);
}

#[test]
fn a_long_tool_adds_its_own_bending() {
    let line = ("path", json!({"kind":"line","from_mm":[600,-20,100],"to_mm":[600,20,100]}));
    let rigid = run(&[line.clone(), ("shaper", json!("none"))]);
    let long = run(&[
        line,
        ("shaper", json!("none")),
        ("tool.bending", json!("cantilever")),
        ("tool.stickout_mm", json!(60)),
        ("tool.flute_length_mm", json!(30)),
    ]);
    // Tool upright: what is added is the force across the axis times the compliance.
    let bending = Bending::of(6e11, 0.06, 0.03, 0.01, 0.01);
    assert!((long.summary().cut["tool_bending_um_n"] - bending.displacement * 1e6).abs() < 1e-12);
    for k in [0, 100, 400] {
        let added = long.before.deflection[k] - rigid.before.deflection[k];
        let force = long.before.force[k];
        let expected = Vector3::new(force.x, force.y, 0.0) * bending.displacement;
        assert!((added - expected).norm() < 1e-12, "{added} against {expected}");
    }
    // The budget still adds up, and compensation copes.
    let parts = long.budget().worst_mm;
    assert!((parts.joints.iter().sum::<f64>() + parts.shaping + parts.tool - parts.total).abs() < 1e-9);
    assert!(parts.tool > 1e-3, "{parts:?}");
    assert!(long.compensation.converged);
}
