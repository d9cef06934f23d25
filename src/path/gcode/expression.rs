//! Variables and expressions of hand-written programs: `#5`, `#<depth>`, `R1` and what is computed from
//! them, as LinuxCNC, Fanuc and Siemens write it.
//!
//! Angles are in degrees. In brackets the operators bind, from the tightest: `**`; `*`, `/`, `MOD`;
//! `+`, `-`; `EQ`, `NE`, `GT`, `GE`, `LT`, `LE` (`==`, `<>`, `>`, `>=`, `<`, `<=`); `AND`, `OR`, `XOR`. On a
//! Fanuc, `AND` binds like `*`, `OR` and `XOR` like `+`, and all three join whole numbers bit by bit.

use super::dialect::GcodeDialect;
use super::operator::{FUNCTIONS, levels};
use super::variables::{Operand, Variable, Variables};
use super::word::{LARGEST, WordFault};
use crate::math;
use crate::units::DEG;

/// Deepest nesting of brackets.
const DEEPEST: usize = 50;

/// A place in a line from which values are read.
pub(super) struct ExpressionReader<'a> {
    line: &'a str,
    /// Byte of the line.
    pub(super) at: usize,
    variables: &'a Variables,
    depth: usize,
}

impl<'a> ExpressionReader<'a> {
    pub(super) fn new(line: &'a str, at: usize, variables: &'a Variables) -> Self {
        Self { line, at, variables, depth: 0 }
    }

