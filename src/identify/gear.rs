//! Spring, delay and hysteresis of a joint, from its angles at the motor and behind the gear.
//!
//! While the arm moves, the two differ by what the gear gives way under the load, and by less than that:
//!
//! ```text
//! q_motor - q_load = c + tau / k + T dq_motor/dt + h sign(dq_motor/dt)
//! ```
//!
//! with the torque tau that a model of the arm puts on the joint, the stiffness k, the delay T between the two readings, half the
//! width h of the hysteresis, and the offset c of the encoders. Least squares over all samples. Neighboring samples err
//! alike, so the intervals come from leaving out one block of half a second after the other (M. Quenouille,
//! Biometrika 43 (1956), 353, the jackknife; H. Kuensch, Ann. Statist. 17 (1989), 1217, for blocks).

use crate::error::Error;
use crate::identify::least_squares::LeastSquares;
use crate::identify::student::quantile_975;
use crate::identify::table::Table;
use crate::math;
use crate::spread::{COVERAGE, Stiffness};
use crate::units::DEG;
use nalgebra::Vector4;

/// JSON path of the text, for errors.
const FIELD: &str = "gear";
/// Length of a block [s].
const BLOCK: f64 = 0.5;
/// Speeds below this share of the largest have no direction.
const SLOW: f64 = 1e-3;
/// What is read, for errors.
const KNOWN: &str = "time_s, and of one joint or several motor_side_q3_deg, load_side_q3_deg and model_load_3_nm; reference and torque \
                     columns are passed over";

/// A joint's angles at motor and load over time.
#[derive(Debug, Clone, PartialEq)]
pub struct GearLog {
    /// The joint, from 0.
    pub joint: usize,
    /// Times [s], rising.
    pub time: Vec<f64>,
    /// Angle at the motor, counted behind the gear's ratio [rad].
    pub motor: Vec<f64>,
    /// Angle behind the gear [rad].
    pub load: Vec<f64>,
    /// Torque of a model on the joint [N m].
    pub torque: Vec<f64>,
}

/// A column of the text.
#[derive(Debug, Clone, Copy, PartialEq)]
enum GearColumn {
    Time(f64),
    Motor(usize, f64),
    Load(usize, f64),
    Torque(usize),
    Other,
}

fn named(words: &[String]) -> Option<GearColumn> {
    let unit = match words.last().map(String::as_str) {
        Some("rad") => 1.0,
        Some("ms") => 1e-3,
        Some("deg" | "s" | "nm") | None => 0.0,
        Some(_) => -1.0,
    };
    let bare = words[..words.len() - usize::from(unit >= 0.0)].concat();
    let angle = if unit == 1.0 { 1.0 } else { DEG };
    if ["time", "t"].contains(&bare.as_str()) {
        return Some(GearColumn::Time(if unit == 1e-3 { unit } else { 1.0 }));
    }
    let joint = bare.chars().last()?.to_digit(10).filter(|joint| (1..=6).contains(joint))? as usize - 1;
    match &bare[..bare.len() - 1] {
        "motorsideq" | "motorq" | "motor" => Some(GearColumn::Motor(joint, angle)),
        "loadsideq" | "loadq" | "load" => Some(GearColumn::Load(joint, angle)),
        "modelload" | "loadtorque" => Some(GearColumn::Torque(joint)),
        "referenceq" | "reference" | "torque" => Some(GearColumn::Other),
        _ => None,
    }
}

/// Reads a text: one log for each joint that has all three columns.
///
/// # Errors
/// [`Error::Text`] with line and column of what cannot be read.
pub fn read(text: &str) -> Result<Vec<GearLog>, Error> {
    read_as(text, FIELD)
}

