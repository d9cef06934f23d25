//! The stiffness of the cut: how its mean force grows as the tool shifts out of its place.
//!
//! A tool that is pushed away from a wall cuts less of it; one that is lifted cuts less deep. Along the
//! feed a shift changes nothing that lasts. The material is where the path leaves it: that an earlier
//! pass was pushed away as well is left out. Where it was pushed as far, this one meets as much as
//! planned, so what the stiffness takes from the force is an upper bound there. Below the tip the
//! material goes on as at the tip: a floor beside it yields as this one does. A flat tool's stiffness is
//! exact; where a round one crosses the fillets of an earlier pass, its growth up the axis may be a
//! third off.

use crate::cutting::along::in_base;
use crate::cutting::{Cut, CutLoad, LinearForce};
use crate::math;
use crate::stock::{Contact, Contacts, SideArc};
use nalgebra::Vector3;
use std::sync::Arc;

/// Shift of the tool in the difference quotients [m].
const SHIFT: f64 = 1e-6;
/// Where a border just touches the tool, its angle changes like the square root of the shift: there its mean
/// growth over this shift is taken [m], about as far as an arm yields, but no more than this share of the arc.
const YIELD: (f64, f64) = (3e-4, 0.1);

/// The stiffness at the stations of contacts with a stock, between which it is linear.
#[derive(Debug, Clone, PartialEq)]
pub struct StiffnessAlong {
    contacts: Arc<Contacts>,
    /// Growth of the mean force per metre to the left and up.
    stations: Arc<[[LinearForce; 2]]>,
}

impl StiffnessAlong {
    /// The stiffness of a cut.
    pub fn of(cut: &Cut, contacts: &Arc<Contacts>) -> Self {
        let stations = contacts.each().map(|(_, contact)| cut.stiffness_in(&contact)).collect();
        Self { contacts: contacts.clone(), stations }
    }

    /// The stiffness at the arc length `within` [m] of the move `index`; none on a rapid move.
    pub fn at(&self, index: usize, within: f64) -> [LinearForce; 2] {
        let Some((from, to, share)) = self.contacts.around(index, within) else {
            return [LinearForce::zero(); 2];
        };
        let (from, to) = (&self.stations[from], &self.stations[to]);
        [0, 1].map(|way| from[way].towards(&to[way], share))
    }
}

/// The stiffness of the cut where the tool is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutStiffness {
    /// Unit vectors to the left of the feed and up the tool axis.
    pub ways: [Vector3<f64>; 2],
    /// Growth of the mean force as the tool shifts in either direction [N/m].
    pub growth: [Vector3<f64>; 2],
}

impl CutStiffness {
    /// The stiffness under a load, given per shift in {T} whose x and z point along `x` and `axis`.
    pub(super) fn under(
        load: &CutLoad,
        by: &[LinearForce; 2],
        (x, axis): (&Vector3<f64>, &Vector3<f64>),
    ) -> Self {
        let growth = by.map(|by| in_base(&by.under(load), x, axis));
        Self { ways: [axis.cross(x), *axis], growth }
    }

    /// The parts of a shift [m] that change the force.
    pub fn felt(&self, shift: &Vector3<f64>) -> [f64; 2] {
        self.ways.map(|way| way.dot(shift))
    }

    /// The growth of the force [N] with such a shift [m].
    pub fn grown(&self, [left, up]: [f64; 2]) -> Vector3<f64> {
        self.growth[0] * left + self.growth[1] * up
    }
}

impl Cut {
    /// The stiffness of the cut at a contact: growth of its mean force per metre that the tool shifts
    /// to its left and up its axis, by difference quotients.
    pub fn stiffness_in(&self, contact: &Contact) -> [LinearForce; 2] {
        let quotient = |shifted: &dyn Fn(f64) -> Vec<SideArc>| {
            let force = |by: f64| self.mean_force_in(&Contact { sides: &shifted(by), ..*contact });
            force(SHIFT).less(&force(-SHIFT)).times(0.5 / SHIFT)
        };
        if contact.sides.is_empty() {
            return [LinearForce::zero(); 2];
        }
        [
            quotient(&|by| contact.sides.iter().filter_map(|arc| to_the_left(arc, by)).collect()),
            quotient(&|by| self.up(contact.sides, by)),
        ]
    }

    /// The arcs as the tool meets them `by` [m] further up its axis. The material goes on below its tip.
    /// On the corner its borders follow the wall, whose slope follows from the next layer.
    fn up(&self, sides: &[SideArc], by: f64) -> Vec<SideArc> {
        let middle = |arc: &SideArc| (arc.from + arc.to) / 2.0;
        let layers: Vec<&[SideArc]> = sides.chunk_by(|a, b| a.from == b.from).collect();
        let mut raised = Vec::with_capacity(sides.len());
        for (number, layer) in layers.iter().enumerate() {
            let above = layers.get(number + 1);
            for (place, arc) in layer.iter().enumerate() {
                if middle(arc) >= self.corner_radius {
                    let from = if arc.from <= self.corner_radius { arc.from } else { arc.from - by };
                    raised.push(SideArc { from, to: arc.to - by, ..*arc });
                    continue;
                }
                let to = if above.is_some() { arc.to } else { arc.to - by };
                let next =
                    above.filter(|above| above.len() == layer.len()).map_or(arc, |above| &above[place]);
                let (own, other) = (self.radius_at(middle(arc)), self.radius_at(middle(next)));
                let part = if middle(next) > middle(arc) { by / (middle(next) - middle(arc)) } else { 0.0 };
                let border = |angle: f64, next: f64, shift: f64| {
                    let beside = own * math::cos(angle);
                    let rate = (beside - other * math::cos(next)) * part / (own * by);
                    if shift == 0.0 { angle } else { shifted(arc, angle, rate, by) }
                };
                let entry = border(arc.entry, next.entry, arc.shift[0]);
                let exit = border(arc.exit, next.exit, arc.shift[1]);
                raised.push(SideArc { to, entry, exit, ..*arc });
            }
        }
        raised.retain(|arc| arc.to > arc.from && arc.exit > arc.entry);
        raised
    }
}

/// An arc as the tool meets it `by` [m] further to its left.
fn to_the_left(arc: &SideArc, by: f64) -> Option<SideArc> {
    let (entry, exit) = (shifted(arc, arc.entry, arc.shift[0], by), shifted(arc, arc.exit, arc.shift[1], by));
    (exit > entry).then_some(SideArc { entry, exit, ..*arc })
}

/// The border of an arc at an angle whose -cos grows at a rate [1/m], after a shift `by` [m].
fn shifted(arc: &SideArc, angle: f64, rate: f64, by: f64) -> f64 {
    let (far, part) = YIELD;
    let width = (math::cos(arc.entry) - math::cos(arc.exit)).abs();
    let grazing = (2.0 * (rate.abs() * far).min(part * width)).sqrt();
    if rate == 0.0 { angle } else { angle + rate * by / math::sin(angle).abs().max(grazing) }
}
