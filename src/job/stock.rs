//! The job's section `stock`: what the program starts from, in the workpiece frame.

use crate::job::choice::choice;
use crate::job::json::keys;
use crate::job::path::ProgramText;
use serde::Serialize;

choice! {
    /// How the stock is given.
    StockKind {
        /// Not given: one engagement holds for the whole path.
        #[default]
        None = "none",
        /// A box between two corners.
        Box = "box",
        /// A cylinder along Z.
        Cylinder = "cylinder",
        /// A box around the program's cutting moves.
        Extents = "extents",
        /// A polygon between two heights.
        Outline = "outline",
        /// A mesh.
        Stl = "stl",
    }
}

/// The stock. The keys in use depend on `kind`.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Stock {
    /// How it is given.
    pub kind: StockKind,
    /// A corner of a box.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from_mm: Option<[f64; 3]>,
    /// The opposite corner of a box.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_mm: Option<[f64; 3]>,
    /// Centre of a cylinder's bottom.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center_mm: Option<[f64; 3]>,
    /// Radius of a cylinder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_mm: Option<f64>,
    /// Height of a cylinder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_mm: Option<f64>,
    /// Material beyond the extents of the tool's axis, on each side and below; default the tool's
    /// diameter.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub allowance_mm: Option<f64>,
    /// Corners of an outline, x and y.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points_mm: Option<Vec<[f64; 2]>>,
    /// Height of an outline's bottom.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bottom_mm: Option<f64>,
    /// Height of the top of an outline, or of the extents; of these by default 0 if the program cuts
    /// below it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub top_mm: Option<f64>,
    /// An STL mesh: its text, or a binary one in base64.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stl: Option<ProgramText>,
    /// Programs that cut it before, in order.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub earlier: Option<Vec<EarlierProgram>>,
}

/// A program that cut the stock before this one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EarlierProgram {
    /// Its G-code, in the same workpiece frame; read like the job's.
    pub text: ProgramText,
    /// Diameter of its tool.
    pub diameter_mm: f64,
    /// Corner radius of its tool; default 0, a flat end mill.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner_radius_mm: Option<f64>,
}

impl Default for EarlierProgram {
    fn default() -> Self {
        Self { text: ProgramText::default(), diameter_mm: 10.0, corner_radius_mm: None }
    }
}

impl Stock {
    /// Whether there is none.
    pub fn is_none(&self) -> bool {
        self.kind == StockKind::None
    }
}

keys!(new EarlierProgram { text, diameter_mm, corner_radius_mm } required text, diameter_mm);
keys!(new Stock {
    kind,
    from_mm,
    to_mm,
    center_mm,
    radius_mm,
    height_mm,
    allowance_mm,
    points_mm,
    bottom_mm,
    top_mm,
    stl,
    earlier
});
