//! The pieces of surface that the tool's envelope offers at a place of the path.
//!
//! A tool that moves along the tangent t leaves surface where its own is along t: at the points of its
//! profile whose outward normal n lies across t. With the tool axis z, y = z x t to the left of the feed and
//! w = t x y, these are n = y sin(kappa) - w cos(kappa), from the bottom (kappa = 0) over the corner
//! to the walls (a right angle). On a level move the flat bottom has that normal all over.

use crate::math;
use crate::stock::{Contact, Cutter, SideArc};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// What a piece of surface is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SurfaceKind {
    /// Cut by the side.
    Wall,
    /// Cut by the bottom, or the tip of a ball nose.
    Floor,
    /// Cut by the corner between them.
    Corner,
}

/// A piece of surface that a tool may leave at a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Facet {
    /// What it is.
    pub(super) kind: SurfaceKind,
    /// Its normal into the material along t, y and w.
    normal: [f64; 3],
    /// Of a wall, its height as a share of that of the cut; of a floor, how far it lies left of the axis, as
    /// a share of the flat bottom's radius.
    share: f64,
}

const fn facet(kind: SurfaceKind, normal: [f64; 3], share: f64) -> Facet {
    Facet { kind, normal, share }
}

/// Sine and cosine of an eighth of a turn's half.
const SIN: f64 = 0.382_683_432_365_089_8;
const COS: f64 = 0.923_879_532_511_286_7;
/// Heights of a wall that are looked at, as shares of that of the cut.
const LOW: f64 = 0.02;
const HIGH: f64 = 0.98;

/// The facets, numbered as in a set of them.
pub(super) const FACETS: [Facet; 19] = {
    use SurfaceKind::{Corner, Floor, Wall};
    [
        facet(Floor, [0.0, 0.0, -1.0], 0.0),
        facet(Floor, [0.0, 0.0, -1.0], 0.5),
        facet(Floor, [0.0, 0.0, -1.0], -0.5),
        facet(Floor, [0.0, 0.0, -1.0], HIGH),
        facet(Floor, [0.0, 0.0, -1.0], -HIGH),
        facet(Corner, [0.0, SIN, -COS], 0.0),
        facet(Corner, [0.0, -SIN, -COS], 0.0),
        facet(Corner, [0.0, FRAC_1_SQRT_2, -FRAC_1_SQRT_2], 0.0),
        facet(Corner, [0.0, -FRAC_1_SQRT_2, -FRAC_1_SQRT_2], 0.0),
        facet(Corner, [0.0, COS, -SIN], 0.0),
        facet(Corner, [0.0, -COS, -SIN], 0.0),
        facet(Wall, [0.0, 1.0, 0.0], LOW),
        facet(Wall, [0.0, -1.0, 0.0], LOW),
        facet(Wall, [0.0, 1.0, 0.0], 0.5),
        facet(Wall, [0.0, -1.0, 0.0], 0.5),
        facet(Wall, [0.0, 1.0, 0.0], HIGH),
        facet(Wall, [0.0, -1.0, 0.0], HIGH),
        // Around a tool that dives.
        facet(Wall, [0.0, 0.0, 1.0], LOW),
        facet(Wall, [0.0, 0.0, -1.0], LOW),
    ]
};

/// A set of facets: bit `k` stands for `FACETS[k]`.
pub(super) type FacetSet = u32;

/// How closely an arc of the contact must reach the edge that generates a facet [rad].
const REACHES: f64 = 0.02;
/// Components of directions smaller than this are none.
const NONE: f64 = 1e-6;

/// A place of the path: directions across which surface is left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Across {
    /// t, y and w.
    directions: [Vector3<f64>; 3],
    /// The tool axis z.
    axis: Vector3<f64>,
    /// Whether the tool only rises or dives.
    vertical: bool,
    /// Whether it stays at its height.
    level: bool,
}

impl Across {
    /// At a place with the tangent `t`; `left` is y where the tool only rises or dives.
    pub(super) fn of(t: &Vector3<f64>, axis: &Vector3<f64>, left: &Vector3<f64>) -> Self {
        let y = axis.cross(t).try_normalize(NONE);
        let vertical = y.is_none();
        let y = y.unwrap_or(*left);
        Self { directions: [*t, y, t.cross(&y)], axis: *axis, vertical, level: t.dot(axis).abs() < NONE }
    }

