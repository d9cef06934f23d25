//! Factors on stiffness and cutting force that a measured pass supports, and what is left unknown of them.
//!
//! The logarithms theta of nine factors (six joint compliances, the cutting force, its radial and its axial ratio) and a
//! constant offset of the measurement are estimated at once: the maximum of the posterior, with the job's own spreads as the prior,
//! by Gauss-Newton steps (A. Tarantola, Inverse Problem Theory, SIAM 2005, 3.4). With the residuals r, their derivative J, the
//! noise s of a residual and the prior covariance P, a step is (J^T J / s^2 + P^-1)^-1 (J^T r / s^2 - P^-1 theta), and the
//! matrix that is inverted is the covariance of what is left unknown.
//!
//! Residuals are means over blocks of the run, because neighboring samples err alike; the noise is what the fit leaves of them,
//! widened by how much neighboring blocks still err alike: (1 + rho) / (1 - rho) times the variance, rho the correlation
//! of one block with the next. Deflection alone determines products of compliance and force. What cannot be told apart
//! stays unknown, and the covariance says how it is tied.

use crate::cutting::{PartForces, along};
use crate::deviation::{Sources, contour};
use crate::identify::student::quantile_975;
use crate::learn::MeasuredPass;
use crate::learn::measured::{Seen, root_mean_square};
use crate::math;
use crate::report::Report;
use crate::robot::Joints;
use crate::spread::cholesky;
use crate::uncertainty::Draw;
use crate::uncertainty::place::{DrawnPlace, places};
use crate::units::MM;
use nalgebra::{SMatrix, SVector, Vector3};

/// Nine logarithms and three components of an offset.
const COUNT: usize = 12;
type Unknowns = SVector<f64, COUNT>;
type Square = SMatrix<f64, COUNT, COUNT>;
/// What the model says of a block.
type BlockModel<'a> = Box<dyn Fn(usize, &Unknowns) -> Vector3<f64> + 'a>;

/// Most blocks.
const BLOCKS: usize = 80;
/// Places at which the model is evaluated in each.
const EACH: usize = 6;
/// Gauss-Newton steps; the noise is estimated again after each.
const STEPS: usize = 12;
/// Step of a numerical derivative.
const STEP: f64 = 1e-4;
/// Standard deviation of the offset that a measurement's frame may have [m].
const OFFSET: f64 = 0.1 * MM;
/// Least noise of a block [m] and [N]: below it, no instrument reads.
const LEAST: [f64; 2] = [1e-7, 1e-2];

/// A factor with its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FactorInterval {
    /// The factor.
    pub value: f64,
    /// Both ends.
    pub interval: [f64; 2],
    /// The interval before the measurement.
    pub prior: [f64; 2],
}

/// What a measured pass says of arm and cut.
#[derive(Debug, Clone, PartialEq)]
pub struct LearnedFactors {
    /// Logarithms of the factors: six compliances, cutting force, radial and axial ratio.
    pub logarithm: [f64; 9],
    /// Covariance of what is still unknown of them.
    pub covariance: [[f64; 9]; 9],
    /// What reaches to each side of a 95 % interval, in standard deviations (Student's t).
    pub reach: f64,
    /// On the stiffness of each joint; `None` of a rigid one.
    pub stiffness: [Option<FactorInterval>; 6],
    /// On the cutting force.
    pub cutting: FactorInterval,
    /// On its radial and its axial ratio.
    pub ratios: [FactorInterval; 2],
    /// Constant offset of the measurement in the base frame [m], and its standard deviation along each axis.
    pub offset: (Vector3<f64>, Vector3<f64>),
    /// Share of the mean square that the model explained before, and that it explains now, of where the tip was; `None` of a
    /// log of forces.
    pub explained: Option<[f64; 2]>,
    /// The same of the force.
    pub force_explained: Option<[f64; 2]>,
    /// What is left of the tip's error in each block [m], with its arc length [m].
    pub rest: Vec<(f64, Vector3<f64>)>,
    /// Number of blocks, and correlation of what is left of one with the next.
    pub blocks: usize,
    /// See there.
    pub alike: f64,
}

impl LearnedFactors {
    /// On the compliance of each joint.
    pub fn compliance_factors(&self) -> [f64; 6] {
        std::array::from_fn(|joint| math::exp(self.logarithm[joint]))
    }

