//! Arms whose joint 3 is relative to the base: FANUC's pendants, and parallelograms, whose springs
//! then belong to other turns.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]

use crate::common::{self, between, refused, run};
use armill::identify::Convention;
use armill::math::Pose;
use armill::robot::equilibrium::equilibrium;
use armill::robot::{
    Elbow, JointStatics, Joints, Load, Robot, Spring, compliance, forward, inverse, jacobian, library,
};
use nalgebra::{Vector3, Vector6};
use rs_opw_kinematics::kinematic_traits::Kinematics;
use rs_opw_kinematics::parallelogram::Parallelogram;
use serde_json::json;
use std::sync::Arc;

const COUNTED: [Elbow; 2] = [Elbow::Pendant, Elbow::Parallelogram];

/// A FANUC and a KUKA: joint 3 turns against joint 2 on one, with it on the other.
fn arms() -> Vec<Robot> {
    let arm = |id: &str| {
        let preset = library::robot(id).unwrap();
        let tool = Pose::from_xyz_rpy(Vector3::new(0.1, -0.05, 0.3), [0.3, 0.6, -0.2]);
        Robot::new(id, preset.links(), None, preset.joint_compliance).unwrap().with_tool(tool)
    };
    vec![arm("fanuc-r-2000ic-210f"), arm("kuka-kr-16-2")]
}

fn poses(seed: u64) -> impl Iterator<Item = Joints> {
    let mut random = fastrand::Rng::with_seed(seed);
    (0..300).map(move |_| Joints::from_fn(|_, _| between(&mut random, -1.5, 1.5)))
}

/// The tip's motion for each joint in the controller's convention, by differences of the forward
/// model alone.
fn slopes(robot: &Robot, q: &Joints) -> [Vector3<f64>; 6] {
    [0, 1, 2, 3, 4, 5].map(|i| {
        let step = Joints::ith(i, 1e-5);
        let tip = |q: Joints| forward::forward(robot, &q).position;
        (tip(q + step) - tip(q - step)) / 2e-5
    })
}

#[test]
fn the_forearm_keeps_its_inclination_while_joint_2_alone_turns() {
    for arm in arms() {
        for elbow in COUNTED {
            let coupled = arm.clone().with_elbow(elbow).unwrap();
            for q in poses(3) {
                let turned = q + Joints::ith(1, 0.4);
                let (before, after) =
                    (forward::frames(&coupled, &q)[2], forward::frames(&coupled, &turned)[2]);
                assert!((before.rotation - after.rotation).norm() < 1e-14);
                assert!((before.position - after.position).norm() > 0.1);
                // The serial arm does the same with its joint 3 turned back by hand.
                let back = arm.links()[1].sign * arm.links()[2].sign * q[1];
                let by_hand = q - Joints::ith(2, back);
                assert!(
                    (forward::forward(&arm, &by_hand).position - forward::forward(&coupled, &q).position)
                        .norm()
                        < 1e-14
                );
            }
        }
    }
}

/// The peer's parallelogram subtracts its scaling times the driven joint.
#[test]
fn forward_agrees_with_another_authors_parallelogram() {
    let preset = library::robot("fanuc-r-2000ic-210f").unwrap();
    let robot: Arc<dyn Kinematics> = Arc::new(common::peer::peer(&preset));
    let peer = Parallelogram { robot, scaling: -1.0, driven: 1, coupled: 2 };
    let ours = Robot::new("", preset.links(), None, preset.joint_compliance)
        .unwrap()
        .with_elbow(preset.elbow)
        .unwrap();
    assert_eq!(preset.elbow, Elbow::Pendant);
    for q in poses(4) {
        let joints: [f64; 6] = q.into();
        let theirs = peer.forward(&joints).translation;
        let tip = forward::forward(&ours, &q).position;
        assert!((tip - Vector3::new(theirs.x, theirs.y, theirs.z)).norm() < 1e-12);
    }
}

