//! Laws that hold for any numbers: scaling, symmetry, limits, convergence.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]

use crate::common::{self, between, column, run};
use armill::motion::shaper::{self, Shaper};
use armill::robot::Joints;
use nalgebra::Vector3;
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

/// A short job within the arm's reach.
fn arc(changes: &[(&str, Value)]) -> armill::Report {
    let path = json!({"kind":"arc","center_mm":[600,0,100],"radius_mm":120,"normal":[0.1,0.2,1],"start_deg":-60,"sweep_deg":150});
    let mut all = vec![("path", path)];
    all.extend(changes.iter().cloned());
    run(&all)
}

fn greatest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn twice_the_force_twice_the_deflection() {
    let once = arc(&[]);
    let twice = arc(&[("cutting.axial_depth_mm", json!(20))]);
    for (a, b) in once.deflection.iter().zip(&twice.deflection) {
        assert!((b - a * 2.0).norm() < 1e-15);
    }
}

#[test]
fn a_rigid_arm_does_not_deflect() {
    let report =
        arc(&[("robot", json!({"preset":"staubli-rx90","joint_compliance_rad_per_nm":[0,0,0,0,0,0]}))]);
    assert!(report.deflection.iter().all(|d| d.norm() == 0.0));
    // The rest is the closure error of the inverse model.
    assert!(report.summary().before_mm.deflection.max < 1e-6);
}

#[test]
fn no_depth_no_force_no_shaper_no_error() {
    let report = arc(&[("cutting.axial_depth_mm", json!(0)), ("shaper", json!("none"))]);
    assert_eq!(report.summary().cut.power_kw.to_bits(), 0.0_f64.to_bits(), "no power, and not -0");
    assert!(report.summary().before_mm.both.max < 1e-6);
    assert!(report.summary().passes == 0 && report.summary().converged);
    let left = arc(&[("compensation.max_passes", json!(0))]).summary();
    assert!(left.after_mm == left.before_mm.both && !left.converged, "no pass, and not within the tolerance");
}

#[test]
fn amplitudes_add_up_to_one_and_times_ascend() {
    let mut random = fastrand::Rng::with_seed(11);
    for kind in &shaper::TYPES {
        for _ in 0..500 {
            let damping = between(&mut random, 0.0, kind.damping_max);
            let shaper = Shaper::new(kind, between(&mut random, 0.5, 500.0), damping);
            let sum: f64 = shaper.impulses().iter().map(|impulse| impulse.amplitude).sum();
            assert!((sum - 1.0).abs() < 1e-14, "{}: {sum}", kind.id);
            assert!(shaper.impulses().windows(2).all(|pair| pair[0].time < pair[1].time));
            assert!(
                shaper.impulses().iter().all(|impulse| impulse.amplitude > 0.0),
                "{} at {damping}",
                kind.id
            );
        }
    }
}

#[test]
fn published_shapers() {
    let all: Value = serde_json::from_str(include_str!("data/golden.json")).unwrap();
    let mut count = 0;
    for case in all["cases"].as_array().unwrap().iter().filter(|case| case["kind"] == "input_shaper") {
        let inputs = &case["inputs"];
        let kind = shaper::kind(inputs["type"].as_str().unwrap()).unwrap();
        let frequency = inputs["frequency_Hz"].as_f64().or(inputs["frequency_hz"].as_f64()).unwrap();
        let shaper = Shaper::new(kind, frequency * TAU, inputs["zeta"].as_f64().unwrap());
        let expected = &case["expected"];
        let list = |key: &str| {
            expected[key].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect::<Vec<_>>()
        };
        let amplitudes = list(if expected.get("amplitudes").is_some() {
            "amplitudes"
        } else {
            "amplitudes_full_precision"
        });
        assert_eq!(amplitudes.len(), shaper.impulses().len());
        for ((impulse, amplitude), time) in shaper.impulses().iter().zip(amplitudes).zip(list("times_s")) {
            // Nine decimals are printed; the record's tolerance is 1e-8.
            assert!(
                (impulse.amplitude - amplitude).abs() < 1e-8 && (impulse.time - time).abs() < 1e-8,
                "{}",
                case["id"]
            );
        }
        count += 1;
    }
    assert_eq!(count, 5, "no case gets lost");
}

