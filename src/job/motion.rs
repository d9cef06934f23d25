//! The job's speed and sampling, mirroring the JSON. Values are as typed, not yet checked.

use crate::job::choice::{Choice, CornerDwell, HeldForce, choice};
use crate::job::json::keys;
use serde::Serialize;

choice! {
    /// What sets the feed along the path.
    FeedRule {
        /// The program, or the job where it states none.
        #[default]
        Programmed = "programmed",
        /// The mean force, which it holds within limits.
        ConstantForce = "constant-force",
    }
}

/// Speed and sampling.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Motion {
    /// Feed along the path.
    pub feed_mm_s: f64,
    /// Speed of a program's rapid moves.
    pub rapid_mm_s: f64,
    /// Acceleration along the path.
    pub acceleration_mm_s2: f64,
    /// Sample time.
    pub sample_time_s: f64,
    /// A sharper corner is a full stop.
    pub corner_angle_deg: f64,
    /// Time at rest in a full-stop corner.
    pub corner_dwell: CornerDwell,
    /// What sets the feed; default as programmed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub feed_rule: Option<FeedRule>,
    /// The mean force that a feed by force holds; default the median along the program.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_n: Option<HeldForce>,
    /// Its lowest feed in percent of the programmed one; default 25.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub feed_least_percent: Option<f64>,
    /// Its highest feed in percent of the programmed one; default 100.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub feed_most_percent: Option<f64>,
}

impl Default for Motion {
    fn default() -> Self {
        Self {
            feed_mm_s: 100.0,
            rapid_mm_s: 250.0,
            acceleration_mm_s2: 200.0,
            sample_time_s: 0.001,
            corner_angle_deg: 5.0,
            corner_dwell: Choice::Word,
            feed_rule: None,
            force_n: None,
            feed_least_percent: None,
            feed_most_percent: None,
        }
    }
}

keys!(Motion {
    feed_mm_s,
    rapid_mm_s,
    acceleration_mm_s2,
    sample_time_s,
    corner_angle_deg,
    corner_dwell,
    feed_rule,
    force_n,
    feed_least_percent,
    feed_most_percent
});
