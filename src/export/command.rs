//! The compensated path as a program: the commanded samples of each move, thinned, in the workpiece
//! frame.
//!
//! A move becomes straight moves, or as few arcs as suffice, if the language has arcs and the move
//! is an arc about an axis of the workpiece frame. A sample belongs to the move that contains its
//! arc length. A commanded move ends at the move's own end plus the correction there. Samples at
//! rest in a corner belong to the move that follows: while the tool waits, the correction changes
//! from one direction of feed to the next.

use crate::error::Error;
use crate::export::arc::{self, Step, rounded};
use crate::export::chain;
use crate::export::commanded_path::CommandedPath;
use crate::export::fillet;
use crate::export::sampled::{MoveSamples, sampled_moves};
use crate::export::style::PostStyle;
use crate::export::thin::{self, Point};
use crate::math::{self, Pose};
use crate::path::program::Dwell;
use crate::path::{Move, MovePace, Path, Program, Segment};
use crate::report::{Report, millimetres};
use crate::units::{MM, RPM};
use nalgebra::Vector3;

/// Finest thinning tolerance [m].
pub const FINEST: f64 = 1e-7;
/// Coarsest thinning tolerance [m].
pub const COARSEST: f64 = 1e-2;
/// A smooth move is written in straight moves that turn by at most this share of the angle at which
/// the tool would stop.
const SMOOTH: f64 = 0.8;

/// The compensated path as moves of a program.
#[derive(Debug, Clone, PartialEq)]
pub struct Command {
    /// Where it starts.
    pub start: Point,
    /// One for each move of the path, in order.
    pub moves: Vec<CommandedMove>,
    /// Thinning tolerance [m].
    pub thinning: f64,
    /// Largest distance of a commanded sample from the moves as written [m], measured.
    pub deviation: f64,
    /// Number of commanded samples.
    pub samples: usize,
    /// How it is to be written.
    pub style: PostStyle,
    /// Where its moves are blended: the distance before the end of a move [m], or the share of the
    /// speed, by [`PostStyle::junctions`]; 0 is an exact stop.
    pub blend: f64,
    /// How it runs with its own timing, once it has been
    /// [rehearsed](crate::verification::rehearsal).
    pub run: Option<ProgramRun>,
    /// The desired path in the workpiece frame.
    pub(crate) path: Path,
}

/// How a program runs with its own timing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProgramRun {
    /// Largest contour error [m].
    pub reached: f64,
    /// Largest distance of a point of the desired path from the tip's way [m], where corners are
    /// blended.
    pub missed: f64,
    /// Time from the start to the end of the path [s].
    pub duration: f64,
    /// Number of full stops in between.
    pub stops: usize,
}

impl ProgramRun {
    /// The larger of its two errors [m].
    pub fn worst(&self) -> f64 {
        self.reached.max(self.missed)
    }
}

/// One move of the path, as commanded, or several that are written as one.
#[derive(Debug, Clone, PartialEq)]
pub struct CommandedMove {
    /// Line of the original program, from 1; 0 if there is none.
    pub line: usize,
    /// Whether it positions without cutting.
    pub rapid: bool,
    /// Speed along the commanded path [m/s]: at this speed of the command, the tip travels along
    /// the desired path at the desired feed.
    pub feed: f64,
    /// Spindle speed [1/s]: the program's where it states one, otherwise the job's.
    pub spindle: f64,
    /// Time at rest before it [s].
    pub wait: f64,
    /// Whether the tool comes to rest at its end.
    pub stops: bool,
    /// The steps written for it, in order; none if it is too short to be written.
    pub steps: Vec<Step>,
    /// Part of a robot's program that it belongs to, from 0.
    pub part: usize,
}

