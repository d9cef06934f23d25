//! Where: the desired path as lines and arcs, with the tool axis along it.
//!
//! A [`Path`] is built from shapes or from a [`program`] in the workpiece frame, then
//! [placed](Path::placed) in the base frame. It is parametrized by arc length.

pub mod segment;
pub mod shape;
pub mod axes;
pub mod reference;
pub mod roll;
pub mod program;
pub mod unit;
mod pieces;
mod lines;
mod builder;
pub mod gcode;
pub mod apt;
pub mod csv;

pub use axes::{Axes, AxisArc};
pub use pieces::Piece;
pub use program::{Move, MovePace, Program, Remark, SourceProgram, Tool};
pub use reference::{RollReference, RollZero};
pub use roll::Roll;
pub use segment::Segment;

use crate::math::{self, Pose};
use nalgebra::{Matrix3, Vector3};
use std::sync::Arc;

/// A chain of moves with cumulative arc length. Clones share the moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    moves: Arc<[Move]>,
    /// Arc length at the start of each move, and at the end of the last [m].
    starts: Arc<[f64]>,
    waits: Arc<[Wait]>,
    /// The workpiece's x and y axes: an axis that is reversed within a move goes by one of them.
    ways: [Vector3<f64>; 2],
    reference: RollReference,
    roll: Roll,
}

/// A wait in a program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wait {
    /// Arc length [m].
    pub s: f64,
    /// Duration [s].
    pub time: f64,
}

/// The point on a path closest to another point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closest {
    /// Arc length [m]. On a closed path searched across its seam, it may be below 0 or beyond the
    /// length.
    pub s: f64,
    /// The point [m].
    pub point: Vector3<f64>,
}

impl Closest {
    /// Its arc length on the path itself, in [0, length] [m].
    pub fn s_on(&self, path: &Path) -> f64 {
        let length = path.length();
        match self.s {
            s if s < 0.0 => s + length,
            s if s > length => s - length,
            s => s,
        }
    }
}

/// Ends closer than this are the same point [m].
const SEAM: f64 = 1e-9;

impl Path {
    /// A path through consecutive segments, cut at the job's feed with the tool upright (axis +Z,
    /// from tip to spindle).
    ///
    /// Segments of zero length are dropped; `None` if none are left.
    pub fn new(segments: Vec<Segment>) -> Option<Self> {
        let up = Vector3::z();
        let cut = |segment| Move {
            segment,
            axis_from: up,
            axis_to: up,
            pace: MovePace::JobFeed,
            spindle: None,
            line: 0,
        };
        Self::of_program(&Program { moves: segments.into_iter().map(cut).collect(), ..Program::default() })
    }

    /// The path of a program. Moves of zero length are dropped; `None` if none are left.
    pub fn of_program(program: &Program) -> Option<Self> {
        let mut moves = Vec::with_capacity(program.moves.len());
        let mut starts = Vec::with_capacity(program.moves.len() + 1);
        let mut waits = Vec::new();
        let mut dwells = program.dwells.iter().peekable();
        let mut s = 0.0;
        for (index, step) in program.moves.iter().enumerate() {
            while let Some(dwell) = dwells.next_if(|dwell| dwell.after <= index) {
                waits.push(Wait { s, time: dwell.time });
            }
            let length = step.segment.length();
            if length > SEAM {
                moves.push(*step);
                starts.push(s);
                s += length;
            }
        }
        starts.push(s);
        waits.extend(dwells.map(|dwell| Wait { s, time: dwell.time }));
        (!moves.is_empty()).then(|| Self {
            reference: RollReference::chosen(&moves),
            moves: moves.into(),
            starts: starts.into(),
            waits: waits.into(),
            ways: [Vector3::x(), Vector3::y()],
            roll: Roll::fixed(0.0),
        })
    }

    /// The path, expressed in the frame in which `frame` is given.
    pub fn placed(&self, frame: &Pose) -> Self {
        let place = |step: &Move| Move {
            segment: step.segment.placed(frame),
            axis_from: frame.direction(&step.axis_from),
            axis_to: frame.direction(&step.axis_to),
            ..*step
        };
        Self {
            moves: self.moves.iter().map(place).collect(),
            ways: self.ways.map(|way| frame.direction(&way)),
            reference: self.reference.placed(frame),
            ..self.clone()
        }
    }

    /// The path with the TCP rotated about the tool axis.
    pub fn with_roll(self, roll: Roll) -> Self {
        Self { roll, ..self }
    }

    /// The path, in the workpiece frame, with the roll counted from a direction in that frame.
    pub fn with_reference(self, direction: &Vector3<f64>) -> Self {
        Self { reference: RollReference::Set(RollZero::along(direction)), ..self }
    }

