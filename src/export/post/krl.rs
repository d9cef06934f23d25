//! The compensated path as a KUKA KRL source file (`.src`).
//!
//! `LIN` to each point in `$BASE`, with `$TOOL` at the tip; lengths in mm, A, B, C [deg] about z,
//! the new y, the new x; `$VEL.CP` in m/s. Nothing is blended: without `C_DIS` the controller stops
//! exactly at every point, which is right but slow; the file says where to turn blending on. The
//! first move is a `PTP` that keeps the arm's present status and turn.
//!
//! The syntax follows published programs and post-processors (`BAS(#INITMOV,0)`, FRAME aggregates,
//! `WAIT SEC`); it has not been tried on a controller.

use super::{Dialect, PostedStep};
use crate::export::command::{Command, CommandedMove};
use crate::export::header::number;
use crate::export::orientation::roll_pitch_yaw;
use crate::math::Pose;
use crate::report::Report;
use crate::units::{DEG, MM};

/// KRL.
pub(super) struct Krl;

impl Dialect for Krl {
    fn opening(&mut self, report: &Report, command: &Command, header: &[String]) -> Vec<String> {
        let mut lines = vec!["&ACCESS RVP".to_owned(), "DEF ARMILL()".into()];
        lines.extend(header.iter().map(|line| self.comment(line)));
        lines.extend([
            "; Every LIN is an exact stop. To blend, set $APO.CDIS in mm and write C_DIS after each LIN;"
                .into(),
            "; what that rounds off comes on top of the figures above.".into(),
            "BAS(#INITMOV,0)".into(),
            format!("$BASE={}", frame("FRAME: ", &report.setup().workpiece_in_world())),
            format!("$TOOL={}", frame("FRAME: ", report.plan.robot.tool())),
            "$IPO_MODE=#BASE".into(),
            "$ORI_TYPE=#VAR".into(),
            "$APO.CDIS=0.0".into(),
            "PTP $AXIS_ACT".into(),
            "; To the start by joint motion: look out for what is in between.".into(),
            format!("PTP {}", frame("", &command.pose(&command.start))),
        ]);
        lines
    }

    fn comment(&self, text: &str) -> String {
        format!("; {text}")
    }

    fn wait(&self, time: f64) -> String {
        format!("WAIT SEC {}", number(time, 4))
    }

    fn feed(&self, commanded: &CommandedMove) -> Option<String> {
        Some(format!("$VEL.CP={}", number(commanded.feed, 7)))
    }

    fn step(&mut self, target: &PostedStep) -> String {
        format!("LIN {}", frame("", &target.pose))
    }

    fn closing(&self) -> Vec<String> {
        vec!["END".into()]
    }
}

/// A frame as an aggregate.
fn frame(kind: &str, pose: &Pose) -> String {
    let [x, y, z] = (pose.position / MM).map(|x| number(x, 5)).into();
    let [c, b, a] = roll_pitch_yaw(&pose.rotation).map(|angle| number(angle / DEG, 6));
    format!("{{{kind}X {x},Y {y},Z {z},A {a},B {b},C {c}}}")
}
