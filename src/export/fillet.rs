//! Rounds corners of the commanded line where the tool should not stop.
//!
//! Where the force follows the feed, the correction grows while the tool accelerates and then stays
//! constant: the commanded line has a corner in the middle of a smooth move. A controller that
//! follows it as written would stop there, and the force would drop. An arc from one neighbouring
//! move to the other, in chords that turn too little to cause a stop, cuts off the corner.

use crate::export::thin::Point;
use crate::math;

/// Minimum length of a chord, in steps of the resolution over the angle it turns [rad]: rounding
/// turns it, too.
const STEPS: f64 = 4.0;

/// The replacement for each of `points`: the ends of such chords, if the moves turn there by more
/// than `limit` [rad] and its index is at least `first`; otherwise the point itself. A corner is at
/// most `tolerance` [m] from its chords. It stays if they would be too short to write in steps of
/// `resolution` [m].
pub fn round(points: &[Point], first: usize, limit: f64, tolerance: f64, resolution: f64) -> Vec<Vec<Point>> {
    let standing = |(k, corner): (usize, &Point)| {
        let arc = match (points[..k].last(), points.get(k + 1)) {
            (Some(before), Some(after)) if k >= first => chords([before, corner, after], limit, tolerance),
            _ => None,
        };
        let long_enough =
            |arc: &Vec<Point>| (arc[1].position - arc[0].position).norm() * limit >= STEPS * resolution;
        arc.filter(long_enough).unwrap_or_else(|| vec![*corner])
    };
    points.iter().enumerate().map(standing).collect()
}

/// Ends of the chords about a corner that turns by more than `limit`.
fn chords(corner: [&Point; 3], limit: f64, tolerance: f64) -> Option<Vec<Point>> {
    let [before, corner, after] = corner;
    let (arriving, leaving) = (corner.position - before.position, after.position - corner.position);
    let turn = math::angle_between(&arriving, &leaving);
    let (to, from) = (arriving.try_normalize(0.0)?, leaving.try_normalize(0.0)?);
    // Towards the centre, at a right angle to the arriving move.
    let aside = (from - to * to.dot(&from)).try_normalize(0.0)?;
    // Where the axis turns too, the corner is more than a turn of the tip's path.
    if turn <= limit || [before, after].iter().any(|point| point.axis != corner.axis) {
        return None;
    }
    // Half a move is left for the corner at its other end. An arc that touches both moves at the
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
