//! The job's keys, mirroring the JSON. Values are as typed, not yet checked.

use crate::error::Error;
use crate::job::choice::choice;
use crate::job::cutting::{Cutting, Material, Tool};
use crate::job::json::{Node, Read, keys};
use crate::job::learned::Learned;
use crate::job::motion::Motion;
use crate::job::online::Online;
use crate::job::path::{Path, PathKind};
use crate::job::program::RobotProgram;
use crate::job::source::Source;
use crate::job::spin::Spin;
use crate::job::stock::Stock;
use crate::job::uncertainty::Uncertainty;
use serde::Serialize;

/// The whole job. `Job::default()` is the thesis's case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Job {
    /// Version of the format: 1.
    pub version: u32,
    /// Number of the model that its figures were computed with; jobs saved before model 2, and those
    /// written by hand, have none. See [`MODEL`](crate::model::MODEL).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<u32>,
    /// What a person calls it: for titles and file names, never for a number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The arm.
    pub robot: Robot,
    /// TCP in the flange frame.
    pub tool_frame: Frame,
    /// The robot's base in the cell: on a plinth, a track, a wall.
    pub base_frame: Frame,
    /// Workpiece in the cell. If the robot's base is at the cell's origin, this is also its pose in
    /// the base frame.
    pub workpiece_frame: Frame,
    /// Rotation of the TCP about the tool axis.
    pub spin: Spin,
    /// The arm's branch at the start of the path.
    pub start_branch: Branch,
    /// The desired path in the workpiece frame.
    pub path: Path,
    /// What the program starts from.
    #[serde(skip_serializing_if = "Stock::is_none")]
    pub stock: Stock,
    /// Speed and sampling.
    pub motion: Motion,
    /// The end mill.
    pub tool: Tool,
    /// Cutting coefficients.
    pub material: Material,
    /// Engagement.
    pub cutting: Cutting,
    /// Input shaper of the joint commands.
    pub shaper: Shaper,
    /// The sources to compensate, and the tolerance.
    pub compensation: Compensation,
    /// How well the inputs are known.
    pub uncertainty: Uncertainty,
    /// What a measured pass taught of arm and cut.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub learned: Option<Learned>,
    /// A loop on top of the path.
    #[serde(skip_serializing_if = "Online::is_default")]
    pub online: Online,
    /// What leaves.
    pub program: RobotProgram,
}

impl Default for Job {
    fn default() -> Self {
        Self {
            version: 1,
            model: None,
            name: None,
            robot: Robot { preset: Some("staubli-rx90".into()), ..Robot::default() },
            tool_frame: Frame::default(),
            base_frame: Frame::default(),
            workpiece_frame: Frame::default(),
            spin: Spin::default(),
            start_branch: Branch::default(),
            path: Path {
                center_mm: Some([0.0, 0.0, 0.0]),
                radius_mm: Some(300.0),
                normal: Some([0.2, 0.3, 0.5]),
                ..Path::of(PathKind::Circle)
            },
            stock: Stock::default(),
            motion: Motion::default(),
            tool: Tool::default(),
            material: Material { preset: Some("thesis".into()), ..Material::default() },
            cutting: Cutting::default(),
            shaper: Shaper::Spec(ShaperSpec {
                kind: ShaperKind::Zvd,
                frequency_rad_s: Some(18.0),
                frequency_hz: None,
                damping: 0.1,
            }),
            compensation: Compensation::default(),
            uncertainty: Uncertainty::default(),
            learned: None,
            online: Online::default(),
            program: RobotProgram::default(),
        }
    }
}

