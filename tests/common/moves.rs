//! Programs as text, and the invariants of every program.
use armill::path::Segment;
use armill::path::program::{MovePace, Program};
use nalgebra::Vector3;

/// The moves as text: mm, deg, mm/s and rpm, rounded to six decimals.
pub(crate) fn described(program: &Program) -> String {
    let number = |value: f64| {
        let rounded = (value * 1e6).round() / 1e6;
        format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
    };
    let list = |v: Vector3<f64>| v.iter().map(|value| number(*value)).collect::<Vec<_>>().join(" ");
    let described = program.moves.iter().map(|one| {
        let end = list(one.segment.point(one.segment.length()) * 1e3);
        let mut text = match one.segment {
            Segment::Line { .. } => format!("line {end}"),
            Segment::Arc { center, sweep, rise, .. } => {
                let rise =
                    if rise.abs() < 1e-12 { String::new() } else { format!(" rise {}", number(rise * 1e3)) };
                format!("arc {end} about {} by {}{rise}", list(center * 1e3), number(sweep.to_degrees()))
            }
        };
        text += &match one.pace {
            MovePace::Rapid => " rapid".to_string(),
            MovePace::JobFeed => " job".to_string(),
            MovePace::Feed(feed) => format!(" feed {}", number(feed * 1e3)),
        };
        if let Some(speed) = one.spindle {
            text += &format!(" spindle {}", number(speed * 60.0));
        }
        if one.axis_from != Vector3::z() {
            text += &format!(" from {}", list(one.axis_from));
        }
        if one.axis_to != Vector3::z() {
            text += &format!(" tilt {}", list(one.axis_to));
        }
        text
    });
    described.collect::<Vec<_>>().join("; ")
}

/// Asserts that moves join without a gap in position and axis, and that nothing is NaN or of zero
/// length.
pub(crate) fn assert_sound(program: &Program, text: &str) {
    assert!(!program.moves.is_empty(), "{text:?}");
    for one in &program.moves {
        let length = one.segment.length();
        assert!(length > 1e-9 && length.is_finite(), "{text:?}: length {length}");
        for axis in [one.axis_from, one.axis_to] {
            assert!((axis.norm() - 1.0).abs() < 1e-12, "{text:?}: axis {axis}");
        }
        if let MovePace::Feed(feed) = one.pace {
            assert!(feed > 0.0 && feed.is_finite(), "{text:?}: feed {feed}");
        }
        assert!((1..=program.lines).contains(&one.line), "{text:?}: line {}", one.line);
    }
    for pair in program.moves.windows(2) {
        let end = pair[0].segment.point(pair[0].segment.length());
        let gap = (end - pair[1].segment.point(0.0)).norm();
        assert!(gap < 1e-9, "{text:?}: a gap of {gap} m before line {}", pair[1].line);
        assert_eq!(
            pair[0].axis_to, pair[1].axis_from,
            "{text:?}: the axis jumps before line {}",
            pair[1].line
        );
        assert!(pair[0].line <= pair[1].line, "{text:?}: lines out of order");
    }
}
