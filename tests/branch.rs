//! The arm's branch: where it ends, its whole turns, and a start in the wrist singularity.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod common;

use armill::robot::library;
use armill::{Error, Report};
use common::{job_text, refused, run};
use serde_json::{Value, json};

/// An arm without tool, shaper and cut along a path.
fn changes(robot: &str, path: Value, more: &[(&'static str, Value)]) -> Vec<(&'static str, Value)> {
    let mut all = vec![
        ("robot", json!({"preset": robot})),
        ("path", path),
        ("motion.sample_time_s", json!(0.004)),
        ("shaper", json!("none")),
        ("cutting.axial_depth_mm", json!(0)),
    ];
    all.extend(more.iter().cloned());
    all
}

fn has(report: &Report, code: &str) -> bool {
    report.warnings.iter().any(|warning| warning.code == code)
}

#[test]
fn where_a_branch_ends_is_an_error_with_its_place() {
    // Over its back the arm reaches less far than to its front. The wrist centre is above the tip
    // by c4 and, seen from axis 2, ahead by a1 more than from axis 1.
    let arm = library::robot("kuka-kr-210-2").unwrap();
    let [a1, a2, _, c1, c2, c3, c4] = arm.opw.lengths_mm;
    let (from, z) = (1200.0, 900.0);
    let ends = ((c2 + a2.hypot(c3)).powi(2) - (z + c4 - c1).powi(2)).sqrt() - a1;
    let text = format!("{from},0,{z}\n{},0,{z}", ends + 100.0);
    let path = json!({"kind": "csv", "text": text});
    let back = json!({"shoulder": "back", "elbow": "negative", "wrist": "near"});
    let all = changes("kuka-kr-210-2", path, &[("start_branch", back)]);
    let error = refused(&all);
    let Error::BranchEnds { arc_length, sample, line, joint, turn, .. } = error else { panic!("{error}") };
    // A sample is at most 0.4 mm from the next.
    let beyond = arc_length * 1e3 - (ends - from);
    assert!((0.0..=0.4).contains(&beyond), "{beyond} mm beyond the end");
    assert!(sample > 0 && line == 2 && (1..=6).contains(&joint) && turn > 1.0, "{error}");
    assert_eq!(error.code(), "branch-ends");
    let said = error.to_string();
    for part in ["line 2", "mm along the path", "start_branch", "spin", "move the part"] {
        assert!(said.contains(part), "{said}");
    }
    // The front branch goes on.
    let mut front = all;
    front.pop();
    assert!(!has(&run(&front), "joint-jump"));
}
