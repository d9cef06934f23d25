//! The job's keys, one to one as in the JSON. Values are as typed, not yet checked.

use crate::error::Error;
use crate::job::choice::{Choice, CornerDwell, choice};
use crate::job::cutting::{Cutting, Material, Tool};
use crate::job::json::{Node, Read, keys};
use crate::job::path::{Path, PathKind};
use crate::job::source::Source;
use serde::Serialize;

/// The whole question. `Job::default()` is the thesis's case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Job {
    /// Version of the format: 1.
    pub version: u32,
    /// The arm.
    pub robot: Robot,
    /// TCP in the flange frame.
    pub tool_frame: Frame,
    /// The robot's base in the cell: on a plinth, a track, a wall.
    pub base_frame: Frame,
    /// Workpiece in the cell; with the robot's base at the cell's origin: in the base frame.
    pub workpiece_frame: Frame,
    /// How the TCP is turned about the tool axis.
    pub spin: Spin,
    /// Which of the arm's solutions the path starts on.
    pub start_branch: Branch,
    /// The desired path in the workpiece frame.
    pub path: Path,
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
    /// What to compensate and how far.
    pub compensation: Compensation,
}

impl Default for Job {
    fn default() -> Self {
        Self {
            version: 1,
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
        }
    }
}

/// The arm: a preset (whose limits and compliances may be overruled), a modified DH table, or ortho-parallel parameters.
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
    /// What joint 3 is counted from, and where its drive sits; default serial, or the preset's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_3: Option<Joint3>,
    /// Joint ranges [deg].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_limits_deg: Option<[[f64; 2]; 6]>,
    /// Joint compliances [rad/(N m)].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_compliance_rad_per_nm: Option<[f64; 6]>,
    /// Points of springs that are no straight lines: joint (1 to 6), torque [N m], turn [arcmin].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_springs_nm_arcmin: Option<Vec<[f64; 3]>>,
    /// Masses that the joints carry: link (1 to 6, the flange), mass [kg], centre of mass in the link's frame [mm].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loads_kg_mm: Option<Vec<[f64; 5]>>,
    /// Pose at which the loads' sag is no error; default the start of the path.
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
    /// 1, or -1 where the maker counts the joint the other way round.
    pub joint_sign: f64,
}

impl Default for DhRow {
    fn default() -> Self {
        Self { alpha_deg: 0.0, a_mm: 0.0, d_mm: 0.0, theta_offset_deg: 0.0, joint_sign: 1.0 }
    }
}

/// Ortho-parallel parameters (see [`crate::robot::Opw`]): lengths, and sign and zero offset of each joint.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Opw {
    /// Axis 2 ahead of axis 1.
    pub a1_mm: f64,
    /// Wrist centre beside the forearm's line; negative is the elbow above it.
    pub a2_mm: f64,
    /// Arm's plane beside axis 1.
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
    /// The parameters' own angle is sign times joint value less this.
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

/// How the TCP is turned about the tool axis, from where its x axis keeps workpiece +X projected across that axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spin {
    /// Whether the angle is free.
    pub mode: SpinMode,
    /// The angle; of a free spin: what it is compared with.
    pub angle_deg: f64,
    /// Smallest and largest angle of a free spin.
    pub range_deg: [f64; 2],
    /// What a free spin is chosen for.
    pub goal: SpinGoal,
}

impl Default for Spin {
    fn default() -> Self {
        Self {
            mode: SpinMode::Fixed,
            angle_deg: 0.0,
            range_deg: [-180.0, 180.0],
            goal: SpinGoal::SmoothJoints,
        }
    }
}

/// Which of the arm's up to eight solutions the path starts on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Branch {
    /// Facing the point, or over its back.
    pub shoulder: Shoulder,
    /// Sign of the elbow angle from the stretched arm (RX-90: of q3).
    pub elbow: Elbow,
    /// The wrist with the smaller |q4|, or the other.
    pub wrist: Wrist,
}

