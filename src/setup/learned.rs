//! From the job's `learned` to the arm, the cut and their spreads.

use crate::cutting::Coefficients;
use crate::error::Error;
use crate::job;
use crate::spread::JointSpread;

/// Factors that a measurement may well find.
const RANGE: std::ops::RangeInclusive<f64> = 0.01..=100.0;

/// Checks the factors.
///
/// # Errors
/// [`Error::OutOfRange`] for a factor that no measurement finds.
pub(super) fn checked(learned: &job::Learned) -> Result<(), Error> {
    let named = [
        ("learned.compliance_factors", learned.compliance_factors.as_slice()),
        ("learned.force_factors", learned.force_factors.as_slice()),
    ];
    for (field, factors) in named {
        for (index, &value) in factors.iter().enumerate() {
            if !RANGE.contains(&value) {
                let (min, max) = (*RANGE.start(), *RANGE.end());
                return Err(Error::OutOfRange {
                    field: format!("{field}[{index}]"),
                    value,
                    min,
                    max,
                    unit: "",
                });
            }
        }
    }
    Ok(())
}

/// The coefficients with their factors.
pub(super) fn coefficients(k: &Coefficients, [t, r, a]: &[f64; 3]) -> Coefficients {
    Coefficients {
        ktc: k.ktc * t,
        krc: k.krc * r,
        kac: k.kac * a,
        kte: k.kte * t,
        kre: k.kre * r,
        kae: k.kae * a,
    }
}

/// What is still unknown of the factors.
///
/// # Errors
/// [`Error::Invalid`] if it is no covariance.
pub(super) fn spread(learned: &job::Learned) -> Result<JointSpread, Error> {
    let field = "learned.covariance";
    for (i, row) in learned.covariance.iter().enumerate() {
        for (j, &value) in row.iter().enumerate() {
            if value != learned.covariance[j][i] {
                return Err(Error::invalid(format!("{field}[{i}][{j}]"), value, "a symmetric table"));
            }
        }
    }
    JointSpread::of(&learned.covariance)
        .ok_or_else(|| Error::invalid(field, "given", "a covariance: no combination has a variance below 0"))
}
