//! The result of a run: numbers, verdict in words, warnings, columns, fingerprint.

pub mod columns;
pub mod warning;
pub mod thesis;
pub mod scene;
mod budget;
mod cut;
mod drives;
mod feed_rule;
pub(crate) mod limit;
mod onset;
mod overload;
mod payload;
mod reference;
mod remedy;
mod roll;
mod severity;
pub(crate) mod singularity;
mod span;
mod stops;
mod summary;
mod verdict;
mod expected;
mod in_stock;
mod surface;
mod taught;

pub use budget::{Budget, Parts};
pub use cut::{CutFigures, WallFigures};
pub use feed_rule::{FeedOutcome, FeedRuleGain};
pub(crate) use in_stock::UNTOUCHED;
pub use remedy::Remedy;
pub use roll::{RollGain, RollOutcome};
pub use severity::Severity;
pub use span::MOST_SPANS;
pub use stops::Stops;
pub use summary::{Statistics, Summary, WorstPlace};
pub use surface::{PartKind, SurfaceFigures, SurfaceSpot};
pub use taught::Taught;
pub use verdict::VerdictState;
pub(crate) use verdict::decapitalised;
pub use warning::Warning;

use crate::compensation::{Compensation, Question, compensate};
use crate::deviation::{Deviation, Largest, Reference, Source, Sources};
use crate::motion::shaper::Shaped;
use crate::online::{Comparison, LoopedRun, OnlineLoop};
use crate::plan::Plan;
use crate::progress::Progress;
use crate::robot::Joints;
use crate::robot::inverse::Branch;
use crate::setup::Setup;
use crate::surface::Surface;
use crate::uncertainty::ErrorBand;
use crate::units::MM;
use nalgebra::Vector3;
use std::sync::{Arc, OnceLock};

/// Everything that was computed for a job.
#[derive(Debug, Clone)]
pub struct Report {
    /// Arm, path and motion as simulated, with the job's setup in SI.
    pub plan: Plan,
    /// Joint commands for the desired path [rad].
    pub q: Arc<Vec<Joints>>,
    /// Inverse kinematics branch at the start.
    pub branch: Branch,
    /// Gain from a free roll about the tool axis, if it is free.
    pub roll: Option<RollGain>,
    /// Gain of the feed rule over the programmed feed, if there is one.
    pub feed_rule: Option<FeedRuleGain>,
    /// Force on the tool in its place, in the base frame, every source acting [N].
    pub planned_force: Arc<Vec<Vector3<f64>>>,
    /// Force on the tool in the base frame with the desired path commanded, every source acting [N]:
    /// the planned one, unless it follows the deflection.
    pub force: Arc<Vec<Vector3<f64>>>,
    /// Samples at which a force that follows the deflection finds no balance with it.
    pub unsettled: Vec<usize>,
    /// Tip deflection under that force with the desired path commanded [m].
    pub deflection: Vec<Vector3<f64>>,
    /// Deviation with the desired path commanded, only cutting forces acting.
    pub deflection_only: Arc<Deviation>,
    /// Deviation with the desired path commanded, only the shaper acting.
    pub shaping_only: Arc<Deviation>,
    /// Deviation with the desired path commanded, every source acting.
    pub before: Arc<Deviation>,
    /// The path to command instead.
    pub compensation: Compensation,
    /// Deviation with the compensated path commanded, every source acting.
    pub after: Arc<Deviation>,
    /// What is left on the part with what is known of robot and material.
    pub band: ErrorBand,
    /// The surface that is left, if the engagement follows a stock.
    pub surface: Option<Surface>,
    /// What a measured pass has changed of the commands, if one did.
    pub taught: Option<Taught>,
    /// The loop of the job on top of the path, and what it would bring.
    pub online: Option<(OnlineLoop, Comparison)>,
    /// Conditions that are odd but workable.
    pub warnings: Vec<Warning>,
    /// See [`Report::alone`]; computed on first use.
    pub(crate) alone: [OnceLock<Compensation>; 2],
    /// See [`Report::fingerprint`]; computed on first use.
    pub(crate) fingerprint: OnceLock<String>,
    /// See [`Report::missed`].
    pub(crate) missed: Largest,
}

