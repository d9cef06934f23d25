//! How much a warning matters, usually by its code.

use serde::Serialize;

/// How much a warning matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub enum Severity {
    /// The arm cannot run the command.
    #[serde(rename = "cannot-run")]
    CannotRun,
    /// The figures or the part may be off.
    #[serde(rename = "matters")]
    Matters,
    /// Good to know.
    #[serde(rename = "note")]
    Note,
}

/// Codes of warnings about what the arm cannot run. A singularity and a jump of a joint are among
/// them only where no controller passes them; see `report/singularity.rs`.
const CANNOT_RUN: [&str; 4] = ["joint-limit", "command-acceleration", "joint-speed", "force-payload"];
/// Codes of warnings that are only good to know.
const NOTES: [&str; 21] = [
    "approach-left-out",
    "block-delete",
    "chord",
    "circle-sense",
    "controller-text",
    "default-used",
    "feed-zero",
    "header-unit",
    "home",
    "index-column",
    "inverse-numerical",
    "joint-limit-near",
    "joint-limits-unknown",
    "joint-speeds-unknown",
    "machine-zero",
    "nearly-full-circle",
    "rake-unused",
    "rotary-zero",
    "spin-reference",
    "text-after-end",
    "tool-length-kept",
];

impl Severity {
    /// The severity of a code; one that is not listed matters.
    pub(super) fn of(code: &str) -> Self {
        match code {
            _ if CANNOT_RUN.contains(&code) => Self::CannotRun,
            _ if NOTES.contains(&code) => Self::Note,
            _ => Self::Matters,
        }
    }
}
