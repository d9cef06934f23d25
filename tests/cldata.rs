//! APT as CAM systems write it: Creo, Siemens NX, SolidWorks CAM, drilling cycles, and texts that are
//! not APT. Lengths are worked out by hand.

use crate::common;
use crate::common::moves::{assert_sound, described};
use armill::path::apt::{Options, program};
use armill::path::gcode;
use armill::path::program::{MovePace, Program};
use armill::path::unit::LengthUnit;

const QUARTER: f64 = std::f64::consts::PI * 5.0;

fn read(text: &str) -> Result<Program, armill::Error> {
    program(text, &Options { field: "path.text", unit: LengthUnit::Mm }, |_| {})
}

fn sound(text: &str) -> Program {
    let program = read(text).unwrap_or_else(|error| panic!("{text}\n{error}"));
    assert_sound(&program, text);
    program
}

/// Length of all moves [mm].
fn length(program: &Program) -> f64 {
    program.moves.iter().map(|one| one.segment.length()).sum::<f64>() * 1e3
}

fn remarks(program: &Program) -> Vec<(&str, usize)> {
    program.remarks.iter().map(|remark| (remark.code, remark.line)).collect()
}

fn assert_length(text: &str, expected: f64) {
    let length = length(&sound(text));
    assert!((length - expected).abs() < 1e-3, "{text}\n{length} instead of {expected} mm");
}

/// P06
const CREO: &str = "$$-> MFGNO / PLATE
PARTNO / PLATE
UNITS / MM
$$-> CUTTER / 10.000000
$$-> CSYS / 1.0000000000, 0.0000000000, 0.0000000000, 0.0000000000,  $
            0.0000000000, 1.0000000000, 0.0000000000, 0.0000000000,  $
            0.0000000000, 0.0000000000, 1.0000000000, 0.0000000000
SPINDL / RPM, 3000.000000,  CLW
RAPID
GOTO / 0.0000000000, 0.0000000000, 5.0000000000
FEDRAT / 300.000000, MMPM
GOTO / 0.0000000000, 0.0000000000, -1.0000000000
GOTO / 40.0000000000, 0.0000000000, -1.0000000000
$$-> END /
FINI
";

#[test]
fn comments_of_creo_are_comments_as_a_whole() {
    assert_length(CREO, 46.0);
    let program = sound(CREO);
    assert_eq!(remarks(&program), []);
    assert_eq!((program.tools[0].diameter, program.tools[0].line, program.lines), (10e-3, 4, 15));
    for (text, expected) in [
        ("GOTO/0,0,0\n$$-> FEEDRAT / 5, $\nGOTO/9,9,9\nGOTO/1,0,0", "line 1 0 0 job"),
        ("GOTO/0,0,0\n$$-> A / 1, $\n 2, $\n 3\nGOTO/1,0,0", "line 1 0 0 job"),
        ("GOTO/0,0,0\n$$-> COST $ 5\nGOTO/1,0,0", "line 1 0 0 job"),
        (
            "GOTO/0,0,0\n  $$->CUTCOM_GEOMETRY_TYPE/OUTPUT_ON_CENTER\nGOTO/1,0,0\nFINI\n$$-> END /",
            "line 1 0 0 job",
        ),
        // A plain comment ends with its line.
        ("GOTO/0,0,0\n$$ price in $\nGOTO/1,0,0", "line 1 0 0 job"),
        ("GOTO/0,0,0\nGOTO/1,0,0\n$$-> NOTE $", "line 1 0 0 job"),
        // Other line ends, and what stands before and after the text.
        ("\u{feff}GOTO/0,0,0\rGOTO/1,0,0\r", "line 1 0 0 job"),
        ("GOTO/0,0,0\r\nGOTO/1,0,0\r\n\u{1a}\0\0", "line 1 0 0 job"),
    ] {
        assert_eq!(described(&sound(text)), expected, "{text:?}");
    }
}

