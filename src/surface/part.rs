//! The part as it is cut: maps of heights, and a mesh of one of them.

use crate::deviation::{Deviation, Sources};
use crate::math::Pose;
use crate::path::MovePace;
use crate::plan::Plan;
use crate::stock::{Blank, HeightMap, Stamp};
use crate::surface::cutter;
use crate::units::MM;
use nalgebra::{Vector2, Vector3};
use stl_io::{Normal, Triangle, Vertex};

/// Most cells of a map that is given no cell: its mesh has about 26 MB.
const MOST_CELLS: f64 = 130e3;
/// Most cells of any map.
const LIMIT: f64 = 4e6;
/// A tip that moved by less than this across its axis, as a part of the radius, and less than this along it
/// [m], clears nothing new.
const STILL: (f64, f64) = (0.02, 2e-7);
/// Farthest apart that two stamps are, as a part of the radius.
const STEP: f64 = 0.05;
/// Material thinner than this over the bottom is none [m].
const THIN: f64 = 1e-6;

/// The tool cuts where its tip goes: where the path puts it, or where it really is.
#[derive(Debug, Clone, Copy)]
pub enum PartCut<'a> {
    /// Nowhere: what the program starts from.
    None,
    /// The path itself.
    Nominal,
    /// The actual tips of a run; the tilt of the tool by deflection is left out.
    Actual(&'a Deviation),
}

/// Heights of a part over the plane across the tool axis, in the workpiece frame.
#[derive(Debug, Clone, PartialEq)]
pub struct PartMap {
    /// Place of the first height [m]; z is the bottom of the part.
    pub origin: Vector3<f64>,
    /// Upper corner of the blank [m]: the last column and row lie there, or up to a cell beyond.
    pub end: Vector2<f64>,
    /// Distance of two heights [m].
    pub cell: f64,
    /// Number of heights along x.
    pub columns: usize,
    /// Heights [m], row by row; that of the bottom where there is no material.
    pub heights: Vec<f32>,
}

/// Distance of heights in a map of a blank [m]: `cell`, but for the largest maps, or what its size suggests.
pub fn cell(blank: &Blank, cell: Option<f64>) -> f64 {
    let [from, to] = blank.solid.outline.bounds();
    let size = to - from;
    let least = |most: f64| (size.x * size.y / most).sqrt();
    cell.unwrap_or_else(|| least(MOST_CELLS)).max(least(LIMIT))
}

impl PartMap {
    /// The part of a plan whose engagement follows a stock, with heights `cell` [m] apart.
    pub fn of(plan: &Plan, blank: &Blank, cut: PartCut, cell: f64) -> Self {
        let mut map = HeightMap::with_border(&blank.solid, cell);
        blank.earlier.iter().for_each(|earlier| map.cut(&earlier.path, &earlier.cutter));
        let to_workpiece = plan.setup.workpiece.inverse();
        match cut {
            PartCut::None => {}
            PartCut::Nominal => map.cut(&plan.path.placed(&to_workpiece), &cutter(plan)),
            PartCut::Actual(run) => cut_along(&mut map, plan, &to_workpiece, run),
        }
        let [from, end] = blank.solid.outline.bounds();
        let bottom = blank.solid.bottom;
        let heights = map.heights.iter().map(|height| height.max(bottom as f32)).collect();
        Self { origin: Vector3::new(from.x, from.y, bottom), end, cell, columns: map.columns, heights }
    }

    /// Number of heights along y.
    pub fn rows(&self) -> usize {
        self.heights.len() / self.columns
    }

    /// The part as a binary STL file in millimetres: a closed surface of top, sides and bottom. Between two
    /// heights the top is straight, so that walls lean by a cell.
    pub fn stl(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        // Writing to memory does not fail.
        let _ = stl_io::write_stl(&mut bytes, self.triangles().iter());
        bytes
    }

    /// Whether there is material at all four corners of a cell; none beyond the map.
    fn is_full(&self, column: isize, row: isize) -> bool {
        let thick = |column: usize, row: usize| {
            f64::from(self.heights[row * self.columns + column]) > self.origin.z + THIN
        };
        let inside = |k: isize, count: usize| usize::try_from(k).ok().filter(|k| k + 1 < count);
        match (inside(column, self.columns), inside(row, self.rows())) {
            (Some(column), Some(row)) => {
                thick(column, row)
                    && thick(column + 1, row)
                    && thick(column, row + 1)
                    && thick(column + 1, row + 1)
            }
            _ => false,
        }
    }

    /// The surface, each triangle counter-clockwise from outside.
    fn triangles(&self) -> Vec<Triangle> {
        let across = |column: isize, row: isize| {
            let at = self.origin.xy() + Vector2::new(column as f64, row as f64) * self.cell;
            at.inf(&self.end)
        };
        let vertex = |at: Vector2<f64>, z: f64| Vertex::new([at.x, at.y, z].map(|x| (x / MM) as f32));
        let top = |(column, row): (isize, isize)| {
            let height = self.heights[row as usize * self.columns + column as usize];
            vertex(across(column, row), f64::from(height))
        };
        let low = |(column, row): (isize, isize)| vertex(across(column, row), self.origin.z);
        let mut triangles = Vec::new();
        let mut quad =
            |[a, b, c, d]: [Vertex; 4]| triangles.extend([triangle([a, b, c]), triangle([a, c, d])]);
        for row in 0..self.rows() as isize - 1 {
            for column in 0..self.columns as isize - 1 {
                if !self.is_full(column, row) {
                    continue;
                }
                let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(x, y)| (column + x, row + y));
                let [a, b, c, d] = corners;
                quad([a, b, c, d].map(top));
                // The same diagonal as the top's.
                quad([a, d, c, b].map(low));
                let beside = [(0, -1), (1, 0), (0, 1), (-1, 0)];
                for (k, (x, y)) in beside.into_iter().enumerate() {
                    if !self.is_full(column + x, row + y) {
                        let (from, to) = (corners[k], corners[(k + 1) % 4]);
                        quad([low(from), low(to), top(to), top(from)]);
                    }
                }
            }
        }
        triangles
    }
}

/// A triangle with its normal.
fn triangle(vertices: [Vertex; 3]) -> Triangle {
    let [a, b, c] = vertices.map(|v| Vector3::new(v[0], v[1], v[2]));
    let normal = (b - a).cross(&(c - a)).try_normalize(0.0).unwrap_or_default();
    Triangle { normal: Normal::new(normal.into()), vertices }
}

/// Clears what the tool reaches with the actual tips of a run, straight from each to the next, on moves that
/// cut.
fn cut_along(map: &mut HeightMap, plan: &Plan, to_workpiece: &Pose, run: &Deviation) {
    let cutter = cutter(plan);
    let stamp = Stamp::new(&cutter);
    let timing = plan.timing(Sources::ALL);
    let mut last: Option<Vector3<f64>> = None;
    for (k, tip) in run.actual.iter().enumerate() {
        if plan.path.moves()[timing.index[k] as usize].pace == MovePace::Rapid {
            last = None;
            continue;
        }
        let tip = to_workpiece.point(tip);
        let from = last.unwrap_or(tip);
        let moved = tip - from;
        let still = moved.xy().norm() < STILL.0 * cutter.radius && moved.z.abs() < STILL.1;
        if still && last.is_some() && k + 1 < run.actual.len() {
            continue;
        }
        let count = (moved.norm() / (STEP * cutter.radius)).ceil().max(1.0);
        for part in 1..=count as usize {
            map.stamp(&stamp, &(from + moved * (part as f64 / count)));
        }
        last = Some(tip);
    }
}
