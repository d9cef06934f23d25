//! Cutting: golden cases, the laws of the force model, and brute-force sums as an independent
//! computation.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]

mod force;
mod job;
mod load;
mod material;
mod measured;
mod runout;
mod spindle;
mod surface;
mod tool;

use armill::cutting::{Coefficients, Cut, Engagement, Hand};
use nalgebra::Vector3;
use serde_json::Value;
use std::f64::consts::{PI, TAU};

const DEG: f64 = PI / 180.0;

fn golden(part: &str) -> Vec<Value> {
    let text =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/golden_cutting.json"))
            .unwrap();
    let golden: Value = serde_json::from_str(&text).unwrap();
    golden[part].as_array().unwrap().clone()
}

/// The coefficients of a golden case.
fn coefficients(case: &Value) -> Coefficients {
    Coefficients::of_table(
        ["Ktc", "Krc", "Kac", "Kte", "Kre", "Kae"].map(|key| case[key].as_f64().unwrap_or(0.0)),
    )
}

/// Half immersion in aluminium with a 12 mm tool.
fn half() -> Cut {
    Cut {
        diameter: 0.012,
        flutes: 4,
        helix: 30.0 * DEG,
        hand: Hand::Right,
        corner_radius: 0.0,
        runout: 0.0,
        coefficients: Coefficients::of_table([767.01, 168.8, 222.0, 27.7, 26.6, 0.7]),
        axial_depth: 0.002,
        engagement: Engagement::Angles { entry: 90.0 * DEG, exit: 180.0 * DEG },
    }
}

/// Feed per tooth of the golden cases [m].
const CHIP: f64 = 1e-4;

/// Mean over a revolution, and the force at `phi`, from thin slices of the edge, chip by chip: the
/// definitions, without any closed form.
fn brute(cut: &Cut, phi: f64, c: f64, slices: usize) -> Vector3<f64> {
    let (outer, corner) = (cut.diameter / 2.0, cut.corner_radius);
    let mut total = Vector3::zeros();
    let dz = cut.axial_depth / slices as f64;
    let hand = if cut.hand == Hand::Right { 1.0 } else { -1.0 };
    for slice in 0..slices {
        let z = (slice as f64 + 0.5) * dz;
        let (radius, sin_k) = if z < corner {
            let out = (corner * corner - (corner - z) * (corner - z)).sqrt();
            (outer - corner + out, out / corner)
        } else {
            (outer, 1.0)
        };
        let cos_k = (1.0 - sin_k * sin_k).max(0.0).sqrt();
        for tooth in 0..cut.flutes {
            let lag = hand * 2.0 * cut.helix.tan() * z / cut.diameter;
            let angle = (phi + TAU * f64::from(tooth) / f64::from(cut.flutes) - lag).rem_euclid(TAU);
            // The part as a half plane, not as angles.
            let y = radius * angle.cos();
            let ahead = angle < PI;
            let engaged = match cut.engagement {
                Engagement::Angles { entry, exit } => angle >= entry && angle <= exit,
                Engagement::Slot => ahead,
                // The pass before left the same profile.
                Engagement::Climb(depth) => ahead && y <= -(radius - depth),
                Engagement::Conventional(depth) => ahead && y >= radius - depth,
            };
            if !engaged {
                continue;
            }
            let (h, db) = (c * angle.sin() * sin_k, dz / sin_k);
            let k = &cut.coefficients;
            let (t, r, a) = ((k.ktc * h + k.kte) * db, (k.krc * h + k.kre) * db, (k.kac * h + k.kae) * db);
            let out = Vector3::new(angle.sin(), angle.cos(), 0.0);
            let along = Vector3::new(-angle.cos(), angle.sin(), 0.0);
            let normal = out * sin_k - Vector3::z() * cos_k;
            // A right-hand helix: the force along the profile points inwards and to the tip.
            total += along * t - normal * r - (out * cos_k + Vector3::z() * sin_k) * (hand * a);
        }
    }
    total
}

fn average(cut: &Cut, c: f64, steps: usize) -> Vector3<f64> {
    let (_, forces) = cut.revolution(steps, c);
    forces[..steps].iter().sum::<Vector3<f64>>() / steps as f64
}
