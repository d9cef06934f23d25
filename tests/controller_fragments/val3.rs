//! Staubli.

use super::{at, near, package, refuses};
use crate::controllers::{Blend, Motion, val3};
use nalgebra::{Matrix3, Vector3};

const PROJECT: &str = "<?xml version=\"1.0\" encoding=\"utf-8\"?>
<Project xmlns=\"http://www.staubli.com/robotics/VAL3/Project/3\">
  <Parameters version=\"s7.10.2\" stackSize=\"5000\" millimeterUnit=\"true\" />
  <Programs>
    <Program file=\"start.pgx\" />
    <Program file=\"stop.pgx\" />
    <Program file=\"mill_001.pgx\" />
    <Program file=\"spindleOn.pgx\" />
  </Programs>
  <Database>
    <Data file=\"JOB1.dtx\" />
  </Database>
  <Libraries />
</Project>
";
const DATA: &str = "
    <Data name=\"fPart\" access=\"private\" xsi:type=\"array\" type=\"frame\" size=\"1\">
      <Value key=\"0\" x=\"500\" rz=\"90\" fatherId=\"world[0]\" />
    </Data>
    <Data name=\"tSpindle\" access=\"private\" xsi:type=\"array\" type=\"tool\" size=\"1\">
      <Value key=\"0\" z=\"250\" fatherId=\"flange[0]\" ioLink=\"valve1\" />
    </Data>
    <Data name=\"jFirst\" access=\"private\" xsi:type=\"array\" type=\"jointRx\" size=\"1\">
      <Value key=\"0\" j2=\"30\" j3=\"90\" />
    </Data>
    <Data name=\"pPath\" access=\"private\" xsi:type=\"array\" type=\"pointRx\" size=\"3\">
      <Value key=\"0\" x=\"1\" rx=\"10\" ry=\"20\" rz=\"30\" fatherId=\"fPart[0]\" />
      <Value key=\"1\" x=\"2\" rx=\"10\" ry=\"20\" rz=\"30\" fatherId=\"fPart[0]\" />
      <Value key=\"2\" x=\"3\" fatherId=\"fPart[0]\" />
    </Data>
    <Data name=\"mMove\" access=\"private\" xsi:type=\"array\" type=\"mdesc\" size=\"1\">
      <Value key=\"0\" vel=\"20\" blend=\"off\" />
    </Data>
    <Data name=\"mCut\" access=\"private\" xsi:type=\"array\" type=\"mdesc\" size=\"1\">
      <Value key=\"0\" tmax=\"20\" blend=\"Cartesian\" leave=\"0.1\" reach=\"0.1\" />
    </Data>";
const START: &str = "  // first by the axes
  movej(jFirst,tSpindle,mMove)
  waitEndMove()
  call spindleOn(12000)
  delay(3)
  call mill_001(20)
";
const MILL: &str = "  mCut.tvel=x_nFeed
  for l_nI=0 to 1
    movel(pPath[l_nI],tSpindle,mCut)
  endFor
  movel(pPath[l_nI+1],tSpindle,mCut)
  waitEndMove()
";

fn database(data: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Database xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" \
         xmlns=\"http://www.staubli.com/robotics/VAL3/Data/2\">\n  <Datas>{data}\n  </Datas>\n</Database>\n"
    )
}

fn val3_program(name: &str, variables: &str, code: &str) -> String {
    format!(
        "\u{feff}<?xml version=\"1.0\" encoding=\"utf-8\"?>\n\
         <Programs xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" \
         xmlns=\"http://www.staubli.com/robotics/VAL3/Program/2\">\n  <Program name=\"{name}\">\n{variables}    \
         <Code><![CDATA[begin\n{code}end]]></Code>\n  </Program>\n</Programs>\n"
    )
}

/// An application with this data and code; `mill_001` has a parameter and a local variable.
fn val3_files(data: &str, start: &str, mill: &str) -> Vec<(&'static str, String)> {
    let variables = "    <Parameters xmlns=\"http://www.staubli.com/robotics/VAL3/Param/1\">
      <Parameter name=\"x_nFeed\" type=\"num\" xsi:type=\"element\" />
    </Parameters>
    <Locals>
      <Local name=\"l_nI\" type=\"num\" xsi:type=\"array\" size=\"1\" />
    </Locals>\n";
    vec![
        ("JOB1/JOB1.pjx", PROJECT.to_owned()),
        ("JOB1/JOB1.dtx", database(data)),
        ("JOB1/start.pgx", val3_program("start", "    <Locals />\n", start)),
        ("JOB1/stop.pgx", val3_program("stop", "", "  resetMotion()\n")),
        ("JOB1/mill_001.pgx", val3_program("mill_001", variables, mill)),
    ]
}

