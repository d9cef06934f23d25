//! A feed that holds the mean force: what it does to the path, and what not.
#![allow(clippy::disallowed_methods, reason = "independent values come from the standard library")]

use crate::common::{any_vector, between, column, in_stock, refused, run};
use armill::cutting::{ChipLoad, LinearForce, MeanForces};
use armill::export::ExportOptions;
use armill::path::{Move, MovePace};
use armill::setup::FeedByForce;
use armill::verification::Programs;
use armill::{Error, Report};
use nalgebra::Vector3;
use serde_json::{Value, json};

/// A groove from the left side into a plate and around a square, two rounds along it, each 4 mm further
/// out, which meet more in the corners; then an arc in what is cut already, and across it.
const POCKET: &str = "G21 G90\nG0 X-40 Y-10 Z5\nZ-3\nG1 X10 F900\nY10\nX-10\nY-10\nG1 X-14 Y-14\nX14\nY14\nX-14\nY-14\n\
                      G1 X-18 Y-18\nX18\nY18\nX-18\nY-18\nX0 Y-14 F600\nG3 X14 Y0 I0 J14\nG0 Z5\n";

/// The pocket in aluminium by a flat tool of 10 mm, with more keys of the motion.
fn job(text: &str, motion: Value) -> Vec<(&'static str, Value)> {
    let mut all = json!({"sample_time_s":0.004,"acceleration_mm_s2":2000});
    for (key, value) in motion.as_object().unwrap() {
        all[key] = value.clone();
    }
    let block = json!({"kind":"box","from_mm":[-30,-30,-20],"to_mm":[30,30,0]});
    in_stock::job(text, block, &[("motion", all)])
}

fn held() -> Report {
    run(&job(POCKET, json!({"feed_rule":"constant-force"})))
}

fn rule(report: &Report) -> &FeedByForce {
    report.setup().feed_rule.as_ref().unwrap()
}

fn summary(report: &Report) -> Value {
    serde_json::to_value(report.summary()).unwrap()
}

fn feed(report: &Report, step: &Move) -> f64 {
    report.setup().loading.programmed(step).unwrap()
}

/// The mean force is as large as asked for at the chip found, by its definition.
#[test]
fn the_chip_gives_the_force() {
    let mut random = fastrand::Rng::with_seed(1);
    for _ in 0..1000 {
        let force =
            LinearForce { cutting: any_vector(&mut random, 1e6), edge: any_vector(&mut random, 50.0) };
        let asked = between(&mut random, 100.0, 1000.0);
        let chip = force.chip_at(asked);
        assert!((force.at(chip).norm() / asked - 1.0).abs() < 1e-9);
        // It is the largest such chip.
        assert!(force.at(chip * 1.001).norm() > asked && chip > 0.0);
    }
    let edge = Vector3::new(30.0, 0.0, 40.0);
    let cutting = Vector3::new(3e5, 0.0, 4e5);
    // Along one line: (500 - 50) / 5e5.
    assert!((LinearForce { cutting, edge }.chip_at(500.0) - 9e-4).abs() < 1e-15);
    assert_eq!(LinearForce { cutting, edge }.chip_at(49.0), 0.0);
    let air = LinearForce { cutting: Vector3::zeros(), edge: Vector3::zeros() };
    assert_eq!(air.chip_at(1.0), f64::INFINITY);
}

/// A feed between its limits is the largest that keeps every station at the force or below it, and one
/// of its stations has that force.
#[test]
fn a_feed_between_its_limits_holds_the_force() {
    let report = held();
    let (setup, rule) = (report.setup(), rule(&report).rule);
    let MeanForces::InStock { contacts, forces } = &setup.mean_force else { panic!("it has a stock") };
    let ChipLoad::FromFeed { flutes, spindle } = setup.loading.chip else { panic!("chip from feed") };
    let moves = setup.path.moves();
    let cutting: Vec<usize> = (0..moves.len()).filter(|&k| moves[k].pace != MovePace::Rapid).collect();
    let mut between_limits = 0;
    for run in cutting.chunk_by(|&a, &b| moves[a].pace == moves[b].pace) {
        let feed = feed(&report, &moves[run[0]]);
        let stations = run.iter().flat_map(|&index| contacts.of_move(index));
        let force = |station: usize| forces[station].at(feed / (flutes * spindle)).norm();
        let largest = stations.map(force).fold(0.0, f64::max);
        // 900 mm/min are 15 mm/s.
        if feed > 0.25 * 15e-3 * 1.001 && feed < 9.99e-3 {
            assert!((largest / rule.force - 1.0).abs() < 1e-9, "{feed}: {largest}");
            between_limits += 1;
        }
        assert!(largest <= rule.force * (1.0 + 1e-9) || feed <= 0.25 * 15e-3 * (1.0 + 1e-9));
    }
    assert!(between_limits > 4, "{between_limits}");
}

