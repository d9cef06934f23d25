//! The surface that is left: what of it remains, against a dense sampling of the path; its excess against the
//! tip, by hand; the simulated part as a closed mesh of the right volume.
#![allow(clippy::disallowed_methods, reason = "independent values come from the standard library")]

use crate::common::in_stock::{AT, plate};
use crate::common::{between, column, in_stock, run};
use armill::Report;
use armill::path::{MovePace, Path, gcode};
use armill::report::PartKind;
use armill::stock::{Blank, Cutter, Earlier, Outline, Remaining, Solid};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use nalgebra::{Vector2, Vector3};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::f64::consts::PI;

const SLOT: &str = "G21 G90\nG0 X-20 Y0 Z5\nG1 Z-3 F300\nG1 X20 F600\nG0 Z5\n";
/// The report of a program in a stock.
fn job(text: &str, stock: Value, more: &[(&'static str, Value)]) -> Report {
    run(&in_stock::job(text, stock, more))
}

fn block(from: [f64; 3], to: [f64; 3]) -> Value {
    json!({"kind":"box","from_mm":from,"to_mm":to})
}

/// The actual tip before compensation in the workpiece frame [mm], sample by sample.
fn tips(report: &Report) -> Vec<Vector3<f64>> {
    report.before.actual.iter().map(|tip| tip * 1e3 - Vector3::from(AT)).collect()
}

/// The samples on a line of the program, with x [mm] and the column of the excess before [mm].
fn on_line(report: &Report, line: usize) -> Vec<(usize, f64, f64)> {
    let (lines, excess) = (column(report, "program_line"), column(report, "surface_before_mm"));
    let x = column(report, "desired_x_mm");
    (0..lines.len()).filter(|&k| lines[k] == line as f64).map(|k| (k, x[k] - AT[0], excess[k])).collect()
}

/// Asserts that the column is the larger one of some excesses [mm] on a straight line of the program, away from its
/// ends; which of them is found by the tip and its place there.
fn follows(report: &Report, line: usize, y: f64, z: f64, expected: impl Fn(f64, f64) -> Vec<f64>) {
    let tips = tips(report);
    let mut seen = 0;
    for (k, x, excess) in on_line(report, line) {
        if x.abs() > 10.0 {
            continue;
        }
        let all = expected(tips[k].y - y, tips[k].z - z);
        let largest = all.iter().copied().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        assert!((excess - largest).abs() < 1e-9, "line {line} at {x}: {excess}, of {all:?}");
        seen += 1;
    }
    assert!(seen > 50, "{seen}");
}

/// One wall alone: on the left of +x the material is towards +y, so a tool too far that way leaves too little;
/// on the right it is the other way round. Without walls, the floor is as high as the tip.
#[test]
fn excess_is_what_the_tip_is_off_by() {
    let left = job(SLOT, block([-50.0, 0.0, -20.0], [50.0, 50.0, 0.0]), &[]);
    follows(&left, 4, 0.0, -3.0, |y, z| vec![-y, z]);
    let right = job(SLOT, block([-50.0, -50.0, -20.0], [50.0, 0.0, 0.0]), &[]);
    follows(&right, 4, 0.0, -3.0, |y, z| vec![y, z]);
    let floor = job(SLOT, block([-50.0, -3.0, -20.0], [50.0, 3.0, 0.0]), &[]);
    follows(&floor, 4, 0.0, -3.0, |_, z| vec![z]);
    let through = job(SLOT, block([-50.0, 0.0, -3.0], [50.0, 50.0, 0.0]), &[]);
    follows(&through, 4, 0.0, -3.0, |y, _| vec![-y]);
}

/// A slot has two walls with equal errors, one too thick, one too thin.
#[test]
fn a_slot_has_two_walls_of_opposite_signs() {
    let report = job(SLOT, plate(), &[]);
    let tips = tips(&report);
    for (k, x, excess) in on_line(&report, 4).into_iter().filter(|(_, x, _)| x.abs() < 10.0) {
        let (y, z) = (tips[k].y, tips[k].z + 3.0);
        assert!((excess.abs() - y.abs().max(z.abs())).abs() < 1e-9, "{x}: {excess} {y} {z}");
    }
}

/// What a later pass takes is not left: of the first pass only the wall on the other side counts, and of the
/// second only the new one.
#[test]
fn only_the_finishing_pass_leaves_its_wall() {
    let text =
        "G21 G90\nG0 X-60 Y0 Z5\nG1 Z-3 F300\nG1 X60 F600\nG0 Z5\nX-60 Y1\nG1 Z-3 F300\nG1 X60 F600\nG0 Z5\n";
    let report = job(text, plate(), &[]);
    follows(&report, 4, 0.0, -3.0, |y, z| vec![y, z]);
    follows(&report, 8, 1.0, -3.0, |y, z| vec![-y, z]);
    // Deeper later: of the first level only what stands above the second's cut, its walls.
    let text =
        "G21 G90\nG0 X-60 Y0 Z5\nG1 Z-2 F300\nG1 X60 F600\nG0 Z5\nX-60\nG1 Z-4 F300\nG1 X60 F600\nG0 Z5\n";
    let report = job(text, block([-50.0, 0.0, -20.0], [50.0, 50.0, 0.0]), &[]);
    follows(&report, 4, 0.0, -2.0, |y, _| vec![-y]);
    follows(&report, 8, 0.0, -4.0, |y, z| vec![-y, z]);
    // The same pass again cuts air: it leaves nothing.
    let text = "G21 G90\nG0 X-60 Y0 Z5\nG1 Z-3 F300\nG1 X60 F600\nX-60\nG0 Z5\n";
    let report = job(text, plate(), &[]);
    assert!(on_line(&report, 5).iter().all(|(.., excess)| *excess == 0.0));
}

/// Around an island: its walls are left, and so are the pocket's.
#[test]
fn an_island_keeps_its_walls() {
    // The tool's axis runs 10 mm from the centre: the island is a square of 10 mm.
    let text = "G21 G90\nG0 X-10 Y-10 Z5\nG1 Z-3 F300\nG1 X10 F600\nY10\nX-10\nY-10\nG0 Z5\n";
    let report = job(text, plate(), &[]);
    let surface = report.summary().surface.unwrap();
    let tips = tips(&report);
    for (k, x, excess) in on_line(&report, 4).into_iter().filter(|(_, x, _)| x.abs() < 4.0) {
        let (y, z) = (tips[k].y + 10.0, tips[k].z + 3.0);
        assert!((excess.abs() - y.abs().max(z.abs())).abs() < 1e-9, "{x}: {excess} {y} {z}");
    }
    // Across the island afterwards: what its walls were is gone over the width of the tool.
    let cut =
        text.replace("G0 Z5\n", "").replace("G0 X-10 Y-10\n", "G0 X-10 Y-10 Z5\n") + "G1 Y0\nX10\nG0 Z5\n";
    let cut = job(&cut, plate(), &[]);
    let at = |report: &Report, line: usize, y: f64| {
        let lines = column(report, "program_line");
        let ys = column(report, "desired_y_mm");
        let k =
            (0..lines.len()).find(|&k| lines[k] == line as f64 && (ys[k] - AT[1] - y).abs() < 0.06).unwrap();
        column(report, "surface_before_mm")[k]
    };
    // On the way up at x = 10, the pocket's wall is right, the island's left; both are through the slot's width.
    assert!(at(&report, 5, 0.0) != 0.0 && surface.worst.len() == 5);
    assert!(at(&cut, 5, 0.0) != 0.0, "the pocket's wall is still there");
}

/// On a ball nose, the normals at kappa = 0, 22.5 and 45 deg lie within 3 mm of a radius of 5 mm.
#[test]
fn a_ball_nose_leaves_what_lies_across_the_feed() {
    let tool = json!({"diameter_mm":10,"flutes":2,"corner_radius_mm":"ball"});
    let report = job(SLOT, plate(), &[("tool", tool)]);
    follows(&report, 4, 0.0, -3.0, |y, z| {
        let each = [0.0, PI / 8.0, -PI / 8.0, PI / 4.0, -PI / 4.0];
        each.iter().map(|kappa| -(y * kappa.sin() - z * kappa.cos())).collect()
    });
    // On a slope of 30 deg the normals lie across it.
    let ramp = "G21 G90\nG0 X-60 Y0 Z5\nG1 X-60 Z-19 F600\nG1 X40 Z1 F600\nG0 Z5\n";
    let tool = json!({"diameter_mm":10,"flutes":2,"corner_radius_mm":"ball"});
    let report = job(ramp, plate(), &[("tool", tool)]);
    let tips = tips(&report);
    let slope = (20.0_f64 / 100.0).atan();
    for (k, x, excess) in on_line(&report, 4).into_iter().filter(|(_, x, _)| x.abs() < 10.0) {
        // Across the slope, by the distance from the line.
        let off = Vector2::new(tips[k].x, tips[k].z) - Vector2::new(-60.0, -19.0);
        let w = off.y * slope.cos() - off.x * slope.sin();
        let normals = [0.0_f64, PI / 8.0, PI / 4.0, PI * 3.0 / 8.0, PI / 2.0].iter();
        let all: Vec<f64> = normals
            .flat_map(|kappa| [1.0, -1.0].map(|side| -(side * tips[k].y * kappa.sin() - w * kappa.cos())))
            .collect();
        let near = all.iter().any(|each| (each - excess).abs() < 1e-9);
        assert!(near, "{x}: {excess} {all:?}");
    }
}

/// Down milling pushes the tool off the wall and leaves too much; up milling pulls it in.
#[test]
fn climb_leaves_too_much_and_conventional_too_little() {
    // The tool turns clockwise: with the wall on the right it cuts down.
    let pass = |side: f64, depth: f64| {
        let text = "G21 G90\nG0 X-60 Y0 Z5\nG1 Z-3 F300\nG1 X60 F600\nG0 Z5\n";
        let (low, high) = if side > 0.0 { (5.0 - depth, 50.0) } else { (-50.0, depth - 5.0) };
        let report = job(text, block([-50.0, low, -3.0], [50.0, high, 0.0]), &[]);
        on_line(&report, 4).into_iter().find(|(_, x, _)| x.abs() < 0.1).unwrap().2
    };
    for depth in [0.5, 4.0] {
        let excess = pass(-1.0, depth);
        assert!(excess > 1e-3, "{depth}: {excess}");
    }
    let excess = pass(1.0, 4.0);
    assert!(excess < -1e-3, "{excess}");
    // Where a thin chip is rubbed more than cut, the radial force outweighs the pull.
    let excess = pass(1.0, 0.5);
    assert!(excess > 1e-3, "{excess}");
}

/// Figures, columns and words say the same; without a stock there is none of them.
#[test]
fn figures_are_those_of_the_columns() {
    let text = "G21 G90\nG0 X-20 Y-20 Z5\nG1 Z-3 F300\nG1 X20 F600\nY20\nX-20\nY-20\nG0 Z5\n";
    let report = job(text, plate(), &[("compensation.max_passes", json!(1))]);
    let surface = report.summary().surface.unwrap();
    let most = |key: &str| column(&report, key).into_iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    assert_eq!(surface.worst_before_mm, Some(most("surface_before_mm")));
    assert_eq!(surface.worst_after_mm, Some(most("surface_after_mm")));
    let first = &surface.worst[0];
    assert_eq!(Some(first.before_mm.abs()), surface.worst_before_mm);
    assert_eq!(column(&report, "surface_before_mm")[first.sample].abs(), first.before_mm.abs());
    let lines: Vec<_> = surface.worst.iter().map(|spot| spot.line).collect();
    assert!(lines.iter().enumerate().all(|(k, line)| !lines[..k].contains(line)), "{lines:?}");
    let word = if first.before_mm > 0.0 { "mm too thick, " } else { "mm too thin, " };
    let begins = format!("Wall at line {}: ", first.line.unwrap());
    assert!(first.sentence.starts_with(&begins) && first.sentence.contains(word), "{}", first.sentence);
    assert!(first.sentence.ends_with("after compensation"), "{}", first.sentence);
    // A point of the wall is the tool's radius from its axis.
    let place = &report.plan.trajectory.position[first.sample];
    let offset = Vector3::from(first.place_mm) + Vector3::from(AT) - place * 1e3;
    assert!((offset.xy().norm() - 5.0).abs() < 1e-9 && (offset.z - first.height_mm).abs() < 1e-9);

    let none = job(text, json!({"kind":"none"}), &[("cutting.engagement", json!("slot"))]);
    assert!(none.summary().surface.is_none());
    assert!(none.series().iter().all(|series| !series.key.starts_with("surface")));
    assert!(none.simulated_part(PartKind::Nominal, None).is_err());
    assert!(report.part(PartKind::Nominal, Some(-1.0)).is_err());
    // Where nothing is cut, nothing is left.
    let air = job("G21 G90\nG0 X-20 Y0 Z5\nG1 X20 F600\n", plate(), &[]).summary().surface.unwrap();
    assert!(air.worst.is_empty() && air.worst_before_mm.is_none() && air.after_p95_mm.is_none());
}

/// In a straight slot the tip's error is across the path only, so the band of its surface is within that of the
/// tip; without spread it is the nominal rest.
#[test]
fn the_band_is_that_of_the_tip_across_the_walls() {
    let half = block([-50.0, 0.0, -20.0], [50.0, 50.0, 0.0]);
    let report = job(SLOT, half.clone(), &[]);
    let p95 = report.summary().surface.unwrap().after_p95_mm.unwrap();
    let tip = report.summary().expected_mm.p95;
    assert!(p95 < tip * 1.01 && p95 > 0.5 * tip, "{p95} {tip}");
    let sure = json!({"stiffness_percent":0.001,"cutting_percent":0.001,"frequency_percent":0.001});
    let passes = ("compensation.max_passes", json!(0));
    let surface = job(SLOT, half, &[("uncertainty", sure), passes]).summary().surface.unwrap();
    let (p95, worst) = (surface.after_p95_mm.unwrap(), surface.worst_after_mm.unwrap());
    assert!((p95 / worst - 1.0).abs() < 1e-3, "{p95} {worst}");
    // Not compensated, before and after are the same; with a softer plant, the surface has the same error as the tip.
    assert_eq!(surface.before_p95_mm, surface.after_p95_mm);
    let wide = report.summary().surface.unwrap();
    let ours = wide.before_p95_mm.unwrap() / wide.worst_before_mm.unwrap();
    let tip = report.band.before.p95 / report.before.statistics.max;
    assert!((ours / tip - 1.0).abs() < 0.15, "{ours} {tip}");
}

/// A point of a mesh by its bits.
type Corner = [u32; 3];

/// The triangles of a binary STL file.
fn triangles(stl: &[u8]) -> Vec<[Corner; 3]> {
    let word = |at: usize| u32::from_le_bytes(stl[at..at + 4].try_into().unwrap());
    assert_eq!(stl.len(), 84 + 50 * word(80) as usize);
    let corner = |at: usize| [0, 4, 8].map(|k| word(at + k));
    (0..word(80) as usize).map(|k| [12, 24, 36].map(|part| corner(84 + 50 * k + part))).collect()
}

/// Volume of a mesh [mm^3], if each edge is used once in each direction.
fn volume(stl: &[u8]) -> f64 {
    let mut edges = BTreeMap::<(Corner, Corner), i32>::new();
    let mut sum = 0.0;
    for corners in triangles(stl) {
        for k in 0..3 {
            *edges.entry((corners[k], corners[(k + 1) % 3])).or_default() += 1;
        }
        let [a, b, c] =
            corners.map(|corner| Vector3::from(corner.map(|bits| f64::from(f32::from_bits(bits)))));
        sum += a.dot(&b.cross(&c)) / 6.0;
    }
    for (&(from, to), &count) in &edges {
        assert!(count == 1 && edges.get(&(to, from)) == Some(&1), "an open edge");
    }
    sum
}

/// The mesh of the nominal part is closed, and has the blank's volume less what was cut.
#[test]
fn the_simulated_part_is_closed_and_has_its_volume() {
    let report = job(SLOT, plate(), &[]);
    let whole = 100.0 * 100.0 * 20.0;
    let cut = 3.0 * (10.0 * 40.0 + PI * 25.0);
    let cm3 = report.summary().cut.removed_cm3.unwrap() * 1e3;
    assert!((cm3 / cut - 1.0).abs() < 1e-3);
    for cell in [0.25, 0.5, 0.83] {
        let nominal = report.simulated_part(PartKind::Nominal, Some(cell * 1e-3)).unwrap();
        let removed = whole - volume(&nominal);
        // The slot's border is known to half a cell to either side.
        let around = 2.0 * 40.0 + PI * 10.0;
        assert!((removed - cm3).abs() < 0.5 * cell * around * 3.0, "{removed} {cm3}");
    }
    assert!(report.simulated_part(PartKind::Before, None).unwrap().len() < 30_000_000);
    // Through the part and over its edge: holes and a bay.
    let through =
        "G21 G90\nG0 X-60 Y0 Z5\nG1 Z-21 F300\nG1 X-20 F600\nG0 Z5\nX10\nG1 Z-21 F300\nX20\nG0 Z5\n";
    let report = job(through, plate(), &[]);
    let gone = 20.0 * (30.0 * 10.0 + PI * 12.5 + 10.0 * 10.0 + PI * 25.0);
    let removed = whole - volume(&report.simulated_part(PartKind::Nominal, Some(0.5e-3)).unwrap());
    assert!((removed / gone - 1.0).abs() < 0.12, "{removed} {gone}");
}

/// The floor of the actual part is where the tip was, and its walls are beside it.
#[test]
fn the_actual_part_lies_where_the_tip_was() {
    let report = job(SLOT, block([-15.0, -8.0, -6.0], [15.0, 8.0, 0.0]), &[]);
    let kinds = [PartKind::Nominal, PartKind::Before, PartKind::After];
    let [nominal, before, after] = kinds.map(|kind| report.part(kind, Some(0.05e-3)).unwrap());
    let tips = tips(&report);
    let k = on_line(&report, 4).into_iter().find(|(_, x, _)| x.abs() < 0.06).unwrap().0;
    let (columns, rows) = (before.columns, before.rows());
    let at = |row: usize| row * columns + columns / 2;
    let floor = |map: &armill::surface::part::PartMap| f64::from(map.heights[at(rows / 2)]) * 1e3;
    assert!((floor(&nominal) + 3.0).abs() < 1e-6 && (floor(&before) - tips[k].z).abs() < 1e-3);
    assert!((floor(&after) + 3.0).abs() < 1e-3);
    // The middle of the slot's width, by its first and last low height.
    let low: Vec<f64> =
        (0..rows).filter(|&row| before.heights[at(row)] < -1e-3).map(|row| row as f64).collect();
    let middle = (low[0] + low[low.len() - 1]) / 2.0 * 0.05 - 8.0;
    assert!((middle - tips[k].y).abs() < 0.05, "{middle} {}", tips[k].y);
    assert!(tips[k].y.abs() > 0.1);
}

/// The mesh of a part is a stock again. On its map of heights the same walls and floors are found, but for those
/// that a later pass takes.
#[test]
fn the_mesh_of_a_part_is_a_stock_for_the_next_program() {
    let uncut = job("G21 G90\nG0 X-20 Y0 Z5\nG1 X20 F600\n", plate(), &[]);
    let stl = STANDARD.encode(uncut.simulated_part(PartKind::After, Some(5e-3)).unwrap());
    let text =
        "G21 G90\nG0 X-60 Y0 Z5\nG1 Z-3 F300\nG1 X60 F600\nG0 Z5\nX-60 Y1\nG1 Z-3 F300\nG1 X60 F600\nG0 Z5\n";
    let report = job(text, json!({"kind":"stl","stl":stl}), &[]);
    assert!(report.summary().cut.stock_cell_mm.is_some());
    follows(&report, 4, 0.0, -3.0, |y, z| vec![y, z]);
    follows(&report, 8, 1.0, -3.0, |y, z| vec![-y, z]);
}

fn program(text: &str) -> Path {
    let options = gcode::Options { field: "text".into(), ..Default::default() };
    Path::of_program(&gcode::program(text, &options, |_| ()).unwrap()).unwrap()
}

/// How far a point [mm] is above the lowest profile that any place of a path has cleared over it [mm], by a dense
/// sampling; above 0 it is cleared.
fn above(path: &Path, cutter: &Cutter, point: &Vector3<f64>) -> f64 {
    let mut most = f64::NEG_INFINITY;
    let (radius, corner) = (cutter.radius * 1e3, cutter.corner * 1e3);
    for step in path.moves().iter().filter(|step| step.pace != MovePace::Rapid) {
        let length = step.segment.length();
        let count = (length / 5e-6).ceil();
        for k in 0..=count as usize {
            let tip = step.segment.point(length * k as f64 / count) * 1e3;
            let away = (tip - point).xy().norm();
            if away <= radius {
                let beyond = (away - (radius - corner)).max(0.0);
                most = most
                    .max(point.z - tip.z - (corner - (corner * corner - beyond * beyond).max(0.0).sqrt()));
            }
        }
    }
    most
}

/// Material at random points, against the tool at places a few micrometres apart: levels, arcs, ramps, helices and
/// plunges of flat, bull and ball nose; the same on a map of heights, where cells leave it open.
#[test]
fn material_remains_where_no_place_of_the_tool_clears_it() {
    let text = "G21 G90 F600\nG0 X-9 Y-6 Z0\nG1 Z-2\nX4\nG2 X4 Y4 I0 J5\nG1 X-6 Y5 Z-4\nG3 X-6 Y5 Z-5 I3 J0\n\
        G1 X-2 Y-2 Z-1\nG0 Z5\nX8 Y-8 Z1\nG1 Z-6\nG0 Z2\nX9 Y9\nG1 X9 Y2 Z-3\n";
    let path = program(text);
    let outline = Outline::rectangle(Vector2::new(-12e-3, -12e-3), Vector2::new(12e-3, 12e-3));
    let mut random = fastrand::Rng::with_seed(7);
    for corner in [0.0, 0.5e-3, 2e-3] {
        let cutter = Cutter { radius: 2e-3, corner, flutes: f64::INFINITY };
        let earlier =
            vec![Earlier { path: program("G21 G90 F600\nG0 X-12 Y10 Z-1\nG1 X0 Y10 Z-1\n"), cutter }];
        let blank = Blank { solid: Solid::prism(outline.clone(), -8e-3, 0.0), earlier: earlier.clone() };
        for on_map in [false, true] {
            let remaining = Remaining::of(&path, &blank, &cutter, on_map);
            let (mut material, mut air) = (0, 0);
            for _ in 0..400 {
                let point = Vector3::from_fn(|axis, _| match axis {
                    2 => between(&mut random, -8.5, 0.5),
                    _ => between(&mut random, -13.0, 13.0),
                });
                let most = above(&path, &cutter, &point).max(above(&earlier[0].path, &cutter, &point));
                // Near a border, across or in height, the sampling or the cells leave it open.
                let near = if on_map { 0.12 } else { 2e-4 };
                let around =
                    [Vector3::x(), -Vector3::x(), Vector3::y(), -Vector3::y(), Vector3::z(), -Vector3::z()];
                let inside =
                    |p: &Vector3<f64>| p.x.abs() < 12.0 && p.y.abs() < 12.0 && p.z < 0.0 && p.z > -8.0;
                let open = |p: Vector3<f64>| {
                    let there = above(&path, &cutter, &p).max(above(&earlier[0].path, &cutter, &p));
                    (there > 0.0) != (most > 0.0) || inside(&p) != inside(&point)
                };
                if around.iter().any(|offset| open(point + offset * near)) {
                    continue;
                }
                let expected = inside(&point) && most <= 0.0;
                assert_eq!(
                    remaining.is_material(&(point / 1e3)),
                    expected,
                    "{corner} {on_map} {point:?} {most}"
                );
                if expected { material += 1 } else { air += 1 }
            }
            assert!(material > 80 && air > 80, "{material} {air}");
        }
    }
}