    /// On the tangential, radial and axial part of the force.
    pub fn force_factors(&self) -> [f64; 3] {
        let [.., cutting, radial, axial] = self.logarithm;
        [cutting, cutting + radial, cutting + axial].map(math::exp)
    }
}

/// The draw at logarithms of factors.
fn draw_at(unknowns: &Unknowns) -> Draw {
    let factor = |index: usize| math::exp(unknowns[index]);
    Draw {
        compliance: std::array::from_fn(factor),
        force: [factor(6), factor(6) * factor(7), factor(6) * factor(8)],
        frequency: 1.0,
    }
}

/// Means over a block of the run.
struct BlockMean {
    /// Its samples at which the model is evaluated.
    at: Vec<usize>,
    measured: Vector3<f64>,
    /// Number of samples that were measured.
    count: usize,
}

/// The blocks of a series.
fn blocks(values: &[Option<Vector3<f64>>]) -> Vec<BlockMean> {
    let length = values.len().div_ceil(BLOCKS).max(1);
    let block = |from: usize| {
        let known: Vec<usize> =
            (from..(from + length).min(values.len())).filter(|k| values[*k].is_some()).collect();
        if 2 * known.len() < length {
            return None;
        }
        let sum: Vector3<f64> = known.iter().filter_map(|k| values[*k]).sum();
        let step = known.len() as f64 / EACH as f64;
        let mut at: Vec<usize> = (0..EACH).map(|k| known[((k as f64 + 0.5) * step) as usize]).collect();
        at.dedup();
        Some(BlockMean { at, measured: sum / known.len() as f64, count: known.len() })
    };
    (0..values.len()).step_by(length).filter_map(block).collect()
}

/// A measured quantity in blocks, and the model of it.
struct Measurand<'a> {
    blocks: Vec<BlockMean>,
    /// What the model says of a block.
    model: BlockModel<'a>,
    /// Directions in which it was measured.
    directions: usize,
    /// Least noise of a block.
    least: f64,
}

impl Measurand<'_> {
    fn residuals(&self, unknowns: &Unknowns) -> Vec<Vector3<f64>> {
        let residual = |(k, block): (usize, &BlockMean)| block.measured - (self.model)(k, unknowns);
        self.blocks.iter().enumerate().map(residual).collect()
    }

    /// J^T J and J^T r at these unknowns.
    fn normal_equations(&self, unknowns: &Unknowns) -> (Square, Unknowns) {
        let (mut square, mut side) = (Square::zeros(), Unknowns::zeros());
        for (k, residual) in self.residuals(unknowns).into_iter().enumerate() {
            let grown: [Vector3<f64>; COUNT] = std::array::from_fn(|i| {
                let step = if i < 9 { STEP } else { STEP * MM };
                let at = |sign: f64| {
                    let mut moved = *unknowns;
                    moved[i] += sign * step;
                    (self.model)(k, &moved)
                };
                (at(1.0) - at(-1.0)) / (2.0 * step)
            });
            for i in 0..COUNT {
                for j in 0..COUNT {
                    square[(i, j)] += grown[i].dot(&grown[j]);
                }
                side[i] += grown[i].dot(&residual);
            }
        }
        (square, side)
    }

    /// Variance of a residual in one direction, and how alike neighbors are; `known` unknowns were taken from the data.
    fn variance(&self, unknowns: &Unknowns, known: f64) -> (f64, f64) {
        let residuals = self.residuals(unknowns);
        let squares: f64 = residuals.iter().map(Vector3::norm_squared).sum();
        let beside: f64 = residuals.windows(2).map(|pair| pair[0].dot(&pair[1])).sum();
        let alike = if squares > 0.0 { (beside / squares).clamp(0.0, 0.9) } else { 0.0 };
        let freedom = ((residuals.len() * self.directions) as f64 - known).max(1.0);
        let variance = squares / freedom * (1.0 + alike) / (1.0 - alike);
        (variance.max(self.least * self.least), alike)
    }

    fn freedom(&self) -> f64 {
        (self.blocks.len() * self.directions) as f64
    }

    /// Share of the mean square that is explained.
    fn explained(&self, unknowns: &Unknowns) -> f64 {
        let whole: f64 = self.blocks.iter().map(|block| block.measured.norm_squared()).sum();
        let rest: f64 = self.residuals(unknowns).iter().map(Vector3::norm_squared).sum();
        if whole > 0.0 { 1.0 - rest / whole } else { 0.0 }
    }
}

