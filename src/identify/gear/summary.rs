//! A gear in numbers and words.

use super::{Gear, GearLog};

/// Fewer blocks than this make an interval that is too narrow.
const FEW: usize = 20;
/// Stiffnesses of joints that arms have, with room on both sides [N m/rad].
const KNOWN: [f64; 2] = [1e3, 1e8];
/// A longer delay between two readings is hardly one [s].
const LONGEST: f64 = 0.1;

/// A gear to be read.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct GearSummary {
    /// Number of the joint, from 1.
    pub joint: usize,
    /// Stiffness [N m/rad]; absent if the load did not show it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_nm_per_rad: Option<f64>,
    /// Its 95 % interval.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_interval_nm_per_rad: Option<[f64; 2]>,
    /// Delay between the two readings [ms], and its 95 % interval.
    pub delay_ms: f64,
    /// See there.
    pub delay_interval_ms: [f64; 2],
    /// Half the width of the hysteresis [urad], and its 95 % interval.
    pub hysteresis_urad: f64,
    /// See there.
    pub hysteresis_interval_urad: [f64; 2],
    /// Share of the variance that is explained.
    pub explained: f64,
    /// Root mean square of what no spring explains [urad].
    pub rest_urad: f64,
    /// The same of what delay and hysteresis alone leave [urad].
    pub rest_without_spring_urad: f64,
    /// Number of blocks behind the intervals.
    pub blocks: usize,
    /// Another run, predicted with this: share of its variance, and root mean square of the rest [urad].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub predicted: Option<PredictedRun>,
    /// All this in words.
    pub sentence: String,
    /// What makes it doubtful.
    pub remarks: Vec<String>,
}

/// A run that was not fitted.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct PredictedRun {
    /// Share of its variance.
    pub explained: f64,
    /// Root mean square of the rest [urad].
    pub rest_urad: f64,
    /// The same without the spring [urad].
    pub rest_without_spring_urad: f64,
}

/// Microradians.
const MICRO: f64 = 1e-6;

impl Gear {
    /// In numbers and words, with another run if there is one.
    pub fn summary(&self, other: Option<&GearLog>) -> GearSummary {
        let interval = |index: usize, unit: f64| {
            [-1.0, 1.0].map(|side| (self.values[index] + side * self.halves[index]) / unit)
        };
        let predicted = other.map(|other| {
            let (explained, rest) = self.predicts(other);
            let rest_without_spring_urad = self.left_without(other) / MICRO;
            PredictedRun { explained, rest_urad: rest / MICRO, rest_without_spring_urad }
        });
        GearSummary {
            joint: self.joint + 1,
            stiffness_nm_per_rad: self.stiffness(),
            stiffness_interval_nm_per_rad: self.stiffness_interval(),
            delay_ms: self.values[2] / 1e-3,
            delay_interval_ms: interval(2, 1e-3),
            hysteresis_urad: self.values[3] / MICRO,
            hysteresis_interval_urad: interval(3, MICRO),
            explained: self.explained,
            rest_urad: self.rest / MICRO,
            rest_without_spring_urad: self.rest_without / MICRO,
            remarks: self.remarks(),
            blocks: self.blocks,
            sentence: self.sentence(predicted),
            predicted,
        }
    }

    fn sentence(&self, predicted: Option<PredictedRun>) -> String {
        let joint = self.joint + 1;
        let spring = match self.stiffness().zip(self.stiffness_interval()) {
            Some((stiffness, [low, high])) => format!(
                "Joint {joint} has {:.2}e6 N m/rad ({:.2} to {:.2})",
                stiffness / 1e6,
                low / 1e6,
                high / 1e6
            ),
            None => format!("The stiffness of joint {joint} does not show"),
        };
        let other = predicted.map_or(String::new(), |other| {
            format!(
                " Of the other run, {:.1} % are predicted: {:.0} µrad are left, {:.0} without the spring.",
                100.0 * other.explained,
                other.rest_urad,
                other.rest_without_spring_urad
            )
        });
        format!(
            "{spring}; load follows motor by {:.1} ms, and lags by {:.0} µrad to each side. {:.1} % of the difference of the readings is \
             explained: delay and hysteresis alone leave {:.0} µrad (root mean square), with the spring {:.0} µrad are left.{other}",
            self.values[2] / 1e-3,
            self.values[3] / MICRO,
            100.0 * self.explained,
            self.rest_without / MICRO,
            self.rest / MICRO
        )
    }

    fn remarks(&self) -> Vec<String> {
        let mut remarks = Vec::new();
        if self.values[1] + self.halves[1] < 0.0 {
            remarks.push(
                "the difference shrinks with the load, as no spring does: the torque may count the other way, or motor and load \
                 may be swapped"
                    .to_owned(),
            );
        }
        if self.is_ahead() {
            remarks
                .push("the load's angle is ahead of the motor's: motor and load may be swapped".to_owned());
        }
        if self.stiffness().is_some_and(|stiffness| !(KNOWN[0]..=KNOWN[1]).contains(&stiffness)) {
            remarks.push("no arm has such a stiffness: check the units of angles and torque".to_owned());
        }
        if self.values[2].abs() > LONGEST {
            remarks.push("so long a delay is hardly one: check the unit of time".to_owned());
        }
        if self.blocks < FEW {
            remarks.push(format!(
                "only {} blocks of half a second: the intervals are too narrow, so record ten seconds or more",
                self.blocks
            ));
        }
        remarks
    }
}
