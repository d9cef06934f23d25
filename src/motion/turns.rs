//! Whole turns of the joints: the inverse model gives angles up to a turn, the joint ranges say
//! which.

use crate::math::TAU;
use crate::robot::{Joints, Robot};

/// Shifts joint commands [rad], each joint by as few whole turns as bring all of it into its range.
/// A joint that fits in no turn stays, as do all without known ranges.
pub fn into_ranges(robot: &Robot, q: &mut [Joints]) {
    for (i, range) in robot.limits().into_iter().flatten().enumerate() {
        let values = q.iter().map(|q| q[i]);
        let used = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), q| (a.min(q), b.max(q)));
        let shift = whole_turns(used, *range) * TAU;
        if shift != 0.0 {
            q.iter_mut().for_each(|q| q[i] += shift);
        }
    }
}

/// The number of whole turns that brings what is used into a range [rad]; 0 if none does.
fn whole_turns((least, most): (f64, f64), (low, high): (f64, f64)) -> f64 {
    // The turns that lift the least above the lower end, and keep the most below the upper one.
    let (up, down) = (((low - least) / TAU).ceil(), ((high - most) / TAU).floor());
    if up > down { 0.0 } else { 0.0_f64.clamp(up, down) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_few_turns_as_suffice() {
        let range = (-350.0, 350.0);
        for (used, turns) in [
            ((-170.0, 130.0), 0.0),
            ((-350.0, 350.0), 0.0),
            ((-470.0, -170.0), 1.0),
            ((-400.0, -380.0), 1.0),
            ((370.0, 380.0), -1.0),
            ((700.0, 1000.0), -2.0),
            // Too wide for the range.
            ((-390.0, 600.0), 0.0),
            ((-100.0, 700.0), 0.0),
        ] {
            let radians = |(a, b): (f64, f64)| (a.to_radians(), b.to_radians());
            assert_eq!(whole_turns(radians(used), radians(range)), turns, "{used:?}");
        }
    }
}
