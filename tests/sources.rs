//! A file corrects the sources that the job names, no more, and states the figure with all of them.

use crate::common::run;
use armill::Report;
use armill::export::ExportOptions;
use armill::verification::{Programs, replay};
use serde_json::{Value, json};

/// A climb-milled circle by an RX-90 whose shaper and force both bend it.
fn job(sources: Value) -> Report {
    run(&[
        ("workpiece_frame", json!({"xyz_mm":[560,-40,320]})),
        ("path", json!({"kind":"circle","center_mm":[0,0,0],"radius_mm":50,"normal":[0,0,1]})),
        ("motion", json!({"feed_mm_s":40,"acceleration_mm_s2":400,"sample_time_s":0.004})),
        ("material", json!({"preset":"al-7075-t6"})),
        (
            "cutting",
            json!({"axial_depth_mm":5,"engagement":"climb","radial_depth_mm":5,"spindle_rpm":6000,
                "feed_per_tooth_mm":0.1}),
        ),
        ("shaper", json!({"kind":"zvd","frequency_hz":11,"damping":0.05})),
        ("compensation.sources", sources),
    ])
}

#[test]
fn a_file_leaves_what_the_job_does_not_compensate() {
    for sources in [json!(["shaping"]), json!(["deflection"]), json!([])] {
        let report = job(sources.clone());
        let left = report.summary().after_mm.max;
        assert!(left > 3.0 * report.summary().tolerance_mm, "{sources}: {left}");
        if sources == json!(["shaping"]) {
            assert!((left - 0.32).abs() < 0.02, "{left}");
        }
        let programs = Programs::default();
        for format in ["gcode", "krl", "apt", "path-csv"] {
            let accuracy = programs.accuracy(&report, format).unwrap();
            assert!(!accuracy.met, "{sources}, {format}: {}", accuracy.sentence);
            // A program has its own timing: it starts and ends a little differently. A robot's is blended,
            // and slower where its moves are short.
            let least = if format == "krl" { 0.5 } else { 0.9 };
            let of_it = accuracy.max_mm / left;
            assert!(
                (least..1.1).contains(&of_it),
                "{sources}, {format}: {} instead of {left}",
                accuracy.max_mm
            );
        }
        // Read back, the file gives the figure that it states.
        let stated = programs.accuracy(&report, "path-csv").unwrap().max_mm;
        let found = replay::read_back(&report, &programs, "path-csv", &ExportOptions::default()).unwrap();
        assert!((found.statistics().max - stated).abs() < 0.01 * stated, "{sources}");
    }
}

#[test]
fn a_file_holds_the_correction_of_the_run() {
    for sources in [json!(["shaping"]), json!(["deflection"]), json!([])] {
        let report = job(sources.clone());
        let own = &report.compensation.correction;
        let programs = Programs::default();
        let file = programs.export(&report, "gcode", &ExportOptions::default()).unwrap();
        let written = &file.commanded_path.correction;
        let (tolerance, moving) = (1e-3 * report.summary().tolerance_mm, report.plan.trajectory.moving);
        // But for the last quarter of a second, where the force fades within a few samples of the
        // program's own timing, the rehearsal leaves the run's correction as it is.
        let same = ..moving - 60;
        let pairs = own[same].iter().zip(&written[same]);
        let off = pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        assert!(off < tolerance, "{sources}: {off} m");
        let most = own.iter().map(|vector| vector.norm()).fold(0.0, f64::max);
        assert_eq!(most == 0.0, sources == json!([]));
        // The points themselves are the desired ones with that correction.
        let desired = &report.plan.trajectory.position;
        let bent = file.commanded_path.positions(&report);
        for k in 0..moving - 60 {
            assert!((bent[k] - desired[k] - own[k]).norm() < tolerance, "{sources}: sample {k}");
        }
    }
}

#[test]
fn a_file_that_corrects_everything_meets_the_tolerance() {
    let report = job(json!(["deflection", "shaping"]));
    let accuracy = Programs::default().accuracy(&report, "gcode").unwrap();
    let left = report.summary().after_mm.max;
    assert!(accuracy.max_mm < 2.0 * left.max(report.summary().tolerance_mm), "{}", accuracy.sentence);
}