/// The same for the text of a field of another name.
///
/// # Errors
/// See [`read`].
pub fn read_as(text: &str, field: &'static str) -> Result<Vec<GearLog>, Error> {
    let table = Table::read(text, field)?;
    if table.names.is_empty() {
        return Err(table.end_error("a text without a header", KNOWN));
    }
    let columns = table
        .names
        .iter()
        .enumerate()
        .map(|(index, words)| named(words).ok_or_else(|| table.name_error(index, KNOWN)))
        .collect::<Result<Vec<_>, Error>>()?;
    let time = columns.iter().position(|column| matches!(column, GearColumn::Time(_)));
    let Some(time) = time else { return Err(table.name_error(0, KNOWN)) };
    let values = |cell: usize, unit: f64| {
        let value = |row: usize| {
            let value = table.row(row)[cell];
            if value.is_finite() { Ok(value * unit) } else { Err(table.cell_error(row, cell, "a number")) }
        };
        (0..table.len()).map(value).collect::<Result<Vec<f64>, Error>>()
    };
    let seconds = match columns[time] {
        GearColumn::Time(unit) => values(time, unit)?,
        _ => vec![],
    };
    if let Some(row) = seconds.windows(2).position(|pair| pair[1] <= pair[0]) {
        return Err(table.cell_error(row + 1, time, "times must increase from row to row"));
    }
    if seconds.last().zip(seconds.first()).is_none_or(|(last, first)| last - first < 4.0 * BLOCK) {
        return Err(table.end_error("a short text", "at least two seconds"));
    }
    let mut logs = Vec::new();
    for joint in 0..6 {
        let find = |wanted: fn(GearColumn) -> Option<(usize, f64)>| {
            let of = |(cell, column): (usize, &GearColumn)| {
                wanted(*column).filter(|(own, _)| *own == joint).map(|(_, unit)| (cell, unit))
            };
            columns.iter().enumerate().find_map(of)
        };
        let motor =
            find(
                |column| if let GearColumn::Motor(joint, unit) = column { Some((joint, unit)) } else { None },
            );
        let load = find(
            |column| if let GearColumn::Load(joint, unit) = column { Some((joint, unit)) } else { None },
        );
        let torque =
            find(|column| if let GearColumn::Torque(joint) = column { Some((joint, 1.0)) } else { None });
        let (Some(motor), Some(load), Some(torque)) = (motor, load, torque) else { continue };
        let read = |(cell, unit): (usize, f64)| values(cell, unit);
        logs.push(GearLog {
            joint,
            time: seconds.clone(),
            motor: read(motor)?,
            load: read(load)?,
            torque: read(torque)?,
        });
    }
    if logs.is_empty() { Err(table.name_error(0, KNOWN)) } else { Ok(logs) }
}

/// A joint's gear.
#[derive(Debug, Clone, PartialEq)]
pub struct Gear {
    /// The joint, from 0.
    pub joint: usize,
    /// c [rad], 1/k [rad/(N m)], T [s], h [rad].
    pub values: Vector4<f64>,
    /// Half the width of the 95 % interval of each.
    pub halves: Vector4<f64>,
    /// Share of the variance that is explained.
    pub explained: f64,
    /// Root mean square of the rest [rad].
    pub rest: f64,
    /// Number of blocks.
    pub blocks: usize,
}

impl GearLog {
    /// The four columns that are fitted, and the difference of the angles [rad].
    fn rows(&self) -> Vec<(Vector4<f64>, f64)> {
        let count = self.time.len();
        let speed: Vec<f64> = (0..count)
            .map(|k| {
                let (before, after) = (k.saturating_sub(1), (k + 1).min(count - 1));
                (self.motor[after] - self.motor[before]) / (self.time[after] - self.time[before])
            })
            .collect();
        let most = speed.iter().fold(0.0, |most: f64, speed| most.max(speed.abs()));
        let sign = |speed: f64| if speed.abs() <= SLOW * most { 0.0 } else { speed.signum() };
        let row = |k: usize| {
            (Vector4::new(1.0, self.torque[k], speed[k], sign(speed[k])), self.motor[k] - self.load[k])
        };
        (0..count).map(row).collect()
    }

