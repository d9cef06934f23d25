//! Units of a chart.

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
    /// Size of the unit [N].
    pub fn in_n(self) -> f64 {
        match self {
            ForceUnit::Newton => 1.0,
            ForceUnit::PoundForce => POUND_FORCE,
        }
    }

    /// Displayed name.
    pub fn name(self) -> &'static str {
        match self {
            ForceUnit::Newton => "N",
            ForceUnit::PoundForce => "lbf",
        }
    }
}

/// The units that a user may choose; angles are always in degrees, times in seconds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Units {
    /// Unit of positions, deflections and errors.
    pub length: LengthUnit,
    /// Unit of forces.
    pub force: ForceUnit,
}
