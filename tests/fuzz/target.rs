//! Laws for any text: nothing panics or hangs, no number is NaN, every rejection has a place and a
//! message, and every output can be read.

use armill::chart;
use armill::export::{Export, ExportOptions, FORMATS};
use armill::path::program::{MovePace, Program};
use armill::path::unit::{FeedUnit, LengthUnit};
use armill::path::{Path, Segment, apt, csv, gcode};
use armill::setup::Controller;
use armill::units::MM;
use armill::verification::{Package, Programs};
use armill::{Error, Job, Report};
use nalgebra::Vector3;
use serde_json::{Value, json};
use std::fs;
use std::path::PathBuf;

use super::controllers;

/// A reader of texts under test.
pub(crate) struct Target {
    pub(crate) name: &'static str,
    /// Panics if the text breaks a law.
    pub(crate) check: fn(&str),
}

pub(crate) const TARGETS: [Target; 5] = [
    Target { name: "gcode", check: check_gcode },
    Target { name: "apt", check: check_apt },
    Target { name: "csv", check: check_csv },
    Target { name: "job", check: check_job },
    Target { name: "export", check: check_export },
];

impl Target {
    /// The corpus folder of this target, from the package or from the engine.
    pub(crate) fn folder(&self) -> PathBuf {
        let here = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
        let beside = ["tests/fuzz/corpus", "../corpus"].map(|folder| here.join(folder));
        beside.into_iter().find(|folder| folder.is_dir()).expect("a corpus").join(self.name)
    }

    /// The texts of the corpus, ordered by name.
    pub(crate) fn corpus(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder()).expect("a corpus for each target");
        let mut paths: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
        if self.name == "gcode" {
            // What posts write is worth changing too.
            let here = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
            let beside = ["tests/data/posts", "../../data/posts"].map(|folder| here.join(folder));
            let posts = beside.into_iter().find(|folder| folder.is_dir()).expect("the posts");
            paths
                .extend(fs::read_dir(posts).expect("the posts").map(|entry| entry.expect("an entry").path()));
        }
        paths.sort();
        paths
            .iter()
            .map(|path| String::from_utf8_lossy(&fs::read(path).expect("a text")).into_owned())
            .collect()
    }
}

const TEXT: &str = "path.text";

fn check_gcode(text: &str) {
    let tables = gcode::Options {
        work_offsets: [Some(Vector3::new(0.1, -0.2, 0.3)); 9],
        tool_length_offsets: [(1, 0.05), (2, -0.01)].into(),
        start: Some(Vector3::zeros()),
        block_delete: false,
        ..gcode::Options::default()
    };
    for options in [gcode::Options::default(), tables] {
        check_reader(text, |on_line| gcode::program(text, &options, on_line));
    }
}

fn check_apt(text: &str) {
    for unit in [LengthUnit::Mm, LengthUnit::Inch] {
        check_reader(text, |on_line| apt::program(text, &apt::Options { field: TEXT, unit }, on_line));
    }
}

fn check_csv(text: &str) {
    for (unit, feed_unit) in [(LengthUnit::Mm, FeedUnit::MmPerS), (LengthUnit::Inch, FeedUnit::InchPerMin)] {
        check_reader(text, |on_line| {
            csv::program(text, &csv::Options { field: TEXT, unit, feed_unit }, on_line)
        });
    }
    if let Err(error) = csv::points(text, TEXT) {
        check_error(&error, text, text);
    }
}

fn check_job(text: &str) {
    let job = match Job::read_json(text) {
        Ok((job, _)) => job,
        Err(error) => return check_error(&error, text, ""),
    };
    let again =
        Job::from_json(&job.to_json()).unwrap_or_else(|error| panic!("a job reads its own JSON: {error}"));
    assert!(is_same(&json!(again), &json!(job)), "a job survives its own JSON: {again:?}");
    if let Some(report) = run(&job) {
        // All controllers are tried on programs; here, where an arm may be solved by iteration, only
        // the job's own.
        check_exports(&report, &[None]);
        check_charts(&report);
    }
}

/// Equal up to the last bits of numbers: exact reading of 17 digits (serde_json's
/// `float_roundtrip`) would cost the page 40 kB.
fn is_same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => match (a.as_f64(), b.as_f64()) {
            (Some(a), Some(b)) => (a - b).abs() <= 1e-15 * b.abs(),
            _ => false,
        },
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_same(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            a.len() == b.len() && a.iter().all(|(key, a)| b.get(key).is_some_and(|b| is_same(a, b)))
        }
        (a, b) => a == b,
    }
}

/// A program as a job, sampled coarsely enough to compute quickly.
fn check_export(text: &str) {
    for kind in ["gcode", "apt", "csv"] {
        let job = json!({
            "path": { "kind": kind, "text": text },
            "shaper": { "kind": "zvd", "frequency_rad_s": 60, "damping": 0.05 },
            "motion": { "acceleration_mm_s2": 2000 },
            "compensation": { "max_passes": 3 },
        });
        let mut job = Job::from_json(&job.to_string()).expect("a job");
        let Ok(setup) = armill::setup::Setup::of(&job, &mut armill::Progress::none()) else { continue };
        let samples = armill::motion::Trajectory::count(&setup.path, &setup.limits);
        job.motion.sample_time_s = (job.motion.sample_time_s * samples / 100.0).clamp(1e-5, 1.0);
        run(&job).iter().for_each(|report| check_exports(report, &CONTROLLERS));
        return;
    }
}

