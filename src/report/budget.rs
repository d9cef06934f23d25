//! The error budget: which joint and which source gives how much of the contour error.
//!
//! The actual tip is the shaped pose plus the deflection, and the deflection is a sum over the joints of J_i c_i J_i^T F (eqs. 3.48, 4.8).
//! So the way from the closest point of the path to the tip is a sum of eight vectors: one for each joint, one for a tool that bends, and the shaped pose's own distance
//! from that point. Each is projected on the direction of the sum, from the path to the tip; the eight lengths then add up to the
//! contour error. A length is negative where that part alone would pull the tip back.

use crate::deviation::Deviation;
use crate::report::Report;
use crate::robot::{compliance, forward};
use crate::units::MM;
use nalgebra::Vector3;
use serde::Serialize;

/// What the contour error before compensation is made of.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Budget {
    /// Sample with the largest contour error.
    pub sample: usize,
    /// Its time [s].
    pub time_s: f64,
    /// The parts of the error there.
    pub worst_mm: Parts,
    /// The parts of the mean error: the mean of each part over all samples.
    pub mean_mm: Parts,
    /// The largest part in words.
    pub sentence: String,
}

/// Parts of a contour error [mm]; those of the joints, the tool and shaping add up to the whole.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Parts {
    /// What each joint's spring gives.
    pub joints: [f64; 6],
    /// What the tool's own bending gives; 0 for a rigid tool.
    pub tool: f64,
    /// What shaping gives, with the little by which the path bends away between the two.
    pub shaping: f64,
    /// The contour error.
    pub total: f64,
}

impl Parts {
    /// What all joints and the tool give [mm].
    pub fn deflection(&self) -> f64 {
        self.joints.iter().sum::<f64>() + self.tool
    }
}

impl Report {
    /// What each joint's spring adds to the tip's deflection before compensation at a sample, base frame [m].
    pub fn deflection_by_joint(&self, sample: usize) -> [Vector3<f64>; 6] {
        let Deviation { q, force, .. } = &self.before;
        let robot = &self.plan.robot;
        let frames = forward::frames(robot, &q[sample]);
        let tip = frames[5].compose(robot.tool()).position;
        compliance::by_joint(robot, &q[sample], &frames, &tip, &force[sample]).map(|(moved, _)| moved)
    }

    /// What the contour error before compensation is made of.
    pub fn budget(&self) -> Budget {
        let mut mean = Parts::default();
        let (mut worst, mut sample) = (Parts::default(), 0);
        for k in 0..self.samples() {
            let parts = self.parts(k);
            for (sum, part) in mean.joints.iter_mut().zip(parts.joints) {
                *sum += part;
            }
            mean.tool += parts.tool;
            mean.shaping += parts.shaping;
            mean.total += parts.total;
            if parts.total > worst.total {
                (worst, sample) = (parts, k);
            }
        }
        let count = self.samples() as f64;
        let mean_mm = Parts {
            joints: mean.joints.map(|sum| sum / count),
            tool: mean.tool / count,
            shaping: mean.shaping / count,
            total: mean.total / count,
        };
        let time_s = sample as f64 * self.plan.trajectory.sample_time;
        Budget { sample, time_s, worst_mm: worst, mean_mm, sentence: sentence(&worst) }
    }

    fn parts(&self, k: usize) -> Parts {
        let error = self.before.contour_error[k];
        let total = error.norm();
        let Some(away) = (-error).try_normalize(0.0) else { return Parts::default() };
        let joints = self.deflection_by_joint(k).map(|moved| moved.dot(&away) / MM);
        let shaping = (-error - self.before.deflection[k]).dot(&away) / MM;
        let tool = match self.plan.bending {
            Some(_) => self.before.deflection[k].dot(&away) / MM - joints.iter().sum::<f64>(),
            None => 0.0,
        };
        Parts { joints, tool, shaping, total: total / MM }
    }
}

/// The largest part in words.
fn sentence(worst: &Parts) -> String {
    let names = (1..=6).map(|joint| format!("Joint {joint}"));
    let parts = names
        .zip(worst.joints)
        .chain([("Tool bending".to_owned(), worst.tool), ("Shaping".to_owned(), worst.shaping)]);
    match parts.max_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((name, part)) if worst.total > 0.0 => {
            format!(
                "{name} gives {:.0} % of the contour error where it is largest.",
                100.0 * part / worst.total
            )
        }
        _ => "There is no contour error.".to_owned(),
    }
}
