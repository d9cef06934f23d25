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
    /// `WHILE [..] DO 1`, with the number after DO.
    WhileDo(usize, Option<u32>),
    /// `DO 1` without WHILE: a loop that only a jump leaves.
    DoLoop(u32),
    /// `END 1`.
    End(u32),
    GoTo(usize),
    /// M98, M97: number, repeats, and whether it is a line's number.
    CallNumber {
        number: u32,
        repeats: Option<u32>,
        is_line: bool,
    },
    /// G65, with its words.
    Macro(usize),
    /// M99.
    Back,
    /// M99 P: back to the line with this number.
    BackTo(u32),
}

impl Control {
    /// Whether only LinuxCNC has it.
    pub(super) fn is_linuxcnc(&self) -> bool {
        use Control::*;
        match self {
            Label(_) | When(_) | WhileDo(..) | DoLoop(_) | End(_) | GoTo(_) => false,
            CallNumber { .. } | Macro(_) | Back | BackTo(_) => false,
            Sub(_) | EndSub(_) | Return(_) | Call(..) | If(..) | ElseIf(..) | Else(_) | EndIf(_) => true,
            While(..) | EndWhile(_) | Do(_) | Repeat(..) | EndRepeat(_) | Break(_) | Continue(_) => true,
        }
    }
}

/// The number of a line, N.
pub(super) fn line_number(line: &str) -> Option<u32> {
    let rest = line.trim_start().strip_prefix(['N', 'n'])?.trim_start();
    rest[..rest.bytes().take_while(u8::is_ascii_digit).count()].parse().ok()
}

/// The number at the start of a text.
fn leading_number(text: &str) -> Option<u32> {
    let text = text.trim_start();
    text[..text.bytes().take_while(u8::is_ascii_digit).count()].parse().ok()
}

/// What a line decides.
pub(super) fn control(line: &str) -> Option<Control> {
    let mut at = line.len() - line.trim_start().len();
    if line[at..].starts_with(['N', 'n']) {
        at += 1;
        at += line[at..].bytes().take_while(|sign| sign.is_ascii_digit() || b" \t".contains(sign)).count();
    }
    let rest = &line[at..];
    let start = [0, 1].map(|at| rest.as_bytes().get(at).map_or(b' ', u8::to_ascii_uppercase));
    match &start {
        [b'O' | b':', _] => named(line, at),
        b"IF" | b"WH" | b"EN" | b"GO" | b"DO" => spelled(rest, at).or_else(|| called(line, at)),
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

/// IF, WHILE, DO, END and GOTO.
fn spelled(rest: &str, at: usize) -> Option<Control> {
    let upper = rest.to_ascii_uppercase();
    let follows = |word: &str| upper.strip_prefix(word).map(|after| after.trim_start().to_owned());
    if follows("IF").is_some_and(|after| after.starts_with('[')) {
        return Some(Control::When(at + 2));
    }
    if follows("WHILE").is_some_and(|after| after.starts_with('[')) {
        let number = upper.rsplit_once("DO").and_then(|(_, after)| leading_number(after));
        return Some(Control::WhileDo(at + 5, number));
    }
    if let Some(after) = follows("END") {
        return leading_number(&after).map(Control::End);
    }
    if let Some(after) = follows("DO") {
        return leading_number(&after).map(Control::DoLoop);
    }
    // GOTOF and GOTOB are Siemens' own.
    let goes =
        follows("GOTO").is_some_and(|after| !after.starts_with(|sign: char| sign.is_ascii_alphabetic()));
    goes.then_some(Control::GoTo(at + 4))
}

/// G65, M97, M98, M99 with their words, which follow them.
fn called(line: &str, from: usize) -> Option<Control> {
    let call = call_in(line, from)?;
    match (call.code, call.number) {
        (MACRO_CALL, _) => call.places.first().map(|(_, end)| Control::Macro(*end)),
        (99, _) if call.repeats.is_some() => None,
        (99, None) => Some(Control::Back),
        (99, Some(number)) => Some(Control::BackTo(number)),
        (_, None) => None,
        (code, Some(number)) => {
            Some(Control::CallNumber { number, repeats: call.repeats, is_line: code == 97 })
        }
    }
}

/// The G code that calls a macro.
const MACRO_CALL: u32 = 65;

/// A call or return in a line, and the bytes of its words.
struct CallWords {
    code: u32,
    number: Option<u32>,
    repeats: Option<u32>,
    places: Vec<(usize, usize)>,
    others: bool,
}

fn call_in(line: &str, from: usize) -> Option<CallWords> {
    if !line.bytes().any(|sign| matches!(sign, b'M' | b'm' | b'P' | b'p')) {
        return None;
    }
    let mut found: Option<CallWords> = None;
    let mut others = false;
    for token in tokens(line, from).filter(|token| token.kind == Kind::Word) {
        let value = token.text.get(1..).and_then(|number| number.trim().parse::<f64>().ok());
        let letter = token.text.as_bytes()[0].to_ascii_uppercase();
        let place = (token.start, token.end());
        match (letter, value, &mut found) {
            // All that follows are its words.
            (b'G', Some(65.0), None) => {
                let (number, repeats, places) = (None, None, vec![place, (place.1, line.len())]);
                return Some(CallWords { code: MACRO_CALL, number, repeats, places, others });
            }
            (b'M', Some(value), None) if [97.0, 98.0, 99.0].contains(&value) => {
                let places = vec![place];
                found = Some(CallWords { code: value as u32, number: None, repeats: None, places, others });
            }
            (b'P', Some(value), Some(call)) if call.number.is_none() => {
                call.number = Some(value as u32);
                call.places.push(place);
            }
            (b'L', Some(value), Some(call)) if call.repeats.is_none() && value >= 0.0 => {
                call.repeats = Some(value as u32);
                call.places.push(place);
            }
            (b'N', ..) => {}
            (.., Some(call)) => call.others = true,
            _ => others = true,
        }
    }
    found
}

/// A line in the pieces that run one after the other: what else stands in the line of a call or return
/// comes before it.
pub(super) fn pieces(line: &str) -> Vec<String> {
    let call = call_in(line, 0).filter(|call| call.others && called(line, 0).is_some());
    let Some(call) = call else { return vec![line.to_owned()] };
    let is_call = |at: usize| call.places.iter().any(|(start, end)| (*start..*end).contains(&at));
    let kept = |wanted: bool| {
        let signs = line.char_indices();
        signs.map(|(at, sign)| if is_call(at) == wanted { sign } else { ' ' }).collect::<String>()
    };
    // Blanks in place of the others keep the columns.
    vec![kept(false), kept(true)]
}