#[test]
fn another_frame_is_remarked_and_a_change_is_refused() {
    let identity = "MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000";
    let go = "UNITS/MM\nFEDRAT/6\nGOTO/0,0,0\nGOTO/1,0,0";
    for (frame, expected) in [
        (identity, vec![]),
        ("MSYS/0,0,0,1,0,0,0,1,0", vec![]),
        ("ORIGIN/0,0,0", vec![]),
        ("CSYS/1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", vec![]),
        ("$$-> CSYS / 1, 0, 0, 0, $\n 0, 1, 0, 0, $\n 0, 0, 1, 0", vec![]),
        ("MSYS/0,0,9,1,0,0,0,1,0", vec![("other-frame", 1)]),
        ("ORIGIN/0,0,9", vec![("other-frame", 1)]),
        ("$$-> CSYS / 1, 0, 0, 0, $\n 0, 1, 0, 0, $\n 0, 0, 1, 9", vec![("other-frame", 1)]),
        ("MSYS/0,0,9,1,0,0,0,1,0\nMSYS/0.0,0.0,9.0,1.0,0.0,0.0,0.0,1.0,0.0", vec![("other-frame", 1)]),
        ("ORIGIN/0,0,0\nMSYS/0,0,0,1,0,0,0,1,0", vec![]),
    ] {
        assert_eq!(remarks(&sound(&format!("{frame}\n{go}"))), expected, "{frame}");
    }
    for (text, place, part) in [
        ("CSYS/1,0,0,0,0,1,0,0,0,0,1,9\nGOTO/0,0,0", (1, 1), "have the CAM system"),
        ("MSYS/0,0,0,1,0,0,0,1,0\nGOTO/0,0,0\nMSYS/0,0,9,1,0,0,0,1,0", (3, 1), "one frame"),
        ("GOTO/0,0,0\nMSYS/0,0,9,1,0,0,0,1,0", (2, 1), "one frame"),
        ("$$-> CSYS/1,0,0,0,0,1,0,0,0,0,1,0\n$$-> CSYS/0,1,0,0,-1,0,0,0,0,0,1,0", (2, 1), "one frame"),
        ("MSYS/A", (1, 6), "\"A\""),
    ] {
        common::refused_at(read(text), text, place, part);
    }
}

/// P07
const DRIVEN: &str = "UNITS / MM
FEDRAT / 300.0, MMPM
GOTO / 0.0, 10.0, 0.0
INDIRV / 1.0, 0.0, 0.0
TLON
GOFWD / ( CIRCLE / 0.0000000000, 0.0000000000, 0.0000000000,$
10.0000000000 ), $
    ON, ( LINE / 0.0000000000, 0.0000000000, 0.0000000000,$
                 10.0000000000, 0.0000000000, 0.0000000000 )
FINI
";

#[test]
fn arcs_along_a_drive_curve_are_true_arcs() {
    assert_length(DRIVEN, QUARTER);
    assert_eq!(described(&sound(DRIVEN)), "arc 10 0 0 about 0 0 0 by 90 feed 5");
    let quarter = "GOFWD/(CIRCLE/0,0,0,10),ON,(LINE/0,0,0,0,10,0)";
    for (before, expected) in [
        ("INDIRV/0,1,0\nTLON", "by 90"),
        ("TLON\nINDIRV/0,1,0", "by 90"),
        ("INDIRV/0,-1,0\nTLON", "by 270"),
        ("INDIRP/7,7,0\nTLON", "by 90"),
        ("INDIRP/0,20,0\nTLON", "by 90"),
        ("INDIRP/0,-20,0\nTLON", "by 270"),
        // A tool of no radius beside the circle is on it.
        ("INDIRV/0,1,0\nTLLFT", "by 90"),
        ("INDIRV/0,1,0\nTLRGT", "by 90"),
    ] {
        let text = format!("GOTO/10,0,0\n{before}\n{quarter}");
        assert_eq!(described(&sound(&text)), format!("arc 0 10 0 about 0 0 0 {expected} job"), "{text}");
    }
    // TLON holds; in one statement it may be continued.
    let text = format!(
        "GOTO/10,0,0\nINDIRV/0,1,0\nTLON, $\n{quarter}\nINDIRV/-1,0,0\n\
         GOFWD/(CIRCLE/0,0,0,10),ON,2,INTOF,(LINE/0,0,0,-10,0,0)"
    );
    assert_length(&text, 2.0 * QUARTER);
    for (text, place, part) in [
        (format!("GOTO/10,0,0\nINDIRV/0,1,0\n{quarter}"), (3, 1), "TLON"),
        (format!("GOTO/10,0,0\nTLON\n{quarter}"), (3, 1), "INDIRV"),
        (format!("GOTO/12,0,0\nINDIRV/0,1,0\nTLLFT\n{quarter}"), (3, 1), "beside the circle"),
        (format!("GOTO/10,0,0\nINDIRP/20,0,0\nTLON\n{quarter}"), (2, 1), "INDIRP"),
        (format!("INDIRP/20,0,0\nTLON\n{quarter}"), (1, 1), "a GOTO before it"),
        ("GOTO/10,0,0\nINDIRV/0,1,0\nTLON\nGORGT/(CIRCLE/0,0,0,10)".into(), (4, 1), "part geometry"),
        ("GOTO/10,0,0\nINDIRP/0,1,0\nGOTO/0,0,0".into(), (2, 1), "TLON,GOFWD"),
    ] {
        common::refused_at(read(&text), &text, place, part);
    }
}

