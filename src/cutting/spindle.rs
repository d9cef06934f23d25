//! What the cut asks of the spindle.

use crate::cutting::Cut;
use crate::cutting::tool::Slice;
use crate::math::{self, TAU};

impl Cut {
    /// Mean torque on the tool [N m] at the feed per tooth `c` [m]: tangential force times radius over all slices and a revolution (Altintas 2012, section 2.8).
    pub fn torque(&self, c: f64) -> f64 {
        let slices = self.profile();
        let torque = |slice: &Slice| {
            let k = &slice.coefficients;
            let chip = c * (math::cos(slice.entry) - math::cos(slice.exit));
            (k.ktc * chip + k.kte * (slice.exit - slice.entry)) * slice.radius * slice.height
        };
        // From 0: the sum of nothing is -0 otherwise.
        let sum = slices.iter().map(torque).fold(0.0, |sum, part| sum + part);
        f64::from(self.flutes) * sum / TAU
    }

    /// Section of the material in the tool's way [m^2]: radial times axial depth on a cylinder. Times the feed it is the removal rate.
    pub fn section(&self) -> f64 {
        let width = |entry: f64, exit: f64, radius: f64| radius * (math::cos(entry) - math::cos(exit));
        let section = |slice: &Slice| width(slice.entry, slice.exit, slice.radius) * slice.height;
        self.profile().iter().map(section).fold(0.0, |sum, part| sum + part)
    }

    /// Mean thickness of chip [m] at the feed per tooth `c` [m]: what a tooth cuts, divided by the edge and the way on which it cuts
    /// (on a cylinder c (cos entry - cos exit) / (exit - entry)).
    pub fn mean_chip(&self, c: f64) -> f64 {
        let (mut section, mut way) = (0.0, 0.0);
        for slice in self.profile() {
            section += (math::cos(slice.entry) - math::cos(slice.exit)) * slice.height;
            way += (slice.exit - slice.entry) * slice.edge;
        }
        if way > 0.0 { c * section / way } else { 0.0 }
    }
}
