//! A remedy cures: with its patch the job runs again without the warning.

use crate::common::{self, any_vector, between, job_text};
use armill::report::{Severity, Warning};
use armill::{Job, Progress, Report};
use serde_json::{Value, json};
use std::collections::BTreeMap;

fn warning<'r>(report: &'r Report, code: &str) -> Option<&'r Warning> {
    report.warnings.iter().find(|warning| warning.code == code)
}

/// What a warning is about: its code and, where there is one for each joint, the joint.
fn about(warning: &Warning) -> String {
    let joint = warning.message.strip_prefix("joint ").and_then(|rest| rest.split(' ').next());
    format!("{} {}", warning.code, joint.unwrap_or_default())
}

/// Runs a job, and again with each remedy, which must remove its warning. Counts the remedies by code.
fn closed_loop(changes: &[(&str, Value)], cured: &mut BTreeMap<&'static str, usize>) -> Option<Report> {
    let job = Job::from_json(&job_text(changes)).unwrap();
    let report = armill::run(&job, &mut Progress::none()).ok()?;
    for warning in &report.warnings {
        let Some(remedy) = &warning.remedy else { continue };
        let after = armill::run(&remedy.applied(&job).unwrap(), &mut Progress::none()).unwrap();
        let left: Vec<_> = after.warnings.iter().map(about).collect();
        assert!(!left.contains(&about(warning)), "{changes:?}: {} leaves {left:?}", remedy.label);
        *cured.entry(warning.code).or_default() += 1;
    }
    Some(report)
}

/// A KR 210 with its spindle across the flange.
fn across(spin_deg: f64) -> Vec<(&'static str, Value)> {
    vec![
        ("robot", json!({"preset":"kuka-kr-210-2"})),
        ("workpiece_frame", json!({"xyz_mm":[1700,0,700]})),
        ("tool_frame", json!({"xyz_mm":[150,0,300],"rpy_deg":[0,90,0]})),
        ("spin", json!({ "angle_deg": spin_deg })),
        (
            "path",
            json!({"kind":"rectangle","center_mm":[0,0,0],"width_mm":200,"height_mm":120,"corner_radius_mm":20}),
        ),
        ("motion.feed_mm_s", json!(40)),
        ("motion.sample_time_s", json!(0.01)),
        ("cutting.axial_depth_mm", json!(2)),
        ("shaper", json!("none")),
    ]
}

#[test]
fn a_spindle_across_the_flange_is_turned_into_the_joint_ranges() {
    let mut cured = BTreeMap::new();
    let report = closed_loop(&across(0.0), &mut cured).unwrap();
    let found = warning(&report, "joint-limit").unwrap();
    assert_eq!(found.severity, Severity::CannotRun);
    assert!(found.message.starts_with("joint 5"), "{}", found.message);
    let remedy = found.remedy.as_ref().unwrap();
    let turn: f64 = remedy.patch["spin"]["angle_deg"].as_f64().unwrap();
    assert_eq!(remedy.label, format!("Turn the tool {turn} deg about its axis"));
    assert_eq!(remedy.patch, json!({"spin":{"angle_deg":turn}}));
    assert!(cured["joint-limit"] > 0);
    // No smaller turn in steps of 10 deg does without a warning of the kind.
    let mut less = 10.0;
    while less < turn.abs() {
        for turn in [less, -less] {
            let report = common::run(&across(turn));
            let codes: Vec<_> = report.warnings.iter().map(|warning| warning.code).collect();
            let near = |code: &&str| code.starts_with("joint-limit") || code.starts_with("singularity");
            assert!(codes.iter().any(near), "{turn} deg would do: {codes:?}");
        }
        less += 10.0;
    }
    // From another angle the same place is a shorter turn away, and the label says how far.
    let other = closed_loop(&across(-20.0), &mut cured).unwrap();
    if let Some(remedy) = warning(&other, "joint-limit").and_then(|found| found.remedy.clone()) {
        let angle = remedy.patch["spin"]["angle_deg"].as_f64().unwrap();
        let turned = (angle + 20.0 + 180.0).rem_euclid(360.0) - 180.0;
        assert!(remedy.label.contains(&format!("{turned} deg")), "{}: {angle}", remedy.label);
    }
}