impl Report {
    /// The job's setup in SI.
    pub fn setup(&self) -> &Setup {
        &self.plan.setup
    }

    /// Adds warnings and sorts them all: what cannot run is said before what it would achieve.
    pub(crate) fn warn(&mut self, more: impl IntoIterator<Item = Warning>) {
        self.warnings.extend(more);
        self.warnings.sort_by_key(|warning| warning.severity);
    }

    /// The number of samples, and of rows in every column.
    pub fn samples(&self) -> usize {
        self.plan.trajectory.len()
    }

    /// Time from the first to the last sample [s].
    pub fn duration(&self) -> f64 {
        (self.samples() - 1) as f64 * self.plan.trajectory.sample_time
    }

    /// One source compensated as if it acted alone (Figs. 5.13, 5.15).
    pub fn alone(&self, source: Source) -> &Compensation {
        let (place, known) = match source {
            Source::Deflection => (&self.alone[0], &self.deflection_only),
            Source::Shaping => (&self.alone[1], &self.shaping_only),
        };
        place.get_or_init(|| {
            let reference = Reference::along(&self.plan, Sources::only(source));
            let goal = self.setup().goal;
            let question = Question { reference: &reference, q: &self.q, before: known, goal };
            compensate(&self.plan, &question, &mut Progress::none())
        })
    }

    /// The run, for a loop on top of it.
    pub fn looped(&self) -> LoopedRun<'_> {
        let Self { plan, band, .. } = self;
        LoopedRun { plan, desired: &self.q, corrected: &self.compensation.q, band }
    }

    /// Joint commands after the shaper.
    pub fn shaped<'a>(&self, q: &'a [Joints]) -> Shaped<'a, Joints> {
        self.plan.shaper().shaped(q, self.plan.trajectory.sample_time)
    }

    /// Largest contour error with the compensated path commanded, every source acting [m].
    pub fn after_max(&self) -> f64 {
        self.after.statistics.max
    }

    /// What of the desired path the actual tip never reaches with the compensated path commanded,
    /// every source acting: the largest distance from a point of the path to the nearest place that
    /// the tip passes [m].
    pub fn missed(&self) -> Largest {
        self.missed
    }

    /// The largest error at the top of the cut with the compensated path commanded, every source
    /// acting [m]: that of the tip and what the tilt of the tool adds over the axial depth, across
    /// the path, where the tool cuts.
    pub fn wall(&self) -> Largest {
        self.after.wall
    }

    /// The path to command: the desired positions with their correction, base frame [m].
    pub fn commanded(&self) -> Vec<Vector3<f64>> {
        self.plan.trajectory.position.iter().zip(&self.compensation.correction).map(|(p, c)| p + c).collect()
    }
}

/// A length [m] as text in mm: three significant digits, but no finer than a tenth of a micrometre,
/// beyond any machine's resolution.
pub(crate) fn millimetres(length: f64) -> String {
    length_text(length, MM, 4)
}

/// A length [m] as text in a unit [m]: three significant digits, but at most `places` decimal
/// places.
pub(crate) fn length_text(length: f64, unit: f64, places: i32) -> String {
    let value = length / unit;
    let finest = crate::math::pow(10.0, f64::from(-places));
    if value > 0.0 && value < 0.5 * finest {
        return format!("less than {finest}");
    }
    let magnitude = if value == 0.0 { 0.0 } else { crate::math::log10(value.abs()).floor() };
    let digits = (2.0 - magnitude).clamp(0.0, f64::from(places)) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// The lengths of vectors [m] in mm.
pub(crate) fn norms_mm(vectors: &[Vector3<f64>]) -> Vec<f64> {
    vectors.iter().map(|v| v.norm() / MM).collect()
}

#[cfg(test)]
mod tests {
    use super::millimetres;

    #[test]
    fn lengths_are_read_with_three_digits() {
        for (m, text) in [
            (1.26134e-3, "1.26"),
            (2.9e-6, "0.0029"),
            (1e-5, "0.01"),
            (0.0, "0"),
            (0.1234, "123"),
            (1.0e-4, "0.1"),
            (7.88e-7, "0.0008"),
            (1e-9, "less than 0.0001"),
        ] {
            assert_eq!(millimetres(m), text);
        }
    }
}
