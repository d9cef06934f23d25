//! Points as text: columns, separators, decimal signs, units and mistakes, all worked out by hand.

use crate::common;
use crate::common::moves::{assert_sound, described};
use armill::path::csv::{Options, points, program};
use armill::path::program::Program;
use armill::path::unit::{FeedUnit, LengthUnit};
use std::fmt::Write;

const MM: Options<'_> = Options { field: "path.text", unit: LengthUnit::Mm, feed_unit: FeedUnit::MmPerS };

fn read(text: &str) -> Result<Program, armill::Error> {
    program(text, &MM, |_| {})
}

#[test]
fn rows_are_read() {
    let two = "line 4 -5 6 job";
    let half = "line 4.5 -5.5 6 job";
    let fed = "line 4 -5 6 feed 50";
    let tilted = "line 4 -5 6 job tilt 0 0.6 0.8";
    let both = "line 4 -5 6 feed 50 tilt 0 0.6 0.8";
    for (text, expected) in [
        // Separators.
        ("1,2,3\n4,-5,6", two),
        ("1, 2, 3\n4 ,-5 , 6", two),
        ("1;2;3\n4; -5;6", two),
        ("1\t2\t3\n4\t-5\t6", two),
        ("1 2 3\n 4   -5\t6 ", two),
        ("1,2,3,\n4,-5,6,", two),
        ("\u{feff}1e0 2. +3\r\n4 -5 6\r\n", two),
        // Decimal commas, with another separator.
        ("1,0;2;3\n4,5;-5,5;6", half),
        ("1,0 2 3\n4,5 -5,5 6", half),
        ("1,0\t2\t3\n4,5\t-5,5\t6,0", half),
        ("x;y;z\n1;2;3\n4,5;-5,5;6", half),
        // Blank lines and comments.
        ("# path\n\n1,2,3 # start\n  \n4,-5,6\n#", two),
        ("; made by CAM\n1;2;3\n;\n4;-5;6\n;;;", two),
        // Headers: any order, any usual spelling.
        ("x,y,z\n1,2,3\n4,-5,6", two),
        ("X Y Z\n1 2 3\n4 -5 6", two),
        ("\"x\",\"y\",\"z\"\n1,2,3\n4,-5,6", two),
        ("z,x,y\n3,1,2\n6,4,-5", two),
        ("PosX;PosY;PosZ\n1;2;3\n4;-5;6", two),
        ("x [mm], y [mm], z [mm]\n1,2,3\n4,-5,6", two),
        ("x [mm] y [mm] z [mm]\n1 2 3\n4 -5 6", two),
        ("x_mm,y_mm,z_mm\n1,2,3\n4,-5,6", two),
        ("x (in);y (in);z (in)\n0;0;0\n1;0,5;0", "line 25.4 12.7 0 job"),
        ("x_inch,y_inch,z\n0,0,0\n1,0.5,0", "line 25.4 12.7 0 job"),
        // Feeds: a row's feed belongs to the move that ends there.
        ("1,2,3,10.0\n4,-5,6,50.0", fed),
        ("feed,x,y,z\n10,1,2,3\n50,4,-5,6", fed),
        ("x,y,z,f\n1,2,3,10\n4,-5,6,50", fed),
        ("x,y,z,feed_mm_s\n1,2,3,10\n4,-5,6,50", fed),
        ("x,y,z,Feed rate [mm/min]\n1,2,3,1000\n4,-5,6,3000", fed),
        ("x;y;z;feed mm per min\n1;2;3;1000\n4;-5;6;3000", fed),
        ("x,y,z,feed_in_min\n0,0,0,1\n1,0,0,6", "line 1 0 0 feed 2.54"),
        ("x,y,z,feed [ipm]\n0,0,0,1\n1,0,0,6", "line 1 0 0 feed 2.54"),
        // Axes.
        ("1,2,3,0,0,1.0\n4,-5,6,0,0.6,0.8", tilted),
        ("x,y,z,i,j,k\n1,2,3,0,0,1\n4,-5,6,0,0.612,0.816", tilted),
        ("x,y,z,nx,ny,nz\n1,2,3,0,0,1\n4,-5,6,0,0.6,0.8", tilted),
        ("axis_i axis_j axis_k x y z\n0 0 1 1 2 3\n0 0.6 0.8 4 -5 6", tilted),
        ("1,2,3,0,0,1,10\n4,-5,6,0,0.6,0.8,50", both),
        ("f;k;j;i;z;y;x\n10;1;0;0;3;2;1\n50;0,8;0,6;0;6;-5;4", both),
        // Whole numbers without a header are unambiguous once one row shows that commas separate.
        ("1,2,3,10\n4,-5,6,50", fed),
        ("1,2,3,10\n2,2,3,10\n4.0,-5,6,50", "line 2 2 3 feed 10; line 4 -5 6 feed 50"),
        // A row at the same place makes no move.
        ("1,2,3\n1,2,3\n4,-5,6\n4,-5,6", two),
    ] {
        let program = read(text).unwrap_or_else(|error| panic!("{text:?}: {error}"));
        assert_eq!(described(&program), expected, "{text:?}");
        assert_sound(&program, text);
    }
}