    fn rest(&self) -> &'a str {
        &self.line[self.at..]
    }

    pub(super) fn skip_blanks(&mut self) {
        self.at = self.line.len() - self.rest().trim_start().len();
    }

    /// Takes a text, upper or lower case, if it comes next.
    pub(super) fn take(&mut self, text: &str) -> bool {
        self.skip_blanks();
        let comes = self.rest().get(..text.len()).is_some_and(|start| start.eq_ignore_ascii_case(text));
        self.at += if comes { text.len() } else { 0 };
        comes
    }

    fn fault(&self, expected: &str) -> WordFault {
        let found = self.rest().split(['(', ';']).next().unwrap_or_default().trim_end();
        let found = if found.is_empty() { "the end of the line".into() } else { format!("\"{found}\"") };
        WordFault { at: self.at, found, expected: expected.into() }
    }

    fn finite(&self, start: usize, value: f64) -> Result<f64, WordFault> {
        if value.abs() <= LARGEST {
            return Ok(value);
        }
        let found = format!("\"{}\", which is {value}", &self.line[start..self.at]);
        Err(WordFault { at: start, found, expected: format!("a number within -{LARGEST:e} and {LARGEST:e}") })
    }

    /// One value: a number, a variable, a function, or an expression in brackets, with a sign. One that
    /// is vacant counts as 0.
    ///
    /// # Errors
    /// At the place that is no value, or a variable without one.
    pub(super) fn value(&mut self) -> Result<f64, WordFault> {
        let value = self.operand()?;
        Ok(self.counted(value))
    }

    /// A vacant value counts as 0.
    fn counted(&self, value: Operand) -> f64 {
        value.unwrap_or_else(|| {
            self.variables.used_vacant.set(true);
            0.0
        })
    }

    /// As [`Self::value`], or none if it is vacant.
    ///
    /// # Errors
    /// See [`Self::value`].
    pub(super) fn operand(&mut self) -> Result<Operand, WordFault> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.fault("at most fifty nested brackets"));
        }
        self.skip_blanks();
        let start = self.at;
        let value = if self.take("-") {
            self.operand()?.map(|value| -value)
        } else if self.take("+") {
            self.operand()?
        } else if self.take("[") {
            self.bracketed("]")?
        } else if self.rest().starts_with('(') && self.depth > 1 {
            // Siemens has its brackets round; at the start of a value they would be a comment.
            self.at += 1;
            self.bracketed(")")?
        } else if let Some(variable) = self.variable()? {
            match self.variables.get(&variable) {
                Some(value) => value,
                None => {
                    let found = format!("\"{}\"", &self.line[start..self.at]);
                    let expected = "this variable has no value here: set it first";
                    return Err(WordFault { at: start, found, expected: expected.into() });
                }
            }
        } else if let Some(number) = self.number() {
            Some(number)
        } else {
            Some(self.function()?)
        };
        self.depth -= 1;
        value.map(|value| self.finite(start, value + 0.0)).transpose()
    }

    fn bracketed(&mut self, close: &str) -> Result<Operand, WordFault> {
        let value = self.joined(0)?;
        if self.take(close) {
            Ok(value)
        } else {
            Err(self.fault(&format!("the bracket closes with {close}")))
        }
    }

    /// Values joined by operators; vacant, it counts as 0.
    ///
    /// # Errors
    /// See [`Self::value`].
    pub(super) fn expression(&mut self) -> Result<f64, WordFault> {
        let value = self.joined(0)?;
        Ok(self.counted(value))
    }

    /// Values joined by operators, or none if there is only one, which is vacant.
    ///
    /// # Errors
    /// See [`Self::value`].
    pub(super) fn operands(&mut self) -> Result<Operand, WordFault> {
        self.joined(0)
    }

    /// Values joined by the operators of a level and of the tighter ones.
    fn joined(&mut self, level: usize) -> Result<Operand, WordFault> {
        let dialect = self.variables.dialect;
        let Some(operators) = levels(dialect).get(level) else { return self.operand() };
        let mut value = self.joined(level + 1)?;
        let mut compared = false;
        'next: loop {
            let next = self.rest().trim_start().bytes().next().map(|byte| byte.to_ascii_uppercase());
            for (sign, operator) in *operators {
                if sign.bytes().next() != next {
                    continue;
                }
                let before = self.at;
                // A single star is not the start of a double one.
                if self.take(sign) && !(*sign == "*" && self.rest().starts_with('*')) {
                    let start = self.at;
                    let other = self.joined(level + 1)?;
                    let fault = |expected: &str| WordFault {
                        at: before,
                        found: format!("\"{}\"", self.line[before..self.at].trim()),
                        expected: expected.into(),
                    };
                    if compared && dialect == GcodeDialect::Fanuc {
                        return Err(fault(
                            "put each comparison in its own brackets: [[#1 GT 2] AND [#3 LE 7]]",
                        ));
                    }
                    compared = operator.compares();
                    if !compared && (value.is_none() || other.is_none()) {
                        self.variables.used_vacant.set(true);
                    }
                    let joined = operator.join(value, other, dialect).map_err(fault)?;
                    value = Some(self.finite(start, joined)?);
                    continue 'next;
                }
                self.at = before;
            }
            return Ok(value);
        }
    }

    /// The variable that comes next.
    ///
    /// # Errors
    /// If a `#` is followed by neither number nor name.
    pub(super) fn variable(&mut self) -> Result<Option<Variable>, WordFault> {
        self.skip_blanks();
        let rest = self.rest();
        if rest.starts_with(['R', 'r']) && rest[1..].starts_with(|sign: char| sign.is_ascii_digit()) {
            self.at += 1;
            return Ok(self.whole().map(Variable::Arithmetic));
        }
        if !rest.starts_with('#') {
            return Ok(None);
        }
        self.at += 1;
        if self.take("<") {
            let Some(end) = self.rest().find('>') else {
                return Err(self.fault("the name of a variable closes with >"));
            };
            let name = self.rest()[..end].chars().filter(|sign| !sign.is_whitespace()).collect::<String>();
            self.at += end + 1;
            return Ok(Some(Variable::Named(name.to_ascii_lowercase())));
        }
        if let Some(number) = self.whole() {
            return Ok(Some(Variable::Numbered(number)));
        }
        // #[..] and ##1 name the number of a variable.
        let place = self.at;
        let number = self.value()?;
        if number.fract() == 0.0 && (0.0..1e6).contains(&number) {
            return Ok(Some(Variable::Numbered(number as u32)));
        }
        Err(WordFault {
            at: place,
            found: format!("variable number {number}"),
            expected: "a whole number".into(),
        })
    }

    fn whole(&mut self) -> Option<u32> {
        let digits = self.rest().bytes().take_while(u8::is_ascii_digit).count();
        let number = self.rest()[..digits].parse().ok()?;
        self.at += digits;
        Some(number)
    }

    fn number(&mut self) -> Option<f64> {
        let rest = self.rest();
        let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
        let mut end = digits(rest);
        if rest[end..].starts_with('.') {
            end += 1 + digits(&rest[end + 1..]);
        }
        let number = rest[..end].parse().ok()?;
        self.at += end;
        Some(number)
    }

    /// A function of a value in brackets.
    fn function(&mut self) -> Result<f64, WordFault> {
        let start = self.at;
        for (name, function) in FUNCTIONS {
            if self.take(name) {
                let (open, close) = if self.take("[") { ("[", "]") } else { ("(", ")") };
                if open == "(" && !self.take("(") {
                    return Err(self.fault("put the argument of a function in brackets"));
                }
                let value = self.bracketed(close)?;
                let value = self.counted(value);
                // LinuxCNC rounds down and up, the others toward zero and away from it.
                return Ok(match (name, self.variables.dialect == GcodeDialect::LinuxCnc) {
                    ("FIX", false) => value.trunc(),
                    ("FUP", false) => value.abs().ceil().copysign(value),
                    _ => function(value),
                });
            }
        }
        if self.take("ATAN") {
            self.skip_blanks();
            let two = self.take("2");
            let (open, close) = if self.take("[") { ("[", "]") } else { ("(", ")") };
            if open == "(" && !self.take("(") {
                return Err(self.fault("put the argument of a function in brackets"));
            }
            let y = self.expression()?;
            let separate = two && self.take(",");
            let x = if separate { self.expression()? } else { 1.0 };
            if !self.take(close) {
                return Err(self.fault("the bracket closes"));
            }
            // ATAN[y]/[x] is one function.
            let before = self.at;
            if !separate && self.take("/") && self.take("[") {
                let x = self.bracketed("]")?;
                let x = self.counted(x);
                return Ok(math::atan2(y, x) / DEG);
            }
            self.at = before;
            return Ok(math::atan2(y, x) / DEG);
        }
        self.at = start;
        Err(self.fault("a number, a variable (#5, #<name>) or an expression in brackets"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Result<f64, String> {
        let mut variables = Variables::default();
        variables.set(Variable::Numbered(1), Some(3.0));
        variables.set(Variable::Numbered(3), Some(7.0));
        variables.set(Variable::Named("depth".into()), Some(-2.5));
        variables.set(Variable::Arithmetic(10), Some(4.0));
        let mut reader = ExpressionReader::new(text, 0, &variables);
        let value = reader.value().map_err(|fault| format!("{}: {}", fault.at, fault.expected))?;
        assert_eq!(reader.at, text.len(), "{text}");
        Ok(value)
    }

    #[test]
    fn expressions_are_computed() {
        for (text, wanted) in [
            ("12.5", 12.5),
            ("-.5", -0.5),
            ("#1", 3.0),
            ("-#1", -3.0),
            ("##1", 7.0),
            ("#[1+2]", 7.0),
            ("#<Depth>", -2.5),
            ("# < de pth >", -2.5),
            ("R10", 4.0),
            ("[1+2*3]", 7.0),
            ("[[1+2]*3]", 9.0),
            ("[2**3*2]", 16.0),
            ("[10-4-3]", 3.0),
            ("[-1 MOD 3]", 2.0),
            ("[7/2]", 3.5),
            ("SIN[30]", 0.5),
            ("ATAN[1]/[1]", 45.0),
            ("ATAN2(-1, 0)", -90.0),
            ("SQRT[#1*#1+16]", 5.0),
            ("FUP[2.1]", 3.0),
            ("FIX[-2.1]", -2.0),
            ("FUP[-2.1]", -3.0),
            ("[#1 GT 2 AND #3 LE 7]", 1.0),
            ("[#1 EQ 2 OR 0]", 0.0),
            ("[2*(1+2)]", 6.0),
        ] {
            let found = value(text).unwrap_or_else(|error| panic!("{text}: {error}"));
            assert!((found - wanted).abs() < 1e-12, "{text}: {found}");
        }
    }

    #[test]
    fn controls_join_as_their_books_say() {
        use GcodeDialect::{Fanuc, LinuxCnc, Unknown};
        let value = |text: &str, dialect| {
            let mut variables = Variables::of(dialect);
            for (number, value) in [(1, 6.0), (2, 3.0)] {
                variables.set(Variable::Numbered(number), Some(value));
            }
            variables.settle();
            ExpressionReader::new(text, 0, &variables).operands().map_err(|fault| fault.expected)
        };
        for (text, dialect, wanted) in [
            // 110 and 011 in binary.
            ("#1 AND #2", Fanuc, Some(2.0)),
            ("#1 OR #2", Fanuc, Some(7.0)),
            ("#1 XOR #2", Fanuc, Some(5.0)),
            ("#1 AND #2", LinuxCnc, Some(1.0)),
            ("#1 XOR #2", LinuxCnc, Some(0.0)),
            // AND binds like a product, OR like a sum: (6 AND 3) + 1 and (8 OR 6) - 2, from the left.
            ("#1 AND #2 + 1", Fanuc, Some(3.0)),
            ("8 OR #1 - 2", Fanuc, Some(12.0)),
            ("#1 AND #2 + 1", LinuxCnc, Some(1.0)),
            ("[[#1 AND 2] EQ 2]", Fanuc, Some(1.0)),
            ("[[#1 GT 2] AND [#2 LE 7]]", Fanuc, Some(1.0)),
            ("[#1 GT 2] AND [#2 GT 7]", Unknown, Some(0.0)),
            ("#0", Fanuc, None),
            ("-[#0]", Fanuc, None),
            ("#0 + 2", Fanuc, Some(2.0)),
            ("#5 EQ #0", Fanuc, Some(1.0)),
            ("#1 EQ #0", Fanuc, Some(0.0)),
            ("#1 NE #0", Fanuc, Some(1.0)),
            // A vacant value equals no number, not even 0, but is no less than 0.
            ("#0 EQ 0", Fanuc, Some(0.0)),
            ("#0 GE 0", Fanuc, Some(1.0)),
        ] {
            assert_eq!(value(text, dialect), Ok(wanted), "{text}");
        }
        assert!(value("#1 AND 2.5", Fanuc).is_err_and(|said| said.contains("whole")));
        assert!(value("#1 AND #2", Unknown).is_err_and(|said| said.contains("path.dialect")));
        assert!(value("#1 GT 2 AND #2 LE 7", Fanuc).is_err_and(|said| said.contains("brackets")));
        assert!(value("#0", LinuxCnc).is_err() && value("#100", Fanuc).is_err());
    }

    #[test]
    fn what_has_no_value_is_refused_at_its_place() {
        for (text, place) in [
            ("#2", "0: this"),
            ("[1+", "3:"),
            ("[1+2", "4:"),
            ("[1/0]", "3:"),
            ("#<a", "2:"),
            ("[FOO[1]]", "1:"),
        ] {
            assert!(value(text).is_err_and(|error| error.starts_with(place)), "{text}: {:?}", value(text));
        }
        assert!(value(&"[".repeat(200)).is_err());
    }
}
