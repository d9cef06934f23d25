//! Calls of subprograms and macros in the same text, and their returns.

use super::control::{Control, ControlName};
use super::dialect::GcodeDialect;
use super::expression::ExpressionReader;
use super::flow::{Flow, LineFault, MOST_REPEATS};
use super::variables::{Locals, Variables};
use super::word::{self, Word};

/// Most calls within each other.
const DEEPEST: usize = 100;
/// Most values of a call on LinuxCNC.
const MOST_VALUES: u32 = 30;

/// Local variables of a macro by the letters of its call (Fanuc, argument specification I).
const ARGUMENTS: [(char, u32); 21] = [
    ('A', 1),
    ('B', 2),
    ('C', 3),
    ('I', 4),
    ('J', 5),
    ('K', 6),
    ('D', 7),
    ('E', 8),
    ('F', 9),
    ('H', 11),
    ('M', 13),
    ('Q', 17),
    ('R', 18),
    ('S', 19),
    ('T', 20),
    ('U', 21),
    ('V', 22),
    ('W', 23),
    ('X', 24),
    ('Y', 25),
    ('Z', 26),
];

/// A call that has not returned.
pub(super) struct Call {
    pub(super) back: usize,
    start: usize,
    repeats: u32,
    /// The caller's own local variables, and those that the call has given.
    locals: Option<(Locals, Locals)>,
}

