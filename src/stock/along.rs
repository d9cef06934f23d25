//! The contact along a path: move by move, each against the solid and all that was cut before.

use crate::math;
use crate::path::{Move, MovePace, Path, Segment};
use crate::progress::Progress;
use crate::stock::circle::left_of;
use crate::stock::contact::{Collider, Contacts, FloorArc, SideArc};
use crate::stock::grid::Grid;
use crate::stock::mapped;
use crate::stock::place::{ArcEnd, Around, Cleared, Cutter, EngagementMeasure, Surroundings, ToolPlace};
use crate::stock::solid::Solid;
use crate::stock::strokes::{Stroke, strokes};
use crate::stock::swept::Swept;
use nalgebra::{Vector2, Vector3};
use std::ops::Range;

/// How far inside its move an end is looked at, as a part of the radius.
pub(super) const INSIDE: f64 = 1e-4;
/// Largest distance of stations, as a part of the radius.
const FAR: f64 = 0.125;
/// Most stations before contact is looked at more closely.
pub(super) const MOST_STATIONS: f64 = 1e6;
/// Distance of the places at which a rapid move is looked at, as a part of the radius.
pub(super) const LOOK: f64 = 0.5;
/// Least distance of stations, as a part of the radius.
const NEAR: f64 = 0.002;
/// Shift used to find how a contact changes, as a share of the radius.
const SHIFT: f64 = 1e-4;
/// How many times as fast as that of a wall along the feed an end of an arc is taken to move at most. Where two
/// circles just touch or the tool breaks through a side, it jumps: a gap opens like the square root of the shift, at
/// this mean rate over a few tenths of a millimetre.
const STEEPEST: f64 = 2.0;
/// Length of what is shifted along, as a part of the radius: the tool has not stepped aside from it.
const TRAIL: f64 = 1e-2;
/// Part of the largest engagement by which a station may differ from the middle of its neighbours.
const BENT: f64 = 0.002;

/// Largest distance of an arc that does not lie across the tool axis from its chords [m].
const CHORD: f64 = 1e-6;

/// Share of the length of the cutting moves that climb or dive as they go along from which the stock is
/// a map of heights.
const MOSTLY_RAMPS: f64 = 0.25;
/// Ramps of a flat tool, whose section is the same at every height, are seen by layers up to so many.
const MOST_RAMPS: usize = 2000;

/// A path that a stock was cut along before, with another tool.
#[derive(Debug, Clone, PartialEq)]
pub struct Earlier {
    /// The path in the workpiece frame; its tool axis is z.
    pub path: Path,
    /// Its tool.
    pub cutter: Cutter,
}

/// The contacts of a cutter along a path in the workpiece frame whose tool axis is z, starting from what
/// earlier paths left of a solid: by a map of heights if much of the path climbs or dives or the solid is
/// no prism, else by circles and capsules. Rapid moves clear nothing.
pub fn contacts(
    path: &Path,
    (solid, earlier): (&Solid, &[Earlier]),
    cutter: &Cutter,
    progress: &mut Progress,
) -> Contacts {
    let cuts = || path.moves().iter().filter(|step| step.pace != MovePace::Rapid).map(|step| &step.segment);
    let is_ramp = |segment: &&Segment| {
        let feed = segment.tangent(segment.length() / 2.0);
        Swept::of(segment).is_none() || (feed.z != 0.0 && math::hypot(feed.x, feed.y) > 1e-6)
    };
    let length = |cuts: &mut dyn Iterator<Item = &Segment>| cuts.map(Segment::length).sum::<f64>();
    let in_space = length(&mut cuts().filter(is_ramp)) > MOSTLY_RAMPS * length(&mut cuts())
        && (cutter.corner > 0.0 || cuts().filter(is_ramp).count() > MOST_RAMPS);
    if in_space || !solid.relief.is_empty() {
        return mapped::contacts(path, (solid, earlier), cutter, progress);
    }
    level(path, (solid, earlier), cutter, progress)
}

