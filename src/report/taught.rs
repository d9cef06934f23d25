//! What a measured pass did to the commands.

use crate::deviation::contour::MeanMax;
use crate::report::millimetres;

/// Commands that a measured pass has corrected: the model does not know why, so its own figures do not judge them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taught {
    /// The error of the pass that was measured [m].
    pub measured: MeanMax,
    /// What would be left of it if it comes back [m].
    pub expected: MeanMax,
}

impl Taught {
    /// In words, without full stop: plain ASCII without brackets, for programs.
    pub fn sentence(&self) -> String {
        format!(
            "Commands corrected after a measured pass: up to {} mm and {} mm on average were measured, \
             {} mm and {} mm are to be expected if that comes back",
            millimetres(self.measured.max),
            millimetres(self.measured.mean),
            millimetres(self.expected.max),
            millimetres(self.expected.mean)
        )
    }
}
