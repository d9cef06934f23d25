//! What a loop would bring for a job: nothing, off-line correction, the loop, and both, over drawn plants.
//!
//! The error is that of the tip against the path, as in the band, all along the run. The controller knows the nominal arm:
//! a measured force is the drawn plant's, and what it should bend the arm by is computed with the assumed compliance. With
//! corrected commands only what differs from the planned force is fed forward, for the rest is taken back already. A position
//! is measured against the path, and bent joints against what the commands expect. The loop has settled where the run begins: what the entry into the material leaves there is
//! not counted. The filter of the controller has its nominal frequency, and the correction is not filtered by it.

use crate::cutting::PartForces;
use crate::deviation::contour;
use crate::error::Error;
use crate::job::Sources;
use crate::math;
use crate::online::simulated::{fed_back, fed_forward};
use crate::online::{FeedForward, Feedback, LoopTimes, Sensor, spectrum};
use crate::plan::Plan;
use crate::report::Report;
use crate::robot::Joints;
use crate::study::at_once;
use crate::uncertainty::Quantiles;
use crate::uncertainty::draw::{self, Draw};
use crate::uncertainty::place::{DrawnPlace, places};
use nalgebra::Vector3;
use serde::Serialize;

/// Most cycles of a run: an hour at 4 ms.
const CYCLES: usize = 1_000_000;
/// The loop settles for so many times its delays before the run begins.
const SETTLES: f64 = 20.0;
/// Places that are looked at to find that order.
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
    /// a loop, so that its quantiles are those of all.
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
        self.largest_stable_gain.is_none_or(|most| self.gain < most)
    }
}

