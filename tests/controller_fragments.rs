//! The readers of robot programs (`controllers/`) held to public fragments, with matrices derived another way,
//! and to faulty programs, each refused for its own reason.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]
#![allow(clippy::disallowed_methods, reason = "compared within a tolerance, not bit by bit")]

mod controllers;

use controllers::{Blend, ControllerProgram, File, Motion, fanuc, krl, rapid, val3};
use nalgebra::{Matrix3, Vector3};

type Reader = fn(&[File]) -> Result<ControllerProgram, String>;

fn package(files: &[(&str, &str)]) -> Vec<File> {
    files.iter().map(|(path, text)| File { path: (*path).to_owned(), text: (*text).to_owned() }).collect()
}

/// Asserts that a package is read, and refused with this message for each change of a text that stands in it once.
fn refuses(read: Reader, files: &[(&str, &str)], faults: &[(&str, &str, &str)]) {
    read(&package(files)).unwrap();
    for (text, fault, message) in faults {
        let changed: Vec<File> = files
            .iter()
            .map(|(path, whole)| File { path: (*path).to_owned(), text: whole.replacen(text, fault, 1) })
            .collect();
        assert!(files.iter().any(|(_, whole)| whole.contains(text)), "{text} stands in the package");
        let error = read(&changed).expect_err(fault);
        assert!(error.contains(message), "`{fault}` gave: {error}");
    }
}

/// Numbers are written to six digits or less.
fn near(found: &Matrix3<f64>, rows: [[f64; 3]; 3]) {
    let expected = Matrix3::from_fn(|row, column| rows[row][column]);
    assert!((found - expected).amax() < 2e-6, "{found} is not {expected}");
}

fn at(found: Vector3<f64>, expected: Vector3<f64>) {
    assert!((found - expected).amax() < 1e-9, "{found} is not {expected}");
}

// ---- KRL ----