choice! {
    /// Shoulder of the start branch.
    Shoulder { #[default] /** Facing the point. */ Front = "front", /** Over its back. */ Back = "back" }
}
choice! {
    /// Elbow of the start branch.
    Elbow { #[default] /** Positive elbow angle. */ Positive = "positive", /** Negative elbow angle. */ Negative = "negative" }
}
choice! {
    /// Wrist of the start branch.
    Wrist { #[default] /** Smaller |q4|. */ Near = "near", /** Turned by 180 degrees. */ Flipped = "flipped" }
}
choice! {
    /// Whether the spin is free.
    SpinMode { #[default] /** One angle all along. */ Fixed = "fixed", /** Chosen along the path. */ Free = "free" }
}
choice! {
    /// What a free spin is chosen for.
    SpinGoal { #[default] /** Joints that turn little and evenly. */ SmoothJoints = "smooth-joints", /** Least error by the cutting force. */ LeastError = "least-error" }
}
choice! {
    /// What joint 3 is counted from, and where its drive sits.
    Joint3 { #[default] /** From the upper arm, driven at the elbow. */ Serial = "serial", /** From the base, driven at the elbow. */ Pendant = "pendant", /** From the base, driven there through a parallelogram. */ Parallelogram = "parallelogram" }
}
choice! {
    /// Pose at which sag is no error.
    SagZero { #[default] /** The start of the path, where the workpiece was touched off. */ Start = "start", /** None: the model without load. */ Model = "model" }
}
choice! {
    /// Kind of input shaper.
    ShaperKind { /** Zero vibration. */ Zv = "zv", #[default] /** And its derivative. */ Zvd = "zvd", /** And two derivatives. */ Zvdd = "zvdd", /** Extra-insensitive. */ Ei = "ei" }
}
/// Speed and sampling.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Motion {
    /// Feed along the path.
    pub feed_mm_s: f64,
    /// Speed of a program's rapid moves.
    pub rapid_mm_s: f64,
    /// Acceleration along the path.
    pub acceleration_mm_s2: f64,
    /// Sample time.
    pub sample_time_s: f64,
    /// A corner sharper than this is a full stop.
    pub corner_angle_deg: f64,
    /// Time at rest in such a corner.
    pub corner_dwell: CornerDwell,
}

impl Default for Motion {
    fn default() -> Self {
        Self {
            feed_mm_s: 100.0,
            rapid_mm_s: 250.0,
            acceleration_mm_s2: 200.0,
            sample_time_s: 0.001,
            corner_angle_deg: 5.0,
            corner_dwell: Choice::Word,
        }
    }
}

/// Input shaper: `"none"`, or a kind with its frequency and damping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shaper {
    /// Commands go to the joints as they are.
    None,
    /// Commands are shaped.
    Spec(ShaperSpec),
}

/// A shaper of a kind; the frequency is given in exactly one of the two units.
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

/// What to compensate and how far.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Compensation {
    /// Largest contour error to reach.
    pub tolerance_mm: f64,
    /// Most passes.
    pub max_passes: u32,
    /// Sources to compensate.
    pub sources: Vec<Source>,
}

impl Default for Compensation {
    fn default() -> Self {
        Self { tolerance_mm: 0.01, max_passes: 5, sources: vec![Source::Deflection, Source::Shaping] }
    }
}

keys!(Job {
    version,
    robot,
    tool_frame,
    base_frame,
    workpiece_frame,
    spin,
    start_branch,
    path,
    motion,
    tool,
    material,
    cutting,
    shaper,
    compensation
});
keys!(new Robot { preset, name, modified_dh, opw, joint_3, joint_limits_deg, joint_compliance_rad_per_nm, joint_springs_nm_arcmin, loads_kg_mm, sag_zero });
keys!(new DhRow { alpha_deg, a_mm, d_mm, theta_offset_deg, joint_sign } required alpha_deg, a_mm, d_mm);
keys!(new Opw { a1_mm, a2_mm, b_mm, c1_mm, c2_mm, c3_mm, c4_mm, joint_sign, joint_offset_deg } required c2_mm, c3_mm);
keys!(Frame { xyz_mm, rpy_deg });
keys!(Spin { mode, angle_deg, range_deg, goal });
keys!(Branch { shoulder, elbow, wrist });
keys!(Motion { feed_mm_s, rapid_mm_s, acceleration_mm_s2, sample_time_s, corner_angle_deg, corner_dwell });
keys!(new ShaperSpec { kind, frequency_rad_s, frequency_hz, damping } required kind, damping);
keys!(Compensation { tolerance_mm, max_passes, sources });
