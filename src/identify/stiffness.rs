//! Joint compliances from loaded poses.
//!
//! The displacement of the TCP under a wrench W is linear in the joint compliances c_i (thesis eqs.
//! 3.47, 3.48, sorted by joint):
//!
//! ```text
//! d = J C_theta J^T W = sum over i of  J_i (J_i^T W) c_i
//! ```
//!
//! so each measured component is one row of A c = b, solved by non-negative least squares with
//! equal weights.

use crate::error::Error;
use crate::identify::eigen::eigen;
use crate::identify::measurement::Measurement;
use crate::identify::{nnls, student};
use crate::robot::{Robot, jacobian::spring_jacobian};
use crate::spread::COVERAGE;
use nalgebra::{Matrix6, Vector6};

/// JSON path of the measurements, for errors.
const FIELD: &str = "measurements";
/// A direction counts as unseen if its singular value is below this share of the largest, with
/// columns scaled to unit length.
const UNSEEN: f64 = 1e-5;
/// A column shorter than this share of the longest is nothing but rounding error.
const UNLOADED: f64 = 1e-9;
/// Condition index above which a near dependency can do harm, and the share of variance above which
/// a joint takes part in it (D. Belsley, E. Kuh, R. Welsch, Regression Diagnostics, 1980, section
/// 3.2).
const HARMFUL: (f64, f64) = (30.0, 0.5);
/// Largest half-interval, as a share of the compliance, at which a compliance counts as known.
const KNOWN: f64 = 0.25;
/// Half-interval that the advice aims at, as a share of the compliance.
const WANTED: f64 = 0.1;

/// How well a joint's compliance is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Its interval reaches no more than a quarter to each side.
    Known,
    /// Its interval reaches further, but not to zero.
    Rough,
    /// Its interval reaches zero, or it is held there: these loads do not distinguish it from a
    /// rigid joint.
    Small,
    /// No load of these poses moves the TCP through this joint.
    Unloaded,
    /// Only its sum with other joints' compliances can be observed.
    Confounded,
}

impl Verdict {
    /// Stable slug.
    pub fn id(self) -> &'static str {
        match self {
            Verdict::Known => "known",
            Verdict::Rough => "rough",
            Verdict::Small => "small",
            Verdict::Unloaded => "idle",
            Verdict::Confounded => "entangled",
        }
    }
}

/// The result for one joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Compliance [rad/(N m)], zero or positive.
    pub compliance: f64,
    /// Its 95 % confidence interval [rad/(N m)]; infinite where it is unbounded.
    pub interval: (f64, f64),
    /// Whether it is held at zero, where the data alone would make it negative.
    pub at_zero: bool,
    /// Variance inflation: its variance as a multiple of what it would be if the other joints'
    /// columns were orthogonal to its own. Infinite where it cannot be separated from them.
    pub inflation: f64,
    /// Share of its variance from each singular direction, the best determined first; empty where
    /// there is no variance.
    pub shares: Vec<f64>,
    /// The joints, from 0, that are hard or impossible to separate from it.
    pub mixed_with: Vec<usize>,
    /// Factor on the loads that would bring its interval to 10 % on each side; none where more load
    /// does not help.
    pub load_factor: Option<f64>,
    /// The verdict on it.
    pub verdict: Verdict,
}

/// The residual of one row.
#[derive(Debug, Clone, PartialEq)]
pub struct Residual {
    /// Line of the text, from 1.
    pub line: usize,
    /// Length of the measured displacement [m].
    pub measured: f64,
    /// Length of the fitted displacement along the same axes [m].
    pub fitted: f64,
    /// Length of measured minus fitted [m].
    pub residual: f64,
    /// Length of the displacement along the same axes that a fit to all other rows predicts [m].
    pub predicted: f64,
    /// Length of measured minus predicted by a fit to all other rows [m].
    pub left_out: f64,
}

/// Joint compliances and how far to trust them.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The six joints.
    pub joints: [Joint; 6],
    /// Covariance of the six compliances [(rad/(N m))^2], as wide as their 95 % intervals with 1.96
    /// standard deviations; zero for joints held at zero or never loaded. None where joints cannot
    /// be separated.
    pub covariance: Option<[[f64; 6]; 6]>,
    /// The rows in the order of the text.
    pub rows: Vec<Residual>,
    /// Measured components minus free compliances.
    pub freedom: usize,
    /// Root mean square of the components' residuals [m].
    pub rms: f64,
    /// Standard deviation of one component [m], corrected for the degrees of freedom.
    pub deviation: f64,
    /// Share of the squared displacements that J C J^T explains; no mean is subtracted, because
    /// without load there is no displacement.
    pub explained: f64,
    /// Ratio of largest to smallest singular value, columns scaled to unit length; infinite where a
    /// direction is unseen.
    pub condition: f64,
}