/// In the corner where the programmed feed has the largest force, the held one is there, to the step of
/// the feeds; nowhere along the run is it more.
#[test]
fn a_corner_has_the_force_that_is_held() {
    let lowest = json!({"feed_rule":"constant-force","feed_least_percent":5,"force_n":130});
    let report = run(&job(POCKET, lowest));
    let before = run(&job(POCKET, json!({})));
    let largest = |report: &Report| report.planned_force.iter().map(Vector3::norm).fold(0.0, f64::max);
    assert!(largest(&before) > 160.0, "{}", largest(&before));
    assert!(largest(&report) < 130.0 * (1.0 + 1e-9) && largest(&report) > 129.9, "{}", largest(&report));
    let gain = &summary(&report)["feed_rule"];
    assert_eq!(gain["force_n"], 130.0);
    assert!((gain["constant_force"]["largest_force_n"].as_f64().unwrap() - largest(&report)).abs() < 1e-9);
}

/// Feeds stay within their share of the programmed one; above it, air is run at the upper limit.
#[test]
fn the_limits_are_kept() {
    for (least, most) in [(25.0, 100.0), (40.0, 160.0), (60.0, 60.0)] {
        let report = run(&job(
            POCKET,
            json!({"feed_rule":"constant-force","feed_least_percent":least,"feed_most_percent":most}),
        ));
        let (low, high) =
            column(&report, "feed_mm_s").into_iter().fold((f64::MAX, 0.0_f64), |(low, high), v| {
                (if v > 0.0 { low.min(v) } else { low }, high.max(v))
            });
        assert!(low < high);
        let programmed = &rule(&report).programmed.path;
        let mut at = [0.0; 2];
        for step in report.setup().path.moves().iter().filter(|step| step.pace != MovePace::Rapid) {
            let own = programmed.moves().iter().find(|own| own.line == step.line).unwrap();
            let share = feed(&report, step) / feed(&report, own);
            assert!(
                share > least / 100.0 - 1e-12 && share < most / 100.0 + 1e-12,
                "line {}: {share}",
                own.line
            );
            at[0] += if share < least / 100.0 + 1e-9 { step.segment.length() } else { 0.0 };
            at[1] += if share > most / 100.0 - 1e-9 { step.segment.length() } else { 0.0 };
        }
        let gain = &summary(&report)["feed_rule"];
        let all: f64 = programmed
            .moves()
            .iter()
            .filter(|step| step.pace != MovePace::Rapid)
            .map(|step| step.segment.length())
            .sum();
        for (at, key) in at.into_iter().zip(["share_at_least", "share_at_most"]) {
            assert!((gain[key].as_f64().unwrap() - at / all).abs() < 1e-9, "{key} {gain}");
        }
        assert!(at[1] > 0.0);
    }
}

/// Helices down into the plate and slopes across it, by a ball nose: a map of heights.
const RAMPS: &str = "G21 G90\nG0 X-12 Y0 Z1\nG3 X-12 Y0 Z-2 I12 J0 F900\nG3 X-12 Y0 Z-2 I12 J0\nG1 X0 Z-4\n\
                     X20 Z-1\nY8 Z-3\nX-20 Z-5\nG0 Z5\n";

#[test]
fn pieces_keep_geometry_lines_stops_and_contacts() {
    for (text, corner) in [(POCKET, 0), (RAMPS, 5)] {
        let ball = ("tool", json!({"diameter_mm":10,"flutes":3,"helix_deg":30,"corner_radius_mm":corner}));
        let with = |motion: Value| run(&[job(text, motion), vec![ball.clone()]].concat());
        let (held, before) = (with(json!({"feed_rule":"constant-force"})), with(json!({})));
        assert_eq!(held.setup().contacts.as_ref().unwrap().cell.is_some(), corner > 0);
        keeps(&held, &before);
    }
}