#[test]
fn mistakes_are_placed_and_say_what_to_do() {
    for (text, place, part) in [
        ("", (1, 1), "two rows"),
        ("x,y,z\n", (1, 1), "two rows"),
        ("1,2,3\n1,2,3\n", (2, 1), "two rows"),
        ("1,2", (1, 3), "x, y, z"),
        ("1,2,3\n1,2", (2, 3), "3 cells"),
        ("1,2,3\n1,2,3,4", (2, 7), "3 cells"),
        ("1,2,3,4,5", (1, 9), "5 numbers"),
        ("1 2 3 4 5 6 7 8", (1, 15), "8 numbers"),
        ("1,2,3\n 1, two, 3", (2, 5), "\"two\""),
        ("1,,3", (1, 3), "\"\""),
        ("1;;3", (1, 3), "\"\""),
        ("1,nan,3", (1, 3), "\"nan\""),
        ("1,inf,3", (1, 3), "\"inf\""),
        ("1,1e999,3", (1, 3), "\"1e999\""),
        ("1,0x10,3", (1, 3), "\"0x10\""),
        ("1,2,3\nx,y,z", (2, 1), "\"x\""),
        ("ä;1;2", (1, 1), "\"ä\""),
        ("1;ä;x", (1, 3), "\"ä\""),
        ("0,0,2000000", (1, 5), "within 1000000 mm"),
        // Headers.
        ("x,y\n1,2", (1, 3), "x, y and z"),
        ("x,y,v\n1,2,3", (1, 5), "the columns are"),
        ("x,y,z,x\n1,2,3,4", (1, 7), "only once"),
        ("x,y,z,i,j\n1,2,3,0,0", (1, 9), "or none"),
        ("x_mm,y_in,z\n1,2,3", (1, 6), "same unit"),
        ("x_m,y,z\n1,2,3", (1, 1), "mm or in"),
        ("x,y,z [furlong]\n1,2,3", (1, 5), "mm or in"),
        ("x,y,z,feed_m_s\n1,2,3,4", (1, 7), "in/min"),
        ("x,y,z,feed [mm/s^2]\n1,2,3,4", (1, 7), "in/min"),
        ("x,y,z,i_mm,j,k\n1,2,3,0,0,1", (1, 7), "no unit"),
        ("x [\"],y,z\n1,2,3", (1, 1), "mm or in"),
        // Commas and points.
        ("1,5,2,5\n2,5,3,5", (1, 1), "semicolons"),
        ("1,5,2,5,3,5\n1,5,2,5,4,5", (1, 1), "semicolons"),
        ("x,y,z\n1,5,2,5,3,5", (2, 7), "separate the cells by semicolons"),
        ("1,5;2;3\n1.5;2;3", (2, 1), "either points or commas"),
        ("1.234,5;2;3", (1, 1), "\"1.234,5\""),
        ("1,2,3\n1,5;2;3", (2, 1), "decimal signs or separators"),
        ("1,5;2;3\n1,2,3", (2, 1), "decimal signs or separators"),
        ("1,0\t2\t3\n4,5\t-5,5\t6,", (2, 1), "decimal signs or separators"),
        ("1, 2 3", (1, 4), "\"2 3\""),
        ("1,2,3 4", (1, 1), "\"1,2,3\""),
        // Feeds and axes.
        ("x,y,z,f\n0,0,0,1\n1,0,0,0", (3, 7), "a feed is"),
        ("x,y,z,f\n0,0,0,1\n1,0,0,-5", (3, 7), "a feed is"),
        ("x,y,z,f\n0,0,0,1\n1,0,0,", (3, 5), "4 cells"),
        ("x,y,z,i,j,k\n0,0,0,0,0,1\n1,0,0,0,0,0", (3, 7), "a unit vector"),
        ("x,y,z,i,j,k\n0,0,0,0,0,1\n1,0,0,0,0,1\n1,0,0,0,0.7071,0.7071", (4, 7), "45.000 deg in place"),
        ("x,y,z,i,j,k\n0,0,0,0,0,1\n1,0,0,0,0,-1", (3, 7), "180 deg"),
    ] {
        common::refused_at(read(text), text, place, part);
    }
}

