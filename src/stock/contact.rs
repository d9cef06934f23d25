//! Where the tool touches the stock at a place of the path.

use crate::math;

/// A range of heights and immersion angles in which a tooth's edge is in material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SideArc {
    /// Lower height above the tip [m].
    pub from: f64,
    /// Upper height above the tip [m].
    pub to: f64,
    /// Immersion angle where a tooth enters [rad], within [0, pi]; on a corner that dives within [0, 2 pi].
    pub entry: f64,
    /// Immersion angle where it leaves [rad].
    pub exit: f64,
    /// How fast -cos(entry) and -cos(exit) grow as the tool shifts to its left [1/m]: 1 / r where the
    /// material ends along the feed, 0 where it goes on around the tool.
    pub shift: [f64; 2],
}

/// An arc of a ring of the tool's bottom that is in material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FloorArc {
    /// Radius of the ring [m].
    pub radius: f64,
    /// Its width [m].
    pub width: f64,
    /// Immersion angle where a tooth enters [rad], within [0, 2 pi].
    pub entry: f64,
    /// Immersion angle where it leaves [rad].
    pub exit: f64,
}

/// What the tool meets at a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact<'a> {
    /// Around its side, from the tip up.
    pub sides: &'a [SideArc],
    /// Under its bottom; only where it dives.
    pub floors: &'a [FloorArc],
    /// Share of the feed across the tool axis.
    pub across: f64,
    /// Share of the feed down the tool axis; negative where it climbs.
    pub down: f64,
}

impl Contact<'_> {
    /// Whether the tool is in the air.
    pub fn is_air(&self) -> bool {
        self.sides.is_empty() && self.floors.is_empty()
    }

    /// The arcs at the height where the tool is engaged most: of a cylinder at the tip.
    pub fn widest(&self) -> &[SideArc] {
        let layers = self.sides.chunk_by(|a, b| a.from == b.from);
        let angle = |layer: &[SideArc]| layer.iter().fold(0.0, |sum, arc| sum + (arc.exit - arc.entry));
        let most = layers.fold((0.0, &self.sides[..0]), |most, layer| {
            let angle = angle(layer);
            if angle > most.0 { (angle, layer) } else { most }
        });
        most.1
    }

    /// Outer bounds of the immersion angles there [rad].
    pub fn bounds(&self) -> Option<(f64, f64)> {
        let widest = self.widest();
        Some((widest.first()?.entry, widest.last()?.exit))
    }

    /// Angle in material there [rad].
    pub fn engaged(&self) -> f64 {
        self.widest().iter().fold(0.0, |sum, arc| sum + (arc.exit - arc.entry))
    }

    /// Width of the material in the tool's way [m], at the height where it is largest; `radius` gives the
    /// tool's radius at a height above its tip [m].
    pub fn radial_depth(&self, radius: impl Fn(f64) -> f64) -> f64 {
        let width = |layer: &[SideArc]| {
            let wide = |arc: &SideArc| math::cos(arc.entry) - math::cos(arc.exit);
            let sum = layer.iter().fold(0.0, |sum, arc| sum + wide(arc));
            sum * radius((layer[0].from + layer[0].to) / 2.0)
        };
        self.sides.chunk_by(|a, b| a.from == b.from).map(width).fold(0.0, f64::max)
    }

    /// Height of the material around the tool [m].
    pub fn axial_depth(&self) -> f64 {
        let low = self.sides.iter().map(|arc| arc.from).fold(f64::INFINITY, f64::min);
        self.sides.iter().map(|arc| arc.to - low).fold(0.0, f64::max)
    }
}

/// What meets material that it does not cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Collider {
    /// The tool on a rapid move.
    Rapid,
    /// What is above the flutes: shank or holder.
    Shank,
    /// The holder.
    Holder,
}

/// The first place in a move where something meets material that it does not cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collision {
    /// What.
    pub collider: Collider,
    /// Number of the move.
    pub index: usize,
    /// Arc length within the move [m].
    pub within: f64,
}

/// A place at which contact was determined.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Station {
    /// Arc length within its move [m].
    pub(super) within: f64,
    /// Shares of the feed across and down.
    lean: [f64; 2],
    /// Ends of its arcs in the lists of all.
    sides: u32,
    floors: u32,
}

/// What the tool meets at stations along a path: both ends of each move and as many between as the
/// contact needs to be nearly linear from one to the next.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Contacts {
    stations: Vec<Station>,
    sides: Vec<SideArc>,
    floors: Vec<FloorArc>,
    /// Places where something meets material that it does not cut; one of each kind in a move.
    pub collisions: Vec<Collision>,
    /// Width of a cell [m] if a map of heights was used.
    pub cell: Option<f64>,
    /// Number of stations before each move's, and their number; none of a rapid move.
    firsts: Vec<u32>,
}

