//! Shared by several test files: jobs made from a patch, random arms, random joint values.
#![allow(dead_code, reason = "each test file uses a part of this")]

pub(crate) mod in_stock;
pub(crate) mod measured;
pub(crate) mod moves;
#[cfg(not(target_arch = "wasm32"))]
pub(crate) mod peer;
pub(crate) mod program;

use armill::robot::{Joints, Link, Robot};
use armill::{Job, Progress, Report};
use nalgebra::Vector3;
use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, PI};

/// The default job with some values replaced: pairs of a JSON path (`motion.feed_mm_s`) and a
/// value.
pub(crate) fn job_text(changes: &[(&str, Value)]) -> String {
    let mut job = serde_json::to_value(Job::default()).unwrap();
    for (path, value) in changes {
        let mut place = &mut job;
        for key in path.split('.') {
            place = &mut place[key];
        }
        *place = value.clone();
    }
    job.to_string()
}

/// Computes the default job with some values replaced.
pub(crate) fn run(changes: &[(&str, Value)]) -> Report {
    armill::run_json(&job_text(changes), &mut Progress::none()).unwrap()
}

/// The error of the default job with some values replaced.
pub(crate) fn refused(changes: &[(&str, Value)]) -> armill::Error {
    armill::run_json(&job_text(changes), &mut Progress::none()).unwrap_err()
}

/// Asserts that a reader rejected a text of the job at this line and column, with this message.
pub(crate) fn refused_at<T: std::fmt::Debug>(
    outcome: Result<T, armill::Error>,
    text: &str,
    place: (usize, usize),
    part: &str,
) {
    let error = outcome.expect_err(text);
    assert_eq!(error.place(), Some(place), "{text:?}: {error}");
    assert_eq!(error.field(), Some("path.text"), "{text:?}");
    assert!(error.to_string().contains(part), "{text:?}: {error}");
}

/// A column of a report.
pub(crate) fn column(report: &Report, key: &str) -> Vec<f64> {
    report
        .columns()
        .into_iter()
        .find(|column| column.key == key)
        .unwrap_or_else(|| panic!("no column {key}"))
        .values
}

/// A number from `low` to `high`.
pub(crate) fn between(random: &mut fastrand::Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * random.f64()
}

/// Joint values within half a turn of zero.
pub(crate) fn any_joints(random: &mut fastrand::Rng) -> Joints {
    Joints::from_fn(|_, _| between(random, -PI, PI))
}

/// A vector of at most this length along each axis.
pub(crate) fn any_vector(random: &mut fastrand::Rng, size: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| between(random, -size, size))
}

/// An arm of the RX-90's family with random lengths, offsets a1, a3 and b, base twist, zero angles
/// and twist signs, and a random tool.
pub(crate) fn any_arm(random: &mut fastrand::Rng) -> Robot {
    let sign = |random: &mut fastrand::Rng| if random.bool() { 1.0 } else { -1.0 };
    let half_turn = |random: &mut fastrand::Rng| if random.bool() { 0.0 } else { PI };
    let offset = |random: &mut fastrand::Rng, size: f64| {
        if random.bool() { 0.0 } else { between(random, -size, size) }
    };
    let rows = [
        (half_turn(random), offset(random, 0.2), between(random, 0.2, 0.8)),
        (sign(random) * FRAC_PI_2, offset(random, 0.4), offset(random, 0.1)),
        (half_turn(random), sign(random) * between(random, 0.3, 1.2), offset(random, 0.1)),
        (sign(random) * FRAC_PI_2, offset(random, 0.2), sign(random) * between(random, 0.3, 1.2)),
        (sign(random) * FRAC_PI_2, 0.0, 0.0),
        (sign(random) * FRAC_PI_2, 0.0, offset(random, 0.3)),
    ];
    let links =
        rows.map(|(alpha, a, d)| Link { alpha, a, d, theta_offset: offset(random, PI), sign: sign(random) });
    let compliance = [0; 6].map(|_| between(random, 0.0, 1e-5));
    let rpy = [0; 3].map(|_| between(random, -3.0, 3.0));
    let tool = armill::math::Pose::from_xyz_rpy(any_vector(random, 0.3), rpy);
    Robot::new("random", links, None, compliance).unwrap().with_tool(tool)
}

/// The RX-90 as shipped with Armill.
pub(crate) fn rx90() -> Robot {
    armill::report::thesis::rx90(0.085).unwrap()
}

/// A job whose fingerprint is pinned: name, changes to the default job, fingerprint.
pub(crate) type Pinned = (&'static str, Vec<(&'static str, Value)>, &'static str);

/// Jobs that must give the same bits natively and in the browser. The fingerprints are our own:
/// they pin the two sides to each other and show when a number changes. They do not show that it is
/// right.
pub(crate) fn pinned() -> [Pinned; 5] {
    use serde_json::json;
    [
        ("default", vec![], "27afa232dc195c05483c2ee2ea0e1ca5"),
        (
            "rounded rectangle, EI in Hz, chip from feed, tilted part, offset tool",
            vec![
                (
                    "path",
                    json!({"kind":"rectangle","center_mm":[600,0,100],"width_mm":120,"height_mm":80,"corner_radius_mm":10}),
                ),
                ("shaper", json!({"kind":"ei","frequency_hz":9,"damping":0.03})),
                ("cutting.feed_per_tooth_mm", json!("from_feed")),
                ("material", json!({"preset":"al-7075-t6"})),
                ("workpiece_frame", json!({"xyz_mm":[10,20,30],"rpy_deg":[10,-20,30]})),
                ("tool_frame", json!({"xyz_mm":[0,50,120],"rpy_deg":[0,30,0]})),
            ],
            "99ceb22c345cc5ee26cace016a80f87e",
        ),
        (
            "points, ZVDD, another branch",
            vec![
                ("path", json!({"kind":"csv","text":"600,-100,100\n680,0,120\n600,100,100"})),
                ("shaper", json!({"kind":"zvdd","frequency_rad_s":60,"damping":0.02})),
                ("start_branch", json!({"shoulder":"front","elbow":"negative","wrist":"flipped"})),
            ],
            "b2212342e6bcc342a133ed1d8a42c42d",
        ),
        (
            "arc without shaper",
            vec![
                (
                    "path",
                    json!({"kind":"arc","center_mm":[600,0,100],"radius_mm":100,"normal":[0,0,1],"start_deg":30,"sweep_deg":-200}),
                ),
                ("shaper", json!("none")),
            ],
            "6902f3ff0a34f221bf2c6c7d970887e5",
        ),
        (
            "ball nose by catalogue constants, conventional milling, a tool that bends",
            vec![
                ("path", json!({"kind":"line","from_mm":[600,-20,100],"to_mm":[620,20,120]})),
                (
                    "tool",
                    json!({
                        "diameter_mm":12,"flutes":3,"helix_deg":40,"corner_radius_mm":"ball","rake_deg":6,
                        "bending":"cantilever","stickout_mm":60
                    }),
                ),
                ("material", json!({"preset":"s37"})),
                ("cutting.engagement", json!("conventional")),
                ("cutting.radial_depth_mm", json!(2.5)),
            ],
            "3a2a6b6a9f5172c20ac4a4631a5e4bcc",
        ),
    ]
}
