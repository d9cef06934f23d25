//! Kinematics and compliance against published cases (tests/data/golden.json) and against their own
//! definitions.
#![allow(clippy::disallowed_types, reason = "quaternions by another library, compared within a tolerance")]

use crate::common::{self, any_arm, any_joints, any_vector};
use armill::math::Pose;
use armill::robot::inverse::{Branch, Margin, Solution, inverse};
use armill::robot::{Joints, Link, Opw, Robot, compliance, forward, jacobian, library};
use nalgebra::{Matrix6, Quaternion, UnitQuaternion, Vector3, Vector6};
use serde_json::Value;
use std::f64::consts::{PI, TAU};

fn golden(kind: &str) -> Vec<Value> {
    let all: Value = serde_json::from_str(include_str!("data/golden.json")).unwrap();
    all["cases"].as_array().unwrap().iter().filter(|case| case["kind"] == kind).cloned().collect()
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    let list: Vec<f64> = value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    list.try_into().unwrap()
}

/// An arm by ortho-parallel parameters as golden.json prints them (metres); joint values are the
/// maker's own.
fn ortho_parallel(opw: &Value) -> Robot {
    let keys = ["a1", "a2", "b", "c1", "c2", "c3", "c4"];
    let opw = Opw {
        lengths_mm: keys.map(|key| opw[key].as_f64().unwrap() * 1e3),
        joint_sign: numbers(&opw["joint_sign"]),
        joint_offset_deg: numbers(&opw["joint_offset_deg"]),
    };
    Robot::new("ortho-parallel", opw.links(), None, [0.0; 6]).unwrap()
}

#[test]
fn published_poses_and_all_their_solutions() {
    let cases = golden("fk_ik");
    assert_eq!(cases.len(), 6, "no case gets lost");
    for case in cases {
        let opw = &case["inputs"]["opw"];
        let robot = ortho_parallel(opw);
        let joints = |q: &Value| Joints::from(numbers::<6>(q)).map(f64::to_radians);
        let tcp = forward::forward(&robot, &joints(&case["inputs"]["joints_deg"]));
        let position = Vector3::from(numbers::<3>(&case["expected"]["position_m"]));
        let [x, y, z, w] = numbers::<4>(&case["expected"]["quaternion"]);
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix();
        // The record: position 1e-5 m, angles 1e-4 deg.
        assert!((tcp.position - position).norm() < 1e-5, "{}", case["id"]);
        assert!((tcp.rotation - rotation.matrix()).norm() < 1e-5, "{}", case["id"]);

        let solutions = inverse(&robot, &tcp, &Joints::zeros()).unwrap();
        let expected = case["expected"]["ik_solutions_deg"].as_array().unwrap();
        assert_eq!(solutions.iter().count(), expected.len(), "number of solutions of {}", case["id"]);
        for printed in expected {
            let wanted = joints(printed);
            let apart = |s: &Joints| {
                (s - wanted).iter().map(|d| (d - TAU * (d / TAU).round()).abs()).fold(0.0, f64::max)
            };
            let nearest = solutions.iter().map(|s| apart(&s.q)).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-4_f64.to_radians(), "{}: {printed} is {nearest} rad away", case["id"]);
        }
    }
}

