//! The desired motion: where along the path, and where in space, at each sample (thesis section 5.2, Figs. 5.2, 5.3).

use crate::motion::Profile;
use crate::path::{Axes, Corner, Move, MovePace, Path};
use nalgebra::Vector3;

/// How the path is travelled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tempo {
    /// Highest speed of moves that state none [m/s].
    pub feed: f64,
    /// Speed of rapid moves [m/s].
    pub rapid: f64,
    /// Acceleration along the path [m/s^2].
    pub acceleration: f64,
    /// Sample time [s].
    pub sample_time: f64,
    /// A corner sharper than this is a full stop [rad].
    pub corner_angle: f64,
    /// Time at rest in such a corner [s].
    pub corner_dwell: f64,
    /// Time added at rest after the end, until a shaped command has settled [s].
    pub settle: f64,
}

/// Progress along the path over time, one value a sample.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Pace {
    /// Arc length [m].
    pub arc_length: Vec<f64>,
    /// Speed along the path [m/s].
    pub speed: Vec<f64>,
    /// Direction of the feed, a vector of at most unit length; it turns evenly while the tool waits in a corner.
    pub heading: Vec<Vector3<f64>>,
    /// 1 where the tool cuts, 0 on rapid moves.
    pub engaged: Vec<f64>,
}

impl Pace {
    /// The same at some samples, in any order and number.
    pub fn at(&self, samples: &[usize]) -> Self {
        let numbers = |all: &[f64]| samples.iter().map(|&k| all[k]).collect();
        Self {
            arc_length: numbers(&self.arc_length),
            speed: numbers(&self.speed),
            heading: samples.iter().map(|&k| self.heading[k]).collect(),
            engaged: numbers(&self.engaged),
        }
    }
}

/// The desired motion, sampled evenly; the last sample of the motion is the exact end of the path, samples at rest follow.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    /// Sample time [s].
    pub sample_time: f64,
    /// Progress along the path.
    pub pace: Pace,
    /// Desired TCP position in the base frame [m].
    pub position: Vec<Vector3<f64>>,
    /// Desired tool axis from tip to spindle in the base frame.
    pub axis: Axes,
    /// Corners with a full stop.
    pub stops: Vec<Corner>,
    /// Samples up to and with the exact end of the path; the rest is settling.
    pub moving: usize,
}

impl Trajectory {
    /// The number of samples that [`Trajectory::new`] would give.
    pub fn count(path: &Path, tempo: &Tempo) -> f64 {
        let moving: f64 = runs(path, tempo).iter().map(Run::duration).sum();
        (moving + tempo.settle) / tempo.sample_time + 2.0
    }

