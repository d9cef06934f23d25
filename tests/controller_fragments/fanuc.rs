//! FANUC.

use super::{at, near, package, refuses};
use crate::controllers::{Blend, ControllerProgram, Motion, fanuc};
use nalgebra::{Matrix3, Vector3};

/// A program of these lines, numbered and ended here, with these positions.
fn listing(name: &str, lines: &[&str], positions: &str) -> String {
    let mut text = format!(
        "/PROG  {name}\n/ATTR\nOWNER\t\t= MNEDITOR;\nCOMMENT\t\t= \"PART 12\";\nPROG_SIZE\t= 0;\n\
         CREATE\t\t= DATE 26-01-31  TIME 10:00:00;\nMODIFIED\t= DATE 26-01-31  TIME 10:00:00;\nFILE_NAME\t= ;\n\
         VERSION\t\t= 0;\nLINE_COUNT\t= {};\nMEMORY_SIZE\t= 0;\nPROTECT\t\t= READ_WRITE;\n\
         TCD:  STACK_SIZE\t= 0,\n      \
         TASK_PRIORITY\t= 50,\n      TIME_SLICE\t= 0,\n      BUSY_LAMP_OFF\t= 0,\n      ABORT_REQUEST\t= 0,\n      \
         PAUSE_REQUEST\t= 0;\nDEFAULT_GROUP\t= 1,*,*,*,*;\nCONTROL_CODE\t= 00000000 00000000;\n/MN\n",
        lines.len()
    );
    for (index, line) in lines.iter().enumerate() {
        text.push_str(&format!("{:4}:{line}\n", index + 1));
    }
    text + "/POS\n" + positions + "/END\n"
}

/// A Cartesian position as a controller lists it.
fn pose(number: u32, frames: &str, config: &str, xyz: [&str; 3], wpr: [&str; 3]) -> String {
    let ([x, y, z], [w, p, r]) = (xyz, wpr);
    format!(
        "P[{number}]{{\n   GP1:\n\t{frames},\t\tCONFIG : '{config}',\n\
         \tX = {x:>9}  mm,\tY = {y:>9}  mm,\tZ = {z:>9}  mm,\n\
         \tW = {w:>9} deg,\tP = {p:>9} deg,\tR = {r:>9} deg\n}};\n"
    )
}

const CUT: [&str; 6] = [
    "  UFRAME_NUM=1 ;",
    "  UTOOL_NUM=2 ;",
    "L P[1] 100mm/sec CNT50    ;",
    "L P[2] 75cm/min FINE    ;",
    "  WAIT    .50(sec) ;",
    "C P[3]    \n    :  P[1] 8.5mm/sec CNT10    ;",
];

fn files() -> Vec<(&'static str, String)> {
    let main = [
        "  !two parts ;",
        "  PR[100]=P[2]    ;",
        "  UFRAME[1]=PR[100] ;",
        "  PR[9,1]=0 ;",
        "  PR[9,2]=(-2.5) ;",
        "  PR[9,3]=250 ;",
        "  PR[9,4]=0 ;",
        "  PR[9,5]=90 ;",
        "  PR[9,6]=0 ;",
        "  UTOOL[2]=PR[9] ;",
        "  UFRAME_NUM=1 ;",
        "  UTOOL_NUM=2 ;",
        "  PAYLOAD[1] ;",
        "J P[1] 10% FINE    ;",
        "  CALL SPINDLE_ON(1200)    ;",
        "  DO[1]=ON ;",
        "  CALL MILL_001    ;",
        "   ;",
    ];
    // CrossArm, `tests/fixtures/probes/joints/JPPROBE.LS`, has these joints.
    let joints = "P[1]{\n   GP1:\n\tUF : 1, UT : 2,\t\n\tJ1=    10.000 deg,\tJ2=   -20.000 deg,\tJ3=   -10.000 deg,\n\
        \tJ4=   -40.000 deg,\tJ5=    50.000 deg,\tJ6=   120.000 deg\n};\n";
    let frame = pose(
        2,
        "UF : 0, UT : 2",
        "N U T, 0, 0, 0",
        ["1000.000", ".500", "-.500"],
        ["0.000", "0.000", "90.000"],
    );
    let point = |number, x| {
        pose(
            number,
            "UF : 1, UT : 2",
            "N U T, 0, 0, 0",
            [x, "2.000", "3.000"],
            ["30.000", "20.000", "10.000"],
        )
    };
    let points = point(1, "1.000") + &point(2, "2.000") + &point(3, "4.000");
    vec![
        ("MILL.LS", listing("MILL", &main, &(joints.to_owned() + &frame))),
        ("MILL_001.LS", listing("MILL_001", &CUT, &points)),
    ]
}

