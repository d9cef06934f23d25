//! Identification results as plain data, with the units in the names, and as sentences.
//!
//! JSON has no infinity: an unbounded number is `None` here and `null` there.

use crate::identify::measurement::Measurements;
use crate::identify::response::{Measured, Mode, Other};
use crate::identify::stiffness::{Fit, Joint, Residual, Verdict};
use crate::identify::trials;
use crate::robot::Robot;
use crate::spread::Stiffness;
use crate::units::{HZ, MM};
use serde::Serialize;

/// Number of worst rows listed.
const WORST: usize = 3;

/// A fit of joint compliances.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StiffnessSummary {
    /// The arm's name.
    pub robot: String,
    /// Source of the compliances, in words.
    pub source: String,
    /// Number of rows fitted.
    pub rows: usize,
    /// Measured components minus free compliances.
    pub degrees_of_freedom: usize,
    /// Joint compliances [rad/(N m)].
    pub joint_compliance_rad_per_nm: [f64; 6],
    /// Their covariance [(rad/(N m))^2], for a job's `uncertainty.compliance_covariance`; none where
    /// the compliances are not known well enough to have one.
    pub compliance_covariance: Option<[[f64; 6]; 6]>,
    /// Share of the squared displacements that the joints' springs explain.
    pub explained: f64,
    /// Root mean square of the components' residuals [mm].
    pub residual_rms_mm: f64,
    /// Standard deviation of one component [mm], corrected for the degrees of freedom.
    pub standard_deviation_mm: f64,
    /// Mean over the rows of residual divided by measured length.
    pub mean_relative_residual: f64,
    /// Mean over the rows of left-out residual divided by measured length.
    pub mean_relative_left_out: f64,
    /// Ratio of largest to smallest singular value, columns scaled to unit length; none where a
    /// direction is unseen.
    pub condition: Option<f64>,
    /// The six joints.
    pub joints: Vec<JointSummary>,
    /// The rows in the order of the text.
    pub residuals: Vec<ResidualSummary>,
    /// Lines of the text, from 1, whose rows fit worst.
    pub worst_lines: Vec<usize>,
    /// How well the springs explain the data, in words.
    pub sentence: String,
    /// Oddities of the text that did not keep it from being read.
    pub remarks: Vec<String>,
}

/// The result for one joint.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointSummary {
    /// Number of the joint, from 1.
    pub joint: usize,
    /// Compliance [rad/(N m)].
    pub compliance_rad_per_nm: f64,
    /// Its 95 % confidence interval [rad/(N m)]; an end is none where it is unbounded.
    pub interval_rad_per_nm: [Option<f64>; 2],
    /// Stiffness [N m/rad]; none for a rigid joint.
    pub stiffness_nm_per_rad: Option<f64>,
    /// Variance as a multiple of what it would be if the other joints' columns were orthogonal to
    /// its own; none where it cannot be separated from them.
    pub variance_inflation: Option<f64>,
    /// Share of the variance from each singular direction, the best determined first; empty where
    /// there is no variance.
    pub direction_shares: Vec<f64>,
    /// Numbers of the joints, from 1, that are hard or impossible to separate from it.
    pub mixed_with: Vec<usize>,
    /// Factor on the loads that would bring its interval to 10 % on each side; none where more load
    /// does not help.
    pub load_factor: Option<f64>,
    /// [`Verdict::id`].
    pub verdict: &'static str,
    /// What the verdict means, and what would help.
    pub sentence: String,
}

/// The residual of one row.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ResidualSummary {
    /// Line of the text, from 1.
    pub line: usize,
    /// Length of the measured displacement [mm].
    pub measured_mm: f64,
    /// Length of the fitted displacement along the same axes [mm].
    pub fitted_mm: f64,
    /// Length of measured minus fitted [mm].
    pub residual_mm: f64,
    /// Length of measured minus predicted by a fit to all other rows [mm].
    pub left_out_mm: f64,
}

