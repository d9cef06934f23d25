//! The stock as a map of heights: one height for each cell of a grid, lowered by every move.
//!
//! For programs that climb and dive all along, as over a dome. A cell takes the lowest place of the
//! tool's profile over its centre, at stamps close enough that no ridge between two of them is higher
//! than the profile's fall across a step.

use crate::stock::circle::Region;
use crate::stock::place::Cutter;
use crate::stock::solid::Solid;
use nalgebra::{Vector2, Vector3};

/// Most cells of a map.
const MOST_CELLS: f64 = 4e6;
/// Cells along the tool's radius, where there are not too many.
const ALONG_RADIUS: f64 = 32.0;
/// Steps of the profile's table.
const PROFILE: usize = 1024;

/// Heights over the plane across the tool axis.
#[derive(Debug, Clone)]
pub(super) struct HeightMap {
    corner: Vector2<f64>,
    /// Width of a cell [m].
    pub(super) cell: f64,
    columns: usize,
    /// Height of the material in each cell [m]; minus infinity where there is none.
    heights: Vec<f32>,
    /// Radius of the tool [m].
    radius: f64,
    /// Height of the tool's profile above its tip [m], by the square of the distance from the axis.
    profile: Vec<f32>,
}

impl HeightMap {
    /// The map of a solid, to be cut by a cutter.
    pub(super) fn new(solid: &Solid, cutter: &Cutter) -> Self {
        let [from, to] = solid.outline.bounds();
        let size = to - from;
        let cell = (cutter.radius / ALONG_RADIUS).max((size.x * size.y / MOST_CELLS).sqrt());
        let count = |length: f64| (length / cell).ceil().max(1.0) as usize;
        let (columns, rows) = (count(size.x), count(size.y));
        let middle =
            |k: usize| from + Vector2::new((k % columns) as f64 + 0.5, (k / columns) as f64 + 0.5) * cell;
        let height =
            |k: usize| if solid.outline.holds(&middle(k)) { solid.top as f32 } else { f32::NEG_INFINITY };
        let fall = |k: usize| cutter.profile(cutter.radius * (k as f64 / PROFILE as f64).sqrt()) as f32;
        Self {
            corner: from,
            cell,
            columns,
            heights: (0..columns * rows).map(height).collect(),
            radius: cutter.radius,
            profile: (0..=PROFILE).map(fall).collect(),
        }
    }

    /// The cell at a point: its middle, and the height of its material [m]; minus infinity where there
    /// is none.
    pub(super) fn cell_at(&self, point: &Vector2<f64>) -> (Vector2<f64>, f64) {
        let place = ((point - self.corner) / self.cell).map(f64::floor);
        let middle = self.corner + (place + Vector2::repeat(0.5)) * self.cell;
        if place.x < 0.0 || place.y < 0.0 || place.x >= self.columns as f64 {
            return (middle, f64::NEG_INFINITY);
        }
        let cell = place.y as usize * self.columns + place.x as usize;
        (middle, self.heights.get(cell).map_or(f64::NEG_INFINITY, |height| f64::from(*height)))
    }

    /// Clears what the tool reaches with its tip at a point [m].
    pub(super) fn stamp(&mut self, tip: &Vector3<f64>) {
        // In cells, with their centres at whole numbers.
        let place = (tip.xy() - self.corner) / self.cell - Vector2::repeat(0.5);
        let reach = self.radius / self.cell;
        let rows = self.heights.len() / self.columns;
        let scale = PROFILE as f64 / (reach * reach);
        let (lower, upper) = ((place.y - reach).ceil().max(0.0), (place.y + reach).floor());
        let mut row = lower;
        while row <= upper && row < rows as f64 {
            let beside = (row - place.y) * (row - place.y);
            let half = (reach * reach - beside).max(0.0).sqrt();
            let left = (place.x - half).ceil().max(0.0);
            let right = (place.x + half).floor().min(self.columns as f64 - 1.0);
            if right >= left {
                let first = row as usize * self.columns;
                let cells = &mut self.heights[first + left as usize..=first + right as usize];
                for (k, height) in cells.iter_mut().enumerate() {
                    let along = left + k as f64 - place.x;
                    let fall = self.profile[(((along * along + beside) * scale) as usize).min(PROFILE)];
                    *height = height.min(tip.z as f32 + fall);
                }
            }
            row += 1.0;
        }
    }
}
