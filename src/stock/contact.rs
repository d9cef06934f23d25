//! Where the tool touches the stock at a place of the path.

use crate::math;

/// A range of heights and immersion angles in which a tooth's edge is in material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SideArc {
    /// Lower height above the tip [m].
    pub from: f64,
    /// Upper height above the tip [m].
    pub to: f64,
    /// Immersion angle where a tooth enters [rad], within [0, pi].
    pub entry: f64,
    /// Immersion angle where it leaves [rad].
    pub exit: f64,
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
    /// Share of the feed down the tool axis; 0 where it climbs.
    pub down: f64,
}

impl Contact<'_> {
    /// Whether the tool is in the air.
    pub fn is_air(&self) -> bool {
        self.sides.is_empty() && self.floors.is_empty()
    }

    /// The arcs at the lowest height in material.
    pub fn tip(&self) -> &[SideArc] {
        let from = self.sides.first().map_or(0.0, |arc| arc.from);
        let count = self.sides.partition_point(|arc| arc.from == from);
        &self.sides[..count]
    }

    /// Outer bounds of the immersion angles at the tip [rad].
    pub fn bounds(&self) -> Option<(f64, f64)> {
        let tip = self.tip();
        Some((tip.first()?.entry, tip.last()?.exit))
    }

    /// Angle in material at the tip [rad].
    pub fn engaged(&self) -> f64 {
        self.tip().iter().fold(0.0, |sum, arc| sum + (arc.exit - arc.entry))
    }

    /// Width of the material in the tool's way at the tip [m], for a tool of the radius `radius` [m].
    pub fn radial_depth(&self, radius: f64) -> f64 {
        let width = |arc: &SideArc| radius * (math::cos(arc.entry) - math::cos(arc.exit));
        self.tip().iter().map(width).fold(0.0, |sum, width| sum + width)
    }

    /// Height of the material around the tool [m].
    pub fn axial_depth(&self) -> f64 {
        let low = self.sides.iter().map(|arc| arc.from).fold(f64::INFINITY, f64::min);
        self.sides.iter().map(|arc| arc.to - low).fold(0.0, f64::max)
    }
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
    /// Number of stations before each move's, and their number; none of a rapid move.
    firsts: Vec<u32>,
}

impl Contacts {
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
