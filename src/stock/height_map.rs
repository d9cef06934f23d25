//! The stock as a map of heights: one height for each cell of a grid, lowered by every move.
//!
//! For programs that climb and dive all along, as over a dome. A cell takes the lowest place of the
//! tool's profile over its centre, at stamps close enough that no ridge between two of them is higher
//! than the profile's fall across a step.

use crate::path::{MovePace, Path};
use crate::stock::circle::Region;
use crate::stock::place::Cutter;
use crate::stock::solid::Solid;
use nalgebra::{Vector2, Vector3};

/// Most cells of a map.
const MOST_CELLS: f64 = 4e6;
/// Cells along the tool's radius, where there are not too many.
const ALONG_RADIUS: f64 = 32.0;
/// Distance of stations along a path, as a part of the radius.
pub(super) const STEP: f64 = 0.1;
/// Stamps from one station to the next.
pub(super) const STAMPS: usize = 2;
/// Steps of the profile's table.
const PROFILE: usize = 1024;

/// Heights over the plane across the tool axis.
#[derive(Debug, Clone)]
pub struct HeightMap {
    corner: Vector2<f64>,
    /// Width of a cell [m].
    pub cell: f64,
    /// Number of cells along x.
    pub columns: usize,
    /// Height of the material in each cell [m], row by row; minus infinity where there is none.
    pub heights: Vec<f32>,
}

/// A tool to stamp the map with.
#[derive(Debug, Clone)]
pub struct Stamp {
    /// Radius [m].
    radius: f64,
    /// Height of the profile above the tip [m], by the square of the distance from the axis.
    profile: Vec<f32>,
}

impl Stamp {
    /// The stamp of a tool.
    pub fn new(cutter: &Cutter) -> Self {
        let fall = |k: usize| cutter.profile(cutter.radius * (k as f64 / PROFILE as f64).sqrt()) as f32;
        Self { radius: cutter.radius, profile: (0..=PROFILE).map(fall).collect() }
    }
}

impl HeightMap {
    /// The map of a solid, to be cut by a cutter.
    pub(super) fn new(solid: &Solid, cutter: &Cutter) -> Self {
        let [from, to] = solid.outline.bounds();
        let size = to - from;
        let cell = (cutter.radius / ALONG_RADIUS).max((size.x * size.y / MOST_CELLS).sqrt());
        let count = |length: f64| (length / cell).ceil().max(1.0) as usize;
        Self::over(solid, (from, cell), (count(size.x), count(size.y)), |middle| middle)
    }

    /// The map of a solid whose cells have their middles on its border and all over it, `cell` [m] apart.
    pub fn with_border(solid: &Solid, cell: f64) -> Self {
        let [from, to] = solid.outline.bounds();
        let count = |length: f64| (length / cell - 1e-9).ceil().max(1.0) as usize + 1;
        let counts = (count(to.x - from.x), count(to.y - from.y));
        // A middle on the border, or beyond it by less than a cell, counts as just inside.
        let inside = |at: Vector2<f64>| at.sup(&from).inf(&to).lerp(&((from + to) / 2.0), 1e-9);
        Self::over(solid, (from - Vector2::repeat(cell / 2.0), cell), counts, inside)
    }

    /// The map of a solid with cells from a corner; there is material in a cell if there is at the place that
    /// `at` gives for its middle.
    fn over(
        solid: &Solid,
        (from, cell): (Vector2<f64>, f64),
        (columns, rows): (usize, usize),
        at: impl Fn(Vector2<f64>) -> Vector2<f64>,
    ) -> Self {
        let middle =
            |k: usize| from + Vector2::new((k % columns) as f64 + 0.5, (k / columns) as f64 + 0.5) * cell;
        let height = |k: usize| {
            if solid.outline.holds(&at(middle(k))) { solid.top as f32 } else { f32::NEG_INFINITY }
        };
        let heights = (0..columns * rows).map(height).collect();
        let mut map = Self { corner: from, cell, columns, heights };
        if !solid.relief.is_empty() {
            map.heights.fill(f32::NEG_INFINITY);
            solid.relief.iter().for_each(|triangle| map.raise(triangle));
        }
        map
    }

    /// Clears what a cutter reaches along a path; rapid moves clear nothing.
    pub fn cut(&mut self, path: &Path, cutter: &Cutter) {
        let stamp = Stamp::new(cutter);
        for step in path.moves().iter().filter(|step| step.pace != MovePace::Rapid) {
            let length = step.segment.length();
            let count = (length * STAMPS as f64 / (STEP * cutter.radius)).ceil().max(1.0);
            for k in 0..=count as usize {
                self.stamp(&stamp, &step.segment.point(length * (k as f64 / count)));
            }
        }
    }

    /// Raises the cells whose middles a triangle covers to it.
    fn raise(&mut self, [a, b, c]: &[Vector3<f64>; 3]) {
        let [ab, ac] = [(b - a).xy(), (c - a).xy()];
        let double = ab.perp(&ac);
        if double == 0.0 {
            return;
        }
        let rows = self.heights.len() / self.columns;
        let number = |part: f64, most: usize| (part.max(0.0) as usize).min(most - 1);
        let low = (a.inf(b).inf(c).xy() - self.corner) / self.cell;
        let high = (a.sup(b).sup(c).xy() - self.corner) / self.cell;
        for row in number(low.y, rows)..=number(high.y, rows) {
            for column in number(low.x, self.columns)..=number(high.x, self.columns) {
                let at = self.corner + Vector2::new(column as f64 + 0.5, row as f64 + 0.5) * self.cell;
                let offset = at - a.xy();
                let (to_b, to_c) = (offset.perp(&ac) / double, ab.perp(&offset) / double);
                if to_b >= 0.0 && to_c >= 0.0 && to_b + to_c <= 1.0 {
                    let height = a.z + (b.z - a.z) * to_b + (c.z - a.z) * to_c;
                    let cell = &mut self.heights[row * self.columns + column];
                    *cell = cell.max(height as f32);
                }
            }
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

    /// Clears what a tool reaches with its tip at a point [m].
    pub fn stamp(&mut self, stamp: &Stamp, tip: &Vector3<f64>) {
        // In cells, with their centres at whole numbers.
        let place = (tip.xy() - self.corner) / self.cell - Vector2::repeat(0.5);
        let reach = stamp.radius / self.cell;
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
                    let fall = stamp.profile[(((along * along + beside) * scale) as usize).min(PROFILE)];
                    *height = height.min(tip.z as f32 + fall);
                }
            }
            row += 1.0;
        }
    }
}
