//! Rewrites a program read from G-code with its compensated path.
//!
//! The program keeps its lines, block numbers, comments, spindle and auxiliary words; only the
//! words for positions, modes and feeds are replaced. A block that remains one straight move or one
//! arc remains one block. Others are split within the thinning tolerance, arcs into arcs where that
//! takes fewer moves, after a comment with the original.

use super::gcode::{self, MoveWords};
use crate::error::Error;
use crate::export::command::{Command, CommandedMove};
use crate::export::header;
use crate::path::SourceProgram;
use crate::path::gcode::after_slash;
use crate::path::gcode::token::{Kind, tokens};
use crate::report::Report;

/// M words that act after the motion of their block.
const AFTER: [&str; 7] = ["M0", "M1", "M2", "M5", "M9", "M30", "M60"];
/// Letters of words that are replaced in every block.
const REPLACED: [char; 9] = ['X', 'Y', 'Z', 'F', 'I', 'J', 'K', 'R', 'P'];
/// Codes that are replaced in every block.
const MOTION: [&str; 7] = ["G0", "G1", "G2", "G3", "G17", "G18", "G19"];

/// The program to rewrite, if there is one and the command follows the order of its lines.
pub(super) fn original<'r>(report: &'r Report, command: &Command) -> Option<&'r SourceProgram> {
    let follows = || command.moves.is_sorted_by_key(|commanded| commanded.line);
    let is_plain =
        |listing: &SourceProgram| !listing.program.jumps && listing.text.lines().all(has_plain_words);
    let listing = report.setup().program.as_ref();
    listing.filter(|listing| listing.language == "gcode" && follows() && is_plain(listing))
}

/// Whether a line has nothing but letters with a number: no variables, expressions, names or notes,
/// which would not survive the change of a word.
fn has_plain_words(line: &str) -> bool {
    let optional = after_slash(line) > 0;
    tokens(line, 0).filter(|token| token.kind == Kind::Word).all(|token| {
        let number = token.text.get(1..).unwrap_or_default().trim();
        let is_word = token.text.starts_with(|sign: char| sign.is_ascii_alphabetic());
        optional || token.text == "%" || is_word && number.parse::<f64>().is_ok()
    })
}

/// The original with the command's moves.
///
/// # Errors
/// See [`MoveWords::new`].
pub(super) fn program(report: &Report, command: &Command, original: &SourceProgram) -> Result<String, Error> {
    let mut writer = Writer { text: String::new(), words: MoveWords::new(report, command)? };
    let mut moves = command.moves.iter().peekable();
    let (mut opened, mut started) = (false, false);
    for (index, line) in original.text.trim_start_matches('\u{feff}').lines().enumerate() {
        let line = OriginalLine::of(line);
        let mut own = Vec::new();
        while let Some(commanded) = moves.next_if(|commanded| commanded.line == index + 1) {
            own.push(commanded);
        }
        if !(opened || own.is_empty() && line.precedes_header()) {
            opened = true;
            for line in header::lines(report, Some(command)) {
                writer.line(&gcode::comment(&line));
            }
            let centers = if chooses_centers(original) { " G91.1" } else { "" };
            writer.line(&(writer.words.modes() + centers));
        }
        if !own.is_empty() && !started {
            started = true;
            let start = writer.words.start(command);
            writer.line(&start);
        }
        writer.rewrite(&line, &own);
    }
    Ok(writer.text)
}

/// Whether a program states what I, J and K are relative to. Its control then knows G91.1; others
/// might refuse it.
fn chooses_centers(original: &SourceProgram) -> bool {
    let chooses =
        |line| OriginalLine::of(line).code.split(' ').any(|word| ["G90.1", "G91.1"].contains(&word));
    original.text.lines().any(chooses)
}

struct Writer {
    text: String,
    words: MoveWords,
}

impl Writer {
    fn line(&mut self, line: &str) {
        self.text.push_str(line.trim());
        self.text.push('\n');
    }

    fn wait(&mut self, commanded: &CommandedMove) {
        if commanded.wait > 0.0 {
            self.line(&gcode::wait(commanded.wait));
        }
    }

    /// Writes one line of the original with its commanded moves.
    fn rewrite(&mut self, line: &OriginalLine, moves: &[&CommandedMove]) {
        if let Some(first) = moves.first() {
            self.wait(first);
        }
        let steps: usize = moves.iter().map(|commanded| commanded.steps.len()).sum();
        let stays = steps == 1 && moves.len() == 1;
        let one = match moves {
            [commanded] if stays => self.words.step(&commanded.steps[0], commanded),
            _ => String::new(),
        };
        let after = if stays || steps == 0 { line.after.as_str() } else { "" };
        let kept = stays && line.simple || !line.dropped;
        let was = if kept { String::new() } else { format!("(was: {})", line.code) };
        self.line(&joined(&[&line.number, &line.before, &one, after, &line.comments, &was]));
        if stays || steps == 0 {
            return;
        }
        for (index, commanded) in moves.iter().enumerate() {
            if index > 0 {
                self.wait(commanded);
            }
            for step in &commanded.steps {
                let words = self.words.step(step, commanded);
                self.line(&words);
            }
        }
        if !line.after.is_empty() {
            self.line(&line.after);
        }
    }
}

