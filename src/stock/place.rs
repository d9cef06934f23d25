//! What the tool meets at a place: the part of its circle in the solid, less what earlier moves have
//! cleared, height by height.

use crate::math;
use crate::stock::circle::{ArcParts, HalfCircle, immersion};
use crate::stock::contact::{FloorArc, SideArc};
use crate::stock::grid::{Grid, SAME_HEIGHT};
use crate::stock::solid::Solid;
use crate::stock::swept::{Capsule, Spine, Swept};
use nalgebra::Vector2;
use std::borrow::Cow;
use std::ops::Range;

/// The tool as far as it clears material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cutter {
    /// Radius of its cylinder [m].
    pub radius: f64,
    /// Corner radius [m].
    pub corner: f64,
    /// Height up to which it cuts [m].
    pub flutes: f64,
}

/// Material thinner than this across the feed is none [m]: programs round to a thousandth of a
/// millimetre.
const THIN: f64 = 2e-6;
/// Part of the radius by which a swept region is taken smaller: the edge itself, which touches what
/// it sweeps, is not in it.
const TOUCH: f64 = 1e-11;
/// Parts of the tool's radius at which material within it is looked for: the rim itself may touch.
pub(super) const WITHIN: [f64; 3] = [0.98, 0.6, 0.2];
/// Most layers in which ramps nearby are seen.
const LAYERS: f64 = 16.0;
/// Slices of a corner.
pub(super) const CORNER: usize = 16;
/// Nodes and weights of Gauss and Legendre for twelve rings of the flat bottom, in [0, 1]. They miss 1 % of
/// the disc at worst, where the edge of what is left just touches it; six missed 3 %.
pub(super) const RINGS: [(f64, f64); 12] = [
    (0.009_219_682_876_640_375, 0.023_587_668_193_255_914),
    (0.047_941_371_814_762_57, 0.053_469_662_997_659_21),
    (0.115_048_662_902_847_65, 0.080_039_164_271_673_11),
    (0.206_341_022_856_691_3, 0.101_583_713_361_532_96),
    (0.316_084_250_500_909_9, 0.116_746_268_269_177_4),
    (0.437_383_295_744_265_54, 0.124_573_522_906_701_39),
    (0.562_616_704_255_734_5, 0.124_573_522_906_701_39),
    (0.683_915_749_499_090_1, 0.116_746_268_269_177_4),
    (0.793_658_977_143_308_7, 0.101_583_713_361_532_96),
    (0.884_951_337_097_152_3, 0.080_039_164_271_673_11),
    (0.952_058_628_185_237_5, 0.053_469_662_997_659_21),
    (0.990_780_317_123_359_7, 0.023_587_668_193_255_914),
];

/// What was found at a place, with room to find it in.
#[derive(Default)]
pub(super) struct Around {
    pub(super) sides: Vec<SideArc>,
    pub(super) floors: Vec<FloorArc>,
    parts: ArcParts,
    heights: Vec<f64>,
}

/// An end of an arc.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ArcEnd {
    /// Where a tooth enters.
    Entry,
    /// Where it leaves.
    Exit,
}

/// Engagement as two numbers whose changes matter [m^2]: the section in the tool's way, and how it is
/// spread.
pub(super) type EngagementMeasure = [f64; 2];

/// What a move has cleared with its tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cleared {
    pub(super) swept: Swept,
    pub(super) cutter: Cutter,
}

/// A place of the tool.
pub(super) struct ToolPlace<'a> {
    pub(super) center: Vector2<f64>,
    pub(super) height: f64,
    pub(super) ahead: Vector2<f64>,
    /// Share of the own move that lies behind.
    pub(super) share: f64,
    pub(super) dives: bool,
    /// The own move, if it clears.
    pub(super) own: Option<&'a Swept>,
    /// What was swept right before, and how far it is shifted along with the tool.
    pub(super) trail: (Range<usize>, Vector2<f64>),
}

/// The tool at a place, and what was cut before.
pub(super) struct Surroundings<'a> {
    pub(super) solid: &'a Solid,
    pub(super) cutter: &'a Cutter,
    pub(super) sweeps: &'a [Cleared],
    /// Whether all tools that cut are flat: what one clears at a height it clears above.
    pub(super) flat: bool,
    pub(super) grid: &'a Grid,
    /// Level legs right before, which are not in the grid yet.
    pub(super) begun: &'a [Swept],
    pub(super) place: ToolPlace<'a>,
}