/// The pieces lie on the path, with the lines of their moves, and meet what the path meets there.
fn keeps(report: &Report, before: &Report) {
    let (setup, programmed) = (report.setup(), &rule(report).programmed);
    let (path, own) = (&setup.path, &programmed.path);
    assert!(path.moves().len() > own.moves().len() + 8);
    assert_eq!(path.length(), own.length());
    for k in 0..=5000 {
        let s = own.length() * f64::from(k) / 5000.0;
        assert!((path.point(s) - own.point(s)).norm() < 1e-12);
        assert!((path.tangent(s) - own.tangent(s)).norm() < 1e-9);
    }
    let mut lines: Vec<usize> = path.moves().iter().map(|step| step.line).collect();
    lines.dedup();
    assert_eq!(lines, own.moves().iter().map(|step| step.line).collect::<Vec<_>>());
    let (mut index, mut compared) = (0, 0);
    for (part, step) in path.moves().iter().enumerate() {
        while index + 1 < own.moves().len() && own.start(index + 1) <= path.start(part) {
            index += 1;
        }
        for share in [0.01, 0.3, 0.77] {
            let within = step.segment.length() * share;
            let there = path.start(part) + within - own.start(index);
            let (a, b) = (setup.mean_force.at(part, within), programmed.mean_force.at(index, there));
            let size = b.cutting.norm().max(1.0);
            assert!((a.cutting - b.cutting).norm() < 1e-6 * size, "line {}", step.line);
            compared += 1;
        }
    }
    assert_eq!(compared, 3 * path.moves().len());
    let stops = |report: &Report| report.plan.trajectory.stops.iter().map(|stop| stop.s).collect::<Vec<_>>();
    assert_eq!(stops(report), stops(before));
    let cut = |report: &Report| summary(report)["cut"].clone();
    for key in ["removed_cm3", "air_share", "largest_engaged_deg"] {
        let (a, b) = (cut(report)[key].as_f64().unwrap(), cut(before)[key].as_f64().unwrap());
        assert!((a - b).abs() < 1e-9 * b.max(1.0), "{key}: {a} {b}");
    }
}

/// With no ramps to speak of, the time is that of the feeds.
#[test]
fn the_time_is_what_the_feeds_say() {
    let report = run(&job(POCKET, json!({"feed_rule":"constant-force","acceleration_mm_s2":1e6})));
    let rapid = report.setup().limits.rapid;
    let time: f64 = report
        .setup()
        .path
        .moves()
        .iter()
        .map(|step| step.segment.length() / report.setup().loading.programmed(step).unwrap_or(rapid))
        .sum();
    let moving = (report.plan.trajectory.moving - 1) as f64 * 0.004;
    assert!((moving - time).abs() < 0.01 + 1e-3 * time, "{moving} {time}");
}

/// What it is compared with is the job without the rule.
#[test]
fn the_gain_is_over_the_job_without_the_rule() {
    let (report, before) = (held(), run(&job(POCKET, json!({}))));
    let (with, without) = (summary(&report), summary(&before));
    let gain = &with["feed_rule"];
    assert!(without.get("feed_rule").is_none());
    for (own, other) in [("programmed", &without), ("constant_force", &with)] {
        assert_eq!(gain[own]["largest_error_mm"], other["before_mm"]["both"]["max"]);
        assert_eq!(gain[own]["mean_error_mm"], other["before_mm"]["both"]["mean"]);
        assert_eq!(gain[own]["time_s"], other["duration_s"]);
        assert_eq!(gain[own]["peak_force_n"], other["cut"]["peak_force_n"]);
    }
    let figure = |own: &str, key: &str| gain[own][key].as_f64().unwrap();
    for key in ["largest_error_mm", "largest_force_n", "peak_force_n"] {
        assert!(figure("constant_force", key) < figure("programmed", key), "{gain}");
    }
    assert!(figure("constant_force", "time_s") > figure("programmed", "time_s"));
    assert!(gain["sentence"].as_str().unwrap().contains(" mm at the programmed feed"), "{gain}");
}

/// The median is that of the length in material, by hand on two slots of different depth.
#[test]
fn the_median_is_that_of_the_length_in_material() {
    let slots = |deep: u32| {
        format!("G21 G90\nG0 X-60 Y0 Z5\nZ-2\nG1 X{deep} F900\nG0 Z5\nG0 X-60 Y20\nZ-4\nG1 X0 F900\nG0 Z5\n")
    };
    // Slots of 2 and of 4 mm; the first is the longer one, then the shorter one.
    for (end, depth) in [(20, 2.0), (0, 2.0)] {
        let report = run(&job(&slots(end), json!({"feed_rule":"constant-force"})));
        let stated = json!({
            "engagement":"slot","axial_depth_mm":depth,"spindle_rpm":8000,"feed_per_tooth_mm":"from_feed"
        });
        let mut other = job(&slots(end), json!({}));
        other.push(("cutting", stated));
        let expected = run(&other).setup().cut.mean_force().at(900.0 / 60e3 / (3.0 * 8000.0 / 60.0)).norm();
        let found = rule(&report).rule.force;
        if end == 20 {
            assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
        } else {
            // As long as each other: entry and exit decide between the two depths.
            assert!(found > 0.99 * expected && found < 2.01 * expected);
        }
    }
}