/// Estimates them.
pub fn estimate(report: &Report, measured: &MeasuredPass) -> LearnedFactors {
    let tip = tip_series(report, measured);
    let force = force_series(report, measured);
    let all: Vec<&Measurand> = [&tip, &force].into_iter().flatten().collect();
    let prior = prior(report);
    // In the deviates z of the prior, theta = B z, which has an inverse even where the prior leaves no freedom.
    let root = cholesky(&prior).unwrap_or_else(Square::zeros);
    let mut z = Unknowns::zeros();
    let start = |series: &&Measurand| {
        let size = root_mean_square(series.residuals(&Unknowns::zeros()).iter());
        (0.3 * size).max(series.least).powi(2)
    };
    let mut variances: Vec<f64> = all.iter().map(start).collect();
    let mut inverse = Square::identity();
    for _ in 0..STEPS {
        let unknowns = root * z;
        let (mut square, mut side) = (Square::identity(), -z);
        for (series, variance) in all.iter().zip(&variances) {
            let (own, grown) = series.normal_equations(&unknowns);
            square += root.transpose() * own * root / *variance;
            side += root.transpose() * grown / *variance;
        }
        let Some(factored) = square.cholesky() else { break };
        inverse = factored.inverse();
        // A step of more than one prior deviation may overshoot a model that is not linear.
        let step = inverse * side;
        z += step * (2.0 / step.amax()).min(1.0);
        let known = COUNT as f64 - inverse.trace();
        let whole: f64 = all.iter().map(|series| series.freedom()).sum();
        for (series, variance) in all.iter().zip(&mut variances) {
            *variance = series.variance(&(root * z), known * series.freedom() / whole).0;
        }
    }
    let unknowns = root * z;
    let covariance = root * inverse * root.transpose();
    let known = COUNT as f64 - inverse.trace();
    let freedom: f64 = all.iter().map(|series| series.freedom()).sum();
    let reach = quantile_975(((freedom - known).floor().max(1.0)) as usize);
    let interval = |sum: &dyn Fn(&Unknowns) -> f64, variance: f64, of_prior: f64| {
        let middle = sum(&unknowns);
        let [own, before] = [reach * variance.max(0.0).sqrt(), crate::spread::COVERAGE * of_prior.sqrt()];
        FactorInterval {
            value: math::exp(middle),
            interval: [math::exp(middle - own), math::exp(middle + own)],
            prior: [math::exp(-before), math::exp(before)],
        }
    };
    let plain = |i: usize| interval(&move |theta| theta[i], covariance[(i, i)], prior[(i, i)]);
    let stiffness = std::array::from_fn(|i| {
        let soft = report.plan.robot.compliance()[i] > 0.0 || report.plan.robot.statics().is_some();
        soft.then(|| interval(&move |theta| -theta[i], covariance[(i, i)], prior[(i, i)]))
    });
    let alike = all.iter().map(|series| series.variance(&unknowns, known).1).fold(0.0, f64::max);
    let rest = tip.as_ref().map_or(vec![], |series| {
        let s = &report.plan.trajectory.timing.arc_length;
        let place = |block: &BlockMean| s[block.at[block.at.len() / 2]];
        series.blocks.iter().map(place).zip(series.residuals(&unknowns)).collect()
    });
    let shares = |series: &Measurand| [Unknowns::zeros(), unknowns].map(|theta| series.explained(&theta));
    LearnedFactors {
        logarithm: std::array::from_fn(|i| unknowns[i]),
        covariance: std::array::from_fn(|i| {
            std::array::from_fn(|j| 0.5 * (covariance[(i, j)] + covariance[(j, i)]))
        }),
        reach,
        stiffness,
        cutting: plain(6),
        ratios: [plain(7), plain(8)],
        offset: (
            Vector3::new(unknowns[9], unknowns[10], unknowns[11]),
            Vector3::from_fn(|axis, _| covariance[(9 + axis, 9 + axis)].max(0.0).sqrt()),
        ),
        explained: tip.as_ref().map(shares),
        force_explained: force.as_ref().map(shares),
        blocks: all.iter().map(|series| series.blocks.len()).max().unwrap_or(0),
        rest,
        alike,
    }
}

