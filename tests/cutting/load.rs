//! Load along the path: chip by speed, and run-in.

use super::half;
use crate::common::{column, run};
use armill::cutting::{Cut, Engagement};
use serde_json::{Value, json};
use std::f64::consts::PI;

/// Mean force of a milled line by hand at each sample [N]: the whole force's parts, from a job without
/// edges and a job at no feed, times speed and run-in.
fn by_hand(changes: &[(&str, Value)], feed: f64, length_mm: f64) {
    let report = run(changes);
    let setup = report.setup();
    let (speed, s, run_in) =
        (column(&report, "feed_mm_s"), column(&report, "arc_length_mm"), column(&report, "run_in"));
    let c = report.feed_per_tooth();
    for k in 0..report.samples() {
        let u = (s[k] / length_mm).min(1.0);
        let w = 3.0 * u * u - 2.0 * u * u * u;
        assert!((run_in[k] - w).abs() < 1e-9, "{} after {} mm, by hand {w}", run_in[k], s[k]);
        let ratio = speed[k] / feed;
        let mean = setup.cut.mean_force();
        let mean = mean.cutting * (c * ratio) + mean.edge * (10.0 * ratio).min(1.0);
        let (ours, expected) = (report.force[k].norm(), mean.norm() * w);
        assert!((ours - expected).abs() < 1e-9 * report.mean_force().norm(), "{k}: {ours} N, {expected} N");
    }
    let full = report.force.iter().map(|force| force.norm()).fold(0.0, f64::max);
    assert!((full - report.mean_force().norm()).abs() < 1e-9 * full, "the summary's force is the full one");
    assert!(
        report.force[0].norm() == 0.0 && report.force[report.samples() - 1].norm() == 0.0,
        "none at rest"
    );
}

#[test]
fn the_chip_follows_the_speed() {
    let line = ("path", json!({"kind":"line","from_mm":[600,-100,100],"to_mm":[600,100,100]}));
    let common = [line, ("material", json!({"preset":"al-7075-t6"})), ("shaper", json!("none"))];
    // A quarter turn of a 10 mm tool is 5 mm of radial depth: the run-in is sqrt(5 (10 - 5)) mm.
    let stated = [&common[..], &[("cutting.feed_per_tooth_mm", json!(0.07))]].concat();
    by_hand(&stated, 100.0, 5.0);
    let from_feed = [&common[..], &[("cutting.feed_per_tooth_mm", json!("from_feed"))]].concat();
    by_hand(&from_feed, 100.0, 5.0);
    // 100 mm/s at 4000 rpm and four flutes are 0.375 mm: stated or not, it is the same cut.
    let same = [&common[..], &[("cutting.feed_per_tooth_mm", json!(0.375))]].concat();
    for (a, b) in run(&from_feed).force.iter().zip(run(&same).force.iter()) {
        assert!((a - b).norm() < 1e-9);
    }
}

#[test]
fn a_program_s_chip_holds_at_its_own_feed() {
    // The stated chip is that of each move's F, 600 and 1200 mm/min, not of the job's feed.
    let text = "G21 G90 S4000 M3\nG0 X600 Y-40 Z100\nG1 Y0 F600\nY60 F1200";
    let report = run(&[
        ("path", json!({"kind":"gcode","text":text})),
        ("motion.feed_mm_s", json!(50)),
        ("material", json!({"preset":"al-7075-t6"})),
        ("shaper", json!("none")),
    ]);
    let (speed, line) = (column(&report, "feed_mm_s"), column(&report, "program_line"));
    let full = report.mean_force();
    for (at, feed) in [(3.0, 10.0), (4.0, 20.0)] {
        let reached = (0..report.samples()).filter(|&k| line[k] == at && (speed[k] - feed).abs() < 1e-9);
        let reached: Vec<_> = reached.collect();
        assert!(reached.len() > 100, "line {at} reaches its feed");
        let last = *reached.last().unwrap();
        assert!((report.force[last].norm() - full.norm()).abs() < 1e-9 * full.norm(), "line {at}");
    }
}

