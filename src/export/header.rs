//! The header of every program: its origin, its simulated accuracy, and its limits.

use crate::cutting::ConstantForceFeed;
use crate::export::command::{Command, ProgramRun};
use crate::export::orientation::roll_pitch_yaw;
use crate::export::style::Junctions;
use crate::job::CompensateAt;
use crate::math::Pose;
use crate::model;
use crate::report::{Report, VerdictState, Warning, millimetres};
use crate::units::{DEG, MM};

/// The lines of the header, plain ASCII without brackets, for any language's comments. No date: the
/// same run gives the same text.
pub fn lines(report: &Report, command: Option<&Command>) -> Vec<String> {
    let setup = report.setup();
    let mut lines = origin(report);
    if let Some(by_force) = &setup.feed_rule {
        let ConstantForceFeed { force, least, most } = by_force.rule;
        lines.push(format!(
            "Feeds keep the mean force at {} N, from {} to {} % of the programmed feeds",
            number(force, 1),
            number(least * 100.0, 1),
            number(most * 100.0, 1)
        ));
    }
    if let Some(command) = command {
        lines.extend(points(report, command));
    }
    lines.push(format!("Tool tip on the flange at {}", placed(report.plan.robot.tool())));
    lines.push(
        "Flange and joint zeros are those of the robot model: compare them with the controller's".into(),
    );
    if let Some((frequency, damping)) = setup.mode {
        lines.push(format!(
            "These commands are meant for an input shaper, {frequency} rad/s, damping {damping}: the controller must apply it"
        ));
    }
    let run = command.filter(|_| report.taught.is_none()).and_then(|command| Some((command, command.run?)));
    if let Some((command, run)) = run {
        lines.extend(rehearsed(report, command, &run));
    }
    lines.push(match command {
        Some(command) if command.style.is_robot() => {
            "Warning: a controller's absolute-accuracy option adds its own error to these figures".into()
        }
        _ => "Warning: a controller's own blending or absolute-accuracy option adds its own error to these figures".into(),
    });
    lines
}

/// Where a file comes from, and how accurate the corrected path is.
pub fn origin(report: &Report) -> Vec<String> {
    let setup = report.setup();
    let sources = match (setup.sources.deflection, setup.sources.shaping) {
        _ if report.compensation.passes == 0 => "not compensated",
        (true, true) => "compensated for deflection and shaping",
        (true, false) => "compensated for deflection",
        _ => "compensated for shaping",
    };
    let brought = match setup.compensate_at {
        _ if report.compensation.passes == 0 => "",
        CompensateAt::Tip => "",
        CompensateAt::Middle => " in the middle of the cut",
        CompensateAt::Axis => " with the tool axis",
    };
    let mut lines = vec![
        model::stamp(&report.fingerprint()),
        format!("Path {sources}{brought}, robot model {}", ascii(report.plan.robot.name())),
    ];
    match &report.taught {
        Some(taught) => {
            let cannot = |warning: &Warning| format!("The arm cannot run this: {}", plain(&warning.message));
            lines.extend(report.impossible().map(cannot));
            lines.push(taught.sentence());
        }
        None => lines.extend([
            format!("Verdict, simulated: {}", plain(&report.verdict())),
            format!(
                "Tolerance {} mm, largest contour error {} mm if every number is exact, {} mm without compensation",
                millimetres(setup.goal.tolerance),
                millimetres(report.after_max()),
                millimetres(report.before.statistics.max)
            ),
        ]),
    }
    lines
}

/// Thinning of the points, and the frames they refer to.
fn points(report: &Report, command: &Command) -> Vec<String> {
    let setup = report.setup();
    let mut lines = vec![
        format!(
            "Thinned to {} mm: {} samples to {} points, largest deviation measured {} mm",
            millimetres(command.thinning),
            command.samples,
            command.points(),
            millimetres(command.deviation)
        ),
        setup.world.sentence(),
        format!(
            "Positions in the workpiece frame, measured from there at {}",
            placed(&setup.workpiece_in_world())
        ),
    ];
    if setup.base != Pose::identity() {
        lines.push(format!("The foot of the arm in the cell at {}", placed(&setup.base)));
    }
    lines
}

