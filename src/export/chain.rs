//! Moves that a robot's controller runs without a stop between them, written as one.
//!
//! A program of dense points becomes the fewest points within the tolerance, a least distance apart:
//! controllers plan only a few points ahead, and slow down or stutter where these are dense.

use crate::export::arc::{self, ArcMove, Step, rounded};
use crate::export::command::CommandedMove;
use crate::export::style::PostStyle;
use crate::export::thin::{self, Point};
use crate::math;
use crate::path::Path;
use crate::units::DEG;
use std::ops::Range;

/// A longer arc is written in parts [rad]: controllers take a third point on it, less than half a
/// turn from either end.
const LONGEST_ARC: f64 = 170.0 * DEG;

/// A sharper corner is a way back, at which the tool comes to rest in any case [rad].
pub const WAY_BACK: f64 = 168.0 * DEG;

/// Every move by itself.
pub(super) fn single(path: &Path) -> Vec<Range<usize>> {
    (0..path.moves().len()).map(|index| index..index + 1).collect()
}

/// Consecutive moves at the same pace and spindle speed, where the tool does not rest in between;
/// `rests` says whether it does at an arc length [m].
pub(super) fn all(path: &Path, rests: impl Fn(f64) -> bool) -> Vec<Range<usize>> {
    let mut chains: Vec<Range<usize>> = Vec::new();
    for (index, step) in path.moves().iter().enumerate() {
        match chains.last_mut() {
            Some(chain)
                if (step.pace, step.spindle)
                    == (path.moves()[chain.start].pace, path.moves()[chain.start].spindle)
                    && !rests(path.start(index)) =>
            {
                chain.end = index + 1;
            }
            _ => chains.push(index..index + 1),
        }
    }
    chains
}

/// Lines of a file beside its moves, and beside the steps of a move.
const AROUND: usize = 40;
const BESIDE: usize = 4;

/// The moves in parts for files of at most `lines` lines: each part ends where the tool rests anyway, if
/// that leaves it half full, or else with a stop of its own.
pub(super) fn in_files(moves: Vec<CommandedMove>, lines: usize) -> Vec<CommandedMove> {
    let room = lines.saturating_sub(AROUND).max(1);
    let mut parted: Vec<CommandedMove> = Vec::with_capacity(moves.len());
    let (mut part, mut used) = (0, 0);
    for mut commanded in moves {
        loop {
            let needed = commanded.steps.len() + BESIDE;
            let rested = parted.last().is_none_or(|last| last.stops);
            if used > 0 && used + needed > room && (used + BESIDE >= room || (rested && used * 2 > room)) {
                if let Some(last) = parted.last_mut() {
                    last.stops = true;
                }
                (part, used) = (part + 1, 0);
            }
            let fits = room.saturating_sub(used + BESIDE).max(1);
            commanded.part = part;
            if commanded.steps.len() <= fits {
                used += commanded.steps.len() + BESIDE;
                parted.push(commanded);
                break;
            }
            let rest = commanded.steps.split_off(fits);
            let next = CommandedMove { steps: rest, wait: 0.0, ..commanded.clone() };
            parted.push(CommandedMove { stops: true, ..commanded });
            (part, used) = (part + 1, 0);
            commanded = next;
        }
    }
    parted
}

/// Lets the tool come to rest at the last point written before a stop or a wait, where the move that
/// stops is too short to be written.
pub(super) fn rest(moves: &mut [CommandedMove]) {
    let mut rests = false;
    for commanded in moves.iter_mut().rev() {
        rests |= commanded.stops;
        if !commanded.steps.is_empty() {
            commanded.stops |= rests;
            rests = false;
        }
        rests |= commanded.wait > 0.0;
    }
}

