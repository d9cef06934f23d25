//! Nonlinear springs and the weight of links and spindle: the joints come to rest where every
//! torque balances.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]

use crate::common::{between, refused, run};
use armill::math::Pose;
use armill::robot::equilibrium::{Equilibrium, SETTLED, equilibrium};
use armill::robot::load::GRAVITY;
use armill::robot::{JointStatics, Joints, Load, Robot, Spring, compliance, forward, library};
use nalgebra::Vector3;
use serde_json::{Value, json};

/// The RX-90 with a spindle whose tip is off the flange's axis.
fn arm() -> Robot {
    let preset = library::robot("staubli-rx90").unwrap();
    let tool = Pose::from_xyz_rpy(Vector3::new(0.08, -0.03, 0.2), [0.2, -0.5, 0.1]);
    Robot::new(preset.name(), preset.links(), preset.limits(), preset.joint_compliance)
        .unwrap()
        .with_tool(tool)
}

/// Lost motion of one arc minute, then 6 N m/arcmin, then twice that.
fn worn() -> Spring {
    let arcmin = (1.0_f64 / 60.0).to_radians();
    let points = [(1.0, 1.0), (7.0, 2.0), (19.0, 3.0)].map(|(torque, turn)| (torque, turn * arcmin));
    Spring::through("spring", points.to_vec()).unwrap()
}

fn loads() -> Vec<Load> {
    let load = |link, mass, x, y, z| Load { link, mass, center: Vector3::new(x, y, z) };
    vec![load(1, 18.0, 0.2, 0.02, -0.1), load(2, 12.0, 0.03, -0.05, 0.1), load(5, 9.0, 0.04, -0.02, 0.12)]
}

fn statics(robot: &Robot, springs: Option<Spring>, loads: Vec<Load>) -> JointStatics {
    let springs = [0, 1, 2, 3, 4, 5]
        .map(|joint| springs.clone().unwrap_or_else(|| Spring::linear(robot.compliance()[joint])));
    JointStatics { springs, loads, gravity: Vector3::new(0.0, 0.0, -GRAVITY), touched_off: false }
}

fn poses() -> impl Iterator<Item = (Joints, Vector3<f64>)> {
    let mut random = fastrand::Rng::with_seed(5);
    (0..200).map(move |_| {
        let q = Joints::from_fn(|_, _| between(&mut random, -2.0, 2.0));
        (q, Vector3::from_fn(|_, _| between(&mut random, -800.0, 800.0)))
    })
}

fn balanced(robot: &Robot, statics: &JointStatics, q: &Joints, force: &Vector3<f64>) -> Equilibrium {
    let balance = equilibrium(robot, statics, q, force);
    assert!(balance.converged && balance.residual <= SETTLED, "{balance:?}");
    balance
}

fn sum(parts: &[(Vector3<f64>, Vector3<f64>); 6]) -> Vector3<f64> {
    parts.iter().map(|(moved, _)| moved).sum()
}

/// The torque of each joint as the slope of the work of force and weight, by differences of the
/// forward model alone.
#[test]
fn at_rest_each_joint_turns_as_its_spring_says_under_the_slope_of_the_work() {
    let robot = arm();
    for springs in [None, Some(worn())] {
        let statics = statics(&robot, springs, loads());
        for (q, force) in poses() {
            let balance = balanced(&robot, &statics, &q, &force);
            let work = |q: &Joints| {
                let frames = forward::frames(&robot, q);
                let tip = frames[5].compose(robot.tool()).position;
                let lifted = statics
                    .loads
                    .iter()
                    .map(|load| load.mass * statics.gravity.dot(&frames[load.link].point(&load.center)));
                force.dot(&tip) + lifted.sum::<f64>()
            };
            let rest = q + Joints::from(balance.turns);
            for joint in 0..6 {
                let step = Joints::ith(joint, 1e-5);
                let torque = (work(&(rest + step)) - work(&(rest - step))) / 2e-5;
                let turn = statics.springs[joint].turn(torque);
                // Differences over 1e-5 rad are good to 1e-6 N m; the softest segment turns 3e-4
                // rad per N m.
                assert!((turn - balance.turns[joint]).abs() < 1e-9, "joint {joint}: {turn} {balance:?}");
            }
            // The contributions of the joints add up to the tip's motion.
            let there = forward::forward(&robot, &rest).position - forward::forward(&robot, &q).position;
            // The midpoint rule errs by 1/24 of the third power, at a reach of less than 2 m.
            let turned: f64 = balance.turns.iter().map(|turn| turn.abs()).sum();
            assert!((sum(&balance.parts) - there).norm() < 2.0 * turned.powi(3) / 24.0 + 1e-14);
            // And to its rotation, about the axis given by the difference of the rotations.
            let [there, here] = [rest, q].map(|q| forward::forward(&robot, &q).rotation);
            let turn = there * here.transpose();
            let axis = Vector3::new(turn[(2, 1)], turn[(0, 2)], turn[(1, 0)]);
            let parts: Vector3<f64> = balance.parts.iter().map(|(_, turned)| turned).sum();
            assert!((parts - axis).norm() < turned * turned, "{parts} and {axis}");
        }
    }
}

