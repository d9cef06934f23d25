//! The place in front of the robot, and the turn of the tool about its axis, with the least error there.

use crate::error::Error;
use crate::job::{Job, SpinMode};
use crate::math::within_half_turn;
use crate::placement::in_front::{no_place, shifts};
use crate::placement::{PlacementMap, PlacementStatus};
use crate::units::{DEG, MM};
use nalgebra::Vector3;

/// Turns tried at every place [deg], and how far around the best of them others are [deg].
const TURNS: [f64; 12] = [0.0, 30.0, -30.0, 60.0, -60.0, 90.0, -90.0, 120.0, -120.0, 150.0, -150.0, 180.0];
const AROUND: [f64; 4] = [-20.0, -10.0, 10.0, 20.0];

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

/// The best of 30 places in front of the robot, each with [`TURNS`] of the tool and then a few more at the best
/// of them, by the [`PlacementMap`]'s 95 % quantile; only suitable ones count. A tool whose spin is free keeps it.
///
/// # Errors
/// Any error of the job's setup; [`Error::Invalid`] if no place is suitable.
pub fn sought(job: &Job) -> Result<SoughtPlace, Error> {
    let map = PlacementMap::new(job)?;
    let setup = map.setup();
    let own = job.spin.angle_deg;
    let turns: &[f64] = if job.spin.mode == SpinMode::Fixed { &TURNS } else { &TURNS[..1] };
    let from = Vector3::from(job.workpiece_frame.xyz_mm);
    let places: Vec<Vector3<f64>> =
        shifts(setup).map(|shift| (from + setup.base.direction(&shift) / MM).map(f64::round)).collect();
    let at = |map: &PlacementMap, xyz: &Vector3<f64>, spin_deg: f64| {
        let place = map.at(xyz * MM);
        let sought = SoughtPlace { xyz_mm: (*xyz).into(), spin_deg, p95: place.p95 };
        (place.status == PlacementStatus::Good && place.p95.is_finite()).then_some(sought)
    };
    let turned = |turn: f64| {
        let spin_deg = within_half_turn(own + turn);
        let map = map.turned(spin_deg * DEG);
        places.iter().filter_map(|xyz| at(&map, xyz, spin_deg)).collect::<Vec<_>>()
    };
    let coarse = turns.iter().flat_map(|turn| turned(*turn));
    let better = |best: SoughtPlace, other: SoughtPlace| if other.p95 < best.p95 { other } else { best };
    let best = coarse.reduce(better).ok_or_else(|| no_place(setup))?;
    let around = AROUND.iter().take(if turns.len() > 1 { AROUND.len() } else { 0 });
    let finer = around.filter_map(|turn| {
        let spin_deg = within_half_turn(best.spin_deg + turn);
        at(&map.turned(spin_deg * DEG), &best.xyz_mm.into(), spin_deg)
    });
    Ok(finer.fold(best, better))
}
