//! What was identified, as plain data with the units in the names and as sentences.

use crate::identify::measurement::Measurements;
use crate::identify::response::{Measured, Mode};
use crate::identify::stiffness::{Fit, Joint, Verdict};
use crate::robot::Robot;
use crate::units::{HZ, MM};
use serde_json::{Value, json};

/// Rows named as those that fit worst.
const WORST: usize = 3;

/// A fit of joint compliances.
pub fn stiffness(robot: &Robot, measurements: &Measurements, fit: &Fit) -> Value {
    let (relative, left_out) = fit.relative();
    let joints = fit.joints.iter().enumerate().map(|(i, joint)| {
        json!({
            "joint": i + 1,
            "compliance_rad_per_nm": joint.compliance,
            "interval_rad_per_nm": [joint.interval.0, joint.interval.1],
            "stiffness_nm_per_rad": 1.0 / joint.compliance,
            "variance_inflation": joint.inflation,
            "direction_shares": joint.shares,
            "mixed_with": joint.mixed_with.iter().map(|other| other + 1).collect::<Vec<_>>(),
            "load_factor": joint.load_factor,
            "verdict": joint.verdict.id(),
            "sentence": judgement(joint),
        })
    });
    let residuals = fit.rows.iter().map(|row| {
        json!({
            "line": row.line,
            "measured_mm": row.measured / MM,
            "fitted_mm": row.fitted / MM,
            "residual_mm": row.residual / MM,
            "left_out_mm": row.left_out / MM,
        })
    });
    let worst: Vec<usize> = fit.worst().iter().take(WORST).map(|row| row.line).collect();
    json!({
        "robot": robot.name(),
        "source": format!("identified from {} rows", fit.rows.len()),
        "rows": fit.rows.len(),
        "degrees_of_freedom": fit.freedom,
        "joint_compliance_rad_per_nm": fit.compliance(),
        "explained": fit.explained,
        "residual_rms_mm": fit.rms / MM,
        "standard_deviation_mm": fit.deviation / MM,
        "mean_relative_residual": relative,
        "mean_relative_left_out": left_out,
        "condition": fit.condition,
        "joints": joints.collect::<Vec<_>>(),
        "residuals": residuals.collect::<Vec<_>>(),
        "worst_lines": worst,
        "sentence": explanation(fit, relative, left_out),
        "remarks": measurements.remarks,
    })
}

/// How well J C J^T explains the data.
fn explanation(fit: &Fit, relative: f64, left_out: f64) -> String {
    let worst = fit.worst();
    let lines: Vec<String> = worst.iter().take(WORST).map(|row| row.line.to_string()).collect();
    format!(
        "Springs in the joints explain {:.1} % of the squared displacements of {} rows; a row is missed by {:.0} % of its displacement on average, \
         and by {:.0} % where it was not part of the fit. Lines {} fit worst.",
        100.0 * fit.explained,
        fit.rows.len(),
        100.0 * relative,
        100.0 * left_out,
        lines.join(", ")
    )
}

/// What a verdict means for a joint, and what would help.
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
        format!("; hard to tell from {others} in these poses")
    };
    let more = joint.load_factor.map_or(String::new(), |factor| {
        format!(
            "; for 10 % to each side: loads {factor:.1} times as large, or {:.0} times the rows",
            factor * factor
        )
    });
    match joint.verdict {
        Verdict::Known => format!("identified{hard}{more}"),
        Verdict::Rough => format!("a rough value{hard}{more}"),
        Verdict::Small if joint.at_zero => {
            format!(
                "held at zero, where the data would make it negative{hard}; the upper end of its interval is all they say"
            )
        }
        Verdict::Small => format!("not told from a rigid joint{hard}{more}"),
        Verdict::Idle => {
            "cannot be identified: no load in these poses turns it. Load the tip further from its axis"
                .to_owned()
        }
        Verdict::Entangled => format!(
            "cannot be identified: only a sum with {others} shows. Add poses and directions of load in which they do not move the tip alike"
        ),
    }
}

/// A vibration.
pub fn response(mode: &Mode) -> Value {
    let interval = |measured: Measured, unit: f64| {
        [(measured.value - measured.half) / unit, (measured.value + measured.half) / unit]
    };
    let remarks = mode.remarks.iter().map(|(code, message)| json!({ "code": code, "message": message }));
    json!({
        "frequency_rad_s": mode.frequency.value,
        "frequency_interval_rad_s": interval(mode.frequency, 1.0),
        "frequency_hz": mode.frequency.value / HZ,
        "frequency_interval_hz": interval(mode.frequency, HZ),
        "damping": mode.damping.value,
        "damping_interval": interval(mode.damping, 1.0),
        "decrement": { "frequency_rad_s": mode.decrement.0, "damping": mode.decrement.1 },
        "other": mode.other.map(|other| json!({ "frequency_hz": other.frequency / HZ, "damping": other.damping, "amplitude_share": other.share })),
        "from_s": mode.window.0,
        "to_s": mode.window.1,
        "cycles": mode.cycles,
        "samples_per_cycle": mode.samples_per_cycle,
        "explained": mode.explained,
        "passes": mode.passes.0,
        "sentence": format!(
            "{:.2} cycles from {:.3} s to {:.3} s, {:.0} samples a cycle; the fit explains {:.2} % of the signal.",
            mode.cycles, mode.window.0, mode.window.1, mode.samples_per_cycle, 100.0 * mode.explained
        ),
        "remarks": remarks.collect::<Vec<_>>(),
    })
}
