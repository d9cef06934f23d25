//! Words that a controller would understand: a letter and a number, each with its place.

use super::dialect::GcodeDialect;
use super::expression::ExpressionReader;
use super::token::{Kind, Token, tokens};
use super::variables::{Variable, Variables};

/// A letter and its number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Word {
    /// Capital letter, `@` or `^`.
    pub(super) letter: char,
    /// The number, in the program's unit.
    pub(super) value: f64,
    /// Byte of the line at which the word starts.
    pub(super) start: usize,
    /// Byte after the word.
    pub(super) end: usize,
    /// How a position counts.
    pub(super) mode: WordMode,
}

/// How the position that a word gives counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum WordMode {
    /// As G90, G91, G90.1 and G91.1 say.
    Modal,
    /// From the program's zero (Siemens `AC`).
    Absolute,
    /// From where the tool is (Siemens `IC`).
    Incremental,
}

/// What is wrong with a line, and where. The reader adds the line number.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct WordFault {
    /// Byte of the line.
    pub(super) at: usize,
    /// The text at that place.
    pub(super) found: String,
    /// What would be accepted.
    pub(super) expected: String,
}

/// Largest magnitude of a number. No machine travels farther, and sums of larger doubles no longer
/// resolve a micrometre.
pub(super) const LARGEST: f64 = 1e9;

impl Word {
    /// The word as written.
    pub(super) fn text<'t>(&self, line: &'t str) -> &'t str {
        &line[self.start..self.end]
    }

    /// A fault at this word.
    pub(super) fn fault(&self, line: &str, expected: impl Into<String>) -> WordFault {
        WordFault { at: self.start, found: format!("\"{}\"", self.text(line)), expected: expected.into() }
    }

    /// The number, which must be whole and from `least` to `most`.
    pub(super) fn whole(&self, line: &str, least: u32, most: u32) -> Result<u32, WordFault> {
        if self.value.fract() == 0.0 && self.value >= f64::from(least) && self.value <= f64::from(most) {
            Ok(self.value as u32)
        } else {
            let letter = self.letter;
            Err(self.fault(line, format!("{letter} takes a whole number from {least} to {most} here")))
        }
    }
}

/// Collects the words of `line` from the byte `from` on, without comments, and sets the variables
/// that it assigns.
pub(super) fn words(
    line: &str,
    from: usize,
    words: &mut Vec<Word>,
    variables: &mut Variables,
) -> Result<(), WordFault> {
    let mut at = from;
    loop {
        if let Some(word) = plain_word(line, at) {
            at = word.end;
            words.push(word);
            continue;
        }
        let Some(token) = tokens(line, at).next() else { break };
        at = token.end();
        match token.kind {
            Kind::LineComment => {}
            Kind::Comment => check_comment(line, &token)?,
            // Tapes number a program with a colon instead of O.
            Kind::Word if token.text.starts_with(':') && numbers_program(&line[token.start + 1..]) => {
                return Ok(());
            }
            Kind::Word if token.text.starts_with('#') => at = assignment(line, token.start, variables)?,
            Kind::Word
                if !token.text.starts_with(|sign: char| sign.is_ascii_alphabetic())
                    && !is_polar(&token, variables.dialect) =>
            {
                return Err(stray(line, token.start));
            }
            Kind::Word
                if token.text.starts_with(['o', 'O'])
                    && !(words.iter().all(|word| word.letter == 'N')
                        && numbers_program(&line[token.start + 1..])) =>
            {
                let found = format!("\"{}\"", line[token.start..].trim_end());
                return Err(WordFault { at: token.start, found, expected: SUBPROGRAM.into() });
            }
            Kind::Word if computes(line, &token) => {
                let mut reader = ExpressionReader::new(line, token.start + 1, variables);
                let value = if reader.take("=") { reader.operands()? } else { reader.operand()? };
                at = reader.at;
                let letter = char::from(token.text.as_bytes()[0].to_ascii_uppercase());
                // A word whose value is vacant is passed over (Fanuc).
                let Some(value) = value else {
                    variables.used_vacant.set(true);
                    continue;
                };
                words.push(Word { letter, value, start: token.start, end: at, mode: WordMode::Modal });
            }
            Kind::Word => words.push(word(line, &token)?),
        }
    }
    variables.settle();
    Ok(())
}

/// Number of digits that a double always holds exactly.
const EXACT_DIGITS: usize = 15;
/// Powers of ten that a double holds exactly.
#[rustfmt::skip] // A table.
const POWERS: [f64; EXACT_DIGITS + 1] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
];

