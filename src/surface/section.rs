//! A section through the finished part across the feed, where the tool is at a sample.

use crate::motion::TimingLaw;
use crate::path::MovePace;
use crate::plan::Plan;
use crate::surface::cutter;
use crate::surface::deviation_map::DeviationMap;
use crate::surface::part::PartMap;
use nalgebra::{Vector2, Vector3};

/// A plane through the tool axis across the feed: lengths across count from the tip to the left of the feed, heights
/// are those of the workpiece frame [m].
#[derive(Debug, Clone, PartialEq)]
pub struct PartSection {
    /// The nominal surface from left to right, as seen along the feed.
    pub nominal: Vec<[f64; 2]>,
    /// How far each of its points is moved with the desired path commanded.
    pub before: Vec<[f64; 2]>,
    /// The same with the compensated path commanded.
    pub after: Vec<[f64; 2]>,
    /// Outline of the tool in its place, from the left over the tip to the right.
    pub tool: Vec<[f64; 2]>,
    /// Bottom of the part.
    pub bottom: f64,
}

/// Half the width of a section, in radii of the tool.
const HALF: f64 = 3.0;
/// Points from the middle to an end.
const POINTS: i32 = 240;
/// Distance of the tool's places that are looked at, as a part of the radius.
const STEP: f64 = 0.05;
/// How far up the tool is drawn, in radii.
const DRAWN: f64 = 3.0;
/// Points of a corner's outline.
const CORNER: i32 = 12;
/// A feed that is less than this part sideways has no side.
const UPRIGHT: f64 = 1e-6;

impl PartSection {
    /// The section of a part at the sample `k` of the timing.
    pub(crate) fn of(plan: &Plan, map: &DeviationMap, timing: &TimingLaw, k: usize) -> Self {
        let to_workpiece = plan.setup.workpiece.inverse();
        let (path, index) = (&plan.path, timing.index[k] as usize);
        let place = path.within(index, timing.arc_length[k]);
        let tip = to_workpiece.point(&path.point_at(place));
        let tangent = to_workpiece.direction(&path.moves()[index].segment.tangent(place.1));
        let left = Vector3::z().cross(&tangent).try_normalize(UPRIGHT).unwrap_or_else(Vector3::y).xy();
        let cutter = cutter(plan);
        let at = |j: i32| -cutter.radius * HALF * f64::from(j) / f64::from(POINTS);
        let point = |across: f64| tip.xy() + left * across;
        let across: Vec<f64> = (-POINTS..=POINTS).map(at).collect();
        let mut heights: Vec<f64> = across.iter().map(|across| map.blank_at(&point(*across))).collect();
        // Left of the tip, and ahead of the plane.
        let local = |tip_there: Vector3<f64>| {
            let from = tip_there.xy() - tip.xy();
            (Vector2::new(from.dot(&left), from.perp(&left)), tip_there.z)
        };
        let width = across[0] - across[1];
        for each in path.moves().iter().filter(|each| each.pace != MovePace::Rapid) {
            let length = each.segment.length();
            let count = (length / (STEP * cutter.radius)).ceil().max(1.0) as usize;
            for j in 0..=count {
                let there = each.segment.point(length * (j as f64 / count as f64));
                let (there, z) = local(to_workpiece.point(&there));
                let half = (cutter.radius * cutter.radius - there.y * there.y).max(0.0).sqrt();
                let from = ((across[0] - there.x - half) / width).ceil().max(0.0);
                let to = ((across[0] - there.x + half) / width).floor().min(across.len() as f64 - 1.0);
                if half == 0.0 || to < from {
                    continue;
                }
                for k in from as usize..=to as usize {
                    let beside = across[k] - there.x;
                    let off_axis = (beside * beside + there.y * there.y).sqrt().min(cutter.radius);
                    heights[k] = heights[k].min(z + cutter.profile(off_axis));
                }
            }
        }
        let PartMap { origin, .. } = map.nominal;
        heights.iter_mut().for_each(|height| *height = height.max(origin.z));
        // Beside the part nothing is moved.
        let moved = |shifts| {
            let moved = |(across, height): (&f64, &f64)| match *height > origin.z {
                true => {
                    let shift = map.at(shifts, &point(*across));
                    [shift.xy().dot(&left), shift.z]
                }
                false => [0.0; 2],
            };
            across.iter().zip(&heights).map(moved).collect()
        };
        let (before, after) = (moved(&map.before), moved(&map.after));
        let nominal = across.iter().zip(&heights).map(|(across, height)| [*across, *height]).collect();
        Self { nominal, before, after, tool: outline(cutter.radius, cutter.corner, tip.z), bottom: origin.z }
    }
}

/// The outline of a tool with its tip at a height [m].
fn outline(radius: f64, corner: f64, tip: f64) -> Vec<[f64; 2]> {
    let right = |j: i32| {
        let (sin, cos) = crate::math::sin_cos(crate::math::FRAC_PI_2 * f64::from(j) / f64::from(CORNER));
        [radius - corner + corner * sin, tip + corner * (1.0 - cos)]
    };
    let top = [radius, tip + DRAWN * radius];
    let down: Vec<[f64; 2]> = [top].into_iter().chain((0..=CORNER).rev().map(right)).collect();
    let mirrored = down.iter().rev().map(|[across, height]| [-across, *height]);
    down.iter().copied().chain(mirrored).collect()
}
