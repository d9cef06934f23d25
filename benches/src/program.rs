//! A long program of plain lines, as a CAM system posts a surface.

use std::fmt::Write;
use std::hint::black_box;

use armill::path::gcode::{self, Options};

/// Lines of the program that is timed.
pub const LINES: usize = 500_000;

/// Straight cuts over a wavy surface: three decimals, a word of motion and a feed now and then.
pub fn plain(lines: usize) -> String {
    let mut text = String::from("G21 G90 G17\nG0 X0 Y0 Z5\nG1 Z0 F600\n");
    for line in 0..lines {
        let spread = |root: f64| ((line as f64 + 0.5) * root.sqrt()).fract() * 100.0;
        let words = match line {
            _ if line % 10 == 0 => ("G1 ", " F800"),
            _ if line % 3 == 0 => ("G1 ", ""),
            _ => ("", ""),
        };
        let _ = writeln!(text, "{}X{:.3} Y{:.3}{}", words.0, spread(2.0), spread(3.0), words.1);
    }
    text
}

/// Reads a program.
pub fn read(text: &str) {
    drop(black_box(gcode::program(text, &Options::default(), |_| {})));
}
