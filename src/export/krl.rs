//! The compensated path as a KUKA KRL source file (`.src`).
//!
//! `LIN` to each point in `$BASE`, with `$TOOL` at the tip; lengths in mm, A, B, C [deg] about z, the new y, the new x; `$VEL.CP` in m/s.
//! Nothing is blended: without `C_DIS` the controller stops exactly at every point, which is right but slow; the file says where to
//! turn blending on. The first move is a `PTP` that keeps the arm's present status and turn.
//! The language was followed from programs and post-processors in the open (`BAS(#INITMOV,0)`, FRAME aggregates, `WAIT SEC`), not tried on a controller.

use crate::export::command::Command;
use crate::export::header::{self, number};
use crate::export::orientation::roll_pitch_yaw;
use crate::math::Pose;
use crate::report::Report;
use crate::units::{DEG, MM};

/// The program.
pub fn program(report: &Report, command: &Command) -> String {
    let mut lines = vec!["&ACCESS RVP".to_owned(), "DEF ARMILL()".into()];
    lines.extend(header::lines(report, Some(command)).iter().map(|line| format!("; {line}")));
    lines.extend([
        "; Every LIN is an exact stop. To blend, set $APO.CDIS in mm and write C_DIS after each LIN;".into(),
        "; what that rounds off comes on top of the figures above.".into(),
        "BAS(#INITMOV,0)".into(),
        format!("$BASE={}", frame("FRAME: ", &report.setup().workpiece)),
        format!("$TOOL={}", frame("FRAME: ", report.plan.robot.tool())),
        "$IPO_MODE=#BASE".into(),
        "$ORI_TYPE=#VAR".into(),
        "$APO.CDIS=0.0".into(),
        "PTP $AXIS_ACT".into(),
        "; To the start by joint motion: look out for what is in between.".into(),
    ]);
    let at = |point| frame("", &Pose { rotation: command.orientation(point), position: point.position });
    lines.push(format!("PTP {}", at(&command.start)));
    let (mut spindle, mut feed, mut line) = (None, None, 0);
    for block in &command.blocks {
        if block.line != line {
            line = block.line;
            lines.push(format!("; line {line} of the original"));
        }
        if spindle != Some(block.spindle) {
            spindle = Some(block.spindle);
            lines.push(format!(
                "; spindle clockwise at {} rpm: switch it by your own signals",
                number(block.rpm(), 2)
            ));
        }
        if block.wait > 0.0 {
            lines.push(format!("WAIT SEC {}", number(block.wait, 4)));
        }
        if feed != Some(block.feed) {
            feed = Some(block.feed);
            lines.push(format!("$VEL.CP={}", number(block.feed, 7)));
        }
        lines.extend(block.points().map(|point| format!("LIN {}", at(point))));
    }
    lines.extend(["END".into(), String::new()]);
    lines.join("\n")
}

/// A frame as an aggregate.
fn frame(kind: &str, pose: &Pose) -> String {
    let [x, y, z] = (pose.position / MM).map(|x| number(x, 5)).into();
    let [c, b, a] = roll_pitch_yaw(&pose.rotation).map(|angle| number(angle / DEG, 6));
    format!("{{{kind}X {x},Y {y},Z {z},A {a},B {b},C {c}}}")
}
