//! Lines that decide which line is next.

use super::token::{Kind, tokens};

/// The name of a subprogram, or of a loop or condition of LinuxCNC: lower case, `<cut>` or `100`.
pub(super) type ControlName = String;

/// A line that decides which line is next; bytes of the line behind it where something is left to read.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Control {
    /// `O1000`, `:1000`: another program begins.
    Label(u32),
    Sub(ControlName),
    EndSub(ControlName),
    Return(ControlName),
    Call(ControlName, usize),
    If(ControlName, usize),
    ElseIf(ControlName, usize),
    Else(ControlName),
    EndIf(ControlName),
    While(ControlName, usize),
    EndWhile(ControlName),
    Do(ControlName),
    Repeat(ControlName, usize),
    EndRepeat(ControlName),
    Break(ControlName),
    Continue(ControlName),
    /// `IF [..] GOTO 10` or `IF [..] THEN ..`.
    When(usize),
    /// `WHILE [..] DO 1`.
    WhileDo(usize),
    /// `END 1`.
    End(u32),
    GoTo(usize),
    /// M98, M97: number, repeats, and whether it is a line's number.
    CallNumber {
        number: u32,
        repeats: Option<u32>,
        is_line: bool,
    },
    /// M99.
    Back,
}

/// The number of a line, N.
pub(super) fn line_number(line: &str) -> Option<u32> {
    let rest = line.trim_start().strip_prefix(['N', 'n'])?.trim_start();
    rest[..rest.bytes().take_while(u8::is_ascii_digit).count()].parse().ok()
}

/// The number after DO in a line that begins with WHILE.
pub(super) fn do_number(line: &str) -> Option<u32> {
    let upper = line.to_ascii_uppercase();
    let rest = upper.contains("WHILE").then(|| upper.rsplit_once("DO"))??.1.trim_start().to_owned();
    rest[..rest.bytes().take_while(u8::is_ascii_digit).count()].parse().ok()
}

/// What a line decides.
pub(super) fn control(line: &str) -> Option<Control> {
    let mut at = line.len() - line.trim_start().len();
    if line[at..].starts_with(['N', 'n']) {
        at += 1;
        at += line[at..].bytes().take_while(|sign| sign.is_ascii_digit() || *sign == b' ').count();
    }
    let rest = &line[at..];
    match rest.chars().next()?.to_ascii_uppercase() {
        'O' | ':' => named(line, at),
        'I' | 'W' | 'E' | 'G' => spelled(rest, at).or_else(|| called(line, at)),
        _ => called(line, at),
    }
}

/// A line that begins with an O word.
fn named(line: &str, at: usize) -> Option<Control> {
    use Control::*;
    let rest = &line[at + 1..];
    let blanks = rest.len() - rest.trim_start().len();
    let body = &rest[blanks..];
    let (name, length) = if body.starts_with('<') {
        let end = body.find('>')?;
        (body[..=end].to_ascii_lowercase(), end + 1)
    } else {
        let digits = body.bytes().take_while(u8::is_ascii_digit).count();
        (body[..digits].trim_start_matches('0').to_owned(), digits)
    };
    if length == 0 {
        return None;
    }
    let after = at + 1 + blanks + length;
    let tail = line[after..].trim_start();
    let keyword: String = tail.chars().take_while(char::is_ascii_alphabetic).collect();
    let from = line.len() - tail.len() + keyword.len();
    Some(match keyword.to_ascii_lowercase().as_str() {
        "sub" => Sub(name),
        "endsub" => EndSub(name),
        "return" => Return(name),
        "call" => Call(name, from),
        "if" => If(name, from),
        "elseif" => ElseIf(name, from),
        "else" => Else(name),
        "endif" => EndIf(name),
        "while" => While(name, from),
        "endwhile" => EndWhile(name),
        "do" => Do(name),
        "repeat" => Repeat(name, from),
        "endrepeat" => EndRepeat(name),
        "break" => Break(name),
        "continue" => Continue(name),
        "" if tail.is_empty() || tail.starts_with(['(', ';']) => Label(name.parse().unwrap_or(0)),
        _ => return None,
    })
}

/// IF, WHILE, END and GOTO.
fn spelled(rest: &str, at: usize) -> Option<Control> {
    let upper = rest.to_ascii_uppercase();
    let follows = |word: &str| upper.strip_prefix(word).map(|after| after.trim_start().to_owned());
    if follows("IF").is_some_and(|after| after.starts_with('[')) {
        return Some(Control::When(at + 2));
    }
    if follows("WHILE").is_some_and(|after| after.starts_with('[')) {
        return Some(Control::WhileDo(at + 5));
    }
    if let Some(number) = follows("END") {
        let digits = number.bytes().take_while(u8::is_ascii_digit).count();
        return number[..digits].parse().ok().map(Control::End);
    }
    follows("GOTO").map(|_| Control::GoTo(at + 4))
}

/// M97, M98, M99 with their words.
fn called(line: &str, from: usize) -> Option<Control> {
    if !line.contains("M9") && !line.contains("m9") {
        return None;
    }
    let (mut code, mut number, mut repeats) = (None, None, None);
    for token in tokens(line, from).filter(|token| token.kind == Kind::Word) {
        let value = token.text.get(1..).and_then(|number| number.trim().parse::<f64>().ok());
        match (token.text.as_bytes()[0].to_ascii_uppercase(), value) {
            (b'M', Some(value)) if [97.0, 98.0, 99.0].contains(&value) => code = Some(value as u32),
            (b'P', Some(value)) => number = Some(value as u32),
            (b'L', Some(value)) => repeats = Some(value as u32),
            // Any other word: not a call alone.
            _ if code.is_some() => return None,
            _ => {}
        }
    }
    match (code?, number) {
        (99, None) => Some(Control::Back),
        (99, Some(_)) | (_, None) => None,
        (code, Some(number)) => Some(Control::CallNumber { number, repeats, is_line: code == 97 }),
    }
}