/// Largest excursion of x'' + 2 z w x' + w^2 x = w^2 u from its end value after a shaped unit step,
/// by Runge-Kutta.
fn residual(shaper: &Shaper, frequency: f64, damping: f64) -> f64 {
    let command = |t: f64| {
        let given = shaper.impulses().iter().filter(|impulse| impulse.time <= t);
        given.map(|impulse| impulse.amplitude).sum::<f64>()
    };
    let slope =
        |[x, v]: [f64; 2], u: f64| [v, frequency * frequency * (u - x) - 2.0 * damping * frequency * v];
    let mut state = [0.0, 0.0];
    let mut edges: Vec<f64> = shaper.impulses().iter().map(|impulse| impulse.time).collect();
    let rest = edges[edges.len() - 1];
    edges.push(rest + 3.0 * TAU / frequency);
    let mut largest = 0.0_f64;
    // The command is constant between impulses, so no step straddles a jump.
    for pair in edges.windows(2) {
        let u = command(pair[0]);
        let steps = 4000;
        let h = (pair[1] - pair[0]) / f64::from(steps);
        for _ in 0..steps {
            let add = |s: [f64; 2], k: [f64; 2], h: f64| [s[0] + k[0] * h, s[1] + k[1] * h];
            let k1 = slope(state, u);
            let k2 = slope(add(state, k1, h / 2.0), u);
            let k3 = slope(add(state, k2, h / 2.0), u);
            let k4 = slope(add(state, k3, h), u);
            let k = [0, 1].map(|i| (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0);
            state = add(state, k, h);
            if pair[0] >= rest {
                largest = largest.max((state[0] - 1.0).abs());
            }
        }
    }
    largest
}

#[test]
fn shapers_leave_no_vibration_at_their_frequency() {
    for damping in [0.0, 0.03, 0.1, 0.25] {
        for id in ["zv", "zvd", "zvdd"] {
            let shaper = Shaper::new(shaper::kind(id).unwrap(), 18.0, damping);
            let left = residual(&shaper, 18.0, damping);
            assert!(left < 1e-9, "{id} leaves {left} at damping {damping}");
            assert!(shaper.residual_vibration(18.0, damping) < 1e-12);
        }
        // EI leaves 5 % by design; its damped fit is good to a percent of that.
        let shaper = Shaper::new(shaper::kind("ei").unwrap(), 18.0, damping);
        assert!((shaper.residual_vibration(18.0, damping) - 0.05).abs() < 0.003, "EI at {damping}");
    }
    // Without a shaper a step overshoots fully.
    assert!(residual(&Shaper::none(), 18.0, 0.0) > 0.99);
}

#[test]
fn residual_vibration_is_what_delayed_steps_leave_together() {
    let mut random = fastrand::Rng::with_seed(14);
    for _ in 0..300 {
        let kind = &shaper::TYPES[random.usize(0..4)];
        let shaper = Shaper::new(kind, between(&mut random, 5.0, 50.0), between(&mut random, 0.0, 0.25));
        let (w, z) = (between(&mut random, 5.0, 50.0), between(&mut random, 0.0, 0.5));
        let damped = w * f64::sqrt(1.0 - z * z);
        // Residual of a unit step, and its speed, some time after it: the textbook's second-order
        // system.
        let step = |t: f64| {
            let (sin, cos) = (damped * t).sin_cos();
            let decay = (-z * w * t).exp();
            [decay * (cos + z * w / damped * sin), -decay * w * w / damped * sin]
        };
        let left = shaper.impulses().iter().fold([0.0, 0.0], |[x, v], impulse| {
            let [dx, dv] = step(shaper.duration() - impulse.time);
            [x + impulse.amplitude * dx, v + impulse.amplitude * dv]
        });
        let amplitude = |[x, v]: [f64; 2]| f64::hypot(x, (v + z * w * x) / damped);
        let share = amplitude(left) / amplitude(step(0.0));
        let ours = shaper.residual_vibration(w, z);
        assert!((ours - share).abs() < 1e-12, "{} at {w}, {z}: {ours} against {share}", kind.id);
    }
}

#[test]
fn misjudged_frequency_zvd_forgives_more_than_zv() {
    let left =
        |id: &str| Shaper::new(shaper::kind(id).unwrap(), 18.0, 0.05).residual_vibration(18.0 * 1.1, 0.05);
    assert!(left("zvdd") < left("zvd") && left("zvd") < left("zv"));
}

#[test]
fn shaping_shrinks_a_cartesian_circle_by_the_variance_of_the_impulses() {
    // Radius lost to first order: v^2 / (32 R f^2) with ZV, v^2 / (16 R f^2) with ZVD, undamped.
    let (radius, speed, dt) = (0.2, 0.05, 1e-3);
    for (id, share) in [("zv", 32.0), ("zvd", 16.0)] {
        for hertz in [4.0, 8.0, 16.0] {
            let shaper = Shaper::new(shaper::kind(id).unwrap(), hertz * TAU, 0.0);
            let angle = |k: i32| f64::from(k) * dt * speed / radius;
            let circle: Vec<_> =
                (0..4000).map(|k| Vector3::new(angle(k).cos(), angle(k).sin(), 0.0) * radius).collect();
            let shaped = shaper.apply(&circle, dt);
            let lost = radius - shaped[3999].norm();
            let expected = speed * speed / (share * radius * hertz * hertz);
            // Next order: the fourth power of speed/(radius frequency), and linear interpolation
            // between samples.
            assert!((lost / expected - 1.0).abs() < 2e-3, "{id} at {hertz} Hz: {lost} against {expected}");
        }
    }
}

#[test]
fn a_shaped_joint_line_stays_on_its_line() {
    // Equal lags in all joints: a line in joint space keeps its shape, whatever the profile.
    let (from, to) =
        (Joints::from([0.1, 0.2, 1.0, 0.0, 0.3, 0.0]), Joints::from([0.6, 0.5, 0.7, 0.4, -0.2, 1.0]));
    let profile = armill::motion::Profile::new(1.0, 0.5, 1.0);
    let command: Vec<Joints> =
        (0..4000).map(|k| from + (to - from) * profile.at(f64::from(k) * 1e-3).0).collect();
    let shaper = Shaper::new(shaper::kind("zvd").unwrap(), 18.0, 0.1);
    let along = (to - from).normalize();
    let one_by_one = shaper.shaped(&command, 1e-3);
    for (k, q) in shaper.apply(&command, 1e-3).into_iter().enumerate() {
        assert_eq!(one_by_one.at(k), q, "sample {k}");
        let offset = q - from;
        assert!((offset - along * offset.dot(&along)).norm() < 1e-14);
    }
}

#[test]
fn undoing_a_shaper_gives_back_a_slow_command() {
    let shaper = Shaper::new(shaper::kind("zvd").unwrap(), 18.0, 0.1);
    let slow = |k: i32| Vector3::new((f64::from(k) * 1e-3 * 0.5).sin(), 0.0, 1.0);
    let wanted: Vec<_> = (0..20_000).map(slow).collect();
    let shaped = shaper.apply(&shaper.undo(&wanted, 1e-3, wanted.len()), 1e-3);
    // Away from the ends, where a command held before its start and after its end is not a slow
    // command.
    let middle = 6000..14_000;
    let worst =
        shaped[middle.clone()].iter().zip(&wanted[middle]).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    assert!(worst < 1e-9, "{worst}");
    // It never makes anything worse: the residual of any command shrinks.
    let mut random = fastrand::Rng::with_seed(12);
    let noise: Vec<_> = (0..2000).map(|_| common::any_vector(&mut random, 1.0)).collect();
    let left = shaper.apply(&shaper.undo(&noise, 1e-3, noise.len()), 1e-3);
    let size = |v: &mut dyn Iterator<Item = f64>| v.sum::<f64>().sqrt();
    let before = size(&mut noise.iter().map(|v| v.norm_squared()));
    let after = size(&mut noise.iter().zip(&left).map(|(a, b)| (a - b).norm_squared()));
    assert!(after < before);
}

#[test]
fn turning_path_and_base_together_changes_no_error() {
    // Base and workpiece moved together in {B}: hung upside down and shifted.
    let rows = |alpha: f64, a: f64| {
        json!([
            {"alpha_deg":alpha,"a_mm":a,"d_mm":420,"theta_offset_deg":0}, {"alpha_deg":-90,"a_mm":0,"d_mm":0,"theta_offset_deg":-90},
            {"alpha_deg":0,"a_mm":450,"d_mm":0,"theta_offset_deg":90}, {"alpha_deg":90,"a_mm":0,"d_mm":650,"theta_offset_deg":0},
            {"alpha_deg":-90,"a_mm":0,"d_mm":0,"theta_offset_deg":0}, {"alpha_deg":90,"a_mm":0,"d_mm":85,"theta_offset_deg":0}
        ])
    };
    let moved = |alpha: f64, a: f64| {
        let compliance = json!([9.03e-7, 11.17e-7, 14.74e-7, 27.65e-7, 97.58e-7, 1e-6]);
        arc(&[
            (
                "robot",
                json!({"name":"moved","modified_dh":rows(alpha, a),"joint_compliance_rad_per_nm":compliance}),
            ),
            ("tool_frame", json!({"xyz_mm":[20,-30,100],"rpy_deg":[0,10,0]})),
            ("workpiece_frame", json!({"xyz_mm":[a,0,0],"rpy_deg":[alpha,0,0]})),
        ])
    };
    let here = moved(0.0, 0.0);
    let there = moved(180.0, 250.0);
    for key in ["contour_error_mm", "after_contour_error_mm", "q1_deg", "q5_deg"] {
        let difference = greatest_difference(&column(&here, key), &column(&there, key));
        // Rounding of positions near 1 m, 1e-16 m, through the inverse model.
        assert!(difference < 1e-9, "{key} differs by {difference}");
    }
}

#[test]
fn turning_the_part_about_axis_1_only_turns_joint_1() {
    let here = arc(&[]);
    let there = arc(&[("workpiece_frame.rpy_deg", json!([0, 0, 40]))]);
    let error = greatest_difference(&column(&here, "contour_error_mm"), &column(&there, "contour_error_mm"));
    assert!(error < 1e-9, "{error}");
    let turned = column(&there, "q1_deg")[0] - column(&here, "q1_deg")[0];
    assert!((turned - 40.0).abs() < 1e-9);
}

#[test]
fn halving_the_sample_time_converges() {
    let max = |dt: f64| {
        let summary = arc(&[("motion.sample_time_s", json!(dt))]).summary();
        [summary.before_mm.shaping.max, summary.before_mm.deflection.mean, summary.before_mm.both.max]
    };
    let runs = [0.008, 0.004, 0.002, 0.001].map(max);
    for i in 0..3 {
        let steps: Vec<f64> = runs.windows(2).map(|pair| (pair[1][i] - pair[0][i]).abs()).collect();
        assert!(steps[2] < steps[0] && steps[2] < 2e-3 * runs[3][i], "figure {i}: {runs:?}");
    }
}

#[test]
fn the_force_turns_with_the_feed() {
    // A square around a point: the force on each side is equal in {T} and a quarter turn further in
    // {B} (eq. 4.11).
    let report = run(&[
        ("path", json!({"kind":"rectangle","center_mm":[600,0,100],"width_mm":100,"height_mm":100})),
        ("shaper", json!("none")),
    ]);
    let mean = report.mean_force();
    let per_side = 100;
    let s = column(&report, "arc_length_mm");
    for (side, (x, y)) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)].into_iter().enumerate() {
        let middle = s.iter().position(|s| *s > f64::from(per_side) * (side as f64 + 0.5)).unwrap();
        // x along the feed, z up, y = z x x.
        let expected = Vector3::new(x * mean.x - y * mean.y, y * mean.x + x * mean.y, mean.z);
        assert!((report.force[middle] - expected).norm() < 1e-9, "side {side}");
    }
}

