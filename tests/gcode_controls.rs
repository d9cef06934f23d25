//! What one control has and another has not: macros, bits, polar words, offsets. Values are worked by hand
//! from the controls' manuals.

use armill::path::gcode::{GcodeDialect, Options, program};
use armill::path::program::Program;

use GcodeDialect::{Fanuc, Grbl, LinuxCnc, Mach, Siemens, Unknown};

const HEAD: &str = "G21 G90 G17\nG0 X0 Y0 Z10\nG1 F600\n";

fn read(text: &str, dialect: GcodeDialect) -> Result<Program, armill::Error> {
    let options = Options { dialect: (dialect != Unknown).then_some(dialect), ..Options::default() };
    program(text, &options, |_| {})
}

/// Where each move ends [mm], rounded to a nanometre.
fn ends(program: &Program) -> Vec<[f64; 3]> {
    let end = |step: &armill::path::program::Move| step.segment.point(step.segment.length()) * 1e3;
    program.moves.iter().map(|step| end(step).map(|x| (x * 1e6).round() / 1e6 + 0.0).into()).collect()
}

/// Reads texts after the head; each leads to these points.
fn lead(rows: &[(GcodeDialect, &str, &[[f64; 3]])]) {
    for (dialect, text, points) in rows {
        let program =
            read(&format!("{HEAD}{text}"), *dialect).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(ends(&program), *points, "{text}");
    }
}

/// Reads texts after the head; each is refused in this line of the text after it, and with these words.
fn refuse(rows: &[(GcodeDialect, &str, usize, &str)]) {
    for (dialect, text, line, part) in rows {
        let error = match read(&format!("{HEAD}{text}"), *dialect) {
            Ok(program) => panic!("{text}: {:?}", ends(&program)),
            Err(error) => error,
        };
        assert_eq!(error.place().unwrap().0, line + 3, "{text}: {error}");
        assert!(error.to_string().contains(part), "{text}: {error}");
    }
}

fn has_remark(program: &Program, code: &str) -> Option<usize> {
    program.remarks.iter().find(|remark| remark.code == code).map(|remark| remark.line)
}

#[test]
fn logic_is_that_of_the_control() {
    lead(&[
        // 6 is 110, 3 is 011.
        (Fanuc, "#1=6 AND 3\nX#1", &[[2.0, 0.0, 10.0]]),
        (Fanuc, "#1=[6 OR 3]\n#2=6 XOR 3\nX#1 Y#2", &[[7.0, 5.0, 10.0]]),
        (LinuxCnc, "#1=[6 AND 3]\nX#1", &[[1.0, 0.0, 10.0]]),
        (Fanuc, "#1=2\nIF [[#1 GT 1] AND [#1 LT 3]] GOTO 5\nX1\nN5 X9", &[[9.0, 0.0, 10.0]]),
        (Fanuc, "#1=6\nIF [[#1 AND 4] EQ 4] THEN #2=8\nX#2", &[[8.0, 0.0, 10.0]]),
    ]);
    refuse(&[
        (Fanuc, "#1=1.5 OR 2", 1, "whole numbers"),
        (Unknown, "#1=6 AND 3", 1, "path.dialect"),
        (Fanuc, "IF [1 GT 2 AND 3 LE 7] GOTO 5\nN5 X1", 1, "brackets"),
        (Fanuc, "GOTO 1.5", 1, "whole"),
        (LinuxCnc, "o1 if [1] X5\no1 endif", 1, "comment"),
    ]);
}

#[test]
fn vacant_words_are_left_out() {
    lead(&[
        (Fanuc, "#1=#0\nX5 Y#1", &[[5.0, 0.0, 10.0]]),
        (Fanuc, "#1=5\nX#1\n#1=#0\nX#1 Y3", &[[5.0, 0.0, 10.0], [5.0, 3.0, 10.0]]),
        (Fanuc, "IF [#4 EQ #0] THEN #4=7\nX#4", &[[7.0, 0.0, 10.0]]),
        (Fanuc, "#4=0\nIF [#4 EQ #0] THEN #4=7\nY2 X#4", &[[0.0, 2.0, 10.0]]),
        (Fanuc, "X[#0+4]", &[[4.0, 0.0, 10.0]]),
    ]);
    let program = read(&format!("{HEAD}X5 Y#1"), Fanuc).unwrap();
    assert_eq!(has_remark(&program, "vacant-variable"), Some(4));
    let compared = read(&format!("{HEAD}IF [#1 EQ #0] GOTO 5\nN5 X5"), Fanuc).unwrap();
    assert_eq!(has_remark(&compared, "vacant-variable"), None);
    refuse(&[
        (Fanuc, "#0=5", 1, "#0"),
        (LinuxCnc, "X#0", 1, "no value"),
        (Fanuc, "X#100", 1, "no value"),
        (Fanuc, "#3000=1 (NO TOOL)", 1, "alarm"),
    ]);
}

