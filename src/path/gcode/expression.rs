//! Variables and expressions of hand-written programs: `#5`, `#<depth>`, `R1` and what is computed from
//! them, as LinuxCNC, Fanuc and Siemens write it.
//!
//! Angles are in degrees. In brackets the operators bind, from the tightest: `**`; `*`, `/`, `MOD`;
//! `+`, `-`; `EQ`, `NE`, `GT`, `GE`, `LT`, `LE` (`==`, `<>`, `>`, `>=`, `<`, `<=`); `AND`, `OR`, `XOR`.

use super::word::{LARGEST, WordFault};
use crate::math;
use crate::units::DEG;
use std::collections::BTreeMap;

/// Deepest nesting of brackets.
const DEEPEST: usize = 50;

/// The values of a program's variables.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Variables {
    /// By `#` and a number.
    numbered: BTreeMap<u32, f64>,
    /// By `#<name>`, lower case.
    named: BTreeMap<String, f64>,
    /// `R` and a number (Siemens).
    arithmetic: BTreeMap<u32, f64>,
    /// Whether LinuxCNC's rules hold.
    pub(super) is_linuxcnc: bool,
    /// Values set in the line being read.
    pending: Vec<(Variable, f64)>,
}

/// A variable.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Variable {
    Numbered(u32),
    Named(String),
    Arithmetic(u32),
}

impl Variables {
    /// Sets a variable; on LinuxCNC its value holds from the next line on.
    pub(super) fn set(&mut self, variable: Variable, value: f64) {
        if self.is_linuxcnc { self.pending.push((variable, value)) } else { self.put(variable, value) }
    }

    /// The values set in the line just read hold from here on.
    pub(super) fn settle(&mut self) {
        if self.pending.is_empty() {
            return;
        }
        for (variable, value) in std::mem::take(&mut self.pending) {
            self.put(variable, value);
        }
    }

    fn put(&mut self, variable: Variable, value: f64) {
        match variable {
            Variable::Numbered(number) => self.numbered.insert(number, value),
            Variable::Named(name) => self.named.insert(name, value),
            Variable::Arithmetic(number) => self.arithmetic.insert(number, value),
        };
    }

    fn get(&self, variable: &Variable) -> Option<f64> {
        match variable {
            Variable::Numbered(number) => self.numbered.get(number),
            Variable::Named(name) => self.named.get(name),
            Variable::Arithmetic(number) => self.arithmetic.get(number),
        }
        .copied()
    }

    /// The local variables.
    pub(super) fn locals(&self) -> Locals {
        let numbered = self.numbered.range(1..=30).map(|(number, value)| (*number, *value)).collect();
        let named = self.named.iter().filter(|(name, _)| !name.starts_with('_'));
        Locals { numbered, named: named.map(|(name, value)| (name.clone(), *value)).collect() }
    }

    /// Puts local variables in place of those in force.
    pub(super) fn set_locals(&mut self, locals: Locals) {
        self.numbered.retain(|number, _| !(1..=30).contains(number));
        self.numbered.extend(locals.numbered);
        self.named.retain(|name, _| name.starts_with('_'));
        self.named.extend(locals.named);
    }
}

/// Variables that a subprogram of LinuxCNC has for itself: #1 to #30, and names that do not start with
/// an underscore.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Locals {
    numbered: BTreeMap<u32, f64>,
    named: BTreeMap<String, f64>,
}

