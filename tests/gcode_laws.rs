//! Laws of the G-code reader: two notations of a path read as the same path, random programs have
//! no gaps, no text breaks it.

use crate::common::between;
use armill::math::{PI, TAU, cos, hypot, sin};
use armill::path::Segment;
use armill::path::gcode::{self, Options};
use armill::path::program::{MovePace, Program};
use nalgebra::Vector3;
use std::fmt::Write;

fn read(text: &str) -> Program {
    gcode::program(text, &Options::default(), |_| {}).unwrap_or_else(|error| panic!("{text}\n{error}"))
}

fn ends(segment: &Segment) -> [Vector3<f64>; 2] {
    match segment {
        Segment::Line { from, to } => [*from, *to],
        Segment::Arc { .. } => [segment.point(0.0), segment.point(segment.length())],
    }
}

/// Points along a program: 5 per move, and the end of the last.
fn points(program: &Program) -> Vec<Vector3<f64>> {
    let mut points = Vec::new();
    for step in &program.moves {
        points.extend((0..=4).map(|part| step.segment.point(step.segment.length() * f64::from(part) / 4.0)));
    }
    points
}

fn assert_same(one: &Program, other: &Program, tolerance: f64, text: &str) {
    let (one, other) = (points(one), points(other));
    assert_eq!(one.len(), other.len(), "{text}");
    for (a, b) in one.iter().zip(&other) {
        assert!((a - b).norm() < tolerance, "{a} {b}\n{text}");
    }
}

/// A coordinate as CAM systems print it: in steps of 0.001.
fn coordinate(random: &mut fastrand::Rng) -> f64 {
    between(random, -200.0, 200.0).round() + f64::from(random.u32(0..1000)) / 1000.0
}

/// A move of a random program, by its end and, for an arc, the ends' angles about the centre:
/// enough for either notation.
enum Step {
    Line([f64; 3]),
    Arc { counter_clockwise: bool, center: [f64; 2], end: [f64; 3], radius: f64, long: bool },
}

fn any_steps(random: &mut fastrand::Rng) -> Vec<Step> {
    let mut at = [0.0; 3];
    (0..20)
        .map(|_| {
            if random.bool() {
                at = [coordinate(random), coordinate(random), coordinate(random)];
                return Step::Line(at);
            }
            let (angle, radius) = (between(random, -3.0, 3.0), between(random, 5.0, 80.0));
            let center = [at[0] - radius * cos(angle), at[1] - radius * sin(angle)];
            let sweep = if random.bool() { between(random, 0.2, 3.0) } else { between(random, 3.3, 6.0) };
            let counter_clockwise = random.bool();
            let bearing = if counter_clockwise { angle + sweep } else { angle - sweep };
            at = [
                center[0] + radius * cos(bearing),
                center[1] + radius * sin(bearing),
                if random.bool() { at[2] } else { coordinate(random) },
            ];
            Step::Arc { counter_clockwise, center, end: at, radius, long: sweep > 3.2 }
        })
        .collect()
}

/// A notation for programs.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    Plain,
    Inches,
    Increments,
    CenterPoints,
    Radii,
}

fn write(steps: &[Step], way: Way) -> String {
    let head = if way == Way::Inches { "G20" } else { "G21" };
    let unit = if way == Way::Inches { 25.4 } else { 1.0 };
    let mut text = format!("{head} G90 G94 G0 X0 Y0 Z0 F10\n");
    text += match way {
        Way::Increments => "G91\n",
        Way::CenterPoints => "G90.1\n",
        _ => "",
    };
    let mut at = [0.0; 3];
    for step in steps {
        let end = match step {
            Step::Line(end) | Step::Arc { end, .. } => *end,
        };
        let from = if way == Way::Increments { at } else { [0.0; 3] };
        let [x, y, z] = [0, 1, 2].map(|axis| (end[axis] - from[axis]) / unit);
        match step {
            Step::Line(_) => writeln!(text, "G1 X{x:.15} Y{y:.15} Z{z:.15}").unwrap(),
            Step::Arc { counter_clockwise, center, radius, long, .. } => {
                let code = if *counter_clockwise { "G3" } else { "G2" };
                write!(text, "{code} X{x:.15} Y{y:.15} Z{z:.15} ").unwrap();
                let from = if way == Way::CenterPoints { [0.0; 3] } else { at };
                let [i, j] = [0, 1].map(|axis| (center[axis] - from[axis]) / unit);
                let signed = if *long { -radius } else { *radius };
                match way {
                    Way::Radii => writeln!(text, "R{signed:.15}").unwrap(),
                    _ => writeln!(text, "I{i:.15} J{j:.15}").unwrap(),
                }
            }
        }
        at = end;
    }
    text
}

