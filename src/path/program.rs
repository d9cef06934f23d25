//! A program as it was understood: moves in order, and what a person should look at.
//!
//! Readers of G-code, APT and CSV all end here; nothing right of this file knows which of them a path came from.

use crate::path::Segment;
use nalgebra::Vector3;
use std::sync::Arc;

/// A toolpath with all that a program says about it. Lengths in m, in the workpiece frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Program {
    /// The moves, each starting where the one before ends.
    pub moves: Vec<Move>,
    /// Waits asked for by the program.
    pub dwells: Vec<Dwell>,
    /// Words that change nothing here (coolant, tool numbers, ...).
    pub ignored: Vec<Ignored>,
    /// What is odd but workable, e.g. a move without a feed.
    pub remarks: Vec<Remark>,
    /// Tools that the program describes.
    pub tools: Vec<Tool>,
    /// Unit of length of the text, as read: `mm` or `inch`.
    pub unit: &'static str,
    /// Number of lines of the text.
    pub lines: usize,
}

/// A program with the text it was read from.
#[derive(Debug, Clone, PartialEq)]
pub struct SourceProgram {
    /// Language: `gcode`, `apt` or `csv`.
    pub language: &'static str,
    /// As typed.
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
    /// Spindle speed [1/s], where the program has said one.
    pub spindle: Option<f64>,
    /// Line of the text, from 1.
    pub line: usize,
}

/// How fast a move runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MovePace {
    /// Positioning: moves the arm but does not cut.
    Rapid,
    /// Cutting at this feed [m/s].
    Feed(f64),
    /// Cutting at the job's feed: the program has not said any.
    JobFeed,
}

/// A wait.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dwell {
    /// Number of moves done before it.
    pub after: usize,
    /// Time [s].
    pub time: f64,
    /// Line of the text, from 1.
    pub line: usize,
}

/// A tool that a program describes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tool {
    /// Diameter [m].
    pub diameter: f64,
    /// Line of the text, from 1.
    pub line: usize,
}

/// A word that is understood and has no effect on the path.
#[derive(Debug, Clone, PartialEq)]
pub struct Ignored {
    /// As written.
    pub word: String,
    /// Line of the text, from 1.
    pub line: usize,
}

/// Something a person should look at.
#[derive(Debug, Clone, PartialEq)]
pub struct Remark {
    /// Stable slug.
    pub code: &'static str,
    /// What a person reads.
    pub message: String,
    /// Line of the text, from 1.
    pub line: usize,
}