/// P08
const NX: &str = "TOOL PATH/KONTUR,TOOL,M10
TLDATA/MILL,10.0000,0.0000,75.0000,0.0000,0.0000
MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000
RAPID
GOTO/10.0000,0.0000,5.0000,0.0000000,0.0000000,1.0000000
FEDRAT/MMPM,600.0000
GOTO/10.0000,0.0000,0.0000
CIRCLE/0.0000,0.0000,0.0000,0.0000000,0.0000000,-1.0000000,10.0000,0.0600,0.5000,10.0000,0.0000
GOTO/0.0000,10.0000,0.0000
END-OF-PATH
";

/// P09
const SOLIDWORKS: &str = "$$ PART
UNIT/MM
MACHIN/3 AXIS MILL
CSYS/1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.
LOADTL/1
SPINDL/3000,RPM,CLW
RAPID/
GOTO/10.,0.,5.
FEDRAT/600,MMPM
GOTO/10.,0.,0.
CIRCLE/0.,0.,0.,0.,0.,1.
GOTO/0.,10.,0.
FINI
";

#[test]
fn circles_turn_as_their_system_means_them() {
    for text in [NX, SOLIDWORKS] {
        assert_length(text, 5.0 + QUARTER);
        let last = sound(text).moves[1].segment;
        // Counter-clockwise from above: halfway at 45 deg.
        let middle = last.point(last.length() / 2.0) * 1e3;
        assert!(
            (middle.x - 50.0_f64.sqrt()).abs() < 1e-9 && (middle.y - 50.0_f64.sqrt()).abs() < 1e-9,
            "{middle}"
        );
    }
    assert_eq!(remarks(&sound(SOLIDWORKS)), [("circle-sense", 11)]);
    let words = "UNIT/INCH\nCSI_SET_OFFSET/1\nCSI_SET_TOOL,2\nTRNTYP/1\nSETUP/1\nPAINT/PATH\n\
                 PAINT/SPEED,10\nRAPID / \nGOTO/0,0,0\nRAPID  \nGOTO/1,0,0";
    let program = sound(words);
    assert_eq!((described(&program).as_str(), program.ignored.len()), ("line 25.4 0 0 rapid", 6));
    let go = "GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1";
    for (values, expected) in [
        ("", "arc 0 10 4 about 0 0 0 by 90 rise 4 job"),
        (",10", "arc 0 10 4 about 0 0 0 by 90 rise 4 job"),
        (",10,0.06,0.5,10,0", "arc 0 10 4 about 0 0 0 by 270 rise -4 job"),
    ] {
        let text = format!("{go}{values}\nGOTO/0,10,4");
        assert_eq!(described(&sound(&text)), expected, "{text}");
    }
    for (values, place, part) in [
        (",10,0.06,0.5,10,0,TIMES,2", (2, 37), "TIMES"),
        (",10,0.06,0.5,10,A", (2, 35), "\"A\""),
        (",10,0.06", (2, 23), "eleven (Siemens NX)"),
    ] {
        let text = format!("{go}{values}\nGOTO/0,10,0");
        common::refused_at(read(&text), &text, place, part);
    }
    let text = "GOTO/0,0,0\nCIRCLE/0,0,0,0,0,1\nGOTO/0,10,0";
    common::refused_at(read(text), text, (3, 1), "circle");
}

/// P27
const DRILLED: &str = "UNITS / MM
RAPID
GOTO/0,0,20
CYCLE / DRILL, DEPTH, 10.000000, MMPM, 200.000000, CLEAR, 2.000000
GOTO/0,0,0
GOTO/20,0,0
CYCLE / OFF
RAPID
GOTO/20,0,20
FINI
";

