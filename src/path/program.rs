//! A program as it was read: moves in order, and remarks for the user.
//!
//! The readers of G-code, APT and CSV all produce a [`Program`]; later stages don't know which
//! language a path came from.

use crate::path::Segment;
use crate::path::gcode::GcodeDialect;
use nalgebra::Vector3;
use std::sync::Arc;

/// A toolpath with everything the program specifies about it. Lengths in m, in the workpiece frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Program {
    /// The moves; each starts where the previous one ends.
    pub moves: Vec<Move>,
    /// The program's waits.
    pub dwells: Vec<Dwell>,
    /// Words without effect here (coolant, tool numbers, ...).
    pub ignored: Vec<Ignored>,
    /// Oddities that can be worked around, e.g. a move without a feed.
    pub remarks: Vec<Remark>,
    /// Tools described by the program.
    pub tools: Vec<Tool>,
    /// Whether subprograms, loops or jumps decide which line is next.
    pub jumps: bool,
    /// The controller whose G-code it is.
    pub dialect: Option<GcodeDialect>,
    /// Unit of length of the text, as read: `mm` or `inch`.
    pub unit: &'static str,
    /// Number of lines in the text.
    pub lines: usize,
}

/// A program with the text it was read from.
#[derive(Debug, Clone, PartialEq)]
pub struct SourceProgram {
    /// Language: `gcode`, `apt` or `csv`.
    pub language: &'static str,
    /// As typed, but with LF where a bare CR ended a line.
    pub text: Arc<str>,
    /// As read.
    pub program: Program,
}

/// One straight line or arc (helix).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Move {
    /// Geometry of the tip.
    pub segment: Segment,
    /// Unit vector from tip to spindle at the start.
    pub axis_from: Vector3<f64>,
    /// Unit vector from tip to spindle at the end.
    pub axis_to: Vector3<f64>,
    /// How fast, and whether it cuts.
    pub pace: MovePace,
    /// Spindle speed [1/s], if the program sets one.
    pub spindle: Option<f64>,
    /// Line of the text, from 1.
    pub line: usize,
}

/// Pace of a move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MovePace {
    /// Positioning: the arm moves but does not cut.
    Rapid,
    /// Cutting at this feed [m/s].
    Feed(f64),
    /// Cutting at the job's feed, because the program sets none.
    JobFeed,
}

/// A wait.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dwell {
    /// Number of moves before it.
    pub after: usize,
    /// Duration [s].
    pub time: f64,
    /// Line of the text, from 1.
    pub line: usize,
}

/// A tool described by a program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tool {
    /// Diameter [m].
    pub diameter: f64,
    /// Line of the text, from 1.
    pub line: usize,
}

/// A known word without effect on the path.
#[derive(Debug, Clone, PartialEq)]
pub struct Ignored {
    /// As written.
    pub word: String,
    /// Line of the text, from 1.
    pub line: usize,
}

/// A remark for the user.
#[derive(Debug, Clone, PartialEq)]
pub struct Remark {
    /// Stable slug.
    pub code: &'static str,
    /// Message shown to the user.
    pub message: String,
    /// Line of the text, from 1.
    pub line: usize,
}
