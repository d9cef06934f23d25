//! The headline figures of a report, as one small object.

use crate::cutting::MeanForces;
use crate::cutting::material::Material;
use crate::deviation::contour::MeanMax;
use crate::deviation::{Deviation, Largest};
use crate::model::MODEL;
use crate::online::{Comparison, OnlineSummary};
use crate::path::gcode::GcodeDialect;
use crate::path::{MovePace, Path, SourceProgram};
use crate::report::expected::{ExpectedError, HowSure};
use crate::report::{
    Budget, CutFigures, FeedRuleGain, Report, RollGain, Stops, SurfaceFigures, VerdictState, WallFigures,
    Warning,
};
use crate::setup::spindle_speeds;
use crate::units::{DEG, MM};
use nalgebra::Vector3;
use serde::Serialize;
use std::collections::BTreeMap;

/// Mean and largest error over all samples, in mm (angles in deg).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Statistics {
    /// Mean.
    pub mean: f64,
    /// Largest.
    pub max: f64,
}

impl Statistics {
    /// Statistics of angles [rad], in deg.
    pub fn of_angles(angles: &[f64]) -> Self {
        let mean = angles.iter().sum::<f64>() / angles.len().max(1) as f64;
        let max = angles.iter().copied().fold(0.0, f64::max);
        Self { mean: mean / DEG, max: max / DEG }
    }
}

impl From<MeanMax> for Statistics {
    /// Statistics of contour errors, from m to mm.
    fn from(MeanMax { mean, max }: MeanMax) -> Self {
        Self { mean: mean / MM, max: max / MM }
    }
}

/// The largest error of its kind, in mm, and where on the path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct WorstPlace {
    /// Largest.
    pub max: f64,
    /// Arc length of its place on the desired path [mm].
    pub at_arc_length_mm: f64,
}

impl From<Largest> for WorstPlace {
    /// From m to mm.
    fn from(Largest { max, at }: Largest) -> Self {
        Self { max: max / MM, at_arc_length_mm: at / MM }
    }
}

/// Contour error before compensation, each source alone and both together.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Before {
    /// Only cutting forces act.
    pub deflection: Statistics,
    /// Only the shaper acts.
    pub shaping: Statistics,
    /// Both act.
    pub both: Statistics,
}

