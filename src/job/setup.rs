//! From the job's keys to the validated model in SI.

use crate::compensation::Goal;
use crate::cutting::along::ChipLoad;
use crate::cutting::{Bending, Cut};
use crate::deviation::Sources;
use crate::error::Error;
use crate::job::cut::Stock;
use crate::job::{
    Choice, Elbow, Frame, Job, Joint3, Opw, Shaper, ShaperSpec, Shoulder, Source, SpinMode, Wrist, fields,
};
use crate::math::Pose;
use crate::motion::joints::StartBranch;
#[cfg(feature = "full")]
use crate::motion::spin::{self, Freedom};
use crate::motion::trajectory::Tempo;
use crate::motion::{self, shaper};
use crate::path::{self, Listing, Path};
use crate::robot::{self, Link, Robot, library};
use crate::units::{DEG, HZ, KILOWATT, MM, RPM};
use nalgebra::Vector3;

/// Most samples a job may have; a 1 ms trajectory of half an hour.
const MAX_SAMPLES: f64 = 2e6;

/// The question in SI, checked: what the pipeline starts from.
#[derive(Debug, Clone)]
pub struct Setup {
    /// The arm with its tool.
    pub robot: Robot,
    /// Where its compliance comes from and how far to trust it.
    pub stiffness_note: String,
    /// Whether its compliance is only an order of magnitude.
    pub stiffness_assumed: bool,
    /// The desired path in the base frame.
    pub path: Path,
    /// The robot's base in the cell, whose z axis points up.
    pub base: Pose,
    /// The workpiece in the base frame.
    pub workpiece: Pose,
    /// The program that the path was read from, if it was not drawn from a shape.
    pub listing: Option<Listing>,
    /// Range and goal of the spin, if it is free; until it is chosen, the path has the fixed one.
    #[cfg(feature = "full")]
    pub freedom: Option<Freedom>,
    /// The fixed spin [rad]; what a free one is compared with.
    pub spin: f64,
    /// How the path is travelled.
    pub tempo: Tempo,
    /// The shaper of the joint commands.
    pub shaper: motion::Shaper,
    /// Undamped natural frequency [rad/s] and damping ratio of the mode it is made for; `None` without a shaper.
    pub mode: Option<(f64, f64)>,
    /// The cut.
    pub cut: Cut,
    /// What is cut, and how its coefficients were made.
    pub stock: Stock,
    /// Normal rake of the tool [rad].
    pub rake: f64,
    /// How the tool bends, if it does.
    pub bending: Option<Bending>,
    /// What the spindle can give [W], if it is known.
    pub spindle_power: Option<f64>,
    /// What sets the chip.
    pub chip: ChipLoad,
    /// Teeth that pass in a second [1/s].
    pub teeth_per_second: f64,
    /// Branch at the start.
    pub start: StartBranch,
    /// When compensation stops.
    pub goal: Goal,
    /// What is compensated.
    pub sources: Sources,
}

impl Job {
    /// Checks the job and turns it into SI.
    ///
    /// # Errors
    /// The first thing that is not legal, with its field, value and what would be legal.
    pub fn setup(&self) -> Result<Setup, Error> {
        self.setup_with(|_| {})
    }