#[test]
fn macros_take_their_words_as_variables() {
    let grid = "G65 P9100 A10 B20. X5 I3\nX0 Y0\nM30\nO9100\nX#1 Y#2\nX#24 Y#4 Z#26\nM99";
    let points: &[[f64; 3]] = &[[10.0, 20.0, 10.0], [5.0, 3.0, 10.0], [0.0, 0.0, 10.0]];
    lead(&[
        (Fanuc, grid, points),
        (Unknown, grid, points),
        // Its variables are its own, and the caller's come back.
        (Fanuc, "#1=4\nG65 P1 A7\nX#1\nM30\nO1\nY#1\n#1=9\nM99", &[[0.0, 7.0, 10.0], [4.0, 7.0, 10.0]]),
        // What stands before it in the line comes first; values may be computed.
        (Fanuc, "#5=2\nG91 G65 P1 A[#5*3] L2\nM30\nO1\nX#1\nM99", &[[6.0, 0.0, 10.0], [12.0, 0.0, 10.0]]),
        // Not given: its word is left out.
        (Fanuc, "G65 P1 A7\nM30\nO1\nIF [#2 EQ #0] GOTO 8\nX1\nN8 X#1 Y#2\nM99", &[[7.0, 0.0, 10.0]]),
        (
            Fanuc,
            "G65 P1 K1 D2 M3 Z4\nM30\nO1\nX#6 Y#7\nX#13 Y#26\nM99",
            &[[1.0, 2.0, 10.0], [3.0, 4.0, 10.0]],
        ),
    ]);
    refuse(&[
        (Fanuc, "G65 P77 A1\nM30", 1, "a sub-program or macro in this text"),
        (Fanuc, "G65 A1\nM30", 1, "names its macro"),
        (Fanuc, "G65 P1 I1 J2 I3\nM30\nO1\nM99", 1, "specification II"),
        (Fanuc, "G65 P1\nM30\nO1\nG65 P1\nM99", 4, "hundred"),
        (Fanuc, "G65 P1 A1 L2\nM30\nO1\n#1=#1+1\nM99", 5, "L"),
        (LinuxCnc, "G65 P1 A1\nM2\nO1\nM99", 1, "macros"),
        (Fanuc, "G66 P1 A1\nM30\nO1\nM99", 1, "macro"),
    ]);
}

#[test]
fn returns_may_name_a_line() {
    lead(&[
        (Fanuc, "M98 P1\nX1\nN20 X2\nM30\nO1\nY5\nM99 P20", &[[0.0, 5.0, 10.0], [2.0, 5.0, 10.0]]),
        // In the main program it is a jump.
        (Fanuc, "M99 P20\nX1\nN20 X2\nM30", &[[2.0, 0.0, 10.0]]),
        // The rest of its line comes first.
        (Haas, "Y3 M99 P20\nX1\nN20 X2\nM30", &[[0.0, 3.0, 10.0], [2.0, 3.0, 10.0]]),
    ]);
    refuse(&[
        (Fanuc, "M99 P20\nM30", 1, "N20"),
        (Fanuc, "M98 P1 L3\nN20 X2\nM30\nO1\nM99 P20", 5, "once"),
        (LinuxCnc, "M99 P20\nN20 X2", 1, "LinuxCNC"),
    ]);
    // A loop in which nothing changes ends with an error in it.
    let endless = read(&format!("{HEAD}N10 X1\nM99 P10"), Fanuc).unwrap_err();
    assert!(endless.to_string().contains("loop that ends"), "{endless}");
}

/// Haas follows Fanuc.
use GcodeDialect::Fanuc as Haas;

#[test]
fn loops_without_a_condition_need_a_way_out() {
    lead(&[
        (
            Fanuc,
            "#1=0\nDO 1\n#1=#1+1\nX#1\nIF [#1 GE 2] GOTO 9\nEND 1\nN9 Y5",
            &[[1.0, 0.0, 10.0], [2.0, 0.0, 10.0], [2.0, 5.0, 10.0]],
        ),
        (Fanuc, "#1=0\nWHILE [#1 LT 2] DO2\nX[#1+1]\n#1=#1+1\nEND2", &[[1.0, 0.0, 10.0], [2.0, 0.0, 10.0]]),
    ]);
    // The way out is never taken: bounded, and the fault is in the loop.
    let endless = "#1=0\nDO 1\nX#1\nIF [[#1 AND 6] EQ 6] GOTO 9\nEND 1\nN9 Y1";
    let error = read(&format!("{HEAD}{endless}"), Fanuc).unwrap_err();
    assert!(
        (5..=8).contains(&error.place().unwrap().0) && error.to_string().contains("loop that ends"),
        "{error}"
    );
    refuse(&[
        (Fanuc, "X1\nDO 1\nX2\nX1\nEND 1\nM30", 2, "endless"),
        (Fanuc, "DO 1\nX2\nIF [#0 EQ #0] GOTO 5\nM30\nN5 X1", 1, "END"),
        (Fanuc, "X1\nEND 1", 2, "DO"),
    ]);
}