/// The fewest moves along `points` within `tolerance`, none shorter than `least` [m], and the largest
/// distance of the points from them [m]; arcs about the axis `normal` of the workpiece frame, where
/// the language has them and they save moves. Where the tool `rests` at the end, that is written however
/// near it is.
pub(super) fn steps(
    points: &[Point],
    (normal, rests): (Option<usize>, bool),
    (tolerance, least): (f64, f64),
    style: PostStyle,
) -> (Vec<Step>, f64) {
    let resolution = style.resolution();
    // Coarse steps of the language leave at least half of the tolerance to thinning.
    let within = (tolerance - resolution).max(tolerance / 2.0);
    let kept = thin::thin(points, within);
    let mut kept = thin::spaced(points, &thin::pruned(points, &kept, within), (tolerance, least));
    if kept.len() == 1 && rests && rounded(&points[points.len() - 1], resolution) != points[0] {
        kept.push(points.len() - 1);
    }
    let ends: Vec<Vec<Point>> = kept.iter().map(|&k| vec![rounded(&points[k], resolution)]).collect();
    // Of moves too short to be written, only the start is left.
    let from_start = |point: &Point| point.distance(&points[0], &points[0]);
    let deviation = match kept.len() {
        0 | 1 => points.iter().map(from_start).fold(0.0, f64::max),
        _ => thin::deviation(points, &kept, &ends),
    };
    let straight: Vec<Step> = ends.concat().into_iter().skip(1).map(|to| Step { to, arc: None }).collect();
    let Some(normal) = normal.filter(|_| style.arcs && straight.len() > 1) else {
        return (straight, deviation);
    };
    let (turned, strayed) = arc::steps(points, normal, within, resolution);
    let turned: Vec<Step> = in_parts(&points[0], &turned).collect();
    let writable = steepest(&points[0], &turned, normal, least).filter(|rise| *rise <= tolerance);
    match writable {
        Some(rise) if turned.len() < straight.len() && !turns(points) => (turned, strayed + rise / 4.0),
        _ => (straight, deviation),
    }
}

/// Whether the spin changes: controllers turn the tool along an arc in ways of their own.
fn turns(points: &[Point]) -> bool {
    points.iter().any(|point| (point.spin - points[0].spin).abs() > 1e-9)
}

/// Largest rise of an arc along the axis about which it turns [m]; `None` if a move is shorter than
/// `least` [m].
///
/// Three points make an arc of a tilted plane, which is off an even rise by less than a quarter of it.
fn steepest(start: &Point, steps: &[Step], normal: usize, least: f64) -> Option<f64> {
    let mut from = *start;
    let mut steepest = 0.0_f64;
    for step in steps {
        let start = std::mem::replace(&mut from, step.to);
        if step.segment(&start).length() < least {
            return None;
        }
        if step.arc.is_some() {
            steepest = steepest.max((step.to.position[normal] - start.position[normal]).abs());
        }
    }
    Some(steepest)
}

/// The moves from `start`, with arcs of more than [`LONGEST_ARC`] in equal parts.
fn in_parts<'s>(start: &Point, steps: &'s [Step]) -> impl Iterator<Item = Step> + use<'s> {
    let mut from = *start;
    steps.iter().flat_map(move |step| {
        let start = std::mem::replace(&mut from, step.to);
        let segment = step.segment(&start);
        let count = step.arc.map_or(1.0, |arc| (arc.sweep.abs() / LONGEST_ARC).ceil().max(1.0));
        (1..=count as usize).map(move |part| {
            let share = part as f64 / count;
            let to = Point {
                position: if share < 1.0 {
                    segment.point(segment.length() * share)
                } else {
                    step.to.position
                },
                s: start.s + (step.to.s - start.s) * share,
                ..step.to
            };
            Step { to, arc: step.arc.map(|arc| ArcMove { sweep: arc.sweep / count, ..arc }) }
        })
    })
}

/// The point in the middle of an arc from `from` [m].
pub(super) fn middle(from: &Point, step: &Step) -> Option<Point> {
    let arc = step.arc?;
    let mut spoke = from.position - arc.center;
    spoke[arc.normal] = 0.0;
    let mut axis = nalgebra::Vector3::zeros();
    axis[arc.normal] = 1.0;
    let height = (from.position[arc.normal] + step.to.position[arc.normal]) / 2.0;
    let position = arc.center
        + math::rotation_about(&axis, arc.sweep / 2.0) * spoke
        + axis * (height - arc.center[arc.normal]);
    Some(Point { position, axis: from.axis, spin: from.spin, s: (from.s + step.to.s) / 2.0 })
}
