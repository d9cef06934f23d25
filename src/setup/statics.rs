//! From the job's tables of springs and loads to the arm's static equilibrium.

use crate::error::Error;
use crate::job::{self, SagZero};
use crate::math::Pose;
use crate::robot::load::GRAVITY;
use crate::robot::{JointStatics, Joints, Load, Spring};
use crate::units::{ARCMIN, MM};
use nalgebra::Vector3;

/// Largest mass of a link or spindle [kg].
const HEAVIEST: f64 = 1e5;

/// Springs and loads of the arm with its base at `base` in the cell; `None` if the joints only have
/// a compliance. A table of a spring is turned further by the factor in `softer`.
///
/// # Errors
/// The first invalid row, with its field.
pub(super) fn of(
    robot: &job::Robot,
    (compliance, softer): (&Joints, &[f64; 6]),
    base: &Pose,
) -> Result<Option<JointStatics>, Error> {
    let points = robot.joint_springs_nm_arcmin.as_deref().unwrap_or_default();
    let rows = robot.loads_kg_mm.as_deref().unwrap_or_default();
    if points.is_empty() && rows.is_empty() {
        return Ok(None);
    }
    let field = "robot.joint_springs_nm_arcmin";
    let mut tables: [Vec<(f64, f64)>; 6] = Default::default();
    for (index, &[joint, torque, turn]) in points.iter().enumerate() {
        let joint = one_of_six(joint).ok_or_else(|| {
            Error::invalid(format!("{field}[{index}]"), joint, "the first number is a joint, 1 to 6")
        })?;
        tables[joint].push((torque, turn * ARCMIN));
    }
    let mut springs = [0, 1, 2, 3, 4, 5].map(|joint| Spring::linear(compliance[joint]));
    let tabled = springs.iter_mut().zip(tables).zip(softer).filter(|((_, table), _)| !table.is_empty());
    for ((spring, table), factor) in tabled {
        *spring = Spring::through(field, table)?.softened(*factor);
    }
    let mut loads = Vec::with_capacity(rows.len());
    for (index, &[link, mass, x, y, z]) in rows.iter().enumerate() {
        let field = format!("robot.loads_kg_mm[{index}]");
        let link = one_of_six(link)
            .ok_or_else(|| Error::invalid(&field, link, "the first number is a link, 1 to 6 (the flange)"))?;
        if !(0.0..=HEAVIEST).contains(&mass) {
            return Err(Error::invalid(
                &field,
                mass,
                format!("the second number is a mass, 0 to {HEAVIEST} kg"),
            ));
        }
        loads.push(Load { link, mass, center: Vector3::new(x, y, z) * MM });
    }
    let gravity = base.inverse().direction(&Vector3::new(0.0, 0.0, -GRAVITY));
    let touched_off = robot.sag_zero.unwrap_or_default() == SagZero::Start;
    Ok(Some(JointStatics { springs, loads, gravity, touched_off }))
}

/// The index of a number from 1 to 6.
fn one_of_six(number: f64) -> Option<usize> {
    (1..=6).find(|&whole| f64::from(whole) == number).map(|whole| whole as usize - 1)
}
