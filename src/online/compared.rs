//! What a loop would bring for a job: nothing, off-line correction, the loop, and both, over drawn plants.
//!
//! The error is that of the tip against the path, as in the band, all along the run. The controller knows the nominal arm:
//! a measured force is the drawn plant's, and what it should bend the arm by is computed with the assumed compliance. With
//! corrected commands only what differs from the planned force is fed forward, for the rest is taken back already. A position
//! is measured against the path, and bent joints against what the commands expect. The loop has settled where the run
//! begins: what the entry into the material leaves there is not counted. The filter of the controller has its nominal
//! frequency, and the correction is not filtered by it.

use crate::at_once::at_once;
use crate::error::Error;
use crate::job::{self, MeasuredOnline};
use crate::math;
use crate::online::cycles::Cycles;
use crate::online::drawn_run::DrawnRun;
use crate::online::simulated::{fed_back, fed_forward};
use crate::online::{FeedForward, Feedback, LoopTimes, Sensor, spectrum};
use crate::plan::Plan;
use crate::robot::Joints;
use crate::uncertainty::draw::{self, Draw};
use crate::uncertainty::{ErrorBand, Quantiles};
use crate::units::MM;
use nalgebra::Vector3;
use serde::Serialize;

/// Places at which the order of the plants is seen.
const RANKED_BY: usize = 48;
/// Plants that stand for all draws where not every one is simulated: their quantiles are within a few percent of those of
/// all.
pub const EVEN_PLANTS: usize = 60;
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
    /// Integral gain; without one, that for which the largest |S| is [`PEAK`]. A force is fed forward with it, by default 1.
    pub gain: Option<f64>,
    /// Most plants that are simulated. Of more draws, those are that stand evenly in the order of what they leave without
    /// a loop, or with a force that is fed forward at once: their quantiles are close to those of all.
    pub plants: usize,
}

impl OnlineLoop {
    /// The loop of a job, if it has one, with an even choice of plants.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a value that is not in its field's range.
    pub fn of(job: &job::Job) -> Result<Option<Self>, Error> {
        job::fields::check_ranges(job)?;
        let job::Online { cycle_s, dead_time_s, arm_lag_s, filter_s, noise, resolution, .. } = job.online;
        let measures = match job.online.measures {
            MeasuredOnline::None => return Ok(None),
            MeasuredOnline::Force => Measures::Force,
            MeasuredOnline::Position => Measures::Position,
            MeasuredOnline::LoadSideAngle => Measures::LoadSideAngle,
        };
        let largest = job.online.largest_correction_mm.number();
        Ok(Some(Self {
            measures,
            times: LoopTimes { cycle: cycle_s, dead_time: dead_time_s, arm_lag: arm_lag_s, filter: filter_s },
            sensor: Sensor {
                noise: noise * MM,
                seed: u64::from(job.uncertainty.seed),
                resolution: resolution * MM,
                largest_correction: largest.map_or(f64::INFINITY, |largest| largest * MM),
            },
            gain: job.online.gain.number(),
            plants: EVEN_PLANTS,
        }))
    }
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

/// A run that a loop may be put on top of.
#[derive(Debug, Clone, Copy)]
pub struct LoopedRun<'a> {
    /// Arm, path and motion.
    pub plan: &'a Plan,
    /// Joint commands for the desired path [rad].
    pub desired: &'a [Joints],
    /// Joint commands for the corrected path [rad].
    pub corrected: &'a [Joints],
    /// What is left with these: where it is widest, the order of the plants is seen.
    pub band: &'a ErrorBand,
}

