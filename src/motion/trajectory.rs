//! The desired motion: where along the path, and where in space, at each sample (thesis section 5.2, Figs. 5.2, 5.3).

use crate::motion::Profile;
use crate::path::{Corner, Path};
use nalgebra::Vector3;

/// How the path is travelled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tempo {
    /// Highest speed along the path [m/s].
    pub feed: f64,
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
    /// Corners with a full stop.
    pub stops: Vec<Corner>,
    /// Samples up to and with the exact end of the path; the rest is settling.
    pub moving: usize,
}

impl Trajectory {
    /// The number of samples that [`Trajectory::new`] would give.
    pub fn count(path: &Path, tempo: &Tempo) -> f64 {
        let runs = runs(path, tempo);
        let moving: f64 = runs.iter().map(|run| run.profile.duration() + run.dwell).sum();
        (moving + tempo.settle) / tempo.sample_time + 2.0
    }

    /// Travels the path by the trapezoidal profile, from rest to rest between the corners that are stops.
    pub fn new(path: &Path, tempo: &Tempo) -> Self {
        let runs = runs(path, tempo);
        let dt = tempo.sample_time;
        let mut pace = Pace::default();
        let mut position = Vec::new();
        let mut sample = |s: f64, speed: f64, heading: Vector3<f64>| {
            pace.arc_length.push(s);
            pace.speed.push(speed);
            pace.heading.push(heading);
            position.push(path.point(s));
        };
        let mut clock = 0.0;
        let mut k = 0_usize;
        for run in &runs {
            let stopped = clock + run.profile.duration();
            let left = stopped + run.dwell;
            while (k as f64) * dt < left {
                let t = k as f64 * dt;
                let (distance, speed) = run.profile.at(t - clock);
                let s = run.start + distance;
                match &run.corner {
                    Some(corner) if t >= stopped => {
                        let part = (t - stopped) / run.dwell;
                        let heading = corner.before * (1.0 - part) + corner.after * part;
                        sample(s, 0.0, heading);
                    }
                    // Rounding may put the arrival one sample early; at a corner the path's own tangent is the next segment's.
                    Some(corner) if s >= corner.s => sample(s, speed, corner.before),
                    _ => sample(s, speed, path.tangent(s)),
                }
                k += 1;
            }
            clock = left;
        }
        let moving = k + 1;
        let settling = (tempo.settle / dt).ceil() as usize;
        let length = path.length();
        for _ in 0..=settling {
            sample(length, 0.0, path.tangent(length));
        }
        let stops = runs.iter().filter_map(|run| run.corner).collect();
        Self { sample_time: dt, pace, position, stops, moving }
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

/// A stretch from rest to rest.
struct Run {
    start: f64,
    profile: Profile,
    dwell: f64,
    corner: Option<Corner>,
}

fn runs(path: &Path, tempo: &Tempo) -> Vec<Run> {
    let mut runs = Vec::new();
    let mut start = 0.0;
    for corner in path.corners().filter(|corner| corner.angle > tempo.corner_angle) {
        let profile = Profile::new(corner.s - start, tempo.feed, tempo.acceleration);
        runs.push(Run { start, profile, dwell: tempo.corner_dwell, corner: Some(corner) });
        start = corner.s;
    }
    let profile = Profile::new(path.length() - start, tempo.feed, tempo.acceleration);
    runs.push(Run { start, profile, dwell: 0.0, corner: None });
    runs
}
