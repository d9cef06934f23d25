//! Programs that do not run from the first line to the last: subprograms, loops and conditions of
//! LinuxCNC (O words) and Fanuc (G65, M97, M98, M99, IF, WHILE, DO, GOTO).
//!
//! Only what stands in the same text is followed. Steps and calls are bounded, so that a loop without
//! an end is an error at its line.

use super::after_slash;
use super::call::Call;
use super::control::{Control, control, line_number, pieces};
use super::expression::ExpressionReader;
use super::token::tokens;
use super::variables::Variables;
use super::word::{self, WordFault};
use crate::path::lines::TextLines;
use std::cell::Cell;

/// Most bytes of lines that are run beyond those of the text.
const MOST_RUN: usize = 16_000_000;
/// What a line costs besides its bytes.
const LINE_COST: usize = 16;
/// Most lines that are looked through for the other ends of jumps.
const MOST_LOOKED_THROUGH: usize = 200_000_000;
/// Most repeats of a call or a loop.
pub(super) const MOST_REPEATS: u32 = 100_000;

/// A fault and the line, from 0, in which it is.
pub(super) type LineFault = (usize, WordFault);

/// A program and the place in it.
pub(super) struct Flow<'t> {
    pub(super) lines: Vec<&'t str>,
    /// The line of the text, from 0, that each is (a part of).
    pub(super) sources: Vec<usize>,
    pub(super) controls: Vec<Option<Control>>,
    pub(super) at: usize,
    pub(super) calls: Vec<Call>,
    /// Lines of loops that repeat, with the repeats that are left.
    repeats: Vec<(usize, u32)>,
    /// Bytes of the lines that were run, with their cost, and their limit.
    run: usize,
    most_run: usize,
    /// Lines that were looked through for the other end of a jump.
    looked: Cell<usize>,
    started: bool,
}

/// The lines of a text in the pieces that run one after the other, each with its line from 0.
pub(super) fn parts(lines: TextLines) -> Vec<(usize, String)> {
    let lines = lines.enumerate();
    lines.flat_map(|(index, line)| pieces(line).into_iter().map(move |piece| (index, piece))).collect()
}

/// Whether a text has lines that decide which line is next.
pub(super) fn decides(text: &str) -> bool {
    // An O word, GOTO and DO have an O, END a D, a call its P, a condition its bracket.
    let has = |sign: u8| matches!(sign, b'O' | b'o' | b'P' | b'p' | b'D' | b'd' | b':' | b'[');
    let may = |text: &str| text.bytes().any(has);
    let decides = |line: &str| !matches!(control(line), None | Some(Control::Label(_) | Control::Back));
    may(text) && TextLines::of(text).any(|line| may(line) && decides(line))
}

impl<'t> Flow<'t> {
    /// A program of these pieces of lines, each with its line of the text; `block_delete` leaves out
    /// those with a slash.
    pub(super) fn new(pieces: &'t [(usize, String)], block_delete: bool) -> Self {
        let lines: Vec<&str> = pieces.iter().map(|(_, line)| line.as_str()).collect();
        let sources = pieces.iter().map(|(source, _)| *source).collect();
        let most_run = MOST_RUN + lines.iter().map(|line| line.len() + LINE_COST).sum::<usize>();
        let left_out = |line: &str| block_delete && after_slash(line) > 0;
        let controls = lines.iter().map(|line| if left_out(line) { None } else { control(line) }).collect();
        Self {
            lines,
            sources,
            controls,
            at: 0,
            calls: Vec::new(),
            repeats: Vec::new(),
            run: 0,
            most_run,
            looked: Cell::new(0),
            started: false,
        }
    }

