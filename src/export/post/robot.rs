//! Programs of robot controllers: a package of files, one language for each controller.
//!
//! The driver walks the moves of a [`Command`] once, part by part. A language provides the words, and
//! puts its lines in files. To support another controller, add a file with its language here, a line
//! in [`package`], and a [`Controller`].

use super::{fanuc, krl, rapid, val3};
use crate::error::Error;
use crate::export::chain;
use crate::export::command::Command;
use crate::export::header::{self, number};
use crate::math::Pose;
use crate::report::Report;
use crate::robot::Joints;
use crate::setup::{Controller, ProgramOptions};
use crate::units::{DEG, MM};

/// A file of a package.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct PackageFile {
    /// Its name, in the folder of the package.
    pub path: String,
    /// Its text.
    pub text: String,
}

/// What a language knows of the whole program.
pub(super) struct Brief<'r> {
    pub(super) report: &'r Report,
    pub(super) command: &'r Command,
    pub(super) options: &'r ProgramOptions,
    /// Comments that say what it is.
    pub(super) header: Vec<String>,
    /// Joint values at the start [rad].
    pub(super) start: Joints,
    /// The workpiece as the controller counts.
    pub(super) base: Pose,
    /// The tip on the flange.
    pub(super) tool: &'r Pose,
}

impl Brief<'_> {
    /// Joint values at the start, as the controller shows them.
    pub(super) fn start_deg(&self) -> [f64; 6] {
        self.start.map(|q| q / DEG).into()
    }

    /// The different speeds [m/s], in the order in which they come.
    pub(super) fn speeds(&self) -> Vec<f64> {
        let mut speeds = Vec::new();
        for commanded in &self.command.moves {
            if !speeds.contains(&commanded.feed) && !commanded.steps.is_empty() {
                speeds.push(commanded.feed);
            }
        }
        speeds
    }

    /// Names of the parts: the program's with a number.
    pub(super) fn part(&self, index: usize) -> String {
        format!("{}_{:03}", self.options.name, index + 1)
    }

    /// A call of each procedure that the job names, or a remark that nothing is called.
    pub(super) fn hooks(
        &self,
        names: &[&str],
        call: impl Fn(&str) -> String,
        otherwise: &str,
    ) -> Vec<String> {
        if names.is_empty() {
            vec![otherwise.to_owned()]
        } else {
            names.iter().map(|name| call(name)).collect()
        }
    }
}

/// A move of the tool for a language to write.
pub(super) struct PostedMove<'a> {
    /// The TCP at its end, in the workpiece frame.
    pub(super) pose: Pose,
    /// A point in the middle of an arc.
    pub(super) via: Option<Pose>,
    /// Joint values at its end [rad].
    pub(super) joints: &'a Joints,
    /// Those in the middle of an arc.
    pub(super) via_joints: &'a Joints,
    /// Speed [m/s].
    pub(super) speed: f64,
    /// Whether the tool comes to rest at its end.
    pub(super) stops: bool,
}

/// The language of a robot's controller. Each text is one or more lines, without the final line break.
pub(super) trait Language {
    /// A comment among the moves.
    fn comment(&self, text: &str) -> String;

    /// A dwell [s].
    fn wait(&self, time: f64) -> String;

    /// A change of speed [m/s], where the language has a line for it.
    fn speed(&mut self, _speed: f64) -> Option<String> {
        None
    }

    /// A new part begins.
    fn begin(&mut self, _part: usize) {}

    /// A straight move or an arc, from where the tool is.
    fn move_to(&mut self, target: &PostedMove) -> String;

    /// The files, from the lines of each part; the main program first.
    fn files(&self, brief: &Brief, parts: &[Vec<String>]) -> Vec<PackageFile>;
}

