//! What the drives cannot follow is said, with its place and its largest value.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]

use crate::common::{column, run};
use armill::Report;
use armill::report::Warning;
use armill::robot::library;
use nalgebra::Vector3;
use serde_json::{Value, json};

fn warning<'r>(report: &'r Report, code: &str) -> Option<&'r Warning> {
    report.warnings.iter().find(|warning| warning.code == code)
}

fn severity(warning: &Warning) -> Value {
    serde_json::to_value(warning).unwrap()["severity"].clone()
}

/// Accelerations [mm/s^2] of three columns by the second difference over a time [s], at every sample.
fn accelerations(report: &Report, key: &str, over: f64) -> Vec<f64> {
    let [x, y, z] = ["x", "y", "z"].map(|axis| column(report, &format!("{key}_{axis}_mm")));
    let at = |k: usize| Vector3::new(x[k], y[k], z[k]);
    let steps = (over / report.plan.trajectory.sample_time).round() as usize;
    let size = |k: usize| {
        if k < steps || k + steps >= x.len() {
            return 0.0;
        }
        (at(k + steps) - at(k) * 2.0 + at(k - steps)).norm() / (over * over)
    };
    (0..x.len()).map(size).collect()
}

/// A rectangle with sharp corners, not shaped: the edge force sets in within 13 ms of a corner.
fn rectangle(changes: &[(&str, Value)]) -> Report {
    let mut all = vec![
        ("robot", json!({"preset":"kuka-kr-240-r2900-ultra-f"})),
        ("workpiece_frame", json!({"xyz_mm":[1700,0,600]})),
        ("tool_frame", json!({"xyz_mm":[0,0,250]})),
        ("path", json!({"kind":"rectangle","center_mm":[0,0,0],"width_mm":100,"height_mm":60})),
        ("motion.feed_mm_s", json!(40)),
        ("motion.acceleration_mm_s2", json!(400)),
        ("motion.sample_time_s", json!(0.004)),
        ("tool", json!({"diameter_mm":16,"flutes":4,"helix_deg":35})),
        ("material", json!({"preset":"al-7075-t6"})),
        (
            "cutting",
            json!({"axial_depth_mm":8,"engagement":"climb","radial_depth_mm":8,"entry_deg":90,"exit_deg":180,
                "spindle_rpm":6000,"feed_per_tooth_mm":"from_feed"}),
        ),
        ("shaper", json!("none")),
    ];
    all.extend(changes.iter().cloned());
    run(&all)
}

#[test]
fn a_command_that_jumps_is_said_to_be_impossible() {
    for dt in [0.001, 0.004, 0.012] {
        let report = rectangle(&[("motion.sample_time_s", json!(dt))]);
        // Without a shaper the drives get the compensated path itself.
        let all = accelerations(&report, "compensated", 0.012);
        let largest = all.iter().copied().fold(0.0, f64::max);
        assert!(largest > 3.0 * 400.0, "{largest}");
        let found = warning(&report, "command-acceleration").unwrap();
        assert_eq!(severity(found), "cannot-run");
        assert_eq!(report.warnings[0].code, "command-acceleration", "before all that it would achieve");
        let said: f64 = found
            .message
            .split_once("tool at ")
            .and_then(|(_, rest)| rest.split(' ').next())
            .and_then(|figure| figure.parse().ok())
            .unwrap();
        // On a fine grid every fourth sample is looked at.
        assert!((said - largest).abs() < 0.03 * largest, "{dt}: {said} of {largest}");
        let (from, to) = (found.from_sample.unwrap(), found.to_sample.unwrap());
        let beyond = |k: &usize| all[*k] > 1200.0;
        let (first, last) = ((0..all.len()).find(beyond).unwrap(), (0..all.len()).rfind(beyond).unwrap());
        assert!(from.abs_diff(first) <= 4 && to.abs_diff(last) <= 4, "{from} to {to}: {first} to {last}");
    }
}

#[test]
fn a_command_that_an_arm_follows_is_not_remarked() {
    // The same without a force; and a light cut along a line.
    let idle = rectangle(&[("compensation.sources", json!([]))]);
    let line = [
        ("path", json!({"kind":"line","from_mm":[0,0,0],"to_mm":[80,0,0]})),
        ("material", json!({"preset":"thesis"})),
        ("cutting.axial_depth_mm", json!(1)),
    ];
    for report in [idle, rectangle(&line)] {
        let largest = accelerations(&report, "compensated", 0.012).into_iter().fold(0.0, f64::max);
        assert!(largest < 1200.0, "{largest}");
        assert!(warning(&report, "command-acceleration").is_none());
    }
}

#[test]
fn samples_too_far_apart_are_not_taken_for_an_answer() {
    for (dt, unchecked) in [(0.012, false), (0.02, true), (0.1, true)] {
        let report = rectangle(&[("motion.sample_time_s", json!(dt))]);
        assert_eq!(warning(&report, "command-unchecked").is_some(), unchecked, "{dt}");
        assert_eq!(warning(&report, "command-acceleration").is_some(), !unchecked, "{dt}");
    }
}

