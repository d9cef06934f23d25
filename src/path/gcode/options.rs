//! What the reader is given besides the text.

use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Part of an arc's radius by which the centre's distances from its two ends may differ, on top of
/// [`Options::arc_tolerance`].
pub const ARC_TOLERANCE_PART: f64 = 1e-3;

/// What a control knows besides the program. Lengths in m, in the workpiece frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// JSON path of the text, for errors.
    pub field: String,
    /// Offsets of G54 to G59, G59.1, G59.2 and G59.3 from the workpiece frame [m]. `None`: zero,
    /// with a remark where other than G54 is used.
    pub work_offsets: [Option<Vector3<f64>>; 9],
    /// Tool length offsets by their number H [m]: added to Z, so what the job's tool frame does not
    /// hold already. With an empty table every offset is zero, with a remark.
    pub tool_length_offsets: BTreeMap<u32, f64>,
    /// Where the tool stands before the first line [m]. `None`: the path begins at the first
    /// position of which the program has given X, Y and Z.
    pub start: Option<Vector3<f64>>,
    /// How much the centre's distances from the two ends of an arc may differ [m], besides
    /// [`ARC_TOLERANCE_PART`] of the radius.
    pub arc_tolerance: f64,
    /// Whether lines with a slash are left out (block delete on).
    pub block_delete: bool,
}

impl Default for Options {
    /// No offsets, no start position, 0.005 mm, block delete on (as NIST's interpreter starts).
    fn default() -> Self {
        Self {
            field: "path.text".into(),
            work_offsets: [None; 9],
            tool_length_offsets: BTreeMap::new(),
            start: None,
            arc_tolerance: 5e-6,
            block_delete: true,
        }
    }
}