#[test]
fn the_inverse_gives_the_joints_as_told() {
    for arm in arms() {
        for elbow in COUNTED {
            let coupled = arm.clone().with_elbow(elbow).unwrap();
            for q in poses(5) {
                let solutions = inverse::inverse(&coupled, &forward::forward(&coupled, &q), &q).unwrap();
                let near = solutions.nearest(&q).unwrap();
                assert!(near.margin.wrist < 0.02 || (near.q - q).amax() < 1e-9, "{} for {q}", near.q);
            }
        }
    }
}

#[test]
fn the_jacobian_is_the_slope_by_the_joints_as_told() {
    for arm in arms() {
        for elbow in COUNTED {
            let coupled = arm.clone().with_elbow(elbow).unwrap();
            for q in poses(6) {
                let j = jacobian::jacobian(&coupled, &q);
                for (i, slope) in slopes(&coupled, &q).into_iter().enumerate() {
                    assert!((j.fixed_view::<3, 1>(0, i) - slope).norm() < 1e-8);
                }
            }
        }
    }
}

/// By differences: a parallelogram's springs turn the joints in the controller's convention, those
/// behind a pendant the serial arm's.
#[test]
fn springs_give_way_where_the_drives_are() {
    for arm in arms() {
        for elbow in COUNTED {
            let coupled = arm.clone().with_elbow(elbow).unwrap();
            for q in poses(7) {
                let slopes = match elbow {
                    Elbow::Parallelogram => slopes(&coupled, &q),
                    _ => {
                        let back = arm.links()[1].sign * arm.links()[2].sign * q[1];
                        slopes(&arm, &(q - Joints::ith(2, back)))
                    }
                };
                let force = Vector3::new(300.0, -500.0, 200.0);
                let moved: Vector3<f64> = slopes
                    .iter()
                    .zip(arm.compliance())
                    .map(|(slope, c)| slope * (c * slope.dot(&force)))
                    .sum();
                let c = compliance::cartesian_compliance(&coupled, &q);
                let wrench = Vector6::new(force.x, force.y, force.z, 0.0, 0.0, 0.0);
                let ours = (c * wrench).fixed_rows::<3>(0).into_owned();
                assert!((ours - moved).norm() < 1e-6 * moved.norm(), "{elbow:?}: {ours} {moved}");
            }
        }
        // The two differ, so one must not be taken for the other.
        let q = Joints::new(0.1, 0.5, -0.4, 0.3, 0.9, 0.2);
        let c = COUNTED
            .map(|elbow| compliance::cartesian_compliance(&arm.clone().with_elbow(elbow).unwrap(), &q));
        assert!((c[0] - c[1]).norm() > 0.05 * c[0].norm());
    }
}

/// At rest each drive's spring turns by the slope of the work of force and weight along that drive.
#[test]
fn force_and_weight_are_in_balance_with_a_parallelogram_too() {
    let loads = vec![
        Load { link: 1, mass: 200.0, center: Vector3::new(0.4, 0.1, -0.2) },
        Load { link: 2, mass: 150.0, center: Vector3::new(0.2, -0.3, 0.1) },
        Load { link: 5, mass: 60.0, center: Vector3::new(0.05, 0.0, 0.2) },
    ];
    for arm in arms() {
        let springs = [0, 1, 2, 3, 4, 5].map(|joint| Spring::linear(arm.compliance()[joint]));
        let statics = JointStatics {
            springs,
            loads: loads.clone(),
            gravity: Vector3::new(0.0, 0.0, -9.8),
            touched_off: false,
        };
        let coupled = arm.clone().with_elbow(Elbow::Parallelogram).unwrap();
        let force = Vector3::new(-400.0, 300.0, 250.0);
        for q in poses(8) {
            let balance = equilibrium(&coupled, &statics, &q, &force);
            assert!(balance.converged);
            let signs = Joints::from_fn(|i, _| arm.links()[i].sign);
            let rest = q + Joints::from(balance.turns).component_mul(&signs);
            let work = |q: Joints| {
                let frames = forward::frames(&coupled, &q);
                let weight = loads
                    .iter()
                    .map(|load| load.mass * statics.gravity.dot(&frames[load.link].point(&load.center)));
                force.dot(&frames[5].compose(coupled.tool()).position) + weight.sum::<f64>()
            };
            for i in 0..6 {
                let step = Joints::ith(i, 1e-5);
                let torque = (work(rest + step) - work(rest - step)) / 2e-5;
                let turn = arm.compliance()[i] * torque * signs[i];
                assert!((turn - balance.turns[i]).abs() < 1e-10, "joint {i}: {turn} {:?}", balance.turns);
            }
            let there = forward::forward(&coupled, &rest).position - forward::forward(&coupled, &q).position;
            let parts: Vector3<f64> = balance.parts.iter().map(|(moved, _)| moved).sum();
            assert!((parts - there).norm() < 1e-9, "{parts} {there}");
        }
        // Behind a pendant the springs are the serial arm's, whatever the display shows.
        let pendant = arm.clone().with_elbow(Elbow::Pendant).unwrap();
        for q in poses(9) {
            let back = arm.links()[1].sign * arm.links()[2].sign * q[1];
            let serial = equilibrium(&arm, &statics, &(q - Joints::ith(2, back)), &force);
            let shown = equilibrium(&pendant, &statics, &q, &force);
            assert!(serial.turns.iter().zip(shown.turns).all(|(a, b)| (a - b).abs() < 1e-12));
        }
    }
}

