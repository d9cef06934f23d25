//! The compensated path for Staubli controllers: a VAL3 application (s7 and later).
//!
//! A project (`.pjx`), its data (`.dtx`), the programs `start` and `stop`, and one program for each part if there are several.
//! Points are data in the frame `fPart`, which is in the world (on a Staubli arm at the height of axis
//! 2), the tool is `tMill`; lengths in mm, rx, ry, rz [deg] about x, the new y, the new z. There is a
//! motion descriptor for each speed: `mCut` leaves for the next point at a distance, `mStop` stops. The
//! first move is by joints; linear moves keep its configuration.
//!
//! The files follow projects that Staubli's own tools made and published posts; nothing has been tried
//! on a controller.

use super::robot::{Brief, Language, PackageFile, PostedMove};
use crate::export::header::number;
use crate::export::orientation::about_moving_xyz;
use crate::math::Pose;
use crate::units::{DEG, MM};
use std::fmt::Write;

const XML: &str = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n";
const INSTANCE: &str = "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\"";

/// VAL3.
pub(super) struct Val3 {
    /// The different speeds [m/s].
    speeds: Vec<f64>,
    /// Distance before the end of a move at which the next begins [mm].
    blend: f64,
    /// The points of each part.
    points: Vec<Vec<Pose>>,
}

impl Val3 {
    pub(super) fn new(brief: &Brief) -> Self {
        Self { speeds: brief.speeds(), blend: brief.command.blend / MM, points: Vec::new() }
    }

    /// Adds a point, and names it.
    fn point(&mut self, pose: &Pose) -> String {
        let part = self.points.len();
        let Some(points) = self.points.last_mut() else { return String::new() };
        points.push(*pose);
        format!("pPath{part}[{}]", points.len() - 1)
    }

    /// The data of the application.
    fn data(&self, brief: &Brief) -> String {
        let mut text = format!(
            "{XML}<Database {INSTANCE} xmlns=\"http://www.staubli.com/robotics/VAL3/Data/2\">\n  <Datas>\n"
        );
        let mut add = |name: &str, kind: &str, values: &[String]| {
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "    <Data name=\"{name}\" access=\"private\" xsi:type=\"array\" type=\"{kind}\" size=\"{}\">",
                values.len()
            );
            for (key, value) in values.iter().enumerate() {
                let _ = writeln!(text, "      <Value key=\"{key}\" {value} />");
            }
            text.push_str("    </Data>\n");
        };
        add("fPart", "frame", &[format!("{} fatherId=\"world[0]\"", attributes(&brief.base))]);
        add(
            "tMill",
            "tool",
            &[format!("{} fatherId=\"flange[0]\" ioLink=\"valve1\"", attributes(brief.tool))],
        );
        let joints = brief.start_deg().into_iter().enumerate();
        let joints: Vec<_> = joints.map(|(k, q)| format!("j{}=\"{}\"", k + 1, number(q, 5))).collect();
        add("jStart", "jointRx", &[joints.join(" ")]);
        add("mMove", "mdesc", &["accel=\"20\" vel=\"10\" decel=\"20\" blend=\"off\"".into()]);
        let descriptor = |speed: &f64, blend: &str| {
            let speed = number(speed / MM, 4);
            format!("accel=\"100\" vel=\"100\" decel=\"100\" tmax=\"{speed}\" rmax=\"99999\" {blend}")
        };
        let distance = number(self.blend, 4);
        let blended = match self.blend {
            0.0 => "blend=\"off\"".to_owned(),
            _ => format!("blend=\"Cartesian\" leave=\"{distance}\" reach=\"{distance}\""),
        };
        add(
            "mCut",
            "mdesc",
            &self.speeds.iter().map(|speed| descriptor(speed, &blended)).collect::<Vec<_>>(),
        );
        let stopped: Vec<_> = self.speeds.iter().map(|speed| descriptor(speed, "blend=\"off\"")).collect();
        add("mStop", "mdesc", &stopped);
        for (part, points) in self.points.iter().enumerate() {
            let points: Vec<_> =
                points.iter().map(|pose| format!("{} fatherId=\"fPart[0]\"", attributes(pose))).collect();
            add(&format!("pPath{}", part + 1), "pointRx", &points);
        }
        text + "  </Datas>\n</Database>\n"
    }
}

impl Language for Val3 {
    fn comment(&self, text: &str) -> String {
        // The end of a CDATA section has no place inside one.
        format!("  // {}", text.replace("]]", "] ]"))
    }

    fn wait(&self, time: f64) -> String {
        format!("  waitEndMove()\n  delay({})", number(time, 4))
    }

