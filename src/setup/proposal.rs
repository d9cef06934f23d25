//! What a program says of its own cut, for a job that takes it over.

use crate::error::Error;
use crate::job::{FeedPerTooth, Job};
use crate::path::Path;
use crate::progress::Progress;
use crate::setup::path;
use crate::units::RPM;
use serde::Serialize;

/// Keys of the job's `cutting` that a program decides.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ProposedCutting {
    /// The program's spindle speed [1/min]; the first, if it states several.
    pub spindle_rpm: f64,
    /// The chip follows from feed and spindle speed.
    pub feed_per_tooth_mm: FeedPerTooth,
}

/// The cut that a job's program states, if it states a spindle speed.
///
/// # Errors
/// If the path cannot be read.
pub fn proposed_cutting(job: &Job) -> Result<Option<ProposedCutting>, Error> {
    let (path, _) = path::desired(job, &mut Progress::none())?;
    Ok(spindle_speeds(&path)
        .next()
        .map(|spindle_rpm| ProposedCutting { spindle_rpm, feed_per_tooth_mm: FeedPerTooth::Word }))
}

/// The spindle speeds [1/min] of the moves that state one, in their order.
pub(crate) fn spindle_speeds(path: &Path) -> impl Iterator<Item = f64> + '_ {
    path.moves().iter().filter_map(|step| Some(step.spindle? / RPM))
}