#[test]
fn the_chosen_units_hold_unless_the_header_gives_others() {
    let inch = Options { unit: LengthUnit::Inch, feed_unit: FeedUnit::InchPerMin, ..MM };
    let per_minute = Options { feed_unit: FeedUnit::MmPerMin, ..MM };
    for (text, options, expected, unit, remarks) in [
        ("0,0,0,6.0\n1,0,0,6.0", inch, "line 25.4 0 0 feed 2.54", "inch", 0),
        ("0,0,0,60.0\n1,0,0,60.0", per_minute, "line 1 0 0 feed 1", "mm", 0),
        ("x_in,y_in,z_in,feed\n0,0,0,6\n1,0,0,6", inch, "line 25.4 0 0 feed 2.54", "inch", 0),
        ("x_mm,y_mm,z_mm,feed\n0,0,0,6\n1,0,0,6", inch, "line 1 0 0 feed 2.54", "mm", 1),
        ("x_in,y_in,z_in,feed_mm_s\n0,0,0,6\n1,0,0,6", MM, "line 25.4 0 0 feed 6", "inch", 1),
    ] {
        let program = program(text, &options, |_| {}).unwrap();
        assert_eq!(described(&program), expected, "{text:?}");
        assert_eq!((program.unit, program.remarks.len()), (unit, remarks), "{text:?}");
    }
}

#[test]
fn an_axis_off_unit_length_is_remarked() {
    let program = read("x,y,z,i,j,k\n0,0,0,0,0,1\n1,0,0,0,0,1.02\n2,0,0,0,0,0.97").unwrap();
    let remarks: Vec<_> = program.remarks.iter().map(|remark| (remark.code, remark.line)).collect();
    assert_eq!(remarks, [("axis-length", 3)]);
    assert!(program.remarks[0].message.contains("1 more"), "{}", program.remarks[0].message);
}

