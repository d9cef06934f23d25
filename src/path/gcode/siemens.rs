//! Words of Siemens Sinumerik programs for three axes: `X=10`, `CR=`, `I=AC(5)`, `TRANS`, `SUPA`,
//! `CYCLE81`. They become the words that the interpreter knows, at their places in the line.

use super::expression::{ExpressionReader, Variable, Variables};
use super::word::{Word, WordFault, WordMode};

/// What a line asks of a canned cycle besides its words.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct SiemensCycle {
    /// Retraction plane, to which the tool returns.
    pub(super) level: f64,
    /// Reference plane, from which pecks count.
    pub(super) surface: f64,
    /// Whether it is called at each position of the lines that follow (MCALL), or here alone.
    pub(super) stays: bool,
}

/// State of the translation.
#[derive(Debug, Default)]
pub(super) struct Siemens {
    /// TRANS and ATRANS, in the unit of the program.
    shift: [f64; 3],
    /// The cycle of the line just read.
    pub(super) cycle: Option<SiemensCycle>,
}

/// Names without effect on the path of a milling program.
const HARMLESS: [&str; 37] = [
    "WORKPIECE",
    "MSG",
    "CYCLE832",
    "GROUP_BEGIN",
    "GROUP_END",
    "STOPRE",
    "TRAFOOF",
    "SOFT",
    "BRISK",
    "DRIVE",
    "FFWON",
    "FFWOF",
    "COMPOF",
    "COMPON",
    "COMPCAD",
    "COMPCURV",
    "CFC",
    "CFTCP",
    "CFIN",
    "DIAMOF",
    "CUT2D",
    "UPATH",
    "SPATH",
    "FGROUP",
    "FIFOCTRL",
    "KONT",
    "NORM",
    "CDOF",
    "DYNROUGH",
    "DYNFINISH",
    "DYNSEMIFIN",
    "DYNNORM",
    "DYNPOS",
    "FNORM",
    "WALIMOF",
    "SPOS",
    "FGREF",
];
/// Names that would change the path, and what to do.
const REFUSED: [(&str, &str); 18] = [
    ("TRAORI", FIVE_AXES),
    ("TRACYL", "a wrapped path is not read: post it in X, Y and Z"),
    ("ROT", FRAME),
    ("AROT", FRAME),
    ("RPL", FRAME),
    ("SCALE", FRAME),
    ("ASCALE", FRAME),
    ("MIRROR", FRAME),
    ("AMIRROR", FRAME),
    ("GOTOF", CONTROL),
    ("GOTOB", CONTROL),
    ("GOTO", CONTROL),
    ("WHILE", CONTROL),
    ("FOR", CONTROL),
    ("REPEAT", CONTROL),
    ("IF", CONTROL),
    ("CALL", CONTROL),
    ("BSPLINE", "splines are not read: post lines and arcs"),
];
const FIVE_AXES: &str =
    "Siemens TRAORI turns the tool: post for three axes, or use APT or CSV with tool axes";
const FRAME: &str = "rotated, scaled and mirrored frames are not read: post the coordinates as they are cut";
const CONTROL: &str = "jumps and loops of Siemens programs are not followed: post plain moves";
const CORNER: &str = "chamfers, roundings, angles and polar words are not read: post lines and arcs";

impl Siemens {
    /// Collects the words of a line from the byte `from` on.
    pub(super) fn words(
        &mut self,
        line: &str,
        from: usize,
        words: &mut Vec<Word>,
        variables: &mut Variables,
    ) -> Result<(), WordFault> {
        self.cycle = None;
        let mut at = from;
        let mut calls = false;
        loop {
            at = line.len() - line[at..].trim_start().len();
            let rest = &line[at..];
            let Some(sign) = rest.chars().next() else { break };
            if sign == ';' {
                break;
            }
            if !sign.is_ascii_alphabetic() && sign != '_' && sign != '$' {
                let found = format!("\"{sign}\"");
                let expected = "a word, such as X12.5 or CR=5; comments stand after ;";
                return Err(WordFault { at, found, expected: expected.into() });
            }
            let letters =
                rest.bytes().take_while(|sign| sign.is_ascii_alphabetic() || *sign == b'_').count().max(1);
            let digits = rest[letters..].bytes().take_while(u8::is_ascii_digit).count();
            let name = rest[..letters].to_ascii_uppercase();
            let after = at + letters + digits;
            let follows = line[after..].trim_start().chars().next();
            let start = at;
            match (letters, follows) {
                _ if name == "DEF" => break,
                _ if name == "MCALL" => {
                    calls = true;
                    at = after;
                }
                _ if name == "CYCLE" => at = self.cycle(line, (start, after), calls, words, variables)?,
                (2.., _) if name == "SUPA" => {
                    words.push(Word { letter: 'G', value: 53.0, start, end: after, mode: WordMode::Modal });
                    at = after;
                }
                (2.., _) if name == "TRANS" || name == "ATRANS" => {
                    at = self.translate(line, (start, after), words, variables)?;
                }
                // An addressed value: X=10, CR=5, S1=3000, R10=3, T="NAME".
                (_, Some('=')) => at = assigned(line, (start, after), &name, words, variables)?,
                (2.., _) => at = named(line, (start, after), &name)?,
                _ => at = plain(line, start, words, variables)?,
            }
        }
        if calls && self.cycle.is_none() {
            // MCALL alone ends the calls.
            words.push(Word {
                letter: 'G',
                value: 80.0,
                start: from,
                end: line.len(),
                mode: WordMode::Modal,
            });
        }
        Ok(())
    }