    /// The path with the roll of `other`, matched at the same fraction of the length. If `other`
    /// carries its roll along, this path carries its own.
    pub fn rolled_as(self, other: &Path) -> Self {
        let roll = other.roll.stretched(self.length() / other.length());
        let reference = match &other.reference {
            RollReference::Carried(starts) => RollReference::carried(&self.moves, starts[0], &self.ways),
            zero => zero.clone(),
        };
        Self { reference, ..self }.with_roll(roll)
    }

    /// The moves in order; all have a length above 0.
    pub fn moves(&self) -> &[Move] {
        &self.moves
    }

    /// Arc length at the start of the move `index` [m].
    pub fn start(&self, index: usize) -> f64 {
        self.starts[index]
    }

    /// The program's waits, in order.
    pub fn waits(&self) -> &[Wait] {
        &self.waits
    }

    /// Length along the path [m].
    pub fn length(&self) -> f64 {
        self.starts[self.moves.len()]
    }

    /// Whether the tool axis changes along the path.
    pub fn is_multi_axis(&self) -> bool {
        let first = self.moves[0].axis_from;
        self.moves
            .iter()
            .any(|step| (step.axis_from - first).norm() > 1e-9 || (step.axis_to - first).norm() > 1e-9)
    }

    /// Whether the path ends where it starts.
    pub fn is_closed(&self) -> bool {
        (self.point(0.0) - self.point(self.length())).norm() < SEAM
    }

    /// Unit vector from the tool tip to the spindle (I, J, K) at the arc length `s` [m]. It turns
    /// at a constant rate along each move.
    pub fn axis(&self, s: f64) -> Vector3<f64> {
        self.axis_at(self.locate(s))
    }

    /// The tool axis at a place returned by [`Path::locate`].
    pub(crate) fn axis_at(&self, (index, within): (usize, f64)) -> Vector3<f64> {
        let Move { segment, axis_from, axis_to, .. } = &self.moves[index];
        if axis_from == axis_to {
            return *axis_from;
        }
        let arc = AxisArc::by(axis_from, axis_to, &self.ways);
        arc.at(arc.angle() * within / segment.length())
    }

    /// The least angle between the tool axis and either way along a direction [rad], in [0, pi/2],
    /// and the index of the move where it is met.
    pub fn clearance(&self, direction: &Vector3<f64>) -> (f64, usize) {
        reference::clearance(&self.moves, direction)
    }

    /// Rotation of the TCP about the tool axis at the arc length `s` [m], in rad, counter-clockwise
    /// seen from the spindle.
    pub fn roll(&self, s: f64) -> f64 {
        self.roll.at(s)
    }

    /// What the TCP's x axis follows.
    pub fn roll_reference(&self) -> &RollReference {
        &self.reference
    }

    /// Where the roll is zero at the arc length `s` [m].
    pub fn roll_zero(&self, s: f64) -> RollZero {
        match &self.reference {
            RollReference::Chosen(_, zero) | RollReference::Set(zero) => *zero,
            RollReference::Carried(starts) => {
                let (index, within) = self.locate(s);
                let Move { segment, axis_from, axis_to, .. } = &self.moves[index];
                let arc = AxisArc::by(axis_from, axis_to, &self.ways);
                let x = arc.carried(&starts[index], arc.angle() * within / segment.length());
                RollZero::of_x_axis(&x)
            }
        }
    }

    /// How far the TCP arrives turned about the tool axis because its x axis is carried along [rad],
    /// in (-pi, pi]: against the start, by the direct way from the last tool axis to the first.
    /// `None` if it is not carried.
    pub fn carried_turn(&self) -> Option<f64> {
        let RollReference::Carried(starts) = &self.reference else { return None };
        let (first, last) = (self.moves[0].axis_from, self.moves[self.moves.len() - 1].axis_to);
        let arrived = self.roll_zero(self.length()).x_axis(&last);
        let arrived = AxisArc::by(&last, &first, &self.ways).carried_to_its_end(&arrived);
        let start = starts[0];
        Some(math::atan2(first.dot(&start.cross(&arrived)), start.dot(&arrived)))
    }

    /// A direction across a tool axis, for where the feed gives none: the TCP's x axis at the
    /// start, without roll.
    pub fn reference(&self, axis: &Vector3<f64>) -> Vector3<f64> {
        self.roll_zero(0.0).x_axis(axis)
    }

    /// Orientation of the TCP at the arc length `s` [m] for a tool axis there: z = approach
    /// (against the axis), x = that of zero roll, rotated by `roll` [rad].
    pub fn orientation(&self, s: f64, axis: &Vector3<f64>, roll: f64) -> Matrix3<f64> {
        self.roll_zero(s).orientation(axis, roll)
    }

