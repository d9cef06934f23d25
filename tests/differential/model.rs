//! The whole pipeline a second time, as one plain loop after another.

use super::arm::{Arm, Joints, Refusal, column, frame};
use super::cut::{Beam, Cut, Force};
use super::way::{Instant, Piece, Tempo, Way};
use nalgebra::{Matrix4, Vector3};
use std::f64::consts::{PI, TAU};

/// A job in SI, with every preset resolved.
pub(crate) struct Question {
    pub(crate) arm: Arm,
    pub(crate) way: Way,
    /// Workpiece in the base frame.
    pub(crate) place: Matrix4<f64>,
    /// [rad]
    pub(crate) spin: f64,
    /// Front, elbow positive, wrist near.
    pub(crate) branch: [bool; 3],
    pub(crate) tempo: Tempo,
    /// Shares and delays [s].
    pub(crate) impulses: Vec<(f64, f64)>,
    pub(crate) cut: Cut,
    pub(crate) beam: Option<Beam>,
    /// [m]
    pub(crate) tolerance: f64,
    pub(crate) max_passes: usize,
    pub(crate) sources: Sources,
    /// [rad], as the robot shows them.
    pub(crate) limits: Option<[[f64; 2]; 6]>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Sources {
    pub(crate) deflection: bool,
    pub(crate) shaping: bool,
}

pub(crate) const ALL: Sources = Sources { deflection: true, shaping: true };

/// The result of joint commands, one per sample.
#[derive(Clone, Default)]
pub(crate) struct Outcome {
    pub(crate) q: Vec<Joints>,
    pub(crate) force: Vec<Vector3<f64>>,
    pub(crate) deflection: Vec<Vector3<f64>>,
    pub(crate) actual: Vec<Vector3<f64>>,
    pub(crate) error: Vec<f64>,
    /// [rad]
    pub(crate) tilt: Vec<f64>,
}

impl Outcome {
    /// Mean and largest contour error [m].
    pub(crate) fn figures(&self) -> [f64; 2] {
        let mut sum = 0.0;
        let mut max = 0.0;
        for error in &self.error {
            sum += error;
            if *error > max {
                max = *error;
            }
        }
        [sum / self.error.len() as f64, max]
    }
}

/// Everything that a report states.
pub(crate) struct Answer {
    pub(crate) force: Force,
    pub(crate) desired: Vec<Instant>,
    pub(crate) position: Vec<Vector3<f64>>,
    pub(crate) q: Vec<Joints>,
    pub(crate) deflection_only: Outcome,
    pub(crate) shaping_only: Outcome,
    pub(crate) before: Outcome,
    pub(crate) commanded: Vec<Vector3<f64>>,
    pub(crate) command_q: Vec<Joints>,
    pub(crate) after: Outcome,
    pub(crate) history: Vec<[f64; 2]>,
    pub(crate) passes: usize,
    /// Why a correction could not be commanded, if one could not.
    pub(crate) stopped: Option<Refusal>,
    /// How near the commands come to a singularity and, relative to the arm, to the end of its
    /// reach.
    pub(crate) regular: f64,
}

impl Answer {
    /// Whether a pass is so close to the stopping criterion that rounding decides.
    pub(crate) fn close_call(&self, question: &Question) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-4 * b;
        let ends = self
            .history
            .iter()
            .any(|[_, max]| near(*max, question.tolerance) || near(*max, 0.1 * question.tolerance));
        let stalls = |share| self.history.windows(2).any(|pair| near(pair[1][1], share * pair[0][1]));
        ends || stalls(0.99) || stalls(0.8)
    }
}

/// A rejected sample.
#[derive(Debug)]
pub(crate) struct Refused {
    pub(crate) sample: usize,
    pub(crate) why: Refusal,
}

/// Impulses of a shaper: N. Singer, W. Seering 1990; EI's fit for 5 %: W. Singhose, W. Seering, N.
/// Singer 1994.
pub(crate) fn impulses(kind: &str, w: f64, z: f64) -> Vec<(f64, f64)> {
    let root = (1.0 - z * z).sqrt();
    let (k, half) = ((-z * PI / root).exp(), PI / (w * root));
    let even = |shares: &[f64]| {
        let sum: f64 = shares.iter().sum();
        shares.iter().enumerate().map(|(i, share)| (share / sum, half * i as f64)).collect()
    };
    match kind {
        "none" => vec![(1.0, 0.0)],
        "zv" => even(&[1.0, k]),
        "zvd" => even(&[1.0, 2.0 * k, k * k]),
        "zvdd" => even(&[1.0, 3.0 * k, 3.0 * k * k, k * k * k]),
        _ => {
            let v = 0.05;
            let a1 =
                0.24968 + 0.24961 * v + 0.80008 * z + 1.23328 * v * z + 0.49599 * z * z + 3.17316 * v * z * z;
            let a3 =
                0.25149 + 0.21474 * v - 0.83249 * z + 1.41498 * v * z + 0.85181 * z * z - 4.90094 * v * z * z;
            let t2 = 0.4999
                + 0.46159 * v * z
                + 4.26169 * v * z * z
                + 1.75601 * v * z * z * z
                + 8.57843 * v * v * z
                - 108.644 * v * v * z * z
                + 336.989 * v * v * z * z * z;
            vec![(a1, 0.0), (1.0 - a1 - a3, t2 * 2.0 * half), (a3, 2.0 * half)]
        }
    }
}

