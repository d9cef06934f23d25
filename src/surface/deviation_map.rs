//! The deviation of the part all over its surface, for a picture that magnifies it.
//!
//! On a map of heights a wall that stands elsewhere changes heights by all of its own, so walls are not compared
//! by height: they take the excess of the facets left on them, as exact as in the list of the worst places.
//! Floors and slopes take the difference of heights. Between walls the sideways part is spread evenly
//! (harmonically), so that a magnified part bends instead of tearing.

use crate::deviation::Deviation;
use crate::motion::TimingLaw;
use crate::plan::Plan;
use crate::stock::Blank;
use crate::surface::Excesses;
use crate::surface::facet::members;
use crate::surface::part::{PartCut, PartMap};
use nalgebra::{Vector2, Vector3};

/// Deviation of the surface at a height of the map [m]: how far it is moved along x, y and z of the workpiece,
/// and the excess of the wall there, or of the nearest one.
pub type Shift = [f32; 4];

/// The nominal part, and how far the actual one is from it.
#[derive(Debug, Clone)]
pub struct DeviationMap {
    /// The part with the tool where it should be.
    pub nominal: PartMap,
    /// The deviation at each of its heights with the desired path commanded.
    pub before: Vec<Shift>,
    /// The same with the compensated path commanded.
    pub after: Vec<Shift>,
    /// How far each height is from the wall that it stands at the head or foot of, along x and y [m]: moved by that,
    /// walls are as smooth as they are.
    pub to_wall: Vec<[f32; 2]>,
    /// Largest excess of the surface left, before or after [m].
    pub largest: f64,
    /// Heights before the program begins [m].
    pub(super) blank: Vec<f32>,
}

/// A normal that leans by more than this does not belong to a wall: its part across the tool axis.
const UPRIGHT: f64 = 0.7;
/// How far from a piece of wall heights are that take its excess, in cells.
const REACH: f64 = 1.5;
/// Differences of height up to this many times the largest excess are the floor's own.
const OWN: f64 = 1.5;
/// A step that is this part of a difference of heights, or more, explains it.
const EXPLAINS: f64 = 0.5;
/// Farthest that such a step is looked for, in cells.
const FARTHEST: usize = 8;
/// Neighbours that differ by more than this in height are head and foot of a wall, in cells.
const STEEP: f64 = 1.0;
/// Sweeps over the map that spread a deviation, and by how much each goes too far.
const SWEEPS: (usize, f32) = (100, 1.9);
/// Differences of height that are rounding [m].
const ROUNDING: f64 = 1e-6;

impl DeviationMap {
    /// Of a plan whose engagement follows a stock, with heights `cell` [m] apart.
    pub(crate) fn of(
        plan: &Plan,
        blank: &Blank,
        (excesses, timing): (&Excesses, &TimingLaw),
        runs: [&Deviation; 2],
        cell: f64,
    ) -> Self {
        let nominal = PartMap::of(plan, blank, PartCut::Nominal, cell);
        let (walls, largest) = walls(plan, (excesses, timing), runs, &nominal);
        let [before, after] = [0, 1].map(|side| {
            let actual = PartMap::of(plan, blank, PartCut::Actual(runs[side]), cell);
            shifts(&nominal, &actual, largest, walls.iter().map(|wall| wall.side(side)))
        });
        let beside = |k: &usize| is_beside_step(&nominal, *k, 1, STEEP * cell);
        let to_wall = (0..walls.len()).map(|k| walls[k].way().filter(|_| beside(&k)).unwrap_or_default());
        let to_wall = to_wall.collect();
        let blank = PartMap::of(plan, blank, PartCut::None, cell).heights;
        Self { nominal, before, after, to_wall, largest, blank }
    }

