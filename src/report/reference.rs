//! Remarks on what the roll about the tool axis counts from, where that is not workpiece +X.

use crate::path::{Path, RollReference};
use crate::report::Warning;
use crate::units::DEG;

/// The remark on a path's reference, unless it is workpiece +X or set by the job.
pub(super) fn remark(path: &Path) -> Option<Warning> {
    match path.roll_reference() {
        RollReference::Set(_) | RollReference::Chosen(0, _) => None,
        RollReference::Chosen(i, _) => {
            let (name, passed) = if *i == 1 { ("+Y", "+X or -X") } else { ("+Z", "X and of workpiece Y") };
            let message = format!(
                "the tool axis comes within 15 deg of workpiece {passed}, so the spin is measured from \
                 {name}; spin.reference sets another direction"
            );
            Some(Warning::new("spin-reference", message))
        }
        RollReference::Carried(_) => {
            let turn = path.carried_turn()? / DEG;
            let lap = if path.is_closed() { "in each lap" } else { "by its end" };
            let message = format!(
                "the tool axis comes near X, Y and Z of the workpiece, so the x axis is carried along \
                 without twist and turns by {turn:.1} deg {lap}; spin.reference sets a direction"
            );
            Some(Warning::new("spin-carried", message))
        }
    }
}