    /// Fits its gear.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the joint hardly moves, or its load does not change.
    pub fn fit(&self) -> Result<Gear, Error> {
        let rows = self.rows();
        let vague = || {
            let value = format!("joint {} at rest, or under a steady load", self.joint + 1);
            Error::invalid(FIELD, value, "a joint that moves both ways while its load changes")
        };
        let values = LeastSquares::of(rows.iter().copied()).ok_or_else(vague)?.values;
        let begins = self.time[0];
        let of = |k: usize| ((self.time[k] - begins) / BLOCK) as usize;
        let blocks = of(self.time.len() - 1) + 1;
        let mut without = Vec::with_capacity(blocks);
        for block in 0..blocks {
            let kept = rows.iter().enumerate().filter(|(k, _)| of(*k) != block).map(|(_, row)| *row);
            without.push(LeastSquares::of(kept).ok_or_else(vague)?.values);
        }
        let mean = without.iter().sum::<Vector4<f64>>() / blocks as f64;
        let squares = without.iter().map(|value| (value - mean).component_mul(&(value - mean)));
        let variance = squares.sum::<Vector4<f64>>() * ((blocks - 1) as f64 / blocks as f64);
        let halves = variance.map(|variance| quantile_975(blocks - 1) * variance.sqrt());
        let (explained, rest) = judged(&rows, &values, false);
        Ok(Gear { joint: self.joint, values, halves, explained, rest, blocks })
    }
}

impl Gear {
    /// Stiffness [N m/rad]; `None` if the load did not show it.
    pub fn stiffness(&self) -> Option<f64> {
        self.is_seen().then(|| 1.0 / self.values[1])
    }

    /// Its 95 % interval [N m/rad].
    pub fn stiffness_interval(&self) -> Option<[f64; 2]> {
        let [soft, stiff] = [self.values[1] + self.halves[1], self.values[1] - self.halves[1]];
        self.is_seen().then(|| [1.0 / soft, 1.0 / stiff])
    }

    fn is_seen(&self) -> bool {
        self.values[1] - self.halves[1] > 0.0
    }

    /// Another log, predicted with what was found: share of its variance that is explained, and root mean square of the rest
    /// [rad]. The offset of the encoders is the other log's own.
    pub fn predicts(&self, other: &GearLog) -> (f64, f64) {
        judged(&other.rows(), &self.values, true)
    }

    /// The difference of a log's angles at each instant, measured and by what was found, both without the log's own offset
    /// [rad].
    pub fn beside(&self, log: &GearLog) -> Vec<[f64; 2]> {
        let rows = log.rows();
        let by_gear: Vec<f64> = rows.iter().map(|(row, _)| row.dot(&self.values) - self.values[0]).collect();
        let offset =
            rows.iter().zip(&by_gear).map(|((_, value), own)| value - own).sum::<f64>() / rows.len() as f64;
        rows.iter().zip(by_gear).map(|((_, value), own)| [value - offset, own]).collect()
    }
}

/// Share of the variance that values explain, and root mean square of the rest.
fn judged(rows: &[(Vector4<f64>, f64)], values: &Vector4<f64>, own_offset: bool) -> (f64, f64) {
    let count = rows.len() as f64;
    let rests: Vec<f64> = rows.iter().map(|(row, value)| value - row.dot(values)).collect();
    let offset = if own_offset { rests.iter().sum::<f64>() / count } else { 0.0 };
    let mean = rows.iter().map(|(_, value)| value).sum::<f64>() / count;
    let whole: f64 = rows.iter().map(|(_, value)| (value - mean).powi(2)).sum();
    let left: f64 = rests.iter().map(|rest| (rest - offset).powi(2)).sum();
    (1.0 - left / whole, (left / count).sqrt())
}

/// Compliances of an arm one of whose gears was measured.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct MeasuredJoint {
    /// Those of all six joints [rad/(N m)].
    pub joint_compliance_rad_per_nm: [f64; 6],
    /// Their covariance [(rad/(N m))^2], for a job's `uncertainty.compliance_covariance`.
    pub compliance_covariance: [[f64; 6]; 6],
}