#[test]
fn published_pose_and_jacobian_of_a_milling_robot() {
    for case in golden("fk_jacobian").into_iter().filter(|case| case["robot"].is_string()) {
        let rows = case["inputs"]["dh"]["rows_offset_deg_d_a_alpha_deg"].as_array().unwrap();
        let rows: Vec<[f64; 4]> = rows.iter().map(numbers).collect();
        let base = case["inputs"]["dh"]["base_z_m"].as_f64().unwrap();
        // Standard DH keeps a and alpha after the joint, modified DH before it.
        let links: [Link; 6] = std::array::from_fn(|i| Link {
            alpha: if i == 0 { 0.0 } else { rows[i - 1][3].to_radians() },
            a: if i == 0 { 0.0 } else { rows[i - 1][2] },
            d: rows[i][1] + if i == 0 { base } else { 0.0 },
            theta_offset: rows[i][0].to_radians(),
            sign: 1.0,
        });
        let flange = Pose::from_xyz_rpy(Vector3::zeros(), [rows[5][3].to_radians(), 0.0, 0.0]);
        let robot = Robot::new("KR210", links, None, [0.0; 6]).unwrap().with_tool(flange);
        let q = Joints::from(numbers::<6>(&case["inputs"]["dh"]["q_deg"])).map(f64::to_radians);
        let tcp = forward::forward(&robot, &q);
        let j = jacobian::jacobian(&robot, &q);
        for row in 0..3 {
            let t: [f64; 4] = numbers(&case["expected"]["T06"][row]);
            let ours =
                [tcp.rotation[(row, 0)], tcp.rotation[(row, 1)], tcp.rotation[(row, 2)], tcp.position[row]];
            assert!(ours.iter().zip(t).all(|(ours, t)| (ours - t).abs() < 1e-6), "row {row} of T: {ours:?}");
        }
        for row in 0..6 {
            let expected: [f64; 6] = numbers(&case["expected"]["J_base_6x6"][row]);
            for (ours, printed) in j.row(row).iter().zip(expected) {
                // Six decimals are printed.
                assert!((ours - printed).abs() < 2e-6, "row {row} of J: {ours} against {printed}");
            }
        }
    }
}

#[test]
fn compliance_of_a_measured_robot() {
    for case in golden("compliance_validation_measured") {
        let rows: Vec<[f64; 4]> =
            case["inputs"]["mdh_alpha_a_theta0_d"].as_array().unwrap().iter().map(numbers).collect();
        let links: [Link; 6] = std::array::from_fn(|i| {
            let [alpha, a, theta_offset, d] = rows[i];
            Link { alpha, a, d, theta_offset, sign: 1.0 }
        });
        let tcp = Vector3::from(numbers::<3>(&case["inputs"]["tcp_offset_in_flange_m"]));
        let stiffness: [f64; 6] = numbers(&case["inputs"]["K_Nm_per_rad"]);
        let robot = Robot::new("R-2000iC", links, None, stiffness.map(|k| 1.0 / k))
            .unwrap()
            .with_tool(Pose::from_xyz_rpy(tcp, [0.0; 3]));
        // First row of the measurement: pendant angles [rad] and force [N] (source in golden.json).
        let [q1, q2, q3, q4, q5, q6] =
            [-1.047040472, -0.291347812, -0.504923753, 0.066113072, -1.098335698, 2.529313699];
        let q = Joints::from([q1, q2, -(q2 + q3), -q4, -q5, -q6]);
        let wrench = Vector6::new(-120.2110768, -78.21523168, -14.69090881, 0.0, 0.0, 0.0);
        let moved = compliance::cartesian_compliance(&robot, &q) * wrench;
        let expected = Vector3::from(numbers::<3>(&case["expected"]["predicted_dx_first_row_m"]));
        // The record: 1e-4 relative.
        assert!((moved.fixed_rows::<3>(0) - expected).norm() < 1e-4 * expected.norm(), "{moved}");
    }
}

#[test]
fn jacobian_is_the_derivative_of_the_forward_model() {
    let mut random = fastrand::Rng::with_seed(1);
    for _ in 0..500 {
        let robot = any_arm(&mut random);
        let q = any_joints(&mut random);
        let j = jacobian::jacobian(&robot, &q);
        let h = 1e-6;
        for i in 0..6 {
            let moved = |step: f64| {
                let mut q = q;
                q[i] += step;
                forward::forward(&robot, &q)
            };
            let (plus, minus) = (moved(h), moved(-h));
            let v = (plus.position - minus.position) / (2.0 * h);
            // Rotation velocity: the vector of dR R^T.
            let spin = (plus.rotation - minus.rotation) / (2.0 * h)
                * forward::forward(&robot, &q).rotation.transpose();
            let w = Vector3::new(spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]);
            // Central differences: h^2 plus rounding 1e-16/h.
            assert!((j.fixed_view::<3, 1>(0, i) - v).norm() < 1e-8, "v of joint {}", i + 1);
            assert!((j.fixed_view::<3, 1>(3, i) - w).norm() < 1e-8, "omega of joint {}", i + 1);
        }
    }
}

