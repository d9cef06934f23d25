//! Units of the lengths and feeds in a text.

use crate::units::{INCH, MINUTE, MM};

/// Unit of length of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LengthUnit {
    /// Millimetre.
    #[default]
    Mm,
    /// Inch.
    Inch,
}

impl LengthUnit {
    /// The unit in m.
    pub fn in_m(self) -> f64 {
        match self {
            LengthUnit::Mm => MM,
            LengthUnit::Inch => INCH,
        }
    }

    /// Name shown to the user.
    pub fn name(self) -> &'static str {
        match self {
            LengthUnit::Mm => "mm",
            LengthUnit::Inch => "inch",
        }
    }
}

/// Unit of the feeds of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FeedUnit {
    /// Millimetres per second.
    #[default]
    MmPerS,
    /// Millimetres per minute.
    MmPerMin,
    /// Inches per minute.
    InchPerMin,
}

impl FeedUnit {
    /// The unit in m/s.
    pub fn in_m_per_s(self) -> f64 {
        match self {
            FeedUnit::MmPerS => MM,
            FeedUnit::MmPerMin => MM / MINUTE,
            FeedUnit::InchPerMin => INCH / MINUTE,
        }
    }

    /// Name shown to the user.
    pub fn name(self) -> &'static str {
        match self {
            FeedUnit::MmPerS => "mm/s",
            FeedUnit::MmPerMin => "mm/min",
            FeedUnit::InchPerMin => "inch/min",
        }
    }
}