#[test]
fn spreadsheets_are_read_as_they_write() {
    let two = "line 4 -5 6 job";
    let thousand = "line 1234.5 -5 6 job";
    let fed = "line 4 -5 6 feed 50";
    for (text, expected) in [
        // A stated separator, whatever ends the lines, and what stands before and after the text.
        ("sep=;\n1;2;3\n4;-5;6", two),
        ("\"sep=,\"\r\nx,y,z,f\r\n1,2,3,10\r\n4,-5,6,50", fed),
        ("SEP=,\n1,2,3,10\n4,-5,6,50", fed),
        ("sep=\t\n1\t2\t3\n4\t-5\t6", two),
        ("1,2,3\r4,-5,6\r", two),
        ("x,y,z\r1,2,3\r\r4,-5,6", two),
        ("\u{feff}\u{feff}1,2,3\n4,-5,6\n", two),
        ("1,2,3\n4,-5,6\n\u{1a}", two),
        ("1,2,3\r\n4,-5,6\r\n\u{1a}\r\n", two),
        ("1,2,3\n4,-5,6\0\0\0\n", two),
        // Thousands are set off by spaces where blanks do not separate.
        ("1;2;3\n1 234,5;-5;6", thousand),
        ("1\t2\t3\n1 234,5\t-5\t6", thousand),
        ("1\t2\t3\n1 234.5\t-5\t6", thousand),
        ("1;2;3\n1\u{a0}234,5;-5;6", thousand),
        ("1;2;3\n1\u{202f}234,5;-5;6", thousand),
        ("1 2 3\n1\u{a0}234,5 -5 6", thousand),
        ("1;2;3\n1'234.5;-5;6", thousand),
        ("1,2,3\n\"1 234.5\",-5,6", thousand),
        ("1;2;3\n-12 345;-5;6", "line -12345 -5 6 job"),
        // Other no-break spaces are blanks.
        ("1\u{a0}2\u{a0}3\n4\u{a0}-5\u{a0}6", two),
        // Quotation marks, and separators between them.
        ("\"1\",\"2\",\"3\"\n\"4\",\"-5\",\"6\"", two),
        ("\"1\";\"2\";\"3\"\n\"4,5\";\"-5,5\";\"6\"", "line 4.5 -5.5 6 job"),
        ("\"1,5\",2,3\n\"4,5\",\"-5,5\",6\n7,8,9", "line 4.5 -5.5 6 job; line 7 8 9 job"),
        ("\"x\",\"y\",\"z\",\"Feed, mm/min\"\n1,2,3,600\n4,-5,6,3000", fed),
        // Tabs separate where there are tabs: a name has blanks.
        ("x [mm]\ty [mm]\tz [mm]\tFeed rate [mm/min]\n1\t2\t3\t600\n4\t-5\t6\t3000", fed),
        ("1,\t2,\t3\n4,\t-5,\t6", two),
        ("1 2\t3\n4 -5\t6", two),
        // A column of row numbers.
        ("n,x,y,z\n1,1,2,3\n2,4,-5,6", two),
        ("Point No;x;y;z\nP1;1;2;3\nP2;4;-5;6", two),
        ("x y z line\n1 2 3 10\n4 -5 6 20", two),
        ("index,x,y,z,i,j,k,feed\n7,1,2,3,0,0,1,10\n9,4,-5,6,0,0,1,50", fed),
        (",x,y,z\n0,1,2,3\n1,4,-5,6", two),
        (";x;y;z\n0;1,0;2,0;3,0\n1;4,0;-5,0;6,0", two),
        ("1 1 2 3\n2 4 -5 6", two),
        ("1;1,0;2;3\n2;4,0;-5;6", two),
        ("1\t1\t2\t3\n2\t4\t-5\t6", two),
        ("1,1.0,2,3\n2,4.0,-5,6", two),
        ("1 1 2 3 0 0 1\n2 4 -5 6 0 0.6 0.8", "line 4 -5 6 job tilt 0 0.6 0.8"),
        // No row numbers: they do not count, or the rest is a feed along a straight line.
        ("1 2 3 10\n3 -5 6 50", "line 3 -5 6 feed 50"),
        ("0 2 3 10\n1 -5 6 50", "line 1 -5 6 feed 50"),
        ("1 2 3 50\n2 2 3 50\n3 2 3 50", "line 2 2 3 feed 50; line 3 2 3 feed 50"),
        ("1.0 2 3 10\n2.0 -5 6 50", "line 2 -5 6 feed 50"),
        ("x y z f\n1 2 3 10\n2 -5 6 50", "line 2 -5 6 feed 50"),
        ("1 2 3 0 0 1 10\n2 -5 6 0 0 1 50", "line 2 -5 6 feed 50"),
    ] {
        let program = read(text).unwrap_or_else(|error| panic!("{text:?}: {error}"));
        assert_eq!(described(&program), expected, "{text:?}");
        assert_sound(&program, text);
    }
    for (text, place, part) in [
        ("1;2;3\n1 23;2;3", (2, 1), "\"1 23\""),
        ("1;2;3\n1 234,567 8;2;3", (2, 1), "a number"),
        ("1\t2\t3\n1\t\t3", (2, 3), "\"\""),
        ("\"1,234\",2,3", (1, 1), "1234 or 1.234"),
        ("\"1,5\",2.5,3", (1, 7), "either points or commas"),
        ("sep=;\n1,2,3", (2, 1), "\"1,2,3\""),
        ("sep=|\n1|2|3", (1, 1), "the columns are"),
        ("1,2,3\n4,-5,6\n\u{1a}7,8,9", (3, 1), "\"\u{1a}7\""),
        ("n,x,y\n1,2,3", (1, 5), "x, y and z"),
        ("n,no,x,y,z\n1,1,2,3,4", (1, 3), "only once"),
    ] {
        common::refused_at(read(text), text, place, part);
    }
    for (text, line) in [("n,x,y,z\n1,1,2,3\n2,4,-5,6", 2), ("1 1 2 3\n2 4 -5 6", 1)] {
        let program = read(text).unwrap();
        let remarks: Vec<_> = program.remarks.iter().map(|remark| (remark.code, remark.line)).collect();
        assert_eq!(remarks, [("index-column", line)], "{text:?}");
    }
}

