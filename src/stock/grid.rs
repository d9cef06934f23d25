//! The moves made so far, by where they are and how deep: what is near a place is found in one cell.

use crate::stock::swept::{Spine, Swept};
use nalgebra::Vector2;

/// Most cells of the grid.
const MOST_CELLS: f64 = 4e6;
/// Heights closer than this are the same [m].
pub(super) const SAME_HEIGHT: f64 = 1e-7;

/// Moves at one height, the newest last.
#[derive(Debug, Clone)]
pub(super) struct ClearedLevel {
    /// Height of the tip [m]; of a ramp its lowest.
    pub(super) height: f64,
    /// Numbers of the moves.
    pub(super) moves: Vec<u32>,
}

/// What lies within reach of a cell.
#[derive(Debug, Clone, Default)]
pub(super) struct GridCell {
    /// Moves that stay at a height, the lowest first.
    pub(super) levels: Vec<ClearedLevel>,
    /// Moves that climb or dive.
    pub(super) ramps: Vec<u32>,
}

/// Cells over the plane across the tool axis.
#[derive(Debug, Clone)]
pub(super) struct Grid {
    corner: Vector2<f64>,
    cell: f64,
    columns: usize,
    cells: Vec<GridCell>,
    /// Distance from a place within which moves count [m].
    reach: f64,
}

impl Grid {
    /// An empty grid over the plane between two corners, for moves within `reach` [m] of a place.
    pub(super) fn new([from, to]: [Vector2<f64>; 2], reach: f64) -> Self {
        let size = to - from;
        let least = (size.x.max(reach) * size.y.max(reach) / MOST_CELLS).sqrt();
        let cell = (reach / 2.0).max(least);
        let count = |length: f64| (length / cell).floor() as usize + 1;
        let columns = count(size.x);
        Self { corner: from, cell, columns, cells: vec![GridCell::default(); columns * count(size.y)], reach }
    }

    /// Column and row of a place, held within the grid.
    fn place(&self, at: &Vector2<f64>) -> (usize, usize) {
        let part = (at - self.corner) / self.cell;
        let rows = self.cells.len() / self.columns;
        // A negative number becomes 0.
        ((part.x as usize).min(self.columns - 1), (part.y as usize).min(rows - 1))
    }

    /// The cell of a place within the grid.
    pub(super) fn at(&self, at: &Vector2<f64>) -> &GridCell {
        let (column, row) = self.place(at);
        &self.cells[row * self.columns + column]
    }

    /// Adds a move with its number; numbers rise.
    pub(super) fn add(&mut self, number: u32, swept: &Swept) {
        let length = match swept.spine {
            Spine::Point(_) => 0.0,
            Spine::Line { length, .. } => length,
            Spine::Arc { radius, sweep, .. } => radius * sweep,
        };
        let (low, high) = swept.range();
        // A line across many cells is entered piece by piece: its bounds would hold far more.
        let pieces = (length / self.cell).ceil().max(1.0) as usize;
        for piece in 0..pieces {
            let share = |k: usize| k as f64 / pieces as f64;
            let spine = swept.part(share(piece), share(piece + 1));
            let [from, to] = spine.bounds();
            // A cell counts if any point of it is in reach.
            let far = self.reach + self.cell * std::f64::consts::FRAC_1_SQRT_2;
            let middle = |column: usize, row: usize| {
                self.corner + Vector2::new(column as f64 + 0.5, row as f64 + 0.5) * self.cell
            };
            let reach = Vector2::repeat(self.reach);
            let ((left, lower), (right, upper)) = (self.place(&(from - reach)), self.place(&(to + reach)));
            for row in lower..=upper {
                for column in left..=right {
                    if spine.distance(&middle(column, row)) > far {
                        continue;
                    }
                    let cell = &mut self.cells[row * self.columns + column];
                    let list = if high - low < SAME_HEIGHT || matches!(swept.spine, Spine::Point(_)) {
                        cell.level(low)
                    } else {
                        &mut cell.ramps
                    };
                    if list.last() != Some(&number) {
                        list.push(number);
                    }
                }
            }
        }
    }
}

impl GridCell {
    /// The list of moves at a height.
    fn level(&mut self, height: f64) -> &mut Vec<u32> {
        let at = self.levels.partition_point(|level| level.height < height - SAME_HEIGHT);
        if self.levels.get(at).is_none_or(|level| level.height > height + SAME_HEIGHT) {
            self.levels.insert(at, ClearedLevel { height, moves: Vec::new() });
        }
        &mut self.levels[at].moves
    }
}
