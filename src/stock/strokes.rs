//! Strokes: short legs that go on nearly straight, which clear as one capsule once the stroke ends.
//!
//! A path in points a hundredth of a millimetre apart has thousands of legs within the tool's reach; its
//! strokes are a few dozen.

use crate::path::Segment;
use crate::stock::swept::{Spine, Swept};
use nalgebra::Vector2;

/// Longest leg that is joined with others, as a part of the tool's radius.
const SHORT: f64 = 0.05;
/// Most legs in a stroke.
const MOST_LEGS: usize = 64;
/// Largest distance of the joints from the stroke [m]: material this thin is none.
const BESIDE: f64 = 1e-6;
/// Distance of ends that are the same [m].
const SAME: f64 = 1e-9;

/// Legs in a row that clear one capsule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stroke {
    /// What they sweep together.
    pub(super) swept: Swept,
    /// Their number.
    pub(super) legs: usize,
}

/// The strokes of legs by a tool with this radius [m]; no stroke goes on across `None`, which stands for a
/// rapid leg.
pub(super) fn strokes(legs: impl Iterator<Item = Option<Swept>>, radius: f64) -> Vec<Stroke> {
    let (mut all, mut group) = (Vec::new(), Vec::new());
    for leg in legs.chain([None]) {
        let joined = leg.and_then(|leg| joined(&group, &leg, SHORT * radius));
        if let (Some(leg), Some(swept)) = (leg, joined) {
            group.push(leg);
            if let Some(last) = all.last_mut() {
                *last = Stroke { swept, legs: group.len() };
            }
            continue;
        }
        group.clear();
        if let Some(leg) = leg {
            group.push(leg);
            all.push(Stroke { swept: leg, legs: 1 });
        }
    }
    all
}

/// What a group of legs sweeps with one more; `None` if it does not go on straight and level.
fn joined(group: &[Swept], leg: &Swept, short: f64) -> Option<Swept> {
    let (first, last) = (group.first()?, group.last()?);
    let [(start, _), (_, end), (from, to)] = [ends(first)?, ends(last)?, ends(leg)?];
    let level = |leg: &Swept| leg.heights == first.heights && leg.heights[0] == leg.heights[1];
    let is_short = |leg: &Swept| leg.length() <= short;
    if group.len() == MOST_LEGS || !level(last) || !level(leg) || !is_short(first) || !is_short(leg) {
        return None;
    }
    let along = (to - start).try_normalize(0.0)?;
    let mut reached = 0.0;
    let straight = group.iter().filter_map(ends).all(|(_, joint)| {
        let offset = joint - start;
        let goes_on = offset.dot(&along) >= reached;
        reached = offset.dot(&along);
        goes_on && along.perp(&offset).abs() <= BESIDE
    });
    if (from - end).norm() > SAME || !straight || (to - start).dot(&along) < reached {
        return None;
    }
    let height = first.heights[0];
    Swept::of(&Segment::Line { from: start.push(height), to: to.push(height) })
}

/// Ends of a straight leg [m].
fn ends(leg: &Swept) -> Option<(Vector2<f64>, Vector2<f64>)> {
    match leg.spine {
        Spine::Line { from, along, length } => Some((from, from + along * length)),
        _ => None,
    }
}