/// The contacts by circles and capsules: exact where the path is level.
fn level(
    path: &Path,
    (solid, earlier): (&Solid, &[Earlier]),
    cutter: &Cutter,
    progress: &mut Progress,
) -> Contacts {
    let legs: Vec<Vec<Leg>> = path.moves().iter().map(|step| legs(&step.segment)).collect();
    let cuts =
        path.moves().iter().zip(&legs).flat_map(|(step, legs)| {
            legs.iter().map(|leg| (step.pace != MovePace::Rapid).then_some(leg.swept))
        });
    let strokes = strokes(cuts, cutter.radius);
    let own = strokes.iter().map(|stroke| Cleared { swept: stroke.swept, cutter: *cutter });
    let sweeps: Vec<Cleared> = earlier.iter().flat_map(cleared).chain(own).collect();
    let mut walk = Walk::new(path, (&sweeps, &strokes), solid, cutter);
    for (index, legs) in legs.iter().enumerate() {
        progress.sample(index, path.moves().len());
        walk.step(index, legs);
    }
    walk.contacts
}

/// What an earlier path has cleared.
pub(super) fn cleared(earlier: &Earlier) -> Vec<Cleared> {
    let legs = earlier.path.moves().iter().flat_map(|step| {
        let cuts = step.pace != MovePace::Rapid;
        legs(&step.segment).into_iter().map(move |leg| cuts.then_some(leg.swept))
    });
    let strokes = strokes(legs, earlier.cutter.radius).into_iter();
    strokes.map(|stroke| Cleared { swept: stroke.swept, cutter: earlier.cutter }).collect()
}

/// A part of a move that sweeps one capsule.
pub(super) struct Leg {
    pub(super) swept: Swept,
    /// Its chord; `None` of a whole move. The tool is looked at on it: beside it, what the leg has swept
    /// would reach ahead of the tool.
    pub(super) chord: Option<Segment>,
    /// Arc lengths of its ends within the move [m].
    pub(super) within: Range<f64>,
}

/// The legs of a move: itself, or the chords of an arc that does not lie across the tool axis.
pub(super) fn legs(segment: &Segment) -> Vec<Leg> {
    let length = segment.length();
    if let Some(swept) = Swept::of(segment) {
        return vec![Leg { swept, chord: None, within: 0.0..length }];
    }
    // A chord of the angle a is r a^2 / 8 away.
    let step = (8.0 * CHORD / segment.curvature()).sqrt();
    let count = (length / step).ceil().max(1.0);
    let at = |k: usize| length * (k as f64 / count);
    let chord = |k: usize| Segment::Line { from: segment.point(at(k)), to: segment.point(at(k + 1)) };
    let leg = |k: usize| {
        Some(Leg { swept: Swept::of(&chord(k))?, chord: Some(chord(k)), within: at(k)..at(k + 1) })
    };
    (0..count as usize).filter_map(leg).collect()
}

/// The walk along a path.
struct Walk<'a> {
    path: &'a Path,
    /// What earlier paths and the strokes of this one sweep.
    sweeps: &'a [Cleared],
    /// The strokes.
    strokes: &'a [Stroke],
    /// Number of sweeps by earlier paths.
    earlier: usize,
    /// Number of sweeps before the stroke that is walked.
    number: usize,
    /// The legs of that stroke so far.
    begun: Vec<Swept>,
    flat: bool,
    /// Distance of stations where the contact does not change [m].
    far: f64,
    solid: &'a Solid,
    cutter: &'a Cutter,
    grid: Grid,
    /// The last direction across the tool axis.
    ahead: Vector2<f64>,
    contacts: Contacts,
    around: Around,
}

/// The contact at an arc length within a move.
struct FoundContact {
    /// Arc length [m].
    within: f64,
    measure: EngagementMeasure,
    sides: Vec<SideArc>,
    floors: Vec<FloorArc>,
}

