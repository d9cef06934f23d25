//! The compensated path for KUKA controllers: KRL modules, each a `.src`, and the main one's `.dat`.
//!
//! `LIN` and `CIRC` in `$BASE`, with `$TOOL` at the tip; lengths in mm, A, B, C [deg] about z, the new
//! y, the new x; `$VEL.CP` in m/s. Moves are blended by `C_DIS` from `$APO.CDIS` before their ends;
//! without it the controller stops exactly there. The first move is by axes.
//!
//! The layout of modules, `BAS(#INITMOV,0)` and what it resets (base, tool, speeds: everything else
//! comes after it), the number of characters of a name, the use of `TOOL_DATA`, `BASE_DATA` and
//! `LOAD_DATA` follow published programs of KSS 8 and KUKA's own `bas.src`; nothing has been tried on a
//! controller.

use super::robot::{Brief, Language, PackageFile, PostedMove};
use crate::export::header::number;
use crate::export::orientation::roll_pitch_yaw;
use crate::export::posture::Posture;
use crate::math::Pose;
use crate::robot::Joints;
use crate::setup::ProgramOptions;
use crate::units::{DEG, MM};

/// KRL.
pub(super) struct Krl {
    /// Distance before the end of a move at which the next begins [mm].
    blend: f64,
    /// Positions of external axes, as the end of every point.
    external: String,
}

impl Krl {
    pub(super) fn new(brief: &Brief) -> Self {
        let axes = brief.options.external.iter().enumerate();
        let external = axes.map(|(k, axis)| format!(",E{} {}", k + 1, number(*axis, 4))).collect();
        Self { blend: brief.command.blend / MM, external }
    }

    /// A point of the path as an aggregate.
    fn point(&self, pose: &Pose) -> String {
        format!("{{{}{}}}", coordinates(pose), self.external)
    }

    /// The main program up to the first point.
    fn opening(&self, brief: &Brief) -> Vec<String> {
        let Brief { options, report, .. } = brief;
        let mut lines: Vec<String> = brief.header.iter().map(|line| self.comment(line)).collect();
        lines.extend(
            [
                ";FOLD INI",
                ";FOLD BASISTECH INI",
                "GLOBAL INTERRUPT DECL 3 WHEN $STOPMESS==TRUE DO IR_STOPM ( )",
                "INTERRUPT ON 3",
                "BAS (#INITMOV,0 )",
                ";ENDFOLD (BASISTECH INI)",
                ";ENDFOLD (INI)",
            ]
            .map(String::from),
        );
        lines.extend(self.frames(brief));
        lines.extend([format!("BAS (#TOOL,{})", options.tool), format!("BAS (#BASE,{})", options.base)]);
        if options.load.is_some() || !options.stores_frames {
            lines.push(format!("$LOAD=LOAD_DATA[{}]", load_number(options)));
        }
        lines.extend(
            ["$IPO_MODE=#BASE", "$ORI_TYPE=#VAR", "$CIRC_TYPE=#BASE", "$ADVANCE=5"].map(String::from),
        );
        lines.extend(["BAS (#VEL_PTP,10)", "BAS (#ACC_PTP,20)"].map(String::from));
        lines.extend([
            format!("$ACC.CP={}", number(report.setup().limits.acceleration, 7)),
            "$VEL.ORI1=200.0".into(),
            "$VEL.ORI2=200.0".into(),
            "$ACC.ORI1=100.0".into(),
            "$ACC.ORI2=100.0".into(),
            format!("$APO.CDIS={}", number(self.blend, 4)),
        ]);
        let otherwise = "; Spindle and coolant: switch them on here, and wait until the spindle is at speed.";
        lines.extend(brief.hooks(&options.before(), |name| format!("{name}()"), otherwise));
        let axes = brief
            .start_deg()
            .iter()
            .enumerate()
            .map(|(k, q)| format!("A{} {}", k + 1, number(*q, 5)))
            .collect::<Vec<_>>();
        let start = brief.command.pose(&brief.command.start);
        lines.extend([
            "PTP $AXIS_ACT".into(),
            "; To the start by joint motion: check that the way is clear.".into(),
            format!("PTP {{{}{}}}", axes.join(","), self.external),
            format!(
                "; In the base that is {{{},S {},T {}}}",
                coordinates(&start),
                status(&Posture::of(&report.plan.robot, &brief.start)),
                turn(&brief.start)
            ),
        ]);
        lines
    }

