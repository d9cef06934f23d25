//! Controllers whose path can be corrected while it runs, what measures the tool from outside, and how late they act.

use crate::error::Error;
use crate::online::{LoopTimes, OnlineLoop};
use crate::units::MM;

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

/// What is assumed of an instrument that measures where the tool is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensorPreset {
    /// Stable slug.
    pub id: &'static str,
    /// What it is.
    pub name: &'static str,
    /// From the moment that is measured until the controller has it [s].
    pub dead_time: f64,
    /// Standard deviation of its noise along each axis [m].
    pub noise: f64,
    /// Where these come from, and what is assumed.
    pub source: &'static str,
}

/// The instruments. What they are late by is assumed: no maker's figure for it was found.
pub const SENSORS: [SensorPreset; 2] = [
    SensorPreset {
        id: "tracker",
        name: "Laser tracker",
        dead_time: 0.004,
        noise: 0.01 * MM,
        source: "Errors of some hundredths of a millimetre over metres are usual; noise of 0.01 mm and 4 ms for \
                 measuring and sending are assumed. Measure yours",
    },
    SensorPreset {
        id: "camera",
        name: "Cameras",
        dead_time: 0.04,
        noise: 0.02 * MM,
        source: "0.015 mm of mean path error were reached with cameras and an IRB 120 without cutting \
                 (doi 10.1177/09544054221131156); noise of 0.02 mm and 40 ms, a picture at 30 Hz and its evaluation, \
                 are assumed. Measure yours",
    },
];

impl SensorPreset {
    /// The one of this id.
    ///
    /// # Errors
    /// [`Error::Invalid`] with all ids.
    pub fn named(id: &str) -> Result<Self, Error> {
        let known = SENSORS.iter().find(|preset| preset.id == id).copied();
        known.ok_or_else(|| {
            Error::unknown_name("online.sensor", id, "one of", SENSORS.map(|preset| preset.id))
        })
    }

    /// Lets a loop measure with it: the controller's dead time comes on top.
    pub fn put_on(&self, online: &mut OnlineLoop) {
        online.times.dead_time += self.dead_time;
        online.sensor.noise = self.noise;
    }
}