/// A vibration.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResponseSummary {
    /// Undamped natural frequency [rad/s].
    pub frequency_rad_s: f64,
    /// Its 95 % confidence interval [rad/s]; an end is none where it is unbounded.
    pub frequency_interval_rad_s: [Option<f64>; 2],
    /// Undamped natural frequency [Hz].
    pub frequency_hz: f64,
    /// Its 95 % confidence interval [Hz]; an end is none where it is unbounded.
    pub frequency_interval_hz: [Option<f64>; 2],
    /// Damping ratio.
    pub damping: f64,
    /// Its 95 % confidence interval; an end is none where it is unbounded.
    pub damping_interval: [Option<f64>; 2],
    /// Frequency and damping by logarithmic decrement, as a cross-check; absent where it disagrees with the fit, because noise,
    /// drift or a second mode disturbs the peaks.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decrement: Option<DecrementSummary>,
    /// A second mode, if the signal shows one.
    pub other: Option<OtherSummary>,
    /// Start of the part of the signal that was fitted [s].
    pub from_s: f64,
    /// End of that part [s].
    pub to_s: f64,
    /// Number of cycles in that part.
    pub cycles: f64,
    /// Samples per cycle.
    pub samples_per_cycle: f64,
    /// Share of the signal's variance that the fit explains.
    pub explained: f64,
    /// Passes of the fit.
    pub passes: usize,
    /// How much of the signal was fitted and how well, in words.
    pub sentence: String,
    /// Reasons to doubt the result.
    pub remarks: Vec<ResponseRemark>,
}

/// Frequency and damping from the extrema alone, by logarithmic decrement.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DecrementSummary {
    /// Undamped natural frequency [rad/s].
    pub frequency_rad_s: f64,
    /// Damping ratio.
    pub damping: f64,
}

/// A second mode in the signal.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OtherSummary {
    /// Undamped natural frequency [Hz].
    pub frequency_hz: f64,
    /// Damping ratio.
    pub damping: f64,
    /// Initial amplitude, as a share of the first mode's.
    pub amplitude_share: f64,
}

/// A reason to doubt a vibration.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResponseRemark {
    /// Stable slug.
    pub code: &'static str,
    /// The reason in words.
    pub message: String,
}

/// A fit of joint compliances.
pub fn stiffness(robot: &Robot, measurements: &Measurements, fit: &Fit) -> StiffnessSummary {
    let (relative, left_out) = fit.relative();
    StiffnessSummary {
        robot: robot.name().to_owned(),
        source: format!("identified from {} rows", fit.rows.len()),
        rows: fit.rows.len(),
        degrees_of_freedom: fit.freedom,
        joint_compliance_rad_per_nm: fit.compliance(),
        compliance_covariance: fit
            .covariance
            .filter(|covariance| Stiffness::together(&fit.compliance(), covariance).is_some()),
        explained: fit.explained,
        residual_rms_mm: fit.rms / MM,
        standard_deviation_mm: fit.deviation / MM,
        mean_relative_residual: relative,
        mean_relative_left_out: left_out,
        condition: bounded(fit.condition),
        joints: fit.joints.iter().enumerate().map(|(i, joint)| JointSummary::of(i + 1, joint)).collect(),
        residuals: fit.rows.iter().map(ResidualSummary::of).collect(),
        worst_lines: fit.worst().iter().take(WORST).map(|row| row.line).collect(),
        sentence: explanation(fit, relative, left_out),
        remarks: [measurements.remarks.clone(), trials::remarks(robot, &measurements.rows, fit)].concat(),
    }
}

impl JointSummary {
    fn of(number: usize, joint: &Joint) -> Self {
        let (low, high) = joint.interval;
        Self {
            joint: number,
            compliance_rad_per_nm: joint.compliance,
            interval_rad_per_nm: [bounded(low), bounded(high)],
            stiffness_nm_per_rad: bounded(1.0 / joint.compliance),
            variance_inflation: bounded(joint.inflation),
            direction_shares: joint.shares.clone(),
            mixed_with: joint.mixed_with.iter().map(|other| other + 1).collect(),
            load_factor: joint.load_factor.and_then(bounded),
            verdict: joint.verdict.id(),
            sentence: judgement(joint),
        }
    }
}

