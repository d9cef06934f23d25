//! The arm's branch: where it ends, its whole turns, and a start in the wrist singularity.
#![allow(clippy::disallowed_methods, reason = "compared within tolerances")]

use crate::common::{refused, run};
use armill::robot::{Joints, Robot, forward, library};
use armill::{Error, Report};
use nalgebra::Vector3;
use serde_json::{Value, json};

/// An arm without tool, shaper and cut along a path.
fn changes(robot: &str, path: Value, more: &[(&'static str, Value)]) -> Vec<(&'static str, Value)> {
    let mut all = vec![
        ("robot", json!({"preset": robot})),
        ("path", path),
        ("motion.sample_time_s", json!(0.004)),
        ("shaper", json!("none")),
        ("cutting.axial_depth_mm", json!(0)),
    ];
    all.extend(more.iter().cloned());
    all
}

fn has(report: &Report, code: &str) -> bool {
    report.warnings.iter().any(|warning| warning.code == code)
}

#[test]
fn where_a_branch_ends_is_an_error_with_its_place() {
    // Over its back the arm reaches less far than to its front. The wrist centre is above the tip
    // by c4 and, seen from axis 2, ahead by a1 more than from axis 1.
    let arm = library::robot("kuka-kr-210-2").unwrap();
    let [a1, a2, _, c1, c2, c3, c4] = arm.opw.lengths_mm;
    let (from, z) = (1200.0, 900.0);
    let ends = ((c2 + a2.hypot(c3)).powi(2) - (z + c4 - c1).powi(2)).sqrt() - a1;
    let text = format!("{from},0,{z}\n{},0,{z}", ends + 100.0);
    let path = json!({"kind": "csv", "text": text});
    let back = json!({"shoulder": "back", "elbow": "negative", "wrist": "near"});
    let all = changes("kuka-kr-210-2", path, &[("start_branch", back)]);
    let error = refused(&all);
    let Error::BranchEnds { arc_length, sample, line, joint, turn, .. } = error else { panic!("{error}") };
    // A sample is at most 0.4 mm from the next.
    let beyond = arc_length * 1e3 - (ends - from);
    assert!((0.0..=0.4).contains(&beyond), "{beyond} mm beyond the end");
    assert!(sample > 0 && line == 2 && (1..=6).contains(&joint) && turn > 1.0, "{error}");
    assert_eq!(error.code(), "branch-ends");
    let said = error.to_string();
    for part in ["line 2", "mm along the path", "start_branch", "spin", "move the part"] {
        assert!(said.contains(part), "{said}");
    }
    // The front branch goes on.
    let mut front = all;
    front.pop();
    assert!(!has(&run(&front), "joint-jump"));
}

/// A KR 210 or another arm at the pose of joint values [deg], then along Y.
fn from_joints(robot: &str, q_deg: [f64; 6], more: &[(&'static str, Value)]) -> Report {
    from_text(robot, q_deg, |x| format!("{x:e}"), more)
}

/// As [`from_joints`], with positions and axes as they are `written`.
fn from_text(
    robot: &str,
    q_deg: [f64; 6],
    written: impl Fn(f64) -> String,
    more: &[(&'static str, Value)],
) -> Report {
    let preset = library::robot(robot).unwrap();
    let arm = Robot::new("", preset.links(), preset.limits(), [0.0; 6]).unwrap();
    let tcp = forward::forward(&arm, &Joints::from(q_deg.map(f64::to_radians)));
    let (axis, x) = (-tcp.rotation.column(2), tcp.rotation.column(0));
    // The spin of that pose, counted from Y.
    let level = (Vector3::y() - axis * axis.y).normalize().cross(&axis);
    let spin = axis.dot(&level.cross(&x)).atan2(level.dot(&x)).to_degrees();
    let [p, a] = [tcp.position * 1e3, axis];
    let row = |y: f64| [p.x, p.y + y, p.z, a.x, a.y, a.z].map(&written).join(",");
    let path = json!({"kind": "csv", "text": format!("x,y,z,i,j,k\n{}\n{}", row(0.0), row(20.0))});
    let mut all = changes(robot, path, &[("spin", json!({"angle_deg": spin, "reference": "y"}))]);
    all.extend(more.iter().cloned());
    run(&all)
}

#[test]
fn the_start_takes_each_joint_inside_its_range() {
    // Joint 3 from -80 to 206 deg: 195 is inside, the same a turn less is not.
    let q = [10.0, 20.0, 195.0, 5.0, 30.0, 10.0];
    let branch = json!({"shoulder": "back", "elbow": "negative", "wrist": "near"});
    let report = from_joints("yaskawa-gp35l", q, &[("start_branch", branch)]);
    for (i, (ours, wanted)) in report.q[0].iter().zip(q).enumerate() {
        assert!((ours.to_degrees() - wanted).abs() < 1e-6, "q{} is {}", i + 1, ours.to_degrees());
    }
    assert!(!has(&report, "joint-limit"), "{:?}", report.warnings);
}

#[test]
fn the_whole_path_takes_the_turns_that_suit_its_ranges() {
    let arc = json!({"kind": "arc", "center_mm": [0, 0, 900], "radius_mm": 1700, "normal": [0, 0, 1], "start_deg": -150, "sweep_deg": 300});
    let all = changes(
        "kuka-kr-210-2",
        arc,
        &[("spin", json!({"angle_deg": -140})), ("motion.feed_mm_s", json!(500))],
    );
    let report = run(&all);
    // An upright tool under an arm that faces it: joint 6 turns against joint 1, from 150 deg one way
    // to 150 deg the other, and 40 deg beside it. A turn less it would leave its 350 deg.
    let q6 = |k: usize| report.q[k][5].to_degrees();
    let (first, last) = (q6(0), q6(report.samples() - 1));
    assert!((first - 190.0).abs() < 1e-6 && (last + 110.0).abs() < 1e-6, "{first} to {last}");
    assert!(!has(&report, "joint-limit"), "{:?}", report.warnings);
    // The compensated command, and with it every file, has the same turns.
    for (desired, compensated) in report.q.iter().zip(report.compensation.q.iter()) {
        assert!((desired - compensated).amax() < 0.1);
    }
}

#[test]
fn a_start_in_the_wrist_singularity_has_q4_of_the_first_step() {
    let report = from_joints("kuka-kr-210-2", [0.0, -60.0, 90.0, 0.0, 0.0, 0.0], &[]);
    let q = |k: usize, i: usize| report.q[k][i].to_degrees();
    // Along Y the tool axis leans about the forearm's own vertical: q4 is a quarter turn either way.
    assert!((q(0, 3).abs() - 90.0).abs() < 0.01, "{}", q(0, 3));
    assert!(q(0, 4).abs() < 1e-6 && (q(0, 3) - q(1, 3)).abs() < 0.01, "{} and {}", q(0, 3), q(1, 3));
    // Joints 4 and 6 cancel.
    assert!((q(0, 3) + q(0, 5)).abs() < 1e-6, "{} and {}", q(0, 3), q(0, 5));
    assert!(!has(&report, "joint-jump"), "{:?}", report.warnings);
    // The other wrist starts on the other side.
    let flipped = json!({"shoulder": "front", "elbow": "positive", "wrist": "flipped"});
    let other = from_joints("kuka-kr-210-2", [0.0, -60.0, 90.0, 0.0, 0.0, 0.0], &[("start_branch", flipped)]);
    assert!(!has(&other, "joint-jump"));
}

#[test]
fn a_start_typed_with_seven_decimals_is_singular_too() {
    // With six, rounding turns the tool axis as far as the first samples do.
    for decimals in [7, 8, 9, 12] {
        let written = |x: f64| format!("{x:.decimals$}");
        let report = from_text("kuka-kr-210-2", [0.0, -60.0, 90.0, 0.0, 0.0, 0.0], written, &[]);
        let largest = report.q.windows(2).map(|pair| (pair[1] - pair[0]).amax()).fold(0.0, f64::max);
        assert!(largest.to_degrees() < 0.5, "{decimals} decimals: {} deg in a sample", largest.to_degrees());
        assert!(!has(&report, "joint-jump") && !has(&report, "joint-speed"), "{decimals}");
        // The pose is kept: twice 3e-6 rad on levers of half a metre.
        let away = report.before.contour_error.iter().map(|error| error.norm()).fold(0.0, f64::max);
        assert!(away < 3e-6, "{decimals}: {away} m");
    }
}