    fn begin(&mut self, _part: usize) {
        self.points.push(Vec::new());
    }

    fn move_to(&mut self, target: &PostedMove) -> String {
        let via = target.via.map(|via| self.point(&via));
        let to = self.point(&target.pose);
        let index = self.speeds.iter().position(|known| *known == target.speed).unwrap_or(0);
        let descriptor = if target.stops { "mStop" } else { "mCut" };
        match via {
            Some(via) => format!("  movec({via},{to},tMill,{descriptor}[{index}])"),
            None => format!("  movel({to},tMill,{descriptor}[{index}])"),
        }
    }

    fn files(&self, brief: &Brief, parts: &[Vec<String>]) -> Vec<PackageFile> {
        let options = brief.options;
        let name = &options.name;
        let mut lines: Vec<String> = brief.header.iter().map(|line| self.comment(line)).collect();
        let said = match &options.load {
            Some(load) => {
                let [x, y, z] = (load.centre / MM).map(|x| number(x, 3)).into();
                format!(
                    "Load of the flange: {} kg, centre at x {x} y {y} z {z} mm: enter it in the controller's arm settings",
                    number(load.mass, 4)
                )
            }
            None => {
                "The load is not known here: enter that of spindle, holder and tool in the controller".into()
            }
        };
        lines.push(self.comment(&said));
        if !options.stores_frames {
            let said = "Compare fPart and tMill with the controller's own: the figures are for the values in the data";
            lines.push(self.comment(said));
        }
        lines.push("  resetMotion()".into());
        let otherwise =
            "  // Spindle and coolant: switch them on here, and wait until the spindle is at speed";
        lines.extend(brief.hooks(&options.before(), |name| format!("  call {name}()"), otherwise));
        lines.extend(
            [
                "  // To the start by joint motion: check that the way is clear",
                "  movej(jStart,tMill,mMove)",
                "  waitEndMove()",
            ]
            .map(String::from),
        );
        let mut programs = Vec::new();
        if let [whole] = parts {
            lines.extend_from_slice(whole);
        } else {
            for (index, part) in parts.iter().enumerate() {
                let name = format!("mill_{:03}", index + 1);
                lines.push(format!("  call {name}()"));
                programs.push((name, part.clone()));
            }
        }
        lines.push("  waitEndMove()".into());
        let otherwise = "  // Spindle and coolant: switch them off here";
        lines.extend(brief.hooks(&options.after(), |name| format!("  call {name}()"), otherwise));
        // A call must lead to a program of the application: the cell's own go into these.
        for (_, name) in &options.hooks {
            if programs.iter().all(|(known, _)| known != name) {
                programs.push((name.clone(), vec![self.comment("Add the cell's own instructions here")]));
            }
        }
        programs
            .splice(0..0, [("start".to_owned(), lines), ("stop".to_owned(), vec!["  resetMotion()".into()])]);
        let listed: String =
            programs.iter().map(|(name, _)| format!("    <Program file=\"{name}.pgx\" />\n")).collect();
        let project = format!(
            "{XML}<Project xmlns=\"http://www.staubli.com/robotics/VAL3/Project/3\">\n  \
             <Parameters version=\"s7.3.1\" stackSize=\"5000\" millimeterUnit=\"true\" />\n  <Programs>\n{listed}  \
             </Programs>\n  <Database>\n    <Data file=\"{name}.dtx\" />\n  </Database>\n  <Libraries />\n</Project>\n"
        );
        let file = |name: &str, extension: &str, text: String| PackageFile {
            path: format!("{name}.{extension}"),
            text,
        };
        let mut files = vec![file(name, "pjx", project), file(name, "dtx", self.data(brief))];
        files.extend(programs.iter().map(|(name, lines)| file(name, "pgx", program(name, lines))));
        files
    }
}

/// A program as XML.
fn program(name: &str, lines: &[String]) -> String {
    format!(
        "{XML}<Programs {INSTANCE} xmlns=\"http://www.staubli.com/robotics/VAL3/Program/2\">\n  \
         <Program name=\"{name}\">\n    <Locals />\n    <Code><![CDATA[begin\n{}\nend]]></Code>\n  </Program>\n</Programs>\n",
        lines.join("\n")
    )
}

/// A frame's coordinates as XML attributes.
fn attributes(pose: &Pose) -> String {
    let [x, y, z] = (pose.position / MM).map(|x| number(x, 5)).into();
    let [rx, ry, rz] = about_moving_xyz(&pose.rotation).map(|angle| number(angle / DEG, 6));
    format!("x=\"{x}\" y=\"{y}\" z=\"{z}\" rx=\"{rx}\" ry=\"{ry}\" rz=\"{rz}\"")
}