const KRL_MAIN: &str = "\
&ACCESS RVP
&REL 1
DEF ARM_JOB1()
; two parts
;FOLD INI
  ;FOLD BASISTECH INI
    GLOBAL INTERRUPT DECL 3 WHEN $STOPMESS==TRUE DO IR_STOPM ( )
    INTERRUPT ON 3
    BAS (#INITMOV,0 )
  ;ENDFOLD (BASISTECH INI)
;ENDFOLD (INI)
TOOL_DATA[3]={X 0.0,Y 0.0,Z 250.0,A 0.0,B 0.0,C 0.0}
LOAD_DATA[3]={M 18.5,CM {X 0.0,Y 0.0,Z 120.0,A 0.0,B 0.0,C 0.0},J {X 0.4,Y 0.4,Z 0.2}}
BASE_DATA[2]={X 1462.4854,Y 0.0,Z 664.8991,A 0.0,B 0.0,C 0.0}
BAS (#TOOL,3)
BAS (#BASE,2)
$IPO_MODE=#BASE
$VEL.CP=0.05
$APO.CDIS=0.5
PTP $AXIS_ACT
PTP {A1 0.0,A2 -90.0,A3 90.0,A4 0.0,A5 0.0,A6 0.0}
SPINDLE_ON(12000)
ARM_JOB1_001()
END
";
const KRL_PART: &str = "\
DEF ARM_JOB1_001()
LIN {X 1.0,Y 2.0,Z 3.0,A 10.0,B 20.0,C 30.0} C_DIS
$VEL.CP=0.02
LIN {X 2.0,Y 2.0,Z 3.0,A 10.0,B 20.0,C 30.0} C_DIS
WAIT SEC 0.5
CIRC {X 3.0,Y 3.0,Z 3.0,A 0.0,B 0.0,C 0.0},{X 4.0,Y 2.0,Z 3.0,A 0.0,B 0.0,C 0.0} C_DIS
END
";
const KRL: [(&str, &str); 3] = [
    ("ARM_JOB1.src", KRL_MAIN),
    (
        "ARM_JOB1.dat",
        "&ACCESS RVP\nDEFDAT ARM_JOB1\nEXT  BAS (BAS_COMMAND  :IN,REAL  :IN )\nDECL INT SUCCESS\nENDDAT\n",
    ),
    ("ARM_JOB1_001.src", KRL_PART),
];

#[test]
fn krl_keeps_what_is_in_force() {
    let program = krl(&package(&KRL)).unwrap();
    assert_eq!((program.name.as_str(), program.load_kg), ("ARM_JOB1", Some(18.5)));
    assert_eq!(program.hooks, ["SPINDLE_ON(12000)"]);
    at(program.base.0, Vector3::new(1462.4854, 0.0, 664.8991));
    at(program.tool.0, Vector3::new(0.0, 0.0, 250.0));
    let [first, one, two, arc] = &program.targets[..] else { panic!("{:?}", program.targets) };
    assert_eq!(first.motion, Motion::Joints([0.0, -90.0, 90.0, 0.0, 0.0, 0.0]));
    assert_eq!((one.speed, one.blend), (Some(50.0), Blend::Distance(0.5)));
    // A wait stops the advance run, so nothing is rounded; neither is the last motion.
    assert_eq!((two.speed, two.blend), (Some(20.0), Blend::Stop));
    assert_eq!((arc.wait_before_s, arc.blend), (0.5, Blend::Stop));
    assert_eq!(arc.motion, Motion::Arc { via: Vector3::new(3.0, 3.0, 3.0) });
    assert_eq!(program.lines_of_longest_file, 24);
}

/// HugoDanielson/ChinaMilling, `KRC/R1/System/$config.dat`, a cell's tool and load: Rz(-90) Rx(90) by hand.
#[test]
fn krl_reads_a_cells_tool() {
    let config = "&ACCESS RV\nDEFDAT $CONFIG PUBLIC\n\
        TOOL_DATA[3]={X 409.434326,Y 3.01155138,Z 166.257782,A -90.0000,B 0.0,C 90.0000}\n\
        LOAD_DATA[3]={M 40.3176460,CM {X -20.2326183,Y 6.49601889,Z 105.904,A -90.0085373,B -0.0804520,\
        C 88.8709488},J {X 5.25000,Y 5.25000,Z 5.25000}}\n\
        E6AXIS XHOME={A1 -70.0000,A2 -115.000,A3 125.000,A4 -86.0000,A5 -70.0000,A6 78.0000,\
        E1 0.0,E2 0.0,E3 0.0,E4 0.0,E5 0.0,E6 0.0}\nENDDAT\n";
    let main = "DEF M1()\nBAS(#INITMOV,0)\nBAS(#TOOL,3)\n$VEL.CP=0.1\nPTP XHOME\n\
        LIN {X 0,Y 0,Z 0,A 0,B -90.0,C 0}\nEND\n";
    let program = krl(&package(&[("$config.dat", config), ("M1.src", main)])).unwrap();
    near(&program.tool.1, [[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    at(program.tool.0, Vector3::new(409.434326, 3.01155138, 166.257782));
    assert_eq!(program.load_kg, Some(40.317646));
    assert_eq!(program.targets[0].motion, Motion::Joints([-70.0, -115.0, 125.0, -86.0, -70.0, 78.0]));
    // `TOOL_DATA[1]` of the same file is turned by B -90.
    near(&program.targets[1].rotation, [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]);
}

/// ros-industrial-attic/robodk_postprocessors, `KUKA_KRC4_DAT.py`; the matrix by RoboDK's `KUKA_2_Pose.m`.
#[test]
fn krl_reads_a_taught_point() {
    let list = "DEFDAT M1\nDECL E6POS XP1={X 27.0236969,Y 1220.23962,Z 669.846619,A -90.0563354,B 53.4202652,\
        C -178.565933,S 2,T 35,E1 0.0,E2 0.0,E3 0.0,E4 0.0,E5 0.0,E6 0.0}\nENDDAT\n";
    let main = "DEF M1()\n$BASE={X 0,Y 0,Z 0,A 0,B 0,C 0}\n$TOOL={X 0,Y 0,Z 0,A 0,B 0,C 0}\nPTP XP1\nEND\n";
    let point = &krl(&package(&[("M1.dat", list), ("M1.src", main)])).unwrap().targets[0];
    assert_eq!((point.motion, point.configuration.as_deref()), (Motion::Free, Some("S 2,T 35")));
    near(
        &point.rotation,
        [
            [-0.000586, -0.999667, 0.025816],
            [-0.595941, 0.021080, 0.802752],
            [-0.803028, -0.014914, -0.595754],
        ],
    );
}

/// A RoboDK 5.4.1 program for a KR 10 R1100 sixx (the README of a public repository of student work).
#[test]
fn krl_reads_a_post() {
    let main = "DEF M1()\n$BASE = {FRAME: X 0,Y 0,Z 0,A 0,B 0,C 0}\n\
        $TOOL = {FRAME: X -4.000,Y 0.000,Z 371.300,A 0.000,B 45.000,C 0.000}\n$VEL.CP = 0.05\n\
        PTP {A1 -37.61500,A2 -66.12680,A3 64.78780,A4 -4.01055,A5 87.37590,A6 -32.10020,E1 0.00000}\n\
        LIN {X 741.007,Y 99.446,Z 857.731,A -172.958,B -15.331,C -171.778,E1 0.00000}\nEND\n";
    let program = krl(&package(&[("M1.src", main)])).unwrap();
    let h = 0.5_f64.sqrt();
    near(&program.tool.1, [[h, 0.0, h], [0.0, 1.0, 0.0], [-h, 0.0, h]]);
    near(
        &program.targets[1].rotation,
        [
            [-0.957139, -0.158862, -0.242171],
            [-0.118234, 0.977620, -0.174011],
            [0.264395, -0.137920, -0.954502],
        ],
    );
}

#[test]
fn krl_refuses() {
    refuses(
        krl,
        &KRL,
        &[
            ("DEF ARM_JOB1()", "DEF ARM_JOB()", "the file is called"),
            ("DEFDAT ARM_JOB1", "DEFDAT ARM_JOB2", "the file is called"),
            ("Z 3.0,A 10.0,B 20.0,C 30.0} C", "Z 3.0,A 10.0,B 20.0} C", "C is missing"),
            ("{X 1.0,", "{X 1.0,X 1.0,", "X twice"),
            (";ENDFOLD (INI)\n", "\n", "is not closed"),
            ("DEF ARM_JOB1_001()\n", "DEF ARM_JOB1_001()\n;ENDFOLD\n", "no such fold"),
            ("BAS (#BASE,2)", "BAS (#BASE,4)", "this base has no value"),
            ("BAS (#TOOL,3)", "$TOOL=MY_TOOL", "MY_TOOL is not declared"),
            ("BAS (#BASE,2)", "BAS (#LOAD,2)", "no such command"),
            ("$IPO_MODE=#BASE", "$IPO_MOD=#BASE", "no variable that this controller knows"),
            ("$VEL.CP=0.02", "$VEL.CP=50", "out of range"),
            ("$VEL.CP=0.02", "$VEL.CP=0.02 mm", "more than a statement"),
            ("$APO.CDIS=0.5\n", "", "$APO.CDIS has no value"),
            ("; two parts", "; zwei St\u{fc}cke", "not printable ASCII"),
            ("WAIT SEC 0.5", "WAIT 0.5", "`SEC` is missing"),
            ("WAIT SEC 0.5", "GOTO M", "`(` is missing"),
            ("SPINDLE_ON(12000)", "SPINDLE_ON_WITH_A_LONG_NAME(12000)", "more than 24"),
            ("ARM_JOB1_001()\nEND\n", "ARM_JOB1_001()\nEND\ngarbage\n", "outside DEF"),
            ("ENDDAT\n", "ENDDAT\nDECL INT A\n", "after ENDDAT"),
            ("0.0}\nSPINDLE", "0.0\nSPINDLE", "`,` is missing"),
            ("ARM_JOB1_001()\nEND\n", "END\n", "two main"),
        ],
    );
}

// ---- RAPID ----

const RAPID_MAIN: &str = "\
%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE ArmJob1
  ! two parts
  TASK PERS tooldata tArm:=[TRUE,[[0,0,250],[1,0,0,0]],[18.5,[0,0,120],[1,0,0,0],0.4,0.4,0.2]];
  TASK PERS wobjdata wArm:=[FALSE,TRUE,\"\",[[1200,0,600],[0,0,0,1]],[[10,0,0],[1,0,0,0]]];
  CONST speeddata vArm1:=[12.5,500,5000,1000];
  CONST zonedata zArm:=[FALSE,0.5,0.5,0.5,0.05,0.5,0.05];
  PROC main()
    AccSet 50,50;
    ConfJ\\On;
    ConfL\\Off;
    SingArea\\Off;
    SpindleOn 12000;
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]\\NoEOffs,v100,fine,tArm\\WObj:=wArm;
    Load\\Dynamic,\"HOME:/ArmJob1/ArmJob1_01.mod\";
    %\"ArmJob1_p01\"%;
    UnLoad \"HOME:/ArmJob1/ArmJob1_01.mod\";
    Stop;
  ENDPROC
ENDMODULE
";
const RAPID_PART: &str = "\
MODULE ArmJob1_01
  PROC ArmJob1_p01()
    MoveL [[1,2,3],[1,0,0,0],[0,-1,0,1],[9E9,9E9,9E9,9E9,9E9,9E9]],vArm1,zArm,tArm\\WObj:=wArm;
    MoveL [[2,2,3],[1,0,0,0],[0,-1,0,1],[9E9,9E9,9E9,9E9,9E9,9E9]],vArm1,fine,tArm\\WObj:=wArm;
    WaitTime\\InPos,0.5;
    MoveL [[3,2,3],[1,0,0,0],[0,-1,0,1],[9E9,9E9,9E9,9E9,9E9,9E9]],v20,fine,tArm\\WObj:=wArm;
  ENDPROC
ENDMODULE
";
const RAPID: [(&str, &str); 3] = [
    (
        "ArmJob1.pgf",
        "<?xml version=\"1.0\" encoding=\"ISO-8859-1\" ?>\n<Program>\n  <Module>ArmJob1.mod</Module>\n</Program>\n",
    ),
    ("ArmJob1.mod", RAPID_MAIN),
    ("ArmJob1_01.mod", RAPID_PART),
];

#[test]
fn rapid_keeps_what_is_in_force() {
    let program = rapid(&package(&RAPID)).unwrap();
    assert_eq!((program.load_kg, &program.hooks[..]), (Some(18.5), &["SpindleOn 12000".to_owned()][..]));
    // The object frame lies in the user frame, which is turned by 180 deg about Z.
    at(program.base.0, Vector3::new(1190.0, 0.0, 600.0));
    near(&program.base.1, [[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]);
    let [first, one, two, three] = &program.targets[..] else { panic!("{:?}", program.targets) };
    assert_eq!(first.motion, Motion::Joints([0.0, 0.0, 0.0, 0.0, 30.0, 0.0]));
    assert_eq!((one.speed, one.blend), (Some(12.5), Blend::Distance(0.5)));
    assert_eq!(one.configuration.as_deref(), Some("[0,-1,0,1]"));
    assert_eq!((two.blend, three.wait_before_s, three.speed), (Blend::Stop, 0.5, Some(20.0)));
}

/// A module around one motion.
fn rapid_module(data: &str, motions: &str) -> ControllerProgram {
    rapid(&package(&[("M.mod", &format!("MODULE M\n{data}\nPROC main()\n{motions}\nENDPROC\nENDMODULE\n"))]))
        .unwrap()
}

/// visose/Robots, `tests/Robots.Tests/PostProcessorTests.cs`; its `TestRobots.cs` gives the axes of the pose:
/// x' = Y, y' = Z, z' = X.
#[test]
fn rapid_reads_a_post() {
    let program = rapid_module(
        "PERS tooldata DefaultTool:=[TRUE,[[0,0,0],[1,0,0,0]],[0.001,[0,0,0.001],[1,0,0,0],0,0,0]];
        TASK PERS wobjdata DefaultFrame:=[FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
        CONST confdata conf:=[0,0,0,1]; VAR extjoint extj:=[9E9,9E9,9E9,9E9,9E9,9E9];
        CONST speeddata DefaultSpeed:=[100,180,5000,1080]; CONST speeddata Speed000:=[200,180,5000,1080];",
        "MoveAbsJ [[41.257,-0.5638,4.3298,85.7179,-41.3979,5.7002],extj],DefaultSpeed,fine,DefaultTool;
        MoveL [[300,-200,610],[0.5,0.5,0.5,0.5],conf,extj],Speed000,fine,DefaultTool \\WObj:=DefaultFrame;",
    );
    assert_eq!(
        program.targets[0].motion,
        Motion::Joints([41.257, -0.5638, 4.3298, 85.7179, -41.3979, 5.7002])
    );
    at(program.targets[1].position, Vector3::new(300.0, -200.0, 610.0));
    near(&program.targets[1].rotation, [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
}

/// The RAPID reference manual, data type orient: a tool turned by 30 deg about Y has x' = (cos 30, 0, -sin 30),
/// y' = (0, 1, 0), z' = (sin 30, 0, cos 30). Its `[0.707,0,0.707,0]` is no unit quaternion to five digits.
#[test]
fn rapid_reads_the_manuals_tool() {
    let program = rapid_module(
        "PERS tooldata t:=[TRUE,[[97.4,0,223.1],[0.965926,0,0.258819,0]],[5,[23,0,75],[1,0,0,0],0,0,0]];",
        "MoveL [[1,2,3],[0.707107,0,0.707107,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;",
    );
    let cos = 0.75_f64.sqrt();
    near(&program.tool.1, [[cos, 0.0, 0.5], [0.0, 1.0, 0.0], [-0.5, 0.0, cos]]);
    near(&program.targets[0].rotation, [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]);
}

/// mjkkirschner/TORO, `extra/test02_001.prg`: the point is 100 (sin 10, 0, cos 10), the tool's z looks at the origin.
#[test]
fn rapid_reads_an_inclined_target() {
    let program = rapid_module(
        "VAR robtarget p10 := [[17.364817766693,-1.04083408558608E-15,98.4807753012208], [0.00759612349389579,\
        0.992403876506124,-0.0868240888334661,-0.086824088833467], [0,0,0,0], [9E9,9E9,9E9,9E9,9E9,9E9]];",
        "MoveL p10, v100, z5, tool0;\nMoveL p10, v100, fine, tool0\\WObj:=wobj0;",
    );
    let target = &program.targets[0];
    assert_eq!(target.blend, Blend::Distance(5.0));
    assert!((target.rotation.column(2) + target.position / 100.0).amax() < 1e-8);
    near(
        &target.rotation,
        [[0.969846, -0.171010, -0.173648], [-0.173648, -0.984808, 0.0], [-0.171010, 0.030154, -0.984808]],
    );
}

#[test]
fn rapid_refuses() {
    refuses(
        rapid,
        &RAPID,
        &[
            ("[0,0,250],[1,0,0,0]", "[0,0,250],[0.707,0,0.707,0]", "no value of a tooldata"),
            ("vArm1,zArm", "vArm2,zArm", "no speeddata varm2 is declared"),
            ("vArm1,zArm", "vArm1,z7", "no zonedata z7 is declared"),
            ("fine,tArm\\WObj:=wArm;\n    Wait", "zArm,tArm\\WObj:=wArm;\n    Wait", "within a corner zone"),
            ("v20,fine", "v20,z1", "within a corner zone"),
            ("[1,0,0,0],[0,-1,0,1],[9E9", "[0,-1,0,1],[9E9", "no value of a robtarget"),
            ("[0,-1,0,1]", "[0,-1,0,8]", "cfx from 0 to 7"),
            ("MODULE ArmJob1\n", "MODULE A234567890123456789012345678901234\n", "at most 32"),
            ("PROC main()", "PROC Main2()", "PROC main"),
            ("PROC ArmJob1_p01()", "PROC main()", "ambiguous"),
            ("%\"ArmJob1_p01\"%;", "%\"ArmJob1_p02\"%;", "no procedure of this name"),
            ("UnLoad \"HOME:/ArmJob1/ArmJob1_01.mod\";", "", "never unloaded"),
            ("UnLoad \"HOME:/ArmJob1/", "UnLoad \"HOME:/", "not loaded by this path"),
            ("<Module>ArmJob1.mod</Module>", "<Module>ArmJob2.mod</Module>", "no file ArmJob2.mod"),
            ("</Program>\n", "</Programm>\n", "</Program> is missing"),
            ("</Program>\n", "</Program>\n<a/>\n", "something after the root"),
            ("ENDMODULE\n", "ENDMODULE\ngarbage\n", "more than a statement"),
            ("SingArea\\Off", "SingArea\\Of", "no such switch"),
            ("AccSet 50,50;", "AccSet 50,50", "more than a statement"),
            ("18.5,", "0,", "its load is zero"),
            ("! two parts", "! \u{2013}", "not printable ASCII"),
            ("SpindleOn 12000;", "Spindle-On 12000;", "a number is missing"),
        ],
    );
}