/// The arm: a preset (whose limits and compliances may be overridden), a modified DH table, or
/// ortho-parallel parameters.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Robot {
    /// Key of a robot in the library.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub preset: Option<String>,
    /// Name of a robot that is not in the library.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Modified DH table, six rows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modified_dh: Option<[DhRow; 6]>,
    /// Ortho-parallel parameters.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub opw: Option<Opw>,
    /// Reference of the joint 3 angle, and location of its drive; default serial, or the preset's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_3: Option<Joint3>,
    /// Joint ranges [deg].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_limits_deg: Option<[[f64; 2]; 6]>,
    /// Joint compliances [rad/(N m)].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_compliance_rad_per_nm: Option<[f64; 6]>,
    /// Points of nonlinear springs: joint (1 to 6), torque [N m], deflection [arcmin].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_springs_nm_arcmin: Option<Vec<[f64; 3]>>,
    /// Masses carried by the joints: link (1 to 6, the flange), mass [kg], centre of mass in the
    /// link's frame [mm].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loads_kg_mm: Option<Vec<[f64; 5]>>,
    /// Pose at which the sag is zero by definition; default the start of the path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sag_zero: Option<SagZero>,
}

/// One row of a modified DH table.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DhRow {
    /// Twist alpha_{i-1}.
    pub alpha_deg: f64,
    /// Length a_{i-1}.
    pub a_mm: f64,
    /// Offset d_i.
    pub d_mm: f64,
    /// Constant part of theta_i.
    pub theta_offset_deg: f64,
    /// 1, or -1 if the manufacturer counts the joint in the opposite direction.
    pub joint_sign: f64,
}

impl Default for DhRow {
    fn default() -> Self {
        Self { alpha_deg: 0.0, a_mm: 0.0, d_mm: 0.0, theta_offset_deg: 0.0, joint_sign: 1.0 }
    }
}

/// Ortho-parallel parameters (see [`crate::robot::Opw`]): lengths, and sign and zero offset of each
/// joint.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Opw {
    /// Distance of axis 2 in front of axis 1.
    pub a1_mm: f64,
    /// Offset of the wrist centre from the forearm's line; negative if the elbow is above it.
    pub a2_mm: f64,
    /// Lateral offset of the arm's plane from axis 1.
    pub b_mm: f64,
    /// Base to axis 2.
    pub c1_mm: f64,
    /// Axis 2 to axis 3.
    pub c2_mm: f64,
    /// Axis 3 to the wrist centre, along the forearm.
    pub c3_mm: f64,
    /// Wrist centre to the flange.
    pub c4_mm: f64,
    /// 1 or -1.
    pub joint_sign: [f64; 6],
    /// The parameters' angle is sign times joint value minus this offset.
    pub joint_offset_deg: [f64; 6],
}

impl Default for Opw {
    fn default() -> Self {
        let [a1_mm, a2_mm, b_mm, c1_mm, c2_mm, c3_mm, c4_mm] = [0.0; 7];
        let (joint_sign, joint_offset_deg) = ([1.0; 6], [0.0; 6]);
        Self { a1_mm, a2_mm, b_mm, c1_mm, c2_mm, c3_mm, c4_mm, joint_sign, joint_offset_deg }
    }
}

/// A frame: position, then roll, pitch and yaw about the fixed x, y and z axes.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Frame {
    /// Position.
    pub xyz_mm: [f64; 3],
    /// Orientation.
    pub rpy_deg: [f64; 3],
}

/// The arm's branch, of up to eight, at the start of the path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Branch {
    /// Facing the point, or reaching over its back.
    pub shoulder: Shoulder,
    /// Sign of the elbow angle, measured from the stretched arm (RX-90: sign of q3).
    pub elbow: Elbow,
    /// The wrist solution with the smaller |q4|, or the other.
    pub wrist: Wrist,
}