/// The package of a command for a controller that runs robots; in one part if `whole`. `joints` are those
/// of [`posture::joints`](crate::export::posture::joints).
///
/// # Errors
/// [`Error::Invalid`] for what the controller does not take.
pub fn package(
    report: &Report,
    command: &Command,
    joints: &[Joints],
    controller: Controller,
    whole: bool,
) -> Result<Vec<PackageFile>, Error> {
    let options = &report.setup().output;
    let brief = Brief {
        report,
        command,
        options,
        header: header::lines(report, Some(command)),
        start: joints[0],
        base: report.setup().workpiece_in_world(),
        tool: report.plan.robot.tool(),
    };
    runs(command, report, controller)?;
    let split = !whole && command.moves.last().is_some_and(|last| last.part > 0);
    controller.accepts(options, split)?;
    let language: &mut dyn Language = match controller {
        Controller::Kuka => &mut krl::Krl::new(&brief),
        Controller::Abb => &mut rapid::Rapid::new(&brief),
        Controller::Staubli => &mut val3::Val3::new(&brief),
        Controller::Fanuc => &mut fanuc::Fanuc::new(&brief),
        Controller::Gcode | Controller::Apt | Controller::Csv => {
            let expected = "a robot's controller: kuka, abb, staubli, fanuc";
            return Err(Error::invalid("controller", format!("\"{}\"", controller.id()), expected));
        }
    };
    let parts = parts(command, joints, whole, language);
    let files = language.files(&brief, &parts);
    // Controllers run Windows: their own files have its line ends, and Staubli's a mark of UTF-8.
    let mark = if controller == Controller::Staubli { "\u{feff}" } else { "" };
    let ended = |text: String| if whole { text } else { format!("{mark}{}", text.replace('\n', "\r\n")) };
    Ok(files.into_iter().map(|file| PackageFile { text: ended(file.text), ..file }).collect())
}

/// Refuses speeds and accelerations that a controller does not take: KUKA's go up to 3 m/s and, in its
/// programs, 20 m/s^2.
fn runs(command: &Command, report: &Report, controller: Controller) -> Result<(), Error> {
    let fastest = command.moves.iter().map(|commanded| commanded.feed).fold(0.0, f64::max);
    let acceleration = report.setup().limits.acceleration;
    if controller == Controller::Kuka && fastest > 3.0 {
        let expected = "at most 3000 mm/s on a KUKA controller";
        return Err(Error::invalid(
            "motion.rapid_mm_s",
            format!("a move at {:.0} mm/s", fastest / MM),
            expected,
        ));
    }
    if controller == Controller::Kuka && !(1e-6..=20.0).contains(&acceleration) {
        let expected = "0.001 to 20000 on a KUKA controller";
        return Err(Error::invalid("motion.acceleration_mm_s2", acceleration / MM, expected));
    }
    Ok(())
}

/// The lines of each part.
fn parts(command: &Command, joints: &[Joints], whole: bool, language: &mut dyn Language) -> Vec<Vec<String>> {
    let mut parts: Vec<Vec<String>> = Vec::new();
    let mut joints = joints.iter();
    let mut at = command.start;
    let mut before = joints.next();
    let (mut line, mut spindle, mut speed) = (0, None, None);
    for commanded in &command.moves {
        let part = if whole { 0 } else { commanded.part };
        if parts.len() <= part {
            parts.push(Vec::new());
            language.begin(part);
            speed = None;
        }
        let Some(lines) = parts.last_mut() else { break };
        if line != commanded.line {
            line = commanded.line;
            lines.push(language.comment(&format!("line {line} of the original")));
        }
        if spindle != Some(commanded.spindle) {
            spindle = Some(commanded.spindle);
            lines.push(language.comment(&format!("spindle clockwise, {} rpm", number(commanded.rpm(), 1))));
        }
        if commanded.wait > 0.0 {
            lines.push(language.wait(commanded.wait));
        }
        if speed != Some(commanded.feed) && !commanded.steps.is_empty() {
            speed = Some(commanded.feed);
            lines.extend(language.speed(commanded.feed));
        }
        for (index, step) in commanded.steps.iter().enumerate() {
            let after = joints.next();
            let (Some(via_joints), Some(joints)) = (before, after) else { break };
            lines.push(language.move_to(&PostedMove {
                pose: command.pose(&step.to),
                via: chain::middle(&at, step).map(|point| command.pose(&point)),
                joints,
                via_joints,
                speed: commanded.feed,
                stops: commanded.stops && index + 1 == commanded.steps.len(),
            }));
            (at, before) = (step.to, after);
        }
    }
    parts
}