    /// The same; `on_read` hears now and then which share of a program is read.
    ///
    /// # Errors
    /// See [`Job::setup`].
    pub fn setup_with(&self, on_read: impl FnMut(f64)) -> Result<Setup, Error> {
        if self.version != 1 {
            return Err(invalid("version", self.version, "this Armill reads version 1"));
        }
        fields::check_ranges(self)?;
        let (robot, stiffness_note, stiffness_assumed) = self.arm()?;
        let robot = robot.with_tool(frame(&self.tool_frame));
        let base = frame(&self.base_frame);
        let burden = self.burden(robot.compliance(), &base)?;
        let robot = burden.into_iter().fold(robot, Robot::with_statics);
        let workpiece = base.inverse().compose(&frame(&self.workpiece_frame));
        let (path, listing) = self.desired_path(on_read)?;
        let spin = self.spin.angle_deg * DEG;
        let path = path.placed(&workpiece).with_spin(path::Spin::fixed(spin));
        #[cfg(not(feature = "full"))]
        if self.spin.mode == SpinMode::Free {
            return Err(Error::NeedsFull { what: "choosing the spin" });
        }
        #[cfg(feature = "full")]
        let freedom = self.freedom()?;
        let (shaper, mode) = self.input_shaper()?;
        let (cut, stock) = self.cut()?;
        let bending = self.bending()?;
        let spindle_power = match self.cutting.spindle_power_kw {
            Some(Choice::Value(power, _)) => Some(power * KILOWATT),
            _ => None,
        };
        let teeth_per_second = self.cutting.spindle_rpm * RPM * f64::from(self.tool.flutes);
        let chip = self.chip_load();
        let motion = &self.motion;
        let tempo = Tempo {
            feed: motion.feed_mm_s * MM,
            rapid: motion.rapid_mm_s * MM,
            acceleration: motion.acceleration_mm_s2 * MM,
            sample_time: motion.sample_time_s,
            corner_angle: motion.corner_angle_deg * DEG,
            corner_dwell: match motion.corner_dwell {
                Choice::Value(dwell, _) => dwell,
                Choice::Word if shaper.duration() > 0.0 => shaper.duration() + 2.0 * motion.sample_time_s,
                Choice::Word => 0.0,
            },
            settle: shaper.duration(),
        };
        let samples = motion::Trajectory::count(&path, &tempo);
        if samples > MAX_SAMPLES {
            let shortest = motion.sample_time_s * samples / MAX_SAMPLES;
            let expected = format!(
                "the path would take {samples:.0} samples, at most {MAX_SAMPLES:.0} are computed: from {shortest:.4} s on"
            );
            return Err(invalid("motion.sample_time_s", motion.sample_time_s, expected));
        }
        let start = StartBranch {
            front: self.start_branch.shoulder == Shoulder::Front,
            elbow_positive: self.start_branch.elbow == Elbow::Positive,
            wrist_near: self.start_branch.wrist == Wrist::Near,
        };
        let compensation = &self.compensation;
        let goal =
            Goal { tolerance: compensation.tolerance_mm * MM, max_passes: compensation.max_passes as usize };
        let has = |source| compensation.sources.contains(&source);
        if compensation.sources.len() > 2
            || (compensation.sources.len() == 2 && !(has(Source::Deflection) && has(Source::Shaping)))
        {
            return Err(invalid(
                "compensation.sources",
                "a list with a source twice",
                "name each of deflection and shaping once at most",
            ));
        }
        let sources = Sources { deflection: has(Source::Deflection), shaping: has(Source::Shaping) };
        Ok(Setup {
            robot,
            stiffness_note,
            stiffness_assumed,
            path,
            base,
            workpiece,
            listing,
            #[cfg(feature = "full")]
            freedom,
            spin,
            tempo,
            shaper,
            mode,
            cut,
            stock,
            rake: self.tool.rake_deg.unwrap_or(0.0) * DEG,
            bending,
            spindle_power,
            chip,
            teeth_per_second,
            start,
            goal,
            sources,
        })
    }

    /// The arm with its tool, whatever it is to do.
    ///
    /// # Errors
    /// What is wrong with the robot.
    pub fn robot(&self) -> Result<Robot, Error> {
        Ok(self.arm()?.0.with_tool(frame(&self.tool_frame)))
    }

    /// The arm without its tool; where its compliance comes from, and whether that is only an order of magnitude.
    fn arm(&self) -> Result<(Robot, String, bool), Error> {
        let given = &self.robot;
        let forms = [given.preset.is_some(), given.modified_dh.is_some(), given.opw.is_some()];
        if forms.into_iter().filter(|form| *form).count() > 1 {
            let field = if forms[0] { "robot.preset" } else { "robot.opw" };
            return Err(invalid(
                field,
                "given together with another form",
                "give one of preset, modified_dh and opw",
            ));
        }
        let mut library_note = None;
        let mut elbow = robot::Elbow::Serial;
        let (name, links, limits, compliance) = if let Some(id) = &given.preset {
            let preset = library::robot(id)?;
            elbow = preset.elbow;
            library_note = Some((preset.stiffness_note.clone(), preset.stiffness_assumed));
            (preset.name(), preset.links(), preset.limits(), Some(preset.joint_compliance))
        } else if let Some(rows) = given.modified_dh {
            Error::unless_full("a table of links")?;
            let links = rows.map(|row| Link {
                alpha: row.alpha_deg * DEG,
                a: row.a_mm * MM,
                d: row.d_mm * MM,
                theta_offset: row.theta_offset_deg * DEG,
                sign: row.joint_sign,
            });
            (String::new(), links, None, None)
        } else if let Some(opw) = &given.opw {
            Error::unless_full("ortho-parallel parameters")?;
            (String::new(), ortho_parallel(opw)?.links(), None, None)
        } else {
            return Err(missing("robot.preset", "name a preset, or give modified_dh or opw"));
        };
        let limits =
            given.joint_limits_deg.map(|ranges| ranges.map(|[low, high]| (low * DEG, high * DEG))).or(limits);
        let compliance = given.joint_compliance_rad_per_nm.or(compliance).ok_or_else(|| {
            missing("robot.joint_compliance_rad_per_nm", "six compliances, 0 for a rigid joint")
        })?;
        let (note, assumed) = match (given.joint_compliance_rad_per_nm, library_note) {
            (None, Some(note)) => note,
            _ => ("Joint stiffness: as given in the job.".into(), false),
        };
        let robot = Robot::new(given.name.clone().unwrap_or(name), links, limits, compliance)?;
        let elbow = match given.joint_3 {
            Some(Joint3::Serial) => robot::Elbow::Serial,
            Some(Joint3::Pendant) => robot::Elbow::Pendant,
            Some(Joint3::Parallelogram) => robot::Elbow::Parallelogram,
            None => elbow,
        };
        Ok((robot.with_elbow(elbow)?, note, assumed))
    }

