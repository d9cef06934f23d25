//! The compensated path as a Staubli VAL3 program (`.pgx`, VAL3 s7 and later).
//!
//! One program of an application whose data the file names: the frame `fPart` (in the world, on
//! a Staubli arm at the height of axis 2), the tool `tMill`, the point `pPath` (in `fPart`) and the motion descriptor
//! `mPath`. `movel` to each point; lengths in mm, rx, ry, rz [deg] about x, the new y, the new z;
//! `tvel` in mm/s. Blending is off. The first move is a `movej`.
//!
//! The XML frame follows published programs; instructions and the fields of `mdesc` are partly from
//! memory, and nothing has been tried on a controller. Project and data files are not written:
//! their version depends on the controller.

use super::{Dialect, PostedStep};
use crate::export::command::{Command, CommandedMove};
use crate::export::header::number;
use crate::export::orientation::about_moving_xyz;
use crate::math::Pose;
use crate::report::Report;
use crate::units::{DEG, MM};

/// VAL3.
pub(super) struct Val3;

impl Dialect for Val3 {
    fn opening(&mut self, report: &Report, command: &Command, header: &[String]) -> Vec<String> {
        let mut lines = vec![
            "<?xml version=\"1.0\" encoding=\"utf-8\" ?>".to_owned(),
            "<Programs xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" \
             xmlns=\"http://www.staubli.com/robotics/VAL3/Program/2\">"
                .into(),
            "  <Program name=\"armill\" access=\"public\">".into(),
            "    <Code><![CDATA[".into(),
            "begin".into(),
        ];
        lines.extend(header.iter().map(|line| self.comment(line)));
        lines.extend([
            "  // Data to declare in the application, lengths in mm: \
             frame fPart, tool tMill, pointRx pPath in fPart, mdesc mPath."
                .to_owned(),
            format!("  fPart.trsf={}", trsf(&report.setup().workpiece_in_world())),
            format!("  tMill.trsf={}", trsf(report.plan.robot.tool())),
            "  link(pPath,fPart)".into(),
            "  mPath.blend=off".into(),
            "  // To the start by joint motion: look out for what is in between.".into(),
            "  mPath.vel=10".into(),
            format!("  pPath.trsf={}", trsf(&command.pose(&command.start))),
            "  movej(pPath,tMill,mPath)".into(),
            "  waitEndMove()".into(),
            "  mPath.vel=100".into(),
        ]);
        lines
    }

    fn comment(&self, text: &str) -> String {
        format!("  // {text}")
    }

    fn wait(&self, time: f64) -> String {
        format!("  waitEndMove()\n  delay({})", number(time, 4))
    }

    fn feed(&self, commanded: &CommandedMove) -> Option<String> {
        Some(format!("  mPath.tvel={}", number(commanded.feed / MM, 4)))
    }

    fn step(&mut self, target: &PostedStep) -> String {
        format!("  pPath.trsf={}\n  movel(pPath,tMill,mPath)", trsf(&target.pose))
    }

    fn closing(&self) -> Vec<String> {
        ["  waitEndMove()", "end", "    ]]></Code>", "  </Program>", "</Programs>"].map(String::from).into()
    }
}

/// A transformation as `{x,y,z,rx,ry,rz}`.
fn trsf(pose: &Pose) -> String {
    let [x, y, z] = (pose.position / MM).map(|x| number(x, 5)).into();
    let [rx, ry, rz] = about_moving_xyz(&pose.rotation).map(|angle| number(angle / DEG, 6));
    format!("{{{x},{y},{z},{rx},{ry},{rz}}}")
}