impl Fit {
    /// The compliances [rad/(N m)].
    pub fn compliance(&self) -> [f64; 6] {
        self.joints.each_ref().map(|joint| joint.compliance)
    }

    /// Mean over the rows of residual divided by measured length, for the fit itself and for the
    /// fits to all other rows.
    pub fn relative(&self) -> (f64, f64) {
        let moved: Vec<&Residual> = self.rows.iter().filter(|row| row.measured > 0.0).collect();
        let mean = |of: fn(&Residual) -> f64| {
            moved.iter().map(|row| of(row) / row.measured).sum::<f64>() / moved.len().max(1) as f64
        };
        (mean(|row| row.residual), mean(|row| row.left_out))
    }

    /// The rows with the largest residuals first.
    pub fn worst(&self) -> Vec<&Residual> {
        let mut rows: Vec<&Residual> = self.rows.iter().collect();
        rows.sort_by(|a, b| b.residual.total_cmp(&a.residual));
        rows
    }
}

/// One row's contribution to A c = b: for each measured component the six coefficients [m per
/// rad/(N m)] and the displacement [m].
pub fn equations(robot: &Robot, row: &Measurement) -> Vec<(Vector6<f64>, f64)> {
    let j = spring_jacobian(robot, &row.q);
    let torque = j.transpose() * row.wrench;
    let component = |axis: usize| {
        let coefficients = Vector6::from_fn(|i, _| j[(axis, i)] * torque[i]);
        row.displacement[axis].map(|measured| (coefficients, measured))
    };
    [0, 1, 2].into_iter().filter_map(component).collect()
}

/// The system A c = b of some rows, its normal equations, and their solution.
struct Solved {
    equations: Vec<Vec<(Vector6<f64>, f64)>>,
    g: Matrix6<f64>,
    h: Vector6<f64>,
    /// Sum of the squared displacements [m^2].
    square: f64,
    solution: nnls::NnlsSolution,
}

impl Solved {
    fn of(robot: &Robot, rows: &[Measurement]) -> Result<Self, Error> {
        let equations: Vec<_> = rows.iter().map(|row| equations(robot, row)).collect();
        let count: usize = equations.iter().map(Vec::len).sum();
        if count <= 6 {
            return Err(Error::invalid(
                FIELD,
                format!("{} rows with {count} displacements", rows.len()),
                "six compliances and their uncertainty need at least seven measured displacements, preferably 60",
            ));
        }
        let (mut g, mut h, mut square) = (Matrix6::zeros(), Vector6::zeros(), 0.0);
        for (a, b) in equations.iter().flatten() {
            g += a * a.transpose();
            h += a * *b;
            square += b * b;
        }
        let longest = (0..6).map(|i| g[(i, i)].sqrt()).fold(0.0, f64::max);
        if !(longest > 0.0 && square > 0.0) {
            let value = "without load or without displacement";
            return Err(Error::invalid(FIELD, value, "loads that move the TCP"));
        }
        // Columns of rounding error only are cleared.
        for i in (0..6).filter(|&i| g[(i, i)].sqrt() <= UNLOADED * longest).collect::<Vec<_>>() {
            g.set_row(i, &Matrix6::zeros().row(0));
            g.set_column(i, &Matrix6::zeros().column(0));
            h[i] = 0.0;
        }
        let solution = nnls::solve(&g, &h);
        Ok(Self { equations, g, h, square, solution })
    }
}

/// What compliances leave of a row [m^2].
fn left_by(row: &[(Vector6<f64>, f64)], c: &Vector6<f64>) -> f64 {
    row.iter().map(|(a, b)| (b - a.dot(c)) * (b - a.dot(c))).sum()
}

/// What they leave of all rows [m^2].
fn left(equations: &[Vec<(Vector6<f64>, f64)>], c: &Vector6<f64>) -> f64 {
    equations.iter().map(|row| left_by(row, c)).sum()
}

/// Share of the squared displacements of rows that a fit explains, without the rest of it.
///
/// # Errors
/// See [`fit`].
pub(super) fn explained(robot: &Robot, rows: &[Measurement]) -> Result<f64, Error> {
    let Solved { equations, square, solution, .. } = Solved::of(robot, rows)?;
    Ok(1.0 - left(&equations, &solution.x) / square)
}