#[test]
fn calls_of_linuxcnc_may_leave_values_out() {
    let sub = "o<a> sub\nX#1 Y#2\no<a> endsub\n";
    lead(&[
        (LinuxCnc, &format!("{sub}o<a> call [5]\nM2"), &[[5.0, 0.0, 10.0]]),
        (LinuxCnc, &format!("{sub}o<a> call [5] [2+1] (both)\nM2"), &[[5.0, 3.0, 10.0]]),
        (LinuxCnc, &format!("{sub}X1\no<a> call\nM2"), &[[1.0, 0.0, 10.0], [0.0, 0.0, 10.0]]),
    ]);
    refuse(&[
        (LinuxCnc, &format!("{sub}o<a> call [] [3]\nM2"), 4, "]"),
        (LinuxCnc, &format!("{sub}o<a> call [1] 3\nM2"), 4, "comment"),
        (LinuxCnc, &format!("{sub}o<a> call{}\nM2", " [1]".repeat(31)), 4, "comment"),
    ]);
}

#[test]
fn polar_words_count_from_the_zero_of_the_program() {
    let half = 3.0_f64.sqrt() * 5.0;
    let near = |x: f64| (x * 1e6).round() / 1e6;
    lead(&[
        (LinuxCnc, "@10 ^90", &[[0.0, 10.0, 10.0]]),
        // What is not given stays.
        (
            LinuxCnc,
            "@10 ^60\n^-60\n@20",
            &[[5.0, near(half), 10.0], [5.0, near(-half), 10.0], [10.0, near(-2.0 * half), 10.0]],
        ),
        // Under G91 both are added.
        (LinuxCnc, "X10\nG91 ^90\n@5 Z-1", &[[10.0, 0.0, 10.0], [0.0, 10.0, 10.0], [0.0, 15.0, 9.0]]),
        (LinuxCnc, "G20\n@[1] ^0", &[[25.4, 0.0, 10.0]]),
        (LinuxCnc, "G92 X-10\n@10 ^0", &[[20.0, 0.0, 10.0]]),
        // A quarter about X0 Y0.
        (Unknown, "X10\nG3 @10 ^90 I-10", &[[10.0, 0.0, 10.0], [0.0, 10.0, 10.0]]),
    ]);
    refuse(&[
        (LinuxCnc, "@10", 1, "angle"),
        (LinuxCnc, "G91 ^10", 1, "angle"),
        (LinuxCnc, "@10 ^0 X5", 1, "both"),
        (LinuxCnc, "G18 @10 ^0", 1, "G17"),
        (LinuxCnc, "G53 G0 @10 ^0", 1, "G0"),
        (LinuxCnc, "G81 @10 ^0 Z-1 R2", 1, "X and Y"),
        (Fanuc, "@10 ^0", 1, "linuxcnc"),
        (Grbl, "@10 ^0", 1, "linuxcnc"),
    ]);
}

#[test]
fn translations_keep_their_length_when_the_unit_changes() {
    lead(&[
        // 10 mm and one inch.
        (Siemens, "TRANS X10\nG70\nATRANS X1\nX0", &[[35.4, 0.0, 10.0]]),
        (Siemens, "G700\nTRANS X1 Y1\nG710\nATRANS X1\nX0 Y0", &[[26.4, 25.4, 10.0]]),
        (Siemens, "TRANS X10 Y5\nTRANS X1\nX0 Y0", &[[1.0, 0.0, 10.0]]),
        (Siemens, "TRANS X10\nTRANS\nX1", &[[1.0, 0.0, 10.0]]),
    ]);
    // The last was found by the fuzz target: a variable of the control.
    refuse(&[(Siemens, "TRANS A10", 1, "TRANS"), (Siemens, "$1", 1, "variable of the control")]);
}

