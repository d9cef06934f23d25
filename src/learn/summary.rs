//! What a measured pass taught, in numbers and words.

use crate::deviation::contour::MeanMax;
use crate::job;
use crate::learn::factors::{FactorInterval, estimate};
use crate::learn::measured::{millimetres, root_mean_square};
use crate::learn::{Commanded, LearnedFactors, LearningGain, MeasuredPass, NextPass};
use crate::report::{Report, Statistics};
use crate::units::MM;
use nalgebra::Vector3;
use serde::Serialize;

/// How a log was read.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReadSummary {
    /// What ran: `desired` or `corrected`, with what earlier passes taught if there was any.
    pub commanded: &'static str,
    /// Number of passes' teaching that was in it: whether there was any.
    pub learned_before: bool,
    /// Frame in which it was measured.
    pub frame: &'static str,
    /// From the first row until the run begins [s], of a log over time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shift_s: Option<f64>,
    /// The same along the path [mm], of a log over arc length.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shift_mm: Option<f64>,
    /// How far positions lie from where they are expected, root mean square [mm].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance_mm: Option<f64>,
    /// Correlation with what the model expects.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub correlation: Option<f64>,
    /// Corner of the low pass [Hz].
    pub corner_hz: f64,
    /// Standard deviation along an axis of what changes from row to row [mm].
    pub noise_mm: f64,
    /// Share of the run at which something was measured [%].
    pub covered_percent: f64,
    /// What was recognised.
    pub recognised: Vec<String>,
    /// What is odd.
    pub remarks: Vec<String>,
}

/// The next pass.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NextSummary {
    /// The measured error, through the low pass [mm].
    pub measured_mm: Statistics,
    /// What would be left of it if it comes back and corrections act as they are commanded [mm].
    pub expected_mm: Statistics,
    /// Largest change of the commands [mm].
    pub largest_change_mm: f64,
    /// Gain a.
    pub gain: f64,
    /// It converges where corrections move the tip by less than so many times as much as is commanded.
    pub converges_below: f64,
    /// Standard deviation of the error that the noise leaves in the end [mm].
    pub noise_floor_mm: f64,
}

/// A factor.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FactorSummary {
    /// `stiffness-1` to `stiffness-6`, `cutting`, `radial-ratio`, `axial-ratio`.
    pub input: String,
    /// The factor.
    pub value: f64,
    /// 95 % interval.
    pub interval: [f64; 2],
    /// The interval before the measurement.
    pub before: [f64; 2],
}

/// Factors on stiffness and cutting force.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FactorsSummary {
    /// Each of them.
    pub factors: Vec<FactorSummary>,
    /// By which estimator.
    pub estimator: String,
    /// Share of the mean square of the tip's error that the model explained before, and explains now [%].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub explained_percent: Option<[f64; 2]>,
    /// The same of the force.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_explained_percent: Option<[f64; 2]>,
    /// The section `learned` of a job that has them.
    pub learned: job::Learned,
}

/// All that a pass taught.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LearnSummary {
    /// How the log was read.
    pub log: ReadSummary,
    /// The next pass; absent of a log of forces alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub next: Option<NextSummary>,
    /// Factors on stiffness and cutting force.
    pub factors: FactorsSummary,
    /// What the model does not explain.
    pub unexplained: Vec<String>,
}

impl LearnSummary {
    /// Of a measured pass, with the next one if there is one. A job that has learned before keeps those factors: the new
    /// ones come on top.
    pub fn of(
        report: &Report,
        before: Option<&job::Learned>,
        measured: &MeasuredPass,
        next: Option<(&NextPass, LearningGain)>,
    ) -> Self {
        let factors = estimate(report, measured);
        Self {
            log: read(measured),
            next: next.map(|(next, gain)| next_summary(measured, next, gain)),
            unexplained: unexplained(report, measured, &factors),
            factors: factors_summary(&factors, before),
        }
    }
}

fn read(measured: &MeasuredPass) -> ReadSummary {
    let MeasuredPass { commanded: Commanded { corrected, learned }, alignment, by_time, .. } = measured;
    let shift = |of_time: bool| alignment.filter(|_| *by_time == of_time).map(|alignment| alignment.shift);
    let by = |distance: bool| {
        use crate::learn::alignment::ComparedBy;
        let wanted = if distance { ComparedBy::Distance } else { ComparedBy::Likeness };
        alignment.filter(|alignment| alignment.by == wanted).map(|alignment| alignment.agreement)
    };
    ReadSummary {
        commanded: if *corrected { "corrected" } else { "desired" },
        learned_before: learned.iter().any(|v| *v != Vector3::zeros()),
        frame: measured.frame,
        shift_s: shift(true),
        shift_mm: shift(false).map(|shift| shift / MM),
        distance_mm: by(true).filter(|_| !measured.only_joints).map(|agreement| -agreement / MM),
        correlation: by(false),
        corner_hz: measured.corner,
        noise_mm: measured.noise / MM,
        covered_percent: 100.0 * measured.covered,
        recognised: measured.said.recognised.clone(),
        remarks: measured.said.odd.clone(),
    }
}

fn next_summary(measured: &MeasuredPass, next: &NextPass, gain: LearningGain) -> NextSummary {
    let change = next.correction.iter().zip(&measured.correction).map(|(new, old)| (new - old).norm());
    NextSummary {
        measured_mm: next.before.into(),
        expected_mm: next.after.into(),
        largest_change_mm: change.fold(0.0, f64::max) / MM,
        gain: gain.value(),
        converges_below: gain.converges_below(),
        noise_floor_mm: gain.noise_floor(1.0) * measured.noise / MM,
    }
}