impl Question {
    /// A sampled command, delayed and mixed (eq. 4.14): linear between samples, at rest before the
    /// first.
    fn shaped<T>(&self, command: &[T]) -> Vec<T>
    where
        T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
    {
        let at = |t: f64| {
            let place = (t / self.tempo.dt).max(0.0);
            let before = (place.floor() as usize).min(command.len() - 1);
            let part = place - before as f64;
            command[before] * (1.0 - part) + command[(before + 1).min(command.len() - 1)] * part
        };
        let mixed = |k: usize| {
            let parts =
                self.impulses.iter().map(|(share, delay)| at(k as f64 * self.tempo.dt - delay) * *share);
            parts.reduce(|sum, part| sum + part).unwrap()
        };
        (0..command.len()).map(mixed).collect()
    }

    fn shaped_joints(&self, q: &[Joints]) -> Vec<Joints> {
        let vectors: Vec<_> = q.iter().map(|q| nalgebra::Vector6::from(*q)).collect();
        self.shaped(&vectors).into_iter().map(Joints::from).collect()
    }

    /// The TCP's pose at a place: its z axis points into the part, its x axis is the workpiece's X
    /// projected across z, turned by the spin.
    fn tcp(&self, p: &Vector3<f64>) -> Matrix4<f64> {
        let axis = column(&self.place, 2);
        // The tool is upright in the workpiece, so the workpiece's X is perpendicular to it.
        let (x, y) = (column(&self.place, 0), column(&self.place, 1));
        let x = x * self.spin.cos() + y * self.spin.sin();
        let y = (-axis).cross(&x);
        let mut m = Matrix4::identity();
        for (i, v) in [x, y, -axis, *p].iter().enumerate() {
            m.fixed_view_mut::<3, 1>(0, i).copy_from(v);
        }
        m
    }

    fn joints(&self, positions: &[Vector3<f64>]) -> Result<Vec<Joints>, Refused> {
        let mut all: Vec<Joints> = Vec::with_capacity(positions.len());
        for (sample, p) in positions.iter().enumerate() {
            let tcp = self.tcp(p);
            let [front, elbow, near] = self.branch;
            let q = match all.last() {
                None => self.arm.first(&tcp, front, elbow, near),
                Some(last) => self.arm.next(&tcp, last),
            };
            all.push(q.map_err(|why| Refused { sample, why })?);
        }
        Ok(all)
    }

    /// Mean force at every sample, rotated with the feed (eq. 4.11).
    fn forces(&self, pace: &[Instant], force: &Force) -> Vec<Vector3<f64>> {
        let axis = column(&self.place, 2);
        let across = |heading: &Vector3<f64>| {
            let v = heading - axis * heading.dot(&axis);
            (v.norm() > 1e-6).then(|| v / v.norm())
        };
        let length = self.cut.run_in();
        let mut x = pace.iter().find_map(|at| across(&at.heading)).unwrap_or(column(&self.place, 0));
        let turned = |at: &Instant| {
            x = across(&at.heading).unwrap_or(x);
            let piece = self.way.piece(at.s);
            let Piece { limit, cuts, spindle, .. } = self.way.pieces[piece];
            if !cuts {
                return Vector3::zeros();
            }
            // The chip is the programmed one times the share of the programmed feed, and below a
            // tenth of that feed the edges' share falls too; a cut begins along a smooth step.
            let share = at.speed / limit;
            let whole = self.begun(at.s, length) * at.cuts;
            let chip = self.cut.per_tooth(limit, spindle) * share;
            let f = (force.cutting * chip + force.edge * f64::min(10.0 * share, 1.0)) * whole;
            x * f.x + axis.cross(&x) * f.y + axis * f.z
        };
        pace.iter().map(turned).collect()
    }

