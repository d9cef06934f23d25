//! Tool bending.

use crate::common::run;
use armill::cutting::Bending;
use nalgebra::Vector3;
use serde_json::json;
use std::f64::consts::PI;

#[test]
fn a_tool_bends_like_a_bar() {
    let (e, d, length) = (6e11, 0.01, 0.05);
    let inertia = |d: f64| PI * f64::powi(d, 4) / 64.0;
    // A round bar (no flutes): F L^3 / (3 E I) and F L^2 / (2 E I).
    let bar = Bending::of(e, length, 0.0, d, d);
    assert!((bar.displacement - length.powi(3) / (3.0 * e * inertia(d))).abs() < 1e-12 * bar.displacement);
    assert!((bar.turn - length.powi(2) / (2.0 * e * inertia(d))).abs() < 1e-12 * bar.turn);
    // Fluted over the whole length: 0.8 of the diameter.
    let fluted = Bending::of(e, length, length, d, d);
    assert!((fluted.displacement * f64::powi(0.8, 4) / bar.displacement - 1.0).abs() < 1e-12);
    // Stepped: the curvature M / (E I) integrated from the clamp, in small steps.
    let stepped = Bending::of(e, length, 0.02, d, 0.012);
    let n = 200_000;
    let dx = length / f64::from(n);
    let (mut slope, mut moved) = (0.0, 0.0);
    for piece in 0..n {
        let from_tip = length - (f64::from(piece) + 0.5) * dx;
        let i = inertia(if from_tip < 0.02 { 0.008 } else { 0.012 });
        slope += from_tip / (e * i) * dx;
        moved += slope * dx;
    }
    // Rectangle rule.
    assert!(
        (stepped.displacement - moved).abs() < 1e-4 * moved && (stepped.turn - slope).abs() < 1e-6 * slope
    );
    // Only forces across the axis bend the tool. The tip tilts as it moves, so a point further up
    // moves less.
    let (moved, turned) = bar.deflection(&Vector3::z(), &Vector3::new(10.0, 0.0, 500.0));
    assert!((moved - Vector3::new(10.0 * bar.displacement, 0.0, 0.0)).norm() < 1e-15);
    let above = moved + turned.cross(&Vector3::new(0.0, 0.0, 0.01));
    assert!(above.x < moved.x && above.x > 0.0);
}

#[test]
fn a_long_tool_adds_its_own_bending() {
    // Upright until after the samples under test; because it tilts in the end, the axes are kept.
    let text = "600,-20,100,0,0,1\n600,20,100,0,0,1\n600,22,100,0.02,0,1";
    let line = ("path", json!({"kind":"csv","text":text}));
    let rigid = run(&[line.clone(), ("shaper", json!("none"))]);
    let long = run(&[
        line,
        ("shaper", json!("none")),
        ("tool.bending", json!("cantilever")),
        ("tool.stickout_mm", json!(60)),
        ("tool.flute_length_mm", json!(30)),
    ]);
    // Tool upright: the addition is the force across the axis times the compliance.
    let bending = Bending::of(6e11, 0.06, 0.03, 0.01, 0.01);
    assert!((long.summary().cut.tool_bending_um_n.unwrap() - bending.displacement * 1e6).abs() < 1e-12);
    for k in [200, 300, 400] {
        let added = long.deflection[k] - rigid.deflection[k];
        let force = long.force[k];
        let expected = Vector3::new(force.x, force.y, 0.0) * bending.displacement;
        assert!((added - expected).norm() < 1e-12, "{added} against {expected}");
        // The clamped end stays, so the axis, from tip to spindle, tilts against the force. With
        // the arm's tilt this holds to first order.
        let leans = long.before.axis[k] - rigid.before.axis[k];
        let expected = Vector3::new(force.x, force.y, 0.0) * -bending.turn;
        assert!((leans - expected).norm() < expected.norm_squared(), "{leans} against {expected}");
    }
    // The budget still adds up, and compensation still works.
    let parts = long.budget().worst_mm;
    assert!((parts.joints.iter().sum::<f64>() + parts.shaping + parts.tool - parts.total).abs() < 1e-9);
    assert!(parts.tool > 1e-3, "{parts:?}");
    assert!(long.compensation.converged);
}
