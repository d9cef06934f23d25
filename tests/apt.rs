//! APT and CLDATA input: points, arcs, axes, feeds, units and mistakes, all worked out by hand.

use crate::common;
use crate::common::moves::{assert_sound, described};
use armill::math;
use armill::path::apt::{Options, program};
use armill::path::program::{Program, Tool};
use armill::path::unit::LengthUnit;

fn read(text: &str) -> Result<Program, armill::Error> {
    program(text, &Options { field: "path.text", unit: LengthUnit::Mm }, |_| {})
}

#[test]
fn moves_are_read() {
    for (text, expected) in [
        // Straight moves. The first point only sets the start of the path.
        ("GOTO/0,0,0\nGOTO/10,0,0", "line 10 0 0 job"),
        ("FROM/0,0,5\nGOTO/0,0,0", "line 0 0 0 job"),
        ("goto / 1., 2.,3\nGoTo/ -.5 , +2.5E+1, 1e-1", "line -0.5 25 0.1 job"),
        ("GOTO/0,0,0\n\n  GOTO/1,2,3\nGOTO/4,5,6", "line 1 2 3 job; line 4 5 6 job"),
        ("GOTO/0,0,0\nGOTO/0,0,0\nGOTO/1,0,0\nGOTO/1,0,0", "line 1 0 0 job"),
        ("\u{feff}GOTO/0,0,0\r\nGOTO/1,0,0\r\n", "line 1 0 0 job"),
        // Continuation lines and comments.
        ("GOTO/0,0,0 $$ start\n$$ GOTO/5,5,5\nGOTO/1, $\n2,3", "line 1 2 3 job"),
        ("GOTO/0,0,0\nGOTO/1, $ $$ half\n\n 2, $\n3", "line 1 2 3 job"),
        ("GOTO/0,0,0\nGOTO $\n/1 $\n,2,3", "line 1 2 3 job"),
        // Rapid moves: only the next GOTO.
        ("GOTO/0,0,0\nRAPID\nGOTO/1,0,0\nGOTO/2,0,0", "line 1 0 0 rapid; line 2 0 0 job"),
        ("RAPID\nGOTO/0,0,0\nFEDRAT/60,MMPM\nGOTO/1,0,0", "line 1 0 0 feed 1"),
        // Feeds, all in mm/s here.
        ("GOTO/0,0,0\nFEDRAT/600\nGOTO/1,0,0", "line 1 0 0 feed 10"),
        ("GOTO/0,0,0\nFEDRAT/MMPM,120\nGOTO/1,0,0\nGOTO/2,0,0", "line 1 0 0 feed 2; line 2 0 0 feed 2"),
        ("GOTO/0,0,0\nFEDRAT/6,IPM\nGOTO/1,0,0", "line 1 0 0 feed 2.54"),
        ("GOTO/0,0,0\nSPINDL/RPM,600,CLW\nFEDRAT/0.5,MMPR\nGOTO/1,0,0", "line 1 0 0 feed 5 spindle 600"),
        (
            "GOTO/0,0,0\nFEDRAT/0.1,IPR\nSPINDL/60\nGOTO/1,0,0\nSPINDL/120,CLW\nGOTO/2,0,0",
            "line 1 0 0 feed 2.54 spindle 60; line 2 0 0 feed 5.08 spindle 120",
        ),
        ("UNITS/INCHES\nGOTO/0,0,0\nFEDRAT/PERMIN,6\nGOTO/1,0,0", "line 25.4 0 0 feed 2.54"),
        // Spindle.
        (
            "GOTO/0,0,0\nSPINDL/100.0,RPM,CLW\nGOTO/1,0,0\nSPINDL/OFF\nGOTO/2,0,0\nSPINDL/ON\nGOTO/3,0,0",
            "line 1 0 0 job spindle 100; line 2 0 0 job; line 3 0 0 job spindle 100",
        ),
        // Tool axes: normalised, kept, and upright again after MULTAX/OFF.
        ("GOTO/0,0,0\nGOTO/1,0,0,0,0.6,0.8", "line 1 0 0 job tilt 0 0.6 0.8"),
        (
            "MULTAX\nGOTO/0,0,0,0,0.6,0.8\nGOTO/1,0,0,0,0.6,0.8",
            "line 1 0 0 job from 0 0.6 0.8 tilt 0 0.6 0.8",
        ),
        ("GOTO/0,0,0,0,0,1\nGOTO/1,0,0,0,3,4", "line 1 0 0 job tilt 0 0.6 0.8"),
        (
            "MULTAX/ON\nGOTO/0,0,0,1,0,0\nGOTO/1,0,0\nMULTAX/OFF\nGOTO/2,0,0",
            "line 1 0 0 job from 1 0 0 tilt 1 0 0; line 2 0 0 job from 1 0 0",
        ),
        ("TLAXIS/0,1,0\nGOTO/0,0,0\nGOTO/1,0,0", "line 1 0 0 job from 0 1 0 tilt 0 1 0"),
        ("FROM/0,0,0\nGOTO/0,0,0,1,0,0\nGOTO/1,0,0,1,0,0", "line 1 0 0 job from 1 0 0 tilt 1 0 0"),
        // Arcs: counter-clockwise about the vector.
        ("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0", "arc 0 10 0 about 0 0 0 by 90 job"),
        ("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,-1,10\nGOTO/0,10,0", "arc 0 10 0 about 0 0 0 by 270 job"),
        ("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/10,0,0", "arc 10 0 0 about 0 0 0 by 360 job"),
        ("GOTO/0,0,10\nCIRCLE/0,0,0,0,1,0,10\nGOTO/10,0,0", "arc 10 0 0 about 0 0 0 by 90 job"),
        ("GOTO/0,0,10\nCIRCLE/0,0,0,0,-1,0,10\nGOTO/10,0,0", "arc 10 0 0 about 0 0 0 by 270 job"),
        // PTC's thread: a turn that rises, then another from its end.
        (
            "UNITS/INCHES\nGOTO / 1, 0, -1\nFEDRAT / 6, IPM\nCIRCLE / 0, 0, -1, $ $$ 1ST ORBIT\n0, 0, 1, 1\nGOTO / 1, 0, 0",
            "arc 25.4 0 0 about 0 0 -25.4 by 360 rise 25.4 feed 2.54",
        ),
        ("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,-1,10\nGOTO/0,-10,-2", "arc 0 -10 -2 about 0 0 0 by 90 rise 2 job"),
        ("GOTO/10,0,3\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,3", "arc 0 10 3 about 0 0 3 by 90 job"),
        ("GOTO/10,0,0\nMOVARC/0,0,0,0,0,1,10,ANGLE,90\nGOTO/0,10,0", "arc 0 10 0 about 0 0 0 by 90 job"),
        (
            "GOTO/10,0,0\nMOVARC/0,0,0,0,0,1,10, ANGLE, 810\nGOTO/0,10,9",
            "arc 0 10 9 about 0 0 0 by 810 rise 9 job",
        ),
        // CATIA's arcs: a direction vector gives the sense of rotation.
        (
            "GOTO/10,0,0\nINDIRV/0,1,0\nTLON,GOFWD/ (CIRCLE/ 0, 0, 0,$\n 10),ON,(LINE/ 0, 0, 0, 0, 10, 0)",
            "arc 0 10 0 about 0 0 0 by 90 job",
        ),
        (
            "GOTO/10,0,0\nINDIRV/0,-1,0\nFEDRAT/60\nTLON,GOFWD/(CIRCLE/0,0,0,10),ON,2,INTOF,(LINE/0,0,0,0,10,0)\nGOTO/0,20,0",
            "arc 0 10 0 about 0 0 0 by 270 feed 1; line 0 20 0 feed 1",
        ),
        // A radius rounded by the CAM system: accepted within 0.01 mm, and both ends stay as
        // written.
        (
            "GOTO/10.004,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/-9.996,0,0",
            "arc -9.996 0 0 about 0.004 0 0 by 180 job",
        ),
        (
            "GOTO/10,0,0\nRAPID\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0,0,0.6,0.8",
            "arc 0 10 0 about 0 0 0 by 90 rapid tilt 0 0.6 0.8",
        ),
    ] {
        let program = read(text).unwrap_or_else(|error| panic!("{text:?}: {error}"));
        assert_eq!(described(&program), expected, "{text:?}");
        assert_sound(&program, text);
    }
}