    /// The next line to run; none at the end.
    ///
    /// # Errors
    /// At a call of what is not there, a loop or subprogram without its end, and where steps or calls
    /// are too many.
    pub(super) fn next(&mut self, variables: &mut Variables) -> Result<Option<usize>, LineFault> {
        loop {
            let Some(control) = self.controls.get(self.at) else {
                let Some(call) = self.calls.last() else { return Ok(None) };
                return Err(self.fault(
                    call.back - 1,
                    "a sub-program called here does not return: end it with M99 or endsub",
                ));
            };
            self.run += self.lines[self.at].len() + LINE_COST;
            if self.looked.get() > MOST_LOOKED_THROUGH {
                return Err(self.fault(self.at, "a program with fewer jumps across this many lines"));
            }
            // At a line that decides, which is one of the loop.
            if self.run > self.most_run && control.is_some() {
                let expected =
                    "a loop that ends: at most about half a million lines are run, or fewer if they are long";
                return Err(self.fault(self.at, expected));
            }
            match control.clone() {
                None => {
                    self.at += 1;
                    let line = self.lines[self.at - 1].trim_start();
                    self.started |= !(line.is_empty() || line.starts_with(['%', '(', ';']));
                    return Ok(Some(self.at - 1));
                }
                Some(Control::Label(_)) if !self.started && self.calls.is_empty() => {
                    self.at += 1;
                    self.started = true;
                    return Ok(Some(self.at - 1));
                }
                Some(control) => {
                    if !self.decide(control, variables)? {
                        return Ok(None);
                    }
                }
            }
        }
    }

    /// Goes where a line says; false at the end of the program.
    fn decide(&mut self, control: Control, variables: &mut Variables) -> Result<bool, LineFault> {
        use Control::*;
        let here = self.at;
        self.at += 1;
        match control {
            Label(_) => {
                return Err(self.fault(
                    here,
                    "the previous program must end with M30 or M99: it runs into the next one here",
                ));
            }
            // A definition is run when it is called.
            Sub(name) => {
                let is_end = |control: &Control| *control == EndSub(name.clone());
                self.at = self.after(here, is_end, "a sub-program ends with endsub")? + 1;
            }
            EndSub(_) | Return(_) => return self.back(here, variables),
            Back => {
                if self.calls.is_empty() {
                    return Ok(false);
                }
                return self.back(here, variables);
            }
            Call(name, from) => self.call(here, &name, from, variables)?,
            CallNumber { number, repeats, is_line } => self.call_number(here, number, repeats, is_line)?,
            Macro(from) => self.call_macro(here, from, variables)?,
            BackTo(number) => self.back_to(here, number, variables)?,
            If(name, from) | ElseIf(name, from) if matches!(self.controls[here], Some(If(..))) => {
                if !self.holds(here, from, variables)? {
                    self.at = self.branch(here, &name, variables)?;
                }
            }
            // Reached from the branch before: that was the one.
            If(name, _) | ElseIf(name, _) | Else(name) => {
                let is_end = |control: &Control| *control == EndIf(name.clone());
                self.at = self.after(here, is_end, "a condition ends with endif")? + 1;
            }
            EndIf(_) | Do(_) => {}
            While(name, from) => self.loop_while(here, &name, from, variables)?,
            EndWhile(name) => {
                let is_start = |control: &Control| matches!(control, While(other, _) if *other == name);
                self.at = self.before(here, is_start, "endwhile closes a while")?;
            }
            Repeat(name, from) => {
                let times = self.value(here, from, variables)?.max(0.0);
                if times > f64::from(MOST_REPEATS) {
                    return Err(self.fault(here, "repeats of 100000 at most"));
                }
                let is_end = |control: &Control| *control == EndRepeat(name.clone());
                let end = self.after(here, is_end, "a repeat ends with endrepeat")?;
                match times as u32 {
                    0 => self.at = end + 1,
                    times => self.repeats.push((here, times - 1)),
                }
            }
            EndRepeat(name) => {
                let open = self.repeats.last().copied().filter(|(start, _)| self.is_repeat(*start, &name));
                let Some((start, left)) = open else {
                    return Err(self.fault(here, "endrepeat closes a repeat"));
                };
                self.repeats.pop();
                if left > 0 {
                    self.repeats.push((start, left - 1));
                    self.at = start + 1;
                }
            }
            Break(name) => {
                let is_end = |control: &Control| {
                    *control == EndWhile(name.clone()) || *control == EndRepeat(name.clone())
                };
                self.at = self.after(here, is_end, "break leaves a loop of the same number")? + 1;
                self.repeats.retain(
                    |(start, _)| !matches!(&self.controls[*start], Some(Repeat(other, _)) if *other == name),
                );
            }
            Continue(name) => {
                let is_end = |control: &Control| {
                    *control == EndWhile(name.clone()) || *control == EndRepeat(name.clone())
                };
                self.at = self.after(here, is_end, "continue is in a loop of the same number")?;
            }
            When(from) => self.when(here, from, variables)?,
            WhileDo(from, number) => self.while_do(here, from, number, variables)?,
            DoLoop(number) => self.do_loop(here, number)?,
            End(number) => {
                let is_start = |control: &Control| match control {
                    WhileDo(_, Some(other)) | DoLoop(other) => *other == number,
                    _ => false,
                };
                self.at = self.before(here, is_start, "END closes a WHILE or DO with the same number")?;
            }
            GoTo(from) => self.go_to(here, from, variables)?,
        }
        Ok(true)
    }

