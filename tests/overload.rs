//! Warnings about a cut that is more than spindle, tool or holder take, with their lines and places.
#![allow(clippy::disallowed_methods, reason = "independent values come from the standard library")]

use crate::common::{column, in_stock, refused, run};
use armill::report::Warning;
use armill::{Error, Report};
use serde_json::{Value, json};

/// A groove, then a wall beside it with a radial depth of 1 mm.
const GROOVE: &str = "G21 G90\nG0 X-70 Y0 Z5\nZ-3\nG1 X70 F600\nG0 Z5\nX-70 Y1\nZ-3\nG1 X70 F600\nG0 Z5\n";

/// In a plate, at 8000 1/min: 0.025 mm a tooth.
fn job(text: &str, more: &[(&'static str, Value)]) -> Vec<(&'static str, Value)> {
    in_stock::job(text, in_stock::plate(), more)
}

fn warning<'r>(report: &'r Report, code: &str) -> Option<&'r Warning> {
    report.warnings.iter().find(|warning| warning.code == code)
}

/// Desired x and y [mm] in the workpiece at the samples of a warning's spans.
fn places(report: &Report, warning: &Warning) -> Vec<[f64; 2]> {
    let (x, y) = (column(report, "desired_x_mm"), column(report, "desired_y_mm"));
    let samples = warning.spans_samples.iter().flat_map(|&(from, to)| from..=to);
    samples.map(|k| [x[k] - 1800.0, y[k]]).collect()
}

/// The torque of a slot is N a / (2 pi) (2 K_tc c + pi K_te) D / 2, by hand; the warning comes between.
#[test]
fn the_torque_is_warned_of_where_it_is_exceeded() {
    let torque = |ktc: f64, kte: f64| {
        3.0 * 3e-3 / std::f64::consts::TAU * (2.0 * ktc * 0.025e-3 + std::f64::consts::PI * kte) * 5e-3
    };
    let report = run(&job(GROOVE, &[]));
    let k = serde_json::to_value(report.summary()).unwrap()["cut"].clone();
    let expected = torque(k["ktc_n_mm2"].as_f64().unwrap() * 1e6, k["kte_n_mm"].as_f64().unwrap() * 1e3);
    let with = |rated: f64| run(&job(GROOVE, &[("cutting.spindle_torque_nm", json!(rated))]));
    let weak = with(expected * 0.999);
    let found = warning(&weak, "spindle-torque").unwrap();
    assert!(found.message.starts_with("line 4: the cut takes up to "), "{}", found.message);
    assert!(places(&weak, found).iter().all(|[x, y]| *y == 0.0 && x.abs() < 55.0));
    assert!(warning(&with(expected * 1.001), "spindle-torque").is_none());
    assert!(warning(&report, "spindle-torque").is_none());
    let unknown = run(&job(GROOVE, &[("cutting.spindle_torque_nm", json!("unknown"))]));
    assert_eq!(unknown.fingerprint(), report.fingerprint());
    // A stated slot has no place: it is the same all along.
    let stated = |rated: f64| {
        let cutting = json!({
            "engagement":"slot","axial_depth_mm":3,"spindle_rpm":8000,"feed_per_tooth_mm":0.025,
            "spindle_torque_nm":rated
        });
        run(&job(GROOVE, &[("cutting", cutting)]))
    };
    let weak = stated(expected * 0.999);
    let found = warning(&weak, "spindle-torque").unwrap();
    assert!(found.message.starts_with("the cut takes ") && found.from_s.is_none(), "{}", found.message);
    assert!(warning(&stated(expected * 1.001), "spindle-torque").is_none());
}