impl LoopedRun<'_> {
    /// Compares the four.
    ///
    /// # Errors
    /// [`Error::Invalid`] if a time is out of its range, a gain is not above 0, or the run has too many cycles.
    pub fn with(&self, online: &OnlineLoop) -> Result<Comparison, Error> {
        let dead_time = [online.times.dead_time];
        self.by_dead_time(online, &dead_time)?.pop().ok_or_else(|| Error::invalid("online", "none", "a loop"))
    }

    /// The same with each of these dead times [s] instead of the loop's own.
    ///
    /// # Errors
    /// See [`with`](Self::with).
    pub fn by_dead_time(&self, online: &OnlineLoop, dead_times: &[f64]) -> Result<Vec<Comparison>, Error> {
        let late = |dead_time: &f64| {
            LateLoop::new(self.plan, online, LoopTimes { dead_time: *dead_time, ..online.times })
        };
        let loops: Vec<LateLoop> = dead_times.iter().map(late).collect::<Result<_, _>>()?;
        let Some(LateLoop { cycles, .. }) = loops.first() else { return Ok(Vec::new()) };
        let spreads = &self.plan.setup.spreads;
        let draws: Vec<Draw> = draw::deviates(spreads.seed, spreads.draws)
            .iter()
            .map(|z| Draw { frequency: 1.0, ..Draw::at(spreads, z) })
            .collect();
        let seen_at = widest(self.band);
        // What the correction of the commands takes back already is not fed forward again.
        let sent = |q, expected| [&cycles.at, &seen_at].map(|at| DrawnRun::new(self.plan, (q, at), expected));
        let [desired, few] = sent(self.desired, Draw { force: [0.0; 3], ..Draw::NOMINAL });
        let (without, online_alone) = left(&desired, &few, &draws, online, &loops);
        let errors = cycles.of(&desired.errors(&desired.tips(&Draw::NOMINAL)));
        drop((desired, few));
        let [kept, few] = sent(self.corrected, Draw::NOMINAL);
        let (offline, both) = left(&kept, &few, &draws, online, &loops);
        let compared = |((late, online), both): ((&LateLoop, Quantiles), Quantiles)| {
            let LateLoop { acting, .. } = late;
            let stable = acting.is_stable();
            let helps_below = acting.helps_below();
            Comparison {
                without,
                offline,
                online: stable.then_some(online),
                both: stable.then_some(both),
                gain: acting.gain(),
                largest_stable_gain: acting.largest_stable_gain(),
                helps_below,
                slow_share: helps_below
                    .map_or(0.0, |frequency| spectrum::share_below(&errors, late.times.cycle, frequency)),
            }
        };
        Ok(loops.iter().zip(online_alone).zip(both).map(compared).collect())
    }

    /// What the nominal arm leaves with the desired path commanded, at the frequencies of a run of this cycle [s], and how
    /// much of it a loop leaves.
    ///
    /// # Errors
    /// See [`with`](Self::with).
    pub fn spectrum(&self, online: &OnlineLoop) -> Result<LoopSpectrum, Error> {
        let late = LateLoop::new(self.plan, online, online.times)?;
        let expected = Draw { force: [0.0; 3], ..Draw::NOMINAL };
        let run = DrawnRun::new(self.plan, (self.desired, &late.cycles.at), expected);
        let errors = late.cycles.of(&run.errors(&run.tips(&Draw::NOMINAL)));
        let mut spectrum = LoopSpectrum { frequency: vec![], amplitude: vec![], left: vec![] };
        for (frequency, amplitude) in spectrum::amplitudes(&errors, online.times.cycle) {
            spectrum.frequency.push(frequency);
            spectrum.amplitude.push(amplitude);
            spectrum.left.push(late.acting.left(frequency));
        }
        Ok(spectrum)
    }
}

/// How fast the error of a run changes, and what a loop leaves of it.
#[derive(Debug, Clone, PartialEq)]
pub struct LoopSpectrum {
    /// Middles of bands of frequencies [Hz], rising.
    pub frequency: Vec<f64>,
    /// Root mean square [m] of the error in a band about each: one line of the spectrum, or a twelfth of a decade.
    pub amplitude: Vec<f64>,
    /// What the loop leaves of an error of the frequency: |S|, or |1 - r H| with r = 1.
    pub left: Vec<f64>,
}

