//! The solid that a program starts from.

use crate::math;
use crate::stock::circle::{HalfCircle, Region};
use nalgebra::{Vector2, Vector3};

/// The outline of a solid seen along the tool axis [m].
#[derive(Debug, Clone, PartialEq)]
pub enum Outline {
    /// A circle.
    Circle {
        /// Centre [m].
        center: Vector2<f64>,
        /// Radius [m].
        radius: f64,
    },
    /// A polygon; the last corner is joined to the first.
    Polygon(Vec<Vector2<f64>>),
}

/// A prism along the tool axis, in the workpiece frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Solid {
    /// Its outline.
    pub outline: Outline,
    /// Height of its bottom [m].
    pub bottom: f64,
    /// Height of its top [m].
    pub top: f64,
    /// Triangles whose upper side is its top instead, within the outline; none of a prism [m].
    pub relief: Vec<[Vector3<f64>; 3]>,
}

impl Solid {
    /// A prism over an outline between two heights [m].
    pub fn prism(outline: Outline, bottom: f64, top: f64) -> Self {
        Self { outline, bottom, top, relief: Vec::new() }
    }

    /// The solid under the upper side of a mesh [m], down to its lowest point; `None` without volume.
    pub fn under(relief: Vec<[Vector3<f64>; 3]>) -> Option<Self> {
        let corners = || relief.iter().flatten();
        let low = corners().copied().reduce(|low, corner| low.inf(&corner))?;
        let high = corners().copied().reduce(|high, corner| high.sup(&corner))?;
        let outline = Outline::rectangle(low.xy(), high.xy());
        let size = high - low;
        (size.min() > 0.0).then_some(Self { outline, bottom: low.z, top: high.z, relief })
    }
}

impl Outline {
    /// A rectangle between two corners [m].
    pub fn rectangle(from: Vector2<f64>, to: Vector2<f64>) -> Self {
        Self::Polygon(vec![from, Vector2::new(to.x, from.y), to, Vector2::new(from.x, to.y)])
    }

    /// Smallest box that holds it: lower and upper corner [m].
    pub fn bounds(&self) -> [Vector2<f64>; 2] {
        match self {
            Self::Circle { center, radius } => {
                [center - Vector2::repeat(*radius), center + Vector2::repeat(*radius)]
            }
            Self::Polygon(corners) => {
                let none = [Vector2::repeat(f64::INFINITY), Vector2::repeat(f64::NEG_INFINITY)];
                corners.iter().fold(none, |[low, high], corner| [low.inf(corner), high.sup(corner)])
            }
        }
    }

    /// Its corners in order [m]; a circle is given as many, evenly spaced.
    pub fn corners(&self, count: usize) -> Vec<Vector2<f64>> {
        match self {
            Self::Circle { center, radius } => (0..count)
                .map(|i| {
                    let (sine, cosine) = math::sin_cos(std::f64::consts::TAU * i as f64 / count as f64);
                    center + Vector2::new(cosine, sine) * *radius
                })
                .collect(),
            Self::Polygon(corners) => corners.clone(),
        }
    }

    /// Its area [m^2].
    pub fn area(&self) -> f64 {
        match self {
            Self::Circle { radius, .. } => std::f64::consts::PI * radius * radius,
            Self::Polygon(_) => self.edges().map(|(from, to)| from.perp(&to)).sum::<f64>().abs() / 2.0,
        }
    }

    /// The edges of a polygon.
    fn edges(&self) -> impl Iterator<Item = (Vector2<f64>, Vector2<f64>)> + '_ {
        let corners: &[_] = match self {
            Self::Circle { .. } => &[],
            Self::Polygon(corners) => corners,
        };
        corners.iter().copied().zip(corners.iter().copied().cycle().skip(1))
    }
}

impl Region for Outline {
    fn holds(&self, point: &Vector2<f64>) -> bool {
        if let Self::Circle { center, radius } = self {
            return (point - center).norm_squared() < radius * radius;
        }
        // A ray along +x crosses the border an odd number of times.
        let crosses = |(from, to): &(Vector2<f64>, Vector2<f64>)| {
            (from.y > point.y) != (to.y > point.y)
                && point.x < from.x + (to.x - from.x) * (point.y - from.y) / (to.y - from.y)
        };
        self.edges().filter(crosses).count() % 2 == 1
    }

    fn meet(&self, half: &HalfCircle, places: &mut Vec<f64>) {
        if let Self::Circle { center, radius } = self {
            half.meet_circle(center, *radius, places);
        }
        for (from, to) in self.edges() {
            if let Some(along) = (to - from).try_normalize(0.0) {
                half.meet_line(&from, &along, places);
            }
        }
    }
}