    /// Share of the force at a place by its run-in of this length [m].
    fn begun(&self, s: f64, length: f64) -> f64 {
        let piece = self.way.piece(s);
        if !self.way.pieces[piece].cuts {
            return 0.0;
        }
        let u = f64::min((s - self.way.began(piece, &column(&self.place, 2))) / length, 1.0);
        u * u * (3.0 - 2.0 * u)
    }

    /// Share of the force at every sample by the run-in; not a number on the border of two pieces,
    /// where that of either is right.
    pub(crate) fn run_in(&self, desired: &[Instant]) -> Vec<f64> {
        let length = self.cut.run_in();
        let share = |at: &Instant| if self.way.at_border(at.s) { f64::NAN } else { self.begun(at.s, length) };
        self.shaped_pace(desired).iter().map(share).collect()
    }

    /// Sends joint commands through shaper, arm and cut.
    fn outcome(&self, desired: &[Instant], q: &[Joints], force: &Force, acting: Sources) -> Outcome {
        let pace = if acting.shaping { self.shaped_pace(desired) } else { desired.to_vec() };
        let q = if acting.shaping { self.shaped_joints(q) } else { q.to_vec() };
        let force =
            if acting.deflection { self.forces(&pace, force) } else { vec![Vector3::zeros(); q.len()] };
        let mut outcome = Outcome { q, force, ..Outcome::default() };
        let tip = self.beam.map(|beam| beam.tip());
        for (k, q) in outcome.q.iter().enumerate() {
            let tcp = self.arm.forward(q);
            let axis = -column(&tcp, 2);
            let (mut moved, mut leaned) = (Vector3::zeros(), Vector3::zeros());
            if acting.deflection {
                let force = outcome.force[k];
                let (way, lean) = self.arm.give(q, &force);
                (moved, leaned) = (way, -lean);
                if let Some((way, turn)) = tip {
                    let across = force - axis * force.dot(&axis);
                    // The clamped bar's tip moves with the force; the axis, from tip to spindle,
                    // tilts back by the slope.
                    moved += across * way;
                    leaned -= across * turn;
                }
            }
            let actual = column(&tcp, 3) + moved;
            let away = (actual - self.way.point(pace[k].s)).norm();
            let axis = (axis + leaned).normalize();
            let upright = column(&self.place, 2);
            outcome.deflection.push(moved);
            outcome.actual.push(actual);
            outcome.error.push(self.way.distance(&actual, pace[k].s, away));
            outcome.tilt.push(axis.cross(&upright).norm().atan2(axis.dot(&upright)));
        }
        outcome
    }

    /// Fraction of the time during which the shaped tool cuts.
    pub(crate) fn shaped_cuts(&self, desired: &[Instant]) -> Vec<f64> {
        self.shaped_pace(desired).iter().map(|at| at.cuts).collect()
    }

    fn shaped_pace(&self, desired: &[Instant]) -> Vec<Instant> {
        let s = self.shaped(&desired.iter().map(|at| at.s).collect::<Vec<_>>());
        let speed = self.shaped(&desired.iter().map(|at| at.speed).collect::<Vec<_>>());
        let heading = self.shaped(&desired.iter().map(|at| at.heading).collect::<Vec<_>>());
        let cuts = self.shaped(&desired.iter().map(|at| at.cuts).collect::<Vec<_>>());
        (0..s.len())
            .map(|k| Instant { s: s[k], speed: speed[k], heading: heading[k], cuts: cuts[k] })
            .collect()
    }