    /// The facet's normal into the material.
    pub(super) fn normal(&self, facet: &Facet) -> Vector3<f64> {
        let [t, y, w] = &self.directions;
        t * facet.normal[0] + y * facet.normal[1] + w * facet.normal[2]
    }

    /// From the tip to the facet [m], at a contact; `None` if the tool does not cut it there.
    pub(super) fn place(&self, facet: &Facet, cutter: &Cutter, contact: &Contact) -> Option<Vector3<f64>> {
        if contact.is_air() {
            return None;
        }
        let flat = cutter.radius - cutter.corner;
        let normal = self.normal(facet);
        let off_axis = normal - self.axis * self.axis.dot(&normal);
        let round =
            || off_axis.try_normalize(NONE).unwrap_or_default() * flat + (normal + self.axis) * cutter.corner;
        let side = facet.normal[1];
        match facet.kind {
            // Around the hole of a plunge, at the lower end of the cylinder.
            SurfaceKind::Wall if self.vertical => {
                (facet.share == LOW).then(|| normal * cutter.radius + self.axis * cutter.corner)
            }
            _ if self.vertical || (facet.kind == SurfaceKind::Wall && side == 0.0) => None,
            SurfaceKind::Wall => {
                let (low, high) = beside(contact, side, cutter.corner)?;
                let height = low + (high - low) * facet.share;
                Some(normal * cutter.radius + self.axis * height)
            }
            SurfaceKind::Floor if self.level && flat > NONE * cutter.radius => {
                let left = flat * facet.share;
                is_below(contact, cutter, left).then(|| self.directions[1] * left)
            }
            SurfaceKind::Floor => (facet.share == 0.0).then(round),
            SurfaceKind::Corner if cutter.corner == 0.0 => None,
            SurfaceKind::Corner => {
                let place = round();
                let height = self.axis.dot(&place);
                let here = |arc: &&SideArc| arc.from <= height && height <= arc.to && reaches(arc, side);
                // Where the tool climbs or dives, its corner cuts before and behind these points.
                (!self.level || contact.sides.iter().any(|arc| here(&arc))).then_some(place)
            }
        }
    }
}

/// Whether an arc reaches the edge at the left (`side` above 0) or right of the feed.
fn reaches(arc: &SideArc, side: f64) -> bool {
    if side > 0.0 { arc.entry <= REACHES } else { arc.entry <= PI && arc.exit >= PI - REACHES }
}

/// Lowest and highest place above the corner where the contact reaches that edge [m].
fn beside(contact: &Contact, side: f64, corner: f64) -> Option<(f64, f64)> {
    let arcs = contact.sides.iter().filter(|arc| arc.to > corner && reaches(arc, side));
    let heights = arcs.map(|arc| (arc.from.max(corner), arc.to));
    heights.reduce(|(low, high), (from, to)| (low.min(from), high.max(to)))
}

/// Whether there is material in the way of the bottom's edge at a distance left of the axis [m].
fn is_below(contact: &Contact, cutter: &Cutter, left: f64) -> bool {
    let lowest = contact.sides.iter().take_while(|arc| arc.from <= NONE);
    let reaches = |arc: &SideArc| {
        let radius = cutter.radius_at((arc.from + arc.to) / 2.0);
        let angle = math::acos((left / radius).clamp(-1.0, 1.0));
        arc.entry - REACHES <= angle && angle <= arc.exit + REACHES
    };
    lowest.into_iter().any(reaches)
}

/// Numbers of the facets in a set.
pub(super) fn members(set: FacetSet) -> impl Iterator<Item = usize> {
    (0..FACETS.len()).filter(move |k| set & (1 << k) != 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_unit_vectors() {
        for facet in FACETS {
            let [a, b, c] = facet.normal;
            assert!((a * a + b * b + c * c - 1.0).abs() < 1e-15, "{facet:?}");
        }
        assert!((math::cos(PI / 8.0) - COS).abs() < 1e-15);
    }
}
