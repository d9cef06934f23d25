//! Where commands take the tip at a few places, with any drawn plant.

use crate::cutting::PartForces;
use crate::deviation::{Reference, Sources, contour, missed, simulate};
use crate::motion::TimingLaw;
use crate::plan::Plan;
use crate::progress::Progress;
use crate::robot::Joints;
use crate::setup::Setup;
use crate::uncertainty::draw::{self, Draw};
use crate::uncertainty::place::{DrawnPlace, places};
use nalgebra::Vector3;
use std::sync::Arc;

/// Frequencies at which the filtered motion is computed; in between it is interpolated.
const FREQUENCIES: usize = 9;
/// The plant with one of a few frequencies of its filter: factor on the frequency, plan, and timing of
/// the tool.
pub(super) type Filtered<'a> = (f64, &'a Plan, &'a TimingLaw);

/// The plan with each frequency of the filter at which it is computed, rising; the nominal one is in
/// the middle.
pub(super) fn filtered(plan: &Plan) -> Vec<(f64, Plan)> {
    let spread = plan.setup.spreads.frequency;
    if spread.deviation() == 0.0 || plan.shaper().duration() == 0.0 {
        return vec![(1.0, plan.clone())];
    }
    let tuned = |k: usize| {
        let factor = spread.at(draw::CUT_OFF * (2.0 * k as f64 / (FREQUENCIES - 1) as f64 - 1.0));
        let setup = Setup { shaper: plan.shaper().tuned(factor), ..(*plan.setup).clone() };
        (factor, Plan { setup: Arc::new(setup), ..plan.clone() })
    };
    (0..FREQUENCIES).map(tuned).collect()
}

/// What every set of commands is sent through.
pub(super) struct Plants<'a> {
    pub(super) filtered: Vec<Filtered<'a>>,
    pub(super) parts: PartForces,
}

impl Plants<'_> {
    /// What of the path the tip never reaches with joint commands [rad] and `factor` times the
    /// frequency of the filter [m].
    pub(super) fn missed(&self, q: &[Joints], factor: f64) -> f64 {
        let plan = self.nominal().1;
        let setup = Setup { shaper: plan.shaper().tuned(factor), ..(*plan.setup).clone() };
        let plan = Plan { setup: Arc::new(setup), ..plan.clone() };
        let reference = Reference::along(&plan, Sources::ALL);
        let actual = simulate(&plan, &reference, q, &mut Progress::none()).actual;
        missed::missed(&plan.path, &reference.arc_length, &actual).max
    }

    pub(super) fn nominal(&self) -> Filtered<'_> {
        self.filtered[self.filtered.len() / 2]
    }

    /// The outcome of joint commands [rad] at samples, at a height above the tip [m].
    pub(super) fn send(&self, q: &[Joints], at: &[usize], height: f64) -> Outcomes<'_> {
        let node = |(factor, plan, timing): &Filtered| {
            (*factor, places(plan, (timing, &self.parts), (q, at), height))
        };
        Outcomes { plan: self.nominal().1, nodes: self.filtered.iter().map(node).collect() }
    }
}

/// Where commands take the tip at a few places.
pub(super) struct Outcomes<'a> {
    pub(super) plan: &'a Plan,
    /// Factors on the filter's frequency, rising, and the places with each.
    pub(super) nodes: Vec<(f64, Vec<DrawnPlace>)>,
}

impl Outcomes<'_> {
    /// Adds other places of the same commands.
    pub(super) fn extend(&mut self, more: Self) {
        for ((_, places), (_, more)) in self.nodes.iter_mut().zip(more.nodes) {
            places.extend(more);
        }
    }

    /// Puts the places in an order, given as their present numbers.
    pub(super) fn reorder(&mut self, order: &[usize]) {
        for (_, places) in &mut self.nodes {
            *places = order.iter().map(|&k| places[k]).collect();
        }
    }

    /// The tip at a place with a drawn plant [m] and the nominal frequency of the filter.
    pub(super) fn tip(&self, place: usize, draw: &Draw) -> Vector3<f64> {
        self.nodes[self.nodes.len() / 2].1[place].tip(self.plan, draw)
    }

    /// Contour error at a place with a drawn plant [m].
    pub(super) fn error(&self, place: usize, draw: &Draw) -> Vector3<f64> {
        let ((s, target), tip) = self.drawn(place, draw);
        contour::closest(&self.plan.path, (s, &target), &tip).point - tip
    }

    /// Where the tool should be at a place with a drawn plant, as arc length and point of the path [m], and
    /// where its tip is [m].
    pub(super) fn drawn(&self, place: usize, draw: &Draw) -> ((f64, Vector3<f64>), Vector3<f64>) {
        let node = |k: usize| &self.nodes[k].1[place];
        let above = self.nodes.partition_point(|(factor, _)| *factor < draw.frequency);
        if above == 0 || above == self.nodes.len() {
            let place = node(above.min(self.nodes.len() - 1));
            return ((place.arc_length, place.target), place.tip(self.plan, draw));
        }
        let (from, to) = (node(above - 1), node(above));
        let (low, high) = (self.nodes[above - 1].0, self.nodes[above].0);
        let part = (draw.frequency - low) / (high - low);
        let s = from.arc_length + (to.arc_length - from.arc_length) * part;
        let tip = from.tip(self.plan, draw).lerp(&to.tip(self.plan, draw), part);
        ((s, self.plan.path.point(s)), tip)
    }

    /// Length of that error [m].
    pub(super) fn size(&self, place: usize, draw: &Draw) -> f64 {
        match &self.nodes[..] {
            [(_, places)] => places[place].near.error(&self.plan.path, &places[place].tip(self.plan, draw)),
            _ => self.error(place, draw).norm(),
        }
    }

    /// Largest contour error with a drawn plant [m], at some of the places.
    pub(super) fn largest_at(&self, places: &[usize], draw: &Draw) -> f64 {
        places.iter().map(|&place| self.size(place, draw)).fold(0.0, f64::max)
    }

    /// Largest contour error with a drawn plant [m].
    pub(super) fn largest(&self, draw: &Draw) -> f64 {
        (0..self.nodes[0].1.len()).map(|place| self.size(place, draw)).fold(0.0, f64::max)
    }
}
