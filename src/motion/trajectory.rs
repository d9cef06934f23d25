//! The desired motion: arc length and position at each sample (thesis section 5.2, Figs. 5.2, 5.3).

use crate::math::PI;
use crate::motion::{Profile, Shaper, course};
use crate::path::{Axes, Corner, Move, MovePace, Path};
use nalgebra::Vector3;

/// Limits of the motion along the path, and its times at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionLimits {
    /// Highest speed of moves that state no feed [m/s].
    pub feed: f64,
    /// Speed of rapid moves [m/s].
    pub rapid: f64,
    /// Acceleration along the path [m/s^2].
    pub acceleration: f64,
    /// Sample time [s].
    pub sample_time: f64,
    /// A corner sharper than this is a full stop [rad].
    pub corner_angle: f64,
    /// Whether the path's points may be those of a smooth course, dense or rounded; see
    /// [`course`]. Points that Armill writes are exact.
    pub rounded: bool,
    /// Time at rest at such a corner [s].
    pub corner_dwell: f64,
    /// Time at rest after the end, for a shaped command to settle [s].
    pub settle: f64,
}

/// Timing law: progress along the path over time, one value per sample.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TimingLaw {
    /// Arc length [m].
    pub arc_length: Vec<f64>,
    /// Index of the path's move that contains it.
    pub index: Vec<u32>,
    /// Speed along the path [m/s].
    pub speed: Vec<f64>,
    /// Direction of the feed, a vector of at most unit length; it turns evenly while the tool waits
    /// at a corner.
    pub heading: Vec<Vector3<f64>>,
    /// 1 where the tool cuts, 0 on rapid moves.
    pub engaged: Vec<f64>,
}

impl TimingLaw {
    /// An empty law with room for `count` samples.
    fn with_capacity(count: usize) -> Self {
        Self {
            arc_length: Vec::with_capacity(count),
            index: Vec::with_capacity(count),
            speed: Vec::with_capacity(count),
            heading: Vec::with_capacity(count),
            engaged: Vec::with_capacity(count),
        }
    }

    /// The law at selected samples, in any order and number.
    pub fn at(&self, samples: &[usize]) -> Self {
        let numbers = |all: &[f64]| samples.iter().map(|&k| all[k]).collect();
        Self {
            arc_length: numbers(&self.arc_length),
            index: samples.iter().map(|&k| self.index[k]).collect(),
            speed: numbers(&self.speed),
            heading: samples.iter().map(|&k| self.heading[k]).collect(),
            engaged: numbers(&self.engaged),
        }
    }

    /// The timing law of the shaped motion, to first order in the curvature: every value is shaped.
    pub fn shaped(&self, shaper: &Shaper, path: &Path, sample_time: f64) -> Self {
        let arc_length = shaper.apply(&self.arc_length, sample_time);
        Self {
            index: indices(path, &arc_length),
            arc_length,
            speed: shaper.apply(&self.speed, sample_time),
            heading: shaper.apply(&self.heading, sample_time),
            engaged: shaper.apply(&self.engaged, sample_time),
        }
    }

    /// The path's tool axis at the sample `k`, from tip to spindle.
    pub fn axis(&self, path: &Path, k: usize) -> Vector3<f64> {
        path.axis_at(path.within(self.index[k] as usize, self.arc_length[k]))
    }

    /// The path's points, one per sample [m].
    pub fn points(&self, path: &Path) -> Vec<Vector3<f64>> {
        let places = self.index.iter().zip(&self.arc_length);
        places.map(|(&index, &s)| path.point_at(path.within(index as usize, s))).collect()
    }
}

/// Index of the move that contains each arc length [m]; fast if they mostly rise.
pub(crate) fn indices(path: &Path, arc_length: &[f64]) -> Vec<u32> {
    let mut near = 0;
    let index = |&s: &f64| {
        (near, _) = path.locate_near(s, near);
        near as u32
    };
    arc_length.iter().map(index).collect()
}