/// The word at the byte `at` if it is written as almost all are: a letter other than O and some digits,
/// then a blank, a letter or the end of the line. It is read without the detour of tokens.
///
/// Digits and power of ten are exact, so that their quotient is the double nearest to the decimal, as
/// [`str::parse`] gives it.
fn plain_word(line: &str, at: usize) -> Option<Word> {
    let bytes = line.as_bytes();
    let byte = |at: usize| bytes.get(at).copied().unwrap_or(b' ');
    let blank = |byte: u8| byte == b' ' || byte == b'\t';
    let mut at = at;
    while at < bytes.len() && blank(bytes[at]) {
        at += 1;
    }
    let (start, letter) = (at, byte(at).to_ascii_uppercase());
    if !letter.is_ascii_uppercase() || letter == b'O' {
        return None;
    }
    at += 1;
    let negative = byte(at) == b'-';
    at += usize::from(negative);
    let (first, mut mantissa, mut decimals) = (at, 0_u64, 0);
    let mut digits = |at: &mut usize| {
        while byte(*at).is_ascii_digit() {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(byte(*at) - b'0'));
            *at += 1;
        }
    };
    digits(&mut at);
    let mut count = at - first;
    if byte(at) == b'.' {
        at += 1;
        let point = at;
        digits(&mut at);
        decimals = at - point;
        count += decimals;
    }
    let ends = blank(byte(at)) || byte(at).is_ascii_alphabetic() && !matches!(byte(at), b'e' | b'E');
    if count == 0 || count > EXACT_DIGITS || !ends {
        return None;
    }
    let size = mantissa as f64 / POWERS[decimals];
    let value = if negative { 0.0 - size } else { size };
    (size <= LARGEST).then_some(Word {
        letter: char::from(letter),
        value,
        start,
        end: at,
        mode: WordMode::Modal,
    })
}

/// Whether a token is a polar word, `@` or `^` (LinuxCNC).
fn is_polar(token: &Token, dialect: GcodeDialect) -> bool {
    token.text.starts_with(['@', '^']) && matches!(dialect, GcodeDialect::LinuxCnc | GcodeDialect::Unknown)
}

/// Whether a letter is followed by an expression instead of a number.
fn computes(line: &str, token: &Token) -> bool {
    matches!(token.text[1..].trim_ascii_start(), "" | "+" | "-")
        && line[token.end()..].starts_with(['#', '[', '='])
}

/// Sets a variable (`#1 = 5`, `#<depth> = [#1 / 2]`); returns the byte after it.
fn assignment(line: &str, start: usize, variables: &mut Variables) -> Result<usize, WordFault> {
    let mut reader = ExpressionReader::new(line, start, variables);
    let variable = reader.variable()?;
    if !reader.take("=") {
        return Err(stray(line, start));
    }
    let value = reader.operands()?;
    let end = reader.at;
    let fault = |expected: &str| {
        Err(WordFault { at: start, found: format!("\"{}\"", &line[start..end]), expected: expected.into() })
    };
    match variable {
        Some(Variable::Numbered(0)) => {
            return fault("#0 is the variable without a value: nothing is assigned to it");
        }
        Some(Variable::Numbered(ALARM)) if variables.dialect == GcodeDialect::Fanuc => {
            return fault("the program stops with an alarm of its own here (#3000)");
        }
        Some(variable) => variables.set(variable, value),
        None => {}
    }
    Ok(end)
}

/// The variable by which a Fanuc program raises an alarm.
const ALARM: u32 = 3000;

/// What to do about an O word.
pub(super) const SUBPROGRAM: &str = "an O number stands alone in its line, and sub-programs follow the end of the \
     program that calls them (M98, or call)";
const MACRO: &str = "a variable is set at the start of a word, such as #1=5, or stands for the number of a letter, such as X#1";
const EXPRESSION: &str =
    "an expression in square brackets follows a letter, such as X[#1+2]; comments stand in round brackets";

/// Fails unless the comment opens and closes exactly once.
fn check_comment(line: &str, comment: &Token) -> Result<(), WordFault> {
    let Some(inside) = comment.text.strip_prefix('(') else { return Err(stray(line, comment.start)) };
    match inside.find(['(', ')']) {
        // Brackets within are closed; see the tokens.
        Some(_) if comment.text.matches('(').count() == comment.text.matches(')').count() => Ok(()),
        Some(at) => Err(WordFault {
            at: comment.start + 1 + at,
            found: "a bracket that opens inside a comment".into(),
            expected: "each bracket of a comment is closed on its line".into(),
        }),
        None => Err(WordFault {
            at: comment.start,
            found: "a comment without its closing bracket".into(),
            expected:
                "a comment closes with ) on its own line; a comment to the end of the line starts with ;"
                    .into(),
        }),
    }
}

/// Whether O is followed by a number and no other word, as in a numbered program (`O1000`).
fn numbers_program(rest: &str) -> bool {
    let rest = rest.trim_start();
    let after = rest.trim_start_matches(|c: char| c.is_ascii_digit());
    after.len() < rest.len() && (after.trim().is_empty() || after.trim_start().starts_with(['(', ';']))
}