#[test]
fn every_remedy_cures_its_warning() {
    let mut random = fastrand::Rng::with_seed(15);
    let mut cured = BTreeMap::new();
    for _ in 0..240 {
        let mut at = |size: f64| -> [f64; 3] { any_vector(&mut random, size).into() };
        let (points, place): (Vec<[f64; 3]>, _) = ((0..4).map(|_| at(100.0)).collect(), at(300.0));
        let robot = ["kuka-kr-210-2", "staubli-rx90", "fanuc-r-2000ic-165f"][random.usize(..3)];
        let reach = if robot == "staubli-rx90" { 450.0 } else { 1600.0 };
        let spin = match random.usize(..4) {
            0 => json!({"mode":"free","range_deg":[-20,20],"goal":"smooth-joints"}),
            _ => json!({"angle_deg": between(&mut random, -180.0, 180.0).round()}),
        };
        let changes = [
            ("robot", json!({ "preset": robot })),
            ("workpiece_frame", json!({"xyz_mm":[reach + place[0], 3.0 * place[1], 500.0 + place[2]]})),
            (
                "tool_frame",
                json!({"xyz_mm":[50,0,200],"rpy_deg":[0,between(&mut random, 0.0, 120.0).round(),0]}),
            ),
            ("spin", spin),
            ("path", json!({"kind":"polyline","points_mm":points})),
            ("motion.feed_mm_s", json!(60)),
            ("motion.sample_time_s", json!(0.01)),
            ("cutting.axial_depth_mm", json!(1)),
            ("shaper", json!("none")),
        ];
        closed_loop(&changes, &mut cured);
    }
    for code in ["joint-limit", "joint-limit-near", "singularity-wrist"] {
        assert!(cured.get(code).is_some_and(|count| *count > 2), "{cured:?}");
    }
}

#[test]
fn a_path_that_no_turn_clears_is_placed_in_front() {
    // Behind an RX-90, where joint 1 ends whatever the spin is.
    let changes = [
        ("workpiece_frame", json!({"xyz_mm":[-550,0,200]})),
        ("path", json!({"kind":"line","from_mm":[0,-50,0],"to_mm":[0,50,0]})),
        ("motion.sample_time_s", json!(0.01)),
        ("shaper", json!("none")),
    ];
    let mut cured = BTreeMap::new();
    let report = closed_loop(&changes, &mut cured).unwrap();
    let remedy = warning(&report, "joint-limit").unwrap().remedy.clone().unwrap();
    let [x, y, _] =
        serde_json::from_value::<[f64; 3]>(remedy.patch["workpiece_frame"]["xyz_mm"].clone()).unwrap();
    assert!(x > 300.0 && y == 0.0 && remedy.label.contains("in front of the robot"), "{remedy:?}");
    // A circle around the base fits no place in front, and no turn helps.
    let around = [
        ("robot", json!({"preset":"kuka-kr-210-2"})),
        ("path", json!({"kind":"circle","center_mm":[0,0,900],"radius_mm":1800})),
        ("motion.sample_time_s", json!(0.02)),
    ];
    let report = closed_loop(&around, &mut cured).unwrap();
    assert!(warning(&report, "joint-limit").unwrap().remedy.is_none());
}

#[test]
fn a_shaper_that_does_harm_is_switched_off() {
    let mut cured = BTreeMap::new();
    let mut changes = across(90.0);
    changes.pop();
    let sharp = json!({"kind":"rectangle","center_mm":[0,0,0],"width_mm":100,"height_mm":60});
    changes.extend([
        ("path", sharp),
        ("motion.corner_dwell", json!(0)),
        ("shaper", json!({"kind":"zvd","frequency_hz":5,"damping":0.05})),
    ]);
    closed_loop(&changes, &mut cured).unwrap();
    assert_eq!(cured.get("corners-rounded"), Some(&1));
    changes.push(("shaper", json!({"kind":"zvd","frequency_hz":80,"damping":0.05})));
    closed_loop(&changes, &mut cured).unwrap();
    assert_eq!(cured.get("shaper-sampling"), Some(&1));
}

#[test]
fn a_patch_is_what_scripts_get() {
    let report = common::run(&across(0.0));
    let found = serde_json::to_value(warning(&report, "joint-limit").unwrap()).unwrap();
    assert!(found["remedy"]["label"].is_string() && found["remedy"]["patch"].is_object(), "{found}");
    // A remark without one has no such key.
    let other =
        serde_json::to_value(report.warnings.iter().find(|warning| warning.remedy.is_none())).unwrap();
    assert!(other.get("remedy").is_none());
}
