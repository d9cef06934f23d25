//! Forces measured with a dynamometer: slots by a bull nose and a ball nose, 16 mm, two flutes,
//! helix 25 deg, right-hand, 800 rpm, 0.1 mm per tooth.
//!
//! Means and coefficients as published at github.com/leekunhwee/ForceCalculation (3fda341f3e19); see
//! `armill::evidence::slots`.

use armill::Progress;
use armill::cutting::{Cut, Hand};
use armill::evidence::slots::{BALL, BULL_NOSE, Slot, cut, measured};
use armill::path::{Path, gcode};
use armill::stock::{Cutter, Outline, Solid, contacts};
use nalgebra::Vector2;

#[test]
fn measured_slots_of_bull_and_ball_nose() {
    for (corner, rows) in [(3.0, BULL_NOSE), (8.0, BALL)] {
        for slot in rows {
            let [depth, .., p99] = slot;
            let cut = cut(corner, depth);
            let measured = measured(&slot);
            let ours = cut.mean_force().at(1e-4);
            let miss = (ours - measured).norm() / measured.norm();
            // At 1 mm the edge at the tip rubs, which no edge coefficient covers: 30 % is known.
            let allowed = if depth < 2.0 { 0.35 } else { 0.20 };
            assert!(miss < allowed, "corner {corner}, {depth} mm: {ours} against {measured}, {miss}");
            let peak = cut.peak_force(1e-4);
            assert!((peak - p99).abs() < 0.10 * p99, "corner {corner}, {depth} mm: {peak} N against {p99} N");
            // The other sign misses by 26 to 50 %.
            let turned = Cut { hand: Hand::Left, ..cut }.mean_force().at(1e-4);
            assert!((turned - measured).norm() > 0.25 * measured.norm(), "the sign shows");
        }
    }
}

/// The same slots, cut into a block: what the tool meets there gives the measured forces as well.
#[test]
fn measured_forces_come_out_of_a_slot_in_a_stock() {
    let corner_of = |x: f64, y: f64| Vector2::new(x, y) / 1e3;
    let outline = Outline::rectangle(corner_of(-50.0, -50.0), corner_of(50.0, 50.0));
    let block = Solid::prism(outline, -0.02, 0.0);
    for (corner, rows) in [(3.0, BULL_NOSE), (8.0, BALL)] {
        for slot in rows {
            let [depth, ..] = slot;
            let text = format!("G21 G90\nG0 X-70 Y0 Z5\nG1 Z-{depth} F60\nG1 X40 F160\nG0 Z5\n");
            let options = gcode::Options { field: "text".into(), ..Default::default() };
            let path = Path::of_program(&gcode::program(&text, &options, |_| ()).unwrap()).unwrap();
            let cutter = Cutter { radius: 8e-3, corner: corner * 1e-3, flutes: f64::INFINITY };
            let met = contacts(&path, (&block, &[]), &cutter, &mut Progress::none());
            let index = path.moves().iter().position(|step| step.segment.length() > 0.1).unwrap();
            let (station, ..) = met.around(index, 0.07).unwrap();
            let ours = cut(corner, depth).mean_force_in(&met.at(station)).at(1e-4);
            let measured = measured(&slot);
            let miss = (ours - measured).norm() / measured.norm();
            let allowed = if depth < 2.0 { 0.35 } else { 0.20 };
            assert!(miss < allowed, "corner {corner}, {depth} mm: {ours} against {measured}, {miss}");
        }
    }
}

#[test]
fn the_side_edge_pulls_down_and_the_corner_pushes_up() {
    // Above the corner the measured axial force falls by 18 N for each mm of side edge.
    let slope = |rows: &[Slot]| (rows[4][3] - rows[2][3]) / 2.0;
    let axial = |depth: f64| cut(3.0, depth).mean_force().at(1e-4).z;
    let (ours, measured) = ((axial(5.0) - axial(3.0)) / 2.0, slope(&BULL_NOSE));
    // Kac and Kae as the authors fitted them; a line through three means is good to some 20 %.
    assert!((ours - measured).abs() < 0.20 * measured.abs(), "{ours} N/mm against {measured} N/mm");
}