#[test]
fn mistakes_are_placed_and_say_what_to_do() {
    for (text, place, part) in [
        ("", (1, 1), "two different GOTO points"),
        ("GOTO/1,2,3\n", (1, 1), "two different GOTO points"),
        ("GOTO/0,0,0\nGOTO/1,2", (2, 9), "3 or 6 values"),
        ("GOTO/0,0,0\nGOTO/1,2,3,4", (2, 13), "3 or 6 values"),
        ("GOTO/0,0,0\nGOTO/1,2,3,0,0,1,500", (2, 18), "3 or 6 values"),
        ("GOTO/0,0,0\nGOTO", (2, 5), "3 or 6 values"),
        ("GOTO/0,0,0\n GOTO/1, P2,3", (2, 10), "\"P2\""),
        ("GOTO/1,,3", (1, 8), "value before and after it"),
        ("GOTO/1,2,", (1, 10), "value before and after it"),
        ("GOTO/1,2 $\n3", (2, 1), "separated by commas"),
        ("GOTO/1,2,3 $", (1, 11), "continues the statement"),
        ("GOTO/1,2,nan", (1, 10), "\"nan\""),
        ("GOTO/1,2,inf", (1, 10), "\"inf\""),
        ("GOTO/1 0,2,3", (1, 6), "\"1 0\""),
        ("GOTO/1,2,2e6", (1, 10), "within 1000000 mm"),
        ("GOTO/1,2,1e999", (1, 10), "\"1e999\""),
        ("GOTO/1,2,3,0,0,0", (1, 12), "a direction has the length 1"),
        ("GOTO/0,0,0\nGOTO/1,0,0\nGOTO/1,0,0,1,0,0", (3, 1), "90.000 deg in place"),
        ("GOTO/0,0,0\nGOTO/1,0,0,0,0,-1", (2, 1), "180 deg"),
        ("MULTAX/OFF\nGOTO/0,0,0,0,0,1", (2, 12), "MULTAX/ON"),
        ("MULTAX/YES", (1, 8), "ON or OFF"),
        ("RAPID/5", (1, 7), "RAPID takes no values"),
        ("UNITS/FEET", (1, 7), "MM or INCHES"),
        ("GOTO/0,0,0\nUNITS/INCHES", (2, 1), "before the first length"),
        ("FEDRAT/100,MMPS", (1, 12), "MMPM, IPM, MMPR or IPR"),
        ("FEDRAT/0", (1, 8), "larger than 0"),
        ("FEDRAT/-5,IPM", (1, 8), "larger than 0"),
        ("FEDRAT", (1, 7), "FEDRAT/f,MMPM"),
        ("SPINDL/0.5,RPM", (1, 8), "from 1 to 1000000 rpm"),
        ("FEDRAT/1e9", (1, 8), "a feed is"),
        ("GOTO/0,0,0\nFEDRAT/0.1,MMPR\nGOTO/1,0,0", (3, 1), "SPINDL"),
        ("SPINDL/RPM,1000,CCLW", (1, 17), "clockwise"),
        ("SPINDL/SFM,100", (1, 8), "surface speed"),
        ("SPINDL/-1", (1, 8), "SPINDL/OFF"),
        ("GOTO/0,0,0\nFROM/1,0,0", (2, 1), "where the path starts"),
        ("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,12\nGOTO/0,10,0", (3, 1), "within 0.01 mm"),
        ("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10.5,0", (3, 1), "within 0.01 mm"),
        ("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nFINI", (2, 1), "GOTO of the arc's end"),
        ("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nCIRCLE/0,0,0,0,0,1,10", (2, 1), "GOTO of the arc's end"),
        ("CIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0", (2, 1), "starts at the point before it"),
        ("CIRCLE/0,0,0,0,0,0,10", (1, 14), "a direction has the length 1"),
        ("CIRCLE/0,0,0,0,0,1,0", (1, 20), "larger than 0"),
        ("CIRCLE/0,0,0,0,0,1,10,0.06,0.5,10", (1, 23), "Siemens NX"),
        ("CIRCLE/0,0,0,0,0,1", (1, 1), "starts at the point before it"),
        ("CIRCLE/0,0,0,0,0", (1, 17), "CIRCLE/xc,yc,zc,i,j,k,r"),
        ("MOVARC/0,0,0,0,0,1,10", (1, 22), "ANGLE,a"),
        ("GOTO/10,0,0\nMOVARC/0,0,0,0,0,-1,10,ANGLE,90\nGOTO/0,10,0", (3, 1), "270.000 deg"),
        ("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0,-10,0,0", (3, 13), "second point on the arc"),
        ("GOTO/0,0,0\nGOHOME\nGOTO/1,0,0", (3, 1), "GOHOME (line 2)"),
        ("FINI\n  GOTO/0,0,0", (2, 3), "FINI (line 1)"),
        ("MSYS/0,0,0,1,0,0,0,1,0\nMSYS/0,0,9,1,0,0,0,1,0", (2, 1), "one frame"),
        ("TRACUT/M1", (1, 1), "have the CAM system"),
        ("COPY/1,TRANSL,1,0,0,3", (1, 1), "have the CAM system"),
        ("ROTABL/ATANGL,90", (1, 1), "rotary axes"),
        ("CUTCOM/LEFT,1", (1, 1), "cutter compensation"),
        ("CYCLE/DRILL,10,MMPM,100,5", (1, 1), "expand cycles"),
        ("GODLTA/0,0,5", (1, 1), "absolute"),
        ("GOTO/10,0,0\nINDIRV/0,1,0\nGOTO/0,0,0", (2, 1), "TLON,GOFWD"),
        ("GOTO/10,0,0\nTLON,GOFWD/(CIRCLE/0,0,0,10),ON,(LINE/0,0,0,0,10,0)", (2, 1), "INDIRV"),
        (
            "GOTO/10,0,0\nINDIRV/1,0,0\nTLON,GOFWD/(CIRCLE/0,0,0,10),ON,(LINE/0,0,0,0,10,0)",
            (2, 1),
            "along the circle",
        ),
        (
            "GOTO/10,0,0\nINDIRV/0,1,0\nTLON,GOFWD/(CIRCLE/0,0,0,10),ON,(LINE/0,0,0,0,11,0)",
            (3, 1),
            "within 0.01 mm",
        ),
        (
            "GOTO/10,0,0\nINDIRV/0,1,0\nTLON,GOFWD/(CYLNDR/0,0,0,0,1,0,10),ON,(LINE/0,0,0,0,10,0)",
            (3, 1),
            "as points",
        ),
        ("GOTO/10,0,0\nINDIRV/0,1,0\nTLON,GOFWD/(CIRCLE/ a,0,0,10),ON,(LINE/0,0,0,0,11,0)", (3, 21), "\"a\""),
        ("GOLFT/L1", (1, 1), "part geometry"),
        ("P1 = POINT/1,2,3", (1, 1), "part programs"),
        ("GOTTO/1,2,3", (1, 1), "did you mean GOTO"),
        ("äöü\nGOTO/0,0,0", (1, 1), "unknown word"),
        ("ABC/1", (1, 1), "a word of APT"),
        ("DELAY/5,REV", (1, 9), "in seconds"),
        ("DELAY/-1", (1, 7), "0 to 3600 s"),
        ("$$ ö\nGOTO/0,0,ö", (2, 10), "\"ö\""),
    ] {
        common::refused_at(read(text), text, place, part);
    }
}

