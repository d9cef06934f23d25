//! The arm in the plainest form: a product of 4x4 matrices, and finite differences of it for
//! everything else.

use armill::robot::library::Preset;
use nalgebra::{Matrix4, Matrix6, Vector3, Vector6};
use rs_opw_kinematics::kinematic_traits::Kinematics;
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use std::f64::consts::TAU;

/// Joint values [rad], joint 3 relative to the upper arm.
pub(crate) type Joints = [f64; 6];

pub(crate) fn shift(x: f64, y: f64, z: f64) -> Matrix4<f64> {
    Matrix4::new(1.0, 0.0, 0.0, x, 0.0, 1.0, 0.0, y, 0.0, 0.0, 1.0, z, 0.0, 0.0, 0.0, 1.0)
}

pub(crate) fn about_x(angle: f64) -> Matrix4<f64> {
    let (s, c) = angle.sin_cos();
    Matrix4::new(1.0, 0.0, 0.0, 0.0, 0.0, c, -s, 0.0, 0.0, s, c, 0.0, 0.0, 0.0, 0.0, 1.0)
}

pub(crate) fn about_y(angle: f64) -> Matrix4<f64> {
    let (s, c) = angle.sin_cos();
    Matrix4::new(c, 0.0, s, 0.0, 0.0, 1.0, 0.0, 0.0, -s, 0.0, c, 0.0, 0.0, 0.0, 0.0, 1.0)
}

pub(crate) fn about_z(angle: f64) -> Matrix4<f64> {
    let (s, c) = angle.sin_cos();
    Matrix4::new(c, -s, 0.0, 0.0, s, c, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)
}

/// Position [mm] and roll, pitch, yaw [deg] about the fixed axes, as in a job.
pub(crate) fn frame(xyz_mm: [f64; 3], rpy_deg: [f64; 3]) -> Matrix4<f64> {
    let [x, y, z] = xyz_mm.map(|v| v * 1e-3);
    let [roll, pitch, yaw] = rpy_deg.map(f64::to_radians);
    shift(x, y, z) * about_z(yaw) * about_y(pitch) * about_x(roll)
}

/// A column of a matrix without its last row: 0 to 2 are directions, 3 is the origin.
pub(crate) fn column(m: &Matrix4<f64>, i: usize) -> Vector3<f64> {
    Vector3::new(m[(0, i)], m[(1, i)], m[(2, i)])
}

/// A point of a frame, in the coordinates outside it.
pub(crate) fn placed(m: &Matrix4<f64>, p: &Vector3<f64>) -> Vector3<f64> {
    column(m, 0) * p.x + column(m, 1) * p.y + column(m, 2) * p.z + column(m, 3)
}

/// An arm with a spherical wrist, straight up with all its own angles at zero (Brandstoetter,
/// Angerer, Hofbaur 2014, Fig. 2).
pub(crate) struct Arm {
    /// a1, a2, b, c1, c2, c3, c4 [m].
    lengths: [f64; 7],
    sign: [f64; 6],
    /// [rad]
    offset: [f64; 6],
    /// How far joint 3 turns from the upper arm per turn of joint 2 while joint 3 is commanded
    /// constant.
    pub(crate) follows: f64,
    /// [rad/(N m)]
    pub(crate) compliance: [f64; 6],
    tool: Matrix4<f64>,
    /// TCP to flange.
    off_tool: Matrix4<f64>,
    start: OPWKinematics,
}

/// Why a pose is rejected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Refusal {
    Reach,
    Branch,
}

impl Arm {
    pub(crate) fn new(
        preset: &Preset,
        compliance: [f64; 6],
        tool: Matrix4<f64>,
        start: OPWKinematics,
    ) -> Self {
        // Relative to the base, joint 3 is the forearm's inclination: the sum of the arm's own
        // angles 2 and 3 stays constant while joint 3 does.
        let sign = preset.opw.joint_sign;
        let pendant = preset.elbow == armill::robot::Elbow::Pendant;
        Self {
            lengths: preset.opw.lengths_mm.map(|length| length * 1e-3),
            sign,
            offset: preset.opw.joint_offset_deg.map(f64::to_radians),
            follows: if pendant { -sign[1] * sign[2] } else { 0.0 },
            compliance,
            tool,
            off_tool: tool.try_inverse().unwrap(),
            start,
        }
    }