impl Command {
    /// A report's path along `commanded_path`, thinned to `thinning` [m]: by default a tenth of the
    /// job's tolerance, from [`FINEST`] to [`COARSEST`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a tolerance that is not from [`FINEST`] to [`COARSEST`];
    /// [`Error::Invalid`] if the thinned path strays further from the samples than that.
    pub fn new(
        report: &Report,
        commanded_path: &CommandedPath,
        thinning: Option<f64>,
        style: PostStyle,
    ) -> Result<Self, Error> {
        let thinning = checked(thinning, report)?;
        let back = report.setup().workpiece.inverse();
        let path = report.plan.path.placed(&back);
        let turn = SMOOTH * report.setup().limits.corner_angle;
        let back_at: Vec<f64> = match style.is_robot() {
            true => path
                .corners()
                .filter(|corner| corner.angle > chain::WAY_BACK)
                .map(|corner| corner.s)
                .collect(),
            false => Vec::new(),
        };
        let stops = report.plan.trajectory.stops.iter().map(|corner| corner.s);
        let mut rests: Vec<f64> = stops.chain(back_at).collect();
        rests.sort_unstable_by(f64::total_cmp);
        let rests = |s: f64| rests.binary_search_by(|stop| stop.total_cmp(&s)).is_ok();
        let mut start = None;
        let mut end: Option<Point> = None;
        let mut deviation = 0.0_f64;
        let mut moves = Vec::with_capacity(path.moves().len());
        let mut sampled = sampled_moves(report, commanded_path, &path, &back).into_iter();
        for chain in if style.is_robot() { chain::all(&path, rests) } else { chain::single(&path) } {
            let step = path.moves()[chain.start];
            let Some(mut sampled) = sampled.by_ref().take(chain.len()).reduce(MoveSamples::followed_by)
            else {
                break;
            };
            // A move starts where the previous one ends as written.
            let first = end.unwrap_or_else(|| rounded(&sampled.points[0], style.resolution()));
            sampled.points[0] = first;
            start.get_or_insert(first);
            let (steps, strayed) = if style.is_robot() {
                let normal = path.moves()[chain.clone()].iter().find_map(|step| turning_about(&step.segment));
                let rests = chain.end == path.moves().len() || rests(path.start(chain.end));
                chain::steps(
                    &sampled.points,
                    (normal, rests),
                    (thinning, report.setup().output.least_step),
                    style,
                )
            } else {
                steps(&sampled, &step.segment, (thinning, turn), style)
            };
            end = Some(steps.last().map_or(first, |last| last.to));
            deviation = deviation.max(strayed);
            let feed = match step.pace {
                MovePace::Rapid => report.setup().limits.rapid,
                MovePace::Feed(feed) => feed * sampled.stretch(),
                MovePace::JobFeed => report.setup().limits.feed * sampled.stretch(),
            };
            moves.push(CommandedMove {
                line: step.line,
                rapid: step.pace == MovePace::Rapid,
                feed: style.speed(feed),
                spindle: step
                    .spindle
                    .unwrap_or(report.setup().teeth_per_second / f64::from(report.setup().cut.flutes)),
                wait: sampled.wait,
                stops: chain.end == path.moves().len() || rests(path.start(chain.end)),
                steps,
                part: 0,
            });
        }
        if style.is_robot() {
            moves = chain::in_files(moves, report.setup().output.lines);
            chain::rest(&mut moves);
            if moves.iter().all(|commanded| commanded.steps.is_empty()) {
                let least = report.setup().output.least_step / MM;
                let expected = format!("less than the path's length of {} mm", path.length() / MM);
                return Err(Error::invalid("program.least_step_mm", least, expected));
            }
        }
        // Points that are merged may stray further; that is measured and said.
        if deviation > thinning && !style.is_robot() {
            return Err(Error::invalid(
                "thinning_mm",
                millimetres(thinning),
                format!(
                    "the samples deviate by {} mm from the thinned path; allow more",
                    millimetres(deviation)
                ),
            ));
        }
        let on_path = |s: f64| Point { position: path.point(s), axis: path.axis(s), spin: path.roll(s), s };
        let start = start.unwrap_or_else(|| on_path(0.0));
        Ok(Self {
            start,
            moves,
            thinning,
            deviation,
            samples: report.samples(),
            style,
            blend: 0.0,
            run: None,
            path,
        })
    }

    /// The program as a reader would read it.
    pub fn program(&self) -> Program {
        let mut program = Program { unit: "mm", ..Program::default() };
        let mut at = self.start;
        for commanded in &self.moves {
            let CommandedMove { line, rapid, feed, spindle, wait, .. } = *commanded;
            if wait > 0.0 && !self.style.points_only {
                program.dwells.push(Dwell { after: program.moves.len(), time: wait, line });
            }
            let pace = match rapid && !self.style.points_only {
                true => MovePace::Rapid,
                false => MovePace::Feed(feed),
            };
            for step in &commanded.steps {
                program.moves.push(Move {
                    segment: step.segment(&at),
                    axis_from: at.axis,
                    axis_to: step.to.axis,
                    pace,
                    spindle: (!self.style.points_only).then_some(spindle),
                    line,
                });
                at = step.to;
            }
        }
        program
    }

    /// Number of points, the start included.
    pub fn points(&self) -> usize {
        1 + self.moves.iter().map(|commanded| commanded.steps.len()).sum::<usize>()
    }

    /// Whether the tool axis differs from +Z of the workpiece frame anywhere.
    pub fn is_tilted(&self) -> bool {
        let tilted = |point: &Point| (point.axis - Vector3::z()).norm() > 1e-9;
        tilted(&self.start) || self.moves.iter().flat_map(CommandedMove::points).any(tilted)
    }

