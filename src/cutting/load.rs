//! Load: how much of the cut acts where the tool is and as fast as it goes.
//!
//! The chip is proportional to the speed along the path: at rest no tooth takes a chip. The edge
//! force, which rubs and ploughs, stays down to a tenth of the programmed feed and fades from there
//! to none at rest. Both begin with the run-in.

use crate::cutting::run_in::RunIn;
use crate::motion::TimingLaw;
use crate::path::{Move, MovePace, Path};

/// What sets the feed per tooth at the programmed feed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ChipLoad {
    /// A stated feed per tooth [m].
    Stated(f64),
    /// The feed divided by the number of teeth that pass per second.
    FromFeed {
        /// Number of flutes.
        flutes: f64,
        /// Spindle speed [1/s], if the program states none.
        spindle: f64,
    },
}

impl ChipLoad {
    /// Feed per tooth [m] at the programmed `feed` [m/s] and the program's spindle speed [1/s], if it
    /// states one.
    pub fn at(&self, feed: f64, programmed: Option<f64>) -> f64 {
        match self {
            ChipLoad::Stated(c) => *c,
            ChipLoad::FromFeed { flutes, spindle } => feed / (flutes * programmed.unwrap_or(*spindle)),
        }
    }

    /// Feed [m/s] for a feed per tooth `chip` [m] at the program's spindle speed [1/s], if it states
    /// one; `None` if a stated feed per tooth goes with every feed.
    pub fn feed(&self, chip: f64, programmed: Option<f64>) -> Option<f64> {
        match self {
            ChipLoad::Stated(_) => None,
            ChipLoad::FromFeed { flutes, spindle } => Some(chip * flutes * programmed.unwrap_or(*spindle)),
        }
    }
}

/// Load of the cut at an instant: the factors of the two parts of a
/// [`LinearForce`](crate::cutting::LinearForce).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CutLoad {
    /// Feed per tooth [m].
    pub chip: f64,
    /// Share of the edge force.
    pub edge: f64,
}

/// What the load depends on in a job.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loading {
    /// Feed per tooth at the programmed feed.
    pub chip: ChipLoad,
    /// Feed of moves that state none [m/s].
    pub feed: f64,
    /// Length over which a cut begins [m]; see [`RunIn`].
    pub run_in: f64,
}

/// Share of the programmed feed below which edge forces fade. An assumption: tests of edge forces
/// end far above it.
const FADING: f64 = 0.1;

impl Loading {
    /// Feed per tooth [m] at the job's own feed and spindle speed.
    pub fn feed_per_tooth(&self) -> f64 {
        self.chip.at(self.feed, None)
    }

    /// Largest programmed feed per tooth of the moves that cut [m]; the job's own if none does.
    pub fn largest_chip(&self, path: &Path) -> f64 {
        let chip = |step: &Move| Some(self.chip.at(self.programmed(step)?, step.spindle));
        let largest = path.moves().iter().filter_map(chip).reduce(f64::max);
        largest.unwrap_or_else(|| self.feed_per_tooth())
    }

    /// Programmed feed of a move [m/s]; `None` for a rapid move.
    pub fn programmed(&self, step: &Move) -> Option<f64> {
        match step.pace {
            MovePace::Rapid => None,
            MovePace::Feed(feed) => Some(feed),
            MovePace::JobFeed => Some(self.feed),
        }
    }

    /// The loads along a path.
    pub fn along<'a>(&'a self, path: &'a Path) -> Loads<'a> {
        Loads { loading: self, path, run_in: RunIn::along(path, self.run_in) }
    }
}

/// The loads along a path.
#[derive(Debug, Clone)]
pub struct Loads<'a> {
    loading: &'a Loading,
    path: &'a Path,
    run_in: RunIn,
}

impl Loads<'_> {
    /// The load at the sample `k` of a timing law: chip c v / v_f, and edge forces that fade in
    /// proportion to v below `FADING` of v_f; none on rapid moves.
    pub fn at(&self, timing: &TimingLaw, k: usize) -> CutLoad {
        let index = timing.index[k] as usize;
        let step = &self.path.moves()[index];
        let Some(feed) = self.loading.programmed(step) else { return CutLoad::default() };
        let share = timing.engaged[k] * self.run_in.at(index, timing.arc_length[k]);
        let speed = timing.speed[k] / feed;
        CutLoad {
            chip: self.loading.chip.at(feed, step.spindle) * speed * share,
            edge: (speed / FADING).min(1.0) * share,
        }
    }
}
