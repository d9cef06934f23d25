//! The job's section `online`: a loop that would correct the arm while it mills.

use crate::job::choice::{Choice, LargestCorrection, LoopGain, choice};
use crate::job::json::keys;
use serde::Serialize;

choice! {
    /// What the loop measures.
    MeasuredOnline {
        /// Nothing: there is no loop.
        #[default]
        None = "none",
        /// The force on the tool.
        Force = "force",
        /// The position of the tool.
        Position = "position",
        /// The joints' angles behind their gears.
        LoadSideAngle = "load-side-angle",
    }
}

/// The loop. The other keys count once something is measured; cycle and dead time are also those of a
/// [table of corrections](crate::export::superposed).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Online {
    /// What it measures.
    pub measures: MeasuredOnline,
    /// Time between two corrections.
    pub cycle_s: f64,
    /// From the measurement until the arm begins to move.
    pub dead_time_s: f64,
    /// Time constant of the arm's following.
    pub arm_lag_s: f64,
    /// Time constant of the measurement's filter.
    pub filter_s: f64,
    /// Standard deviation of the noise along each axis [mm]; of a force, of the deflection that it should cause. Its seed is
    /// that of the draws.
    pub noise: f64,
    /// Step of what is measured [mm]; 0 for none.
    pub resolution: f64,
    /// Largest correction.
    pub largest_correction_mm: LargestCorrection,
    /// Integral gain for each cycle; of a force, the share of the deflection that is taken back.
    pub gain: LoopGain,
}

impl Default for Online {
    fn default() -> Self {
        Self {
            measures: MeasuredOnline::None,
            cycle_s: 0.004,
            dead_time_s: 0.008,
            arm_lag_s: 0.02,
            filter_s: 0.0,
            noise: 0.0,
            resolution: 0.0,
            largest_correction_mm: Choice::Word,
            gain: Choice::Word,
        }
    }
}

impl Online {
    /// Whether the job says nothing of a loop.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

keys!(Online {
    measures,
    cycle_s,
    dead_time_s,
    arm_lag_s,
    filter_s,
    noise,
    resolution,
    largest_correction_mm,
    gain
});
