//! The Puma 560, whose Jacobian and gravity torques are published: kinematics and weight of an arm
//! that the library does not contain.

use armill::math::Pose;
use armill::robot::equilibrium::equilibrium;
use armill::robot::{JointStatics, Joints, Link, Load, Robot, Spring, forward, jacobian};
use nalgebra::Vector3;
use serde_json::Value;

fn case(id: &str) -> Value {
    let text =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/golden.json")).unwrap();
    let golden: Value = serde_json::from_str(&text).unwrap();
    golden["cases"].as_array().unwrap().iter().find(|case| case["id"] == id).unwrap().clone()
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    let numbers: Vec<_> = value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    numbers.try_into().unwrap()
}

/// The case's standard Denavit-Hartenberg table as a modified one: a row's twist and length belong
/// to the row after it, so a frame of the standard table is offset from ours by its own length and
/// twist.
fn arm(inputs: &Value) -> (Robot, [Pose; 6]) {
    let (d, a): ([f64; 6], [f64; 6]) = (numbers(&inputs["d_m"]), numbers(&inputs["a_m"]));
    let alpha: [f64; 6] = numbers::<6>(&inputs["alpha_deg"]).map(f64::to_radians);
    let links = [0, 1, 2, 3, 4, 5].map(|i| Link {
        alpha: if i == 0 { 0.0 } else { alpha[i - 1] },
        a: if i == 0 { 0.0 } else { a[i - 1] },
        d: d[i],
        theta_offset: 0.0,
        sign: 1.0,
    });
    let standard =
        [0, 1, 2, 3, 4, 5].map(|i| Pose::from_xyz_rpy(Vector3::new(a[i], 0.0, 0.0), [alpha[i], 0.0, 0.0]));
    (Robot::new("Puma 560", links, None, [1e-12; 6]).unwrap(), standard)
}

#[test]
fn pose_and_jacobian_are_the_published_ones() {
    let case = case("puma560_fk_jacobian_qn");
    let (robot, _) = arm(&case["inputs"]);
    let q = Joints::from(numbers::<6>(&case["inputs"]["q_rad"]));
    let pose = forward::forward(&robot, &q);
    for (row, expected) in case["expected"]["T"].as_array().unwrap().iter().take(3).enumerate() {
        let expected: [f64; 4] = numbers(expected);
        for (column, expected) in expected.into_iter().enumerate() {
            let ours = if column < 3 { pose.rotation[(row, column)] } else { pose.position[row] };
            assert!((ours - expected).abs() < 1e-6, "T[{row}][{column}]: {ours} against {expected}");
        }
    }
    let j = jacobian::jacobian(&robot, &q);
    for (row, expected) in
        case["expected"]["J0_rows_vx_vy_vz_wx_wy_wz"].as_array().unwrap().iter().enumerate()
    {
        for (joint, expected) in numbers::<6>(expected).into_iter().enumerate() {
            assert!(
                (j[(row, joint)] - expected).abs() < 1e-6,
                "J[{row}][{joint}]: {} against {expected}",
                j[(row, joint)]
            );
        }
    }
}

/// The holding torque balances the weight; springs so stiff that nothing moves show it.
#[test]
fn the_weight_of_the_links_is_the_published_torque() {
    let case = case("puma560_gravload_qn");
    let inputs = &case["inputs"];
    let (robot, standard) = arm(inputs);
    let masses: [f64; 6] = numbers(&inputs["link_mass_kg"]);
    let load = |link: usize| {
        let center = Vector3::from(numbers::<3>(&inputs["link_com_m"][link]));
        Load { link, mass: masses[link], center: standard[link].point(&center) }
    };
    let springs = [1e-12; 6].map(Spring::linear);
    let gravity = Vector3::new(0.0, 0.0, -inputs["g"].as_f64().unwrap());
    let statics = JointStatics { springs, loads: (0..6).map(load).collect(), gravity, touched_off: false };
    let q = Joints::from(numbers::<6>(&inputs["q_rad"]));
    let balance = equilibrium(&robot, &statics, &q, &Vector3::zeros());
    let expected: [f64; 6] = numbers(&case["expected"]["tau_Nm"]);
    for (joint, (turn, expected)) in balance.turns.iter().zip(expected).enumerate() {
        // Printed with four digits.
        assert!(
            (-turn * 1e12 - expected).abs() < 1e-4,
            "joint {}: {} N m against {expected}",
            joint + 1,
            -turn * 1e12
        );
    }
}