#[test]
fn a_job_says_which_it_is() {
    let opw = json!({"a1_mm":200,"a2_mm":-150,"c1_mm":680,"c2_mm":890,"c3_mm":880,"c4_mm":140,"joint_offset_deg":[0,0,-90,0,0,0]});
    let compliance = json!([1e-6, 1e-6, 1e-6, 3e-6, 3e-6, 3e-6]);
    let path = json!({"kind":"line","from_mm":[1200,-100,800],"to_mm":[1200,100,800]});
    let job = |kind: &str| {
        let robot = json!({"opw": opw, "joint_3": kind, "joint_compliance_rad_per_nm": compliance});
        run(&[("robot", robot), ("path", path.clone())])
    };
    let [serial, pendant, parallel] = ["serial", "pendant", "parallelogram"].map(job);
    let deflection = |report: &armill::Report| report.deflection[1000];
    assert!((deflection(&serial) - deflection(&pendant)).norm() < 1e-12, "a display bends nothing");
    assert!((deflection(&serial) - deflection(&parallel)).norm() > 1e-5);
    assert!((pendant.q[0] - parallel.q[0]).amax() < 1e-12);
    assert!((serial.q[0] - parallel.q[0])[2].abs() > 0.1);
    let bent = json!({"modified_dh": [
        {"alpha_deg":0,"a_mm":0,"d_mm":400}, {"alpha_deg":-90,"a_mm":0,"d_mm":0}, {"alpha_deg":20,"a_mm":450,"d_mm":0},
        {"alpha_deg":90,"a_mm":0,"d_mm":450}, {"alpha_deg":-90,"a_mm":0,"d_mm":0}, {"alpha_deg":90,"a_mm":0,"d_mm":85}],
        "joint_3": "parallelogram", "joint_compliance_rad_per_nm": compliance});
    assert_eq!(refused(&[("robot", bent)]).field(), Some("robot.joint_3"));
    // Axes 2 and 3 are parallel, either way round, or they are not.
    for (deg, parallel) in [(0.0, true), (90.0, false), (180.0, true), (-90.0, false), (-180.0, true)] {
        let mut links = *arms()[0].links();
        links[2].alpha = f64::to_radians(deg);
        let arm = Robot::new("", links, None, [0.0; 6]).unwrap().with_elbow(Elbow::Parallelogram);
        assert_eq!(arm.is_ok(), parallel, "{deg} deg");
    }
    let fanuc = library::robot("fanuc-r-2000ic-210f").unwrap();
    let robot =
        Robot::new("", fanuc.links(), None, fanuc.joint_compliance).unwrap().with_elbow(fanuc.elbow).unwrap();
    assert!(Convention::CoupledJ3.suits(&robot).is_err() && Convention::Table.suits(&robot).is_ok());
}