#[test]
fn drilling_cycles_are_expanded() {
    assert_length(DRILLED, 18.0 + 12.0 + 12.0 + 20.0 + 12.0 + 12.0 + 18.0);
    let program = sound(DRILLED);
    let lowest = program.moves.iter().map(|one| one.segment.point(one.segment.length()).z);
    assert_eq!(lowest.fold(f64::INFINITY, f64::min), -0.010);
    assert_eq!(program.moves.iter().filter(|one| one.pace != MovePace::Rapid).count(), 2);
    for (cycle, holes, expected) in [
        // Values in another order; the feed of FEDRAT; a return above the clearance.
        (
            "DRILL,CLEAR,2,RETURN,5,DEPTH,3",
            "GOTO/1,0,0",
            "line 1 0 9 rapid; line 1 0 2 rapid; line 1 0 -3 feed 1; line 1 0 5 rapid",
        ),
        (
            "FACE,DEPTH,3,IPM,6,CLEAR,1,DWELL,0.5",
            "GOTO/0,0,0",
            "line 0 0 1 rapid; line 0 0 -3 feed 2.54; line 0 0 1 rapid",
        ),
        // The tool rises to a hole that lies higher, and stays up on the way to a lower one.
        (
            "DRILL,DEPTH,1,CLEAR,1",
            "GOTO/0,0,0\nGOTO/1,0,5\nGOTO/2,0,0",
            "line 0 0 1 rapid; line 0 0 -1 feed 1; line 0 0 1 rapid; \
             line 0 0 6 rapid; line 1 0 6 rapid; line 1 0 4 feed 1; line 1 0 6 rapid; \
             line 2 0 6 rapid; line 2 0 1 rapid; line 2 0 -1 feed 1; line 2 0 1 rapid",
        ),
        (
            "DRILL,DEEP,DEPTH,3,STEP,2,CLEAR,1",
            "GOTO/0,0,0",
            "line 0 0 1 rapid; line 0 0 -1 feed 1; line 0 0 1 rapid; line 0 0 -0.746 rapid; \
             line 0 0 -3 feed 1; line 0 0 1 rapid",
        ),
        (
            "BRKCHP,DEPTH,3,INCR,2,CLEAR,1",
            "GOTO/0,0,0",
            "line 0 0 1 rapid; line 0 0 -1 feed 1; line 0 0 -0.746 rapid; line 0 0 -3 feed 1; line 0 0 1 rapid",
        ),
        // A hole along x, at a tilted tool: straight to its clearance.
        (
            "DRILL,DEPTH,3,CLEAR,1",
            "GOTO/5,0,0,1,0,0",
            "line 6 0 0 rapid tilt 1 0 0; line 2 0 0 feed 1 from 1 0 0 tilt 1 0 0; \
             line 6 0 0 rapid from 1 0 0 tilt 1 0 0",
        ),
    ] {
        let text = format!("FEDRAT/60\nGOTO/0,0,9\nCYCLE/{cycle}\n{holes}");
        assert_eq!(described(&sound(&text)), expected, "{text}");
    }
    let program = sound("GOTO/0,0,9\nCYCLE/DRILL,DEPTH,3,CLEAR,1,DWELL,2\nGOTO/0,0,0\nGOTO/5,0,0");
    let waits: Vec<_> = program.dwells.iter().map(|wait| (wait.after, wait.time, wait.line)).collect();
    assert_eq!(waits, [(2, 2.0, 3), (5, 2.0, 4)]);
}

#[test]
fn cycles_are_expanded_as_the_gcode_reader_expands_them() {
    let options = gcode::Options { field: "path.text".into(), ..gcode::Options::default() };
    for (cycle, code) in [
        ("DRILL,DEPTH,10,MMPM,200,CLEAR,2", "G81"),
        ("FACE,DEPTH,10,MMPM,200,CLEAR,2,DWELL,1.5", "G82 P1.5"),
        ("DEEP,DEPTH,10,MMPM,200,STEP,3,CLEAR,2", "G83 Q3"),
        ("BRKCHP,DEPTH,10,MMPM,200,STEP,4,CLEAR,2", "G73 Q4"),
    ] {
        let apt = sound(&format!("GOTO/0,0,20\nCYCLE/{cycle}\nGOTO/1,0,0\nGOTO/20,5,0\nCYCLE/OFF"));
        let text = format!("G21 G90 G94\nG0 X0 Y0 Z20\nG99 {code} X1 Y0 Z-10 R2 F200\nX20 Y5\nG80");
        let gcode = gcode::program(&text, &options, |_| {}).unwrap();
        assert_eq!(described(&apt), described(&gcode), "{cycle}");
        let waits =
            |program: &Program| program.dwells.iter().map(|one| (one.after, one.time)).collect::<Vec<_>>();
        assert_eq!(waits(&apt), waits(&gcode), "{cycle}");
    }
}