impl Contacts {
    /// No contacts yet, on a map of heights with cells of the width `cell` [m].
    pub(super) fn on_map(cell: f64) -> Self {
        Self { cell: Some(cell), ..Self::default() }
    }

    /// Begins the next move.
    pub(super) fn begin(&mut self) {
        self.firsts.push(self.stations.len() as u32);
    }

    /// Adds a station to the last move, with the shares of its feed across and down the tool axis.
    pub(super) fn push(&mut self, within: f64, lean: [f64; 2], sides: &[SideArc], floors: &[FloorArc]) {
        self.sides.extend_from_slice(sides);
        self.floors.extend_from_slice(floors);
        let (sides, floors) = (self.sides.len() as u32, self.floors.len() as u32);
        self.stations.push(Station { within, lean, sides, floors });
    }

    /// Notes a collision in the last move, unless its kind is already noted there.
    pub(super) fn collide(&mut self, collider: Collider, within: f64) {
        let collision = Collision { collider, index: self.firsts.len() - 1, within };
        let own = self.collisions.iter().rev().take_while(|known| known.index == collision.index);
        if !own.map(|known| known.collider).any(|known| known == collider) {
            self.collisions.push(collision);
        }
    }

    /// Number of stations.
    pub fn len(&self) -> usize {
        self.stations.len()
    }

    /// Whether no move cuts.
    pub fn is_empty(&self) -> bool {
        self.stations.is_empty()
    }

    /// Arc length of a station within its move [m].
    pub fn within(&self, station: usize) -> f64 {
        self.stations[station].within
    }

    /// The stations of a move.
    pub fn of_move(&self, index: usize) -> std::ops::Range<usize> {
        let first = self.firsts[index] as usize;
        let end = self.firsts.get(index + 1).map_or(self.stations.len(), |&first| first as usize);
        first..end
    }

    /// The stations of the move `index` between two arc lengths within it [m].
    pub(super) fn between(&self, index: usize, from: f64, to: f64) -> std::ops::Range<usize> {
        let stations = self.of_move(index);
        let before =
            |limit| self.stations[stations.clone()].partition_point(|station| station.within < limit);
        stations.start + before(from)..stations.start + before(to)
    }

    /// The contact at a station.
    pub fn at(&self, station: usize) -> Contact<'_> {
        let before = station.checked_sub(1).map(|before| self.stations[before]);
        let (side, floor) =
            before.map_or((0, 0), |station| (station.sides as usize, station.floors as usize));
        let Station { sides, floors, lean: [across, down], .. } = self.stations[station];
        Contact {
            sides: &self.sides[side..sides as usize],
            floors: &self.floors[floor..floors as usize],
            across,
            down,
        }
    }

    /// The contacts at all stations in order, each with the numbers of its move and its station.
    pub fn each(&self) -> impl Iterator<Item = ((usize, usize), Contact<'_>)> {
        (0..self.firsts.len()).flat_map(move |index| {
            self.of_move(index).map(move |station| ((index, station), self.at(station)))
        })
    }

    /// The largest height of material around the tool [m].
    pub fn deepest(&self) -> f64 {
        self.each().map(|(_, contact)| contact.axial_depth()).fold(0.0, f64::max)
    }

    /// Length of path for which a station of the move `index` stands [m]: half of the way to either
    /// neighbour.
    pub fn share(&self, index: usize, station: usize) -> f64 {
        let stations = self.of_move(index);
        let last = stations.end - 1;
        let at = |station: usize| self.stations[station.clamp(stations.start, last)].within;
        (at((station + 1).min(last)) - at(station.saturating_sub(1))) / 2.0
    }

    /// The stations around the arc length `within` [m] of the move `index`, and the share of the way
    /// from the first to the second; `None` on a rapid move.
    pub fn around(&self, index: usize, within: f64) -> Option<(usize, usize, f64)> {
        let stations = self.of_move(index);
        let (first, last) = (stations.start, stations.end.checked_sub(1)?);
        if stations.is_empty() {
            return None;
        }
        let after = first + self.stations[stations].partition_point(|station| station.within <= within);
        if after == first || after > last {
            let end = after.clamp(first, last);
            return Some((end, end, 0.0));
        }
        let (from, to) = (self.stations[after - 1].within, self.stations[after].within);
        Some((after - 1, after, (within - from) / (to - from)))
    }
}
