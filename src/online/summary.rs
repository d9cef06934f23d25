//! What a loop would bring, in numbers and words.

use crate::online::Comparison;
use crate::uncertainty::Quantiles;
use crate::units::MM;
use serde::Serialize;

/// Two quantiles of the largest contour error [mm].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LoopError {
    /// Half of the plants leave at most this.
    pub p50: f64,
    /// 95 % of them.
    pub p95: f64,
}

/// A [`Comparison`] to be read.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OnlineSummary {
    /// Nothing corrects.
    pub without: LoopError,
    /// The commands are corrected.
    pub offline: LoopError,
    /// The loop corrects; absent if it is not stable.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub online: Option<LoopError>,
    /// Both do; absent if the loop is not stable.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub both: Option<LoopError>,
    /// Below this frequency the loop leaves less than there was [Hz].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub helps_below_hz: Option<f64>,
    /// Share of the error's mean square that lies there.
    pub slow_share: f64,
    /// Whether the loop is stable.
    pub stable: bool,
    /// Its gain.
    pub gain: f64,
    /// The gain from which on it is not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_stable_gain: Option<f64>,
    /// All this in a few words.
    pub verdict: String,
}

impl Comparison {
    /// The same in mm and words.
    pub fn summary(&self) -> OnlineSummary {
        let error = |of: Quantiles| LoopError { p50: of.p50 / MM, p95: of.p95 / MM };
        OnlineSummary {
            without: error(self.without),
            offline: error(self.offline),
            online: self.online.map(error),
            both: self.both.map(error),
            helps_below_hz: self.helps_below,
            slow_share: self.slow_share,
            stable: self.stable(),
            gain: self.gain,
            largest_stable_gain: self.largest_stable_gain,
            verdict: self.verdict(),
        }
    }

    fn verdict(&self) -> String {
        let mm = |of: Quantiles| match of.p95 / MM {
            p95 if p95 < 0.01 => "less than 0.01 mm".to_owned(),
            p95 => format!("{p95:.2} mm"),
        };
        let (Some(online), Some(both)) = (self.online, self.both) else {
            return format!(
                "The loop is not stable: its gain of {:.3} is not below {:.3}.",
                self.gain,
                self.largest_stable_gain.unwrap_or_default()
            );
        };
        let helps = match self.helps_below {
            None => "The loop helps at no frequency".to_owned(),
            Some(frequency) => {
                let share = match 100.0 * self.slow_share {
                    percent if percent > 99.0 => "more than 99 %".to_owned(),
                    percent => format!("{percent:.0} %"),
                };
                format!("The loop helps below {frequency:.1} Hz; {share} of this error lies there")
            }
        };
        format!(
            "{helps}. Largest error in 95 of 100 cases: {} with nothing, {} with corrected commands, {} with the loop, {} with both.",
            mm(self.without),
            mm(self.offline),
            mm(online),
            mm(both)
        )
    }
}