/// With linear springs and no weight it is C F, apart from the change of pose: a thousandth at a
/// millimetre, and half of that at half the force.
#[test]
fn straight_springs_without_weight_are_the_thesiss_compliance_in_the_limit() {
    let robot = arm();
    let statics = statics(&robot, None, Vec::new());
    for (q, force) in poses() {
        let off = |force: &Vector3<f64>| {
            let linear =
                (compliance::cartesian_compliance(&robot, &q).fixed_view::<3, 3>(0, 0) * force).norm();
            let c = compliance::cartesian_compliance(&robot, &q);
            let displacement: Vector3<f64> = c.fixed_view::<3, 3>(0, 0) * force;
            (sum(&balanced(&robot, &statics, &q, force).parts) - displacement).norm() / linear
        };
        let (whole, half) = (off(&force), off(&(force / 2.0)));
        assert!(whole < 0.01, "{whole}");
        assert!((half / whole - 0.5).abs() < 0.02 || whole < 1e-9, "{whole} {half}");
    }
}

#[test]
fn a_spring_is_read_between_its_points_both_ways_and_beyond() {
    let spring = Spring::through("s", vec![(2.0, 1e-3), (6.0, 2e-3), (10.0, 2.5e-3)]).unwrap();
    let rows =
        [(0.0, 0.0), (1.0, 5e-4), (2.0, 1e-3), (4.0, 1.5e-3), (6.0, 2e-3), (8.0, 2.25e-3), (14.0, 3e-3)];
    for (torque, turn) in rows {
        assert!((spring.turn(torque) - turn).abs() < 1e-15);
        assert!((spring.turn(-torque) + turn).abs() < 1e-15);
    }
    assert_eq!(Spring::linear(2e-6).turn(300.0), 2e-6 * 300.0);
    for (points, part) in [
        (vec![], "no point"),
        (vec![(0.0, 0.0)], "torque 0 N m after 0 N m"),
        (vec![(2.0, 1e-3), (2.0, 2e-3)], "torque 2 N m after 2 N m"),
        (vec![(2.0, 1e-3), (4.0, 5e-4)], "angle of 0.0005 rad after 0.001 rad"),
        (vec![(f64::NAN, 0.0)], "torque NaN"),
    ] {
        let error = Spring::through("robot.x", points).unwrap_err();
        assert_eq!(error.field(), Some("robot.x"));
        assert!(error.to_string().contains(part), "{error}");
    }
}

fn arc(robot: Value, more: &[(&str, Value)]) -> armill::Report {
    let path = json!({"kind":"arc","center_mm":[600,0,100],"radius_mm":120,"normal":[0.1,0.2,1],"start_deg":-60,"sweep_deg":150});
    run(&[&[("path", path), ("robot", robot), ("shaper", json!("none"))], more].concat())
}

