//! The compensated path as G-code (RS-274, ISO 6983).
//!
//! A program that was read from G-code keeps its lines, block numbers, comments, spindle and auxiliary words; only what tells
//! positions, modes and feeds is written anew. A block that stays one straight move or one arc stays one block; others are split within
//! the thinning tolerance, arcs into arcs where these are fewer, behind a comment with the original. All else becomes a plain program. Points are
//! absolute, in the workpiece frame, in the original's unit of length: its work offsets and tool lengths are in them already. I, J and K
//! count from the start of the arc (G91.1); P counts turns where an arc has more than one.

use crate::error::Error;
use crate::export::arc::Step;
use crate::export::command::{Block, Command};
use crate::export::header::{self, number};
use crate::path::SourceProgram;
use crate::report::Report;
use crate::units::{INCH, MM, RPM};
use nalgebra::Vector3;
use std::fmt::Write;

/// The plane across each axis.
const PLANES: [&str; 3] = ["G19", "G18", "G17"];
/// M words that act after the motion of their block.
const AFTER: [&str; 7] = ["M0", "M1", "M2", "M5", "M9", "M30", "M60"];
/// Letters of words that are written anew with every block.
const REPLACED: [char; 9] = ['X', 'Y', 'Z', 'F', 'I', 'J', 'K', 'R', 'P'];
/// Codes that are written anew with every block.
const MOTION: [&str; 7] = ["G0", "G1", "G2", "G3", "G17", "G18", "G19"];

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
        report.setup().program.as_ref().filter(|listing| {
            listing.language == "gcode" && command.blocks.is_sorted_by_key(|block| block.line)
        });
    let unit = match command.style.inch {
        true => Unit { word: "G20", size: INCH, decimals: 6 },
        false => Unit { word: "G21", size: MM, decimals: 5 },
    };
    let (text, feed, at) = (String::new(), String::new(), command.start.position);
    let mut writer = Writer { text, unit, at, motion: "", plane: PLANES[2], feed };
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
    /// Where the tool is [m].
    at: Vector3<f64>,
    /// G0 to G3, as last written.
    motion: &'static str,
    /// G17, G18 or G19, as last written.
    plane: &'static str,
    /// Feed word as last written.
    feed: String,
}

impl Writer {
    fn line(&mut self, line: &str) {
        self.text.push_str(line.trim());
        self.text.push('\n');
    }

    fn preamble(&mut self, header: &[String], centers: &str) {
        for line in header {
            self.line(line);
        }
        let unit = self.unit.word;
        self.line(&format!("{unit} G17 G40 G49 G80 G90 G94{centers}"));
    }

    /// The words of one move.
    fn words(&mut self, step: &Step, rapid: bool, feed: f64) -> String {
        let mut words = String::new();
        let motion = match step.arc {
            None if rapid => "G0",
            None => "G1",
            Some(arc) if arc.sweep < 0.0 => "G2",
            Some(_) => "G3",
        };
        if let Some(arc) = step.arc
            && self.plane != PLANES[arc.normal]
        {
            self.plane = PLANES[arc.normal];
            words.push_str(self.plane);
            words.push(' ');
        }
        if self.motion != motion {
            words.push_str(motion);
            self.motion = motion;
        }
        // Writing to a string cannot fail.
        let mut length = |letter: char, value: f64| {
            let _ = write!(words, " {letter}{}", number(value / self.unit.size, self.unit.decimals));
        };
        for (letter, value) in ['X', 'Y', 'Z'].into_iter().zip(step.to.position.iter()) {
            length(letter, *value);
        }
        if let Some(arc) = step.arc {
            let offset = arc.center - self.at;
            let in_plane = |(axis, _): &(usize, char)| *axis != arc.normal;
            for (axis, letter) in ['I', 'J', 'K'].into_iter().enumerate().filter(in_plane) {
                length(letter, offset[axis]);
            }
            let turns = arc.turns();
            if turns > 1.0 {
                let _ = write!(words, " P{turns}");
            }
        }
        self.at = step.to.position;
        if !rapid {
            let feed = format!(" F{}", number(feed / (self.unit.size * RPM), 4));
            if self.feed != feed {
                words.push_str(&feed);
                self.feed = feed;
            }
        }
        words
    }

    fn start(&mut self, command: &Command) {
        let words = self.words(&Step { to: command.start, arc: None }, true, 0.0);
        self.line(&words);
    }

    /// The moves of a block, a line each.
    fn moves(&mut self, block: &Block) {
        for step in &block.steps {
            let words = self.words(step, block.rapid, block.feed);
            self.line(&words);
        }
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
        self.preamble(header, "");
        let mut spindle = None;
        let mut line = 0;
        self.start(command);
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
            self.moves(block);
        }
        self.line("M5");
        self.line("M30");
        self.line("%");
    }

    fn rewritten(&mut self, listing: &SourceProgram, command: &Command, header: &[String]) {
        let mut blocks = command.blocks.iter().peekable();
        let mut preamble = false;
        let mut started = false;
        for (index, line) in listing.text.trim_start_matches('\u{feff}').lines().enumerate() {
            let source = Source::of(line);
            let mut own = Vec::new();
            while let Some(block) = blocks.next_if(|block| block.line == index + 1) {
                own.push(block);
            }
            // The header follows what must be first, the tape mark and the program's number, and what does not count before them.
            let opens = own.is_empty()
                && (source.code.is_empty()
                    || source.code.starts_with('/')
                    || source.before.contains(['%', 'O']));
            if !(preamble || opens) {
                // A control that knows one of these needs to be told; others would refuse it.
                let knows = |line| {
                    words(&uncommented(line).0).iter().any(|word| ["G90.1", "G91.1"].contains(&word.as_str()))
                };
                self.preamble(header, if listing.text.lines().any(knows) { " G91.1" } else { "" });
                preamble = true;
            }
            if !own.is_empty() && !started {
                started = true;
                self.start(command);
            }
            self.block(&source, &own);
        }
    }

    /// One line of the original, with the blocks that its moves have become.
    fn block(&mut self, source: &Source, blocks: &[&Block]) {
        let moves: usize = blocks.iter().map(|block| block.steps.len()).sum();
        if let Some(first) = blocks.first() {
            self.wait(first);
        }
        let stays = moves == 1 && blocks.len() == 1;
        let said = stays && source.simple || !source.dropped;
        let was = if said { String::new() } else { format!("(was: {})", source.code) };
        let one: String = match (stays, blocks) {
            (true, [block, ..]) => {
                block.steps.iter().map(|step| self.words(step, block.rapid, block.feed)).collect()
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
            self.moves(block);
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
    /// Whether these are no more than a motion, its plane, positions and a feed.
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
                    source.dropped = true;
                    source.simple &= MOTION.contains(&unpadded(&word).as_str()) || REPLACED.contains(&letter);
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
    let (letter, digits) = word.split_at(word.chars().next().map_or(0, char::len_utf8));
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
