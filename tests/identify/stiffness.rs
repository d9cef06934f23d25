//! Joint compliances: the measured case of golden.json, synthetic data, intervals, and unobservable
//! joints.

use crate::common::{any_arm, any_joints, between, job_text};
use armill::identify::measurement::{Measurements, read};
use armill::identify::stiffness::{Fit, Verdict, equations, fit};
use armill::identify::{Convention, Measurement};
use armill::robot::compliance::cartesian_compliance;
use armill::robot::{Joints, Robot};
use armill::{Error, Job};
use nalgebra::{DMatrix, DVector, Matrix6, Vector6};
use serde_json::{Value, json};

const FANUC: &str = include_str!("../../web/examples/identify-fanuc-r2000ic.csv");

/// The robot of the measured example, with its tool.
pub(crate) fn fanuc() -> Robot {
    let example: Value =
        serde_json::from_str(include_str!("../../web/examples/identify-fanuc-r2000ic.json")).unwrap();
    let changes = ["robot", "tool_frame"].map(|key| (key, example[key].clone()));
    armill::setup::robot(&Job::from_json(&job_text(&changes)).unwrap()).unwrap()
}

fn measured() -> Measurements {
    read(FANUC, Convention::CoupledJ3).unwrap()
}

fn golden(id: &str) -> Value {
    let all: Value = serde_json::from_str(include_str!("../data/golden.json")).unwrap();
    all["cases"].as_array().unwrap().iter().find(|case| case["id"] == id).unwrap().clone()
}

/// The whole system A c = b.
fn system(robot: &Robot, rows: &[Measurement]) -> (DMatrix<f64>, DVector<f64>) {
    let all: Vec<_> = rows.iter().flat_map(|row| equations(robot, row)).collect();
    let a = DMatrix::from_fn(all.len(), 6, |i, j| all[i].0[j]);
    (a, DVector::from_fn(all.len(), |i, _| all[i].1))
}

#[test]
fn the_measured_case_of_the_golden_file() {
    let case = golden("fanuc_r2000ic_stiffness_identification_lsq");
    let (robot, rows) = (fanuc(), measured().rows);
    assert_eq!(rows.len(), 43);
    let fit = fit(&robot, &rows).unwrap();
    let near = |ours: f64, key: &Value| {
        let theirs = key.as_f64().unwrap();
        assert!((ours / theirs - 1.0).abs() < 1e-5, "{ours} against {theirs}");
    };
    for (i, compliance) in fit.compliance().into_iter().enumerate() {
        near(compliance, &case["expected"]["compliance_rad_per_Nm"][i]);
        near(1.0 / compliance, &case["expected"]["stiffness_Nm_per_rad"][i]);
        assert!(!fit.joints[i].at_zero);
    }
    near(fit.rms, &case["expected"]["residual_rms_m"]);
    let (a, _) = system(&robot, &rows);
    let singular = a.singular_values();
    near(singular.max() / singular.min(), &case["expected"]["cond"]);
    assert_eq!(fit.freedom, 3 * 43 - 6);
    // The file's own remark on the case: J6 is poorly conditioned.
    let inflated = fit.joints.iter().map(|joint| joint.interval.1 / joint.compliance).collect::<Vec<_>>();
    assert!((0..5).all(|i| inflated[i] < inflated[5]), "{inflated:?}");
}

#[test]
fn the_published_stiffnesses_err_as_the_golden_file_says() {
    let case = golden("fanuc_r2000ic_measured_vs_published_K");
    let robot = fanuc();
    let c = Vector6::from_fn(|i, _| 1.0 / case["inputs"]["K_Nm_per_rad"][i].as_f64().unwrap());
    let errors: Vec<f64> = measured()
        .rows
        .iter()
        .map(|row| {
            let parts = equations(&robot, row);
            let (left, all) = parts
                .iter()
                .fold((0.0, 0.0), |(left, all), (a, b)| (left + (b - a.dot(&c)).powi(2), all + b * b));
            (left / all).sqrt()
        })
        .collect();
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    assert!((mean - case["expected"]["mean_relative_error"].as_f64().unwrap()).abs() < 1e-4, "{mean}");
}