#[test]
fn one_path_said_in_five_ways() {
    let mut random = fastrand::Rng::with_seed(31);
    for _ in 0..200 {
        let steps = any_steps(&mut random);
        let plain = read(&write(&steps, Way::Plain));
        for way in [Way::Inches, Way::Increments, Way::CenterPoints, Way::Radii] {
            let text = write(&steps, way);
            // A radius near half the chord locates its centre only to the root of the rounding:
            // 1e-7 m of 0.1 m.
            let tolerance = if way == Way::Radii { 1e-8 } else { 1e-11 };
            assert_same(&plain, &read(&text), tolerance, &text);
        }
    }
}

#[test]
fn arcs_lie_on_the_circle_that_was_meant_and_turn_the_way_that_was_meant() {
    let mut random = fastrand::Rng::with_seed(32);
    for _ in 0..200 {
        let steps = any_steps(&mut random);
        let program = read(&write(&steps, Way::Plain));
        assert_eq!(program.moves.len(), steps.len());
        for (step, read) in steps.iter().zip(&program.moves) {
            let Step::Arc { counter_clockwise, center, radius, end, long } = step else { continue };
            let Segment::Arc { u, v, sweep, .. } = read.segment else { panic!("an arc is read as an arc") };
            for part in 0..=10 {
                let point = read.segment.point(read.segment.length() * f64::from(part) / 10.0) * 1e3;
                let distance = (point.xy() - Vector3::new(center[0], center[1], 0.0).xy()).norm();
                assert!((distance - radius).abs() < 1e-9);
            }
            assert_eq!(u.cross(&v).z > 0.0, *counter_clockwise);
            assert_eq!(sweep > PI, *long);
            assert!((ends(&read.segment)[1] * 1e3 - Vector3::from(*end)).norm() < 1e-9);
        }
    }
}

#[test]
fn an_arc_run_backwards_is_as_long() {
    let mut random = fastrand::Rng::with_seed(33);
    for _ in 0..500 {
        let (x, y, z) = (coordinate(&mut random), coordinate(&mut random), coordinate(&mut random));
        let radius = hypot(x, y) / 2.0 * between(&mut random, 1.001, 3.0);
        let sign = if random.bool() { "" } else { "-" };
        let there = read(&format!("G21 G0 X0 Y0 Z0\nG3 X{x} Y{y} Z{z} R{sign}{radius}"));
        let back = read(&format!("G21 G0 X{x} Y{y} Z{z}\nG2 X0 Y0 Z0 R{sign}{radius}"));
        let (there, back) = (there.moves[0].segment, back.moves[0].segment);
        assert!((there.length() - back.length()).abs() < 1e-12);
        let middle = |segment: &Segment| segment.point(segment.length() / 2.0);
        assert!((middle(&there) - middle(&back)).norm() < 1e-12);
    }
}

