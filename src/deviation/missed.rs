//! What of the path the tip never reaches: the distance from the path to the tip's way, where the
//! contour error is the distance from the tip to the path.
//!
//! The two agree where the tip runs beside the path. Where it cuts a corner, the tip is never far
//! from one of the legs, but the corner is far from the tip. Both together are the Hausdorff
//! distance of the two curves.

use crate::deviation::Largest;
use crate::path::Path;
use nalgebra::Vector3;

/// The largest distance from a point of the path to the nearest place that the tip passes [m].
/// `tips` are the actual tips [m] and `arc_length` the places on the path where they are due [m],
/// never decreasing; in between, the tip goes straight.
///
/// The points looked at are those due at the samples and the exact end of each move.
pub fn missed(path: &Path, arc_length: &[f64], tips: &[Vector3<f64>]) -> Largest {
    let mut track = TipTrack::of(tips, path.is_closed());
    let mut largest = Largest::default();
    let mut last = f64::NEG_INFINITY;
    let mut look = |due: usize, s: f64, point: &Vector3<f64>| {
        // While the tip waits, one point is due at many samples.
        if s > last {
            last = s;
            let enough = largest.max * (1.0 + RESOLUTION);
            largest.raise(track.distance(point, due, enough), s);
        }
    };
    let mut k = 0;
    for (index, step) in path.moves().iter().enumerate() {
        let end = path.start(index + 1);
        while k < arc_length.len() && arc_length[k] < end {
            look(k, arc_length[k], &path.point_at(path.within(index, arc_length[k])));
            k += 1;
        }
        look(k.min(tips.len() - 1), end, &step.segment.point(step.segment.length()));
    }
    largest
}

/// A distance that exceeds the largest so far by no more than this share is not sought: along a
/// slowly growing error each sample would exceed the one before.
const RESOLUTION: f64 = 1e-6;

/// The way of the tip, straight from each sample to the next.
struct TipTrack<'a> {
    tips: &'a [Vector3<f64>],
    /// Length of the way up to each sample [m].
    walked: Vec<f64>,
    /// Whether the path ends where it starts, so that the tip passes there twice.
    closed: bool,
    /// Number of samples from the one due to the nearest, at the last point that was searched for.
    lead: isize,
}

impl<'a> TipTrack<'a> {
    fn of(tips: &'a [Vector3<f64>], closed: bool) -> Self {
        let mut walked = Vec::with_capacity(tips.len());
        let mut length = 0.0;
        for (k, tip) in tips.iter().enumerate() {
            length += (tip - tips[k.saturating_sub(1)]).norm();
            walked.push(length);
        }
        Self { tips, walked, closed, lead: 0 }
    }

    /// The distance from a point that is due at the sample `due` to the nearest place of the way
    /// [m]; a search may end as soon as it is no more than `enough`.
    ///
    /// If the tip due is at the distance d, the nearest place is no further from the point, so the
    /// two are at most 2 d apart; 3 d along the way allows for its bends. A path that crosses
    /// itself is thus never matched to the wrong branch.
    fn distance(&mut self, point: &Vector3<f64>, due: usize, enough: f64) -> f64 {
        let due_tip = (self.tips[due] - point).norm();
        // The nearest place moves along with the point: most often one look there is enough.
        let near = due.saturating_add_signed(self.lead).min(self.tips.len() - 2);
        let there = to_segment(point, &self.tips[near], &self.tips[near + 1]);
        if due_tip.min(there) <= enough {
            return due_tip.min(there);
        }
        let (place, length) = (self.walked[due], self.walked[self.walked.len() - 1]);
        let (low, high) = (place - 3.0 * due_tip, place + 3.0 * due_tip);
        let (mut least, nearest) = self.search(point, (low, high), (due_tip, enough));
        self.lead = nearest.map_or(0, |nearest| nearest as isize - due as isize);
        if self.closed && low < 0.0 {
            (least, _) = self.search(point, (low + length, length), (least, enough));
        }
        if self.closed && high > length {
            (least, _) = self.search(point, (0.0, high - length), (least, enough));
        }
        least
    }

    /// The smaller of `least` and the distance from a point to the way between two lengths [m], with
    /// the sample that the nearest place follows, if the way comes nearer.
    fn search(
        &self,
        point: &Vector3<f64>,
        (low, high): (f64, f64),
        (mut least, enough): (f64, f64),
    ) -> (f64, Option<usize>) {
        let Self { tips, walked, .. } = self;
        let end = walked.partition_point(|length| *length <= high).min(tips.len() - 1);
        let mut k = walked.partition_point(|length| *length < low).saturating_sub(1);
        let mut nearest = None;
        while k < end && least > enough {
            let distance = to_segment(point, &tips[k], &tips[k + 1]);
            if distance < least {
                (least, nearest) = (distance, Some(k));
            }
            // A place on the way is nearer by no more than the way to it is long, which leaps over
            // most of a long search and over all of a rest.
            let leap = walked[k + 1] + (tips[k + 1] - point).norm() - least;
            k += walked[k + 1..=end].partition_point(|length| *length <= leap).max(1);
        }
        (least, nearest)
    }
}

/// Distance of a point from a straight piece [m].
fn to_segment(point: &Vector3<f64>, from: &Vector3<f64>, to: &Vector3<f64>) -> f64 {
    let (along, offset) = (to - from, point - from);
    let square = along.norm_squared();
    let share = if square > 0.0 { (offset.dot(&along) / square).clamp(0.0, 1.0) } else { 0.0 };
    (offset - along * share).norm()
}
