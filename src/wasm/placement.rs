//! A map of places for the workpiece.

use crate::units::MM;
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

    /// For each place, three numbers x, y, z of the workpiece frame in the cell [mm]: largest and
    /// mean contour error by the cutting force [mm], and 0 if suitable, 1 near a singularity, 2
    /// where a joint leaves its range, 3 out of reach.
    pub fn places(&self, xyz_mm: &[f64]) -> Float64Array {
        let places = xyz_mm.chunks_exact(3).flat_map(|at| {
            let place = self.map.at(Vector3::new(at[0], at[1], at[2]) * MM);
            [place.max / MM, place.mean / MM, f64::from(place.status as u8)]
        });
        Float64Array::from(places.collect::<Vec<f64>>().as_slice())
    }
}
