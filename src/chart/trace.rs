//! From samples in the canvas's units to the few points worth drawing: gaps, reduction, clipping.

/// A point on the canvas [SVG units, y down].
pub(super) type SheetPoint = (f64, f64);

/// Width of the columns to which dense curves are reduced [SVG units]: half a pixel.
const COLUMN: f64 = 0.5;
/// Points of a path nearer than this to the last one kept add nothing [SVG units].
const CLOSE: f64 = 0.3;
/// A drawn line strays from the samples by no more than this [SVG units]: half the raster of the
/// file.
const STRAY: f64 = 0.05;

/// The part of the canvas that shows data [SVG units].
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Window {
    /// Whether the point lies inside or on the border.
    pub(super) fn contains(&self, (x, y): SheetPoint) -> bool {
        (self.left..=self.right).contains(&x) && (self.top..=self.bottom).contains(&y)
    }

    /// The window, larger by this much on all sides.
    pub(super) fn grown(&self, by: f64) -> Self {
        let Self { left, top, right, bottom } = *self;
        Self { left: left - by, top: top - by, right: right + by, bottom: bottom + by }
    }

    /// How many pieces of a line come into the window.
    pub(super) fn pieces(&self, line: &[SheetPoint]) -> usize {
        line.windows(2).filter(|pair| self.clip(pair[0], pair[1]).is_some()).count()
    }

    /// The part of a segment that lies inside, after Liang and Barsky (ACM Transactions on Graphics
    /// 3(1), 1984).
    fn clip(&self, a: SheetPoint, b: SheetPoint) -> Option<(SheetPoint, SheetPoint)> {
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for (step, room) in
            [(-dx, a.0 - self.left), (dx, self.right - a.0), (-dy, a.1 - self.top), (dy, self.bottom - a.1)]
        {
            if step < 0.0 {
                enter = enter.max(room / step);
            } else if step > 0.0 {
                leave = leave.min(room / step);
            } else if room < 0.0 {
                return None;
            }
        }
        let at = |t: f64| {
            let (x, y) = (a.0 + t * dx, a.1 + t * dy);
            (x.clamp(self.left, self.right), y.clamp(self.top, self.bottom))
        };
        // Ends that are not clipped keep the samples' bits, so that pieces can be joined again.
        (enter <= leave)
            .then(|| (if enter > 0.0 { at(enter) } else { a }, if leave < 1.0 { at(leave) } else { b }))
    }
}

/// The lines that show these samples in the window. A sample that is not finite leaves a gap. Peaks
/// survive any reduction: a curve over an increasing x keeps the extremes of every half pixel, a
/// path in a plane its shape.
pub(super) fn lines(samples: impl IntoIterator<Item = SheetPoint>, window: Window) -> Vec<Vec<SheetPoint>> {
    let samples: Vec<SheetPoint> = samples.into_iter().collect();
    samples
        .split(|(x, y)| !(x.is_finite() && y.is_finite()))
        .filter(|run| !run.is_empty())
        .flat_map(|run| {
            let grows = run.windows(2).all(|pair| pair[0].0 <= pair[1].0);
            let kept = if grows { column_extremes(seen(run, window)) } else { spaced(run) };
            clipped(&straightened(&kept), window)
        })
        .collect()
}

/// The samples of an increasing x that lie in the window, and the next on either side.
fn seen(run: &[SheetPoint], window: Window) -> &[SheetPoint] {
    let from = run.partition_point(|p| p.0 < window.left).saturating_sub(1);
    let to = run.partition_point(|p| p.0 <= window.right) + 1;
    &run[from..to.clamp(from + 1, run.len())]
}

/// The first, lowest, highest and last sample of every column, in order.
fn column_extremes(run: &[SheetPoint]) -> Vec<SheetPoint> {
    run.chunk_by(|a, b| (a.0 / COLUMN).floor() == (b.0 / COLUMN).floor())
        .flat_map(|column| {
            let by_height = |a: &usize, b: &usize| column[*a].1.total_cmp(&column[*b].1);
            let low = (0..column.len()).min_by(by_height).unwrap_or(0);
            let high = (0..column.len()).max_by(by_height).unwrap_or(0);
            let mut kept = vec![0, low, high, column.len() - 1];
            kept.sort_unstable();
            kept.dedup();
            kept.into_iter().map(|i| column[i])
        })
        .collect()
}

/// A path without the samples that crowd around the last one kept; its ends stay.
fn spaced(run: &[SheetPoint]) -> Vec<SheetPoint> {
    let mut kept: Vec<SheetPoint> = Vec::new();
    for (i, &p) in run.iter().enumerate() {
        let near = kept.last().is_some_and(|k| {
            let (dx, dy) = (p.0 - k.0, p.1 - k.1);
            dx * dx + dy * dy < CLOSE * CLOSE
        });
        if !near || i + 1 == run.len() {
            kept.push(p);
        }
    }
    kept
}

