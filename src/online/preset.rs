//! Controllers whose path can be corrected while it runs, and how late they act.

use crate::error::Error;
use crate::online::LoopTimes;

/// What is known of a controller's interface for corrections.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoopPreset {
    /// Stable slug.
    pub id: &'static str,
    /// Name of the interface.
    pub name: &'static str,
    /// Its times; the filter is the sensor's, and none is assumed.
    pub times: LoopTimes,
    /// Where they come from, and what is assumed.
    pub source: &'static str,
}

const fn times(cycle: f64, dead_time: f64) -> LoopTimes {
    LoopTimes { cycle, dead_time, arm_lag: 0.02, filter: 0.0 }
}

/// The controllers. A lag of the arm of 20 ms is assumed for each.
pub const PRESETS: [LoopPreset; 4] = [
    LoopPreset {
        id: "kuka-rsi-4",
        name: "KUKA RSI 4 ms",
        times: times(0.004, 0.008),
        source: "Cycle of IPO_FAST; a dead time of two cycles is assumed. Measure yours",
    },
    LoopPreset {
        id: "kuka-rsi-12",
        name: "KUKA RSI 12 ms",
        times: times(0.012, 0.12),
        source: "120 ms from command to motion measured with RSI 2 (kuka_experimental, issues 71 and 132)",
    },
    LoopPreset {
        id: "abb-egm",
        name: "ABB EGM 4 ms",
        times: times(0.004, 0.05),
        source: "Dead time of 50 ms, 40 to 80 ms in all, as users report (abb_libegm, issues 49, 111 and 131)",
    },
    LoopPreset {
        id: "staubli-4",
        name: "Stäubli 4 ms",
        times: times(0.004, 0.02),
        source: "Cycle of the controller; a dead time of five cycles is assumed. Measure yours",
    },
];

impl LoopPreset {
    /// The one of this id.
    ///
    /// # Errors
    /// [`Error::Invalid`] with all ids.
    pub fn named(id: &str) -> Result<Self, Error> {
        let known = PRESETS.iter().find(|preset| preset.id == id).copied();
        known.ok_or_else(|| {
            Error::unknown_name("online.preset", id, "one of", PRESETS.map(|preset| preset.id))
        })
    }
}
