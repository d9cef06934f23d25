//! Where: the desired path as lines and arcs, with the tool axis along it.
//!
//! A [`Path`] is drawn in the workpiece frame and then [placed](Path::placed) in the base frame; its parameter is the arc length.

pub mod segment;
pub mod shape;
pub mod program;
pub mod unit;
mod draft;
pub mod gcode;
pub mod apt;
pub mod csv;

pub use segment::Segment;

use crate::math::{self, Pose};
use nalgebra::{Matrix3, Vector3};

/// A chain of segments with its running arc length and the tool's orientation.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    segments: Vec<Segment>,
    /// Arc length at the start of each segment, and at the end of the last [m].
    starts: Vec<f64>,
    tool_axis: Vector3<f64>,
    x_reference: Vector3<f64>,
}

/// The point of a path closest to another point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closest {
    /// Arc length [m]; below 0 or beyond the length where a closed path was searched across its seam.
    pub s: f64,
    /// The point [m].
    pub point: Vector3<f64>,
}

/// Ends that are nearer than this are the same point [m].
const SEAM: f64 = 1e-9;

impl Path {
    /// A path of segments that follow each other, with the tool upright (axis +Z, from tip to spindle).
    ///
    /// Segments without length are dropped. `None` if nothing is left.
    pub fn new(segments: Vec<Segment>) -> Option<Self> {
        let segments: Vec<Segment> = segments.into_iter().filter(|segment| segment.length() > SEAM).collect();
        if segments.is_empty() {
            return None;
        }
        let mut starts = Vec::with_capacity(segments.len() + 1);
        let mut s = 0.0;
        for segment in &segments {
            starts.push(s);
            s += segment.length();
        }
        starts.push(s);
        Some(Self { segments, starts, tool_axis: Vector3::z(), x_reference: Vector3::x() })
    }

    /// The same path seen from outside the frame it is drawn in.
    pub fn placed(&self, frame: &Pose) -> Self {
        Self {
            segments: self.segments.iter().map(|segment| segment.placed(frame)).collect(),
            starts: self.starts.clone(),
            tool_axis: frame.direction(&self.tool_axis),
            x_reference: frame.direction(&self.x_reference),
        }
    }

    /// The segments in order.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Length along the path [m].
    pub fn length(&self) -> f64 {
        self.starts[self.segments.len()]
    }

    /// Whether the path ends where it starts.
    pub fn is_closed(&self) -> bool {
        (self.point(0.0) - self.point(self.length())).norm() < SEAM
    }

    /// Unit vector from the tool's tip to the spindle (I, J, K).
    pub fn tool_axis(&self) -> Vector3<f64> {
        self.tool_axis
    }

    /// Orientation of the TCP along the path: z = approach (against the tool axis), x = workpiece +X projected across it.
    pub fn tool_orientation(&self) -> Matrix3<f64> {
        let z = -self.tool_axis;
        let x = math::across(&z, &self.x_reference, &self.tool_axis.cross(&self.x_reference));
        Matrix3::from_columns(&[x, z.cross(&x), z])
    }

    /// The segment that holds the arc length `s` [m], and the arc length within it; ends belong to the segment that starts there.
    fn locate(&self, s: f64) -> (usize, f64) {
        let after = self.starts.partition_point(|&start| start <= s);
        let index = after.saturating_sub(1).min(self.segments.len() - 1);
        (index, (s - self.starts[index]).clamp(0.0, self.segments[index].length()))
    }

    /// The point at the arc length `s` [m], limited to the path.
    pub fn point(&self, s: f64) -> Vector3<f64> {
        let (index, within) = self.locate(s);
        self.segments[index].point(within)
    }

    /// Unit tangent at the arc length `s` [m]; at a corner that of the segment that starts there.
    pub fn tangent(&self, s: f64) -> Vector3<f64> {
        let (index, within) = self.locate(s);
        self.segments[index].tangent(within)
    }

    /// Arc length [m], angle [rad] and the two tangents of every junction of segments, the seam of a closed path left out.
    pub fn corners(&self) -> impl Iterator<Item = Corner> {
        self.segments.windows(2).zip(&self.starts[1..]).map(|(pair, &s)| {
            let before = pair[0].tangent(pair[0].length());
            let after = pair[1].tangent(0.0);
            Corner { s, angle: math::angle_between(&before, &after), before, after }
        })
    }

    /// The point of the path closest to `p`, searched over arc lengths within `radius` of `near` [m] (eq. 5.2).
    ///
    /// The search is local so that a path that crosses itself is never matched to the wrong branch, exact
    /// on the path's own lines and arcs, and runs across the seam of a closed path. Among equals the one nearest to `near` wins.
    pub fn closest(&self, p: &Vector3<f64>, near: f64, radius: f64) -> Closest {
        let length = self.length();
        let mut best: Option<(f64, Closest)> = None;
        let mut search = |low: f64, high: f64, shift: f64| {
            let (mut index, _) = self.locate(low);
            while index < self.segments.len() && self.starts[index] <= high {
                let segment = &self.segments[index];
                let start = self.starts[index];
                let (from, to) = ((low - start).max(0.0), (high - start).min(segment.length()));
                let within = segment.closest(p, from.min(to), to);
                let point = segment.point(within);
                let candidate = Closest { s: start + within + shift, point };
                let distance = (p - point).norm_squared();
                let better = best.is_none_or(|(least, so_far)| {
                    distance < least
                        || (distance == least && (candidate.s - near).abs() < (so_far.s - near).abs())
                });
                if better {
                    best = Some((distance, candidate));
                }
                index += 1;
            }
        };
        let radius = radius.min(length / 2.0);
        let (low, high) = (near - radius, near + radius);
        search(low.clamp(0.0, length), high.clamp(0.0, length), 0.0);
        if (low < 0.0 || high > length) && self.is_closed() {
            if low < 0.0 {
                search(low + length, length, -length);
            }
            if high > length {
                search(0.0, high - length, length);
            }
        }
        best.map_or(Closest { s: near, point: self.point(near) }, |(_, closest)| closest)
    }
}

/// A junction of two segments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Arc length [m].
    pub s: f64,
    /// Angle between the tangents [rad].
    pub angle: f64,
    /// Unit tangent before it.
    pub before: Vector3<f64>,
    /// Unit tangent after it.
    pub after: Vector3<f64>,
}
