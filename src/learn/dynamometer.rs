//! Cutting coefficients from a dynamometer: a straight line through the mean forces over the feed per tooth.
//!
//! The mean force over a revolution is linear in the feed per tooth and in the six coefficients
//! ([`Cut::mean_force`], eqs. 4.6, 4.7; the method is E. Budak, Y. Altintas, E. Armarego, J. Eng. Ind. 118 (1996), and
//! Altintas, Manufacturing Automation, 2nd ed. 2012, section 2.8). Tangential and radial ones follow from the two components
//! in the plane of the cut together, axial ones from the third, each by least squares with intervals by Student's t.

use crate::cutting::{Coefficients, Cut};
use crate::error::Error;
use crate::identify::least_squares::LeastSquares;
use crate::identify::student::quantile_975;
use crate::identify::table::Table;
use crate::units::{MM, N_PER_MM, N_PER_MM2};
use nalgebra::{SVector, Vector3};

/// JSON path of the text, for errors.
const FIELD: &str = "cuts";

/// A cut with its mean force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredCut {
    /// Feed per tooth [m].
    pub chip: f64,
    /// Axial depth [m]; that of the job if it is not given.
    pub axial_depth: Option<f64>,
    /// Mean force on the tool in {T} [N].
    pub force: Vector3<f64>,
    /// Largest resultant of a revolution [N], if it was read.
    pub peak: Option<f64>,
}

/// A coefficient, in N/mm^2 or N/mm, with its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct FittedCoefficient {
    /// Its key in a job's material.
    pub key: &'static str,
    /// The value.
    pub value: f64,
    /// Both ends; absent where the cuts are as many as the coefficients.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interval: Option<[f64; 2]>,
}

/// What the cuts say.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct FittedCut {
    /// ktc, krc, kac, kte, kre, kae.
    pub coefficients: [FittedCoefficient; 6],
    /// Share of the variance of each component about its mean that the lines explain.
    pub r_squared: [f64; 3],
    /// Peaks, as measured by as computed with the coefficients: the mean ratio, and the largest miss [%].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_check: Option<PeakCheck>,
    /// Number of cuts.
    pub cuts: usize,
    /// What is odd.
    pub remarks: Vec<String>,
}

/// Peaks against those that the coefficients give.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct PeakCheck {
    /// Mean of computed by measured peak.
    pub ratio: f64,
    /// The largest difference [%].
    pub worst_percent: f64,
}

const KEYS: [&str; 6] = ["ktc_n_mm2", "krc_n_mm2", "kac_n_mm2", "kte_n_mm", "kre_n_mm", "kae_n_mm"];

/// Reads cuts: `feed_per_tooth_mm` (or `fz_mm`), `fx_n`, `fy_n`, `fz_n` with the force on the tool in {T} (x feed, y to its left,
/// z from tip to spindle), and, if they are known, `axial_depth_mm` and `peak_n`.
///
/// # Errors
/// [`Error::Text`] with line and column.
pub fn read(text: &str) -> Result<Vec<MeasuredCut>, Error> {
    let table = Table::read(text, FIELD)?;
    let find = |names: &[&str]| table.names.iter().position(|words| names.contains(&words.concat().as_str()));
    let chip = find(&["feedpertoothmm", "feedpertooth", "fzmm"]);
    let forces = [find(&["fxn", "fx"]), find(&["fyn", "fy"]), find(&["fzn", "fz"])];
    let (Some(chip), [Some(x), Some(y), Some(z)]) = (chip, forces) else {
        let expected = "a header with feed_per_tooth_mm, fx_n, fy_n, fz_n and, if they are known, axial_depth_mm, peak_n";
        return Err(table.end_error("a text without these columns", expected));
    };
    let (depth, peak) = (find(&["axialdepthmm", "axialdepth"]), find(&["peakn", "peak"]));
    let known = [Some(chip), Some(x), Some(y), Some(z), depth, peak];
    if let Some(other) = (0..table.width).find(|cell| !known.contains(&Some(*cell))) {
        return Err(table.name_error(other, "feed_per_tooth_mm, fx_n, fy_n, fz_n, axial_depth_mm or peak_n"));
    }
    let number = |row: usize, cell: usize, least: f64, expected: &str| {
        let value = table.row(row)[cell];
        if value.is_finite() && value > least {
            Ok(value)
        } else {
            Err(table.cell_error(row, cell, expected))
        }
    };
    let cut = |row: usize| {
        let force = |cell| number(row, cell, f64::NEG_INFINITY, "a force in N");
        Ok(MeasuredCut {
            chip: number(row, chip, 0.0, "a feed per tooth above 0 mm")? * MM,
            axial_depth: match depth {
                Some(cell) => Some(number(row, cell, 0.0, "a depth above 0 mm")? * MM),
                None => None,
            },
            force: Vector3::new(force(x)?, force(y)?, force(z)?),
            peak: match peak.filter(|cell| !table.row(row)[*cell].is_nan()) {
                Some(cell) => Some(number(row, cell, 0.0, "a force above 0 N")?),
                None => None,
            },
        })
    };
    let cuts = (0..table.len()).map(cut).collect::<Result<Vec<_>, Error>>()?;
    let first = cuts.first().map(|cut| cut.chip);
    if cuts.iter().all(|cut| Some(cut.chip) == first) {
        let expected =
            "cuts with at least two feeds per tooth: cutting and edge coefficients differ in nothing else";
        return Err(table.end_error("one feed per tooth", expected));
    }
    Ok(cuts)
}

