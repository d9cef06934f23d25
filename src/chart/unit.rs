//! Units in which a chart is read.

use crate::path::unit::LengthUnit;
use crate::units::POUND_FORCE;

/// Unit of force of a chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ForceUnit {
    /// Newton.
    #[default]
    Newton,
    /// Pound-force.
    PoundForce,
}

impl ForceUnit {
    /// One of it [N].
    pub fn in_n(self) -> f64 {
        match self {
            ForceUnit::Newton => 1.0,
            ForceUnit::PoundForce => POUND_FORCE,
        }
    }

    /// As a person reads it.
    pub fn name(self) -> &'static str {
        match self {
            ForceUnit::Newton => "N",
            ForceUnit::PoundForce => "lbf",
        }
    }
}

/// The units that a person may choose; angles are always degrees, times seconds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Units {
    /// Of positions, deflections and errors.
    pub length: LengthUnit,
    /// Of forces.
    pub force: ForceUnit,
}
