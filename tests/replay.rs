//! A program taken away and run again: read back by the reader of its language, it brings out the path first desired.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod common;

use armill::Report;
use armill::export::replay::{self, replay};
use armill::export::{Options, export};
use armill::math::Pose;
use armill::path::gcode;
use common::program::small_jobs;
use common::run;
use nalgebra::Vector3;
use serde_json::{Value, json};

/// Jobs whose promise a program can keep: name and changes of the default job.
fn jobs() -> Vec<(&'static str, Vec<(&'static str, Value)>)> {
    let [(_, arc), (_, rounded), (_, sharp)] = small_jobs();
    let with = |job: &[(&'static str, Value)], more: &[(&'static str, Value)]| [job, more].concat();
    let rigid = ("shaper", json!("none"));
    let slow = ("motion.feed_mm_s", json!(30));
    let idle = ("cutting.axial_depth_mm", json!(0.001));
    let line = ("path", json!({"kind":"line","from_mm":[600,-60,100],"to_mm":[600,60,120]}));
    vec![
        ("default", vec![]),
        ("default without shaper", vec![rigid.clone()]),
        ("line", vec![line]),
        ("arc, slow", with(&arc, &[slow])),
        ("arc without shaper", with(&arc, std::slice::from_ref(&rigid))),
        ("rounded rectangle without shaper", with(&rounded, &[rigid])),
        ("rectangle, no force", with(&sharp, &[idle])),
    ]
}

/// The tolerance that was promised, and a tenth of it that the points may be thinned by.
fn allowed(report: &Report) -> f64 {
    let summary = report.summary();
    assert!(summary.after_mm.max <= summary.tolerance_mm);
    summary.tolerance_mm * 1.1
}

#[test]
fn a_program_read_back_and_run_keeps_the_promise() {
    for (name, changes) in jobs() {
        let report = run(&changes);
        for format in ["gcode", "apt", "path-csv"] {
            let outcome = replay(&report, format, &Options::default()).unwrap();
            let error = outcome.statistics();
            assert!(error.max <= allowed(&report), "{name} as {format}: {error:?}");
            assert!(error.mean <= error.max && error.max > 0.0, "{name} as {format}: {error:?}");
        }
    }
    let refused = replay(&run(&[]), "krl", &Options::default()).unwrap_err();
    assert_eq!((refused.code(), refused.field()), ("invalid", Some("format")));
}

#[test]
fn a_program_that_is_wrong_is_seen_to_be() {
    let report = run(&small_jobs()[0].1);
    let text = export(&report, "gcode", &Options::default()).unwrap().text;
    let read = gcode::program(&text, &gcode::Options::default(), |_| {}).unwrap();
    let outcome = |shift: f64| {
        let mut program = read.clone();
        let higher = Pose::from_xyz_rpy(Vector3::new(0.0, 0.0, shift), [0.0; 3]);
        for step in &mut program.moves {
            step.segment = step.segment.placed(&higher);
        }
        replay::run(&report, &program).unwrap().statistics().max
    };
    // A program 0.1 mm too high cuts 0.1 mm too high, give or take what is left of the error.
    assert!((outcome(1e-4) - 0.1).abs() < 0.02, "{}", outcome(1e-4));
    assert!(outcome(0.0) < 0.02);
}

/// The plain way, without telling the second run what the first desired: the program is the path, nothing is compensated, and
/// force follows the program's own direction. That costs the deflection times the angle between the two directions: 0.4 um on the default circle.
#[test]
fn a_program_opened_as_a_job_of_its_own_keeps_it_too_where_the_path_is_wide() {
    for (name, changes) in
        jobs().into_iter().filter(|(name, _)| name.starts_with("default") || *name == "line")
    {
        let report = run(&changes);
        for (format, kind) in [("gcode", "gcode"), ("apt", "apt"), ("path-csv", "csv")] {
            let text = export(&report, format, &Options::default()).unwrap().text;
            let mut again: Vec<_> = changes.iter().filter(|(key, _)| *key != "path").cloned().collect();
            again.push(("path", json!({ "kind": kind, "text": text })));
            again.push(("compensation.sources", json!([])));
            let second = run(&again);
            let length = report.plan.path.length();
            let error = |tip: &Vector3<f64>| {
                (report.plan.path.closest(tip, length / 2.0, length).point - tip).norm() * 1e3
            };
            let worst = second.after.actual.iter().map(error).fold(0.0, f64::max);
            assert!(worst <= allowed(&report), "{name} as {format}: {worst} mm");
            assert_eq!(second.summary().passes, 0);
        }
    }
}
