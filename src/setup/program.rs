//! What leaves: the controller that loads it, and how it is to be written.

use crate::error::Error;
use crate::job::{self, Choice, ControllerWord, FrameValues};
use crate::setup::reserved;
use crate::units::MM;
use nalgebra::Vector3;

/// A language that programs are written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Controller {
    /// KUKA's KRL.
    Kuka,
    /// ABB's RAPID.
    Abb,
    /// Staubli's VAL3.
    Staubli,
    /// FANUC's teach pendant language.
    Fanuc,
    /// G-code.
    Gcode,
    /// APT.
    Apt,
    /// A table of points.
    Csv,
}

impl Controller {
    /// Every controller, robots first.
    pub const ALL: [Self; 7] =
        [Self::Kuka, Self::Abb, Self::Staubli, Self::Fanuc, Self::Gcode, Self::Apt, Self::Csv];

    /// Its word in jobs.
    pub fn id(self) -> &'static str {
        match self {
            Self::Kuka => "kuka",
            Self::Abb => "abb",
            Self::Staubli => "staubli",
            Self::Fanuc => "fanuc",
            Self::Gcode => "gcode",
            Self::Apt => "apt",
            Self::Csv => "csv",
        }
    }

    /// The controller with this word.
    ///
    /// # Errors
    /// [`Error::Invalid`] with all words.
    pub fn named(id: &str) -> Result<Self, Error> {
        let all = || Self::ALL.iter().map(|controller| controller.id());
        Self::ALL
            .into_iter()
            .find(|controller| controller.id() == id)
            .ok_or_else(|| Error::unknown_name("controller", id, "there are", all()))
    }

    /// The controller of a robot's maker; G-code for others.
    fn of_maker(maker: Option<&str>) -> Self {
        match maker {
            Some("KUKA") => Self::Kuka,
            Some("ABB") => Self::Abb,
            Some("Stäubli") => Self::Staubli,
            Some("FANUC") => Self::Fanuc,
            _ => Self::Gcode,
        }
    }

    /// Refuses names and numbers that it does not take; a split program needs room for the numbers of
    /// its parts.
    ///
    /// # Errors
    /// [`Error::Invalid`] of the key of `program`.
    pub fn accepts(self, options: &ProgramOptions, split: bool) -> Result<(), Error> {
        let longest = self.longest_name();
        let numbers = if split { "p_000".len() } else { 0 };
        self.identifier("program.name", &options.name, longest - numbers)?;
        if matches!(self, Self::Gcode | Self::Apt | Self::Csv) {
            return Ok(());
        }
        for (field, name) in &options.hooks {
            self.identifier(field, name, longest)?;
            let taken = name.eq_ignore_ascii_case(&options.name)
                || options.part_prefixes(self).iter().any(|prefix| begins(name, prefix));
            if taken {
                let expected = "a name other than those of this program and its parts";
                return Err(Error::invalid(*field, format!("\"{name}\""), expected));
            }
        }
        let numbers = [
            ("program.tool_number", options.tool, 10),
            ("program.base_number", options.base, 9),
            ("program.load_number", options.load_number.unwrap_or(1), 10),
        ];
        for (field, number, most) in numbers {
            if self == Self::Fanuc && number > most {
                return Err(Error::invalid(field, number, format!("1 to {most} on a FANUC controller")));
            }
        }
        if self == Self::Staubli && !options.external.is_empty() {
            let expected = "none: points of a Staubli arm have no external axes";
            return Err(Error::invalid("program.external_axes", format!("{:?}", options.external), expected));
        }
        Ok(())
    }

    /// Refuses what is no name for it.
    fn identifier(self, field: &str, name: &str, longest: usize) -> Result<(), Error> {
        let legal = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let reserved = reserved::words(self).iter().any(|word| word.eq_ignore_ascii_case(name));
        let letter = name.starts_with(|c: char| c.is_ascii_alphabetic());
        if letter && name.chars().all(legal) && name.len() <= longest && !reserved {
            return Ok(());
        }
        let expected = match reserved {
            true => "a name that the controller does not reserve".to_owned(),
            false => format!(
                "it must be letters, digits and underscores, start with a letter and have at most {longest} characters"
            ),
        };
        Err(Error::invalid(field, format!("\"{name}\""), expected))
    }

    /// Longest name of a program that it takes [characters].
    fn longest_name(self) -> usize {
        match self {
            Self::Kuka => 24,
            Self::Abb => 30,
            Self::Staubli => 15,
            Self::Fanuc => 36,
            Self::Gcode | Self::Apt | Self::Csv => 60,
        }
    }
}

/// How a path leaves one move for the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Blending {
    /// At a distance that is sought: as large as the tolerance allows.
    Sought,
    /// At this distance before the end [m]; 0 is an exact stop.
    At(f64),
}

