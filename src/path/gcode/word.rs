//! A line of G-code as words: a letter and a number, each with its place.

/// One letter with its number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Word {
    /// Capital letter.
    pub(super) letter: char,
    /// The number, in the program's own unit.
    pub(super) value: f64,
    /// Byte of the line at which the word starts.
    pub(super) start: usize,
    /// Byte after the word.
    pub(super) end: usize,
}

/// What is wrong with a line, and where; the reader adds the line's number.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fault {
    /// Byte of the line.
    pub(super) at: usize,
    /// What stands there.
    pub(super) found: String,
    /// What would be legal.
    pub(super) expected: String,
}

/// Largest magnitude of a number: beyond it no machine has travel, and doubles no longer resolve a micrometre of what is added up.
pub(super) const LARGEST: f64 = 1e9;

impl Word {
    /// The word as written.
    pub(super) fn text<'t>(&self, line: &'t str) -> &'t str {
        &line[self.start..self.end]
    }

    /// This word is wrong here.
    pub(super) fn fault(&self, line: &str, expected: impl Into<String>) -> Fault {
        Fault { at: self.start, found: format!("\"{}\"", self.text(line)), expected: expected.into() }
    }

    /// The number as a whole one from `least` to `most`.
    pub(super) fn whole(&self, line: &str, least: u32, most: u32) -> Result<u32, Fault> {
        if self.value.fract() == 0.0 && self.value >= f64::from(least) && self.value <= f64::from(most) {
            Ok(self.value as u32)
        } else {
            let letter = self.letter;
            Err(self.fault(line, format!("{letter} takes a whole number from {least} to {most} here")))
        }
    }
}

/// Collects the words of `line` from the byte `from` on, comments left out.
pub(super) fn words(line: &str, from: usize, words: &mut Vec<Word>) -> Result<(), Fault> {
    let bytes = line.as_bytes();
    let mut at = from;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            _ if byte.is_ascii_whitespace() => at += 1,
            b';' => break,
            b'(' => at = comment_end(line, at)?,
            b'o' | b'O' if !words.is_empty() || !numbers_program(&line[at + 1..]) => {
                let found = format!("\"{}\"", line[at..].trim_end());
                return Err(Fault { at, found, expected: SUBPROGRAM.into() });
            }
            _ if byte.is_ascii_alphabetic() => {
                let word = word(line, at)?;
                at = word.end;
                words.push(word);
            }
            _ => return Err(stray(line, at)),
        }
    }
    Ok(())
}

/// What to do about an O word.
pub(super) const SUBPROGRAM: &str =
    "sub-programs and loops (O words) are not followed; have the CAM system post the program without them";
const MACRO: &str = "variables and macros are not followed; have the CAM system post plain numbers";
const EXPRESSION: &str =
    "expressions are not computed; have the CAM system post plain numbers (comments stand in round brackets)";

/// The byte after the comment that opens at `open`.
fn comment_end(line: &str, open: usize) -> Result<usize, Fault> {
    let inside = open + 1;
    match line[inside..].find(['(', ')']) {
        Some(length) if line[inside + length..].starts_with(')') => Ok(inside + length + 1),
        Some(length) => Err(Fault {
            at: inside + length,
            found: "a bracket that opens inside a comment".into(),
            expected: "controls end a comment at its first closing bracket: take the inner brackets out"
                .into(),
        }),
        None => Err(Fault {
            at: open,
            found: "a comment without its closing bracket".into(),
            expected:
                "a comment closes with ) on its own line; a comment to the end of the line starts with ;"
                    .into(),
        }),
    }
}

/// Whether what follows an O is a number and no other word, as where a program is numbered (`O1000`).
fn numbers_program(rest: &str) -> bool {
    let rest = rest.trim_start();
    let after = rest.trim_start_matches(|c: char| c.is_ascii_digit());
    after.len() < rest.len() && (after.trim().is_empty() || after.trim_start().starts_with(['(', ';']))
}

/// The word that starts at the letter at `start`. Blanks may stand between the letter and its number, not inside the number.
fn word(line: &str, start: usize) -> Result<Word, Fault> {
    let bytes = line.as_bytes();
    let letter = char::from(bytes[start].to_ascii_uppercase());
    let skip = |mut at: usize, wanted: fn(&u8) -> bool| {
        while bytes.get(at).is_some_and(wanted) {
            at += 1;
        }
        at
    };
    let first = skip(start + 1, u8::is_ascii_whitespace);
    let unsigned = first + usize::from(matches!(bytes.get(first), Some(b'+' | b'-')));
    let whole = skip(unsigned, u8::is_ascii_digit);
    let end = if bytes.get(whole) == Some(&b'.') { skip(whole + 1, u8::is_ascii_digit) } else { whole };
    match line[first..end].parse::<f64>() {
        Ok(value) if value.abs() <= LARGEST => {
            // Adding zero turns -0 into 0.
            Ok(Word { letter, value: value + 0.0, start, end })
        }
        Ok(_) => Err(Fault {
            at: start,
            found: format!("\"{}\"", &line[start..end]),
            expected: format!("numbers lie within -{LARGEST:e} and {LARGEST:e}"),
        }),
        // `#5`, `[1+2]`, `<name>`: the stray sign says more than the letter before it.
        Err(_) if matches!(bytes.get(unsigned), Some(b'#' | b'[' | b'<')) => Err(stray(line, unsigned)),
        Err(_) => Err(Fault {
            at: start,
            found: format!("\"{}\" without a number", line[start..end].trim_end()),
            expected: format!("a number follows {letter}, such as {letter}12.5"),
        }),
    }
}

/// A sign that starts no word.
fn stray(line: &str, at: usize) -> Fault {
    let found = line[at..].chars().next().map_or_else(String::new, |sign| sign.to_string());
    let expected = match found.as_str() {
        "#" | "=" | "<" | ">" => MACRO,
        "[" | "]" => EXPRESSION,
        "/" => "a slash (block delete) stands at the start of a line or after its N word",
        "%" => "a percent sign stands alone on its line, before and after the program",
        "," => "numbers are written with a decimal point",
        ")" => "a comment opens with ( before it closes",
        _ => "a word is a letter and a number, such as X12.5; comments stand in ( ) or after ;",
    };
    Fault { at, found: format!("\"{found}\""), expected: expected.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Result<Vec<(char, f64)>, usize> {
        let mut found = Vec::new();
        words(line, 0, &mut found)
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
    fn mistakes_are_placed() {
        for (line, at) in [
            ("X", 0),
            ("G1 X.", 3),
            ("X1 Y-", 3),
            ("X1..2", 3),
            ("X1 2", 3),
            ("X#5", 1),
            ("#5=3", 0),
            ("X-[1+2]", 2),
            ("X1 (a", 3),
            ("(a(b))", 2),
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
