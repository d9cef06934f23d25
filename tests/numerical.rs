//! The numerical inverse against the closed form, against the forward model of published arms, and
//! along a path.
#![allow(clippy::disallowed_types, clippy::disallowed_methods, reason = "compared within tolerances")]
#![allow(clippy::print_stdout, reason = "quantiles are worth seeing: cargo test -- --nocapture")]

use crate::common::{any_arm, any_joints, refused, run, rx90};
use armill::math::Pose;
use armill::robot::inverse::{Margin, inverse};
use armill::robot::{Joints, Link, Robot, forward};
use nalgebra::Vector3;
use serde_json::{Value, json};
use std::f64::consts::{FRAC_PI_2, TAU};

/// a, d [m] and alpha of the standard Denavit-Hartenberg rows that Universal Robots publishes ("DH
/// Parameters for calculations of kinematics and dynamics", universal-robots.com, article 45257).
const ALPHA: [f64; 6] = [FRAC_PI_2, 0.0, 0.0, FRAC_PI_2, -FRAC_PI_2, 0.0];
const UR5: [[f64; 6]; 2] =
    [[0.0, -0.425, -0.39225, 0.0, 0.0, 0.0], [0.089159, 0.0, 0.0, 0.10915, 0.09465, 0.0823]];
const UR10: [[f64; 6]; 2] =
    [[0.0, -0.612, -0.5723, 0.0, 0.0, 0.0], [0.1273, 0.0, 0.0, 0.163941, 0.1157, 0.0922]];

/// Standard rows keep a and alpha after the joint, modified ones before it.
fn modified([a, d]: [[f64; 6]; 2]) -> [Link; 6] {
    std::array::from_fn(|i| {
        let (alpha, a) = if i == 0 { (0.0, 0.0) } else { (ALPHA[i - 1], a[i - 1]) };
        Link { alpha, a, d: d[i], theta_offset: 0.0, sign: 1.0 }
    })
}

fn universal(table: [[f64; 6]; 2]) -> Robot {
    Robot::new("UR", modified(table), None, [0.0; 6]).unwrap()
}

/// Largest difference of two sets of joint values, modulo whole turns.
fn apart(a: &Joints, b: &Joints) -> f64 {
    (a - b).iter().map(|d| (d - TAU * (d / TAU).round()).abs()).fold(0.0, f64::max)
}

fn quantiles(mut errors: Vec<f64>) -> [f64; 3] {
    errors.sort_by(f64::total_cmp);
    let at = |share: f64| errors[((errors.len() - 1) as f64 * share) as usize];
    [at(0.75), at(0.99), at(1.0)]
}

#[test]
fn both_inverses_agree_on_arms_of_the_family() {
    let mut random = fastrand::Rng::with_seed(51);
    let (mut angles, mut missed, mut all) = (Vec::new(), 0, 0);
    for _ in 0..60 {
        // A tilted base: the same arm, but axis 1 is not vertical, which the closed form rejects.
        let closed = any_arm(&mut random);
        let tilt = Pose::from_xyz_rpy(Vector3::zeros(), [0.5, 0.0, 0.0]);
        let mut links = *closed.links();
        links[0].alpha += 0.5;
        let tilted = Robot::new("tilted", links, None, [0.0; 6]).unwrap().with_tool(*closed.tool());
        assert!(closed.closed_form().is_ok() && tilted.closed_form().is_err());
        let tcp = forward::forward(&closed, &any_joints(&mut random));
        let expected = inverse(&closed, &tcp, &Joints::zeros()).unwrap();
        let found = inverse(&tilted, &tilt.compose(&tcp), &Joints::zeros()).unwrap();
        for solution in expected.iter() {
            let margin = solution.margin.elbow.min(solution.margin.wrist).min(solution.margin.shoulder);
            if margin < 0.05 {
                continue;
            }
            all += 1;
            let Some(same) = found.iter().find(|other| apart(&other.q, &solution.q) < 1e-6) else {
                missed += 1;
                continue;
            };
            angles.push(apart(&same.q, &solution.q));
            // The same branch names for the same arm.
            assert_eq!(same.branch, solution.branch);
            for (ours, theirs) in [
                (same.margin.shoulder, solution.margin.shoulder),
                (same.margin.elbow, solution.margin.elbow),
                (same.margin.wrist, solution.margin.wrist),
            ] {
                assert!((ours - theirs).abs() < 1e-9, "{:?} against {:?}", same.margin, solution.margin);
            }
        }
    }
    let angles = quantiles(angles);
    println!("{missed} of {all} solutions missed; the others differ by {angles:?} rad (q75, q99, max)");
    assert!(all > 250 && missed * 100 <= all, "{missed} of {all} missed");
    assert!(angles[1] < 1e-11 && angles[2] < 1e-9, "{angles:?}");
}

