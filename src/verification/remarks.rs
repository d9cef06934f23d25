//! What to look out for before a package runs.

use crate::export::command::Command;
use crate::export::posture;
use crate::report::{Report, millimetres};
use crate::robot::Joints;
use crate::setup::Controller;
use crate::units::MM;

/// Everything that a package leaves to the person who runs it, the dangerous first. `joints` are those of
/// [`posture::joints`]; none for a machine.
pub(super) fn remarks(
    report: &Report,
    command: &Command,
    joints: &[Joints],
    controller: Controller,
) -> Vec<String> {
    let setup = report.setup();
    let mut remarks = Vec::new();
    if setup.mode.is_some() {
        remarks.push(
            "These commands are meant for an input shaper, which the controller must apply. Without one, use \
             a job with the shaper \"none\"."
                .into(),
        );
    }
    if command.style.is_robot() {
        remarks.extend(of_arm(report, command, joints, controller));
        remarks.extend(left_out(report, command));
        remarks.extend(of_controller(report, command, controller));
        remarks.push("Not tried on a controller: run it slowly and without the part first.".into());
    }
    remarks
}

/// What the arm may not do as simulated.
fn of_arm(report: &Report, command: &Command, joints: &[Joints], controller: Controller) -> Vec<String> {
    let output = &report.setup().output;
    let mut remarks = Vec::new();
    if posture::changes(&report.plan.robot, joints) {
        remarks.push(
            "The arm changes its posture on the way (wrist, elbow or shoulder), which no linear move can do: the \
             controller stops there."
                .into(),
        );
    }
    if output.of_arm != Some(controller) {
        remarks.push(format!(
            "This arm is not known to have this controller: base and first axes are measured as for {}. Check both.",
            report.plan.robot.name()
        ));
    }
    if command.deviation > command.thinning {
        remarks.push(format!(
            "Points merged by program.least_step_mm leave out up to {} mm of the path.",
            millimetres(command.deviation)
        ));
    }
    remarks
}

/// Words of the original program that the package does not have.
fn left_out(report: &Report, command: &Command) -> Vec<String> {
    let mut remarks = Vec::new();
    let program = report.setup().program.as_ref().map(|source| &source.program);
    let mut words: Vec<String> = Vec::new();
    for ignored in program.iter().flat_map(|program| &program.ignored) {
        let switches = ["M", "T"].iter().any(|letter| ignored.word.starts_with(letter));
        // What ends a program ends the package, too.
        let ends = ["M2", "M02", "M30"].contains(&ignored.word.as_str());
        if switches && !ends {
            words.push(format!("{} in line {}", ignored.word, ignored.line));
        }
    }
    if !words.is_empty() {
        const SHOWN: usize = 8;
        let more =
            if words.len() > SHOWN { format!(" and {} more", words.len() - SHOWN) } else { String::new() };
        words.truncate(SHOWN);
        remarks.push(format!("Left out of the original program: {}{more}.", words.join(", ")));
    }
    let mut speeds =
        command.moves.iter().filter(|commanded| !commanded.rapid).map(|commanded| commanded.rpm());
    let first = speeds.next();
    if speeds.any(|rpm| Some(rpm) != first) {
        remarks
            .push("The spindle's speed changes on the way: the package says where, in comments only.".into());
    }
    remarks
}

/// What this controller's package leaves to be done.
fn of_controller(report: &Report, command: &Command, controller: Controller) -> Vec<String> {
    let setup = report.setup();
    let output = &setup.output;
    let split = command.moves.last().is_some_and(|last| last.part > 0);
    let mut remarks = Vec::new();
    if output.load.is_none() {
        remarks.push(
            "The load on the flange is not known (program.load_kg): set it in the controller before running, or \
             the path will be less accurate."
                .into(),
        );
    }
    let acceleration = setup.limits.acceleration / MM;
    match controller {
        Controller::Abb if split => {
            remarks.push(format!(
                "Its parts are loaded from HOME:/{}/ on the controller: copy them there.",
                output.name
            ));
        }
        Controller::Staubli if !output.hooks.is_empty() => {
            let names: Vec<_> = output.hooks.iter().map(|(_, name)| format!("{name}.pgx")).collect();
            remarks.push(format!("{} are empty: add the cell's own instructions to them.", names.join(", ")));
        }
        Controller::Fanuc if !output.external.is_empty() => {
            remarks.push("External axes are listed in mm: change the unit of a rotary one to deg.".into());
        }
        _ => {}
    }
    if matches!(controller, Controller::Staubli | Controller::Fanuc) {
        remarks.push(format!(
            "The controller's own acceleration holds; its time and stops are simulated with {acceleration:.0} mm/s\u{b2}."
        ));
    }
    remarks
}
