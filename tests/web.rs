//! The wasm boundary in a real browser: the same bits as natively, and the contract that the page
//! relies on.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]
#![cfg(target_arch = "wasm32")]

mod common;

use armill::wasm;
use common::measured::{CUTS, CUTS_JOB, LOADS, LOOP, PASS, PASS_JOB, RESPONSE, ROBOT, RUNS, same};
use common::{job_text, pinned};
use js_sys::{Float64Array, Function, Reflect};
use serde_json::json;
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_test::{wasm_bindgen_test, wasm_bindgen_test_configure};

wasm_bindgen_test_configure!(run_in_browser);

fn get(object: &JsValue, path: &str) -> JsValue {
    path.split('.').fold(object.clone(), |value, key| Reflect::get(&value, &key.into()).unwrap())
}

fn number(object: &JsValue, path: &str) -> f64 {
    get(object, path).as_f64().unwrap_or_else(|| panic!("{path} is not a number"))
}

fn text(object: &JsValue, path: &str) -> String {
    get(object, path).as_string().unwrap_or_else(|| panic!("{path} is no text"))
}

/// The error that `run` throws for a job.
fn thrown(json: &str) -> JsValue {
    wasm::run(json, None).map(|_| ()).unwrap_err()
}

#[wasm_bindgen_test]
fn the_browser_gives_the_same_bits() {
    for (name, changes, fingerprint) in pinned() {
        let run = wasm::run(&job_text(&changes), None).unwrap();
        // tests/job.rs asserts the same fingerprints natively.
        assert_eq!(run.fingerprint(), fingerprint, "{name}");
        assert_eq!(text(&run.summary().unwrap(), "fingerprint"), fingerprint);
    }
}

#[wasm_bindgen_test]
fn the_default_job_and_its_summary() {
    let run = wasm::run(&wasm::default_job(), None).unwrap();
    let summary = run.summary().unwrap();
    assert!((number(&summary, "before_mm.deflection.mean") - 1.13).abs() < 0.005);
    assert!((number(&summary, "after_mm.max") - 0.042).abs() < 0.001);
    assert_eq!(get(&summary, "converged"), JsValue::FALSE);
    assert_eq!(number(&summary, "mean_force_n.length"), 3.0);
    assert_eq!(number(&summary, "model"), f64::from(wasm::model()));
    assert!(text(&summary, "verdict").starts_with("The arm cannot run this: joint 1 leaves its range"));
    assert_eq!(text(&summary, "warnings.0.code"), "joint-limit");
    assert!(number(&summary, "warnings.0.from_sample") > 0.0);
}

#[wasm_bindgen_test]
fn columns_are_float64_arrays_of_one_length() {
    let run = wasm::run(&wasm::default_job(), None).unwrap();
    let samples = number(&run.summary().unwrap(), "samples");
    let heads = run.columns().unwrap();
    let count = number(&heads, "length") as u32;
    assert!(count >= 31);
    for i in 0..count {
        let key = text(&heads, &format!("{i}.key"));
        let column = run.column(&key).unwrap();
        assert_eq!(f64::from(column.length()), samples, "{key}");
        assert!(column.to_vec().iter().all(|value| value.is_finite()), "{key}");
    }
    let error: JsValue = run.column("nothing").map(|_: Float64Array| ()).unwrap_err();
    assert_eq!(text(&error, "code"), "invalid");
}

#[wasm_bindgen_test]
fn errors_are_errors_with_data() {
    let error = thrown(&job_text(&[("motion.feed_mm_s", json!(-1))]));
    assert!(error.is_instance_of::<js_sys::Error>());
    assert_eq!(text(&error, "code"), "out-of-range");
    assert_eq!(text(&error, "field"), "motion.feed_mm_s");
    assert!(text(&error, "message").contains("it must be 0.001 to 10000 mm/s"));
    assert!(get(&error, "line").is_undefined());

    let error = thrown("{\n \"moton\": {}}");
    assert_eq!(text(&error, "code"), "unknown-key");
    assert_eq!((number(&error, "line"), number(&error, "column")), (2.0, 2.0));

    let points = json!({"kind":"csv","text":"600,0,100\n600,zero,100"});
    let error = thrown(&job_text(&[("path", points)]));
    assert_eq!((text(&error, "code").as_str(), text(&error, "field").as_str()), ("text", "path.text"));
    assert_eq!((number(&error, "line"), number(&error, "column")), (2.0, 5.0));

    let far = json!({"kind":"line","from_mm":[600,0,100],"to_mm":[1600,0,100]});
    let error = thrown(&job_text(&[("path", far)]));
    assert_eq!(text(&error, "code"), "unreachable");
    assert!(get(&error, "field").is_undefined());
    assert!(text(&error, "message").contains("sample "));
    assert!(wasm::check(&wasm::default_job()).is_ok());
    assert!(wasm::check("[]").is_err());
}

