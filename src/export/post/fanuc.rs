//! The compensated path for FANUC controllers: teach pendant programs in text form (`.LS`).
//!
//! `L` and `C` to each point in a user frame with a tool frame; lengths in mm, W, P, R [deg] about the
//! fixed x, y and z axes. The frames are stored by way of a position register, or used as they are;
//! positions count from the controller's world, at the height of axis 2 on a FANUC arm. `FINE` stops at a
//! point; `CNT` passes it at a share of the speed. The first move is by joints, and every point has the
//! configuration simulated.
//!
//! The layout follows listings that controllers and ROBOGUIDE wrote, the letters of CONFIG 16 public
//! poses; nothing has been tried on a controller.

use super::robot::{Brief, Language, PackageFile, PostedMove};
use crate::export::header::{self, number};
use crate::export::orientation::roll_pitch_yaw;
use crate::export::posture::{Posture, turns};
use crate::math::Pose;
use crate::robot::{Joints, Robot};
use crate::units::{DEG, MM};
use std::fmt::Write;

/// Longest remark [characters].
const REMARK: usize = 32;
/// Position register by which frames are stored.
const REGISTER: usize = 99;

/// FANUC's teach pendant language.
pub(super) struct Fanuc<'r> {
    robot: &'r Robot,
    /// Numbers of user frame and tool frame.
    frames: (u32, u32),
    /// Share of the speed at which points are passed [%]; 0 stops.
    share: f64,
    external: Vec<f64>,
    /// The points of each part, as they are listed.
    points: Vec<Vec<String>>,
}

impl<'r> Fanuc<'r> {
    pub(super) fn new(brief: &Brief<'r>) -> Self {
        let options = brief.options;
        Self {
            robot: &brief.report.plan.robot,
            frames: (options.base, options.tool),
            share: (brief.command.blend * 100.0).round(),
            external: options.external.clone(),
            points: Vec::new(),
        }
    }

    /// Adds a point of the path, and numbers it.
    fn point(&mut self, pose: &Pose, q: &Joints) -> usize {
        let text = cartesian(self.frames, &configuration(self.robot, q), pose, &self.external);
        let Some(points) = self.points.last_mut() else { return 0 };
        points.push(text);
        points.len()
    }

    /// The frames' values: stored by a register, or for comparison.
    fn store(&self, brief: &Brief, points: &mut Vec<String>) -> Vec<String> {
        let (base, tool) = self.frames;
        if !brief.options.stores_frames {
            let said = ["Compare user frame and tool frame with the values above"].map(String::from);
            return header::wrapped(&said, REMARK).iter().map(|line| self.comment(line)).collect();
        }
        let mut lines = vec![self.comment(&format!("PR[{REGISTER}] is overwritten"))];
        for (word, number, frame) in [("UTOOL", tool, brief.tool), ("UFRAME", base, &brief.base)] {
            let configuration = configuration(self.robot, &brief.start);
            points.push(cartesian((0, tool), &configuration, frame, &self.external));
            lines.extend([
                format!("  PR[{REGISTER}]=P[{}]    ;", points.len()),
                format!("  {word}[{number}]=PR[{REGISTER}] ;"),
            ]);
        }
        lines
    }

    /// The selection of both frames.
    fn selection(&self) -> [String; 2] {
        [format!("  UFRAME_NUM={} ;", self.frames.0), format!("  UTOOL_NUM={} ;", self.frames.1)]
    }
}

impl Language for Fanuc<'_> {
    fn comment(&self, text: &str) -> String {
        // A semicolon ends the line.
        let text: String = text.chars().filter(|c| *c != ';').take(REMARK).collect();
        format!("  !{text} ;")
    }

    fn wait(&self, time: f64) -> String {
        format!("  WAIT {:>6}(sec) ;", plain(time, 2))
    }

    fn begin(&mut self, _part: usize) {
        self.points.push(Vec::new());
    }

    fn move_to(&mut self, target: &PostedMove) -> String {
        let via = target.via.map(|via| self.point(&via, target.via_joints));
        let to = self.point(&target.pose, target.joints);
        let end =
            if target.stops || self.share == 0.0 { "FINE".into() } else { format!("CNT{}", self.share) };
        let speed = speed(target.speed);
        match via {
            Some(via) => format!("C P[{via}]    \n    :  P[{to}] {speed} {end}    ;"),
            None => format!("L P[{to}] {speed} {end}    ;"),
        }
    }

    fn files(&self, brief: &Brief, parts: &[Vec<String>]) -> Vec<PackageFile> {
        let options = brief.options;
        let name = options.name.to_ascii_uppercase();
        let mut files = Vec::new();
        // With a single part, its points come first and keep their numbers.
        let mut points = if let [_] = parts { self.points[0].clone() } else { Vec::new() };
        let mut lines: Vec<String> =
            header::wrapped(&brief.header, REMARK).iter().map(|line| self.comment(line)).collect();
        lines.extend(self.store(brief, &mut points));
        lines.extend(self.selection());
        let schedule = options.load_number.unwrap_or(1);
        let payload = match &options.load {
            Some(load) => format!("Payload {}: {} kg", schedule, number(load.mass, 3)),
            None => format!("Payload {} must be set", schedule),
        };
        lines.extend([self.comment(&payload), format!("  PAYLOAD[{}] ;", schedule)]);
        let call = |name: &str| format!("  CALL {}    ;", name.to_ascii_uppercase());
        let on = [self.comment("Switch spindle and coolant on,"), self.comment("wait until it is at speed")]
            .join("\n");
        lines.extend(brief.hooks(&options.before(), call, &on));
        lines.extend([
            self.comment("To the start by joint motion:"),
            self.comment("check that the way is clear"),
        ]);
        points.push(by_joints(self.frames, &brief.start_deg(), &self.external));
        lines.push(format!("J P[{}] 10% FINE    ;", points.len()));
        if let [whole] = parts {
            lines.extend_from_slice(whole);
        } else {
            for (index, part) in parts.iter().enumerate() {
                let part_name = brief.part(index).to_ascii_uppercase();
                lines.push(call(&part_name));
                let all: Vec<String> = self.selection().into_iter().chain(part.iter().cloned()).collect();
                files.push(file(&part_name, &all, &self.points[index]));
            }
        }
        lines.extend(brief.hooks(&options.after(), call, &self.comment("Switch spindle and coolant off")));
        files.insert(0, file(&name, &lines, &points));
        files
    }
}