#[test]
fn oddities_are_remarked_once_and_counted() {
    for (text, expected) in [
        ("UNITS/MM\nFEDRAT/60\nGOTO/0,0,0\nGOTO/1,0,0", vec![]),
        ("FEDRAT/60\nGOTO/0,0,0\nGOTO/1,0,0", vec![("unit-assumed", 2)]),
        ("UNITS/MM\nGOTO/0,0,0\nGOTO/1,0,0\nGOTO/2,0,0", vec![("feed-missing", 3)]),
        ("UNITS/MM\nFEDRAT/6,IPM\nGOTO/0,0,0\nGOTO/1,0,0", vec![("feed-unit", 2)]),
        ("UNITS/MM\nFEDRAT/6\nGOTO/0,0,0\nGOTO/1,0,0,0,0,1.002", vec![("axis-length", 4)]),
        ("UNITS/MM\nFEDRAT/6\nGOTO/0,0,0\nGOTO/1,0,0,0,0,1.0005", vec![]),
        ("UNITS/MM\nFEDRAT/6\nGOTO/0,0,0\nGOTO/1,0,0,1,0,0\nGOTO/2,0,0", vec![("axis-kept", 5)]),
        ("UNITS/MM\nFEDRAT/6\nGOTO/0,0,0\nGOTO/1,0,0\nGOHOME", vec![("home", 5)]),
        ("UNITS/MM\nLOADTL/1\nFEDRAT/6\nGOTO/0,0,0\nGOTO/1,0,0\nLOADTL/2", vec![("tool-change", 6)]),
        (
            "UNITS/MM\nFEDRAT/6\nSPINDL/9\nGOTO/0,0,0\nSPINDL/OFF\nRAPID\nGOTO/1,0,0\nGOTO/2,0,0",
            vec![("spindle-stopped", 8)],
        ),
        (
            "UNITS/MM\nFEDRAT/6\nGOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/10,-0.001,0",
            vec![("circle-sense", 4), ("nearly-full-circle", 5)],
        ),
        ("UNITS/MM\nINSERT/M08\nFEDRAT/6\nGOTO/0,0,0\nGOTO/1,0,0", vec![("controller-text", 2)]),
        (
            "UNITS/MM\nFEDRAT/6\nGOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0\nGOTO/-10,0,0",
            vec![("circle-sense", 4), ("chord", 6)],
        ),
    ] {
        let program = read(text).unwrap();
        let remarks: Vec<_> = program.remarks.iter().map(|remark| (remark.code, remark.line)).collect();
        assert_eq!(remarks, expected, "{text:?}");
    }
    let program = read("GOTO/0,0,0\nGOTO/1,0,0\nGOTO/2,0,0\nGOTO/3,0,0").unwrap();
    assert!(program.remarks[0].message.contains("2 more"), "{}", program.remarks[0].message);
}

