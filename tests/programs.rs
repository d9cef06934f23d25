//! Exported programs: they read back as the compensated path and, simulated again, meet the
//! tolerance.

use crate::common::program::{chain, commanded, largest_distance, read_back, small_jobs, written};
use crate::common::run;
use armill::Report;
use armill::export::ExportOptions;
use armill::math::rotation_about;
use armill::path::{Axes, Move, MovePace, Path, Program, Segment, SourceProgram};
use armill::verification::export;
use nalgebra::Vector3;
use serde_json::{Value, json};

#[test]
fn a_wait_in_a_corner_is_written() {
    let report = run(&small_jobs()[2].1);
    let wait = report.setup().limits.corner_dwell;
    for (id, word) in [
        ("gcode", "G4 P"),
        ("apt", "DELAY/"),
        ("krl", "WAIT SEC "),
        ("rapid", "WaitTime \\InPos,"),
        ("val3", "delay("),
        ("fanuc", "WAIT "),
    ] {
        let text = written(&report, id).text;
        let waits: Vec<f64> = text
            .lines()
            .filter_map(|line| line.split_once(word))
            .map(|(_, rest)| rest.trim_start().split([' ', '(', ')', ';']).next().unwrap().parse().unwrap())
            .collect();
        assert_eq!(waits.len(), 3, "{id}: a rectangle has three corners between its ends");
        assert!(waits.iter().all(|w| (w - wait).abs() < 0.006), "{id}: {waits:?} for {wait}");
    }
}

/// A report whose path is said to come from a program: down, along a side, around a corner, up. The
/// simulated path is a polyline, which the moves repeat.
fn from_gcode(text: &str, unit: &'static str) -> Report {
    let corners = [
        [0.0, 0.0, 20.0],
        [0.0, 0.0, 0.0],
        [60.0, 0.0, 0.0],
        [80.0, 20.0, 0.0],
        [80.0, 60.0, 0.0],
        [80.0, 60.0, 20.0],
    ];
    let mut report = run(&[
        ("workpiece_frame", json!({"xyz_mm":[550,0,150],"rpy_deg":[0,0,0]})),
        ("path", json!({"kind":"polyline","points_mm":corners})),
    ]);
    let lines = [4, 5, 6, 6, 8];
    let paces =
        [MovePace::Rapid, MovePace::Feed(0.1), MovePace::Feed(0.1), MovePace::Feed(0.1), MovePace::Rapid];
    let points = corners.map(|[x, y, z]| Vector3::new(x, y, z) * 1e-3);
    let moves = (0..5)
        .map(|i| Move {
            segment: Segment::Line { from: points[i], to: points[i + 1] },
            axis_from: Vector3::z(),
            axis_to: Vector3::z(),
            pace: paces[i],
            spindle: Some(100.0),
            line: lines[i],
        })
        .collect();
    let program = Program { moves, unit, lines: text.lines().count(), ..Program::default() };
    report.plan.path = Path::of_program(&program).unwrap().placed(&report.setup().workpiece);
    std::sync::Arc::make_mut(&mut report.plan.setup).program =
        Some(SourceProgram { language: "gcode", text: text.into(), program });
    report
}

#[test]
fn a_program_keeps_its_lines() {
    let text = "%\nO100 (side of a pocket)\nN10 G21 G90 G0 X0 Y0 Z20 S6000 M3\nn20 z0 ; down\nN30 G1 X60 F6000 (side)\n\
                N40 G3 X80 Y20 I0 J20 M8\n/N45 M7\nN50 G0 Z20 M9\nN60 M30\n%\n";
    let report = from_gcode(text, "mm");
    let export = written(&report, "gcode");
    let lines: Vec<&str> = export.text.lines().collect();
    let find = |start: &str| {
        let found: Vec<usize> = (0..lines.len()).filter(|&i| lines[i].starts_with(start)).collect();
        assert_eq!(found.len(), 1, "{start}\n{}", export.text);
        found[0]
    };
    assert_eq!(lines[..2], ["%", "O100 (side of a pocket)"], "what must be first stays first");
    assert!(lines[2].starts_with("(Armill "));
    let modes = find("G21 G17 G40 G49 G80 G90 G94");
    assert!(lines[modes + 1].starts_with("N10 S6000 M3 (was: N10 G21 G90 G0 X0 Y0 Z20 S6000 M3)"));
    // The start, then each line with its own moves; a line that needs only one move stays one
    // block.
    assert!(lines[modes + 2].starts_with("G0 X"));
    assert!(lines[find("N40 ")].ends_with("(was: N40 G3 X80 Y20 I0 J20 M8)"));
    assert!(lines[find("N40 ")].starts_with("N40 M8"));
    assert_eq!(lines[find("(was: / N45")], "(was: / N45 M7)", "what a switch decides is not run");
    assert!(find("N20 ") < find("N30 ") && find("N30 ") < find("N40 ") && find("N50 ") < find("N60 M30"));
    // Read back, it is the compensated path; the rapids are unchanged.
    let (export, read) = read_back(&report, "gcode", &ExportOptions::default());
    assert!(largest_distance(&commanded(&report, &export), &chain(&read)) <= 1e-6);
    for step in &read.moves {
        let cuts = (find("N30 ")..find("N50 ")).contains(&(step.line - 1));
        assert_eq!(step.pace == MovePace::Rapid, !cuts, "line {}: {}", step.line, lines[step.line - 1]);
        assert!(!cuts || matches!(step.pace, MovePace::Feed(feed) if (feed / 0.1 - 1.0).abs() < 0.05));
    }
    // A plain line that need not bend stays one block with its number.
    let mut straight = report.clone();
    std::sync::Arc::make_mut(&mut straight.plan.setup).goal.max_passes = 0;
    straight.compensation.correction.iter_mut().for_each(|c| *c = Vector3::new(1e-4, 0.0, 0.0));
    let text = written(&straight, "gcode").text;
    assert!(text.contains("\nN30 G1 X60.1 Y0.0 Z0.0 F6000.0 (side)\n"), "{text}");
    assert!(text.contains("\nN50 G0 X80.1 Y60.0 Z20.0 M9\n"), "{text}");

    let (inches, read) = read_back(&from_gcode(text_in_inches(), "inch"), "gcode", &ExportOptions::default());
    assert!(inches.text.contains("\nG20 G17") && inches.text.contains(" F23"), "{}", inches.text);
    assert!(largest_distance(&commanded(&report, &inches), &chain(&read)) <= 1e-6);
}

