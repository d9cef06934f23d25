//! The thickest chip of a turn (h_ex): what tool makers give a range for.
//!
//! A tooth's chip is c (s sin(phi) sin(kappa) + d cos(kappa)), with the shares s and d of the feed across
//! and down the axis (see [`in_stock`](crate::cutting::in_stock)). On a cylinder it is thickest ahead,
//! or where the arc in material is nearest to that. Runout is left out.

use crate::cutting::Cut;
use crate::cutting::tool::Slice;
use crate::math::{self, PI};
use crate::stock::Contact;

impl Cut {
    /// Largest chip thickness of the stated engagement for 1 m of feed per tooth.
    pub fn largest_chip(&self) -> f64 {
        self.thickest(&self.profile(), [1.0, 0.0])
    }

    /// Largest chip thickness at a contact for 1 m of feed per tooth; 0 in the air.
    pub fn largest_chip_in(&self, contact: &Contact) -> f64 {
        let side = self.thickest(&self.engaged(contact), [contact.across, contact.down]);
        if contact.floors.is_empty() { side } else { side.max(contact.down) }
    }

    /// Largest chip thickness of slices, with the shares of the feed across and down the axis.
    fn thickest(&self, slices: &[Slice], [across, down]: [f64; 2]) -> f64 {
        let chip = |slice: &Slice| {
            let ahead = across * largest_sine(slice.entry, slice.exit);
            // The sine and the cosine of kappa at a height on the corner.
            let at = |height: f64| {
                let cos = (1.0 - height / self.corner_radius).max(0.0);
                ahead * (1.0 - cos * cos).sqrt() + down * cos
            };
            if slice.from + slice.height / 2.0 < self.corner_radius {
                at(slice.from).max(at(slice.from + slice.height))
            } else {
                ahead
            }
        };
        slices.iter().map(chip).fold(0.0, f64::max)
    }
}

/// The largest sine between two angles [rad] from 0 to a turn.
fn largest_sine(from: f64, to: f64) -> f64 {
    if (from..=to).contains(&(PI / 2.0)) { 1.0 } else { math::sin(from).max(math::sin(to)) }
}