impl ResidualSummary {
    fn of(row: &Residual) -> Self {
        Self {
            line: row.line,
            measured_mm: row.measured / MM,
            fitted_mm: row.fitted / MM,
            residual_mm: row.residual / MM,
            left_out_mm: row.left_out / MM,
        }
    }
}

/// The number, if it is finite.
fn bounded(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// How well J C J^T explains the data.
fn explanation(fit: &Fit, relative: f64, left_out: f64) -> String {
    let worst = fit.worst();
    let lines: Vec<String> = worst.iter().take(WORST).map(|row| row.line.to_string()).collect();
    format!(
        "Springs in the joints explain {:.1} % of the squared displacements of {} rows; \
         a row is missed by {:.0} % of its displacement on average, \
         and by {:.0} % where it was not part of the fit. Lines {} fit worst.",
        100.0 * fit.explained,
        fit.rows.len(),
        100.0 * relative,
        100.0 * left_out,
        lines.join(", ")
    )
}

/// The verdict on a joint in words, and what would help.
fn judgement(joint: &Joint) -> String {
    let others: Vec<String> = joint.mixed_with.iter().map(|other| (other + 1).to_string()).collect();
    let others = match others.as_slice() {
        [] => String::new(),
        [one] => format!("joint {one}"),
        all => format!("joints {}", all.join(", ")),
    };
    let hard = if others.is_empty() {
        String::new()
    } else {
        format!("; hard to distinguish from {others} in these poses")
    };
    let more = joint.load_factor.map_or(String::new(), |factor| {
        format!(
            "; for 10 % to each side: use loads {factor:.1} times as large, or {:.0} times as many rows",
            factor * factor
        )
    });
    match joint.verdict {
        Verdict::Known => format!("identified{hard}{more}"),
        Verdict::Rough => format!("a rough value{hard}{more}"),
        Verdict::Small if joint.at_zero => {
            format!(
                "held at zero because the data would make it negative{hard}; only the upper end of its interval is known"
            )
        }
        Verdict::Small => format!("not distinguishable from a rigid joint{hard}{more}"),
        Verdict::Unloaded => {
            "cannot be identified: no load in these poses turns it. Load the tip further from its axis"
                .to_owned()
        }
        Verdict::Confounded => format!(
            "cannot be identified: only its sum with {others} shows. Add poses and load directions in which they move the tip differently"
        ),
    }
}

/// A vibration.
pub fn response(mode: &Mode) -> ResponseSummary {
    let interval = |measured: Measured, unit: f64| {
        [(measured.value - measured.half) / unit, (measured.value + measured.half) / unit].map(bounded)
    };
    let (frequency_rad_s, damping) = mode.decrement;
    let other = |other: Other| OtherSummary {
        frequency_hz: other.frequency / HZ,
        damping: other.damping,
        amplitude_share: other.share,
    };
    let remark = |(code, message): &(&'static str, String)| ResponseRemark { code, message: message.clone() };
    ResponseSummary {
        frequency_rad_s: mode.frequency.value,
        frequency_interval_rad_s: interval(mode.frequency, 1.0),
        frequency_hz: mode.frequency.value / HZ,
        frequency_interval_hz: interval(mode.frequency, HZ),
        damping: mode.damping.value,
        damping_interval: interval(mode.damping, 1.0),
        decrement: mode.decrement_agrees().then_some(DecrementSummary { frequency_rad_s, damping }),
        other: mode.other.map(other),
        from_s: mode.window.0,
        to_s: mode.window.1,
        cycles: mode.cycles,
        samples_per_cycle: mode.samples_per_cycle,
        explained: mode.explained,
        passes: mode.passes.0,
        sentence: format!(
            "{:.2} cycles from {:.3} s to {:.3} s, {:.0} samples per cycle; the fit explains {:.2} % of the signal.",
            mode.cycles,
            mode.window.0,
            mode.window.1,
            mode.samples_per_cycle,
            100.0 * mode.explained
        ),
        remarks: mode.remarks.iter().map(remark).collect(),
    }
}