fn joined(parts: &[&str]) -> String {
    parts.iter().filter(|part| !part.trim().is_empty()).map(|part| part.trim()).collect::<Vec<_>>().join(" ")
}

/// A line of the original, split into its parts.
struct OriginalLine {
    /// Its words without blanks inside, comments left out, upper case.
    code: String,
    /// The block number.
    number: String,
    /// Words kept before the motion.
    before: String,
    /// Words kept after the motion.
    after: String,
    /// Its comments.
    comments: String,
    /// Whether it is marked for block delete.
    optional: bool,
    /// Whether some of its words are dropped.
    dropped: bool,
    /// Whether the dropped words are only a motion, its plane, positions and a feed.
    simple: bool,
}

impl OriginalLine {
    fn of(line: &str) -> Self {
        let (words, comments) = words_and_comments(line);
        let mut original = Self {
            code: words.join(" "),
            number: String::new(),
            before: String::new(),
            after: String::new(),
            comments,
            optional: after_slash(line) > 0,
            dropped: false,
            simple: true,
        };
        if original.optional {
            // A switch on the control decides whether its words act; a move could not follow that.
            (original.dropped, original.simple) = (true, false);
            return original;
        }
        let blending = words.iter().any(|word| word == "G64");
        for word in words {
            let letter = word.chars().next().unwrap_or(' ');
            let place = match letter {
                'N' => &mut original.number,
                'M' if AFTER.contains(&unpadded(&word).as_str()) => &mut original.after,
                'M' | 'S' | 'T' | 'O' | '%' => &mut original.before,
                'G' if ["G61", "G61.1", "G64"].contains(&word.as_str()) => &mut original.before,
                'P' if blending => &mut original.before,
                _ => {
                    original.dropped = true;
                    original.simple &=
                        MOTION.contains(&unpadded(&word).as_str()) || REPLACED.contains(&letter);
                    continue;
                }
            };
            if !place.is_empty() {
                place.push(' ');
            }
            place.push_str(&word);
        }
        original
    }

    /// Whether the header may follow this line, if it makes no move: the tape mark and the
    /// program's number must come first, and lines without effect may precede them.
    fn precedes_header(&self) -> bool {
        self.code.is_empty() || self.optional || self.before.contains(['%', 'O'])
    }
}

/// The words of a line, upper case and without blanks, and its comments in round brackets.
fn words_and_comments(line: &str) -> (Vec<String>, String) {
    let (mut words, mut comments) = (Vec::<String>::new(), String::new());
    for token in tokens(line, 0) {
        match token.kind {
            Kind::Comment => comments.push_str(token.text),
            Kind::LineComment => {
                // Brackets within would end the comment early.
                let text = token.text[1..].replace(['(', ')'], " ");
                comments.push_str(&gcode::comment(text.trim()));
            }
            Kind::Word => {
                let word: String = token.text.split_whitespace().collect();
                let word = word.to_ascii_uppercase();
                match words.last_mut() {
                    // A number apart from its letter occurs only in a line that no control accepts.
                    Some(last) if word.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) => {
                        last.push_str(&word);
                    }
                    _ if word.is_empty() => {}
                    _ => words.push(word),
                }
            }
        }
    }
    (words, comments)
}

/// A word without leading zeros in its number: `M05` is `M5`.
fn unpadded(word: &str) -> String {
    let (letter, digits) = word.split_at(word.chars().next().map_or(0, char::len_utf8));
    match digits.trim_start_matches('0') {
        "" => format!("{letter}0"),
        rest => format!("{letter}{rest}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_taken_apart_however_they_are_written() {
        for (line, words, comments) in [
            (
                "n 10 g01 X 1.5(side) m05 ; down (here) ",
                vec!["N10", "G01", "X1.5", "M05"],
                "(side)(down  here)",
            ),
            ("% (tape)", vec!["%"], "(tape)"),
            ("O1000", vec!["O1000"], ""),
            ("/2 G1 X 1 . 5", vec!["/2", "G1", "X1.5"], ""),
            ("\u{feff}G91.1", vec!["\u{feff}", "G91.1"], ""),
            // Lines that no control accepts.
            ("X(a)1 \u{a0}2 (b(c)d)", vec!["X12"], "(a)(b(c)d)"),
            ("5#\u{e4} (open", vec!["5", "#", "\u{e4}"], "(open"),
        ] {
            let (found, remarks) = words_and_comments(line);
            assert_eq!(
                (found, remarks.as_str()),
                (words.into_iter().map(String::from).collect(), comments),
                "{line}"
            );
        }
    }

    #[test]
    fn words_stay_on_their_side_of_the_motion() {
        let line = OriginalLine::of("N5 M08 G1 X2 M05 S300 G64 P.1");
        assert_eq!((line.number.as_str(), line.before.as_str()), ("N5", "M08 S300 G64 P.1"));
        assert_eq!((line.after.as_str(), line.dropped, line.simple), ("M05", true, true));
        let line = OriginalLine::of("G54 G1 X2");
        assert!(line.dropped && !line.simple);
        for line in ["/M8", "N10 /M8", "n 7/70 M8", " /2 M8"] {
            let line = OriginalLine::of(line);
            assert!(line.optional && line.dropped && line.before.is_empty());
        }
    }
}
