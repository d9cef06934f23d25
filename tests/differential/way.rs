//! The desired path as plain curves, its closest point by sampling, and its timing by integrating
//! the speed.

use nalgebra::{Matrix4, Vector3};

use super::arm::{column, placed};

/// A line or an arc (helix), parametrised by arc length.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Curve {
    Line {
        from: Vector3<f64>,
        to: Vector3<f64>,
    },
    /// Centre, direction to the start, direction of motion at the start, radius [m], sweep [rad],
    /// rise along the third direction [m].
    Arc {
        center: Vector3<f64>,
        e1: Vector3<f64>,
        e2: Vector3<f64>,
        radius: f64,
        sweep: f64,
        rise: f64,
    },
}

impl Curve {
    pub(crate) fn length(&self) -> f64 {
        match self {
            Curve::Line { from, to } => (to - from).norm(),
            Curve::Arc { radius, sweep, rise, .. } => (radius * sweep).hypot(*rise),
        }
    }

    fn point(&self, s: f64) -> Vector3<f64> {
        let part = s / self.length();
        match self {
            Curve::Line { from, to } => from * (1.0 - part) + to * part,
            Curve::Arc { center, e1, e2, radius, sweep, rise } => {
                let (sin, cos) = (sweep * part).sin_cos();
                center + (e1 * cos + e2 * sin) * *radius + e1.cross(e2) * (rise * part)
            }
        }
    }

    fn tangent(&self, s: f64) -> Vector3<f64> {
        match self {
            Curve::Line { from, to } => (to - from) / self.length(),
            Curve::Arc { e1, e2, radius, sweep, rise, .. } => {
                let (sin, cos) = (sweep * s / self.length()).sin_cos();
                ((e2 * cos - e1 * sin) * (radius * sweep) + e1.cross(e2) * *rise) / self.length()
            }
        }
    }

    fn placed(&self, m: &Matrix4<f64>) -> Self {
        let turned = |v: &Vector3<f64>| placed(m, v) - column(m, 3);
        match *self {
            Curve::Line { from, to } => Curve::Line { from: placed(m, &from), to: placed(m, &to) },
            Curve::Arc { center, e1, e2, radius, sweep, rise } => Curve::Arc {
                center: placed(m, &center),
                e1: turned(&e1),
                e2: turned(&e2),
                radius,
                sweep,
                rise,
            },
        }
    }
}

/// A curve with its speed limits.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece {
    pub(crate) curve: Curve,
    /// Programmed feed, or the speed of rapids [m/s].
    pub(crate) limit: f64,
    pub(crate) cuts: bool,
    /// Spindle speed stated by the program [1/s].
    pub(crate) spindle: Option<f64>,
    /// Dwell after it, if the program asks for one [s].
    pub(crate) wait: f64,
}

/// Consecutive pieces, in the base frame.
#[derive(Debug, Clone)]
pub(crate) struct Way {
    pub(crate) pieces: Vec<Piece>,
    starts: Vec<f64>,
    /// Whether the path passes near itself, so that the closest point is sought only near a place.
    local: bool,
}

/// One instant of the desired motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Instant {
    pub(crate) s: f64,
    pub(crate) speed: f64,
    pub(crate) heading: Vector3<f64>,
    pub(crate) cuts: f64,
}

/// Distance from `p` to a curve between two places on it, if it is less than `least`.
fn nearest(p: &Vector3<f64>, curve: &Curve, from: f64, to: f64, least: f64) -> f64 {
    let count = if matches!(curve, Curve::Line { .. }) { 2 } else { 16 };
    let step = (to - from) / f64::from(count);
    let off = |s: f64| (p - curve.point(s)).norm();
    let tried: Vec<f64> = (0..=count).map(|k| off(from + step * f64::from(k))).collect();
    let mut best = tried.iter().copied().fold(f64::INFINITY, f64::min);
    // No point is nearer than this: the distance changes no faster than the arc length.
    if best - step / 2.0 > least {
        return best;
    }
    for k in 0..=count {
        let is = tried[k as usize];
        if (k > 0 && tried[k as usize - 1] < is) || (k < count && tried[k as usize + 1] < is) {
            continue;
        }
        let mut low = (from + step * f64::from(k - 1)).max(from);
        let mut high = (from + step * f64::from(k + 1)).min(to);
        while high - low > 1e-10 {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if off(a) < off(b) { high = b } else { low = a }
        }
        best = best.min(off((low + high) / 2.0));
    }
    best
}

