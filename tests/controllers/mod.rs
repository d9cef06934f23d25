//! Readers of robot programs, an independent second way to what the exporters write: each stands for a
//! controller, follows the calls of a package from its main program and refuses what it does not know. Nothing
//! here calls the crate; parsing and conventions of rotation are the readers' own.
//!
//! Data that stay on a controller (a measured tool, say) are given as files of their own: a KRL `$config.dat`,
//! a RAPID `.sys` module.
#![allow(dead_code, unused_imports, reason = "each test file uses a part of this")]
#![allow(clippy::disallowed_methods, reason = "compared within a tolerance, not bit by bit")]

mod fanuc;
mod krl;
mod rapid;
mod scan;
mod val3;
mod xml;

pub(crate) use fanuc::fanuc;
pub(crate) use krl::krl;
pub(crate) use rapid::rapid;
pub(crate) use val3::val3;

use nalgebra::{Matrix3, Vector3};

/// Reads a package, its paths and texts, by the reader of the controller that a job calls `id`.
pub(crate) fn read<'t>(
    id: &str,
    files: impl Iterator<Item = (&'t str, &'t str)>,
) -> Result<ControllerProgram, String> {
    let files: Vec<File> = files.map(|(path, text)| File { path: path.into(), text: text.into() }).collect();
    match id {
        "kuka" => krl(&files),
        "abb" => rapid(&files),
        "staubli" => val3(&files),
        "fanuc" => fanuc(&files),
        _ => Err(format!("no reader for {id}")),
    }
}

/// A position [mm] and the orientation there.
pub(crate) type Frame = (Vector3<f64>, Matrix3<f64>);

/// A file of a package.
pub(crate) struct File {
    pub(crate) path: String,
    pub(crate) text: String,
}

/// How a motion ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Blend {
    /// An exact stop.
    Stop,
    /// The path may be left this far before the target [mm].
    Distance(f64),
    /// FANUC's CNT, or KUKA's $APO.CPTP [%].
    Percent(f64),
}

/// How a target is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Motion {
    /// By the axes, to these values as the controller shows them [deg].
    Joints([f64; 6]),
    /// By the axes, to the pose of the target.
    Free,
    /// Along a straight line.
    Line,
    /// Along the circle through this point in the base frame [mm].
    Arc { via: Vector3<f64> },
}

/// A motion with all that is in force for it.
#[derive(Debug, Clone)]
pub(crate) struct Target {
    pub(crate) motion: Motion,
    /// Tool point in the program's base frame [mm]; zero for a joint target.
    pub(crate) position: Vector3<f64>,
    /// The tool's axes in the base frame, as columns; identity for a joint target.
    pub(crate) rotation: Matrix3<f64>,
    /// Speed of the tool point [mm/s], where one is in force.
    pub(crate) speed: Option<f64>,
    pub(crate) blend: Blend,
    /// S and T, confdata, CONFIG, or VAL3's config, as written.
    pub(crate) configuration: Option<String>,
    /// Waits since the target before [s].
    pub(crate) wait_before_s: f64,
}

/// What a package makes a robot do.
#[derive(Debug, Clone)]
pub(crate) struct ControllerProgram {
    /// The main program, or the application.
    pub(crate) name: String,
    /// The frame of all Cartesian targets, in the controller's world.
    pub(crate) base: Frame,
    /// The tool of all Cartesian targets, on the flange.
    pub(crate) tool: Frame,
    pub(crate) load_kg: Option<f64>,
    pub(crate) targets: Vec<Target>,
    /// Calls to procedures that the package does not contain, and outputs that are set.
    pub(crate) hooks: Vec<String>,
    pub(crate) lines_of_longest_file: usize,
    /// Waits since the last target [s].
    pub(crate) wait_at_end_s: f64,
}

impl ControllerProgram {
    fn of(name: &str, texts: &[Text]) -> ControllerProgram {
        ControllerProgram {
            name: name.to_owned(),
            base: identity(),
            tool: identity(),
            load_kg: None,
            targets: Vec::new(),
            hooks: Vec::new(),
            lines_of_longest_file: texts.iter().map(|text| text.text.lines().count()).max().unwrap_or(0),
            wait_at_end_s: 0.0,
        }
    }

    /// Adds a joint target.
    fn joints(&mut self, axes: [f64; 6], speed: Option<f64>, blend: Blend) {
        let (position, rotation) = identity();
        self.add(Target {
            motion: Motion::Joints(axes),
            position,
            rotation,
            speed,
            blend,
            configuration: None,
            wait_before_s: 0.0,
        });
    }