impl Gear {
    /// An arm with this gear: `compliance` [rad/(N m)] and `spread` are those of the arm before. The measured joint varies by
    /// its own interval, the others as before. `None` if the load did not show the spring.
    pub fn in_arm(&self, compliance: &[f64; 6], spread: &Stiffness) -> Option<MeasuredJoint> {
        self.stiffness()?;
        let mut joint_compliance_rad_per_nm = *compliance;
        joint_compliance_rad_per_nm[self.joint] = self.values[1];
        let own = (self.halves[1] / COVERAGE).powi(2);
        let logarithms = spread.covariance();
        let compliance_covariance = std::array::from_fn(|i| {
            std::array::from_fn(|j| match (i == self.joint, j == self.joint) {
                (true, true) => own,
                (false, false) => compliance[i] * compliance[j] * (math::exp(logarithms[(i, j)]) - 1.0),
                _ => 0.0,
            })
        });
        Some(MeasuredJoint { joint_compliance_rad_per_nm, compliance_covariance })
    }
}

/// A gear to be read.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct GearSummary {
    /// Number of the joint, from 1.
    pub joint: usize,
    /// Stiffness [N m/rad]; absent if the load did not show it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_nm_per_rad: Option<f64>,
    /// Its 95 % interval.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_interval_nm_per_rad: Option<[f64; 2]>,
    /// Delay between the two readings [ms], and its 95 % interval.
    pub delay_ms: f64,
    /// See there.
    pub delay_interval_ms: [f64; 2],
    /// Half the width of the hysteresis [urad], and its 95 % interval.
    pub hysteresis_urad: f64,
    /// See there.
    pub hysteresis_interval_urad: [f64; 2],
    /// Share of the variance that is explained.
    pub explained: f64,
    /// Root mean square of what no spring explains [urad].
    pub rest_urad: f64,
    /// Number of blocks behind the intervals.
    pub blocks: usize,
    /// Another run, predicted with this: share of its variance, and root mean square of the rest [urad].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub predicted: Option<PredictedRun>,
    /// All this in words.
    pub sentence: String,
}

/// A run that was not fitted.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct PredictedRun {
    /// Share of its variance.
    pub explained: f64,
    /// Root mean square of the rest [urad].
    pub rest_urad: f64,
}

/// Microradians.
const MICRO: f64 = 1e-6;

impl Gear {
    /// In numbers and words, with another run if there is one.
    pub fn summary(&self, other: Option<&GearLog>) -> GearSummary {
        let interval = |index: usize, unit: f64| {
            [-1.0, 1.0].map(|side| (self.values[index] + side * self.halves[index]) / unit)
        };
        let predicted = other.map(|other| {
            let (explained, rest) = self.predicts(other);
            PredictedRun { explained, rest_urad: rest / MICRO }
        });
        GearSummary {
            joint: self.joint + 1,
            stiffness_nm_per_rad: self.stiffness(),
            stiffness_interval_nm_per_rad: self.stiffness_interval(),
            delay_ms: self.values[2] / 1e-3,
            delay_interval_ms: interval(2, 1e-3),
            hysteresis_urad: self.values[3] / MICRO,
            hysteresis_interval_urad: interval(3, MICRO),
            explained: self.explained,
            rest_urad: self.rest / MICRO,
            blocks: self.blocks,
            sentence: self.sentence(predicted),
            predicted,
        }
    }

    fn sentence(&self, predicted: Option<PredictedRun>) -> String {
        let joint = self.joint + 1;
        let spring = match self.stiffness().zip(self.stiffness_interval()) {
            Some((stiffness, [low, high])) => format!(
                "Joint {joint} has {:.2}e6 N m/rad ({:.2} to {:.2})",
                stiffness / 1e6,
                low / 1e6,
                high / 1e6
            ),
            None => format!("The load hardly turned joint {joint}: its stiffness does not show"),
        };
        let other = predicted.map_or(String::new(), |other| {
            format!(
                " Of the other run, {:.1} % are predicted, {:.0} µrad are left.",
                100.0 * other.explained,
                other.rest_urad
            )
        });
        format!(
            "{spring}; load follows motor by {:.1} ms, and lags by {:.0} µrad to each side. {:.1} % of the difference is explained; \
             {:.0} µrad (root mean square) no spring explains.{other}",
            self.values[2] / 1e-3,
            self.values[3] / MICRO,
            100.0 * self.explained,
            self.rest / MICRO
        )
    }
}
