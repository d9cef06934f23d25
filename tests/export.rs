//! Exported files: thinning stays within its tolerance, orientations multiply back, every file
//! states its origin.
#![allow(clippy::disallowed_types, reason = "nalgebra's own rotations are the second way")]

use crate::common::program::{small_jobs, written};
use crate::common::{any_vector, between, run};
use armill::export::command::{COARSEST, FINEST};
use armill::export::fillet;
use armill::export::orientation::{about_moving_xyz, quaternion, roll_pitch_yaw};
use armill::export::thin::{LEVER, Point, deviation, thin};
use armill::export::{ExportOptions, FORMATS};
use armill::math::{Pose, angle_between, rotation_about, sin_cos};
use armill::path::gcode;
use armill::units::MM;
use armill::verification::export;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use serde_json::json;
use std::f64::consts::FRAC_PI_2;

/// Each point on its own.
fn alone(points: &[Point]) -> Vec<Vec<Point>> {
    points.iter().map(|point| vec![*point]).collect()
}

#[test]
fn thinned_lines_keep_every_point_within_the_tolerance() {
    let mut random = fastrand::Rng::with_seed(31);
    for case in 0..60 {
        let turn = between(&mut random, 0.0, 0.4);
        let (mut at, mut heading) = (Vector3::zeros(), Vector3::x());
        let mut axis = Vector3::z();
        let points: Vec<Point> = (0..random.usize(2..160))
            .map(|_| {
                heading = (heading + any_vector(&mut random, turn)).normalize();
                at += heading * 1e-3;
                if case % 2 == 0 {
                    axis = (axis + any_vector(&mut random, 1e-3)).normalize();
                }
                Point { position: at, axis, spin: 0.0, s: 0.0 }
            })
            .collect();
        let tolerance = between(&mut random, 1e-6, 1e-3);
        let kept = thin(&points, tolerance);
        assert_eq!((kept[0], kept[kept.len() - 1]), (0, points.len() - 1), "case {case}: the ends are kept");
        assert!(kept.is_sorted_by(|a, b| a < b), "case {case}");
        let left: Vec<Point> = kept.iter().map(|&k| points[k]).collect();
        // By brute force: each point against all moves, at 1,000 places of each, tip and axis
        // together.
        let worst = points
            .iter()
            .map(|p| {
                let moves = left.windows(2).flat_map(|pair| {
                    (0..=1000).map(|i| {
                        let t = f64::from(i) / 1000.0;
                        let tip = p.position - pair[0].position.lerp(&pair[1].position, t);
                        let axis = (p.axis - pair[0].axis.lerp(&pair[1].axis, t)) * LEVER;
                        tip.norm().max(axis.norm())
                    })
                });
                moves.fold(f64::INFINITY, f64::min)
            })
            .fold(0.0, f64::max);
        assert!(worst <= tolerance * 1.001 + 1e-8, "case {case}: {worst} of {tolerance}");
        let measured = deviation(&points, &kept, &alone(&left));
        assert!(measured <= tolerance, "case {case}: measured {measured} of {tolerance}");
    }
}

/// A corner in the middle of a move: rounding stays near it, turns nowhere by more than allowed,
/// and touches nothing else.
#[test]
fn a_fillet_leaves_out_a_corner() {
    const LIMIT: f64 = 0.07;
    let point = |x: f64, y: f64| Point {
        position: Vector3::new(x, y, 0.1) * MM,
        axis: Vector3::z(),
        spin: 0.0,
        s: 0.0,
    };
    for (turn, tolerance) in [(0.1_f64, 1e-6), (0.5, 1e-6), (1.5, 1e-5), (2.5, 1e-4), (0.5, 1.0)] {
        let (sin, cos) = sin_cos(turn);
        let after = point(2.0 + 2.0 * cos, 2.0 * sin);
        let points = [point(0.0, 0.0), point(2.0, 0.0), after];
        let standing = fillet::round(&points, 1, LIMIT, tolerance, 1e-8);
        let left_out = deviation(&points, &[0, 1, 2], &standing);
        let rounded = standing.concat();
        let count = (turn / LIMIT).ceil() as usize;
        assert_eq!(rounded.len(), 3 + count, "{turn}");
        assert_eq!((rounded[0], rounded[rounded.len() - 1]), (points[0], after));
        let moves: Vec<_> = rounded.windows(2).map(|ends| ends[1].position - ends[0].position).collect();
        for pair in moves.windows(2) {
            // The chords touch the arc's middle, so they turn by half at its ends.
            assert!(angle_between(&pair[0], &pair[1]) <= LIMIT + 1e-9, "{turn}");
        }
        assert!(left_out <= tolerance * (1.0 + 1e-9), "{turn}: {left_out}");
        // No less than allowed, up to the chord: as far from the corner as permitted, or up to the
        // middle of a move.
        let reach = (rounded[1].position - points[1].position).norm();
        assert!(left_out > 0.75 * tolerance || (reach - MM).abs() < 1e-12, "{turn}: {left_out} {reach}");
        // A corner that may turn, follows a rest, or cannot be rounded in such steps stays.
        assert_eq!(fillet::round(&points, 1, turn + 1e-6, tolerance, 1e-8).concat(), points);
        assert_eq!(fillet::round(&points, 2, LIMIT, tolerance, 1e-8).concat(), points);
        assert_eq!(fillet::round(&points, 1, LIMIT, tolerance, 1e-3).concat(), points);
    }
    let back = [point(0.0, 0.0), point(2.0, 0.0), point(1.0, 0.0)];
    assert_eq!(fillet::round(&back, 1, LIMIT, 1e-6, 1e-8).concat(), back);
}