#[test]
fn the_planes_are_one_another_turned() {
    // Axis 1 and 2 of each plane and its normal, with the letters of end and centre.
    let planes = [
        ("G17", ["X", "Y", "Z"], ["I", "J"]),
        ("G18", ["Z", "X", "Y"], ["K", "I"]),
        ("G19", ["Y", "Z", "X"], ["J", "K"]),
    ];
    let mut random = fastrand::Rng::with_seed(34);
    for _ in 0..200 {
        let code = if random.bool() { "G2" } else { "G3" };
        let (angle, sweep) = (between(&mut random, -3.0, 3.0), between(&mut random, -3.0, 3.0));
        let center = [-30.0 * cos(angle), -30.0 * sin(angle)];
        let end = [
            center[0] + 30.0 * cos(angle + sweep),
            center[1] + 30.0 * sin(angle + sweep),
            coordinate(&mut random),
        ];
        let all: Vec<Vec<Vector3<f64>>> = planes
            .iter()
            .map(|(plane, axes, offsets)| {
                let text = format!(
                    "G21 G0 X0 Y0 Z0\n{plane} {code} {}{:.15} {}{:.15} {}{:.15} {}{:.15} {}{:.15}",
                    axes[0],
                    end[0],
                    axes[1],
                    end[1],
                    axes[2],
                    end[2],
                    offsets[0],
                    center[0],
                    offsets[1],
                    center[1]
                );
                points(&read(&text))
            })
            .collect();
        for (xy, (zx, yz)) in all[0].iter().zip(all[1].iter().zip(&all[2])) {
            // (first, second, normal) are (X, Y, Z), (Z, X, Y) and (Y, Z, X).
            assert!((Vector3::new(zx.z, zx.x, zx.y) - xy).norm() < 1e-14);
            assert!((Vector3::new(yz.y, yz.z, yz.x) - xy).norm() < 1e-14);
        }
    }
}

#[test]
fn arcs_with_rounded_centres_keep_their_ends_and_stay_near_the_circle() {
    let mut random = fastrand::Rng::with_seed(35);
    for _ in 0..2000 {
        let (angle, radius) = (between(&mut random, -3.0, 3.0), between(&mut random, 3.0, 50.0));
        // Sweeps up to 0.02 mm short of one full turn, and beyond it.
        let sweep = if random.bool() { between(&mut random, 0.5, 6.2) } else { TAU - 0.02 / radius };
        let turns = random.u32(1..4);
        let round = |x: f64| (x * 1e3).round() / 1e3;
        let center = [round(-radius * cos(angle)), round(-radius * sin(angle))];
        let end = [radius * (cos(angle + sweep) - cos(angle)), radius * (sin(angle + sweep) - sin(angle))];
        let text = format!(
            "G21 G0 X0 Y0 Z0\nG3 X{:.4} Y{:.4} Z5 I{} J{} P{turns}",
            end[0], end[1], center[0], center[1]
        );
        let program = read(&text);
        assert_chained(&program, &text);
        let last = ends(&program.moves.last().unwrap().segment)[1] * 1e3;
        assert!((last - Vector3::new(end[0], end[1], 5.0)).norm() < 1e-4, "{text}");
        for point in points(&program) {
            let distance = hypot(point.x * 1e3 - center[0], point.y * 1e3 - center[1]);
            // Two coordinates rounded by half of 0.001 each: 0.0015 mm for difference and place
            // together; 0.001 to stay one piece.
            assert!((distance - radius).abs() < 2.5e-3, "{text} {distance}");
        }
        let turned: f64 = program
            .moves
            .iter()
            .map(|step| if let Segment::Arc { sweep, .. } = step.segment { sweep } else { 0.0 })
            .sum();
        let meant = sweep + TAU * f64::from(turns - 1);
        assert!((turned - meant).abs() < 3e-3 / radius.min(3.0), "{text} {turned} {meant}");
    }
}

/// Every move begins where the one before ended, and every number is finite.
fn assert_chained(program: &Program, text: &str) {
    let mut before: Option<(Vector3<f64>, f64)> = None;
    for step in &program.moves {
        let [from, to] = ends(&step.segment);
        let radius = if let Segment::Arc { radius, .. } = step.segment { radius } else { 0.0 };
        let size = 1.0 + from.norm() + to.norm() + radius;
        assert!(from.iter().chain(to.iter()).all(|x| x.is_finite()), "{text}");
        assert!(step.segment.length().is_finite() && step.segment.length() > 0.0, "{text}");
        if let Some((at, size_before)) = before {
            // Sine and cosine of many turns keep 1e-12 of the radius.
            assert!((at - from).norm() < 1e-11 * (size + size_before), "{at} {from}\n{text}");
        }
        before = Some((to, size));
        if let MovePace::Feed(feed) = step.pace {
            assert!(feed.is_finite() && feed > 0.0, "{text}");
        }
    }
    assert!(
        program.dwells.iter().all(|dwell| dwell.time >= 0.0 && dwell.after <= program.moves.len()),
        "{text}"
    );
    assert!(program.moves.iter().all(|step| step.spindle.is_none_or(|speed| speed > 0.0)), "{text}");
}