#[test]
fn joints_that_turn_too_fast_are_named() {
    for id in ["kuka-kr-210-2", "fanuc-r-2000ic-165f"] {
        let preset = library::robot(id).unwrap();
        let limits = preset.joint_speed_deg_s.unwrap();
        let job = |feed: f64| {
            run(&[
                ("robot", json!({ "preset": id })),
                // Across the front, near axis 1: joint 1 turns fast.
                ("path", json!({"kind":"line","from_mm":[700,-700,900],"to_mm":[700,700,900]})),
                ("motion.feed_mm_s", json!(feed)),
                ("motion.acceleration_mm_s2", json!(20_000)),
                ("motion.sample_time_s", json!(0.004)),
                ("cutting.axial_depth_mm", json!(0)),
                ("shaper", json!("none")),
            ])
        };
        let fast = job(4000.0);
        let speed = |i: usize| {
            let q = column(&fast, &format!("compensated_q{i}_deg"));
            q.windows(2).map(|pair| (pair[1] - pair[0]) / 0.004).collect::<Vec<_>>()
        };
        let mut speeds: Vec<Vec<f64>> = (1..=6).map(speed).collect();
        if preset.elbow == armill::robot::Elbow::Pendant {
            // The drive turns the forearm against the upper arm, the pendant counts from the level.
            let [_, s2, s3, ..] = preset.opw.joint_sign;
            speeds[2] = speeds[2].iter().zip(&speeds[1]).map(|(v3, v2)| v3 - s2 * s3 * v2).collect();
        }
        let share = |i: usize| speeds[i].iter().fold(0.0, |most: f64, v| most.max(v.abs())) / limits[i];
        let worst = (0..6).max_by(|&a, &b| share(a).total_cmp(&share(b))).unwrap();
        assert!(share(worst) > 1.0, "{id}: {}", share(worst));
        let found = warning(&fast, "joint-speed").unwrap();
        assert_eq!(severity(found), "cannot-run");
        let expected =
            format!("joint {} would have to turn at {:.0} deg/s", worst + 1, share(worst) * limits[worst]);
        assert!(found.message.starts_with(&expected), "{id}: {} instead of {expected}", found.message);
        assert!(found.message.contains(&format!("its maximum is {:.0} deg/s", limits[worst])));
        assert!(warning(&job(100.0), "joint-speed").is_none());
    }
    let own = run(&[]);
    assert_eq!(severity(warning(&own, "joint-speeds-unknown").unwrap()), "note");
}

#[test]
fn the_report_says_where_a_cut_begins_too_fast_for_the_shaper() {
    let report = run(&[]);
    let found = warning(&report, "run-in").unwrap();
    assert!(
        found.message.contains("0.042 mm") && found.message.contains("within 5.0 mm"),
        "{}",
        found.message
    );
    assert!(found.message.contains("exact inverse of the shaper"), "{}", found.message);
    let after = column(&report, "after_contour_error_mm");
    let tolerance = report.summary().tolerance_mm;
    let (from, to) = (found.from_sample.unwrap(), found.to_sample.unwrap());
    assert!(after[from] > tolerance && after[to] > tolerance);
    assert!(after[to + 1..].iter().all(|error| *error <= tolerance), "nothing is beyond it later on");
    // Nothing of the kind without a shaper: the command follows.
    assert!(warning(&run(&[("shaper", json!("none"))]), "run-in").is_none());
}

#[test]
fn what_is_left_at_the_end_is_not_laid_to_the_beginning() {
    let slot = |to: f64| {
        run(&[
            ("robot", json!({"preset":"kuka-kr-210-2"})),
            ("workpiece_frame", json!({"xyz_mm":[1700,0,800]})),
            ("tool_frame", json!({"xyz_mm":[0,0,250]})),
            ("path", json!({"kind":"line","from_mm":[0,0,0],"to_mm":[0,to,0]})),
            ("motion.feed_mm_s", json!(40)),
            ("motion.acceleration_mm_s2", json!(400)),
            ("motion.sample_time_s", json!(0.004)),
            ("material", json!({"preset":"al-7075-t6"})),
            ("cutting.engagement", json!("slot")),
            ("shaper", json!({"kind":"zvd","frequency_hz":10,"damping":0.03})),
        ])
    };
    let long = slot(200.0);
    let found = warning(&long, "run-out").unwrap();
    assert!(found.from_sample.unwrap() >= long.plan.trajectory.moving, "after the command has arrived");
    if let Some(begin) = warning(&long, "run-in") {
        assert!(begin.to_sample.unwrap() < long.plan.trajectory.moving);
    }
    assert!(warning(&long, "run-in-short").is_none());
    // The run-in of this slot is 5 mm.
    let short = warning(&slot(2.0), "run-in-short").unwrap().message.clone();
    assert!(short.contains("5.0 mm") && short.contains("at most 35 %"), "{short}");
}