    /// The move at the arc length `s` [m], and the arc length within it. A junction belongs to the
    /// move that starts there.
    pub(crate) fn locate(&self, s: f64) -> (usize, f64) {
        let after = self.starts.partition_point(|&start| start <= s);
        self.within(after.saturating_sub(1).min(self.moves.len() - 1), s)
    }

    /// [`Path::locate`], trying the move `near` first: trajectories advance from one move to the
    /// next.
    pub(crate) fn locate_near(&self, s: f64, near: usize) -> (usize, f64) {
        let last = self.moves.len() - 1;
        let holds = |index: usize| self.starts[index] <= s && (index == last || s < self.starts[index + 1]);
        if near <= last && holds(near) { self.within(near, s) } else { self.locate(s) }
    }

    /// The place at the arc length `s` [m] in the move `index`.
    pub(crate) fn within(&self, index: usize, s: f64) -> (usize, f64) {
        (index, (s - self.starts[index]).clamp(0.0, self.moves[index].segment.length()))
    }

    /// The point at a place returned by [`Path::locate`].
    pub(crate) fn point_at(&self, (index, within): (usize, f64)) -> Vector3<f64> {
        self.moves[index].segment.point(within)
    }

    /// The point at the arc length `s` [m], clamped to the path.
    pub fn point(&self, s: f64) -> Vector3<f64> {
        self.point_at(self.locate(s))
    }

    /// Unit tangent at the arc length `s` [m]; at a corner, that of the segment that starts there.
    pub fn tangent(&self, s: f64) -> Vector3<f64> {
        let (index, within) = self.locate(s);
        self.moves[index].segment.tangent(within)
    }

    /// Every junction of segments except the seam of a closed path.
    pub fn corners(&self) -> impl Iterator<Item = Corner> {
        self.moves.windows(2).zip(&self.starts[1..]).map(|(pair, &s)| {
            let before = pair[0].segment.tangent(pair[0].segment.length());
            let after = pair[1].segment.tangent(0.0);
            Corner { s, angle: math::angle_between(&before, &after), before, after }
        })
    }

    /// The point on the path closest to `p`, searched over arc lengths within `radius` of `near`
    /// [m] (eq. 5.2).
    ///
    /// The search is local, so a path that crosses itself is never matched to the wrong branch. It
    /// is exact on lines and arcs, and crosses the seam of a closed path. In a tie, the point
    /// nearest to `near` wins. Segments that are too far away are left out: over an arc length, a
    /// distance changes by at most as much.
    pub fn closest(&self, p: &Vector3<f64>, near: f64, radius: f64) -> Closest {
        /// Segments, from which on leaving some out is faster.
        const MANY: usize = 32;
        let length = self.length();
        let mut best: Option<(f64, Closest)> = None;
        let radius = radius.min(length / 2.0);
        let (low, high) = (near - radius, near + radius);
        let mut search = |low: f64, high: f64, shift: f64| {
            let (mut index, _) = self.locate(low);
            let many = self.starts.get(index + MANY).is_some_and(|&start| start <= high);
            let reached = if many { self.reached(p, near, (low, high)) } else { f64::INFINITY };
            while index < self.moves.len() && self.starts[index] <= high {
                let segment = &self.moves[index].segment;
                let start = self.starts[index];
                if many {
                    let least = best.map_or(reached, |(least, _)| reached.min(least.sqrt()));
                    let next = self.close_enough(p, index, least);
                    if next > index {
                        index = next;
                        continue;
                    }
                }
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

    /// The first move, from `index` on, that may come as close to `p` as `least` [m].
    fn close_enough(&self, p: &Vector3<f64>, index: usize, least: f64) -> usize {
        /// Far more than rounding changes a distance [m].
        const MARGIN: f64 = 1e-9;
        let (start, segment) = (self.starts[index], &self.moves[index].segment);
        let too_far_before = start + (p - segment.point(0.0)).norm() - least - MARGIN;
        if start + segment.length() < too_far_before {
            self.locate(too_far_before).0.max(index + 1)
        } else {
            index
        }
    }

    /// A distance [m] from `p` that some point between two arc lengths [m] keeps: found by a few steps
    /// along the tangent.
    fn reached(&self, p: &Vector3<f64>, near: f64, (low, high): (f64, f64)) -> f64 {
        let mut least = f64::INFINITY;
        let mut s = near.max(low).min(high);
        for _ in 0..3 {
            let away = p - self.point(s);
            least = least.min(away.norm());
            s = (s + away.dot(&self.tangent(s))).max(low).min(high);
        }
        least
    }
}

/// A junction of two segments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Arc length [m].
    pub s: f64,
    /// Angle between the tangents [rad].
    pub angle: f64,
    /// Unit tangent before the corner.
    pub before: Vector3<f64>,
    /// Unit tangent after the corner.
    pub after: Vector3<f64>,
}
