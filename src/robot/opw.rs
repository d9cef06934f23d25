//! Ortho-parallel parameters: an arm with a spherical wrist, described by seven lengths, joint
//! signs and zero offsets.
//!
//! Mathias Brandstoetter, Arthur Angerer, Michael Hofbaur, "An analytical solution of the inverse
//! kinematics problem of industrial serial manipulators with an ortho-parallel basis and a
//! spherical wrist", Austrian Robotics Workshop 2014, Fig. 2.

use crate::robot::model::Link;
use crate::units::{DEG, MM};

/// The parameters as data sheets and robot packages give them, in mm and degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Opw {
    /// a1, a2, b, c1, c2, c3, c4 [mm]. Offsets: of the shoulder ahead of axis 1, of the wrist
    /// beside the forearm, of the arm's plane beside axis 1. Lengths: from base to shoulder, elbow,
    /// wrist centre and flange, each from the point before.
    pub lengths_mm: [f64; 7],
    /// +1 or -1 for each joint.
    pub joint_sign: [f64; 6],
    /// Zero offsets [deg]: the parameters' own angle is sign * q - offset.
    pub joint_offset_deg: [f64; 6],
}

impl Opw {
    /// Modified DH table: alpha [deg], a [mm], d [mm], theta offset [deg].
    ///
    /// With the parameters' own angles at zero, upper arm and forearm point straight up.
    pub fn modified_dh(&self) -> [[f64; 4]; 6] {
        let [a1, a2, b, c1, c2, c3, c4] = self.lengths_mm;
        let [o1, o2, o3, o4, o5, o6] = self.joint_offset_deg;
        [
            [0.0, 0.0, c1, 0.0 - o1],
            [-90.0, a1, 0.0, -90.0 - o2],
            [0.0, c2, b, 90.0 - o3],
            [90.0, a2, c3, 0.0 - o4],
            [-90.0, 0.0, 0.0, 0.0 - o5],
            [90.0, 0.0, c4, 0.0 - o6],
        ]
    }

    /// The modified DH table in SI, with the joint signs.
    pub fn links(&self) -> [Link; 6] {
        let mut signs = self.joint_sign.into_iter();
        self.modified_dh().map(|[alpha, a, d, theta_offset]| Link {
            alpha: alpha * DEG,
            a: a * MM,
            d: d * MM,
            theta_offset: theta_offset * DEG,
            sign: signs.next().unwrap_or(1.0),
        })
    }
}