#[test]
fn inverse_then_forward_is_the_identity_on_all_branches() {
    let mut random = fastrand::Rng::with_seed(2);
    let mut seen = [0_u32; 8];
    for _ in 0..2000 {
        let robot = any_arm(&mut random);
        let q = any_joints(&mut random);
        let tcp = forward::forward(&robot, &q);
        let solutions = inverse(&robot, &tcp, &q).unwrap();
        for solution in solutions.iter() {
            let reached = forward::forward(&robot, &solution.q);
            // The inverse carries sines and cosines and computes angles only at the end: the
            // difference is rounding, which grows near a singularity.
            let Margin { shoulder, elbow, wrist } = solution.margin;
            let rounding = 1e-13 / shoulder.min(elbow).min(wrist).clamp(1e-4, 1.0);
            assert!((reached.position - tcp.position).norm() < rounding, "{:?}", solution.margin);
            assert!((reached.rotation - tcp.rotation).norm() < rounding, "{:?}", solution.margin);
            assert!((reached.position - tcp.position).norm() < 1e-9);
            assert!((reached.rotation - tcp.rotation).norm() < 1e-9);
            let Branch { front, elbow_positive, wrist_positive } = solution.branch;
            seen[4 * usize::from(front) + 2 * usize::from(elbow_positive) + usize::from(wrist_positive)] += 1;
        }
        // The original joint values are among the solutions; near a singularity they are ill
        // defined, the pose is not.
        let (apart, margin) = solutions
            .iter()
            .map(|s| ((s.q - q).amax(), s.margin.elbow.min(s.margin.wrist).min(s.margin.shoulder)))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap();
        assert!(apart < 1e-9 / margin.max(1e-6), "nearest solution is {apart} rad away, margin {margin}");
    }
    assert!(seen.iter().all(|&count| count > 500), "every branch is met: {seen:?}");
}

#[test]
fn up_to_eight_different_solutions() {
    let robot = common::rx90();
    let q = Joints::from([0.4, 0.5, 1.2, 0.7, 0.8, -0.3]);
    let solutions = inverse(&robot, &forward::forward(&robot, &q), &Joints::zeros()).unwrap();
    let all: Vec<Joints> = solutions.iter().map(|s| s.q).collect();
    assert_eq!(all.len(), 8);
    for (i, a) in all.iter().enumerate() {
        for b in &all[..i] {
            assert!((a - b).amax() > 1e-3, "two solutions are the same");
        }
    }
    let order = |s: &Solution| [s.branch.front, s.branch.elbow_positive, s.branch.wrist_positive];
    let binary = |k: usize| [4, 2, 1].map(|bit| k & bit == 0);
    assert!(solutions.iter().map(order).eq((0..8).map(binary)), "front first, then elbow, then wrist");
}

#[test]
fn a_wrist_centre_on_axis_1_is_reached() {
    // Straight above the shoulder, where the arm may face any way.
    let robot = common::rx90();
    let tcp = Pose::from_xyz_rpy(Vector3::new(0.0, 0.0, 0.42 + 0.8 + 0.085), [0.0; 3]);
    let solutions = inverse(&robot, &tcp, &Joints::zeros()).unwrap();
    assert!(solutions.iter().count() >= 4, "both elbows, both wrists");
    for solution in solutions.iter() {
        assert!((forward::forward(&robot, &solution.q).position - tcp.position).norm() < 1e-12);
        assert!(solution.margin.shoulder < 1e-12);
        // The law of cosines: 0.8^2 = 0.45^2 + 0.65^2 + 2 0.45 0.65 cos(q3).
        assert!((armill::math::cos(solution.q[2]) - 0.015 / 0.585).abs() < 1e-12);
    }
}

