//! The cut as a job states it, and its errors.

use crate::common::{refused, run};
use serde_json::{Value, json};

#[test]
fn both_ways_of_giving_the_engagement_are_one() {
    let force = |changes: &[(&str, Value)]| run(changes).mean_force();
    // The thesis's quarter turn of a 10 mm tool is 5 mm of climb milling.
    let climb = [("cutting.engagement", json!("climb")), ("cutting.radial_depth_mm", json!(5))];
    assert!((force(&climb) - force(&[])).norm() < 1e-9 * force(&[]).norm());
    let summary = run(&climb).summary();
    assert!((summary.cut.entry_deg - 90.0).abs() < 1e-9 && (summary.cut.exit_deg - 180.0).abs() < 1e-9);
    let summary = run(&[("cutting.entry_deg", json!(0)), ("cutting.exit_deg", json!(60))]).summary();
    assert!((summary.cut.radial_depth_mm - 2.5).abs() < 1e-9, "5 (1 - cos 60)");
    let up = [("cutting.engagement", json!("conventional")), ("cutting.radial_depth_mm", json!(2.5))];
    assert!((run(&up).summary().cut.exit_deg - 60.0).abs() < 1e-9);
    let slot = force(&[("cutting.engagement", json!("slot"))]);
    assert!((slot - force(&[("cutting.entry_deg", json!(0))])).norm() < 1e-9 * slot.norm());
}

#[test]
fn what_is_missing_or_contradicts_is_named() {
    let cases: [(&str, Value, &str, &str); 16] = [
        ("cutting.radial_depth_mm", json!(5), "missing", "cutting.engagement"),
        ("cutting.engagement", json!("climb"), "missing", "cutting.radial_depth_mm"),
        ("cutting.engagement", json!("down"), "json", "cutting.engagement"),
        ("tool.corner_radius_mm", json!(5.1), "out-of-range", "tool.corner_radius_mm"),
        ("tool.corner_radius_mm", json!("bull"), "json", "tool.corner_radius_mm"),
        ("tool.stickout_mm", json!(40), "missing", "tool.bending"),
        ("tool.bending", json!("cantilever"), "missing", "tool.stickout_mm"),
        ("tool.runout_mm", json!(-0.1), "out-of-range", "tool.runout_mm"),
        ("material", json!({"kc11_n_mm2":1500}), "missing", "material.mc"),
        ("material", json!({"mc":0.2}), "missing", "material.kc11_n_mm2"),
        ("material", json!({"kc11_n_mm2":1500,"mc":1}), "out-of-range", "material.mc"),
        ("material", json!({"kc11_n_mm2":1500,"mc":0.2,"ktc_n_mm2":1}), "invalid", "material.kc11_n_mm2"),
        ("material", json!({"preset":"p1","mc":0.2}), "invalid", "material.preset"),
        ("material", json!({"preset":"thesis","radial_ratio":0.2}), "invalid", "material.radial_ratio"),
        (
            "material",
            json!({"preset":"p1","chip_thickness_mm":0}),
            "out-of-range",
            "material.chip_thickness_mm",
        ),
        ("material", json!({"preset":"p1","line":"chord"}), "json", "material.line"),
    ];
    for (path, value, code, field) in cases {
        let error = refused(&[(path, value.clone())]);
        assert_eq!((error.code(), error.field()), (code, Some(field)), "{path} = {value}: {error}");
    }
    let deep = [("cutting.engagement", json!("climb")), ("cutting.radial_depth_mm", json!(10.5))];
    assert_eq!(refused(&deep).field(), Some("cutting.radial_depth_mm"));
    let thin = [("material", json!({"preset":"p1"})), ("cutting.feed_per_tooth_mm", json!(0.001))];
    assert_eq!(refused(&thin).field(), Some("material.chip_thickness_mm"));
}