/// The covariance before the measurement.
fn prior(report: &Report) -> Square {
    let mut prior = Square::zeros();
    prior.fixed_view_mut::<9, 9>(0, 0).copy_from(&report.setup().spreads.covariance());
    for axis in 9..COUNT {
        prior[(axis, axis)] = OFFSET * OFFSET;
    }
    prior
}

/// The samples at which the model is evaluated.
fn places_of(blocks: &[BlockMean]) -> Vec<usize> {
    blocks.iter().flat_map(|block| block.at.iter().copied()).collect()
}

/// Where the tip was.
fn tip_series<'a>(report: &'a Report, measured: &'a MeasuredPass) -> Option<Measurand<'a>> {
    let seen = |(k, error): (usize, &Option<Vector3<f64>>)| Some(measured.seen.part(k, &(*error)?));
    let errors: Vec<_> = measured.error.iter().enumerate().map(seen).collect();
    let blocks = blocks(&errors);
    if blocks.is_empty() {
        return None;
    }
    let plan = &report.plan;
    let timing = plan.timing(Sources::ALL);
    let parts = PartForces::of(&plan.setup.cut, plan.setup.contacts.as_ref());
    let at = places_of(&blocks);
    let drawn = places(plan, (&timing, &parts), (&measured.q as &[Joints], &at), 0.0);
    let mut from = 0;
    let of_block: Vec<Vec<(usize, DrawnPlace)>> = blocks
        .iter()
        .map(|block| {
            let own = block.at.iter().copied().zip(drawn[from..from + block.at.len()].iter().copied());
            from += block.at.len();
            own.collect()
        })
        .collect();
    let only_joints = measured.only_joints;
    let model = move |k: usize, unknowns: &Unknowns| {
        let draw = draw_at(unknowns);
        let offset = Vector3::new(unknowns[9], unknowns[10], unknowns[11]);
        let places = &of_block[k];
        let off = |(sample, place): &(usize, DrawnPlace)| {
            let tip = place.tip(plan, &draw) + offset;
            let zero = match measured.seen {
                _ if only_joints => place.tip(plan, &Draw { compliance: [0.0; 6], ..draw }),
                Seen::Everywhere => place.target,
                // As it was measured: a path bends between where the tip should be and where it is closest.
                _ => contour::closest(&plan.path, (place.arc_length, &place.target), &tip).point,
            };
            measured.seen.part(*sample, &(tip - zero))
        };
        places.iter().map(off).sum::<Vector3<f64>>() / places.len() as f64
    };
    let counted = blocks.iter().map(|block| block.count).max().unwrap_or(1);
    let least = (measured.noise / (counted as f64).sqrt()).max(LEAST[0]);
    Some(Measurand { blocks, model: Box::new(model), directions: measured.seen.directions(), least })
}

/// The force on the tool.
fn force_series<'a>(report: &'a Report, measured: &'a MeasuredPass) -> Option<Measurand<'a>> {
    let blocks = blocks(&measured.force);
    if blocks.is_empty() {
        return None;
    }
    let plan = &report.plan;
    let timing = plan.timing(Sources::ALL);
    let parts = PartForces::of(&plan.setup.cut, plan.setup.contacts.as_ref());
    let at = places_of(&blocks);
    let cuts = along::parts(&plan.path, &timing, &parts, &plan.setup.loading, &at);
    // Where the force follows the deflection, it differs from the planned one as the nominal arm's does.
    let beyond = |sample: usize| report.force[sample] - report.planned_force[sample];
    let mut from = 0;
    let of_block: Vec<[Vector3<f64>; 4]> = blocks
        .iter()
        .map(|block| {
            let count = block.at.len() as f64;
            let mut sums = [Vector3::zeros(); 4];
            for (sample, (force, _)) in block.at.iter().zip(&cuts[from..from + block.at.len()]) {
                for part in 0..3 {
                    sums[part] += force[part] / count;
                }
                sums[3] += beyond(*sample) / count;
            }
            from += block.at.len();
            sums
        })
        .collect();
    let model = move |k: usize, unknowns: &Unknowns| {
        let [t, r, a, beyond] = of_block[k];
        let [tangential, radial, axial] = draw_at(unknowns).force;
        t * tangential + r * radial + a * axial + beyond
    };
    Some(Measurand { blocks, model: Box::new(model), directions: 3, least: LEAST[1] })
}
