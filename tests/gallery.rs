//! The gallery: every figure in its answers is what the core gives for the job that the card opens.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::cards::{self, cards, figures, job, without_tags};
use armill::Progress;
use serde_json::{Value, json};

/// Names with digits in them, and what the page says everywhere: numbers that no job computes.
const NAMES: [&str; 9] = [
    "KR 500-3 MT",
    "GP88",
    "7075-T6",
    "6082-T6",
    "TX200",
    "KR 240 R2900-2",
    "IRB 4600-60/2.05",
    "IRB 6640-235/2.55",
    "RX-90",
];

/// Bytes of a picture, and of all together.
const LARGEST: [u64; 2] = [40_000, 400_000];

/// The jobs whose question is what the arm cannot run.
const CANNOT_RUN: [&str; 3] = ["dome", "reach", "thesis"];

fn web() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("web")
}

/// The summary of a job, with the job itself.
fn summary(name: &str) -> Value {
    let job = job(name);
    let report = armill::run(&job, &mut Progress::none()).unwrap();
    let mut summary = json!(report.summary());
    summary["job"] = serde_json::from_str(&job.to_json()).unwrap();
    summary
}

/// Whether a figure is the value: a number to the digits shown, without its sign, or words of a text.
fn is(figure: &str, value: &Value) -> bool {
    match value {
        Value::Number(number) => {
            let decimals = figure.split_once('.').map_or(0, |(_, digits)| digits.len());
            figure == format!("{:.decimals$}", number.as_f64().unwrap().abs())
        }
        Value::String(text) => text.split_once(figure).is_some_and(|(before, after)| {
            let inside = |letter: Option<char>| letter.is_some_and(|letter| letter.is_ascii_alphanumeric());
            let digits = after.strip_prefix('.').unwrap_or(after);
            !inside(before.chars().last()) && !inside(digits.chars().next())
        }),
        _ => false,
    }
}

#[test]
fn figures_are_what_the_core_gives() {
    let mut summaries: BTreeMap<String, Value> = BTreeMap::new();
    let cards = cards();
    assert_eq!(cards.len(), 8);
    for card in &cards {
        let figures = figures(&card.answer);
        assert!(figures.len() >= 2, "{}: {figures:?}", card.id);
        for (place, figure) in figures {
            let (name, key) = place.split_once(' ').unwrap();
            let summary = summaries.entry(name.into()).or_insert_with(|| summary(name));
            let pointer = format!("/{}", key.replace('.', "/"));
            let value = summary.pointer(&pointer).unwrap_or_else(|| panic!("{name} has no {key}"));
            assert!(
                is(&figure, value),
                "{}: {figure} is shown for {key} of {name}, which is {value}",
                card.id
            );
        }
        // No number stands there but the figures.
        let (mut rest, _) = cards::without_figures(&card.answer);
        rest = without_tags(&rest).replace("in 95 of 100 cases", "");
        for name in NAMES {
            rest = rest.replace(name, "");
        }
        assert!(!rest.chars().any(|letter| letter.is_ascii_digit()), "{}: {rest}", card.id);
    }
    for (name, summary) in &summaries {
        let cannot = summary["verdict_state"] == "cannot-run";
        assert_eq!(cannot, CANNOT_RUN.contains(&name.as_str()), "{name}: {}", summary["verdict"]);
    }
    let mut files: Vec<String> = fs::read_dir(web().join("gallery"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter_map(|name| name.strip_suffix(".json").map(str::to_owned))
        .collect();
    files.extend(["bracket".to_owned(), "thesis".to_owned()]);
    files.sort();
    assert_eq!(files, summaries.into_keys().collect::<Vec<_>>(), "every job has its figure");
}

#[test]
fn every_card_asks_a_question_and_has_a_picture_in_words() {
    let mut all = 0;
    let mut seen = Vec::new();
    for card in cards() {
        assert!(card.question.ends_with('?'), "{}", card.question);
        assert!(card.alt.len() > 60 && card.alt.ends_with('.'), "{}: {}", card.id, card.alt);
        assert_eq!(card.picture, format!("gallery/{}.webp", card.id));
        let bytes = fs::metadata(web().join(&card.picture)).unwrap().len();
        assert!((2_000..=LARGEST[0]).contains(&bytes), "{} has {bytes} bytes", card.picture);
        all += bytes;
        assert_eq!(card.links[0].0, card.id, "the question opens its own job");
        assert!(!seen.contains(&card.question), "{} twice", card.question);
        seen.push(card.question);
    }
    assert!(all <= LARGEST[1], "{all} bytes");
    for id in ["bracket", "thesis"] {
        assert!(cards().iter().any(|card| card.id == id), "{id}");
    }
}

#[test]
fn a_figure_is_compared_to_the_digits_shown() {
    for (figure, value, same) in [
        ("0.20", json!(0.2022), true),
        ("0.21", json!(0.2022), false),
        ("0.2", json!(0.2022), true),
        ("80", json!(-80.0), true),
        ("joint 3 leaves its range by up to 6.1", json!("joint 3 leaves its range by up to 6.1 deg"), true),
        ("by up to 6", json!("joint 3 leaves its range by up to 6.1 deg"), false),
        ("up to 6.1", json!("joint 3 leaves its range by up to 6.12 deg"), false),
        ("6.1", json!(null), false),
    ] {
        assert_eq!(is(figure, &value), same, "{figure} {value}");
    }
}
