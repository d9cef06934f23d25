//! Built-in robots, each with the source of its numbers and how far to trust them. The data are in
//! `library/`.

use crate::error::Error;
use crate::math;
use crate::robot::model::{Elbow, Link};
use crate::robot::{Opw, World};
use crate::spread::InputSpread;
use crate::units::{DEG, MM};

const ROBOTS: &str = include_str!("library/robots.csv");
const ZEROS: &str = include_str!("library/zeros.csv");
const STIFFNESS: &str = include_str!("library/stiffness.csv");
const SOURCES: &str = include_str!("library/sources.txt");

/// Range of a stiffness that was not measured on the joint: a factor of 2.0 as one standard
/// deviation (see [`assumed_compliance`]), so 2.0^1.96 at 95 %.
const NOT_MEASURED: f64 = 3.9;

/// A robot of the library.
#[derive(Debug, Clone, PartialEq)]
pub struct Preset {
    /// Key used in jobs.
    pub id: &'static str,
    /// Manufacturer.
    pub maker: &'static str,
    /// The manufacturer's name for it.
    pub model: &'static str,
    /// Mass at the flange that the maker rates it for [kg].
    pub payload_kg: f64,
    /// Lengths, joint signs and zero offsets.
    pub opw: Opw,
    /// Where joint 3 is measured from.
    pub elbow: Elbow,
    /// Height of the controller's world above the foot of the arm [mm], if known.
    pub world_mm: Option<f64>,
    /// Joint ranges [deg], if known.
    pub joint_limits_deg: Option<[[f64; 2]; 6]>,
    /// Largest joint speeds [deg/s], if known. Those of the drives: joint 3 turns against the upper
    /// arm also where its angle is counted from the base.
    pub joint_speed_deg_s: Option<[f64; 6]>,
    /// Joint compliances [rad/(N m)].
    pub joint_compliance: [f64; 6],
    /// Whether the compliance is only the order-of-magnitude estimate of [`assumed_compliance`].
    pub stiffness_assumed: bool,
    /// Whether each joint's compliance was measured on it.
    pub stiffness_measured: bool,
    /// How well each joint's stiffness is known.
    pub stiffness_spread: [InputSpread; 6],
    /// Where the geometry comes from and how far to trust it.
    pub geometry_note: String,
    /// Where the height of the controller's world is from.
    pub world_source: &'static str,
    /// Where the compliance comes from and how far to trust it.
    pub stiffness_note: String,
    /// The first natural frequency, where it was measured; empty otherwise.
    pub mode_note: String,
}

impl Preset {
    /// Display name.
    pub fn name(&self) -> String {
        format!("{} {}", self.maker, self.model)
    }

    /// Distance of the wrist's centre from axis 1 with the arm stretched [mm], to a millimetre: what
    /// makers call the reach.
    pub fn wrist_reach_mm(&self) -> f64 {
        let [a1, a2, _, _, c2, c3, _] = self.opw.lengths_mm;
        (a1 + c2 + math::hypot(a2, c3)).round()
    }

    /// Where the controller counts from, in SI.
    pub fn world(&self) -> World {
        let at_axis_2 = self.world_mm == Some(self.opw.lengths_mm[3]);
        World { height: self.world_mm.map(|height| height * MM), at_axis_2 }
    }

    /// Where the controller counts from, what that means for a job, and the source.
    pub fn world_note(&self) -> String {
        let (said, source) = (self.world().sentence(), self.world_source);
        match self.world_mm {
            None => format!("{said}."),
            Some(0.0) => format!("{said} ({source})."),
            Some(mm) => format!(
                "{said} ({source}). Positions here are measured from the foot of the arm: with the robot's base \
                 at zero, add {mm} mm to the controller's z. Programs state positions as the controller measures them."
            ),
        }
    }

    /// The modified DH table in SI.
    pub fn links(&self) -> [Link; 6] {
        self.opw.links()
    }

