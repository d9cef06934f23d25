//! A pocket cleared as by an adaptive strategy: a spiral of short chords through a stock, which the
//! engagement follows.
#![allow(clippy::disallowed_methods, reason = "three decimals are the same everywhere")]

use std::f64::consts::TAU;
use std::fmt::Write;
use std::hint::black_box;

use armill::setup::Setup;
use armill::{Error, Job, Progress};
use serde_json::json;

/// Samples for each move.
pub const SAMPLES_A_MOVE: usize = 10;
/// Length of a move and distance from one turn to the next [mm].
const CHORD: f64 = 1.0;
const PITCH: f64 = 1.0;

/// A job with roughly this many samples and a tenth as many moves.
pub fn job(samples: usize) -> String {
    let mut text = String::from("G21 G90\nG0 X0 Y0 Z5\nG1 Z-3 F600\n");
    let (mut turn, mut radius) = (0.0_f64, 0.0);
    for _ in 0..samples / SAMPLES_A_MOVE {
        radius = PITCH * turn / TAU;
        let _ = writeln!(text, "G1 X{:.3} Y{:.3} F6000", radius * turn.cos(), radius * turn.sin());
        turn += CHORD / radius.max(1.0);
    }
    let half = radius.ceil() + 20.0;
    json!({
        "robot": {"preset": "kuka-kr-300-r2700-2"},
        "tool_frame": {"xyz_mm": [0, 0, 300]},
        "workpiece_frame": {"xyz_mm": [1800, 0, 700]},
        "path": {"kind": "gcode", "text": text + "G0 Z5\n"},
        "stock": {"kind": "box", "from_mm": [-half, -half, -20], "to_mm": [half, half, 0]},
        "motion": {"sample_time_s": 0.001, "feed_mm_s": 100, "acceleration_mm_s2": 5000},
        "tool": {"diameter_mm": 10, "flutes": 3, "helix_deg": 30},
        "material": {"preset": "al-7075-t6"},
        "cutting": {"spindle_rpm": 8000, "feed_per_tooth_mm": "from_feed"},
        "shaper": "none",
    })
    .to_string()
}

/// Reads a job and follows its stock.
///
/// # Errors
/// If the job is invalid.
pub fn engagement(text: &str) -> Result<(), Error> {
    let setup = Setup::of(&Job::from_json(text)?, &mut Progress::none())?;
    drop(black_box(setup.contacts));
    Ok(())
}
