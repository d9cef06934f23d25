//! What a feed that holds the force gains over the programmed one.

use crate::deviation::Deviation;
use crate::plan::Plan;
use crate::report::millimetres;
use crate::units::MM;
use nalgebra::Vector3;
use serde::Serialize;

/// Forces, errors and time of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FeedOutcome {
    /// Largest mean force along the path [N].
    pub largest_force_n: f64,
    /// Its mean over the time in material [N].
    pub mean_force_n: f64,
    /// Largest force within a revolution where the mean is largest as the tool goes along, plunges aside [N].
    pub peak_force_n: f64,
    /// Largest contour error before compensation, every source acting [mm].
    pub largest_error_mm: f64,
    /// Mean contour error before compensation, every source acting [mm].
    pub mean_error_mm: f64,
    /// Time from the first to the last sample [s].
    pub time_s: f64,
}

impl FeedOutcome {
    /// The outcome of a plan with its forces [N] and its deviation `before` compensation.
    pub(crate) fn of(plan: &Plan, forces: &[Vector3<f64>], before: &Deviation) -> Self {
        let setup = &plan.setup;
        let sizes = || forces.iter().map(|force| force.norm()).filter(|force| *force > 0.0);
        let peak = setup
            .heaviest
            .zip(setup.contacts.as_ref())
            .map_or(0.0, |(place, contacts)| setup.cut.peak_force_in(&place.contact(contacts), place.chip));
        Self {
            largest_force_n: sizes().fold(0.0, f64::max),
            // An empty sum would be -0.
            mean_force_n: sizes().fold(0.0, |sum, force| sum + force) / sizes().count().max(1) as f64,
            peak_force_n: peak,
            largest_error_mm: before.statistics.max / MM,
            mean_error_mm: before.statistics.mean / MM,
            time_s: (plan.trajectory.len() - 1) as f64 * plan.trajectory.sample_time,
        }
    }
}

/// The gain of a feed rule.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FeedRuleGain {
    /// The mean force to hold [N].
    pub force_n: f64,
    /// Lowest feed, in percent of the programmed one.
    pub least_percent: f64,
    /// Highest feed, in percent of the programmed one.
    pub most_percent: f64,
    /// Share of the way at feed on which the feed is at its lower limit.
    pub share_at_least: f64,
    /// Share of the way at feed on which the feed is at its upper limit.
    pub share_at_most: f64,
    /// Outcome at the programmed feed.
    pub programmed: FeedOutcome,
    /// Outcome with the rule.
    pub constant_force: FeedOutcome,
    /// The comparison in words.
    pub sentence: String,
}

impl FeedRuleGain {
    /// The gain of a plan's rule, if it has one.
    pub(crate) fn new(plan: &Plan, programmed: FeedOutcome, held: FeedOutcome) -> Option<Self> {
        let by_force = plan.setup.feed_rule.as_ref()?;
        let (force_n, [share_at_least, share_at_most]) = (by_force.rule.force, by_force.at_limits);
        let (least_percent, most_percent) = (by_force.rule.least * 100.0, by_force.rule.most * 100.0);
        let sentence = format!(
            "Constant force: the feed holds {force_n:.0} N, from {least_percent:.0} to {most_percent:.0} % of the \
             programmed one. The largest contour error before compensation is {} mm ({} mm at the programmed \
             feed), the largest mean force {:.0} N ({:.0} N), the time {:.1} s ({:.1} s).",
            millimetres(held.largest_error_mm * MM),
            millimetres(programmed.largest_error_mm * MM),
            held.largest_force_n,
            programmed.largest_force_n,
            held.time_s,
            programmed.time_s
        );
        Some(Self {
            force_n,
            least_percent,
            most_percent,
            share_at_least,
            share_at_most,
            programmed,
            constant_force: held,
            sentence,
        })
    }
}