    /// The deviation at a point of the map's plane [m], between its heights.
    pub(super) fn at(&self, shifts: &[Shift], point: &Vector2<f64>) -> Vector3<f64> {
        let [columns, rows] = [self.nominal.columns, self.nominal.rows()];
        let place = (point - self.nominal.origin.xy()) / self.nominal.cell;
        let split = |x: f64, count: usize| {
            let x = x.clamp(0.0, (count - 1) as f64);
            let whole = (x as usize).min(count.saturating_sub(2));
            (whole, x - whole as f64)
        };
        let ((column, right), (row, up)) = (split(place.x, columns), split(place.y, rows));
        let shift = |column: usize, row: usize| {
            let [x, y, z, _] = shifts[row.min(rows - 1) * columns + column.min(columns - 1)];
            Vector3::new(x, y, z).cast::<f64>()
        };
        let along = |row: usize| shift(column, row).lerp(&shift(column + 1, row), right);
        along(row).lerp(&along(row + 1), up)
    }

    /// Height of what the program starts from at a point of the map's plane [m]; that of the bottom beside it.
    pub(super) fn blank_at(&self, point: &Vector2<f64>) -> f64 {
        let PartMap { origin, end, cell, columns, .. } = self.nominal;
        if point.x < origin.x || point.y < origin.y || point.x > end.x || point.y > end.y {
            return origin.z;
        }
        let place = ((point - origin.xy()) / cell).map(|x| x.round() as usize);
        self.blank.get(place.y * columns + place.x).map_or(origin.z, |height| f64::from(*height))
    }
}

/// What the pieces of wall near a height add up to: weight, the way to the wall, and for each run x, y and excess,
/// each times the weight.
#[derive(Debug, Clone, Copy, Default)]
struct NearWalls {
    weight: f64,
    way: [f64; 2],
    sums: [[f64; 3]; 2],
}

impl NearWalls {
    /// Mean way to the wall; `None` if there is none.
    fn way(&self) -> Option<[f32; 2]> {
        (self.weight > 0.0).then(|| self.way.map(|sum| (sum / self.weight) as f32))
    }

    /// Mean x, y and excess of a run; `None` if there is no wall.
    fn side(&self, side: usize) -> Option<[f32; 3]> {
        (self.weight > 0.0).then(|| self.sums[side].map(|sum| (sum / self.weight) as f32))
    }
}

/// The walls near each height of a map, and the largest excess of any surface [m].
fn walls(
    plan: &Plan,
    (excesses, timing): (&Excesses, &TimingLaw),
    runs: [&Deviation; 2],
    map: &PartMap,
) -> (Vec<NearWalls>, f64) {
    let mut walls = vec![NearWalls::default(); map.heights.len()];
    let mut largest = 0.0_f64;
    let to_workpiece = plan.setup.workpiece.inverse();
    let mut last = f64::NEG_INFINITY;
    for k in 0..timing.arc_length.len() {
        let set = excesses.set(timing, k);
        if set == 0 {
            continue;
        }
        let displaced = runs.map(|run| excesses.at(timing, k, run));
        let new = (timing.arc_length[k] - last).abs() > map.cell / 3.0;
        if new {
            last = timing.arc_length[k];
        }
        for facet in members(set) {
            let excess = [0, 1].map(|side: usize| displaced[side].of(facet));
            largest = largest.max(excess[0].abs()).max(excess[1].abs());
            let normal = to_workpiece.direction(&excesses.normal(timing, k, facet));
            if !new || normal.xy().norm() < UPRIGHT {
                continue;
            }
            let Some(place) = excesses.place(timing, k, facet) else { continue };
            let place = to_workpiece.point(&place);
            let parts = excess.map(|excess| [-normal.x * excess, -normal.y * excess, excess]);
            around(map, &place, |height, to_place, weight| {
                let near = &mut walls[height];
                let way = normal.xy() * to_place.dot(&normal.xy());
                near.weight += weight;
                near.way[0] += weight * way.x;
                near.way[1] += weight * way.y;
                for (sums, parts) in near.sums.iter_mut().zip(parts) {
                    sums.iter_mut().zip(parts).for_each(|(sum, part)| *sum += weight * part);
                }
            });
        }
    }
    (walls, largest)
}

