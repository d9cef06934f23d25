//! Settings of the reader.

use super::dialect::GcodeDialect;
use crate::path::unit::LengthUnit;
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Fraction of an arc's radius by which the centre's distances from its two ends may differ, in
/// addition to [`Options::arc_tolerance`].
pub const ARC_TOLERANCE_PART: f64 = 1e-3;

/// Controller settings that are not in the program. Lengths in m, in the workpiece frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// JSON path of the text, for errors.
    pub field: String,
    /// Offsets of G54 to G59, G59.1, G59.2 and G59.3 from the workpiece frame [m]. `None` is zero;
    /// codes other than G54 then get a remark.
    pub work_offsets: [Option<Vector3<f64>>; 9],
    /// Tool length offsets by their number H [m], added to Z; the part that the job's tool frame
    /// does not already contain. If the table is empty, every offset is zero, with a remark.
    pub tool_length_offsets: BTreeMap<u32, f64>,
    /// The controller whose program it is; without one, it is recognised.
    pub dialect: Option<GcodeDialect>,
    /// Unit of length until the program says one; without either it is mm, with a remark.
    pub unit: Option<LengthUnit>,
    /// Tool position before the first line [m]. `None`: the path starts at the first position for
    /// which the program has given X, Y and Z.
    pub start: Option<Vector3<f64>>,
    /// Largest difference between the centre's distances from the two ends of an arc [m], in
    /// addition to [`ARC_TOLERANCE_PART`] of the radius.
    pub arc_tolerance: f64,
    /// Whether lines with a slash are skipped (block delete on).
    pub block_delete: bool,
}

impl Default for Options {
    /// No offsets, no start position, 0.005 mm, block delete on (the initial state of NIST's
    /// interpreter).
    fn default() -> Self {
        Self {
            field: "path.text".into(),
            work_offsets: [None; 9],
            tool_length_offsets: BTreeMap::new(),
            dialect: None,
            unit: None,
            start: None,
            arc_tolerance: 5e-6,
            block_delete: true,
        }
    }
}
