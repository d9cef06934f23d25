//! The script entry (`examples/run.rs`) as a user at a shell meets it.

use crate::common::job_text;
use serde_json::{Value, json};
use std::path::PathBuf;
use std::process::{Command, Output};

/// Runs the example through cargo, because `cargo test --test native script` alone would not bring it up
/// to date.
fn script() -> Command {
    let mut command = Command::new(env!("CARGO"));
    command
        .args(["run", "--quiet", "--locked", "--example", "run", "--"])
        .current_dir(env!("CARGO_MANIFEST_DIR"));
    command
}

/// A file of this test's own.
fn file(name: &str, text: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path
}

fn json_of(bytes: &[u8]) -> Value {
    serde_json::from_slice(bytes)
        .unwrap_or_else(|error| panic!("{error}: {}", String::from_utf8_lossy(bytes)))
}

fn refusal(output: &Output) -> Value {
    assert_eq!(output.status.code(), Some(1));
    assert!(output.stdout.is_empty());
    json_of(&output.stderr)
}

#[test]
fn without_a_file_the_default_job_is_printed() {
    let output = script().output().unwrap();
    assert!(output.status.success());
    let printed = json_of(&output.stdout);
    let summary = armill::run(&armill::Job::default(), &mut armill::Progress::none()).unwrap().summary();
    assert_eq!(printed["fingerprint"], summary.fingerprint);
    assert_eq!(printed["model"], 2);
    assert_eq!(printed["samples"], summary.samples);
    assert_eq!(printed["before_mm"]["both"]["max"], summary.before_mm.both.max);
    let as_program = printed["as_program"]["max_mm"].as_f64().unwrap();
    assert_eq!(printed["as_program"]["met"], as_program <= summary.tolerance_mm);
    // Points and arcs of a program stray by no more than the thinning's 0.001 mm and what adds to it.
    assert!((as_program - summary.after_mm.max).abs() < 0.005, "{as_program}");
    for key in ["duration_s", "mean_force_n", "after_mm", "passes", "converged", "history_max_mm", "warnings"]
    {
        assert!(!printed[key].is_null(), "{key}");
    }
}

#[test]
fn a_job_file_is_computed_and_its_columns_written() {
    let path = json!({"kind":"line","from_mm":[600,-50,100],"to_mm":[600,50,100]});
    let job = file("line.json", &job_text(&[("path", path)]));
    let columns = job.with_file_name("line.csv");
    let output = script().arg(&job).arg("--columns").arg(&columns).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let samples = json_of(&output.stdout)["samples"].as_u64().unwrap();
    let text = std::fs::read_to_string(columns).unwrap();
    assert!(text.starts_with("time_s,arc_length_mm,desired_x_mm"));
    assert_eq!(text.lines().count() as u64, samples + 1);
}

#[test]
fn errors_are_one_json_object() {
    let job = file("bad.json", "{\n  \"motion\": { \"feed\": 1 } }");
    let error = refusal(&script().arg(job).output().unwrap());
    assert_eq!(error["code"], "unknown-key");
    assert_eq!(error["field"], "motion.feed");
    assert_eq!((&error["line"], &error["column"]), (&json!(2), &json!(15)));

    let job = file("range.json", &job_text(&[("tool.flutes", json!(0))]));
    let error = refusal(&script().arg(job).output().unwrap());
    assert_eq!((&error["code"], &error["field"]), (&json!("out-of-range"), &json!("tool.flutes")));
    assert!(error.get("line").is_none());

    for arguments in
        [vec!["--colums", "x"], vec!["--columns"], vec!["no-such-file.json"], vec!["a.json", "b.json"]]
    {
        let error = refusal(&script().args(&arguments).output().unwrap());
        assert_eq!(error["code"], "usage", "{arguments:?}");
    }
}
