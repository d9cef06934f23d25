//! An exported program, read back by the reader of its language and simulated, reproduces the path
//! first desired.

use crate::common::program::small_jobs;
use crate::common::run;
use armill::export::ExportOptions;
use armill::export::commanded_path::CommandedPath;
use armill::math::Pose;
use armill::motion::Trajectory;
use armill::path::{Path, gcode};
use armill::verification::{Programs, Replay, export, read_back, replay};
use armill::{Error, Report};
use nalgebra::Vector3;
use serde_json::{Value, json};
use std::sync::Arc;

/// A report's program, read back and simulated.
fn back(report: &Report, format: &str) -> Result<Replay, Error> {
    read_back(report, &Programs::default(), format, &ExportOptions::default())
}

/// Jobs that keep their tolerance as a program: name and changes to the default job.
fn jobs() -> Vec<(&'static str, Vec<(&'static str, Value)>)> {
    let [(_, arc), (_, rounded), (_, sharp)] = small_jobs();
    let with = |job: &[(&'static str, Value)], more: &[(&'static str, Value)]| [job, more].concat();
    let rigid = ("shaper", json!("none"));
    let stiff = ("shaper", json!({"kind":"zvd","frequency_hz":10,"damping":0.03}));
    let idle = ("cutting.axial_depth_mm", json!(0.001));
    let line = ("path", json!({"kind":"line","from_mm":[600,-60,100],"to_mm":[600,60,120]}));
    let following = [
        ("motion.feed_mm_s", json!(26.6)),
        ("cutting.feed_per_tooth_mm", json!("from_feed")),
        ("cutting.axial_depth_mm", json!(2)),
    ];
    let light = |job: &[(&'static str, Value)]| with(&with(job, &following), std::slice::from_ref(&rigid));
    vec![
        ("default without shaper", vec![rigid.clone()]),
        ("line without shaper", vec![line.clone(), rigid.clone()]),
        ("arc, stiffer arm", with(&arc, &[stiff])),
        ("arc without shaper", with(&arc, std::slice::from_ref(&rigid))),
        ("rectangle, no force", with(&sharp, &[idle])),
        ("line, force follows the feed", light(&[line])),
        ("default, force follows the feed", light(&[])),
        ("arc, force follows the feed", light(&arc)),
        ("rounded rectangle, force follows the feed", light(&rounded)),
    ]
}

/// Jobs for which no program was found that keeps the tolerance: a cut that begins faster than the
/// shaped command can follow, or a force that bends the arm by a millimetre and more while the tool
/// gains speed or turns.
fn out_of_reach() -> Vec<(&'static str, Vec<(&'static str, Value)>)> {
    let [(_, arc), (_, rounded), (_, sharp)] = small_jobs();
    let following = ("cutting.feed_per_tooth_mm", json!("from_feed"));
    let slow = [("motion.feed_mm_s", json!(26.6)), following.clone()];
    let rigid = ("shaper", json!("none"));
    vec![
        ("default", vec![]),
        ("default, chip from feed", vec![following.clone()]),
        ("default, slow", slow.to_vec()),
        ("arc", arc.clone()),
        ("arc, chip from feed", [arc.clone(), vec![following]].concat()),
        ("arc, slow", [arc, slow.to_vec()].concat()),
        ("rounded rectangle without shaper", [rounded, vec![rigid.clone()]].concat()),
        ("rectangle without shaper", [sharp, vec![rigid]].concat()),
    ]
}

#[test]
fn a_program_read_back_and_run_keeps_the_promise() {
    for (name, changes) in jobs() {
        let report = run(&changes);
        let tolerance = report.summary().tolerance_mm;
        assert!(report.summary().after_mm.max <= tolerance, "{name}");
        let promise = Programs::default().accuracy(&report, "gcode").unwrap();
        assert!(promise.max_mm <= tolerance, "{name}: {promise:?}");
        assert_eq!(promise.verdict_state, report.verdict_state(), "{name}");
        for format in ["gcode", "apt", "path-csv"] {
            let outcome = back(&report, format).unwrap();
            let error = outcome.statistics();
            assert!(error.max <= tolerance, "{name} as {format}: {error:?}");
            assert!(error.mean <= error.max && error.max > 0.0, "{name} as {format}: {error:?}");
        }
    }
    let refused = back(&run(&[]), "krl").unwrap_err();
    assert_eq!((refused.code(), refused.field()), ("invalid", Some("format")));
}

/// The report states no better accuracy for a program than its simulation gives. It adds no stop in
/// the middle of a move, where the force would stop too.
#[test]
fn what_no_program_keeps_is_not_promised() {
    for (name, changes) in out_of_reach() {
        let report = run(&changes);
        let promise = Programs::default().accuracy(&report, "gcode").unwrap();
        assert!(!promise.met && promise.max_mm > report.summary().tolerance_mm, "{name}: {promise:?}");
        let text = export(&report, "gcode", &ExportOptions::default()).unwrap().text;
        let outcome = back(&report, "gcode").unwrap();
        let read_back = outcome.statistics().max;
        assert!(read_back <= promise.max_mm * 1.02, "{name}: {promise:?}, read back {read_back}");
        let read = gcode::program(&text, &gcode::Options::default(), |_| {}).unwrap();
        let path = Path::of_program(&read).unwrap();
        let own = Trajectory::new(&path, &report.setup().limits);
        // At the ends and in corners the tool is at rest, and the correction with it goes to nothing
        // and back: a stop there stops nothing.
        let (path, desired) = (path.placed(&report.setup().workpiece), &report.plan.path);
        let mut rests: Vec<_> = report.plan.trajectory.stops.iter().map(|stop| stop.s).collect();
        rests.extend([0.0, desired.length()]);
        for stop in &own.stops {
            let away = |s: &f64| (desired.point(*s) - path.point(stop.s)).norm();
            let nearest = rests.iter().map(away).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-3, "{name}: {stop:?} is {nearest} m away from a rest");
        }
        // A tenth of the deflection itself, which would be the error of the whole correction.
        assert!(read_back < 0.1 * report.summary().before_mm.deflection.max, "{name}: {read_back}");
    }
}