#[test]
fn angles_of_a_robot_are_no_axis() {
    for (text, place) in [
        // P33
        ("0 0 0 0 90 0\n50 0 0 0 90 0", (1, 7)),
        ("0,0,0,180.0,0,90\n50,0,0,180.0,0,90", (1, 7)),
        ("0 0 0 0 0 0\n50 0 0 0 0 0", (1, 7)),
        ("0 0 0 0 0 1\n50 0 0 0 0 1.06", (2, 8)),
        ("0 0 0 0 0 1\n50 0 0 0 0 0.94", (2, 8)),
        ("0 0 0 0 90 0 10\n50 0 0 0 90 0 10", (1, 7)),
        ("1 0 0 0 0 90 0\n2 50 0 0 0 90 0", (1, 7)),
        ("x,y,z,i,j,k\n0,0,0,0,0,1\n50,0,0,0,3,4", (3, 8)),
        ("x,y,z,a,b,c\n0,0,0,0,90,0", (1, 7)),
        ("X;Y;Z;A [deg];B [deg];C [deg]\n0;0;0;0;90;0", (1, 7)),
        ("x y z rx ry rz\n0 0 0 0 1.57 0", (1, 7)),
        ("x\ty\tz\tw\tp\tr\n0\t0\t0\t0\t90\t0", (1, 7)),
        ("w,p,r,x,y,z\n0,90,0,0,0,0", (1, 1)),
        ("x,y,z,qw,qx,qy,qz\n0,0,0,1,0,0,0", (1, 7)),
    ] {
        common::refused_at(read(text), text, place, "robot angles");
    }
    for text in [
        // P49
        "0,0,0,0,0,0.999\n50,0,0,0,0.01,0.9999",
        "0 0 0 0 0 1\n50 0 0 0.57 0.57 0.57",
        "0 0 0 0 0 1.04\n50 0 0 0 0 0.96",
    ] {
        let program = read(text).unwrap_or_else(|error| panic!("{text:?}: {error}"));
        assert_sound(&program, text);
        assert!((program.moves[0].segment.length() - 0.05).abs() < 1e-12, "{text:?}");
    }
}

#[test]
fn points_are_three_columns() {
    let read = |text: &str| {
        points(text, "path.text")
            .map(|points| {
                points.iter().map(|p| [p.x * 1e3, p.y * 1e3, p.z * 1e3].map(f64::round)).collect::<Vec<_>>()
            })
            .map_err(|error| error.place().unwrap())
    };
    assert_eq!(read(""), Ok(vec![]));
    assert_eq!(read("x,y,z\n1,2,3\n1,2,3"), Ok(vec![[1.0, 2.0, 3.0]; 2]));
    assert_eq!(read("1;2;3"), Ok(vec![[1.0, 2.0, 3.0]]));
    assert_eq!(read("x_in y_in z_in\n10 0 0"), Ok(vec![[254.0, 0.0, 0.0]]));
    assert_eq!(read("1,2,3,4"), Err((1, 7)));
    assert_eq!(read("1,5,2,5,3,5"), Err((1, 7)));
    assert_eq!(read("x,y,z,feed\n1,2,3,4"), Err((1, 7)));
    assert_eq!(read("x,y,z,i,j,k\n1,2,3,0,0,1"), Err((1, 7)));
}

