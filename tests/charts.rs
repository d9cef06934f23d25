//! What charts of the run can be drawn over, and by which scale.

use crate::common::run;
use armill::Report;
use armill::chart::{CATALOG, Chart, ChartOptions, Over, Scaling, Units, chart, charts_of, data};
use serde_json::json;

/// Two lines of cutting with a full stop between them and a wait of a quarter of a second.
fn program() -> Report {
    let text = "G21 G90\nG0 X600 Y-20 Z100\nG1 Y20 F3000\nG4 P0.25\n\nG1 X640\nM30";
    run(&[("path", json!({ "kind": "gcode", "text": text }))])
}

fn column(report: &Report, key: &str) -> Vec<f64> {
    report.columns().into_iter().find(|column| column.key == key).unwrap().values
}

fn drawn(report: &Report, name: &str, scaling: Option<Scaling>, over: Over) -> Chart {
    chart(report, name, &ChartOptions { scaling, over, ..ChartOptions::sized(700.0, 320.0) }).unwrap()
}

#[test]
fn the_first_axis_is_time_length_or_line() {
    let report = program();
    let along = |over| data(&report, "before-after", Units::default(), over).unwrap();
    assert_eq!(along(Over::Time)[0].values, column(&report, "time_s"));
    assert_eq!(along(Over::Length)[0].values, column(&report, "arc_length_mm"));
    let lines = &along(Over::Line)[0];
    assert_eq!((lines.key.as_str(), along(Over::Length)[0].key.as_str()), ("program_line", "path_length_mm"));
    // The whole part is the column's line, and within a line the decimals only grow.
    let whole = column(&report, "program_line");
    for (k, (at, line)) in lines.values.iter().zip(&whole).enumerate() {
        assert_eq!(at.floor(), *line, "sample {k}");
        assert!(k == 0 || lines.values[k - 1] < *at, "sample {k}");
    }
    // The other columns do not depend on it, nor does a path in space.
    assert_eq!(along(Over::Time)[1..], along(Over::Line)[1..]);
    let chart = drawn(&report, "force", None, Over::Line);
    assert_eq!((chart.x.label.as_str(), chart.x.full.0), ("Program line", 3.0));
    assert!(chart.svg.contains(">4<") && !chart.svg.contains(">4.5<"), "whole numbers only");
}

#[test]
fn a_stop_is_a_vertical_line_over_length() {
    let report = program();
    let length = column(&report, "arc_length_mm");
    let standing = length.windows(2).filter(|pair| pair[0] == pair[1]).count();
    assert!(standing > 200, "0.25 s of 1 ms");
    let chart = drawn(&report, "coordinates", None, Over::Length);
    assert_eq!(chart.x.full, (0.0, *length.last().unwrap()));
    assert!(!chart.svg.contains("NaN"));
}

#[test]
fn only_axes_that_a_chart_has_can_be_asked_for() {
    let circle = run(&[]);
    let entry = |report: &Report, name: &str| charts_of(report).into_iter().find(|e| e.name == name).unwrap();
    assert_eq!(entry(&circle, "force").over, [Over::Time, Over::Length]);
    assert_eq!(entry(&program(), "force").over, [Over::Time, Over::Length, Over::Line]);
    assert!(entry(&circle, "path").over.is_empty() && entry(&circle, "revolution").over.is_empty());
    let refused = |name: &str, over| {
        chart(&circle, name, &ChartOptions { over, ..ChartOptions::sized(700.0, 320.0) })
            .unwrap_err()
            .to_string()
    };
    let message = refused("force", Over::Line);
    assert!(
        message.contains("over")
            && message.contains("\"line\"")
            && message.contains("\"time\" or \"length\"")
    );
    assert!(refused("convergence", Over::Length).contains("\"time\""));
}

#[test]
fn errors_before_and_after_are_read_by_decades() {
    let report = run(&[]);
    let peak = |key: &str| column(&report, key).into_iter().fold(0.0, f64::max);
    let tenth = peak("contour_error_mm") / 10.0;
    // What is to be expected can be compared with what was; what the numbers alone leave cannot.
    assert!(peak("after_p95_mm") > tenth && peak("after_contour_error_mm") < tenth);
    assert!(!drawn(&report, "before-after", Some(Scaling::Auto), Over::Time).y.log);
    let auto = drawn(&report, "after-shaping", Some(Scaling::Auto), Over::Time);
    assert!(auto.y.log && auto.svg == drawn(&report, "after-shaping", Some(Scaling::Log), Over::Time).svg);
    assert_eq!(auto.y.full.0, 1e-4, "the least that is read");
    assert!(auto.svg.contains(">0.01</text>") && auto.svg.contains("class=\"band\""));
    assert!(!drawn(&report, "after-shaping", None, Over::Time).y.log, "as it always was");
    // What may be negative has no decades.
    assert!(!drawn(&report, "force", Some(Scaling::Auto), Over::Time).y.log);
    for entry in CATALOG.iter().filter(|entry| ["force", "path", "joints"].contains(&entry.name)) {
        let options = ChartOptions { scaling: Some(Scaling::Log), ..ChartOptions::sized(700.0, 320.0) };
        let error = chart(&report, entry.name, &options).unwrap_err().to_string();
        assert!(error.contains("scale") && error.contains("\"log\"") && error.contains("linear"), "{error}");
    }
}
