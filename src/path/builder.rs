//! Builds a program move by move, for the readers of APT and CSV.

use crate::error::Error;
use crate::math::{self, PI, TAU};
use crate::path::Segment;
use crate::path::program::{Move, MovePace, Program, Remark};
use crate::units::{DEG, MM};
use nalgebra::Vector3;

/// Points closer than this are the same point [m].
const SAME: f64 = 1e-9;
/// Directions closer than this are the same direction [rad].
const SAME_DIRECTION: f64 = 1e-9;
/// Largest coordinate accepted [m].
const FARTHEST: f64 = 1e3;
/// Range of accepted feeds [mm/s].
const FEEDS: [f64; 2] = [1e-3, 1e5];
/// Range of accepted spindle speeds [rev/min].
pub(super) const SPINDLE: std::ops::RangeInclusive<f64> = 1.0..=1e6;
/// Longest wait accepted [s].
pub(super) const LONGEST_WAIT: f64 = 3600.0;
/// How far the ends of an arc may lie off its circle [m].
const ARC_TOLERANCE: f64 = 0.01 * MM;

/// An error without its place in the text.
pub(super) struct Fault {
    pub(super) found: String,
    pub(super) expected: String,
}

impl Fault {
    pub(super) fn new(found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { found: found.into(), expected: expected.into() }
    }

    /// The error at a line and column (from 1) of the text in `field`.
    pub(super) fn at(self, field: &str, (line, column): (usize, usize)) -> Error {
        Error::Text { field: field.into(), line, column, found: self.found, expected: self.expected }
    }
}

/// The circle of an arc, traversed counter-clockwise about its axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Circle {
    /// Centre [m].
    pub(super) center: Vector3<f64>,
    /// Unit vector.
    pub(super) axis: Vector3<f64>,
    /// Radius as written [m].
    pub(super) radius: f64,
    /// Angle as written [rad]; it determines the number of full turns.
    pub(super) sweep: Option<f64>,
}

impl Circle {
    /// Whether the point lies on the circle, within the tolerance of an arc.
    pub(super) fn passes(&self, point: &Vector3<f64>) -> bool {
        let offset = point - self.center;
        let height = offset.dot(&self.axis);
        height.abs() <= ARC_TOLERANCE
            && ((offset - self.axis * height).norm() - self.radius).abs() <= ARC_TOLERANCE
    }
}

/// End point of a move, its pace and spindle speed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Target {
    /// End of the move [m].
    pub(super) point: Vector3<f64>,
    /// Unit vector from tip to spindle at the end.
    pub(super) axis: Vector3<f64>,
    pub(super) pace: MovePace,
    pub(super) spindle: Option<f64>,
    /// Line of the text, from 1.
    pub(super) line: usize,
}

/// The moves read so far, and the current tool pose.
#[derive(Default)]
pub(super) struct ProgramBuilder {
    pub(super) program: Program,
    /// Tip [m] and unit axis.
    pub(super) pose: Option<(Vector3<f64>, Vector3<f64>)>,
    /// How often each remark occurred.
    counts: Vec<usize>,
}

impl ProgramBuilder {
    /// Records a remark at the first line that causes it, and counts the others.
    pub(super) fn remark(&mut self, code: &'static str, line: usize, message: impl FnOnce() -> String) {
        if let Some(index) = self.program.remarks.iter().position(|remark| remark.code == code) {
            self.counts[index] += 1;
        } else {
            self.program.remarks.push(Remark { code, message: message(), line });
            self.counts.push(1);
        }
    }

    /// A direction as a unit vector; one whose length is off by more than 1e-3 gets a remark.
    pub(super) fn direction(&mut self, ijk: Vector3<f64>, line: usize) -> Result<Vector3<f64>, Fault> {
        let (axis, length) = unit(ijk)?;
        if (length - 1.0).abs() > 1e-3 {
            self.remark("axis-length", line, || {
                format!(
                    "the axis {} has the length {length:.4} instead of 1; its direction is used",
                    list(ijk)
                )
            });
        }
        Ok(axis)
    }

    /// A straight move. The first one only sets the start of the path.
    ///
    /// A move of zero length is dropped. One that only turns the tool is refused, because paths are
    /// parametrized by arc length.
    pub(super) fn line_to(&mut self, target: Target) -> Result<(), Fault> {
        let Some((from, axis_from)) = self.pose else {
            self.pose = Some((target.point, target.axis));
            return Ok(());
        };
        let turn = math::angle_between(&axis_from, &target.axis);
        if (target.point - from).norm() <= SAME {
            if turn > SAME_DIRECTION && !self.program.moves.is_empty() {
                return Err(Fault::new(
                    format!("a turn of the tool by {:.3} deg in place", turn / DEG),
                    "the path is measured along the tip: move the tip by at least 0.01 mm while the tool turns",
                ));
            }
            self.pose = Some((from, if self.program.moves.is_empty() { target.axis } else { axis_from }));
            return Ok(());
        }
        self.push(Segment::Line { from, to: target.point }, axis_from, target)
    }

