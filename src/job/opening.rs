//! The job that a calculator opens with: a real part on a real machining robot.
//!
//! The default job is the thesis's case, which no RX-90 can run; it stays what absent keys mean. A
//! person meets the bracket of `opening/bracket.nc` instead: a pocket in two levels and an outside
//! contour in aluminium, milled from a block by a KUKA KR 500-3 MT with its spindle at a right angle
//! to the flange.

use crate::error::Error;
use crate::job::{Job, Path, PathKind};

impl Job {
    /// The job of the bracket.
    ///
    /// # Errors
    /// None: its text is part of the program, and a test reads it.
    pub fn opening() -> Result<Self, Error> {
        let text = Some(include_str!("opening/bracket.nc").into());
        let path = Path { text, ..Path::of(PathKind::Gcode) };
        Ok(Self { path, ..Self::from_json(include_str!("opening/job.json"))? })
    }
}
