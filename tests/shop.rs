//! Programs as shops' posts and hands write them, one for each kind of fault that once kept them from
//! being read or had them misread, with the values worked by hand.

use armill::path::Program;
use armill::path::gcode::{Options, program};

/// What a program gives: its length [mm] with lowest, highest and last point, where they are stated;
/// or the line and a part of the message that refuses it.
enum Gives {
    Moves { length: f64, extents: Option<[[f64; 3]; 2]>, end: [f64; 3] },
    Refused(usize, &'static str),
}

/// `G0 X0 Y0 Z10`, `G1 Z-1`, `X50`, `G0 Z10`: 11 down, 50 along, 11 up.
fn standard() -> Gives {
    let extents = Some([[0.0, 0.0, -1.0], [50.0, 0.0, 10.0]]);
    Gives::Moves { length: 72.0, extents, end: [50.0, 0.0, 10.0] }
}

fn at(length: f64, end: [f64; 3]) -> Gives {
    Gives::Moves { length, extents: None, end }
}

fn refused(line: usize, part: &'static str) -> Gives {
    Gives::Refused(line, part)
}

/// Name of the kind, text, and what it gives.
fn programs() -> Vec<(&'static str, &'static str, Gives)> {
    vec![
        (
            "G53 is left out, the park move runs at the height held",
            r#"G90 G94 G17
G21
G54
G53 G0 Z-10
S10000 M3
G4 P1.8
G0 X60 Y0
Z15
Z5
G1 Z-1 F300
G0 Z15
G53 G0 Z-10
M5
G0 X-10 Y-10
M30"#,
            at(102.711, [-10.0, -10.0, 15.0]),
        ),
        (
            "G53 Z0 never is the part's top",
            r#"%
O0101 (PLATE)
G21 G17 G40 G80 G90
G53 G0 Z0.
T1 M6
G54
G0 X0. Y0. S3000 M3
G43 Z10. H1
G1 Z-1. F600.
X50.
G0 Z10.
G53 G0 Z0.
M30
%"#,
            standard(),
        ),
        (
            "G28",
            r#"%
O1001 (plate)
N10 G90 G94 G17
N15 G21
N20 G28 G91 Z0.
N25 G90
N30 T1 M6
N35 S5000 M3
N40 G54
N45 G0 X0. Y0.
N50 G43 Z10. H1
N55 G1 Z-1. F600.
N60 X50.
N65 G0 Z10.
N70 M9
N75 G28 G91 Z0.
N80 G28 X0. Y0.
N85 M30
%"#,
            standard(),
        ),
        (
            "G28 in a line with G0",
            r#"G21
G0 G17 G40 G49 G80 G90
G0 G28 G91 Z0.
G0 G90 G54 X0. Y0. S3000 M3
G43 H1 Z10.
G1 Z-1. F600.
X50.
G0 Z10.
M5
G91 G28 Z0.
G28 X0. Y0.
M30"#,
            standard(),
        ),
        (
            "after G80 the G0 of before is in force",
            r#"G90 G21 G17 G94
G0 X10 Y0
Z15
G98 G81 X10 Y0 Z-5 R2 F300
X20
G80
Z15
M30"#,
            at(90.0, [20.0, 0.0, 15.0]),
        ),
        (
            "no motion word yet",
            r#"%
Z50.
G21 G90
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10
M30"#,
            standard(),
        ),
        (
            "a centre word of 0 across the plane",
            r#"G17 G90 G21
G0 X10.000 Y0.000 Z1.000
G1 Z-1.000 F600.000
G3 X0.000 Y10.000 I-10.000 J0.000 K0.000
G0 Z5.000"#,
            at(23.708, [0.0, 10.0, 5.0]),
        ),
        (
            "rotary axes at 0",
            r#"G21 G90 G17
G0 G54 A0. C0.
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10
M30"#,
            standard(),
        ),
        (
            "a rotary axis that turns",
            r#"G21 G90 G17
G0 X0 Y0 Z10 A0.
G1 Z-1 F600
X50
G0 Z10
A90.
X0"#,
            refused(6, "A90."),
        ),
        (
            "smoothing and machine functions",
            r#"G21 G90 G17
G187 P2 E0.025
G05.1 Q1
M50
M10
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10
M11
G05.1 Q0
M89
M30"#,
            standard(),
        ),
        (
            "look-ahead",
            r#"G21 G90 G17
G05 P10000
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10
G05 P0
M30"#,
            standard(),
        ),
        (
            "a mode that ends",
            r#"G21 G90 G17
G69.1
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10
M30"#,
            standard(),
        ),
        (
            "the same code twice",
            r#"N100G00G20G17G20G90G40G49G80
N110T1M06
N120G00X0.0Y0.0
N130Z0.4
N140G1Z-0.04F20
N150X2
N160G0Z0.4
N170M30"#,
            at(73.152, [50.8, 0.0, 10.16]),
        ),
        (
            "codes that contradict",
            r#"G21 G90 G91 G17
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10"#,
            refused(1, "G91"),
        ),
        (
            "a dwell by X",
            r#"G21 G90 G17
G4 X2.
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10"#,
            standard(),
        ),
        (
            "a dwell in milliseconds",
            r#"G21 G90 G17
M3 S10000
G4 P5000
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10"#,
            standard(),
        ),
        (
            "a cycle's dwell in milliseconds",
            r#"G21 G90 G17
G0 X0 Y0 Z10
G82 X0 Y0 Z-5 R2 P500 F300
X10
G80
M30"#,
            at(70.0, [10.0, 0.0, 10.0]),
        ),
        (
            "a dwell by U",
            r#"G21 G90 G17
G4 U1.5
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10"#,
            standard(),
        ),
        (
            "a number with a colon",
            r#"%
:1234
G21 G90 G17
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10
M30
%"#,
            standard(),
        ),
        (
            "a name after %",
            r#"%_N_PLATE_MPF
;$PATH=/_N_MPF_DIR
G21 G90 G17
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10
M30"#,
            standard(),
        ),
        (
            "a number after N",
            r#"%
N10 O4711
G21 G90 G17
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10
M30
%"#,
            standard(),
        ),
        (
            "a note after %",
            r#"%
(header)
% spindle on
G21 G90 G17
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10
%(end)"#,
            standard(),
        ),
        (
            "brackets in a comment",
            r#"G21 G90 G17
(2D Contour1 (2))
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10"#,
            standard(),
        ),
        (
            "a slash in a line",
            r#"G21 G90 G17
G0 X0 Y0
G43 H6 Z10. /M8
G1 Z-1 F600
X50
G0 Z10
M30"#,
            standard(),
        ),
        (
            "a note after a slash",
            r#"G21 G90 G17
G0 X0 Y0 Z10
M00 /turn the part over
G1 Z-1 F600
X50
G0 Z10"#,
            standard(),
        ),
        (
            "G43 without H",
            r#"G21 G90 G17
T1 M6
G0 X0 Y0
G43 H1 Z20
G1 Z10 F1000
G43 Z5
G1 Z-1 F600
X50
G0 Z10"#,
            at(82.0, [50.0, 0.0, 10.0]),
        ),
        (
            "a start that is not known",
            r#"G21 G90
G1 Z-9 F600
G0 X5 Y5
G1 X20
M2"#,
            at(15.0, [20.0, 5.0, -9.0]),
        ),
        (
            "Siemens words",
            r#"%_N_KONTUR_MPF
; Kontur
N10 G17 G90 G710 G94
N20 T="FRAESER_10" D1
N30 M6
N40 S3000 M3
N50 G0 X=10 Y=0 Z10
N60 G1 Z-1 F600
N70 G3 X0 Y10 CR=10
N80 G0 Z10
N90 M30"#,
            at(37.708, [0.0, 10.0, 10.0]),
        ),
        (
            "Siemens five axes",
            r#"N10 G17 G90 G710 G54
N20 TRAORI
N30 G0 X0 Y0 Z10 A3=0 B3=0 C3=1
N40 G1 X50 A3=0 B3=0.5 C3=0.866 F600
N50 TRAFOOF
N60 M30"#,
            refused(2, "TRAORI"),
        ),
        (
            "Heidenhain",
            r#"0 BEGIN PGM TEIL MM
1 TOOL CALL 1 Z S3000
2 L X+0 Y+0 Z+10 R0 FMAX
3 L Z-1 F600
4 L X+50
5 END PGM TEIL MM"#,
            refused(1, "Heidenhain"),
        ),
        (
            "KRL",
            r#"DEF TEIL()
PTP {A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0}
LIN {X 0,Y 0,Z 10,A 0,B 90,C 0}
LIN {X 50,Y 0,Z 10,A 0,B 90,C 0} C_DIS
END"#,
            refused(1, "KUKA KRL"),
        ),
        (
            "variables",
            r#"G21 G90
#1=10
#2=-1
G0 X0 Y0 Z#1
G1 Z#2 F600
X50
G0 Z#1"#,
            standard(),
        ),
        (
            "named variables",
            r#"G21 G90
#<safe>=10
#<cut>=[0-1]
G0 X0 Y0 Z#<safe>
G1 Z[#<cut>] F600
X[25*2]
G0 Z#<safe>"#,
            standard(),
        ),
        (
            "G10 of zeros",
            r#"G21 G90 G17
G10 L2 P1 X0 Y0 Z0
G54
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10"#,
            standard(),
        ),
        (
            "G10",
            r#"G21 G90 G17
G54
G10 L2 P1 X100 Y0 Z0
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10"#,
            refused(3, "G10"),
        ),
        (
            "exponents",
            r#"G21 G90 G17
G0 X0 Y0 Z10
G1 Z-1 F600
X50 Y-3.55e-15
G0 Z10"#,
            standard(),
        ),
        (
            "a feed of 0",
            r#"G21 G90 G17
G0 X0 Y0 Z10 F0
G1 Z-1 F600
X50
G0 Z10"#,
            standard(),
        ),
        (
            "checksums",
            r#"G21 G90 G17
N1 G0 X0 Y0 Z10*45
N2 G1 Z-1 F600*12
N3 X50*77
N4 G0 Z10*8"#,
            standard(),
        ),
        (
            "radius compensation",
            r#"G21 G90 G17
G41 D1
G0 X0 Y0 Z10
G1 Z-1 F600
X50
G0 Z10
G40"#,
            refused(2, "G41"),
        ),
    ]
}

fn read(text: &str) -> Result<Program, armill::Error> {
    program(text, &Options::default(), |_| {})
}

/// Length, lowest, highest and last point [mm].
fn figures(program: &Program) -> (f64, [[f64; 3]; 2], [f64; 3]) {
    let (mut length, mut extents) = (0.0, [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]]);
    for step in &program.moves {
        length += step.segment.length() * 1e3;
        for s in step.segment.extremes() {
            let point = step.segment.point(s) * 1e3;
            for axis in 0..3 {
                extents[0][axis] = extents[0][axis].min(point[axis]);
                extents[1][axis] = extents[1][axis].max(point[axis]);
            }
        }
    }
    let last = program.moves.last().unwrap().segment;
    (length, extents, (last.point(last.length()) * 1e3).into())
}

#[test]
fn shop_programs_are_read_right() {
    let near = |a: f64, b: f64| (a - b).abs() < 5e-4;
    let same = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).all(|(a, b)| near(*a, *b));
    let mut wrong = Vec::new();
    for (name, text, gives) in programs() {
        match (read(text), gives) {
            (Ok(program), Gives::Moves { length, extents, end }) => {
                let (found, box_found, last) = figures(&program);
                let boxed =
                    extents.is_none_or(|[low, high]| same(&low, &box_found[0]) && same(&high, &box_found[1]));
                if !(near(found, length) && same(&last, &end) && boxed) {
                    wrong.push(format!("{name}: {found} to {last:?}, {box_found:?}"));
                }
            }
            (Err(error), Gives::Refused(line, part)) => {
                let said = error.to_string();
                if !(said.contains(&format!("line {line},")) && said.contains(part)) {
                    wrong.push(format!("{name}: {said}"));
                }
            }
            (Ok(program), Gives::Refused(..)) => {
                wrong.push(format!("{name}: accepted, {:?}", figures(&program)))
            }
            (Err(error), Gives::Moves { .. }) => wrong.push(format!("{name}: {error}")),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn dwells_are_counted_as_the_control_counts_them() {
    let time = |text: &str| read(text).unwrap().dwells.iter().map(|dwell| dwell.time).sum::<f64>();
    let body = "G0 X0 Y0 Z10\nG1 Z-1 F600";
    for (text, seconds) in [
        ("G4 X2.", 2.0),
        ("G4 U1.5", 1.5),
        ("G4 P0.5", 0.5),
        ("G4 P2", 2.0),
        ("G4 P5000", 5.0),
        ("O1000\nG4 P500", 0.5),
        ("O1000\nG4 P0.5", 0.5),
        ("(grbl)\nG4 P500", 500.0),
        ("(grbl)\nG4 P20000.00000", 20.0),
    ] {
        assert!((time(&format!("{text}\n{body}")) - seconds).abs() < 1e-9, "{text}");
    }
    let holes = "G0 X0 Y0 Z10\nG82 X0 Y0 Z-5 R2 P500 F300\nX10\nG80\nM30";
    assert!((time(holes) - 1.0).abs() < 1e-9);
}

/// What machinists write, and where it leads [mm]: kinds that were misread while these were new.
#[test]
fn programs_of_hands_lead_where_the_control_goes() {
    let head = "G21 G90 G17\nG0 X0 Y0 Z0\nG1 F600\n";
    for (text, end) in [
        // A slash divides and a star multiplies, behind a variable.
        ("#2=10\n#10=#2/2\nX#10", [5.0, 0.0, 0.0]),
        ("#1 = 360 / 6\nX#1", [60.0, 0.0, 0.0]),
        ("#1=20\n#3=#1*2\nX#3", [40.0, 0.0, 0.0]),
        ("X[6/2]\nY[[2+4]/2]", [3.0, 3.0, 0.0]),
        ("#1=SIN[30]*10\nX#1", [5.0, 0.0, 0.0]),
        // What else stands in the line of a call comes before it.
        ("X10 M98 P100\nX20\nM30\nO100\nY5\nM99", [20.0, 5.0, 0.0]),
        ("X10 M98 P100 (B\u{fc}chse)\nX20\nM30\nO100\nY5\nM99", [20.0, 5.0, 0.0]),
        ("G91 M98 P1000 L3\nM30\nO1000\nX10\nM99", [30.0, 0.0, 0.0]),
        ("M98 P1000\nX20\nM30\nO1000\nG91 X10\nG90 M99", [20.0, 0.0, 0.0]),
        ("M98 P1000\nX40\nM30\nO1000\nX10\nG4 P500 M99", [40.0, 0.0, 0.0]),
        // Block delete holds for calls as well.
        ("/M98 P1000\nX20\nM98 P1000\nM30\nO1000\nY50\nM99", [20.0, 50.0, 0.0]),
        // A variable of LinuxCNC is a subprogram's own, and its value holds from the next line.
        ("o<a> sub\n#<x>=5\no<a> endsub\n#<x>=9\no<a> call\nX#<x>", [9.0, 0.0, 0.0]),
        ("o<a> sub\no<a> endsub\n#1=5\n#1=10 G1 X#1", [5.0, 0.0, 0.0]),
        ("#1=5\n#1=10 G1 X#1", [10.0, 0.0, 0.0]),
        ("X[FIX[-2.8]] Y[FUP[-2.1]]", [-2.0, -3.0, 0.0]),
        ("#1=0\nWHILE [#1 LT 3] DO1\n#1=[#1+1]\nG91 X10\nEND1\nG90", [30.0, 0.0, 0.0]),
        ("#1=0\nN10 #1=#1+1\nG91 X5\nIF [#1 LT 4] GOTO 10\nG90", [20.0, 0.0, 0.0]),
        ("G25 X-100 Y-100\nX3", [3.0, 0.0, 0.0]),
        ("MSG()\nR1=20/2\nX=R1/2 F600", [5.0, 0.0, 0.0]),
        ("MSG()\nTRANS X10\nX0\nROT\nX1", [1.0, 0.0, 0.0]),
    ] {
        let program = read(&format!("{head}{text}")).unwrap_or_else(|error| panic!("{text}: {error}"));
        let (_, _, found) = figures(&program);
        assert!(found.iter().zip(end).all(|(a, b)| (a - b).abs() < 1e-9), "{text}: {found:?}");
    }
    // Holes at the positions that G0 and G1 lead to.
    let called = "MSG()\nG0 X0 Y0 Z10 F100\nMCALL CYCLE81(10,0,2,-5)\nG0 X10 Y10\nG0 X20\nMCALL\nX30";
    let program = read(called).unwrap();
    let (_, [lowest, _], end) = figures(&program);
    assert!((lowest[2] + 5.0).abs() < 1e-9 && (end[0] - 30.0).abs() < 1e-9, "{lowest:?} {end:?}");
    for (text, line, part) in [
        ("G10 L20 P1 X0", 4, "G10"),
        ("G53 G0 Z0 A90", 4, "rotary"),
        ("Z5\nZ-1\nG91 G28 X0 Y0", 6, "lift the tool"),
        ("M198 P1000", 4, "sub-program"),
        ("M70", 4, "restoring"),
        ("X50 ,R5", 4, "chamfered"),
    ] {
        let error = read(&format!("{head}{text}")).unwrap_err().to_string();
        assert!(error.contains(&format!("line {line},")) && error.contains(part), "{text}: {error}");
    }
    assert!(read(&format!("MSG()\n{}", "TRANS ".repeat(100_000))).is_err());
}

/// CR alone ends a line, as old systems write it, and errors count such lines.
#[test]
fn bare_carriage_returns_end_lines() {
    let body = "G21 G90 G17\rG0 X0 Y0 Z10\rG1 Z-1 F600\rX50 (a note)\rG0 Z10\r";
    let program = read(body).unwrap();
    assert_eq!(program, read(&body.replace('\r', "\n")).unwrap());
    assert_eq!(program.lines, 5);
    assert!((figures(&program).0 - 72.0).abs() < 1e-9);
    let error = read("G21 G90\rG0 X0 Y0 Z10\r\nG1 Z-1 F600\r  G41 D1\rX50").unwrap_err();
    assert_eq!(error.place(), Some((4, 3)));
}
