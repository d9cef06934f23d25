//! What a run is judged by beside the tip's contour error: what of the path is never reached, and
//! the error at the top of the cut; and what of the tool the compensation brings onto its place.

use crate::common::program::small_jobs;
use crate::common::run;
use armill::Report;
use armill::export::ExportOptions;
use armill::math::Pose;
use armill::robot::{Joints, forward};
use armill::verification::{Programs, export, read_back};
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

/// The pose of the tool at the sample `k` with the compensated path commanded, from the joints up:
/// shaped joint values and the turns of sprung joints.
fn bent(report: &Report, k: usize) -> Pose {
    let robot = &report.plan.robot;
    let (q, force) = (report.shaped(&report.compensation.q).at(k), report.force[k]);
    let tip = |q: &Joints| forward::forward(robot, q).position;
    // A joint's torque is the force times the tip's motion, by central differences.
    let turns = Joints::from_fn(|i, _| {
        let mut step = Joints::zeros();
        step[i] = 1e-5;
        robot.compliance()[i] * force.dot(&(tip(&(q + step)) - tip(&(q - step)))) / 2e-5
    });
    forward::forward(robot, &(q + turns))
}

/// Arc length of the command and error at the top of the cut on a circle [m], by the circle's own
/// geometry.
fn wall_on_a_circle(
    report: &Report,
    center: &Vector3<f64>,
    normal: &Vector3<f64>,
    radius: f64,
) -> Vec<(f64, f64)> {
    let depth = report.setup().cut.axial_depth;
    let error = |k: usize| {
        let bent = bent(report, k);
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

/// A line along y, with or without a shaper, compensated at a part of the tool.
fn at(part: &str, more: &[(&'static str, Value)]) -> Report {
    let line = json!({"kind":"line","from_mm":[600,-60,100],"to_mm":[600,60,100]});
    let changes = [("path", line), ("shaper", json!("none")), ("compensation.at", json!(part))];
    run(&[&changes, more].concat())
}

#[test]
fn the_tip_is_compensated_unless_the_job_says_otherwise() {
    let (tip, absent) = (at("tip", &[]), at("tip", &[("compensation.at", Value::Null)]));
    assert_eq!(tip.fingerprint(), absent.fingerprint());
    assert!(tip.after.axis.is_empty() && tip.after.middle.is_empty());
    assert_eq!(tip.after.judged, tip.after.statistics);
}

#[test]
fn compensated_in_the_middle_the_wall_errs_as_much_above_as_below() {
    let (tip, middle) = (at("tip", &[]), at("middle", &[]));
    let depth = middle.setup().cut.axial_depth;
    let mut largest = [0.0_f64; 3];
    for k in (0..middle.samples()).step_by(11) {
        let pose = bent(&middle, k);
        let up = -Vector3::from(pose.rotation.column(2));
        // The line x = 600, z = 100 and its copies above it.
        let error = |height: f64| {
            let point = pose.position + up * height - Vector3::new(0.6, 0.0, 0.1 + height);
            Vector3::new(point.x, 0.0, point.z)
        };
        let [bottom, half, top] = [0.0, depth / 2.0, depth].map(error);
        assert!((top + bottom - half * 2.0).norm() < 1e-12);
        for (most, error) in largest.iter_mut().zip([bottom, half, top]) {
            *most = most.max(error.norm());
        }
    }
    let [bottom, half, top] = largest;
    // The middle is where the tip is otherwise: well within the tolerance.
    assert!(middle.after.judged.max < 1e-6 && tip.after_max() < 1e-6);
    // From the joints up, to the squares of their turns: 1.5 m times 1 mrad twice.
    let square = 3e-6;
    assert!(half < square, "{half}");
    assert!((bottom - top).abs() < 2.0 * half && top > 10e-6, "{bottom} {top}");
    assert!((middle.after_max() - bottom).abs() < square && (middle.wall().max - top).abs() < square);
    // The tilt is the same, so each has half of what the top had.
    let (wall, half_wall) = (middle.wall().max, tip.wall().max / 2.0);
    assert!((wall - half_wall).abs() < 0.05 * half_wall, "{wall} {half_wall}");
    assert!((middle.after_max() - half_wall).abs() < 0.05 * half_wall);
    assert!(middle.compensation.converged);
}

#[test]
fn with_the_axis_compensated_the_wall_stands_upright() {
    let shaped = ("shaper", json!({"kind":"zvd","frequency_hz":10,"damping":0.03}));
    let [(_, arc), ..] = small_jobs();
    for more in [vec![], [arc, vec![shaped]].concat()] {
        let (tip, axis) = (at("tip", &more), at("axis", &more));
        assert!(axis.compensation.converged, "{:?}", axis.compensation.history_max);
        // What is left is less than the tolerance, by which the passes judge tip and top.
        let (left, tolerance) = (axis.wall().max, axis.setup().goal.tolerance);
        assert!(left <= tolerance && left < 0.5 * tip.wall().max, "{left} of {:?}", tip.wall());
        assert!(axis.after_max() <= tolerance);
        // It is the error of the tip and what is left of the tilt.
        let tilt = axis.after.axis_error.iter().copied().fold(0.0, f64::max);
        assert!(left <= axis.after_max() + tilt * axis.setup().cut.axial_depth + 1e-12);
    }
}

#[test]
fn a_tip_within_the_tolerance_is_no_reason_to_leave_the_wall_slanted() {
    // Only the shoulder gives way, far below the cut: the top of the tool is moved more than the tip.
    let robot = json!({"preset":"staubli-rx90","joint_compliance_rad_per_nm":[0,1e-6,0,0,0,0]});
    let high = json!({"kind":"line","from_mm":[500,-60,650],"to_mm":[500,60,650]});
    let exact = json!({"stiffness_percent":0,"cutting_percent":0});
    let job = [("robot", robot), ("path", high), ("uncertainty", exact)];
    let with = |part, more: (&'static str, Value)| at(part, &[&job[..], &[more]].concat());
    let as_desired = with("axis", ("compensation.max_passes", json!(0)));
    let (tip, top) = (as_desired.after_max(), as_desired.wall().max);
    assert!(tip < top, "{tip} {top}");
    let between = ("compensation.tolerance_mm", json!((tip + top) / 2.0 * 1e3));
    assert_eq!(with("tip", between.clone()).compensation.passes, 0);
    let report = with("axis", between);
    assert!(report.compensation.passes > 0 && report.wall().max <= report.setup().goal.tolerance);
}

#[test]
fn programs_command_the_tilt_and_keep_the_wall_upright() {
    let [(_, arc), ..] = small_jobs();
    let report = at("axis", &arc);
    let (programs, options) = (Programs::default(), ExportOptions::default());
    let tolerance = report.setup().goal.tolerance;
    for format in ["apt", "path-csv"] {
        let outcome = read_back(&report, &programs, format, &options).unwrap();
        let (tip, wall) = (outcome.largest(), outcome.deviation.wall);
        assert!(tip <= tolerance && wall.max <= tolerance, "{format}: {tip} {wall:?}");
    }
    for format in ["krl", "rapid", "val3", "fanuc", "joints-csv", "compensated-csv"] {
        export(&report, format, &options).unwrap();
    }
    let refused = export(&report, "gcode", &options).unwrap_err();
    assert_eq!((refused.code(), refused.field()), ("invalid", Some("compensation.at")));
    assert!(refused.to_string().contains("middle"), "{refused}");
    // A program read from G-code cannot be rewritten either; in the middle of the cut it can.
    let text = "G21 G90 M3 S4000\nG0 X560 Y-60 Z110\nG1 Z100 F3000\nG1 Y60\nG0 Z110\nM30";
    let program = ("path", json!({"kind":"gcode","text":text}));
    let refused = export(&at("axis", std::slice::from_ref(&program)), "gcode", &options).unwrap_err();
    assert_eq!(refused.field(), Some("compensation.at"));
    export(&at("middle", &[program]), "gcode", &options).unwrap();
}
