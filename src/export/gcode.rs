//! The compensated path as G-code (RS-274, ISO 6983).
//!
//! A program that was read from G-code keeps its lines, block numbers, comments, spindle and auxiliary words; only what tells
//! positions, modes and feeds is written anew. A block that stays one straight move stays one block; others are split into straight moves within the thinning
//! tolerance, behind a comment with the original. All else becomes a plain program. Points are absolute, in the workpiece frame, in the original's unit of length:
//! its work offsets and tool lengths are in them already.

use crate::error::Error;
use crate::export::command::{Block, Command};
use crate::export::header::{self, number};
use crate::export::thin::Point;
use crate::path::Listing;
use crate::report::Report;
use crate::units::{INCH, MM, RPM};
use std::fmt::Write;

/// M words that act after the motion of their block.
const AFTER: [&str; 7] = ["M0", "M1", "M2", "M5", "M9", "M30", "M60"];
/// Letters of words that are written anew with every block.
const REPLACED: [char; 4] = ['X', 'Y', 'Z', 'F'];

/// The program.
///
/// # Errors
/// [`Error::Invalid`] if the tool axis is other than +Z: three axes cannot say it.
pub fn program(report: &Report, command: &Command) -> Result<String, Error> {
    if command.is_tilted() {
        return Err(Error::Invalid {
            field: "format".into(),
            value: "\"gcode\"".into(),
            expected: "the tool axis is not +Z all along, which this G-code cannot say: use apt".into(),
        });
    }
    let original =
        report.setup.listing.as_ref().filter(|listing| {
            listing.language == "gcode" && command.blocks.is_sorted_by_key(|block| block.line)
        });
    let unit = match &report.setup.listing {
        Some(listing) if listing.program.unit == "inch" => Unit { word: "G20", size: INCH, decimals: 6 },
        _ => Unit { word: "G21", size: MM, decimals: 5 },
    };
    let mut writer = Writer { text: String::new(), unit, motion: "", feed: String::new() };
    let header: Vec<String> =
        header::lines(report, Some(command)).into_iter().map(|line| format!("({line})")).collect();
    match original {
        Some(listing) => writer.rewritten(listing, command, &header),
        None => writer.plain(command, &header),
    }
    Ok(writer.text)
}

struct Unit {
    word: &'static str,
    size: f64,
    decimals: usize,
}

struct Writer {
    text: String,
    unit: Unit,
    /// G0 or G1, as last written.
    motion: &'static str,
    /// Feed word as last written.
    feed: String,
}

impl Writer {
    fn line(&mut self, line: &str) {
        self.text.push_str(line.trim());
        self.text.push('\n');
    }

    fn preamble(&mut self, header: &[String]) {
        for line in header {
            self.line(line);
        }
        let unit = self.unit.word;
        self.line(&format!("{unit} G17 G40 G49 G80 G90 G94"));
    }

    /// The words of one straight move.
    fn words(&mut self, point: &Point, rapid: bool, feed: f64) -> String {
        let mut words = String::new();
        let motion = if rapid { "G0" } else { "G1" };
        if self.motion != motion {
            words.push_str(motion);
            self.motion = motion;
        }
        for (letter, value) in ['X', 'Y', 'Z'].into_iter().zip(point.position.iter()) {
            // Writing to a string cannot fail.
            let _ = write!(words, " {letter}{}", number(value / self.unit.size, self.unit.decimals));
        }
        if !rapid {
            let feed = format!(" F{}", number(feed / (self.unit.size * RPM), 4));
            if self.feed != feed {
                words.push_str(&feed);
                self.feed = feed;
            }
        }
        words
    }

    fn wait(&mut self, block: &Block) {
        if block.wait > 0.0 {
            self.line(&format!(
                "G4 P{} (seconds at rest, until the shaped command has settled or as programmed)",
                number(block.wait, 4)
            ));
        }
    }

    fn plain(&mut self, command: &Command, header: &[String]) {
        self.line("%");
        self.preamble(header);
        let mut spindle = None;
        let mut line = 0;
        let start = self.words(&command.start, true, 0.0);
        self.line(&start);
        for block in &command.blocks {
            if block.line != line {
                line = block.line;
                self.line(&format!("(line {line} of the original)"));
            }
            if spindle != Some(block.spindle) {
                spindle = Some(block.spindle);
                self.line(&format!("S{} M3", number(block.rpm(), 2)));
            }
            self.wait(block);
            for point in &block.points {
                let words = self.words(point, block.rapid, block.feed);
                self.line(&words);
            }
        }
        self.line("M5");
        self.line("M30");
        self.line("%");
    }

