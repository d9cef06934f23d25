//! The thesis's figures, each with its tolerance and why (design notes: what in the thesis is
//! right, and what is not).
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]

use crate::common::{any_joints, column, run};
use armill::deviation::{Source, Sources};
use armill::report::Statistics;
use armill::report::thesis::{ConstantForce, TABLE_5_1, rows, rx90};
use armill::robot::{Joints, forward, inverse, jacobian};
use armill::{Job, Report};
use nalgebra::{Matrix3, Matrix6, Vector3};
use serde_json::json;
use std::sync::OnceLock;

fn default_report() -> &'static Report {
    static REPORT: OnceLock<Report> = OnceLock::new();
    REPORT.get_or_init(|| armill::run(&Job::default(), &mut armill::Progress::none()).unwrap())
}

fn constant_force() -> &'static ConstantForce {
    static CASE: OnceLock<ConstantForce> = OnceLock::new();
    CASE.get_or_init(|| ConstantForce::of(default_report()))
}

fn close(ours: f64, printed: f64, tolerance: f64, what: &str) {
    assert!((ours - printed).abs() <= tolerance, "{what}: {ours} against {printed} +- {tolerance}");
}

const D1: f64 = 0.420;
const A2: f64 = 0.450;
const D4: f64 = 0.650;
const D6: f64 = 0.085;

#[test]
fn eq_3_6_zero_pose() {
    let tcp = forward::forward(&rx90(D6).unwrap(), &Joints::zeros());
    assert!((tcp.rotation - Matrix3::identity()).amax() < 1e-15);
    assert!((tcp.position - Vector3::new(0.0, 0.0, 1.605)).norm() < 1e-15);
}

#[test]
fn eq_3_22_test_pose() {
    let q = Joints::from([70.0, 20.0, 60.0, 0.0, 50.0, 100.0]).map(f64::to_radians);
    // d6 = 0: the printed position is the wrist point. Four digits are printed.
    let tcp = forward::forward(&rx90(0.0).unwrap(), &q);
    let [n, s, a] = [0, 1, 2].map(|column| tcp.rotation.column(column).into_owned());
    for (ours, printed) in [
        (tcp.position * 1e3, [271.6, 746.1, 955.7]),
        (a * 1e3, [262.0, 719.8, -642.8]),
        // The printed n and s have the opposite sign of what eq. 3.5 gives.
        (n * 1e3, [-887.2, 441.7, 133.0]),
        (s * 1e3, [379.7, 535.5, 754.4]),
    ] {
        assert!((ours - Vector3::from(printed)).amax() <= 0.06, "{ours} against {printed:?}");
    }
}

#[test]
fn eq_3_5_is_the_product_of_the_matrices() {
    let robot = rx90(D6).unwrap();
    let mut random = fastrand::Rng::with_seed(35);
    for _ in 0..200 {
        let q = any_joints(&mut random);
        let [s1, s2, _, s4, s5, s6] = [0, 1, 2, 3, 4, 5].map(|i| q[i].sin());
        let [c1, c2, _, c4, c5, c6] = [0, 1, 2, 3, 4, 5].map(|i| q[i].cos());
        let (s23, c23) = (q[1] + q[2]).sin_cos();
        let n = Vector3::new(
            -s1 * (c4 * s6 + s4 * c5 * c6) - c1 * (c23 * (s4 * s6 - c4 * c5 * c6) + s23 * s5 * c6),
            c1 * (c4 * s6 + s4 * c5 * c6) - s1 * (c23 * (s4 * s6 - c4 * c5 * c6) + s23 * s5 * c6),
            s23 * (s4 * s6 - c4 * c5 * c6) - c23 * s5 * c6,
        );
        let s = Vector3::new(
            // Printed with + s4 c5 s6 in the first bracket: a misprint.
            -s1 * (c4 * c6 - s4 * c5 * s6) - c1 * (c23 * (s4 * c6 + c4 * c5 * s6) - s23 * s5 * s6),
            c1 * (c4 * c6 - s4 * c5 * s6) - s1 * (c23 * (s4 * c6 + c4 * c5 * s6) - s23 * s5 * s6),
            s23 * (s4 * c6 + c4 * c5 * s6) + c23 * s5 * s6,
        );
        let a = Vector3::new(
            c1 * (s23 * c5 + c23 * c4 * s5) - s1 * s4 * s5,
            s1 * (s23 * c5 + c23 * c4 * s5) + c1 * s4 * s5,
            c23 * c5 - s23 * c4 * s5,
        );
        let p = Vector3::new(
            c1 * (s23 * (D4 + D6 * c5) + A2 * s2 + D6 * c23 * c4 * s5) - D6 * s1 * s4 * s5,
            s1 * (s23 * (D4 + D6 * c5) + A2 * s2 + D6 * c23 * c4 * s5) + D6 * c1 * s4 * s5,
            D1 + c23 * (D4 + D6 * c5) + A2 * c2 - D6 * s23 * c4 * s5,
        );
        let tcp = forward::forward(&robot, &q);
        assert!((tcp.rotation - Matrix3::from_columns(&[n, s, a])).amax() < 1e-14);
        assert!((tcp.position - p).norm() < 1e-14);
    }
}

