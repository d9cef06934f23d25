//! What others measured, beside what Armill's model says of it: a loaded arm, encoders behind a gear, and cutting forces.
//!
//! What is predicted was not fitted to the numbers it is compared with: a loaded posture is predicted from the others, a
//! run from another run, forces from coefficients that their authors state. No part milled by a program of Armill has been
//! measured yet.

pub mod encoders;
pub mod loads;
pub mod slots;

pub use encoders::encoders;
pub use loads::loads;
pub use slots::slots;

use serde::Serialize;

/// Measured values beside predicted ones.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Evidence {
    /// Stable slug, that of its chart too.
    pub key: &'static str,
    /// What was measured.
    pub title: &'static str,
    /// How far prediction and measurement agree, and where they do not.
    pub sentence: String,
    /// What the prediction rests on.
    pub rests_on: &'static str,
    /// Who measured, where it is published, and its licence.
    pub source: &'static str,
    /// Headings of the table, the first one of the rows' names.
    pub heads: Vec<&'static str>,
    /// Its rows.
    pub rows: Vec<EvidenceRow>,
    /// What is drawn.
    #[serde(skip)]
    pub drawn: &'static str,
    /// What the curves are drawn over, with its unit.
    #[serde(skip)]
    pub over: (&'static str, &'static str),
    /// What they show, with its unit.
    #[serde(skip)]
    pub shows: (&'static str, &'static str),
    /// Where the curves have values.
    #[serde(skip)]
    pub at: Vec<f64>,
    /// Measured and predicted curves.
    #[serde(skip)]
    pub curves: Vec<EvidenceCurve>,
}

/// One row of the table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EvidenceRow {
    /// What it is about.
    pub name: String,
    /// Its numbers, under the headings.
    pub values: Vec<f64>,
}

/// Values over [`Evidence::at`].
#[derive(Debug, Clone, PartialEq)]
pub struct EvidenceCurve {
    /// Stable slug.
    pub key: &'static str,
    /// Displayed name.
    pub label: &'static str,
    /// Its values.
    pub values: Vec<f64>,
}
