//! The cards of `web/gallery.html`, as its tests read them.
#![allow(dead_code, reason = "each test file uses a part of this")]

use std::fs;
use std::path::{Path, PathBuf};

use armill::Job;

/// One card.
pub(crate) struct Card {
    pub(crate) id: String,
    pub(crate) question: String,
    /// The answer's markup.
    pub(crate) answer: String,
    pub(crate) picture: String,
    pub(crate) alt: String,
    /// The jobs that it opens, its own first: their names, and the words of the link.
    pub(crate) links: Vec<(String, String)>,
}

fn web() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("web")
}

/// What stands between `start` and the next `end`.
fn between<'a>(text: &'a str, start: &str, end: &str) -> &'a str {
    let (_, rest) = text.split_once(start).unwrap_or_else(|| panic!("no {start} in {text}"));
    rest.split_once(end).unwrap_or_else(|| panic!("{start} does not end")).0
}

/// The text without its tags.
pub(crate) fn without_tags(markup: &str) -> String {
    let mut parts = markup.split('<');
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| text + part.split_once('>').map_or("", |(_, rest)| rest))
}

/// All cards of the page.
pub(crate) fn cards() -> Vec<Card> {
    let page = fs::read_to_string(web().join("gallery.html")).unwrap();
    page.split("<article class=\"card\" ").skip(1).map(card).collect()
}

fn card(text: &str) -> Card {
    let text = text.split_once("</article>").unwrap().0;
    let links = text
        .split("<a href=\"")
        .skip(1)
        .map(|link| {
            let (address, rest) = link.split_once("\">").unwrap();
            (named(address), without_tags(rest.split_once("</a>").unwrap().0))
        })
        .collect();
    Card {
        id: between(text, "id=\"card-", "\"").into(),
        question: without_tags(between(text, "<h2>", "</h2>")),
        answer: between(text, "<p>", "</p>").into(),
        picture: between(text, "<img src=\"", "\"").into(),
        alt: between(text, "alt=\"", "\"").into(),
        links,
    }
}

/// The name of the job that an address opens.
fn named(address: &str) -> String {
    let file = address.strip_prefix("gallery/").and_then(|name| name.strip_suffix(".json"));
    let name = file.or_else(|| address.strip_prefix("index.html#example="));
    name.unwrap_or_else(|| panic!("{address} opens no job")).into()
}

/// The figures of an answer: the job and key of each, and its digits.
pub(crate) fn figures(answer: &str) -> Vec<(String, String)> {
    without_figures(answer).1
}

/// An answer without its figures, and the figures.
pub(crate) fn without_figures(answer: &str) -> (String, Vec<(String, String)>) {
    let mut parts = answer.split("<data value=\"");
    let mut rest = parts.next().unwrap_or_default().to_owned();
    let mut figures = Vec::new();
    for part in parts {
        let (place, part) = part.split_once("\">").unwrap();
        let (digits, after) = part.split_once("</data>").unwrap();
        figures.push((place.into(), digits.into()));
        rest.push_str(after);
    }
    (rest, figures)
}

/// A job of the gallery by its name: the core's own, or a file.
pub(crate) fn job(name: &str) -> Job {
    match name {
        "bracket" => Job::opening().unwrap(),
        "thesis" => Job::default(),
        _ => {
            let file = web().join("gallery").join(format!("{name}.json"));
            Job::from_json(&fs::read_to_string(file).unwrap()).unwrap()
        }
    }
}
