//! Statements of an APT text: lines joined at `$`, comments cut at `$$`, each a major word and its
//! values after a slash.

use crate::error::Error;
use crate::path::builder::Fault;
use crate::path::lines::TextLines;

/// Words followed by text for people or for the controller, up to the end of the line, `$`
/// included.
const FREE_TEXT: [&str; 6] = ["PARTNO", "PPRINT", "REMARK", "INSERT", "TPRINT", "LETTER"];

/// What begins a comment that a program may read: `$$-> CUTTER / 10.0`, as PTC Creo writes it. Unlike
/// other comments it goes on in the next line after a `$`.
const NOTE: &str = "$$->";

/// A place in the text.
#[derive(Debug, Clone, Copy)]
pub(super) struct TextPlace<'a> {
    /// From 1.
    pub(super) line: usize,
    text: &'a str,
    byte: usize,
}

impl TextPlace<'_> {
    /// Line and column, both from 1; columns count characters.
    pub(super) fn position(&self) -> (usize, usize) {
        (self.line, self.text[..self.byte].chars().count() + 1)
    }
}

/// The text between two commas.
#[derive(Debug, Clone, Copy)]
pub(super) struct AptToken<'a> {
    pub(super) text: &'a str,
    pub(super) place: TextPlace<'a>,
}

impl<'a> AptToken<'a> {
    /// What follows `(WORD/`, if the token starts with it.
    pub(super) fn opened(&self, word: &str) -> Option<Self> {
        let inner = self.text.strip_prefix('(')?.trim_start();
        let name = inner.get(..word.len()).filter(|name| name.eq_ignore_ascii_case(word))?;
        let value = inner[name.len()..].trim_start().strip_prefix('/')?.trim_start();
        let byte = self.place.byte + self.text.len() - value.len();
        Some(Self { text: value, place: TextPlace { byte, ..self.place } })
    }

    /// What precedes `)`, if the token ends with it.
    pub(super) fn closed(&self) -> Option<Self> {
        self.text.strip_suffix(')').map(|text| Self { text: text.trim_end(), ..*self })
    }

    /// The token as a number, if it is one.
    pub(super) fn number(&self) -> Option<f64> {
        let numeric = self.text.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
        // `inf` and `nan` are words here.
        if numeric { self.text.parse().ok().filter(|value: &f64| value.is_finite()) } else { None }
    }

    /// Whether the token is this word, in any case.
    pub(super) fn is(&self, word: &str) -> bool {
        self.text.eq_ignore_ascii_case(word)
    }
}

/// One statement.
pub(super) struct Statement<'a> {
    /// The major word: upper case, single blanks.
    pub(super) word: String,
    /// Place of the major word.
    pub(super) place: TextPlace<'a>,
    /// What follows the slash, one piece per line.
    rest: Vec<TextPlace<'a>>,
    slash: bool,
}

impl<'a> Statement<'a> {
    /// The word of a comment `$$-> WORD / ...`, if the statement is one.
    pub(super) fn note(&self) -> Option<&str> {
        self.word.strip_prefix(NOTE).map(str::trim_start)
    }

    /// Whether nothing follows the word but blanks and, perhaps, a slash.
    pub(super) fn is_bare(&self) -> bool {
        self.rest.iter().all(|place| place.text[place.byte..].trim().is_empty())
    }

    /// What follows the slash, cut at commas; empty without a slash.
    ///
    /// # Errors
    /// The place of a continuation line that has no comma before it.
    pub(super) fn tokens(&self) -> Result<Vec<AptToken<'a>>, TextPlace<'a>> {
        let mut tokens: Vec<AptToken<'a>> = Vec::with_capacity(6);
        let mut wanted = self.slash;
        for place in &self.rest {
            let mut byte = place.byte;
            for cell in place.text[byte..].split(',') {
                let comma = byte + cell.len() < place.text.len();
                let trimmed = cell.trim();
                let token = TextPlace { byte: byte + cell.len() - cell.trim_start().len(), ..*place };
                byte += cell.len() + 1;
                if trimmed.is_empty() && (!comma || !wanted) {
                    // The line ends with a comma, or starts with the one that the previous line
                    // left out.
                    wanted |= comma;
                    continue;
                }
                if !wanted {
                    return Err(token);
                }
                tokens.push(AptToken { text: trimmed, place: token });
                wanted = comma;
            }
        }
        if wanted {
            tokens.push(AptToken { text: "", place: self.end() });
        }
        Ok(tokens)
    }

