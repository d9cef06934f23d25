//! Corners of the commanded line where the tool is not to stop, rounded.
//!
//! Where a force follows the feed, the correction grows while the tool gains speed and stays once
//! it has it: the commanded line has a corner in the middle of a smooth move. What travels it as
//! written would stop there, and the force with it. An arc from one neighbouring move to the other,
//! in chords that turn less than a stop takes, leaves out the corner.

use crate::export::thin::Point;
use crate::math;

/// A chord is at least this many steps of the resolution long, over the angle it turns [rad]:
/// rounding turns it, too.
const STEPS: f64 = 4.0;

/// For each of `points` what is to stand for it: the ends of such chords, if the moves turn there
/// by more than `limit` [rad] and it is not before the one numbered `first`; else the point itself.
/// A corner is at most `tolerance` [m] from its chords, and stays if these were too short to be
/// said in steps of `resolution` [m].
pub fn round(points: &[Point], first: usize, limit: f64, tolerance: f64, resolution: f64) -> Vec<Vec<Point>> {
    let standing = |(k, corner): (usize, &Point)| {
        let arc = match (points[..k].last(), points.get(k + 1)) {
            (Some(before), Some(after)) if k >= first => chords([before, corner, after], limit, tolerance),
            _ => None,
        };
        let can_be_said =
            |arc: &Vec<Point>| (arc[1].position - arc[0].position).norm() * limit >= STEPS * resolution;
        arc.filter(can_be_said).unwrap_or_else(|| vec![*corner])
    };
    points.iter().enumerate().map(standing).collect()
}

/// Ends of the chords about a corner that turns by more than `limit`.
fn chords(corner: [&Point; 3], limit: f64, tolerance: f64) -> Option<Vec<Point>> {
    let [before, corner, after] = corner;
    let (arriving, leaving) = (corner.position - before.position, after.position - corner.position);
    let turn = math::angle_between(&arriving, &leaving);
    let (to, from) = (arriving.try_normalize(0.0)?, leaving.try_normalize(0.0)?);
    // Towards the centre, at a right angle to the way in.
    let aside = (from - to * to.dot(&from)).try_normalize(0.0)?;
    // Where the axis turns too, the way of the tip is not all there is to the corner.
    if turn <= limit || [before, after].iter().any(|point| point.axis != corner.axis) {
        return None;
    }
    // Half a move is left to the corner at its other end. An arc that touches both moves at the
    // distance d from the corner has the radius d / tan(turn / 2); the corner is d tan(turn / 4)
    // from it, and no chord is further inside than half a move turns.
    let count = (turn / limit).ceil();
    let room = arriving.norm().min(leaving.norm()) / 2.0;
    let tan_half = math::tan(turn / 2.0);
    let sagitta = (1.0 - math::cos(turn / count / 2.0)) / tan_half;
    let reach = room.min(tolerance / (math::tan(turn / 4.0) + sagitta));
    let radius = reach / tan_half;
    let touching = corner.position - to * reach;
    let on_arc = |i: usize| {
        let (sin, cos) = math::sin_cos(turn * i as f64 / count);
        let position = touching + (to * sin + aside * (1.0 - cos)) * radius;
        Point { position, ..*corner }
    };
    Some((0..=count as usize).map(on_arc).collect())
}