    /// Travels the path by the trapezoidal profile, from rest to rest between the corners that are stops and the program's waits.
    pub fn new(path: &Path, tempo: &Tempo) -> Self {
        let runs = runs(path, tempo);
        let dt = tempo.sample_time;
        let settling = (tempo.settle / dt).ceil() as usize;
        let most = (runs.iter().map(Run::duration).sum::<f64>() / dt) as usize + settling + 2;
        let mut pace = Pace {
            arc_length: Vec::with_capacity(most),
            speed: Vec::with_capacity(most),
            heading: Vec::with_capacity(most),
            engaged: Vec::with_capacity(most),
        };
        let mut position = Vec::with_capacity(most);
        let mut sample = |s: f64, speed: f64, heading: Vector3<f64>, engaged: bool| {
            pace.arc_length.push(s);
            pace.speed.push(speed);
            pace.heading.push(heading);
            pace.engaged.push(if engaged { 1.0 } else { 0.0 });
            position.push(path.point(s));
        };
        let cuts = |index: usize| path.moves()[index].pace != MovePace::Rapid;
        let mut clock = 0.0;
        let mut k = 0_usize;
        for run in &runs {
            for (index, profile) in &run.profiles {
                let end = clock + profile.duration();
                while (k as f64) * dt < end {
                    let (distance, speed) = profile.at(k as f64 * dt - clock);
                    let segment = &path.moves()[*index].segment;
                    sample(path.start(*index) + distance, speed, segment.tangent(distance), cuts(*index));
                    k += 1;
                }
                clock = end;
            }
            let (arrived, last) = (clock, run.profiles.last().map_or(0, |(index, _)| *index));
            let Some(Rest { corner, time }) = run.rest else { continue };
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
        let stops = runs.iter().filter_map(|run| run.rest.map(|rest| rest.corner)).collect();
        let axis = Axes::along(path, &pace.arc_length);
        Self { sample_time: dt, pace, position, axis, stops, moving }
    }

    /// A few places along the path instead of every sample, evenly spaced over its length, each at the full speed of its move: for
    /// searches over many poses.
    pub fn stations(path: &Path, tempo: &Tempo, count: usize) -> Self {
        let mut pace = Pace::default();
        let mut position = Vec::with_capacity(count);
        for k in 0..count {
            let s = path.length() * k as f64 / (count - 1) as f64;
            let step = &path.moves()[path.locate(s).0];
            pace.arc_length.push(s);
            pace.speed.push(limit(step, tempo));
            pace.heading.push(path.tangent(s));
            pace.engaged.push(if step.pace == MovePace::Rapid { 0.0 } else { 1.0 });
            position.push(path.point(s));
        }
        let axis = Axes::along(path, &pace.arc_length);
        Self { sample_time: tempo.sample_time, pace, position, axis, stops: Vec::new(), moving: count }
    }

    /// The number of samples.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there are no samples; there always are.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }
}

/// A stretch from rest to rest: its moves with their profiles, and the rest that follows.
struct Run {
    profiles: Vec<(usize, Profile)>,
    rest: Option<Rest>,
}

/// A stop along the path.
#[derive(Debug, Clone, Copy)]
struct Rest {
    corner: Corner,
    time: f64,
}

impl Run {
    fn duration(&self) -> f64 {
        let moving: f64 = self.profiles.iter().map(|(_, profile)| profile.duration()).sum();
        moving + self.rest.map_or(0.0, |rest| rest.time)
    }
}

fn runs(path: &Path, tempo: &Tempo) -> Vec<Run> {
    let mut runs = Vec::new();
    let mut first = 0;
    let mut waits = path.waits().iter().peekable();
    // Waits before the first move are no part of the motion.
    while waits.next_if(|wait| wait.s <= 0.0).is_some() {}
    for (index, corner) in path.corners().enumerate() {
        let mut asked = 0.0;
        while let Some(wait) = waits.next_if(|wait| wait.s <= corner.s) {
            asked += wait.time;
        }
        let sharp = corner.angle > tempo.corner_angle;
        if sharp || asked > 0.0 {
            let time = if sharp { asked.max(tempo.corner_dwell) } else { asked };
            let profiles = profiles(path, tempo, first..index + 1);
            runs.push(Run { profiles, rest: Some(Rest { corner, time }) });
            first = index + 1;
        }
    }
    runs.push(Run { profiles: profiles(path, tempo, first..path.moves().len()), rest: None });
    runs
}

/// Highest speed of a move [m/s].
fn limit(step: &Move, tempo: &Tempo) -> f64 {
    match step.pace {
        MovePace::Rapid => tempo.rapid,
        MovePace::Feed(feed) => feed,
        MovePace::JobFeed => tempo.feed,
    }
}

/// Profiles of moves that are travelled without a stop: each junction is passed as fast as both its feeds and the braking distance
/// behind it allow.
fn profiles(path: &Path, tempo: &Tempo, range: std::ops::Range<usize>) -> Vec<(usize, Profile)> {
    let moves = &path.moves()[range.clone()];
    let limit = |step: &Move| limit(step, tempo);
    let reach =
        |speed: f64, step: &Move| (speed * speed + 2.0 * tempo.acceleration * step.segment.length()).sqrt();
    let mut speeds = vec![0.0; moves.len() + 1];
    for i in 1..moves.len() {
        speeds[i] = limit(&moves[i - 1]).min(limit(&moves[i])).min(reach(speeds[i - 1], &moves[i - 1]));
    }
    for i in (1..moves.len()).rev() {
        speeds[i] = speeds[i].min(reach(speeds[i + 1], &moves[i]));
    }
    let profile = |(i, step): (usize, &Move)| {
        let ends = (speeds[i], speeds[i + 1]);
        (range.start + i, Profile::between(step.segment.length(), ends, limit(step), tempo.acceleration))
    };
    moves.iter().enumerate().map(profile).collect()
}