/// Calls with the heights near a point [m], the way from each there in the plane, and their weights, larger the
/// nearer they are in space: a wall's head and foot may move differently.
fn around(map: &PartMap, point: &Vector3<f64>, mut call: impl FnMut(usize, Vector2<f64>, f64)) {
    let place = (point.xy() - map.origin.xy()) / map.cell;
    let ends = |x: f64, count: usize| {
        let (from, to) = ((x - REACH).ceil().max(0.0), (x + REACH).floor().min(count as f64 - 1.0));
        if to < from { 0..0 } else { from as usize..to as usize + 1 }
    };
    for row in ends(place.y, map.rows()) {
        for column in ends(place.x, map.columns) {
            let k = row * map.columns + column;
            let across = place - Vector2::new(column as f64, row as f64);
            let up = (f64::from(map.heights[k]) - point.z) / map.cell;
            call(k, across * map.cell, 1.0 / (0.25 + across.norm_squared() + up * up));
        }
    }
}

/// The deviation at each height: what walls say sideways, the difference of heights upwards.
fn shifts(
    nominal: &PartMap,
    actual: &PartMap,
    largest: f64,
    walls: impl Iterator<Item = Option<[f32; 3]>>,
) -> Vec<Shift> {
    let columns = nominal.columns;
    let mut shifts = vec![[0.0; 4]; nominal.heights.len()];
    let mut free = Vec::new();
    for (k, wall) in walls.enumerate() {
        let (column, row) = (k % columns, k / columns);
        let border = column == 0 || row == 0 || column + 1 == columns || row + 1 == nominal.rows();
        match wall {
            Some([x, y, excess]) => shifts[k] = [x, y, 0.0, excess],
            None if !border => free.push(k),
            None => {}
        }
    }
    for part in [0, 1, 3] {
        spread(&mut shifts, part, &free, columns);
    }
    let limit = OWN * largest + ROUNDING;
    let reach = (1 + (limit / nominal.cell).ceil() as usize).min(FARTHEST);
    let mut flipped = Vec::new();
    for (k, (actual, due)) in actual.heights.iter().zip(&nominal.heights).enumerate() {
        let difference = f64::from(actual - due);
        if difference.abs() > limit && is_beside_step(nominal, k, reach, EXPLAINS * difference.abs()) {
            flipped.push(k);
        } else {
            shifts[k][2] = difference as f32;
        }
    }
    spread(&mut shifts, 2, &flipped, columns);
    shifts
}

/// Whether a height `reach` cells from the height `k` or nearer differs from it by more than `step` [m].
fn is_beside_step(map: &PartMap, k: usize, reach: usize, step: f64) -> bool {
    let (column, row) = (k % map.columns, k / map.columns);
    let ends = |x: usize, count: usize| x.saturating_sub(reach)..(x + reach + 1).min(count);
    let own = f64::from(map.heights[k]);
    ends(row, map.rows()).any(|row| {
        ends(column, map.columns).any(|column| {
            let other = f64::from(map.heights[row * map.columns + column]);
            (other - own).abs() > step
        })
    })
}

/// Spreads a part of the deviation to the `free` heights: each becomes about the mean of its neighbours
/// (successive over-relaxation of Laplace's equation).
fn spread(shifts: &mut [Shift], part: usize, free: &[usize], columns: usize) {
    let (sweeps, over) = SWEEPS;
    for _ in 0..sweeps {
        for &k in free {
            let column = k % columns;
            let beside = [
                if column > 0 { k - 1 } else { k },
                if column + 1 < columns { k + 1 } else { k },
                if k >= columns { k - columns } else { k },
                if k + columns < shifts.len() { k + columns } else { k },
            ];
            let mean = beside.iter().map(|&k| shifts[k][part]).sum::<f32>() / 4.0;
            let own = &mut shifts[k][part];
            *own += over * (mean - *own);
        }
    }
}
