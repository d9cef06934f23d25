//! The error budget: how much each joint and each source contributes to the contour error.
//!
//! The actual tip is the shaped pose plus the deflection, and the deflection is a sum over the
//! joints of J_i c_i J_i^T F (eqs. 3.48, 4.8). The error vector, from the closest point of the path
//! to the tip, is therefore a sum of eight vectors: one for each joint, one for the bending of the
//! tool, and the shaped pose's own offset from that point. Each is projected on the direction of
//! the error vector, so the eight lengths add up to the contour error. A length is negative where
//! that part alone would pull the tip back towards the path.

use crate::math::Pose;
use crate::report::Report;
use crate::robot::{Joints, compliance, forward};
use crate::units::MM;
use nalgebra::Vector3;
use serde::Serialize;

/// Breakdown of the contour error before compensation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Budget {
    /// Sample with the largest contour error.
    pub sample: usize,
    /// Time of that sample [s].
    pub time_s: f64,
    /// Breakdown of the error at that sample.
    pub worst_mm: Parts,
    /// Breakdown of the mean error: the mean of each part over all samples.
    pub mean_mm: Parts,
    /// The largest part, in words.
    pub sentence: String,
}

/// Parts of a contour error [mm]; those of the joints, the tool and shaping add up to the whole.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Parts {
    /// Contribution of each joint's spring.
    pub joints: [f64; 6],
    /// Contribution of the tool's bending; 0 for a rigid tool.
    pub tool: f64,
    /// Contribution of shaping, including the slight curvature of the path in between.
    pub shaping: f64,
    /// The contour error.
    pub total: f64,
}

impl Parts {
    /// Contribution of all joints and the tool [mm].
    pub fn deflection(&self) -> f64 {
        self.joints.iter().sum::<f64>() + self.tool
    }
}

impl Report {
    /// Tip deflection due to each joint's spring at a sample, before compensation, base frame [m].
    pub fn deflection_by_joint(&self, sample: usize) -> [Vector3<f64>; 6] {
        let robot = &self.plan.robot;
        let q = self.shaped(&self.q).at(sample);
        let frames = forward::frames(robot, &q);
        let tip = frames[5].compose(robot.tool()).position;
        compliance::by_joint(robot, &q, &frames, &tip, &self.force[sample]).map(|(moved, _)| moved)
    }

    /// Breakdown of the contour error before compensation.
    pub fn budget(&self) -> Budget {
        self.budget_and_walls().0
    }

    /// The breakdown at sample `k`, given the joint values, frames and tip there.
    pub(super) fn parts(&self, k: usize, q: &Joints, frames: &[Pose; 6], tip: &Vector3<f64>) -> Parts {
        let error = self.before.contour_error[k];
        let total = error.norm();
        let Some(away) = (-error).try_normalize(0.0) else { return Parts::default() };
        let joints = compliance::by_joint(&self.plan.robot, q, frames, tip, &self.force[k])
            .map(|(moved, _)| moved.dot(&away) / MM);
        let shaping = (-error - self.deflection[k]).dot(&away) / MM;
        let tool = match self.setup().bending {
            Some(_) => self.deflection[k].dot(&away) / MM - joints.iter().sum::<f64>(),
            None => 0.0,
        };
        Parts { joints, tool, shaping, total: total / MM }
    }
}

/// Running sums of a budget.
#[derive(Default)]
pub(super) struct Sum {
    sum: Parts,
    worst: Parts,
    sample: usize,
    count: f64,
}

impl Sum {
    pub(super) fn take(&mut self, k: usize, parts: Parts) {
        let Self { sum, worst, .. } = self;
        for (sum, part) in sum.joints.iter_mut().zip(parts.joints) {
            *sum += part;
        }
        sum.tool += parts.tool;
        sum.shaping += parts.shaping;
        sum.total += parts.total;
        self.count += 1.0;
        if parts.total > worst.total {
            (self.worst, self.sample) = (parts, k);
        }
    }

    pub(super) fn budget(&self, sample_time: f64) -> Budget {
        let Self { sum, worst, sample, count } = *self;
        let mean_mm = Parts {
            joints: sum.joints.map(|sum| sum / count),
            tool: sum.tool / count,
            shaping: sum.shaping / count,
            total: sum.total / count,
        };
        let time_s = sample as f64 * sample_time;
        Budget { sample, time_s, worst_mm: worst, mean_mm, sentence: sentence(&worst) }
    }
}

/// The largest part, in words.
fn sentence(worst: &Parts) -> String {
    let names = (1..=6).map(|joint| format!("Joint {joint}"));
    let parts = names
        .zip(worst.joints)
        .chain([("Tool bending".to_owned(), worst.tool), ("Shaping".to_owned(), worst.shaping)]);
    match parts.max_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((name, part)) if worst.total > 0.0 => {
            format!(
                "{name} causes {:.0} % of the contour error where it is largest.",
                100.0 * part / worst.total
            )
        }
        _ => "There is no contour error.".to_owned(),
    }
}
