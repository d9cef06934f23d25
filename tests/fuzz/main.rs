//! No text breaks a reader, the job or an export: the texts that were found worth keeping, and some seconds of changes to them.
//! `cargo xtask fuzz` searches for more, guided by coverage.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod target;
mod words;

use std::time::{Duration, Instant};
use target::{TARGETS, Target};
use words::Words;

/// No text takes longer; most take microseconds.
const PATIENCE: Duration = Duration::from_secs(10);

fn check(target: &Target, text: &str) {
    let start = Instant::now();
    if std::panic::catch_unwind(|| (target.check)(text)).is_err() {
        panic!("{}: the text {text:?} breaks a law", target.name);
    }
    assert!(start.elapsed() < PATIENCE, "{}: {:?} for {text:?}", target.name, start.elapsed());
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