/// A line without the points that a straight segment passes anyway, after Douglas and Peucker
/// (Cartographica 10(2), 1973).
fn straightened(run: &[SheetPoint]) -> Vec<SheetPoint> {
    let mut keep = vec![false; run.len()];
    let mut open = vec![(0, run.len() - 1)];
    while let Some((first, last)) = open.pop() {
        (keep[first], keep[last]) = (true, true);
        let distance = |i: usize| squared_distance(run[i], run[first], run[last]);
        let far = (first + 1..last).max_by(|a, b| distance(*a).total_cmp(&distance(*b)));
        if let Some(far) = far.filter(|&far| distance(far) > STRAY * STRAY) {
            open.extend([(first, far), (far, last)]);
        }
    }
    run.iter().zip(keep).filter_map(|(&p, keep)| keep.then_some(p)).collect()
}

/// Squared distance from a point to the segment from a to b.
fn squared_distance(p: SheetPoint, a: SheetPoint, b: SheetPoint) -> f64 {
    let (ux, uy) = (b.0 - a.0, b.1 - a.1);
    let (vx, vy) = (p.0 - a.0, p.1 - a.1);
    let length = ux * ux + uy * uy;
    let t = if length > 0.0 { ((vx * ux + vy * uy) / length).clamp(0.0, 1.0) } else { 0.0 };
    let (ex, ey) = (vx - t * ux, vy - t * uy);
    ex * ex + ey * ey
}

/// The pieces of a line inside the window.
fn clipped(run: &[SheetPoint], window: Window) -> Vec<Vec<SheetPoint>> {
    if let [point] = run {
        return if window.contains(*point) { vec![vec![*point]] } else { vec![] };
    }
    let mut pieces: Vec<Vec<SheetPoint>> = Vec::new();
    for pair in run.windows(2) {
        let Some((a, b)) = window.clip(pair[0], pair[1]) else { continue };
        match pieces.last_mut() {
            Some(piece) if piece.last() == Some(&a) => piece.push(b),
            _ => pieces.push(vec![a, b]),
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    const WINDOW: Window = Window { left: 0.0, top: 0.0, right: 800.0, bottom: 400.0 };

    #[test]
    fn a_peak_survives_the_reduction() {
        let samples = (0..100_000).map(|i| {
            let y = if i == 54_321 { 17.0 } else { 200.0 + f64::from(i % 7) };
            (f64::from(i) * 0.008, y)
        });
        let lines = lines(samples, WINDOW);
        let points: Vec<_> = lines.concat();
        assert!(points.iter().any(|p| p.1 == 17.0), "the peak is lost");
        assert!(points.len() < 8000, "{} points are too many", points.len());
    }

    #[test]
    fn a_smooth_curve_needs_few_points() {
        let samples = (0..100_000).map(|i| {
            let t = f64::from(i) / 100_000.0;
            (800.0 * t, 400.0 * t * t)
        });
        let points = lines(samples, WINDOW).concat();
        assert!(points.len() < 100, "{} points", points.len());
        for (x, y) in points {
            let t = x / 800.0;
            assert!((y - 400.0 * t * t).abs() < 1e-9, "a kept point is not a sample");
        }
    }

    #[test]
    fn what_is_not_finite_breaks_the_line() {
        let samples = [(0.0, 1.0), (1.0, 2.0), (2.0, f64::NAN), (3.0, 1.0), (f64::INFINITY, 0.0), (5.0, 5.0)];
        assert_eq!(
            lines(samples, WINDOW),
            [vec![(0.0, 1.0), (1.0, 2.0)], vec![(3.0, 1.0)], vec![(5.0, 5.0)]]
        );
        assert!(lines([], WINDOW).is_empty());
    }

    #[test]
    fn a_path_keeps_its_ends() {
        let samples = [(10.0, 10.0), (10.1, 10.0), (50.0, 90.0), (10.1, 10.2), (10.0, 10.1)];
        let points = lines(samples, WINDOW).concat();
        assert_eq!(points.first(), Some(&(10.0, 10.0)));
        assert_eq!(points.last(), Some(&(10.0, 10.1)));
        assert!(points.contains(&(50.0, 90.0)));
    }

    #[test]
    fn what_is_zoomed_in_on_is_drawn_from_its_own_samples() {
        let steps = (0..9).map(|i| (f64::from(i) * 500.0 - 2000.0, f64::from(i) * 50.0));
        assert_eq!(lines(steps, WINDOW).concat(), [(0.0, 200.0), (800.0, 280.0)]);
        assert!(lines([(-9.0, 1.0), (-5.0, 1.0)], WINDOW).is_empty());
        assert!(lines([(801.0, 1.0), (900.0, 1.0)], WINDOW).is_empty());
    }

    #[test]
    fn lines_end_at_the_border() {
        let pieces = lines([(-10.0, 200.0), (10.0, 200.0), (20.0, -100.0), (30.0, 200.0)], WINDOW);
        assert_eq!(pieces.len(), 2, "{pieces:?}");
        assert_eq!(pieces[0][0], (0.0, 200.0));
        assert!(pieces.concat().iter().all(|&p| WINDOW.contains(p)), "{pieces:?}");
        assert!(lines([(-5.0, -5.0), (900.0, -1.0)], WINDOW).is_empty());
    }
}