/// The word of a token that starts with a letter.
fn word(line: &str, token: &Token) -> Result<Word, WordFault> {
    let letter = char::from(token.text.as_bytes()[0].to_ascii_uppercase());
    let number = token.text[1..].trim_ascii_start();
    let (start, end) = (token.start, token.end());
    match number.parse::<f64>() {
        Ok(value) if value.abs() <= LARGEST => {
            // Adding zero turns -0 into 0.
            Ok(Word { letter, value: value + 0.0, start, end, mode: WordMode::Modal })
        }
        Ok(_) => Err(WordFault {
            at: start,
            found: format!("\"{}\"", token.text),
            expected: format!("numbers lie within -{LARGEST:e} and {LARGEST:e}"),
        }),
        // `<name>`: an error at the stray character says more than one at the letter before it.
        Err(_) if matches!(number, "" | "+" | "-") && line[end..].starts_with('<') => Err(stray(line, end)),
        Err(_) => Err(WordFault {
            at: start,
            found: format!("\"{}\" without a number", token.text.trim_end()),
            expected: format!("a number follows {letter}, such as {letter}12.5"),
        }),
    }
}

/// A character that cannot start a word.
fn stray(line: &str, at: usize) -> WordFault {
    let found = line[at..].chars().next().map_or_else(String::new, |sign| sign.to_string());
    let expected = match found.as_str() {
        "#" | "=" | "<" | ">" => MACRO,
        "[" | "]" => EXPRESSION,
        "/" => "a slash (block delete) stands at the start of a line or after its N word",
        "%" => "a percent sign stands alone on its line, before and after the program",
        "," if line[at + 1..].trim_start().starts_with(['R', 'C', 'r', 'c', 'A', 'a']) => {
            "rounded and chamfered corners (,R ,C) are not read: post lines and arcs"
        }
        "@" | "^" => "polar words (@ ^) are LinuxCNC's: say path.dialect \"linuxcnc\" if it is its program",
        "," => "numbers are written with a decimal point",
        ")" => "a comment opens with ( before it closes",
        _ => "a word is a letter and a number, such as X12.5; comments stand in ( ) or after ;",
    };
    WordFault { at, found: format!("\"{found}\""), expected: expected.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Result<Vec<(char, f64)>, usize> {
        let mut found = Vec::new();
        words(line, 0, &mut found, &mut Variables::default())
            .map(|()| found.iter().map(|word| (word.letter, word.value)).collect())
            .map_err(|fault| fault.at)
    }

    #[test]
    fn numbers_of_every_shape() {
        for (line, value) in [
            ("X1.", 1.0),
            ("X.5", 0.5),
            ("X+2", 2.0),
            ("X-0", 0.0),
            ("x -3.25", -3.25),
            ("X007", 7.0),
            ("X-.5(end)", -0.5),
            ("(a)X4;b", 4.0),
        ] {
            assert_eq!(read(line), Ok(vec![('X', value)]), "{line}");
        }
        assert_eq!(read("g1x1y-2.5"), Ok(vec![('G', 1.0), ('X', 1.0), ('Y', -2.5)]));
        assert!(read("X-0").is_ok_and(|words| words[0].1.is_sign_positive()));
    }

    #[test]
    fn plain_numbers_are_the_nearest_doubles() {
        let mut state = 1_u64;
        for _ in 0..200_000 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let (whole, part, places) =
                (state >> 60, (state >> 24) & 0xffff_ffff, (state >> 16) as usize % 12);
            let sign = if state & 0x8000 == 0 { "" } else { "-" };
            let number =
                format!("{sign}{whole}.{:.places$}", part % 10_u64.pow(places as u32), places = places);
            let word = plain_word(&format!("X{number}"), 0).unwrap();
            assert_eq!(word.value.to_bits(), (number.parse::<f64>().unwrap() + 0.0).to_bits(), "{number}");
        }
        for left in [
            "X",
            "X-",
            "X.",
            "X+1",
            "X 1",
            "X1E+2",
            "X1#2",
            "X1[2",
            "X1(a",
            "O1",
            "X1\u{e4}",
            "X1234567890123456",
        ] {
            assert_eq!(plain_word(left, 0), None, "{left}: left to the tokens");
        }
    }

    #[test]
    fn mistakes_are_placed() {
        for (line, at) in [
            ("X", 0),
            ("G1 X.", 3),
            ("X1 Y-", 3),
            ("X1..2", 3),
            ("X1 2", 3),
            ("X#5", 1),
            ("#5 3", 0),
            ("X-[1+a]", 5),
            ("X[1+2", 5),
            ("X1 (a", 3),
            ("(a(b)", 2),
            ("X1)", 2),
            ("O<cut> call", 0),
            ("X1 O5", 3),
            ("X9999999999", 0),
            ("X\u{e4}", 0),
            ("\u{e4}X1", 0),
        ] {
            assert_eq!(read(line), Err(at), "{line}");
        }
    }
}
