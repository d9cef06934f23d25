//! What is said to be impossible, where, and what cures it.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]

use crate::common::{column, refused, run};
use armill::Report;
use armill::report::{Severity, Warning};
use armill::robot::library;
use serde_json::{Value, json};

fn warning<'r>(report: &'r Report, code: &str) -> Option<&'r Warning> {
    report.warnings.iter().find(|warning| warning.code == code)
}

/// A line cut by a KR 210 whose wrist is straight (the flange looks down, the forearm too) but for
/// an angle [deg] by which the tool is tilted.
fn straight_wrist(off_deg: f64) -> Report {
    // At q = (0, q2, q3, 0, q5, 0) the forearm's direction in the arm's plane is that of joints 2 and 3.
    let robot =
        armill::robot::Robot::new("", library::robot("kuka-kr-210-2").unwrap().links(), None, [0.0; 6])
            .unwrap();
    let q = [0.0, -50.0, 110.0, 0.0, off_deg, 0.0].map(f64::to_radians);
    let flange = armill::robot::forward::forward(&robot, &q.into());
    let (p, axis) = (flange.position * 1e3, -flange.rotation.column(2));
    // Along y from the middle on, so that it is nearest at its start.
    let row = |y: f64| format!("{},{y},{},{},{},{}", p.x, p.z, axis.x, axis.y, axis.z);
    run(&[
        ("robot", json!({"preset":"kuka-kr-210-2"})),
        ("path", json!({"kind":"csv","text":format!("x,y,z,i,j,k\n{}\n{}", row(0.0), row(1.0))})),
        ("motion.sample_time_s", json!(0.01)),
        ("cutting.axial_depth_mm", json!(0)),
        ("shaper", json!("none")),
    ])
}

#[test]
fn a_singularity_cannot_be_run_where_the_path_all_but_meets_it() {
    for (off, severity) in [(0.05, Severity::CannotRun), (0.2, Severity::Matters), (4.0, Severity::Matters)] {
        let report = straight_wrist(off);
        let found = warning(&report, "singularity-wrist").unwrap();
        assert_eq!(found.severity, severity, "{off}: {}", found.message);
    }
    assert!(warning(&straight_wrist(6.0), "singularity-wrist").is_none());
}

#[test]
fn a_force_above_the_rated_load_is_named_with_both_numbers() {
    let default = run(&[]);
    let found = warning(&default, "force-payload").unwrap();
    assert_eq!(found.severity, Severity::CannotRun);
    // 6 kg weigh 58.8 N; eq. 4.7 gives (303, 1072, 509) N: 1225 N.
    for part in ["1225 N", "59 N", "6 kg", "lighter cut", "larger arm"] {
        assert!(found.message.contains(part), "{}", found.message);
    }
    // All the time in which the force is above the weight, which sets in and fades at the ends.
    let [x, y, z] = ["x", "y", "z"].map(|axis| column(&default, &format!("force_{axis}_n")));
    let over = |k: &usize| (x[*k] * x[*k] + y[*k] * y[*k] + z[*k] * z[*k]).sqrt() > 6.0 * 9.80665;
    let count = x.len();
    assert_eq!(found.from_sample, (0..count).find(over));
    assert_eq!(found.to_sample, (0..count).rfind(over));
    // The same cut by an arm for 210 kg (2059 N), by no rated arm, or none at all.
    let place = json!({"xyz_mm": [1500, 0, 800]});
    for changes in [
        vec![("robot", json!({"preset":"kuka-kr-210-2"})), ("workpiece_frame", place)],
        vec![("cutting.axial_depth_mm", json!(0))],
        vec![("robot", own_arm())],
    ] {
        assert!(warning(&run(&changes), "force-payload").is_none(), "{changes:?}");
    }
}

/// The default job's arm by its numbers.
fn own_arm() -> Value {
    let rows = library::robot("staubli-rx90").unwrap().links().map(|link| {
        json!({
            "alpha_deg": link.alpha.to_degrees().round(), "a_mm": (link.a * 1e3).round(),
            "d_mm": (link.d * 1e3).round(), "theta_offset_deg": link.theta_offset.to_degrees().round(),
            "joint_sign": link.sign
        })
    });
    json!({"modified_dh": rows, "joint_compliance_rad_per_nm": [0, 0, 0, 0, 0, 0]})
}

#[test]
fn what_is_out_of_reach_is_placed_and_has_a_remedy() {
    let far = refused(&[("workpiece_frame", json!({"xyz_mm": [3000, 0, 0]}))]).to_string();
    assert!(far.contains("sample 0") && far.contains("TCP at") && far.contains("closer"), "{far}");
}

#[test]
fn a_joint_may_turn_far_between_samples_that_are_far_apart() {
    // A circle of 1500 mm about the base at 750 mm/s: joint 1 turns at 0.5 rad/s, 28.6 deg/s.
    let slow = |sample_time_s: f64| {
        run(&[
            ("robot", json!({"preset":"kuka-kr-210-2"})),
            ("workpiece_frame", json!({"xyz_mm":[0,0,900]})),
            (
                "path",
                json!({"kind":"arc","center_mm":[0,0,0],"radius_mm":1500,"start_deg":-60,"sweep_deg":120}),
            ),
            ("motion", json!({"feed_mm_s":750,"acceleration_mm_s2":2000,"sample_time_s":sample_time_s})),
            ("cutting.axial_depth_mm", json!(0)),
            ("shaper", json!("none")),
        ])
    };
    assert!(warning(&slow(0.01), "joint-jump").is_none());
    let coarse = slow(0.2);
    let found = warning(&coarse, "joint-jump").unwrap();
    assert_eq!(found.severity, Severity::Matters, "{}", found.message);
    // Through the wrist singularity joints 4 and 6 turn half round within a few samples of 10 ms: at more
    // than the 885 deg/s of the fastest joint in the library.
    let through = straight_wrist(0.0005);
    let found = warning(&through, "joint-jump").unwrap();
    assert_eq!(found.severity, Severity::CannotRun, "{}", found.message);
}