/// A program.
fn file(name: &str, lines: &[String], points: &[String]) -> PackageFile {
    // The second line of a circular move is not counted, nor numbered.
    let lines: Vec<&str> = lines.iter().flat_map(|line| line.split('\n')).collect();
    let continues = |line: &str| line.starts_with("    :");
    let count = lines.iter().filter(|line| !continues(line)).count();
    let mut text = format!(
        "/PROG  {name}\n/ATTR\nOWNER\t\t= MNEDITOR;\nCOMMENT\t\t= \"Armill {}\";\nPROG_SIZE\t= 0;\n\
         CREATE\t\t= DATE 26-01-01  TIME 00:00:00;\nMODIFIED\t= DATE 26-01-01  TIME 00:00:00;\nFILE_NAME\t= ;\n\
         VERSION\t\t= 0;\nLINE_COUNT\t= {count};\nMEMORY_SIZE\t= 0;\nPROTECT\t\t= READ_WRITE;\n\
         TCD:  STACK_SIZE\t= 0,\n      TASK_PRIORITY\t= 50,\n      TIME_SLICE\t= 0,\n      BUSY_LAMP_OFF\t= 0,\n      \
         ABORT_REQUEST\t= 0,\n      PAUSE_REQUEST\t= 0;\nDEFAULT_GROUP\t= 1,*,*,*,*;\n\
         CONTROL_CODE\t= 00000000 00000000;\n/MN\n",
        env!("CARGO_PKG_VERSION"),
    );
    let mut number = 0;
    for line in lines {
        // Writing to a string cannot fail.
        if continues(line) {
            let _ = writeln!(text, "{line}");
        } else {
            number += 1;
            let _ = writeln!(text, "{number:4}:{line}");
        }
    }
    text.push_str("/POS\n");
    for (index, point) in points.iter().enumerate() {
        let _ = writeln!(text, "P[{}]{{\n   GP1:\n{point}\n}};", index + 1);
    }
    text.push_str("/END\n");
    PackageFile { path: format!("{name}.LS"), text }
}

/// A speed [m/s]: whole mm/s, or tenths below 10.
fn speed(speed: f64) -> String {
    let mm = speed / MM;
    format!("{}mm/sec", plain(mm, usize::from(mm < 9.95)))
}

/// A number as listings show it: without a zero before the point.
fn plain(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    text.strip_prefix("0.").map_or(text.clone(), |rest| format!(".{rest}"))
}

/// A coordinate as positions list it, and no zero with a sign.
fn listed(value: f64) -> String {
    format!("{:9.3}", (value * 1000.0).round() / 1000.0 + 0.0)
}

/// A point by its pose in the frames `frames` (user, tool).
fn cartesian(frames: (u32, u32), configuration: &str, pose: &Pose, external: &[f64]) -> String {
    let [x, y, z] = (pose.position / MM).map(listed).into();
    let [w, p, r] = roll_pitch_yaw(&pose.rotation).map(|angle| listed(angle / DEG));
    format!(
        "\tUF : {}, UT : {},\t\tCONFIG : '{configuration}',\n\tX = {x}  mm,\tY = {y}  mm,\tZ = {z}  mm,\n\t\
         W = {w} deg,\tP = {p} deg,\tR = {r} deg{}",
        frames.0,
        frames.1,
        further(external)
    )
}

/// A point by its joint values [deg].
fn by_joints(frames: (u32, u32), q: &[f64; 6], external: &[f64]) -> String {
    let joint = |k: usize| format!("J{}= {} deg", k + 1, listed(q[k]));
    format!(
        "\tUF : {}, UT : {},\t\t\n\t{},\t{},\t{},\n\t{},\t{},\t{}{}",
        frames.0,
        frames.1,
        joint(0),
        joint(1),
        joint(2),
        joint(3),
        joint(4),
        joint(5),
        further(external)
    )
}

/// External axes of a point.
fn further(external: &[f64]) -> String {
    let axes = external.iter().enumerate();
    axes.map(|(k, axis)| format!(",\n\tE{}= {}  mm", k + 1, listed(*axis))).collect()
}

/// CONFIG of the joint values `q` [rad]: wrist flipped (joint 5 positive) or not, elbow up or down,
/// wrist centre in front of axis 1 or behind, and the turns of joints 1, 4 and 6.
fn configuration(robot: &Robot, q: &Joints) -> String {
    let posture = Posture::of(robot, q);
    let letter = |is: bool, yes: char, no: char| if is { yes } else { no };
    let [j1, j4, j6] = [0, 3, 5].map(|axis| turns((q[axis] / DEG * 1000.0).round() / 1000.0));
    format!(
        "{} {} {}, {j1}, {j4}, {j6}",
        letter(posture.wrist_negative, 'N', 'F'),
        letter(posture.bent_forward, 'U', 'D'),
        letter(posture.behind, 'B', 'T')
    )
}
