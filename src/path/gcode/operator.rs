//! Operators and functions of expressions.

use super::dialect::GcodeDialect;
use super::variables::Operand;
use crate::math;
use crate::units::DEG;

/// What joins two values.
#[derive(Debug, Clone, Copy)]
pub(super) enum Operator {
    /// Of two numbers; a vacant one counts as 0.
    Number(fn(f64, f64) -> f64),
    /// A comparison; a vacant value counts as 0.
    Order(fn(f64, f64) -> bool),
    /// Whether they are equal, or are not; a vacant value equals no number.
    Equal(bool),
    /// AND, OR, XOR: bit by bit.
    Bits(fn(u32, u32) -> u32),
}

/// Operators that bind alike, by their signs.
type OperatorLevel = &'static [(&'static str, Operator)];

const AND: (&str, Operator) = ("AND", Operator::Bits(|a, b| a & b));
const OR: (&str, Operator) = ("OR", Operator::Bits(|a, b| a | b));
const XOR: (&str, Operator) = ("XOR", Operator::Bits(|a, b| a ^ b));
const ADD: (&str, Operator) = ("+", Operator::Number(|a, b| a + b));
const SUBTRACT: (&str, Operator) = ("-", Operator::Number(|a, b| a - b));
const MULTIPLY: (&str, Operator) = ("*", Operator::Number(|a, b| a * b));
const DIVIDE: (&str, Operator) = ("/", Operator::Number(|a, b| a / b));
const MODULO: (&str, Operator) = ("MOD", Operator::Number(|a, b| a - b * (a / b).floor()));
const POWER: (&str, Operator) = ("**", Operator::Number(math::pow));
const COMPARISONS: OperatorLevel = &[
    ("EQ", Operator::Equal(true)),
    ("NE", Operator::Equal(false)),
    ("GE", Operator::Order(|a, b| a >= b)),
    ("GT", Operator::Order(|a, b| a > b)),
    ("LE", Operator::Order(|a, b| a <= b)),
    ("LT", Operator::Order(|a, b| a < b)),
    ("==", Operator::Equal(true)),
    ("<>", Operator::Equal(false)),
    (">=", Operator::Order(|a, b| a >= b)),
    ("<=", Operator::Order(|a, b| a <= b)),
    (">", Operator::Order(|a, b| a > b)),
    ("<", Operator::Order(|a, b| a < b)),
];

/// By how loosely they bind (LinuxCNC, Siemens).
const LEVELS: &[OperatorLevel] =
    &[&[AND, OR, XOR], COMPARISONS, &[ADD, SUBTRACT], &[MULTIPLY, DIVIDE, MODULO], &[POWER]];
/// On a Fanuc, AND binds as a product does, OR and XOR as a sum.
const FANUC_LEVELS: &[OperatorLevel] =
    &[COMPARISONS, &[ADD, SUBTRACT, OR, XOR], &[MULTIPLY, DIVIDE, MODULO, AND], &[POWER]];

/// The operators of a dialect, by how loosely they bind.
pub(super) fn levels(dialect: GcodeDialect) -> &'static [OperatorLevel] {
    if dialect == GcodeDialect::Fanuc { FANUC_LEVELS } else { LEVELS }
}

impl Operator {
    /// Whether it compares.
    pub(super) fn compares(self) -> bool {
        matches!(self, Self::Order(_) | Self::Equal(_))
    }

    /// Joins two values.
    ///
    /// # Errors
    /// Where AND, OR and XOR have no meaning, or not the same one on each control: what would be right.
    pub(super) fn join(self, a: Operand, b: Operand, dialect: GcodeDialect) -> Result<f64, &'static str> {
        let (x, y) = (a.unwrap_or(0.0), b.unwrap_or(0.0));
        let truth = |holds: bool| f64::from(u8::from(holds));
        let bit = |value: f64| u32::from(value != 0.0);
        let is_truth = |value: f64| value == 0.0 || value == 1.0;
        match (self, dialect) {
            (Self::Number(compute), _) => Ok(compute(x, y)),
            (Self::Order(holds), _) => Ok(truth(holds(x, y))),
            (Self::Equal(wanted), _) => Ok(truth((a == b) == wanted)),
            // Comparisons give 0 or 1, whose bits are the truth value.
            (Self::Bits(join), GcodeDialect::Fanuc) => match (whole(x), whole(y)) {
                (Some(a), Some(b)) => Ok(f64::from(join(a, b))),
                _ => Err("AND, OR and XOR join whole numbers of 0 to 4294967295 bit by bit here"),
            },
            (Self::Bits(_), GcodeDialect::Unknown) if !(is_truth(x) && is_truth(y)) => {
                Err("Fanuc joins the bits of such numbers, LinuxCNC asks whether they are 0: \
                 say which by path.dialect, or compare")
            }
            (Self::Bits(join), _) => Ok(f64::from(join(bit(x), bit(y)))),
        }
    }
}

/// A whole number of 32 bits.
fn whole(value: f64) -> Option<u32> {
    (value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value)).then_some(value as u32)
}

type Function = fn(f64) -> f64;

/// Functions of one value; angles in degrees.
pub(super) const FUNCTIONS: [(&str, Function); 12] = [
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