/// How the file itself runs: its largest contour error compared with the tolerance, its time, its
/// stops and its blending.
fn rehearsed(report: &Report, command: &Command, run: &ProgramRun) -> Vec<String> {
    let ProgramRun { reached, missed, duration, stops } = *run;
    let tolerance = report.setup().goal.tolerance;
    let met = match report.verdict_state_at(run.worst()) {
        VerdictState::CannotRun => "the arm cannot run it",
        VerdictState::Met => "tolerance met",
        VerdictState::MetIfNominal => "tolerance met if the numbers are exact, but not in 95 of 100 cases",
        VerdictState::NotMet => "tolerance not met",
    };
    let mut lines = vec![format!(
        "Simulated from this file, with its own moves, feeds and stops: largest contour error {} mm if every number is exact, \
         up to {} mm in 95 of 100 cases, {met}",
        millimetres(run.worst()),
        millimetres(report.p95_at(run.worst()))
    )];
    if missed > reached {
        lines.push(format!(
            "That is how far the tip's path misses a blended corner, the tip itself is at most {} mm off the path",
            millimetres(reached)
        ));
    }
    if command.style.is_robot() {
        lines.push(format!(
            "It takes {} s with {stops} stops on the way, {}",
            number(duration, 1),
            blending(command)
        ));
    }
    if reached > tolerance && report.after_max() <= tolerance {
        lines.push(
            "The joint commands at the sample time keep the timing of the run and reach the figure above"
                .into(),
        );
    }
    lines
}

/// How moves are blended, in words.
fn blending(command: &Command) -> String {
    match command.style.junctions {
        _ if command.blend == 0.0 => "every point is an exact stop".into(),
        Junctions::Share => format!(
            "blended by CNT{:.0}, which rounds corners depending on speed: simulated as overlapping ramps, good to a factor of 2",
            command.blend * 100.0
        ),
        _ => format!(
            "blended from {} mm before each point, at most half a move, simulated as a parabola",
            number(command.blend / MM, 3)
        ),
    }
}

/// A frame in words: mm, and roll, pitch, yaw about the fixed axes in degrees.
fn placed(frame: &Pose) -> String {
    let [x, y, z] = (frame.position / MM).into();
    let [roll, pitch, yaw] = roll_pitch_yaw(&frame.rotation).map(|angle| angle / DEG);
    format!(
        "x {} y {} z {} mm, roll {} pitch {} yaw {} deg",
        number(x, 4),
        number(y, 4),
        number(z, 4),
        number(roll, 5),
        number(pitch, 5),
        number(yaw, 5)
    )
}

/// A name as any controller reads it: umlauts lose their dots; any other character that is not a
/// letter, a digit or one of `-_.,` becomes a blank.
fn ascii(name: &str) -> String {
    let plain = |c: char| match c {
        'ä' => 'a',
        'ö' => 'o',
        'ü' => 'u',
        _ if c.is_ascii_alphanumeric() || "-_.,".contains(c) => c,
        _ => ' ',
    };
    name.chars().map(plain).collect()
}

/// A sentence without what would end a comment in some language, or is not ASCII.
fn plain(sentence: &str) -> String {
    let plain = |c: char| match c {
        '²' => Some('2'),
        ';' => Some(','),
        '(' | ')' | '{' | '}' => None,
        _ => Some(if c.is_ascii() { c } else { ' ' }),
    };
    sentence.chars().filter_map(plain).collect()
}

/// A number with at most `decimals` decimal places, and at least one: some controls read a number
/// without a point in least increments.
pub fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = text.trim_end_matches('0');
    let text = if text.ends_with('.') { format!("{text}0") } else { text.to_owned() };
    if text == "-0.0" { "0.0".into() } else { text }
}

/// Lines broken at blanks so that none is longer than `width`, words longer than that left whole.
pub fn wrapped(lines: &[String], width: usize) -> Vec<String> {
    let mut short: Vec<String> = Vec::new();
    for line in lines {
        let mut current = String::new();
        for word in line.split(' ') {
            if !current.is_empty() && current.len() + 1 + word.len() > width {
                short.push(std::mem::take(&mut current));
            }
            if !current.is_empty() {
                current.push(' ');
            }
            current.push_str(word);
        }
        short.push(current);
    }
    short
}