/// Limits of the motion along the path [m/s^2, s, rad, s, s].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tempo {
    pub(crate) acceleration: f64,
    pub(crate) dt: f64,
    pub(crate) corner_angle: f64,
    pub(crate) corner_dwell: f64,
    pub(crate) settle: f64,
}

/// A stretch at constant acceleration.
struct Cell {
    piece: usize,
    start: f64,
    s: f64,
    speed: f64,
    acceleration: f64,
    duration: f64,
}

impl Way {
    pub(crate) fn new(pieces: Vec<Piece>, place: &Matrix4<f64>, local: bool) -> Self {
        let pieces: Vec<_> =
            pieces.iter().map(|piece| Piece { curve: piece.curve.placed(place), ..*piece }).collect();
        let mut starts = vec![0.0];
        for piece in &pieces {
            starts.push(starts[starts.len() - 1] + piece.curve.length());
        }
        Self { pieces, starts, local }
    }

    pub(crate) fn length(&self) -> f64 {
        self.starts[self.pieces.len()]
    }

    /// The piece that holds `s`.
    /// Where the cut of a piece began [m]: at the first one since the last rapid move, and since the
    /// last one that dives along `up`, if a flatter one follows it.
    pub(crate) fn began(&self, piece: usize, up: &Vector3<f64>) -> f64 {
        let dives = |i: usize| self.pieces[i].curve.tangent(0.0).dot(up) < -(60.0_f64.to_radians().sin());
        let mut first = piece;
        while first > 0 && self.pieces[first - 1].cuts && (!dives(first - 1) || dives(first)) {
            first -= 1;
        }
        self.starts[first]
    }

    /// Whether two pieces meet at a place, to rounding.
    pub(crate) fn at_border(&self, s: f64) -> bool {
        self.starts.iter().any(|start| (start - s).abs() < 1e-12)
    }

    pub(crate) fn piece(&self, s: f64) -> usize {
        (1..self.pieces.len()).rev().find(|&i| self.starts[i] <= s).unwrap_or(0)
    }

    pub(crate) fn point(&self, s: f64) -> Vector3<f64> {
        let i = self.piece(s);
        self.pieces[i].curve.point((s - self.starts[i]).clamp(0.0, self.pieces[i].curve.length()))
    }

    /// Distance from `p` to the nearest point of the path: many points of every piece, then thirds
    /// of the interval around the best of them. `near` is the tool's intended place; `away` how far
    /// `p` is from there.
    pub(crate) fn distance(&self, p: &Vector3<f64>, near: f64, away: f64) -> f64 {
        let length = self.length();
        // A path that meets itself again, or that is far away, is searched only near the tool's
        // place, as eq. 5.2 is meant.
        let reach =
            if self.local || away > 0.02 * length { (3.0 * away + 1e-6).min(length / 2.0) } else { length };
        let closed = (self.point(0.0) - self.point(length)).norm() < 1e-9;
        let laps: &[f64] = if closed { &[0.0, -1.0, 1.0] } else { &[0.0] };
        let mut least = f64::INFINITY;
        for lap in laps {
            for (piece, start) in self.pieces.iter().zip(&self.starts) {
                let from = (near - reach + lap * length - start).max(0.0);
                let to = (near + reach + lap * length - start).min(piece.curve.length());
                if from <= to {
                    least = least.min(nearest(p, &piece.curve, from, to, least));
                }
            }
        }
        least
    }

    /// Highest speed at `s` between the stops at `from` and `to`: every piece's limit within
    /// braking distance is respected.
    fn speed(&self, s: f64, from: usize, to: usize, acceleration: f64) -> f64 {
        let ends = (s - self.starts[from]).min(self.starts[to] - s).max(0.0);
        let mut squared = 2.0 * acceleration * ends;
        for i in from..to {
            let away = (self.starts[i] - s).max(s - self.starts[i + 1]).max(0.0);
            let limit = self.pieces[i].limit;
            squared = squared.min(limit * limit + 2.0 * acceleration * away);
        }
        squared.sqrt()
    }

