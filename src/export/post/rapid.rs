//! The compensated path for ABB controllers: RAPID modules, and the `.pgf` that lists them.
//!
//! `MoveL` and `MoveC` in a work object, with the tip as tool; lengths in mm, quaternions with the
//! scalar first, speeds in mm/s. Stops are `fine`; elsewhere a zone of the program's own, within which
//! the path is a parabola, half the distance to the next point at most. The first move is by axes;
//! after it, `ConfL\Off` keeps the nearest configuration, and the one simulated stands in each target.
//! Parts are loaded one after the other, which needs the tool at rest.
//!
//! The layout of data types and zones follows ABB's RAPID reference manual, that of the package
//! published programs; nothing has been tried on a controller.

use super::robot::{Brief, Language, PackageFile, PostedMove};
use crate::export::header::number;
use crate::export::orientation::quaternion;
use crate::export::posture::Posture;
use crate::math::Pose;
use crate::robot::{Joints, Robot};
use crate::units::{DEG, MM};

/// Number of external axes in a target.
const EXTERNAL: usize = 6;

/// RAPID.
pub(super) struct Rapid<'r> {
    robot: &'r Robot,
    /// The different speeds [m/s]; each is declared as a speeddata.
    speeds: Vec<f64>,
    /// Size of the zone [mm].
    zone: f64,
    /// Positions of external axes.
    external: String,
}

impl<'r> Rapid<'r> {
    pub(super) fn new(brief: &Brief<'r>) -> Self {
        let given = brief.options.external.iter().map(|axis| number(*axis, 4));
        let external: Vec<_> =
            given.chain(std::iter::repeat_n("9E9".to_owned(), EXTERNAL)).take(EXTERNAL).collect();
        Self {
            robot: &brief.report.plan.robot,
            speeds: brief.speeds(),
            zone: brief.command.blend / MM,
            external: format!("[{}]", external.join(",")),
        }
    }

    /// A robtarget in the configuration of the joint values `q` [rad].
    fn target(&self, pose: &Pose, q: &Joints) -> String {
        let pose = frame(pose);
        let inner = &pose[1..pose.len() - 1];
        let [cf1, cf4, cf6] = [0, 3, 5].map(|axis| (q[axis] / DEG / 90.0).floor());
        let cfx = cfx(&Posture::of(self.robot, q));
        format!("[{inner},[{cf1},{cf4},{cf6},{cfx}],{}]", self.external)
    }

    /// Tool, work object, speeds and zone.
    fn declarations(&self, brief: &Brief) -> Vec<String> {
        let options = brief.options;
        let (mass, centre) = match &options.load {
            Some(load) => (load.mass, load.centre / MM),
            // A mass and a centre of zero are refused.
            None => (1.0, nalgebra::Vector3::z() * 0.001),
        };
        let [x, y, z] = centre.map(|x| number(x, 3)).into();
        let tool = format!(
            "TASK PERS tooldata tMill:=[TRUE,{},[{},[{x},{y},{z}],[1,0,0,0],0,0,0]];",
            frame(brief.tool),
            number(mass, 4)
        );
        let part = format!(
            "TASK PERS wobjdata wPart:=[FALSE,TRUE,\"\",{},[[0,0,0],[1,0,0,0]]];",
            frame(&brief.base)
        );
        let mut lines = Vec::new();
        match (options.stores_frames, &options.load) {
            (true, Some(_)) => {}
            (true, None) => lines.push(
                "  ! The load is not known here: 1 kg is a placeholder. Enter that of spindle, holder and tool before \
                 running."
                    .into(),
            ),
            (false, _) => lines.push(
                "  ! Tool tMill and work object wPart are the controller's own: the figures are for these values.".into(),
            ),
        }
        let stored =
            |line: String| if options.stores_frames { format!("  {line}") } else { format!("  ! {line}") };
        lines.extend([stored(tool), stored(part)]);
        lines.extend(self.speeds.iter().enumerate().map(|(k, speed)| {
            format!("  CONST speeddata vFeed{}:=[{},500,5000,1000];", k + 1, number(speed / MM, 4))
        }));
        if self.zone > 0.0 {
            let [tcp, tenth] = [self.zone, self.zone / 10.0].map(|size| number(size, 4));
            lines.push(format!("  CONST zonedata zMill:=[FALSE,{tcp},{tcp},{tcp},{tenth},{tcp},{tenth}];"));
        }
        lines
    }
}