    /// The values of tool, load and base: stored, or for comparison.
    fn frames(&self, brief: &Brief) -> Vec<String> {
        let options = brief.options;
        let mut values = vec![
            format!("TOOL_DATA[{}]={{{}}}", options.tool, coordinates(brief.tool)),
            format!("BASE_DATA[{}]={{{}}}", options.base, coordinates(&brief.base)),
        ];
        if let Some(load) = &options.load {
            let [x, y, z] = (load.centre / MM).map(|x| number(x, 3)).into();
            values.push(format!(
                "LOAD_DATA[{}]={{M {},CM {{X {x},Y {y},Z {z},A 0.0,B 0.0,C 0.0}},J {{X 0.0,Y 0.0,Z 0.0}}}}",
                load_number(options),
                number(load.mass, 4)
            ));
        }
        let said = match options.stores_frames {
            true => "; These lines store tool and base in the controller.",
            false => "; Compare tool and base with the controller's own: the figures are for these values.",
        };
        let mut lines = vec![said.to_owned()];
        if options.load.is_none() {
            lines.push(format!(
                "; The load is not known here: LOAD_DATA[{}] must be that of spindle, holder and tool.",
                load_number(options)
            ));
        }
        let stored = |value: String| if options.stores_frames { value } else { self.comment(&value) };
        lines.extend(values.into_iter().map(stored));
        lines
    }
}

impl Language for Krl {
    fn comment(&self, text: &str) -> String {
        format!("; {text}")
    }

    fn wait(&self, time: f64) -> String {
        format!("WAIT SEC {}", number(time, 4))
    }

    fn speed(&mut self, speed: f64) -> Option<String> {
        Some(format!("$VEL.CP={}", number(speed, 7)))
    }

    fn move_to(&mut self, target: &PostedMove) -> String {
        let blended = if target.stops || self.blend == 0.0 { "" } else { " C_DIS" };
        let to = self.point(&target.pose);
        match &target.via {
            Some(via) => format!("CIRC {},{to}{blended}", self.point(via)),
            None => format!("LIN {to}{blended}"),
        }
    }

    fn files(&self, brief: &Brief, parts: &[Vec<String>]) -> Vec<PackageFile> {
        let name = &brief.options.name;
        let module = |name: &str, lines: Vec<String>| PackageFile {
            path: format!("{name}.src"),
            text: format!("&ACCESS RVP\n&REL 1\nDEF {name}()\n{}\nEND\n", lines.join("\n")),
        };
        let mut main = self.opening(brief);
        let mut subs = Vec::new();
        if let [whole] = parts {
            main.extend_from_slice(whole);
        } else {
            for (index, lines) in parts.iter().enumerate() {
                main.push(format!("{}()", brief.part(index)));
                subs.push(module(&brief.part(index), lines.clone()));
            }
        }
        let otherwise = "; Spindle and coolant: switch them off here.";
        main.extend(brief.hooks(&brief.options.after(), |name| format!("{name}()"), otherwise));
        let mut files = vec![module(name, main), data(name, brief, parts.len())];
        files.extend(subs);
        files
    }
}

/// Number of the load data: that of the tool unless it is given.
fn load_number(options: &ProgramOptions) -> u32 {
    options.load_number.unwrap_or(options.tool)
}

/// The main module's data list.
fn data(name: &str, brief: &Brief, parts: usize) -> PackageFile {
    let mut text = format!("&ACCESS RVP\n&REL 1\nDEFDAT {name}\n");
    text.push_str("EXT BAS (BAS_COMMAND :IN,REAL :IN )\nDECL INT SUCCESS\n");
    for index in (0..parts).filter(|_| parts > 1) {
        text.push_str(&format!("EXT {}()\n", brief.part(index)));
    }
    text.push_str("ENDDAT\n");
    PackageFile { path: format!("{name}.dat"), text }
}

/// A frame's coordinates as in an aggregate.
fn coordinates(pose: &Pose) -> String {
    let [x, y, z] = (pose.position / MM).map(|x| number(x, 5)).into();
    let [c, b, a] = roll_pitch_yaw(&pose.rotation).map(|angle| number(angle / DEG, 6));
    format!("X {x},Y {y},Z {z},A {a},B {b},C {c}")
}

/// Status of a posture: bit 0 where the wrist is behind axis 1, bit 1 where it is in front of the line
/// through axes 2 and 3, bit 2 where axis 5 is negative.
fn status(posture: &Posture) -> u8 {
    u8::from(posture.behind) + 2 * u8::from(posture.bent_forward) + 4 * u8::from(posture.wrist_negative)
}

/// Turn of an arm: a bit for each axis at a negative angle.
fn turn(q: &Joints) -> u8 {
    (0..6).filter(|&axis| q[axis] < 0.0).map(|axis| 1 << axis).sum()
}
