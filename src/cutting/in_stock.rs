//! The cut where the tool is in the stock: the side by its arcs in material, the bottom where the
//! tool dives.
//!
//! A tooth's chip is the feed's part along the normal of its edge: c (s sin(phi) sin(kappa) + d
//! cos(kappa)), with the shares s across and d down the axis (S. Engin, Y. Altintas, Int. J. Mach.
//! Tools Manufact. 41 (2001), eqs. 12 to 19). Over the height dz and the width dr of a piece of edge the
//! chip section is c (s sin(phi) dz + d dr). The bottom's edges are the limit kappa = 0, with the
//! tangential force K_tc c + K_te and the axial one K_rc c + K_re on each metre of edge: a whole bottom
//! pushes the tool up by N R (K_rc c + K_re). Left out: the chisel edge, where the cutting speed
//! is none, and a core that is not cut.

use crate::cutting::force::primitive;
use crate::cutting::tool::Slice;
use crate::cutting::{Coefficients, Cut, LinearForce};
use crate::math::{self, TAU};
use crate::stock::{Contact, Contacts, FloorArc, SideArc};
use nalgebra::Vector3;

/// Slope from which the bottom's edges cut with their whole edge force; less steep ramps rub less. As
/// for slow feeds, an assumption.
const STEEP: f64 = 0.1;

/// Share of the bottom's edge force where the feed's share down the axis is `down`.
fn rubbing(down: f64) -> f64 {
    (down / STEEP).min(1.0)
}

/// Figures of the cut at a place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlaceFigures {
    /// Material removed for 1 m of path [m^2].
    pub section: f64,
    /// Mean chip thickness for 1 m of feed per tooth.
    pub chip: f64,
    /// Mean torque for 1 m of feed per tooth [N], and by the edges [N m].
    pub torque: [f64; 2],
}

impl Cut {
    /// The edge in material around the side.
    pub(super) fn engaged(&self, contact: &Contact) -> Vec<Slice> {
        contact.sides.iter().map(|arc| self.piece(arc)).collect()
    }

    /// The piece of the edge in an arc, which lies on the corner or on the cylinder.
    fn piece(&self, arc: &SideArc) -> Slice {
        let SideArc { from, to, entry, exit, .. } = *arc;
        let (height, corner, own) = (to - from, self.corner_radius, self.towards_spindle());
        if (from + to) / 2.0 >= corner {
            let radius = self.radius();
            return Slice { from, height, edge: height, radius, coefficients: own, entry, exit };
        }
        let kappa = |height: f64| math::acos((1.0 - height / corner).max(0.0));
        let (low, high) = (kappa(from), kappa(to));
        let (coefficients, sin) = self.turned(&own, (low, high), height);
        let radius = self.radius() - corner + corner * sin;
        Slice { from, height, edge: corner * (high - low), radius, coefficients, entry, exit }
    }

    /// Width of a piece seen along the axis [m]: what it cuts of a feed down the axis. None of the
    /// cylinder.
    fn run(&self, piece: &Slice) -> f64 {
        self.radius_at(piece.from + piece.height) - self.radius_at(piece.from)
    }

    /// Mean force over a revolution at a contact, in {T}, for the feed per tooth along the path.
    pub fn mean_force_in(&self, contact: &Contact) -> LinearForce {
        let slices = self.engaged(contact);
        let (side, below) = (self.mean_of(&slices), self.below(contact, &slices));
        LinearForce { cutting: side.cutting * contact.across + below.cutting, edge: side.edge + below.edge }
    }

    /// Mean force of the corner [N/m] for 1 m of feed per tooth down the axis: its chip is the same all
    /// round.
    fn dipping(&self, slices: &[Slice]) -> Vector3<f64> {
        let corner = slices.iter().filter(|slice| slice.from + slice.height / 2.0 < self.corner_radius);
        let force = |slice: &Slice| {
            let k = &slice.coefficients;
            let constant = Coefficients { kte: k.ktc, kre: k.krc, kae: k.kac, ..Coefficients::default() };
            let scale = f64::from(self.flutes) * self.run(slice) / TAU;
            (primitive(&constant, slice.exit).1 - primitive(&constant, slice.entry).1) * scale
        };
        corner.map(force).fold(Vector3::zeros(), |sum, force| sum + force)
    }

