//! Programs in the form that public posts and manuals write, read whole: length, extents, end, moves
//! and waits, worked by hand (see `data/posts/README.md`). The goal is 38 of the 40.

use armill::path::gcode::{self, Options};
use armill::path::program::{MovePace, Program};
use nalgebra::Vector3;
use std::path::{Path, PathBuf};

/// What a program is, and what it should give. Lengths in mm.
struct Row {
    file: &'static str,
    /// The post, or the manual's sample, whose form it has.
    post: &'static str,
    length: f64,
    lowest: [f64; 3],
    highest: [f64; 3],
    end: [f64; 3],
    /// Moves at a feed.
    cuts: usize,
    rapids: usize,
    /// All waits together [s].
    dwell: f64,
    /// Whether the reader gets it right today.
    reads: bool,
}

/// How many are read right today, at least. The goal is 38.
const READ_TODAY: usize = 40;

/// Programs are worked to 0.0001 mm, and centres are written to 0.001 mm.
const TOLERANCE: f64 = 0.002;

/// Each with the working of its length, move by move in the unit of the program.
#[rustfmt::skip] // A table.
const ROWS: [Row; 40] = [
    // 10 + 7 down + 20 + 30 + 20 along + 2 * 5 * pi quarters + 17 up
    Row {
        file: "01-fusion-fanuc.nc", post: "Fusion 360, fanuc.cps", length: 135.4159,
        lowest: [-5.0, 10.0, -2.0], highest: [45.0, 40.0, 15.0], end: [45.0, 10.0, 15.0],
        cuts: 6, rapids: 2, dwell: 0.0, reads: true,
    },
    // 10 down + 3 * 16 spots + 40 + 10 up + 10 down + 2 * 2 * (5 + 10 + 15) pecks + 20 between + 10 up
    Row {
        file: "02-fusion-fanuc-drill.nc", post: "Fusion 360, fanuc.cps", length: 268.0,
        lowest: [10.0, 10.0, -10.0], highest: [30.0, 30.0, 15.0], end: [10.0, 30.0, 15.0],
        cuts: 9, rapids: 20, dwell: 0.0, reads: true,
    },
    // 10 + 4 down + 2 * sqrt(16 * pi^2 + 1) helical halves + 2 * 4 * pi flat halves + 10 + 8 along + 16 up
    Row {
        file: "03-fusion-haas.nc", post: "Fusion 360, haas.cps", length: 98.3449,
        lowest: [12.0, 8.0, -1.0], highest: [30.0, 20.0, 15.0], end: [30.0, 20.0, 15.0],
        cuts: 7, rapids: 2, dwell: 0.0, reads: true,
    },
    // 15 down + 3 * (3 + 6 + 9) holes + 2 * 15 between + 15 up
    Row {
        file: "04-fusion-haas-drill.nc", post: "Fusion 360, haas.cps", length: 114.0,
        lowest: [0.0, 0.0, -4.0], highest: [30.0, 0.0, 20.0], end: [30.0, 0.0, 20.0],
        cuts: 3, rapids: 10, dwell: 1.5, reads: true,
    },
    // 10 + 7.4 down + 0.3 * pi lead in + 9.4 along + 5 * pi quarter + 20 along + 0.3 * pi lead out + 17.4 up
    Row {
        file: "05-fusion-grbl.nc", post: "Fusion 360, grbl.cps", length: 81.7929,
        lowest: [-20.6, 0.0, -3.0], highest: [10.0, 20.0, 15.0], end: [-20.6, 0.0, 15.0],
        cuts: 7, rapids: 1, dwell: 0.0, reads: true,
    },
    // 10 down + 3 * 20 holes + 2 * 20 between + 10 up
    Row {
        file: "06-fusion-grbl-drill.nc", post: "Fusion 360, grbl.cps", length: 120.0,
        lowest: [5.0, 5.0, -5.0], highest: [25.0, 25.0, 15.0], end: [25.0, 25.0, 15.0],
        cuts: 3, rapids: 7, dwell: 1.5, reads: true,
    },
    // 13 + 3.5 down + 20 along + 2.5 * pi + 5 * pi quarters + 15 + 15 along + 16.5 up
    Row {
        file: "07-fusion-linuxcnc.nc", post: "Fusion 360, linuxcnc.cps", length: 106.5619,
        lowest: [0.0, 0.0, -1.5], highest: [25.0, 15.0, 15.0], end: [0.0, 0.0, 15.0],
        cuts: 6, rapids: 2, dwell: 0.0, reads: true,
    },
    // 0.4 + 2 * (0.1 + 0.2 + 0.01 + 0.21 + 0.5) pecked + 1 + 0.4 + 1 + 0.4 + (0.1 + 0.2 + 0.3) + 0.4 (inches)
    Row {
        file: "08-fusion-linuxcnc-drill.nc", post: "Fusion 360, linuxcnc.cps", length: 158.496,
        lowest: [12.7, 12.7, -7.62], highest: [38.1, 38.1, 15.24], end: [38.1, 38.1, 15.24],
        cuts: 5, rapids: 14, dwell: 0.5, reads: true,
    },
    // 15.5 down + 60 + 50 + 60 + 2 * 5 * pi + 15.5 up + sqrt(40^2 + 10^2) + 10 + 2 * (2 + 9 + 11) + 20 + 10
    Row {
        file: "09-fusion-mach3.nc", post: "Fusion 360, mach3mill.cps", length: 357.647,
        lowest: [-10.0, 0.0, -6.0], highest: [60.0, 20.0, 15.0], end: [40.0, 10.0, 15.0],
        cuts: 8, rapids: 10, dwell: 0.0, reads: true,
    },
    // 10 + 7 down + 25 + 30 + 25 along + 2 * 5 * pi quarters + 17 up
    Row {
        file: "10-fusion-siemens.mpf", post: "Fusion 360, siemens-840d.cps", length: 145.4159,
        lowest: [0.0, -5.0, -2.0], highest: [50.0, 30.0, 15.0], end: [50.0, -5.0, 15.0],
        cuts: 6, rapids: 2, dwell: 0.0, reads: true,
    },
    // 2 * (10 + 8 + 18) spots + 20 between + 2 * (10 + 11 + 11 + 17 + 27) pecked + 20 between
    Row {
        file: "11-fusion-siemens-drill.mpf", post: "Fusion 360, siemens-840d.cps", length: 264.0,
        lowest: [10.0, 10.0, -12.0], highest: [30.0, 10.0, 15.0], end: [10.0, 10.0, 15.0],
        cuts: 6, rapids: 14, dwell: 0.0, reads: true,
    },
    // 15 + sqrt(5^2 + 5^2) + 10 + 6 + 30 + 2.5 * pi + 15 + 16 + sqrt(40^2 + 25^2) + 15
    Row {
        file: "12-fusion-mpcnc.nc", post: "Fusion 360, MPCNC.cps (Marlin)", length: 169.095,
        lowest: [0.0, 0.0, -1.0], highest: [40.0, 25.0, 15.0], end: [0.0, 0.0, 0.0],
        cuts: 4, rapids: 6, dwell: 0.5, reads: true,
    },
    // 10 + 6 down + 40 + 30 + 40 + 30 round + 16 up + sqrt(20^2 + 20^2) to park
    Row {
        file: "13-fusion-openbuilds.nc", post: "Fusion 360, OpenBuilds grbl", length: 200.2843,
        lowest: [-10.0, -10.0, -1.0], highest: [50.0, 40.0, 15.0], end: [-10.0, -10.0, 15.0],
        cuts: 5, rapids: 3, dwell: 1.8, reads: true,
    },
    // 13 + 2 down + sqrt(40^2 + 2^2) ramp + 40 back + 17 up
    Row {
        file: "14-fusion-carbide.nc", post: "Fusion 360, carbide3d.cps", length: 112.05,
        lowest: [0.0, 0.0, -2.0], highest: [40.0, 0.0, 15.0], end: [0.0, 0.0, 15.0],
        cuts: 3, rapids: 2, dwell: 0.0, reads: true,
    },
    // 2 + 5 down + 30 + 50 + 30 + 50 sides + 4 * 2.5 * pi corners + 7 up
    Row {
        file: "15-freecad-grbl.nc", post: "FreeCAD, grbl_post", length: 205.4159,
        lowest: [0.0, 0.0, -2.0], highest: [60.0, 40.0, 5.0], end: [0.0, 5.0, 5.0],
        cuts: 9, rapids: 2, dwell: 0.0, reads: true,
    },
    // 3 * (2 + 8 + 10) holes + 20 + 15 between
    Row {
        file: "16-freecad-grbl-drill.nc", post: "FreeCAD, grbl_post", length: 95.0,
        lowest: [10.0, 10.0, -5.0], highest: [30.0, 25.0, 5.0], end: [30.0, 25.0, 5.0],
        cuts: 3, rapids: 8, dwell: 1.5, reads: true,
    },
    // 2 * (4 + 2.5 + 2.5 + 5 + 9) pecked + 20 between
    Row {
        file: "17-freecad-linuxcnc.nc", post: "FreeCAD, linuxcnc_post", length: 66.0,
        lowest: [4.0, 4.0, -4.0], highest: [24.0, 4.0, 5.0], end: [24.0, 4.0, 5.0],
        cuts: 4, rapids: 9, dwell: 0.0, reads: true,
    },
    // 4 down + 4 * sqrt(25 * pi^2 + 0.5^2) helical halves + 2 * 5 * pi flat halves + 6 up
    Row {
        file: "18-freecad-mach3.nc", post: "FreeCAD, mach3_mach4_post", length: 104.2796,
        lowest: [5.0, 5.0, -1.0], highest: [15.0, 15.0, 5.0], end: [15.0, 10.0, 5.0],
        cuts: 6, rapids: 2, dwell: 0.0, reads: true,
    },
    // 8 + 3 down + 30 along + 5 * pi quarter + 11 up
    Row {
        file: "19-freecad-centroid.nc", post: "FreeCAD, centroid_post", length: 67.708,
        lowest: [0.0, -10.0, -1.0], highest: [40.0, 0.0, 10.0], end: [40.0, -10.0, 10.0],
        cuts: 3, rapids: 2, dwell: 0.0, reads: true,
    },
    // 6.5 down + 40 + 20 + 20 along + 6.5 up
    Row {
        file: "20-linuxcnc-parameters.nc", post: "LinuxCNC, by hand: numbered parameters", length: 93.0,
        lowest: [0.0, 0.0, -1.5], highest: [40.0, 20.0, 5.0], end: [20.0, 20.0, 5.0],
        cuts: 4, rapids: 1, dwell: 2.0, reads: true,
    },
    // (4 + 3 + 10 + 7) + sqrt(10^2 + 15^2) + (4 + 3 + 10 + 7) + 10 + (4 + 4 + 10 + 8) + sqrt(30^2 + 15^2)
    Row {
        file: "21-linuxcnc-subroutine.nc", post: "LinuxCNC, by hand: O-word subroutine", length: 135.5688,
        lowest: [0.0, 0.0, -3.0], highest: [30.0, 15.0, 5.0], end: [0.0, 0.0, 5.0],
        cuts: 6, rapids: 9, dwell: 0.0, reads: true,
    },
    // 4.5 + 1 + 3 * 0.5 down + 4 * 80 along + 7 up
    Row {
        file: "22-linuxcnc-while.nc", post: "LinuxCNC, by hand: O-word loop, named parameters", length: 334.0,
        lowest: [0.0, 0.0, -2.0], highest: [40.0, 0.0, 5.0], end: [0.0, 0.0, 5.0],
        cuts: 12, rapids: 2, dwell: 0.0, reads: true,
    },
    // 9 + 2 down + 6 * 20 sides + 11 up
    Row {
        file: "23-linuxcnc-polar.nc", post: "LinuxCNC, by hand: polar coordinates", length: 142.0,
        lowest: [-20.0, -17.3205, -1.0], highest: [20.0, 17.3205, 10.0], end: [20.0, 0.0, 10.0],
        cuts: 7, rapids: 2, dwell: 0.0, reads: true,
    },
    // sqrt((2 * 2 * pi * 0.5)^2 + 0.5^2) helix + 0.5 along + 0.5 up (inches)
    Row {
        file: "24-linuxcnc-hand.nc", post: "LinuxCNC, by hand: inch, turns by P", length: 185.4974,
        lowest: [-12.7, -12.7, -10.16], highest: [12.7, 12.7, 2.54], end: [0.0, 0.0, 2.54],
        cuts: 2, rapids: 1, dwell: 1.5, reads: true,
    },
    // 5 down + 50 along + 10 * pi quarter + 5 up
    Row {
        file: "25-haas-basic.nc", post: "Haas, mill manual: basic program", length: 91.4159,
        lowest: [-60.0, -30.0, -2.0], highest: [0.0, 0.0, 3.0], end: [-60.0, -10.0, 3.0],
        cuts: 3, rapids: 1, dwell: 0.0, reads: true,
    },
    // 22 + 3 * 12 + 6 + 28 spots + 60 between + 2 * (22 + 12 + 24 + 18 + 40) pecked + 20 between
    Row {
        file: "26-haas-cycles.nc", post: "Haas, mill manual: G81 and G83, G98 and G99", length: 404.0,
        lowest: [10.0, 10.0, -15.0], highest: [30.0, 30.0, 25.0], end: [30.0, 30.0, 25.0],
        cuts: 10, rapids: 21, dwell: 0.0, reads: true,
    },
    // 8 + 2 down + 3 * (1 + 30 + 30) passes + 13 up
    Row {
        file: "27-haas-m97.nc", post: "Haas, mill manual: M97 local subprogram, G187", length: 206.0,
        lowest: [0.0, 0.0, -3.0], highest: [30.0, 0.0, 10.0], end: [0.0, 0.0, 10.0],
        cuts: 10, rapids: 2, dwell: 0.0, reads: true,
    },
    // 23 + 3 * 8 + 35 + 23 first + 25 back + 23 + 3 * 16 + 35 + 23 second
    Row {
        file: "28-haas-m98.nc", post: "Haas, mill manual: M98 and cycles with L0", length: 259.0,
        lowest: [10.0, 10.0, -6.0], highest: [30.0, 25.0, 25.0], end: [30.0, 25.0, 25.0],
        cuts: 6, rapids: 15, dwell: 0.9, reads: true,
    },
    // 0.9 + 0.1 + 6 + 1 facing + 4 back + 2 * (0.9 + 0.2 + 1.1) spots + 2 between (inches)
    Row {
        file: "29-haas-inch.nc", post: "Haas, mill manual: G91 G28, G04, inch", length: 467.36,
        lowest: [-38.1, 0.0, -2.54], highest: [114.3, 0.0, 25.4], end: [63.5, 0.0, 25.4],
        cuts: 4, rapids: 8, dwell: 1.0, reads: true,
    },
    // 12 down + 50 + 30 along + 5 * pi quarter + 12 up
    Row {
        file: "30-fanuc-basic.nc", post: "Fanuc sample: G28, G10 L2, G05.1", length: 119.708,
        lowest: [-10.0, 0.0, -2.0], highest: [50.0, 40.0, 10.0], end: [50.0, 40.0, 10.0],
        cuts: 4, rapids: 1, dwell: 0.0, reads: true,
    },
    // 17 down + 8 * 14 holes + 6 * 12 + 15 between + 17 up
    Row {
        file: "31-fanuc-grid.nc", post: "Fanuc sample: G04 X, G04 P, G82 with K", length: 233.0,
        lowest: [0.0, 0.0, -4.0], highest: [36.0, 15.0, 20.0], end: [0.0, 15.0, 20.0],
        cuts: 8, rapids: 17, dwell: 9.9, reads: true,
    },
    // 5 + 3 * (0.5 + 40) + 6.5 first slot + 50 over + 5 + 2 * (0.5 + 40) + 6 second
    Row {
        file: "32-fanuc-m98.nc", post: "Fanuc sample: M98 with the count in P, G52", length: 275.0,
        lowest: [0.0, 0.0, -1.5], highest: [70.0, 0.0, 5.0], end: [50.0, 0.0, 5.0],
        cuts: 17, rapids: 3, dwell: 0.0, reads: true,
    },
    // 25 out + 5 * 25 between + 6 * (18 + 5 + 23) holes
    Row {
        file: "33-fanuc-while.nc", post: "Fanuc sample: custom macro, WHILE", length: 426.0,
        lowest: [-25.0, -21.6506, -3.0], highest: [25.0, 21.6506, 20.0], end: [12.5, -21.6506, 20.0],
        cuts: 6, rapids: 18, dwell: 0.0, reads: true,
    },
    // 28 + 3 down + 3 * 160 along + 2 * 15 across + 31 up
    Row {
        file: "34-fanuc-if.nc", post: "Fanuc sample: custom macro, IF GOTO, G54.1", length: 572.0,
        lowest: [-20.0, 0.0, -1.0], highest: [60.0, 30.0, 30.0], end: [-20.0, 30.0, 30.0],
        cuts: 9, rapids: 2, dwell: 0.0, reads: true,
    },
    // 11 down + 2 * 5 * pi quarters + 20 along + 11 up
    Row {
        file: "35-siemens-contour.mpf", post: "Siemens 840D: CR=, I=AC(), MSG", length: 73.4159,
        lowest: [-30.0, 0.0, -1.0], highest: [10.0, 20.0, 10.0], end: [-30.0, 20.0, 10.0],
        cuts: 4, rapids: 1, dwell: 0.5, reads: true,
    },
    // 9 + sqrt((5 * 5 * pi)^2 + 3^2) + 20 + 12 + sqrt(30^2 + 20^2) + 12 + 20 + 12 + sqrt(45^2 + 30^2)
    Row {
        file: "36-siemens-trans.mpf", post: "Siemens 840D: TRANS, ATRANS, TURN=", length: 253.7359,
        lowest: [0.0, 0.0, -2.0], highest: [45.0, 30.0, 10.0], end: [0.0, 0.0, 10.0],
        cuts: 4, rapids: 5, dwell: 0.0, reads: true,
    },
    // 2 * (18 + 7 + 25) holes + 20 + 20 + 20 between + 2 * (18 + 12 + 20 + 14 + 32) pecked
    Row {
        file: "37-siemens-cycles.mpf", post: "Siemens 840D: CYCLE81, CYCLE82, CYCLE83", length: 352.0,
        lowest: [10.0, 10.0, -12.0], highest: [50.0, 30.0, 20.0], end: [50.0, 30.0, 20.0],
        cuts: 8, rapids: 19, dwell: 0.4, reads: true,
    },
    // 13 + 3 down + 50 + 20 along + 10 * pi quarter + 16 up
    Row {
        file: "38-siemens-hsc.mpf", post: "Siemens 840D: CYCLE832, CYCLE800, IC(), SUPA", length: 133.4159,
        lowest: [0.0, 0.0, -1.0], highest: [50.0, 80.0, 15.0], end: [50.0, 80.0, 15.0],
        cuts: 4, rapids: 2, dwell: 0.0, reads: true,
    },
    // 23 + 5 down + 5 * pi + 5 * pi + 10 * pi round + 15 along + 28 up
    Row {
        file: "39-mastercam-pocket.nc", post: "Mastercam, mpfan.pst", length: 133.8319,
        lowest: [0.0, 5.0, -3.0], highest: [35.0, 25.0, 25.0], end: [35.0, 15.0, 25.0],
        cuts: 5, rapids: 2, dwell: 0.0, reads: true,
    },
    // 22 + 3 * (10 + 20 + 30) pecked + 60 between + 22 up + 2 * (22 + 5 + 27) chamfers + 30 between
    Row {
        file: "40-mastercam-drill.nc", post: "Mastercam, mpfan.pst", length: 422.0,
        lowest: [10.0, 10.0, -12.0], highest: [40.0, 40.0, 25.0], end: [10.0, 40.0, 25.0],
        cuts: 11, rapids: 24, dwell: 0.0, reads: true,
    },
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/posts")
}

