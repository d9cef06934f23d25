//! Which facets are left when all is cut, along the path.

use crate::path::{MovePace, Path};
use crate::stock::{Contacts, Cutter, Remaining};
use crate::surface::facet::{Across, FACETS, FacetSet};
use nalgebra::Vector3;

/// Distance of the places that are looked at, as a part of the radius.
const STEP: f64 = 1.0 / 64.0;
/// Most places.
const MOST_PLACES: f64 = 5e5;

/// The facets left at even places along each move.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct LeftFacets {
    sets: Vec<FacetSet>,
    /// Number of places before each move's, and their number.
    firsts: Vec<u32>,
}

impl LeftFacets {
    /// What is left along a path in the workpiece frame with these contacts; the tool axis is z.
    pub(super) fn of(path: &Path, contacts: &Contacts, cutter: &Cutter, remaining: &Remaining) -> Self {
        let step = (STEP * cutter.radius).max(path.length() / MOST_PLACES);
        let mut left = Self::default();
        // Of dense points, only as many are looked at.
        let (mut last, mut known) = (f64::NEG_INFINITY, 0);
        for (index, each) in path.moves().iter().enumerate() {
            left.firsts.push(left.sets.len() as u32);
            if each.pace == MovePace::Rapid {
                last = f64::NEG_INFINITY;
                continue;
            }
            let length = each.segment.length();
            let count = (length / step).ceil().max(1.0) as usize;
            for place in 0..count {
                let within = length * (place as f64 + 0.5) / count as f64;
                let s = path.start(index) + within;
                if s - last > step / 2.0 {
                    let (tip, tangent) = (each.segment.point(within), each.segment.tangent(within));
                    (last, known) =
                        (s, set((&tip, &tangent), contacts, (index, within), (cutter, remaining)));
                }
                left.sets.push(known);
            }
        }
        left.firsts.push(left.sets.len() as u32);
        left
    }

    /// The facets left where the tool is `within` [m] in the move `index`, a share `share` of its length.
    pub(super) fn at(&self, index: usize, share: f64) -> FacetSet {
        let (first, end) = (self.firsts[index] as usize, self.firsts[index + 1] as usize);
        if first == end {
            return 0;
        }
        self.sets[first + ((share * (end - first) as f64) as usize).min(end - first - 1)]
    }
}

/// The facets left at a place.
fn set(
    (tip, tangent): (&Vector3<f64>, &Vector3<f64>),
    contacts: &Contacts,
    (index, within): (usize, f64),
    (cutter, remaining): (&Cutter, &Remaining),
) -> FacetSet {
    let Some((from, to, share)) = contacts.around(index, within) else { return 0 };
    let contact = contacts.at(if share < 0.5 { from } else { to });
    let across = Across::of(tangent, &Vector3::z(), &Vector3::y());
    let is_left = |k: &usize| {
        let facet = &FACETS[*k];
        let place = across.place(facet, cutter, &contact);
        place.is_some_and(|place| remaining.is_left(&(tip + place), &across.normal(facet)))
    };
    (0..FACETS.len()).filter(is_left).fold(0, |set, k| set | 1 << k)
}
