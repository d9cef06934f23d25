//! The tool holder over the stock: a cylinder above the tool that cuts nothing.
//!
//! It is looked at around the tool axis at every half radius of the tool, on rapid moves as well. What
//! the tools have cleared at its lower end they have cleared above.

use crate::math::{self, TAU};
use crate::path::{Move, MovePace, Path};
use crate::stock::along::{Earlier, LOOK, Leg, cleared, legs};
use crate::stock::circle::HalfCircle;
use crate::stock::contact::{Collider, Collision, Contacts};
use crate::stock::grid::{Grid, SAME_HEIGHT};
use crate::stock::height_map::{HeightMap, STAMPS, STEP, Stamp};

use crate::stock::place::{Around, Cleared, Cutter, Surroundings, ToolPlace, WITHIN};
use crate::stock::solid::Solid;
use nalgebra::{Vector2, Vector3};

/// Directions in which a map is looked at.
const DIRECTIONS: usize = 180;

/// A holder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Holder {
    /// Radius [m].
    pub radius: f64,
    /// Height of its lower end above the tip [m].
    pub height: f64,
}

/// The contacts with the places where the holder meets the stock, the first in each move.
pub fn with_holder(
    mut contacts: Contacts,
    path: &Path,
    (solid, earlier): (&Solid, &[Earlier]),
    (cutter, holder): (&Cutter, &Holder),
) -> Contacts {
    let lowest = |step: &Move| {
        let heights = step.segment.extremes().into_iter().map(|s| step.segment.point(s).z);
        heights.fold(f64::INFINITY, f64::min)
    };
    // Most holders stay above the stock all along.
    if path.moves().iter().map(lowest).fold(f64::INFINITY, f64::min) + holder.height >= solid.top {
        return contacts;
    }
    let found = match contacts.cell {
        Some(_) => on_map(path, (solid, earlier), (cutter, holder)),
        None => level(path, (solid, earlier), (cutter, holder)),
    };
    let collision = |(index, within)| Collision { collider: Collider::Holder, index, within };
    contacts.collisions.extend(found.into_iter().map(collision));
    contacts.collisions.sort_by_key(|collision| collision.index);
    contacts
}

/// The number of each move in which the holder meets the stock, and the arc length within it [m]; by
/// circles and capsules.
fn level(
    path: &Path,
    (solid, earlier): (&Solid, &[Earlier]),
    (cutter, holder): (&Cutter, &Holder),
) -> Vec<(usize, f64)> {
    let moves: Vec<Vec<Leg>> = path.moves().iter().map(|step| legs(&step.segment)).collect();
    let own = moves.iter().flatten().map(|leg| Cleared { swept: leg.swept, cutter: *cutter });
    let sweeps: Vec<Cleared> = earlier.iter().flat_map(cleared).chain(own).collect();
    let largest = sweeps.iter().map(|cleared| cleared.cutter.radius).fold(0.0, f64::max);
    let bounds = sweeps.iter().map(|cleared| cleared.swept.spine.bounds());
    let bounds = bounds.reduce(|a, b| [a[0].inf(&b[0]), a[1].sup(&b[1])]);
    let mut grid = Grid::new(bounds.unwrap_or_default(), holder.radius + largest);
    let mut number = sweeps.len() - moves.iter().map(Vec::len).sum::<usize>();
    sweeps[..number].iter().zip(0..).for_each(|(cleared, number)| grid.add(number, &cleared.swept));
    let flat = sweeps.iter().all(|cleared| cleared.cutter.corner == 0.0);
    let (mut found, mut around) = (Vec::new(), Around::default());
    // Short legs are looked at together: the length since the last look, and what was seen there.
    let far = LOOK * cutter.radius;
    let (mut since, mut met) = (far, false);
    for (index, (step, legs)) in path.moves().iter().zip(&moves).enumerate() {
        let cuts = step.pace != MovePace::Rapid;
        for leg in legs {
            let is_known = found.last().is_some_and(|(known, _)| *known == index);
            let meets = |share: &f64| {
                let (center, height) = tip(step, leg, *share);
                let own = cuts.then_some(&leg.swept);
                let place = ToolPlace {
                    center,
                    height,
                    ahead: Vector2::x(),
                    share: *share,
                    dives: false,
                    own,
                    trail: Default::default(),
                };
                let surroundings =
                    Surroundings { solid, cutter, sweeps: &sweeps, flat, grid: &grid, begun: &[], place };
                surroundings.is_holder_in(holder, &mut around)
            };
            let length = leg.within.end - leg.within.start;
            since += length;
            if !is_known {
                let first = if since < far { met.then_some(0.0) } else { shares(length / far).find(meets) };
                (since, met) = (if since < far { since } else { 0.0 }, first.is_some());
                found.extend(first.map(|share| (index, leg.within.start + share * length)));
            }
            if cuts {
                grid.add(number as u32, &leg.swept);
            }
            number += 1;
        }
    }
    found
}