#[test]
fn harmless_words_are_listed_as_written() {
    let text = "PARTNO POCKET $ 12 $$ A\nMACHIN / MILL,1\nUNITS/MM\nMULTAX/ON\nCUTTER / 10.0, $\n 2.5\nLOADTL/3,LENGTH,120\nCOOLNT/FLOOD\n\
                PPRINT FINISH\nCUTCOM/OFF\nCYCLE/OFF\nINTOL/0.01\nTOOL PATH/P1,TOOL,D10\nSTOP\nOPSTOP\nGOTO/0,0,0\nGOTO/1,0,0\nEND\nFINI\n";
    let program = read(text).unwrap();
    let words: Vec<_> = program.ignored.iter().map(|ignored| (ignored.line, ignored.word.as_str())).collect();
    let expected = [
        (1, "PARTNO POCKET $ 12 $$ A"),
        (2, "MACHIN/MILL,1"),
        (5, "CUTTER/10.0, 2.5"),
        (7, "LOADTL/3,LENGTH,120"),
        (8, "COOLNT/FLOOD"),
        (9, "PPRINT FINISH"),
        (10, "CUTCOM/OFF"),
        (11, "CYCLE/OFF"),
        (12, "INTOL/0.01"),
        (13, "TOOL PATH/P1,TOOL,D10"),
        (14, "STOP"),
        (15, "OPSTOP"),
        (18, "END"),
    ];
    assert_eq!(words, expected);
    assert_eq!((program.unit, program.lines), ("mm", 19));
    assert_eq!(program.tools, [Tool { diameter: 10e-3, line: 5 }]);
    assert_eq!(program.moves[0].line, 17);
}

