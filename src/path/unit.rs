//! Units in which a text gives its lengths and feeds.

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
    /// One of it [m].
    pub fn in_m(self) -> f64 {
        match self {
            LengthUnit::Mm => MM,
            LengthUnit::Inch => INCH,
        }
    }

    /// As a person reads it.
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
    /// Millimetres a second.
    #[default]
    MmPerS,
    /// Millimetres a minute.
    MmPerMin,
    /// Inches a minute.
    InchPerMin,
}

impl FeedUnit {
    /// One of it [m/s].
    pub fn in_m_per_s(self) -> f64 {
        match self {
            FeedUnit::MmPerS => MM,
            FeedUnit::MmPerMin => MM / MINUTE,
            FeedUnit::InchPerMin => INCH / MINUTE,
        }
    }

    /// As a person reads it.
    pub fn name(self) -> &'static str {
        match self {
            FeedUnit::MmPerS => "mm/s",
            FeedUnit::MmPerMin => "mm/min",
            FeedUnit::InchPerMin => "inch/min",
        }
    }
}