/// The summary that scripts and the page receive.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Hash over the bits of all columns.
    pub fingerprint: String,
    /// Number of the model, see [`MODEL`].
    pub model: u32,
    /// Number of samples.
    pub samples: usize,
    /// Time from the first to the last sample [s].
    pub duration_s: f64,
    /// Length of the desired path [mm].
    pub path_length_mm: f64,
    /// Full stops along the path.
    pub stops: Stops,
    /// Mean milling force in {T} at the programmed feed [N], z from tip to spindle; of a program,
    /// at that of its move with the largest feed per tooth.
    pub mean_force_n: [f64; 3],
    /// Name of the material.
    pub material: String,
    /// Source of its coefficients, and how far to trust them.
    pub material_note: String,
    /// The cut: coefficients, engagement, spindle.
    pub cut: CutFigures,
    /// The walls left by the cut, by the mean force and at the instants when the edge generates
    /// them.
    pub walls: Vec<WallFigures>,
    /// Contour error before compensation [mm].
    pub before_mm: Before,
    /// Breakdown of the contour error before compensation.
    pub budget: Budget,
    /// Contour error after compensation, every source acting [mm].
    pub after_mm: Statistics,
    /// Largest distance from a point of the desired path to the nearest place that the tip passes
    /// after compensation, every source acting [mm]: what of the path is never reached.
    pub missed_mm: WorstPlace,
    /// Largest error at the top of the cut after compensation, every source acting [mm]: that of the
    /// tip and what the tilt of the tool adds over the axial depth.
    pub wall_mm: WorstPlace,
    /// The surface that is left, if the engagement follows a stock.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface: Option<SurfaceFigures>,
    /// Angle between actual and desired tool axis before compensation, every source acting [deg].
    pub before_axis_deg: Statistics,
    /// Angle between actual and desired tool axis after compensation, every source acting [deg]; it
    /// is corrected only along a path whose tool axis turns, or if the job compensates the axis.
    pub after_axis_deg: Statistics,
    /// Number of the pass whose path is commanded.
    pub passes: usize,
    /// Whether the loop reached the tolerance for the sources it compensates.
    pub converged: bool,
    /// The tolerance [mm].
    pub tolerance_mm: f64,
    /// Largest contour error before the first pass and after each [mm]: of the tip, or what the job
    /// compensates instead.
    pub history_max_mm: Vec<f64>,
    /// Mean of that error before the first pass and after each [mm].
    pub history_mean_mm: Vec<f64>,
    /// The verdict in words.
    pub verdict: String,
    /// The verdict as a state.
    pub verdict_state: VerdictState,
    /// Largest contour error to expect after compensation, with what is known of robot and material
    /// [mm].
    pub expected_mm: ExpectedError,
    /// How sure that is.
    pub how_sure: HowSure,
    /// What the loop of the job would bring, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub online: Option<OnlineSummary>,
    /// Summary of the program, if the path came from one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub program: Option<ProgramSummary>,
    /// Gain from a free spin, if it is free.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spin: Option<RollGain>,
    /// Gain of the feed rule over the programmed feed, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub feed_rule: Option<FeedRuleGain>,
    /// Name of the robot.
    pub robot: String,
    /// Source of the joint compliances, and how far to trust them.
    pub stiffness: String,
    /// Controller that its program is for.
    pub controller: &'static str,
    /// How the inverse kinematics is solved: `closed form` or `numerically`.
    pub inverse: &'static str,
    /// The arm's branch at the start, in words.
    pub branch: String,
    /// Conditions that are odd but workable.
    pub warnings: Vec<Warning>,
}

/// Summary of a program as it was read.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProgramSummary {
    /// `gcode`, `apt` or `csv`.
    pub language: &'static str,
    /// Unit of length in the text.
    pub unit: &'static str,
    /// Controller whose G-code it is: `fanuc`, `linuxcnc`, `grbl`, `siemens`, `mach` or `unknown`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dialect: Option<&'static str>,
    /// Number of lines.
    pub lines: usize,
    /// Number of cutting moves.
    pub cutting_moves: usize,
    /// Number of rapid moves.
    pub rapid_moves: usize,
    /// Whether the tool axis turns.
    pub multi_axis: bool,
    /// Smallest x, y, z of the moves in the workpiece frame [mm].
    pub lowest_mm: [f64; 3],
    /// Largest x, y, z of the moves in the workpiece frame [mm].
    pub highest_mm: [f64; 3],
    /// Smallest and largest feed that the program states [mm/s].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub feeds_mm_s: Option<[f64; 2]>,
    /// Smallest and largest spindle speed that the program states [1/min].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spindle_rpm: Option<[f64; 2]>,
    /// Words without effect, each with its lines.
    pub ignored: Vec<IgnoredWord>,
}

/// A word that is recognised but has no effect on the path.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct IgnoredWord {
    /// As written.
    pub word: String,
    /// Line numbers, from 1.
    pub lines: Vec<usize>,
}

