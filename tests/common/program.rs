//! What the tests of exports share: jobs, and a reader of our own G-code that knows nothing of its writer.

use armill::Report;
use armill::export::{Export, Options, export};
use nalgebra::Vector3;
use serde_json::{Value, json};

/// Jobs of a size that many tests can run: name and changes of the default job.
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
    export(report, id, &Options::default()).unwrap()
}

/// Commanded tips in the workpiece frame [m].
pub(crate) fn commanded(report: &Report) -> Vec<Vector3<f64>> {
    let back = report.setup.workpiece.inverse();
    report.commanded().iter().map(|p| back.point(p)).collect()
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

/// Points of our own G-code [m], with line, rapid and feed [m/s]: absolute, modal, comments out.
pub(crate) fn read_gcode(text: &str) -> Vec<(usize, bool, f64, Vector3<f64>)> {
    let (mut at, mut rapid, mut feed, mut size) = (Vector3::zeros(), false, 0.0, f64::NAN);
    let mut points = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let mut code = line.to_owned();
        while let (Some(open), Some(close)) = (code.find('('), code.find(')')) {
            code.replace_range(open..=close, "");
        }
        let mut moved = false;
        for word in code.split_whitespace() {
            let value = || word[1..].parse::<f64>().unwrap();
            match word {
                "G20" => size = 25.4e-3,
                "G21" => size = 1e-3,
                "G0" => rapid = true,
                "G1" => rapid = false,
                "G2" | "G3" | "G91" => panic!("{word} in {line}"),
                _ => match word.as_bytes()[0] {
                    axis @ b'X'..=b'Z' => (at[usize::from(axis - b'X')], moved) = (value() * size, true),
                    b'F' => feed = value() * size / 60.0,
                    _ => {}
                },
            }
        }
        if moved {
            points.push((index + 1, rapid, feed, at));
        }
    }
    points
}
