//! The controller that a program is written for. It decides what several would read differently.

use super::control::control;
use crate::path::builder::LONGEST_WAIT;
use crate::path::lines::TextLines;

/// A controller's way of writing programs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum GcodeDialect {
    /// Fanuc, and Haas, which follows it.
    Fanuc,
    /// LinuxCNC.
    LinuxCnc,
    /// grbl and its relatives.
    Grbl,
    /// Siemens Sinumerik 840D and its relatives.
    Siemens,
    /// Mach3 and Mach4.
    Mach,
    /// None of them is recognised.
    #[default]
    Unknown,
}

/// Words in comments and program names by which a controller is known.
const NAMES: [(&str, GcodeDialect); 14] = [
    ("haas", GcodeDialect::Fanuc),
    ("fanuc", GcodeDialect::Fanuc),
    ("mpfan", GcodeDialect::Fanuc),
    ("linuxcnc", GcodeDialect::LinuxCnc),
    ("emc2", GcodeDialect::LinuxCnc),
    ("grbl", GcodeDialect::Grbl),
    ("carbide create", GcodeDialect::Grbl),
    ("carbide motion", GcodeDialect::Grbl),
    ("carbide 3d", GcodeDialect::Grbl),
    ("openbuilds", GcodeDialect::Grbl),
    ("siemens", GcodeDialect::Siemens),
    ("sinumerik", GcodeDialect::Siemens),
    ("mach3", GcodeDialect::Mach),
    ("mach4", GcodeDialect::Mach),
];
/// Pieces of lines, without blanks, that only one of them writes.
const SIGNS: [(&str, GcodeDialect); 15] = [
    ("%_N_", GcodeDialect::Siemens),
    ("G710", GcodeDialect::Siemens),
    ("CR=", GcodeDialect::Siemens),
    ("MSG(", GcodeDialect::Siemens),
    ("TRAORI", GcodeDialect::Siemens),
    ("SUPA", GcodeDialect::Siemens),
    ("CYCLE8", GcodeDialect::Siemens),
    ("WORKPIECE(", GcodeDialect::Siemens),
    ("T=\"", GcodeDialect::Siemens),
    ("#<", GcodeDialect::LinuxCnc),
    ("O<", GcodeDialect::LinuxCnc),
    ("G187", GcodeDialect::Fanuc),
    ("G05.1", GcodeDialect::Fanuc),
    ("G05P", GcodeDialect::Fanuc),
    ("$H", GcodeDialect::Grbl),
];
/// Lines that are looked at.
const LOOKED_AT: usize = 200;
/// A dwell from which on P without a decimal point is taken to be milliseconds where no controller is
/// recognised.
const MANY: f64 = 100.0;

impl GcodeDialect {
    /// Recognises the controller by what is written in the first lines.
    pub fn of(text: &str) -> Self {
        let mut numbered = false;
        for line in TextLines::of(text).take(LOOKED_AT) {
            let code: String = line.chars().filter(|sign| !sign.is_whitespace()).collect();
            let (upper, lower) = (code.to_ascii_uppercase(), line.to_ascii_lowercase());
            if let Some((_, dialect)) = NAMES.iter().find(|(name, _)| is_named(&lower, name)) {
                return *dialect;
            }
            if control(line).is_some_and(|control| control.is_linuxcnc()) {
                return Self::LinuxCnc;
            }
            let open = upper.split(['(', ';']).next().unwrap_or_default();
            let sign = SIGNS
                .iter()
                .find(|(sign, _)| open.contains(sign) || sign.ends_with('(') && upper.contains(sign));
            if let Some((_, dialect)) = sign {
                return *dialect;
            }
            numbered |= open.len() > 1
                && open.starts_with(['O', ':'])
                && open[1..].bytes().all(|sign| sign.is_ascii_digit());
        }
        if numbered { Self::Fanuc } else { Self::Unknown }
    }

    /// Stable slug.
    pub fn id(self) -> &'static str {
        match self {
            Self::Fanuc => "fanuc",
            Self::LinuxCnc => "linuxcnc",
            Self::Grbl => "grbl",
            Self::Siemens => "siemens",
            Self::Mach => "mach",
            Self::Unknown => "unknown",
        }
    }

    /// Whether the P of a dwell, with the text and value of its word, counts milliseconds.
    ///
    /// Fanuc and Haas count a number without a point in milliseconds, with one in seconds; Mach3
    /// counts milliseconds by default, but its posts write what was set; the others count seconds.
    /// Nothing waits for more than an hour.
    pub(super) fn counts_milliseconds(self, text: &str, value: f64) -> bool {
        let whole = !text.contains('.');
        match self {
            Self::Fanuc => whole,
            Self::LinuxCnc | Self::Grbl | Self::Siemens => value > LONGEST_WAIT,
            Self::Mach | Self::Unknown => value > LONGEST_WAIT || whole && value >= MANY,
        }
    }
}

/// Whether a line, lower case, has a name as a word of its own in a comment or behind a percent sign.
fn is_named(line: &str, name: &str) -> bool {
    line.match_indices(name).any(|(at, _)| {
        let (before, after) = (&line[..at], &line[at + name.len()..]);
        before.contains(['(', ';', '%'])
            && !before.ends_with(char::is_alphanumeric)
            && !after.starts_with(char::is_alphabetic)
    })
}