/// What the reader makes of a program that differs from the row: nothing if all is right.
fn differences(row: &Row, program: &Program) -> Vec<String> {
    let mut found = Vec::new();
    let mut compare = |name: &str, value: f64, expected: f64, tolerance: f64| {
        if (value - expected).abs() > tolerance {
            found.push(format!("{name} {value:.4} for {expected:.4}"));
        }
    };
    let (mut lowest, mut highest) = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    let (mut length, mut end, mut rapids) = (0.0, Vector3::repeat(f64::NAN), 0);
    for step in &program.moves {
        for s in step.segment.extremes() {
            let point = step.segment.point(s) * 1e3;
            (lowest, highest) = (lowest.inf(&point), highest.sup(&point));
        }
        length += step.segment.length() * 1e3;
        end = step.segment.point(step.segment.length()) * 1e3;
        rapids += usize::from(step.pace == MovePace::Rapid);
    }
    compare("length", length, row.length, TOLERANCE);
    let points = [("lowest", lowest, row.lowest), ("highest", highest, row.highest), ("end", end, row.end)];
    for (name, point, expected) in points {
        for (axis, letter) in ["X", "Y", "Z"].into_iter().enumerate() {
            compare(&format!("{name} {letter}"), point[axis], expected[axis], TOLERANCE);
        }
    }
    compare("cuts", (program.moves.len() - rapids) as f64, row.cuts as f64, 0.0);
    compare("rapids", rapids as f64, row.rapids as f64, 0.0);
    compare("dwell", program.dwells.iter().map(|dwell| dwell.time).sum(), row.dwell, 1e-9);
    found
}

#[test]
fn programs_of_public_posts() {
    let mut surprises = Vec::new();
    let mut right = 0;
    for row in &ROWS {
        let text = std::fs::read_to_string(folder().join(row.file)).expect(row.file);
        let fault = match gcode::program(&text, &Options::default(), |_| {}) {
            Ok(program) => differences(row, &program).join(", "),
            Err(error) => error.to_string(),
        };
        right += usize::from(fault.is_empty());
        let outcome = if fault.is_empty() { "right" } else { &fault };
        let line = format!("{} ({}): {outcome}", row.file, row.post);
        eprintln!("{line}");
        if row.reads != fault.is_empty() {
            surprises.push(line);
        }
    }
    eprintln!("{right} of {} are read right", ROWS.len());
    assert!(surprises.is_empty(), "`reads` does not say what happens:\n{}", surprises.join("\n"));
    assert!(right >= READ_TODAY, "{right} are read right, and {READ_TODAY} were");
}

#[test]
fn every_program_has_its_row() {
    let mut files: Vec<String> = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name != "README.md")
        .collect();
    files.sort();
    assert_eq!(files, ROWS.map(|row| row.file));
}
