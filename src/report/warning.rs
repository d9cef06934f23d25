//! Warnings: conditions that are odd but workable, each with the part of the motion it applies to.

use crate::cutting::ChipLoad;
use crate::cutting::material::Model;
use crate::deviation::{Deviation, Sources};
use crate::math;
use crate::path::{Move, MovePace, Tool};
use crate::plan::Plan;
use crate::report::span::{MOST_SPANS, Span, joined, spans};
use crate::report::{
    Remedy, Report, Severity, Stops, drives, in_stock, limit, millimetres, onset, overload, payload,
    reference,
};
use crate::robot::equilibrium::equilibrium;
use crate::setup::Setup;
use crate::units::{DEG, HZ, MM};
use nalgebra::Vector3;
use serde::Serialize;

/// A remark on the result.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Warning {
    /// Stable slug.
    pub code: &'static str,
    /// How much it matters.
    pub severity: Severity,
    /// Text for the reader.
    pub message: String,
    /// First sample it applies to, if it concerns a part of the motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from_sample: Option<usize>,
    /// Last sample it applies to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_sample: Option<usize>,
    /// Time of the first sample [s].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from_s: Option<f64>,
    /// Time of the last sample [s].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_s: Option<f64>,
    /// The separate stretches of samples at which it holds, first and last of each; empty if it
    /// concerns the whole job. At most [`MOST_SPANS`], the nearest joined.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub spans_samples: Vec<(usize, usize)>,
    /// Times of these stretches [s].
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub spans_s: Vec<(f64, f64)>,
    /// The change of the job that cures it, where one is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remedy: Option<Remedy>,
}

impl Warning {
    /// A remark on the whole job.
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self {
            code,
            severity: Severity::of(code),
            message: message.into(),
            from_sample: None,
            to_sample: None,
            from_s: None,
            to_s: None,
            spans_samples: Vec::new(),
            spans_s: Vec::new(),
            remedy: None,
        }
    }

    /// The remark with the stretches of samples that it applies to; `None` if there are none.
    pub(super) fn within(mut self, spans: &[Span], sample_time: f64) -> Option<Self> {
        let ((from, _), (_, to)) = (spans.first()?, spans.last()?);
        (self.from_sample, self.to_sample) = (Some(*from), Some(*to));
        let time = |sample: usize| sample as f64 * sample_time;
        (self.from_s, self.to_s) = (Some(time(*from)), Some(time(*to)));
        if spans.len() > MOST_SPANS {
            let count = spans.len();
            self.message += &format!("; {count} intervals, the closest merged into {MOST_SPANS}");
        }
        self.spans_samples = joined(spans, MOST_SPANS);
        self.spans_s = self.spans_samples.iter().map(|&(from, to)| (time(from), time(to))).collect();
        Some(self)
    }

    /// The message without what explains it, for a headline.
    pub fn brief(&self) -> &str {
        let end = [": ", " ("].iter().filter_map(|mark| self.message.find(mark)).min();
        &self.message[..end.unwrap_or(self.message.len())]
    }

    /// The time that it applies to, in words; none if it concerns the whole job.
    pub fn place(&self) -> Option<String> {
        let (from, to) = (self.from_s?, self.to_s?);
        Some(if from == to { format!("at {from:.2} s") } else { format!("{from:.2} to {to:.2} s") })
    }
}

/// Angle between the feed and the plane across the tool axis above which a warning is given [rad].
const RAMP: f64 = 30.0 * DEG;

/// Tools whose diameters differ by less than this count as the same [m]: CAM systems round inches.
const SAME_TOOL: f64 = 0.01 * MM;

/// What a report has to warn of, in no order; its own list so far holds that of
/// [`singularities`](super::singularity::singularities).
pub(crate) fn warnings(report: &Report) -> Vec<Warning> {
    let Report { plan, compensation, warnings: singular, .. } = report;
    let setup = report.setup();
    let mut warnings = Vec::new();
    if setup.stiffness_assumed {
        let message = "no joint stiffness has been published for this \
                       robot: deflections are an order of magnitude, usually within a factor of 2, for single joints \
                       within a factor of 9; enter your own values";
        warnings.push(Warning::new("stiffness-assumed", message));
    }
    if let Err(reason) = plan.robot.closed_form() {
        warnings.push(Warning::new(
            "inverse-numerical",
            format!("the joint values are solved numerically: {reason}"),
        ));
    }
    warnings.extend(reference::remark(&plan.path));
    springs(report, &mut warnings);
    warnings.extend(limit::warnings(report));
    warnings.extend_from_slice(singular);
    cut(setup, plan, &mut warnings);
    warnings.extend(payload::warning(report));
    warnings.extend(sampling(setup));
    corners(setup, plan, &report.shaping_only, &mut warnings);
    warnings.extend(Stops::warning(report));
    program(setup, &mut warnings);
    if let Some(error) = &compensation.stopped {
        let message = format!(
            "a compensated path could not be commanded ({error}); the last one that could be is kept"
        );
        warnings.push(Warning::new("compensation-stopped", message));
    }
    let compensates = setup.sources != Sources::NONE && setup.goal.max_passes > 0;
    let after_max = report.after_max();
    if compensates && after_max > setup.goal.tolerance {
        let corners = if setup.shaper.duration() > 0.0 && !plan.trajectory.stops.is_empty() {
            "; a longer wait in corners gives the shaped correction time to follow the force"
        } else {
            ""
        };
        let message = format!(
            "the compensated path leaves {:.4} mm, more than the tolerance of {} mm{corners}",
            after_max / MM,
            setup.goal.tolerance / MM
        );
        warnings.push(Warning::new("tolerance-not-met", message));
    }
    warnings.extend(overload::warnings(report));
    warnings.extend(in_stock::collisions(report));
    warnings.extend(onset::warnings(report));
    warnings.extend(drives::warnings(report));
    warnings
}