/// A slot's thickest chip is the feed per tooth, that of a radial depth e is c 2 sqrt(e / D - (e / D)^2).
#[test]
fn chips_are_held_to_the_tool_s_range() {
    let with = |key: &'static str, limit: f64| run(&job(GROOVE, &[(key, json!(limit))]));
    let thin = 0.025 * 2.0 * (0.1_f64 - 0.01).sqrt();
    assert!(warning(&with("tool.max_chip_mm", 0.025_001), "chip-too-thick").is_none());
    let thick = with("tool.max_chip_mm", 0.0249);
    let found = warning(&thick, "chip-too-thick").unwrap();
    assert!(found.message.starts_with("line 4: chips are up to 0.025 mm thick"), "{}", found.message);
    assert!(places(&thick, found).iter().any(|[x, y]| *y == 0.0 && x.abs() < 40.0));
    assert!(warning(&with("tool.min_chip_mm", thin * 0.999), "chip-too-thin").is_none_or(|found| {
        // Where the tool comes out of the plate, and goes in beside the groove, the arcs are short.
        places(&with("tool.min_chip_mm", thin * 0.999), found).iter().all(|[x, _]| x.abs() > 44.0)
    }));
    let rubbing = with("tool.min_chip_mm", thin * 1.001);
    let found = warning(&rubbing, "chip-too-thin").unwrap();
    assert!(found.message.contains("line 8: chips are at most "), "{}", found.message);
    let all = places(&rubbing, found);
    assert!(all.iter().all(|[x, y]| *y == 1.0 || x.abs() > 44.0));
    assert!(all.iter().filter(|[x, y]| *y == 1.0 && x.abs() < 40.0).count() > 500);
    let cut = serde_json::to_value(thick.summary()).unwrap()["cut"].clone();
    assert!((cut["largest_chip_mm"].as_f64().unwrap() - 0.025).abs() < 1e-12);
}

/// Stated: half immersion has its thickest chip ahead; a ball nose at a small depth sin(kappa) of it.
#[test]
fn stated_chips_have_closed_forms() {
    let chip = |tool: Value, cutting: Value| {
        let report = run(&[("tool", tool), ("cutting", cutting)]);
        serde_json::to_value(report.summary()).unwrap()["cut"]["largest_chip_mm"].as_f64().unwrap()
    };
    let flat = json!({"diameter_mm":10,"flutes":3,"helix_deg":30});
    let climb = |depth: f64| {
        json!({
            "engagement":"climb","radial_depth_mm":depth,"axial_depth_mm":1,"spindle_rpm":8000,
            "feed_per_tooth_mm":0.1
        })
    };
    assert!((chip(flat.clone(), climb(5.0)) - 0.1).abs() < 1e-9);
    assert!((chip(flat.clone(), climb(8.0)) - 0.1).abs() < 1e-15);
    // sin(acos(1 - 2 / 5)) = 0.8
    assert!((chip(flat, climb(2.0)) - 0.08).abs() < 1e-12);
    let ball = json!({"diameter_mm":10,"flutes":3,"helix_deg":30,"corner_radius_mm":"ball"});
    let slot = json!({"engagement":"slot","axial_depth_mm":1,"spindle_rpm":8000,"feed_per_tooth_mm":0.1});
    // cos(kappa) = 1 - 1 / 5.
    assert!((chip(ball, slot) - 0.06).abs() < 1e-12);
}

/// The warning of a stated chip that is off concerns all that is cut.
#[test]
fn a_stated_chip_is_checked_as_well() {
    let cutting =
        json!({"engagement":"slot","axial_depth_mm":3,"spindle_rpm":8000,"feed_per_tooth_mm":0.025});
    let with = |least: f64, most: f64| {
        let tool = json!({
            "diameter_mm":10,"flutes":3,"helix_deg":30,"min_chip_mm":least,"max_chip_mm":most
        });
        run(&job(GROOVE, &[("cutting", cutting.clone()), ("tool", tool)]))
    };
    assert!(warning(&with(0.001, 0.02), "chip-too-thick").is_some_and(|warning| warning.spans_s.len() == 2));
    assert!(warning(&with(0.03, 0.1), "chip-too-thin").is_some());
    let fine = with(0.02, 0.03);
    assert!(warning(&fine, "chip-too-thick").or(warning(&fine, "chip-too-thin")).is_none());
}