    /// Halves an interval until the square of the speed is linear over it: then the acceleration is
    /// constant.
    fn cells(
        &self,
        piece: usize,
        (a, b): (f64, f64),
        v: &dyn Fn(f64) -> f64,
        clock: &mut f64,
        cells: &mut Vec<Cell>,
    ) {
        let (va, vb) = (v(a), v(b));
        let bent = [0.25, 0.5, 0.75].iter().any(|part| {
            let (straight, is) = (va * va * (1.0 - part) + vb * vb * part, v(a + (b - a) * part).powi(2));
            (is - straight).abs() > 1e-12 * (va * va + vb * vb)
        });
        if bent && b - a > 1e-13 {
            self.cells(piece, (a, (a + b) / 2.0), v, clock, cells);
            self.cells(piece, ((a + b) / 2.0, b), v, clock, cells);
            return;
        }
        if va + vb <= 0.0 {
            return;
        }
        let duration = 2.0 * (b - a) / (va + vb);
        cells.push(Cell {
            piece,
            start: *clock,
            s: a,
            speed: va,
            acceleration: (vb - va) / duration,
            duration,
        });
        *clock += duration;
    }

    /// Whether a sharp corner ends a move so short that Armill looks at more of the course.
    pub(crate) fn doubtful(&self, tempo: &Tempo) -> bool {
        self.pieces.windows(2).any(|pair| {
            let [before, after] = [pair[0].curve, pair[1].curve];
            let (arriving, leaving) = (before.tangent(before.length()), after.tangent(0.0));
            let turn = arriving.cross(&leaving).norm().atan2(arriving.dot(&leaving));
            turn > tempo.corner_angle && before.length().min(after.length()) < 1.25e-3
        })
    }

    /// The motion at uniform times, the exact end, and rest until the shaper has settled; the
    /// number of samples until the end.
    pub(crate) fn travel(&self, tempo: &Tempo) -> (Vec<Instant>, usize) {
        let count = self.pieces.len();
        let end_tangent = |i: usize| self.pieces[i].curve.tangent(self.pieces[i].curve.length());
        let mut instants = Vec::new();
        let mut clock = 0.0;
        let mut from = 0;
        while from < count {
            let mut to = from + 1;
            let mut rest = 0.0;
            while to < count {
                let (before, after) = (end_tangent(to - 1), self.pieces[to].curve.tangent(0.0));
                let sharp = before.cross(&after).norm().atan2(before.dot(&after)) > tempo.corner_angle;
                let asked = self.pieces[to - 1].wait;
                if sharp || asked > 0.0 {
                    rest = if sharp { asked.max(tempo.corner_dwell) } else { asked };
                    break;
                }
                to += 1;
            }
            let v = |s: f64| self.speed(s, from, to, tempo.acceleration);
            let mut cells = Vec::new();
            for i in from..to {
                for k in 0..8 {
                    let at = |k: usize| {
                        if k == 8 {
                            self.starts[i + 1]
                        } else {
                            self.starts[i] + self.pieces[i].curve.length() * k as f64 / 8.0
                        }
                    };
                    self.cells(i, (at(k), at(k + 1)), &v, &mut clock, &mut cells);
                }
            }
            for cell in &cells {
                while instants.len() as f64 * tempo.dt < cell.start + cell.duration {
                    let t = instants.len() as f64 * tempo.dt - cell.start;
                    let s = cell.s + cell.speed * t + cell.acceleration * t * t / 2.0;
                    let piece = &self.pieces[cell.piece];
                    let heading = piece.curve.tangent(s - self.starts[cell.piece]);
                    let cuts = if piece.cuts { 1.0 } else { 0.0 };
                    instants.push(Instant { s, speed: cell.speed + cell.acceleration * t, heading, cuts });
                }
            }
            if to < count {
                let arrived = clock;
                clock += rest;
                while (instants.len() as f64) * tempo.dt < clock {
                    let part = (instants.len() as f64 * tempo.dt - arrived) / rest;
                    let heading =
                        end_tangent(to - 1) * (1.0 - part) + self.pieces[to].curve.tangent(0.0) * part;
                    let cuts = if self.pieces[if part < 0.5 { to - 1 } else { to }].cuts { 1.0 } else { 0.0 };
                    instants.push(Instant { s: self.starts[to], speed: 0.0, heading, cuts });
                }
            }
            from = to;
        }
        let moving = instants.len() + 1;
        let cuts = if self.pieces[count - 1].cuts { 1.0 } else { 0.0 };
        let last = Instant { s: self.length(), speed: 0.0, heading: end_tangent(count - 1), cuts };
        instants.extend(vec![last; 1 + (tempo.settle / tempo.dt).ceil() as usize]);
        (instants, moving)
    }
}
