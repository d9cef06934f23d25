//! Mutates a text word by word, with the words and lines of the corpus, so that most results still
//! mean something in any language.

use fastrand::Rng;
use std::collections::BTreeSet;

/// Numbers at which arithmetic overflows or changes sign.
#[rustfmt::skip]
const NUMBERS: [&str; 24] = [
    "0", "1", "-1", "2", "3", "0.5", "10", "90", "180", "360", "-90", "1000", "100000", "4294967296", "99999999999999999999",
    "0.001", "0.00001", "0.000000001", "-0.0", "1e-9", "1e9", "1e308", "-1e-308", "1e400",
];

/// The material for mutations.
pub(crate) struct Words {
    words: Vec<String>,
    lines: Vec<String>,
}

impl Words {
    /// Collects the words and lines of these texts.
    pub(crate) fn of(texts: &[String]) -> Self {
        let words: BTreeSet<&str> = texts.iter().flat_map(|text| split(text)).collect();
        let lines: BTreeSet<&str> = texts.iter().flat_map(|text| text.lines()).collect();
        let owned = |set: BTreeSet<&str>| set.into_iter().map(str::to_owned).collect();
        Self { words: owned(words), lines: owned(lines) }
    }

    /// Returns the text with one to four changes.
    pub(crate) fn mutated(&self, text: &str, random: &mut Rng) -> String {
        let mut text = text.to_owned();
        for _ in 0..random.u8(1..5) {
            text = if random.u8(0..4) == 0 {
                self.other_lines(&text, random)
            } else {
                self.other_words(&text, random)
            };
        }
        text
    }

    fn other_words(&self, text: &str, random: &mut Rng) -> String {
        let mut words = split(text);
        let at = random.usize(0..=words.len());
        let (one, other) = (one_of(&self.words, random), random.usize(0..words.len().max(1)));
        if at == words.len() {
            words.push(one);
            return words.concat();
        }
        let old = words[at];
        let tweaked;
        match random.u8(0..8) {
            0 => drop(words.remove(at)),
            1 => words.insert(at, one),
            2 => words.insert(at, old),
            3 => words.swap(at, other),
            4 if kind(old) != FieldKind::Number => words[at] = one,
            _ => {
                // A number at or behind this place.
                let place = words
                    .iter()
                    .skip(at)
                    .position(|word| kind(word) == FieldKind::Number)
                    .map_or(at, |skip| at + skip);
                tweaked = number(words[place], random);
                words[place] = &tweaked;
            }
        }
        words.concat()
    }

    fn other_lines(&self, text: &str, random: &mut Rng) -> String {
        let mut lines: Vec<&str> = text.split('\n').collect();
        let (at, other) = (random.usize(0..lines.len()), random.usize(0..lines.len()));
        match random.u8(0..5) {
            0 => drop(lines.remove(at)),
            1 => lines.insert(at, lines[other]),
            2 => lines.swap(at, other),
            3 => lines.truncate(at + 1),
            _ => lines.insert(at, one_of(&self.lines, random)),
        }
        lines.join("\n")
    }
}

fn one_of<'a>(list: &'a [String], random: &mut Rng) -> &'a str {
    if list.is_empty() { "" } else { &list[random.usize(0..list.len())] }
}

/// Replaces a number by another: near it, or from the list.
fn number(old: &str, random: &mut Rng) -> String {
    match (old.parse::<f64>(), random.u8(0..6)) {
        (Ok(value), 0) => format!("{}", -value),
        (Ok(value), 1) => format!("{}", value * 10.0),
        (Ok(value), 2) => format!("{}", value / 10.0),
        (Ok(value), 3) => format!("{}", value + 1.0),
        (Ok(_), 4) => format!("{old}{}", random.u8(0..10)),
        _ => NUMBERS[random.usize(0..NUMBERS.len())].to_owned(),
    }
}

#[derive(PartialEq)]
enum FieldKind {
    Name,
    Number,
    Other,
}

fn kind(word: &str) -> FieldKind {
    match word.chars().next() {
        Some(c) if c.is_alphabetic() || c == '_' => FieldKind::Name,
        Some(c) if c.is_ascii_digit() || c == '.' => FieldKind::Number,
        _ => FieldKind::Other,
    }
}

/// Runs of letters, runs of digits and points, and single other characters.
fn split(text: &str) -> Vec<&str> {
    let mut words = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = match kind(rest) {
            FieldKind::Other => first.len_utf8(),
            run => rest.find(|c: char| kind(c.encode_utf8(&mut [0; 4])) != run).unwrap_or(rest.len()),
        };
        let (word, behind) = rest.split_at(length);
        words.push(word);
        rest = behind;
    }
    words
}
