//! The sources of error, as a job names them and as a set.

use crate::job::choice::choice;

choice! {
    /// A source of error.
    Source {
        /// Cutting forces bend the arm.
        #[default]
        Deflection = "deflection",
        /// The input shaper bends the path.
        Shaping = "shaping",
    }
}

/// The sources that act, or are compensated.
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

    /// A set of one source.
    pub fn only(source: Source) -> Self {
        Self { deflection: source == Source::Deflection, shaping: source == Source::Shaping }
    }
}
