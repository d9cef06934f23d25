//! What leaves: the controller that loads it, and how it is to be written.

use crate::error::Error;
use crate::job::{self, Choice, ControllerWord, FrameValues};
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

    /// Refuses a name that it does not take, with room for the numbers of parts if it is split.
    ///
    /// # Errors
    /// [`Error::Invalid`] of `program.name`.
    pub fn accepts(self, name: &str, split: bool) -> Result<(), Error> {
        let numbers = if split { "p_000".len() } else { 0 };
        identifier("program.name", name, self.longest_name() - numbers)
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
    /// Number of the load.
    pub load_number: u32,
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
    /// Procedures that are called before the first cut.
    pub before: Vec<String>,
    /// Procedures that are called at the end.
    pub after: Vec<String>,
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
    controller.accepts(&given.name, false)?;
    let hooks = [
        ("program.spindle_on", &given.spindle_on),
        ("program.spindle_off", &given.spindle_off),
        ("program.coolant_on", &given.coolant_on),
        ("program.coolant_off", &given.coolant_off),
    ];
    for (field, name) in hooks {
        if !name.is_empty() {
            identifier(field, name, controller.longest_name())?;
        }
    }
    let external = given.external_axes.clone().unwrap_or_default();
    if external.len() > 6 || external.iter().any(|axis| !axis.is_finite()) {
        return Err(Error::invalid("program.external_axes", format!("{external:?}"), "up to six numbers"));
    }
    let named = |names: [&String; 2]| names.into_iter().filter(|name| !name.is_empty()).cloned().collect();
    Ok(ProgramOptions {
        controller,
        name: given.name.clone(),
        tool: given.tool_number,
        base: given.base_number,
        load_number: given.load_number.unwrap_or(given.tool_number),
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
        before: named([&given.spindle_on, &given.coolant_on]),
        after: named([&given.spindle_off, &given.coolant_off]),
    })
}

/// Refuses what is no name for a controller.
fn identifier(field: &str, name: &str, longest: usize) -> Result<(), Error> {
    let legal = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) && name.chars().all(legal) && name.len() <= longest
    {
        return Ok(());
    }
    let expected = format!("letters, digits and underscores, a letter first, {longest} characters at most");
    Err(Error::invalid(field, format!("\"{name}\""), expected))
}
