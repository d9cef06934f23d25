//! The libraries as the page's form offers them, with the sources of their numbers.

use crate::cutting::material::{self, Material, Model};
use crate::job::{DhRow, Joint3, Opw};
use crate::robot::{Elbow, library};
use crate::units::{N_PER_MM, N_PER_MM2};
use serde::Serialize;

/// Robots and materials, with their values under the keys of a job.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Presets {
    /// All robots in the library.
    pub robots: Vec<RobotPreset>,
    /// All materials in the library.
    pub materials: Vec<MaterialPreset>,
}

/// A robot in the library.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RobotPreset {
    /// Key used in jobs.
    pub id: &'static str,
    /// Manufacturer and model.
    pub name: String,
    /// Manufacturer.
    pub maker: &'static str,
    /// Mass at the flange that the maker rates it for [kg].
    pub payload_kg: f64,
    /// Distance that the wrist's centre reaches from axis 1 [mm].
    pub reach_mm: f64,
    /// Source of the geometry and the first natural frequency, and how far to trust it.
    pub note: String,
    /// Source of the joint stiffness, and how far to trust it.
    pub stiffness_note: String,
    /// Height of the controller's world above the foot of the arm [mm]; `null` where unknown.
    pub world_mm: Option<f64>,
    /// Where the controller counts from, what that means for a job, and the source.
    pub world_note: String,
    /// Whether the stiffness is only an order of magnitude.
    pub stiffness_assumed: bool,
    /// How well the stiffness is known.
    pub stiffness: StiffnessOrigin,
    /// Rows of the modified Denavit-Hartenberg table [deg, mm].
    pub modified_dh: [DhRow; 6],
    /// Ortho-parallel parameters [mm, deg].
    pub opw: Opw,
    /// Reference of the joint 3 angle.
    pub joint_3: Joint3,
    /// Lower and upper limit of each joint [deg]; `null` where unknown.
    pub joint_limits_deg: Option<[[f64; 2]; 6]>,
    /// Joint compliances [rad/(N m)].
    pub joint_compliance_rad_per_nm: [f64; 6],
}

/// Where a robot's joint stiffness comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum StiffnessOrigin {
    /// A published set, measured on each joint.
    Measured,
    /// A published set, in part estimated.
    Published,
    /// A rule for the payload: an order of magnitude.
    Guessed,
}

/// A material in the library. Keys of other models are omitted.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct MaterialPreset {
    /// Key used in jobs.
    pub id: &'static str,
    /// Name shown to the user.
    pub name: &'static str,
    /// Source of the coefficients, and how far to trust them.
    pub note: String,
    /// Possible error of a force, either way [%].
    pub spread_percent: f64,
    /// How far to trust the record: high, medium or low.
    pub confidence: &'static str,
    /// Tangential cutting coefficient [N/mm^2].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ktc_n_mm2: Option<f64>,
    /// Radial cutting coefficient [N/mm^2].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub krc_n_mm2: Option<f64>,
    /// Axial cutting coefficient [N/mm^2].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kac_n_mm2: Option<f64>,
    /// Tangential edge coefficient [N/mm].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kte_n_mm: Option<f64>,
    /// Radial edge coefficient [N/mm].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kre_n_mm: Option<f64>,
    /// Axial edge coefficient [N/mm].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kae_n_mm: Option<f64>,
    /// Specific cutting force at 1 mm of chip thickness [N/mm^2].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kc11_n_mm2: Option<f64>,
    /// Exponent of the decrease of the specific cutting force with chip thickness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mc: Option<f64>,
    /// Whether it is given by constants of orthogonal cutting, for which the form has no fields;
    /// omitted if false.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub orthogonal: bool,
}

/// Robots and materials in the library.
pub fn presets() -> Presets {
    Presets {
        robots: library::robots().map(RobotPreset::of).collect(),
        materials: material::library().iter().map(MaterialPreset::of).collect(),
    }
}

impl RobotPreset {
    fn of(robot: library::Preset) -> Self {
        let mut signs = robot.opw.joint_sign.into_iter();
        let modified_dh = robot.opw.modified_dh().map(|[alpha_deg, a_mm, d_mm, theta_offset_deg]| DhRow {
            alpha_deg,
            a_mm,
            d_mm,
            theta_offset_deg,
            joint_sign: signs.next().unwrap_or(1.0),
        });
        let [a1_mm, a2_mm, b_mm, c1_mm, c2_mm, c3_mm, c4_mm] = robot.opw.lengths_mm;
        let (joint_sign, joint_offset_deg) = (robot.opw.joint_sign, robot.opw.joint_offset_deg);
        Self {
            id: robot.id,
            name: robot.name(),
            maker: robot.maker,
            payload_kg: robot.payload_kg,
            reach_mm: robot.wrist_reach_mm(),
            stiffness: match (robot.stiffness_assumed, robot.stiffness_measured) {
                (true, _) => StiffnessOrigin::Guessed,
                (false, true) => StiffnessOrigin::Measured,
                (false, false) => StiffnessOrigin::Published,
            },
            note: format!("{} {}", robot.geometry_note, robot.mode_note),
            world_mm: robot.world_mm,
            world_note: robot.world_note(),
            stiffness_note: robot.stiffness_note,
            stiffness_assumed: robot.stiffness_assumed,
            modified_dh,
            opw: Opw { a1_mm, a2_mm, b_mm, c1_mm, c2_mm, c3_mm, c4_mm, joint_sign, joint_offset_deg },
            joint_3: if robot.elbow == Elbow::Serial { Joint3::Serial } else { Joint3::Pendant },
            joint_limits_deg: robot.joint_limits_deg,
            joint_compliance_rad_per_nm: robot.joint_compliance,
        }
    }
}

impl MaterialPreset {
    fn of(material: &Material) -> Self {
        let preset = Self {
            id: material.id,
            name: material.name,
            note: material.note(),
            spread_percent: material.spread,
            confidence: material.confidence,
            ..Self::default()
        };
        // Converted back from SI and rounded, as the table does not have the last bits.
        let number = |value: f64, unit: f64| Some((value / unit * 1e9).round() / 1e9);
        match &material.model {
            Model::Linear(k) => Self {
                ktc_n_mm2: number(k.ktc, N_PER_MM2),
                krc_n_mm2: number(k.krc, N_PER_MM2),
                kac_n_mm2: number(k.kac, N_PER_MM2),
                kte_n_mm: number(k.kte, N_PER_MM),
                kre_n_mm: number(k.kre, N_PER_MM),
                kae_n_mm: number(k.kae, N_PER_MM),
                ..preset
            },
            Model::Kienzle(kienzle) => {
                Self { kc11_n_mm2: number(kienzle.kc11, N_PER_MM2), mc: number(kienzle.mc, 1.0), ..preset }
            }
            Model::Orthogonal(_) => Self { orthogonal: true, ..preset },
        }
    }
}
