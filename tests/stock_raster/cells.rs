//! A height field in cells, and what it says of the tool's rim and bottom.

use armill::stock::{Contact, Outline, SideArc, Solid};
use nalgebra::{Vector2, Vector3};
use std::f64::consts::{PI, TAU};

/// Radius of the tool [mm].
pub(crate) const R: f64 = 2.0;
/// Size of a cell [mm].
pub(crate) const CELL: f64 = 0.01;
/// Step of the tool [mm]: a scallop between two places is 0.1 micrometres high.
pub(crate) const STEP: f64 = 0.04;
/// How far before a station the cells are asked [mm].
pub(crate) const BEFORE: f64 = 10.0 * CELL;

/// Height of the material in each cell [mm].
pub(crate) struct Raster {
    heights: Vec<f32>,
    size: [usize; 2],
    /// Corner of the first cell [mm].
    origin: Vector2<f64>,
    bottom: f32,
}

/// Where a row at the height `y` is inside an outline [mm].
pub(crate) fn spans(outline: &Outline, y: f64) -> Vec<f64> {
    match outline {
        Outline::Circle { center, radius } => {
            let half = ((radius * 1e3).powi(2) - (y - center.y * 1e3).powi(2)).max(0.0).sqrt();
            vec![center.x * 1e3 - half, center.x * 1e3 + half]
        }
        Outline::Polygon(points) => {
            let mut crossings = Vec::new();
            for (k, a) in points.iter().enumerate() {
                let (a, b) = (a * 1e3, points[(k + 1) % points.len()] * 1e3);
                if (a.y > y) != (b.y > y) {
                    crossings.push(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
                }
            }
            crossings.sort_by(f64::total_cmp);
            crossings
        }
    }
}

/// Cells with their centre between two places [cells], within 0 to `size`.
pub(crate) fn cells(from: f64, to: f64, size: usize) -> std::ops::Range<usize> {
    let at = |place: f64| ((place / CELL - 0.5).ceil().max(0.0) as usize).min(size);
    at(from)..at(to).max(at(from))
}

impl Raster {
    pub(crate) fn new(solid: &Solid, origin: Vector2<f64>) -> Self {
        let size = [1500, 1500];
        let mut heights = vec![(solid.bottom * 1e3) as f32; size[0] * size[1]];
        for (j, row) in heights.chunks_mut(size[0]).enumerate() {
            for span in spans(&solid.outline, origin.y + (j as f64 + 0.5) * CELL).chunks(2) {
                row[cells(span[0] - origin.x, span[1] - origin.x, size[0])].fill((solid.top * 1e3) as f32);
            }
        }
        Self { heights, size, origin, bottom: (solid.bottom * 1e3) as f32 }
    }

    pub(crate) fn height(&self, p: Vector2<f64>) -> f32 {
        let at = (p - self.origin) / CELL;
        let inside = at.x >= 0.0 && at.y >= 0.0 && at.x < self.size[0] as f64 && at.y < self.size[1] as f64;
        if inside { self.heights[at.y as usize * self.size[0] + at.x as usize] } else { self.bottom }
    }

    /// Clears what the tool covers at `to` and did not cover at `from`. Volume [mm^3].
    pub(crate) fn step(&mut self, from: Option<Vector3<f64>>, to: Vector3<f64>) -> f64 {
        let tip = (to.z as f32).max(self.bottom);
        let (mut removed, width) = (0.0, self.size[0]);
        for j in cells(to.y - R - self.origin.y, to.y + R - self.origin.y, self.size[1]) {
            let y = self.origin.y + (j as f64 + 0.5) * CELL;
            let covered = |at: Vector3<f64>| {
                let half = (R * R - (y - at.y).powi(2)).max(0.0).sqrt();
                cells(at.x - half - self.origin.x, at.x + half - self.origin.x, width)
            };
            let new = covered(to);
            // A tool that dives meets all that is under it.
            let old = from.filter(|old| old.z <= to.z + 1e-9).map_or(new.start..new.start, covered);
            let row = &mut self.heights[j * width..][..width];
            for part in [new.start..new.end.min(old.start), new.start.max(old.end)..new.end] {
                for height in row.get_mut(part).into_iter().flatten() {
                    removed += f64::from((*height - tip).max(0.0));
                    *height = height.min(tip);
                }
            }
        }
        removed * CELL * CELL
    }
}

/// What the cells and a contact do not agree on at one height: across the feed [mm], and as an angle.
#[derive(Clone, Copy, Default)]
pub(crate) struct Difference {
    pub(crate) across: f64,
    pub(crate) angle: f64,
}

/// A station to look at, as the cells see it: the tool short of it, at it, and its feed.
pub(crate) struct Look {
    pub(crate) before: Vector3<f64>,
    pub(crate) tip: Vector3<f64>,
    pub(crate) feed: Vector2<f64>,
}

/// Directions looked at, over half a turn.
const DIRECTIONS: usize = 1440;

/// The worst of the heights. `open` and `engaged` count directions: left open, and in material.
pub(crate) fn difference(
    raster: &Raster,
    look: &Look,
    contact: &Contact<'_>,
    levels: &[f64],
    layer: f64,
    counts: &mut [usize; 2],
) -> Difference {
    let left = Vector2::new(-look.feed.y, look.feed.x);
    let mut worst = Difference::default();
    for pair in levels.windows(2).filter(|pair| pair[1] > look.tip.z + 2.0 * layer + 1e-6) {
        let height = (pair[0].max(look.tip.z) + pair[1]) / 2.0;
        let mut run = Difference::default();
        for k in 0..DIRECTIONS {
            let phi = (k as f64 + 0.5) * PI / DIRECTIONS as f64;
            let direction = left * phi.cos() + look.feed * phi.sin();
            let mut seen = [false; 2];
            for out in [-1.0, 0.0, 1.0] {
                let p = look.tip.xy() + direction * (R + out * CELL);
                if (p - look.before.xy()).norm() < R + 0.75 * CELL {
                    // Cleared already: a border may run there, and what the rim leaves of it is open.
                    seen[0] = true;
                    continue;
                }
                let material = f64::from(raster.height(p));
                seen[usize::from(material > height - layer)] = true;
                seen[usize::from(material > height + layer)] = true;
            }
            let above = (height - look.tip.z) / 1e3;
            let arc =
                |arc: &SideArc| arc.from <= above && above <= arc.to && arc.entry <= phi && phi <= arc.exit;
            let engaged = contact.sides.iter().any(arc);
            counts[0] += usize::from(seen[0] && seen[1]);
            counts[1] += usize::from(engaged);
            if seen[usize::from(engaged)] {
                run = Difference::default();
                continue;
            }
            run.across += R * phi.sin() * PI / DIRECTIONS as f64;
            run.angle += PI / DIRECTIONS as f64;
            if run.across > worst.across {
                worst = run;
            }
        }
    }
    worst
}

/// Part of the bottom on which the cells and a contact do not agree, where the tool dives: of each
/// ring, the directions in which the cells around all are in material right under the tip or all free.
pub(crate) fn difference_below(raster: &Raster, look: &Look, contact: &Contact<'_>) -> f64 {
    let left = Vector2::new(-look.feed.y, look.feed.x);
    let mut sum = 0.0;
    let mut rings: Vec<(f64, f64)> = contact.floors.iter().map(|arc| (arc.radius, arc.width)).collect();
    rings.dedup();
    for (radius, width) in rings {
        for k in 0..DIRECTIONS {
            let phi = (k as f64 + 0.5) * TAU / DIRECTIONS as f64;
            let p = look.tip.xy() + (left * phi.cos() + look.feed * phi.sin()) * radius * 1e3;
            let mut seen = [false; 2];
            for (x, y) in [(0.0, 0.0), (CELL, 0.0), (-CELL, 0.0), (0.0, CELL), (0.0, -CELL)] {
                let material = f64::from(raster.height(p + Vector2::new(x, y)));
                seen[usize::from(material > look.tip.z - 1e-3)] = true;
                seen[usize::from(material > look.tip.z + 1e-3)] = true;
            }
            let arcs = contact.floors.iter().filter(|arc| arc.radius == radius);
            let engaged = arcs.into_iter().any(|arc| arc.entry <= phi && phi <= arc.exit);
            if !seen[usize::from(engaged)] {
                sum += radius * width * TAU / DIRECTIONS as f64;
            }
        }
    }
    sum * 1e6 / (PI * R * R)
}