/// Where no program of this motion can keep the tolerance, its header says so: forces that follow a
/// fast feed from rest, a slow shaper.
#[test]
fn the_header_says_what_comes_out_of_the_program() {
    let [(_, arc), _, (_, sharp)] = small_jobs();
    let stiff = ("shaper", json!({"kind":"zvd","frequency_hz":10,"damping":0.03}));
    for (changes, met) in [([arc.clone(), vec![stiff]].concat(), true), (arc, false), (sharp, false)] {
        let report = run(&changes);
        let text = export(&report, "gcode", &ExportOptions::default()).unwrap().text;
        let line = text.lines().find(|line| line.contains("Simulated from this file")).unwrap();
        let (_, figure) = line.split_once("largest contour error ").unwrap();
        let said: f64 = figure.split(' ').next().unwrap().parse().unwrap();
        assert_eq!(said <= report.summary().tolerance_mm, met, "{line}");
        // Read back, places and feeds are rounded, and the figure has three digits.
        let outcome = back(&report, "gcode").unwrap().statistics().max;
        assert!((said - outcome).abs() <= 0.02 * outcome, "{line}, read back {outcome}");
    }
}

/// The largest contour error [mm] that the header of a robot program states, as it is written.
fn stated(text: &str) -> String {
    // FANUC breaks its remarks into short lines.
    let comment =
        |line: &str| line.split_once('!').map_or(line.to_owned(), |(_, rest)| rest.replace(" ;", ""));
    let text: Vec<String> = text.lines().map(comment).collect();
    let text = text.join(" ").split_whitespace().collect::<Vec<_>>().join(" ");
    let (_, own) = text.split_once("Simulated from this file").unwrap();
    let (_, figure) = own.split_once("largest contour error ").unwrap();
    figure.split(' ').next().unwrap().to_owned()
}

/// A robot program waits and moves at rapid speed where a list of points does not, so it has an
/// error of its own; the figure beside the file is the one in its header.
#[test]
fn a_robot_program_is_judged_by_its_own_timing() {
    let text = "G21 G90 M3 S4000\nG0 X560 Y-60 Z110\nG1 Z100 F3000\nG1 Y60\nG4 P0.5\nG1 X620\nG0 Z110\nM30";
    let report = run(&[
        ("path", json!({"kind":"gcode","text":text})),
        ("cutting.axial_depth_mm", json!(0.01)),
        ("motion.corner_dwell", json!(0)),
    ]);
    let programs = Programs::default();
    let points = programs.accuracy(&report, "path-csv").unwrap().max_mm;
    for (id, name) in [
        ("krl", "a KUKA KRL"),
        ("rapid", "an ABB RAPID"),
        ("val3", "a Staubli VAL3"),
        ("fanuc", "a FANUC LS"),
    ] {
        let accuracy = programs.accuracy(&report, id).unwrap();
        assert!(accuracy.sentence.starts_with(&format!("As {name} program")), "{accuracy:?}");
        let header = stated(&programs.export(&report, id, &ExportOptions::default()).unwrap().text);
        assert!(accuracy.sentence.contains(&format!(" {header} mm")), "{id}: {header}, {accuracy:?}");
        assert!((accuracy.max_mm - points).abs() > 0.01 * points, "{id}: {accuracy:?}, points {points}");
    }
    let refused = programs.accuracy(&report, "joints-csv").unwrap_err();
    assert_eq!((refused.code(), refused.field()), ("invalid", Some("format")));
}