/// Largest number of samples checked for springs that do not settle.
const LOOKS: usize = 200;

fn springs(report: &Report, warnings: &mut Vec<Warning>) {
    let Some(statics) = report.plan.robot.statics() else { return };
    let q = report.shaped(&report.compensation.q);
    let unsettled =
        |k: usize| !equilibrium(&report.plan.robot, statics, &q.at(k), &report.planned_force[k]).converged;
    let samples = report.samples();
    if (0..samples).step_by(samples.div_ceil(LOOKS)).any(unsettled) {
        let message = "the joints are so soft under this load that their springs find no balance: do not rely on these deflections";
        warnings.push(Warning::new("springs-unsettled", message));
    }
}

/// The program reader's remarks with their lines, and a tool that differs from the job's.
fn program(setup: &Setup, warnings: &mut Vec<Warning>) {
    for remark in setup.program.iter().flat_map(|source| &source.program.remarks) {
        warnings.push(Warning::new(remark.code, format!("line {}: {}", remark.line, remark.message)));
    }
    let other = |tool: &&Tool| (tool.diameter - setup.cut.diameter).abs() > SAME_TOOL;
    let mut tools = setup.program.iter().flat_map(|source| &source.program.tools);
    if let Some(tool) = tools.find(other) {
        let message = format!(
            "line {}: the program's tool has a diameter of {:.3} mm, the job's tool {:.3} mm; the force is computed for the job's tool",
            tool.line,
            tool.diameter / MM,
            setup.cut.diameter / MM
        );
        warnings.push(Warning::new("tool-differs", message));
    }
}

/// The angle in [0, pi/2] with this sine [rad].
pub(super) fn angle_of_sine(sine: f64) -> f64 {
    math::atan2(sine, (1.0 - sine * sine).max(0.0).sqrt())
}

/// Warnings about the cut.
fn cut(setup: &Setup, plan: &Plan, warnings: &mut Vec<Warning>) {
    warnings.extend(chip_load(setup, plan));
    if matches!(setup.material.model, Model::Linear(_)) && setup.rake != 0.0 {
        let message =
            "the rake angle is not used: these coefficients apply to the tool they were measured with";
        warnings.push(Warning::new("rake-unused", message));
    }
    if setup.cut.runout > 0.0 {
        let message = "runout raises the peak of the force within a revolution; the mean force and the deviation \
                       of the path are computed without it. Teeth that pass without cutting \
                       have no edge force: in aluminium, for example, the mean is up to 3 % lower at 0.015 mm of runout and 12 \
                       to 17 % at 0.05 mm";
        warnings.push(Warning::new("runout", message));
    }
    if setup.tilted_in_stock {
        let message = "the stock is not used: the tool axis is not the workpiece's z axis along the \
                       whole path. The stated engagement is used everywhere";
        warnings.push(Warning::new("stock-unused", message));
    }
    // In a stock the bottom cuts as well.
    warnings.extend(if setup.contacts.is_none() { plunge(plan) } else { None });
    warnings.extend(centripetal(setup, plan));
}

/// The moves that cut.
fn cutting_moves(plan: &Plan) -> impl Iterator<Item = &Move> {
    plan.path.moves().iter().filter(|step| step.pace != MovePace::Rapid)
}

/// Feed of a move that cuts [m/s].
fn feed(setup: &Setup, step: &Move) -> f64 {
    if let MovePace::Feed(feed) = step.pace { feed } else { setup.limits.feed }
}

