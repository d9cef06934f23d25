//! No text breaks a reader, the job or an export: the corpus, and some seconds of mutations of it.
//! `cargo xtask fuzz` searches for more, guided by coverage.

mod target;
mod words;

use crate::controllers;
use std::time::{Duration, Instant};
use target::{TARGETS, Target};
use words::Words;

/// Time limit for any text, on a slow machine too; most take microseconds.
const PATIENCE: Duration = Duration::from_secs(20);

fn check(target: &Target, text: &str) {
    let start = Instant::now();
    if std::panic::catch_unwind(|| (target.check)(text)).is_err() {
        let start: String = text.chars().take(4000).collect();
        panic!("{}: the text {start:?} ({} bytes) breaks a law", target.name, text.len());
    }
    let seconds = start.elapsed().as_secs_f64();
    assert!(start.elapsed() < PATIENCE, "{}: {seconds} s for {} bytes", target.name, text.len());
}

#[test]
fn kept_texts_hold_the_laws() {
    for target in &TARGETS {
        let corpus = target.corpus();
        assert!(corpus.len() > 5, "{}: {} texts", target.name, corpus.len());
        corpus.iter().for_each(|text| check(target, text));
    }
}

#[test]
fn changed_texts_hold_the_laws() {
    for target in &TARGETS {
        let corpus = target.corpus();
        let words = Words::of(&corpus);
        let mut random = fastrand::Rng::with_seed(41);
        let end = Instant::now() + Duration::from_secs(1);
        while Instant::now() < end {
            check(target, &words.mutated(&corpus[random.usize(0..corpus.len())], &mut random));
        }
    }
}

/// A file dropped by mistake, or a program of a million lines: time grows linearly with the length.
#[test]
fn long_texts_hold_the_laws() {
    let pieces = [
        "A",
        "1",
        " ",
        "\n",
        "(",
        "\"",
        ",",
        "1,2,3\n",
        "x y z ",
        "G4P0\n",
        "G1X1",
        "(a)",
        "/\n",
        "%\n",
        "$\n",
        "$$\n",
        "1$\n,",
        "GOTO/1,2,3\n",
        "GOTO/",
        "PPRINT ",
        "FEDRAT/1\n",
        "G0X1Y2Z3\nX4\n",
        "G2X1Y1R9P9\n",
        "o1 call\n",
        "o1 if [1]\n",
        "o1 while [1]\n",
        "M98P1\n",
        "GOTO 1\n",
        "#1=1\n",
        "X[",
        "X#",
        "CYCLE81(",
        "TRANS X1 ",
        "[",
        "{\"a\":",
        "\u{e4}",
        "0.",
        "-",
        "1;",
    ];
    let long = |piece: &str| piece.repeat(500_000 / piece.len());
    for target in TARGETS.iter().filter(|target| target.name != "export") {
        pieces.iter().for_each(|piece| check(target, &long(piece)));
    }
    let job = TARGETS.iter().find(|target| target.name == "job").unwrap();
    for (before, piece, after) in [
        ("{\"", "a", "\":1}"),
        ("{\"path\":{\"kind\":\"", "a", "\"}}"),
        ("{\"path\":{\"kind\":\"apt\",\"text\":\"", "a", "\"}}"),
        ("{\"path\":{\"kind\":\"polyline\",\"points_mm\":[", "[600,1,2],[600,2,2],", "[1,2,3]]}}"),
        ("{\"compensation\":{\"sources\":[", "\"shaping\",", "\"shaping\"]}}"),
    ] {
        check(job, &format!("{before}{}{after}", long(piece)));
    }
}