/// A file that needs no pass reports the correction of the run; one that does is no worse for it.
#[test]
fn a_rehearsal_only_improves() {
    let [(_, arc), (_, rounded), _] = small_jobs();
    let rigid = ("shaper", json!("none"));
    let light = vec![
        ("path", json!({"kind":"line","from_mm":[600,-60,100],"to_mm":[600,60,120]})),
        ("cutting.axial_depth_mm", json!(0.05)),
        rigid.clone(),
    ];
    let with = |job: Vec<(&'static str, Value)>| [job, vec![rigid.clone()]].concat();
    for (changes, passes) in [(light, false), (with(arc), true), (with(rounded), true)] {
        let report = run(&changes);
        let unrehearsed = {
            let mut report = report.clone();
            Arc::make_mut(&mut report.plan.setup).goal.max_passes = 0;
            back(&report, "gcode").unwrap().largest()
        };
        let rehearsed = back(&report, "gcode").unwrap().largest();
        let commanded_path = export(&report, "gcode", &ExportOptions::default()).unwrap().commanded_path;
        assert_eq!(commanded_path != CommandedPath::of(&report), passes);
        assert!(if passes { rehearsed < unrehearsed } else { rehearsed == unrehearsed });
    }
}

#[test]
fn a_program_that_is_wrong_is_seen_to_be() {
    let report = run(&[small_jobs()[0].1.clone(), vec![("shaper", json!("none"))]].concat());
    let written = export(&report, "gcode", &ExportOptions::default()).unwrap();
    let read = gcode::program(&written.text, &gcode::Options::default(), |_| {}).unwrap();
    let outcome = |shift: f64| {
        let mut program = read.clone();
        let higher = Pose::from_xyz_rpy(Vector3::new(0.0, 0.0, shift), [0.0; 3]);
        for step in &mut program.moves {
            step.segment = step.segment.placed(&higher);
        }
        replay::run(&report, &written.commanded_path, &program).unwrap().statistics().max
    };
    // A program 0.1 mm too high cuts 0.1 mm too high, within the remaining error.
    assert!((outcome(1e-4) - 0.1).abs() < 0.02, "{}", outcome(1e-4));
    assert!(outcome(0.0) < 0.02);
}

/// The plain way, without giving the second run the path first desired: the program is the path,
/// nothing is compensated, and the force follows the program's own direction. That costs the
/// deflection times the angle between the two directions: 0.4 um on the default circle, 24 um on
/// corners of 15 mm radius. In a sharp corner it costs all of it, so these are left out, and so are
/// the first and the last 30 mm, where the tool gains and loses speed and the correction leads the
/// command aside.
#[test]
fn a_program_opened_as_a_job_of_its_own_keeps_it_too_where_the_path_is_wide() {
    const WIDE: [&str; 5] = [
        "default without shaper",
        "line without shaper",
        "arc, stiffer arm",
        "arc without shaper",
        "rectangle, no force",
    ];
    for (name, changes) in jobs().into_iter().filter(|(name, _)| WIDE.contains(name)) {
        let report = run(&changes);
        for (format, kind) in [("gcode", "gcode"), ("apt", "apt"), ("path-csv", "csv")] {
            let text = export(&report, format, &ExportOptions::default()).unwrap().text;
            let mut again: Vec<_> = changes.iter().filter(|(key, _)| *key != "path").cloned().collect();
            again.push(("path", json!({ "kind": kind, "text": text })));
            again.push(("compensation.sources", json!([])));
            let second = run(&again);
            let length = report.plan.path.length();
            let error = |tip: &Vector3<f64>| {
                (report.plan.path.closest(tip, length / 2.0, length).point - tip).norm() * 1e3
            };
            let ends = [0.0, length].map(|s| report.plan.path.point(s));
            let away = |tip: &&Vector3<f64>| ends.iter().all(|end| (*tip - end).norm() > 0.03);
            let worst = second.after.actual.iter().filter(away).map(error).fold(0.0, f64::max);
            assert!(worst <= report.summary().tolerance_mm, "{name} as {format}: {worst} mm");
            assert_eq!(second.summary().passes, 0);
        }
    }
}
