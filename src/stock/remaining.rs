//! What remains of the stock when all is cut: whether there is material at a point.

use crate::path::Path;
use crate::stock::along::{Earlier, cleared};
use crate::stock::blank::Blank;
use crate::stock::circle::Region;
use crate::stock::grid::{Grid, GridCell, SAME_HEIGHT};
use crate::stock::height_map::HeightMap;
use crate::stock::place::{Cleared, Cutter};
use crate::stock::swept::{Spine, Swept};
use nalgebra::{Vector2, Vector3};

/// How far behind a surface its material is looked for [m]: programs round to a thousandth of a
/// millimetre.
const BEHIND: f64 = 2e-6;
/// The same on a map of heights, in cells: along the surface's normal as far as it is level, and further
/// as it is steep. A tool's profile is stamped to half a cell of its table, a wall stands where the middles
/// of cells are out of reach.
const BEHIND_LEVEL: f64 = 1.0 / 16.0;
const BEHIND_STEEP: f64 = 1.5;
/// Steps of the search for the lowest place of a round tool over a point.
const STEPS: usize = 40;

/// What remains of a blank when earlier paths and one of this tool have cut it; the tool axis is z.
/// Rapid moves clear nothing.
pub struct Remaining<'a> {
    blank: &'a Blank,
    cleared: ClearedSpace,
}

/// What was cleared.
enum ClearedSpace {
    /// What each move has swept: exact.
    Sweeps { sweeps: Vec<Cleared>, grid: Grid },
    /// By a map of heights.
    Map(HeightMap),
}

impl<'a> Remaining<'a> {
    /// What a cutter leaves along a path in the workpiece frame: by a map of heights if the contact was
    /// found on one.
    pub fn of(path: &Path, blank: &'a Blank, cutter: &Cutter, on_map: bool) -> Self {
        let own = Earlier { path: path.clone(), cutter: *cutter };
        let all = || blank.earlier.iter().chain([&own]);
        if on_map || !blank.solid.relief.is_empty() {
            let mut map = HeightMap::new(&blank.solid, cutter);
            all().for_each(|each| map.cut(&each.path, &each.cutter));
            return Self { blank, cleared: ClearedSpace::Map(map) };
        }
        let sweeps: Vec<Cleared> = all().flat_map(cleared).collect();
        let reach = sweeps.iter().map(|cleared| cleared.cutter.radius).fold(0.0, f64::max);
        let own = || own.path.moves().iter().map(|step| &step.segment);
        let ends = own().flat_map(|segment| segment.extremes().into_iter().map(|s| segment.point(s).xy()));
        // Points of the surface lie within the tool's radius of the path.
        let beyond = Vector2::repeat(reach + cutter.radius);
        let bounds = ends.map(|point| [point - beyond, point + beyond]);
        let bounds = bounds.reduce(|a, b| [a[0].inf(&b[0]), a[1].sup(&b[1])]);
        let mut grid = Grid::new(bounds.unwrap_or_default(), reach);
        for (number, cleared) in sweeps.iter().enumerate() {
            grid.add(number as u32, &cleared.swept);
        }
        Self { blank, cleared: ClearedSpace::Sweeps { sweeps, grid } }
    }

    /// Whether a surface at a point [m] is left: there is material behind it, where its unit normal
    /// points.
    pub fn is_left(&self, point: &Vector3<f64>, into: &Vector3<f64>) -> bool {
        let behind = match &self.cleared {
            ClearedSpace::Sweeps { .. } => BEHIND,
            ClearedSpace::Map(map) => (BEHIND_LEVEL + BEHIND_STEEP * into.xy().norm()) * map.cell,
        };
        self.is_material(&(point + into * behind))
    }

    /// Whether there is material at a point [m].
    pub fn is_material(&self, point: &Vector3<f64>) -> bool {
        let solid = &self.blank.solid;
        if point.z <= solid.bottom || point.z >= solid.top {
            return false;
        }
        match &self.cleared {
            ClearedSpace::Sweeps { sweeps, grid } => {
                let cell = grid.at(&point.xy());
                solid.outline.holds(&point.xy()) && !numbers(cell, point.z).any(|k| sweeps[k].holds(point))
            }
            ClearedSpace::Map(map) => point.z < map.cell_at(&point.xy()).1,
        }
    }
}

/// The moves near a cell whose tip came below a height [m].
fn numbers(cell: &GridCell, height: f64) -> impl Iterator<Item = usize> + '_ {
    let levels = cell.levels.iter().take_while(move |level| level.height < height - SAME_HEIGHT);
    levels.flat_map(|level| &level.moves).chain(&cell.ramps).map(|&number| number as usize)
}

impl Cleared {
    /// Whether a point [m] was cleared: the tool came at or below it within its radius at that height.
    fn holds(&self, point: &Vector3<f64>) -> bool {
        let Self { swept, cutter } = self;
        let (low, high) = swept.range();
        let across = swept.spine.distance(&point.xy());
        if point.z <= low || across >= cutter.radius {
            return false;
        }
        if high - low < SAME_HEIGHT || matches!(swept.spine, Spine::Point(_)) {
            return across < cutter.radius_at(point.z - low);
        }
        if cutter.corner == 0.0 {
            let below = swept.below(point.z, 1.0);
            return below.is_some_and(|spine| spine.distance(&point.xy()) < cutter.radius);
        }
        swept.lowest(cutter, &point.xy()) < point.z
    }
}

impl Swept {
    /// Height of the lowest place of a round tool's profile over a point on its way along a ramp [m].
    fn lowest(&self, cutter: &Cutter, point: &Vector2<f64>) -> f64 {
        let [start, end] = self.heights;
        let over = |share: f64| {
            let away = self.part(share, share).distance(point);
            // Out of reach it is high above everything, and lower where it is nearer.
            let beyond = if away > cutter.radius { 1e3 * (1.0 + away) } else { 0.0 };
            start + (end - start) * share + cutter.profile(away.min(cutter.radius)) + beyond
        };
        // Over a line this is convex: the profile rises ever faster with the distance. Over an arc it is
        // nearly so piece by piece.
        let pieces = match self.spine {
            Spine::Arc { .. } => self.pieces(),
            _ => 1,
        };
        let lowest = |piece: usize| {
            let share = |k: usize| k as f64 / pieces as f64;
            let (mut low, mut high) = (share(piece), share(piece + 1));
            for _ in 0..STEPS {
                let third = (high - low) / 3.0;
                if over(low + third) < over(high - third) { high -= third } else { low += third }
            }
            over((low + high) / 2.0)
        };
        (0..pieces).map(lowest).fold(f64::INFINITY, f64::min)
    }
}
