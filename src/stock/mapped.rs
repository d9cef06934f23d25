//! The contact along a path by a map of heights.

use crate::math;
use crate::path::{Move, MovePace, Path};
use crate::progress::Progress;
use crate::stock::along::{Earlier, INSIDE, LOOK, MOST_STATIONS, heading};
use crate::stock::circle::{immersion, left_of};
use crate::stock::contact::{Collider, Contacts, FloorArc, SideArc};
use crate::stock::height_map::{HeightMap, STAMPS, STEP, Stamp};
use crate::stock::place::{CORNER, Cutter, RINGS, WITHIN};
use crate::stock::solid::Solid;
use nalgebra::{Vector2, Vector3};

/// Directions ahead that are looked at.
const AHEAD: usize = 180;
/// Every so many directions are enough to find what must not be met.
const SPARSE: usize = 6;
/// Layers of the cylinder.
const CYLINDER: usize = 8;
/// How far beyond the cylinder the map is read, in cells: the middle of the cell read is then beyond it.
const BEYOND: f64 = 0.75;
/// Material lower than this above the tool's profile is none [m].
const SHALLOW: f64 = 1e-6;

/// The contacts of a cutter along a path in the workpiece frame whose tool axis is z, by a map of
/// heights. Rapid moves clear nothing.
pub(super) fn contacts(
    path: &Path,
    (solid, earlier): (&Solid, &[Earlier]),
    cutter: &Cutter,
    progress: &mut Progress,
) -> Contacts {
    let mut map = HeightMap::new(solid, cutter);
    earlier.iter().for_each(|earlier| map.cut(&earlier.path, &earlier.cutter));
    let stamp = Stamp::new(cutter);
    let step_length = (STEP * cutter.radius).max(path.length() / MOST_STATIONS);
    let mut contacts = Contacts::on_map(map.cell);
    let directions = Directions::new();
    let first = path.moves().iter().find_map(|step| heading(step, 0.0));
    let mut ahead = first.unwrap_or_else(Vector2::x);
    let (mut sides, mut floors) = (Vec::new(), Vec::new());
    // A place counts as cut only after the contact there was seen, also that of the next move.
    let mut reached: Option<Vector3<f64>> = None;
    for (index, step) in path.moves().iter().enumerate() {
        progress.sample(index, path.moves().len());
        contacts.begin();
        let length = step.segment.length();
        if step.pace == MovePace::Rapid {
            reached.take().into_iter().for_each(|tip| map.stamp(&stamp, &tip));
            ahead = heading(step, length).unwrap_or(ahead);
            let count = (length / (LOOK * cutter.radius)).ceil().max(1.0);
            let places = (0..=count as usize).map(|k| length * (k as f64 / count));
            let view = |within: f64| {
                let tip = step.segment.point(within);
                MapView { map: &map, solid, cutter, directions: &directions, tip, ahead, lean: [1.0, 0.0] }
            };
            let met = places.into_iter().find(|&within| view(within).is_inside());
            met.into_iter().for_each(|within| contacts.collide(Collider::Rapid, within));
            continue;
        }
        let count = (length / step_length).ceil().max(1.0) as usize;
        let at = |part: usize, of: usize| length * (part as f64 / of as f64);
        for k in 0..=count {
            let within = at(k, count);
            ahead = heading(step, within).unwrap_or(ahead);
            let feed = step.segment.tangent(within);
            let lean = [math::hypot(feed.x, feed.y), -feed.z];
            let inside = (INSIDE * cutter.radius).min(length / 2.0);
            let tip = step.segment.point(within.clamp(inside, length - inside));
            let view = MapView { map: &map, solid, cutter, directions: &directions, tip, ahead, lean };
            view.sides(is_vertical(step), &mut sides);
            view.floors(feed.z < -1e-6, &mut floors);
            contacts.push(within, lean, &sides, &floors);
            if !is_vertical(step) && view.is_shank_in() {
                contacts.collide(Collider::Shank, within);
            }
            let stamps = if k < count { 0..STAMPS } else { 0..0 };
            for part in stamps {
                map.stamp(&stamp, &step.segment.point(at(k * STAMPS + part, count * STAMPS)));
            }
        }
        reached = Some(step.segment.point(length));
    }
    contacts
}

/// Whether a move only rises or dives.
fn is_vertical(step: &Move) -> bool {
    heading(step, 0.0).is_none()
}

/// Sines and cosines of the immersion angles that are looked at, the middles of even steps around the
/// tool; the first half lies ahead.
struct Directions(Vec<(f64, f64)>);

impl Directions {
    fn new() -> Self {
        let angle = |k: usize| math::PI * (k as f64 + 0.5) / AHEAD as f64;
        Self((0..2 * AHEAD).map(|k| math::sin_cos(angle(k))).collect())
    }
}

/// The runs of numbers below `count` for which a test holds, as their first and the one after their
/// last.
fn runs(count: usize, holds: impl Fn(usize) -> bool) -> impl Iterator<Item = (usize, usize)> {
    let mut next = 0;
    std::iter::from_fn(move || {
        let first = (next..count).find(|&k| holds(k))?;
        let end = (first..count).find(|&k| !holds(k)).unwrap_or(count);
        next = end;
        Some((first, end))
    })
}