#[test]
fn chip_from_feed_follows_the_speed() {
    let report = arc(&[("cutting.feed_per_tooth_mm", json!("from_feed")), ("shaper", json!("none"))]);
    let full = report.mean_force();
    // 100 mm/s at 4000 rpm and 4 flutes: 0.375 mm per tooth, 3.75 times the thesis's force without
    // edge terms.
    assert!((full.y - 3.75 * 1071.887).abs() < 0.01);
    assert!(report.force[0].norm() < 1e-9, "no chip at rest");
    let fastest = report.force.iter().map(|f| f.norm()).fold(0.0, f64::max);
    assert!((fastest - full.norm()).abs() < 1e-9);
}

#[test]
fn a_corner_with_a_wait_is_kept_and_one_without_is_rounded() {
    let corner = json!({"kind":"polyline","points_mm":[[550,-100,100],[650,0,100],[550,100,100]]});
    let nearest = |dwell: Value| {
        let report = run(&[("path", corner.clone()), ("motion.corner_dwell", dwell)]);
        let corner = Vector3::new(0.65, 0.0, 0.1);
        let nearest =
            report.shaping_only.actual.iter().map(|tip| (tip - corner).norm()).fold(f64::INFINITY, f64::min);
        (nearest, report)
    };
    let (kept, report) = nearest(json!("settle"));
    assert!(kept < 1e-9, "with the wait the corner is reached within {kept} m");
    assert!(!report.warnings.iter().any(|warning| warning.code == "corners-rounded"));
    let (rounded, report) = nearest(json!(0));
    assert!(rounded > 1e-4, "without it the corner is missed by {rounded} m");
    assert!(
        report.warnings.iter().any(|warning| warning.code == "corners-rounded"),
        "and the report says so"
    );
}