/// Largest number of samples computed here.
const FEW: f64 = 400.0;

/// Runs a job of few samples; its report, if it has one, must hold finite numbers only.
fn run(job: &Job) -> Option<Report> {
    let program = job.path.text.as_deref().unwrap_or_default();
    let setup = match armill::setup::Setup::of(job, &mut armill::Progress::none()) {
        Ok(setup) => setup,
        Err(error) => {
            check_error(&error, "", program);
            return None;
        }
    };
    let samples = armill::motion::Trajectory::count(&setup.path, &setup.limits);
    assert!(samples.is_finite(), "{samples} samples");
    if samples > FEW || job.compensation.max_passes > 20 {
        return None;
    }
    armill::run(job, &mut armill::Progress::none())
        .inspect(check_numbers)
        .inspect_err(|error| check_error(error, "", program))
        .ok()
}

/// A reader gives the same result twice: a sound program, or an error located in the text.
fn check_reader(text: &str, read: impl Fn(&mut dyn FnMut(usize)) -> Result<Program, Error>) {
    let (mut done, most) = (0, text.lines().count().max(unified(text).lines().count()));
    let outcome = read(&mut |lines| {
        assert!(lines >= done && lines <= most, "{lines} lines done after {done}");
        done = lines;
    });
    assert_eq!(outcome, read(&mut |_| {}), "the same text is read the same");
    match outcome {
        Ok(program) => check_program(&program),
        Err(error) => {
            assert_eq!((error.code(), error.field()), ("text", Some(TEXT)));
            check_error(&error, "", text);
        }
    }
}

/// Moves join without a gap in position and axis; every number is finite.
fn check_program(program: &Program) {
    let size = |segment: &Segment| match segment {
        Segment::Line { from, to } => 1.0 + from.norm() + to.norm(),
        // Sine and cosine of many turns lose digits of the angle.
        Segment::Arc { center, radius, sweep, rise, .. } => {
            1.0 + center.norm() + radius * (1.0 + sweep) + rise.abs()
        }
    };
    for step in &program.moves {
        let segment = &step.segment;
        let length = segment.length();
        assert!(length.is_finite() && length > 0.0, "line {}: length {length}", step.line);
        for s in [0.0, length / 2.0, length] {
            let numbers = [segment.point(s), segment.tangent(s)];
            assert!(
                numbers.iter().all(|v| v.iter().all(|x| x.is_finite())),
                "line {}: {segment:?}",
                step.line
            );
            assert!((numbers[1].norm() - 1.0).abs() < 1e-6, "line {}: {segment:?}", step.line);
        }
        for axis in [step.axis_from, step.axis_to] {
            assert!((axis.norm() - 1.0).abs() < 1e-12, "line {}: axis {axis}", step.line);
        }
        if let MovePace::Feed(feed) = step.pace {
            assert!(feed.is_finite() && feed > 0.0, "line {}: feed {feed}", step.line);
        }
        assert!(step.spindle.is_none_or(|speed| speed.is_finite() && speed > 0.0), "line {}", step.line);
        assert!((1..=program.lines).contains(&step.line), "line {} of {}", step.line, program.lines);
    }
    for pair in program.moves.windows(2) {
        let (end, start) = (pair[0].segment.point(pair[0].segment.length()), pair[1].segment.point(0.0));
        let gap = (end - start).norm();
        let bound = 1e-9 + 1e-11 * (size(&pair[0].segment) + size(&pair[1].segment));
        assert!(gap < bound, "a gap of {gap} m before line {}", pair[1].line);
        assert_eq!(pair[0].axis_to, pair[1].axis_from, "the axis jumps before line {}", pair[1].line);
        assert!(program.jumps || pair[0].line <= pair[1].line, "lines out of order");
    }
    for dwell in &program.dwells {
        assert!(dwell.time.is_finite() && dwell.time >= 0.0 && dwell.after <= program.moves.len());
    }
    let remarks = program.remarks.iter().map(|remark| (&remark.message, remark.line));
    for (words, line) in remarks.chain(program.ignored.iter().map(|ignored| (&ignored.word, ignored.line))) {
        assert!(
            (1..=program.lines.max(1)).contains(&line) && !words.trim().is_empty(),
            "line {line}: {words:?}"
        );
    }
    assert!(["mm", "inch"].contains(&program.unit), "{:?}", program.unit);
    if let Some(path) = Path::of_program(program) {
        assert!(path.length().is_finite() && path.corners().all(|corner| corner.angle.is_finite()));
    }
}

fn place(error: &Error) -> (usize, usize) {
    error.place().unwrap_or_else(|| panic!("{error:?} has no place"))
}

