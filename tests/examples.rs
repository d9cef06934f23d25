//! The page's example programs: each reads as intended, computes, and gains from compensation.
#![allow(clippy::disallowed_methods, reason = "independent values come from the standard library")]

use crate::common::program::{example, folder};
use crate::common::{column, job_text, run};
use armill::Report;
use armill::deviation::{Source, Sources};
use serde::Deserialize;
use serde_json::json;
use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::path::Path;

/// An entry of `web/examples/index.json`, from which the page makes its menu.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    file: String,
    kind: String,
    title: String,
    note: String,
    stock: Option<serde_json::Value>,
    tool: Option<serde_json::Value>,
}

/// The expected content of a program, worked out by hand. Lengths in mm.
struct Known {
    file: &'static str,
    unit: &'static str,
    lines: usize,
    cutting: usize,
    rapid: usize,
    /// Corners of the bounding box of the tip's path.
    lowest: [f64; 3],
    highest: [f64; 3],
    /// Whether an arc reaches beyond the ends of the moves; the summary's box is then smaller.
    bulges: bool,
    multi_axis: bool,
    /// The reader's remarks.
    remarks: &'static [&'static str],
}

/// A program in mm with the tool upright and no remarks.
const PLAIN: Known = Known {
    file: "",
    unit: "mm",
    lines: 0,
    cutting: 0,
    rapid: 2,
    lowest: [0.0; 3],
    highest: [0.0; 3],
    bulges: false,
    multi_axis: false,
    remarks: &[],
};

const KNOWN: [Known; 9] = [
    // A level: 3 turns of helix, rings of 7, 9 and 9 moves, 2 links of 2, the lead-out.
    Known {
        file: "pocket.nc",
        lines: 90,
        cutting: 2 * (3 + 7 + 9 + 9 + 4 + 1),
        rapid: 5,
        lowest: [575.0, -14.0, 96.0],
        highest: [625.0, 14.0, 120.0],
        ..PLAIN
    },
    Known {
        file: "contour.nc",
        lines: 33,
        cutting: 16,
        lowest: [545.0, -35.0, 98.0],
        highest: [645.0, 35.0, 120.0],
        ..PLAIN
    },
    // Down, in, 7 rows, 6 steps between them, out.
    Known {
        file: "face.nc",
        lines: 29,
        cutting: 2 + 7 + 6 + 1,
        lowest: [535.0, -21.0, 100.0],
        highest: [665.0, 21.0, 120.0],
        ..PLAIN
    },
    // Down, half a circle out, the turns (7 blocks, then 1), the bottom, half a circle back.
    Known {
        file: "bore.nc",
        lines: 33,
        cutting: (2 + 7 + 2) + (2 + 1 + 2),
        rapid: 4,
        lowest: [590.0, -50.0, 94.0],
        highest: [610.0, 50.0, 120.0],
        bulges: true,
        ..PLAIN
    },
    // Down, 5 rows of 5 moves, 4 steps.
    Known {
        file: "ridge.nc",
        lines: 47,
        cutting: 1 + 5 * 5 + 4,
        lowest: [560.0, -10.0, 100.0],
        highest: [640.0, 10.0, 120.0],
        ..PLAIN
    },
    // The slot's ends lie 0.25 inch beyond the arcs' ends.
    Known {
        file: "inch.nc",
        unit: "inch",
        lines: 28,
        cutting: 1 + 4 + 4 + 2,
        lowest: [22.75 * 25.4, -0.25 * 25.4, 3.92 * 25.4],
        highest: [24.375 * 25.4, 0.25 * 25.4, 4.75 * 25.4],
        bulges: true,
        remarks: &["tool-length-missing"],
        ..PLAIN
    },
    // Spots: one feed each; down, away, five times over and away. Drill: 3 pecks each; 4 rapids
    // between a hole's pecks, 1 away, 5 times over, twice down to R (the first hole's G98 goes back
    // up). Finally up to 120.
    Known {
        file: "holes.nc",
        lines: 30,
        cutting: 6 + 6 * 3,
        rapid: (1 + 6 + 5) + (6 * 4 + 6 + 5 + 2) + 1,
        lowest: [570.0, -30.0, 91.0],
        highest: [630.0, 30.0, 120.0],
        remarks: &["tool-change"],
        ..PLAIN
    },
    // On the sphere of radius 220 with its top at (600, 0, 100): starts 25 above (-12, -54), ends
    // 25 above (12, 45), along the radius.
    Known {
        file: "dome.apt",
        lines: 116,
        cutting: 33 + 31 + 31,
        lowest: [600.0 - 12.0 * 245.0 / 220.0, -54.0 * 245.0 / 220.0, 92.931_9],
        highest: [600.0 + 12.0 * 245.0 / 220.0, 45.0 * 245.0 / 220.0, 119.447_4],
        multi_axis: true,
        ..PLAIN
    },
    // An ellipse of 80 by 56 in 120 sampled_moves, quarter circles of radius 12 in 12 sampled_moves
    // before and after.
    Known {
        file: "rim.csv",
        lines: 146,
        cutting: 120 + 2 * 12,
        rapid: 0,
        lowest: [560.0, -28.0, 98.0],
        highest: [652.0, 28.0, 98.0],
        multi_axis: true,
        remarks: &["header-unit"],
        ..PLAIN
    },
];