    /// TRANS replaces the shift, ATRANS adds to it: both as G52 of all axes.
    fn translate(
        &mut self,
        line: &str,
        (start, after): (usize, usize),
        words: &mut Vec<Word>,
        variables: &mut Variables,
    ) -> Result<usize, WordFault> {
        if line[start..].starts_with(['T', 't']) {
            self.shift = [0.0; 3];
        }
        let mut given = Vec::new();
        let mut inner = Siemens::default();
        inner.words(line, after, &mut given, variables)?;
        for word in &given {
            let Some(axis) = ['X', 'Y', 'Z'].iter().position(|&axis| axis == word.letter) else {
                return Err(word.fault(line, "TRANS takes X, Y and Z"));
            };
            self.shift[axis] += word.value;
        }
        let place = |letter, value| Word { letter, value, start, end: after, mode: WordMode::Modal };
        words.push(place('G', 52.0));
        for (letter, value) in ['X', 'Y', 'Z'].into_iter().zip(self.shift) {
            words.push(place(letter, value));
        }
        Ok(line.len())
    }

    /// CYCLE81 (RTP, RFP, SDIS, DP, DPR), CYCLE82 with a dwell DTB, CYCLE83 with pecks; the others by
    /// name.
    fn cycle(
        &mut self,
        line: &str,
        (start, after): (usize, usize),
        stays: bool,
        words: &mut Vec<Word>,
        variables: &Variables,
    ) -> Result<usize, WordFault> {
        let fault = |expected: &str| WordFault {
            at: start,
            found: format!("\"{}\"", line[start..].trim_end()),
            expected: expected.into(),
        };
        let (values, end) = arguments(line, after, variables)?;
        let value = |index: usize| values.get(index).copied().flatten();
        let number = &line[start + "CYCLE".len()..after];
        if number == "832" || number == "800" && values.iter().flatten().all(|value| *value == 0.0) {
            return Ok(end);
        }
        if !["81", "82", "83"].contains(&number) {
            return Err(fault(match number {
                "800" => {
                    "Siemens CYCLE800 turns the workpiece: post for three axes, or use APT or CSV with tool axes"
                }
                _ => "of the cycles CYCLE81, CYCLE82 and CYCLE83 are read: post the others as plain moves",
            }));
        }
        let (Some(level), Some(surface)) = (value(0), value(1)) else {
            return Err(fault("a drilling cycle needs its retraction and reference plane"));
        };
        let clearance = surface + value(2).unwrap_or(0.0);
        // DPR is a depth from the reference plane, whatever its sign.
        let Some(bottom) = value(3).or(value(4).map(|depth| surface - depth.abs())) else {
            return Err(fault("a drilling cycle needs a depth, DP or DPR"));
        };
        let place = |letter, value| Word { letter, value, start, end, mode: WordMode::Absolute };
        let mut code = 81.0;
        let mut more = Vec::new();
        if number == "82" {
            code = 82.0;
            more.push(place('P', value(5).unwrap_or(0.0)));
        }
        if number == "83" {
            let first = value(5).map(|depth| surface - depth).or(value(6).map(f64::abs));
            let Some(first) = first.filter(|first| *first > 0.0) else {
                return Err(fault("CYCLE83 needs its first depth, FDEP or FDPR"));
            };
            if value(7).is_some_and(|less| less != 0.0) {
                return Err(fault("CYCLE83 whose pecks become smaller (DAM) is not read: post plain moves"));
            }
            code = if value(11).unwrap_or(0.0) == 0.0 { 73.0 } else { 83.0 };
            more.push(place('Q', first));
            if let Some(time) = value(8).filter(|time| *time > 0.0) {
                more.push(place('P', time));
            }
        }
        words.push(place('G', code));
        words.push(place('Z', bottom));
        words.push(place('R', clearance));
        words.append(&mut more);
        if stays {
            words.push(place('L', 0.0));
        }
        self.cycle = Some(SiemensCycle { level, surface, stays });
        Ok(end)
    }
}

/// A word of one letter and a number or expression.
fn plain(line: &str, start: usize, words: &mut Vec<Word>, variables: &Variables) -> Result<usize, WordFault> {
    let mut reader = ExpressionReader::new(line, start + 1, variables);
    let value = reader.value()?;
    let letter = char::from(line.as_bytes()[start].to_ascii_uppercase());
    words.push(Word { letter, value, start, end: reader.at, mode: WordMode::Modal });
    Ok(reader.at)
}

