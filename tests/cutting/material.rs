//! Coefficients: specific cutting force, orthogonal data, the library.

use super::{DEG, golden};
use crate::common::{between, run};
use armill::cutting::{Kienzle, material, oblique};
use nalgebra::Vector3;
use serde_json::{Value, json};
use std::f64::consts::PI;

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
    // Both lines meet the curve at h0; the tangent has its slope there (central difference), for
    // any constants.
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
    // Without helix and rake: Merchant's circle, F_c / b = tau h cos(beta - rake) / (sin(phi)
    // cos(phi + beta - rake)).
    let (phi, beta): (f64, f64) = (0.5, 0.4);
    let k = oblique::oblique(1e8, phi, beta, 0.0, 0.0);
    assert!((k.ktc - 1e8 * beta.cos() / (phi.sin() * (phi + beta).cos())).abs() < 1e-6 * k.ktc);
    assert!(k.kac.abs() < 1e-6);
}

#[test]
fn every_material_of_the_library_cuts() {
    for (id, word) in [("thesis", "milling"), ("p1", "k_c1.1"), ("ti-6al-4v", "Orthogonal")] {
        let material = material::library().iter().find(|material| material.id == id).unwrap();
        assert!(material.model.heading().contains(word), "{id} under {}", material.model.heading());
    }
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
        let specific = summary.cut.power_kw * 6e4 / summary.cut.removal_cm3_min;
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
    // 0.1 mm per tooth over a quarter turn: 0.2 / pi.
    let h0 = 0.2 / PI;
    assert!((cut.made_at_chip_mm.unwrap() - h0).abs() < 1e-12);
    assert!((cut.ktc_n_mm2 - 1500.0 * 0.78 * h0.powf(-0.22)).abs() < 1e-6);
    assert!((cut.krc_n_mm2 / cut.ktc_n_mm2 - 0.3).abs() < 1e-12);
    let fast = steel(&[("cutting.feed_per_tooth_mm", json!("from_feed"))]);
    assert!((fast.made_at_chip_mm.unwrap() - 3.75 * h0).abs() < 1e-12, "100 mm/s, 4000 rpm, 4 flutes");
    let raked = steel(&[("tool.rake_deg", json!(8))]);
    assert!((raked.ktc_n_mm2 / cut.ktc_n_mm2 - 0.92).abs() < 1e-12);
    let codes =
        |changes: &[(&str, Value)]| -> Vec<&str> { run(changes).warnings.iter().map(|w| w.code).collect() };
    assert!(codes(&[("tool.rake_deg", json!(8))]).contains(&"rake-unused"));
    assert!(codes(&[("tool.runout_mm", json!(0.01))]).contains(&"runout"));
}

#[test]
fn orthogonal_data_follow_chip_speed_and_rake_as_their_table_says() {
    // Shear stress [N/mm^2] and friction angle [deg]; shear angle [deg] by its own line, or 0 and
    // the chip's ratio; edges [N/mm].
    let (stress, friction) = ([500.0, 2.0], [20.0, -30.0, 0.04, 0.3]);
    let (shear, ratio, edge) = ([25.0, 40.0, 0.02, 0.5], [0.7, 0.004, 0.2, 0.003], [20.0, 30.0]);
    for by_line in [true, false] {
        let shear = if by_line { shear } else { [0.0; 4] };
        let orthogonal = oblique::Orthogonal {
            numbers: [&stress[..], &friction, &shear, &ratio, &edge].concat().try_into().unwrap(),
        };
        for (h, v, rake, helix) in [
            (0.05, 60.0, 0.0, 30.0),
            (0.2, 60.0, 8.0, 30.0),
            (0.05, 200.0, 8.0, 0.0),
            (0.1, 120.0, -4.0, 40.0),
        ] {
            let line = |[at, by_h, by_v, by_rake]: [f64; 4]| at + by_h * h + by_v * v + by_rake * rake;
            let angle = if by_line {
                line(shear) * DEG
            } else {
                // Merchant's construction: the chip's thickness ratio and the rake give the shear
                // angle.
                let r = (ratio[0] + ratio[1] * rake) * f64::powf(h, ratio[2] + ratio[3] * rake);
                (r * (rake * DEG).cos() / (1.0 - r * (rake * DEG).sin())).atan()
            };
            let stress = (stress[0] + stress[1] * rake) * 1e6;
            let expected = oblique::oblique(stress, angle, line(friction) * DEG, rake * DEG, helix * DEG);
            let ours = orthogonal.linear(h * 1e-3, v / 60.0, rake * DEG, helix * DEG);
            for (ours, expected) in
                [(ours.ktc, expected.ktc), (ours.krc, expected.krc), (ours.kac, expected.kac)]
            {
                assert!(
                    (ours - expected).abs() < 1e-9 * stress,
                    "{h} mm, {v} m/min, {rake} deg: {ours} against {expected}"
                );
            }
            assert_eq!([ours.kte, ours.kre, ours.kae], [edge[0] * 1e3, edge[1] * 1e3, 0.0]);
        }
    }
}

#[test]
fn an_oblique_edge_pulls_a_right_hand_tool_out_of_its_holder() {
    // Pressure on the rake face and friction along the chip, as vectors at the tooth of a right-hand
    // helix: v where it moves, out away from the tool's axis, z from tip to spindle.
    let mut random = fastrand::Rng::with_seed(204);
    let (v, out, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    for _ in 0..200 {
        let [helix, rake, friction, shear] = [(0.0, 55.0), (-15.0, 25.0), (5.0, 45.0), (15.0, 40.0)]
            .map(|(a, b)| between(&mut random, a, b) * DEG);
        // Above the tip the edge lags behind it.
        let edge = z * helix.cos() - v * helix.sin();
        let forward = v * helix.cos() + z * helix.sin();
        let face = forward * rake.cos() - out * rake.sin();
        // The chip flows inwards, and along the edge as the material comes (Stabler).
        let inwards = -out * rake.cos() - forward * rake.sin();
        let chip = inwards * helix.cos() + edge * helix.sin();
        let force = chip * friction.tan() - face;
        let ours = oblique::oblique(6e8, shear, friction, rake, helix);
        let scale = -force.dot(&v) / ours.ktc;
        for (ours, along) in [(ours.krc, -out), (ours.kac, -z)] {
            let share = force.dot(&along) / scale;
            assert!((ours - share).abs() < 1e-12 * 1e10, "{ours} against {share}");
        }
    }
}
