//! Run-in: the length over which a cut begins.
//!
//! A tool that comes from the air meets the part with its edge first: the force rises while the tool
//! moves by the length L = sqrt(a_e (D - a_e)) from the first touch to the full engagement, which is
//! the distance along the feed from the axis to where the edge enters. From half the diameter on
//! the foremost point touches first and L = D / 2. The rise is taken as w = 3 u^2 - 2 u^3, u = s / L.
//! The stock is not known, so this holds after every rapid move, at the start of the path, and after
//! a plunge, which leaves the tool in its own hole.

use crate::cutting::Cut;
use crate::math;
use crate::path::{Move, MovePace, Path};
use crate::units::DEG;

/// A feed move that dives steeper than this is a plunge [rad]; less steep ones open a groove.
const STEEP: f64 = 60.0 * DEG;

/// The run-in along a path.
#[derive(Debug, Clone, PartialEq)]
pub struct RunIn {
    /// Length [m].
    length: f64,
    /// Where the cut of each move began [m]; not a number for a rapid move.
    since: Vec<f64>,
}

impl RunIn {
    /// The run-in of the length `length` [m] along a path.
    pub fn along(path: &Path, length: f64) -> Self {
        let mut since = Vec::with_capacity(path.moves().len());
        let mut began = 0.0;
        let mut before: Option<&Move> = None;
        for (index, step) in path.moves().iter().enumerate() {
            let cuts = step.pace != MovePace::Rapid;
            let goes_on =
                before.is_some_and(|last| last.pace != MovePace::Rapid && (!dives(last) || dives(step)));
            if cuts && !goes_on {
                began = path.start(index);
            }
            since.push(if cuts { began } else { f64::NAN });
            before = Some(step);
        }
        Self { length, since }
    }

    /// Share of the force at the arc length `s` [m] in the move `index`; 0 on rapid moves.
    pub fn at(&self, index: usize, s: f64) -> f64 {
        let run = s - self.since[index];
        if run.is_nan() {
            return 0.0;
        }
        let u = if run < self.length { (run / self.length).max(0.0) } else { 1.0 };
        u * u * (3.0 - 2.0 * u)
    }
}

/// Whether a move dives along the tool axis.
fn dives(step: &Move) -> bool {
    -step.segment.tangent(0.0).dot(&step.axis_from) > math::sin(STEEP)
}

impl Cut {
    /// Length of the run-in [m]; a_e of stated angles is D / 2 |cos entry - cos exit|.
    pub fn run_in(&self) -> f64 {
        let outer = self.radius();
        let (entry, exit) = self.engagement.at(outer);
        let width = (outer * (math::cos(entry) - math::cos(exit)).abs()).min(outer);
        (width * (self.diameter - width)).sqrt()
    }
}
