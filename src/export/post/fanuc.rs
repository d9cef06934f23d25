//! The compensated path as a FANUC teach pendant program in text form (`.ls`).
//!
//! `L P[i] ... mm/sec FINE` to each point in user frame 1 with tool frame 1; lengths in mm, W, P, R
//! [deg] about the fixed x, y and z axes. Frames are numbers on the controller, so their values are
//! stated in remarks, counted from its world (at the height of axis 2 on a FANUC arm). `FINE` stops
//! exactly at every point. `CONFIG` is written `N U T, 0, 0, 0`
//! throughout: it depends on the controller's own joint zeros, so the arm must start in the desired
//! configuration.
//!
//! The layout follows published listings; it has not been tried on a controller. Long programs may
//! exceed the controller's memory or its limit on lines: state a coarser thinning, or split them.

use super::{Dialect, PostedStep};
use crate::export::command::Command;
use crate::export::header::{self, number};
use crate::export::orientation::roll_pitch_yaw;
use crate::math::Pose;
use crate::report::Report;
use crate::units::{DEG, MM};
use std::fmt::Write;

/// Longest remark [characters].
const REMARK: usize = 32;

/// FANUC's teach pendant language.
#[derive(Default)]
pub(super) struct Fanuc {
    /// The points P[1], P[2] and so on.
    points: Vec<Pose>,
}

impl Dialect for Fanuc {
    fn opening(&mut self, _report: &Report, command: &Command, header: &[String]) -> Vec<String> {
        self.points.push(command.pose(&command.start));
        let mut notes = header.to_vec();
        notes.extend([
            "Enter user frame 1 and tool frame 1 as stated above".to_owned(),
            "Check CONFIG before running".into(),
            "To the start by joint motion: look out for what is in between".into(),
        ]);
        let mut lines: Vec<String> =
            header::wrapped(&notes, REMARK).iter().map(|line| self.comment(line)).collect();
        lines.extend(["  UFRAME_NUM=1 ;", "  UTOOL_NUM=1 ;", "J P[1] 10% FINE    ;"].map(String::from));
        lines
    }

    fn comment(&self, text: &str) -> String {
        format!("  !{text} ;")
    }

    fn spindle(&self, rpm: f64) -> String {
        self.comment(&format!("spindle {} rpm clockwise", number(rpm, 1)))
    }

    fn wait(&self, time: f64) -> String {
        format!("  WAIT   {}(sec) ;", number(time, 2))
    }

    fn step(&mut self, target: &PostedStep) -> String {
        self.points.push(target.pose);
        let speed = number(target.commanded.feed / MM, 3);
        let speed = speed.trim_end_matches(".0");
        format!("L P[{}] {speed}mm/sec FINE    ;", self.points.len())
    }

    fn closing(&self) -> Vec<String> {
        Vec::new()
    }

    fn file(&self, lines: &[String]) -> String {
        let mut text = format!(
            "/PROG  ARMILL\n/ATTR\nOWNER\t\t= MNEDITOR;\nCOMMENT\t\t= \"Armill {}\";\nPROG_SIZE\t= 0;\nFILE_NAME\t= ;\n\
             VERSION\t\t= 0;\nLINE_COUNT\t= {};\nMEMORY_SIZE\t= 0;\nPROTECT\t\t= READ_WRITE;\n\
             TCD:  STACK_SIZE\t= 0,\n      TASK_PRIORITY\t= 50,\n      TIME_SLICE\t= 0,\n      BUSY_LAMP_OFF\t= 0,\n      \
             ABORT_REQUEST\t= 0,\n      PAUSE_REQUEST\t= 0;\nDEFAULT_GROUP\t= 1,*,*,*,*;\n\
             CONTROL_CODE\t= 00000000 00000000;\n/MN\n",
            env!("CARGO_PKG_VERSION"),
            lines.len()
        );
        // Writing to a string cannot fail.
        for (index, line) in lines.iter().enumerate() {
            let _ = writeln!(text, "{:4}:{line}", index + 1);
        }
        text.push_str("/POS\n");
        for (index, pose) in self.points.iter().enumerate() {
            text.push_str(&position(index + 1, pose));
        }
        text.push_str("/END\n");
        text
    }
}

/// A point of the list at the end.
fn position(index: usize, pose: &Pose) -> String {
    let [x, y, z] = (pose.position / MM).map(|x| number(x, 5)).into();
    let [w, p, r] = roll_pitch_yaw(&pose.rotation).map(|angle| number(angle / DEG, 6));
    format!(
        "P[{index}]{{\n   GP1:\n\tUF : 1, UT : 1,\t\tCONFIG : 'N U T, 0, 0, 0',\n\tX = {x} mm,\tY = {y} mm,\tZ = {z} mm,\n\t\
         W = {w} deg,\tP = {p} deg,\tR = {r} deg\n}};\n"
    )
}