#[test]
fn waits_stand_between_moves() {
    let program = read("GOTO/0,0,0\nDELAY/1.5\nGOTO/1,0,0\nDWELL/2\nDELAY/DWELL,3").unwrap();
    let waits: Vec<_> = program.dwells.iter().map(|dwell| (dwell.after, dwell.time, dwell.line)).collect();
    assert_eq!(waits, [(0, 1.5, 2), (1, 2.0, 4), (1, 3.0, 5)]);
}

/// A random valid program.
fn random_program(random: &mut fastrand::Rng, unit: &str, scale: f64) -> String {
    use std::fmt::Write;
    let mut text = format!("UNITS/{unit}\nMULTAX/ON\nGOTO/0,0,0\n");
    let mut at = [0.0; 3];
    for _ in 0..40 {
        match random.u32(0..5) {
            0 => text.push_str("RAPID\n"),
            1 => writeln!(text, "FEDRAT/{}", (1.0 + random.f64() * 500.0) / scale).unwrap(),
            2 => {
                let r = 1.0 + random.f64() * 50.0;
                let angle = random.f64() * 6.0 + 0.1;
                let center = [at[0] - r, at[1], at[2]];
                let rise = random.f64() - 0.5;
                at = [center[0] + r * math::cos(angle), center[1] + r * math::sin(angle), at[2] + rise];
                let [x, y, z] = center.map(|value| value / scale);
                writeln!(text, "CIRCLE/{x},{y},{z},0,0,1,{}", r / scale).unwrap();
                let [x, y, z] = at.map(|value| value / scale);
                writeln!(text, "GOTO/{x},{y},{z},0,0,1").unwrap();
            }
            _ => {
                at = at.map(|value| value + random.f64() * 20.0 - 10.0);
                let [x, y, z] = at.map(|value| value / scale);
                let (i, j) = (random.f64() - 0.5, random.f64() - 0.5);
                let length = (i * i + j * j + 1.0_f64).sqrt();
                writeln!(text, "GOTO/{x},{y},{z},{},{},{}", i / length, j / length, 1.0 / length).unwrap();
            }
        }
    }
    text + "GOTO/0,0,0,0,0,1\nFINI\n"
}