    /// A move along a circle, counter-clockwise about its axis. It is a helix if the end lies above
    /// the start.
    ///
    /// Both ends may lie off the circle by 0.01 mm. The ends stay as written: the centre moves, by
    /// at most as much.
    pub(super) fn arc_to(&mut self, circle: Circle, target: Target) -> Result<(), Fault> {
        let Some((from, axis_from)) = self.pose else {
            return Err(Fault::new("an arc before the first point", "an arc starts at the point before it"));
        };
        let Circle { center, axis, radius, sweep } = circle;
        let flat = |p: Vector3<f64>| {
            let offset = p - center;
            let height = offset.dot(&axis);
            (offset - axis * height, height)
        };
        let ((start, low), (end, high)) = (flat(from), flat(target.point));
        let chord = end - start;
        let closed = chord.norm() <= SAME;
        let shift = center_shift(&start, &end, radius)?;
        let spoke = start - shift;
        let radius = spoke.norm();
        if radius <= SAME {
            return Err(Fault::new("an arc of radius 0", "the radius is larger than 0"));
        }
        let u = spoke / radius;
        let v = axis.cross(&u);
        let mut turned = TAU;
        if !closed {
            let bearing = math::atan2((end - shift).dot(&v), (end - shift).dot(&u));
            turned = if bearing > 0.0 { bearing } else { bearing + TAU };
        }
        if !closed && sweep.is_none() && chord.norm() < ARC_TOLERANCE && turned > PI {
            self.remark("nearly-full-circle", target.line, || {
                format!("the arc ends {:.4} mm short of its start: nearly a full circle", chord.norm() / MM)
            });
        }
        if let Some(stated) = sweep {
            turned = with_full_turns(turned, stated, radius, &axis)?;
        }
        let center = center + shift + axis * low;
        self.push(Segment::Arc { center, u, v, radius, sweep: turned, rise: high - low }, axis_from, target)
    }

    fn push(&mut self, segment: Segment, axis_from: Vector3<f64>, target: Target) -> Result<(), Fault> {
        let Target { point, axis, pace, spindle, line } = target;
        if math::angle_between(&axis_from, &axis) > PI - 1e-6 {
            return Err(Fault::new(
                format!("the axis {} reversed from {}", list(axis), list(axis_from)),
                "the program does not say which way the tool turns by 180 deg: add a point in between",
            ));
        }
        self.program.moves.push(Move { segment, axis_from, axis_to: axis, pace, spindle, line });
        self.pose = Some((point, axis));
        Ok(())
    }

    /// The program, after the last line of the text.
    pub(super) fn finish(mut self, unit: &'static str, lines: usize) -> Program {
        for (remark, count) in self.program.remarks.iter_mut().zip(&self.counts) {
            if *count > 1 {
                remark.message.push_str(&format!(" (and {} more such lines)", count - 1));
            }
        }
        Program { unit, lines, ..self.program }
    }
}

/// Shift of the centre along the chord that makes it equidistant from both ends of an arc, which
/// are given relative to the centre. Fails if an end is too far off the circle.
fn center_shift(start: &Vector3<f64>, end: &Vector3<f64>, radius: f64) -> Result<Vector3<f64>, Fault> {
    let chord = end - start;
    let shift = if chord.norm() <= SAME {
        Vector3::zeros()
    } else {
        chord * ((start + end).dot(&chord) / chord.norm_squared() / 2.0)
    };
    let off = [start.norm() - radius, end.norm() - radius, shift.norm()];
    if off.iter().any(|off| off.abs() > ARC_TOLERANCE) {
        let mm = |length: f64| length / MM;
        return Err(Fault::new(
            format!(
                "an arc of radius {:.4} mm whose start lies {:.4} mm and whose end lies {:.4} mm from its centre",
                mm(radius),
                mm(start.norm()),
                mm(end.norm())
            ),
            format!("both ends lie on the circle within {} mm", mm(ARC_TOLERANCE)),
        ));
    }
    Ok(shift)
}

/// The angle `turned` plus the full turns that the `stated` angle has. Fails if the two disagree.
fn with_full_turns(turned: f64, stated: f64, radius: f64, axis: &Vector3<f64>) -> Result<f64, Fault> {
    let sweep = turned + TAU * ((stated - turned) / TAU).round().max(0.0);
    let gap = (stated - sweep).abs();
    if gap > 0.1 * DEG && gap * radius > ARC_TOLERANCE {
        return Err(Fault::new(
            format!("the angle {:.3} deg", stated / DEG),
            format!(
                "from the start counter-clockwise about the vector {} to the end it is {:.3} deg",
                list(*axis),
                turned / DEG
            ),
        ));
    }
    Ok(sweep)
}

/// A vector's direction and length.
pub(super) fn unit(ijk: Vector3<f64>) -> Result<(Vector3<f64>, f64), Fault> {
    let length = ijk.norm();
    if (1e-6..=1e6).contains(&length) {
        return Ok((ijk / length, length));
    }
    Err(Fault::new(format!("the vector {}", list(ijk)), "a direction has the length 1"))
}

/// A coordinate [m], if it is in range.
pub(super) fn coordinate(value: f64) -> Result<f64, Fault> {
    if value.abs() <= FARTHEST {
        return Ok(value);
    }
    Err(Fault::new(
        format!("{} mm", value / MM),
        format!("a coordinate is within {} mm of the origin", FARTHEST / MM),
    ))
}

/// A feed [m/s], if it is in range.
pub(super) fn feed(value: f64) -> Result<f64, Fault> {
    let [slowest, fastest] = FEEDS;
    // The limits must hold whichever unit the feed was given in.
    if (slowest * (1.0 - 1e-9)..=fastest * (1.0 + 1e-9)).contains(&(value / MM)) {
        return Ok(value);
    }
    Err(Fault::new(
        format!("a feed of {} mm/s", value / MM),
        format!("a feed is {slowest} to {fastest} mm/s"),
    ))
}

fn list(v: Vector3<f64>) -> String {
    format!("({}, {}, {})", v.x, v.y, v.z)
}