#[test]
fn a_stretched_arm_is_still_within_reach() {
    let robot = common::rx90();
    for q2 in [0.0, 0.4, 1.0, -0.7] {
        let tcp = forward::forward(&robot, &Joints::from([0.3, q2, 0.0, 0.2, 0.5, 0.1]));
        let solutions = inverse(&robot, &tcp, &Joints::zeros()).unwrap();
        // The reach falls by the square of the elbow's angle: 1e-16 m of rounding is 3e-8 rad.
        assert!(solutions.iter().all(|s| s.margin.elbow < 1e-6 && s.q[2].abs() < 1e-6), "at {q2}");
    }
}

#[test]
fn an_arm_beside_axis_1_does_not_reach_it() {
    let robot = library::robot("staubli-tx90").unwrap();
    assert_eq!(
        (robot.opw.lengths_mm[2], robot.opw.lengths_mm[3]),
        (50.0, 478.0),
        "beside axis 1, and the shoulder's height"
    );
    let robot = Robot::new("TX90", robot.links(), None, [0.0; 6]).unwrap();
    let place = |x: f64| Pose::from_xyz_rpy(Vector3::new(x, 0.0, 0.478 + 0.7), [0.0; 3]);
    assert!(inverse(&robot, &place(0.051), &Joints::zeros()).is_ok());
    match inverse(&robot, &place(0.03), &Joints::zeros()) {
        Err(armill::Error::Unreachable { distance, reach_min, .. }) => {
            assert!((distance - 0.03).abs() < 1e-12 && (reach_min - 0.05).abs() < 1e-12);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn wrist_singularity_keeps_joint_4_and_still_closes() {
    let robot = common::rx90();
    let mut random = fastrand::Rng::with_seed(3);
    for bend in [0.0, 1e-13, 1e-11, 1e-9, 1e-6] {
        for _ in 0..50 {
            let mut q = any_joints(&mut random);
            q[4] = bend;
            let tcp = forward::forward(&robot, &q);
            let solutions = inverse(&robot, &tcp, &q).unwrap();
            let nearest = solutions.nearest(&q).unwrap();
            let reached = forward::forward(&robot, &nearest.q);
            assert!((reached.rotation - tcp.rotation).norm() < 1e-9, "bend {bend}");
            if bend == 0.0 {
                assert!((nearest.q - q).amax() < 1e-7, "joint 4 stays where it was");
            }
        }
    }
}

#[test]
fn compliance_is_symmetric_positive_and_keeps_the_work() {
    let mut random = fastrand::Rng::with_seed(4);
    for _ in 0..500 {
        let robot = any_arm(&mut random);
        let q = any_joints(&mut random);
        let c = compliance::cartesian_compliance(&robot, &q);
        assert!((c - c.transpose()).amax() <= 1e-15 * c.amax(), "symmetric");
        let least = c.symmetric_eigenvalues().min();
        assert!(least > -1e-14 * c.amax(), "positive semidefinite, least eigenvalue {least}");

        // Eqs. 3.46, 3.47: F^T C F = tau^T C_theta tau with tau = J^T F.
        let wrench = Vector6::from_fn(|_, _| common::between(&mut random, -1000.0, 1000.0));
        let tau = jacobian::jacobian(&robot, &q).transpose() * wrench;
        let joint_work = (Matrix6::from_diagonal(robot.compliance()) * tau).dot(&tau);
        let work = wrench.dot(&(c * wrench));
        assert!(
            (work - joint_work).abs() < 1e-12 * joint_work.max(1e-12),
            "work {work} against {joint_work}"
        );

        // Independently for eq. 3.49: turn each joint by c_i tau_i in the forward model itself, and
        // take the chord.
        let scale = 1e-6;
        let turned = q + robot.compliance().component_mul(&tau) * scale;
        let chord =
            (forward::forward(&robot, &turned).position - forward::forward(&robot, &q).position) / scale;
        let moved = (c * wrench).fixed_rows::<3>(0).into_owned();
        assert!((chord - moved).norm() < 1e-6 * moved.norm().max(1e-3), "{chord} against {moved}");
    }
}

#[test]
fn out_of_reach_is_refused_with_distance_and_reach() {
    let robot = common::rx90();
    let far = Pose { position: Vector3::new(1.5, 0.3, 0.4), ..forward::forward(&robot, &Joints::zeros()) };
    match inverse(&robot, &far, &Joints::zeros()) {
        Err(armill::Error::Unreachable { distance, reach_min, reach_max, .. }) => {
            // Shoulder at (0, 0, 0.42), wrist 0.085 below the TCP.
            let expected: f64 = Vector3::new(1.5, 0.3, 0.4 - 0.085 - 0.42).norm();
            assert!((distance - expected).abs() < 1e-12);
            assert!((reach_max - 1.1).abs() < 1e-12 && (reach_min - 0.2).abs() < 1e-12);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn tables_outside_the_family_are_named_by_row() {
    let rx90 = *common::rx90().links();
    let bent = |row: usize, change: &dyn Fn(&mut Link)| {
        let mut links = rx90;
        change(&mut links[row]);
        Robot::new("bent", links, None, [0.0; 6])
    };
    let field = |row: usize, change: &dyn Fn(&mut Link)| {
        bent(row, change).unwrap().closed_form().unwrap_err().field().unwrap().to_owned()
    };
    assert_eq!(field(1, &|l| l.alpha = 1.0), "robot.modified_dh[1].alpha_deg");
    assert_eq!(field(2, &|l| l.alpha = PI / 2.0), "robot.modified_dh[2].alpha_deg");
    assert_eq!(field(4, &|l| l.a = 0.1), "robot.modified_dh[4].a_mm");
    assert_eq!(field(4, &|l| l.d = 0.1), "robot.modified_dh[4].d_mm");
    assert_eq!(field(5, &|l| l.a = -0.1), "robot.modified_dh[5].a_mm");
    assert_eq!(field(2, &|l| l.a = 0.0), "robot.modified_dh[2].a_mm");
    assert_eq!(field(3, &|l| l.d = 0.0), "robot.modified_dh[3].d_mm");
    // Errors state values in the table's units, with whole turns kept.
    let said = |row: usize, change: &dyn Fn(&mut Link)| {
        bent(row, change).unwrap().closed_form().unwrap_err().to_string()
    };
    assert!(said(1, &|l| l.alpha = 400_f64.to_radians()).contains("400"));
    assert!(said(4, &|l| l.a = 0.125).contains(" 125"));
    assert!(said(2, &|l| l.a = 5e-7).contains("0.0005"));
    assert!(said(3, &|l| l.d = 5e-7).contains("0.0005"));
    let refused =
        |row: usize, change: &dyn Fn(&mut Link)| bent(row, change).unwrap_err().field().unwrap().to_owned();
    assert_eq!(refused(3, &|l| l.sign = 0.5), "robot.modified_dh[3].joint_sign");
    assert_eq!(refused(0, &|l| l.d = f64::NAN), "robot.modified_dh[0].d_mm");
}

#[test]
fn any_vector_is_bounded() {
    // The generator itself: a faulty one would make the tests above meaningless.
    let mut random = fastrand::Rng::with_seed(5);
    let longest = (0..1000).map(|_| any_vector(&mut random, 0.3).amax()).fold(0.0, f64::max);
    assert!(longest <= 0.3 && longest > 0.29);
}