/// A stated feed per tooth that contradicts feed and spindle speed.
fn chip_load(setup: &Setup, plan: &Plan) -> Option<Warning> {
    let ChipLoad::Stated(c) = setup.loading.chip else { return None };
    let from_feed = |step: &Move| {
        let teeth_per_second =
            step.spindle.map_or(setup.teeth_per_second, |spindle| spindle * f64::from(setup.cut.flutes));
        feed(setup, step) / teeth_per_second
    };
    let off = |chip: f64| (c - chip).abs() / chip;
    let worst = cutting_moves(plan).map(from_feed).max_by(|a, b| off(*a).total_cmp(&off(*b)));
    let chip = worst.filter(|chip| off(*chip) > 0.05)?;
    let message = format!(
        "the feed per tooth of {} mm does not match feed and spindle speed, which give {} mm",
        c / MM,
        millimetres(chip)
    );
    Some(Warning::new("chip-load", message))
}

/// A feed along the tool axis, which the force model does not cover.
fn plunge(plan: &Plan) -> Option<Warning> {
    let trajectory = &plan.trajectory;
    // At rest in a corner the heading only turns.
    let sine = |k: usize| {
        if trajectory.timing.speed[k] == 0.0 && k > 0 && k + 1 < trajectory.moving {
            return 0.0;
        }
        let along: f64 =
            trajectory.timing.heading[k].dot(trajectory.axis.at(k)) * trajectory.timing.engaged[k];
        along.abs()
    };
    let steep = math::sin(RAMP);
    let spans = spans(trajectory.len(), |k| sine(k) > steep);
    let steepest = angle_of_sine((0..trajectory.len()).map(sine).fold(0.0, f64::max)) / DEG;
    let message = format!(
        "the tool climbs or dives at up to {steepest:.0} deg; the force model covers cuts across \
         the tool axis only, not plunging"
    );
    Warning::new("plunge", message).within(&spans, trajectory.sample_time)
}

/// An arc that needs more acceleration across the path than the motion's limit along it.
fn centripetal(setup: &Setup, plan: &Plan) -> Option<Warning> {
    let across = |step: &Move| feed(setup, step) * feed(setup, step) * step.segment.curvature();
    let step = cutting_moves(plan).max_by(|a, b| across(a).total_cmp(&across(b)))?;
    let message = format!(
        "at {:.1} mm/s an arc of radius {:.2} mm takes {:.0} mm/s² across the path, more than the {:.0} mm/s² \
         along it",
        feed(setup, step) / MM,
        1.0 / step.segment.curvature() / MM,
        across(step) / MM,
        setup.limits.acceleration / MM
    );
    if across(step) <= setup.limits.acceleration {
        return None;
    }
    let trajectory = &plan.trajectory;
    let spans = spans(trajectory.len(), |k| {
        let step = &plan.path.moves()[trajectory.timing.index[k] as usize];
        step.pace != MovePace::Rapid && across(step) > setup.limits.acceleration
    });
    let warning = Warning::new("centripetal", message);
    // An arc between two samples has none of its own.
    warning.clone().within(&spans, trajectory.sample_time).or(Some(warning))
}

/// A shaper for a mode that vibrates faster than the samples can show (above their Nyquist
/// frequency): its impulses lie within a sample.
fn sampling(setup: &Setup) -> Option<Warning> {
    let (frequency, _) = setup.mode?;
    let highest = 0.5 / setup.limits.sample_time;
    let message = format!(
        "samples every {} s carry up to {:.0} Hz, but the shaper is for {:.0} Hz: its impulses fall within one \
         sample, so it does nothing; use shorter samples (motion.sample_time_s) or check the frequency",
        setup.limits.sample_time,
        highest,
        frequency / HZ
    );
    (frequency / HZ > highest).then(|| Warning::new("shaper-sampling", message))
}

/// Without the wait, shaping rounds corners: the error within a shaper duration's travel of a stop.
fn corners(setup: &Setup, plan: &Plan, shaping_only: &Deviation, warnings: &mut Vec<Warning>) {
    let trajectory = &plan.trajectory;
    if trajectory.stops.is_empty() || setup.limits.corner_dwell >= setup.shaper.duration() {
        return;
    }
    let reach = setup.limits.feed * setup.shaper.duration();
    let at_corner = |k: usize| {
        trajectory.stops.iter().any(|stop| (stop.s - trajectory.timing.arc_length[k]).abs() <= reach)
    };
    let errors: &[Vector3<f64>] = &shaping_only.contour_error;
    let spans = spans(errors.len(), at_corner);
    let worst = (0..errors.len()).filter(|&k| at_corner(k)).map(|k| errors[k].norm()).fold(0.0, f64::max);
    let message = format!(
        "the path does not wait in its {} corners until the shaped command has settled: shaping rounds them by up to {:.3} mm",
        trajectory.stops.len(),
        worst / MM
    );
    warnings.extend(Warning::new("corners-rounded", message).within(&spans, trajectory.sample_time));
}
