//! What stopping at corners costs.

use crate::motion::Trajectory;
use crate::report::{Report, Warning};
use crate::units::DEG;
use serde::Serialize;

/// Full stops along the path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Stops {
    /// Their number: sharp corners, and places where the program waits.
    pub count: usize,
    /// Time that the corners among them take: braking, rest and starting again, compared with
    /// passing them [s].
    pub corners_s: f64,
}

/// So many stops at least are remarked.
const MANY: usize = 20;

impl Stops {
    pub(super) fn of(report: &Report) -> Self {
        let Trajectory { stops, time_of_corners, .. } = &*report.plan.trajectory;
        Self { count: stops.len(), corners_s: *time_of_corners }
    }

    /// Many corners that take more time than all the rest.
    pub(super) fn warning(report: &Report) -> Option<Warning> {
        let Self { count, corners_s } = Self::of(report);
        let duration = report.duration();
        let message = format!(
            "the path stops {count} times: its corners sharper than {} deg take {corners_s:.1} of {duration:.1} s, and a cutter \
             that dwells leaves marks; a larger motion.corner_angle_deg runs through them, and finer points or arcs avoid them",
            report.setup().limits.corner_angle / DEG
        );
        (count >= MANY && corners_s > duration / 2.0).then(|| Warning::new("many-stops", message))
    }
}