    /// The joint ranges in SI, if known.
    pub fn limits(&self) -> Option<[(f64, f64); 6]> {
        self.joint_limits_deg.map(|ranges| ranges.map(|[low, high]| (low * DEG, high * DEG)))
    }
}

/// Id, maker and model of every robot, in the order of the file.
pub fn names() -> impl Iterator<Item = [&'static str; 3]> {
    rows(ROBOTS).map(|mut row| [row(), row(), row()])
}

/// All robots of the library.
pub fn robots() -> impl Iterator<Item = Preset> {
    rows(ROBOTS).map(preset)
}

/// The robot with this key.
///
/// # Errors
/// [`Error::Invalid`] with the most similar keys; there are too many to list.
pub fn robot(id: &str) -> Result<Preset, Error> {
    if let Some((row, _)) = rows(ROBOTS).zip(names()).find(|(_, [key, ..])| *key == id) {
        return Ok(preset(row));
    }
    let mut keys: Vec<_> = names().map(|[key, ..]| (strsim::jaro_winkler(id, key), key)).collect();
    keys.sort_by(|a, b| b.0.total_cmp(&a.0));
    let like: Vec<_> = keys.iter().take(3).map(|(_, key)| *key).collect();
    let expected = format!("the most similar of the library's {} robots are {}", keys.len(), like.join(", "));
    Err(Error::invalid("robot.preset", format!("\"{id}\""), expected))
}

/// Joint stiffness at [`RULE_PAYLOAD`] [Nm/rad]: geometric means of the measured values in
/// `stiffness.csv`, each scaled to that payload.
pub const RULE_STIFFNESS: [f64; 6] = [2.4e6, 3.3e6, 2.2e6, 4.1e5, 3.4e5, 3.7e5];
/// Payload of [`RULE_STIFFNESS`] [kg].
pub const RULE_PAYLOAD: f64 = 200.0;

/// Order-of-magnitude joint compliance [rad/(N m)] of an arm without published stiffness, from its
/// rated payload [kg].
///
/// k_i = K_i (payload / 200 kg)^(1/4). The exponent and K_i are a least-squares fit (in logarithms;
/// 0.26, rounded) to the eight published sets in `stiffness.csv`, from 6 to 500 kg. Single values
/// deviate by a factor of 2.0 (one standard deviation) and by up to 9, so the result has only one
/// digit.
pub fn assumed_compliance(payload: f64) -> [f64; 6] {
    let scale = math::pow(payload / RULE_PAYLOAD, 0.25);
    RULE_STIFFNESS.map(|k| number(&format!("{:.0e}", 1.0 / (k * scale))))
}

/// A published set of joint stiffnesses.
#[derive(Debug, Clone, PartialEq)]
pub struct Published {
    /// Key used in `robots.csv`; empty if no robot of the library uses it.
    pub key: &'static str,
    /// Rated payload of the robot [kg].
    pub payload: f64,
    /// Joint compliances [rad/(N m)], where given.
    pub compliance: [Option<f64>; 6],
    /// Which of them were measured on the joint.
    pub measured: [bool; 6],
    /// First natural frequency and damping ratio in words; empty if not measured.
    pub mode: &'static str,
    /// How far to trust it.
    pub confidence: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// How well the measured values are known.
    pub spread: InputSpread,
}

/// All published sets.
pub fn published() -> impl Iterator<Item = Published> {
    rows(STIFFNESS).map(|mut row| {
        let (key, _, payload, unit) = (row(), row(), number(row()), row());
        let values: [&str; 6] = std::array::from_fn(|_| row());
        let compliance = values.map(|text| {
            let value = number(text.trim_end_matches('?'));
            // No source measures more than four digits.
            let compliance = if unit == "rad/Nm" { value } else { number(&format!("{:.3e}", 1.0 / value)) };
            (!text.is_empty()).then_some(compliance)
        });
        let measured = values.map(|text| !text.is_empty() && !text.ends_with('?'));
        let (mode, confidence, source, spread) = (row(), row(), row(), row());
        let spread = match spread.strip_prefix('x') {
            Some(factor) => InputSpread::factor(number(factor)),
            None => InputSpread::percent(number(spread)),
        };
        Published { key, payload, compliance, measured, mode, confidence, source, spread }
    })
}

