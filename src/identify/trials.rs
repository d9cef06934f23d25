//! What would make a bad fit of joint compliances a good one: the obvious mistakes, tried one by one.

use crate::identify::measurement::Measurement;
use crate::identify::stiffness::{Fit, explained};
use crate::robot::{Joints, Robot, forward};
use crate::units::DEG;
use nalgebra::Vector3;

/// A fit that explains less is poor.
const POOR: f64 = 0.9;
/// A trial counts if it leaves at most this share of what the fit leaves, and is itself no poor fit.
const BETTER: f64 = 0.25;
/// A fit that leaves less is perfect.
const ROUNDING: f64 = 1e-12;
/// Rows that are tried at the most.
const FEW: usize = 300;
/// The middle one of the six stiffnesses of real arms lies within these [N m/rad]: 1e4 to 3e7 are known.
const REAL: [f64; 2] = [2e3, 1e8];

/// Reasons to doubt a fit: how much it explains, which mistake would explain more, and stiffnesses that no arm has.
pub fn remarks(robot: &Robot, rows: &[Measurement], found: &Fit) -> Vec<String> {
    let mut remarks = Vec::new();
    let best = best(robot, rows, found);
    if found.explained < POOR {
        remarks.push(format!(
            "poor fit: springs in the joints explain only {:.1} % of the squared displacements",
            100.0 * found.explained.max(0.0)
        ));
    }
    if let Some((name, explained)) = best {
        remarks.push(format!(
            "with {name}, springs explain {:.2} % instead of {:.1} %: check that",
            100.0 * explained,
            100.0 * found.explained.max(0.0)
        ));
    }
    remarks.extend(unreal(found));
    remarks
}

/// Stiffnesses that no arm has: a unit is wrong.
fn unreal(found: &Fit) -> Option<String> {
    let known =
        found.joints.iter().filter(|joint| joint.compliance > 0.0).map(|joint| 1.0 / joint.compliance);
    let stiffness = crate::math::rising(known, |stiffness| *stiffness);
    let middle = *stiffness.get(stiffness.len() / 2)?;
    let (than, hint) = if middle > REAL[1] {
        ("stiffer", "are displacements in m, or forces in kN, under names that say mm and N?")
    } else if middle < REAL[0] {
        ("softer", "are displacements in um, under a name that says mm?")
    } else {
        return None;
    };
    Some(format!("the joints would be {than} than those of any arm ({middle:.1e} N m/rad): {hint}"))
}

/// The trial that explains most, if one is clearly better.
fn best(robot: &Robot, rows: &[Measurement], found: &Fit) -> Option<(String, f64)> {
    let left = 1.0 - found.explained;
    if left < ROUNDING {
        return None;
    }
    let few: Vec<Measurement> = rows.iter().step_by(rows.len().div_ceil(FEW)).cloned().collect();
    let tried = trials(robot, &few).into_iter().filter_map(|(name, rows)| {
        let explained = explained(robot, &rows).ok()?;
        (explained > POOR && 1.0 - explained < BETTER * left).then_some((name, explained))
    });
    tried.reduce(|best, other| if other.1 > best.1 + 1e-9 { other } else { best })
}

/// Rows as they would be without a mistake, by name; the simpler ones first.
fn trials(robot: &Robot, rows: &[Measurement]) -> Vec<(String, Vec<Measurement>)> {
    let with = |change: &dyn Fn(&mut Measurement)| {
        let mut rows = rows.to_vec();
        rows.iter_mut().for_each(change);
        rows
    };
    let of_angles = |change: &dyn Fn(&Joints) -> Joints| with(&|row| row.q = change(&row.q));
    let mut all = vec![
        ("forces turned round".to_owned(), with(&|row| row.wrench = -row.wrench)),
        ("joint angles in radians".to_owned(), of_angles(&|q| q / DEG)),
        (
            "joints 4 and 6 swapped".to_owned(),
            of_angles(&|q| Joints::new(q[0], q[1], q[2], q[5], q[4], q[3])),
        ),
        (
            "joint 3 counted from the horizontal".to_owned(),
            of_angles(&|q| Joints::new(q[0], q[1], q[2] + q[1], q[3], q[4], q[5])),
        ),
        ("forces in the flange frame".to_owned(), with(&|row| turn(robot, row, (true, false)))),
        ("displacements in the flange frame".to_owned(), with(&|row| turn(robot, row, (false, true)))),
        (
            "forces and displacements in the flange frame".to_owned(),
            with(&|row| turn(robot, row, (true, true))),
        ),
    ];
    // Every choice of joints that count the other way.
    for turned in 1..64_u32 {
        let is_turned = |joint: usize| turned >> joint & 1 == 1;
        let names: Vec<String> =
            (0..6).filter(|joint| is_turned(*joint)).map(|joint| (joint + 1).to_string()).collect();
        let plural = if names.len() == 1 { "" } else { "s" };
        let name = format!("joint{plural} {} counted the other way", names.join(", "));
        let q = |q: &Joints| Joints::from_fn(|joint, _| if is_turned(joint) { -q[joint] } else { q[joint] });
        all.push((name, of_angles(&q)));
    }
    all
}

/// Takes a row's force and displacement as given along the flange's axes.
fn turn(robot: &Robot, row: &mut Measurement, (force, displacement): (bool, bool)) {
    let flange = forward::frames(robot, &row.q)[5].rotation;
    if force {
        for from in [0, 3] {
            let own: Vector3<f64> = row.wrench.fixed_rows::<3>(from).into();
            row.wrench.fixed_rows_mut::<3>(from).copy_from(&(flange * own));
        }
    }
    // Along axes that were not measured nothing can be turned.
    if let (true, [Some(x), Some(y), Some(z)]) = (displacement, row.displacement) {
        let turned = flange * Vector3::new(x, y, z);
        row.displacement = [Some(turned.x), Some(turned.y), Some(turned.z)];
    }
}