/// The tool at a place over the map.
struct MapView<'a> {
    directions: &'a Directions,
    map: &'a HeightMap,
    solid: &'a Solid,
    cutter: &'a Cutter,
    tip: Vector3<f64>,
    ahead: Vector2<f64>,
    /// Shares of the feed across and down.
    lean: [f64; 2],
}

impl MapView<'_> {
    /// Where a cell in a direction at a radius [m] is: its distance from the axis, and the height of its
    /// material above the tip [m].
    fn cell(&self, radius: f64, direction: usize) -> (f64, f64) {
        let (sin, cos) = self.directions.0[direction];
        let offset = (self.ahead * sin + left_of(&self.ahead) * cos) * radius;
        let (middle, height) = self.map.cell_at(&(self.tip.xy() + offset));
        ((middle - self.tip.xy()).norm(), height - self.tip.z)
    }

    /// The arcs around the side, from the tip up; of a tool that only rises or dives those of its corner.
    fn sides(&self, vertical: bool, sides: &mut Vec<SideArc>) {
        sides.clear();
        let low = (self.solid.bottom - self.tip.z).max(0.0);
        let high = (self.solid.top - self.tip.z).min(self.cutter.flutes);
        let high = if vertical { high.min(self.cutter.corner) } else { high };
        if high <= low {
            return;
        }
        let corner = self.cutter.corner;
        let slice = |k: usize| corner * (1.0 - math::cos(math::PI / 2.0 * k as f64 / CORNER as f64));
        let layer = |k: usize| corner + (high - corner) * k as f64 / CYLINDER as f64;
        let borders = (0..CORNER).map(slice).filter(|_| corner > 0.0).chain((0..=CYLINDER).map(layer));
        let borders: Vec<f64> = borders.filter(|height| *height < high).chain([high]).collect();
        for pair in borders.windows(2) {
            let (from, to) = (pair[0].max(low), pair[1]);
            if to > from {
                self.layer((from, to), sides);
            }
        }
    }

    /// Whether there is material within the tool, as on a rapid move; by more than a cell's slope hides.
    fn is_inside(&self) -> bool {
        self.tip.z < self.solid.top
            && WITHIN.iter().any(|part| {
                (0..2 * AHEAD).step_by(SPARSE).any(|k| {
                    let (distance, height) = self.cell(part * self.cutter.radius, k);
                    let low = (self.solid.bottom - self.tip.z).max(self.cutter.profile(distance));
                    distance < self.cutter.radius && height > low + self.map.cell
                })
            })
    }

    /// Whether what is above the flutes meets material ahead.
    fn is_shank_in(&self) -> bool {
        let radius = self.cutter.radius + BEYOND * self.map.cell;
        self.tip.z + self.cutter.flutes < self.solid.top
            && (0..AHEAD).step_by(SPARSE).any(|k| self.cell(radius, k).1 > self.cutter.flutes + self.map.cell)
    }

    /// The arcs between two heights above the tip [m].
    fn layer(&self, (from, to): (f64, f64), sides: &mut Vec<SideArc>) {
        let middle = (from + to) / 2.0;
        let on_corner = middle < self.cutter.corner;
        let radius = self.cutter.radius_at(middle) + if on_corner { 0.0 } else { BEYOND * self.map.cell };
        let met = |k: usize| {
            let (distance, height) = self.cell(radius, k);
            let profile = if on_corner && distance < self.cutter.radius {
                self.cutter.profile(distance)
            } else {
                middle
            };
            height > profile + SHALLOW
        };
        // On the corner the edge cuts where it moves along its normal: to the side as the feed goes
        // across, down as it dives.
        let run = self.cutter.radius_at(to) - self.cutter.radius_at(from);
        let [across, down] = self.lean;
        let steep = down * run / (to - from);
        let cuts = |k: usize| across * self.directions.0[k].0 + steep > 0.0;
        let count = if on_corner { 2 * AHEAD } else { AHEAD };
        let runs = runs(count, |k| cuts(k) && met(k));
        // A place beyond the cylinder is seen where the feed brings the edge to it.
        let at = |k: usize| {
            if on_corner { angle(k) } else { immersion(-math::cos(angle(k)) * radius / self.cutter.radius) }
        };
        // Taken as ending along the feed: cells are too coarse to see how a border moves.
        let shift = |angle: f64| if angle > 0.0 && angle < math::PI { 1.0 / radius } else { 0.0 };
        sides.extend(runs.map(|(first, end)| {
            let (entry, exit) = (at(first), at(end));
            SideArc { from, to, entry, exit, shift: [shift(entry), shift(exit)] }
        }));
    }

    /// The arcs under the flat bottom, if the tool dives.
    fn floors(&self, dives: bool, floors: &mut Vec<FloorArc>) {
        floors.clear();
        let flat = self.cutter.radius - self.cutter.corner;
        if !dives || self.tip.z < self.solid.bottom || flat <= 0.0 {
            return;
        }
        for (node, weight) in RINGS {
            let (radius, width) = (node * flat, weight * flat);
            let runs = runs(2 * AHEAD, |k| self.cell(radius, k).1 > SHALLOW);
            let arc = |(first, end)| FloorArc { radius, width, entry: angle(first), exit: angle(end) };
            floors.extend(runs.map(arc));
        }
    }
}

/// Immersion angle at the border of the directions `k - 1` and `k` [rad].
fn angle(k: usize) -> f64 {
    math::PI * k as f64 / AHEAD as f64
}