#[test]
fn cycles_that_are_not_certain_are_refused() {
    let expand = "expand cycles";
    for (text, place, part) in [
        ("CYCLE/DRILL,10,MMPM,100,5", (1, 1), expand),
        ("CYCLE/DRILL,RAPTO,3,FEDTO,-10,RTRCTO,AUTO,MMPM,250", (1, 1), expand),
        ("CYCLE/TAP,DEPTH,10,MMPM,100,CLEAR,5", (1, 1), expand),
        ("CYCLE/DRILL,DEPTH,10,MMPM,100", (1, 1), expand),
        ("CYCLE/DRILL,CLEAR,2,MMPM,100", (1, 1), expand),
        ("CYCLE/DRILL,DEPTH,10,STEP,3,CLEAR,2", (1, 1), expand),
        ("CYCLE/DEEP,DEPTH,10,CLEAR,2", (1, 1), expand),
        ("CYCLE/DEEP,DEPTH,10,STEP,3,2,CLEAR,2", (1, 1), expand),
        ("CYCLE/FACE,DEPTH,10,CLEAR,2", (1, 1), expand),
        ("CYCLE/DRILL,DEPTH,10,DEPTH,12,CLEAR,2", (1, 1), expand),
        ("CYCLE/ON", (1, 1), expand),
        ("CYCLE/DRILL,DEPTH,-10,CLEAR,2", (1, 19), "DEPTH is above 0"),
        ("CYCLE/DRILL,DEPTH,10,CLEAR,-2", (1, 28), "CLEAR is 0 or more"),
        ("CYCLE/DRILL,DEPTH,10,CLEAR,2,RETURN,1", (1, 37), "CLEAR or above"),
        ("CYCLE/DRILL,DEPTH,10,CLEAR,2,MMPM,0", (1, 35), "larger than 0"),
        ("CYCLE/DRILL,DEPTH,10,CLEAR,2,DWELL,9999", (1, 36), "0 to 3600 s"),
        ("CYCLE/DEEP,DEPTH,10,STEP,0.001,CLEAR,2", (1, 1), "at most 1000"),
        ("GOTO/0,0,9\nCYCLE/DRILL,DEPTH,9,CLEAR,2\nRAPID\nGOTO/0,0,0", (4, 1), "each GOTO is a hole"),
        ("GOTO/0,0,9\nCYCLE/DRILL,DEPTH,9,CLEAR,2\nGOHOME/0,0,9", (3, 1), "CYCLE/OFF"),
        // P28
        ("CUTCOM/LEFT\nGOTO/0,0,0", (1, 1), "cutter compensation"),
    ] {
        common::refused_at(read(text), text, place, part);
    }
}

/// P29
const HOME: &str = "RAPID
GOTO/0,0,10
FEDRAT/600,MMPM
GOTO/50,0,10
GOHOME/50,0,100
LOADTL/2
RAPID
GOTO/50,20,10
FEDRAT/600,MMPM
GOTO/0,20,10
FINI
";

/// P31
const STANDING: &str = "SPINDL/0,CLW\nRAPID\nGOTO/0,0,0,0,0,1\nFEDRAT/600,MMPM\nGOTO/50,0,0\nFINI";

