//! The job's tool, material and cutting, mirroring the JSON. Values are as typed, not yet checked.

use crate::job::choice::{
    ChipLimit, ChipThickness, Choice, CornerRadius, FeedPerTooth, HolderDiameter, SpindlePower,
    SpindleTorque, choice,
};
use crate::job::json::keys;
use serde::Serialize;

choice! {
    /// How the tool sits in its holder.
    ToolBending {
        /// Rigid.
        #[default]
        Rigid = "rigid",
        /// It bends as a cantilever beam.
        Cantilever = "cantilever",
    }
}
choice! {
    /// Hand of the helix.
    HelixHand {
        /// The usual one: the chip rises.
        #[default]
        Right = "right",
        /// The chip is pushed down.
        Left = "left",
    }
}
choice! {
    /// How the engagement is given.
    Engaged {
        /// By entry and exit.
        #[default]
        Angles = "angles",
        /// Down milling.
        Climb = "climb",
        /// Up milling.
        Conventional = "conventional",
        /// Material on both sides.
        Slot = "slot",
        /// Where the tool is in the stock.
        FromStock = "from-stock",
    }
}
choice! {
    /// What the force follows.
    Coupling {
        /// The deflection: a tool that is pushed away cuts less.
        #[default]
        Deflection = "deflection",
        /// Nothing: it is that of the cut as planned.
        None = "none",
    }
}
choice! {
    /// The linearization of Kienzle's curve.
    Line {
        /// Exact in force and slope.
        #[default]
        Tangent = "tangent",
        /// Exact in force, zero at zero chip thickness.
        Secant = "secant",
    }
}

/// The end mill.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Tool {
    /// Diameter.
    pub diameter_mm: f64,
    /// Number of flutes.
    pub flutes: u32,
    /// Helix angle.
    pub helix_deg: f64,
    /// Hand of the helix; default right.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hand: Option<HelixHand>,
    /// Corner radius between side and bottom; default 0, a flat end mill.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner_radius_mm: Option<CornerRadius>,
    /// Normal rake angle; default 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rake_deg: Option<f64>,
    /// Offset of the tool axis from the spindle axis; default 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub runout_mm: Option<f64>,
    /// Least chip thickness that the edges cut; not checked if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min_chip_mm: Option<ChipLimit>,
    /// Largest chip thickness that the tool takes; not checked if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_chip_mm: Option<ChipLimit>,
    /// Whether the tool bends; default rigid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bending: Option<ToolBending>,
    /// Length outside the holder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stickout_mm: Option<f64>,
    /// Flute length from the tip; default: the whole stickout.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flute_length_mm: Option<f64>,
    /// Diameter above the flutes; default: the tool's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shank_diameter_mm: Option<f64>,
    /// Diameter of the holder, which begins a stickout above the tip; not checked if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub holder_diameter_mm: Option<HolderDiameter>,
    /// Young's modulus; default 600, carbide.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modulus_gpa: Option<f64>,
}

impl Default for Tool {
    fn default() -> Self {
        Self {
            diameter_mm: 10.0,
            flutes: 4,
            helix_deg: 30.0,
            hand: None,
            corner_radius_mm: None,
            rake_deg: None,
            runout_mm: None,
            min_chip_mm: None,
            max_chip_mm: None,
            bending: None,
            stickout_mm: None,
            flute_length_mm: None,
            shank_diameter_mm: None,
            holder_diameter_mm: None,
            modulus_gpa: None,
        }
    }
}

/// Cutting coefficients: a preset, numbers, or Kienzle's constants. The last four keys may override
/// a preset's.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Material {
    /// Key of a material in the library.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub preset: Option<String>,
    /// Tangential cutting coefficient.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ktc_n_mm2: Option<f64>,
    /// Radial cutting coefficient.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub krc_n_mm2: Option<f64>,
    /// Axial cutting coefficient.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kac_n_mm2: Option<f64>,
    /// Tangential edge coefficient; default 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kte_n_mm: Option<f64>,
    /// Radial edge coefficient; default 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kre_n_mm: Option<f64>,
    /// Axial edge coefficient; default 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kae_n_mm: Option<f64>,
    /// Kienzle's specific cutting force for a chip of 1 mm by 1 mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kc11_n_mm2: Option<f64>,
    /// Kienzle's exponent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mc: Option<f64>,
    /// Ratio of radial to tangential force; default 0.3.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radial_ratio: Option<f64>,
    /// Ratio of axial to tangential force; default 0.3.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axial_ratio: Option<f64>,
    /// The linearization of the curve; default tangent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<Line>,
    /// Chip thickness at which the curve is linearized; default the cut's mean.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chip_thickness_mm: Option<ChipThickness>,
}

/// Engagement.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Cutting {
    /// Axial depth of cut.
    pub axial_depth_mm: f64,
    /// How the engagement is given; default: from the stock if there is one, else entry and exit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub engagement: Option<Engaged>,
    /// What the force follows; default: the deflection if the engagement is from a stock, else nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coupling: Option<Coupling>,
    /// Radial depth of cut, for climb and conventional milling.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radial_depth_mm: Option<f64>,
    /// Immersion angle at which a tooth enters.
    pub entry_deg: f64,
    /// Immersion angle at which a tooth exits.
    pub exit_deg: f64,
    /// Spindle speed.
    pub spindle_rpm: f64,
    /// Rated spindle power; not checked if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spindle_power_kw: Option<SpindlePower>,
    /// Rated spindle torque; not checked if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spindle_torque_nm: Option<SpindleTorque>,
    /// Feed per tooth.
    pub feed_per_tooth_mm: FeedPerTooth,
}

impl Default for Cutting {
    fn default() -> Self {
        Self {
            axial_depth_mm: 10.0,
            engagement: None,
            coupling: None,
            radial_depth_mm: None,
            entry_deg: 90.0,
            exit_deg: 180.0,
            spindle_rpm: 4000.0,
            spindle_power_kw: None,
            spindle_torque_nm: None,
            feed_per_tooth_mm: Choice::value(0.1),
        }
    }
}

keys!(Tool {
    diameter_mm,
    flutes,
    helix_deg,
    hand,
    corner_radius_mm,
    rake_deg,
    runout_mm,
    min_chip_mm,
    max_chip_mm,
    bending,
    stickout_mm,
    flute_length_mm,
    shank_diameter_mm,
    holder_diameter_mm,
    modulus_gpa
});
keys!(new Material {
    preset,
    ktc_n_mm2,
    krc_n_mm2,
    kac_n_mm2,
    kte_n_mm,
    kre_n_mm,
    kae_n_mm,
    kc11_n_mm2,
    mc,
    radial_ratio,
    axial_ratio,
    line,
    chip_thickness_mm
});
keys!(Cutting {
    axial_depth_mm,
    engagement,
    coupling,
    radial_depth_mm,
    entry_deg,
    exit_deg,
    spindle_rpm,
    spindle_power_kw,
    spindle_torque_nm,
    feed_per_tooth_mm
});
