//! The deviation all over the part, for pictures: against the tips of a slot, by hand; the mesh closed but for its
//! bottom and of the right volume; the section against the slot's own.

use crate::common::in_stock::AT;
use crate::common::{column, in_stock, run};
use armill::Report;
use armill::surface::deviation_map::{DeviationMap, Shift};
use armill::surface::mesh::PartMesh;
use nalgebra::Vector3;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::f64::consts::PI;

const SLOT: &str = "G21 G90\nG0 X-20 Y0 Z5\nG1 Z-3 F300\nG1 X20 F600\nG0 Z5\n";
const HEIGHTS: usize = 30_000;

/// A slot of 10 mm, cut 3 mm deep into a plate of 100 mm by a soft arm.
fn slot(more: &[(&'static str, Value)]) -> Report {
    run(&in_stock::job(SLOT, in_stock::plate(), more))
}

/// What moves the tip at each sample of the slot's own line before compensation [mm], with the tip's x.
fn moved(report: &Report) -> Vec<(f64, Vector3<f64>)> {
    let lines = column(report, "program_line");
    let place = |k: usize| report.before.actual[k] * 1e3 - Vector3::from(AT);
    let along: Vec<usize> = (0..lines.len()).filter(|&k| lines[k] == 4.0).collect();
    let desired = column(report, "desired_x_mm");
    along
        .into_iter()
        .map(|k| (desired[k] - AT[0], place(k) - Vector3::new(desired[k] - AT[0], 0.0, -3.0)))
        .collect()
}

/// The places of a map [mm] with their deviation before [mm].
fn places(map: &DeviationMap) -> Vec<(Vector3<f64>, Shift)> {
    let part = &map.nominal;
    let place = |k: usize| {
        let (column, row) = (k % part.columns, k / part.columns);
        let [x, y] = [(column, part.origin.x), (row, part.origin.y)].map(|(n, at)| at + n as f64 * part.cell);
        (Vector3::new(x, y, f64::from(part.heights[k])) * 1e3, map.before[k].map(|shift| shift * 1e3))
    };
    (0..part.heights.len()).map(place).collect()
}

/// Both walls of a slot stand where the tool has been: moved as far as the tip, one too thick by as much as the
/// other is too thin. The floor is as deep as the lowest tip that passed.
#[test]
fn walls_and_floor_are_moved_as_the_tip_is() {
    let report = slot(&[]);
    let map = report.deviation_map(HEIGHTS).unwrap();
    let (tips, cell) = (moved(&report), map.nominal.cell * 1e3);
    let near =
        |x: f64, reach: f64| tips.iter().filter(move |(at, _)| (at - x).abs() < reach).map(|(_, tip)| *tip);
    let (mut walls, mut floors, mut raw) = (0, 0, 0);
    for (place, [_, across, up, excess]) in places(&map) {
        if place.x.abs() > 10.0 {
            continue;
        }
        let beside = (place.y.abs() - 5.0).abs();
        if beside < cell / 2.0 {
            let [low, high] =
                [f64::min, f64::max].map(|pick| near(place.x, 2.0).map(|tip| tip.y).reduce(pick).unwrap());
            let across = f64::from(across);
            assert!(low - 1e-4 <= across && across <= high + 1e-4, "{place}: {across} of {low} to {high}");
            assert!((f64::from(excess) + across * place.y.signum()).abs() < 1e-6, "{place}: {excess}");
            walls += 1;
        } else if place.y.abs() < 4.0 {
            let lowest = near(place.x, 5.0 + cell).map(|tip| tip.z).reduce(f64::min).unwrap();
            let highest = near(place.x, 2.0).map(|tip| tip.z).reduce(f64::max).unwrap();
            let up = f64::from(up);
            assert!(lowest - 1e-3 <= up && up <= highest + 1e-3, "{place}: {up} of {lowest} to {highest}");
            floors += 1;
        } else if place.y.abs() > 5.0 + 3.0 * cell {
            assert_eq!(up, 0.0, "{place}: no tool has been there");
            raw += 1;
        }
    }
    assert!(walls > 50 && floors > 300 && raw > 1000, "{walls} {floors} {raw}");
    // The largest is that of the list in words.
    let surface = report.summary().surface.unwrap();
    let worst = surface.worst_before_mm.unwrap().max(surface.worst_after_mm.unwrap());
    assert!((map.largest * 1e3 - worst).abs() < 1e-9);
    // The border of the blank stays.
    let (part, before) = (&map.nominal, &map.before);
    assert!((0..part.columns).all(|k| before[k] == [0.0; 4]));
}

/// A soft arm moves a wall by several cells: no height on the way is taken for a deviation of the floor.
#[test]
fn no_wall_is_taken_for_a_deviation_of_the_floor() {
    let report = slot(&[]);
    let map = report.deviation_map(HEIGHTS).unwrap();
    let limit = 2.0 * map.largest as f32;
    for (place, [x, y, up, _]) in places(&map) {
        let size = [x, y, up].map(f32::abs).into_iter().fold(0.0, f32::max);
        assert!(size <= limit * 1e3, "{place}: {size} of {limit}");
    }
}

/// Edges are shared by two triangles in opposite directions, but for the rim of the bottom; the volume over the bottom
/// is the blank's less what was cut, far closer than a cell, for walls stand where they are.
#[test]
fn the_mesh_is_closed_but_for_its_bottom_and_has_its_volume() {
    let report = slot(&[]);
    let map = report.deviation_map(HEIGHTS).unwrap();
    let mesh = PartMesh::of(&map);
    assert_eq!((mesh.before.len(), mesh.after.len()), (mesh.places.len(), mesh.places.len()));
    assert!(mesh.triangles.len() < 2 * 31_000);
    let mut edges = BTreeMap::<(u32, u32), i32>::new();
    let mut volume = 0.0;
    let place = |k: u32| {
        let place = mesh.places[k as usize].map(f64::from);
        Vector3::from(place) * 1e3 - Vector3::new(0.0, 0.0, -20.0)
    };
    for corners in &mesh.triangles {
        for k in 0..3 {
            *edges.entry((corners[k], corners[(k + 1) % 3])).or_default() += 1;
        }
        let [a, b, c] = corners.map(place);
        volume += a.dot(&b.cross(&c)) / 6.0;
    }
    for (&(from, to), &count) in &edges {
        let closed = edges.get(&(to, from)) == Some(&1);
        let rim = place(from).z < 1e-3 && place(to).z < 1e-3;
        assert!(count == 1 && (closed || rim), "an open edge at {}", place(from));
    }
    let cut = 3.0 * (10.0 * 40.0 + PI * 25.0);
    assert!(((100.0 * 100.0 * 20.0 - volume) / cut - 1.0).abs() < 0.02, "{volume}");
}

/// Across the feed a slot is as wide as the tool and as deep as it goes; its walls and floor are moved as the map says.
#[test]
fn a_section_is_that_of_the_slot() {
    let report = slot(&[]);
    let map = report.deviation_map(HEIGHTS).unwrap();
    let lines = column(&report, "program_line");
    let x = column(&report, "desired_x_mm");
    let sample = (0..x.len()).find(|&k| lines[k] == 4.0 && x[k] - AT[0] > 0.0).unwrap();
    let section = report.part_section(&map, sample);
    assert!(section.nominal[0][0] > 0.0, "it begins on the left");
    for [across, height] in &section.nominal {
        let depth = if across.abs() < 4.9e-3 { -3e-3 } else { 0.0 };
        if (across.abs() - 5e-3).abs() > 1e-4 {
            assert!((height - depth).abs() < 1e-7, "{across}: {height}");
        }
    }
    let tip = report.before.actual[sample] - Vector3::from(AT) * 1e-3;
    let at = |across: f64| section.nominal.iter().position(|[place, _]| *place <= across).unwrap();
    for side in [5e-3, -5e-3] {
        // The feed is +x, so its left is +y.
        assert!(
            (section.before[at(side)][0] / tip.y - 1.0).abs() < 0.1,
            "{:?} {tip}",
            section.before[at(side)]
        );
    }
    assert!((section.before[at(0.0)][1] - (tip.z + 3e-3)).abs() < 0.2 * (tip.z + 3e-3).abs() + 1e-6);
    let widest = section.tool.iter().map(|[across, _]| across.abs()).fold(0.0, f64::max);
    assert!((widest - 5e-3).abs() < 1e-12 && (section.bottom + 20e-3).abs() < 1e-12);
    assert!(section.tool.iter().all(|[_, height]| *height >= -3e-3 - 1e-12));
    // Past the end it is the last one.
    assert_eq!(report.part_section(&map, usize::MAX), report.part_section(&map, report.samples() - 1));
}

#[test]
fn without_a_stock_there_is_no_picture() {
    let none = slot(&[("stock", json!({"kind":"none"})), ("cutting.engagement", json!("slot"))]);
    assert!(none.deviation_map(HEIGHTS).is_err());
    assert!(slot(&[]).deviation_map(3).unwrap_err().to_string().contains("most"));
}