#[test]
fn thinning_is_exact_on_lines_and_bears_a_million_points() {
    let line = |n: usize| -> Vec<Point> {
        (0..n)
            .map(|i| Point {
                position: Vector3::new(i as f64 * 1e-4, 0.0, 0.0),
                axis: Vector3::z(),
                spin: 0.0,
                s: 0.0,
            })
            .collect()
    };
    assert_eq!(thin(&line(1000), 1e-9), [0, 999]);
    assert_eq!(thin(&line(1), 1e-9), [0]);
    assert!(thin(&[], 1e-9).is_empty());
    // A helix: every span must be split, recursively.
    let helix: Vec<Point> = (0..1_000_000)
        .map(|i| {
            let angle = f64::from(i) * 1e-3;
            let (sin, cos) = sin_cos(angle);
            let position = Vector3::new(cos * 0.1, sin * 0.1, angle * 1e-3);
            Point { position, axis: Vector3::z(), spin: 0.0, s: 0.0 }
        })
        .collect();
    let kept = thin(&helix, 1e-6);
    // A chord of a circle of 100 mm within 1 um spans at most 8.9 mrad: ten steps, of which at
    // least eight are used.
    assert!((1_000_000 / 9..1_000_000 / 4).contains(&kept.len()), "{}", kept.len());
    assert!(deviation(&helix, &kept, &alone(&kept.iter().map(|&k| helix[k]).collect::<Vec<_>>())) <= 1e-6);
}

#[test]
fn orientations_multiply_back() {
    let mut random = fastrand::Rng::with_seed(5);
    let mut rotations: Vec<Matrix3<f64>> = (0..2000)
        .map(|_| rotation_about(&any_vector(&mut random, 1.0).normalize(), between(&mut random, -3.2, 3.2)))
        .collect();
    // Gimbal lock, exact and nearly so: pitch or ry of +-90 deg; half turns, where the quaternion's
    // scalar is zero.
    for sign in [1.0, -1.0] {
        for near in [0.0, 1e-15, 1e-12, 1e-9, 1e-6] {
            for roll in [0.0, 0.3, -2.5] {
                let pitch = sign * (FRAC_PI_2 - near);
                let locked = Pose::from_xyz_rpy(Vector3::zeros(), [roll, pitch, 1.1]).rotation;
                rotations.extend([locked, locked.transpose()]);
            }
        }
    }
    rotations.extend(
        [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| rotation_about(&axis, 2.0 * FRAC_PI_2)),
    );
    rotations.push(Matrix3::identity());
    for r in &rotations {
        let turn = |axis: Vector3<f64>, angle: f64| rotation_about(&axis, angle);
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        // FANUC: W, P, R about the fixed axes; KUKA: A about z, B about the new y, C about the new
        // x.
        let [roll, pitch, yaw] = roll_pitch_yaw(r);
        let fanuc = turn(z, yaw) * (turn(y, pitch) * turn(x, roll));
        let (a, b, c) = (yaw, pitch, roll);
        let about_new =
            |first: Matrix3<f64>, axis: Vector3<f64>, angle: f64| turn(first * axis, angle) * first;
        let kuka = about_new(about_new(turn(z, a), y, b), x, c);
        let [rx, ry, rz] = about_moving_xyz(r);
        let staubli = about_new(about_new(turn(x, rx), y, ry), z, rz);
        let [q1, q2, q3, q4] = quaternion(r);
        let abb =
            UnitQuaternion::new_unchecked(Quaternion::new(q1, q2, q3, q4)).to_rotation_matrix().into_inner();
        for (name, back) in [("fanuc", fanuc), ("kuka", kuka), ("staubli", staubli), ("abb", abb)] {
            assert!((back - r).norm() < 1e-9, "{name}: {r}");
        }
    }
}

