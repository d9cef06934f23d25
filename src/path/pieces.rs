//! A path whose moves are run in pieces, each at a pace of its own.

use crate::path::{Move, MovePace, Path, RollReference};

/// A piece of a move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Its move.
    pub index: usize,
    /// Where it starts within the move [m].
    pub from: f64,
    /// Where it ends [m].
    pub to: f64,
    /// Its pace.
    pub pace: MovePace,
}

impl Path {
    /// The same path with its moves in pieces: one or more a move, in order, each starting where the one
    /// before ends. A piece keeps the line and the spindle speed of its move; arc lengths, waits and roll
    /// stay where they are.
    pub fn in_pieces(&self, pieces: &[Piece]) -> Self {
        let moves = pieces.iter().map(|piece| self.part(piece)).collect::<Vec<_>>();
        let end = std::iter::once(self.length());
        let starts = pieces.iter().map(|piece| self.starts[piece.index] + piece.from).chain(end).collect();
        let reference = match &self.reference {
            RollReference::Carried(at) => RollReference::carried(&moves, at[0], &self.ways),
            zero => zero.clone(),
        };
        Self { moves: moves.into(), starts, reference, ..self.clone() }
    }

    /// A piece as a move of its own.
    fn part(&self, &Piece { index, from, to, pace }: &Piece) -> Move {
        let step = self.moves[index];
        if from == 0.0 && to == step.segment.length() {
            return Move { pace, ..step };
        }
        let (axis_from, axis_to) = (self.axis_at((index, from)), self.axis_at((index, to)));
        Move { segment: step.segment.part(from, to), axis_from, axis_to, pace, ..step }
    }
}