impl Flow<'_> {
    /// M98 and M97, which share the variables of the caller.
    pub(super) fn call_number(
        &mut self,
        here: usize,
        number: u32,
        repeats: Option<u32>,
        is_line: bool,
    ) -> Result<(), LineFault> {
        // Older controls write the repeats before the four digits of the number.
        let is_label = |control: &Option<Control>| *control == Some(Control::Label(number));
        let both = !is_line && number > 9999 && repeats.is_none() && !self.controls.iter().any(is_label);
        let (number, repeats) =
            if both { (number % 10_000, number / 10_000) } else { (number, repeats.unwrap_or(1)) };
        if repeats > MOST_REPEATS {
            return Err(self.fault(here, "repeats of 100000 at most"));
        }
        let start = if is_line { self.numbered(here, number)? } else { self.labelled(here, number)? };
        self.enter(here, start, repeats, None)
    }

    /// `o<name> call [1] [2]`: what is not given is 0.
    pub(super) fn call(
        &mut self,
        here: usize,
        name: &ControlName,
        from: usize,
        variables: &mut Variables,
    ) -> Result<(), LineFault> {
        let is_sub =
            |control: &Option<Control>| matches!(control, Some(Control::Sub(other)) if other == name);
        self.look(self.lines.len());
        let Some(start) = self.controls.iter().position(is_sub) else {
            return Err(self.fault(here, "a sub-program in this text"));
        };
        let mut given = Vec::new();
        let mut reader = ExpressionReader::new(self.lines[here], from, variables);
        loop {
            reader.skip_blanks();
            if given.len() >= MOST_VALUES as usize || !self.lines[here][reader.at..].starts_with('[') {
                break;
            }
            given.push(reader.value().map_err(|fault| (here, fault))?);
        }
        self.ends(here, reader.at)?;
        given.resize(MOST_VALUES as usize, 0.0);
        let locals = Locals::of((1..).zip(given));
        self.enter(here, start + 1, 1, Some((variables.locals(), locals.clone())))?;
        variables.set_locals(locals);
        Ok(())
    }

    /// G65: the words behind it are the macro's local variables; those not given are vacant.
    pub(super) fn call_macro(
        &mut self,
        here: usize,
        from: usize,
        variables: &mut Variables,
    ) -> Result<(), LineFault> {
        if matches!(variables.dialect, GcodeDialect::LinuxCnc | GcodeDialect::Grbl) {
            return Err(self.fault(here, "this control has no macros (G65): call a sub-program"));
        }
        let line = self.lines[here];
        let mut words: Vec<Word> = Vec::new();
        word::words(line, from, &mut words, variables).map_err(|fault| (here, fault))?;
        let (mut number, mut repeats, mut given) = (None, 1, Vec::new());
        for word in words {
            let fault = |expected: &str| (here, word.fault(line, expected));
            let whole = |most: u32| word.whole(line, 1, most).map_err(|fault| (here, fault));
            match word.letter {
                'P' if number.is_none() => number = Some(whole(99_999_999)?),
                'L' => repeats = whole(MOST_REPEATS)?,
                letter => {
                    let Some((_, local)) = ARGUMENTS.iter().find(|(known, _)| *known == letter) else {
                        return Err(fault("a macro takes the letters A to Z without G, L, N, O and P"));
                    };
                    if given.iter().any(|(other, _)| other == local) {
                        return Err(fault(
                            "use each letter once; repeated I, J, K (argument specification II) are not supported",
                        ));
                    }
                    given.push((*local, word.value));
                }
            }
        }
        let Some(number) = number else {
            return Err(
                self.fault(here, "G65 names its macro by P, which must be in this text as O and its number")
            );
        };
        let start = self.labelled(here, number)?;
        let locals = Locals::of(given);
        self.enter(here, start, repeats, Some((variables.locals(), locals.clone())))?;
        variables.set_locals(locals);
        Ok(())
    }

    fn enter(
        &mut self,
        here: usize,
        start: usize,
        repeats: u32,
        locals: Option<(Locals, Locals)>,
    ) -> Result<(), LineFault> {
        if self.calls.len() >= DEEPEST {
            return Err(self.fault(here, "at most a hundred nested calls"));
        }
        if repeats > 0 {
            self.calls.push(Call { back: here + 1, start, repeats: repeats - 1, locals });
            self.at = start;
        }
        Ok(())
    }

    /// Returns from a call, or repeats it.
    pub(super) fn back(&mut self, here: usize, variables: &mut Variables) -> Result<bool, LineFault> {
        let Some(call) = self.calls.last_mut() else {
            return Err(self.fault(here, "a return is only allowed in a sub-program that was called"));
        };
        if call.repeats == 0 {
            self.at = call.back;
            self.leave(variables);
            return Ok(true);
        }
        // Whether a macro that is repeated finds its variables as it left them, books do not say.
        if call.locals.as_ref().is_some_and(|(_, given)| *given != variables.locals()) {
            return Err(self.fault(
                here,
                "a macro called with L may not change its local variables: call it line by line",
            ));
        }
        call.repeats -= 1;
        self.at = call.start;
        Ok(true)
    }

    /// M99 P: back to a line of the program that has called, or a jump in the main program.
    pub(super) fn back_to(
        &mut self,
        here: usize,
        number: u32,
        variables: &mut Variables,
    ) -> Result<(), LineFault> {
        if variables.dialect == GcodeDialect::LinuxCnc {
            return Err(self.fault(here, "M99 without P: LinuxCNC returns after the call"));
        }
        match self.calls.last() {
            None => self.at = self.numbered(here, number)?,
            Some(call) if call.repeats > 0 => {
                return Err(self.fault(here, "M99 P ends a sub-program that is called once"));
            }
            Some(call) => {
                self.at = self.numbered(call.back - 1, number)?;
                self.leave(variables);
            }
        }
        Ok(())
    }

    /// Gives the caller its own variables back.
    fn leave(&mut self, variables: &mut Variables) {
        if let Some((own, _)) = self.calls.pop().and_then(|call| call.locals) {
            variables.set_locals(own);
        }
    }

    /// The line after the number of a program.
    fn labelled(&self, here: usize, number: u32) -> Result<usize, LineFault> {
        let is_label = |control: &Option<Control>| *control == Some(Control::Label(number));
        self.look(self.lines.len());
        let found = self.controls.iter().position(is_label);
        found
            .map(|line| line + 1)
            .ok_or_else(|| self.fault(here, "a sub-program or macro in this text: other files are not read"))
    }
}