/// The first lines of a file as running text: FANUC's remarks are short, a sentence spans several.
fn opening(text: &str) -> String {
    let lines = text.lines().take(80);
    let bare = lines
        .map(|line| line.trim_start_matches([' ', '!', ':', '$', '#', ';', '/']))
        .map(|line| line.split_once(":  !").map_or(line, |(_, rest)| rest).trim_end_matches([';', ' ']));
    bare.collect::<Vec<_>>().join(" ")
}

/// A short line 500 mm above the origin of the workpiece frame, with this robot and these frames.
fn line_of(
    robot: serde_json::Value,
    base: serde_json::Value,
    workpiece: serde_json::Value,
) -> armill::Report {
    run(&[
        ("robot", robot),
        ("base_frame", base),
        ("workpiece_frame", workpiece),
        ("path", json!({"kind":"line","from_mm":[0,-20,500],"to_mm":[0,20,500]})),
    ])
}

/// Frames from the foot of the arm against the same from its controller's world, by hand.
#[test]
fn the_parts_frame_is_counted_as_the_controller_counts() {
    let fanuc = json!({"preset":"fanuc-r-2000ic-165f"});
    let at = |xyz: [f64; 3], rpy: [f64; 3]| json!({"xyz_mm":xyz,"rpy_deg":rpy});
    let zero = at([0.0; 3], [0.0; 3]);
    let cases = [
        // At the height of the foot, 670 mm below axis 2.
        (
            zero.clone(),
            at([1500.0, 0.0, 0.0], [0.0; 3]),
            "x 1500.0 y 0.0 z -670.0 mm, roll 0.0 pitch 0.0 yaw 0.0 deg",
        ),
        // The arm on a plinth, turned to the left: what is 1500 mm to the left of it in the cell is
        // ahead of it, 100 mm above its foot; the part is turned by 30 deg in the cell.
        (
            at([100.0, 200.0, 300.0], [0.0, 0.0, 90.0]),
            at([100.0, 1700.0, 400.0], [0.0, 0.0, 30.0]),
            "x 1500.0 y 0.0 z -570.0 mm, roll 0.0 pitch 0.0 yaw -60.0 deg",
        ),
        // The arm on a wall: its axis 1 points along the cell's -y, and so does the way to axis 2.
        (
            at([0.0, 0.0, 1000.0], [90.0, 0.0, 0.0]),
            at([1500.0, -100.0, 1000.0], [90.0, 0.0, 0.0]),
            "x 1500.0 y 0.0 z -570.0 mm, roll 0.0 pitch 0.0 yaw 0.0 deg",
        ),
    ];
    for (base, workpiece, stated) in cases {
        let report = line_of(fanuc.clone(), base, workpiece);
        let text = opening(&written(&report, "fanuc").text);
        assert!(
            text.contains("The controller measures from axis 2, 670 mm above the foot of the arm"),
            "{text}"
        );
        assert!(text.contains(stated), "{stated}: {text}");
    }
    let beside = at([1500.0, 0.0, 0.0], [0.0; 3]);
    let report = line_of(fanuc, zero.clone(), beside.clone());
    for (id, frame) in [
        ("krl", "BASE_DATA[1]={X 1500.0,Y 0.0,Z -670.0,A 0.0,B 0.0,C 0.0}"),
        ("rapid", "[1500.0,0.0,-670.0]"),
        ("val3", "from axis 2, 670 mm above the foot"),
        ("gcode", "from axis 2, 670 mm above the foot"),
        ("apt", "from axis 2, 670 mm above the foot"),
        ("path-csv", "from axis 2, 670 mm above the foot"),
    ] {
        let text = written(&report, id).text;
        assert!(text.contains(frame), "{id}: {text}");
    }
    let staubli = line_of(json!({"preset":"staubli-tx2-90"}), zero.clone(), at([500.0, 0.0, 0.0], [0.0; 3]));
    let package = armill::verification::Programs::default().package(&staubli, None).unwrap();
    let data =
        package.files.iter().find(|file| file.path.ends_with(".dtx")).unwrap().text.replace("\r\n", "\n");
    let part = "type=\"frame\" size=\"1\">\n      \
                <Value key=\"0\" x=\"500.0\" y=\"0.0\" z=\"-478.0\" rx=\"0.0\" ry=\"0.0\" rz=\"0.0\" fatherId=\"world[0]\"";
    assert!(data.contains(part), "{data}");

    let kuka = line_of(json!({"preset":"kuka-kr-210-2"}), zero.clone(), beside.clone());
    let text = written(&kuka, "krl").text;
    assert!(text.contains("BASE_DATA[1]={X 1500.0,Y 0.0,Z 0.0,"), "{text}");
    assert!(text.contains("The controller measures from the foot of the arm\n"), "{text}");
    let mut own = json!({"joint_compliance_rad_per_nm":[0,0,0,0,0,0]});
    let links = armill::job::presets::presets().robots.into_iter().find(|robot| robot.id == "kuka-kr-210-2");
    own["modified_dh"] = json!(links.unwrap().modified_dh);
    let text = written(&line_of(own, zero, beside), "rapid").text;
    assert!(text.contains("is not known, so the foot of the arm is assumed: check it"), "{text}");
    assert!(text.contains("[1500.0,0.0,0.0]"), "{text}");
}

