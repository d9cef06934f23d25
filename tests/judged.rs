//! What a run is judged by beside the tip's contour error: what of the path is never reached, and
//! the error at the top of the cut.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod common;

use armill::Report;
use armill::robot::{Joints, forward};
use common::program::small_jobs;
use common::run;
use nalgebra::Vector3;
use serde_json::{Value, json};

/// A spike of 10 deg, passed without a wait by a shaped command.
fn spike(more: &[(&'static str, Value)]) -> Report {
    let changes = [
        ("workpiece_frame", json!({"xyz_mm":[560,-40,320],"rpy_deg":[0,0,0]})),
        ("path", json!({"kind":"polyline","points_mm":[[0,0,0],[60,0,0],[0,10.6,0]]})),
        ("motion.feed_mm_s", json!(40)),
        ("motion.acceleration_mm_s2", json!(400)),
        ("motion.sample_time_s", json!(0.002)),
        ("motion.corner_dwell", json!(0)),
        ("material", json!({"preset":"al-7075-t6"})),
        ("cutting.axial_depth_mm", json!(3)),
    ];
    run(&[&changes, more].concat())
}

/// Jobs on paths that bend, stop and turn, compensated and not.
fn reports() -> Vec<Report> {
    let [(_, arc), (_, rounded), (_, sharp)] = small_jobs();
    let as_desired = ("compensation.max_passes", json!(0));
    let with = |job: &[(&'static str, Value)], more: &[(&'static str, Value)]| run(&[job, more].concat());
    vec![
        spike(std::slice::from_ref(&as_desired)),
        spike(&[]),
        with(&arc, std::slice::from_ref(&as_desired)),
        with(&arc, &[]),
        with(&rounded, std::slice::from_ref(&as_desired)),
        with(&sharp, &[as_desired, ("motion.corner_dwell", json!(0))]),
        with(&sharp, &[]),
    ]
}

/// Distance of a point from the tip's way [m], all of it looked at.
fn from_way(tips: &[Vector3<f64>], point: &Vector3<f64>) -> f64 {
    let piece = |pair: &[Vector3<f64>]| {
        let along = pair[1] - pair[0];
        let length = along.norm();
        let Some(unit) = along.try_normalize(0.0) else { return (point - pair[0]).norm() };
        let foot = pair[0] + unit * (point - pair[0]).dot(&unit).clamp(0.0, length);
        (point - foot).norm()
    };
    tips.windows(2).map(piece).fold(f64::INFINITY, f64::min)
}

#[test]
fn the_vertex_of_a_spike_is_missed() {
    let as_desired = ("compensation.max_passes", json!(0));
    let rigid = json!({"preset":"staubli-rx90","joint_compliance_rad_per_nm":[0,0,0,0,0,0]});
    let of_shaping = spike(&[as_desired.clone(), ("robot", rigid)]).summary().missed_mm;
    // By an independent model: 2.45 mm, at the vertex.
    assert!((of_shaping.max - 2.45).abs() < 0.01, "{of_shaping:?}");
    let report = spike(&[as_desired]);
    let missed = report.summary().missed_mm;
    assert!((missed.at_arc_length_mm - 60.0).abs() < 1e-9, "{missed:?}");
    // The force moves the tip, and what it misses, by a deflection at most.
    let bent = report.deflection.iter().map(|d| d.norm() * 1e3).fold(0.0, f64::max);
    assert!((missed.max - of_shaping.max).abs() < bent && bent < 0.2, "{missed:?} {bent}");
    // No contour error shows it: the tip is always near one of the legs.
    assert!(report.summary().after_mm.max < 0.5 * missed.max);
}

#[test]
fn what_is_missed_is_what_a_look_at_everything_finds() {
    for report in reports() {
        let path = &report.plan.path;
        let missed = report.missed();
        // Evenly spaced places instead of those due at the samples.
        let count = 4000;
        let places = (0..=count).map(|i| path.length() * f64::from(i) / f64::from(count));
        let distance = |s: f64| from_way(&report.after.actual, &path.point(s));
        let corners = path.corners().map(|corner| corner.s);
        let found = places.chain(corners).map(distance).fold(0.0, f64::max);
        // The largest lies between two of the places due at the samples, where the distance hardly
        // changes, or exactly at a corner.
        assert!(found <= missed.max * 1.001 + 1e-8, "{found} for {missed:?}");
        assert!((distance(missed.at) - missed.max).abs() <= 1e-12, "{missed:?} is at its place");
    }
}

#[test]
fn on_a_circle_the_path_is_as_far_from_the_tip_as_the_tip_from_the_path() {
    for shaper in [json!("none"), json!({"kind":"zvd","frequency_rad_s":18.0,"damping":0.1})] {
        let report = run(&[("shaper", shaper), ("compensation.max_passes", json!(0))]);
        let (missed, after) = (report.missed(), report.after_max());
        // Both are distances of the same two curves; the error of 1 mm bends the tip's circle of
        // 300 mm by a three hundredth.
        assert!((missed.max - after).abs() < after / 300.0, "{missed:?} {after}");
    }
}

#[test]
fn a_tip_that_stays_on_the_path_misses_only_its_waits() {
    let rigid = json!({"preset":"staubli-rx90","joint_compliance_rad_per_nm":[0,0,0,0,0,0]});
    let [_, _, (_, sharp)] = small_jobs();
    let report = run(&[sharp, vec![("robot", rigid), ("shaper", json!("none"))]].concat());
    // The corners lie between two samples, which the tip connects straight: a stop from 100 mm/s in
    // steps of 1 ms passes the corner by less than the way of its last step, 1/2 a t^2.
    assert!(report.missed().max < 1e-6, "{:?}", report.missed());
}

/// Arc length of the command and error at the top of the cut on a circle [m], from the joints up:
/// shaped joint values, the turns of sprung joints, and the circle's own geometry.
fn wall_on_a_circle(
    report: &Report,
    center: &Vector3<f64>,
    normal: &Vector3<f64>,
    radius: f64,
) -> Vec<(f64, f64)> {
    let robot = &report.plan.robot;
    let depth = report.setup().cut.axial_depth;
    let shaped = report.shaped(&report.compensation.q);
    let error = |k: usize| {
        let (q, force) = (shaped.at(k), report.force[k]);
        let tip = |q: &Joints| forward::forward(robot, q).position;
        // A joint's torque is the force times the tip's motion, by central differences.
        let turns = Joints::from_fn(|i, _| {
            let mut step = Joints::zeros();
            step[i] = 1e-5;
            robot.compliance()[i] * force.dot(&(tip(&(q + step)) - tip(&(q - step)))) / 2e-5
        });
        let bent = forward::forward(robot, &(q + turns));
        let top = bent.position - bent.rotation.column(2) * depth;
        // On the circle moved up by the depth along the desired axis, +Z of the workpiece; errors
        // along the tangent at the tip's place do not count.
        let spoke = bent.position - center;
        let outward = (spoke - normal * normal.dot(&spoke)).normalize();
        let desired = center + outward * radius + Vector3::z() * depth;
        let error = top - desired;
        let tangent = normal.cross(&outward);
        let arc_length = report.plan.trajectory.timing.arc_length[k];
        (arc_length, (error - tangent * tangent.dot(&error)).norm())
    };
    (0..report.samples()).step_by(7).map(error).collect()
}

#[test]
fn the_wall_errs_by_the_tilt_over_the_depth() {
    let report = run(&[]);
    let pose = report.setup().workpiece;
    assert_eq!(pose.position, Vector3::zeros(), "the default circle is about the base");
    let normal = Vector3::new(0.2, 0.3, 0.5).normalize();
    let wall = report.wall();
    let errors = wall_on_a_circle(&report, &Vector3::zeros(), &normal, 0.3);
    let found = errors.iter().map(|(_, error)| *error).fold(0.0, f64::max);
    // Levers are taken before the joints turn, which costs the square of the turn.
    assert!((wall.max - found).abs() < 1e-3 * found, "{wall:?} {found}");
    // By an independent model: 0.028 mm at the top of a wall 10 mm high, with an axial force the
    // other way and a cut that begins with its full force, hence without an error of the tip there.
    let settled = errors.iter().filter(|(s, _)| *s > 0.1).map(|(_, error)| *error).fold(0.0, f64::max);
    assert!((settled - 0.028e-3).abs() < 0.002e-3, "{settled}");
    // The tilt times the depth, with the error of the tip at most.
    let tilt = report.after.axis_error.iter().copied().fold(0.0, f64::max);
    assert!(wall.max <= tilt * report.setup().cut.axial_depth + report.after_max());
}

#[test]
fn a_slender_tool_that_bends_leans_more() {
    let line = json!({"kind":"line","from_mm":[600,-60,100],"to_mm":[600,60,100]});
    let slender = |more: &[(&'static str, Value)]| {
        let bends = [
            ("path", line.clone()),
            ("tool.bending", json!("cantilever")),
            ("tool.stickout_mm", json!(60)),
            ("shaper", json!("none")),
        ];
        run(&[&bends, more].concat())
    };
    let rigid = json!({"preset":"staubli-rx90","joint_compliance_rad_per_nm":[0,0,0,0,0,0]});
    let of_tool = slender(&[("robot", rigid)]);
    // The line runs along y, so the wall is bent by the force along x. A bar clamped at its other
    // end turns by F L^2 / (2 E I).
    let across = of_tool.force.iter().map(|force| force.x.abs()).fold(0.0, f64::max);
    let (length, inertia) = (60e-3_f64, std::f64::consts::PI * 8e-3_f64.powi(4) / 64.0);
    let modulus = 600e9;
    let leans = across * length.powi(2) / (2.0 * modulus * inertia) * of_tool.setup().cut.axial_depth;
    assert!((of_tool.wall().max - leans).abs() < 1e-3 * leans, "{:?} {leans}", of_tool.wall());
    // The tip of both is where it should be; the arm leans in addition.
    let report = slender(&[]);
    assert!(report.after_max() < 1e-5 && report.wall().max > of_tool.wall().max, "{:?}", report.wall());
}

#[test]
fn a_rigid_arm_leaves_upright_walls() {
    let rigid = json!({"preset":"staubli-rx90","joint_compliance_rad_per_nm":[0,0,0,0,0,0]});
    let report = run(&[("robot", rigid), ("shaper", json!("none"))]);
    // The closure error of the inverse model.
    assert!(report.wall().max < 1e-9, "{:?}", report.wall());
}