/// A random text with an axis and a feed, its lengths divided by `scale`.
fn random_text(random: &mut fastrand::Rng, header: &str, scale: f64) -> String {
    let mut text = format!("{header}\n");
    for _ in 0..30 {
        let [x, y, z] = [0; 3].map(|_| (random.f64() * 200.0 - 100.0) / scale);
        let [i, j] = [0; 2].map(|_| random.f64() - 0.5);
        let length = (i * i + j * j + 1.0_f64).sqrt();
        let [i, j, k] = [i / length, j / length, 1.0 / length];
        let feed = (1.0 + random.f64() * 100.0) / scale;
        writeln!(text, "{x};{y};{z};{i};{j};{k};{feed}").unwrap();
    }
    text
}

#[test]
fn inches_and_millimetres_are_the_same_path() {
    for seed in 0..200 {
        let mut random = fastrand::Rng::with_seed(seed);
        let mm = read(&random_text(&mut random.clone(), "x_mm;y_mm;z_mm;i;j;k;feed_mm_min", 1.0)).unwrap();
        let inch = read(&random_text(&mut random, "x_in;y_in;z_in;i;j;k;feed_in_min", 25.4)).unwrap();
        assert_sound(&mm, "random");
        assert_eq!(mm.moves.len(), 29);
        for (a, b) in mm.moves.iter().zip(&inch.moves) {
            let end = |m: &armill::path::program::Move| m.segment.point(m.segment.length());
            assert!((end(a) - end(b)).norm() < 1e-15, "seed {seed}");
            assert_eq!(a.axis_to, b.axis_to, "seed {seed}");
        }
    }
}

#[test]
fn decimal_commas_and_points_are_the_same_path() {
    for seed in 0..100 {
        let text = random_text(&mut fastrand::Rng::with_seed(seed), "x;y;z;i;j;k;feed", 1.0);
        let (points, commas) = (read(&text).unwrap(), read(&text.replace('.', ",")).unwrap());
        assert_eq!(points, commas, "seed {seed}");
    }
}

#[test]
fn no_text_makes_the_reader_panic() {
    let mut random = fastrand::Rng::with_seed(11);
    let words = [
        "x",
        "y",
        "z",
        "x,y,z\n",
        "x;y;z;f\n",
        "i",
        "feed",
        "[mm]",
        "_in",
        "1",
        "2",
        "-3.5",
        "1,5",
        "0",
        "1e308",
        "nan",
        ",",
        ";",
        "\t",
        " ",
        "\n",
        "\n",
        "\n",
        "#",
        "ö",
        "\"",
        "1,2,3\n",
        "4,5,6\n",
        "1;2;3\n",
        "sep=,\n",
        "n,x,y,z\n",
        "1 1 2 3\n2 4 5 6\n",
        "\u{a0}",
        "1 234",
        "\r",
        "\u{1a}",
        "\"1,5\"",
    ];
    let mut read_well = 0;
    for round in 0..20_000 {
        let text = if round % 2 == 0 {
            let bytes: Vec<u8> = (0..random.usize(0..200)).map(|_| random.u8(..)).collect();
            String::from_utf8_lossy(&bytes).into_owned()
        } else {
            let start = if round % 4 == 1 { "x,y,z\n1,2,3\n4,5,6\n" } else { "" };
            (0..random.usize(0..8)).fold(start.to_string(), |text, _| text + random.choice(words).unwrap())
        };
        let _ = points(&text, "path.text");
        if let Ok(program) = read(&text) {
            assert_sound(&program, &text);
            read_well += 1;
        }
    }
    assert!(read_well > 100, "{read_well} random texts were programs");
}

#[test]
fn half_a_million_rows_are_read_in_seconds() {
    let mut text = String::from("x,y,z,i,j,k,feed\n");
    for row in 0..500_000 {
        writeln!(text, "{:.4},{:.4},{:.4},0.0,0.6,0.8,{}", row as f64 * 1e-3, -0.5, 12.25, 100 + row % 7)
            .unwrap();
    }
    let start = std::time::Instant::now();
    let program = read(&text).unwrap();
    let time = start.elapsed().as_secs_f64();
    assert_eq!((program.moves.len(), program.lines), (499_999, 500_001));
    // Well above the usual time (about 0.2 s), so that a busy machine does not fail it.
    assert!(time < 5.0, "{time} s");
}
