//! A place in the text of a program, from which words and numbers are taken.

/// A place in a text.
#[derive(Clone)]
pub(super) struct Scan<'a> {
    file: &'a str,
    /// The line of the text's beginning.
    line: usize,
    text: &'a str,
    at: usize,
    /// The mark of a comment to the end of its line.
    comment: Option<char>,
}

impl<'a> Scan<'a> {
    pub(super) fn of(file: &'a str, line: usize, text: &'a str) -> Scan<'a> {
        Scan { file, line, text, at: 0, comment: None }
    }

    /// The same, passing over comments.
    pub(super) fn with_comments(self, mark: char) -> Scan<'a> {
        Scan { comment: Some(mark), ..self }
    }

    pub(super) fn line(&self) -> usize {
        self.line + self.text[..self.at].matches('\n').count()
    }

    /// The error at this place.
    pub(super) fn fail<T>(&self, what: impl std::fmt::Display) -> Result<T, String> {
        let near: String = self.rest().chars().take_while(|letter| *letter != '\n').take(60).collect();
        Err(format!("{}:{}: {what} (at `{}`)", self.file, self.line(), near.trim_end()))
    }

    pub(super) fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    pub(super) fn blank(&mut self) {
        loop {
            let rest = self.rest();
            self.at += rest.len() - rest.trim_start().len();
            if self.comment.is_none_or(|mark| !self.rest().starts_with(mark)) {
                return;
            }
            self.at += self.rest().find('\n').unwrap_or(self.rest().len());
        }
    }

    pub(super) fn is_done(&mut self) -> bool {
        self.blank();
        self.rest().is_empty()
    }

    /// Passes over the rest.
    pub(super) fn finish(&mut self) {
        self.at = self.text.len();
    }

    pub(super) fn end(&mut self) -> Result<(), String> {
        if self.is_done() { Ok(()) } else { self.fail("more than a statement holds") }
    }

    /// Whether this stands next, in either case of letters; then it is passed. What follows may be anything.
    pub(super) fn prefix(&mut self, token: &str) -> bool {
        self.blank();
        let found = self.rest().get(..token.len()).is_some_and(|next| next.eq_ignore_ascii_case(token));
        self.at += if found { token.len() } else { 0 };
        found
    }

    /// Whether this stands next as a whole word or sign; then it is passed.
    pub(super) fn take(&mut self, token: &str) -> bool {
        let before = self.at;
        let found = self.prefix(token);
        let is_longer = found && token.ends_with(is_letter) && self.rest().starts_with(is_letter);
        if is_longer {
            self.at = before;
        }
        found && !is_longer
    }

    pub(super) fn need(&mut self, token: &str) -> Result<(), String> {
        if self.take(token) { Ok(()) } else { self.fail(format!("`{token}` is missing")) }
    }

    pub(super) fn need_all(&mut self, tokens: &[&str]) -> Result<(), String> {
        tokens.iter().try_for_each(|token| self.need(token))
    }

    /// A name: letters, digits, `_` and `$`, not beginning with a digit.
    pub(super) fn word(&mut self) -> Result<&'a str, String> {
        self.blank();
        let rest = self.rest();
        let length = rest.find(|letter| !is_letter(letter)).unwrap_or(rest.len());
        if length == 0 || rest.starts_with(|first: char| first.is_ascii_digit()) {
            return self.fail("a name is missing");
        }
        self.at += length;
        Ok(&rest[..length])
    }

    /// A decimal number, with an exponent perhaps.
    pub(super) fn number(&mut self) -> Result<f64, String> {
        self.blank();
        let rest = self.rest().as_bytes();
        let digits = |from: usize| {
            rest.get(from..).map_or(0, |tail| tail.iter().take_while(|byte| byte.is_ascii_digit()).count())
        };
        let sign = usize::from(matches!(rest.first(), Some(b'-' | b'+')));
        let whole = digits(sign);
        let mut length = sign + whole;
        let mut decimals = 0;
        if rest.get(length) == Some(&b'.') {
            decimals = digits(length + 1);
            length += 1 + decimals;
        }
        if whole + decimals == 0 {
            return self.fail("a number is missing");
        }
        if matches!(rest.get(length), Some(b'E' | b'e')) {
            let signed = 1 + usize::from(matches!(rest.get(length + 1), Some(b'-' | b'+')));
            if digits(length + signed) > 0 {
                length += signed + digits(length + signed);
            }
        }
        match self.rest()[..length].parse::<f64>() {
            Ok(number) if number.is_finite() => {
                self.at += length;
                Ok(number)
            }
            _ => self.fail("no number"),
        }
    }

    /// A whole number between these.
    pub(super) fn integer(&mut self, least: i64, greatest: i64) -> Result<i64, String> {
        let from = self.clone();
        let number = self.number()?;
        if number.fract() != 0.0 || number < least as f64 || number > greatest as f64 {
            return from.fail(format!("no whole number from {least} to {greatest}"));
        }
        Ok(number as i64)
    }

    /// Numbers with commas between them.
    pub(super) fn numbers<const N: usize>(&mut self) -> Result<[f64; N], String> {
        let mut numbers = [0.0; N];
        for (index, number) in numbers.iter_mut().enumerate() {
            if index > 0 {
                self.need(",")?;
            }
            *number = self.number()?;
        }
        Ok(numbers)
    }

    /// What stands between two of these marks, in one line.
    pub(super) fn quoted(&mut self, mark: char) -> Result<&'a str, String> {
        self.blank();
        let inner =
            self.rest().strip_prefix(mark).and_then(|rest| rest.split_once(mark)).map(|(inner, _)| inner);
        match inner {
            Some(inner) if !inner.contains('\n') => {
                self.at += inner.len() + 2;
                Ok(inner)
            }
            _ => self.fail(format!("no text between {mark}")),
        }
    }

    /// All up to this mark, which is passed.
    pub(super) fn until(&mut self, mark: char) -> Result<&'a str, String> {
        match self.rest().split_once(mark) {
            Some((inner, _)) => {
                self.at += inner.len() + 1;
                Ok(inner)
            }
            None => self.fail(format!("no `{mark}` follows")),
        }
    }
}

fn is_letter(letter: char) -> bool {
    letter.is_ascii_alphanumeric() || letter == '_' || letter == '$'
}