fn text_in_inches() -> &'static str {
    "G20\n(the same in inches)\nG0 X0 Y0 Z0.78740157\nZ0\nG1 X2.36220472 F236\nX3.1496063 Y0.78740157\n(next)\nG0 Z0.78740157\n"
}

#[test]
fn a_tilted_axis_goes_to_apt_not_to_gcode() {
    let mut report = run(&small_jobs()[0].1);
    let tilt = rotation_about(&Vector3::x(), 0.1);
    let tilted: Vec<_> = (0..report.samples()).map(|k| tilt * report.compensation.axis.at(k)).collect();
    report.compensation.axis = Axes::Each(tilted.clone());
    let error = export(&report, "gcode", &ExportOptions::default()).unwrap_err();
    assert!(error.to_string().contains("use apt"), "{error}");
    let export = written(&report, "apt");
    let apt = &export.text;
    assert!(apt.contains("\nMULTAX/ON\n") && apt.ends_with("FINI\n"));
    let back = report.setup().workpiece.inverse();
    let wanted: Vec<_> = tilted.iter().map(|axis| back.direction(axis)).collect();
    let mut chain = Vec::new();
    for line in apt.lines().filter_map(|line| line.strip_prefix("GOTO/")) {
        let numbers: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        assert_eq!(numbers.len(), 6);
        chain.push(Vector3::new(numbers[0], numbers[1], numbers[2]) * 1e-3);
        assert!((Vector3::new(numbers[3], numbers[4], numbers[5]) - wanted[0]).norm() < 1e-8);
    }
    assert!(largest_distance(&commanded(&report, &export), &chain) <= 1e-6);
    let upright = written(&run(&small_jobs()[0].1), "apt").text;
    assert!(
        !upright.contains("MULTAX")
            && upright
                .lines()
                .filter(|line| line.starts_with("GOTO/"))
                .all(|line| line.split(',').count() == 3)
    );
}