#[test]
fn every_program_says_where_it_comes_from_and_what_it_does_not_promise() {
    let report = run(&small_jobs()[0].1);
    let fingerprint = report.fingerprint();
    for format in FORMATS {
        let export = written(&report, format.id);
        assert!(export.file_name.ends_with(format.extension), "{}", format.id);
        if ["columns-csv", "compensated-csv", "correction-csv"].contains(&format.id) {
            assert_eq!(export.points, report.samples());
            continue;
        }
        let text = opening(&export.text);
        for piece in [
            env!("CARGO_PKG_VERSION"),
            "model 2, run",
            &fingerprint,
            "Tolerance 0.01 mm, largest contour error",
            "absolute-accuracy option adds its own error",
            "commands are meant for an input shaper, 18 rad/s, damping 0.1",
        ] {
            assert!(text.contains(piece), "{}: {piece}\n{text}", format.id);
        }
        if format.id != "joints-csv" {
            assert!(text.contains("Thinned to 0.001 mm"), "{}", format.id);
            assert!(
                // From the foot z is 150 mm, axis 2 is at 420 mm.
                text.contains("x 550.0 y 40.0 z -270.0 mm, roll 5.0 pitch -10.0 yaw 30.0 deg"),
                "{}",
                format.id
            );
            let robot = ["krl", "rapid", "val3", "fanuc"].contains(&format.id);
            // A robot's points are 0.1 mm apart at least, also where the correction sets in.
            let allowed = if robot { 1e-5 } else { 1e-6 };
            assert!(
                export.deviation > 0.0 && export.deviation <= allowed,
                "{}: {}",
                format.id,
                export.deviation
            );
            assert!(
                // An arc of 200 deg: few arcs replace many chords.
                export.points > if robot || format.id == "gcode" { 20 } else { 50 }
                    && export.points < report.samples() / 4,
                "{}: {}",
                format.id,
                export.points
            );
        }
        assert!(export.text.is_ascii(), "{}", format.id);
        let longest = export.text.lines().map(str::len).max().unwrap();
        assert!(longest < 256, "{}: a line of {longest}", format.id);
        assert_eq!(export, written(&report, format.id), "the same run gives the same text");
    }
    let error = export(&report, "dxf", &ExportOptions::default()).unwrap_err();
    assert_eq!((error.code(), error.field()), ("invalid", Some("format")));
    for thinning in [0.0, FINEST / 2.0, COARSEST * 2.0, f64::NAN] {
        let error = export(&report, "krl", &ExportOptions { thinning: Some(thinning) }).unwrap_err();
        assert_eq!((error.code(), error.field()), ("out-of-range", Some("thinning_mm")), "{thinning}");
    }
}

/// Programs that were read and then could not be written, or were written and could not be read
/// back (found by `cargo xtask fuzz`).
#[test]
fn odd_programs_are_written_so_that_they_are_read_again() {
    let moves = "G21 F6000 G0 X600 Y0 Z100\nG1 Y20\nX620\n";
    for (name, text) in [
        ("a byte order mark", format!("\u{feff}{moves}")),
        ("letters of any kind after the end", format!("{moves}M30\n\u{e4}1 \u{feff}\n")),
        ("lines before the program's number", format!("\n(PART)\n/M8\nO1002\n{moves}")),
    ] {
        let report = run(&[("path", json!({ "kind": "gcode", "text": text }))]);
        for format in FORMATS {
            let written = written(&report, format.id).text;
            if format.id == "gcode" {
                let read = gcode::program(&written, &gcode::Options::default(), |_| {});
                let read = read.unwrap_or_else(|error| panic!("{name}: {error}\n{written}"));
                assert!(read.moves.len() >= 2, "{name}");
            }
        }
    }
}