/// Fits the joint compliances to the rows. The robot's own compliances are not used; its tool is,
/// since loads and displacements are given at the TCP.
///
/// The intervals assume that the errors of all components are independent and equally large, and
/// that joints held at zero are rigid. Where these are not, or where more than the joints is
/// compliant, the intervals are too narrow.
///
/// # Errors
/// [`Error::Invalid`] if there are too few measured components, or if nothing is loaded.
pub fn fit(robot: &Robot, rows: &[Measurement]) -> Result<Fit, Error> {
    let Solved { equations, g, h, square, solution } = Solved::of(robot, rows)?;
    let count: usize = equations.iter().map(Vec::len).sum();
    let left = left(&equations, &solution.x);
    let freedom = count - solution.free.iter().filter(|free| **free).count();
    let deviation = (left / freedom as f64).sqrt();
    let outcomes = rows.iter().zip(&equations).map(|(row, own)| {
        let (mut g, mut h) = (g, h);
        for (a, b) in own {
            g -= a * a.transpose();
            h -= a * *b;
        }
        let others = nnls::solve(&g, &h).x;
        let moved = |by: &Vector6<f64>| own.iter().map(|(a, _)| a.dot(by) * a.dot(by)).sum::<f64>().sqrt();
        Residual {
            line: row.line,
            measured: own.iter().map(|(_, b)| b * b).sum::<f64>().sqrt(),
            fitted: moved(&solution.x),
            predicted: moved(&others),
            residual: left_by(own, &solution.x).sqrt(),
            left_out: left_by(own, &others).sqrt(),
        }
    });
    let rows = outcomes.collect();
    let reach = student::quantile_975(freedom) * deviation;
    let poses = Poses::of(&g);
    Ok(Fit {
        joints: [0, 1, 2, 3, 4, 5].map(|i| poses.joint(i, &solution, &h, reach)),
        covariance: poses.covariance(&solution, reach),
        rows,
        freedom,
        rms: (left / count as f64).sqrt(),
        deviation,
        explained: 1.0 - left / square,
        condition: poses.condition(),
    })
}

/// The information in the poses and loads, whatever the measured displacements.
struct Poses {
    /// Length of each joint's column.
    length: Vector6<f64>,
    /// A^T A with columns of unit length.
    g: Matrix6<f64>,
    /// Squared singular values, largest first, and their directions; an unloaded joint has the
    /// value 1 and itself as direction.
    directions: Vec<(f64, Vector6<f64>)>,
    unloaded: [bool; 6],
    /// Joints that take part in an unseen direction.
    confounded: [bool; 6],
}

impl Poses {
    fn of(g: &Matrix6<f64>) -> Self {
        let length = Vector6::from_fn(|i, _| g[(i, i)].sqrt());
        let unloaded = [0, 1, 2, 3, 4, 5].map(|i| length[i] == 0.0);
        let g = Matrix6::from_fn(|i, j| match i == j {
            true => 1.0,
            false if unloaded[i] || unloaded[j] => 0.0,
            false => g[(i, j)] / (length[i] * length[j]),
        });
        let (values, vectors) = eigen(&g);
        let mut directions: Vec<_> = values
            .into_iter()
            .enumerate()
            .map(|(k, value)| (value, vectors.column(k).into_owned()))
            .collect();
        directions.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        let mut poses = Self { length, g, directions, unloaded, confounded: [false; 6] };
        for k in poses.unseen() {
            let (_, direction) = &poses.directions[k];
            for (i, confounded) in poses.confounded.iter_mut().enumerate() {
                *confounded |= direction[i].abs() > 1e-2;
            }
        }
        poses
    }

    fn is_unseen(&self, value: f64) -> bool {
        value <= UNSEEN * UNSEEN * self.directions[0].0
    }

    fn unseen(&self) -> Vec<usize> {
        (0..6).filter(|&k| self.is_unseen(self.directions[k].0)).collect()
    }

    fn condition(&self) -> f64 {
        let (largest, smallest) = (self.directions[0].0, self.directions[5].0);
        if self.is_unseen(smallest) || self.unloaded.contains(&true) {
            return f64::INFINITY;
        }
        (largest / smallest).sqrt()
    }

    /// Inverse of the scaled A^T A over some joints; none where they cannot be separated.
    fn inverse(&self, of: &[bool; 6]) -> Option<Matrix6<f64>> {
        nnls::restricted(&self.g, of).cholesky().map(|factor| factor.inverse())
    }