#[test]
fn the_record_ends_at_rest_on_the_exact_end() {
    let report = arc(&[]);
    let trajectory = &report.plan.trajectory;
    let end = report.plan.path.point(report.plan.path.length());
    assert_eq!(trajectory.position[trajectory.moving - 1], end);
    let shaped = report.shaping_only.actual.last().unwrap();
    assert!((shaped - end).norm() < 1e-9, "the shaped command has settled");
    let ends = report.after.actual.last().unwrap();
    assert!((ends - end).norm() < 1e-5, "the compensated tip ends on the end of the path");
}

#[test]
fn the_same_job_gives_the_same_bits() {
    assert_eq!(arc(&[]).fingerprint(), arc(&[]).fingerprint());
    assert_ne!(arc(&[]).fingerprint(), arc(&[("motion.feed_mm_s", json!(100.000001))]).fingerprint());
}

#[test]
fn mean_force_by_edge_coefficients_adds() {
    let with_edges = |kte: f64| {
        let report =
            arc(&[("material", json!({"ktc_n_mm2":1800,"krc_n_mm2":540,"kac_n_mm2":800,"kte_n_mm":kte}))]);
        report.mean_force()
    };
    // N a k_te / (2 pi) times (-(sin 180 - sin 90), -(cos 180 - cos 90)) = N a k_te / (2 pi) (1,
    // 1).
    let added = with_edges(20.0) - with_edges(0.0);
    let expected = 4.0 * 10.0 * 20.0 / (2.0 * PI);
    assert!((added - Vector3::new(expected, expected, 0.0)).norm() < 1e-9);
}