fn borrowed<'a>(files: &'a [(&'static str, String)]) -> Vec<(&'static str, &'a str)> {
    files.iter().map(|(path, text)| (*path, text.as_str())).collect()
}

#[test]
fn val3_keeps_what_is_in_force() {
    let program = val3(&package(&borrowed(&val3_files(DATA, START, MILL)))).unwrap();
    assert_eq!(
        (program.name.as_str(), &program.hooks[..]),
        ("JOB1", &["call spindleOn(12000)".to_owned()][..])
    );
    at(program.base.0, Vector3::new(500.0, 0.0, 0.0));
    near(&program.base.1, [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
    let [first, one, _, last] = &program.targets[..] else { panic!("{:?}", program.targets) };
    assert_eq!(first.motion, Motion::Joints([0.0, 30.0, 90.0, 0.0, 0.0, 0.0]));
    assert_eq!((first.speed, first.blend, one.wait_before_s), (None, Blend::Stop, 3.0));
    assert_eq!((one.speed, one.blend, last.blend), (Some(20.0), Blend::Distance(0.1), Blend::Stop));
    at(last.position, Vector3::new(3.0, 0.0, 0.0));
}

/// Where a TX90 holds its flange [mm], by its lengths (ros-industrial/staubli_experimental): axes z y y z y z, the
/// world on axis 1 at the height of axis 2.
fn tx90(joints: [f64; 6]) -> (Vector3<f64>, Matrix3<f64>) {
    let [j1, j2, j3, j4, j5, j6] = joints.map(f64::to_radians);
    let z = |a: f64| Matrix3::new(a.cos(), -a.sin(), 0.0, a.sin(), a.cos(), 0.0, 0.0, 0.0, 1.0);
    let y = |a: f64| Matrix3::new(a.cos(), 0.0, a.sin(), 0.0, 1.0, 0.0, -a.sin(), 0.0, a.cos());
    let up = |length: f64| Vector3::new(0.0, 0.0, length);
    let (elbow, forearm) = (z(j1) * y(j2), z(j1) * y(j2) * y(j3));
    let hand = forearm * z(j4) * y(j5);
    let place =
        z(j1) * Vector3::new(50.0, 50.0, 0.0) + elbow * up(425.0) + forearm * up(425.0) + hand * up(100.0);
    (place, hand * z(j6))
}

/// ThenesVara/Checkers_Staubli, `usrapp/ROBERT_TP6/ROBERT_TP6.dtx`, a TX90 that mills: the spindle at `jStart` stands
/// 100.704 mm outside the part, square to it. The frames' matrices by hand: Rx(180) Rz(-90) and Ry(90) Rz(90).
#[test]
fn val3_reads_a_milling_cell() {
    let data = DATA
        .replace(
            "j2=\"30\" j3=\"90\"",
            "j1=\"-13.1554864532824\" j2=\"52.8057266959055\" j3=\"128.56179776802\" \
             j4=\"166.840895901009\" j5=\"91.3316286241402\" j6=\"-180.311296989427\"",
        )
        .replace(
            "z=\"250\"",
            "x=\"169.400168374358\" y=\"5.67105066906493E-05\" z=\"47.7499999146672\" \
             ry=\"90\" rz=\"90\"",
        )
        .replace(
            "x=\"500\" rz=\"90\"",
            "x=\"527.606812\" y=\"-37.435701\" z=\"-438.0625\" rx=\"180\" rz=\"-90\"",
        )
        .replace("x=\"1\" rx=\"10\" ry=\"20\" rz=\"30\"", "x=\"25\" y=\"25\"");
    let program = val3(&package(&borrowed(&val3_files(&data, START, MILL)))).unwrap();
    near(&program.base.1, [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]]);
    near(&program.tool.1, [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    at(program.targets[1].position, Vector3::new(25.0, 25.0, 0.0));
    let Motion::Joints(joints) = program.targets[0].motion else { panic!("{:?}", program.targets[0]) };
    let (place, turn) = tx90(joints);
    let tip = program.base.1.transpose() * (place + turn * program.tool.0 - program.base.0);
    assert!((tip - Vector3::new(0.0, 0.0, -100.704)).amax() < 5e-4, "{tip}");
    near(
        &(program.base.1.transpose() * turn * program.tool.1),
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    );
}

/// The same project's `usrapp/AA_Chessie/AA_Chessie.dtx`: joints and the point they reach, to a hundredth of a micron.
#[test]
fn val3_reads_a_taught_point() {
    let data = DATA
        .replace(
            "j2=\"30\" j3=\"90\"",
            "j1=\"-7.236149\" j2=\"83.896154\" j3=\"110.243942\" \
             j5=\"-14.140096\" j6=\"172.763851\"",
        )
        .replace("z=\"250\"", "x=\"2.67332365613152\" y=\"0.0823457375943404\" z=\"50.1043771229301\"")
        .replace("x=\"500\" rz=\"90\"", "")
        .replace(
            "x=\"1\" rx=\"10\" ry=\"20\" rz=\"30\"",
            "x=\"374.8\" y=\"3.07\" z=\"-517.036829\" rx=\"-180\" \
             shoulder=\"lefty\" elbow=\"epositive\" wrist=\"wpositive\"",
        );
    let program = val3(&package(&borrowed(&val3_files(&data, START, MILL)))).unwrap();
    let Motion::Joints(joints) = program.targets[0].motion else { panic!("{:?}", program.targets[0]) };
    let (place, turn) = tx90(joints);
    let point = &program.targets[1];
    assert!((place + turn * program.tool.0 - point.position).amax() < 2e-5);
    assert!((turn - point.rotation).amax() < 1e-7);
    assert_eq!(point.configuration.as_deref(), Some("lefty epositive wpositive"));
}

/// ros-industrial-attic/robodk_postprocessors, a sample in `Staubli_VAL3.py`; the matrix by its `Pose_2_Staubli_v2`
/// read backwards.
#[test]
fn val3_reads_a_general_orientation() {
    let data = DATA.replace(
        "x=\"1\" rx=\"10\" ry=\"20\" rz=\"30\"",
        "x=\"-36.802\" y=\"-6.159\" z=\"500.000\" rx=\"135.407\" ry=\"80.416\" rz=\"46.453\"",
    );
    let program = val3(&package(&borrowed(&val3_files(&data, START, MILL)))).unwrap();
    near(
        &program.targets[1].rotation,
        [
            [0.114706, -0.120676, 0.986043],
            [-0.039208, -0.992371, -0.116889],
            [0.992625, -0.025253, -0.118562],
        ],
    );
}

#[test]
fn val3_refuses() {
    refuses(
        val3,
        &borrowed(&val3_files(DATA, START, MILL)),
        &[
            ("<Libraries />", "<Libraries>", "</Libraries> is missing"),
            ("</Project>\n", "</Project>\n<a/>\n", "something after the root"),
            ("<Program file=\"mill_001.pgx\" />", "", "not listed"),
            ("file=\"JOB1.dtx\"", "file=\"JOB2.dtx\"", "not listed"),
            ("millimeterUnit=\"true\"", "millimeterUnit=\"false\"", "millimeterUnit"),
            ("size=\"3\"", "size=\"2\"", "below the size"),
            ("<Value key=\"1\"", "<Value key=\"0\"", "a key of its own"),
            ("x=\"3\" fatherId=\"fPart[0]\"", "x=\"3\" fatherId=\"fPiece[0]\"", "no such father"),
            ("x=\"3\"", "x=\"3mm\"", "no number"),
            ("x=\"3\"", "a=\"3\"", "not known in a pointRx"),
            ("blend=\"off\"", "blend=\"none\"", "no blending"),
            ("name=\"tSpindle\"", "name=\"tSpindleOfTheJob\"", "at most 15"),
            ("reach=\"0.1\"", "reach=\"0.2\"", "leave and reach differ"),
            ("<Program name=\"mill_001\">", "<Program name=\"mill_002\">", "called as its file"),
            ("pPath[l_nI+1]", "pPath[l_nI+2]", "no pointRx pPath[3]"),
            ("movel(pPath[l_nI],tSpindle,mCut)", "movel(pPath[l_nI],tSpindl,mCut)", "no tool tSpindl"),
            ("<Local name=\"l_nI\"", "<Local name=\"l_nJ\"", "no num l_nI"),
            ("endFor", "", "endFor is missing"),
            ("call mill_001(20)", "call mill_001()", "other parameters"),
            ("call mill_001(20)", "mill_001(20)", "is missing"),
            ("call spindleOn", "call spindle", "neither a program of the project"),
            ("+1],tSpindle,mCut)\n  waitEndMove()", "+1],tSpindle,mCut)", "motions are under way"),
            ("waitEndMove()\n  call spindle", "call spindle", "motions are under way"),
            ("mCut.tvel", "mCut.tmax", "no such field"),
            ("delay(3)", "delay(3) 4", "more than a statement"),
            ("end]]>", "end\n  garbage]]>", "between begin and end"),
            ("first by the axes", "\u{e9}tape", "not printable ASCII"),
        ],
    );
}

/// The orientation of a point with these rx, ry, rz.
pub(crate) fn turned([x, y, z]: [f64; 3]) -> Matrix3<f64> {
    let angles = format!("rx=\"{x}\" ry=\"{y}\" rz=\"{z}\"");
    let data = DATA.replacen("rx=\"10\" ry=\"20\" rz=\"30\"", &angles, 1);
    val3(&package(&borrowed(&val3_files(&data, START, MILL)))).unwrap().targets[1].rotation
}
