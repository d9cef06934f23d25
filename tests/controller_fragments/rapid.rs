//! ABB.

use super::{at, near, package, refuses};
use crate::controllers::{Blend, ControllerProgram, Motion, rapid};
use nalgebra::Vector3;

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
