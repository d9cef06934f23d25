//! The script entry (`examples/identify.rs`) as a person at a shell meets it.

use serde_json::Value;
use std::process::{Command, Output};

fn script(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO"));
    command.args(["run", "--quiet", "--locked", "--example", "identify", "--"]).args(arguments);
    command.current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap()
}

fn printed(arguments: &[&str]) -> Value {
    let output = script(arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn the_measured_example_is_identified() {
    let robot = "web/examples/identify-fanuc-r2000ic.json";
    let found =
        printed(&["web/examples/identify-fanuc-r2000ic.csv", "--robot", robot, "--joints", "coupled-j3"]);
    assert!((found["joint_compliance_rad_per_nm"][0].as_f64().unwrap() / 1.161581e-6 - 1.0).abs() < 1e-5);
    // As described in the docs.
    let percent = |key: &str| (100.0 * found[key].as_f64().unwrap()).round();
    let page = include_str!("../../docs/identify.md");
    let words = format!(
        "{:.0} % of the squared displacements; a row is missed by {:.0} % on average, by {:.0} %",
        percent("explained"),
        percent("mean_relative_residual"),
        percent("mean_relative_left_out")
    );
    assert!(page.replace('\n', " ").contains(&words), "{words}");
}

#[test]
fn a_response_is_identified_and_errors_are_one_json_object() {
    let file = format!("{}/response.csv", env!("CARGO_TARGET_TMPDIR"));
    let rows = (0..2000)
        .map(|k| f64::from(k) / 500.0)
        .map(|t| format!("{t},{}\n", (-1.8 * t).exp() * (17.9 * t).cos()));
    std::fs::write(&file, rows.collect::<String>()).unwrap();
    let found = printed(&[&file, "--response", "--from", "0"]);
    let expected = 17.9_f64.hypot(1.8);
    assert!((found["frequency_rad_s"].as_f64().unwrap() / expected - 1.0).abs() < 1e-9);
    assert!((found["damping"].as_f64().unwrap() * expected / 1.8 - 1.0).abs() < 1e-9);

    for (arguments, code) in [
        (vec!["nowhere.csv"], "usage"),
        (vec![&file], "text"),
        (vec![&file, "--joints", "x"], "invalid"),
        (vec![], "usage"),
    ] {
        let output = script(&arguments);
        assert_eq!(output.status.code(), Some(1));
        let error: Value = serde_json::from_slice(&output.stderr).unwrap();
        assert_eq!(error["code"], code, "{arguments:?}");
    }
}

/// The docs' figures are the script's.
#[test]
fn a_gear_is_identified_and_the_other_run_predicted() {
    let file = |run: &str| format!("web/examples/gear-kuka-kr300-{run}.csv");
    let a = printed(&[&file("a"), "--gear", "--predict", &file("b")]);
    let b = printed(&[&file("b"), "--gear"]);
    let page = include_str!("../../docs/identify.md").replace('\n', " ");
    let text = |found: &Value| {
        let joint = &found["joints"][0];
        let [low, high] =
            [0, 1].map(|end| joint["stiffness_interval_nm_per_rad"][end].as_f64().unwrap() / 1e6);
        format!("{:.2}e6", joint["stiffness_nm_per_rad"].as_f64().unwrap() / 1e6)
            + if joint["predicted"].is_null() { " (" } else { " N m/rad (" }
            + &format!("{low:.2} to {high:.2})")
    };
    for found in [&a, &b] {
        assert!(page.contains(&text(found)), "{}", text(found));
        let rest = format!("{:.0} urad", found["joints"][0]["rest_urad"].as_f64().unwrap());
        assert!(page.contains(&rest), "{rest}");
    }
    let predicted = 100.0 * a["joints"][0]["predicted"]["explained"].as_f64().unwrap();
    assert!(page.contains(&format!("predicts {predicted:.1} % of B")), "{predicted}");
}