    /// The result for joint `i`; `reach` is the standard deviation of a component times Student's
    /// t.
    fn joint(&self, i: usize, solution: &nnls::NnlsSolution, h: &Vector6<f64>, reach: f64) -> Joint {
        let compliance = solution.x[i];
        let mixed_with = self.mixed(i);
        let confounded = self.confounded[i];
        if self.unloaded[i] || confounded {
            let (verdict, inflation) =
                if confounded { (Verdict::Confounded, f64::INFINITY) } else { (Verdict::Unloaded, 1.0) };
            let interval = (0.0, f64::INFINITY);
            let (shares, load_factor, at_zero) = (vec![], None, !solution.free[i]);
            return Joint {
                compliance,
                interval,
                at_zero,
                inflation,
                shares,
                mixed_with,
                load_factor,
                verdict,
            };
        }
        let distinct = [0, 1, 2, 3, 4, 5].map(|k| !self.confounded[k]);
        // A joint at zero is judged as if all were free, to see how large it might be.
        let at_zero = !solution.free[i];
        let judged = if at_zero { distinct } else { solution.free };
        let inverse = self.inverse(&judged).unwrap_or_else(Matrix6::identity);
        let half = reach * inverse[(i, i)].sqrt() / self.length[i];
        let centre = if at_zero { self.unconstrained(i, &inverse, h, &judged) } else { compliance };
        let interval = ((centre - half).max(0.0), (centre + half).max(0.0));
        let inflation = self.inverse(&distinct).map_or(f64::INFINITY, |inverse| inverse[(i, i)]);
        let share = half / compliance;
        let verdict = match interval.0 {
            low if low <= 0.0 || at_zero => Verdict::Small,
            _ if share <= KNOWN => Verdict::Known,
            _ => Verdict::Rough,
        };
        let load_factor = (!at_zero && share > WANTED).then_some(share / WANTED);
        Joint {
            compliance,
            interval,
            at_zero,
            inflation,
            shares: self.shares(i),
            mixed_with,
            load_factor,
            verdict,
        }
    }

    /// Covariance of the free compliances, `reach` being 1.96 standard deviations of a component; none
    /// where joints cannot be separated.
    fn covariance(&self, solution: &nnls::NnlsSolution, reach: f64) -> Option<[[f64; 6]; 6]> {
        if self.confounded.contains(&true) {
            return None;
        }
        let free: [bool; 6] = std::array::from_fn(|i| solution.free[i] && !self.unloaded[i]);
        let inverse = self.inverse(&free)?;
        let deviation = reach / COVERAGE;
        let scaled = |i: usize| if free[i] { deviation / self.length[i] } else { 0.0 };
        // Each pair from the same element, so that rows and columns agree to the last bit.
        Some(std::array::from_fn(|i| {
            std::array::from_fn(|j| inverse[(i.min(j), i.max(j))] * (scaled(i) * scaled(j)))
        }))
    }

    /// The compliance that least squares without bounds would give.
    fn unconstrained(&self, i: usize, inverse: &Matrix6<f64>, h: &Vector6<f64>, judged: &[bool; 6]) -> f64 {
        let scaled =
            Vector6::from_fn(|k, _| if judged[k] && !self.unloaded[k] { h[k] / self.length[k] } else { 0.0 });
        (inverse * scaled)[i] / self.length[i]
    }

    /// Variance decomposition (Belsley, Kuh, Welsch 1980, eq. 3.20).
    fn shares(&self, i: usize) -> Vec<f64> {
        let parts = self.directions.iter().map(|(value, direction)| match self.is_unseen(*value) {
            true => 0.0,
            false => direction[i] * direction[i] / value,
        });
        let parts: Vec<f64> = parts.collect();
        let whole: f64 = parts.iter().sum();
        parts.into_iter().map(|part| part / whole).collect()
    }

    /// The joints that share an unseen or a weak direction with joint i.
    fn mixed(&self, i: usize) -> Vec<usize> {
        let (harmful, large) = HARMFUL;
        let weak = |k: usize| self.directions[0].0 > harmful * harmful * self.directions[k].0;
        let takes_part = |k: usize, joint: usize| match self.is_unseen(self.directions[k].0) {
            true => self.directions[k].1[joint].abs() > 1e-2,
            false => weak(k) && self.shares(joint)[k] > large,
        };
        (0..6)
            .filter(|&other| other != i && (0..6).any(|k| takes_part(k, i) && takes_part(k, other)))
            .collect()
    }
}
