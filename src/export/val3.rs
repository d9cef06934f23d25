//! The compensated path as a Staubli VAL3 program (`.pgx`, VAL3 s7 and later).
//!
//! One program of an application whose data the file names: the frame `fPart`, the tool `tMill`, the point `pPath` (in `fPart`)
//! and the motion descriptor `mPath`. `movel` to each point; lengths in mm, rx, ry, rz [deg] about x, the new y, the new z; `tvel`
//! in mm/s. Blending is off. The first move is a `movej`.
//! The XML frame follows published programs; instructions and the fields of `mdesc` are partly from memory, and nothing was
//! tried on a controller. Project and data files are not written: their version is the controller's.

use crate::export::command::Command;
use crate::export::header::{self, number};
use crate::export::orientation::about_moving_xyz;
use crate::math::Pose;
use crate::report::Report;
use crate::units::{DEG, MM};

/// The program.
pub fn program(report: &Report, command: &Command) -> String {
    let mut lines = vec![
        "<?xml version=\"1.0\" encoding=\"utf-8\" ?>".to_owned(),
        "<Programs xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" xmlns=\"http://www.staubli.com/robotics/VAL3/Program/2\">".into(),
        "  <Program name=\"armill\" access=\"public\">".into(),
        "    <Code><![CDATA[".into(),
        "begin".into(),
    ];
    lines.extend(header::lines(report, Some(command)).iter().map(|line| format!("  // {line}")));
    lines.extend([
        "  // Data to declare in the application, lengths in mm: frame fPart, tool tMill, pointRx pPath in fPart, mdesc mPath.".to_owned(),
        format!("  fPart.trsf={}", trsf(&report.setup().workpiece)),
        format!("  tMill.trsf={}", trsf(report.plan.robot.tool())),
        "  link(pPath,fPart)".into(),
        "  mPath.blend=off".into(),
        "  // To the start by joint motion: look out for what is in between.".into(),
        "  mPath.vel=10".into(),
    ]);
    let at = |point| trsf(&Pose { rotation: command.orientation(point), position: point.position });
    lines.extend([
        format!("  pPath.trsf={}", at(&command.start)),
        "  movej(pPath,tMill,mPath)".into(),
        "  waitEndMove()".into(),
        "  mPath.vel=100".into(),
    ]);
    let (mut spindle, mut feed, mut line) = (None, None, 0);
    for block in &command.blocks {
        if block.line != line {
            line = block.line;
            lines.push(format!("  // line {line} of the original"));
        }
        if spindle != Some(block.spindle) {
            spindle = Some(block.spindle);
            lines.push(format!(
                "  // spindle clockwise at {} rpm: switch it by your own signals",
                number(block.rpm(), 2)
            ));
        }
        if block.wait > 0.0 {
            lines.extend(["  waitEndMove()".into(), format!("  delay({})", number(block.wait, 4))]);
        }
        if feed != Some(block.feed) {
            feed = Some(block.feed);
            lines.push(format!("  mPath.tvel={}", number(block.feed / MM, 4)));
        }
        for point in block.points() {
            lines.extend([format!("  pPath.trsf={}", at(point)), "  movel(pPath,tMill,mPath)".into()]);
        }
    }
    lines.extend(
        ["  waitEndMove()", "end", "    ]]></Code>", "  </Program>", "</Programs>", ""].map(String::from),
    );
    lines.join("\n")
}

/// A transformation as `{x,y,z,rx,ry,rz}`.
fn trsf(pose: &Pose) -> String {
    let [x, y, z] = (pose.position / MM).map(|x| number(x, 5)).into();
    let [rx, ry, rz] = about_moving_xyz(&pose.rotation).map(|angle| number(angle / DEG, 6));
    format!("{{{x},{y},{z},{rx},{ry},{rz}}}")
}
