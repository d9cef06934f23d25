//! Load of the cut on the spindle.

use crate::cutting::Cut;
use crate::cutting::tool::Slice;
use crate::math::{self, TAU};

impl Cut {
    /// Mean torque on the tool [N m] at the feed per tooth `c` [m]: tangential force times radius,
    /// summed over all slices and averaged over a revolution (Altintas 2012, section 2.8).
    pub fn torque(&self, c: f64) -> f64 {
        self.torque_of(&self.profile(), c)
    }

    /// [`Cut::torque`] of slices of the edge.
    pub(super) fn torque_of(&self, slices: &[Slice], c: f64) -> f64 {
        let torque = |slice: &Slice| {
            let k = &slice.coefficients;
            let chip = c * (math::cos(slice.entry) - math::cos(slice.exit));
            (k.ktc * chip + k.kte * (slice.exit - slice.entry)) * slice.radius * slice.height
        };
        // From 0: an empty sum would be -0.
        let sum = slices.iter().map(torque).fold(0.0, |sum, part| sum + part);
        f64::from(self.flutes) * sum / TAU
    }

    /// Cross section of the cut [m^2]: radial times axial depth on a cylinder. Times the feed, it
    /// is the removal rate.
    pub fn section(&self) -> f64 {
        Self::section_of(&self.profile())
    }

    /// [`Cut::section`] of slices of the edge.
    pub(super) fn section_of(slices: &[Slice]) -> f64 {
        let width = |entry: f64, exit: f64, radius: f64| radius * (math::cos(entry) - math::cos(exit));
        let section = |slice: &Slice| width(slice.entry, slice.exit, slice.radius) * slice.height;
        slices.iter().map(section).fold(0.0, |sum, part| sum + part)
    }

    /// Mean chip thickness [m] at the feed per tooth `c` [m]: the chip of a tooth divided by its
    /// engaged edge and arc (on a cylinder c (cos entry - cos exit) / (exit - entry)).
    pub fn mean_chip(&self, c: f64) -> f64 {
        let [section, arc] = Self::chip_of(&self.profile());
        if arc > 0.0 { c * section / arc } else { 0.0 }
    }

    /// The chip of a tooth for 1 m of feed per tooth [m], and its engaged edge times arc [m], of slices
    /// of the edge.
    pub(super) fn chip_of(slices: &[Slice]) -> [f64; 2] {
        let (mut section, mut arc) = (0.0, 0.0);
        for slice in slices {
            section += (math::cos(slice.entry) - math::cos(slice.exit)) * slice.height;
            arc += (slice.exit - slice.entry) * slice.edge;
        }
        [section, arc]
    }
}