#[test]
fn forward_model_of_a_published_arm() {
    // At zero a UR lies along -x: (a2 + a3, -(d4 + d6), d1 - d5).
    let tcp = forward::forward(&universal(UR5), &Joints::zeros());
    assert!((tcp.position - Vector3::new(-0.81725, -0.19145, -0.005491)).norm() < 1e-12, "{}", tcp.position);
}

#[test]
fn arms_without_a_spherical_wrist_are_solved() {
    let mut random = fastrand::Rng::with_seed(52);
    for table in [UR5, UR10] {
        let robot = universal(table);
        let (mut position, mut rotation, mut counts, mut lost) = (Vec::new(), Vec::new(), [0; 9], 0);
        for _ in 0..150 {
            let q = any_joints(&mut random);
            let tcp = forward::forward(&robot, &q);
            let solutions = inverse(&robot, &tcp, &Joints::zeros()).unwrap();
            counts[solutions.iter().count()] += 1;
            for solution in solutions.iter() {
                let reached = forward::forward(&robot, &solution.q);
                position.push((reached.position - tcp.position).norm());
                rotation.push((reached.rotation - tcp.rotation).norm());
                // Axes 2, 3 and 4 are parallel, the offset of the wrist is along them: the elbow is
                // q3, and the upper arm points backwards.
                let (elbow, wrist) = (solution.q[2].sin(), solution.q[4].sin());
                let Margin { elbow: bent, wrist: turned, .. } = solution.margin;
                assert!((bent - elbow.abs()).abs() < 1e-9 && (turned - wrist.abs()).abs() < 1e-9);
                assert_eq!(solution.branch.elbow_positive, elbow <= 0.0);
            }
            lost += u32::from(solutions.iter().all(|s| apart(&s.q, &q) > 1e-4));
            // From nearby values, the search converges to the original solution.
            let near = q + Joints::from_fn(|i, _| if i % 2 == 0 { 0.01 } else { -0.01 });
            let back = inverse(&robot, &tcp, &near).unwrap();
            let margin = back.nearest(&near).unwrap().margin;
            if margin.elbow.min(margin.wrist) > 0.1 && margin.shoulder > 0.1 {
                assert!((back.nearest(&near).unwrap().q - q).amax() < 1e-8);
            }
        }
        let [position, rotation] = [position, rotation].map(quantiles);
        println!(
            "position {position:?} m, rotation {rotation:?}; number of solutions {counts:?}; {lost} poses not found again"
        );
        // Rounding; only beside a singularity the last steps are slow, within the accuracy required
        // of any solution.
        assert!(position[2] < 1e-9 && rotation[2] < 1e-9, "{position:?} {rotation:?}");
        assert!(position[1] < 1e-13 && rotation[1] < 1e-13, "{position:?} {rotation:?}");
        assert!(lost <= 2, "{lost} of 150");
    }
}