impl Locals {
    /// Those of a call with these values.
    pub(super) fn of(given: &[f64]) -> Self {
        let numbered = (1..).zip(given.iter().copied()).collect();
        Self { numbered, named: BTreeMap::new() }
    }
}

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

    /// One value: a number, a variable, a function, or an expression in brackets, with a sign.
    ///
    /// # Errors
    /// At the place that is no value, or a variable without one.
    pub(super) fn value(&mut self) -> Result<f64, WordFault> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.fault("brackets within each other, fifty at most"));
        }
        self.skip_blanks();
        let start = self.at;
        let value = if self.take("-") {
            -self.value()?
        } else if self.take("+") {
            self.value()?
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
                    let expected = "this variable has no value here: set it before";
                    return Err(WordFault { at: start, found, expected: expected.into() });
                }
            }
        } else if let Some(number) = self.number() {
            number
        } else {
            self.function()?
        };
        self.depth -= 1;
        self.finite(start, value + 0.0)
    }

    fn bracketed(&mut self, close: &str) -> Result<f64, WordFault> {
        let value = self.expression()?;
        if self.take(close) {
            Ok(value)
        } else {
            Err(self.fault(&format!("the bracket closes with {close}")))
        }
    }

    /// Values joined by operators.
    ///
    /// # Errors
    /// See [`Self::value`].
    pub(super) fn expression(&mut self) -> Result<f64, WordFault> {
        self.joined(0)
    }

    /// Values joined by the operators of a level and of the tighter ones.
    fn joined(&mut self, level: usize) -> Result<f64, WordFault> {
        let Some(operators) = LEVELS.get(level) else { return self.value() };
        let mut value = self.joined(level + 1)?;
        'next: loop {
            for (sign, operator) in *operators {
                let before = self.at;
                // A single star is not the start of a double one.
                if self.take(sign) && !(*sign == "*" && self.rest().starts_with('*')) {
                    let start = self.at;
                    let other = self.joined(level + 1)?;
                    value = self.finite(start, operator(value, other))?;
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
                    return Err(self.fault("the value of a function stands in brackets"));
                }
                let value = self.bracketed(close)?;
                // LinuxCNC rounds down and up, the others toward zero and away from it.
                return Ok(match (name, self.variables.is_linuxcnc) {
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
                return Err(self.fault("the value of a function stands in brackets"));
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
                return Ok(math::atan2(y, x) / DEG);
            }
            self.at = before;
            return Ok(math::atan2(y, x) / DEG);
        }
        self.at = start;
        Err(self.fault("a number, a variable (#5, #<name>) or an expression in brackets"))
    }
}

type Operator = fn(f64, f64) -> f64;
type Function = fn(f64) -> f64;

fn truth(holds: bool) -> f64 {
    f64::from(u8::from(holds))
}

fn is_true(value: f64) -> bool {
    value != 0.0
}

/// Operators by how loosely they bind.
const LEVELS: [&[(&str, Operator)]; 5] = [
    &[
        ("AND", |a, b| truth(is_true(a) && is_true(b))),
        ("OR", |a, b| truth(is_true(a) || is_true(b))),
        ("XOR", |a, b| truth(is_true(a) != is_true(b))),
    ],
    &[
        ("EQ", |a, b| truth(a == b)),
        ("NE", |a, b| truth(a != b)),
        ("GE", |a, b| truth(a >= b)),
        ("GT", |a, b| truth(a > b)),
        ("LE", |a, b| truth(a <= b)),
        ("LT", |a, b| truth(a < b)),
        ("==", |a, b| truth(a == b)),
        ("<>", |a, b| truth(a != b)),
        (">=", |a, b| truth(a >= b)),
        ("<=", |a, b| truth(a <= b)),
        (">", |a, b| truth(a > b)),
        ("<", |a, b| truth(a < b)),
    ],
    &[("+", |a, b| a + b), ("-", |a, b| a - b)],
    &[("*", |a, b| a * b), ("/", |a, b| a / b), ("MOD", |a, b| a - b * (a / b).floor())],
    &[("**", math::pow)],
];

/// Functions of one value; angles in degrees.
const FUNCTIONS: [(&str, Function); 12] = [
    ("ABS", f64::abs),
    ("SQRT", f64::sqrt),
    ("SIN", |a| math::sin(a * DEG)),
    ("COS", |a| math::cos(a * DEG)),
    ("TAN", |a| math::tan(a * DEG)),
    ("ASIN", |a| math::atan2(a, (1.0 - a * a).sqrt()) / DEG),
    ("ACOS", |a| math::acos(a) / DEG),
    ("ROUND", f64::round),
    ("FIX", f64::floor),
    ("FUP", f64::ceil),
    ("EXP", math::exp),
    ("LN", math::ln),
];

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Result<f64, String> {
        let mut variables = Variables::default();
        variables.set(Variable::Numbered(1), 3.0);
        variables.set(Variable::Numbered(3), 7.0);
        variables.set(Variable::Named("depth".into()), -2.5);
        variables.set(Variable::Arithmetic(10), 4.0);
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
