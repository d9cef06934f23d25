//! The compensated path as a FANUC teach pendant program in text form (`.ls`).
//!
//! `L P[i] ... mm/sec FINE` to each point in user frame 1 with tool frame 1; lengths in mm, W, P, R [deg] about the fixed x, y and z axes.
//! Frames are numbers on the controller, so their values are stated in remarks. `FINE` stops exactly at every point. `CONFIG` is written
//! `N U T, 0, 0, 0` throughout: it depends on the controller's own joint zeros, so the arm must start in the configuration wanted.
//! The layout follows listings in the open; it was not tried on a controller. Long programs may exceed the controller's memory or its
//! number of lines: state a coarser thinning, or split them.

use crate::export::command::Command;
use crate::export::header::{self, number};
use crate::export::orientation::roll_pitch_yaw;
use crate::export::thin::Point;
use crate::report::Report;
use crate::units::{DEG, MM};

/// Longest remark [characters].
const REMARK: usize = 32;

/// The program.
pub fn program(report: &Report, command: &Command) -> String {
    let mut notes = header::lines(report, Some(command));
    notes.extend([
        "Enter user frame 1 and tool frame 1 as stated above".to_owned(),
        "Check CONFIG before running".into(),
        "To the start by joint motion: look out for what is in between".into(),
    ]);
    let mut code: Vec<String> =
        header::wrapped(&notes, REMARK).into_iter().map(|line| format!("  !{line} ;")).collect();
    code.extend(["  UFRAME_NUM=1 ;".to_owned(), "  UTOOL_NUM=1 ;".into(), "J P[1] 10% FINE    ;".into()]);
    let mut points = vec![&command.start];
    let (mut spindle, mut line) = (None, 0);
    for block in &command.blocks {
        if block.line != line {
            line = block.line;
            code.push(format!("  !line {line} of the original ;"));
        }
        if spindle != Some(block.spindle) {
            spindle = Some(block.spindle);
            code.push(format!("  !spindle {} rpm clockwise ;", number(block.rpm(), 1)));
        }
        if block.wait > 0.0 {
            code.push(format!("  WAIT   {}(sec) ;", number(block.wait, 2)));
        }
        let speed = number(block.feed / MM, 3);
        let speed = speed.trim_end_matches(".0");
        for point in block.points() {
            points.push(point);
            code.push(format!("L P[{}] {speed}mm/sec FINE    ;", points.len()));
        }
    }
    let mut text = format!(
        "/PROG  ARMILL\n/ATTR\nOWNER\t\t= MNEDITOR;\nCOMMENT\t\t= \"Armill {}\";\nPROG_SIZE\t= 0;\nFILE_NAME\t= ;\n\
         VERSION\t\t= 0;\nLINE_COUNT\t= {};\nMEMORY_SIZE\t= 0;\nPROTECT\t\t= READ_WRITE;\n\
         TCD:  STACK_SIZE\t= 0,\n      TASK_PRIORITY\t= 50,\n      TIME_SLICE\t= 0,\n      BUSY_LAMP_OFF\t= 0,\n      \
         ABORT_REQUEST\t= 0,\n      PAUSE_REQUEST\t= 0;\nDEFAULT_GROUP\t= 1,*,*,*,*;\n\
         CONTROL_CODE\t= 00000000 00000000;\n/MN\n",
        env!("CARGO_PKG_VERSION"),
        code.len()
    );
    for (index, line) in code.iter().enumerate() {
        text.push_str(&format!("{:4}:{line}\n", index + 1));
    }
    text.push_str("/POS\n");
    for (index, point) in points.iter().enumerate() {
        text.push_str(&position(command, index + 1, point));
    }
    text.push_str("/END\n");
    text
}

fn position(command: &Command, index: usize, point: &Point) -> String {
    let [x, y, z] = (point.position / MM).map(|x| number(x, 5)).into();
    let [w, p, r] = roll_pitch_yaw(&command.orientation(point)).map(|angle| number(angle / DEG, 6));
    format!(
        "P[{index}]{{\n   GP1:\n\tUF : 1, UT : 1,\t\tCONFIG : 'N U T, 0, 0, 0',\n\tX = {x} mm,\tY = {y} mm,\tZ = {z} mm,\n\t\
         W = {w} deg,\tP = {p} deg,\tR = {r} deg\n}};\n"
    )
}
