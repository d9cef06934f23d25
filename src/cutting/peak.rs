//! The largest force within a revolution.
//!
//! The force is smooth but where a slice of an edge enters or leaves the material. There it has a
//! kink, or a jump if the slice does so at once along its height. The search takes both sides of
//! each such angle and even steps between them, and then closes in on the best. A corner is searched
//! in coarse slices and closed in on in fine ones.

use crate::cutting::Cut;
use crate::cutting::tool::Slice;
use crate::math::TAU;
use crate::units::DEG;

/// Largest step of the search [rad].
const STEP: f64 = DEG;
/// Distance from a kink at which either side is evaluated [rad].
const BESIDE: f64 = 1e-9;
/// Turn of the edge within a slice with runout [rad].
const TURN: f64 = 0.1 * DEG;
/// Most slices of a cylinder with runout.
const MOST: f64 = 720.0;
/// Number of places to close in on.
const PLACES: usize = 3;
/// Steps of the golden section: the last is 1e-3 of the first.
const PASSES: usize = 14;
/// The golden section.
const GOLDEN: f64 = 0.618_033_988_749_895;

impl Cut {
    /// Largest force on the tool within a revolution [N] at the feed per tooth `c` [m], to 0.1 %.
    pub fn peak_force(&self, c: f64) -> f64 {
        if self.runout > 0.0 {
            let count = (self.lag().abs() * self.axial_depth / TURN).ceil().clamp(1.0, MOST);
            let slices = self.thin(count as usize);
            let size = |phi: f64| self.instant_with_runout(&slices, phi, c).norm();
            let steps = (TAU / STEP).ceil();
            let angles = (0..=steps as usize).map(|k| TAU * k as f64 / steps).collect();
            return largest(angles, size, size, 0.0);
        }
        self.peak_of(&self.coarse(), &self.profile(), c)
    }

    /// [`Cut::peak_force`] without runout of slices of the edge, found in coarse ones and closed in on
    /// in fine ones.
    pub(super) fn peak_of(&self, slices: &[Slice], fine: &[Slice], c: f64) -> f64 {
        // All teeth are alike, so one pitch is enough.
        let pitch = TAU / f64::from(self.flutes);
        let mut angles = self.kinks(slices, pitch);
        let steps = (pitch / STEP).ceil();
        angles.extend((0..=steps as usize).map(|k| pitch * k as f64 / steps));
        angles.sort_by(f64::total_cmp);
        let size = |slices: &[Slice], phi: f64| self.instant(slices, phi).at(c).norm();
        // The slices of a corner enter as wholes, fine ones elsewhere than coarse ones.
        let beyond = if self.corner_radius > 0.0 { STEP } else { 0.0 };
        largest(angles, |phi| size(slices, phi), |phi| size(fine, phi), beyond)
    }

    /// Both sides of each immersion angle within a pitch [rad] at which an end of a slice meets its
    /// entry or exit.
    fn kinks(&self, slices: &[Slice], pitch: f64) -> Vec<f64> {
        let at = |slice: &Slice| {
            let ends = [slice.from, slice.from + slice.height].map(|height| self.lag() * height);
            ends.map(|lag| [slice.entry + lag, slice.exit + lag])
        };
        let angles = slices.iter().flat_map(at).flatten();
        angles
            .flat_map(|angle| [angle - BESIDE, angle + BESIDE])
            .map(|angle| angle.rem_euclid(pitch))
            .collect()
    }
}

/// The largest value of `f` near the rising `angles`: a golden section between the neighbours of those
/// that are best by the nearly equal `search`, or `beyond` them [rad].
fn largest(angles: Vec<f64>, search: impl Fn(f64) -> f64, f: impl Fn(f64) -> f64, beyond: f64) -> f64 {
    let values: Vec<f64> = angles.iter().map(|&angle| search(angle)).collect();
    let last = angles.len() - 1;
    let mut order: Vec<usize> = (0..=last)
        .filter(|&k| values[k] >= values[k.saturating_sub(1)] && values[k] >= values[(k + 1).min(last)])
        .collect();
    order.sort_by(|&a, &b| values[b].total_cmp(&values[a]));
    let mut most = 0.0_f64;
    for &k in order.iter().take(PLACES) {
        most = most.max(f(angles[k]));
        let (mut low, mut high) = (angles[k.saturating_sub(1)] - beyond, angles[(k + 1).min(last)] + beyond);
        for _ in 0..PASSES {
            let width = (high - low) * GOLDEN;
            let (left, right) = (f(high - width), f(low + width));
            most = most.max(left).max(right);
            if left > right {
                high = low + width;
            } else {
                low = high - width;
            }
        }
    }
    most
}
