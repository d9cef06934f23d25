//! ABB Externally Guided Motion, path correction: a module that runs the desired path with it, and the correction across the
//! path.
//!
//! `EGMSetupUC` with `\PathCorr`, `EGMActMove`, `EGMMoveL` and `EGMMoveC` as public modules for this option write them
//! (github.com/rpiRobotics/abb_motion_program_exec, github.com/FLo-ABB/ABB-EGM-Python); messages are `EgmSensorPathCorr` of
//! `egm.proto`, as in the crate `abbegm`. A path correction shifts across the path only, and the controller takes a new one every
//! 48 ms, whatever is sent in between.

use super::{CorrectionTable, header};
use crate::export::header::number;
use crate::export::post::robot::PackageFile;
use crate::report::Report;
use crate::units::MM;
use std::fmt::Write;

/// Longest time between two rows [s]: that at which the controller takes a correction.
pub const SLOWEST: f64 = 0.048;
/// Time from one correction to the next that the controller takes [ms].
const RATE: u32 = 48;

/// The files, the module first.
pub(super) fn files(report: &Report, table: &CorrectionTable) -> Vec<PackageFile> {
    let name = &report.setup().output.name;
    let said = said(report, table);
    let file = |ending: &str, text| PackageFile { path: format!("{name}{ending}"), text };
    vec![
        file("_EGM.mod", module(name, &said)),
        file("_EGM_correction.csv", super::remarks(&said) + &in_path(table)),
        file("_correction.csv", super::remarks(&said) + &table.csv()),
    ]
}

/// The header, with what the interface cannot do.
fn said(report: &Report, table: &CorrectionTable) -> Vec<String> {
    let mut lines = header(report, table);
    lines.push(format!(
        "EGM shifts across the path only: y_mm and z_mm. Up to {} mm of the shift and {} deg are left out. Nothing is sent where the \
         tool moves along itself, as in a plunge.",
        number(table.largest_along / MM, 4),
        number(table.largest_turn, 4)
    ));
    lines.push(
        "Path coordinates: x along the path, y = tool z times x, z = x times y, tool z out of the tool. Check both signs with a \
         constant correction first."
            .into(),
    );
    lines.push(format!("The controller takes a correction every {RATE} ms, whatever is sent in between."));
    lines
}

fn module(name: &str, said: &[String]) -> String {
    let mut text = format!("MODULE {name}_EGM\n");
    for line in said {
        let _ = writeln!(text, "  ! {line}");
    }
    let _ = write!(
        text,
        "  VAR egmident egmId1;\n\
         \n  ! tMill is the tool as the program of the desired path declares it.\n\
         \n  PROC {name}_Run()\n    \
         ! Move to the start of the desired path here, with a fine point.\n    \
         EGMReset egmId1;\n    \
         EGMGetId egmId1;\n    \
         ! pathCorr: External Motion Interface Data with level Path. UCdevice: a transmission protocol of type UDPUC.\n    \
         EGMSetupUC ROB_1, egmId1, \"pathCorr\", \"UCdevice\" \\PathCorr \\APTR;\n    \
         EGMActMove egmId1, tMill.tframe \\SampleRate:={RATE};\n    \
         ! The program of the desired path here, each MoveL as EGMMoveL egmId1 and each MoveC as EGMMoveC egmId1.\n    \
         EGMReset egmId1;\n  \
         ENDPROC\n\
         ENDMODULE\n"
    );
    text
}

/// The correction across the path as CSV.
fn in_path(table: &CorrectionTable) -> String {
    let mut text = String::from("time_s,s_mm,y_mm,z_mm\n");
    for row in &table.rows {
        let cells = [
            number(row.time, 6),
            number(row.arc_length / MM, 4),
            number(row.across[0] / MM, 5),
            number(row.across[1] / MM, 5),
        ];
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text
}
