//! The verdict as a state.

use crate::report::{Report, Severity};
use serde::Serialize;

/// What can be promised.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum VerdictState {
    /// The arm cannot run the commands; the first warning says where.
    CannotRun,
    /// The tolerance is met with 95 % probability by what is known of robot and material.
    Met,
    /// The tolerance is met only if every number were exact.
    MetIfNominal,
    /// The tolerance is not met.
    NotMet,
}

impl Report {
    /// The verdict as a state. `Met` needs both the tip and the top of the cut; the nominal model is
    /// judged at the tip alone.
    pub fn verdict_state(&self) -> VerdictState {
        let tolerance = self.setup().goal.tolerance;
        if self.warnings.iter().any(|warning| warning.severity == Severity::CannotRun) {
            return VerdictState::CannotRun;
        }
        if self.after_max() > tolerance {
            return VerdictState::NotMet;
        }
        if self.band.after.p95.max(self.band.wall.p95) <= tolerance {
            return VerdictState::Met;
        }
        VerdictState::MetIfNominal
    }
}
