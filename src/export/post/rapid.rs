//! The compensated path as an ABB RAPID module (`.mod`).
//!
//! `MoveL` to each point in a work object, with the tip as tool; lengths in mm, quaternions with
//! the scalar first, speeds in mm/s. Stops are `fine`, points in between `z0`, the smallest zone,
//! which still rounds (0.3 mm at most): the file says so. The configuration is not asserted
//! (`ConfL\Off`), since the model's joint zeros may differ from the controller's.
//!
//! The layout of robtarget, tooldata, wobjdata and speeddata follows ABB's published data types; it
//! has not been tried on a controller.

use super::{Dialect, PostedStep};
use crate::export::command::Command;
use crate::export::header::number;
use crate::export::orientation::quaternion;
use crate::math::Pose;
use crate::report::Report;
use crate::units::MM;

/// RAPID.
#[derive(Default)]
pub(super) struct Rapid {
    /// The different feeds [m/s]; each is declared as a speeddata.
    feeds: Vec<f64>,
}

impl Rapid {
    /// The speeddata of a feed.
    fn speed(&self, feed: f64) -> String {
        let index = self.feeds.iter().position(|known| *known == feed).unwrap_or(0);
        format!("vFeed{}", index + 1)
    }
}

impl Dialect for Rapid {
    fn opening(&mut self, report: &Report, command: &Command, header: &[String]) -> Vec<String> {
        for commanded in &command.moves {
            if !self.feeds.contains(&commanded.feed) {
                self.feeds.push(commanded.feed);
            }
        }
        let mut lines = vec!["MODULE ArmillPath".to_owned()];
        lines.extend(header.iter().map(|line| format!("  ! {line}")));
        lines.extend([
            "  ! z0 may round a point by up to 0.3 mm; write fine instead to stop exactly at every point."
                .to_owned(),
            "  ! Mass 1 kg and its centre are placeholders: enter the spindle's own load before running."
                .into(),
            format!(
                "  PERS tooldata tMill:=[TRUE,{},[1,[0,0,0.001],[1,0,0,0],0,0,0]];",
                frame(report.plan.robot.tool())
            ),
            format!(
                "  PERS wobjdata wPart:=[FALSE,TRUE,\"\",{},[[0,0,0],[1,0,0,0]]];",
                frame(&report.setup().workpiece_in_world())
            ),
        ]);
        lines.extend(self.feeds.iter().map(|&feed| {
            format!("  CONST speeddata {}:=[{},500,5000,1000];", self.speed(feed), number(feed / MM, 4))
        }));
        let start = target(&command.pose(&command.start));
        lines.extend([
            "  PROC ArmillMain()".into(),
            "    ConfJ \\Off;".into(),
            "    ConfL \\Off;".into(),
            "    ! To the start by joint motion: look out for what is in between.".into(),
            format!("    MoveJ {start},v50,fine,tMill\\WObj:=wPart;"),
        ]);
        lines
    }

    fn comment(&self, text: &str) -> String {
        format!("    ! {text}")
    }

    fn wait(&self, time: f64) -> String {
        format!("    WaitTime \\InPos,{};", number(time, 4))
    }

    fn step(&mut self, PostedStep { commanded, pose, stops, .. }: &PostedStep) -> String {
        let zone = if *stops { "fine" } else { "z0" };
        format!("    MoveL {},{},{zone},tMill\\WObj:=wPart;", target(pose), self.speed(commanded.feed))
    }

    fn closing(&self) -> Vec<String> {
        vec!["  ENDPROC".into(), "ENDMODULE".into()]
    }
}

/// A robtarget: any configuration, no external axes.
fn target(pose: &Pose) -> String {
    let pose = frame(pose);
    let inner = &pose[1..pose.len() - 1];
    format!("[{inner},[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]")
}

/// A frame as `[[x,y,z],[q1,q2,q3,q4]]`.
fn frame(pose: &Pose) -> String {
    let [x, y, z] = (pose.position / MM).map(|x| number(x, 5)).into();
    let [q1, q2, q3, q4] = quaternion(&pose.rotation).map(|q| number(q, 9));
    format!("[[{x},{y},{z}],[{q1},{q2},{q3},{q4}]]")
}