/// The load of the flange.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlangeLoad {
    /// Mass [kg].
    pub mass: f64,
    /// Centre of mass in the flange frame [m].
    pub centre: Vector3<f64>,
}

/// What leaves, and for which controller.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramOptions {
    /// The controller.
    pub controller: Controller,
    /// Name of the program.
    pub name: String,
    /// Number of the tool.
    pub tool: u32,
    /// Number of the base.
    pub base: u32,
    /// Number of the load, if it is given.
    pub load_number: Option<u32>,
    /// Whether the program stores the values of tool, base and load in the controller.
    pub stores_frames: bool,
    /// Load of the flange, if it is known.
    pub load: Option<FlangeLoad>,
    /// How moves are blended.
    pub blending: Blending,
    /// Points nearer to each other are merged [m].
    pub least_step: f64,
    /// Most lines of a file.
    pub lines: usize,
    /// Positions of external axes [mm or deg].
    pub external: Vec<f64>,
    /// Procedures of the cell that the job names, each with its key.
    pub hooks: Vec<(&'static str, String)>,
    /// The controller of the arm's maker, if that is one of these.
    pub of_arm: Option<Controller>,
}

/// Keys of the procedures that are called before the first cut; the others are called at the end.
const BEFORE: [&str; 2] = ["program.spindle_on", "program.coolant_on"];

impl ProgramOptions {
    /// Procedures that are called before the first cut.
    pub fn before(&self) -> Vec<&str> {
        let hooks = self.hooks.iter().filter(|(key, _)| BEFORE.contains(key));
        hooks.map(|(_, name)| name.as_str()).collect()
    }

    /// Procedures that are called at the end.
    pub fn after(&self) -> Vec<&str> {
        let hooks = self.hooks.iter().filter(|(key, _)| !BEFORE.contains(key));
        hooks.map(|(_, name)| name.as_str()).collect()
    }

    /// What the names of a split program's parts begin with, before their numbers.
    fn part_prefixes(&self, controller: Controller) -> Vec<String> {
        let name = &self.name;
        match controller {
            Controller::Kuka | Controller::Fanuc => vec![format!("{name}_")],
            Controller::Abb => vec![format!("m{name}_"), format!("p{name}_")],
            Controller::Staubli => vec!["mill_".into()],
            // These call nothing.
            Controller::Gcode | Controller::Apt | Controller::Csv => Vec::new(),
        }
    }
}

/// Whether a name is a prefix and digits.
fn begins(name: &str, prefix: &str) -> bool {
    let rest = name.get(prefix.len()..).filter(|_| name[..prefix.len()].eq_ignore_ascii_case(prefix));
    rest.is_some_and(|rest| !rest.is_empty() && rest.chars().all(|c| c.is_ascii_digit()))
}

/// Checks the section of a job for a robot of this maker.
pub(super) fn options(given: &job::RobotProgram, maker: Option<&str>) -> Result<ProgramOptions, Error> {
    let controller = match given.controller {
        ControllerWord::Brand => Controller::of_maker(maker),
        ControllerWord::Kuka => Controller::Kuka,
        ControllerWord::Abb => Controller::Abb,
        ControllerWord::Staubli => Controller::Staubli,
        ControllerWord::Fanuc => Controller::Fanuc,
        ControllerWord::Gcode => Controller::Gcode,
        ControllerWord::Apt => Controller::Apt,
        ControllerWord::Csv => Controller::Csv,
    };
    let external = given.external_axes.clone().unwrap_or_default();
    if external.len() > 6 || external.iter().any(|axis| axis.abs() > 1e5 || axis.is_nan()) {
        let expected = "up to six numbers from -100000 to 100000";
        return Err(Error::invalid("program.external_axes", format!("{external:?}"), expected));
    }
    let hooks = [
        ("program.spindle_on", &given.spindle_on),
        ("program.coolant_on", &given.coolant_on),
        ("program.spindle_off", &given.spindle_off),
        ("program.coolant_off", &given.coolant_off),
    ];
    let named = hooks.into_iter().filter(|(_, name)| !name.is_empty());
    let options = ProgramOptions {
        controller,
        name: given.name.clone(),
        tool: given.tool_number,
        base: given.base_number,
        load_number: given.load_number,
        stores_frames: given.frames == FrameValues::Values,
        load: match given.load_kg {
            Choice::Value(mass, _) => {
                Some(FlangeLoad { mass, centre: Vector3::from(given.load_centre_mm) * MM })
            }
            Choice::Word => None,
        },
        blending: match given.blending_mm {
            Choice::Value(distance, _) => Blending::At(distance * MM),
            Choice::Word => Blending::Sought,
        },
        least_step: given.least_step_mm * MM,
        lines: given.lines_per_file as usize,
        external,
        hooks: named.map(|(key, name)| (key, name.clone())).collect(),
        of_arm: maker.map(|maker| Controller::of_maker(Some(maker))),
    };
    controller.accepts(&options, false)?;
    Ok(options)
}