/// Compares the four for a run.
///
/// # Errors
/// [`Error::Invalid`] if a time is out of its range, a gain is not above 0, or the run has too many cycles.
pub fn compare(report: &Report, online: &OnlineLoop) -> Result<Comparison, Error> {
    let plan = &report.plan;
    let track = Track::new(plan, &online.times)?;
    let acting = Acting::new(online)?;
    let spreads = &plan.setup.spreads;
    let draws: Vec<Draw> = draw::deviates(spreads.seed, spreads.draws)
        .iter()
        .map(|z| Draw { frequency: 1.0, ..Draw::at(spreads, z) })
        .collect();
    let settles = settling(&online.times);
    // Where the band is widest, the order of all plants is seen.
    let few = Track { at: widest(report), ..track };
    let runs = |q: &[Joints], expected: Draw| {
        let [sent, sent_to_few] = [&track, &few].map(|track| track.sent(plan, q));
        let tips = |sent: &[DrawnPlace], draw: &Draw| -> Vec<Vector3<f64>> {
            sent.iter().map(|place| place.tip(plan, draw)).collect()
        };
        let open = |track: &Track, sent: &[DrawnPlace], draw: &Draw| {
            track.largest(plan, (sent, &tips(sent, draw)), |_| Vector3::zeros())
        };
        let closed = |draw: &Draw| {
            let tips = tips(&sent, draw);
            let corrections = match &acting {
                Acting::Back { feedback, gain, .. } => {
                    let seen = match online.measures {
                        Measures::LoadSideAngle => track.bent_joints(plan, &sent, (draw, &expected)),
                        _ => track.errors(plan, (&sent, &tips)),
                    };
                    let errors = track.cycles(&seen, settles);
                    let left = fed_back(feedback, *gain, &online.sensor, &errors);
                    left.iter().zip(&errors).map(|(left, error)| left - error).collect()
                }
                Acting::Forward(forward) => {
                    let assumed = track.cycles(&track.assumed(plan, &sent, (draw, &expected)), settles);
                    let still = vec![Vector3::zeros(); assumed.len()];
                    fed_forward(forward, &online.sensor, (&still, &assumed))
                }
            };
            track.largest(plan, (&sent, &tips), |place| track.at_place(&corrections[settles..], place))
        };
        let without = evenly(&draws, online.plants, |draw| open(&few, &sent_to_few, draw));
        // Feedback leaves a share of what there is; a force, what it would if it were fed forward at once.
        let with = match &acting {
            Acting::Back { .. } => without.clone(),
            Acting::Forward(_) => evenly(&draws, online.plants, |draw| {
                let assumed = few.assumed(plan, &sent_to_few, (draw, &expected));
                few.largest(plan, (&sent_to_few, &tips(&sent_to_few, draw)), |place| -assumed[place])
            }),
        };
        let left = at_once(without.len(), |k| open(&track, &sent, &without[k]));
        let left_by_loop = acting.is_stable().then(|| at_once(with.len(), |k| closed(&with[k])));
        (Quantiles::of(left), left_by_loop.map(Quantiles::of))
    };
    // What the correction of the commands takes back already is not fed forward again.
    let no_force = Draw { force: [0.0; 3], ..Draw::NOMINAL };
    let (without, online_alone) = runs(&report.q, no_force);
    let (offline, both) = runs(&report.compensation.q, Draw::NOMINAL);
    let sent = track.sent(plan, &report.q);
    let tips: Vec<Vector3<f64>> = sent.iter().map(|place| place.tip(plan, &Draw::NOMINAL)).collect();
    let nominal = track.errors(plan, (&sent, &tips));
    let helps_below = acting.helps_below();
    let slow_share = helps_below.map_or(0.0, |frequency| {
        spectrum::share_below(&track.cycles(&nominal, 0), online.times.cycle, frequency)
    });
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

/// The samples of a run at which errors are computed, and its cycles.
struct Track {
    at: Vec<usize>,
    /// Cycles in the time between two of those samples.
    each: f64,
    count: usize,
}

impl Track {
    fn new(plan: &Plan, times: &LoopTimes) -> Result<Self, Error> {
        let LoopTimes { cycle, dead_time, arm_lag, filter } = *times;
        if !(1e-4..=1.0).contains(&cycle) {
            return Err(Error::invalid("online.cycle_s", cycle, "0.0001 to 1 s"));
        }
        for (field, time) in
            [("online.dead_time_s", dead_time), ("online.arm_lag_s", arm_lag), ("online.filter_s", filter)]
        {
            if !(0.0..=5.0).contains(&time) {
                return Err(Error::invalid(field, time, "0 to 5 s"));
            }
        }
        let samples = plan.trajectory.timing.arc_length.len();
        let step = plan.trajectory.sample_time;
        // No further apart than a cycle, where the run's samples are not.
        let stride = ((cycle / step + 1e-9).floor() as usize).max(1);
        let at: Vec<usize> = (0..samples).step_by(stride).collect();
        let each = cycle / (step * stride as f64);
        let count = ((at.len() - 1) as f64 / each + 1e-9).floor() as usize + 1;
        if count > CYCLES {
            return Err(Error::invalid("online.cycle_s", cycle, format!("at most {CYCLES} cycles in a run")));
        }
        Ok(Self { at, each, count })
    }

    /// Where joint commands [rad] take the tip there.
    fn sent(&self, plan: &Plan, q: &[Joints]) -> Vec<DrawnPlace> {
        let timing = plan.timing(Sources::ALL);
        let parts = PartForces::of(&plan.setup.cut, plan.setup.contacts.as_ref());
        places(plan, (&timing, &parts), (q, &self.at), 0.0)
    }

    /// Tips from the closest point of the path [m].
    fn errors(&self, plan: &Plan, (sent, tips): (&[DrawnPlace], &[Vector3<f64>])) -> Vec<Vector3<f64>> {
        let closest = |(place, tip): (&DrawnPlace, &Vector3<f64>)| {
            tip - contour::closest(&plan.path, (place.arc_length, &place.target), tip).point
        };
        sent.iter().zip(tips).map(closest).collect()
    }

    /// The largest contour error of tips with the correction at each place [m].
    fn largest(
        &self,
        plan: &Plan,
        (sent, tips): (&[DrawnPlace], &[Vector3<f64>]),
        correction: impl Fn(usize) -> Vector3<f64>,
    ) -> f64 {
        let places = sent.iter().zip(tips).enumerate();
        places
            .map(|(k, (place, tip))| place.near.error(&plan.path, &(tip + correction(k))))
            .fold(0.0, f64::max)
    }

    /// What a series at the cycles is at a place, straight in between.
    fn at_place(&self, series: &[Vector3<f64>], place: usize) -> Vector3<f64> {
        between(series, place as f64 / self.each)
    }

    /// What the drawn force bends the assumed arm by, beyond what an expected one does [m].
    fn assumed(
        &self,
        plan: &Plan,
        sent: &[DrawnPlace],
        (draw, expected): (&Draw, &Draw),
    ) -> Vec<Vector3<f64>> {
        let measured = Draw { force: draw.force, ..Draw::NOMINAL };
        sent.iter().map(|place| place.tip(plan, &measured) - place.tip(plan, expected)).collect()
    }

    /// Where bent joints take the tip with a drawn plant, from where they do with an expected one [m]: the tip less what a
    /// tool bends on a rigid arm.
    fn bent_joints(
        &self,
        plan: &Plan,
        sent: &[DrawnPlace],
        (draw, expected): (&Draw, &Draw),
    ) -> Vec<Vector3<f64>> {
        let joints = |place: &DrawnPlace, draw: &Draw| {
            place.tip(plan, draw) - place.tip(plan, &Draw { compliance: [0.0; 6], ..*draw })
        };
        sent.iter().map(|place| joints(place, draw) - joints(place, expected)).collect()
    }

    /// Values at the samples as values at the cycles, straight in between, after `settles` cycles of the first one.
    fn cycles(&self, values: &[Vector3<f64>], settles: usize) -> Vec<Vector3<f64>> {
        let at = |cycle: usize| between(values, cycle as f64 * self.each);
        std::iter::repeat_n(values[0], settles).chain((0..self.count).map(at)).collect()
    }
}

/// A series at a place between its values; beyond the last one, that.
fn between(series: &[Vector3<f64>], place: f64) -> Vector3<f64> {
    let last = series.len() - 1;
    let place = place.min(last as f64);
    let below = (place.floor() as usize).min(last);
    series[below].lerp(&series[(below + 1).min(last)], place - below as f64)
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

/// Cycles until the loop has settled.
fn settling(times: &LoopTimes) -> usize {
    let LoopTimes { cycle, dead_time, arm_lag, filter } = *times;
    (SETTLES * (cycle + dead_time + arm_lag + filter) / cycle).ceil() as usize
}