/// A word with an equals sign.
fn assigned(
    line: &str,
    (start, after): (usize, usize),
    name: &str,
    words: &mut Vec<Word>,
    variables: &mut Variables,
) -> Result<usize, WordFault> {
    let equals = line[after..].find('=').map_or(after, |at| after + at + 1);
    let digits = &line[start + name.len()..after];
    let refuse = |expected: &str| {
        Err(WordFault {
            at: start,
            found: format!("\"{}\"", line[start..].trim_end()),
            expected: expected.into(),
        })
    };
    let text = line[equals..].trim_start();
    if let Some(quoted) = text.strip_prefix('"') {
        // The name of a tool.
        let Some(length) = quoted.find('"') else { return refuse("a name closes with \"") };
        let end = line.len() - text.len() + length + 2;
        let value = quoted[..length].bytes().fold(0.0, |sum, byte| (sum * 31.0 + f64::from(byte)) % 1e8);
        if name == "T" {
            words.push(Word { letter: 'T', value, start, end, mode: WordMode::Modal });
        }
        return Ok(end);
    }
    let mut reader = ExpressionReader::new(line, equals, variables);
    let mode = if reader.take("AC") {
        WordMode::Absolute
    } else if reader.take("IC") {
        WordMode::Incremental
    } else {
        WordMode::Modal
    };
    let value = if mode != WordMode::Modal && reader.take("(") {
        let value = reader.expression()?;
        if !reader.take(")") {
            return refuse("AC and IC close with )");
        }
        value
    } else {
        reader.expression()?
    };
    let end = reader.at;
    let letter = match name {
        "R" if !digits.is_empty() => {
            if let Ok(number) = digits.parse() {
                variables.set(Variable::Arithmetic(number), value);
            }
            return Ok(end);
        }
        "CR" => 'R',
        // Full turns beyond the arc itself.
        "TURN" => {
            words.push(Word { letter: 'P', value: value + 1.0, start, end, mode });
            return Ok(end);
        }
        "RND" | "RNDM" | "CHF" | "CHR" | "ANG" | "AR" | "AP" | "RP" => return refuse(CORNER),
        // S1=, M1= address the first spindle.
        "S" | "M" if digits == "1" => char::from(name.as_bytes()[0]),
        _ if name.len() == 1 && digits.is_empty() => char::from(name.as_bytes()[0]),
        _ if ["A", "B", "C"].contains(&name) => return refuse(FIVE_AXES),
        _ => return refuse("no word of three-axis milling"),
    };
    words.push(Word { letter, value, start, end, mode });
    Ok(end)
}

/// A name, which has no effect or is refused; returns the byte after its brackets.
fn named(line: &str, (start, after): (usize, usize), name: &str) -> Result<usize, WordFault> {
    let refuse = |expected: &str| {
        Err(WordFault { at: start, found: format!("\"{}\"", &line[start..after]), expected: expected.into() })
    };
    if let Some((_, expected)) = REFUSED.iter().find(|(refused, _)| *refused == name) {
        // Without words, a frame is taken back.
        let alone = line[after..].split(';').next().is_none_or(|rest| rest.trim().is_empty());
        return if alone && *expected == FRAME { Ok(after) } else { refuse(expected) };
    }
    let full = line[start..after].to_ascii_uppercase();
    if !HARMLESS.iter().any(|known| *known == name || *known == full) {
        return refuse(
            "no word of three-axis milling that is known; known names are listed in the reader's source",
        );
    }
    Ok(closing(line, after))
}

/// The byte after the brackets that open next, or `from`.
fn closing(line: &str, from: usize) -> usize {
    let rest = line[from..].trim_start();
    if !rest.starts_with('(') {
        return from;
    }
    let opened = line.len() - rest.len();
    let (mut depth, mut quoted) = (0, false);
    for (at, sign) in rest.char_indices() {
        match sign {
            '"' => quoted = !quoted,
            '(' if !quoted => depth += 1,
            ')' if !quoted => {
                depth -= 1;
                if depth == 0 {
                    return opened + at + 1;
                }
            }
            _ => {}
        }
    }
    line.len()
}

/// The values in the brackets after a name, where they are given, and the byte after them; a text counts
/// as none.
fn arguments(line: &str, from: usize, variables: &Variables) -> Result<(Vec<Option<f64>>, usize), WordFault> {
    let mut reader = ExpressionReader::new(line, from, variables);
    let mut values = Vec::new();
    if !reader.take("(") {
        return Ok((values, from));
    }
    loop {
        if reader.take(")") {
            return Ok((values, reader.at));
        }
        if reader.take(",") {
            values.push(None);
            continue;
        }
        if reader.take("\"") {
            let end = line[reader.at..].find('"').map_or(line.len(), |end| reader.at + end + 1);
            reader.at = end;
            values.push(None);
        } else {
            values.push(Some(reader.expression()?));
        }
        if !reader.take(",") && !line[reader.at..].trim_start().starts_with(')') {
            let found = format!("\"{}\"", line[reader.at..].trim_end());
            return Err(WordFault {
                at: reader.at,
                found,
                expected: "values are separated by commas".into(),
            });
        }
    }
}
