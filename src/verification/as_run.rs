//! The moves of a robot program as its controller runs them: exact stops, and rounded corners.
//!
//! Within the distance d of a corner (half of either move at most) the path is a parabola that
//! touches both, so it passes the corner at d sin(turn / 2) / 2. That is what ABB states of its zones
//! (RAPID reference manual, zonedata: a parabola, no more than half the distance) and what KUKA's and
//! Staubli's programming manuals draw. The speed on it is the feed, or less where the acceleration
//! across the path, v^2 / r, would be above the job's along it: an assumption, since makers do not say.
//!
//! FANUC's CNT is a share of the speed: the next move starts while the last one still slows down. Two
//! such ramps overlapped give a parabola as well, with d = share v^2 / (2 a). Measured corners differ
//! from that by a factor of 2 either way.
//!
//! Where nothing is blended, the tool comes to rest, and the next move starts in the next cycle of the
//! controller, for which the job's sample time is taken.

use crate::export::chain::WAY_BACK;
use crate::export::command::Command;
use crate::export::style::Junctions;
use crate::math;
use crate::motion::trajectory::MotionLimits;
use crate::path::program::Dwell;
use crate::path::{Move, MovePace, Program, Segment};
use crate::units::DEG;
use nalgebra::Vector3;

/// A parabola is run in chords that turn by at most this share of the angle that is a stop, of which no
/// more than [`COARSEST`] counts.
const CHORD: f64 = 0.3;
/// See [`CHORD`] [rad].
const COARSEST: f64 = 5.0 * DEG;

/// The program of a robot's command, with its corners as they are run.
pub fn as_run(command: &Command, limits: &MotionLimits) -> Program {
    let Program { moves, dwells, .. } = command.program();
    let speed = |step: &Move| match step.pace {
        MovePace::Rapid => limits.rapid,
        MovePace::Feed(feed) => feed,
        MovePace::JobFeed => limits.feed,
    };
    let stops = stops(command);
    let reach: Vec<f64> = moves
        .windows(2)
        .zip(&stops)
        .map(|(pair, stops)| {
            let turn = math::angle_between(
                &pair[0].segment.tangent(pair[0].segment.length()),
                &pair[1].segment.tangent(0.0),
            );
            let distance = match command.style.junctions {
                _ if *stops || turn > WAY_BACK => 0.0,
                Junctions::AsWritten => 0.0,
                Junctions::Distance => command.blend,
                Junctions::Share => {
                    let speed = speed(&pair[0]).min(speed(&pair[1]));
                    command.blend * speed * speed / (2.0 * limits.acceleration)
                }
            };
            distance.min(pair[0].segment.length() / 2.0).min(pair[1].segment.length() / 2.0)
        })
        .collect();
    let mut program = Program { unit: "mm", ..Program::default() };
    let mut dwells = dwells.into_iter().peekable();
    for (index, step) in moves.iter().enumerate() {
        while let Some(dwell) = dwells.next_if(|dwell| dwell.after <= index) {
            program.dwells.push(Dwell { after: program.moves.len(), ..dwell });
        }
        let length = step.segment.length();
        let from = if index > 0 { reach[index - 1] } else { 0.0 };
        let to = length - reach.get(index).copied().unwrap_or(0.0);
        if to > from {
            program.moves.push(part(step, from, to));
        }
        let Some((next, reach)) = moves.get(index + 1).zip(reach.get(index)) else { continue };
        if *reach > 0.0 {
            let corner = BlendedCorner { before: part(step, to, length), after: part(next, 0.0, *reach) };
            let speeds = [speed(step), speed(next)];
            program.moves.extend(corner.chords(*reach, speeds, limits));
        } else {
            let (after, time) = (program.moves.len(), limits.sample_time);
            program.dwells.push(Dwell { after, time, line: step.line });
        }
    }
    program.dwells.extend(dwells.map(|dwell| Dwell { after: program.moves.len(), ..dwell }));
    program
}

/// Whether the tool stops at the end of each step of a command.
fn stops(command: &Command) -> Vec<bool> {
    let of_move = |commanded: &crate::export::command::CommandedMove| {
        let last = commanded.steps.len();
        let stops = commanded.stops;
        (1..=last).map(move |step| stops && step == last)
    };
    command.moves.iter().flat_map(of_move).collect()
}

/// The parts of two moves that a blended corner replaces.
struct BlendedCorner {
    before: Move,
    after: Move,
}

impl BlendedCorner {
    /// The parabola that touches both at the distance `reach` [m] from the corner, at no more than
    /// the moves' `speeds` [m/s].
    fn chords(&self, reach: f64, speeds: [f64; 2], limits: &MotionLimits) -> Vec<Move> {
        let Self { before, after } = self;
        let (start, end) = (before.segment.point(0.0), after.segment.point(reach));
        let (arriving, leaving) = (before.segment.tangent(0.0), after.segment.tangent(reach));
        let corner = math::angle_between(&before.segment.tangent(reach), &after.segment.tangent(0.0));
        // At its vertex the radius is d cos^2(turn / 2) / sin(turn / 2).
        let (sin, cos) = math::sin_cos(corner / 2.0);
        let slowest = (limits.acceleration * reach * cos * cos / sin.max(f64::MIN_POSITIVE)).sqrt();
        // On arcs it turns with them, there and back where they bend in turn.
        let turn = corner + reach * (before.segment.curvature() + after.segment.curvature());
        // An even number, so that the vertex is among their ends.
        let count = 2.0 * (turn / (2.0 * CHORD * limits.corner_angle.min(COARSEST))).ceil().max(1.0);
        // As a cubic, the parabola between two straight moves has its inner points at two thirds of the
        // way to the corner; beside an arc, that touches the arc.
        let inner = [start + arriving * (reach * 2.0 / 3.0), end - leaving * (reach * 2.0 / 3.0)];
        let at = |k: f64| {
            let t = k / count;
            let u = 1.0 - t;
            start * (u * u * u)
                + inner[0] * (3.0 * u * u * t)
                + inner[1] * (3.0 * u * t * t)
                + end * (t * t * t)
        };
        let axis = |k: f64| {
            let t = k / count;
            (before.axis_from * (1.0 - t) + after.axis_to * t).normalize()
        };
        let chord = |k: usize| {
            let (from, to) = (k as f64, k as f64 + 1.0);
            let (of, speed) = if from * 2.0 < count { (before, speeds[0]) } else { (after, speeds[1]) };
            let pace = if speed > slowest { MovePace::Feed(slowest) } else { of.pace };
            Move {
                segment: Segment::Line { from: at(from), to: at(to) },
                axis_from: axis(from),
                axis_to: axis(to),
                pace,
                ..*of
            }
        };
        (0..count as usize).map(chord).collect()
    }
}

/// The part of a move between two lengths along it [m].
fn part(step: &Move, from: f64, to: f64) -> Move {
    let length = step.segment.length();
    let axis = |s: f64| {
        let turned: Vector3<f64> = step.axis_from * (1.0 - s / length) + step.axis_to * (s / length);
        turned.normalize()
    };
    Move { segment: step.segment.part(from, to), axis_from: axis(from), axis_to: axis(to), ..*step }
}
