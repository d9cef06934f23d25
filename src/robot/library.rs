//! Robots that come with Armill, each with the source of its numbers.

use crate::robot::model::Link;
use crate::units::{DEG, MM};

/// A robot of the library.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Preset {
    /// Key used in jobs.
    pub id: &'static str,
    /// Name as read.
    pub name: &'static str,
    /// Where each number comes from and how far to trust it.
    pub note: &'static str,
    /// Modified DH table: alpha [deg], a [mm], d [mm], theta offset [deg].
    pub modified_dh: [[f64; 4]; 6],
    /// Joint ranges [deg].
    pub joint_limits_deg: [[f64; 2]; 6],
    /// Joint compliances [rad/(N m)].
    pub joint_compliance: [f64; 6],
}

impl Preset {
    /// The DH table in SI.
    pub fn links(&self) -> [Link; 6] {
        self.modified_dh.map(|[alpha, a, d, theta_offset]| Link {
            alpha: alpha * DEG,
            a: a * MM,
            d: d * MM,
            theta_offset: theta_offset * DEG,
            sign: 1.0,
        })
    }

    /// The joint ranges in SI.
    pub fn limits(&self) -> [(f64, f64); 6] {
        self.joint_limits_deg.map(|[low, high]| (low * DEG, high * DEG))
    }
}

/// All robots of the library.
pub const ROBOTS: [Preset; 1] = [Preset {
    id: "staubli-rx90",
    name: "Stäubli RX-90",
    note: "Geometry: thesis Tables 3.1 and 3.2. Joint compliance: thesis Table 3.4, which cites static load tests; \
           no second source was found, and joint 6, for which it has no value, is taken as rigid (with the tool on axis 6 it cannot move the tip). \
           Joint ranges: recalled from the maker's data sheet, medium confidence.",
    modified_dh: [
        [0.0, 0.0, 420.0, 0.0],
        [-90.0, 0.0, 0.0, -90.0],
        [0.0, 450.0, 0.0, 90.0],
        [90.0, 0.0, 650.0, 0.0],
        [-90.0, 0.0, 0.0, 0.0],
        [90.0, 0.0, 85.0, 0.0],
    ],
    joint_limits_deg: [
        [-160.0, 160.0],
        [-137.5, 137.5],
        [-142.5, 142.5],
        [-270.0, 270.0],
        [-105.0, 120.0],
        [-270.0, 270.0],
    ],
    joint_compliance: [9.03e-7, 11.17e-7, 14.74e-7, 27.65e-7, 97.58e-7, 0.0],
}];