#[test]
fn inches_and_millimetres_are_the_same_path() {
    for seed in 0..200 {
        let mut random = fastrand::Rng::with_seed(seed);
        let mm = read(&random_program(&mut random.clone(), "MM", 1.0)).unwrap();
        let inch = read(&random_program(&mut random, "INCHES", 25.4)).unwrap();
        assert_sound(&mm, "random");
        assert_eq!(mm.moves.len(), inch.moves.len());
        for (a, b) in mm.moves.iter().zip(&inch.moves) {
            let end = |m: &armill::path::program::Move| m.segment.point(m.segment.length());
            assert!((end(a) - end(b)).norm() < 1e-12, "seed {seed}: {a:?} {b:?}");
            assert!((a.segment.length() - b.segment.length()).abs() < 1e-9, "seed {seed}");
        }
    }
}

#[test]
fn no_text_makes_the_reader_panic() {
    let mut random = fastrand::Rng::with_seed(7);
    let words = [
        "GOTO/",
        "FROM/",
        "RAPID",
        "CIRCLE/",
        "MOVARC/",
        "ANGLE,",
        "FEDRAT/",
        "MMPM",
        "IPR",
        "SPINDL/",
        "CLW",
        "UNITS/",
        "MM",
        "INCHES",
        "MULTAX",
        "/",
        ",",
        "$",
        "$$",
        "\n",
        "\n",
        "\n",
        "1",
        "0",
        "-10.5",
        "1e308",
        "1e-308",
        ".",
        "0,0,1",
        "10,0,0",
        "10,0,0,",
        "TLAXIS/",
        "DELAY/",
        "FINI",
        "PARTNO",
        "ö",
        "=",
        "LOADTL/1",
        " ",
        "\t",
        "OFF",
        "GOHOME",
        "TOOL PATH/",
        "INDIRV/0,-1,0\n",
        "TLON,GOFWD/(CIRCLE/0,0,0,10),ON,(LINE/0,0,0,0,10,0)\n",
        "CIRCLE/0,0,0,0,0,1\n",
        "CIRCLE/0,0,0,0,0,1,10,0.06,0.5,10,0\n",
        "CYCLE/DEEP,DEPTH,10,STEP,3,CLEAR,2\n",
        "CYCLE/OFF\n",
        "GOHOME/",
        "INDIRP/0,20,0\n",
        "TLON\nGOFWD/(CIRCLE/0,0,0,10),ON,(LINE/0,0,0,0,10,0)\n",
        "$$-> CSYS/",
        "MSYS/0,0,0,1,0,0,0,1,0\n",
        "G1 X0",
    ];
    let mut read_well = 0;
    for round in 0..20_000 {
        let text = if round % 2 == 0 {
            let bytes: Vec<u8> = (0..random.usize(0..200)).map(|_| random.u8(..)).collect();
            String::from_utf8_lossy(&bytes).into_owned()
        } else {
            let start = if round % 4 == 1 { "GOTO/10,0,0\nGOTO/0,0,0\n" } else { "" };
            (0..random.usize(0..40)).fold(start.to_string(), |text, _| text + random.choice(words).unwrap())
        };
        if let Ok(program) = read(&text) {
            assert_sound(&program, &text);
            read_well += 1;
        }
    }
    assert!(read_well > 100, "{read_well} random texts were programs");
}

#[test]
fn half_a_million_lines_are_read_in_seconds() {
    use std::fmt::Write;
    let mut text = String::from("UNITS/MM\nMULTAX/ON\nFEDRAT/1000,MMPM\n");
    for row in 0..500_000 {
        writeln!(text, "GOTO/{:.4},-0.5000,12.2500,0.000000,0.600000,0.800000", f64::from(row) * 1e-3)
            .unwrap();
    }
    let start = std::time::Instant::now();
    let program = read(&text).unwrap();
    let time = start.elapsed().as_secs_f64();
    assert_eq!(program.moves.len(), 499_999);
    // Well above the usual time (about 0.3 s), so that a busy machine does not fail it.
    assert!(time < 5.0, "{time} s");
}
