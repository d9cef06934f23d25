//! Jobs in a stock, in front of a KUKA.

use serde_json::{Value, json};

/// Where the workpiece stands, upright [mm].
pub(crate) const AT: [f64; 3] = [1800.0, 0.0, 700.0];

/// A plate whose top is at zero.
pub(crate) fn plate() -> Value {
    json!({"kind":"box","from_mm":[-50,-50,-20],"to_mm":[50,50,0]})
}

/// A G-code program cut in aluminium by a flat tool of 10 mm with three flutes, with more changes of the
/// default job.
pub(crate) fn job(text: &str, stock: Value, more: &[(&'static str, Value)]) -> Vec<(&'static str, Value)> {
    let mut all = vec![
        ("robot", json!({"preset":"kuka-kr-300-r2700-2"})),
        ("tool_frame", json!({"xyz_mm":[0,0,300]})),
        ("workpiece_frame", json!({"xyz_mm":AT})),
        ("path", json!({"kind":"gcode","text":text})),
        ("stock", stock),
        ("motion", json!({"sample_time_s":0.01})),
        ("tool", json!({"diameter_mm":10,"flutes":3,"helix_deg":30})),
        ("material", json!({"preset":"al-7075-t6"})),
        ("cutting", json!({"spindle_rpm":8000,"feed_per_tooth_mm":"from_feed"})),
        ("shaper", json!("none")),
    ];
    all.extend_from_slice(more);
    all
}
