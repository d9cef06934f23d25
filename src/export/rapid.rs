//! The compensated path as an ABB RAPID module (`.mod`).
//!
//! `MoveL` to each point in a work object, with the tip as tool; lengths in mm, quaternions with the scalar first, speeds in mm/s.
//! Stops are `fine`, points in between `z0`, the smallest zone, which still rounds (0.3 mm at most): the file says so. The configuration is
//! not asserted (`ConfL\Off`), since the model's joint zeros may be others than the controller's.
//! The layout of robtarget, tooldata, wobjdata and speeddata follows ABB's published data types; it was not tried on a controller.

use crate::export::command::Command;
use crate::export::header::{self, number};
use crate::export::orientation::quaternion;
use crate::export::thin::Point;
use crate::math::Pose;
use crate::report::Report;
use crate::units::MM;

/// The module.
pub fn program(report: &Report, command: &Command) -> String {
    let mut lines = vec!["MODULE ArmillPath".to_owned()];
    lines.extend(header::lines(report, Some(command)).iter().map(|line| format!("  ! {line}")));
    lines.extend([
        "  ! z0 may round a point by up to 0.3 mm; write fine instead to stop exactly at every point."
            .to_owned(),
        "  ! Mass 1 kg and its centre are placeholders: enter the spindle's own load before running.".into(),
        format!(
            "  PERS tooldata tMill:=[TRUE,{},[1,[0,0,0.001],[1,0,0,0],0,0,0]];",
            frame(report.plan.robot.tool())
        ),
        format!(
            "  PERS wobjdata wPart:=[FALSE,TRUE,\"\",{},[[0,0,0],[1,0,0,0]]];",
            frame(&report.setup().workpiece)
        ),
    ]);
    let mut feeds: Vec<f64> = Vec::new();
    for block in &command.blocks {
        if !feeds.contains(&block.feed) {
            feeds.push(block.feed);
        }
    }
    let name = |feed: f64| {
        let index = feeds.iter().position(|known| *known == feed).unwrap_or(0);
        format!("vFeed{}", index + 1)
    };
    for &feed in &feeds {
        lines.push(format!("  CONST speeddata {}:=[{},500,5000,1000];", name(feed), number(feed / MM, 4)));
    }
    lines.extend([
        "  PROC ArmillMain()".into(),
        "    ConfJ \\Off;".into(),
        "    ConfL \\Off;".into(),
        "    ! To the start by joint motion: look out for what is in between.".into(),
        format!("    MoveJ {},v50,fine,tMill\\WObj:=wPart;", target(command, &command.start)),
    ]);
    let (mut spindle, mut line) = (None, 0);
    for block in &command.blocks {
        if block.line != line {
            line = block.line;
            lines.push(format!("    ! line {line} of the original"));
        }
        if spindle != Some(block.spindle) {
            spindle = Some(block.spindle);
            lines.push(format!(
                "    ! spindle clockwise at {} rpm: switch it by your own signals",
                number(block.rpm(), 2)
            ));
        }
        if block.wait > 0.0 {
            lines.push(format!("    WaitTime \\InPos,{};", number(block.wait, 4)));
        }
        let speed = name(block.feed);
        for (index, point) in block.points().enumerate() {
            let zone = if block.stops && index + 1 == block.steps.len() { "fine" } else { "z0" };
            lines.push(format!("    MoveL {},{speed},{zone},tMill\\WObj:=wPart;", target(command, point)));
        }
    }
    lines.extend(["  ENDPROC".into(), "ENDMODULE".into(), String::new()]);
    lines.join("\n")
}

fn target(command: &Command, point: &Point) -> String {
    let pose = frame(&Pose { rotation: command.orientation(point), position: point.position });
    let inner = &pose[1..pose.len() - 1];
    format!("[{inner},[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]")
}

/// A frame as `[[x,y,z],[q1,q2,q3,q4]]`.
fn frame(pose: &Pose) -> String {
    let [x, y, z] = (pose.position / MM).map(|x| number(x, 5)).into();
    let [q1, q2, q3, q4] = quaternion(&pose.rotation).map(|q| number(q, 9));
    format!("[[{x},{y},{z}],[{q1},{q2},{q3},{q4}]]")
}
