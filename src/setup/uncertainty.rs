//! From the job's `uncertainty`, or what the library says of robot and material, to the spreads of
//! the inputs.

use crate::error::Error;
use crate::job::{self, Choice};
use crate::setup::ResolvedMaterial;
use crate::spread::{InputSpread, Spreads, Stiffness};

/// 95 % range of numbers that the job gives itself [%]: cutting forces lie within 20 % of those from
/// coefficients identified on the machine (Bhattacharyya, Schueller, Mann, Schmitz, Gomez, ASME
/// MSEC2009). Joint stiffness that was identified from loaded poses is assumed to be as good.
const OWN: f64 = 20.0;

/// The spreads of a job; `stiffness` is what the library says of the robot's.
pub(super) fn spreads(
    given: &job::Uncertainty,
    compliance: &[f64; 6],
    stiffness: Option<[InputSpread; 6]>,
    material: &ResolvedMaterial,
) -> Result<Spreads, Error> {
    let job::Uncertainty { stiffness_percent, stiffness_factor, compliance_covariance, .. } = given;
    let ways = [
        ("stiffness_percent", matches!(stiffness_percent, Choice::Value(..))),
        ("stiffness_factor", stiffness_factor.is_some()),
        ("compliance_covariance", compliance_covariance.is_some()),
    ];
    if let Some((second, _)) = ways.into_iter().filter(|(_, given)| *given).nth(1) {
        return Err(Error::invalid(
            format!("uncertainty.{second}"),
            "given with another spread of the stiffness",
            "give one of stiffness_percent, stiffness_factor and compliance_covariance",
        ));
    }
    let stiffness = if let Choice::Value(percent, _) = stiffness_percent {
        Stiffness::Each([InputSpread::percent(*percent); 6])
    } else if let Some(factor) = stiffness_factor {
        Stiffness::Each([InputSpread::factor(*factor); 6])
    } else if let Some(covariance) = compliance_covariance {
        together(compliance, covariance)?
    } else {
        Stiffness::Each(stiffness.unwrap_or([InputSpread::percent(OWN); 6]))
    };
    let cutting = InputSpread::percent(match given.cutting_percent {
        Choice::Value(percent, _) => percent,
        Choice::Word => material.material.map_or(OWN, |material| material.spread),
    });
    Ok(Spreads {
        stiffness,
        cutting,
        ratios: cutting,
        frequency: InputSpread::percent(given.frequency_percent),
        draws: given.draws as usize,
        seed: u64::from(given.seed),
        together: None,
    })
}

/// Compliances from one fit.
fn together(compliance: &[f64; 6], covariance: &[[f64; 6]; 6]) -> Result<Stiffness, Error> {
    let field = "uncertainty.compliance_covariance";
    for (i, row) in covariance.iter().enumerate() {
        for (j, value) in row.iter().enumerate().take(i) {
            if *value != covariance[j][i] {
                let expected = format!("the same number as in row {}, column {}", j + 1, i + 1);
                return Err(Error::invalid(format!("{field}[{i}][{j}]"), value, expected));
            }
        }
    }
    // Beyond that, a lognormal has its mass near zero: the compliance is not known at all.
    for (i, compliance) in compliance.iter().enumerate() {
        let deviation = covariance[i][i].max(0.0).sqrt();
        if *compliance > 0.0 && deviation > *compliance {
            let value = format!("a standard deviation of {:.2} times the compliance", deviation / compliance);
            let expected = "at most 1: measure this joint, or give stiffness_factor";
            return Err(Error::invalid(format!("{field}[{i}][{i}]"), value, expected));
        }
    }
    Stiffness::together(compliance, covariance).ok_or_else(|| {
        let expected =
            "six rows of six numbers in (rad/(N m))², positive semidefinite, zero for rigid joints";
        Error::invalid(field, "not the covariance of these joint compliances", expected)
    })
}