#[test]
fn the_run_in_is_the_way_from_the_first_touch_to_full_engagement() {
    for depth in [0.0004, 0.002, 0.0059, 0.006, 0.009, 0.012] {
        // The tool enters a block with its front across the feed and its side `depth` deep. How far
        // before the front is its axis when a point of its edge first touches?
        let touch = (0..=100_000)
            .map(|step| PI * f64::from(step) / 100_000.0)
            .filter(|phi| 0.006 * phi.cos() <= -(0.006 - depth) + 1e-12)
            .map(|phi| 0.006 * phi.sin())
            .fold(0.0, f64::max);
        for engagement in [Engagement::Climb(depth), Engagement::Conventional(depth)] {
            let ours = Cut { engagement, ..half() }.run_in();
            assert!((ours - touch).abs() < 1e-6, "{depth}: {ours} against {touch}");
        }
    }
    let of = |engagement| Cut { engagement, ..half() }.run_in();
    assert!((of(Engagement::Slot) - 0.006).abs() < 1e-15, "slot: half the diameter");
    // Stated angles: a_e = D / 2 |cos entry - cos exit|, here 6 (1 - cos 60) = 3 mm.
    let sixty = of(Engagement::Angles { entry: 0.0, exit: PI / 3.0 });
    assert!((sixty - (0.003_f64 * 0.009).sqrt()).abs() < 1e-12);
}

#[test]
fn a_cut_begins_after_rapids_and_plunges() {
    let text = "G21 G90 S4000 M3\nG0 X600 Y-40 Z105\nG1 Z100 F300\nY-10 F600\nX620\nG0 Z105\nY20\nZ100\n\
                G1 Y50 Z98\nG1 Y80";
    let report = run(&[("path", json!({"kind":"gcode","text":text})), ("shaper", json!("none"))]);
    let (run_in, line) = (column(&report, "run_in"), column(&report, "program_line"));
    let first = |at: f64| (0..report.samples()).find(|&k| line[k] == at).unwrap();
    // The plunge starts one, the move after it another; the corner and the ramp go on.
    for (at, fresh) in [(3.0, true), (4.0, true), (5.0, false), (9.0, true), (10.0, false)] {
        let begun = run_in[first(at)];
        assert_eq!(begun < 1e-3, fresh, "line {at}: {begun}");
    }
    for k in 0..report.samples() {
        let rapid = [2.0, 6.0, 7.0, 8.0].contains(&line[k]);
        assert!(!rapid || (run_in[k] == 0.0 && report.force[k].norm() == 0.0), "line {}", line[k]);
    }
    assert!(run_in.iter().all(|w| (0.0..=1.0).contains(w)) && run_in.contains(&1.0));
}

#[test]
fn nothing_is_cut_at_rest() {
    // A rectangle with sharp corners: whatever the chip, the tool waits on the path itself, and the
    // command there is the desired point.
    for chip in [json!(0.1), json!("from_feed")] {
        let report = run(&[
            ("path", json!({"kind":"rectangle","center_mm":[600,0,100],"width_mm":120,"height_mm":60})),
            ("material", json!({"preset":"al-7075-t6"})),
            ("motion.feed_mm_s", json!(40)),
            ("motion.corner_dwell", json!(0.4)),
            ("cutting.feed_per_tooth_mm", chip),
            ("shaper", json!("none")),
        ]);
        let speed = column(&report, "feed_mm_s");
        let mut waits = 0;
        for (k, speed) in speed.iter().enumerate() {
            if *speed == 0.0 {
                waits += 1;
                assert!(report.force[k].norm() == 0.0 && report.deflection[k].norm() == 0.0);
                // The inverse model closes to 1e-9 m.
                assert!(
                    report.compensation.correction[k].norm() < 1e-8,
                    "{}",
                    report.compensation.correction[k]
                );
            }
        }
        assert!(waits > 3 * 400, "{waits} samples at rest");
        assert!(report.compensation.converged, "{}", report.after.statistics.max);
    }
}

#[test]
fn figures_of_a_program_are_those_of_its_largest_chip() {
    let text = "G21 G90 S4000 M3\nG0 X600 Y-40 Z100\nG1 Y0 F600\nY60 F1200";
    let report = run(&[
        ("path", json!({"kind":"gcode","text":text})),
        ("motion.feed_mm_s", json!(100)),
        ("cutting.feed_per_tooth_mm", json!("from_feed")),
        ("material", json!({"preset":"al-7075-t6"})),
        ("shaper", json!("none")),
    ]);
    // 1200 mm/min at 4000 rpm and four flutes, not the job's 100 mm/s.
    assert!((report.summary().cut.feed_per_tooth_mm - 0.075).abs() < 1e-12);
    let largest = report.force.iter().map(|force| force.norm()).fold(0.0, f64::max);
    assert!((largest - report.mean_force().norm()).abs() < 1e-9 * largest);
}
