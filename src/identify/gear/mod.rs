//! Spring, delay and hysteresis of a joint, from its angles at the motor and behind the gear.
//!
//! While the arm moves, the two differ by what the gear gives way under the load, and by less than that:
//!
//! ```text
//! q_motor - q_load = c + tau / k + T dq_motor/dt + h sign(dq_motor/dt)
//! ```
//!
//! with the torque tau that a model of the arm puts on the joint, the stiffness k, the delay T between the two readings, half the
//! width h of the hysteresis, and the offset c of the encoders. Least squares over all samples. Neighboring samples err
//! alike, so the intervals come from leaving out one block of half a second after the other (M. Quenouille,
//! Biometrika 43 (1956), 353, the jackknife; H. Kuensch, Ann. Statist. 17 (1989), 1217, for blocks).

mod log;
mod summary;

pub use log::{GearLog, read, read_as};
pub use summary::{GearSummary, PredictedRun};

use crate::error::Error;
use crate::identify::least_squares::LeastSquares;
use crate::identify::student::quantile_975;
use crate::math;
use crate::spread::{COVERAGE, Stiffness};
use log::{BLOCK, FIELD};
use nalgebra::{Matrix4, Vector3, Vector4};

/// Speeds below this share of the largest have no direction.
const SLOW: f64 = 1e-3;

/// A joint's gear.
#[derive(Debug, Clone, PartialEq)]
pub struct Gear {
    /// The joint, from 0.
    pub joint: usize,
    /// c [rad], 1/k [rad/(N m)], T [s], h [rad].
    pub values: Vector4<f64>,
    /// Half the width of the 95 % interval of each.
    pub halves: Vector4<f64>,
    /// Share of the variance that is explained.
    pub explained: f64,
    /// Root mean square of the rest [rad].
    pub rest: f64,
    /// Number of blocks.
    pub blocks: usize,
    /// c, T and h alone, fitted without a spring.
    without: Vector4<f64>,
    /// Root mean square of the rest without a spring [rad].
    pub rest_without: f64,
}

impl GearLog {
    /// The four columns that are fitted, and the difference of the angles [rad].
    fn rows(&self) -> Vec<(Vector4<f64>, f64)> {
        let count = self.time.len();
        let speed: Vec<f64> = (0..count)
            .map(|k| {
                let (before, after) = (k.saturating_sub(1), (k + 1).min(count - 1));
                (self.motor[after] - self.motor[before]) / (self.time[after] - self.time[before])
            })
            .collect();
        let most = speed.iter().fold(0.0, |most: f64, speed| most.max(speed.abs()));
        let sign = |speed: f64| if speed.abs() <= SLOW * most { 0.0 } else { speed.signum() };
        let row = |k: usize| {
            (Vector4::new(1.0, self.torque[k], speed[k], sign(speed[k])), self.motor[k] - self.load[k])
        };
        (0..count).map(row).collect()
    }

    /// Fits its gear.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the joint hardly moves, or its load does not change.
    pub fn fit(&self) -> Result<Gear, Error> {
        let rows = self.rows();
        let vague = || {
            let value = format!("joint {} at rest, or under a steady load", self.joint + 1);
            Error::invalid(FIELD, value, "a joint that moves both ways while its load changes")
        };
        if rows.iter().all(|(_, difference)| *difference == rows[0].1) {
            let value = format!("joint {} with the same difference of its angles all along", self.joint + 1);
            return Err(Error::invalid(FIELD, value, "angles at the motor and behind the gear"));
        }
        // The normal equations of each block, so that leaving one out costs nothing.
        let begins = self.time[0];
        let of = |k: usize| ((self.time[k] - begins) / BLOCK) as usize;
        let blocks = of(self.time.len() - 1) + 1;
        let mut sums = vec![(Matrix4::zeros(), Vector4::zeros()); blocks];
        for (k, (row, value)) in rows.iter().enumerate() {
            sums[of(k)].0 += row * row.transpose();
            sums[of(k)].1 += row * *value;
        }
        let square: Matrix4<f64> = sums.iter().map(|sum| sum.0).sum();
        let side: Vector4<f64> = sums.iter().map(|sum| sum.1).sum();
        let values = LeastSquares::solved(square, side).ok_or_else(vague)?.values;
        let left_out =
            |sum: &(Matrix4<f64>, Vector4<f64>)| LeastSquares::solved(square - sum.0, side - sum.1);
        let replicates: Option<Vec<Vector4<f64>>> =
            sums.iter().map(|sum| left_out(sum).map(|found| found.values)).collect();
        let replicates = replicates.ok_or_else(vague)?;
        let mean = replicates.iter().sum::<Vector4<f64>>() / blocks as f64;
        let squares = replicates.iter().map(|value| (value - mean).component_mul(&(value - mean)));
        let variance = squares.sum::<Vector4<f64>>() * ((blocks - 1) as f64 / blocks as f64);
        let halves = variance.map(|variance| quantile_975(blocks - 1) * variance.sqrt());
        let (explained, rest) = judged(&rows, &values, false);
        let bare = rows.iter().map(|(row, value)| (Vector3::new(row[0], row[2], row[3]), *value));
        let bare = LeastSquares::of(bare).ok_or_else(vague)?.values;
        let without = Vector4::new(bare[0], 0.0, bare[1], bare[2]);
        let (_, rest_without) = judged(&rows, &without, false);
        Ok(Gear { joint: self.joint, values, halves, explained, rest, blocks, without, rest_without })
    }
}

