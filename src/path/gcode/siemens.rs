//! Words of Siemens Sinumerik programs for three axes: `X=10`, `CR=`, `I=AC(5)`, `TRANS`, `SUPA`,
//! `CYCLE81`. They become the words that the interpreter knows, at their places in the line.

use super::interpreter::AXES;
use super::siemens_word::{arguments, assigned, closing, named, plain};
use super::variables::Variables;
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

/// What a line asks for besides its words.
#[derive(Debug, Default)]
pub(super) struct Siemens {
    /// The cycle of the line just read.
    pub(super) cycle: Option<SiemensCycle>,
}

/// Takes back the translation.
fn clear(words: &mut Vec<Word>, (start, end): (usize, usize)) {
    for (letter, value) in [('G', 52.0), ('X', 0.0), ('Y', 0.0), ('Z', 0.0)] {
        words.push(Word { letter, value, start, end, mode: WordMode::Modal });
    }
}

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
            if !sign.is_ascii_alphabetic() && sign != '_' {
                let found = format!("\"{sign}\"");
                let expected = match sign {
                    '$' => {
                        "no variable of the control ($..), whose value is not known: a word, such as X12.5"
                    }
                    _ => "a word, such as X12.5 or CR=5; comments stand after ;",
                };
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
                (1, _) if name == "G" && ["153", "500"].contains(&&line[start + 1..after]) => {
                    // Without the offset, or all of them: a position of the machine, or its zero from here on.
                    if &line[start + 1..after] == "153" {
                        words.push(Word {
                            letter: 'G',
                            value: 53.0,
                            start,
                            end: after,
                            mode: WordMode::Modal,
                        });
                    }
                    at = after;
                }
                (2.., _) if name == "TRANS" || name == "ATRANS" => {
                    at = self.translate(line, (start, after), words, variables)?;
                }
                // An addressed value: X=10, CR=5, S1=3000, R10=3, T="NAME".
                (_, Some('=')) => at = assigned(line, (start, after), &name, words, variables)?,
                (2.., _) => {
                    at = named(line, (start, after), &name)?;
                    if ["ROT", "SCALE", "MIRROR"].contains(&name.as_str()) {
                        // Without words, each takes back every programmable frame.
                        clear(words, (start, after));
                    }
                }
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

    /// TRANS replaces the shift, as G52 of all axes; ATRANS adds to it.
    fn translate(
        &self,
        line: &str,
        (start, after): (usize, usize),
        words: &mut Vec<Word>,
        variables: &mut Variables,
    ) -> Result<usize, WordFault> {
        let adds = line[start..].starts_with(['A', 'a']);
        let mut given = Vec::new();
        let mut at = after;
        loop {
            at = line.len() - line[at..].trim_start().len();
            if !line[at..].starts_with(|sign: char| sign.is_ascii_alphabetic()) {
                break;
            }
            let equals = line[at + 1..].trim_start().starts_with('=');
            let name = line[at..=at].to_ascii_uppercase();
            at = if equals {
                assigned(line, (at, at + 1), &name, &mut given, variables)?
            } else {
                plain(line, at, &mut given, variables)?
            };
        }
        if !matches!(line[at..].chars().next(), None | Some(';')) {
            let found = format!("\"{}\"", line[at..].trim_end());
            return Err(WordFault { at, found, expected: "TRANS takes X, Y and Z".into() });
        }
        if let Some(word) = given.iter().find(|word| !AXES.contains(&word.letter)) {
            return Err(word.fault(line, "TRANS takes X, Y and Z"));
        }
        let mode = if adds { WordMode::Incremental } else { WordMode::Modal };
        let place = |letter, value| Word { letter, value, start, end: after, mode };
        words.push(place('G', 52.0));
        for letter in AXES {
            let value = given.iter().filter(|word| word.letter == letter).map(|word| word.value).sum();
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
        let number = &line[start + "CYCLE".len()..after];
        if number == "832" {
            return Ok(closing(line, after));
        }
        let (values, end) = arguments(line, after, variables)?;
        let value = |index: usize| values.get(index).copied().flatten();
        if number == "800" && values.iter().flatten().all(|value| *value == 0.0) {
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
        let relative = value(4).filter(|depth| *depth != 0.0).map(|depth| surface - depth.abs());
        let Some(bottom) = relative.or(value(3)) else {
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