    /// Joint values as the robot shows them.
    pub(crate) fn displayed(&self, q: &Joints) -> Joints {
        let mut q = *q;
        q[2] -= self.follows * q[1];
        q
    }

    /// The TCP.
    pub(crate) fn forward(&self, q: &Joints) -> Matrix4<f64> {
        let [a1, a2, b, c1, c2, c3, c4] = self.lengths;
        let t: [f64; 6] = std::array::from_fn(|i| self.sign[i] * q[i] - self.offset[i]);
        let shoulder = shift(0.0, 0.0, c1) * about_z(t[0]) * shift(a1, b, 0.0) * about_y(t[1]);
        let wrist = shift(0.0, 0.0, c2) * about_y(t[2]) * shift(a2, 0.0, c3);
        let hand = about_z(t[3]) * about_y(t[4]) * about_z(t[5]) * shift(0.0, 0.0, c4);
        shoulder * wrist * hand * self.tool
    }

    /// Motion of the TCP per joint: central differences.
    fn change(&self, q: &Joints, i: usize) -> Matrix4<f64> {
        let h = 1e-5;
        let (mut more, mut less) = (*q, *q);
        more[i] += h;
        less[i] -= h;
        (self.forward(&more) - self.forward(&less)) / (2.0 * h)
    }

    /// Deflection of the tip and of the approach direction under a force on the tip (eqs. 3.41,
    /// 3.42, 3.47).
    pub(crate) fn give(&self, q: &Joints, force: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let (mut moved, mut leaned) = (Vector3::zeros(), Vector3::zeros());
        for i in 0..6 {
            let change = self.change(q, i);
            let turn = self.compliance[i] * column(&change, 3).dot(force);
            moved += column(&change, 3) * turn;
            leaned += column(&change, 2) * turn;
        }
        (moved, leaned)
    }

    /// Margin of reach [m] at the pose for an arm that faces the wrist centre (or turns its back to
    /// it).
    fn margin(&self, tcp: &Matrix4<f64>, front: bool) -> f64 {
        let [a1, a2, b, c1, c2, c3, c4] = self.lengths;
        let wrist = column(&(tcp * self.off_tool * shift(0.0, 0.0, -c4)), 3);
        let beside = (wrist.x * wrist.x + wrist.y * wrist.y - b * b).max(0.0).sqrt();
        let ahead = if front { beside } else { -beside };
        let distance = (ahead - a1).hypot(wrist.z - c1);
        let fore = a2.hypot(c3);
        let planar = if beside == 0.0 { -1.0 } else { f64::INFINITY };
        (c2 + fore - distance).min(distance - (c2 - fore).abs()).min(planar)
    }

    /// How far inside its reach the arm is, on either shoulder [m]; negative: out of reach.
    pub(crate) fn reach(&self, tcp: &Matrix4<f64>) -> f64 {
        self.margin(tcp, true).max(self.margin(tcp, false))
    }