    /// Whether the tool axis of the desired path differs from +Z of the workpiece frame anywhere.
    pub fn is_desired_tilted(&self) -> bool {
        let tilted = |axis: &Vector3<f64>| (axis - Vector3::z()).norm() > 1e-9;
        self.path.moves().iter().any(|step| tilted(&step.axis_from) || tilted(&step.axis_to))
    }

    /// The TCP in the workpiece frame (see [`Path::orientation`]).
    pub fn pose(&self, point: &Point) -> Pose {
        Pose { rotation: self.path.orientation(point.s, &point.axis, point.spin), position: point.position }
    }
}

impl CommandedMove {
    /// Ends of its steps, in order.
    pub fn points(&self) -> impl DoubleEndedIterator<Item = &Point> + ExactSizeIterator {
        self.steps.iter().map(|step| &step.to)
    }

    /// Spindle speed [rev/min].
    pub fn rpm(&self) -> f64 {
        self.spindle / RPM
    }
}

/// The thinning tolerance [m]: as stated, or the default.
fn checked(stated: Option<f64>, report: &Report) -> Result<f64, Error> {
    let thinning = stated.unwrap_or((report.setup().goal.tolerance / 10.0).clamp(FINEST, COARSEST));
    if !(FINEST..=COARSEST).contains(&thinning) {
        return Err(Error::OutOfRange {
            field: "thinning_mm".into(),
            value: thinning / MM,
            min: FINEST / MM,
            max: COARSEST / MM,
            unit: "mm",
        });
    }
    Ok(thinning)
}

/// A move's samples as few moves that avoid turns of more than `turn` [rad], and the largest
/// distance of the samples from these moves [m].
fn steps(
    sampled: &MoveSamples,
    segment: &Segment,
    (thinning, turn): (f64, f64),
    style: PostStyle,
) -> (Vec<Step>, f64) {
    let points = sampled.points.as_slice();
    let resolution = style.resolution();
    // Rounding shifts the ends of straight moves, and a rounded centre shifts the arc that a
    // control makes of it.
    let tolerance = thinning - resolution;
    let thinned = |tolerance: f64, fillet: f64| {
        let kept = thin::smooth(points, tolerance, sampled.resting, turn);
        let ends: Vec<Point> = kept.iter().map(|&k| rounded(&points[k], resolution)).collect();
        let first = 1 + kept.iter().filter(|&&k| k < sampled.resting).count();
        let mut ends = fillet::round(&ends, first, turn, fillet, resolution);
        ends.iter_mut().flatten().for_each(|end| *end = rounded(end, resolution));
        let corners = ends.iter().any(|standing| standing.len() > 1);
        let strayed = thin::deviation(points, &kept, &ends);
        let mut ends = ends.concat();
        ends.dedup_by_key(|point| (point.position, point.axis, point.spin));
        let straight: Vec<Step> = ends.into_iter().skip(1).map(|to| Step { to, arc: None }).collect();
        (straight, strayed, corners)
    };
    let (mut straight, mut deviation, _) = thinned(tolerance, 0.0);
    if stops(&points[0], &straight, turn) > 0 {
        // The tool would stop in the middle of the move: half of the tolerance is spent on rounding
        // that corner.
        let (filleted, strayed, corners) = thinned(tolerance / 2.0, tolerance / 2.0 - resolution);
        if corners && strayed <= tolerance {
            (straight, deviation) = (filleted, strayed);
        }
    }
    if let Some(normal) = turning_about(segment).filter(|_| style.arcs && straight.len() > 1) {
        let (turned, strayed) = arc::steps(points, normal, tolerance - resolution, resolution);
        let stops = |steps: &[Step]| stops(&points[0], steps, turn);
        if turned.len() < straight.len() && stops(&turned) <= stops(&straight) {
            return (turned, strayed);
        }
    }
    (straight, deviation)
}

/// Number of moves from `start` that turn by more than `limit` [rad] from the previous one.
fn stops(start: &Point, steps: &[Step], limit: f64) -> usize {
    let mut from = *start;
    let tangents = steps.iter().map(|step| {
        let segment = step.segment(&std::mem::replace(&mut from, step.to));
        (segment.tangent(0.0), segment.tangent(segment.length()))
    });
    let tangents: Vec<_> = tangents.collect();
    tangents.windows(2).filter(|pair| math::angle_between(&pair[0].1, &pair[1].0) > limit).count()
}

/// The axis of the workpiece frame about which an arc turns, if it does.
fn turning_about(segment: &Segment) -> Option<usize> {
    let Segment::Arc { u, v, .. } = segment else { return None };
    let normal = u.cross(v);
    // Any remaining tilt is part of the measured deviation.
    (0..3).find(|&axis| normal[axis].abs() > 1.0 - 1e-6)
}