impl<'a> Walk<'a> {
    /// A walk of the strokes that come last among the sweeps.
    fn new(
        path: &'a Path,
        (sweeps, strokes): (&'a [Cleared], &'a [Stroke]),
        solid: &'a Solid,
        cutter: &'a Cutter,
    ) -> Self {
        let earlier = sweeps.len() - strokes.len();
        let bounds = strokes.iter().map(|stroke| stroke.swept.spine.bounds());
        let all = bounds.reduce(|a, b| [a[0].inf(&b[0]), a[1].sup(&b[1])]);
        let ahead = path.moves().iter().find_map(|step| heading(step, 0.0));
        let largest = sweeps.iter().map(|cleared| cleared.cutter.radius).fold(cutter.radius, f64::max);
        let mut grid = Grid::new(all.unwrap_or_default(), cutter.radius + largest);
        for (number, cleared) in sweeps[..earlier].iter().enumerate() {
            grid.add(number as u32, &cleared.swept);
        }
        Self {
            path,
            sweeps,
            strokes,
            earlier,
            number: earlier,
            begun: Vec::new(),
            flat: sweeps.iter().all(|cleared| cleared.cutter.corner == 0.0),
            far: (FAR * cutter.radius).max(path.length() / MOST_STATIONS),
            solid,
            cutter,
            grid,
            ahead: ahead.unwrap_or_else(Vector2::x),
            contacts: Contacts::default(),
            around: Around::default(),
        }
    }

    /// The stations of a move, which then counts as cut.
    fn step(&mut self, index: usize, legs: &[Leg]) {
        let step = &self.path.moves()[index];
        self.contacts.begin();
        if step.pace == MovePace::Rapid {
            legs.iter().for_each(|leg| self.rapid(step, leg));
            self.ahead = heading(step, step.segment.length()).unwrap_or(self.ahead);
            return;
        }
        for leg in legs {
            self.leg(step, leg);
            self.ahead = heading(step, leg.within.end).unwrap_or(self.ahead);
            self.begun.push(leg.swept);
            let stroke = &self.strokes[self.number - self.earlier];
            if self.begun.len() == stroke.legs {
                self.grid.add(self.number as u32, &stroke.swept);
                self.begun.clear();
                self.number += 1;
            }
        }
    }

    /// The stations of a leg.
    fn leg(&mut self, step: &Move, leg: &Leg) {
        let Range { start, end } = leg.within;
        let pieces = ((end - start) / self.far).ceil().max(1.0);
        let mut from = self.find(step, leg, start);
        self.keep(step, leg, &mut from);
        for piece in 1..=pieces as usize {
            let mut to = self.find(step, leg, start + (end - start) * (piece as f64 / pieces));
            self.refine(step, leg, &from, &to);
            self.keep(step, leg, &mut to);
            from = to;
        }
    }

    /// Looks for material in the way of a rapid leg.
    fn rapid(&mut self, step: &Move, leg: &Leg) {
        let Range { start, end } = leg.within;
        let pieces = ((end - start) / (LOOK * self.cutter.radius)).ceil().max(1.0);
        for piece in 0..=pieces as usize {
            let within = start + (end - start) * (piece as f64 / pieces);
            let mut around = std::mem::take(&mut self.around);
            let is_inside = self.at(step, leg, within, None).is_inside(&mut around);
            self.around = around;
            if is_inside {
                self.contacts.collide(Collider::Rapid, within);
                return;
            }
        }
    }

    /// Adds the stations that are needed strictly between two places.
    fn refine(&mut self, step: &Move, leg: &Leg, from: &FoundContact, to: &FoundContact) {
        if to.within - from.within < 2.0 * NEAR * self.cutter.radius {
            return;
        }
        let mut middle = self.find(step, leg, (from.within + to.within) / 2.0);
        let height = self.solid.top - step.segment.point(middle.within).z.max(self.solid.bottom);
        let most = 2.0 * self.cutter.radius * height;
        let bent =
            |k: usize| (middle.measure[k] - (from.measure[k] + to.measure[k]) / 2.0).abs() > BENT * most;
        // Where an arc begins, ends or parts, the contact changes like a square root.
        let parted = from.sides.len() != to.sides.len();
        if parted || bent(0) || bent(1) {
            self.refine(step, leg, from, &middle);
            self.keep(step, leg, &mut middle);
            self.refine(step, leg, &middle, to);
        }
    }

    /// Keeps what was found.
    fn keep(&mut self, step: &Move, leg: &Leg, found: &mut FoundContact) {
        self.shift(step, leg, found);
        let feed = step.segment.tangent(found.within);
        let lean = [math::hypot(feed.x, feed.y), -feed.z];
        self.contacts.push(found.within, lean, &found.sides, &found.floors);
    }