/// Every language gives the tool the feeds of the pieces: down to a quarter of the programmed ones, where the
/// program itself has two feeds, one two thirds of the other.
#[test]
fn every_language_writes_the_feeds() {
    let (report, before) = (held(), run(&job(POCKET, json!({}))));
    let text = |report: &Report, id: &str| {
        Programs::default().export(report, id, &ExportOptions::default()).unwrap().text
    };
    for (id, head, unit) in [
        ("gcode", " F", 1.0 / 60.0),
        ("apt", "FEDRAT/", 1.0 / 60.0),
        ("krl", "$VEL.CP=", 1e3),
        ("rapid", ":=[", 1.0),
        ("fanuc", "] ", 1.0),
    ] {
        let speeds = |text: &str| -> Vec<f64> {
            let lines = text.lines().filter(|line| match id {
                "rapid" => line.contains("speeddata vFeed"),
                "fanuc" => line.contains("mm/sec"),
                _ => !line.starts_with('('),
            });
            let words = lines.filter_map(|line| line.split_once(head)).map(|(_, rest)| {
                let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
                rest[..end].parse::<f64>().unwrap() * unit
            });
            let mut speeds: Vec<f64> = words.filter(|speed| *speed < 100.0).collect();
            speeds.sort_by(f64::total_cmp);
            speeds.dedup();
            speeds
        };
        let (with, without) = (speeds(&text(&report, id)), speeds(&text(&before, id)));
        assert!(with.len() > 6 && with.len() > without.len(), "{id}: {with:?} {without:?}");
        // The feed of the command is that of the tip, times how much longer the commanded path is.
        assert!((3.5..4.5).contains(&with[0]), "{id}: {with:?}");
        assert!(without[0] > 7.0, "{id}: {without:?}");
    }
    // VAL3 keeps its speeds in another file, and has an index for each.
    let indices = |report: &Report| {
        let text = text(report, "val3");
        (0..99).filter(|k| text.contains(&format!("mCut[{k}]"))).count()
    };
    assert!(indices(&report) > indices(&before) + 4);
    let text = text(&report, "gcode");
    assert!(text.contains("(Feeds keep the mean force at ") && text.contains("(was: "), "{text}");
}

#[test]
fn without_the_rule_no_bit_changes() {
    let plain = run(&job(POCKET, json!({}))).fingerprint();
    assert_eq!(run(&job(POCKET, json!({"feed_rule":"programmed","force_n":3}))).fingerprint(), plain);
    // A force that is never reached leaves the feed at its upper limit, the programmed one.
    let weak = run(&job(POCKET, json!({"feed_rule":"constant-force","force_n":1e5})));
    assert_eq!(weak.fingerprint(), plain);
}

#[test]
fn mistakes_are_named() {
    let error = |motion: Value| refused(&job(POCKET, motion));
    let field = |motion: Value| error(motion).field().unwrap().to_owned();
    assert_eq!(field(json!({"force_n":30})), "motion.feed_rule");
    assert_eq!(field(json!({"feed_rule":"constant"})), "motion.feed_rule");
    assert_eq!(field(json!({"feed_rule":"constant-force","force_n":"mean"})), "motion.force_n");
    assert_eq!(field(json!({"feed_rule":"constant-force","force_n":0})), "motion.force_n");
    assert_eq!(
        field(json!({"feed_rule":"constant-force","feed_most_percent":30,"feed_least_percent":40})),
        "motion.feed_most_percent"
    );
    assert!(matches!(
        error(json!({"feed_rule":"constant-force","feed_most_percent":300})),
        Error::OutOfRange { .. }
    ));
    let with = |more: (&'static str, Value)| {
        let mut all = job(POCKET, json!({"feed_rule":"constant-force"}));
        all.push(more);
        refused(&all).field().unwrap().to_owned()
    };
    assert_eq!(with(("stock", json!({"kind":"none"}))), "motion.feed_rule");
    assert_eq!(with(("cutting.engagement", json!("slot"))), "motion.feed_rule");
    assert_eq!(with(("cutting.feed_per_tooth_mm", json!(0.02))), "cutting.feed_per_tooth_mm");
    assert_eq!(
        with(("stock", json!({"kind":"box","from_mm":[-50,-50,-20],"to_mm":[50,50,-10]}))),
        "motion.force_n"
    );
}

/// In the air there is no force, and none is not less than none.
#[test]
fn in_the_air_the_mean_force_is_zero() {
    let report = run(&job(
        "G21 G90\nG0 X-40 Y0 Z5\nG1 X40 F900\n",
        json!({"feed_rule":"constant-force","force_n":50}),
    ));
    for run in ["programmed", "constant_force"] {
        let force = summary(&report)["feed_rule"][run]["mean_force_n"].as_f64().unwrap();
        assert!(force == 0.0 && force.is_sign_positive(), "{run}: {force}");
    }
}
