//! The turn about the tool axis, which milling leaves open.

use crate::error::Error;
use crate::job::choice::choice;
use crate::job::json::{Node, Read, keys};
use serde::Serialize;

/// Rotation of the TCP about the tool axis, counter-clockwise seen from the spindle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spin {
    /// Whether the angle is free.
    pub mode: SpinMode,
    /// The angle; for a free spin, the reference for comparison.
    pub angle_deg: f64,
    /// What it counts from.
    #[serde(skip_serializing_if = "SpinReference::is_auto")]
    pub reference: SpinReference,
    /// Smallest and largest angle of a free spin.
    pub range_deg: [f64; 2],
    /// Optimization goal of a free spin.
    pub goal: SpinGoal,
}

impl Default for Spin {
    fn default() -> Self {
        Self {
            mode: SpinMode::Fixed,
            angle_deg: 0.0,
            reference: SpinReference::Auto,
            range_deg: [-180.0, 180.0],
            goal: SpinGoal::SmoothJoints,
        }
    }
}

/// The direction that the TCP's x axis follows, projected across the tool axis.
///
/// The projection is turned by a constant angle such that an upright tool has its x axis on
/// workpiece +X with every direction but a vertical one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum SpinReference {
    /// Workpiece +X, or +Y, or +Z: the first that keeps 15 deg clear of the tool axis. If none
    /// does, the x axis is carried along without twist.
    #[default]
    Auto,
    /// Workpiece +X.
    X,
    /// Workpiece +Y.
    Y,
    /// Workpiece +Z.
    Z,
    /// A direction in the workpiece frame; its length does not matter.
    Direction([f64; 3]),
}

impl SpinReference {
    /// The words in the JSON.
    pub const WORDS: [&'static str; 4] = ["auto", "x", "y", "z"];
    /// What they stand for.
    const NAMED: [Self; 4] = [Self::Auto, Self::X, Self::Y, Self::Z];

    /// The direction that is set, if one is.
    pub fn direction(self) -> Option<[f64; 3]> {
        match self {
            Self::Auto => None,
            Self::X => Some([1.0, 0.0, 0.0]),
            Self::Y => Some([0.0, 1.0, 0.0]),
            Self::Z => Some([0.0, 0.0, 1.0]),
            Self::Direction(direction) => Some(direction),
        }
    }

    fn is_auto(&self) -> bool {
        *self == Self::Auto
    }
}

impl Serialize for SpinReference {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Direction(direction) => direction.serialize(serializer),
            Self::Auto => serializer.serialize_str(Self::WORDS[0]),
            Self::X => serializer.serialize_str(Self::WORDS[1]),
            Self::Y => serializer.serialize_str(Self::WORDS[2]),
            Self::Z => serializer.serialize_str(Self::WORDS[3]),
        }
    }
}

impl Read for SpinReference {
    fn read(&mut self, node: &Node) -> Result<(), Error> {
        if node.is_text() {
            *self = Self::NAMED[node.one_of(&Self::WORDS)?];
            return Ok(());
        }
        let mut direction = [0.0; 3];
        direction.read(node)?;
        *self = Self::Direction(direction);
        Ok(())
    }
}

choice! {
    /// Whether the spin is free.
    SpinMode {
        /// A constant angle.
        #[default]
        Fixed = "fixed",
        /// Chosen along the path.
        Free = "free",
    }
}
choice! {
    /// Optimization goal of a free spin.
    SpinGoal {
        /// Small and smooth joint motion.
        #[default]
        SmoothJoints = "smooth-joints",
        /// Smallest error due to the cutting force.
        LeastError = "least-error",
    }
}

keys!(Spin { mode, angle_deg, reference, range_deg, goal });