/// A UR10 as a job states it.
fn ur10() -> Value {
    let links = modified(UR10).map(
        |link| json!({"alpha_deg": link.alpha.to_degrees(), "a_mm": link.a * 1e3, "d_mm": link.d * 1e3}),
    );
    json!({"name":"UR10","modified_dh":links,"joint_compliance_rad_per_nm":[1e-5,1e-5,1e-5,3e-5,3e-5,3e-5]})
}

#[test]
fn a_path_is_milled_by_an_arm_that_is_solved_numerically() {
    let report = run(&[
        ("robot", ur10()),
        ("path", json!({"kind":"circle","center_mm":[-700,-200,200],"radius_mm":60,"normal":[0,0,1]})),
        ("motion.feed_mm_s", json!(40)),
        ("cutting.axial_depth_mm", json!(0.1)),
    ]);
    assert_eq!(report.summary().inverse, "numerically");
    let remark = report.warnings.iter().find(|warning| warning.code == "inverse-numerical").unwrap();
    assert!(remark.message.contains("robot.modified_dh["), "{}", remark.message);
    for (q, position) in report.q.iter().zip(&report.plan.trajectory.position) {
        let tcp = forward::forward(&report.plan.robot, q);
        assert!((tcp.position - position).norm() < 1e-9);
    }
    let steps = report.q.windows(2).map(|pair| (pair[1] - pair[0]).amax());
    // 0.04 mm per sample, about 0.7 m from the base.
    assert!(steps.fold(0.0, f64::max) < 2e-3, "no joint jumps");
    let history = &report.compensation.history_max;
    assert!(
        report.compensation.passes > 0 && history[report.compensation.passes] < 0.1 * history[0],
        "{history:?}"
    );
}

#[test]
fn what_cannot_be_reached_is_refused_with_distance_and_reach() {
    let far = json!({"kind":"line","from_mm":[2000,0,100],"to_mm":[2000,100,100]});
    let error = refused(&[("robot", ur10()), ("path", far)]);
    let armill::Error::Unreachable { distance, reach_max, .. } = error else { panic!("{error}") };
    // Links 2 to 5 in line: 0.612 + 0.5723 with the offsets beside them.
    assert!(distance > reach_max && (1.3..1.6).contains(&reach_max), "{distance}, {reach_max}");
    // Within that bound, but with the tool pointing down there the wrist is too far.
    let edge = json!({"kind":"line","from_mm":[1310,0,60],"to_mm":[1310,10,60]});
    let error = refused(&[("robot", ur10()), ("path", edge)]);
    assert!(error.to_string().contains("no joint values were found"), "{error}");
    assert!(
        error.to_string().contains("at (1310.0, ") && error.to_string().contains(", 60.0) mm"),
        "{error}"
    );
}

#[test]
fn arms_with_four_axes_through_one_point_reach_what_they_reach() {
    // Without a forearm axes 3 to 6 meet, without an upper arm and a shoulder offset axes 1 to 3 do:
    // the wrist centre is then always at full reach, to the last digit.
    let mut random = fastrand::Rng::with_seed(14);
    let links = |change: fn(&mut [Link; 6])| {
        let mut links = *rx90().links();
        change(&mut links);
        Robot::new("", links, None, [0.0; 6]).unwrap()
    };
    let no_forearm = links(|links| (links[3].a, links[3].d) = (0.0, 0.0));
    let no_upper_arm = links(|links| (links[1].a, links[2].a) = (0.0, 0.0));
    for robot in [no_forearm, no_upper_arm] {
        assert!(robot.closed_form().is_err());
        for _ in 0..300 {
            let q = any_joints(&mut random);
            let tcp = forward::forward(&robot, &q);
            let found = inverse(&robot, &tcp, &q).unwrap();
            for solution in found.iter() {
                let reached = forward::forward(&robot, &solution.q);
                assert!((reached.position - tcp.position).norm() < 1e-9);
                assert!((reached.rotation - tcp.rotation).norm() < 1e-9);
            }
            // From a place that knows nothing of the answer, too.
            assert!(inverse(&robot, &tcp, &Joints::zeros()).is_ok());
        }
    }
}