    pub(super) fn fault(&self, line: usize, expected: &str) -> LineFault {
        let text = self.lines[line];
        let at = text.len() - text.trim_start().len();
        (line, WordFault { at, found: format!("\"{}\"", text.trim()), expected: expected.into() })
    }

    pub(super) fn look(&self, lines: usize) {
        self.looked.set(self.looked.get() + lines);
    }

    fn is_repeat(&self, line: usize, name: &str) -> bool {
        matches!(&self.controls[line], Some(Control::Repeat(other, _)) if other == name)
    }

    /// The first line after `here` with a control.
    fn after(&self, here: usize, is: impl Fn(&Control) -> bool, expected: &str) -> Result<usize, LineFault> {
        let found = (here + 1..self.lines.len()).find(|&line| self.controls[line].as_ref().is_some_and(&is));
        self.look(found.unwrap_or(self.lines.len()) - here);
        found.ok_or_else(|| self.fault(here, expected))
    }

    /// The last line before `here` with a control.
    fn before(&self, here: usize, is: impl Fn(&Control) -> bool, expected: &str) -> Result<usize, LineFault> {
        let found = (0..here).rev().find(|&line| self.controls[line].as_ref().is_some_and(&is));
        self.look(here - found.unwrap_or(0));
        found.ok_or_else(|| self.fault(here, expected))
    }

    /// The value with which a line ends.
    fn value(&self, line: usize, from: usize, variables: &Variables) -> Result<f64, LineFault> {
        let mut reader = ExpressionReader::new(self.lines[line], from, variables);
        let value = reader.value().map_err(|fault| (line, fault))?;
        self.ends(line, reader.at)?;
        Ok(value)
    }

    /// Fails unless nothing but a comment follows in a line.
    pub(super) fn ends(&self, line: usize, at: usize) -> Result<(), LineFault> {
        let rest = self.lines[line][at..].trim_start();
        if rest.is_empty() || rest.starts_with(['(', ';']) {
            return Ok(());
        }
        let at = self.lines[line].len() - rest.len();
        let expected = "only a comment may follow here";
        Err((line, WordFault { at, found: format!("\"{}\"", rest.trim_end()), expected: expected.into() }))
    }

    /// GOTO from the byte before its number.
    fn go_to(&mut self, here: usize, from: usize, variables: &Variables) -> Result<(), LineFault> {
        let number = self.value(here, from, variables)?;
        if number.fract() != 0.0 || !(0.0..=f64::from(u32::MAX)).contains(&number) {
            return Err(self.fault(here, &format!("a line's whole number; this goes to {number}")));
        }
        self.at = self.numbered(here, number as u32)?;
        Ok(())
    }

    fn holds(&self, line: usize, from: usize, variables: &Variables) -> Result<bool, LineFault> {
        Ok(self.value(line, from, variables)? != 0.0)
    }

    /// The line to go on at when the condition of `here` does not hold.
    fn branch(&self, here: usize, name: &str, variables: &Variables) -> Result<usize, LineFault> {
        for line in here + 1..self.lines.len() {
            match &self.controls[line] {
                Some(Control::ElseIf(other, from))
                    if other == name && self.holds(line, *from, variables)? =>
                {
                    return Ok(line + 1);
                }
                Some(Control::Else(other) | Control::EndIf(other)) if other == name => return Ok(line + 1),
                _ => {}
            }
        }
        Err(self.fault(here, "a condition ends with endif"))
    }