/// Even shares from 0 to 1, in at least so many steps.
fn shares(steps: f64) -> impl Iterator<Item = f64> {
    let count = steps.ceil().max(1.0) as usize;
    (0..=count).map(move |k| k as f64 / count as f64)
}

/// Where the tip is at a share of a leg: across the axis, and its height [m].
fn tip(step: &Move, leg: &Leg, share: f64) -> (Vector2<f64>, f64) {
    let (from, to) = (leg.within.start, leg.within.end);
    let tip = match &leg.chord {
        None => step.segment.point(from + share * (to - from)),
        Some(chord) => chord.point(share * chord.length()),
    };
    (tip.xy(), tip.z)
}

impl Surroundings<'_> {
    /// Whether there is material within the holder.
    fn is_holder_in(&self, holder: &Holder, around: &mut Around) -> bool {
        let height = (self.place.height + holder.height).max(self.solid.bottom) + 2.0 * SAME_HEIGHT;
        let ring = |part: f64| HalfCircle {
            center: self.place.center,
            radius: part * holder.radius,
            ahead: self.place.ahead,
        };
        height < self.solid.top
            && WITHIN
                .into_iter()
                .map(ring)
                .any(|half| self.is_met(&half, height, around) || self.is_met(&half.behind(), height, around))
    }
}

/// As [`level`], on a map of heights.
fn on_map(
    path: &Path,
    (solid, earlier): (&Solid, &[Earlier]),
    (cutter, holder): (&Cutter, &Holder),
) -> Vec<(usize, f64)> {
    let mut map = HeightMap::new(solid, cutter);
    earlier.iter().for_each(|earlier| map.cut(&earlier.path, &earlier.cutter));
    let stamp = Stamp::new(cutter);
    let directions: Vec<Vector2<f64>> = (0..DIRECTIONS)
        .map(|k| math::sin_cos(TAU * k as f64 / DIRECTIONS as f64))
        .map(|(sin, cos)| Vector2::new(cos, sin))
        .collect();
    let meets = |map: &HeightMap, tip: &Vector3<f64>| {
        let low = tip.z + holder.height;
        let rings = || WITHIN.iter().map(|part| part * holder.radius);
        let is_met = |at: Vector2<f64>| map.cell_at(&at).1 > low + map.cell;
        low < solid.top && rings().any(|radius| directions.iter().any(|way| is_met(tip.xy() + way * radius)))
    };
    let mut found = Vec::new();
    for (index, step) in path.moves().iter().enumerate() {
        let length = step.segment.length();
        let met = |map: &HeightMap, share: f64| meets(map, &step.segment.point(share * length));
        if step.pace == MovePace::Rapid {
            let first = shares(length / (LOOK * cutter.radius)).find(|share| met(&map, *share));
            found.extend(first.map(|share| (index, share * length)));
            continue;
        }
        for (k, share) in shares(length * STAMPS as f64 / (STEP * cutter.radius)).enumerate() {
            let is_known = found.last().is_some_and(|(known, _)| *known == index);
            if !is_known && (k % (STAMPS * 5) == 0 || share == 1.0) && met(&map, share) {
                found.push((index, share * length));
            }
            map.stamp(&stamp, &step.segment.point(share * length));
        }
    }
    found
}