#[test]
fn eqs_3_35_to_3_40_are_the_jacobian() {
    let robot = rx90(D6).unwrap();
    let mut random = fastrand::Rng::with_seed(335);
    for _ in 0..200 {
        let q = any_joints(&mut random);
        let [s1, s2, _, s4, s5, _] = [0, 1, 2, 3, 4, 5].map(|i| q[i].sin());
        let [c1, c2, _, c4, c5, _] = [0, 1, 2, 3, 4, 5].map(|i| q[i].cos());
        let (s23, c23) = (q[1] + q[2]).sin_cos();
        let radial = s23 * (D4 + D6 * c5) + A2 * s2 + D6 * c23 * c4 * s5;
        let fore = c23 * (D4 + D6 * c5) - D6 * s23 * c4 * s5;
        let drop = -s23 * (D4 + D6 * c5) - D6 * c23 * c4 * s5;
        let printed = Matrix6::from_columns(&[
            [-s1 * radial - D6 * c1 * s4 * s5, c1 * radial - D6 * s1 * s4 * s5, 0.0, 0.0, 0.0, 1.0].into(),
            [c1 * (fore + A2 * c2), s1 * (fore + A2 * c2), drop - A2 * s2, -s1, c1, 0.0].into(),
            [c1 * fore, s1 * fore, drop, -s1, c1, 0.0].into(),
            // The x row of J4 is printed without its minus.
            [
                -D6 * s5 * (s1 * c4 + c1 * c23 * s4),
                D6 * s5 * (c1 * c4 - s1 * c23 * s4),
                D6 * s23 * s4 * s5,
                s23 * c1,
                s23 * s1,
                c23,
            ]
            .into(),
            [
                D6 * (c1 * c23 * c4 * c5 - c1 * s23 * s5 - s1 * s4 * c5),
                D6 * (s1 * c23 * c4 * c5 - s1 * s23 * s5 + c1 * s4 * c5),
                -D6 * (c23 * s5 + s23 * c4 * c5),
                -c1 * c23 * s4 - s1 * c4,
                -s1 * c23 * s4 + c1 * c4,
                s23 * s4,
            ]
            .into(),
            [
                0.0,
                0.0,
                0.0,
                c1 * s23 * c5 - s1 * s4 * s5 + c1 * c23 * c4 * s5,
                s1 * s23 * c5 + c1 * s4 * s5 + s1 * c23 * c4 * s5,
                c23 * c5 - s23 * c4 * s5,
            ]
            .into(),
        ]);
        assert!((jacobian::jacobian(&robot, &q) - printed).amax() < 1e-14);
    }
}

#[test]
fn table_3_3_second_row_is_the_other_shoulder() {
    let robot = rx90(D6).unwrap();
    let q = Joints::from([70.0, 20.0, 60.0, 0.0, 50.0, 100.0]).map(f64::to_radians);
    let solutions = inverse::inverse(&robot, &forward::forward(&robot, &q), &Joints::zeros()).unwrap();
    // Printed: theta1 = -110, theta2 = -20, theta3 = -60, theta4 = 0 and theta6 = -100 (under the
    // heading theta5) for the wrist that goes with theta4 = 0; theta6 is 100 - 180 = -80 there,
    // -100 is a slip of sign.
    let row = [-110.0, -20.0, -60.0, 0.0];
    let found = solutions
        .iter()
        .any(|s| row.iter().enumerate().all(|(i, deg)| (s.q[i].to_degrees() - deg).abs() < 1e-9));
    assert!(found, "{:?}", solutions.iter().map(|s| s.q.map(f64::to_degrees)).collect::<Vec<_>>());
}