/// The largest errors [m] of the plants: without a loop, and with each.
fn left(
    run: &DrawnRun,
    few: &DrawnRun,
    draws: &[Draw],
    online: &OnlineLoop,
    loops: &[LateLoop],
) -> (Quantiles, Vec<Quantiles>) {
    let still = |_| Vector3::zeros();
    let open = evenly(draws, online.plants, |draw| few.largest(&few.tips(draw), still));
    // Feedback leaves a share of what there is; a force, what it would if it were fed forward at once.
    let fed_forward = online.measures == Measures::Force;
    let closed = if fed_forward {
        evenly(draws, online.plants, |draw| {
            let assumed = few.assumed(draw);
            few.largest(&few.tips(draw), |place| -assumed[place])
        })
    } else {
        open.clone()
    };
    let alone = |draw: &Draw| run.largest(&run.tips(draw), still);
    let with_each = |k: usize| -> (f64, Vec<f64>) {
        let tips = run.tips(&closed[k]);
        let without = if fed_forward { alone(&open[k]) } else { run.largest(&tips, still) };
        let seen = match online.measures {
            Measures::Force => run.assumed(&closed[k]),
            Measures::LoadSideAngle => run.bent_joints(&closed[k]),
            Measures::Position => run.errors(&tips),
        };
        // No two plants meet the same noise.
        let sensor = Sensor { seed: online.sensor.seed.wrapping_add(k as u64), ..online.sensor };
        let with = |late: &LateLoop| {
            let corrections = late.corrections(&sensor, &seen);
            run.largest(&tips, |sample| late.cycles.at_sample(&corrections, sample))
        };
        (without, loops.iter().map(with).collect())
    };
    let all = at_once(open.len(), with_each);
    let of = |index: usize| Quantiles::of(all.iter().map(|(_, with)| with[index]).collect());
    (Quantiles::of(all.iter().map(|(without, _)| *without).collect()), (0..loops.len()).map(of).collect())
}

/// A loop with a dead time.
struct LateLoop {
    times: LoopTimes,
    cycles: Cycles,
    acting: Acting,
}

impl LateLoop {
    fn new(plan: &Plan, online: &OnlineLoop, times: LoopTimes) -> Result<Self, Error> {
        let online = OnlineLoop { times, ..*online };
        Ok(Self { times, cycles: Cycles::new(plan, &times)?, acting: Acting::new(&online)? })
    }

    /// What it corrects of what is seen at the samples, a value a cycle [m]; nothing if it is not stable.
    fn corrections(&self, sensor: &Sensor, seen: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let seen = self.cycles.settled(seen);
        let still = || vec![Vector3::zeros(); seen.len()];
        match &self.acting {
            Acting::Forward(forward) => fed_forward(forward, sensor, (&still(), &seen)),
            Acting::Back { .. } if !self.acting.is_stable() => still(),
            Acting::Back { feedback, gain, .. } => {
                let left = fed_back(feedback, *gain, sensor, &seen);
                left.iter().zip(&seen).map(|(left, error)| left - error).collect()
            }
        }
    }
}

/// A loop with its gain.
enum Acting {
    Forward(FeedForward),
    Back { feedback: Feedback, gain: f64, most: f64 },
}

impl Acting {
    fn new(online: &OnlineLoop) -> Result<Self, Error> {
        if let Some(gain) = online.gain.filter(|gain| !(*gain > 0.0 && gain.is_finite())) {
            return Err(Error::invalid("online.gain", gain, "a number above 0"));
        }
        if online.measures == Measures::Force {
            return Ok(Self::Forward(FeedForward::new(&online.times).with_gain(online.gain.unwrap_or(1.0))));
        }
        let feedback = Feedback::new(&online.times);
        let gain = online.gain.unwrap_or_else(|| feedback.gain_for_peak(PEAK));
        Ok(Self::Back { feedback, gain, most: feedback.largest_stable_gain() })
    }

    fn gain(&self) -> f64 {
        match self {
            Self::Forward(forward) => forward.gain,
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

    /// What it leaves of an error of one frequency [Hz], where the assumed compliance is the true one.
    fn left(&self, frequency: f64) -> f64 {
        match self {
            Self::Forward(forward) => forward.left(1.0, frequency),
            Self::Back { feedback, gain, .. } => feedback.left(*gain, frequency),
        }
    }

    fn helps_below(&self) -> Option<f64> {
        match self {
            Self::Forward(forward) => forward.helps_below(1.0),
            Self::Back { feedback, gain, .. } => feedback.helps_below(*gain).filter(|_| self.is_stable()),
        }
    }
}

/// The samples where the band is widest, and as many all along, rising.
fn widest(band: &ErrorBand) -> Vec<usize> {
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