/// An error has a message, and a place in its text or the name of a field.
fn check_error(error: &Error, json: &str, program: &str) {
    let message = error.to_string();
    assert!(!message.trim().is_empty() && message.chars().count() < 1000, "{} characters", message.len());
    let text = match error {
        Error::Text { .. } => program,
        Error::Json { .. } | Error::UnknownKey { .. } => json,
        Error::Unreachable { position, distance, .. } => {
            assert!(position.iter().chain([distance]).all(|x| x.is_finite()), "{error:?}");
            return;
        }
        Error::BranchEnds { position, turn, .. } => {
            assert!(position.iter().chain([turn]).all(|x| x.is_finite()), "{error:?}");
            return;
        }
        _ => return assert!(error.field().is_some_and(|field| !field.is_empty()), "{error:?}"),
    };
    let (line, column) = place(error);
    let lies_in = |text: &str| {
        let mut lines = text.split('\n');
        line >= 1 && column >= 1 && lines.nth(line - 1).is_some_and(|line| column <= line.chars().count() + 1)
    };
    assert!(lies_in(text) || lies_in(&unified(text)), "{error:?}");
}

/// The text with LF at the end of each line: the readers of APT and CSV know bare CR, too.
fn unified(text: &str) -> String {
    text.replace("\r\n", "\n").replace('\r', "\n")
}

fn check_numbers(report: &Report) {
    for column in report.columns() {
        assert_eq!(column.values.len(), report.samples(), "{}", column.key);
        assert!(column.values.iter().all(|x| x.is_finite()), "{}", column.key);
    }
    // serde_json writes a non-finite number as null.
    let summary = json!(report.summary()).to_string();
    assert!(!summary.contains("null") && !summary.contains("NaN"), "{summary}");
}

fn check_charts(report: &Report) {
    for entry in chart::charts_of(report) {
        let options = chart::ChartOptions::sized(640.0, 300.0);
        let chart = chart::chart(report, entry.name, &options)
            .unwrap_or_else(|error| panic!("{}: {error}", entry.name));
        assert!(!chart.svg.contains("NaN") && !chart.svg.contains("inf\""), "{}", entry.name);
    }
}

fn check_exports(report: &Report, controllers: &[Option<Controller>]) {
    for format in FORMATS {
        match armill::verification::export(report, format.id, &ExportOptions::default()) {
            Ok(export) => {
                assert!(!export.text.contains("NaN"), "{}", format.id);
                check_written(report, format.id, &export);
            }
            Err(error) => check_error(&error, "", ""),
        }
    }
    let programs = Programs::default();
    for controller in controllers {
        match programs.package(report, *controller) {
            Ok(package) => check_package(&package),
            Err(error) => check_error(&error, "", ""),
        }
    }
}

/// The controllers that take packages.
const CONTROLLERS: [Option<Controller>; 4] =
    [Some(Controller::Kuka), Some(Controller::Abb), Some(Controller::Staubli), Some(Controller::Fanuc)];

/// A package is what its controller's reader takes.
fn check_package(package: &Package) {
    // Those of one file are read where formats are checked.
    if CONTROLLERS.into_iter().flatten().all(|controller| controller.id() != package.controller) {
        return;
    }
    let files = package.files.iter().map(|file| (file.path.as_str(), file.text.as_str()));
    let read = controllers::read(package.controller, files);
    // A path through a singularity is said to be no path for a controller.
    if package.remarks.iter().any(|remark| remark.contains("changes its posture")) {
        return;
    }
    let program =
        read.unwrap_or_else(|error| panic!("{}: {error}\n{}", package.controller, package.files[0].text));
    assert_eq!(program.targets.len(), package.points, "{}", package.controller);
}

/// Output is read back, and passes every commanded tip.
fn check_written(report: &Report, id: &str, export: &Export) {
    let text = export.text.as_str();
    let read = match id {
        "gcode" => gcode::program(text, &gcode::Options::default(), |_| {}),
        "apt" => apt::program(text, &apt::Options { field: TEXT, unit: LengthUnit::Mm }, |_| {}),
        "path-csv" => csv::program(
            text,
            &csv::Options { field: TEXT, unit: LengthUnit::Mm, feed_unit: FeedUnit::MmPerS },
            |_| {},
        ),
        _ => return,
    };
    let program = read.unwrap_or_else(|error| panic!("{id}: {error}\n{text}"));
    check_program(&program);
    let back = report.setup().workpiece.inverse();
    for tip in export.commanded_path.positions(report).iter().map(|tip| back.point(tip)) {
        let distance =
            |segment: &Segment| (segment.point(segment.closest(&tip, 0.0, segment.length())) - tip).norm();
        let distances = program.moves.iter().map(|step| distance(&step.segment));
        let nearest = distances.fold(f64::INFINITY, f64::min);
        // Texts are written to 1e-5 mm or 1e-6 inch.
        assert!(
            nearest <= export.deviation + 1e-4 * MM,
            "{id}: a tip is {nearest} m beside the path\n{text}"
        );
    }
}
