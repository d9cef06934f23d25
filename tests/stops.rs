//! Where the path stops: at corners of the course, not at those of its rounded points.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]

use crate::common::run;
use armill::Report;
use serde_json::json;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

type Points = Vec<[f64; 2]>;

/// Points in the plane, at z = 900, to so many decimals.
fn csv(points: &Points, decimals: usize) -> String {
    let mut text = String::from("x,y,z\n");
    let mut last = String::new();
    for [x, y] in points {
        let row = format!("{x:.decimals$},{y:.decimals$},900");
        if row != last {
            writeln!(text, "{row}").unwrap();
        }
        last = row;
    }
    text
}

fn travelled(text: &str) -> Report {
    run(&[
        ("robot", json!({"preset":"kuka-kr-210-2"})),
        ("path", json!({"kind":"csv","text":text})),
        ("motion", json!({"feed_mm_s":50,"acceleration_mm_s2":500,"sample_time_s":0.01})),
        ("shaper", json!({"kind":"zvd","frequency_hz":10,"damping":0.03})),
        ("cutting.axial_depth_mm", json!(0)),
    ])
}

fn circle(radius: f64, spacing: f64) -> Points {
    let count = (TAU * radius / spacing).round() as usize;
    let at = |k: usize| TAU * k as f64 / count as f64;
    (0..=count).map(|k| [1700.0 + radius * at(k).cos(), radius * at(k).sin()]).collect()
}