    fn rewritten(&mut self, listing: &Listing, command: &Command, header: &[String]) {
        let mut blocks = command.blocks.iter().peekable();
        let mut preamble = false;
        let mut started = false;
        for (index, line) in listing.text.lines().enumerate() {
            let source = Source::of(line);
            // The header follows what must be first: the tape mark and the program's number.
            if !(preamble || source.code.starts_with(['%', 'O'])) {
                self.preamble(header);
                preamble = true;
            }
            let mut own = Vec::new();
            while let Some(block) = blocks.next_if(|block| block.line == index + 1) {
                own.push(block);
            }
            if !own.is_empty() && !started {
                started = true;
                let start = self.words(&command.start, true, 0.0);
                self.line(&start);
            }
            self.block(&source, &own);
        }
    }

    /// One line of the original, with the blocks that its moves have become.
    fn block(&mut self, source: &Source, blocks: &[&Block]) {
        let moves: usize = blocks.iter().map(|block| block.points.len()).sum();
        if let Some(first) = blocks.first() {
            self.wait(first);
        }
        let stays = moves == 1 && blocks.len() == 1 && source.simple;
        let was = if stays || !source.dropped { String::new() } else { format!("(was: {})", source.code) };
        let one: String = match (stays, blocks) {
            (true, [block, ..]) => {
                block.points.iter().map(|point| self.words(point, block.rapid, block.feed)).collect()
            }
            _ => String::new(),
        };
        let after = if stays || moves == 0 { source.after.as_str() } else { "" };
        self.line(&joined(&[&source.number, &source.before, &one, after, &source.comments, &was]));
        if stays || moves == 0 {
            return;
        }
        for (index, block) in blocks.iter().enumerate() {
            if index > 0 {
                self.wait(block);
            }
            for point in &block.points {
                let words = self.words(point, block.rapid, block.feed);
                self.line(&words);
            }
        }
        if !source.after.is_empty() {
            self.line(&source.after);
        }
    }
}

fn joined(parts: &[&str]) -> String {
    parts.iter().filter(|part| !part.trim().is_empty()).map(|part| part.trim()).collect::<Vec<_>>().join(" ")
}

/// A line of the original, taken apart.
struct Source {
    /// Its words without blanks between letter and number, comments left out, upper case.
    code: String,
    /// The block number.
    number: String,
    /// Words that stay, before the motion.
    before: String,
    /// Words that stay, after the motion.
    after: String,
    /// Its comments.
    comments: String,
    /// Whether it has words that do not stay.
    dropped: bool,
    /// Whether these are no more than G0 or G1, positions and a feed.
    simple: bool,
}

impl Source {
    fn of(line: &str) -> Self {
        let (code, comments) = uncommented(line);
        let words = words(&code);
        let mut source = Self {
            code: words.join(" "),
            number: String::new(),
            before: String::new(),
            after: String::new(),
            comments,
            dropped: false,
            simple: true,
        };
        if code.starts_with('/') {
            // Its words act or not by a switch on the control, which a move could not follow.
            (source.dropped, source.simple) = (true, false);
            return source;
        }
        let blending = words.iter().any(|word| word == "G64");
        for word in words {
            let letter = word.chars().next().unwrap_or(' ');
            let place = match letter {
                'N' => &mut source.number,
                'M' if AFTER.contains(&unpadded(&word).as_str()) => &mut source.after,
                'M' | 'S' | 'T' | 'O' | '%' => &mut source.before,
                'G' if ["G61", "G61.1", "G64"].contains(&word.as_str()) => &mut source.before,
                'P' if blending => &mut source.before,
                _ => {
                    let line = ["G0", "G1"].contains(&unpadded(&word).as_str());
                    source.dropped = true;
                    source.simple &= line || REPLACED.contains(&letter);
                    continue;
                }
            };
            if !place.is_empty() {
                place.push(' ');
            }
            place.push_str(&word);
        }
        source
    }
}

/// A word without leading zeros in its number: `M05` is `M5`.
fn unpadded(word: &str) -> String {
    let (letter, digits) = word.split_at(word.len().min(1));
    match digits.trim_start_matches('0') {
        "" => format!("{letter}0"),
        rest => format!("{letter}{rest}"),
    }
}

/// The code of a line without blanks, upper case, and its comments.
fn uncommented(line: &str) -> (String, String) {
    let (mut code, mut comments) = (String::new(), String::new());
    let mut inside = false;
    for (at, c) in line.char_indices() {
        match c {
            ';' if !inside => {
                // Brackets within would end the comment early.
                let rest: String =
                    line[at + 1..].chars().map(|c| if "()".contains(c) { ' ' } else { c }).collect();
                comments.push_str(&format!("({})", rest.trim()));
                break;
            }
            '(' | ')' => {
                inside = c == '(';
                comments.push(c);
            }
            _ if inside => comments.push(c),
            _ if !c.is_whitespace() => code.push(c.to_ascii_uppercase()),
            _ => {}
        }
    }
    (code, comments)
}

/// The words of a line of code: each starts with a letter or another sign that is no part of a number.
fn words(code: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    for c in code.chars() {
        match words.last_mut() {
            Some(word) if c.is_ascii_digit() || "+-.".contains(c) => word.push(c),
            _ => words.push(c.to_string()),
        }
    }
    words
}