/// Exports a job's points and simulates them as a job of their own without compensation. Gives each
/// sample's distance [m] from the path first desired, with its place on it. The distance is sought
/// over the whole path, not near an expected place.
fn simulated_again(changes: &[(&'static str, Value)]) -> Vec<(f64, Vector3<f64>)> {
    let report = run(changes);
    let (_, program) = read_back(&report, "gcode", &ExportOptions::default());
    let points: Vec<_> = chain(&program).iter().map(|p| [p.x, p.y, p.z].map(|x| x * 1e3)).collect();
    let mut again = changes.to_vec();
    again.retain(|(key, _)| *key != "path");
    again.push(("path", json!({"kind":"polyline","points_mm":points})));
    again.push(("compensation.sources", json!([])));
    let length = report.plan.path.length();
    let nearest = |p: &Vector3<f64>| report.plan.path.closest(p, length / 2.0, length).point;
    run(&again).after.actual.iter().map(|p| ((p - nearest(p)).norm(), nearest(p))).collect()
}

/// Exported, read back and simulated with compensation off, a path stays within the job's tolerance
/// plus the thinning's (0.011 mm) of the path first desired, at the same feed, acceleration and
/// corner rule as the first time. Bounds on this, all found by measuring:
///
/// - The second run takes the bent path for the path desired, so its cutting force follows the bent
///   path's tangent. This costs the deflection squared over the path's radius (1.2 mm on 15 mm:
///   0.028 mm); hence the lighter cut on the rounded rectangle.
/// - Where the cut begins, the correction leads the command aside within the run-in, and the second
///   run's force turns with it (0.036 mm): within 20 mm of the start nothing is asserted.
/// - In a sharp corner the correction steps from one side's to the other's while the tool waits.
///   The second run takes the step for a cut of its own, in its own direction: within 1 mm of a
///   corner nothing is asserted.
/// - A correction for shaping belongs to the instants it was made for. Where all of it lies in the
///   dwells and at the ends of straight lines, it survives as points (asserted, without force). On
///   an arc it does not survive at the ends (0.03 mm, from 0.1 mm), which is why the header says
///   so.
#[test]
fn an_export_simulated_again_meets_the_tolerance() {
    let allowed = 1.1e-5;
    let [(_, arc), (_, rounded), (_, sharp)] = small_jobs();
    let with = |job: &[(&'static str, Value)], more: &[(&'static str, Value)]| [job, more].concat();
    let rigid = ("shaper", json!("none"));
    let light = ("cutting.axial_depth_mm", json!(2));
    for (name, changes) in [
        ("arc", with(&arc, std::slice::from_ref(&rigid))),
        ("rounded rectangle", with(&rounded, &[rigid.clone(), light.clone()])),
        (
            "rectangle, shaping",
            with(&sharp, &[("cutting.axial_depth_mm", json!(0.001)), ("motion.feed_mm_s", json!(30))]),
        ),
    ] {
        let again = simulated_again(&changes);
        let away = again.iter().filter(|(_, place)| (place - again[0].1).norm() > 0.02);
        let worst = away.map(|(e, _)| *e).fold(0.0, f64::max);
        assert!(worst <= allowed, "{name}: {worst}");
    }
    let changes = with(&sharp, &[rigid, light]);
    let workpiece = run(&changes).setup().workpiece;
    let corners = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]]
        .map(|[x, y]| workpiece.point(&Vector3::new(0.06 * x, 0.04 * y, 0.0)));
    let errors = simulated_again(&changes);
    let away: Vec<f64> = errors
        .iter()
        .filter(|(_, place)| corners.iter().all(|corner| (corner - place).norm() > 1e-3))
        .map(|(e, _)| *e)
        .collect();
    assert!(away.len() > errors.len() / 2);
    let worst = away.iter().copied().fold(0.0, f64::max);
    assert!(worst <= allowed, "rectangle, away from corners: {worst}");
}

/// The remark that a program was computed with an earlier model, if it gets one.
fn earlier(kind: &str, text: &str) -> Option<String> {
    let (_, changes) = &small_jobs()[2];
    let report = run(&[changes[0].clone(), ("path", json!({"kind": kind, "text": text}))]);
    let remark = report.warnings.iter().find(|warning| warning.code == "earlier-model");
    remark.map(|warning| warning.message.clone())
}

#[test]
fn a_program_of_an_earlier_model_says_so_when_it_is_opened() {
    // As headers were written before there was a number.
    let header = [
        "Armill 0.1.0, run 57d9a2f0c1b3e4865f0d7a9b2c4e6813",
        "Path compensated for deflection and shaping, robot model Staubli RX-90",
        "Tolerance asked 0.01 mm, largest contour error reached 0.0049 mm, 1.25 mm without compensation, simulated",
    ];
    let lines = |before: &str, after: &str| header.map(|line| format!("{before}{line}{after}\n")).concat();
    let old = [
        ("gcode", format!("%\n{}G21 G90 S4000 M3\nG0 X-60 Y-40 Z0\nG1 X60 F6000\nM30\n%\n", lines("(", ")"))),
        (
            "apt",
            format!(
                "PARTNO/ARMILL\n{}UNITS/MM\nFEDRAT/6000,MMPM\nGOTO/-60,-40,0\nGOTO/60,-40,0\nFINI\n",
                lines("$$ ", "")
            ),
        ),
        ("csv", format!("{}x_mm,y_mm,z_mm,feed_mm_s\n-60,-40,0,100\n60,-40,0,100\n", lines("# ", ""))),
    ];
    for (kind, text) in &old {
        let line = if *kind == "csv" { 1 } else { 2 };
        let expected =
            format!("line {line}: this program was computed with an earlier model; figures differ");
        assert_eq!(earlier(kind, text), Some(expected.clone()), "{kind}");
        let numbered = |model: u32| text.replace("run 57d9", &format!("model {model}, run 57d9"));
        assert_eq!(earlier(kind, &numbered(1)), Some(expected), "{kind}");
        assert_eq!(earlier(kind, &numbered(2)), None, "{kind}");
        assert_eq!(earlier(kind, &text.replace("Armill", "CAM")), None, "{kind}: another's program");
    }

    // What is written now has none, a rewritten old program included.
    let (_, changes) = &small_jobs()[2];
    let report = run(changes);
    for (id, kind) in [("gcode", "gcode"), ("apt", "apt"), ("path-csv", "csv")] {
        assert_eq!(earlier(kind, &written(&report, id).text), None, "{id}");
    }
    let (kind, text) = &old[0];
    let again =
        written(&run(&[changes[0].clone(), ("path", json!({"kind": kind, "text": text}))]), "gcode").text;
    assert!(again.contains(header[0]), "comments are kept");
    assert_eq!(earlier(kind, &again), None);
}