#[test]
fn what_cam_systems_add_is_harmless() {
    assert_length(HOME, 50.0 + 90.0 + 8500.0_f64.sqrt() + 50.0);
    assert_eq!(
        sound(HOME).moves.iter().map(|one| one.pace == MovePace::Rapid).collect::<Vec<_>>(),
        [false, true, true, false]
    );
    assert_length(STANDING, 50.0);
    assert_eq!(remarks(&sound(STANDING)), [("spindle-zero", 1), ("unit-assumed", 3)]);
    for (text, expected) in [
        ("SPINDL/RPM,600,CLW,RANGE,1\nGOTO/0,0,0\nGOTO/1,0,0", "line 1 0 0 job spindle 600"),
        ("SPINDL/600,RANGE,LOW,CLW\nGOTO/0,0,0\nGOTO/1,0,0", "line 1 0 0 job spindle 600"),
        ("GOTO/0,0,0\nFEDRAT/600,PERMIN\nGOTO/1,0,0", "line 1 0 0 feed 10"),
        ("GOTO/0,0,0\nFEDRAT/600,PERMIN,MMPM\nGOTO/1,0,0", "line 1 0 0 feed 10"),
        ("GOTO/0,0,0\nFEDRAT/PERMIN,6,IPM\nGOTO/1,0,0", "line 1 0 0 feed 2.54"),
        ("ROTABL/0\nROTABL/ATANGL,0.0\nGOTO/0,0,0\nGOTO/1,0,0", "line 1 0 0 job"),
        ("GOHOME/0,0,5\nGOTO/1,0,5\nGOHOME/0,0,5,0,0,1", "line 1 0 5 job; line 0 0 5 rapid"),
        ("GOTO/0,0,0\nRAPID/\nGOHOME/1,0,0\nGOTO/2,0,0", "line 1 0 0 rapid; line 2 0 0 job"),
    ] {
        assert_eq!(described(&sound(text)), expected, "{text:?}");
    }
    for (text, place, part) in [
        // P30
        (
            "GOTO/0,0,0\nFEDRAT/600,MMPM\nGOTO/10,0,0\nNURBS/\n\
             KNOT/0.1,0.5,1.0\nCNTRL/11,0,0\nCNTRL/12,1,0\nGOTO/20,0,0",
            (4, 1),
            "splines",
        ),
        ("SPLINE/1", (1, 1), "splines"),
        ("ROTABL/90", (1, 1), "rotary axes"),
        ("ROTABL/CLW", (1, 1), "rotary axes"),
        ("FEDRAT/600,PERMIN,MMPR", (1, 19), "MMPM"),
        ("SPINDL/600,RANGE", (1, 12), "SPINDL/RPM"),
        ("GOHOME/1,2", (1, 11), "3 or 6 values"),
        ("GOTO/0,0,0\nGOHOME/\nGOTO/1,0,0", (3, 1), "GOHOME (line 2)"),
    ] {
        common::refused_at(read(text), text, place, part);
    }
}

#[test]
fn another_language_is_named() {
    for (text, place, name, part) in [
        // P46
        ("G21 G90\nG0 X0 Y0 Z10\nG1 Z-1 F600\nX50\nG0 Z10", (1, 1), "G-code", "choose G-code"),
        ("%\nO1001 (PLATE)\nG21 G90", (1, 1), "G-code", "choose G-code"),
        ("(made by CAM)\nN10 G0 X0 Y0 Z10", (1, 1), "G-code", "choose G-code"),
        ("#1=10\nG0 X#1\nG1 Y5", (1, 1), "G-code", "choose G-code"),
        ("DEF TEIL()\nPTP {A1 0,A2 -90}\nLIN {X 0,Y 0}\nEND", (1, 1), "KUKA KRL", "not supported"),
        ("&ACCESS RVP\nDEF TEIL()", (1, 1), "KUKA KRL", "not supported"),
        ("PTP {A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0}", (1, 1), "KUKA KRL", "not supported"),
        (
            "0 BEGIN PGM TEIL MM\n1 TOOL CALL 1 Z S3000\n2 L X+0 Y+0 R0 FMAX",
            (1, 1),
            "Heidenhain",
            "not supported",
        ),
        ("BEGIN PGM TEIL MM", (1, 1), "Heidenhain", "not supported"),
        ("MODULE Part\nPROC main()\nMoveL p10,v100,fine,tool0;", (1, 1), "ABB RAPID", "not supported"),
        ("/PROG PART\n/ATTR", (1, 1), "FANUC", "not supported"),
        ("def part():\n  movel(p[0,0,0,0,0,0])", (1, 1), "URScript", "not supported"),
        ("1,2,3\n4,5,6", (1, 1), "rows of numbers", "choose points"),
    ] {
        common::refused_at(read(text), text, place, part);
        assert!(read(text).unwrap_err().to_string().contains(name), "{text:?}");
    }
    // One strange word in a text of APT makes no other language.
    let text = "GOTO/0,0,0\nG01 X5\nGOTO/1,0,0";
    common::refused_at(read(text), text, (2, 1), "a word of APT");
    let text = "ABCDE/1\n$$-> CSYS / 1, 0, 0, 0, $\n 0, 1, 0, 0, $\n 0, 0, 1, 0\nGOTO / 0, 0, 0";
    common::refused_at(read(text), text, (1, 1), "a word of APT");
}