/// The fit by other means: singular values of the whole system for values and intervals, a refit
/// with each row left out.
#[test]
fn the_figures_agree_with_a_second_way() {
    let (robot, rows) = (fanuc(), measured().rows);
    let fit = fit(&robot, &rows).unwrap();
    let (a, b) = system(&robot, &rows);
    let solved = a.clone().svd(true, true).solve(&b, 0.0).unwrap();
    let residual = &b - &a * &solved;
    let variance = residual.norm_squared() / 123.0;
    let inverse = (a.transpose() * &a).try_inverse().unwrap();
    for (i, joint) in fit.joints.iter().enumerate() {
        assert!((joint.compliance / solved[i] - 1.0).abs() < 1e-9);
        // Student's t for 123 degrees of freedom, from a table.
        let half = 1.979439 * (variance * inverse[(i, i)]).sqrt();
        let (low, high) = joint.interval;
        assert!(
            (high - joint.compliance - half).abs() < 1e-5 * half
                && ((low + half - joint.compliance).abs() < 1e-5 * half || low == 0.0)
        );
        // The variance inflation is 1 / (1 - R^2) of the column on the others (uncentred).
        let others = a.clone().remove_column(i);
        let column = a.column(i).into_owned();
        let on_others = others.clone().svd(true, true).solve(&column, 0.0).unwrap();
        let apart = (&column - others * on_others).norm_squared() / column.norm_squared();
        assert!((joint.inflation * apart - 1.0).abs() < 1e-8, "{} {}", joint.inflation, 1.0 / apart);
        assert!((joint.shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
    let explained = 1.0 - residual.norm_squared() / b.norm_squared();
    assert!((fit.explained - explained).abs() < 1e-12);
    for left_out in [0, 17, 42] {
        let others: Vec<_> =
            rows.iter().enumerate().filter(|(k, _)| *k != left_out).map(|(_, row)| row.clone()).collect();
        let c = Vector6::from(super::stiffness::fit(&robot, &others).unwrap().compliance());
        let missed: f64 =
            equations(&robot, &rows[left_out]).iter().map(|(a, b)| (b - a.dot(&c)).powi(2)).sum();
        assert!((fit.rows[left_out].left_out / missed.sqrt() - 1.0).abs() < 1e-9);
    }
}

/// Rows that obey d = J C J^T W exactly, through the Cartesian compliance rather than the equations
/// of the fit.
fn synthetic(robot: &Robot, count: usize, random: &mut fastrand::Rng) -> Vec<Measurement> {
    (0..count)
        .map(|k| {
            let q = any_joints(random);
            let wrench =
                Vector6::from_fn(|i, _| between(random, -1.0, 1.0) * if i < 3 { 500.0 } else { 100.0 });
            let d = cartesian_compliance(robot, &q) * wrench;
            // Now and then an axis is not measured.
            let displacement = [0, 1, 2].map(|axis| (k % 4 != axis).then_some(d[axis]));
            Measurement { line: k + 1, q, wrench, displacement }
        })
        .collect()
}

#[test]
fn compliances_come_back_from_exact_data() {
    let mut random = fastrand::Rng::with_seed(5);
    for case in 0..60 {
        let arm = any_arm(&mut random);
        let rows = synthetic(&arm, 30, &mut random);
        let fit = fit(&arm, &rows).unwrap();
        for (i, joint) in fit.joints.iter().enumerate() {
            let truth = arm.compliance()[i];
            assert!(
                (joint.compliance - truth).abs() < 1e-9 * arm.compliance().amax(),
                "case {case}, joint {i}: {joint:?}, {truth}"
            );
        }
        assert!(fit.explained > 1.0 - 1e-12 && fit.relative().1 < 1e-6, "case {case}");
    }
}

#[test]
fn intervals_hold_the_truth_as_often_as_they_say() {
    let mut random = fastrand::Rng::with_seed(95);
    let robot = fanuc();
    let truth = [1.2e-6, 3.7e-7, 5.1e-7, 3.7e-6, 2.4e-6, 4.9e-6];
    // Twelve uniform numbers: a variance of one, nearly normal.
    let mut noise = || (0..12).map(|_| random.f64()).sum::<f64>() - 6.0;
    let rows = measured().rows;
    let clean: Vec<_> = rows
        .into_iter()
        .map(|mut row| {
            for (a, part) in equations(&robot, &row).into_iter().zip(0..3) {
                row.displacement[part] = Some(a.0.dot(&Vector6::from(truth)));
            }
            row
        })
        .collect();
    let (mut within, mut ratio) = ([0; 6], 0.0);
    let runs = 1500;
    for _ in 0..runs {
        let mut rows = clean.clone();
        for row in &mut rows {
            row.displacement = row.displacement.map(|d| d.map(|d| d + 2e-5 * noise()));
        }
        let fit = fit(&robot, &rows).unwrap();
        ratio += (fit.deviation / 2e-5).powi(2) / f64::from(runs);
        for (i, joint) in fit.joints.iter().enumerate() {
            within[i] += usize::from((joint.interval.0..=joint.interval.1).contains(&truth[i]));
        }
    }
    // 95 % of 1500 within four binomial standard deviations.
    assert!(within.iter().all(|n| (1391..=1459).contains(n)), "{within:?}");
    assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
}

/// The covariance against the scatter of many fits, and against the inverse of A^T A.
#[test]
fn the_covariance_is_that_of_repeated_measurements() {
    let mut random = fastrand::Rng::with_seed(15);
    let robot = fanuc();
    let truth = Vector6::from([1.2e-6, 3.7e-7, 5.1e-7, 3.7e-6, 2.4e-6, 4.9e-6]);
    let mut noise = || (0..12).map(|_| random.f64()).sum::<f64>() - 6.0;
    let clean = measured().rows;
    let (runs, mut all, mut stated) = (1500, Vec::new(), Matrix6::zeros());
    for _ in 0..runs {
        let mut rows = clean.clone();
        for row in &mut rows {
            for (a, part) in equations(&robot, row).into_iter().zip(0..3) {
                row.displacement[part] = Some(a.0.dot(&truth) + 2e-6 * noise());
            }
        }
        let fit = fit(&robot, &rows).unwrap();
        let covariance = fit.covariance.unwrap();
        // As wide as the intervals say.
        for (i, joint) in fit.joints.iter().enumerate() {
            let half = (joint.interval.1 - joint.interval.0) / 2.0;
            assert!((1.959964 * covariance[i][i].sqrt() / half - 1.0).abs() < 1e-6, "joint {i}");
        }
        stated += Matrix6::from_fn(|i, j| covariance[i][j]) / f64::from(runs);
        all.push(Vector6::from(fit.compliance()));
    }
    let mean: Vector6<f64> = all.iter().sum::<Vector6<f64>>() / f64::from(runs);
    let scatter: Matrix6<f64> =
        all.iter().map(|c| (c - mean) * (c - mean).transpose()).sum::<Matrix6<f64>>() / f64::from(runs - 1);
    let (a, _) = system(&robot, &clean);
    let inverse = (a.transpose() * &a).try_inverse().unwrap() * 4e-12;
    // Student's t of 123 degrees of freedom is 1 % wider than the normal; 1500 fits scatter by 4 %.
    for i in 0..6 {
        for j in 0..6 {
            let size = (scatter[(i, i)] * scatter[(j, j)]).sqrt();
            let (found, exact) = (scatter[(i, j)], inverse[(i, j)]);
            assert!((stated[(i, j)] - found).abs() < 0.15 * size, "{i} {j}: {} {found}", stated[(i, j)]);
            assert!((stated[(i, j)] - exact).abs() < 0.04 * size, "{i} {j}: {} {exact}", stated[(i, j)]);
        }
    }
}

/// What the fit says of its compliances is what a job with them is as sure of.
#[test]
fn a_job_takes_over_what_was_identified() {
    let (robot, measured) = (fanuc(), measured());
    let fit = fit(&robot, &measured.rows).unwrap();
    let summary = armill::identify::summary::stiffness(&robot, &measured, &fit);
    let covariance = summary.compliance_covariance.unwrap();
    let example: Value =
        serde_json::from_str(include_str!("../../web/examples/identify-fanuc-r2000ic.json")).unwrap();
    let mut changes =
        ["robot", "tool_frame", "workpiece_frame"].map(|key| (key, example[key].clone())).to_vec();
    changes[0].1["joint_compliance_rad_per_nm"] = json!(summary.joint_compliance_rad_per_nm);
    changes.push(("uncertainty", json!({ "compliance_covariance": covariance })));
    changes.push(("motion.sample_time_s", json!(0.02)));
    let report = armill::run_json(&job_text(&changes), &mut armill::Progress::none()).unwrap();
    assert_eq!(report.how_sure().stiffness, "from the covariance of an identification");
    let joints = report.band.shares.iter().filter(|share| share.input.starts_with("joint"));
    assert!(joints.map(|share| share.share).sum::<f64>() > 0.0);
}

fn verdicts(fit: &Fit) -> [Verdict; 6] {
    fit.joints.each_ref().map(|joint| joint.verdict)
}

#[test]
fn joints_that_the_loads_do_not_turn_are_named() {
    let mut random = fastrand::Rng::with_seed(3);
    let robot = armill::setup::robot(&Job::default()).unwrap();
    // Tip on axis 6 and no moment: joint 6 is never loaded.
    let mut rows = synthetic(&robot, 30, &mut random);
    for row in &mut rows {
        let force = Vector6::from_fn(|i, _| if i < 3 { row.wrench[i] } else { 0.0 });
        let d = cartesian_compliance(&robot, &row.q) * force;
        (row.wrench, row.displacement) = (force, [Some(d[0]), Some(d[1]), Some(d[2])]);
    }
    let all = fit(&robot, &rows).unwrap();
    assert_eq!(verdicts(&all)[5], Verdict::Unloaded);
    assert_eq!(all.joints[5].interval, (0.0, f64::INFINITY));
    assert!(all.condition.is_infinite());
    assert_eq!(verdicts(&all)[..5], [Verdict::Known; 5]);

    // One posture, one direction: only one sum is observable, and no claim is made about any single
    // joint.
    let one: Vec<_> = (1..=8)
        .map(|k| {
            let mut row = rows[0].clone();
            row.wrench *= f64::from(k);
            row.displacement = row.displacement.map(|d| d.map(|d| d * f64::from(k)));
            row
        })
        .collect();
    let poor = fit(&robot, &one).unwrap();
    assert!(verdicts(&poor)[..5].contains(&Verdict::Confounded));
    assert!(poor.covariance.is_none());
    for joint in poor.joints.iter().filter(|joint| joint.verdict == Verdict::Confounded) {
        assert!(joint.interval.1.is_infinite() && !joint.mixed_with.is_empty());
    }
}

#[test]
fn a_joint_that_the_data_would_make_negative_is_held_at_zero() {
    let mut random = fastrand::Rng::with_seed(8);
    let robot = fanuc();
    let mut rows = measured().rows;
    let truth = Vector6::new(1.2e-6, 3.7e-7, 5.1e-7, 0.0, 2.4e-6, 4.9e-6);
    let (mut held, mut small) = (0, 0);
    for _ in 0..40 {
        for row in &mut rows {
            for (k, (a, _)) in equations(&robot, row).into_iter().enumerate() {
                row.displacement[k] = Some(a.dot(&truth) + 2e-5 * between(&mut random, -1.0, 1.0));
            }
        }
        let fit = fit(&robot, &rows).unwrap();
        let joint = &fit.joints[3];
        assert!(joint.interval.1 < 3e-6, "{joint:?}");
        small += usize::from(joint.verdict == Verdict::Small && joint.interval.0 == 0.0);
        held += usize::from(joint.at_zero && joint.compliance == 0.0);
    }
    // One in forty lies above its interval by chance.
    assert!(small >= 36 && (10..=30).contains(&held), "{small} small, {held} held of 40");
}

#[test]
fn too_little_is_refused() {
    let robot = fanuc();
    let rows = measured().rows;
    for few in [&rows[..0], &rows[..2]] {
        let Err(Error::Invalid { field, expected, .. }) = fit(&robot, few) else { panic!("accepted") };
        assert!(field == "measurements" && expected.contains("seven"));
    }
    let mut idle = rows;
    for row in &mut idle {
        row.wrench.fill(0.0);
    }
    assert!(fit(&robot, &idle).is_err());
    assert_eq!(Convention::CoupledJ3.joints(Joints::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0))[2], 5.0);
}

/// 25 rows of exact springs with 5 um of noise, and each obvious mistake: it is named, with what springs explain without it.
#[test]
fn obvious_mistakes_are_tried_and_named() {
    let robot = fanuc();
    let mut random = fastrand::Rng::with_seed(31);
    let compliance = [1.2e-6, 4e-7, 6e-7, 4e-6, 3e-6, 8e-6];
    let exact: Vec<Measurement> = (0..25)
        .map(|line| {
            let q = Joints::from_fn(|_, _| between(&mut random, -1.2, 1.2));
            let wrench =
                Vector6::from_fn(|i, _| if i < 3 { between(&mut random, -2000.0, 2000.0) } else { 0.0 });
            let row = Measurement { line, q, wrench, displacement: [Some(0.0); 3] };
            let parts = equations(&robot, &row);
            let moved = |(a, _): &(Vector6<f64>, f64)| a.dot(&Vector6::from(compliance));
            let displacement =
                std::array::from_fn(|axis| Some(moved(&parts[axis]) + between(&mut random, -8e-6, 8e-6)));
            Measurement { displacement, ..row }
        })
        .collect();
    let said = |change: &dyn Fn(&mut Measurement)| {
        let mut rows = exact.clone();
        rows.iter_mut().for_each(change);
        let found = fit(&robot, &rows).unwrap();
        let measurements = Measurements { rows, remarks: vec![] };
        armill::identify::summary::stiffness(&robot, &measurements, &found).remarks.join("\n")
    };
    assert_eq!(said(&|_| ()), "");
    let turned = said(&|row| row.wrench = -row.wrench);
    assert!(
        turned.contains("poor fit") && turned.contains("with forces turned round, springs explain"),
        "{turned}"
    );
    let swapped =
        said(&|row| row.q = Joints::new(row.q[0], row.q[1], row.q[2], row.q[5], row.q[4], row.q[3]));
    assert!(swapped.contains("with joints 4 and 6 swapped"), "{swapped}");
    let radians = said(&|row| row.q *= std::f64::consts::PI / 180.0);
    assert!(radians.contains("with joint angles in radians"), "{radians}");
    let signs = said(&|row| {
        row.q[1] = -row.q[1];
        row.q[4] = -row.q[4];
    });
    assert!(signs.contains("with joints 2, 5 counted the other way"), "{signs}");
    let flange = said(&|row| {
        let turn = armill::robot::forward::frames(&robot, &row.q)[5].rotation.transpose();
        let force = turn * row.wrench.fixed_rows::<3>(0);
        row.wrench.fixed_rows_mut::<3>(0).copy_from(&force);
        let moved = turn * nalgebra::Vector3::from(row.displacement.map(|v| v.unwrap()));
        row.displacement = [Some(moved.x), Some(moved.y), Some(moved.z)];
    });
    assert!(flange.contains("with forces and displacements in the flange frame"), "{flange}");
    let metres = said(&|row| row.displacement = row.displacement.map(|v| v.map(|v| v * 1e-3)));
    assert!(metres.contains("stiffer than those of any arm"), "{metres}");
    // Real data keep their own remarks only.
    let measured = measured();
    let found = fit(&robot, &measured.rows).unwrap();
    assert_eq!(armill::identify::summary::stiffness(&robot, &measured, &found).remarks, measured.remarks);
}
