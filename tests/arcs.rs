//! Arcs in exported G-code: one that is still an arc after compensation stays one block; one that
//! bends becomes as few arcs as will do.

use crate::common;
use crate::common::program::{example, examples, read_back, written};
use crate::common::run;
use armill::Report;
use armill::export::arc::ArcMove;
use armill::export::command::Command;
use armill::export::commanded_path::CommandedPath;
use armill::export::style::PostStyle;
use armill::export::{Export, ExportOptions};
use armill::math::{pow, sin, sin_cos};
use armill::path::{Program, Segment};
use nalgebra::Vector3;
use serde_json::json;

/// A program, computed without shaper and compensation, so that the commands equal the programmed
/// path.
fn uncompensated(text: &str) -> Report {
    run(&[
        ("path", json!({"kind":"gcode","text":text})),
        ("shaper", json!("none")),
        ("motion.feed_mm_s", json!(20)),
        ("compensation.sources", json!([])),
    ])
}

/// The report with its correction replaced by a function of position.
fn corrected(text: &str, correction: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Report {
    let mut report = uncompensated(text);
    report.compensation.correction = report.plan.trajectory.position.iter().map(correction).collect();
    report
}

/// Every kind of arc that a program may hold, each starting where the one before ends.
const EVERY: &str = "N1 G21 G90 G17 G94
N2 G0 X600 Y0 Z100
N3 S3000 M3
N10 G3 X580 Y20 I-20 J0 F1200
N11 G2 X560 Y40 R20 (quarter)
N12 G1 X560 Y0 F900
N13 G3 I20
N14 G2 X560 Y0 Z94 I20 J0 P3 F600
N15 X580 Y20 Z95 I20
N16 G91 G2 X20 Y20 R-20
N17 G90 G1 Z110
N18 G18 G3 X620 Z110 I10 K0
N19 G2 X640 I10 K0 M8
N20 G19 G3 Y60 Z110 J10 K0
N21 G2 Y80 Z110 R10.0
N22 G17 G90.1 G3 X620 Y60 I620 J80 M5
N23 M30
";

#[test]
fn an_arc_that_is_still_an_arc_stays_one_block() {
    let report = uncompensated(EVERY);
    let (export, read) = read_back(&report, "gcode", &ExportOptions::default());
    stays(&report, &export, &read);
    let lines: Vec<&str> = export.text.lines().collect();
    for line in [
        "N10 G3 X580.0 Y20.0 Z100.0 I-20.0 J0.0 F1200.0",
        "N11 G2 X560.0 Y40.0 Z100.0 I0.0 J20.0 (quarter)",
        "N13 G3 X560.0 Y0.0 Z100.0 I20.0 J0.0",
        "N14 G2 X560.0 Y0.0 Z94.0 I20.0 J0.0 P3 F600.0",
        "N15 X580.0 Y20.0 Z95.0 I20.0 J0.0",
        "N18 G18 G3 X620.0 Y40.0 Z110.0 I10.0 K0.0",
        "N16 X600.0 Y40.0 Z95.0 I0.0 J20.0 (was: N16 G91 G2 X20 Y20 R-20)",
        "N19 M8 G2 X640.0 Y40.0 Z110.0 I10.0 K0.0",
        "N20 G19 G3 X640.0 Y60.0 Z110.0 J10.0 K0.0",
        "N22 G17 G3 X620.0 Y60.0 Z110.0 I-20.0 J0.0 M5 (was: N22 G17 G90.1 G3 X620 Y60 I620 J80 M5)",
    ] {
        assert!(lines.contains(&line), "{line}\n{}", export.text);
    }
    // In inches, too.
    let inches =
        "G20 G90\nG0 X23 Y0 Z4\nN1 G3 X23.5 Y0.5 I0 J0.5 F40\nN2 G2 I0.25\nN3 G18 G2 X24.5 Z4 R0.5\n";
    let report = uncompensated(inches);
    let (export, read) = read_back(&report, "gcode", &ExportOptions::default());
    stays(&report, &export, &read);
    assert!(export.text.contains("\nN2 G2 X23.5 Y0.5 Z4.0 I0.25 J0.0\n"), "{}", export.text);
    assert!(export.text.contains("\nG20 G17 "));
}

#[test]
fn examples_that_are_not_compensated_keep_their_arcs() {
    for (file, kind) in examples().into_iter().filter(|(_, kind)| kind == "gcode") {
        let mut changes = example(&file, &kind);
        changes.push(("compensation.sources", json!([])));
        let report = run(&changes);
        let (export, read) = read_back(&report, "gcode", &ExportOptions::default());
        stays(&report, &export, &read);
    }
}

/// The moves read back match the original one for one; no block was split.
fn stays(report: &Report, export: &Export, read: &Program) {
    let original = &report.setup().program.as_ref().unwrap().program.moves;
    assert_eq!(read.moves.len(), original.len(), "{}", export.text);
    for (read, original) in read.moves.iter().zip(original) {
        let name = format!("line {} for line {}", read.line, original.line);
        match (read.segment, original.segment) {
            (Segment::Line { from, to }, Segment::Line { from: a, to: b }) => {
                assert!((from - a).norm() < 5e-8 && (to - b).norm() < 5e-8, "{name}");
            }
            (
                Segment::Arc { center, u, v, radius, sweep, rise },
                Segment::Arc { center: c, u: m, v: n, radius: r, sweep: s, rise: h },
            ) => {
                // The centre of a short arc is known less exactly than its points: by the tolerance
                // over the arc's height.
                assert!((center - c).norm() < 1e-6 && (radius - r).abs() < 1e-6, "{name}: {center}, not {c}");
                assert!((u - m).norm() < 1e-4 && (v - n).norm() < 1e-4, "{name}");
                assert!((sweep - s).abs() < 1e-4 && (rise - h).abs() < 5e-8, "{name}: {sweep}, not {s}");
            }
            _ => panic!("{name}: {:?} for {:?}\n{}", read.segment, original.segment, export.text),
        }
        assert_eq!((read.pace, read.spindle), (original.pace, original.spindle), "{name}");
    }
}

const CIRCLE: &str = "G21 G90\nG0 X620 Y0 Z100\nN1 G1 X630 F1200\nN2 G3 I-30 J0\nN3 G1 X640\n";

#[test]
fn an_arc_that_moves_or_grows_stays_one_block() {
    let shift = Vector3::new(1e-4, -2e-4, 5e-5);
    let shifted = written(&corrected(CIRCLE, |_| shift), "gcode").text;
    assert!(shifted.contains("\nN2 G3 X630.1 Y-0.2 Z100.05 I-30.0 J0.0\n"), "{shifted}");
    let center = Vector3::new(0.6, 0.0, 0.1);
    let grown = corrected(CIRCLE, |p| (p - center) * 0.01);
    let text = written(&grown, "gcode").text;
    assert!(text.contains("\nN2 G3 X630.3 Y0.0 Z100.0 I-30.3 J0.0\n"), "{text}");
    let tilted = "G21 G90\nG0 X620 Y0 Z100\nN1 G1 X630 F1200\nN2 G3 X570 I-30 J0\nN3 G1 X560\n";
    let risen = written(&corrected(tilted, |p| Vector3::z() * p.y * 1e-5), "gcode").text;
    assert!(risen.contains("\nN2 G3 X570.0 Y0.0 Z100.0 I-30.0 J0.0\n"), "within the tolerance: {risen}");
}

#[test]
fn an_arc_that_bends_becomes_few_arcs() {
    // An oval: 0.3 mm longer along X than along Y. No circle fits it within a micrometre, a few
    // arcs do.
    let oval = corrected(CIRCLE, |p| Vector3::new((p.x - 0.6) * 0.01, 0.0, 0.0));
    for thinning in [1e-6, 5e-6] {
        let (export, read) = read_back(&oval, "gcode", &ExportOptions { thinning: Some(thinning) });
        assert!(export.deviation <= thinning);
        assert!(export.text.contains("\nN2 (was: N2 G3 I-30 J0)\nG3 X"), "{}", export.text);
        let arcs = read.moves.iter().filter(|step| matches!(step.segment, Segment::Arc { .. })).count();
        let chords = Command::new(&oval, &CommandedPath::of(&oval), Some(thinning), PostStyle::default())
            .unwrap()
            .points();
        // A chord of radius r deviates by r a^2 / 8 over the angle a, an arc of an oval by the
        // oval's share of that.
        assert!(arcs > 1 && arcs * 5 < chords, "{arcs} arcs, {chords} chords");
        let lines = read.moves.len() - arcs;
        assert_eq!(lines, 2, "the straight moves before and behind it");
    }
}

/// Random arcs with random bends: the measured deviation stays within the tolerance, and the arcs
/// keep axis and sense of rotation.
#[test]
fn arcs_keep_within_the_tolerance() {
    let mut random = fastrand::Rng::with_seed(11);
    for case in 0..16 {
        let plane = random.usize(17..20);
        let sense = random.usize(2..4);
        let mut number = |low: f64, high: f64| common::between(&mut random, low, high);
        let [a, b] = [number(-20.0, 20.0), number(-20.0, 20.0)];
        let rise = number(-3.0, 3.0);
        let angle = number(0.3, 6.0);
        let forward = if sense == 3 { angle } else { -angle };
        let (up, across) = sin_cos(forward);
        // Axes of the plane, right-handed, and its normal.
        let [i, j, n] = [[1, 2, 0], [2, 0, 1], [0, 1, 2]][19 - plane];
        let mut to = [600.0, 0.0, 120.0];
        to[i] += a - (a * across - b * up);
        to[j] += b - (a * up + b * across);
        to[n] += rise;
        let letters = ["I", "J", "K"];
        let text = format!(
            "G21 G90\nG0 X600 Y0 Z120\nN1 G{plane} G{sense} X{:.6} Y{:.6} Z{:.6} {}{a:.6} {}{b:.6} F1200\n",
            to[0], to[1], to[2], letters[i], letters[j]
        );
        let (bend, wave) = (number(0.0, 1e-4), number(10.0, 200.0));
        let report =
            corrected(&text, |p| Vector3::new(sin(p.y * wave), sin(p.z * wave), sin(p.x * wave)) * bend);
        let thinning = pow(10.0, number(-6.5, -4.5));
        let (export, _) = read_back(&report, "gcode", &ExportOptions { thinning: Some(thinning) });
        assert!(export.deviation <= thinning, "case {case}: {} of {thinning}\n{text}", export.deviation);
        let command = |arcs| {
            let style = PostStyle { arcs, ..PostStyle::default() };
            Command::new(&report, &export.commanded_path, Some(thinning), style).unwrap()
        };
        let (command, chords) = (command(true), command(false).points());
        let arcs: Vec<ArcMove> =
            command.moves.iter().flat_map(|commanded| &commanded.steps).filter_map(|step| step.arc).collect();
        assert!(!arcs.is_empty() || chords < 4, "case {case}: {chords} chords\n{text}");
        assert!(command.points() <= chords, "case {case}");
        let turned: f64 = arcs.iter().map(|arc| arc.sweep).sum();
        assert!(arcs.iter().all(|arc| arc.normal == n), "case {case}");
        assert!((turned - forward).abs() < 0.1, "case {case}: {turned} of {forward}\n{text}{}", export.text);
    }
}
