//! The remaining wall.

use super::{DEG, brute};
use crate::common::{column, run};
use armill::cutting::{Cut, Engagement};
use serde_json::json;
use std::f64::consts::PI;

#[test]
fn the_wall_is_left_by_the_instant_that_makes_it() {
    let line = ("path", json!({"kind":"line","from_mm":[600,-20,100],"to_mm":[600,20,100]}));
    let report = run(&[line.clone(), ("shaper", json!("none"))]);
    let walls = report.walls();
    assert_eq!(walls.len(), 1, "climb milling leaves the wall on the right");
    let wall = &walls[0];
    assert_eq!(wall.side, -1.0);
    // Over all cutting samples, those at less than the programmed feed among them. Feed along +y, so
    // into the part on the right is +x.
    let samples = report.force.iter().filter(|force| force.norm() > 0.0).count() as f64;
    let mean = column(&report, "force_x_n").iter().sum::<f64>() / samples;
    assert!((wall.mean_force_n - mean).abs() < 1e-9, "{wall:?} {mean}");
    // Static, at a nearly constant pose: the deviation by the mean force is the deflection across
    // the feed (here x of the base).
    let across = column(&report, "deflection_x_mm");
    let average = across.iter().sum::<f64>() / samples;
    assert!((wall.by_mean_force_mm - average).abs() < 1e-9 * average.abs().max(1.0), "{wall:?} {average}");
    // Force when the edge passes 180 deg at the height z: another tooth is at 90 deg plus the lag;
    // brute force over thin slices.
    let cut = report.setup().cut;
    let lag = 2.0 * cut.helix.tan() / cut.diameter;
    let heights = 24;
    let mut sum = 0.0;
    for k in 0..heights {
        let z = 0.010 * (f64::from(k) + 0.5) / f64::from(heights);
        sum -= brute(&cut, PI + lag * z, 1e-4, 20_000).y / f64::from(heights);
    }
    // This material has no edge force, so all forces are in proportion.
    let share = report.force.iter().map(|f| f.norm()).sum::<f64>() / samples / report.mean_force().norm();
    let ours = wall.instant_force_n / share;
    assert!((ours - sum).abs() < 1e-3 * sum.abs(), "{ours} against {sum}");
    // With a corner, the wall is evaluated from the corner up.
    let bull = Cut { corner_radius: 0.002, ..cut };
    for (k, instant) in (0..heights).zip(&bull.walls()[0].instants) {
        let z = 0.002 + 0.008 * (f64::from(k) + 0.5) / f64::from(heights);
        let slices = brute(&bull, PI + lag * z, 1e-4, 20_000);
        assert!(
            (instant.at(1e-4) - slices).norm() < 5e-3 * slices.norm(),
            "{k}: {instant:?} against {slices}"
        );
    }
    // Straight flutes form the wall when the tooth no longer cuts and the next one is just
    // entering.
    let cut = Cut { helix: 0.0, ..cut };
    let one = Cut { flutes: 2, ..cut };
    assert!(one.walls()[0].instants.iter().all(|force| force.at(1e-4).norm() < 1e-6), "nothing cuts then");
    // An engagement that reaches neither side leaves no wall; a slot leaves two.
    let count = |entry: f64, exit: f64| {
        let engagement = Engagement::Angles { entry: entry * DEG, exit: exit * DEG };
        Cut { engagement, ..cut }.walls().len()
    };
    assert_eq!([count(30.0, 150.0), count(0.0, 150.0), count(0.0, 180.0)], [0, 1, 2]);
    // A ball cut as deep as its radius has no cylinder in the part: its wall is evaluated from the
    // tip up, as for a slightly shallower cut.
    let ball = |depth: f64| {
        let engagement = Engagement::Slot;
        Cut { corner_radius: 0.005, axial_depth: depth, engagement, helix: 30.0 * DEG, ..cut }.walls()
    };
    for (whole, less) in ball(0.005).iter().zip(ball(0.005 - 1e-12)) {
        for (a, b) in whole.instants.iter().zip(less.instants) {
            assert!((a.at(1e-4) - b.at(1e-4)).norm() < 1e-6 * a.at(1e-4).norm());
        }
    }
}

#[test]
fn a_wait_does_not_change_the_wall() {
    // Nothing is cut while the tool waits.
    let walls = |dwell: f64| {
        let text = format!("G21 G90 S4000 M3\nG1 X600 Y-40 Z100 F2400\nG1 Y0\nG4 P{dwell}\nG1 Y40");
        run(&[("path", json!({"kind":"gcode","text":text})), ("shaper", json!("none"))]).walls()
    };
    let (none, long) = (walls(0.5), walls(30.0));
    for (a, b) in none.iter().zip(&long) {
        // A sample more or less while the tool gains speed.
        assert!((a.mean_force_n - b.mean_force_n).abs() < 0.05 * a.mean_force_n.abs(), "{a:?} {b:?}");
        assert!((a.at_instant_mm - b.at_instant_mm).abs() < 0.05 * a.at_instant_mm.abs(), "{a:?} {b:?}");
    }
}