#[test]
fn offsets_of_a_haas_are_at_zero() {
    for code in ["G110", "G129", "G154 P1", "G154 P99", "G54.1 P300"] {
        let program = read(&format!("{HEAD}{code}\nX5"), Fanuc).unwrap();
        assert_eq!(ends(&program), [[5.0, 0.0, 10.0]], "{code}");
        assert_eq!(has_remark(&program, "work-offset-missing"), Some(4), "{code}");
    }
    refuse(&[
        (Fanuc, "G154 P0", 1, "1 to 99"),
        (Fanuc, "G154 P100", 1, "1 to 99"),
        (Fanuc, "G154", 1, "number P"),
        (Fanuc, "G130", 1, "not known"),
        (Mach, "G110", 1, "Haas"),
        (Unknown, "G110", 1, "not known"),
    ]);
    // Out of an offset of the job, G113 would mean one thing on a Haas and another on a Fanuc.
    let mut options = Options { dialect: Some(Fanuc), ..Options::default() };
    options.work_offsets[1] = Some(nalgebra::Vector3::new(0.1, 0.0, 0.0));
    let error = program(&format!("{HEAD}G55\nG113\nX1"), &options, |_| {}).unwrap_err();
    assert!(error.to_string().contains("polar"), "{error}");
    let moved = program(&format!("{HEAD}G55\nG110\nX1"), &options, |_| {}).unwrap();
    assert_eq!(ends(&moved), [[1.0, 0.0, 10.0]]);
}

#[test]
fn positions_of_the_machine_are_no_points_of_the_workpiece() {
    let body = "G1 Z-1\nX50\nG0 Z10\n";
    let cut: &[[f64; 3]] = &[[0.0, 0.0, -1.0], [50.0, 0.0, -1.0], [50.0, 0.0, 10.0]];
    let row = |text: &'static str, more: &[[f64; 3]]| (format!("{body}{text}"), [cut, more].concat());
    for (text, points) in [
        // Down beside the workpiece: over X20 Y30 first, then down.
        row("G53 G0 X0 Y0\nZ5\nX20 Y30", &[[20.0, 30.0, 10.0], [20.0, 30.0, 5.0]]),
        // The height that was stated last holds, not each one.
        row("G53 G0 X0 Y0\nZ2\nZ5\nX20\nY30", &[[20.0, 30.0, 10.0], [20.0, 30.0, 5.0]]),
        row("G53 G0 Y0\nX20\nY30 Z5", &[[20.0, 30.0, 5.0]]),
        // At the end of the program it leads nowhere.
        row("G53 G0 X0 Y0\nZ5\nM30", &[]),
        row("G53 G0 Z0\nG53 X0 Y0\nG0 X20 Y30\nG1 Z-1", &[[20.0, 30.0, 10.0], [20.0, 30.0, -1.0]]),
        row(
            "G53 G0 X0 Y0\nZ5\nG81 X20 Y30 Z-1 R2\nG80",
            &[
                [20.0, 30.0, 10.0],
                [20.0, 30.0, 5.0],
                [20.0, 30.0, 2.0],
                [20.0, 30.0, -1.0],
                [20.0, 30.0, 5.0],
            ],
        ),
    ] {
        let program = read(&format!("{HEAD}{text}"), Fanuc).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(ends(&program), points, "{text}");
    }
    refuse(&[
        (Fanuc, "G53 G0 X0 Y0\nG1 Z-1", 2, "machine position"),
        (Fanuc, "G53 G0 X0 Y0\nG2 X5 Y5 I5", 2, "machine position"),
        (Fanuc, "G53 G0 X0 Y0\nG81 Z-1 R2", 2, "machine position"),
        (Fanuc, "G53 G0 Z0\nG91 Z-5", 2, "G91"),
        (Fanuc, "G53 G0 Z0\nX1 Y1\nG18 G2 X5 Z5 I5", 3, "in Z"),
        (Fanuc, "G91 G28 X0 Y0\nX5", 2, "G91"),
        (Fanuc, "G53 G0 X0\nG92 X0", 2, "position of the machine"),
    ]);
}

#[test]
fn lengths_without_a_point_are_remarked_once() {
    let remark = |text: &str, dialect| {
        has_remark(&read(&format!("{HEAD}{text}"), dialect).unwrap(), "decimal-point-missing")
    };
    assert_eq!(remark("X10.\nX20\nX30", Fanuc), Some(5 - 3));
    let text = "G21 G90 G17\nG0 X0 Y0 Z0\nG1 X1. F600\nX20 Y0\nX3.\nY7";
    let program = read(text, Fanuc).unwrap();
    assert_eq!(has_remark(&program, "decimal-point-missing"), Some(4));
    let messages =
        program.remarks.iter().filter(|remark| remark.message.contains("X20 has no decimal point"));
    assert_eq!(messages.count(), 1);
    assert_eq!(ends(&program)[1], [20.0, 0.0, 0.0]);
    assert_eq!(has_remark(&read(text, LinuxCnc).unwrap(), "decimal-point-missing"), None);
    for plain in ["X10\nX20", "#1=5\nX1.\nX#1"] {
        let text = format!("G21 G90 G17\nG0 X0 Y0 Z0\nG1 F600\n{plain}");
        assert_eq!(has_remark(&read(&text, Fanuc).unwrap(), "decimal-point-missing"), None, "{plain}");
    }
}