    fn loop_while(
        &mut self,
        here: usize,
        name: &str,
        from: usize,
        variables: &Variables,
    ) -> Result<(), LineFault> {
        let holds = self.holds(here, from, variables)?;
        let is_end = |control: &Control| matches!(control, Control::EndWhile(other) if other == name);
        match self.after(here, is_end, "") {
            Ok(end) if !holds => self.at = end + 1,
            Ok(_) => {}
            // Without endwhile, it closes a loop that began with do.
            Err(_) => {
                let is_do = |control: &Control| matches!(control, Control::Do(other) if other == name);
                let start = self.before(here, is_do, "a while loop ends with endwhile")?;
                self.at = if holds { start + 1 } else { here + 1 };
            }
        }
        Ok(())
    }

    /// The line with this number in the same program, from here on and then from its start.
    pub(super) fn numbered(&self, here: usize, number: u32) -> Result<usize, LineFault> {
        let is_label = |control: &Option<Control>| matches!(control, Some(Control::Label(_)));
        self.look(self.lines.len());
        let first = self.controls[..here].iter().rposition(is_label).unwrap_or(0);
        let last =
            self.controls[here..].iter().position(is_label).map_or(self.lines.len(), |more| here + more);
        let has = |line: &usize| line_number(self.lines[*line]) == Some(number);
        (here..last)
            .find(has)
            .or_else(|| (first..here).find(has))
            .ok_or_else(|| self.fault(here, &format!("a line N{number} in this program")))
    }

    /// `IF [..] GOTO n`, `IF [..] THEN #1 = ..`.
    fn when(&mut self, here: usize, from: usize, variables: &mut Variables) -> Result<(), LineFault> {
        let line = self.lines[here];
        let mut reader = ExpressionReader::new(line, from, variables);
        let holds = reader.value().map_err(|fault| (here, fault))? != 0.0;
        let goes = reader.take("GOTO");
        let is_then = !goes && reader.take("THEN");
        let at = reader.at;
        if !(goes || is_then) {
            return Err(self.fault(here, "IF [condition] GOTO number, or IF [condition] THEN #1 = value"));
        }
        if !holds {
            return Ok(());
        }
        if goes {
            return self.go_to(here, at, variables);
        }
        let mut words = Vec::new();
        word::words(line, at, &mut words, variables).map_err(|fault| (here, fault))?;
        if words.is_empty() { Ok(()) } else { Err(self.fault(here, "after THEN a variable is set")) }
    }

    fn while_do(
        &mut self,
        here: usize,
        from: usize,
        number: Option<u32>,
        variables: &Variables,
    ) -> Result<(), LineFault> {
        let Some(number) = number else {
            return Err(self.fault(here, "WHILE [condition] DO 1"));
        };
        let mut reader = ExpressionReader::new(self.lines[here], from, variables);
        let holds = reader.value().map_err(|fault| (here, fault))? != 0.0;
        if holds {
            return Ok(());
        }
        let is_end = |control: &Control| *control == Control::End(number);
        self.at = self.after(here, is_end, "a loop ends with END and its number")? + 1;
        Ok(())
    }

    /// `DO 1` without WHILE runs until a jump, a return or the program's end leaves it.
    fn do_loop(&self, here: usize, number: u32) -> Result<(), LineFault> {
        use Control::*;
        let is_end = |control: &Control| *control == End(number);
        let end = self.after(here, is_end, "a loop ends with END and its number")?;
        let ends = |line: &str| {
            let words = tokens(line, 0).map(|token| token.text.trim_start_matches(['M', 'm', '0', ' ']));
            line.contains(['M', 'm']) && words.into_iter().any(|word| ["2", "30"].contains(&word.trim_end()))
        };
        let leaves =
            |control: &Option<Control>| matches!(control, Some(GoTo(_) | When(_) | Back | BackTo(_)));
        if self.controls[here..end].iter().any(leaves) || self.lines[here..end].iter().any(|line| ends(line))
        {
            return Ok(());
        }
        Err(self
            .fault(here, "an endless loop: give it WHILE [condition], or leave it with IF [condition] GOTO"))
    }
}
