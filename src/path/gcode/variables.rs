//! The values of a program's variables.

use super::dialect::GcodeDialect;
use std::cell::Cell;
use std::collections::BTreeMap;

/// A number, or none: what Fanuc calls vacant.
pub(super) type Operand = Option<f64>;

/// Local variables of a Fanuc macro: #1 to #33.
const FANUC_LOCALS: u32 = 33;
/// Those of a subprogram of LinuxCNC: #1 to #30.
const LINUXCNC_LOCALS: u32 = 30;

/// The values of a program's variables.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Variables {
    /// By `#` and a number.
    numbered: BTreeMap<u32, Operand>,
    /// By `#<name>`, lower case.
    named: BTreeMap<String, Operand>,
    /// `R` and a number (Siemens).
    arithmetic: BTreeMap<u32, Operand>,
    /// Whose rules hold.
    pub(super) dialect: GcodeDialect,
    /// Values set in the line being read.
    pending: Vec<(Variable, Operand)>,
    /// Whether a variable without a value was passed over, or counted as 0.
    pub(super) used_vacant: Cell<bool>,
}

/// A variable.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Variable {
    Numbered(u32),
    Named(String),
    Arithmetic(u32),
}

impl Variables {
    /// None set, under the rules of a dialect.
    pub(super) fn of(dialect: GcodeDialect) -> Self {
        Self { dialect, ..Self::default() }
    }

    /// Sets a variable; on LinuxCNC its value holds from the next line on.
    pub(super) fn set(&mut self, variable: Variable, value: Operand) {
        if self.dialect == GcodeDialect::LinuxCnc {
            self.pending.push((variable, value));
        } else {
            self.put(variable, value);
        }
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

    fn put(&mut self, variable: Variable, value: Operand) {
        match variable {
            Variable::Numbered(number) => self.numbered.insert(number, value),
            Variable::Named(name) => self.named.insert(name, value),
            Variable::Arithmetic(number) => self.arithmetic.insert(number, value),
        };
    }

    /// The value of a variable; none at all if it is not known here.
    ///
    /// On a Fanuc, #0 is always vacant, and so are local variables that nothing was given to.
    pub(super) fn get(&self, variable: &Variable) -> Option<Operand> {
        let found = match variable {
            Variable::Numbered(number) => self.numbered.get(number),
            Variable::Named(name) => self.named.get(name),
            Variable::Arithmetic(number) => self.arithmetic.get(number),
        };
        let is_vacant = self.dialect == GcodeDialect::Fanuc
            && matches!(variable, Variable::Numbered(number) if *number <= FANUC_LOCALS);
        found.copied().or(is_vacant.then_some(None))
    }

    fn local_numbers(&self) -> std::ops::RangeInclusive<u32> {
        1..=if self.dialect == GcodeDialect::Fanuc { FANUC_LOCALS } else { LINUXCNC_LOCALS }
    }

    /// The local variables.
    pub(super) fn locals(&self) -> Locals {
        let numbered = self.numbered.range(self.local_numbers());
        let named = self.named.iter().filter(|(name, _)| !name.starts_with('_'));
        Locals {
            numbered: numbered.map(|(number, value)| (*number, *value)).collect(),
            named: named.map(|(name, value)| (name.clone(), *value)).collect(),
        }
    }

    /// Puts local variables in place of those in force.
    pub(super) fn set_locals(&mut self, locals: Locals) {
        let local = self.local_numbers();
        self.numbered.retain(|number, _| !local.contains(number));
        self.numbered.extend(locals.numbered);
        self.named.retain(|name, _| name.starts_with('_'));
        self.named.extend(locals.named);
    }
}

/// Variables that a subprogram of LinuxCNC or a macro of Fanuc has for itself: by number, and names that
/// do not start with an underscore.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Locals {
    numbered: BTreeMap<u32, Operand>,
    named: BTreeMap<String, Operand>,
}

impl Locals {
    /// Those of a call with these values, by number.
    pub(super) fn of(given: impl IntoIterator<Item = (u32, f64)>) -> Self {
        let numbered = given.into_iter().map(|(number, value)| (number, Some(value))).collect();
        Self { numbered, named: BTreeMap::new() }
    }
}
