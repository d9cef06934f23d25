//! A part and its deviation as a mesh to draw: places that can be moved, and triangles between them.

use crate::surface::deviation_map::{DeviationMap, Shift};
use nalgebra::{Vector2, Vector3};

/// A mesh of the nominal part without its bottom, in the workpiece frame.
#[derive(Debug, Clone, PartialEq)]
pub struct PartMesh {
    /// Places of the surface [m].
    pub places: Vec<[f32; 3]>,
    /// The deviation of each place with the desired path commanded [m].
    pub before: Vec<Shift>,
    /// The same with the compensated path commanded.
    pub after: Vec<Shift>,
    /// Three places each, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// Material thinner than this over the bottom is none [m].
const THIN: f32 = 1e-6;

impl PartMesh {
    /// The mesh of a map. Around the map stands a rim of places at the height of the bottom, so that sides are a
    /// surface as walls are.
    pub fn of(map: &DeviationMap) -> Self {
        let part = &map.nominal;
        let (columns, rows) = (part.columns, part.rows());
        let bottom = part.origin.z as f32;
        let wide = columns + 2;
        // Column and row in the map of a place of the mesh, and whether it is of the rim.
        let within = |k: usize| {
            let (column, row) = ((k % wide).clamp(1, columns) - 1, (k / wide).clamp(1, rows) - 1);
            let rim = (k % wide, k / wide) != (column + 1, row + 1);
            (column, row, rim)
        };
        let count = wide * (rows + 2);
        let height = |k: usize| match within(k) {
            (.., true) => bottom,
            (column, row, _) => part.heights[row * columns + column],
        };
        let place = |k: usize| {
            let (column, row, _) = within(k);
            let at = part.origin.xy() + Vector2::new(column as f64, row as f64) * part.cell;
            let at = at.inf(&part.end);
            let [x, y] = match within(k) {
                (.., true) => [0.0; 2],
                (column, row, _) => map.to_wall[row * columns + column],
            };
            Vector3::new(at.x as f32 + x, at.y as f32 + y, height(k)).into()
        };
        let shift = |shifts: &[Shift], k: usize| match within(k) {
            (.., true) => [0.0; 4],
            (column, row, _) => shifts[row * columns + column],
        };
        let mut triangles = Vec::new();
        for k in (0..count - wide).filter(|k| k % wide + 1 < wide) {
            let corners = [k, k + 1, k + 1 + wide, k + wide];
            if corners.iter().all(|k| height(*k) <= bottom + THIN) {
                continue;
            }
            let [a, b, c, d] = corners.map(|k| k as u32);
            triangles.extend([[a, b, c], [a, c, d]]);
        }
        Self {
            places: (0..count).map(place).collect(),
            before: (0..count).map(|k| shift(&map.before, k)).collect(),
            after: (0..count).map(|k| shift(&map.after, k)).collect(),
            triangles,
        }
    }
}