fn borrowed<'a>(files: &'a [(&'static str, String)]) -> Vec<(&'static str, &'a str)> {
    files.iter().map(|(path, text)| (*path, text.as_str())).collect()
}

/// The orientation of a position with these W, P, R.
pub(crate) fn turned([w, p, r]: [f64; 3]) -> Matrix3<f64> {
    let [w, p, r] = [w, p, r].map(|angle| format!("{angle:.3}"));
    let point = pose(1, "UF : 0, UT : 1", "N U T, 0, 0, 0", ["0.000"; 3], [&w, &p, &r]);
    alone(&["L P[1] 100mm/sec FINE    ;"], &point).targets[0].rotation
}

/// A program in the world frame, with tool 1 at zero stated in remarks.
fn alone(lines: &[&str], positions: &str) -> ControllerProgram {
    let mut all =
        vec!["  !UTOOL[1] X 0 Y 0 Z 0 ;", "  !UTOOL[1] W 0 P 0 R 0 ;", "  UFRAME_NUM=0 ;", "  UTOOL_NUM=1 ;"];
    all.extend(lines);
    fanuc(&package(&[("ALONE.LS", &listing("ALONE", &all, positions))])).unwrap()
}

#[test]
fn fanuc_keeps_what_is_in_force() {
    let program = fanuc(&package(&borrowed(&files()))).unwrap();
    assert_eq!((program.name.as_str(), program.load_kg), ("MILL", None));
    assert_eq!(program.hooks, ["CALL SPINDLE_ON(1200)", "DO[1]=ON"]);
    at(program.base.0, Vector3::new(1000.0, 0.5, -0.5));
    near(&program.base.1, [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
    at(program.tool.0, Vector3::new(0.0, -2.5, 250.0));
    near(&program.tool.1, [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]);
    let [first, one, two, arc] = &program.targets[..] else { panic!("{:?}", program.targets) };
    assert_eq!(first.motion, Motion::Joints([10.0, -20.0, -10.0, -40.0, 50.0, 120.0]));
    assert_eq!((one.speed, one.blend), (Some(100.0), Blend::Percent(50.0)));
    assert!((two.speed.unwrap() - 12.5).abs() < 1e-12, "75 cm/min");
    assert_eq!((arc.wait_before_s, arc.speed, arc.blend), (0.5, Some(8.5), Blend::Stop));
    assert_eq!(arc.motion, Motion::Arc { via: Vector3::new(4.0, 2.0, 3.0) });
}

/// Where an M-20iD/25 holds its faceplate [mm], by its lengths; the third axis counts from the horizontal.
fn m20id([j1, j2, j3, j4, j5, j6]: [f64; 6]) -> (Vector3<f64>, Matrix3<f64>) {
    let turn = |axis: [f64; 3], degrees: f64| {
        let [x, y, z] = axis;
        let across = Matrix3::new(0.0, -z, y, z, 0.0, -x, -y, x, 0.0);
        let (sin, cos) = degrees.to_radians().sin_cos();
        Matrix3::identity() + across * sin + across * across * (1.0 - cos)
    };
    let (column, shoulder) = (turn([0.0, 0.0, 1.0], j1), turn([0.0, 1.0, 0.0], j2));
    let forearm = turn([0.0, 1.0, 0.0], -j3);
    let hand = column * forearm * turn([-1.0, 0.0, 0.0], j4) * turn([0.0, -1.0, 0.0], j5);
    let place = column
        * (Vector3::new(75.0, 0.0, 0.0)
            + shoulder * Vector3::new(0.0, 0.0, 840.0)
            + forearm * Vector3::new(890.0, 0.0, 215.0))
        + hand * Vector3::new(90.0, 0.0, 0.0);
    // At zero the faceplate looks ahead, its x up.
    let ahead = Matrix3::new(0.0, 0.0, 1.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0);
    (place, hand * turn([-1.0, 0.0, 0.0], j6) * ahead)
}

/// LeroyDu56/CrossArm, `tests/fixtures/probes/CFGPROBE.LS`: joints, and where ROBOGUIDE says they are.
#[test]
fn fanuc_reads_what_a_controller_computed() {
    type Row = ([f64; 6], &'static str, [&'static str; 3], [&'static str; 3]);
    let rows: [Row; 7] = [
        (
            [0.0, 0.0, 0.0, 0.0, 90.0, 0.0],
            "F U T, 0, 0, 0",
            ["965.000", "0.000", "1145.000"],
            ["0.000", "0.000", "-180.000"],
        ),
        (
            [0.0, 0.0, 0.0, 0.0, 30.0, 0.0],
            "F U T, 0, 0, 0",
            ["1042.942", "0.000", "1100.000"],
            ["0.000", "-60.000", "180.000"],
        ),
        (
            [0.0, 0.0, 0.0, 185.0, -90.0, 0.0],
            "N U T, 0, 1, 0",
            ["965.000", "7.844", "1144.657"],
            ["-5.000", "-.000", ".000"],
        ),
        (
            [0.0, 0.0, 0.0, 0.0, -90.0, 190.0],
            "N U T, 0, 0, 1",
            ["965.000", "0.000", "965.000"],
            ["180.000", "0.000", "-170.000"],
        ),
        (
            [0.0, 40.0, 60.0, 0.0, -90.0, 0.0],
            "N D T, 0, 0, 0",
            ["951.688", "0.000", "1476.740"],
            ["180.000", "-60.000", "0.000"],
        ),
        (
            [0.0, -60.0, 80.0, 0.0, -90.0, 0.0],
            "N U B, 0, 0, 0",
            ["-621.015", "0.000", "1318.185"],
            ["180.000", "-80.000", "0.000"],
        ),
        (
            [-150.0, 0.0, 0.0, 0.0, -90.0, 0.0],
            "N U T, 0, 0, 0",
            ["-835.714", "-482.500", "965.000"],
            ["-180.000", "0.000", "-150.000"],
        ),
    ];
    for (joints, config, xyz, wpr) in rows {
        let point = pose(1, "UF : 0, UT : 1", config, xyz, wpr);
        let target = &alone(&["J P[1] 10% FINE    ;"], &point).targets[0];
        let (place, turn) = m20id(joints);
        assert_eq!((target.motion, target.configuration.as_deref()), (Motion::Free, Some(config)));
        assert!((place - target.position).amax() < 6e-4, "{joints:?}: {place} is not {}", target.position);
        assert!((turn - target.rotation).amax() < 1e-12, "{joints:?}: {turn} is not {}", target.rotation);
    }
}

/// WILDER-SYSTEMS-LLC/git-ftp, `tool_1_dropoff_leave.ls`, from a controller with a rail.
#[test]
fn fanuc_reads_a_controllers_own_program() {
    let lines = [
        "  !UFRAME[4] X0 Y0 Z0 W0 P0 R0 ;",
        "  !UTOOL[2] X0 Y0 Z0 W0 P0 R0 ;",
        "  UFRAME_NUM=4 ;",
        "  UTOOL_NUM=2 ;",
        "  WAIT   1.00(sec) ;",
        "  !MOVE TO FLIGHT HEIGHT (x axis) ;",
        "L P[1] 100mm/sec FINE ACC10    ;",
        "  CALL PLCHANDSHAKE    ;",
    ];
    let point = pose(
        1,
        "UF : 4, UT : 2",
        "F U T, 0, 0, 0",
        [".044", "-4.101", "300.000"],
        ["-.242", "0.000", "0.000"],
    )
    .replace(" deg\n}", " deg,\n\tE1= -1290.488  mm\n}");
    let program = fanuc(&package(&[("LEAVE.LS", &listing("LEAVE", &lines, &point))])).unwrap();
    at(program.targets[0].position, Vector3::new(0.044, -4.101, 300.0));
    // 0.242 deg is 0.00422370 rad, less its cube's sixth 1.3e-8.
    near(
        &program.targets[0].rotation,
        [[1.0, 0.0, 0.0], [0.0, 0.999991, 0.004224], [0.0, -0.004224, 0.999991]],
    );
    assert_eq!((program.targets[0].wait_before_s, &program.hooks[0][..]), (1.0, "CALL PLCHANDSHAKE"));
}

/// A taught point of a public plant program; the matrix by RoboDK's formula for roll, pitch and yaw.
#[test]
fn fanuc_reads_a_general_orientation() {
    near(
        &turned([-103.581, -1.481, -1.218]),
        [[0.999440, 0.020126, 0.026730], [-0.021249, -0.235301, 0.971690], [0.025845, -0.971714, -0.234741]],
    );
}

#[test]
fn fanuc_refuses() {
    refuses(
        fanuc,
        &borrowed(&files()),
        &[
            ("/PROG  MILL\n", "/PROG  MILLS\n", "the file is called"),
            ("LINE_COUNT\t= 18", "LINE_COUNT\t= 17", "there are 18 lines"),
            ("\"PART 12\"", "\"PART 12 OF THE HOUSING\"", "at most 16"),
            ("   5:", "   6:", "line 5 is expected"),
            ("!two parts", "!two parts of which each is remarked", "more than 32"),
            ("  !two parts ;", "  !two parts", "semicolon is missing"),
            ("100mm/sec CNT50    ;", "100mm/sec CNT50    ;;", "a blank stands before"),
            ("UTOOL_NUM=2 ;\n   3:L", "UTOOL_NUM=3 ;\n   3:L", "others are chosen"),
            ("UTOOL[2]=PR[9]", "UTOOL[2]=PR[8]", "the PR has no value"),
            ("PR[9,5]=90 ;", "  ;", "not all of it"),
            ("(-2.5)", "-2.5", "without parentheses"),
            ("L P[2]", "L P[7]", "P[7] has no position"),
            ("L P[2]", "LP[2]", "two blanks after"),
            ("  WAIT ", " WAIT ", "two blanks after"),
            ("FINE    ;\n   5:", "CNT5    ;\n   5:", "while the motion before blends"),
            ("100mm/sec", "2100mm/sec", "up to 2000"),
            ("8.5mm/sec", "8.55mm/sec", "one decimal"),
            ("P[3]{", "P[2]{", "a second position"),
            ("'N U T, 0, 0, 0',\n\tX =     1.000", "'N T, 0, 0, 0',\n\tX =     1.000", "no CONFIG"),
            (
                "'N U T, 0, 0, 0',\n\tX =     2.000",
                "'F U T, 0, 0, 0',\n\tX =     2.000",
                "change along a line",
            ),
            ("    2.000  mm", "    2.000", "`mm` is missing"),
            ("0.000 deg,\tP =     0.000", "-0.000 deg,\tP =     0.000", "minus zero"),
            ("/END\n", "/END\ngarbage\n", "more than a statement"),
            ("CALL MILL_001 ", "CALL MILL_002 ", "two main"),
            ("DO[1]=ON", "DO[1]=1", "no value for"),
            ("PAYLOAD[1]", "PAYLOAD[11]", "from 1 to 10"),
            ("!two parts", "!two p\u{e4}rts", "not printable ASCII"),
        ],
    );
}
