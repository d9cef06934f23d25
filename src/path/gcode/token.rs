//! Splits a line of G-code into tokens: words and comments, each with its place.
//!
//! Any text can be split into tokens. [`word`](super::word) decides which of them a controller
//! would understand. The export that rewrites a program also keeps lines that no controller runs
//! (behind a slash, after the end).

/// Kind of a token.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A letter and its number, if one follows. Any other character that is not part of a number or
    /// a comment also starts a word.
    Word,
    /// A comment in round brackets; either bracket may be missing.
    Comment,
    /// A comment from its semicolon to the end of the line.
    LineComment,
}

/// A part of a line. Only blanks separate tokens.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Token<'t> {
    /// Kind of the token.
    pub(crate) kind: Kind,
    /// Byte of the line at which it starts.
    pub(crate) start: usize,
    /// As written.
    pub(crate) text: &'t str,
}

impl Token<'_> {
    /// Byte after the token.
    pub(crate) fn end(&self) -> usize {
        self.start + self.text.len()
    }
}

/// The tokens of `line` from the byte `from` on.
pub(crate) fn tokens(line: &str, from: usize) -> impl Iterator<Item = Token<'_>> {
    let mut at = from;
    std::iter::from_fn(move || {
        let rest = line[at..].trim_ascii_start();
        let start = line.len() - rest.len();
        let (kind, length) = match rest.chars().next()? {
            ';' => (Kind::LineComment, rest.len()),
            '(' => (Kind::Comment, comment(rest)),
            ')' => (Kind::Comment, 1),
            sign => (Kind::Word, sign.len_utf8() + number(&rest[sign.len_utf8()..])),
        };
        at = start + length;
        Some(Token { kind, start, text: &rest[..length] })
    })
}

/// Length in bytes of the comment at the start of `text`: to the bracket that closes it, counting
/// those that open within (CAM systems name a copied operation so, `(2D Contour (2))`). If that is
/// missing, it ends at the first closing bracket.
fn comment(text: &str) -> usize {
    let mut depth = 0;
    for (at, sign) in text.char_indices() {
        match sign {
            '(' => depth += 1,
            ')' if depth == 1 => return at + 1,
            ')' => depth -= 1,
            _ => {}
        }
    }
    text.find(')').map_or(text.len(), |closing| closing + 1)
}

/// Length in bytes of the number that follows a letter in `text`. Blanks may precede it, but not
/// split it. An exponent has a sign: without one, E would be a word of its own.
fn number(text: &str) -> usize {
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let mut at = text.len() - text.trim_ascii_start().len();
    at += usize::from(text[at..].starts_with(['+', '-']));
    at += digits(&text[at..]);
    if text[at..].starts_with('.') {
        at += 1 + digits(&text[at + 1..]);
    }
    let exponent = &text[at..];
    if exponent.starts_with(['e', 'E']) && exponent[1..].starts_with(['+', '-']) {
        let length = digits(&exponent[2..]);
        at += if length > 0 { 2 + length } else { 0 };
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Vec<(Kind, &str)> {
        let mut end = 0;
        tokens(line, 0)
            .map(|token| {
                assert!(line[end..token.start].trim_ascii().is_empty(), "{line}: only blanks between");
                end = token.end();
                assert_eq!(&line[token.start..end], token.text);
                (token.kind, token.text)
            })
            .collect()
    }

    #[test]
    fn words_have_at_most_one_number() {
        let words = |line| read(line).into_iter().map(|(_, text)| text).collect::<Vec<_>>();
        assert_eq!(words("N10g1X-1.5 y .5M05"), ["N10", "g1", "X-1.5", "y .5", "M05"]);
        assert_eq!(words("X 1 . 5"), ["X 1", ". 5"]);
        assert_eq!(words("Y-3.55e-15X1E+2P2E0.025"), ["Y-3.55e-15", "X1E+2", "P2", "E0.025"]);
        assert_eq!(words("X1..2 +-3"), ["X1.", ".2", "+-3"]);
        assert_eq!(words("%"), ["%"]);
        assert_eq!(words("/2 G1"), ["/2", "G1"]);
        assert_eq!(words("\u{feff}X#5 \u{e4}7\u{a0}"), ["\u{feff}", "X", "#5", "\u{e4}7", "\u{a0}"]);
        assert_eq!(words(" \t "), [""; 0]);
    }

    #[test]
    fn comments_end_at_their_bracket_or_with_the_line() {
        use Kind::{Comment, LineComment, Word};
        for (line, tokens) in [
            ("(a)X1 (b;c)", vec![(Comment, "(a)"), (Word, "X1"), (Comment, "(b;c)")]),
            ("X1;(a) b ", vec![(Word, "X1"), (LineComment, ";(a) b ")]),
            ("(a(b)c)X1", vec![(Comment, "(a(b)c)"), (Word, "X1")]),
            ("(a(b)c", vec![(Comment, "(a(b)"), (Word, "c")]),
            ("G (a", vec![(Word, "G "), (Comment, "(a")]),
        ] {
            assert_eq!(read(line), tokens, "{line}");
        }
    }
}
