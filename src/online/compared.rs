//! What a loop would bring for a job: nothing, off-line correction, the loop, and both, over drawn plants.
//!
//! The error is that of the tip against the path, as in the band, all along the run. The controller knows the nominal arm:
//! a measured force is the drawn plant's, and what it should bend the arm by is computed with the assumed compliance. With
//! corrected commands only what differs from the planned force is fed forward, for the rest is taken back already. A position
//! is measured against the path, and bent joints against what the commands expect. The loop has settled where the run
//! begins: what the entry into the material leaves there is not counted. The filter of the controller has its nominal
//! frequency, and the correction is not filtered by it.

use crate::error::Error;
use crate::math;
use crate::online::cycles::Cycles;
use crate::online::drawn_run::DrawnRun;
use crate::online::simulated::{fed_back, fed_forward};
use crate::online::{FeedForward, Feedback, LoopTimes, Sensor, spectrum};
use crate::report::Report;
use crate::robot::Joints;
use crate::study::at_once;
use crate::uncertainty::Quantiles;
use crate::uncertainty::draw::{self, Draw};
use nalgebra::Vector3;
use serde::Serialize;

/// Places at which the order of the plants is seen.
const RANKED_BY: usize = 48;
/// The largest |S| for which the gain is chosen.
pub const PEAK: f64 = 1.7;

/// What is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measures {
    /// The force on the tool; the deflection that it should cause is fed forward.
    Force,
    /// The position of the tool, by a tracker or a camera; it is fed back.
    Position,
    /// The joints' angles behind their gears, by encoders; how far they bend is fed back. The tool's bending and what the
    /// controller's filter does are not seen.
    LoadSideAngle,
}

/// A loop on top of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OnlineLoop {
    /// What is measured.
    pub measures: Measures,
    /// How late it acts.
    pub times: LoopTimes,
    /// What measures it. Noise and steps of a force are those of the deflection that it should cause.
    pub sensor: Sensor,
    /// Integral gain; without one, that for which the largest |S| is [`PEAK`]. A force is fed forward with the gain 1.
    pub gain: Option<f64>,
    /// Most plants that are simulated. Of more draws, those are that stand evenly in the order of what they leave without
    /// a loop, or with a force that is fed forward at once: their quantiles are close to those of all.
    pub plants: usize,
}

/// The largest contour error [m] over the plants, with and without a loop.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// With the desired path commanded.
    pub without: Quantiles,
    /// With the corrected path commanded.
    pub offline: Quantiles,
    /// With the desired path commanded, and the loop; `None` if it is not stable.
    pub online: Option<Quantiles>,
    /// With the corrected path commanded, and the loop; `None` if it is not stable.
    pub both: Option<Quantiles>,
    /// Gain of the loop.
    pub gain: f64,
    /// Gain from which on it is not stable; a force that is fed forward is stable with any.
    pub largest_stable_gain: Option<f64>,
    /// Below which frequency it leaves less than there was [Hz]; `None` if at none.
    pub helps_below: Option<f64>,
    /// Share of the mean square of the nominal arm's error, with the desired path commanded, that lies below it.
    pub slow_share: f64,
}

impl Comparison {
    /// Whether the loop is stable.
    pub fn stable(&self) -> bool {
        self.online.is_some()
    }
}