    /// Joint values at the start, by another author's closed form, on the requested branch.
    pub(crate) fn first(
        &self,
        tcp: &Matrix4<f64>,
        front: bool,
        elbow: bool,
        near: bool,
    ) -> Result<Joints, Refusal> {
        if self.reach(tcp) < 0.0 {
            return Err(Refusal::Reach);
        }
        let [_, a2, _, _, _, c3, _] = self.lengths;
        let flange = tcp * self.off_tool;
        let wrist = column(&(flange * shift(0.0, 0.0, -self.lengths[6])), 3);
        let fits = |q: &Joints| {
            let t: [f64; 6] = std::array::from_fn(|i| self.sign[i] * q[i] - self.offset[i]);
            let ahead = wrist.x * t[0].cos() + wrist.y * t[0].sin();
            (ahead >= 0.0) == front && ((t[2] + a2.atan2(c3)).sin() >= 0.0) == elbow
        };
        let turned = |q: Joints| q.map(|angle| angle - TAU * (angle / TAU).round());
        let flange = pose(&flange, &self.start.forward(&[0.0; 6]));
        let mut wrists: Vec<_> = self.start.inverse(&flange).into_iter().filter(fits).map(turned).collect();
        wrists.sort_by(|a, b| a[3].abs().total_cmp(&b[3].abs()));
        let q = if near { wrists.first() } else { wrists.last() };
        self.next(tcp, q.ok_or(Refusal::Branch)?)
    }

    /// Joint values for a TCP pose, from nearby values: Newton's method on the forward model.
    pub(crate) fn next(&self, tcp: &Matrix4<f64>, last: &Joints) -> Result<Joints, Refusal> {
        if self.reach(tcp) < 0.0 {
            return Err(Refusal::Reach);
        }
        let mut q = Vector6::from(*last);
        let mut least = f64::INFINITY;
        for _ in 0..60 {
            let now = self.forward(&q.into());
            let missing = difference(tcp, &now);
            if missing.norm() >= least && least < 1e-12 {
                break;
            }
            least = least.min(missing.norm());
            let columns: [Vector6<f64>; 6] = std::array::from_fn(|i| {
                let change = self.change(&q.into(), i);
                twist(&change, &now)
            });
            let step = Matrix6::from_columns(&columns).lu().solve(&missing).ok_or(Refusal::Branch)?;
            // Large steps would leave the branch.
            q += step * f64::min(1.0, 0.2 / step.amax());
        }
        let stays = least < 1e-11 && (q - Vector6::from(*last)).amax() < 1.5;
        if stays { Ok(q.into()) } else { Err(Refusal::Branch) }
    }

    /// Distance of the pose from its singularities, each dimensionless: sines of elbow and wrist,
    /// and the wrist centre's distance from axis 1 over the reach.
    pub(crate) fn regular(&self, q: &Joints) -> f64 {
        let [a1, a2, _, _, c2, c3, _] = self.lengths;
        let t: [f64; 6] = std::array::from_fn(|i| self.sign[i] * q[i] - self.offset[i]);
        let fore = a2.hypot(c3);
        let elbow = t[2] + a2.atan2(c3);
        let ahead = a1 + c2 * t[1].sin() + fore * (t[1] + elbow).sin();
        elbow.sin().abs().min(t[4].sin().abs()).min((ahead / (c2 + fore)).abs())
    }
}

/// Translation and rotation (as sines) from one pose to another.
fn difference(to: &Matrix4<f64>, from: &Matrix4<f64>) -> Vector6<f64> {
    twist(&(to - from), from)
}

/// A small change of a pose as translation and rotation: half the sum of the axes' cross products.
fn twist(change: &Matrix4<f64>, pose: &Matrix4<f64>) -> Vector6<f64> {
    let turn = (0..3).map(|i| column(pose, i).cross(&column(change, i))).sum::<Vector3<f64>>() / 2.0;
    let way = column(change, 3);
    Vector6::new(way.x, way.y, way.z, turn.x, turn.y, turn.z)
}

fn pose(m: &Matrix4<f64>, like: &rs_opw_kinematics::pose::Pose) -> rs_opw_kinematics::pose::Pose {
    let rotation = nalgebra::Rotation3::from_matrix_unchecked(m.fixed_view::<3, 3>(0, 0).into_owned());
    let q = nalgebra::UnitQuaternion::from_rotation_matrix(&rotation);
    let mut pose = *like;
    (pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w) = (q.i, q.j, q.k, q.w);
    (pose.translation.x, pose.translation.y, pose.translation.z) = (m[(0, 3)], m[(1, 3)], m[(2, 3)]);
    pose
}
