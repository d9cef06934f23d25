//! What is promised, and that page, files and script promise the same.

use crate::common::run;
use armill::Report;
use armill::export::{ExportOptions, FORMATS};
use armill::report::VerdictState;
use armill::verification::Programs;
use serde_json::{Value, json};

/// A rounded rectangle by an arm that can carry the cut, with a tolerance and 95 % ranges.
fn job(tolerance_mm: f64, percent: f64, more: &[(&'static str, Value)]) -> Report {
    let changes = [
        ("robot", json!({"preset":"kuka-kr-210-2"})),
        ("workpiece_frame", json!({"xyz_mm":[1700,0,700]})),
        (
            "path",
            json!({"kind":"rectangle","center_mm":[0,0,0],"width_mm":200,"height_mm":120,"corner_radius_mm":20}),
        ),
        ("motion", json!({"feed_mm_s":40,"sample_time_s":0.01})),
        ("material", json!({"preset":"al-7075-t6"})),
        ("cutting.axial_depth_mm", json!(2)),
        ("shaper", json!("none")),
        ("compensation.tolerance_mm", json!(tolerance_mm)),
        ("uncertainty", json!({"stiffness_percent":percent,"cutting_percent":percent})),
    ];
    run(&[&changes, more].concat())
}

#[test]
fn the_tolerance_is_met_by_what_is_known_or_only_by_exact_numbers() {
    let narrow = job(0.1, 20.0, &[]);
    let (nominal, p95) = (narrow.after_max(), narrow.band.after.p95);
    assert!(nominal < 1e-6 && p95 > 1e-5, "{nominal} {p95}");
    let text = |report: &Report| (report.verdict_state(), report.verdict());
    // The tolerance between the two, above both, below both. Both are left to find out the state.
    let between = job(0.5e3 * p95, 20.0, &[]);
    let above = job(2e3 * p95, 20.0, &[]);
    let (state, words) = text(&between);
    assert_eq!(state, VerdictState::MetIfNominal);
    assert!(words.ends_with("is met if the numbers are exact, but not in 95 of 100 cases."), "{words}");
    let (state, words) = text(&above);
    assert_eq!(state, VerdictState::Met);
    assert!(words.starts_with("Expect ") && words.ends_with(" is met."), "{words}");
    let (state, words) = text(&job(0.01, 20.0, &[("compensation.max_passes", json!(0))]));
    assert_eq!(state, VerdictState::NotMet);
    assert!(words.starts_with("Not compensated: expect ") && words.ends_with(" is not met."), "{words}");
    // With exact numbers, nothing is left but the nominal model, and no range is stated.
    let (state, words) = text(&job(0.1, 0.0, &[]));
    assert_eq!(state, VerdictState::Met);
    assert!(words.starts_with("Expect less than 0.01 mm on the part; "), "{words}");
}

/// No figure of a verdict is finer than a hundredth of a millimetre.
#[test]
fn nothing_is_promised_below_a_hundredth_of_a_millimetre() {
    for report in [job(0.1, 0.0, &[]), job(0.1, 5.0, &[]), job(0.1, 40.0, &[])] {
        let words = report.verdict();
        let (expected, _) = words.split_once(';').unwrap();
        for figure in expected.split(' ').filter_map(|word| word.parse::<f64>().ok()) {
            assert!((figure * 100.0).fract().abs() < 1e-6 && figure >= 0.01, "{words}");
        }
    }
}

#[test]
fn the_worst_of_tip_top_and_missed_decides() {
    // A corner that a shaped command cuts off: every tip is near a leg, the corner is 2.5 mm away.
    let spike = [
        ("path", json!({"kind":"polyline","points_mm":[[0,0,0],[60,0,0],[0,10.6,0]]})),
        ("motion", json!({"feed_mm_s":40,"acceleration_mm_s2":400,"sample_time_s":0.002,"corner_dwell":0})),
        ("shaper", json!({"kind":"zvd","frequency_rad_s":18,"damping":0.1})),
        ("compensation.max_passes", json!(0)),
    ];
    let report = job(1.0, 5.0, &spike);
    let missed = report.missed().max;
    assert!(report.band.after.p95 < 0.5e-3 && missed > 2e-3, "{missed}");
    assert_eq!(report.verdict_state(), VerdictState::NotMet);
    let said = format!("is not met: the path is missed by {:.2} mm.", missed * 1e3);
    assert!(report.verdict().ends_with(&said), "{} {said}", report.verdict());
    let program = Programs::default().accuracy(&report, "gcode").unwrap();
    assert!(!program.met && program.sentence.contains("the path is missed by"), "{}", program.sentence);

    // A deep cut tilts the tool: the tip is right, the top of the cut is not.
    let deep = [
        ("cutting.axial_depth_mm", json!(8)),
        ("tool_frame", json!({"xyz_mm":[0,0,350]})),
        ("motion", json!({"feed_mm_s":40,"acceleration_mm_s2":2000,"sample_time_s":0.01})),
    ];
    let report = job(0.01, 0.0, &deep);
    let (tip, top) = (report.after_max(), report.wall().max);
    assert!(tip < 0.01e-3 && top > 0.01e-3, "{tip} {top}");
    assert_eq!(report.verdict_state(), VerdictState::NotMet);
    let said = format!("is not met: the top of the cut is off by {:.4} mm.", top * 1e3);
    assert!(report.verdict().ends_with(&said), "{} {said}", report.verdict());
    // Corrected at tip and axis, both are.
    let axis = job(0.01, 0.0, &[&deep[..], &[("compensation.at", json!("axis"))]].concat());
    assert_eq!(axis.verdict_state(), VerdictState::Met, "{}", axis.verdict());
}

/// The text of a file without its line breaks and comment marks, which a language may put anywhere.
fn words(text: &str) -> String {
    let comment = |line: &str| match line.split_once('!') {
        Some((number, rest)) if number.trim().trim_end_matches(':').parse::<u32>().is_ok() => {
            rest.replace(" ;", "")
        }
        _ => line.trim_start_matches("$$").to_owned(),
    };
    let all: Vec<String> = text.lines().map(comment).collect();
    all.join(" ").split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn every_file_says_what_page_and_script_say() {
    let cannot = run(&[("motion.sample_time_s", json!(0.01))]);
    assert_eq!(cannot.verdict_state(), VerdictState::CannotRun);
    for (report, words_of_state) in [
        (cannot, "the arm cannot run it"),
        (job(1.0, 5.0, &[]), "tolerance met"),
        (job(0.1, 40.0, &[]), "tolerance met if the numbers are exact"),
        (job(0.001, 40.0, &[("compensation.max_passes", json!(0))]), "tolerance not met"),
    ] {
        let programs = Programs::default();
        let verdict = report.verdict();
        let opening: String = verdict.chars().take_while(|c| !";(²".contains(*c)).collect();
        for format in FORMATS {
            if ["columns-csv", "compensated-csv"].contains(&format.id) {
                continue;
            }
            let text = programs.export(&report, format.id, &ExportOptions::default()).unwrap().text;
            let header = words(&text);
            assert!(
                header.contains(&opening),
                "{}: {opening}\n{}",
                format.id,
                &header[..1500.min(header.len())]
            );
            if !["joints-csv", "correction-csv"].contains(&format.id) {
                assert!(header.contains(words_of_state), "{}: {words_of_state}", format.id);
                let accuracy = programs.accuracy(&report, format.id).unwrap();
                assert_eq!(accuracy.verdict_state, report.verdict_state(), "{}", accuracy.sentence);
                assert_eq!(accuracy.met, report.verdict_state() == VerdictState::Met);
            }
        }
        let summary = serde_json::to_value(report.summary()).unwrap();
        assert_eq!(summary["verdict"], verdict);
        assert_eq!(summary["verdict_state"], json!(report.verdict_state()));
    }
}

/// What cannot run is said first, with its place and what cures it.
#[test]
fn what_cannot_run_is_named_with_place_and_remedy() {
    let report = run(&[]);
    let warning = &report.warnings[0];
    let (from, to) = (warning.from_s.unwrap(), warning.to_s.unwrap());
    let verdict = report.verdict();
    for part in [
        "The arm cannot run this: joint 1 leaves its range by up to ".to_owned(),
        format!("{from:.2} to {to:.2} s. Remedy: place the path in front of the robot"),
    ] {
        assert!(verdict.contains(&part), "{verdict}: {part}");
    }
    assert!(report.how_sure().sentence.starts_with("The arm cannot run this. If it could, expect "));
}

/// A path that three axes cannot follow is judged as APT, not as a G-code program that there is not.
#[test]
fn a_program_that_cannot_be_written_is_not_judged() {
    let report = job(0.1, 5.0, &[("compensation.at", json!("axis"))]);
    let programs = Programs::default();
    let refused = programs.accuracy(&report, "gcode").unwrap_err();
    assert_eq!(refused.field(), Some("compensation.at"));
    let usual = programs.usual_accuracy(&report).unwrap();
    assert!(usual.sentence.starts_with("As an APT"), "{}", usual.sentence);
    assert_eq!(usual, programs.accuracy(&report, "apt").unwrap());
}

/// A filter that is slower than assumed cuts more off a corner: runs of the whole model at the
/// frequencies of the draws say how much.
#[test]
fn what_is_missed_is_drawn_too() {
    let corner = |frequency_hz: f64, percent: f64| {
        let changes = [
            ("path", json!({"kind":"polyline","points_mm":[[-60,-60,0],[60,0,0],[-60,20,0]]})),
            (
                "motion",
                json!({"feed_mm_s":30,"acceleration_mm_s2":300,"sample_time_s":0.004,"corner_dwell":0}),
            ),
            ("shaper", json!({"kind":"zvd","frequency_hz":frequency_hz,"damping":0.03})),
            ("compensation.max_passes", json!(0)),
            ("uncertainty", json!({"stiffness_percent":0,"cutting_percent":0,"frequency_percent":percent})),
        ];
        job(0.23, 0.0, &changes)
    };
    let report = corner(10.0, 20.0);
    let spread = report.setup().spreads.frequency;
    // 5 % of the frequencies are lower.
    let slow = corner(10.0 * spread.at(-1.645), 0.0).missed().max;
    assert!(slow > 1.2 * report.missed().max, "{slow}");
    assert!((report.band.missed_p95 / slow - 1.0).abs() < 0.01, "{} {slow}", report.band.missed_p95);
    assert_ne!(report.verdict_state(), VerdictState::Met, "{}", report.verdict());
}

/// A run that meets a tolerance at 95 % also meets a looser one.
#[test]
fn a_looser_tolerance_is_no_reason_to_compensate_less() {
    let mut met = f64::INFINITY;
    for tolerance in [0.02, 0.05, 0.08, 0.12, 0.2, 0.3, 0.5] {
        let report = job(tolerance, 40.0, &[]);
        met = met.min(report.band.after.p95.max(report.band.wall.p95));
        assert_eq!(met <= tolerance * 1e-3, report.verdict_state() == VerdictState::Met, "{tolerance}");
    }
}

#[test]
fn what_is_not_compensated_is_the_same_before_and_after() {
    let report = job(0.1, 40.0, &[("compensation.max_passes", json!(0))]);
    assert_eq!((report.band.before, report.band.worse), (report.band.after, 0.0));
    assert_eq!(report.how_sure().break_even, "Nothing is compensated.");
    assert!(report.how_sure().measure_first.is_none_or(|first| first.input != "frequency"));
}

#[test]
fn no_quantile_along_the_path_exceeds_that_of_the_largest() {
    let report = job(0.1, 40.0, &[]);
    let most = (0..report.samples()).map(|k| report.band.p95_at(k)).fold(0.0, f64::max);
    assert!(most <= report.band.after.p95);
}
