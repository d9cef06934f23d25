//! Exported programs, read back by the crate's own readers: they are the compensated path within
//! the thinning tolerance, no more and no less, with its feeds and spindle speeds.

use crate::common::program::{example, examples, read_back, small_jobs};
use crate::common::run;
use armill::Report;
use armill::export::ExportOptions;
use armill::export::arc::Step;
use armill::export::command::{Command, CommandedMove};
use armill::export::commanded_path::CommandedPath;
use armill::export::style::PostStyle;
use armill::export::thin::LEVER;
use armill::path::{Move, MovePace, Path, Program, Segment};
use nalgebra::Vector3;

/// Rounding of the output: five decimals of a millimetre, six of an inch, nine of an axis.
const ROUNDING: f64 = 4e-8;

/// A tip [m] and the tool's axis there.
type Pose = (Vector3<f64>, Vector3<f64>);

/// Distance [m] of each of the points from the path, and the nearest place on it [m]. The nearest
/// point is sought only around the last one, and the path must be followed to its end: moving
/// backwards does not count.
fn follow<'a>(name: &str, points: impl Iterator<Item = &'a Vector3<f64>>, path: &Path) -> Vec<(f64, f64)> {
    const WINDOW: f64 = 3e-3;
    let mut s = 0.0;
    let nearest = points.map(|point| {
        let closest = path.closest(point, s, WINDOW);
        s = closest.s.clamp(0.0, path.length());
        ((closest.point - point).norm(), s)
    });
    let nearest: Vec<_> = nearest.collect();
    assert!(path.length() - s < WINDOW, "{name}: only followed to {s} of {} m", path.length());
    nearest
}

/// Commanded poses in the workpiece frame, one list per move of the path.
fn samples(report: &Report, commanded_path: &CommandedPath) -> Vec<Vec<Pose>> {
    let back = report.setup().workpiece.inverse();
    let axes = (0..report.samples()).map(|k| back.direction(commanded_path.axis.at(k)));
    let mut samples = commanded_path.positions(report).into_iter().map(|p| back.point(&p)).zip(axes);
    let arc_length = &report.plan.trajectory.timing.arc_length;
    let path = &report.plan.path;
    let moves = path.moves().len();
    let ends = (1..=moves).map(|i| if i == moves { f64::INFINITY } else { path.start(i) });
    ends.scan(0, |from, end| {
        let to = arc_length.partition_point(|s| *s < end);
        Some(samples.by_ref().take(to - std::mem::replace(from, to)).collect())
    })
    .collect()
}

fn path_of(moves: &[Move]) -> Option<Path> {
    Path::of_program(&Program { moves: moves.to_vec(), ..Program::default() })
}

fn is_the_compensated_path(name: &str, report: &Report, id: &str, thinning: f64) {
    let (export, program) = read_back(report, id, &ExportOptions { thinning: Some(thinning) });
    let name = format!("{name} as {id}, thinned to {thinning}");
    assert!(export.deviation <= thinning, "{name}: {}", export.deviation);
    let style = PostStyle {
        arcs: id == "gcode",
        inch: program.unit == "inch",
        points_only: id == "path-csv",
        ..PostStyle::default()
    };
    let command = Command::new(report, &export.commanded_path, Some(thinning), style).unwrap();
    assert_eq!(program.moves.len() + 1, command.points(), "{name}");
    let mut moves = program.moves.as_slice();
    for (commanded, poses) in command.moves.iter().zip(samples(report, &export.commanded_path)) {
        let own;
        (own, moves) = moves.split_at(commanded.steps.len());
        let name = format!("{name}, line {}", commanded.line);
        for (read, step) in own.iter().zip(&commanded.steps) {
            said(&format!("{name}, read in line {}", read.line), read, commanded, step, id);
        }
        // Every commanded point lies on the path read back, tip and axis.
        let Some(path) = path_of(own) else { continue };
        let on = follow(&name, poses.iter().map(|(tip, _)| tip), &path);
        for ((distance, s), (_, axis)) in on.iter().zip(&poses) {
            let measured = export.deviation + ROUNDING;
            assert!(*distance <= measured, "{name}: {distance}, measured {measured}");
            // Where the tip turns back by some micrometres, the nearest place may be on the way there
            // for a point on the way back.
            let turned = (-50..=50)
                .map(|step| (path.axis(s + f64::from(step) * 4e-7) - axis).norm() * LEVER)
                .fold(f64::INFINITY, f64::min);
            assert!(turned <= measured, "{name}: {turned}, measured {measured}");
        }
        // Every point read back lies on the commanded path: no move goes elsewhere. Between two
        // samples, 0.1 mm apart, an arc may bulge from their chord; the sharpest that undo a slow
        // shaper have radii of 0.3 mm.
        let ends = [path.point(0.0), path.point(path.length())];
        let tips = poses.iter().map(|(tip, _)| *tip);
        let points: Vec<_> = [ends[0]].into_iter().chain(tips).chain([ends[1]]).collect();
        let lines = points.windows(2).map(|pair| Segment::Line { from: pair[0], to: pair[1] });
        let Some(chain) = Path::new(lines.collect()) else { continue };
        let steps = (path.length() / 1e-4).ceil();
        let read: Vec<_> =
            (0..=steps as usize).map(|i| path.point(path.length() * i as f64 / steps)).collect();
        for (distance, _) in follow(&name, read.iter(), &chain) {
            assert!(distance <= thinning + 5e-6, "{name}: a move strays by {distance}");
        }
    }
}

/// A move states what it should: its end, its feed, whether it cuts, and its spindle speed.
fn said(name: &str, read: &Move, commanded: &CommandedMove, step: &Step, id: &str) {
    let end = read.segment.point(read.segment.length());
    assert!((end - step.to.position).norm() < ROUNDING, "{name}: {end}");
    assert!((read.axis_to - step.to.axis).norm() < 1e-8, "{name}");
    assert_eq!(matches!(read.segment, Segment::Arc { .. }), step.arc.is_some(), "{name}");
    match read.pace {
        MovePace::Rapid => assert!(commanded.rapid, "{name}"),
        MovePace::Feed(feed) => {
            assert!(!commanded.rapid || id == "path-csv", "{name}");
            assert!((feed - commanded.feed).abs() < 3e-8, "{name}: {feed} for {}", commanded.feed);
        }
        MovePace::JobFeed => panic!("{name}: no feed"),
    }
    if let Some(spindle) = read.spindle {
        assert!((spindle - commanded.spindle).abs() < 2e-4, "{name}: {spindle} for {}", commanded.spindle);
    }
}

#[test]
fn small_jobs_read_back() {
    for (name, changes) in small_jobs() {
        let report = run(&changes);
        for thinning in [1e-7, 1e-6, 2e-5] {
            for id in ["gcode", "apt", "path-csv"] {
                is_the_compensated_path(name, &report, id, thinning);
            }
        }
    }
}

#[test]
fn every_example_reads_back() {
    let reads_back = |number: usize, file: &str, kind: &str| {
        let report = run(&example(file, kind));
        let thinning = [1e-6, 1e-5][number % 2];
        for id in ["gcode", "apt", "path-csv"] {
            if id != "gcode" || !report.plan.path.is_multi_axis() {
                is_the_compensated_path(file, &report, id, thinning);
            }
        }
    };
    let all = examples();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for first in 0..threads {
            let (all, reads_back) = (&all, &reads_back);
            scope.spawn(move || {
                let mine = all.iter().enumerate().skip(first).step_by(threads);
                mine.for_each(|(number, (file, kind))| reads_back(number, file, kind));
            });
        }
    });
}