#[test]
fn eq_4_7_mean_force() {
    let force = constant_force().force;
    // A job's tool has a right-hand helix, which pulls it out of its holder.
    let own = default_report().mean_force();
    assert!((own - Vector3::new(force.x, force.y, -force.z)).norm() < 1e-12 * own.norm());
    // Exact values to three decimals from the design; the thesis's digits carry its discretisation,
    // 1e-4 relative.
    for (ours, exact, printed) in
        [(force.x, 302.958, 302.9372), (force.y, 1071.887, 1071.9), (force.z, 509.296, 509.3078)]
    {
        close(ours, exact, 5e-4, "mean force");
        close(ours, printed, 1e-4 * printed, "mean force as printed");
    }
    // Closed form by hand for half immersion down milling: N a c / (2 pi) (k_tc/2 - k_rc pi/4),
    // (k_tc pi/4 + k_rc/2), k_ac.
    let scale = 4.0 * 10.0 * 0.1 / std::f64::consts::TAU;
    let quarter = std::f64::consts::FRAC_PI_4;
    close(force.x, scale * (1800.0 / 2.0 - 540.0 * quarter), 1e-9, "Fx by hand");
    close(force.y, scale * (1800.0 * quarter + 540.0 / 2.0), 1e-9, "Fy by hand");
    close(force.z, scale * 800.0, 1e-9, "Fz by hand");
}

#[test]
fn eq_4_15_zvd() {
    let impulses = default_report().setup().shaper.impulses();
    let printed = [(0.3344, 0.0), (0.4877, 0.1754), (0.1778, 0.3508)];
    assert_eq!(impulses.len(), 3);
    for (impulse, (amplitude, time)) in impulses.iter().zip(printed) {
        // Four decimals are printed.
        close(impulse.amplitude, amplitude, 6e-5, "amplitude");
        close(impulse.time, time, 6e-5, "time");
    }
}

#[test]
fn table_5_1_forward() {
    for ([q1, q2, q3, q5], printed) in TABLE_5_1 {
        let tip = forward::forward(&rx90(0.0).unwrap(), &Joints::from([q1, q2, q3, 0.0, q5, 0.0]));
        let printed = Vector3::from(printed);
        // Angles have four decimals: 5e-5 rad on 1.1 m.
        close((tip.position * 1e3 - printed).norm(), 0.0, 0.06, "point of Table 5.1");
        // A circle of 500 mm about the base, though the text says 300.
        close(printed.norm(), 500.0, 0.01, "distance from the base");
    }
}

#[test]
fn table_5_3_is_table_5_1_plus_table_5_2() {
    // Eq. 5.4 on the printed numbers: errors (Table 5.2) and corrected points (Table 5.3), in mm.
    // The tables print four decimals.
    let errors = [
        [0.4427, 1.8274, -0.1241],
        [0.4283, 1.8323, -0.1265],
        [0.4139, 1.8372, -0.1267],
        [0.3993, 1.8421, -0.1280],
        [0.3846, 1.8469, -0.1292],
        [0.3697, 1.8516, -0.1305],
        [0.3547, 1.8563, -0.1318],
        [0.3396, 1.8610, -0.1330],
    ];
    let corrected = [
        [42.9575, 421.3354, -268.8349],
        [38.8052, 422.3926, -267.8123],
        [34.6369, 423.4204, -266.7658],
        [30.4527, 424.4185, -265.6952],
        [26.2525, 425.3866, -264.6003],
        [22.0366, 426.3244, -263.4809],
        [17.8048, 427.2314, -262.3369],
        [13.5574, 428.1074, -261.1680],
    ];
    for (((_, desired), error), corrected) in TABLE_5_1.iter().zip(errors).zip(corrected) {
        for axis in 0..3 {
            // The z error of point 2 is a misprint (0.1254): its own neighbours and sum say so.
            let tolerance = if error[2] == -0.1265 && axis == 2 { 1.2e-3 } else { 1.1e-4 };
            close(desired[axis] + error[axis], corrected[axis], tolerance, "corrected point");
        }
    }
}

#[test]
fn section_5_2_under_the_thesis_s_constant_force() {
    // Recomputed values of the design; 0.5 % for forces, 3 % for shaping (they were computed with
    // another interpolation).
    let case = constant_force();
    let force = Statistics::from(case.deflection_only.statistics);
    close(force.mean, 1.060, 0.005 * 1.060, "mean by forces");
    close(force.max, 1.327, 0.005 * 1.327, "max by forces");
    close(Statistics::from(case.before.statistics).max, 1.26, 0.01 * 1.26, "max by both");
    let shaping = default_report().summary().before_mm.shaping;
    close(shaping.mean, 0.102, 0.03 * 0.102, "mean by shaping");
    close(shaping.mean, 0.104, 0.03 * 0.104, "mean by shaping");
    close(shaping.max, 0.180, 0.03 * 0.180, "max by shaping");
}