    /// End of the statement.
    pub(super) fn end(&self) -> TextPlace<'a> {
        let last = self.rest.last().copied().unwrap_or(self.place);
        TextPlace { byte: last.text.trim_end().len(), ..last }
    }

    /// The statement as written, with single blanks.
    pub(super) fn written(&self) -> String {
        let mut text = self.word.clone();
        text.push(if self.slash { '/' } else { ' ' });
        for place in &self.rest {
            text.extend(place.text[place.byte..].split_whitespace().flat_map(|part| [part, " "]));
        }
        text.trim_end().to_string()
    }
}

/// The statements of a text in order.
pub(super) struct Statements<'a> {
    lines: std::iter::Enumerate<TextLines<'a>>,
    field: &'a str,
    /// Number of lines read.
    pub(super) count: usize,
}

impl<'a> Statements<'a> {
    pub(super) fn new(text: &'a str, field: &'a str) -> Self {
        Self { lines: TextLines::of(text).enumerate(), field, count: 0 }
    }

    /// The next line that is not blank, without its comment, and whether it is continued.
    fn line(&mut self) -> Option<(TextPlace<'a>, bool)> {
        for (index, text) in self.lines.by_ref() {
            self.count = index + 1;
            let byte = text.len() - text.trim_start().len();
            let free = FREE_TEXT
                .iter()
                .any(|word| text[byte..].get(..word.len()).is_some_and(|s| s.eq_ignore_ascii_case(word)));
            let dollar = match text {
                _ if free => None,
                note if note[byte..].starts_with(NOTE) => last_dollar(note),
                text => text.find('$'),
            };
            let goes_on = dollar.is_some_and(|at| !text[at + 1..].starts_with('$'));
            let text = text[..dollar.unwrap_or(text.len())].trim_end();
            if goes_on || byte < text.len() {
                return Some((TextPlace { line: index + 1, text, byte: byte.min(text.len()) }, goes_on));
            }
        }
        None
    }
}

impl<'a> Iterator for Statements<'a> {
    type Item = Result<Statement<'a>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        let (mut place, mut goes_on) = self.line()?;
        let first = place;
        let body = &place.text[place.byte..];
        let free = FREE_TEXT
            .iter()
            .find(|word| body.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word)));
        let (mut word, length) = match (free, body.find('/')) {
            (Some(word), _) => (word.to_string(), word.len()),
            (None, Some(slash)) => (squeezed(&body[..slash]), slash),
            (None, None) => (squeezed(body), body.len()),
        };
        place.byte += length;
        let mut slash = body[length..].starts_with('/');
        if slash {
            place.byte += 1;
        }
        let mut rest = Vec::with_capacity(1);
        if place.byte < place.text.len() {
            rest.push(place);
        }
        while goes_on {
            let Some((next, more)) = self.line() else {
                if word.starts_with(NOTE) {
                    break;
                }
                let end = (place.line, place.text.chars().count() + 1);
                let expected = "$ continues the statement on the next line";
                return Some(Err(Fault::new("the end of the text after $", expected).at(self.field, end)));
            };
            (place, goes_on) = (next, more);
            if let (false, true, Some(at)) = (slash, rest.is_empty(), place.text[place.byte..].find('/'))
                && (at == 0 || word.ends_with(','))
            {
                word.push_str(&squeezed(&place.text[place.byte..place.byte + at]));
                slash = true;
                place.byte += at + 1;
            }
            if place.byte < place.text.len() {
                rest.push(place);
            }
        }
        Some(Ok(Statement { word, place: first, rest, slash }))
    }
}

/// Place of a `$` that ends a line, unless it is the second of two.
fn last_dollar(text: &str) -> Option<usize> {
    let before = text.trim_end().strip_suffix('$')?;
    (!before.ends_with('$')).then_some(before.len())
}

/// Upper case, with single blanks, and none after a comma.
fn squeezed(text: &str) -> String {
    let mut words = text.split_whitespace();
    let mut squeezed = words.next().unwrap_or_default().to_ascii_uppercase();
    for word in words {
        if !squeezed.ends_with(',') {
            squeezed.push(' ');
        }
        squeezed.push_str(&word.to_ascii_uppercase());
    }
    squeezed
}