/// Mean force by each coefficient of 1 N/m^2 or 1 N/m at the feed per tooth of a cut.
fn by_coefficient(cut: &Cut, measured: &MeasuredCut) -> [Vector3<f64>; 6] {
    let none = Coefficients::default();
    let units = [
        Coefficients { ktc: 1.0, ..none },
        Coefficients { krc: 1.0, ..none },
        Coefficients { kac: 1.0, ..none },
        Coefficients { kte: 1.0, ..none },
        Coefficients { kre: 1.0, ..none },
        Coefficients { kae: 1.0, ..none },
    ];
    let axial_depth = measured.axial_depth.unwrap_or(cut.axial_depth);
    units.map(|coefficients| Cut { coefficients, axial_depth, ..*cut }.mean_force().at(measured.chip))
}

/// Fits the six coefficients to cuts with the tool and the engagement of `cut`.
///
/// # Errors
/// [`Error::Invalid`] if the cuts do not determine them.
pub fn fit(cut: &Cut, cuts: &[MeasuredCut]) -> Result<FittedCut, Error> {
    let rows: Vec<([Vector3<f64>; 6], Vector3<f64>)> =
        cuts.iter().map(|measured| (by_coefficient(cut, measured), measured.force)).collect();
    let vague = || {
        Error::invalid(
            FIELD,
            "forces that do not determine the coefficients",
            "other feeds, depths or engagements",
        )
    };
    let plane = least_squares::<4>(&rows, [0, 1, 3, 4], &[0, 1]).ok_or_else(vague)?;
    let axial = least_squares::<2>(&rows, [2, 5], &[2]).ok_or_else(vague)?;
    let si = [plane.0[0], plane.0[1], axial.0[0], plane.0[2], plane.0[3], axial.0[1]];
    let half = [&plane.1[0], &plane.1[1], &axial.1[0], &plane.1[2], &plane.1[3], &axial.1[1]];
    let coefficients = std::array::from_fn(|k| {
        let unit = if k < 3 { N_PER_MM2 } else { N_PER_MM };
        let (value, half) = (si[k] / unit, half[k] / unit);
        let interval = half.is_finite().then_some([value - half, value + half]);
        FittedCoefficient { key: KEYS[k], value, interval }
    });
    let model = |grown: &[Vector3<f64>; 6]| grown.iter().zip(si).map(|(by, k)| by * k).sum::<Vector3<f64>>();
    let mean = cuts.iter().map(|cut| cut.force).sum::<Vector3<f64>>() / cuts.len() as f64;
    let r_squared = std::array::from_fn(|axis| {
        let rest: f64 = rows.iter().map(|(grown, force)| (force - model(grown))[axis].powi(2)).sum();
        let whole: f64 = rows.iter().map(|(_, force)| (force - mean)[axis].powi(2)).sum();
        if whole > 0.0 { 1.0 - rest / whole } else { 1.0 }
    });
    let [ktc, krc, kac, kte, kre, kae] = si;
    let fitted = Coefficients { ktc, krc, kac, kte, kre, kae };
    let mut remarks = Vec::new();
    if ktc <= 0.0 {
        remarks.push("ktc is not above 0: is it the force on the workpiece, or are axes swapped?".to_owned());
    }
    let below: Vec<&str> = (0..6).filter(|k| *k > 0 && si[*k] < 0.0).map(|k| KEYS[k]).collect();
    if !below.is_empty() {
        remarks.push(format!(
            "below 0: {}; a worn or a sharp edge, drift of the zero, or another sign of that axis",
            below.join(", ")
        ));
    }
    Ok(FittedCut {
        coefficients,
        r_squared,
        peak_check: peaks(cut, &fitted, cuts),
        cuts: cuts.len(),
        remarks,
    })
}

/// Values and half 95 % intervals of some coefficients, fitted to some components.
fn least_squares<const N: usize>(
    rows: &[([Vector3<f64>; 6], Vector3<f64>)],
    which: [usize; N],
    axes: &[usize],
) -> Option<([f64; N], [f64; N])> {
    let each = || {
        let of = |(grown, force): &([Vector3<f64>; 6], Vector3<f64>), axis: usize| {
            (SVector::<f64, N>::from_fn(|i, _| grown[which[i]][axis]), force[axis])
        };
        rows.iter().flat_map(move |row| axes.iter().map(move |axis| of(row, *axis)))
    };
    let LeastSquares { values, inverse } = LeastSquares::of(each())?;
    let rest: f64 = each().map(|(grown, force)| (force - grown.dot(&values)).powi(2)).sum();
    let freedom = (rows.len() * axes.len()).saturating_sub(N);
    let deviation = (rest / freedom.max(1) as f64).sqrt();
    let half = |i: usize| match freedom {
        0 => f64::INFINITY,
        freedom => quantile_975(freedom) * deviation * inverse[(i, i)].max(0.0).sqrt(),
    };
    Some((values.into(), std::array::from_fn(half)))
}

fn peaks(cut: &Cut, coefficients: &Coefficients, cuts: &[MeasuredCut]) -> Option<PeakCheck> {
    let ratio = |measured: &MeasuredCut| {
        let axial_depth = measured.axial_depth.unwrap_or(cut.axial_depth);
        let computed = Cut { coefficients: *coefficients, axial_depth, ..*cut }.peak_force(measured.chip);
        Some(computed / measured.peak?)
    };
    let ratios: Vec<f64> = cuts.iter().filter_map(ratio).collect();
    if ratios.is_empty() {
        return None;
    }
    Some(PeakCheck {
        ratio: ratios.iter().sum::<f64>() / ratios.len() as f64,
        worst_percent: ratios.iter().map(|ratio| 100.0 * (ratio - 1.0).abs()).fold(0.0, f64::max),
    })
}