#[test]
fn the_default_job_before_compensation() {
    let before = default_report().summary().before_mm;
    // By an independent model: axial force of a right-hand helix, chip by speed, run-in. Printed with
    // two decimals.
    for (ours, expected, what) in [
        (before.both.mean, 1.10, "mean by both"),
        (before.both.max, 1.25, "max by both"),
        (before.deflection.mean, 1.13, "mean by forces"),
    ] {
        close(ours, expected, 0.005, what);
    }
    let force = default_report().mean_force();
    assert!((force - Vector3::new(302.958, 1071.887, -509.296)).amax() < 5e-4);
}

#[test]
fn section_5_4_after_compensation() {
    // Under the thesis's constant force.
    let case = &constant_force().compensation;
    let after = Statistics::from(case.result.statistics);
    assert!(case.converged && case.passes <= 5);
    assert!(after.mean <= 0.0005, "mean {}", after.mean);
    assert!(after.max <= 0.005, "max {}", after.max);
    assert!(case.history_max.windows(2).all(|pair| pair[1] < pair[0]), "each pass improves");

    // The default job's force sets in within 5 mm, faster than its shaped command can follow: 0.042
    // mm stay there, by an independent model, and nowhere else more than some micrometres.
    let report = default_report();
    let summary = report.summary();
    close(summary.after_mm.max, 0.042, 0.001, "max after");
    assert_eq!(summary.history_max_mm[0], summary.before_mm.both.max);
    assert!(summary.history_max_mm.windows(2).all(|pair| pair[1] < pair[0]), "each pass improves");
    let (run_in, after) = (column(report, "run_in"), column(report, "after_contour_error_mm"));
    let begun = run_in.iter().position(|w| *w == 1.0).unwrap();
    // The correction is back to that of a steady force two durations of the shaper later.
    let settled = begun + 2 * (report.plan.shaper().duration() / 0.001) as usize;
    let worst = after[settled..].iter().copied().fold(0.0, f64::max);
    assert!(worst < 0.003, "{worst} mm after the run-in");

    let max = |source| {
        let alone = default_report().alone(source);
        assert!(alone.converged);
        alone.history_max[alone.passes] * 1e3
    };
    assert!(max(Source::Shaping) <= 0.005);
    assert!(max(Source::Deflection) <= 0.005);
}

#[test]
fn the_after_figures_come_from_the_whole_model() {
    // Simulated once more by hand: the commanded joints, shaped, bent by C F, against the circle's
    // own equation.
    let report = default_report();
    let robot = &report.plan.robot;
    let shaped = report.plan.shaper().apply(&report.compensation.q, 0.001);
    let normal = Vector3::new(0.2, 0.3, 0.5).normalize();
    let mut worst = 0.0_f64;
    for (q, force) in shaped.iter().zip(report.force.iter()) {
        let c = armill::robot::compliance::cartesian_compliance(robot, q);
        let tip = forward::forward(robot, q).position + c.fixed_view::<3, 3>(0, 0) * force;
        let height = normal.dot(&tip);
        let radial = (tip - normal * height).norm() - 0.3;
        worst = worst.max(height.hypot(radial));
    }
    close(worst * 1e3, report.summary().after_mm.max, 1e-9, "max after, by the circle's equation");
}

#[test]
fn one_source_compensated_leaves_the_other() {
    let shaping = run(&[("compensation.sources", json!(["shaping"]))]);
    let sought = armill::deviation::Reference::along(&shaping.plan, Sources::ALL).without_force();
    assert!(
        sought.force.is_empty() && !sought.acting.deflection,
        "the force is not known to what is compensated"
    );
    let shaping = shaping.summary();
    close(shaping.after_mm.mean, shaping.before_mm.deflection.mean, 0.001, "forces are left");
    assert!(shaping.history_max_mm.last().unwrap() < &0.005);
    let none = run(&[("compensation.sources", json!([]))]).summary();
    assert_eq!((none.passes, none.after_mm), (0, none.before_mm.both));
}

#[test]
fn the_panel_says_what_differs() {
    let rows = rows(default_report()).unwrap();
    let differ: Vec<&str> = rows.iter().filter(|row| !row.agrees).map(|row| row.source).collect();
    assert_eq!(differ, ["chapter 6", "section 5.2", "Fig. 5.8", "Fig. 5.9", "Fig. 5.4", "sections 4.2, 5.2"]);
    assert!(rows.iter().all(|row| row.agrees || !row.reason.is_empty()), "every difference has its reason");
}

#[test]
fn the_default_job_warns() {
    let codes: Vec<&str> = default_report().warnings.iter().map(|warning| warning.code).collect();
    for code in ["joint-limit", "chip-load", "singularity-wrist", "plunge"] {
        assert!(codes.contains(&code), "{code} is missing from {codes:?}");
    }
}