    /// Finds the contact at the arc length `within` [m] of a move.
    fn find(&mut self, step: &Move, leg: &Leg, within: f64) -> FoundContact {
        let seen = self.seen(leg, within);
        let mut found = std::mem::take(&mut self.around);
        let around = self.at(step, leg, seen, Some(&leg.swept));
        let measure = around.find(&mut found);
        let sides = found.sides.clone();
        // A plunge runs down its own hole.
        let shank = heading(step, seen).is_some() && around.is_shank_in(&mut found);
        self.around = found;
        if shank {
            self.contacts.collide(Collider::Shank, within);
        }
        FoundContact { within, measure, sides, floors: self.around.floors.clone() }
    }

    /// Where a place of a leg is looked at: at the very ends the tool may touch what it does not cut, so
    /// they are seen from just inside.
    fn seen(&self, leg: &Leg, within: f64) -> f64 {
        let Range { start, end } = leg.within;
        let inside = (INSIDE * self.cutter.radius).min((end - start) / 2.0);
        within.clamp(start + inside, end - inside)
    }

    /// Finds how fast the ends of the arcs move as the tool shifts to its left.
    fn shift(&mut self, step: &Move, leg: &Leg, found: &mut FoundContact) {
        if found.sides.is_empty() || heading(step, found.within).is_none() {
            return;
        }
        let by = SHIFT * self.cutter.radius;
        let mut around = std::mem::take(&mut self.around);
        let mut shifted = self.at(step, leg, self.seen(leg, found.within), None);
        let offset = left_of(&shifted.place.ahead) * by;
        let own = leg.swept.moved(&offset);
        shifted.place.center += offset;
        shifted.place.own = Some(&own);
        shifted.place.trail = (self.trail(found.within - leg.within.start), offset);
        for arc in &mut found.sides {
            let known = *arc;
            let mut fast = |end: ArcEnd, angle: f64| {
                let place = -math::cos(angle);
                if place.abs() >= 1.0 {
                    return 0.0;
                }
                (shifted.end(&known, end, (place, STEEPEST * SHIFT), &mut around) - place) / by
            };
            arc.shift = [fast(ArcEnd::Entry, known.entry), fast(ArcEnd::Exit, known.exit)];
        }
        self.around = around;
    }

    /// What was swept within a short way before the place `behind` [m] after the start of a leg.
    fn trail(&self, mut behind: f64) -> Range<usize> {
        let mut first = self.number;
        behind += self.begun.iter().map(Swept::length).sum::<f64>();
        while behind < TRAIL * self.cutter.radius && first > self.earlier {
            first -= 1;
            behind += self.sweeps[first].swept.length();
        }
        first..self.number
    }

    /// The tool at the arc length `within` [m] of a move, of which `own` clears.
    fn at<'b>(&'b self, step: &Move, leg: &Leg, within: f64, own: Option<&'b Swept>) -> Surroundings<'b> {
        let Range { start, end } = leg.within;
        let share = (within - start) / (end - start);
        let (tip, feed) = match &leg.chord {
            None => (step.segment.point(within), step.segment.tangent(within)),
            Some(chord) => (chord.point(share * chord.length()), chord.tangent(0.0)),
        };
        let place = ToolPlace {
            center: tip.xy(),
            height: tip.z,
            ahead: across(&feed).unwrap_or(self.ahead),
            share,
            dives: feed.z < -1e-6,
            own,
            trail: Default::default(),
        };
        Surroundings {
            solid: self.solid,
            cutter: self.cutter,
            sweeps: self.sweeps,
            flat: self.flat,
            grid: &self.grid,
            begun: &self.begun,
            place,
        }
    }
}

/// Direction across the tool axis; `None` if the tool only rises or dives.
pub(super) fn heading(step: &Move, within: f64) -> Option<Vector2<f64>> {
    across(&step.segment.tangent(within))
}

/// Direction of a feed across the tool axis; `None` if there is none.
fn across(feed: &Vector3<f64>) -> Option<Vector2<f64>> {
    feed.xy().try_normalize(1e-6)
}
