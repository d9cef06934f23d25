//! Names the language of a text that is not APT.

use crate::path::lines::TextLines;

/// How many lines of a text are looked at.
const LINES: usize = 200;

/// How programs begin, or what their moves begin with, in upper case.
const BEGINNINGS: [(&str, &[&str]); 6] = [
    (
        "KUKA KRL",
        &[
            "&ACCESS", "&REL", "&PARAM", "&COMMENT", "DEF ", "DEFDAT ", "PTP ", "LIN ", "CIRC ", "SPTP ",
            "SLIN ", ";FOLD",
        ],
    ),
    (
        "ABB RAPID",
        &["%%%", "MODULE ", "PROC ", "CONST ROBTARGET", "PERS ", "MOVEL ", "MOVEJ ", "MOVEC ", "MOVEABSJ "],
    ),
    ("a FANUC TP program", &["/PROG", "/ATTR", "/MN", "/POS"]),
    ("a Yaskawa job", &["/JOB", "//NAME", "//POS", "MOVL ", "MOVJ "]),
    ("URScript", &["MOVEL(P[", "MOVEJ(P[", "MOVEP(P["]),
    ("Staubli VAL3", &["MOVEL(", "MOVEJ(", "MOVEC("]),
];

/// What the text is instead of APT, and what to do about it; `None` for a text that has a statement
/// of APT, or nothing known.
pub(super) fn other_than_apt(text: &str) -> Option<(&'static str, &'static str)> {
    let lines: Vec<String> =
        TextLines::of(text).take(LINES).map(|line| line.trim().to_ascii_uppercase()).collect();
    let goes =
        |line: &String| line.strip_prefix("GOTO").is_some_and(|rest| rest.trim_start().starts_with('/'));
    if lines.iter().any(|line| goes(line) || line.starts_with("PARTNO")) {
        return None;
    }
    lines.iter().find_map(|line| named(line))
}

/// The language that an upper-case line belongs to, and what to do about it.
fn named(line: &str) -> Option<(&'static str, &'static str)> {
    if is_gcode(line) {
        return Some(("G-code", "this is G-code: choose G-code as the kind of path (\"gcode\")"));
    }
    if is_heidenhain(line) {
        return Some(("Heidenhain Klartext", NOT_READ));
    }
    if is_row(line) {
        return Some(("rows of numbers", "these are points: choose points as the kind of path (\"csv\")"));
    }
    // `DEF PART()` is KRL, `def part():` is URScript, recognised by its moves.
    if line.ends_with(':') {
        return None;
    }
    let (name, _) = BEGINNINGS.iter().find(|(_, words)| words.iter().any(|word| line.starts_with(word)))?;
    Some((*name, NOT_READ))
}

const NOT_READ: &str =
    "this language is not supported: have the CAM system write G-code, APT/CLDATA or points";

/// Whether a line in upper case is a block of G-code: letters, each with its number.
fn is_gcode(line: &str) -> bool {
    let end = line.find([';', '(']).unwrap_or(line.len());
    let mut rest = line[..end].trim_start_matches('/').trim();
    let mut letters = 0;
    while let Some(letter) = rest.chars().next() {
        let number = rest[letter.len_utf8()..].trim_start();
        let after = number.trim_start_matches(|c: char| c.is_ascii_digit() || "+-.".contains(c));
        let digits = number[..number.len() - after.len()].contains(|c: char| c.is_ascii_digit());
        if !letter.is_ascii_uppercase() || !digits {
            return false;
        }
        letters += 1;
        rest = after.trim_start();
    }
    letters > 0
}

/// Whether a line in upper case is a block of Heidenhain Klartext: its number and a word.
fn is_heidenhain(line: &str) -> bool {
    let words = line.trim_start_matches(|c: char| c.is_ascii_digit());
    let words = words.trim_start();
    ["BEGIN PGM", "TOOL CALL", "BLK FORM", "CYCL DEF", "L X", "L Y", "L Z"]
        .iter()
        .any(|word| words.starts_with(word))
}

/// Whether a line is three numbers or more and what separates them.
fn is_row(line: &str) -> bool {
    let apart = |c: char| c.is_whitespace() || c == ',' || c == ';';
    let cells: Vec<&str> = line.split(apart).filter(|cell| !cell.is_empty()).collect();
    cells.len() >= 3 && cells.iter().all(|cell| cell.parse::<f64>().is_ok())
}