    /// The whole result, or the sample that is out of reach.
    pub(crate) fn answer(&self) -> Result<Answer, Refused> {
        let force = self.cut.mean_force();
        let (desired, moving) = self.way.travel(&self.tempo);
        let position: Vec<_> = desired.iter().map(|at| self.way.point(at.s)).collect();
        let q = self.joints(&position)?;
        let turns = self.turns(&q);
        let turned = |all: Vec<Joints>| -> Vec<Joints> {
            all.into_iter().map(|q| std::array::from_fn(|i| q[i] + turns[i])).collect()
        };
        let q = turned(q);
        let outcome = |q: &[Joints], acting| self.outcome(&desired, q, &force, acting);
        let deflection_only = outcome(&q, Sources { deflection: true, shaping: false });
        let shaping_only = outcome(&q, Sources { deflection: false, shaping: true });
        let before = outcome(&q, ALL);
        let nothing = !self.sources.deflection && !self.sources.shaping;
        let acting = if nothing { ALL } else { self.sources };
        let mut best = match (acting.deflection, acting.shaping) {
            (true, false) => deflection_only.clone(),
            (false, true) => shaping_only.clone(),
            _ => before.clone(),
        };
        let mut correction = vec![Vector3::zeros(); q.len()];
        let mut command_q = q.clone();
        let mut history = vec![best.figures()];
        let (mut passes, mut stopped) = (0, None);
        // The tool's position when the shaper acts; the error there is added to the commands (eq.
        // 5.4).
        let pace = if acting.shaping { self.shaped_pace(&desired) } else { desired.clone() };
        for pass in 1..=if nothing { 0 } else { self.max_passes } {
            let [_, max] = history[passes];
            if max <= self.tolerance * if passes == 0 { 1.0 } else { 0.1 } {
                break;
            }
            let missing: Vec<_> =
                pace.iter().zip(&best.actual).map(|(at, tip)| self.way.point(at.s) - tip).collect();
            let more = if acting.shaping { self.unshaped(&missing, moving) } else { missing };
            let next: Vec<_> = correction.iter().zip(&more).map(|(c, more)| c + more).collect();
            let positions: Vec<_> = position.iter().zip(&next).map(|(p, c)| p + c).collect();
            let commands = match self.joints(&positions) {
                Ok(commands) => turned(commands),
                Err(refused) => {
                    stopped = Some(refused.why);
                    break;
                }
            };
            let result = outcome(&commands, acting);
            history.push(result.figures());
            if result.figures()[1] >= 0.99 * max {
                break;
            }
            (correction, command_q, best, passes) = (next, commands, result, pass);
            if history[pass][1] > 0.8 * max {
                break;
            }
        }
        let after = outcome(&command_q, ALL);
        let regular = q.iter().chain(&command_q).map(|q| self.arm.regular(q)).fold(f64::INFINITY, f64::min);
        let commanded = position.iter().zip(&correction).map(|(p, c)| p + c).collect();
        Ok(Answer {
            force,
            desired,
            position,
            q,
            deflection_only,
            shaping_only,
            before,
            commanded,
            command_q,
            after,
            history,
            passes,
            stopped,
            regular,
        })
    }

    /// The command whose shaped form is nearly this: 25 steps of Landweber's iteration, each with
    /// the shaper run backwards; at rest from `moving` on.
    fn unshaped(&self, wanted: &[Vector3<f64>], moving: usize) -> Vec<Vector3<f64>> {
        let mut command = vec![Vector3::zeros(); wanted.len()];
        for _ in 0..25 {
            let got = self.shaped(&command);
            let mut missing: Vec<_> = wanted.iter().zip(&got).map(|(wanted, got)| wanted - got).collect();
            missing.reverse();
            let mut more = self.shaped(&missing);
            more.reverse();
            for k in 0..command.len() {
                command[k] += more[k];
            }
            for k in moving..command.len() {
                command[k] = command[moving - 1];
            }
        }
        command
    }

    /// Whole turns [rad] that bring each joint into its range all along, or else at the start, or
    /// else none.
    fn turns(&self, q: &[Joints]) -> Joints {
        let Some(limits) = self.limits else { return [0.0; 6] };
        let displayed: Vec<_> = q.iter().map(|q| self.arm.displayed(q)).collect();
        let turns: Joints = std::array::from_fn(|i| {
            let fits = |samples: &[Joints], turn: f64| {
                samples.iter().all(|q| (limits[i][0]..=limits[i][1]).contains(&(q[i] + turn)))
            };
            let few = [0.0, TAU, -TAU, 2.0 * TAU, -2.0 * TAU];
            let found = few.iter().find(|turn| fits(&displayed, **turn));
            found.or_else(|| few.iter().find(|turn| fits(&displayed[..1], **turn))).copied().unwrap_or(0.0)
        });
        let [q1, q2, q3, q4, q5, q6] = turns;
        [q1, q2, q3 + self.arm.follows * q2, q4, q5, q6]
    }

    /// Whether a joint, by the desired or the compensated command, leaves its range; how near it
    /// comes to the range's end [rad].
    pub(crate) fn beyond(&self, answer: &Answer) -> Option<f64> {
        let limits = self.limits?;
        let mut worst = f64::NEG_INFINITY;
        for q in answer.q.iter().chain(&answer.command_q) {
            for (q, [low, high]) in self.arm.displayed(q).iter().zip(limits) {
                worst = worst.max(low - q).max(q - high);
            }
        }
        Some(worst)
    }
}

/// The frame of a job including its base: the workpiece in the base frame.
pub(crate) fn place(base: ([f64; 3], [f64; 3]), workpiece: ([f64; 3], [f64; 3])) -> Matrix4<f64> {
    frame(base.0, base.1).try_inverse().unwrap() * frame(workpiece.0, workpiece.1)
}