/// Noise of no more than +-`size`, the same each time.
fn noise(k: usize, size: f64) -> f64 {
    let hashed = (k as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x5851_F42D_4C95_7F2D;
    let hashed = hashed.wrapping_mul(0xD1B5_4A32_D192_ED03);
    ((hashed >> 40) as f64 / 8_388_608.0 - 1.0) * size
}

/// Time of a stretch from rest to rest [s].
fn trapezoid(length: f64) -> f64 {
    length / 50.0 + 50.0 / 500.0
}

#[test]
fn a_circle_of_rounded_points_does_not_stop() {
    // 62.8 mm at 50 mm/s, started and stopped at 500 mm/s^2: 1.36 s; the steps to the side make the
    // rounded circle up to 4 % longer. Settling is 0.1 s.
    for (radius, spacing, decimals) in
        [(10.0, 0.05, 2), (10.0, 0.05, 3), (10.0, 0.01, 3), (10.0, 0.02, 2), (2.0, 0.05, 2), (1.0, 0.03, 2)]
    {
        let report = travelled(&csv(&circle(radius, spacing), decimals));
        let right = trapezoid(TAU * radius) + 0.1;
        assert_eq!(report.plan.trajectory.stops.len(), 0, "{radius} {spacing} {decimals}");
        let took = report.duration();
        assert!(
            (right..right * 1.3).contains(&(took + 0.02)),
            "{radius} {spacing} {decimals}: {took} {right}"
        );
    }
}

#[test]
fn a_line_with_a_micrometre_of_noise_does_not_stop() {
    let points = (0..=3000).map(|k| [1700.0 + noise(k, 0.001), f64::from(k as u32) * 0.02]).collect();
    let report = travelled(&csv(&points, 6));
    assert_eq!(report.plan.trajectory.stops.len(), 0);
    assert!((1.3..1.45).contains(&report.duration()), "{}", report.duration());
}

/// A regular polygon with `corners` corners and sides of 20 mm, in points every `spacing`.
fn polygon(corners: usize, spacing: f64) -> Points {
    let mut at = [1700.0, 0.0];
    let mut points = vec![at];
    for side in 0..corners {
        let (sin, cos) = (TAU * side as f64 / corners as f64).sin_cos();
        let steps = (20.0 / spacing).round() as usize;
        for k in 1..=steps {
            let s = 20.0 * k as f64 / steps as f64;
            points.push([at[0] + s * cos, at[1] + s * sin]);
        }
        at = [at[0] + 20.0 * cos, at[1] + 20.0 * sin];
    }
    points
}

#[test]
fn a_corner_of_dense_points_is_a_corner() {
    // A closed polygon starts and ends in one of its corners. From 15 deg on nothing is in doubt.
    for corners in [3, 4, 6, 12, 24] {
        for (spacing, decimals) in [(20.0, 6), (0.5, 6), (0.1, 3), (0.05, 6), (0.05, 2), (0.01, 3)] {
            let stops = travelled(&csv(&polygon(corners, spacing), decimals)).plan.trajectory.stops.clone();
            let places: Vec<f64> = stops.iter().map(|stop| stop.s * 1e3).collect();
            // Rounded points may put one corner in two places that are next to each other.
            let mut apart = places.clone();
            apart.dedup_by(|b, a| *b - *a < 0.1);
            assert_eq!(apart.len(), corners - 1, "{corners} {spacing} {decimals}: {places:?}");
            let share = places.last().unwrap() / (corners as f64 - 1.0);
            for (k, s) in apart.iter().enumerate() {
                assert!(
                    (s - share * (k as f64 + 1.0)).abs() < 0.3,
                    "{corners} {spacing} {decimals}: {places:?}"
                );
            }
        }
    }
}

#[test]
fn a_short_move_does_not_hide_a_corner() {
    // Two legs at a right angle, a chamfer of any size between them: it stops once or twice.
    for chamfer in [1e-4, 0.001, 0.005, 0.01, 0.02, 0.1, 0.5, 2.0] {
        let points = vec![[1700.0, 0.0], [1700.0, 20.0 - chamfer], [1700.0 + chamfer, 20.0], [1720.0, 20.0]];
        let stops = travelled(&csv(&points, 6)).plan.trajectory.stops.len();
        assert!((1..=2).contains(&stops), "{chamfer}: {stops}");
    }
}

#[test]
fn a_step_to_the_side_does_not_hide_a_way_back() {
    for step in [0.002, 0.01, 0.011, 0.012, 0.015, 0.02, 0.05] {
        let raster: Points = (0..20)
            .flat_map(|line: u32| {
                let y = f64::from(line) * step;
                let ends = [[1700.0, y], [1720.0, y]];
                if line.is_multiple_of(2) { ends } else { [ends[1], ends[0]] }
            })
            .collect();
        let stops = travelled(&csv(&raster, 6)).plan.trajectory.stops.len();
        assert!((19..=38).contains(&stops), "{step}: {stops}");
    }
    // A right angle whose corner is a chamfer, between dense points.
    for chamfer in [0.012, 0.014, 0.016, 0.02, 0.03] {
        let leg = |k: u32| f64::from(k) * 0.05;
        let mut points: Points = (0..400).map(|k| [1700.0 + leg(k), 0.0]).collect();
        points.extend([[1720.0 - chamfer, 0.0], [1720.0, chamfer]]);
        points.extend((1..=400).map(|k| [1720.0, leg(k)]));
        points.retain(|p| p[0] <= 1720.0 - chamfer || p[1] >= chamfer);
        let stops = travelled(&csv(&points, 6)).plan.trajectory.stops.len();
        assert!((1..=2).contains(&stops), "{chamfer}: {stops}");
    }
}

#[test]
fn right_angles_in_a_row_are_not_one_corner() {
    // A stair of 60 steps of 0.09 mm: corners within 0.1 mm are one, so there are half as many, or more.
    let stair: Points =
        (0..=60_u32).map(|k| [1700.0 + f64::from(k / 2) * 0.09, f64::from(k.div_ceil(2)) * 0.09]).collect();
    let stops = travelled(&csv(&stair, 6)).plan.trajectory.stops.len();
    assert!((25..=59).contains(&stops), "{stops}");
}

#[test]
fn a_fillet_of_dense_points_stops_nowhere() {
    // Between legs of 20 mm, rounded points every 0.03 mm.
    for radius in [0.5, 1.0, 3.0] {
        let mut points = vec![[1700.0, 0.0], [1700.0, 20.0 - radius]];
        let count = (radius * PI / 2.0 / 0.03) as usize;
        for k in 1..=count {
            let (sin, cos) = (PI / 2.0 * k as f64 / count as f64).sin_cos();
            points.push([1700.0 + radius * (1.0 - cos), 20.0 - radius + radius * sin]);
        }
        points.push([1720.0, 20.0]);
        for decimals in [2, 3, 6] {
            let stops = travelled(&csv(&points, decimals)).plan.trajectory.stops.len();
            assert_eq!(
                stops,
                0,
                "{radius} {decimals} {:?}",
                travelled(&csv(&points, decimals)).plan.trajectory.stops
            );
        }
    }
}

#[test]
fn the_number_of_stops_and_their_time_are_said() {
    // 40 corners of a saw with legs of 1 mm. Each leg from rest to rest takes 2 sqrt(s / a).
    let saw: Points = (0..=41).map(|k| [1700.0 + f64::from(k), if k % 2 == 0 { 0.0 } else { 1.0 }]).collect();
    let report = travelled(&csv(&saw, 6));
    let leg = 2f64.sqrt();
    let stopping = 41.0 * 2.0 * (leg / 500.0).sqrt() + 40.0 * report.setup().limits.corner_dwell;
    let summary = report.summary();
    assert_eq!(summary.stops.count, 40);
    assert!((summary.stops.corners_s - (stopping - trapezoid(41.0 * leg))).abs() < 1e-9);
    let warning = summary.warnings.iter().find(|warning| warning.code == "many-stops").unwrap();
    assert!(warning.message.contains("stops 40 times") && warning.message.contains("sharper than 5 deg"));
    // A program's own waits are no corners.
    let waits =
        run(&[("path", json!({"kind":"gcode","text":"G21 G90 G0 X0 Y0 Z0\nG1 X10 F600\nG4 P2\nG1 X20"}))]);
    let summary = waits.summary();
    assert_eq!((summary.stops.count, summary.stops.corners_s), (1, 0.0));
    assert!(summary.warnings.iter().all(|warning| warning.code != "many-stops"));
}

#[test]
fn a_polygon_of_long_sides_stops_as_ever() {
    // Sides of 1 mm turn by 6 deg, more than the limit of 5: a coarse circle is a polygon.
    let points = circle(1.0 / (2.0 * (PI / 60.0).sin()), 1.0).clone();
    let count = points.len() - 1;
    assert!((59..=61).contains(&count));
    assert_eq!(travelled(&csv(&points, 6)).plan.trajectory.stops.len(), count - 1);
}