fn factors_summary(factors: &LearnedFactors, before: Option<&job::Learned>) -> FactorsSummary {
    let row = |input: String, of: &FactorInterval| FactorSummary {
        input,
        value: of.value,
        interval: of.interval,
        before: of.prior,
    };
    let mut rows: Vec<FactorSummary> = Vec::new();
    for (joint, factor) in factors.stiffness.iter().enumerate() {
        rows.extend(factor.as_ref().map(|factor| row(format!("stiffness-{}", joint + 1), factor)));
    }
    rows.push(row("cutting".into(), &factors.cutting));
    for (name, ratio) in ["radial-ratio", "axial-ratio"].into_iter().zip(&factors.ratios) {
        rows.push(row(name.into(), ratio));
    }
    let known = before.cloned().unwrap_or_default();
    let (compliance, force) = (factors.compliance_factors(), factors.force_factors());
    FactorsSummary {
        factors: rows,
        estimator: format!(
            "largest posterior probability (Gauss-Newton), the job's own ranges as the prior, \
             noise from what is left in {} blocks of the run; 95 % intervals",
            factors.blocks
        ),
        explained_percent: factors.explained.map(|shares| shares.map(|share| 100.0 * share)),
        force_explained_percent: factors.force_explained.map(|shares| shares.map(|share| 100.0 * share)),
        learned: job::Learned {
            compliance_factors: std::array::from_fn(|i| known.compliance_factors[i] * compliance[i]),
            force_factors: std::array::from_fn(|i| known.force_factors[i] * force[i]),
            covariance: factors.covariance,
            source: known.source,
        },
    }
}

/// A factor whose interval is still this share of what it was was hardly measured.
const HARDLY: f64 = 0.8;
/// From this correlation on, two factors cannot be told apart.
const TIED: f64 = -0.7;
/// A difference of means counts from so many standard errors on.
const CLEAR: f64 = 3.0;

/// Shorter offsets and drifts are not spoken of [m].
const SEEN: f64 = 0.01 * MM;

/// What the model does not explain, in words.
fn unexplained(report: &Report, measured: &MeasuredPass, factors: &LearnedFactors) -> Vec<String> {
    let mut words = Vec::new();
    if let Some([before, now]) = factors.explained {
        let percent = |share: f64| format!("{:.0} %", 100.0 * share.max(0.0));
        words.push(format!(
            "The model explains {} of the measured error's mean square with these factors, {} without.",
            percent(now),
            percent(before)
        ));
        if now < 0.5 {
            words.push(
                "Most of it has another cause than deflection under the cutting force: calibration, following, friction, \
                 heat. The next pass's command takes it back if it comes back; factors do not."
                    .into(),
            );
        }
    }
    let rest: Vec<Vector3<f64>> = factors.rest.iter().map(|(_, rest)| *rest).collect();
    if let Some((s, worst)) = factors.rest.iter().max_by(|a, b| a.1.norm().total_cmp(&b.1.norm())) {
        let MeanMax { mean, .. } = MeanMax::of(&rest);
        words.push(format!(
            "{} is left on average, {} at most, {:.0} mm along the path.",
            millimetres(mean),
            millimetres(worst.norm()),
            s / MM
        ));
    }
    let (offset, deviation) = factors.offset;
    if factors.explained.is_some()
        && (0..3).any(|axis| offset[axis].abs() > (CLEAR * deviation[axis]).max(SEEN))
    {
        words.push(format!(
            "Everything is off by ({:.3}, {:.3}, {:.3}) mm in the base frame: zero of the workpiece or the instrument, or tool length.",
            offset.x / MM,
            offset.y / MM,
            offset.z / MM
        ));
    }
    let third = rest.len() / 3;
    if third >= 4 {
        let mean = |part: &[Vector3<f64>]| part.iter().sum::<Vector3<f64>>() / part.len() as f64;
        let drift = mean(&rest[rest.len() - third..]) - mean(&rest[..third]);
        let spread = root_mean_square(rest.iter()) * (2.0 / third as f64).sqrt();
        if drift.norm() > (CLEAR * spread).max(2.0 * measured.noise).max(SEEN) {
            words.push(format!(
                "What is left drifts by {} from the first to the last third of the run: heat, or slip.",
                millimetres(drift.norm())
            ));
        }
    }
    words.extend(not_told_apart(report, factors));
    words
}

/// Which factors the pass does not determine.
fn not_told_apart(report: &Report, factors: &LearnedFactors) -> Vec<String> {
    let mut words = Vec::new();
    let hardly: Vec<String> = (0..6)
        .filter(|joint| {
            factors.stiffness[*joint].is_some_and(|factor| {
                let width = |ends: [f64; 2]| crate::math::ln(ends[1] / ends[0]);
                width(factor.interval) > HARDLY * width(factor.prior)
            })
        })
        .map(|joint| (joint + 1).to_string())
        .collect();
    if !hardly.is_empty() {
        let plural = if hardly.len() == 1 { "" } else { "s" };
        words.push(format!(
            "Nothing was learned of joint{plural} {}: what they do hardly shows here.",
            hardly.join(", ")
        ));
    }
    let covariance = &factors.covariance;
    let tied = (0..6).filter(|joint| report.plan.robot.compliance()[*joint] > 0.0).any(|joint| {
        let both = (covariance[joint][joint] * covariance[6][6]).sqrt();
        both > 0.0 && covariance[joint][6] < TIED * both
    });
    if tied {
        words.push(
            "A deflection says how much force times compliance is, not which of them: \
             for another material, measure the force as well."
                .into(),
        );
    }
    words
}
