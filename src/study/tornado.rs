//! Which input moves the result most, over its own spread.
//!
//! Each input of the band alone goes to both ends of its 95 % range while all others are as assumed; the
//! commands stay as they were found for the nominal plant. This is the band's own linear model at the band's
//! places, so no run is needed: on them it differs from a full run as the band does (tests/reruns.rs).

use crate::math;
use crate::report::Report;
use crate::spread::{COVERAGE, Spreads};
use crate::uncertainty::{Draw, largest_errors};
use crate::units::MM;
use serde::Serialize;

/// Inputs in the order of their deviates, see [`crate::uncertainty::draw::Deviates`].
const INPUTS: [&str; 10] = [
    "joint-1",
    "joint-2",
    "joint-3",
    "joint-4",
    "joint-5",
    "joint-6",
    "cutting",
    "radial-ratio",
    "axial-ratio",
    "frequency",
];

/// What one input does to the largest contour error.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TornadoBar {
    /// Stable slug, as in the band's shares.
    pub input: &'static str,
    /// The input at the lower and the upper end of its 95 % range, as a factor on what is assumed: of a
    /// joint its compliance, which is largest where the stiffness is least.
    pub factors: [f64; 2],
    /// Largest contour error after compensation at both [mm].
    pub after_mm: [f64; 2],
    /// Largest contour error before compensation at both [mm].
    pub before_mm: [f64; 2],
}

impl TornadoBar {
    /// By how much the error after compensation changes at most from `nominal` [mm].
    fn swing(&self, nominal: f64) -> f64 {
        self.after_mm.iter().map(|error| (error - nominal).abs()).fold(0.0, f64::max)
    }
}

/// All inputs that vary, the one with the largest swing first.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tornado {
    /// Largest contour error after compensation with every input as assumed [mm].
    pub after_mm: f64,
    /// The same before compensation [mm].
    pub before_mm: f64,
    /// The inputs.
    pub bars: Vec<TornadoBar>,
}

/// The tornado of a run.
pub fn tornado(report: &Report) -> Tornado {
    let spreads = &report.setup().spreads;
    let varied: Vec<(usize, [Draw; 2])> = (0..INPUTS.len())
        .map(|input| (input, ends(spreads, input)))
        .filter(|(_, [low, high])| low != high)
        .collect();
    let mut draws = vec![Draw::NOMINAL];
    draws.extend(varied.iter().flat_map(|(_, ends)| *ends));
    let errors = |q| {
        let all = largest_errors(&report.plan, (q, &report.band.samples), &draws);
        all.into_iter().map(|error| error / MM).collect::<Vec<f64>>()
    };
    let (after, before) = (errors(&report.compensation.q), errors(&report.q));
    let both = |errors: &[f64], bar: usize| [errors[1 + 2 * bar], errors[2 + 2 * bar]];
    let bar = |(bar, (input, draws)): (usize, &(usize, [Draw; 2]))| TornadoBar {
        input: INPUTS[*input],
        factors: draws.each_ref().map(|draw| factor(draw, *input)),
        after_mm: both(&after, bar),
        before_mm: both(&before, bar),
    };
    let bars = math::rising(varied.iter().enumerate().map(bar), |bar| -bar.swing(after[0]));
    Tornado { after_mm: after[0], before_mm: before[0], bars }
}

/// The plants with one input at both ends of its 95 % range, the smaller factor first.
fn ends(spreads: &Spreads, input: usize) -> [Draw; 2] {
    let [low, high] = [-COVERAGE, COVERAGE].map(|z| alone(spreads, input, z));
    if factor(&low, input) > factor(&high, input) { [high, low] } else { [low, high] }
}

/// The plant with one input at the deviate `z`. Compliances from one fit vary together; here each goes to
/// the end of its own range.
fn alone(spreads: &Spreads, input: usize, z: f64) -> Draw {
    let mut draw = Draw::NOMINAL;
    match input {
        0..6 => draw.compliance[input] = spreads.stiffness.alone(input, z),
        6 => draw.force = [spreads.cutting.at(z); 3],
        7 | 8 => draw.force[input - 6] = spreads.ratios.at(z),
        _ => draw.frequency = spreads.frequency.at(z),
    }
    draw
}

fn factor(draw: &Draw, input: usize) -> f64 {
    match input {
        0..6 => draw.compliance[input],
        6 => draw.force[0],
        7 | 8 => draw.force[input - 6],
        _ => draw.frequency,
    }
}