/// The desired motion, sampled evenly; its last sample in motion is the exact end of the path, and
/// samples at rest follow.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    /// Sample time [s].
    pub sample_time: f64,
    /// Progress along the path.
    pub timing: TimingLaw,
    /// Desired TCP position in the base frame [m].
    pub position: Vec<Vector3<f64>>,
    /// Desired tool axis from tip to spindle in the base frame.
    pub axis: Axes,
    /// Corners with a full stop.
    pub stops: Vec<Corner>,
    /// Time that the sharp ones among them take [s]: braking, rest and starting again, compared with
    /// passing them.
    pub time_of_corners: f64,
    /// Number of samples up to and including the exact end of the path; the rest is settling.
    pub moving: usize,
}

impl Trajectory {
    /// The number of samples that [`Trajectory::new`] would give.
    pub fn count(path: &Path, limits: &MotionLimits) -> f64 {
        (Self::moving_time(path, limits) + limits.settle) / limits.sample_time + 2.0
    }

    /// Time from the start to the end of the path [s].
    fn moving_time(path: &Path, limits: &MotionLimits) -> f64 {
        stretches(path, limits).iter().map(Stretch::duration).sum()
    }

    /// Travels the path with trapezoidal profiles, from rest to rest between full stops: sharp
    /// corners and the program's waits.
    pub fn new(path: &Path, limits: &MotionLimits) -> Self {
        let stretches = stretches(path, limits);
        let duration = stretches.iter().map(Stretch::duration).sum::<f64>();
        let passing = Self::moving_time(path, &MotionLimits { corner_angle: PI, ..*limits });
        let dt = limits.sample_time;
        let settling = (limits.settle / dt).ceil() as usize;
        let most = (duration / dt) as usize + settling + 2;
        let mut timing = TimingLaw::with_capacity(most);
        let mut position = Vec::with_capacity(most);
        let mut near = 0;
        let mut sample = |s: f64, speed: f64, heading: Vector3<f64>, engaged: bool| {
            let place = path.locate_near(s, near);
            near = place.0;
            timing.arc_length.push(s);
            timing.index.push(near as u32);
            timing.speed.push(speed);
            timing.heading.push(heading);
            timing.engaged.push(if engaged { 1.0 } else { 0.0 });
            position.push(path.point_at(place));
        };
        let cuts = |index: usize| path.moves()[index].pace != MovePace::Rapid;
        let mut clock = 0.0;
        let mut k = 0_usize;
        for stretch in &stretches {
            for (index, profile) in &stretch.profiles {
                let end = clock + profile.duration();
                while (k as f64) * dt < end {
                    let (distance, speed) = profile.at(k as f64 * dt - clock);
                    let segment = &path.moves()[*index].segment;
                    sample(path.start(*index) + distance, speed, segment.tangent(distance), cuts(*index));
                    k += 1;
                }
                clock = end;
            }
            let (arrived, last) = (clock, stretch.profiles.last().map_or(0, |(index, _)| *index));
            let Some(Stop { corner, time }) = stretch.stop else { continue };
            while (k as f64) * dt < arrived + time {
                let part = (k as f64 * dt - arrived) / time;
                let heading = corner.before * (1.0 - part) + corner.after * part;
                sample(
                    corner.s,
                    0.0,
                    heading,
                    cuts(if part < 0.5 { last } else { (last + 1).min(path.moves().len() - 1) }),
                );
                k += 1;
            }
            clock = arrived + time;
        }
        let moving = k + 1;
        let length = path.length();
        for _ in 0..=settling {
            sample(length, 0.0, path.tangent(length), cuts(path.moves().len() - 1));
        }
        let stops = stretches.iter().filter_map(|stretch| stretch.stop.map(|stop| stop.corner)).collect();
        let axis = Axes::along(path, &timing.arc_length, &timing.index);
        Self { sample_time: dt, timing, position, axis, stops, time_of_corners: duration - passing, moving }
    }

    /// A few stations instead of every sample, for searches over many poses. They are evenly spaced
    /// along the path, each at the full speed of its move.
    pub fn stations(path: &Path, limits: &MotionLimits, count: usize) -> Self {
        let even = |k: usize| path.length() * k as f64 / (count - 1) as f64;
        Self::stations_at(path, limits, &(0..count).map(even).collect::<Vec<_>>())
    }