impl Cutter {
    /// Height of the tool's profile above its tip at a distance from its axis [m].
    pub fn profile(&self, distance: f64) -> f64 {
        let beyond = distance - (self.radius - self.corner);
        if beyond <= 0.0 {
            return 0.0;
        }
        self.corner - (self.corner * self.corner - beyond * beyond).max(0.0).sqrt()
    }

    /// Radius of the tool at a height above its tip [m].
    pub fn radius_at(&self, height: f64) -> f64 {
        let below = self.corner - height;
        if below <= 0.0 {
            return self.radius;
        }
        self.radius - self.corner + (self.corner * self.corner - below * below).max(0.0).sqrt()
    }
}

impl Surroundings<'_> {
    /// Finds the contact.
    pub(super) fn find(&self, around: &mut Around) -> EngagementMeasure {
        around.sides.clear();
        around.floors.clear();
        let low = self.place.height.max(self.solid.bottom);
        let high = self.solid.top.min(self.place.height + self.cutter.flutes);
        if high - low < SAME_HEIGHT {
            return [0.0; 2];
        }
        let half =
            HalfCircle { center: self.place.center, radius: self.cutter.radius, ahead: self.place.ahead };
        let runs = self.place.own.is_some_and(|own| !matches!(own.spine, Spine::Point(_)));
        if runs {
            self.sides(half, (low, high), around);
        } else if self.place.dives {
            self.corner(half, (low, high.min(self.place.height + self.cutter.corner)), around);
        }
        if self.place.dives && self.place.height > self.solid.bottom {
            let flat = self.cutter.radius - self.cutter.corner;
            for (node, weight) in RINGS.into_iter().filter(|_| flat > 0.0) {
                let radius = node * flat;
                let half = HalfCircle { radius, ..half };
                self.ring(half, 0.0, weight * flat, around);
                self.ring(half.behind(), math::PI, weight * flat, around);
            }
        }
        measure(around, self.cutter.radius)
    }

    /// Whether there is material within the tool, as on a rapid move.
    pub(super) fn is_inside(&self, around: &mut Around) -> bool {
        let height = self.place.height.max(self.solid.bottom) + 2.0 * SAME_HEIGHT;
        if height >= self.solid.top {
            return false;
        }
        let half = HalfCircle { center: self.place.center, radius: 0.0, ahead: self.place.ahead };
        WITHIN.iter().any(|part| {
            let radius = part * self.cutter.radius_at(height - self.place.height);
            let half = HalfCircle { radius, ..half };
            self.is_met(&half, height, around) || self.is_met(&half.behind(), height, around)
        })
    }

    /// Whether what is above the flutes meets material ahead.
    pub(super) fn is_shank_in(&self, around: &mut Around) -> bool {
        let height = (self.place.height + self.cutter.flutes).max(self.solid.bottom) + 2.0 * SAME_HEIGHT;
        let half =
            HalfCircle { center: self.place.center, radius: self.cutter.radius, ahead: self.place.ahead };
        height < self.solid.top && self.is_met(&half, height, around)
    }

    /// Whether a half circle meets material at a height [m].
    pub(super) fn is_met(&self, half: &HalfCircle, height: f64, around: &mut Around) -> bool {
        let parts = &mut around.parts;
        parts.fill(half);
        parts.keep(half, &self.solid.outline, true);
        self.clear(half, (f64::NEG_INFINITY, height), parts);
        parts.ranges().iter().any(|(from, to)| (to - from) * half.radius > THIN)
    }

    /// Where one end of an arc is, near the place `near` at the middle of the arc's height; no farther than
    /// `far` from it.
    pub(super) fn end(
        &self,
        arc: &SideArc,
        end: ArcEnd,
        (near, far): (f64, f64),
        around: &mut Around,
    ) -> f64 {
        let height = (arc.from + arc.to) / 2.0;
        let half = HalfCircle {
            center: self.place.center,
            radius: self.cutter.radius_at(height),
            ahead: self.place.ahead,
        };
        let (low, high) = ((near - far).max(-1.0), (near + far).min(1.0));
        let parts = &mut around.parts;
        parts.fill_range(&half, (low, high));
        parts.keep(&half, &self.solid.outline, true);
        self.clear(&half, (f64::NEG_INFINITY, self.place.height + height), parts);
        match end {
            ArcEnd::Entry => {
                parts.ranges().last().filter(|range| range.1 == high).map_or(high, |range| range.0)
            }
            ArcEnd::Exit => {
                parts.ranges().first().filter(|range| range.0 == low).map_or(low, |range| range.1)
            }
        }
    }

    /// The arcs around the side between two heights [m].
    fn sides(&self, half: HalfCircle, (low, high): (f64, f64), around: &mut Around) {
        self.borders((low, high), &mut around.heights);
        let mut cleared = f64::NEG_INFINITY;
        for layer in 0..around.heights.len() - 1 {
            let (from, to) = (around.heights[layer], around.heights[layer + 1]);
            let middle = (from + to) / 2.0;
            let half = HalfCircle { radius: self.cutter.radius_at(middle - self.place.height), ..half };
            let parts = &mut around.parts;
            if layer == 0 || !self.flat {
                parts.fill(&half);
                parts.keep(&half, &self.solid.outline, true);
                cleared = f64::NEG_INFINITY;
            }
            // A cylinder clears above a height what it clears there.
            self.clear(&half, (cleared, middle), parts);
            cleared = middle;
            if parts.is_empty() && self.flat {
                break;
            }
            let wide = |&(a, b): &(f64, f64)| (b - a) * half.radius > THIN;
            let (from, to) = (from - self.place.height, to - self.place.height);
            around.sides.extend(parts.ranges().iter().copied().filter(wide).map(|(a, b)| SideArc {
                from,
                to,
                entry: immersion(a),
                exit: immersion(b),
                shift: [0.0; 2],
            }));
        }
    }

    /// The arcs all around the corner of a tool that only dives between two heights [m].
    fn corner(&self, half: HalfCircle, (low, high): (f64, f64), around: &mut Around) {
        if high - low < SAME_HEIGHT {
            return;
        }
        self.borders((low, high), &mut around.heights);
        for layer in 0..around.heights.len() - 1 {
            let (from, to) = (around.heights[layer], around.heights[layer + 1]);
            let middle = (from + to) / 2.0;
            let half = HalfCircle { radius: self.cutter.radius_at(middle - self.place.height), ..half };
            let (from, to) = (from - self.place.height, to - self.place.height);
            for (half, turn) in [(half, 0.0), (half.behind(), math::PI)] {
                let parts = &mut around.parts;
                parts.fill(&half);
                parts.keep(&half, &self.solid.outline, true);
                self.clear(&half, (f64::NEG_INFINITY, middle), parts);
                around.sides.extend(parts.ranges().iter().map(|&(a, b)| SideArc {
                    from,
                    to,
                    entry: turn + immersion(a),
                    exit: turn + immersion(b),
                    shift: [0.0; 2],
                }));
            }
        }
    }

    /// The heights between which the contact is taken as the same [m].
    fn borders(&self, (low, high): (f64, f64), heights: &mut Vec<f64>) {
        heights.clear();
        heights.extend([low, high]);
        let cell = self.grid.at(&self.place.center);
        let within = |height: f64| height > low + SAME_HEIGHT && height < high - SAME_HEIGHT;
        heights.extend(cell.levels.iter().map(|level| level.height).filter(|height| within(*height)));
        if self.cutter.corner > 0.0 {
            let slice = |k: usize| {
                let kappa = math::PI / 2.0 * k as f64 / CORNER as f64;
                self.place.height + self.cutter.corner * (1.0 - math::cos(kappa))
            };
            heights.extend((1..=CORNER).map(slice).filter(|height| within(*height)));
        }
        let ramps = cell.ramps.iter().map(|&number| &self.sweeps[number as usize].swept);
        // Walls that a round tool has left vary all the way up.
        let mut span = if self.flat { (high, low) } else { (low, high) };
        for (from, to) in ramps.chain(self.place.own).map(Swept::range) {
            if to > low + SAME_HEIGHT && from < high - SAME_HEIGHT && to - from > SAME_HEIGHT {
                span = (span.0.min(from.max(low)), span.1.max(to.min(high)));
            }
        }
        if span.1 > span.0 {
            let step = |k: usize| span.0 + (span.1 - span.0) * k as f64 / LAYERS;
            heights.extend((0..=LAYERS as usize).map(step).filter(|height| within(*height)));
        }
        heights.sort_unstable_by(f64::total_cmp);
        heights.dedup_by(|a, b| *a - *b < SAME_HEIGHT);
    }

    /// Takes away what earlier moves have cleared at a height [m], but for those that stayed at or below
    /// another one.
    fn clear(&self, half: &HalfCircle, (above, height): (f64, f64), parts: &mut ArcParts) {
        let cell = self.grid.at(&self.place.center);
        let mut subtract = |spine: &Spine, cutter: &Cutter, tip: f64| {
            let reach = cutter.radius_at(height - tip) * (1.0 - TOUCH);
            parts.subtract(half, &Capsule { spine, reach }, |point, span| {
                spine.is_within(point, reach + span)
            });
            parts.is_empty()
        };
        let own = self.place.own.and_then(|own| own.below(height, self.place.share));
        if own.is_some_and(|own| subtract(&own, self.cutter, self.place.height)) {
            return;
        }
        let begun = self.begun.iter().rev().map(|leg| leg.moved(&self.place.trail.1));
        let mut begun = begun.filter(|leg| leg.heights[0] > above && leg.heights[0] <= height);
        if begun.any(|leg| subtract(&leg.spine, self.cutter, leg.heights[0])) {
            return;
        }
        for level in cell.levels.iter().filter(|level| level.height > above) {
            if level.height > height {
                break;
            }
            for &number in level.moves.iter().rev() {
                let cleared = self.swept(number as usize);
                if subtract(&cleared.swept.spine, &cleared.cutter, level.height) {
                    return;
                }
            }
        }
        for &number in cell.ramps.iter().rev() {
            let cleared = self.swept(number as usize);
            let Cleared { swept, cutter } = &*cleared;
            let (_, highest) = swept.range();
            let Some(spine) = swept.below(height, 1.0) else { continue };
            // With the reach of its highest place: with any larger one, a round nose that rises would
            // have cleared what lies ahead of it.
            if subtract(&spine, cutter, highest.min(height)) {
                return;
            }
        }
    }

    /// What a move has cleared, as seen by a tool that is shifted with its trail.
    fn swept(&self, number: usize) -> Cow<'_, Cleared> {
        let cleared = &self.sweeps[number];
        let (trail, by) = &self.place.trail;
        if !trail.contains(&number) {
            return Cow::Borrowed(cleared);
        }
        Cow::Owned(Cleared { swept: cleared.swept.moved(by), ..*cleared })
    }

    /// The arcs of half a ring of the bottom, whose immersion angles begin at `turn` [rad].
    fn ring(&self, half: HalfCircle, turn: f64, width: f64, around: &mut Around) {
        let parts = &mut around.parts;
        parts.fill(&half);
        parts.keep(&half, &self.solid.outline, true);
        // What lies right under the tip.
        let height = self.place.height - 2.0 * SAME_HEIGHT;
        self.clear(&half, (f64::NEG_INFINITY, height), parts);
        let arc = |&(a, b): &(f64, f64)| FloorArc {
            radius: half.radius,
            width,
            entry: turn + immersion(a),
            exit: turn + immersion(b),
        };
        around.floors.extend(parts.ranges().iter().map(arc));
    }
}

/// The measure of what was found.
fn measure(around: &Around, radius: f64) -> EngagementMeasure {
    let mut sum = [0.0; 2];
    for arc in &around.sides {
        let (enters, leaves) = (math::cos(arc.entry), math::cos(arc.exit));
        let height = arc.to - arc.from;
        sum[0] += radius * (enters - leaves) * height;
        sum[1] += radius * (enters * enters - leaves * leaves) * height;
    }
    for arc in &around.floors {
        sum[0] += arc.radius * arc.width * (arc.exit - arc.entry);
    }
    sum
}
