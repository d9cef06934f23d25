//! KUKA.

use super::{at, near, package, refuses};
use crate::controllers::{Blend, Motion, krl};
use nalgebra::{Matrix3, Vector3};

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

/// The orientation of a target with these A, B, C.
pub(crate) fn turned([a, b, c]: [f64; 3]) -> Matrix3<f64> {
    let part = KRL_PART.replacen("A 10.0,B 20.0,C 30.0", &format!("A {a},B {b},C {c}"), 1);
    let files = [KRL[0], KRL[1], (KRL[2].0, part.as_str())];
    krl(&package(&files)).unwrap().targets[1].rotation
}