    /// The same at arc lengths of choice [m], which rise.
    pub fn stations_at(path: &Path, limits: &MotionLimits, arc_lengths: &[f64]) -> Self {
        let count = arc_lengths.len();
        let mut timing = TimingLaw::with_capacity(count);
        let mut position = Vec::with_capacity(count);
        for &s in arc_lengths {
            let place = path.locate(s);
            let step = &path.moves()[place.0];
            timing.arc_length.push(s);
            timing.index.push(place.0 as u32);
            timing.speed.push(limit(step, limits));
            timing.heading.push(step.segment.tangent(place.1));
            timing.engaged.push(if step.pace == MovePace::Rapid { 0.0 } else { 1.0 });
            position.push(path.point_at(place));
        }
        let axis = Axes::along(path, &timing.arc_length, &timing.index);
        let (sample_time, stops) = (limits.sample_time, Vec::new());
        Self { sample_time, timing, position, axis, stops, time_of_corners: 0.0, moving: count }
    }

    /// The number of samples.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there are no samples, which never happens.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }
}

/// A stretch between full stops: its moves with their profiles, and the stop that follows.
struct Stretch {
    profiles: Vec<(usize, Profile)>,
    stop: Option<Stop>,
}

/// A stop along the path, and the time at rest there [s].
#[derive(Debug, Clone, Copy)]
struct Stop {
    corner: Corner,
    time: f64,
}

impl Stretch {
    fn duration(&self) -> f64 {
        let moving: f64 = self.profiles.iter().map(|(_, profile)| profile.duration()).sum();
        moving + self.stop.map_or(0.0, |stop| stop.time)
    }
}

fn stretches(path: &Path, limits: &MotionLimits) -> Vec<Stretch> {
    let mut stretches = Vec::new();
    let mut first = 0;
    let mut waits = path.waits().iter().peekable();
    // Waits before the first move are not part of the motion.
    while waits.next_if(|wait| wait.s <= 0.0).is_some() {}
    let corners = if limits.rounded { course::corners } else { course::of_moves };
    let mut corners = corners(path, limits.corner_angle).into_iter().peekable();
    for (index, corner) in path.corners().enumerate() {
        let mut dwell = 0.0;
        while let Some(wait) = waits.next_if(|wait| wait.s <= corner.s) {
            dwell += wait.time;
        }
        let sharp = corners.next_if(|(sharp, _)| *sharp == index).is_some();
        if sharp || dwell > 0.0 {
            let time = if sharp { dwell.max(limits.corner_dwell) } else { dwell };
            let profiles = profiles(path, limits, first..index + 1);
            stretches.push(Stretch { profiles, stop: Some(Stop { corner, time }) });
            first = index + 1;
        }
    }
    stretches.push(Stretch { profiles: profiles(path, limits, first..path.moves().len()), stop: None });
    stretches
}

/// Highest speed of a move [m/s].
fn limit(step: &Move, limits: &MotionLimits) -> f64 {
    match step.pace {
        MovePace::Rapid => limits.rapid,
        MovePace::Feed(feed) => feed,
        MovePace::JobFeed => limits.feed,
    }
}

/// Profiles of moves travelled without a stop. Each junction is passed as fast as the feeds on both
/// sides and the braking distance after it allow.
fn profiles(path: &Path, limits: &MotionLimits, range: std::ops::Range<usize>) -> Vec<(usize, Profile)> {
    let moves = &path.moves()[range.clone()];
    let limit = |step: &Move| limit(step, limits);
    let reach =
        |speed: f64, step: &Move| (speed * speed + 2.0 * limits.acceleration * step.segment.length()).sqrt();
    let mut speeds = vec![0.0; moves.len() + 1];
    for i in 1..moves.len() {
        speeds[i] = limit(&moves[i - 1]).min(limit(&moves[i])).min(reach(speeds[i - 1], &moves[i - 1]));
    }
    for i in (1..moves.len()).rev() {
        speeds[i] = speeds[i].min(reach(speeds[i + 1], &moves[i]));
    }
    let profile = |(i, step): (usize, &Move)| {
        let ends = (speeds[i], speeds[i + 1]);
        (range.start + i, Profile::between(step.segment.length(), ends, limit(step), limits.acceleration))
    };
    moves.iter().enumerate().map(profile).collect()
}
