//! Deviation of the surface left at a sample.

use crate::deviation::Deviation;
use crate::motion::TimingLaw;
use crate::plan::Plan;
use crate::stock::{Contact, Contacts, Cutter};
use crate::surface::facet::{Across, FACETS, FacetSet, members};
use crate::surface::{LeftFacets, SurfacePlace, cutter};
use nalgebra::Vector3;

/// What the excess at each sample is computed from. All vectors are in the base frame.
pub struct Excesses<'a> {
    pub(super) plan: &'a Plan,
    left: &'a LeftFacets,
    contacts: &'a Contacts,
    cutter: Cutter,
    /// The workpiece's y and z axes.
    axes: [Vector3<f64>; 2],
}

/// The tool at a sample: how far it is from its place, and which way facets lie.
pub(super) struct Displaced<'a> {
    across: Across,
    /// From the tip's place on the path to the tip [m].
    moved: Vector3<f64>,
    /// Turn of the tool axis by deflection [rad], with the contact and the tool to find heights; `None` if it is not
    /// known.
    turned: Option<(Vector3<f64>, Contact<'a>, &'a Cutter)>,
}

impl<'a> Excesses<'a> {
    /// Of a plan whose engagement follows a stock.
    pub(crate) fn new(plan: &'a Plan, left: &'a LeftFacets, contacts: &'a Contacts) -> Self {
        let axis = |axis: Vector3<f64>| plan.setup.workpiece.direction(&axis);
        let axes = [axis(Vector3::y()), axis(Vector3::z())];
        Self { plan, left, contacts, cutter: cutter(plan), axes }
    }

    /// Largest excess of the facets left at the sample `k` [m]; `None` where nothing is left.
    pub fn worst(&self, timing: &TimingLaw, k: usize, run: &Deviation) -> Option<f64> {
        let set = self.set(timing, k);
        if set == 0 {
            return None;
        }
        let displaced = self.at(timing, k, run);
        let each = members(set).map(|facet| displaced.of(facet));
        each.reduce(|worst, excess| if excess.abs() > worst.abs() { excess } else { worst })
    }

    /// The facets left where the tool is at the sample `k`.
    pub(super) fn set(&self, timing: &TimingLaw, k: usize) -> FacetSet {
        let index = timing.index[k] as usize;
        let path = &self.plan.path;
        let length = path.start(index + 1) - path.start(index);
        self.left.at(index, (timing.arc_length[k] - path.start(index)) / length)
    }

    /// The tool at the sample `k` of a run.
    pub(super) fn at(&self, timing: &TimingLaw, k: usize, run: &Deviation) -> Displaced<'_> {
        let index = timing.index[k] as usize;
        let mut displaced = self.displaced(index, &run.actual[k]);
        if let Some(axis) = run.axis.get(k) {
            let contact = self.contact(index, timing.arc_length[k]);
            displaced.turned = contact.map(|contact| (self.axes[1].cross(axis), contact, &self.cutter));
        }
        displaced
    }

    /// A tip [m] on the move `index`. What it is ahead or behind does not matter to surface along the move, so
    /// it is compared with the nearest place of the move that it is due on.
    fn displaced(&self, index: usize, tip: &Vector3<f64>) -> Displaced<'_> {
        let segment = &self.plan.path.moves()[index].segment;
        let within = segment.closest(tip, 0.0, segment.length());
        let across = Across::of(&segment.tangent(within), &self.axes[1], &self.axes[0]);
        Displaced { across, moved: tip - segment.point(within), turned: None }
    }

    /// Largest size of the excess over the facets left at the sample `k` with the tip elsewhere [m].
    pub(super) fn largest(&self, timing: &TimingLaw, k: usize, tip: &Vector3<f64>) -> f64 {
        let displaced = self.displaced(timing.index[k] as usize, tip);
        members(self.set(timing, k)).map(|facet| displaced.of(facet).abs()).fold(0.0, f64::max)
    }

    /// A facet left at a sample in full.
    pub(super) fn describe(
        &self,
        timing: &TimingLaw,
        (k, facet): (usize, usize),
        (before, after): (&Deviation, &Deviation),
    ) -> SurfacePlace {
        let (path, index) = (&self.plan.path, timing.index[k] as usize);
        let offset = self.offset(timing, k, facet).unwrap_or_default();
        let excess = |run| self.at(timing, k, run).of(facet);
        SurfacePlace {
            kind: FACETS[facet].kind,
            sample: k,
            line: path.moves()[index].line,
            arc_length: timing.arc_length[k],
            point: self.plan.setup.workpiece.inverse().point(&(self.tip(timing, k) + offset)),
            height: self.axes[1].dot(&offset),
            before: excess(before),
            after: excess(after),
        }
    }

    /// The nominal place of a facet at a sample [m]; `None` if the tool does not cut it there.
    pub(super) fn place(&self, timing: &TimingLaw, k: usize, facet: usize) -> Option<Vector3<f64>> {
        Some(self.tip(timing, k) + self.offset(timing, k, facet)?)
    }

    /// A facet's normal into the material at a sample.
    pub(super) fn normal(&self, timing: &TimingLaw, k: usize, facet: usize) -> Vector3<f64> {
        self.across(timing, k).normal(&FACETS[facet])
    }

    /// The tip on the path at a sample [m].
    fn tip(&self, timing: &TimingLaw, k: usize) -> Vector3<f64> {
        let path = &self.plan.path;
        path.point_at(path.within(timing.index[k] as usize, timing.arc_length[k]))
    }

    fn across(&self, timing: &TimingLaw, k: usize) -> Across {
        let (path, index) = (&self.plan.path, timing.index[k] as usize);
        let (_, within) = path.within(index, timing.arc_length[k]);
        Across::of(&path.moves()[index].segment.tangent(within), &self.axes[1], &self.axes[0])
    }

    /// From the tip on the path to a facet [m].
    fn offset(&self, timing: &TimingLaw, k: usize, facet: usize) -> Option<Vector3<f64>> {
        let contact = self.contact(timing.index[k] as usize, timing.arc_length[k])?;
        self.across(timing, k).place(&FACETS[facet], &self.cutter, &contact)
    }

    /// The contact at the arc length `s` [m] of the path, on the move `index`.
    fn contact(&self, index: usize, s: f64) -> Option<Contact<'_>> {
        let (from, to, share) = self.contacts.around(index, s - self.plan.path.start(index))?;
        Some(self.contacts.at(if share < 0.5 { from } else { to }))
    }
}

impl Displaced<'_> {
    /// Excess of a facet [m]: how far the tool is from the material it should reach.
    pub(super) fn of(&self, facet: usize) -> f64 {
        let facet = &FACETS[facet];
        let turned = self.turned.and_then(|(turn, contact, cutter)| {
            Some(turn.cross(&self.across.place(facet, cutter, &contact)?))
        });
        -(self.moved + turned.unwrap_or_default()).dot(&self.across.normal(facet))
    }
}
