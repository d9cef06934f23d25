//! Shared by the export tests: jobs, programs, and readers for the output.

use armill::Report;
use armill::export::{Export, ExportOptions};
use armill::path::unit::{FeedUnit, LengthUnit};
use armill::path::{Program, Segment, apt, csv, gcode};
use armill::verification::export;
use nalgebra::Vector3;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Jobs small enough for many tests: name and changes to the default job.
pub(crate) fn small_jobs() -> [(&'static str, Vec<(&'static str, Value)>); 3] {
    let frame = json!({"xyz_mm":[550,40,150],"rpy_deg":[5,-10,30]});
    [
        (
            "arc",
            vec![
                ("workpiece_frame", frame.clone()),
                (
                    "path",
                    json!({"kind":"arc","center_mm":[0,0,0],"radius_mm":80,"normal":[0,0,1],"start_deg":30,"sweep_deg":200}),
                ),
            ],
        ),
        (
            "rounded rectangle",
            vec![
                ("workpiece_frame", frame.clone()),
                (
                    "path",
                    json!({"kind":"rectangle","center_mm":[0,0,0],"width_mm":120,"height_mm":80,"corner_radius_mm":15}),
                ),
            ],
        ),
        (
            "rectangle",
            vec![
                ("workpiece_frame", frame),
                ("path", json!({"kind":"rectangle","center_mm":[0,0,0],"width_mm":120,"height_mm":80})),
            ],
        ),
    ]
}

pub(crate) fn written(report: &Report, id: &str) -> Export {
    export(report, id, &ExportOptions::default()).unwrap()
}

/// Tips in the workpiece frame [m] that a file commands.
pub(crate) fn commanded(report: &Report, export: &Export) -> Vec<Vector3<f64>> {
    let back = report.setup().workpiece.inverse();
    export.commanded_path.positions(report).iter().map(|p| back.point(p)).collect()
}

/// Distance [m] of a point from a chain of straight moves.
pub(crate) fn distance(p: &Vector3<f64>, chain: &[Vector3<f64>]) -> f64 {
    let to = |pair: &[Vector3<f64>]| {
        let along = pair[1] - pair[0];
        let length = along.norm_squared();
        let t = if length > 0.0 { ((p - pair[0]).dot(&along) / length).clamp(0.0, 1.0) } else { 0.0 };
        (p - pair[0] - along * t).norm()
    };
    chain.windows(2).map(to).fold(f64::INFINITY, f64::min)
}

pub(crate) fn largest_distance(points: &[Vector3<f64>], chain: &[Vector3<f64>]) -> f64 {
    points.iter().map(|p| distance(p, chain)).fold(0.0, f64::max)
}

/// The program that the crate's own reader makes of an export.
pub(crate) fn read_back(report: &Report, id: &str, options: &ExportOptions) -> (Export, Program) {
    let export = export(report, id, options).unwrap();
    let program = match id {
        "gcode" => gcode::program(&export.text, &gcode::Options::default(), |_| {}),
        "apt" => {
            apt::program(&export.text, &apt::Options { field: "path.text", unit: LengthUnit::Mm }, |_| {})
        }
        "path-csv" => {
            let options =
                csv::Options { field: "path.text", unit: LengthUnit::Mm, feed_unit: FeedUnit::MmPerS };
            csv::program(&export.text, &options, |_| {})
        }
        _ => panic!("{id} is not read"),
    };
    let program = program.unwrap_or_else(|error| panic!("{id}: {error}\n{}", export.text));
    (export, program)
}

/// Points along the moves of a program [m]: the start, then the ends. Arcs get enough points
/// between their ends to keep the chords within 0.1 um.
pub(crate) fn chain(program: &Program) -> Vec<Vector3<f64>> {
    let along = |segment: &Segment| {
        let sampled_moves = match segment {
            Segment::Line { .. } => 1,
            Segment::Arc { radius, sweep, .. } => (sweep * (radius / 8e-7).sqrt()).ceil() as usize,
        };
        let length = segment.length();
        (1..=sampled_moves)
            .map(|i| segment.point(length * i as f64 / sampled_moves as f64))
            .collect::<Vec<_>>()
    };
    let start = program.moves.first().map(|step| step.segment.point(0.0));
    start.into_iter().chain(program.moves.iter().flat_map(|step| along(&step.segment))).collect()
}

/// File and kind of the page's example programs.
pub(crate) fn examples() -> Vec<(String, String)> {
    let text = std::fs::read_to_string(folder().join("index.json")).unwrap();
    let index: Vec<Value> = serde_json::from_str(&text).unwrap();
    let of = |entry: &Value, key: &str| entry[key].as_str().unwrap().to_owned();
    index.iter().map(|entry| (of(entry, "file"), of(entry, "kind"))).collect()
}

/// An example in the default job, with a cut and a mode typical of a milling robot.
pub(crate) fn example(file: &str, kind: &str) -> Vec<(&'static str, Value)> {
    let text = std::fs::read_to_string(folder().join(file)).unwrap();
    vec![
        ("path", json!({"kind": kind, "text": text})),
        ("cutting.axial_depth_mm", json!(2)),
        ("shaper", json!({"kind": "zvd", "frequency_hz": 10, "damping": 0.03})),
    ]
}

/// What a program decides of the cut, as the page takes it over: its first spindle speed, and the chip
/// that follows from it.
pub(crate) fn own_cutting(text: &str) -> Vec<(&'static str, Value)> {
    let words = text.split(['\n', ' ']).filter_map(|word| word.strip_prefix('S'));
    let speed: Option<f64> = words.filter_map(|digits| digits.trim().parse().ok()).next();
    speed.map_or(Vec::new(), |speed| {
        vec![("cutting.spindle_rpm", json!(speed)), ("cutting.feed_per_tooth_mm", json!("from_feed"))]
    })
}

/// An example as the page opens it: with its stock, tool and spindle speed, without the default job's
/// shaper.
pub(crate) fn opened_example(file: &str) -> Vec<(&'static str, Value)> {
    let text = std::fs::read_to_string(folder().join("index.json")).unwrap();
    let index: Vec<Value> = serde_json::from_str(&text).unwrap();
    let entry = index.iter().find(|entry| entry["file"] == file).unwrap();
    let program = std::fs::read_to_string(folder().join(file)).unwrap();
    let mut changes = vec![
        ("path", json!({"kind": entry["kind"], "text": &program})),
        ("shaper", json!("none")),
        ("stock", entry["stock"].clone()),
    ];
    for (key, path) in [("diameter_mm", "tool.diameter_mm"), ("corner_radius_mm", "tool.corner_radius_mm")] {
        changes.push((path, entry["tool"][key].clone()));
    }
    changes.extend(own_cutting(&program));
    changes
}

/// The folder of the example programs.
pub(crate) fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("web/examples")
}
