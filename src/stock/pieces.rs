//! The contacts of a path that is run in pieces.

use crate::path::Piece;
use crate::stock::{Collision, Contacts};

/// Stations nearer to the end of a piece than this are its own [m].
const NEAR: f64 = 1e-12;

impl Contacts {
    /// The contacts along [`Path::in_pieces`](crate::path::Path::in_pieces), whose pieces begin and end
    /// at stations, and for each of its stations the one here that it was. A station between two pieces
    /// belongs to both.
    pub fn in_pieces(&self, pieces: &[Piece]) -> (Self, Vec<usize>) {
        let mut parted = self.cell.map_or_else(Self::default, Self::on_map);
        let mut origins = Vec::with_capacity(self.len());
        for (number, piece) in pieces.iter().enumerate() {
            parted.begin();
            let is_last = pieces.get(number + 1).is_none_or(|next| next.index != piece.index);
            let end = if is_last { f64::INFINITY } else { piece.to };
            for station in self.between(piece.index, piece.from - NEAR, end + NEAR) {
                let within = (self.within(station) - piece.from).clamp(0.0, piece.to - piece.from);
                let contact = self.at(station);
                parted.push(within, [contact.across, contact.down], contact.sides, contact.floors);
                origins.push(station);
            }
            let first = self.collisions.partition_point(|hit| hit.index < piece.index);
            let own = self.collisions[first..].iter().take_while(|hit| hit.index == piece.index);
            let hits = |hit: &&Collision| (piece.from..end).contains(&hit.within);
            own.filter(hits).for_each(|hit| parted.collide(hit.collider, hit.within - piece.from));
        }
        (parted, origins)
    }
}