/// A groove of 10 mm, 12 mm deep in three passes: a holder that begins 10 mm above the tip is 2 mm down
/// in the plate on the last of them.
const DEEP: &str = "G21 G90\nG0 X-70 Y0 Z5\nZ-4\nG1 X70 F600\nZ-8\nX-70\nZ-12\nX70\nG0 Z5\n";

#[test]
fn the_holder_meets_the_stock() {
    let with = |text: &str, holder: f64, stickout: f64, corner: f64| {
        let tool = json!({
            "diameter_mm":10,"flutes":3,"helix_deg":30,"holder_diameter_mm":holder,"stickout_mm":stickout,
            "corner_radius_mm":corner
        });
        run(&job(text, &[("tool", tool)]))
    };
    let report = with(DEEP, 30.0, 10.0, 0.0);
    let found = warning(&report, "holder-in-stock").unwrap();
    assert!(found.message.starts_with("line 8: the holder runs into the stock"), "{}", found.message);
    // It arrives with its rim, 15 mm ahead of the axis: to half a radius of the tool.
    let first = places(&report, found)[0][0];
    assert!((-65.1..-62.0).contains(&first), "{first}");
    // Thinner than the groove, or above the plate, it meets nothing.
    assert!(warning(&with(DEEP, 9.0, 10.0, 0.0), "holder-in-stock").is_none());
    assert!(warning(&with(DEEP, 30.0, 12.0, 0.0), "holder-in-stock").is_none());
    // Its side and back, where the tool itself is clear: the way back in the same groove.
    let back = DEEP.replace("G0 Z5", "X-70\nG0 Z5");
    assert!(
        warning(&with(&back, 30.0, 10.0, 0.0), "holder-in-stock").unwrap().message.contains("another move")
    );
    // In a pocket as wide as the holder it is free until the last pass is deeper.
    let rows: String =
        (-6..=6).map(|row| format!("G0 Z5\nX-70 Y{}\nG1 Z-4\nX70\n", 3 * row)).collect::<String>();
    let pocket = format!("G21 G90 F6000\n{rows}G0 Z5\nX-70 Y0\nZ-8\nG1 X70\nZ-12\nX-70\nG0 Z5\n");
    assert!(warning(&with(&pocket, 30.0, 10.0, 0.0), "holder-in-stock").is_none());
    assert!(warning(&with(&pocket, 30.0, 5.0, 0.0), "holder-in-stock").is_some());
    assert!(warning(&with(&pocket, 50.0, 10.0, 0.0), "holder-in-stock").is_some());
}

/// A line in a thousand points is seen as the line is: one stretch from about the same place on.
#[test]
fn dense_points_are_a_line() {
    let points: String = (1..=1400).map(|k| format!("X{:.1}\n", f64::from(k) * 0.1 - 70.0)).collect();
    let dense = DEEP.replace("Z-12\nX70\n", &format!("Z-12\n{points}"));
    let tool = json!({"diameter_mm":10,"flutes":3,"helix_deg":30,"holder_diameter_mm":30,"stickout_mm":10});
    let stretch = |text: &str| {
        let report = run(&job(text, &[("tool", tool.clone())]));
        let found = warning(&report, "holder-in-stock").unwrap().clone();
        let all = places(&report, &found);
        (found.spans_s.len(), all[0][0], all[all.len() - 1][0])
    };
    let ((one, from, to), (spans, first, last)) = (stretch(DEEP), stretch(&dense));
    assert_eq!((one, spans), (1, 1));
    assert!((from - first).abs() < 2.6 && to > last - 0.1, "{from} {first}, {to} {last}");
    // The whole move counts from its first place on; dense points end where the holder is clear.
    assert!((62.0..68.0).contains(&last), "{last}");
}

/// A rapid move that is clear with the tool may not be with the holder.
#[test]
fn rapid_moves_are_looked_at() {
    let rapid = "G21 G90\nG0 X-70 Y0 Z5\nZ-4\nG1 X70 F600\nZ-8\nX-70\nZ-12\nX70\nG0 X-70\nG0 Z5\n";
    let tool = json!({
        "diameter_mm":10,"flutes":3,"helix_deg":30,"holder_diameter_mm":30,"stickout_mm":10,"bending":"rigid"
    });
    let report = run(&job(rapid, &[("tool", tool)]));
    assert!(warning(&report, "rapid-in-stock").is_none());
    assert!(warning(&report, "holder-in-stock").unwrap().message.contains("another move"));
}

