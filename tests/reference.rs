//! What the spin counts from: tool axes along the workpiece's X, over it, and all around.
#![allow(clippy::disallowed_methods, reason = "compared within tolerances")]

use crate::common::{any_vector, job_text, refused, run};
use armill::export::command::Command;
use armill::export::commanded_path::CommandedPath;
use armill::export::style::PostStyle;
use armill::path::{AxisArc, RollReference};
use armill::robot::{Robot, forward, library};
use armill::verification::replay;
use armill::{Report, math::angle_between};
use nalgebra::Vector3;
use serde_json::{Value, json};
use std::f64::consts::PI;

/// A KR 210 without tool, shaper and cut along points with tool axes.
fn changes(text: &str, more: &[(&'static str, Value)]) -> Vec<(&'static str, Value)> {
    let mut all = vec![
        ("robot", json!({"preset": "kuka-kr-210-2"})),
        ("path", json!({"kind": "csv", "text": text})),
        ("motion.feed_mm_s", json!(20)),
        ("motion.sample_time_s", json!(0.004)),
        ("shaper", json!("none")),
        ("cutting.axial_depth_mm", json!(0)),
    ];
    all.extend(more.iter().cloned());
    all
}

fn milled(text: &str, more: &[(&'static str, Value)]) -> Report {
    run(&changes(text, more))
}

/// Two points on a line along Y, the tool axis along I, J, K.
fn along_y([i, j, k]: [f64; 3]) -> String {
    format!("x,y,z,i,j,k\n1600,-50,1000,{i:e},{j:e},{k:e}\n1600,50,1000,{i:e},{j:e},{k:e}")
}

fn degrees(report: &Report, sample: usize) -> Vec<f64> {
    report.q[sample].iter().map(|q| q.to_degrees()).collect()
}

/// Largest turn of a joint from one sample to the next [deg].
fn largest_step(report: &Report) -> f64 {
    report.q.windows(2).map(|pair| (pair[1] - pair[0]).amax().to_degrees()).fold(0.0, f64::max)
}

fn codes(report: &Report) -> Vec<&str> {
    report.warnings.iter().map(|warning| warning.code).collect()
}

#[test]
fn a_tool_axis_along_x_is_solved() {
    let report = milled(&along_y([-1.0, 0.0, 0.0]), &[]);
    // With the flange at the tip, joints 1 to 5 do not depend on the spin. Solved by Newton's method
    // on a forward model of its own, to 1e-13 mm; printed with six decimals.
    let expected = [2.090159, -70.157288, 124.495522, 2.572003, -54.365584];
    let (first, last) = (degrees(&report, 0), degrees(&report, report.samples() - 1));
    for (i, expected) in expected.into_iter().enumerate() {
        assert!((first[i] - expected).abs() < 1e-6, "q{} is {}", i + 1, first[i]);
        // The other end is the mirror image.
        let mirrored = if i == 0 || i == 3 { -expected } else { expected };
        assert!((last[i] - mirrored).abs() < 1e-6, "q{} is {}", i + 1, last[i]);
    }
    assert!(largest_step(&report) < 0.02, "{}", largest_step(&report));
    assert!(codes(&report).contains(&"spin-reference"), "{:?}", report.warnings);
}

#[test]
fn every_robot_mills_along_x_both_ways() {
    for preset in library::robots() {
        let reach = Robot::new("", preset.links(), None, [0.0; 6]).unwrap().reach().1 * 1e3;
        for i in [1, -1] {
            let path = json!({"kind":"csv","text":format!("x,y,z,i,j,k\n0,0,0,{i},0,0\n0,10,0,{i},0,0")});
            let at = |share: f64| {
                let place = json!({"xyz_mm":[share * reach, -5, 0.35 * reach]});
                let robot = json!({"preset": preset.id});
                let all = [("robot", robot), ("path", path.clone()), ("workpiece_frame", place)];
                armill::run_json(&job_text(&changes("", &all)), &mut armill::Progress::none()).ok()
            };
            let report = [0.55, 0.3, 0.7].into_iter().find_map(at);
            let report = report.unwrap_or_else(|| panic!("{} nowhere with axis {i}", preset.id));
            assert!((report.plan.trajectory.axis.at(0) - Vector3::x() * f64::from(i)).norm() < 1e-12);
            // 0.08 mm a sample, at a distance of a few decimetres from any axis.
            assert!(largest_step(&report) < 0.1, "{}: {}", preset.id, largest_step(&report));
        }
    }
}

#[test]
fn around_x_nothing_but_the_axis_changes() {
    let exact = milled(&along_y([-1.0, 0.0, 0.0]), &[]);
    for tilt in [1e-12, 1e-9, 1e-7, 1e-6, 1e-5] {
        for (j, k) in [(tilt, 0.0), (-tilt, 0.0), (0.0, tilt), (0.0, -tilt)] {
            let near = milled(&along_y([-1.0, j, k]), &[]);
            let apart = near.q.iter().zip(exact.q.iter()).map(|(a, b)| (a - b).amax()).fold(0.0, f64::max);
            // No joint turns more than a few times as far as the tool axis; 1e-12 for rounding.
            assert!(apart < 5.0 * tilt + 1e-12, "{apart} rad for {j:e}, {k:e}");
        }
    }
}

/// A path whose axis passes over -X, one degree a point.
fn over_x(from_deg: f64) -> String {
    let row = |k: i32| {
        let (sin, cos) = (from_deg + f64::from(k)).to_radians().sin_cos();
        format!("1600,{},1000,{},0,{}", -100 + 5 * k, -sin, cos)
    };
    let rows: Vec<_> = (0..=40).map(row).collect();
    format!("x,y,z,i,j,k\n{}", rows.join("\n"))
}

#[test]
fn the_axis_passes_over_x_without_a_turn() {
    // Two starts: beside X, and one that meets it to the last digit.
    for from in [70.3, 70.0] {
        let report = milled(&over_x(from), &[]);
        // The tool axis itself turns by 0.016 deg a sample: 1 deg in 5 mm, at 0.08 mm a sample.
        assert!(largest_step(&report) < 0.021, "{}", largest_step(&report));
        assert!(!codes(&report).contains(&"joint-jump"));
    }
    let tool = json!({"xyz_mm":[150,0,300],"rpy_deg":[0,90,0]});
    let shaper = json!({"kind":"zvd","frequency_hz":10,"damping":0.03});
    let report = milled(&over_x(70.3), &[("tool_frame", tool), ("shaper", shaper)]);
    // It was 450 mm when the TCP turned by half a turn in between.
    assert!(report.before.statistics.max < 1e-3, "{}", report.before.statistics.max);
}

#[test]
fn an_upright_tool_keeps_its_spin_with_every_reference() {
    let line = "600,-50,600\n650,50,600";
    let plain = milled(line, &[("spin", json!({"angle_deg": 20}))]);
    assert!(!codes(&plain).contains(&"spin-reference"));
    for reference in [json!("auto"), json!("x"), json!("y"), json!([1, 0, 0]), json!([3, -4, 5])] {
        let other = milled(line, &[("spin", json!({"angle_deg": 20, "reference": reference}))]);
        for (a, b) in plain.q.iter().zip(other.q.iter()) {
            assert!((a - b).amax() < 1e-12, "{reference}");
        }
    }
}

#[test]
fn what_is_set_holds_for_the_whole_path() {
    for (reference, direction) in [
        (json!("y"), Vector3::y()),
        (json!("z"), Vector3::z()),
        (json!([0, 2, 2]), Vector3::new(0.0, 1.0, 1.0)),
    ] {
        let report = milled(&over_x(70.3), &[("spin", json!({"reference": reference}))]);
        assert!(!codes(&report).contains(&"spin-reference"), "what is set needs no remark");
        for (k, q) in report.q.iter().enumerate() {
            let axis = report.plan.trajectory.axis.at(k);
            let across = (direction - axis * axis.dot(&direction)).normalize();
            let tcp = forward::forward(&report.plan.robot, q);
            // By a quarter turn for a direction in the plane of Y and Z, unless it is Z itself.
            let expected = if reference == "z" { across } else { across.cross(axis) };
            assert!((tcp.rotation.column(0) - expected).norm() < 1e-9, "{reference} at {k}");
        }
    }
}

#[test]
fn a_reference_on_the_axis_is_refused_with_what_is_legal() {
    let text = |spin: Value, text: &str| {
        let error = refused(&changes(text, &[("spin", spin)]));
        assert_eq!(error.field(), Some("spin.reference"), "{error}");
        error.to_string()
    };
    let upright = "600,-50,600\n650,50,600";
    let said = text(json!({"reference": "z"}), upright);
    assert!(said.contains("within 0.0 deg") && said.contains("\"x\" or \"y\""), "{said}");
    let said = text(json!({"reference": "x"}), &over_x(70.3));
    assert!(said.contains("line") && said.contains("such as \"y\""), "{said}");
    text(json!({"reference": [1e-3, 0, -1]}), upright);
    text(json!({"reference": [0, 0, 0]}), upright);
    // 1 deg from the axis is enough.
    milled(upright, &[("spin", json!({"reference": [0.02, 0, -1]}))]);
    let words = refused(&[("spin", json!({"reference": "w"}))]);
    assert_eq!(words.field(), Some("spin.reference"));
    assert!(words.to_string().contains("`auto`, `x`, `y`, `z`"), "{words}");
}

#[test]
fn a_reference_survives_its_json() {
    for reference in [json!("x"), json!("y"), json!("z"), json!([0.0, 1.0, 0.5])] {
        let text = job_text(&[("spin.reference", reference.clone())]);
        let job = armill::Job::from_json(&text).unwrap();
        let written: Value = serde_json::from_str(&job.to_json()).unwrap();
        assert_eq!(written["spin"]["reference"], reference);
    }
    let job = armill::Job::from_json(r#"{"spin":{"reference":"auto"}}"#).unwrap();
    assert_eq!(job, armill::Job::default());
}

/// A path on which the axis goes from +Z over +X and +Y back to +Z, an octant of the sphere.
fn around_an_octant() -> String {
    "x,y,z,i,j,k\n1500,0,1000,0,0,1\n1510,0,1000,1,0,0\n1510,10,1000,0,1,0\n1500,0,1000,0,0,1".to_owned()
}

#[test]
fn where_no_axis_keeps_clear_the_spin_is_carried_without_twist() {
    let job = armill::Job::from_json(&job_text(&changes(&around_an_octant(), &[]))).unwrap();
    let path = armill::setup::Setup::of(&job, &mut armill::Progress::none()).unwrap().path;
    assert!(matches!(path.roll_reference(), RollReference::Carried(_)));
    // A vector carried around a loop on the sphere turns by the area within (Gauss and Bonnet): an
    // eighth of the sphere is a quarter turn, the way of the loop.
    let turn = path.carried_turn().unwrap().to_degrees();
    assert!((turn - 90.0).abs() < 1e-9, "{turn}");
    // Without twist: from one place to the next the x axis moves along the tool axis alone.
    let count = 3000;
    let at = |k: i32| {
        let s = path.length() * f64::from(k) / f64::from(count);
        (path.axis(s), path.orientation(s, &path.axis(s), 0.0).column(0).into_owned())
    };
    let mut twist = 0.0_f64;
    for k in 0..count {
        let ((from, x), (to, next)) = (at(k), at(k + 1));
        let axis = (from + to).normalize();
        // Of the whole turn only what is about the tool axis.
        twist += axis.dot(&x.cross(&next)).abs();
        assert!(angle_between(&x, &next) < 0.002, "at {k}");
    }
    // A turn of 0.1 deg a step leaves its cube as twist.
    assert!(twist < 1e-4, "{twist}");
    assert!((at(count).1 - Vector3::y()).norm() < 1e-9, "a quarter turn later, X is Y");
}

#[test]
fn the_clearance_along_a_way_is_the_least_of_all_places() {
    let mut random = fastrand::Rng::with_seed(15);
    let mut any = || any_vector(&mut random, 1.0).normalize();
    let steps = 2000;
    let mut between = 0;
    for _ in 0..200 {
        let (from, to, direction) = (any(), any(), any());
        let arc = AxisArc::between(&from, &to);
        let off = |k: i32| {
            let angle = angle_between(&arc.at(arc.angle() * f64::from(k) / f64::from(steps)), &direction);
            angle.min(PI - angle)
        };
        let (least, at) = (0..=steps).map(|k| (off(k), k)).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
        between += i32::from(at > 0 && at < steps);
        let clearance = arc.clearance(&direction);
        // The nearest place is at most half a step from one of these.
        assert!(clearance <= least + 1e-12, "{clearance}, not {least}");
        assert!(least - clearance <= arc.angle() / f64::from(steps), "{clearance}, not {least}");
        assert!((arc.at(arc.angle()) - to).norm() < 1e-12);
    }
    assert!(between > 30, "{between} within the way");
}

#[test]
fn a_reversed_axis_has_a_way_even_along_x() {
    for (from, way) in
        [(Vector3::z(), Vector3::x()), (-Vector3::x(), Vector3::y()), (Vector3::y(), Vector3::x())]
    {
        let arc = AxisArc::between(&from, &-from);
        assert!((arc.at(PI / 2.0) - way).norm() < 1e-12 && (arc.angle() - PI).abs() < 1e-12);
    }
}

#[test]
fn a_carried_spin_is_remarked_with_its_turn() {
    let report = milled(&around_an_octant(), &[]);
    let remark = report.warnings.iter().find(|warning| warning.code == "spin-carried").unwrap();
    assert!(remark.message.contains("90.0 deg in each lap"), "{}", remark.message);
}

#[test]
fn a_program_of_a_carried_spin_has_the_orientation_of_the_run() {
    let report = milled(&around_an_octant(), &[]);
    let commanded_path = CommandedPath::of(&report);
    let command = Command::new(&report, &commanded_path, None, PostStyle::default()).unwrap();
    let arc_length = &report.plan.trajectory.timing.arc_length;
    let mut compared = 0;
    for point in command.moves.iter().flat_map(|commanded| commanded.points()) {
        // The ends of moves lie between samples.
        let Some(k) = arc_length.iter().position(|s| *s == point.s) else { continue };
        let tcp = forward::forward(&report.plan.robot, &report.compensation.q[k]);
        assert!((command.pose(point).rotation - tcp.rotation).norm() < 1e-9, "sample {k}");
        compared += 1;
    }
    assert!(compared > 20, "{compared} points");
    // Read as a program, it carries its own.
    let run = replay::run(&report, &commanded_path, &command.program()).unwrap();
    assert!(run.largest() < 1e-5, "{}", run.largest());
}