    /// Mean force of the bottom's edges over a revolution.
    fn bottom(&self, floors: &[FloorArc]) -> LinearForce {
        let k = &self.coefficients;
        let mut mean = LinearForce::zero();
        for arc in floors {
            let (from, to) = (math::sin_cos(arc.entry), math::sin_cos(arc.exit));
            // Integrals of the tangent's direction and of 1 over the angle (eq. 4.3).
            let along = Vector3::new(from.0 - to.0, from.1 - to.1, 0.0);
            let up = Vector3::z() * (arc.exit - arc.entry);
            let scale = f64::from(self.flutes) * arc.width / TAU;
            mean.cutting += (along * k.ktc + up * k.krc) * scale;
            mean.edge += (along * k.kte + up * k.kre) * scale;
        }
        mean
    }

    /// Largest force on the tool within a revolution [N] at a contact and the feed per tooth `c` [m];
    /// that of the bottom is its mean, and runout is left out.
    pub fn peak_force_in(&self, contact: &Contact, c: f64) -> f64 {
        let slices = self.engaged(contact);
        let below = self.below(contact, &slices).at(c).norm();
        if slices.is_empty() { below } else { self.peak_of(&slices, &slices, c * contact.across) + below }
    }

    /// Mean force by the feed down the axis, for the feed per tooth along the path.
    fn below(&self, contact: &Contact, slices: &[Slice]) -> LinearForce {
        let bottom = self.bottom(contact.floors);
        let down = contact.down.max(0.0);
        LinearForce {
            cutting: self.dipping(slices) * contact.down + bottom.cutting * down,
            edge: bottom.edge * rubbing(down),
        }
    }

    /// Force over one revolution at a contact, in `steps` even steps of the immersion angle, as
    /// [`Cut::revolution`]; that of the bottom is its mean, and runout is left out.
    pub fn revolution_in(&self, contact: &Contact, steps: usize, c: f64) -> (Vec<f64>, Vec<Vector3<f64>>) {
        let slices = self.engaged(contact);
        let below = self.below(contact, &slices).at(c);
        let angles: Vec<f64> = (0..=steps).map(|step| TAU * step as f64 / steps as f64).collect();
        let force = |&phi: &f64| self.instant(&slices, phi).at(c * contact.across) + below;
        let forces = angles.iter().map(force).collect();
        (angles, forces)
    }

    /// Figures of the cut at a contact.
    pub fn figures_in(&self, contact: &Contact) -> PlaceFigures {
        let Contact { across, down, .. } = *contact;
        let slices = self.engaged(contact);
        let [chip, edge] = self.chip_in(contact, &slices);
        let edges = self.torque_of(&slices, 0.0);
        let mut section = Self::section_of(&slices) * across;
        let mut torque = [(self.torque_of(&slices, 1.0) - edges) * across, edges];
        let turning = f64::from(self.flutes) / TAU;
        for slice in &slices {
            let area = self.run(slice) * slice.radius * (slice.exit - slice.entry);
            section += area * down;
            torque[0] += area * turning * slice.coefficients.ktc * down;
        }
        let dives = down.max(0.0);
        for floor in contact.floors {
            let area = floor.radius * floor.width * (floor.exit - floor.entry);
            section += area * dives;
            torque[0] += area * turning * self.coefficients.ktc * dives;
            torque[1] += area * turning * self.coefficients.kte * rubbing(dives);
        }
        PlaceFigures { section, chip: if edge > 0.0 { chip / edge } else { 0.0 }, torque }
    }

    /// The chip of a tooth for 1 m of feed per tooth [m], and its engaged edge times arc [m].
    fn chip_in(&self, contact: &Contact, slices: &[Slice]) -> [f64; 2] {
        let [chip, edge] = Self::chip_of(slices);
        let dip = slices.iter().map(|slice| self.run(slice) * (slice.exit - slice.entry));
        let floor = contact.floors.iter().map(|arc| arc.width * (arc.exit - arc.entry));
        let [dip, floor] = [dip.fold(0.0, |sum, arc| sum + arc), floor.fold(0.0, |sum, arc| sum + arc)];
        [chip * contact.across + dip * contact.down + floor * contact.down.max(0.0), edge + floor]
    }

    /// Mean chip thickness along a path, for 1 m of feed per tooth; `None` in the air.
    pub fn mean_chip_along(&self, contacts: &Contacts) -> Option<f64> {
        let (mut chip, mut edge) = (0.0, 0.0);
        for ((index, station), contact) in contacts.each() {
            let length = contacts.share(index, station);
            let here = self.chip_in(&contact, &self.engaged(&contact));
            chip += here[0] * length;
            edge += here[1] * length;
        }
        (edge > 0.0).then(|| chip / edge)
    }
}
