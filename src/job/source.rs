//! The sources of error: what a job names, and sets of them.

use crate::job::choice::choice;

choice! {
    /// A source of error.
    Source { #[default] /** Cutting forces bend the arm. */ Deflection = "deflection", /** The input shaper bends the path. */ Shaping = "shaping" }
}

/// Which sources act, or are compensated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sources {
    /// Cutting forces.
    pub deflection: bool,
    /// Input shaping.
    pub shaping: bool,
}

impl Sources {
    /// Every source.
    pub const ALL: Self = Self { deflection: true, shaping: true };
    /// No source.
    pub const NONE: Self = Self { deflection: false, shaping: false };

    /// One source alone.
    pub fn only(source: Source) -> Self {
        Self { deflection: source == Source::Deflection, shaping: source == Source::Shaping }
    }
}