fn index() -> Vec<Entry> {
    let text = std::fs::read_to_string(folder().join("index.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

#[test]
fn the_index_names_the_files_that_are_there() {
    let index = index();
    let listed: BTreeSet<_> = index.iter().map(|entry| entry.file.clone()).collect();
    let mut present: BTreeSet<_> = std::fs::read_dir(folder())
        .unwrap()
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        // Measurements belong to the view Measure.
        .filter(|name| !["identify-", "learn-", "gear-"].iter().any(|start| name.starts_with(start)))
        .collect();
    assert!(present.remove("index.json"));
    assert_eq!(listed, present);
    assert_eq!(listed.len(), index.len(), "a file is listed twice");
    assert_eq!(listed, KNOWN.iter().map(|known| known.file.to_owned()).collect());
    for entry in &index {
        let kind = match Path::new(&entry.file).extension().unwrap().to_str().unwrap() {
            "nc" => "gcode",
            ending => ending,
        };
        assert_eq!(entry.kind, kind, "{}", entry.file);
        assert!(!entry.title.is_empty() && !entry.note.is_empty(), "{}", entry.file);
        assert!(!entry.note.contains('\n'), "{}", entry.file);
    }
}

#[test]
fn every_example_is_read_as_meant_and_gains_from_compensation() {
    for entry in index() {
        let known = KNOWN.iter().find(|known| known.file == entry.file).unwrap();
        let report = run(&example(&entry.file, &entry.kind));
        is_read_as_meant(known, &report);
        rapids_carry_no_force(known, &report);
        gains(known, &report);
    }
}

fn is_read_as_meant(known: &Known, report: &Report) {
    let Known { file, lowest, highest, .. } = known;
    let summary = report.summary();
    let program = summary.program.unwrap();
    assert_eq!(program.unit, known.unit, "{file}");
    assert_eq!(program.lines, known.lines, "{file}");
    assert_eq!((program.cutting_moves, program.rapid_moves), (known.cutting, known.rapid), "{file}");
    assert_eq!(program.multi_axis, known.multi_axis, "{file}");
    assert!((5.0..60.0).contains(&summary.duration_s), "{file}: {} s", summary.duration_s);
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        // The workpiece frame is the base frame here.
        let way = column(report, &format!("desired_{name}_mm"));
        let least = way.iter().copied().fold(f64::INFINITY, f64::min);
        let most = way.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        assert!((least - lowest[axis]).abs() < 1e-3, "{file}: {name} from {least}");
        assert!((most - highest[axis]).abs() < 1e-3, "{file}: {name} to {most}");
        let (from, to) = (program.lowest_mm[axis] - lowest[axis], highest[axis] - program.highest_mm[axis]);
        assert!(from > -1e-4 && to > -1e-4, "{file}: {name} within the path's");
        assert!(known.bulges || (from < 1e-4 && to < 1e-4), "{file}: {name} as the path's");
    }
    let remarks = &report.setup().program.as_ref().unwrap().program.remarks;
    assert!(
        remarks.iter().map(|remark| remark.code).eq(known.remarks.iter().copied()),
        "{file}: {remarks:?}"
    );
}

fn rapids_carry_no_force(known: &Known, report: &Report) {
    let pace = &report.plan.trajectory.timing;
    let still = (report.plan.shaper().duration() / report.plan.trajectory.sample_time).ceil() as usize + 1;
    let on_time = armill::deviation::Reference::along(&report.plan, Sources::only(Source::Deflection)).force;
    let mut rapid_for = 0;
    for (k, engaged) in pace.engaged.iter().enumerate() {
        let rapid = *engaged == 0.0;
        // Nor does the tool cut at rest, or where its cut has only just begun.
        let begins = pace.speed[k] == 0.0 || (k > 0 && pace.engaged[k - 1] == 0.0);
        assert!(on_time[k].norm() == 0.0 || !rapid, "{}: sample {k}", known.file);
        assert!(on_time[k].norm() > 0.0 || rapid || begins, "{}: sample {k}", known.file);
        // A shaped tool arrives later, by the shaper's length at most.
        rapid_for = if rapid { rapid_for + 1 } else { 0 };
        assert!(rapid_for <= still || report.force[k].norm() == 0.0, "{}: sample {k}, shaped", known.file);
    }
    assert_eq!(pace.engaged.contains(&0.0), known.rapid > 0, "{}", known.file);
}

fn gains(known: &Known, report: &Report) {
    let Known { file, .. } = known;
    let summary = report.summary();
    let (before, after) = (summary.before_mm.both.max, summary.after_mm.max);
    assert!(after < before / 10.0, "{file}: {before} mm before, {after} mm after");
    // Where a cut begins, the force sets in faster than the slow shaper of the default job lets the
    // command follow.
    assert!(after <= 0.1, "{file}: {after} mm");
    if known.multi_axis {
        let (before, after) = (summary.before_axis_deg, summary.after_axis_deg);
        assert!(after.max < before.max / 5.0, "{file}: {} deg before, {} deg after", before.max, after.max);
        assert!(after.mean < before.mean / 20.0, "{file}: {} deg, {} deg", before.mean, after.mean);
    }
}

/// Volumes by hand: the pocket less its rounded corners; the layer; two rings between the bore and the
/// hole before it; of all, the tool is seldom in the air and never deeper than its program goes.
#[test]
fn the_stock_of_an_example_fits_it() {
    let hole = 8.0 * (5.5 / (PI / 16.0).cos()).powi(2) * (PI / 8.0).sin();
    let volumes = [
        ("pocket.nc", (60.0 * 38.0 - (4.0 - PI) * 121.0) * 4.0),
        ("face.nc", 100.0 * 50.0 * 2.0),
        ("bore.nc", 2.0 * 6.0 * (PI * 225.0 - hole)),
    ];
    let mut fitted = 0;
    for entry in index() {
        let Some((stock, tool)) = entry.stock.clone().zip(entry.tool.clone()) else { continue };
        let cut =
            run(&[("path", program(&entry)), ("stock", stock), ("tool", tool), ("shaper", json!("none"))])
                .summary()
                .cut;
        let (air, removed) = (cut.air_share.unwrap(), cut.removed_cm3.unwrap());
        assert!(air > 0.0 && air < 0.25, "{}: {air}", entry.file);
        assert!(cut.axial_depth_mm <= 5.0 + 1e-9, "{}: {}", entry.file, cut.axial_depth_mm);
        if let Some((_, expected)) = volumes.iter().find(|(file, _)| *file == entry.file) {
            let share = removed * 1e3 / expected;
            assert!((share - 1.0).abs() < 3e-3, "{}: {removed} cm3, by hand {expected} mm3", entry.file);
        }
        fitted += 1;
    }
    assert_eq!(fitted, 5);
}

/// What a program gets that knows no stock: its extents, their top where none of it is below zero.
#[test]
fn a_stock_is_proposed_for_what_an_upright_tool_cuts() {
    let proposed = |path: serde_json::Value| {
        let job = armill::Job::from_json(&job_text(&[("path", path)])).unwrap();
        armill::setup::proposed_stock(&job).map(|stock| json!(stock))
    };
    let gcode = |text: &str| proposed(json!({"kind":"gcode","text":text}));
    let below = "G21 G90\nG0 X600 Y0 Z20\nG1 Z-3 F600\nX640\nG0 Z20\nM30";
    assert_eq!(gcode(below).unwrap(), json!({"kind":"extents"}));
    let above = below.replace("Z-3", "Z95").replace("Z20", "Z98.1");
    assert_eq!(gcode(&above).unwrap(), json!({"kind":"extents","top_mm":98.1}), "it is fed down from there");
    let level = json!({"kind":"csv","text":"x,y,z\n600,0,100\n640,0,100"});
    assert_eq!(proposed(level).unwrap(), json!({"kind":"extents","top_mm":110.0}), "by the axial depth");
    for entry in index() {
        let stock = proposed(program(&entry)).unwrap();
        assert_eq!(stock.is_null(), ["apt", "csv"].contains(&entry.kind.as_str()), "{}", entry.file);
    }
    assert_eq!(gcode("G21 G90\nG0 X600 Y0 Z20\nX640").unwrap(), json!(null), "nothing cuts");
    assert_eq!(gcode("G21 G90\nG41 X600").unwrap_err().code(), "text");
}

fn program(entry: &Entry) -> serde_json::Value {
    json!({"kind": entry.kind, "text": std::fs::read_to_string(folder().join(&entry.file)).unwrap()})
}
