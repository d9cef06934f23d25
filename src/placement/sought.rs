//! The place in front of the robot, and the turn of the tool about its axis, with the least error there.

use crate::error::Error;
use crate::job::{Job, SpinMode};
use crate::math::{self, within_half_turn};
use crate::placement::in_front::{no_place, shifts};
use crate::placement::{PlacementMap, PlacementStatus};
use crate::units::{DEG, MM};
use nalgebra::Vector3;

/// Turns from the job's own tried at every place [deg], then at the best of them, and how far around the best place
/// and turn others are.
const QUARTERS: [f64; 4] = [0.0, 90.0, -90.0, 180.0];
const BETWEEN: [f64; 8] = [30.0, -30.0, 60.0, -60.0, 120.0, -120.0, 150.0, -150.0];
const AROUND: [f64; 4] = [-20.0, -10.0, 10.0, 20.0];
/// How many are kept by their error before compensation: places, then places with a turn, whose quantile is computed.
const KEPT: [usize; 2] = [8, 20];

/// Where a part may stand, and how the tool is turned there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SoughtPlace {
    /// Origin of the workpiece frame [mm].
    pub xyz_mm: [f64; 3],
    /// Turn of the tool about its axis, as in the job [deg].
    pub spin_deg: f64,
    /// What the map says there: 95 % quantile of the largest contour error after compensation [m].
    pub p95: f64,
}

/// A place and turn that may be the best, with its largest error before compensation [m].
#[derive(Debug, Clone, Copy)]
struct Candidate {
    xyz: Vector3<f64>,
    spin_deg: f64,
    before: f64,
}

/// The best of 30 places in front of the robot and of 16 turns of the tool there, by the [`PlacementMap`]: first by
/// the error before compensation, which what is left after it is nearly in proportion to, then by the quantile: within
/// 20 % of trying them all (tests/study.rs). Only suitable places count. A tool whose spin is free keeps it.
///
/// # Errors
/// Any error of the job's setup; [`Error::Invalid`] if no place is suitable.
pub fn sought(job: &Job) -> Result<SoughtPlace, Error> {
    let map = PlacementMap::new(job)?;
    let setup = map.setup();
    let is_fixed = job.spin.mode == SpinMode::Fixed;
    let turns = |turns: &'static [f64], least: usize| if is_fixed { turns } else { &turns[..least] };
    let from = Vector3::from(job.workpiece_frame.xyz_mm);
    let places: Vec<Vector3<f64>> =
        shifts(setup).map(|shift| (from + setup.base.direction(&shift) / MM).map(f64::round)).collect();
    let tried = |places: &[Vector3<f64>], turns: &[f64]| -> Vec<Candidate> {
        let at = |turn: &f64| {
            let spin_deg = within_half_turn(job.spin.angle_deg + turn);
            let map = map.turned(spin_deg * DEG);
            let at = |xyz: &Vector3<f64>| {
                let before = map.largest_before(xyz * MM)?;
                Some(Candidate { xyz: *xyz, spin_deg, before })
            };
            places.iter().filter_map(at).collect::<Vec<_>>()
        };
        turns.iter().flat_map(at).collect()
    };
    let least = |candidates: Vec<Candidate>| math::rising(candidates, |candidate| candidate.before);
    let mut coarse = least(tried(&places, turns(&QUARTERS, 1)));
    let mut kept: Vec<Vector3<f64>> = Vec::new();
    for candidate in &coarse {
        if kept.len() < KEPT[0] && !kept.contains(&candidate.xyz) {
            kept.push(candidate.xyz);
        }
    }
    coarse.extend(tried(&kept, turns(&BETWEEN, 0)));
    let judged = |xyz: Vector3<f64>, spin_deg: f64| {
        let place = map.turned(spin_deg * DEG).at(xyz * MM);
        let sought = SoughtPlace { xyz_mm: xyz.into(), spin_deg, p95: place.p95 };
        (place.status == PlacementStatus::Good && place.p95.is_finite()).then_some(sought)
    };
    let better = |best: SoughtPlace, other: SoughtPlace| if other.p95 < best.p95 { other } else { best };
    let finalists = least(coarse).into_iter().take(KEPT[1]);
    let best = finalists
        .filter_map(|candidate| judged(candidate.xyz, candidate.spin_deg))
        .reduce(better)
        .ok_or_else(|| no_place(setup))?;
    let around = turns(&AROUND, 0).iter();
    let finer = around.filter_map(|turn| judged(best.xyz_mm.into(), within_half_turn(best.spin_deg + turn)));
    Ok(finer.fold(best, better))
}