impl Language for Rapid<'_> {
    fn comment(&self, text: &str) -> String {
        format!("    ! {text}")
    }

    fn wait(&self, time: f64) -> String {
        format!("    WaitTime \\InPos,{};", number(time, 4))
    }

    fn move_to(&mut self, target: &PostedMove) -> String {
        let zone = if target.stops || self.zone == 0.0 { "fine" } else { "zMill" };
        let speed = self.speeds.iter().position(|known| *known == target.speed).unwrap_or(0) + 1;
        let to = self.target(&target.pose, target.joints);
        let rest = format!("{to},vFeed{speed},{zone},tMill\\WObj:=wPart;");
        match &target.via {
            Some(via) => format!("    MoveC {},{rest}", self.target(via, target.via_joints)),
            None => format!("    MoveL {rest}"),
        }
    }

    fn files(&self, brief: &Brief, parts: &[Vec<String>]) -> Vec<PackageFile> {
        let options = brief.options;
        let name = &options.name;
        let mut lines: Vec<String> = brief.header.iter().map(|line| format!("  ! {line}")).collect();
        lines.extend(self.declarations(brief));
        let [q1, q2, q3, q4, q5, q6] = brief.start_deg().map(|q| number(q, 5));
        let acceleration = number(brief.report.setup().limits.acceleration.max(0.1), 4);
        lines.extend([
            "  PROC main()".into(),
            "    ConfJ\\On;".into(),
            "    ConfL\\Off;".into(),
            "    SingArea\\Off;".into(),
            format!("    PathAccLim TRUE\\AccMax:={acceleration},TRUE\\DecelMax:={acceleration};"),
        ]);
        let otherwise =
            "    ! Spindle and coolant: switch them on here, and wait until the spindle is at speed.";
        lines.extend(brief.hooks(&options.before(), |name| format!("    {name};"), otherwise));
        lines.extend([
            "    ! To the start by joint motion: check that the way is clear.".into(),
            format!(
                "    MoveAbsJ [[{q1},{q2},{q3},{q4},{q5},{q6}],{}]\\NoEOffs,v100,fine,tMill\\WObj:=wPart;",
                self.external
            ),
        ]);
        let mut files = Vec::new();
        if let [whole] = parts {
            lines.extend_from_slice(whole);
        } else {
            for (index, part) in parts.iter().enumerate() {
                let module = brief.part(index);
                let path = format!("{module}.mod");
                lines.extend([
                    format!("    Load\\Dynamic,\"HOME:/{name}/{path}\";"),
                    format!("    %\"p{module}\"%;"),
                    format!("    UnLoad \"HOME:/{name}/{path}\";"),
                ]);
                let text = format!(
                    "MODULE m{module}\n  PROC p{module}()\n{}\n  ENDPROC\nENDMODULE\n",
                    part.join("\n")
                );
                files.push(PackageFile { path, text });
            }
        }
        let otherwise = "    ! Spindle and coolant: switch them off here.";
        lines.extend(brief.hooks(&options.after(), |name| format!("    {name};"), otherwise));
        lines.extend(["  ENDPROC", "ENDMODULE"].map(String::from));
        let main = PackageFile {
            path: format!("{name}.mod"),
            text: format!("MODULE {name}\n{}\n", lines.join("\n")),
        };
        let list = PackageFile {
            path: format!("{name}.pgf"),
            text: format!(
                "<?xml version=\"1.0\" encoding=\"ISO-8859-1\" ?>\n<Program>\n    <Module>{name}.mod</Module>\n</Program>\n"
            ),
        };
        files.splice(0..0, [main, list]);
        files
    }
}

/// Configuration of an arm with six axes in series, besides the quarter turns of axes 1, 4 and 6: 4
/// where the wrist is behind axis 1, 2 where it is behind the upper arm, 1 where axis 5 is negative.
fn cfx(posture: &Posture) -> u8 {
    4 * u8::from(posture.behind) + 2 * u8::from(!posture.bent_forward) + u8::from(posture.wrist_negative)
}

/// A frame as `[[x,y,z],[q1,q2,q3,q4]]`.
fn frame(pose: &Pose) -> String {
    let [x, y, z] = (pose.position / MM).map(|x| number(x, 5)).into();
    let [q1, q2, q3, q4] = quaternion(&pose.rotation).map(|q| number(q, 9));
    format!("[[{x},{y},{z}],[{q1},{q2},{q3},{q4}]]")
}
