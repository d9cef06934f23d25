//! Weight on the joints: that of the links, and that of the spindle on the flange.

use crate::math::Pose;
use crate::robot::jacobian;
use nalgebra::Vector3;

/// Standard gravity [m/s^2] (3rd CGPM, 1901).
pub const GRAVITY: f64 = 9.80665;

/// A mass fixed to a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// Index of the link, from 0; the last is the flange.
    pub link: usize,
    /// Mass [kg].
    pub mass: f64,
    /// Centre of mass in the link's modified Denavit-Hartenberg frame [m].
    pub center: Vector3<f64>,
}

/// Torque [N m] of the loads about each joint's axis. `gravity` is the acceleration of gravity in
/// the base frame [m/s^2]. For joint i the torque is the sum of k_i . (r x m g) over the masses
/// that the joint carries, with r from the axis to the mass (Siciliano et al., Robotics, 2009, eq.
/// 7.39).
pub(crate) fn torques(frames: &[Pose; 6], loads: &[Load], gravity: &Vector3<f64>) -> [f64; 6] {
    let mut torques = [0.0; 6];
    for load in loads {
        let center = frames[load.link].point(&load.center);
        let weight = gravity * load.mass;
        for (joint, (k, lever)) in jacobian::levers(frames, &center).into_iter().enumerate() {
            if joint <= load.link {
                torques[joint] += k.dot(&lever.cross(&weight));
            }
        }
    }
    torques
}
