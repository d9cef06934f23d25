//! The job's path, mirroring the JSON. Values are as typed, not yet checked.

use crate::error::Error;
use crate::job::choice::choice;
use crate::job::json::{Node, Read, keys};
use serde::{Serialize, Serializer};
use std::ops::Deref;
use std::sync::Arc;

choice! {
    /// What the path is built from.
    PathKind {
        /// Full circle.
        #[default]
        Circle = "circle",
        /// Part of a circle.
        Arc = "arc",
        /// One straight line.
        Line = "line",
        /// Rectangle with sharp or rounded corners.
        Rectangle = "rectangle",
        /// Straight lines through points.
        Polyline = "polyline",
        /// Straight lines through pasted rows of x, y, z, with optional tool axis and feed.
        Csv = "csv",
        /// A G-code program.
        Gcode = "gcode",
        /// An APT or CLDATA program.
        Apt = "apt",
    }
}
choice! {
    /// Unit of length of a text that does not give its own.
    Unit {
        /// Millimetres.
        #[default]
        Mm = "mm",
        /// Inches.
        Inch = "inch",
    }
}

choice! {
    /// Unit of the feeds in a text that does not give its own.
    FeedUnit {
        /// Millimetres per second.
        #[default]
        MmPerS = "mm/s",
        /// Millimetres per minute.
        MmPerMin = "mm/min",
        /// Inches per minute.
        InchPerMin = "inch/min",
    }
}

choice! {
    /// Controller that a G-code program is written for.
    ProgramDialect {
        /// Recognised by what the program writes.
        #[default]
        Auto = "auto",
        /// Fanuc and Haas.
        Fanuc = "fanuc",
        /// LinuxCNC.
        LinuxCnc = "linuxcnc",
        /// grbl and its relatives.
        Grbl = "grbl",
        /// Siemens Sinumerik.
        Siemens = "siemens",
        /// Mach3 and Mach4.
        Mach = "mach",
    }
}

/// The desired path in the workpiece frame. The keys in use depend on `kind`.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Path {
    /// What the path is built from.
    pub kind: PathKind,
    /// Centre of a circle, an arc or a rectangle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center_mm: Option<[f64; 3]>,
    /// Radius of a circle or an arc.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_mm: Option<f64>,
    /// Normal of a circle or an arc, of any length; default +Z.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal: Option<[f64; 3]>,
    /// Start angle of an arc, measured from the projection of +X.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_deg: Option<f64>,
    /// Sweep of an arc, counter-clockwise about the normal if positive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sweep_deg: Option<f64>,
    /// Start of a line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from_mm: Option<[f64; 3]>,
    /// End of a line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_mm: Option<[f64; 3]>,
    /// Size of a rectangle along X.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width_mm: Option<f64>,
    /// Size of a rectangle along Y.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_mm: Option<f64>,
    /// Radius of a rectangle's corners; default 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner_radius_mm: Option<f64>,
    /// Points of a polyline.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points_mm: Option<Vec<[f64; 3]>>,
    /// Text of a program, or pasted rows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub text: Option<ProgramText>,
    /// Unit of length of rows or of a program that do not give their own; default mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// Unit of the feeds of rows that do not give their own; default mm/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub feed_unit: Option<FeedUnit>,
    /// Tool length offsets of a G-code program: rows of the number H and the offset.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tool_length_offsets_mm: Option<Vec<(u32, f64)>>,
    /// Work offsets of a G-code program, in the order G54, G55 and so on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub work_offsets_mm: Option<Vec<[f64; 3]>>,
    /// Whether lines of a G-code program that start with a slash are skipped; default true.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub block_delete: Option<bool>,
    /// Controller of a G-code program; if not given, it is recognised.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dialect: Option<ProgramDialect>,
    /// Tool position before the first line of a G-code program; if not given, the path starts where the
    /// program has given X, Y and Z.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_mm: Option<[f64; 3]>,
}

keys!(new Path {
    kind, center_mm, radius_mm, normal, start_deg, sweep_deg, from_mm, to_mm, width_mm, height_mm,
    corner_radius_mm, points_mm, text, unit, feed_unit, tool_length_offsets_mm, work_offsets_mm,
    block_delete, dialect, start_mm
} required kind);

impl Path {
    /// A path of this kind with no other keys.
    pub fn of(kind: PathKind) -> Self {
        Self { kind, ..Self::default() }
    }
}

/// A text that may be long; clones share it.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramText(Arc<str>);

impl Default for ProgramText {
    fn default() -> Self {
        "".into()
    }
}

impl<T: Into<Arc<str>>> From<T> for ProgramText {
    fn from(text: T) -> Self {
        Self(text.into())
    }
}

impl Deref for ProgramText {
    type Target = str;

    fn deref(&self) -> &str {
        &self.0
    }
}

impl ProgramText {
    /// A shared reference to the text.
    pub fn shared(&self) -> Arc<str> {
        self.0.clone()
    }
}

impl Serialize for ProgramText {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.0)
    }
}

impl Read for ProgramText {
    fn read(&mut self, node: &Node) -> Result<(), Error> {
        *self = node.value::<String>()?.into();
        Ok(())
    }
}