#[test]
fn sag_counts_from_where_the_part_was_touched_off() {
    let robot =
        |zero: &str| json!({"preset":"staubli-rx90","loads_kg_mm":[[6, 9.0, 0, 0, 120]],"sag_zero":zero});
    let idle = [("cutting.axial_depth_mm", json!(0))];
    let (touched, absolute) = (arc(robot("start"), &idle), arc(robot("model"), &idle));
    let first = absolute.deflection[0];
    assert!(first.z < -2e-5, "9 kg pull a soft arm down by more than 20 um: {first}");
    assert_eq!(touched.deflection[0], Vector3::zeros());
    let leaning = ("path", json!({"kind":"csv","text":"600,-60,100,0,0,1\n600,60,100,0,0.1,1"}));
    let leans = ["model", "start"]
        .map(|zero| arc(robot(zero), &[idle[0].clone(), leaning.clone()]).before.axis_error[0]);
    assert!(leans[0] > 2e-5 && leans[1] < 1e-12, "the axis counts from there too: {leans:?}");
    for (a, b) in absolute.deflection.iter().zip(&touched.deflection) {
        assert!((a - b - first).norm() < 1e-15);
    }
    // A base that hangs from the ceiling sags the other way, in its own frame.
    let hung = arc(
        robot("model"),
        &[
            ("cutting.axial_depth_mm", json!(0)),
            ("base_frame", json!({"xyz_mm":[0,0,0],"rpy_deg":[180,0,0]})),
            ("workpiece_frame", json!({"xyz_mm":[0,0,0],"rpy_deg":[180,0,0]})),
        ],
    );
    for (a, b) in absolute.deflection.iter().zip(&hung.deflection) {
        assert!((a + b).norm() < 2e-3 * a.norm() + 1e-12, "{a} {b}");
    }
    // The parts of the budget add up to the whole, whatever the springs.
    let parts: Vector3<f64> = absolute.deflection_by_joint(500).iter().sum();
    assert!((parts - absolute.deflection[500]).norm() < 1e-15);
}

#[test]
fn worn_joints_and_a_heavy_spindle_are_compensated_too() {
    let springs: Vec<_> = (1..=6)
        .flat_map(|joint| {
            [[f64::from(joint), 2.0, 0.3], [f64::from(joint), 100.0, 0.9], [f64::from(joint), 400.0, 2.0]]
        })
        .collect();
    let robot = json!({
        "preset": "staubli-rx90",
        "joint_springs_nm_arcmin": springs,
        "loads_kg_mm": [[2, 20.0, 250, 0, 0], [6, 9.0, 20, 0, 120]],
    });
    let report = arc(robot, &[]);
    let summary = report.summary();
    assert!(summary.before_mm.both.max > 0.3, "{:?}", summary.before_mm);
    assert!(summary.after_mm.max < 0.01 && summary.converged, "{:?}", summary.history_max_mm);
}

#[test]
fn an_arm_that_does_not_come_to_rest_is_told() {
    let robot = json!({"preset":"staubli-rx90","joint_springs_nm_arcmin":[[2, 0.01, 3000],[3, 0.01, 3000]]});
    // The figures after compensation include the force, whatever is compensated.
    for sources in [json!(["deflection", "shaping"]), json!(["shaping"]), json!([])] {
        let changes = [("compensation.max_passes", json!(0)), ("compensation.sources", sources)];
        let report = arc(robot.clone(), &changes);
        assert!(
            report.warnings.iter().any(|warning| warning.code == "springs-unsettled"),
            "{:?}",
            report.warnings
        );
    }
    let sound = arc(json!({"preset":"staubli-rx90","loads_kg_mm":[[6, 9, 0, 0, 100]]}), &[]);
    assert!(sound.warnings.iter().all(|warning| warning.code != "springs-unsettled"));
}

#[test]
fn what_is_wrong_in_a_row_is_named() {
    for (key, rows, field, part) in [
        (
            "joint_springs_nm_arcmin",
            json!([[7, 1, 1]]),
            "robot.joint_springs_nm_arcmin[0]",
            "a joint, 1 to 6",
        ),
        (
            "joint_springs_nm_arcmin",
            json!([[1, 5, 1], [1, 4, 2]]),
            "robot.joint_springs_nm_arcmin",
            "torque 4 N m after 5 N m",
        ),
        (
            "loads_kg_mm",
            json!([[6, 9, 0, 0, 0], [2.5, 1, 0, 0, 0]]),
            "robot.loads_kg_mm[1]",
            "a link, 1 to 6",
        ),
        ("loads_kg_mm", json!([[6, -9, 0, 0, 0]]), "robot.loads_kg_mm[0]", "a mass"),
    ] {
        let robot = json!({"preset":"staubli-rx90", key: rows});
        let error = refused(&[("robot", robot)]);
        assert_eq!(error.field(), Some(field), "{error}");
        assert!(error.to_string().contains(part), "{error}");
    }
}
