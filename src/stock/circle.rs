//! The half of a circle about the tool axis that lies ahead, and the parts of it that are in
//! material.
//!
//! With the feed d and its left hand l, the point at the immersion angle phi is p + r (d sin phi + l
//! cos phi). Places on the half are counted by c = -cos phi, from -1 at the left to 1 at the right:
//! r times a difference of c is the radial depth, and no angle is needed until the end.

use crate::math;
use nalgebra::Vector2;

/// The half of a circle ahead of its centre.
#[derive(Debug, Clone, Copy)]
pub(super) struct HalfCircle {
    /// Centre [m].
    pub(super) center: Vector2<f64>,
    /// Radius [m].
    pub(super) radius: f64,
    /// Unit vector ahead.
    pub(super) ahead: Vector2<f64>,
}

/// A vector turned left by a right angle.
pub(super) fn left_of(v: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-v.y, v.x)
}

/// Immersion angle [rad] at the place c.
pub(super) fn immersion(c: f64) -> f64 {
    math::acos((-c).clamp(-1.0, 1.0))
}

impl HalfCircle {
    /// The point at the place `c` [m].
    pub(super) fn point(&self, c: f64) -> Vector2<f64> {
        let along = (1.0 - c * c).max(0.0).sqrt();
        self.center + (self.ahead * along - left_of(&self.ahead) * c) * self.radius
    }

    /// The place of a point of the circle, given by its offset from the centre [m]; `None` behind.
    fn place(&self, offset: &Vector2<f64>) -> Option<f64> {
        (offset.dot(&self.ahead) > 0.0)
            .then(|| (-offset.dot(&left_of(&self.ahead)) / self.radius).clamp(-1.0, 1.0))
    }

    /// The half behind.
    pub(super) fn behind(&self) -> Self {
        Self { ahead: -self.ahead, ..*self }
    }

    /// Adds the places where the circle meets a straight line through `on` along the unit vector
    /// `along`.
    pub(super) fn meet_line(&self, on: &Vector2<f64>, along: &Vector2<f64>, places: &mut Vec<f64>) {
        let normal = left_of(along);
        let beside = (on - self.center).dot(&normal);
        let square = self.radius * self.radius - beside * beside;
        if square > 0.0 {
            let half = along * square.sqrt();
            let foot = normal * beside;
            places.extend([foot + half, foot - half].iter().filter_map(|offset| self.place(offset)));
        }
    }

    /// Adds the places where the circle meets another one.
    pub(super) fn meet_circle(&self, center: &Vector2<f64>, radius: f64, places: &mut Vec<f64>) {
        let between = center - self.center;
        let square = between.norm_squared();
        if square == 0.0 {
            return;
        }
        // The chord's distance from the centre, in parts of the distance of the centres.
        let part = (square + self.radius * self.radius - radius * radius) / (2.0 * square);
        let rest = self.radius * self.radius - part * part * square;
        if rest > 0.0 {
            let foot = between * part;
            let half = left_of(&between) * (rest / square).sqrt();
            places.extend([foot + half, foot - half].iter().filter_map(|offset| self.place(offset)));
        }
    }
}

/// ArcParts of a half circle, as rising and separate ranges of places.
#[derive(Debug, Clone, Default)]
pub(super) struct ArcParts {
    ranges: Vec<(f64, f64)>,
    /// A disc around each range: centre and radius [m].
    discs: Vec<(Vector2<f64>, f64)>,
    spare: Vec<(f64, f64)>,
    places: Vec<f64>,
}

/// A region of the plane that a circle is compared with.
pub(super) trait Region {
    /// Whether a point is in it.
    fn holds(&self, point: &Vector2<f64>) -> bool;
    /// Adds all places where the half circle crosses its border, perhaps with others.
    fn meet(&self, half: &HalfCircle, places: &mut Vec<f64>);
}

impl ArcParts {
    /// The whole half.
    pub(super) fn fill(&mut self, half: &HalfCircle) {
        self.fill_range(half, (-1.0, 1.0));
    }

    /// One range of it.
    pub(super) fn fill_range(&mut self, half: &HalfCircle, range: (f64, f64)) {
        self.ranges.clear();
        self.ranges.push(range);
        self.surround(half);
    }

    /// Finds the disc around each range.
    fn surround(&mut self, half: &HalfCircle) {
        self.discs.clear();
        self.discs.extend(self.ranges.iter().map(|&(from, to)| {
            let middle = half.point((from + to) / 2.0);
            let span = |c: f64| (half.point(c) - middle).norm_squared();
            (middle, span(from).max(span(to)).sqrt())
        }));
    }

    /// Whether nothing is left.
    pub(super) fn is_empty(&self) -> bool {
        self.ranges.is_empty()
    }

    /// The ranges.
    pub(super) fn ranges(&self) -> &[(f64, f64)] {
        &self.ranges
    }

    /// Removes what lies in a region; `near` says whether it comes within a distance [m] of a point.
    pub(super) fn subtract(
        &mut self,
        half: &HalfCircle,
        region: &impl Region,
        near: impl Fn(&Vector2<f64>, f64) -> bool,
    ) {
        if self.discs.iter().any(|(middle, span)| near(middle, *span)) {
            self.keep(half, region, false);
        }
    }

    /// Keeps what lies in a region, or out of it.
    pub(super) fn keep(&mut self, half: &HalfCircle, region: &impl Region, inside: bool) {
        self.places.clear();
        region.meet(half, &mut self.places);
        self.places.sort_unstable_by(f64::total_cmp);
        self.spare.clear();
        for &(from, to) in &self.ranges {
            let mut begin = from;
            let within = self.places.iter().filter(|&&c| c > from && c < to);
            for &end in within.chain([&to]) {
                if region.holds(&half.point((begin + end) / 2.0)) == inside {
                    match self.spare.last_mut() {
                        Some(last) if last.1 == begin && begin > from => last.1 = end,
                        _ => self.spare.push((begin, end)),
                    }
                }
                begin = end;
            }
        }
        if self.ranges != self.spare {
            std::mem::swap(&mut self.ranges, &mut self.spare);
            self.surround(half);
        }
    }
}