    #[cfg(feature = "full")]
    fn freedom(&self) -> Result<Option<Freedom>, Error> {
        let crate::job::Spin { mode, range_deg: [low, high], goal, .. } = self.spin;
        if mode == SpinMode::Fixed {
            return Ok(None);
        }
        if low > high {
            return Err(invalid(
                "spin.range_deg",
                format!("[{low}, {high}]"),
                "the smallest angle comes first",
            ));
        }
        let goal = match goal {
            crate::job::SpinGoal::SmoothJoints => spin::Goal::SmoothJoints,
            crate::job::SpinGoal::LeastError => spin::Goal::LeastError,
        };
        Ok(Some(Freedom { low: low * DEG, high: high * DEG, goal }))
    }

    fn input_shaper(&self) -> Result<(motion::Shaper, Option<(f64, f64)>), Error> {
        let Shaper::Spec(ShaperSpec { kind, frequency_rad_s, frequency_hz, damping }) = self.shaper else {
            return Ok((motion::Shaper::none(), None));
        };
        let frequency = match (frequency_rad_s, frequency_hz) {
            (Some(rad_s), None) => rad_s,
            (None, Some(hz)) => hz * HZ,
            (None, None) => return Err(missing("shaper.frequency_rad_s", "or frequency_hz: one of the two")),
            (Some(_), Some(_)) => {
                return Err(invalid(
                    "shaper.frequency_hz",
                    "given together with frequency_rad_s",
                    "give one of the two",
                ));
            }
        };
        let kind = shaper::kind(kind.word()).ok_or_else(|| missing("shaper.kind", "a kind of shaper"))?;
        if damping > kind.damping_max {
            let field = "shaper.damping".into();
            return Err(Error::OutOfRange {
                field,
                value: damping,
                min: 0.0,
                max: kind.damping_max,
                unit: "",
            });
        }
        Ok((motion::Shaper::new(kind, frequency, damping), Some((frequency, damping))))
    }
}

/// The parameters, checked for what a table of links could not name.
fn ortho_parallel(given: &Opw) -> Result<robot::Opw, Error> {
    let Opw { a1_mm, a2_mm, b_mm, c1_mm, c2_mm, c3_mm, c4_mm, joint_sign, joint_offset_deg } = *given;
    if let Some(i) = joint_sign.iter().position(|sign| sign.abs() != 1.0) {
        let field = format!("robot.opw.joint_sign[{i}]");
        return Err(invalid(&field, joint_sign[i], "a joint turns one way or the other: 1 or -1"));
    }
    for (key, length) in [("c2_mm", c2_mm), ("c3_mm", c3_mm)] {
        if length < 0.001 {
            return Err(invalid(&format!("robot.opw.{key}"), length, "upper arm and forearm need a length"));
        }
    }
    let lengths_mm = [a1_mm, a2_mm, b_mm, c1_mm, c2_mm, c3_mm, c4_mm];
    Ok(robot::Opw { lengths_mm, joint_sign, joint_offset_deg })
}

fn frame(given: &Frame) -> Pose {
    Pose::from_xyz_rpy(Vector3::from(given.xyz_mm) * MM, given.rpy_deg.map(|angle| angle * DEG))
}

pub(super) fn invalid(field: &str, value: impl ToString, expected: impl Into<String>) -> Error {
    Error::Invalid { field: field.into(), value: value.to_string(), expected: expected.into() }
}

pub(super) fn missing(field: &str, expected: &str) -> Error {
    Error::Missing { field: field.into(), expected: expected.into() }
}

pub(super) fn unknown_preset<'a>(field: &str, id: &str, known: impl Iterator<Item = &'a str>) -> Error {
    invalid(field, format!("\"{id}\""), format!("the library has {}", known.collect::<Vec<_>>().join(", ")))
}
