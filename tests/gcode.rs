//! The G-code reader: a table of snippets worked by hand, equivalent programs, and random texts.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]

use armill::Error;
use armill::path::Segment;
use armill::path::gcode::{self, Options};
use armill::path::program::{MovePace, Program};
use nalgebra::Vector3;
use std::f64::consts::PI;

/// The expected result of a snippet. Lengths in mm, feeds in mm/min.
enum Gives {
    /// The end of every move.
    Ends(&'static [[f64; 3]]),
    /// One arc: centre, normal about which it turns counter-clockwise, radius, angle swept in
    /// degrees, rise along that normal.
    Arc([f64; 3], [f64; 3], f64, f64, f64),
    /// The length of the whole path.
    Length(f64),
    /// The feed of every move: 0 for rapids, -1 for the job's feed.
    Feeds(&'static [f64]),
    /// A remark with this code at this line.
    Remark(&'static str, usize),
    /// Words without effect, each with its line.
    Ignored(&'static [(&'static str, usize)]),
    /// Rejected at this line and column; the message holds these words.
    Error(usize, usize, &'static str),
}

use Gives::{Arc, Ends, Feeds, Ignored, Length, Remark};

/// Precedes every snippet as line 1, so that snippets begin at line 2 with a known place and a
/// feed.
const HEAD: &str = "G21 G90 G94 F600 G0 X0 Y0 Z0";

const Z: [f64; 3] = [0.0, 0.0, 1.0];
const DOWN: [f64; 3] = [0.0, 0.0, -1.0];

fn read_with(text: &str, options: &Options) -> Result<Program, Error> {
    gcode::program(text, options, |_| {})
}

fn read(text: &str) -> Program {
    read_with(text, &Options::default()).unwrap_or_else(|error| panic!("{text}\n{error}"))
}

fn end(segment: &Segment) -> Vector3<f64> {
    segment.point(segment.length())
}

fn length(program: &Program) -> f64 {
    program.moves.iter().map(|step| step.segment.length()).sum()
}

fn feed(pace: MovePace) -> f64 {
    match pace {
        MovePace::Rapid => 0.0,
        MovePace::Feed(feed) => feed * 60e3,
        MovePace::JobFeed => -1.0,
    }
}

/// Programs are milled to micrometres; this arithmetic is good to 1e-9 mm.
fn near(found: f64, expected: f64) -> bool {
    (found - expected).abs() < 1e-9 * (1.0 + expected.abs())
}

fn check(name: &str, text: &str, gives: &Gives, options: &Options) {
    let outcome = read_with(text, options);
    if let Gives::Error(line, column, words) = gives {
        let error = outcome.expect_err(name);
        let message = error.to_string();
        assert_eq!(error.place(), Some((*line, *column)), "{name}: {message}");
        assert!(message.contains(words), "{name}: {message}");
        assert_eq!((error.code(), error.field()), ("text", Some("path.text")), "{name}");
        return;
    }
    let program = outcome.unwrap_or_else(|error| panic!("{name}: {error}"));
    match gives {
        Ends(ends) => {
            let found: Vec<[f64; 3]> =
                program.moves.iter().map(|step| (end(&step.segment) * 1e3).into()).collect();
            let same = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).all(|(&a, &b)| near(a, b));
            assert!(
                found.len() == ends.len() && found.iter().zip(*ends).all(|(a, b)| same(a, b)),
                "{name}: {found:?}"
            );
        }
        Arc(expected, normal, size, degrees, climb) => {
            assert_eq!(program.moves.len(), 1, "{name}");
            let Segment::Arc { center, u, v, radius, sweep, rise } = program.moves[0].segment else {
                panic!("{name}")
            };
            let found = (center * 1e3, u.cross(&v), radius * 1e3, sweep.to_degrees(), rise * 1e3);
            assert!((found.0 - Vector3::from(*expected)).norm() < 1e-9, "{name}: {found:?}");
            assert!((found.1 - Vector3::from(*normal)).norm() < 1e-12, "{name}: {found:?}");
            assert!(
                near(found.2, *size) && near(found.3, *degrees) && near(found.4, *climb),
                "{name}: {found:?}"
            );
        }
        Length(mm) => assert!(near(length(&program) * 1e3, *mm), "{name}: {}", length(&program) * 1e3),
        Feeds(feeds) => {
            let found: Vec<f64> = program.moves.iter().map(|step| feed(step.pace)).collect();
            assert!(
                found.len() == feeds.len() && found.iter().zip(*feeds).all(|(&a, &b)| near(a, b)),
                "{name}: {found:?}"
            );
        }
        Remark(code, line) => {
            let found: Vec<_> = program.remarks.iter().map(|remark| (remark.code, remark.line)).collect();
            assert!(found.contains(&(code, *line)), "{name}: {found:?}");
        }
        Ignored(words) => {
            let found: Vec<_> = program.ignored.iter().map(|word| (word.word.as_str(), word.line)).collect();
            assert_eq!(&found, words, "{name}");
        }
        Gives::Error(..) => unreachable!(),
    }
}

#[test]
#[rustfmt::skip] // One case a line where it fits.
fn lines_and_layout() {
    for (name, text, gives) in [
        ("a plain line", "G1 X10", Ends(&[[10., 0., 0.]])),
        ("no blanks", "N20G1X10Y5Z-2", Ends(&[[10., 5., -2.]])),
        ("lower case", "g1 x10 y5", Ends(&[[10., 5., 0.]])),
        ("blanks between letter and number", "G 1 X -1.5", Ends(&[[-1.5, 0., 0.]])),
        ("numbers without digits on one side", "G1 X1. Y.5 Z+2", Ends(&[[1., 0.5, 2.]])),
        ("leading zeros", "G01 X010 Y-00.50", Ends(&[[10., -0.5, 0.]])),
        ("axes carry over, motion is modal", "G1 X1\nY2\nZ3", Ends(&[[1., 0., 0.], [1., 2., 0.], [1., 2., 3.]])),
        ("words in any order", "X5 G1 Y1", Ends(&[[5., 1., 0.]])),
        ("codes of different groups share a line", "G90 G17 G21 G1 X3 M8 F100", Ends(&[[3., 0., 0.]])),
        ("both kinds of comment", "G1 (X9) X1 ; X2", Ends(&[[1., 0., 0.]])),
        ("a comment with letters of every alphabet", "G1 X1 (Schlichten \u{d8}10 \u{2013} ;ok) Y1", Ends(&[[1., 1., 0.]])),
        ("semicolon comment with brackets", "G1 X1 ; (open", Ends(&[[1., 0., 0.]])),
        ("block delete on", "/G1 X5\nG1 X1", Ends(&[[1., 0., 0.]])),
        ("numbered block delete after N", "N10 /2 G1 X5 [\nG1 X1", Ends(&[[1., 0., 0.]])),
        ("a left-out line is listed", "/G1 X5", Ignored(&[("/G1 X5", 2)])),
        ("a left-out line is remarked", "/G1 X5", Remark("block-delete", 2)),
        ("carriage returns and empty lines", "\r\nG1 X1\r\n\r\n", Ends(&[[1., 0., 0.]])),
        ("a move to where the tool is", "G1 X0\nX1", Ends(&[[1., 0., 0.]])),
        ("minus zero is zero", "G1 X-0 Y1", Ends(&[[0., 1., 0.]])),
        ("the program ends at M30", "G1 X1\nM30\nX2", Ends(&[[1., 0., 0.]])),
        ("what follows the end is remarked", "M2\nX2", Remark("text-after-end", 3)),
        ("a percent sign ends", "G1 X1\n%\nX2", Ends(&[[1., 0., 0.]])),
        ("the motion of the M30 line is made", "G1 X1 M30", Ends(&[[1., 0., 0.]])),
        (
            "harmless words are listed",
            "T1 M6 M8\nG40 G49 G80\nG64 P0.01 M5",
            Ignored(&[("M8", 2), ("T1", 2), ("M6", 2), ("G40", 3), ("G64", 4), ("P0.01", 4)]),
        ),
        ("corner blending is remarked", "G64 P0.01", Remark("blending", 2)),
        ("another tool is remarked", "T1 M6\nT2 M6", Remark("tool-change", 3)),
        ("a common first line of CAM posts", "G0 G17 G40 G49 G80 G90\nX1", Ends(&[[1., 0., 0.]])),
    ] {
        check(name, &format!("{HEAD}\n{text}"), &gives, &Options::default());
    }
}

#[test]
#[rustfmt::skip] // One case a line where it fits.
fn units_and_distances() {
    for (name, text, gives) in [
        ("inch", "G20 G1 X1 Y-0.5", Ends(&[[25.4, -12.7, 0.]])),
        ("inch by G70, back by G71", "G70 G1 X1\nG71 X1", Ends(&[[25.4, 0., 0.], [1., 0., 0.]])),
        ("the unit counts for its whole line, feed too", "X1 F10 G1 G20", Feeds(&[254.])),
        ("a feed keeps its size when the unit changes", "G20\nG1 X1", Feeds(&[600.])),
        ("a change of unit is remarked", "G20 X1", Remark("unit-change", 2)),
        ("steps", "G91 G1 X1\nX1 Y1\nG90 X0", Ends(&[[1., 0., 0.], [2., 1., 0.], [0., 1., 0.]])),
        ("steps in inches", "G91 G20 G1 Z-1\nZ-1", Ends(&[[0., 0., -25.4], [0., 0., -50.8]])),
        ("tenths add up to the whole", "G91 G1 X0.1\nX0.1\nX0.1\nG90 X0.3", Length(0.3)),
    ] {
        check(name, &format!("{HEAD}\n{text}"), &gives, &Options::default());
    }
}

#[test]
#[rustfmt::skip] // One case a line where it fits.
fn arcs() {
    for (name, text, gives) in [
        ("quarter, counter-clockwise", "G1 X10\nG3 X0 Y10 I-10 J0", Length(10. + 5. * PI)),
        ("half circle by I", "G3 X20 I10", Arc([10., 0., 0.], Z, 10., 180., 0.)),
        ("half circle the other way", "G2 X20 I10", Arc([10., 0., 0.], DOWN, 10., 180., 0.)),
        ("quarter clockwise about the origin of I J", "G2 X10 Y10 I10 J0", Arc([10., 0., 0.], DOWN, 10., 90., 0.)),
        ("three quarters", "G3 X10 Y10 I10 J0", Arc([10., 0., 0.], Z, 10., 270., 0.)),
        ("full circle without axis words", "G2 I5", Arc([5., 0., 0.], DOWN, 5., 360., 0.)),
        ("full circle with axis words", "G3 X0 Y0 I0 J-4", Arc([0., -4., 0.], Z, 4., 360., 0.)),
        ("circle of which one axis is named", "G3 X0 J2", Arc([0., 2., 0.], Z, 2., 360., 0.)),
        ("three turns in place", "G3 I5 P3", Arc([5., 0., 0.], Z, 5., 1080., 0.)),
        ("one turn and a quarter", "G2 X10 Y10 I10 P2", Arc([10., 0., 0.], DOWN, 10., 450., 0.)),
        ("centre as a point", "G90.1 G2 X10 Y10 I10 J0", Arc([10., 0., 0.], DOWN, 10., 90., 0.)),
        ("centre as a step again", "G90.1\nG91.1 G3 X20 I10", Arc([10., 0., 0.], Z, 10., 180., 0.)),
        ("centre steps under G91", "G91 G3 X20 I10", Arc([10., 0., 0.], Z, 10., 180., 0.)),
        ("radius, the short way, counter-clockwise: centre left of the chord", "G3 X10 Y10 R10", Arc([0., 10., 0.], Z, 10., 90., 0.)),
        ("radius, the short way, clockwise", "G2 X10 Y10 R10", Arc([10., 0., 0.], DOWN, 10., 90., 0.)),
        ("radius below 0, the long way", "G2 X10 Y10 R-10", Arc([0., 10., 0.], DOWN, 10., 270., 0.)),
        ("radius below 0, counter-clockwise", "G3 X10 Y10 R-10", Arc([10., 0., 0.], Z, 10., 270., 0.)),
        ("radius of half the chord", "G3 X20 R10", Arc([10., 0., 0.], Z, 10., 180., 0.)),
        ("radius short by rounding (0.0001 of 10) is half a circle", "G3 X20 R9.9999", Arc([10., 0., 0.], Z, 10., 180., 0.)),
        ("3-4-5: chord 8, radius 5, centre 3 above", "G3 X8 R5", Arc([4., 3., 0.], Z, 5., 106.26020470831196, 0.)),
        ("inch arc", "G20 G3 X2 I1", Arc([25.4, 0., 0.], Z, 25.4, 180., 0.)),
        ("helix up, counter-clockwise", "G3 X20 I10 Z5", Arc([10., 0., 0.], Z, 10., 180., 5.)),
        ("helix up, clockwise: rises against its normal", "G2 X20 I10 Z5", Arc([10., 0., 0.], DOWN, 10., 180., -5.)),
        ("helix bore: a full turn and 2 down, length hypot(10 pi, 2)", "G3 I5 Z-2", Length(31.479524140446212)),
        ("helix ends where programmed", "G2 X20 I10 Z-3 P4", Ends(&[[20., 0., -3.]])),
        ("G18 counter-clockwise is seen from +Y: from Z to X", "G18 G3 X10 Z-10 K-10", Arc([0., 0., -10.], [0., 1., 0.], 10., 90., 0.)),
        ("G18 clockwise: from Z to -X", "G18 G2 X-10 Z-10 K-10", Arc([0., 0., -10.], [0., -1., 0.], 10., 90., 0.)),
        ("G18 radius, clockwise", "G18 G2 X-10 Z-10 R10", Arc([0., 0., -10.], [0., -1., 0.], 10., 90., 0.)),
        ("G18 helix rises along Y", "G18 G3 X10 Z-10 K-10 Y2", Arc([0., 0., -10.], [0., 1., 0.], 10., 90., 2.)),
        ("G19 counter-clockwise is seen from +X: from Y to Z", "G19 G3 Y-10 Z10 J-10", Arc([0., -10., 0.], [1., 0., 0.], 10., 90., 0.)),
        ("arcs are modal", "G2 X20 I10\nX0 I-10", Ends(&[[20., 0., 0.], [0., 0., 0.]])),
        ("an end 0.002 before the start: which way was meant?", "G3 X0 Y-0.002 I-10", Remark("nearly-full-circle", 2)),
        ("centre rounded to 0.001: ends stay, centre moves to (10, 0)", "G3 X20 I10.002", Arc([10., 0., 0.], Z, 10., 180., 0.)),
    ] {
        check(name, &format!("{HEAD}\n{text}"), &gives, &Options::default());
    }
}

#[test]
#[rustfmt::skip] // One case a line where it fits.
fn feeds_speeds_and_waits() {
    for (name, text, gives) in [
        ("rapids have no feed, feed is modal", "G0 X1\nG1 X2\nX3 F1200", Feeds(&[0., 600., 1200.])),
        ("inverse time: 10 mm in 1/2 min", "G93 G1 X10 F2", Feeds(&[20.])),
        ("inverse time on an arc: 10 pi mm in a minute", "G93 G3 X20 I10 F1", Feeds(&[10. * PI])),
        ("feed a revolution: 0.1 mm at 1000 rpm", "S1000 G95 G1 X10 F0.1", Feeds(&[100.])),
        ("feed a revolution follows S", "S1000 G95 G1 X10 F0.1\nS500 X20", Feeds(&[100., 50.])),
        ("another feed mode forgets F", "S100 G95 F0.1\nG94 G1 X1", Feeds(&[-1.])),
        ("and says so", "S100 G95 F0.1\nG94 G1 X1", Remark("feed-missing", 3)),
        ("cutting with the spindle off", "M3 S100\nM5\nG1 X1", Remark("spindle-stopped", 4)),
        ("S alone does not start it", "M3 S100\nM5\nS200 G1 X1", Remark("spindle-stopped", 4)),
        ("a long wait without a point is milliseconds", "G4 P500", Remark("dwell-milliseconds", 2)),
        ("a long wait in seconds", "G4 P60.5", Remark("long-dwell", 2)),
        ("a feed of 0", "G1 X1 F0", Remark("feed-zero", 2)),
    ] {
        check(name, &format!("{HEAD}\n{text}"), &gives, &Options::default());
    }
    let program = read(&format!("{HEAD}\nM3 S6000 G1 X1\nG4 P0.25\nX2 S3000"));
    let spindle: Vec<_> = program.moves.iter().map(|step| step.spindle.unwrap()).collect();
    assert!(near(spindle[0], 100.0) && near(spindle[1], 50.0), "{spindle:?}");
    let dwells: Vec<_> = program.dwells.iter().map(|dwell| (dwell.after, dwell.time, dwell.line)).collect();
    assert_eq!(dwells, [(1, 0.25, 3)]);
    assert_eq!(program.moves.iter().map(|step| step.line).collect::<Vec<_>>(), [2, 4]);
    assert_eq!(
        read("G0 X0 Y0 Z0\nG1 X1").remarks.iter().filter(|remark| remark.code == "feed-missing").count(),
        1
    );
}

#[test]
#[rustfmt::skip] // One case a line where it fits.
fn offsets() {
    let mut options = Options::default();
    options.work_offsets[0] = Some(Vector3::new(0.1, 0.0, 0.0));
    options.work_offsets[1] = Some(Vector3::new(0.0, 0.2, 0.0));
    options.work_offsets[8] = Some(Vector3::new(0.0, 0.0, 0.3));
    options.tool_length_offsets.extend([(1, 0.005), (7, -0.001)]);
    options.start = Some(Vector3::zeros());
    for (name, text, gives) in [
        ("G54 from the start", "G1 X10", Ends(&[[110., 0., 0.]])),
        ("G55: only named axes move", "G1 X10\nG55 X10\nY0", Ends(&[[110., 0., 0.], [10., 0., 0.], [10., 200., 0.]])),
        ("G59.3", "G59.3 G1 Z1", Ends(&[[0., 0., 301.]])),
        ("an axis without word does not jump", "G55 G1 Z1", Ends(&[[0., 0., 1.]])),
        ("G53 is no point of the workpiece", "G53 G0 X10\nX10", Ends(&[[110., 0., 0.]])),
        ("nor is G28", "G28 X5\nG91 G28 Z0\nG90 G0 X10", Ends(&[[110., 0., 0.]])),
        (
            "one that moves Z goes up to where the tool has been",
            "G1 Z5\nZ-1\nG53 G0 Z0\nX10",
            Ends(&[[0., 0., 5.], [0., 0., -1.], [0., 0., 5.], [110., 0., 5.]]),
        ),
        ("as G30 does", "G0 Z5\nG1 Z-1\nG91 G30 Z0 M5\nX1", Ends(&[[0., 0., 5.], [0., 0., -1.], [0., 0., 5.], [1., 0., 5.]])),
        ("tool length", "G43 H1 G0 Z10\nG49 Z10", Ends(&[[0., 0., 15.], [0., 0., 10.]])),
        ("tool length of another tool, subtracted", "G43 H7 G0 Z10\nG44 H1 Z10", Ends(&[[0., 0., 9.], [0., 0., 5.]])),
        ("H0 is no offset", "G43 H0 G0 Z10", Ends(&[[0., 0., 10.]])),
        ("G92: here is X5, so X0 lies 5 back", "G92 X5\nG1 X0", Ends(&[[-5., 0., 0.]])),
        ("G92 twice", "G92 X5\nG92 X1\nG1 X0", Ends(&[[-1., 0., 0.]])),
        ("G92.1 clears", "G92 X5\nG92.1 G1 X1", Ends(&[[101., 0., 0.]])),
        ("G52 on top of the work offset", "G52 X7\nG1 X1\nG52 X0\nX1", Ends(&[[108., 0., 0.], [101., 0., 0.]])),
        ("absolute centres count from the program's zero", "G0 X0\nG90.1 G3 X20 Y0 I10 J0", Length(100. + 10. * PI)),
        ("H that is not in the table", "G43 H2", Gives::Error(1, 5, "1, 7")),
        ("G52 and G92 do not mix", "G92 X1\nG52 X1", Gives::Error(2, 1, "G92.1")),
    ] {
        check(name, text, &gives, &options);
    }
    for (name, text, gives) in [
        ("a position of the machine", "G53 G0 X1", Remark("machine-zero", 2)),
        ("no offset for G55", "G55", Remark("work-offset-missing", 2)),
        ("no table for H", "G43 H5 Z3", Remark("tool-length-missing", 2)),
        ("and the tip stays where programmed", "G43 H5 Z3", Ends(&[[0., 0., 3.]])),
    ] {
        check(name, &format!("{HEAD}\n{text}"), &gives, &Options::default());
    }
}

#[test]
#[rustfmt::skip] // One case a line where it fits.
fn canned_cycles() {
    for (name, text, gives) in [
        (
            "G81, back to the level before",
            "Z10\nG81 X5 Z-3 R2",
            Ends(&[
                [0., 0., 10.], [5., 0., 10.], [5., 0., 2.], [5., 0., -3.], [5., 0., 10.],
            ]),
        ),
        (
            "G99: back to R, next hole from there",
            "Z10\nG99 G81 X5 Z-3 R2\nX6",
            Ends(&[
                [0., 0., 10.], [5., 0., 10.], [5., 0., 2.], [5., 0., -3.], [5., 0., 2.],
                [6., 0., 2.], [6., 0., -3.], [6., 0., 2.],
            ]),
        ),
        ("from below R the tool rises first", "G81 X5 Z-3 R2", Ends(&[[0., 0., 2.], [5., 0., 2.], [5., 0., -3.], [5., 0., 2.]])),
        ("only the way down cuts", "Z10\nG81 X5 Z-3 R2", Feeds(&[0., 0., 0., 600., 0.])),
        ("G85 cuts on the way up too", "Z10\nG85 X5 Z-3 R2", Feeds(&[0., 0., 0., 600., 600., 0.])),
        (
            "G83 with Q2: 2 to 0 to -2 to -3, back to R, 0.254 above the last depth",
            "G83 X5 Z-3 R2 Q2",
            Ends(&[
                [0., 0., 2.], [5., 0., 2.], [5., 0., 0.], [5., 0., 2.], [5., 0., 0.254],
                [5., 0., -2.], [5., 0., 2.], [5., 0., -1.746], [5., 0., -3.], [5., 0., 2.],
            ]),
        ),
        (
            "G83 whose depth is a multiple of Q has no empty peck",
            "G99 G83 Z-2 R1 Q1.5",
            Ends(&[
                [0., 0., 1.], [0., 0., -0.5], [0., 0., 1.], [0., 0., -0.246], [0., 0., -2.],
                [0., 0., 1.],
            ]),
        ),
        (
            "G73 breaks the chip in the hole",
            "G73 Z-2 R1 Q2",
            Ends(&[
                [0., 0., 1.], [0., 0., -1.], [0., 0., -0.746], [0., 0., -2.], [0., 0., 1.],
            ]),
        ),
        (
            "G91: R from the start, bottom from R, L holes a step apart",
            "Z10\nG91 G81 X5 Z-4 R-8 L2",
            Ends(&[
                [0., 0., 10.], [5., 0., 10.], [5., 0., 2.], [5., 0., -2.], [5., 0., 10.],
                [10., 0., 10.], [10., 0., 2.], [10., 0., -2.], [10., 0., 10.],
            ]),
        ),
        ("G80 ends the cycle", "G81 Z-1 R0\nG80 G1 X1", Ends(&[[0., 0., -1.], [0., 0., 0.], [1., 0., 0.]])),
        ("L0 drills nothing but remembers", "G81 Z-1 R0 L0\nX1", Ends(&[[1., 0., 0.], [1., 0., -1.], [1., 0., 0.]])),
        ("in G19 the drill points along X", "G19 G81 Y2 X-3 R0", Ends(&[[0., 2., 0.], [-3., 2., 0.], [0., 2., 0.]])),
        ("a cycle without R starts at the level before", "G81 X1 Z-1", Ends(&[[1., 0., 0.], [1., 0., -1.], [1., 0., 0.]])),
        ("with a remark", "G81 X1 Z-1", Remark("cycle-clearance", 2)),
        (
            "K repeats as L does",
            "G91 G81 X5 Z-1 R0 K2",
            Ends(&[
                [5., 0., 0.], [5., 0., -1.], [5., 0., 0.],
                [10., 0., 0.], [10., 0., -1.], [10., 0., 0.],
            ]),
        ),
        ("a peck of 0 drills in one go", "G83 Z-2 R1 Q0", Ends(&[[0., 0., 1.], [0., 0., -2.], [0., 0., 1.]])),
        ("another cycle needs its own words", "G81 Z-1 R1\nG82 X1", Gives::Error(3, 1, "depth")),
        ("G82 without P", "G82 Z-1 R1", Gives::Error(2, 1, "seconds")),
        ("G83 without Q", "G83 Z-1 R1", Gives::Error(2, 1, "Q")),
        ("a million pecks", "G83 Z-1 R1 Q0.000001", Gives::Error(2, 1, "at most 1000")),
        ("bottom above R", "G81 Z5 R1", Gives::Error(2, 1, "above")),
        ("half a repeat", "G81 Z-1 R1 L1.5", Gives::Error(2, 12, "whole")),
        ("a cycle at inverse time", "G93 G81 Z-1 R1 F1", Gives::Error(2, 5, "G94")),
        (
            "after G80 the motion before the cycle is in force",
            "G1 X1\nG81 Z-1 R0\nG80\nX3",
            Ends(&[[1., 0., 0.], [1., 0., -1.], [1., 0., 0.], [3., 0., 0.]]),
        ),
    ] {
        check(name, &format!("{HEAD}\n{text}"), &gives, &Options::default());
    }
    let program = read(&format!("{HEAD}\nG82 Z-1 R1 P0.5\nX1 P2\nG89 Z-1 R1 P1"));
    // Two moves to R and down, then the dwell; the next hole: up, across, down.
    let waits: Vec<_> = program.dwells.iter().map(|dwell| (dwell.after, dwell.time)).collect();
    assert_eq!(waits, [(2, 0.5), (5, 2.0), (7, 1.0)]);
}

#[test]
#[rustfmt::skip] // One case a line where it fits.
fn where_the_path_begins() {
    for (name, text, gives) in [
        ("at the first full position", "G21 G90\nG0 Z5\nG0 X1 Y2\nG1 Z0 F100", Ends(&[[1., 2., 0.]])),
        ("one feed move may lead there", "G21 G1 X1 Y2 Z3 F100\nX5", Ends(&[[5., 2., 3.]])),
        ("with a remark", "G21 G1 X1 Y2 Z3 F100\nX5", Remark("approach-left-out", 1)),
        ("G92 says where the tool is", "G21 G92 X0 Y0 Z0\nG91 G1 X1", Ends(&[[1., 0., 0.]])),
        ("a program without unit", "G0 X0 Y0 Z0", Remark("unit-assumed", 1)),
        ("cutting at an unknown height is left out", "G21 G0 X0 Y0\nG1 X10 F100\nZ1\nX20", Ends(&[[20., 0., 1.]])),
        ("and so said", "G21 G0 X0 Y0\nG1 X10 F100\nZ1\nX20", Remark("approach-left-out", 2)),
        ("no motion word yet", "G21 X0 Y0 Z0\nG1 X1 F1", Remark("motion-assumed", 1)),
        ("an arc from an unknown place", "G21 G0 X0 Y0\n G2 X10 I5", Gives::Error(2, 2, "unknown Z")),
        ("a hole at an unknown height", "G21 G0 X0 Y0\nG81 Z-1 R1", Gives::Error(2, 1, "unknown Z")),
        ("steps from an unknown place", "G21 G91 G0 X1", Gives::Error(1, 12, "G91 counts from")),
        ("tape signs, name, comment, then the program", "%\nO1000 (PART)\n(x)\nG0 X0 Y0 Z0\nX1\nM30\n%", Ends(&[[1., 0., 0.]])),
        ("a byte order mark", "\u{feff}G0 X0 Y0 Z0\nX1", Ends(&[[1., 0., 0.]])),
        ("nothing", "", Ends(&[])),
    ] {
        check(name, text, &gives, &Options::default());
    }
    assert_eq!((read("").unit, read("G20\nG0 X1 Y1 Z1").unit, read("").lines), ("mm", "inch", 0));
    let start = Some(Vector3::new(0.0, 0.0, 0.01));
    check(
        "from a given start",
        "G21 G1 X1 F1",
        &Ends(&[[1., 0., 10.]]),
        &Options { start, ..Options::default() },
    );
    let all = Options { block_delete: false, ..Options::default() };
    check("block delete off", "G21 G0 X0 Y0 Z0\n/2 X1\n N7 / X2", &Ends(&[[1., 0., 0.], [2., 0., 0.]]), &all);
    check("block delete off, a mistake", "G21 G0 X0 Y0 Z0\nN7 /2 X1 Q", &Gives::Error(2, 10, "number"), &all);
}

#[test]
#[rustfmt::skip] // One case a line where it fits.
fn refusals_are_placed_and_say_what_to_do() {
    for (name, text, column, words) in [
        ("cutter compensation left", "G1 G41 D1 X10", 4, "centre"),
        ("cutter compensation right", "g42 x1", 1, "centre"),
        ("scaling", "G51 X0 P2", 1, "scaling"),
        ("rotation", "G90 G68 R30", 5, "rotate"),
        ("polar", "G16", 1, "polar"),
        ("offsets from the program", "G10 L2 P1 X1", 1, "job"),
        ("macro call", "G65 P9000", 1, "macro"),
        ("a variable without a value", "G1 X#1", 5, "no value"),
        ("an expression that is none", "G1 X[1+a]", 8, "a number"),
        ("a sub-program without an end", "O100 sub", 1, "endsub"),
        ("a sub-program that is not there", "o<cut> call", 1, "a sub-program in this text"),
                ("a second program", "O200", 1, "sub-programs"),
        ("a call of another file", "M98 P100", 1, "other files are not read"),
        ("rotary axis", "G1 X1 A30", 7, "rotary"),
        ("secondary axis", "G1 W3", 4, "secondary"),
        ("counter-clockwise spindle", "S100 M4", 6, "clockwise"),
        ("tapping", "G84 Z-1 R1", 1, "tapping"),
        ("boring cycle", "G76 Z-1 R1", 1, "canned"),
        ("tool centre point control", "G43.4 H1", 1, "three axes"),
        ("unknown G", "G123", 1, "not known"),
        ("unknown tenth of a G", "G1.5", 1, "not known"),
        ("unknown hundredth of a G", "G1.01", 1, "not known"),
        ("negative G", "G-1", 1, "not known"),
        ("another kinematics", "M428", 1, "kinematics"),
        ("unknown letter", "G1 X1 E2", 7, "milling word"),
        ("an exponent without a sign", "G1 X1e3", 6, "exponent"),
        ("two of a modal group", "G0 G1 X1", 4, "modal group"),
        ("two planes", "G17 X1 G18", 8, "G17"),
        ("two motions", "G1 G81 Z1 R1", 4, "one motion"),
        ("two spindle words", "M3 M5", 4, "modal group"),
        ("a word twice", "G1 X1 Y2 X3", 10, "second"),
        ("N in the middle", "G1 N10 X1", 4, "first"),
        ("letter without number", "G1 X Y2", 4, "number"),
        ("number without letter", "G1 5", 4, "letter and a number"),
        ("two points in a number", "G1 X1.2.3", 8, "letter and a number"),
        ("decimal comma", "G1 X1,5", 6, "decimal point"),
        ("a sign alone", "G1 X-", 4, "number"),
        ("a number beyond all machines", "G1 X10000000000", 4, "1e9"),
        ("a foreign letter, column in characters", "(\u{e4}\u{f6}) \u{fc}1", 6, "letter and a number"),
        ("comment not closed", "G1 X1 (end", 7, "closing"),
        ("comment in a comment", "(a (b)", 4, "inside"),
        ("bracket that closes nothing", "G1 X1)", 6, "opens"),
        ("percent within a line", "G1 % X1", 4, "alone"),
        ("centre and radius", "G2 X1 I1 R1", 10, "not both"),
        ("arc without centre", "G2 X10", 1, "centre"),
        ("K in the XY plane", "G2 X10 I5 K1", 11, "I and J"),
        ("I in the YZ plane", "G19 G2 Y10 I5", 12, "J and K"),
        ("radius too small", "G2 X10 R4.9", 8, "5.0000 mm"),
        ("radius for a full circle", "G2 X0 Y0 R5", 10, "centre"),
        ("centre on the start", "G2 X1 I0", 7, "apart"),
        ("radii differ by 0.1 of 10", "G2 X20 I10.05", 8, "agree within"),
        ("half a centre under G90.1", "G90.1 G2 X20 I10", 14, "both"),
        ("half a turn by P", "G2 I5 P0.5", 7, "whole"),
        ("centre without an arc", "G1 X1 I5", 7, "G2 or G3"),
        ("radius without an arc", "G1 X1 R5", 7, "arc"),
        ("P without use", "G1 X1 P5", 7, "turns"),
        ("H without G43", "G0 Z5 H1", 7, "G43"),
        ("feed below zero", "F-5", 1, "greater"),
        ("speed below zero", "S-5", 1, "1 to 1000000"),
        ("speed of no spindle", "S1000001", 1, "1 to 1000000"),
        ("feed of no machine", "G1 X1 F9000000", 7, "to 100000 mm/s"),
        ("inverse time of no machine", "G93 G1 X1 F9000000", 1, "150000 mm/s; a feed is 0.001 to 100000 mm/s"),
        ("feed a revolution of no machine", "G95 S10 F0.0001 G1 X1", 1, "0.001 to 100000 mm/s"),
        ("inverse time without F", "G93 G1 X1", 1, "G93"),
        ("feed a revolution without speed", "G95 F0.1 G1 X1", 1, "G94"),
        ("wait without time", "G4", 1, "seconds"),
        ("wait below zero", "G4 P-1", 4, "0 to 3600"),
        ("wait of more than an hour", "G4 X5000", 4, "0 to 3600 seconds"),
        ("G92 with a motion", "G92 G1 X1", 5, "own"),
        ("G92 without axes", "G92", 1, "axis word"),
        ("constant surface speed", "G96 S100", 1, "lathe"),
    ] {
        check(name, &format!("{HEAD}\n{text}"), &Gives::Error(2, column, words), &Options::default());
    }
    let endless = format!("{HEAD}\no1 while [1 GT 0]\nG4 P0\no1 endwhile");
    check("an endless loop", &endless, &Gives::Error(4, 1, "loop that ends"), &Options::default());
    // The tolerance is 0.005 mm + 0.001 of the radius: 0.015 mm at 10 mm. A centre off by half of
    // it makes the two radii differ by all of it.
    assert!(read_with(&format!("{HEAD}\nG2 X20 I10.007"), &Options::default()).is_ok());
    assert!(read_with(&format!("{HEAD}\nG2 X20 I10.008"), &Options::default()).is_err());
    let wide = Options { arc_tolerance: 1e-4, ..Options::default() };
    assert!(read_with(&format!("{HEAD}\nG2 X20 I10.008"), &wide).is_ok());
}