/// The data lines of a table, each as a function that returns its cells one by one.
fn rows(table: &'static str) -> impl Iterator<Item = impl FnMut() -> &'static str> {
    table.lines().skip(1).map(|line| {
        let mut cells = line.split(';');
        move || cells.next().unwrap_or_default()
    })
}

fn preset(mut row: impl FnMut() -> &'static str) -> Preset {
    let (id, maker, model, payload) = (row(), row(), row(), number(row()));
    let lengths_mm = std::array::from_fn(|_| number(row()));
    let (world, world_source) = (row(), row());
    let (zero, limits, speeds, source, confidence, stiffness) = (row(), row(), row(), row(), row(), row());
    let mut zeros =
        rows(ZEROS).filter_map(|mut row| (row() == zero).then(|| (numbers(row()), numbers(row()), row())));
    let (joint_sign, joint_offset_deg, joint_3) = zeros.next().unwrap_or(([f64::NAN; 6], [f64::NAN; 6], ""));
    let elbow = if joint_3 == "pendant" { Elbow::Pendant } else { Elbow::Serial };
    let mut ranges = limits.split(' ').map(|range| match range.split_once(':') {
        Some((low, high)) => [number(low), number(high)],
        None => [-number(range), number(range)],
    });
    let limits = (!limits.is_empty()).then(|| [0; 6].map(|_| ranges.next().unwrap_or([f64::NAN; 2])));
    let [source, world_source] = [source, world_source]
        .map(|line| line.parse().ok().and_then(|line| SOURCES.lines().nth(line)).unwrap_or_default());
    let known = published().find(|set| set.key == stiffness && !stiffness.is_empty());
    let stiffness_note = match &known {
        Some(set) => format!("Joint stiffness: {} ({}).", set.source, set.confidence),
        None => format!(
            "Joint stiffness: not known for this robot. The values are an order of magnitude for \
             {payload} kg of payload, from eight published sets for other arms, which scatter \
             by a factor of 2, and by 9 for single joints: identify your own."
        ),
    };
    let mode_note = match known.as_ref().map(|set| set.mode).filter(|mode| !mode.is_empty()) {
        Some(mode) => format!("First natural frequency: {mode}."),
        None => String::new(),
    };
    Preset {
        id,
        maker,
        model,
        payload_kg: payload,
        opw: Opw { lengths_mm, joint_sign, joint_offset_deg },
        elbow,
        world_mm: (!world.is_empty()).then(|| number(world)),
        joint_limits_deg: limits,
        joint_speed_deg_s: (!speeds.is_empty()).then(|| numbers(speeds)),
        joint_compliance: match &known {
            Some(set) => set.compliance.map(|c| c.unwrap_or(0.0)),
            None => assumed_compliance(payload),
        },
        stiffness_assumed: known.is_none(),
        stiffness_measured: known.as_ref().is_some_and(|set| set.measured == [true; 6]),
        stiffness_spread: std::array::from_fn(|joint| match &known {
            Some(set) if set.measured[joint] => set.spread,
            _ => InputSpread::factor(NOT_MEASURED),
        }),
        geometry_note: format!("Geometry: {source} (confidence {confidence})."),
        world_source,
        stiffness_note,
        mode_note,
    }
}

fn number(text: &str) -> f64 {
    text.parse().unwrap_or(f64::NAN)
}

fn numbers(text: &str) -> [f64; 6] {
    let mut values = text.split(' ').map(number);
    [0; 6].map(|_| values.next().unwrap_or(f64::NAN))
}
