//! Questions about the default job.

use std::hint::black_box;

use armill::at_once::at_once;
use armill::placement::PlacementMap;
use armill::study::{ErrorMeasure, EveryRobot, LargestQuestion, PartPlace, Sweep, Variation};
use armill::{Error, Job};

use crate::Work;

/// The default job, and what is asked of it.
#[derive(Debug)]
pub struct Questions {
    job: Job,
    sweep: Sweep,
    robots: EveryRobot,
    map: PlacementMap,
}

/// Places along a side of the map.
const SIDE: usize = 21;

impl Questions {
    /// Prepares them.
    ///
    /// # Errors
    /// None for the default job.
    pub fn new() -> Result<Self, Error> {
        let job = Job::default();
        Ok(Self {
            sweep: Sweep::new(&job, &[Variation::read("cutting.axial_depth_mm=0.5:5:20")?])?,
            robots: EveryRobot::new(&job, PartPlace::Kept)?,
            map: PlacementMap::new(&job)?,
            job,
        })
    }

    /// Number of arms in the library.
    pub fn arms(&self) -> usize {
        self.robots.count()
    }
}

/// What is timed.
pub const QUESTIONS: [Work<Questions>; 5] = [
    ("sweep of 20 values", |questions| {
        black_box(at_once(questions.sweep.count(), |index| questions.sweep.row(index)));
    }),
    ("the same on one core", |questions| {
        for index in 0..questions.sweep.count() {
            black_box(questions.sweep.row(index));
        }
    }),
    ("largest depth", |questions| {
        let question = LargestQuestion::read("cutting.axial_depth_mm=0.1:10", ErrorMeasure::P95);
        let _ = black_box(question.and_then(|question| question.answer(&questions.job)));
    }),
    ("every robot, place kept", |questions| {
        black_box(at_once(questions.robots.count(), |index| questions.robots.row(index)));
    }),
    ("map of 441 places with p95", |questions| {
        let step = |k: usize| -1.0 + 2.0 * k as f64 / (SIDE - 1) as f64;
        black_box(at_once(SIDE * SIDE, |index| {
            questions.map.at([step(index % SIDE), step(index / SIDE), 0.0].into())
        }));
    }),
];