    /// Adds a Cartesian target; all of them have one base and one tool.
    fn cartesian(&mut self, base: Frame, tool: Frame, target: Target) -> Result<(), String> {
        let is_first = self.targets.iter().all(|before| matches!(before.motion, Motion::Joints(_)));
        if is_first {
            (self.base, self.tool) = (base, tool);
        } else if (self.base, self.tool) != (base, tool) {
            return Err("base and tool change between targets".to_owned());
        }
        self.add(target);
        Ok(())
    }

    fn add(&mut self, mut target: Target) {
        target.wait_before_s = std::mem::take(&mut self.wait_at_end_s);
        self.targets.push(target);
    }

    /// Whether the last motion may go on into the next.
    fn is_blending(&self) -> bool {
        self.targets.last().is_some_and(|last| last.blend != Blend::Stop)
    }

    /// Makes the last motion stop: there is nothing to blend it with.
    fn stop_last(&mut self) {
        if let Some(last) = self.targets.last_mut() {
            last.blend = Blend::Stop;
        }
    }
}

/// A file whose characters and line ends are in order.
struct Text<'a> {
    path: &'a str,
    /// The file's name without its ending.
    stem: &'a str,
    /// The ending, in lower case.
    ending: String,
    text: &'a str,
}

/// The files of a package, of these endings only (and `txt`, which no controller reads).
fn checked<'a>(files: &'a [File], endings: &[&str]) -> Result<Vec<Text<'a>>, String> {
    let mut texts: Vec<Text> = Vec::new();
    for File { path, text } in files {
        let fail = |line: usize, what: &str| Err(format!("{path}:{line}: {what}"));
        let name = path.rsplit('/').next().unwrap_or(path);
        let (stem, ending) = name.rsplit_once('.').unwrap_or((name, ""));
        let ending = ending.to_ascii_lowercase();
        if texts.iter().any(|other| other.path.eq_ignore_ascii_case(path)) {
            return fail(0, "two files of one path");
        }
        if ending == "txt" {
            continue;
        }
        if !endings.contains(&ending.as_str()) {
            return fail(0, "no file of this controller");
        }
        let marked = text.strip_prefix('\u{feff}');
        if marked.is_some() && !["pjx", "dtx", "pgx"].contains(&ending.as_str()) {
            return fail(1, "a byte order mark");
        }
        let text = marked.unwrap_or(text);
        let windows = text.contains("\r\n");
        for (number, line) in text.split_inclusive('\n').enumerate() {
            let is_whole = line.ends_with('\n');
            let line = line.strip_suffix('\n').unwrap_or(line);
            let inner = line.strip_suffix('\r').unwrap_or(line);
            if inner.chars().any(|letter| !(' '..='~').contains(&letter) && letter != '\t') {
                return fail(number + 1, "a character that is not printable ASCII");
            }
            if is_whole && windows != line.ends_with('\r') {
                return fail(number + 1, "line ends of two kinds");
            }
        }
        texts.push(Text { path, stem, ending, text });
    }
    Ok(texts)
}

/// The one name that no other program of the package calls.
fn main_of(names: &[String], called: &[String], what: &str) -> Result<String, String> {
    let mut mains = names.iter().filter(|name| !called.contains(name));
    match (mains.next(), mains.next()) {
        (Some(name), None) => Ok(name.clone()),
        (None, _) => Err(format!("no {what} is the main one")),
        (Some(first), Some(second)) => {
            Err(format!("neither {first} nor {second} is called: two main {what}s"))
        }
    }
}

/// Letters, digits and underscores after a letter, at most so long.
fn is_identifier(name: &str, longest: usize) -> bool {
    name.len() <= longest
        && name.starts_with(|first: char| first.is_ascii_alphabetic())
        && name.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
}

fn identity() -> Frame {
    (Vector3::zeros(), Matrix3::identity())
}

/// A frame given within another one.
fn within(outer: Frame, inner: Frame) -> Frame {
    (outer.0 + outer.1 * inner.0, outer.1 * inner.1)
}

fn about_x(degrees: f64) -> Matrix3<f64> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Matrix3::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos)
}

fn about_y(degrees: f64) -> Matrix3<f64> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Matrix3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos)
}

fn about_z(degrees: f64) -> Matrix3<f64> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0)
}