#[wasm_bindgen_test]
fn charts_come_as_svg_with_their_scales() {
    let run = wasm::run(&wasm::default_job(), None).unwrap();
    let charts = run.charts().unwrap();
    let options = js_sys::JSON::parse("{\"width\":640,\"height\":300}").unwrap();
    for i in 0..number(&charts, "length") as u32 {
        let name = text(&charts, &format!("{i}.name"));
        let chart = run.chart(&name, options.clone()).unwrap();
        let parser = js_sys::eval("new DOMParser()").unwrap();
        let parse: Function = get(&parser, "parseFromString").unchecked_into();
        let svg = text(&chart, "svg");
        let document = parse.call2(&parser, &svg.as_str().into(), &"image/svg+xml".into()).unwrap();
        assert_eq!(text(&document, "documentElement.nodeName"), "svg", "{name} is well-formed");
        assert!(
            number(&chart, "plot.width") > 300.0 && number(&chart, "x.max") > number(&chart, "x.min"),
            "{name}"
        );
    }
}

#[wasm_bindgen_test]
fn what_charts_show_comes_as_columns_in_the_units_asked_for() {
    let run = wasm::run(&wasm::default_job(), None).unwrap();
    let data = |options: &str| run.chart_data("before-after", js_sys::JSON::parse(options).unwrap());
    let metric = data("{}").unwrap();
    assert_eq!((text(&metric, "1.key").as_str(), text(&metric, "1.unit").as_str()), ("before_mm", "mm"));
    let values = |object: &JsValue| get(object, "1.values").unchecked_into::<Float64Array>().to_vec();
    assert_eq!(values(&metric), run.column("contour_error_mm").unwrap().to_vec());
    let imperial = data(r#"{"length":"inch"}"#).unwrap();
    assert_eq!(text(&imperial, "1.key"), "before_inch");
    assert!((values(&imperial)[0] * 25.4 - values(&metric)[0]).abs() < 1e-12);
    assert_eq!(text(&data(r#"{"length":"yard"}"#).unwrap_err(), "field"), "length");
}

#[wasm_bindgen_test]
fn charts_are_drawn_by_decades_and_over_the_path() {
    let run = wasm::run(&wasm::default_job(), None).unwrap();
    let asked = r#"{"width":640,"height":300,"scale":"log","over":"length"}"#;
    let chart = run.chart("before-after", js_sys::JSON::parse(asked).unwrap()).unwrap();
    assert_eq!((text(&chart, "x.label").as_str(), text(&chart, "x.unit").as_str()), ("Path length", "mm"));
    assert!(get(&chart, "y.log").is_truthy());
    assert_eq!((number(&chart, "y.floor"), number(&chart, "y.min")), (1e-4, 1e-4));
    let data = run.chart_data("before-after", js_sys::JSON::parse(r#"{"over":"length"}"#).unwrap()).unwrap();
    let along: Float64Array = get(&data, "0.values").unchecked_into();
    assert_eq!(along.to_vec(), run.column("arc_length_mm").unwrap().to_vec());
    // A shape is drawn over two axes, a path in space over none.
    let charts = run.charts().unwrap();
    let over = |name: &str| {
        let all = 0..number(&charts, "length") as u32;
        let at = all.into_iter().find(|i| text(&charts, &format!("{i}.name")) == name).unwrap();
        number(&charts, &format!("{at}.over.length"))
    };
    assert_eq!((over("before-after"), over("path")), (2.0, 0.0));
}

#[wasm_bindgen_test]
fn options_are_refused_with_their_key() {
    let run = wasm::run(&wasm::default_job(), None).unwrap();
    let refused = |options: &str| {
        let error = run.chart("before-after", js_sys::JSON::parse(options).unwrap()).unwrap_err();
        (text(&error, "code"), text(&error, "field"), text(&error, "message"))
    };
    for (options, code, field, part) in [
        (r#"{"width":"wide","height":300}"#, "invalid", "width", "\"wide\"; a number of pixels is expected"),
        (r#"{"width":640}"#, "missing", "height", "a number of pixels"),
        (r#"{"width":null,"height":300}"#, "missing", "width", "a number of pixels"),
        (r#"{"width":640,"height":300,"widht":1}"#, "invalid", "widht", "width, height"),
        (r#"{"width":640,"height":300,"x_range":[1]}"#, "invalid", "x_range", "two numbers"),
        (r#"{"width":640,"height":300,"x_range":[1,2,3]}"#, "invalid", "x_range", "two numbers"),
        (r#"{"width":640,"height":300,"x_range":[1,"b"]}"#, "invalid", "x_range", "[1,\"b\"]"),
        (r#"{"width":640,"height":300,"x_range":5}"#, "invalid", "x_range", "5; two numbers"),
        (r#"{"width":640,"height":300,"hidden":"all"}"#, "invalid", "hidden", "\"all\"; a list"),
        (r#"{"width":640,"height":300,"length":"yard"}"#, "invalid", "length", "mm or inch"),
        (r#"{"width":640,"height":300,"force":[]}"#, "invalid", "force", "N or lbf"),
        (r#"{"width":640,"height":300,"scale":"ln"}"#, "invalid", "scale", "linear, log or auto"),
        (r#"{"width":640,"height":300,"over":"distance"}"#, "invalid", "over", "time, length or line"),
        (r#"{"width":640,"height":300,"over":"line"}"#, "invalid", "over", "\"time\" or \"length\""),
        (r#""wide""#, "invalid", "options", "an object is expected"),
        (r#"{"width":20,"height":300}"#, "invalid", "chart", "between 120 and 8000"),
    ] {
        let (is, at, message) = refused(options);
        assert_eq!((is.as_str(), at.as_str()), (code, field), "{options}: {message}");
        assert!(message.contains(part), "{options}: {message}");
    }
    // A key that is undefined is absent, what JSON cannot write is refused all the same, and the run
    // stays in one piece.
    let evaluated = |text: &str| js_sys::eval(text).unwrap();
    let absent = "({ width: 640, height: 300, length: undefined, hidden: undefined, x_range: null })";
    assert!(run.chart("before-after", evaluated(absent)).is_ok());
    for odd in ["({ width: undefined, height: 300 })", "({ width: () => 1, height: 300 })", "(() => 1)"] {
        assert!(run.chart("before-after", evaluated(odd)).is_err(), "{odd}");
    }
    let force = js_sys::JSON::parse(r#"{"width":640,"height":300,"scale":"log"}"#).unwrap();
    assert_eq!(text(&run.chart("force", force).unwrap_err(), "field"), "scale", "forces may be negative");
    let whole = js_sys::JSON::parse(r#"{"width":640,"height":300,"length":"inch"}"#).unwrap();
    assert!(run.chart_data("before-after", whole).is_ok(), "a chart's options hold its units");
    assert!(run.chart_data("before-after", JsValue::UNDEFINED).is_ok(), "units may be left out");
}

#[wasm_bindgen_test]
fn progress_is_told_and_files_come_out() {
    let heard = js_sys::eval(
        "(() => { const heard = []; const report = (f, s) => heard.push([f, s]); report.heard = heard; \
         return report; })()",
    )
    .unwrap();
    let run = wasm::run(&wasm::default_job(), Some(heard.clone().unchecked_into())).unwrap();
    assert!(number(&heard, "heard.length") >= 5.0);
    assert_eq!(text(&heard, "heard.0.1"), "joint commands");
    let csv = run.export("compensated-csv", None).unwrap();
    assert!(csv.starts_with("time_s,compensated_x_mm"));
    assert!(run.export("columns-csv", None).unwrap().lines().count() > 19_000);
    assert!(run.export("dxf", None).is_err());
}

#[wasm_bindgen_test]
fn form_data_is_plain() {
    let fields = wasm::fields().unwrap();
    assert!(number(&fields, "length") > 40.0);
    assert_eq!(text(&fields, "0.path"), "robot.preset");
    assert!(get(&fields, "0.min").is_undefined(), "absent, not null");
    let presets = wasm::presets().unwrap();
    assert_eq!(text(&presets, "robots.0.id"), "staubli-rx90");
    assert_eq!(number(&presets, "robots.0.modified_dh.2.a_mm"), 450.0);
    assert_eq!(number(&presets, "materials.0.ktc_n_mm2"), 1800.0);
    assert!(number(&wasm::thesis_recomputed().unwrap(), "length") >= 10.0);
    assert!(!wasm::version().is_empty());
}

/// A JavaScript value as it stands: numbers keep their bits.
fn plain(value: &JsValue) -> serde_json::Value {
    serde_wasm_bindgen::from_value(value.clone()).unwrap()
}

/// tests/measured.rs asserts the same digests natively.
#[wasm_bindgen_test]
fn measurements_give_the_same_bits() {
    let pass = wasm::learn_pass(PASS_JOB, PASS, None, None, None, None, None, None).unwrap();
    same("pass", &plain(&pass.summary().unwrap()));
    same("commands", &json!(pass.command_csv().unwrap()));
    same("cuts", &plain(&wasm::fit_cuts(CUTS_JOB, CUTS).unwrap()));
    let found = |found: Result<wasm::Identified, JsValue>| plain(&found.unwrap().summary().unwrap());
    same("stiffness", &found(wasm::identify_stiffness(ROBOT, LOADS, "coupled-j3")));
    same("response", &found(wasm::identify_response(RESPONSE, None)));
    let [a, b] = RUNS;
    let gear = found(wasm::identify_gear(&wasm::default_job(), a, Some(b.to_owned()), None));
    same("gear", &gear["joints"][0]);
    same("loads", &found(wasm::evidence_loads(ROBOT, LOADS)));
    same("encoders", &found(wasm::evidence_encoders(a, b)));
    let run = wasm::run(LOOP, None).unwrap();
    same("loop", &plain(&get(&run.summary().unwrap(), "online")));
}
