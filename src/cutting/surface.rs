//! The force at the instants when the edge generates the finished wall.
//!
//! The force varies within a revolution. The edge that passes a point of the wall last, at 0 or 180
//! deg of immersion, leaves it, so the tool's position at that instant determines the wall (W.
//! Kline, R. DeVor, I. Shareef, The Prediction of Surface Accuracy in End Milling, ASME J. Eng.
//! Ind. 104 (1982); Altintas 2012, section 2.10). With a helix, every height has its own instant.

use crate::cutting::{Cut, LinearForce};

/// A wall and the forces at its generation.
#[derive(Debug, Clone, PartialEq)]
pub struct Wall {
    /// Direction from the tool into the part along y of {T}: 1 is left of the feed, -1 right of it.
    pub side: f64,
    /// Force on the tool when the edge passes the wall, at even heights from the tip up.
    pub instants: Vec<LinearForce>,
}

/// Number of heights at which the wall is evaluated.
const HEIGHTS: usize = 24;

impl Cut {
    /// The walls that the engagement leaves, above the corner if the cut is deeper than that.
    /// Runout is ignored.
    pub fn walls(&self) -> Vec<Wall> {
        let from = if self.axial_depth > self.corner_radius { self.corner_radius } else { 0.0 };
        let slices = self.coarse();
        let walls = self.engagement.walls(self.radius());
        let wall = |angle: f64| {
            let at = |k: usize| from + (self.axial_depth - from) * (k as f64 + 0.5) / HEIGHTS as f64;
            let instants = (0..HEIGHTS).map(|k| self.instant(&slices, angle + self.lag() * at(k)));
            Wall { side: if angle > 1.0 { -1.0 } else { 1.0 }, instants: instants.collect() }
        };
        walls.into_iter().map(wall).collect()
    }
}
