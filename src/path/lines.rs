//! The lines of a text, for the readers of programs.

/// Lines that end in LF, CR LF or a bare CR, without a byte order mark before the first and without
/// the Ctrl-Z and NUL characters that some systems put after the last.
#[derive(Clone)]
pub(super) struct TextLines<'a> {
    rest: &'a str,
}

impl<'a> TextLines<'a> {
    pub(super) fn of(text: &'a str) -> Self {
        let text = text.trim_start_matches('\u{feff}');
        let filler = |c: char| matches!(c, '\u{1a}' | '\0');
        let written = text.trim_end_matches(|c: char| filler(c) || c.is_whitespace()).len();
        let end = text[written..].find(filler).map_or(text.len(), |at| written + at);
        Self { rest: &text[..end] }
    }
}

impl<'a> Iterator for TextLines<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        if self.rest.is_empty() {
            return None;
        }
        let bytes = self.rest.as_bytes();
        let end = bytes.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(bytes.len());
        let line = &self.rest[..end];
        let ends = &self.rest[end..];
        self.rest = ends.strip_prefix("\r\n").or(ends.strip_prefix(['\n', '\r'])).unwrap_or_default();
        Some(line)
    }
}
