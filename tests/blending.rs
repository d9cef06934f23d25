//! What blended corners and exact stops do, against closed forms.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]

use crate::common::run;
use armill::setup::Controller;
use armill::verification::{Package, Programs};
use serde_json::{Value, json};

/// Legs of 40 mm in the plane, each turned from the one before by `turn` [deg], without a cut: what is
/// left of the error is that of the program.
fn package(controller: Controller, turn: f64, legs: usize, more: &[(&'static str, Value)]) -> Package {
    let (mut at, mut heading) = ([0.0, 0.0], 0.0_f64);
    let mut points = vec![[0.0, 0.0, 0.0]];
    for _ in 0..legs {
        at = [at[0] + 40.0 * heading.cos(), at[1] + 40.0 * heading.sin()];
        points.push([at[0], at[1], 0.0]);
        heading += turn.to_radians();
    }
    let mut changes = vec![
        ("robot", json!({"preset":"kuka-kr-210-2"})),
        ("workpiece_frame", json!({"xyz_mm":[1500,0,700],"rpy_deg":[0,0,0]})),
        ("path", json!({"kind":"polyline","points_mm":points})),
        ("shaper", json!("none")),
        ("cutting.axial_depth_mm", json!(0)),
        (
            "motion",
            json!({"feed_mm_s":20,"acceleration_mm_s2":500,"sample_time_s":0.0002,"corner_angle_deg":170}),
        ),
        // The file is not to be compensated for its own corners.
        ("compensation", json!({"max_passes":0,"tolerance_mm":0.1})),
    ];
    changes.extend(more.iter().cloned());
    Programs::default().package(&run(&changes), Some(controller)).unwrap()
}

#[test]
fn a_blended_corner_is_cut_by_a_parabola() {
    // It touches both legs at the distance d, and passes the corner at h = d sin(turn / 2) / 2; from
    // there to the nearer leg it is h cos(turn / 2) = d sin(turn) / 4.
    for turn in [20.0_f64, 45.0, 70.0, 90.0] {
        for d in [0.2, 1.0, 4.0] {
            let made = package(Controller::Kuka, turn, 2, &[("program.blending_mm", json!(d))]);
            let right = d * turn.to_radians().sin() / 4.0;
            assert!(
                (made.max_mm - right).abs() < 0.01 * right + 1e-3,
                "{turn} {d}: {} and {right}",
                made.max_mm
            );
            assert_eq!((made.stops, made.blending), (0, d), "{turn} {d}");
            let missed = d * (turn.to_radians() / 2.0).sin() / 2.0;
            assert!((made.missed_mm - missed).abs() < 0.01 * missed + 3e-3, "{turn} {d}: {}", made.missed_mm);
            assert!(made.p95_mm >= made.missed_mm - 1e-9);
        }
    }
    // Half of either leg is the most.
    let made = package(Controller::Abb, 90.0, 2, &[("program.blending_mm", json!(50))]);
    assert!((made.max_mm - 20.0 / 4.0).abs() < 0.02, "{}", made.max_mm);
}

#[test]
fn a_share_of_the_speed_is_a_distance_of_overlapping_ramps() {
    // v^2 / (2 a) is 0.4 mm at 20 mm/s and 500 mm/s^2: a given distance is a share of it.
    for (given, share) in [(0.1, 25.0), (0.4, 100.0), (5.0, 100.0)] {
        let made = package(Controller::Fanuc, 90.0, 2, &[("program.blending_mm", json!(given))]);
        let right = 0.4 * share / 100.0 / 4.0;
        assert_eq!(made.blending, share);
        assert!((made.max_mm - right).abs() < 0.02 * right + 2e-3, "{given}: {} and {right}", made.max_mm);
    }
}

#[test]
fn exact_stops_take_the_time_of_their_trapezoids() {
    for legs in [1, 2, 5] {
        let made = package(Controller::Kuka, 10.0, legs, &[("program.blending_mm", json!(0))]);
        // From rest to rest over 40 mm, and a sample of 0.2 ms before the next starts.
        let n = legs as f64;
        let right = n * (40.0 / 20.0 + 20.0 / 500.0) + (n - 1.0) * 0.0002;
        assert!((made.duration_s - right).abs() < 0.003, "{legs}: {} and {right}", made.duration_s);
        assert_eq!(made.stops, legs - 1);
        assert!(made.max_mm < 2e-3, "{}", made.max_mm);
    }
}

#[test]
fn a_blended_program_runs_through() {
    // The parabola of d = 4 mm at a right angle has a radius of d cos^2 / sin = 2.83 mm at its vertex:
    // 20 mm/s need 141 mm/s^2 there, less than 500; it is d (1 + asinh(1) / sqrt(2)) long, not 2 d.
    let made = package(Controller::Kuka, 90.0, 2, &[("program.blending_mm", json!(4))]);
    let parabola = 4.0 * (1.0 + 1f64.asinh() / 2f64.sqrt());
    let right = (36.0 + parabola + 36.0) / 20.0 + 20.0 / 500.0;
    assert!((made.duration_s - right).abs() < 0.01, "{} and {right}", made.duration_s);
    // With 50 mm/s^2 it is run at sqrt(50 * 2.83) = 11.9 mm/s: slower than at the feed.
    let soft = json!({"feed_mm_s":20,"acceleration_mm_s2":50,"sample_time_s":0.001,"corner_angle_deg":170});
    let slow = package(Controller::Kuka, 90.0, 2, &[("program.blending_mm", json!(4)), ("motion", soft)]);
    let at_feed = (36.0 + parabola + 36.0) / 20.0 + 20.0 / 50.0;
    assert!(slow.duration_s > at_feed + 0.1, "{} and {at_feed}", slow.duration_s);
}

#[test]
fn the_blending_is_as_long_as_the_tolerance_allows() {
    // With exact numbers, p95 is nominal. The corner itself is missed by d sin(45 deg) / 2: 0.1, 0.3, 1
    // and 3 mm leave 0.035, 0.106, 0.354 and 1.06 mm.
    let sure = ("uncertainty", json!({"stiffness_percent":0,"cutting_percent":0}));
    for (tolerance, blending) in [(0.05, 0.1), (0.2, 0.3), (0.5, 1.0), (1.2, 3.0)] {
        let compensation = json!({"max_passes":0,"tolerance_mm":tolerance});
        let made = package(Controller::Kuka, 90.0, 3, &[("compensation", compensation), sure.clone()]);
        assert_eq!(made.blending, blending, "{tolerance}");
        assert!(made.p95_mm <= tolerance, "{tolerance}: {}", made.sentence);
    }
    // Where no blending is short enough, the shortest is taken, and the tolerance is said to be missed.
    let made = package(
        Controller::Kuka,
        90.0,
        3,
        &[("compensation", json!({"max_passes":0,"tolerance_mm":0.01})), sure],
    );
    assert!(!made.met && made.blending == 0.1, "{} {}", made.blending, made.p95_mm);
    // Corners passed at full speed are more than the joints can do: that is said first.
    assert!(made.sentence.contains("cannot run; if it could"), "{}", made.sentence);
}

/// A G-code program on the KUKA, without a cut.
fn of_gcode(controller: Controller, text: &str, more: &[(&'static str, Value)]) -> Package {
    let mut changes = vec![
        ("robot", json!({"preset":"kuka-kr-210-2"})),
        ("workpiece_frame", json!({"xyz_mm":[1500,0,700],"rpy_deg":[0,0,0]})),
        ("path", json!({"kind":"gcode","text":text})),
        ("shaper", json!("none")),
        ("cutting.axial_depth_mm", json!(0)),
        ("motion", json!({"acceleration_mm_s2":500,"sample_time_s":0.002})),
        ("compensation", json!({"max_passes":0,"tolerance_mm":0.5})),
    ];
    changes.extend(more.iter().cloned());
    Programs::default().package(&run(&changes), Some(controller)).unwrap()
}

#[test]
fn a_way_back_is_no_error() {
    // The tool goes back the way it came: the path itself is exact.
    for text in [
        "G21 G90 G0 X0 Y0 Z0\nG1 F1800 X40\nG1 X0\nG1 X60",
        "G21 G90 G0 X0 Y0 Z2\nG1 F1800 Z-2\nG0 Z2\nG1 Z-4\nG0 Z2\nG1 Z-6\nG0 Z2",
        "G21 G90 G0 X10 Y10 Z5\nG83 X10 Y10 Z-6 R1 Q2 F600\nG80 G0 X20",
    ] {
        for (controller, blending) in
            [(Controller::Kuka, 0.0), (Controller::Gcode, 0.0), (Controller::Kuka, 0.2)]
        {
            let made = of_gcode(controller, text, &[("program.blending_mm", json!(blending))]);
            assert!(made.max_mm < 0.02, "{controller:?} {blending}: {} of {text}", made.max_mm);
        }
    }
}

#[test]
fn arcs_that_touch_are_blended_without_a_stop() {
    // Three half circles of 5 mm and straight lines that touch them.
    let text = "G21 G90 G17 G0 X0 Y0 Z0\nG1 F3000 X30\nG3 X30 Y10 J5\nG1 X0\nG2 X0 Y20 J5\nG1 X30\nG3 X30 Y30 J5\nG1 X0";
    let reference = of_gcode(Controller::Kuka, text, &[("program.blending_mm", json!(0.1))]);
    for blending in [json!(0.3), json!(1), json!(3), json!("tolerance")] {
        let made = of_gcode(Controller::Kuka, text, &[("program.blending_mm", blending.clone())]);
        assert_eq!(made.stops, 0, "{blending}");
        assert!(made.duration_s < reference.duration_s * 1.01, "{blending}: {}", made.duration_s);
        assert!(made.max_mm < 0.5, "{blending}: {}", made.max_mm);
    }
}

#[test]
fn arcs_that_bend_in_turn_are_blended_without_a_stop() {
    let text = "G21 G90 G17 G0 X0 Y0 Z0\nG1 X40 F1800\nG3 X42 Y2 I0 J2\nG2 X44 Y4 I2 J0\nG1 X84";
    for blending in [0.2, 0.8, 1.5] {
        let made = of_gcode(Controller::Kuka, text, &[("program.blending_mm", json!(blending))]);
        assert_eq!(made.stops, 0, "{blending}");
    }
}

#[test]
fn passes_over_the_same_line_all_stay() {
    // There, back and there again, where the job itself stops at no corner.
    let text = "G21 G90 G0 X0 Y0 Z0\nG1 F1800 X60\nG1 X0\nG1 X60\nG1 X0";
    let motion = json!({"acceleration_mm_s2":500,"sample_time_s":0.002,"corner_angle_deg":180});
    let made = of_gcode(Controller::Kuka, text, &[("motion", motion)]);
    assert_eq!((made.points, made.stops), (5, 3));
    assert!((made.duration_s - 4.0 * (60.0 / 30.0 + 30.0 / 500.0)).abs() < 0.02, "{}", made.duration_s);
}
