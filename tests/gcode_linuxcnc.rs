//! The G-code reader against LinuxCNC's interpreter: one program, move by move (see
//! `data/gcode/README.md`).

use armill::path::Segment;
use armill::path::gcode::{self, Options};
use armill::path::program::MovePace;
use nalgebra::Vector3;

/// A move as LinuxCNC reports it; lengths in mm, in machine coordinates, feed in mm/min.
#[derive(Debug)]
struct Canon {
    end: Vector3<f64>,
    /// `None`: rapid.
    feed: Option<f64>,
    /// Centre, normal of the plane, and signed number of the turn that ends it.
    arc: Option<(Vector3<f64>, Vector3<f64>, f64)>,
}

/// The recording prints 4 decimals, of an inch at the coarsest.
const PRINTED: f64 = 25.4 * 1e-4;

/// Reads the recording: its moves, and for each dwell the number of moves before it and its time.
fn recording(text: &str) -> (Vec<Canon>, Vec<(usize, f64)>) {
    let (mut unit, mut feed) = (1.0, 0.0);
    let (mut work, mut shift, mut tool) = (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
    let mut axes = [0, 1, 2];
    let mut at: Vector3<f64> = Vector3::zeros();
    let (mut moves, mut dwells) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let (call, rest) = line.trim_end_matches(')').split_once('(').unwrap();
        let numbers: Vec<f64> = rest.split([',', ' ']).filter_map(|number| number.parse().ok()).collect();
        let vector = |from: usize| Vector3::new(numbers[from], numbers[from + 1], numbers[from + 2]) * unit;
        let origin = work + shift + tool;
        match call {
            "USE_LENGTH_UNITS" => unit = if rest.contains("INCH") { 25.4 } else { 1.0 },
            "SELECT_PLANE" => {
                axes = match rest {
                    "CANON_PLANE_XY" => [0, 1, 2],
                    "CANON_PLANE_XZ" => [2, 0, 1],
                    _ => [1, 2, 0],
                }
            }
            "SET_G5X_OFFSET" => work = vector(1),
            "SET_G92_OFFSET" => shift = vector(0),
            "USE_TOOL_LENGTH_OFFSET" => tool = vector(0),
            "SET_FEED_RATE" => feed = numbers[0] * unit,
            "DWELL" => dwells.push((moves.len(), numbers[0])),
            "STRAIGHT_TRAVERSE" | "STRAIGHT_FEED" => {
                let end = vector(0) + origin;
                // LinuxCNC also calls for moves of zero length.
                if (end - at).norm() > PRINTED {
                    moves.push(Canon { end, feed: (call == "STRAIGHT_FEED").then_some(feed), arc: None });
                    at = end;
                }
            }
            "ARC_FEED" => {
                let [a, b, n] = axes;
                let (mut end, mut center, mut normal) =
                    (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
                (end[a], end[b], end[n]) = (numbers[0] * unit, numbers[1] * unit, numbers[5] * unit);
                (center[a], center[b]) = (numbers[2] * unit, numbers[3] * unit);
                normal[n] = 1.0;
                (end, center) = (end + origin, center + origin);
                moves.push(Canon { end, feed: Some(feed), arc: Some((center, normal, numbers[4])) });
                at = end;
            }
            _ => {}
        }
    }
    (moves, dwells)
}

#[test]
fn the_same_moves_as_linuxcnc() {
    let (moves, dwells) = recording(include_str!("data/gcode/linuxcnc.canon"));
    let mut options = Options::default();
    options.work_offsets[1] = Some(Vector3::new(317.5, -184.15, 76.2) / 1e3);
    options.tool_length_offsets.insert(1, 127.0 / 1e3);
    options.start = Some(Vector3::zeros());
    let program = gcode::program(include_str!("data/gcode/linuxcnc.ngc"), &options, |_| {}).unwrap();
    let (mut arcs, mut turns) = (0, 0);
    for (index, (ours, theirs)) in program.moves.iter().zip(&moves).enumerate() {
        let place = format!("move {index}, line {}: {theirs:?} {ours:?}", ours.line);
        let end = ours.segment.point(ours.segment.length()) * 1e3;
        assert!((end - theirs.end).norm() < PRINTED, "{place}");
        match (ours.pace, theirs.feed) {
            (MovePace::Rapid, None) => {}
            (MovePace::Feed(ours), Some(theirs)) => {
                assert!((ours * 60e3 - theirs).abs() < 60.0 * PRINTED, "{place}")
            }
            _ => panic!("{place}"),
        }
        match (&ours.segment, &theirs.arc) {
            (Segment::Line { .. }, None) => {}
            (Segment::Arc { center, u, v, sweep, .. }, Some((their_center, normal, turn))) => {
                let mut apart = center * 1e3 - their_center;
                apart -= normal * normal.dot(&apart);
                // The reader shifts a centre by the difference of the two radii, here by the
                // program's 4 decimals of an inch.
                assert!(apart.norm() < 4.0 * PRINTED, "{place}");
                assert_eq!(u.cross(v).dot(normal) > 0.0, *turn > 0.0, "{place}");
                assert_eq!((sweep / std::f64::consts::TAU - 1e-9).floor() + 1.0, turn.abs(), "{place}");
                arcs += 1;
                turns += usize::from(turn.abs() > 1.0);
            }
            _ => panic!("{place}"),
        }
    }
    assert_eq!(program.moves.len(), moves.len());
    let waits: Vec<_> = program.dwells.iter().map(|dwell| (dwell.after, dwell.time)).collect();
    assert_eq!(waits, dwells);
    assert!(
        arcs > 80 && turns > 5 && moves.len() > 700,
        "{arcs} arcs, {turns} of many turns, {} moves",
        moves.len()
    );
}