/// The lines of a text; LF, CR LF or CR ends one, and Ctrl-Z and NUL at the end of the text are no part of it.
fn lines_of(text: &str) -> impl Iterator<Item = String> {
    let filler = |sign: char| sign == '\0' || sign == '\u{1a}';
    let content = text.trim_end_matches(|sign: char| sign.is_whitespace() || filler(sign));
    let rest = &text[content.len()..];
    let blank = &rest[..rest.find(filler).unwrap_or(rest.len())];
    let unified = format!("{content}{blank}").replace("\r\n", "\n").replace('\r', "\n");
    unified.lines().map(str::to_owned).collect::<Vec<_>>().into_iter()
}

/// Reads a text that may be rejected; an error's place lies in the text.
fn survive(text: &str) -> bool {
    let mut lines = 0;
    match gcode::program(text, &Options::default(), |line| lines = line) {
        Ok(program) => {
            assert_chained(&program, text);
            assert_eq!((lines, program.lines), (lines_of(text).count(), lines));
            true
        }
        Err(error) => {
            let (line, column) = error.place().unwrap();
            let width = lines_of(text).nth(line - 1).unwrap().chars().count();
            assert!(
                line == lines + 1 && column >= 1 && column <= width + 1,
                "{line}:{column} {error}\n{text}"
            );
            false
        }
    }
}

#[test]
fn no_bytes_break_the_reader() {
    let mut random = fastrand::Rng::with_seed(36);
    let likely = b"GMXYZIJKRFSTPQLHNO0123456789.-+ ()/%;\n\n\r\t#[]ab\xc3\xa4";
    for _ in 0..20_000 {
        let bytes: Vec<u8> = (0..random.usize(0..80))
            .map(
                |_| if random.u8(0..10) == 0 { random.u8(..) } else { likely[random.usize(0..likely.len())] },
            )
            .collect();
        survive(&String::from_utf8_lossy(&bytes));
    }
}

#[test]
fn no_words_break_the_reader() {
    let mut random = fastrand::Rng::with_seed(37);
    let codes = [
        "G0", "G1", "G2", "G3", "G2", "G3", "G17", "G18", "G19", "G20", "G21", "G90", "G91", "G90.1",
        "G91.1", "G93", "G94", "G95", "G4", "G52", "G53", "G92", "G92.1", "G54", "G55", "G43", "G49", "G73",
        "G80", "G81", "G82", "G83", "G85", "G89", "G98", "G99", "M3", "M5", "M8",
    ];
    let letters = ['X', 'Y', 'Z', 'X', 'Y', 'Z', 'I', 'J', 'K', 'R', 'F', 'S', 'P', 'Q', 'L', 'H'];
    let values = [
        "0",
        "1",
        "-1",
        "2",
        "-2",
        "10",
        "-10",
        "0.5",
        "1000",
        "0.000001",
        "-0.0000001",
        "999999999",
        "1e",
        ".",
    ];
    let (mut whole, mut lines) = (0, 0);
    for _ in 0..20_000 {
        let mut text = String::from("G21 G0 X0 Y0 Z0 F100 S100\n");
        // Accepted lines are kept, so that programs build up odd states instead of ending at their
        // first mistake.
        for _ in 0..8 {
            let before = text.len();
            if random.bool() {
                write!(text, "{} ", codes[random.usize(0..codes.len())]).unwrap();
            }
            for _ in 0..random.usize(0..5) {
                let end = if random.u8(0..40) == 0 { values.len() } else { values.len() - 3 };
                let (letter, value) = (letters[random.usize(0..letters.len())], values[random.usize(0..end)]);
                write!(text, "{letter}{value} ").unwrap();
            }
            text.push('\n');
            if survive(&text) {
                lines += 1;
            } else {
                text.truncate(before);
            }
        }
        whole += usize::from(text.lines().count() > 1);
    }
    assert!(
        whole > 10_000 && lines > 20_000,
        "{whole} programs, {lines} lines: the words make sense often enough"
    );
}
