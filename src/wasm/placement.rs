//! A map of places for the workpiece.

use crate::units::{DEG, MM};
use crate::wasm::error::thrown;
use crate::{Job, placement};
use js_sys::Float64Array;
use nalgebra::Vector3;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

/// A job whose part is moved over a map of places.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Survey {
    map: placement::PlacementMap,
}

#[wasm_bindgen]
impl Survey {
    /// Reads a job once, for any number of places. Throws an error if it is invalid.
    #[wasm_bindgen(constructor)]
    pub fn new(json: &str) -> Result<Survey, JsValue> {
        let map = Job::from_json(json).and_then(|job| placement::PlacementMap::new(&job));
        map.map(|map| Survey { map }).map_err(|error| thrown(&error))
    }

    /// Smallest and largest x, y, z of the places worth mapping [mm].
    pub fn extent(&self) -> Float64Array {
        let numbers: Vec<f64> = self.map.extent().iter().flatten().map(|v| v / MM).collect();
        Float64Array::from(numbers.as_slice())
    }

    /// For each place x, y, z of the workpiece frame in the cell [mm], four numbers: largest and
    /// mean contour error by the cutting force before compensation [mm]; 0 if suitable, 1 near a
    /// singularity, 2 where a joint leaves its range, 3 out of reach, 4 where the part would be in the
    /// robot's base; and the 95 % quantile of the largest contour error after compensation [mm].
    pub fn places(&self, xyz_mm: &[f64]) -> Float64Array {
        let places = xyz_mm.chunks_exact(3).flat_map(|at| numbers(&self.map.at(in_metres(at))));
        Float64Array::from(places.collect::<Vec<f64>>().as_slice())
    }

    /// The same four numbers for each of the fixed spins [deg], with the workpiece frame at one place
    /// x, y, z in the cell [mm].
    pub fn turns(&self, xyz_mm: &[f64], spins_deg: &[f64]) -> Float64Array {
        let at = in_metres(xyz_mm);
        let places = spins_deg.iter().flat_map(|spin| numbers(&self.map.turned(spin * DEG).at(at)));
        Float64Array::from(places.collect::<Vec<f64>>().as_slice())
    }

    /// The eight corners of the part's box, from the workpiece frame's origin along the cell's axes
    /// [mm]: that of the stock, or of the tip on the moves that cut.
    pub fn part(&self) -> Float64Array {
        let numbers: Vec<f64> = self
            .map
            .part()
            .iter()
            .flat_map(|corner| [corner.x, corner.y, corner.z])
            .map(|v| v / MM)
            .collect();
        Float64Array::from(numbers.as_slice())
    }

    /// Six numbers [mm]: x, y, z of the robot's base in the cell; radius and height of the cylinder that
    /// stands for it; and the height of the floor in the cell, NaN if the robot does not stand upright.
    pub fn base(&self) -> Float64Array {
        let base = self.map.base();
        let at = base.frame.position;
        let numbers = [at.x, at.y, at.z, base.radius, base.height, base.floor.unwrap_or(f64::NAN)];
        Float64Array::from(numbers.map(|v| v / MM).as_slice())
    }
}

/// x, y, z [mm] in metres; a number that is missing is 0.
fn in_metres(xyz_mm: &[f64]) -> Vector3<f64> {
    Vector3::from_fn(|axis, _| xyz_mm.get(axis).copied().unwrap_or_default() * MM)
}

/// A place as it crosses.
fn numbers(place: &placement::Place) -> [f64; 4] {
    [place.max / MM, place.mean / MM, f64::from(place.status as u8), place.p95 / MM]
}