impl ProgramSummary {
    fn of(source: &SourceProgram, path: &Path) -> Self {
        let program = &source.program;
        let (mut lowest, mut highest) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let mut feeds: Option<[f64; 2]> = None;
        for step in &program.moves {
            for s in step.segment.extremes() {
                let point = step.segment.point(s) / MM;
                for axis in 0..3 {
                    lowest[axis] = f64::min(lowest[axis], point[axis]);
                    highest[axis] = f64::max(highest[axis], point[axis]);
                }
            }
            if let MovePace::Feed(feed) = step.pace {
                let [least, most] = feeds.unwrap_or([feed / MM; 2]);
                feeds = Some([least.min(feed / MM), most.max(feed / MM)]);
            }
        }
        let mut words: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for ignored in &program.ignored {
            words.entry(&ignored.word).or_default().push(ignored.line);
        }
        let rapid_moves = program.moves.iter().filter(|step| step.pace == MovePace::Rapid).count();
        Self {
            language: source.language,
            unit: program.unit,
            dialect: program.dialect.map(GcodeDialect::id),
            lines: program.lines,
            cutting_moves: program.moves.len() - rapid_moves,
            rapid_moves,
            multi_axis: path.is_multi_axis(),
            lowest_mm: lowest,
            highest_mm: highest,
            feeds_mm_s: feeds,
            spindle_rpm: spindle_speeds(path).fold(None, |range: Option<[f64; 2]>, speed| {
                let [least, most] = range.unwrap_or([speed; 2]);
                Some([least.min(speed), most.max(speed)])
            }),
            ignored: words
                .into_iter()
                .map(|(word, lines)| IgnoredWord { word: word.to_owned(), lines })
                .collect(),
        }
    }
}

impl Report {
    /// Mean milling force in {T} [N] at [`Report::feed_per_tooth`]; in a stock where it is largest.
    pub fn mean_force(&self) -> Vector3<f64> {
        let setup = self.setup();
        let force = match (&setup.mean_force, setup.heaviest) {
            (MeanForces::Stated(force), _) => *force,
            (MeanForces::InStock { forces, .. }, Some(place)) => forces[place.station],
            // All is air.
            _ => return Vector3::zeros(),
        };
        force.at(self.feed_per_tooth())
    }

    /// The headline figures.
    pub fn summary(&self) -> Summary {
        let statistics = |deviation: &Deviation| Statistics::from(deviation.statistics);
        let mm = |values: &[f64]| values.iter().map(|v| v / MM).collect();
        let start = self.branch;
        let branch = format!(
            "{}, elbow {}, q4 = {:.1} deg",
            if start.front { "arm facing the point" } else { "arm over its back" },
            if start.elbow_positive { "positive" } else { "negative" },
            self.q.first().map_or(0.0, |q| q[3] / DEG)
        );
        let material = self.setup().material.material;
        let (budget, walls) = self.budget_and_walls();
        Summary {
            fingerprint: self.fingerprint(),
            model: MODEL,
            samples: self.samples(),
            duration_s: self.duration(),
            path_length_mm: self.plan.path.length() / MM,
            stops: Stops::of(self),
            mean_force_n: self.mean_force().into(),
            material: material.map_or("Own numbers", |material| material.name).to_owned(),
            material_note: material.map_or(String::new(), Material::note),
            cut: self.cut_figures(),
            walls,
            before_mm: Before {
                deflection: statistics(&self.deflection_only),
                shaping: statistics(&self.shaping_only),
                both: statistics(&self.before),
            },
            budget,
            after_mm: statistics(&self.after),
            missed_mm: self.missed().into(),
            wall_mm: self.wall().into(),
            surface: self.surface_figures(),
            before_axis_deg: Statistics::of_angles(&self.before.axis_error),
            after_axis_deg: Statistics::of_angles(&self.after.axis_error),
            passes: self.compensation.passes,
            converged: self.compensation.converged,
            tolerance_mm: self.setup().goal.tolerance / MM,
            history_max_mm: mm(&self.compensation.history_max),
            history_mean_mm: mm(&self.compensation.history_mean),
            verdict: self.verdict(),
            verdict_state: self.verdict_state(),
            expected_mm: self.band.after.into(),
            how_sure: self.how_sure(),
            online: self.online.as_ref().map(|(_, compared)| Comparison::summary(compared)),
            program: self.setup().program.as_ref().map(|source| ProgramSummary::of(source, &self.plan.path)),
            spin: self.roll.clone(),
            feed_rule: self.feed_rule.clone(),
            robot: self.plan.robot.name().to_owned(),
            controller: self.setup().output.controller.id(),
            inverse: if self.plan.robot.closed_form().is_ok() { "closed form" } else { "numerically" },
            stiffness: self.setup().stiffness_note.clone(),
            branch,
            warnings: self.warnings.clone(),
        }
    }
}