choice! {
    /// Shoulder of the start branch.
    Shoulder {
        /// Facing the point.
        #[default]
        Front = "front",
        /// Reaching over its back.
        Back = "back",
    }
}
choice! {
    /// Elbow of the start branch.
    Elbow {
        /// Positive elbow angle.
        #[default]
        Positive = "positive",
        /// Negative elbow angle.
        Negative = "negative",
    }
}
choice! {
    /// Wrist of the start branch.
    Wrist {
        /// Smaller |q4|.
        #[default]
        Near = "near",
        /// Turned by 180 degrees.
        Flipped = "flipped",
    }
}
choice! {
    /// Reference of the joint 3 angle, and location of its drive.
    Joint3 {
        /// From the upper arm, driven at the elbow.
        #[default]
        Serial = "serial",
        /// From the base, driven at the elbow.
        Pendant = "pendant",
        /// From the base, driven at the base through a parallelogram.
        Parallelogram = "parallelogram",
    }
}
choice! {
    /// Pose at which the sag is zero by definition.
    SagZero {
        /// The start of the path, where the workpiece was touched off.
        #[default]
        Start = "start",
        /// None: the model without load.
        Model = "model",
    }
}
choice! {
    /// What of the tool is brought onto its desired place.
    CompensateAt {
        /// The tip.
        #[default]
        Tip = "tip",
        /// The point of the tool's axis half the axial depth above the tip.
        Middle = "middle",
        /// The tip and the direction of the tool's axis.
        Axis = "axis",
    }
}
choice! {
    /// Kind of input shaper.
    ShaperKind {
        /// Zero vibration.
        Zv = "zv",
        /// Zero vibration and derivative.
        #[default]
        Zvd = "zvd",
        /// Zero vibration and two derivatives.
        Zvdd = "zvdd",
        /// Extra-insensitive.
        Ei = "ei",
    }
}
/// Input shaper: `"none"`, or a kind with its frequency and damping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shaper {
    /// Joint commands are not shaped.
    None,
    /// Joint commands are shaped.
    Spec(ShaperSpec),
}

/// A shaper kind with its mode. The frequency is given in exactly one of the two units.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct ShaperSpec {
    /// Kind.
    pub kind: ShaperKind,
    /// Undamped natural frequency.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_rad_s: Option<f64>,
    /// Undamped natural frequency.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// Damping ratio.
    pub damping: f64,
}

impl Serialize for Shaper {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Shaper::None => serializer.serialize_str("none"),
            Shaper::Spec(spec) => spec.serialize(serializer),
        }
    }
}

impl Read for Shaper {
    fn read(&mut self, node: &Node) -> Result<(), Error> {
        if node.is_object() {
            let mut spec = ShaperSpec::default();
            spec.read(node)?;
            *self = Shaper::Spec(spec);
        } else if node.is_text() && node.value::<String>()? == "none" {
            *self = Shaper::None;
        } else {
            return Err(node.error(
                "expected \"none\" or an object with kind, frequency_rad_s or frequency_hz, and damping",
            ));
        }
        Ok(())
    }
}

/// The sources to compensate, and the tolerance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Compensation {
    /// Largest contour error to reach.
    pub tolerance_mm: f64,
    /// Largest number of passes.
    pub max_passes: u32,
    /// Sources to compensate.
    pub sources: Vec<Source>,
    /// What of the tool is brought onto its desired place; default the tip.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<CompensateAt>,
}

impl Default for Compensation {
    fn default() -> Self {
        let sources = vec![Source::Deflection, Source::Shaping];
        Self { tolerance_mm: 0.01, max_passes: 5, sources, at: None }
    }
}

keys!(Job {
    version,
    model,
    name,
    robot,
    tool_frame,
    base_frame,
    workpiece_frame,
    spin,
    start_branch,
    path,
    stock,
    motion,
    tool,
    material,
    cutting,
    shaper,
    compensation,
    uncertainty,
    learned,
    online,
    program
});
keys!(new Robot {
    preset, name, modified_dh, opw, joint_3, joint_limits_deg, joint_compliance_rad_per_nm,
    joint_springs_nm_arcmin, loads_kg_mm, sag_zero
});
keys!(new DhRow { alpha_deg, a_mm, d_mm, theta_offset_deg, joint_sign } required alpha_deg, a_mm, d_mm);
keys!(new Opw {
    a1_mm, a2_mm, b_mm, c1_mm, c2_mm, c3_mm, c4_mm, joint_sign, joint_offset_deg
} required c2_mm, c3_mm);
keys!(Frame { xyz_mm, rpy_deg });
keys!(Branch { shoulder, elbow, wrist });
keys!(new ShaperSpec { kind, frequency_rad_s, frequency_hz, damping } required kind, damping);
keys!(Compensation { tolerance_mm, max_passes, sources, at });