/// Compares the four for a run.
///
/// # Errors
/// [`Error::Invalid`] if a time is out of its range, a gain is not above 0, or the run has too many cycles.
pub fn compare(report: &Report, online: &OnlineLoop) -> Result<Comparison, Error> {
    let plan = &report.plan;
    let cycles = Cycles::new(plan, &online.times)?;
    let acting = Acting::new(online)?;
    let spreads = &plan.setup.spreads;
    let draws: Vec<Draw> = draw::deviates(spreads.seed, spreads.draws)
        .iter()
        .map(|z| Draw { frequency: 1.0, ..Draw::at(spreads, z) })
        .collect();
    // Where the band is widest, the order of all plants is seen.
    let seen_at = widest(report);
    let runs = |(run, few): (&DrawnRun, &DrawnRun)| {
        let without =
            evenly(&draws, online.plants, |draw| few.largest(&few.tips(draw), |_| Vector3::zeros()));
        // Feedback leaves a share of what there is; a force, what it would if it were fed forward at once.
        let with = match &acting {
            Acting::Back { .. } => without.clone(),
            Acting::Forward(_) => evenly(&draws, online.plants, |draw| {
                let assumed = few.assumed(draw);
                few.largest(&few.tips(draw), |place| -assumed[place])
            }),
        };
        let open = |k: usize| run.largest(&run.tips(&without[k]), |_| Vector3::zeros());
        let closed = |k: usize| {
            let tips = run.tips(&with[k]);
            // No two plants meet the same noise.
            let sensor = Sensor { seed: online.sensor.seed.wrapping_add(k as u64), ..online.sensor };
            let corrections = match &acting {
                Acting::Back { feedback, gain, .. } => {
                    let seen = match online.measures {
                        Measures::LoadSideAngle => run.bent_joints(&with[k]),
                        _ => run.errors(&tips),
                    };
                    let errors = cycles.settled(&seen);
                    let left = fed_back(feedback, *gain, &sensor, &errors);
                    left.iter().zip(&errors).map(|(left, error)| left - error).collect()
                }
                Acting::Forward(forward) => {
                    let assumed = cycles.settled(&run.assumed(&with[k]));
                    let still = vec![Vector3::zeros(); assumed.len()];
                    fed_forward(forward, &sensor, (&still, &assumed))
                }
            };
            run.largest(&tips, |sample| cycles.at_sample(&corrections, sample))
        };
        let left = Quantiles::of(at_once(without.len(), open));
        (left, acting.is_stable().then(|| Quantiles::of(at_once(with.len(), closed))))
    };
    // What the correction of the commands takes back already is not fed forward again.
    let sent = |q: &[Joints], expected: Draw| {
        [&cycles.at, &seen_at].map(|at| DrawnRun::new(plan, (q, at), expected))
    };
    let [desired, few] = sent(&report.q, Draw { force: [0.0; 3], ..Draw::NOMINAL });
    let (without, online_alone) = runs((&desired, &few));
    let errors = cycles.of(&desired.errors(&desired.tips(&Draw::NOMINAL)));
    drop((desired, few));
    let [kept, few] = sent(&report.compensation.q, Draw::NOMINAL);
    let (offline, both) = runs((&kept, &few));
    let helps_below = acting.helps_below();
    let slow_share =
        helps_below.map_or(0.0, |frequency| spectrum::share_below(&errors, online.times.cycle, frequency));
    Ok(Comparison {
        without,
        offline,
        online: online_alone,
        both,
        gain: acting.gain(),
        largest_stable_gain: acting.largest_stable_gain(),
        helps_below,
        slow_share,
    })
}

/// A loop with its gain.
enum Acting {
    Forward(FeedForward),
    Back { feedback: Feedback, gain: f64, most: f64 },
}

impl Acting {
    fn new(online: &OnlineLoop) -> Result<Self, Error> {
        if online.measures == Measures::Force {
            return Ok(Self::Forward(FeedForward::new(&online.times)));
        }
        let feedback = Feedback::new(&online.times);
        let gain = online.gain.unwrap_or_else(|| feedback.gain_for_peak(PEAK));
        if !(gain > 0.0 && gain.is_finite()) {
            return Err(Error::invalid("online.gain", gain, "a number above 0"));
        }
        Ok(Self::Back { feedback, gain, most: feedback.largest_stable_gain() })
    }

    fn gain(&self) -> f64 {
        match self {
            Self::Forward(_) => 1.0,
            Self::Back { gain, .. } => *gain,
        }
    }

    fn largest_stable_gain(&self) -> Option<f64> {
        match self {
            Self::Forward(_) => None,
            Self::Back { most, .. } => Some(*most),
        }
    }

    fn is_stable(&self) -> bool {
        self.largest_stable_gain().is_none_or(|most| self.gain() < most)
    }

    fn helps_below(&self) -> Option<f64> {
        match self {
            Self::Forward(forward) => forward.helps_below(1.0),
            Self::Back { feedback, gain, .. } => feedback.helps_below(*gain).filter(|_| self.is_stable()),
        }
    }
}

/// The samples where the band is widest, and as many all along, rising.
fn widest(report: &Report) -> Vec<usize> {
    let band = &report.band;
    let widest = math::rising(0..band.samples.len(), |place| -band.p95[*place]);
    let along = (0..band.samples.len()).step_by(band.samples.len().div_ceil(RANKED_BY / 2));
    let places = widest.into_iter().take(RANKED_BY / 2).chain(along).map(|place| band.samples[place]);
    let mut at = math::rising(places, |sample| *sample as f64);
    at.dedup();
    at
}

/// At most `count` of the draws, evenly spread in the order of their sizes.
fn evenly(draws: &[Draw], count: usize, size: impl Fn(&Draw) -> f64) -> Vec<Draw> {
    if draws.len() <= count {
        return draws.to_vec();
    }
    let sizes: Vec<f64> = draws.iter().map(size).collect();
    let order = math::rising(0..draws.len(), |k| sizes[*k]);
    (0..count).map(|k| draws[order[(2 * k + 1) * order.len() / (2 * count)]]).collect()
}