/// On a map of heights the same holder meets the same material.
#[test]
fn a_holder_on_a_map() {
    let waves: String =
        (0..=10).map(|k| format!("X{} Z{}\n", -25 + 5 * k, if k % 2 == 0 { -2 } else { -7 })).collect();
    let text = format!("G21 G90\nG0 X-40 Y0 Z5\nG0 Z-2\nG1 X-25 F600\n{waves}G0 Z5\n");
    let with = |holder: f64, stickout: f64| {
        let tool = json!({
            "diameter_mm":10,"flutes":3,"helix_deg":30,"corner_radius_mm":5,"holder_diameter_mm":holder,
            "stickout_mm":stickout
        });
        let report = run(&job(
            &text,
            &[("tool", tool), ("stock", json!({"kind":"box","from_mm":[-30,-30,-20],"to_mm":[30,30,0]}))],
        ));
        assert!(report.setup().contacts.as_ref().unwrap().cell.is_some());
        warning(&report, "holder-in-stock").map(|warning| warning.message.clone())
    };
    let message = with(30.0, 5.0).unwrap();
    // The first valley, at line 6.
    assert!(message.starts_with("line 6: "), "{message}");
    assert_eq!(with(30.0, 7.5), None);
    assert_eq!(with(8.0, 5.0), None);
}

#[test]
fn a_holder_s_places_stay_with_their_pieces() {
    let tool = json!({
        "diameter_mm":10,"flutes":3,"helix_deg":30,"holder_diameter_mm":30,"stickout_mm":10
    });
    let plain = run(&job(DEEP, &[("tool", tool.clone())]));
    let held = run(&job(
        DEEP,
        &[
            ("tool", tool),
            ("motion", json!({"sample_time_s":0.01,"feed_rule":"constant-force","force_n":60})),
        ],
    ));
    assert!(held.setup().path.moves().len() > plain.setup().path.moves().len());
    let first = |report: &Report| {
        let contacts = report.setup().contacts.as_ref().unwrap();
        let hit = contacts.collisions.first().unwrap();
        report.setup().path.start(hit.index) + hit.within
    };
    assert!((first(&plain) - first(&held)).abs() < 1e-12);
}

#[test]
fn mistakes_are_named() {
    let field = |more: (&'static str, Value)| refused(&job(GROOVE, &[more])).field().unwrap().to_owned();
    let tool = |more: Value| {
        let mut tool = json!({"diameter_mm":10,"flutes":3,"helix_deg":30});
        tool.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        ("tool", tool)
    };
    assert_eq!(field(tool(json!({"holder_diameter_mm":30}))), "tool.stickout_mm");
    assert_eq!(field(tool(json!({"holder_diameter_mm":0,"stickout_mm":30}))), "tool.holder_diameter_mm");
    assert_eq!(field(tool(json!({"stickout_mm":30}))), "tool.bending");
    assert_eq!(field(tool(json!({"min_chip_mm":0.2,"max_chip_mm":0.1}))), "tool.min_chip_mm");
    assert_eq!(field(tool(json!({"max_chip_mm":"none"}))), "tool.max_chip_mm");
    assert_eq!(field(("cutting.spindle_torque_nm", json!(0))), "cutting.spindle_torque_nm");
    assert!(matches!(
        refused(&job(GROOVE, &[("cutting.spindle_torque_nm", json!(-1))])),
        Error::OutOfRange { .. }
    ));
    // Without a stock there is nothing to meet, but the numbers are checked.
    assert_eq!(
        refused(&job(GROOVE, &[("stock", json!({"kind":"none"})), tool(json!({"holder_diameter_mm":30}))]))
            .field(),
        Some("tool.stickout_mm")
    );
}
