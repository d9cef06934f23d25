//! The mean force along a path: the same everywhere, or as the stock makes it.

use crate::cutting::{Cut, LinearForce, Loading};
use crate::path::Path;
use crate::stock::{Contact, Contacts};
use std::sync::Arc;

/// A feed whose share across the tool axis is less only plunges.
const ALONG: f64 = 1e-6;

/// Mean force in {T} by the place on a path.
#[derive(Debug, Clone, PartialEq)]
pub enum MeanForces {
    /// Of a stated engagement.
    Stated(LinearForce),
    /// At the stations of the contacts with the stock, between which it is linear.
    InStock {
        /// The contacts.
        contacts: Arc<Contacts>,
        /// One force a station.
        forces: Arc<[LinearForce]>,
    },
}

/// The place where the mean force is largest at the programmed feed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeaviestPlace {
    /// Its move.
    pub index: usize,
    /// Its station.
    pub station: usize,
    /// Feed per tooth there [m].
    pub chip: f64,
}

impl HeaviestPlace {
    /// The contact there.
    pub fn contact<'a>(&self, contacts: &'a Contacts) -> Contact<'a> {
        contacts.at(self.station)
    }
}

impl MeanForces {
    /// The mean force of a cut in the stock, or with its own engagement.
    pub fn of(cut: &Cut, contacts: Option<&Arc<Contacts>>) -> Self {
        let Some(contacts) = contacts else { return Self::Stated(cut.mean_force()) };
        let forces = contacts.each().map(|(_, contact)| cut.mean_force_in(&contact)).collect();
        Self::InStock { contacts: contacts.clone(), forces }
    }

    /// The force at the arc length `within` [m] of the move `index`.
    pub fn at(&self, index: usize, within: f64) -> LinearForce {
        match self {
            Self::Stated(force) => *force,
            Self::InStock { contacts, forces } => {
                let Some((from, to, share)) = contacts.around(index, within) else {
                    return LinearForce::zero();
                };
                forces[from].towards(&forces[to], share)
            }
        }
    }

    /// The heaviest place in a stock, one where the tool goes along and its side cuts if it does anywhere; `None`
    /// if all is air, or the engagement is stated.
    pub fn heaviest(&self, loading: &Loading, path: &Path) -> Option<HeaviestPlace> {
        let Self::InStock { contacts, forces } = self else { return None };
        let mut most = ((false, 0.0), None);
        for ((index, station), contact) in contacts.each() {
            let step = &path.moves()[index];
            let Some(feed) = loading.programmed(step) else { continue };
            let chip = loading.chip.at(feed, step.spindle);
            let goes_along = contact.across > ALONG && !contact.sides.is_empty();
            let size = (goes_along, forces[station].at(chip).norm());
            if size.1 > 0.0 && size > most.0 {
                most = (size, Some(HeaviestPlace { index, station, chip }));
            }
        }
        most.1
    }
}

/// The mean force and the stiffness of a cut by the tangential, the radial and the axial coefficients
/// alone, which add up to them. They are computed on demand.
#[derive(Debug, Clone, PartialEq)]
pub struct PartForces {
    cuts: [Cut; 3],
    /// The forces of a stated engagement.
    stated: [LinearForce; 3],
    contacts: Option<Arc<Contacts>>,
}

impl PartForces {
    /// The parts of a cut in the stock, or with its own engagement.
    pub fn of(cut: &Cut, contacts: Option<&Arc<Contacts>>) -> Self {
        Self { cuts: cut.alone(), stated: cut.mean_force_parts(), contacts: contacts.cloned() }
    }

    /// The parts of the force at the arc length `within` [m] of the move `index`.
    pub fn at(&self, index: usize, within: f64) -> [LinearForce; 3] {
        let Some(contacts) = &self.contacts else { return self.stated };
        let Some((from, to, share)) = contacts.around(index, within) else {
            return [LinearForce::zero(); 3];
        };
        let (from, to) = (contacts.at(from), contacts.at(to));
        self.cuts.each_ref().map(|cut| cut.mean_force_in(&from).towards(&cut.mean_force_in(&to), share))
    }

    /// The parts of the stiffness there; none of a stated engagement.
    pub fn stiffness_at(&self, index: usize, within: f64) -> [[LinearForce; 2]; 3] {
        let around = self.contacts.as_ref().and_then(|contacts| {
            contacts
                .around(index, within)
                .map(|(from, to, share)| (contacts.at(from), contacts.at(to), share))
        });
        let Some((from, to, share)) = around else { return [[LinearForce::zero(); 2]; 3] };
        self.cuts.each_ref().map(|cut| {
            let (from, to) = (cut.stiffness_in(&from), cut.stiffness_in(&to));
            [0, 1].map(|way| from[way].towards(&to[way], share))
        })
    }
}