impl Gear {
    /// Stiffness [N m/rad]; `None` if the load did not show it.
    pub fn stiffness(&self) -> Option<f64> {
        self.is_seen().then(|| 1.0 / self.values[1])
    }

    /// Its 95 % interval [N m/rad].
    pub fn stiffness_interval(&self) -> Option<[f64; 2]> {
        let [soft, stiff] = [self.values[1] + self.halves[1], self.values[1] - self.halves[1]];
        self.is_seen().then(|| [1.0 / soft, 1.0 / stiff])
    }

    /// Whether the load's angle is ahead of the motor's, as none is.
    fn is_ahead(&self) -> bool {
        self.values[2] + self.halves[2] < 0.0
    }

    fn is_seen(&self) -> bool {
        self.values[1] - self.halves[1] > 0.0
    }

    /// Another log, predicted with what was found: share of its variance that is explained, and root mean square of the rest
    /// [rad]. The offset of the encoders is the other log's own.
    pub fn predicts(&self, other: &GearLog) -> (f64, f64) {
        judged(&other.rows(), &self.values, true)
    }

    /// What delay and hysteresis alone leave of another log, found without a spring: root mean square [rad].
    pub fn left_without(&self, other: &GearLog) -> f64 {
        judged(&other.rows(), &self.without, true).1
    }

    /// The difference of a log's angles at each instant, measured and by what was found, both without the log's own offset
    /// [rad].
    pub fn beside(&self, log: &GearLog) -> Vec<[f64; 2]> {
        let rows = log.rows();
        let by_gear: Vec<f64> = rows.iter().map(|(row, _)| row.dot(&self.values) - self.values[0]).collect();
        let offset =
            rows.iter().zip(&by_gear).map(|((_, value), own)| value - own).sum::<f64>() / rows.len() as f64;
        rows.iter().zip(by_gear).map(|((_, value), own)| [value - offset, own]).collect()
    }
}

/// Share of the variance that values explain, and root mean square of the rest.
fn judged(rows: &[(Vector4<f64>, f64)], values: &Vector4<f64>, own_offset: bool) -> (f64, f64) {
    let count = rows.len() as f64;
    let rests: Vec<f64> = rows.iter().map(|(row, value)| value - row.dot(values)).collect();
    let offset = if own_offset { rests.iter().sum::<f64>() / count } else { 0.0 };
    let mean = rows.iter().map(|(_, value)| value).sum::<f64>() / count;
    let whole: f64 = rows.iter().map(|(_, value)| (value - mean).powi(2)).sum();
    let left: f64 = rests.iter().map(|rest| (rest - offset).powi(2)).sum();
    (1.0 - left / whole, (left / count).sqrt())
}

/// Compliances of an arm one of whose gears was measured.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct MeasuredJoint {
    /// Those of all six joints [rad/(N m)].
    pub joint_compliance_rad_per_nm: [f64; 6],
    /// Their covariance [(rad/(N m))^2], for a job's `uncertainty.compliance_covariance`.
    pub compliance_covariance: [[f64; 6]; 6],
}

impl Gear {
    /// An arm with this gear: `compliance` [rad/(N m)] and `spread` are those of the arm before. The measured joint varies by
    /// its own interval, the others as before. `None` if the load did not show the spring, or motor and load seem swapped.
    pub fn in_arm(&self, compliance: &[f64; 6], spread: &Stiffness) -> Option<MeasuredJoint> {
        self.stiffness().filter(|_| !self.is_ahead())?;
        let mut joint_compliance_rad_per_nm = *compliance;
        joint_compliance_rad_per_nm[self.joint] = self.values[1];
        let own = (self.halves[1] / COVERAGE).powi(2);
        let logarithms = spread.covariance();
        let compliance_covariance = std::array::from_fn(|i| {
            std::array::from_fn(|j| match (i == self.joint, j == self.joint) {
                (true, true) => own,
                (false, false) => compliance[i] * compliance[j] * (math::exp(logarithms[(i, j)]) - 1.0),
                _ => 0.0,
            })
        });
        Some(MeasuredJoint { joint_compliance_rad_per_nm, compliance_covariance })
    }
}
