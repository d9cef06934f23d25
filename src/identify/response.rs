//! Frequency and damping from a measured step or impact response.
//!
//! After the step or blow the arm rings freely. Any signal of that (acceleration, velocity,
//! displacement) has the form
//!
//! ```text
//! a(t) = exp(-zeta w t) (A cos w_d t + B sin w_d t) + offset,   w_d = w sqrt(1 - zeta^2)
//! ```
//!
//! where w is the undamped natural frequency that the shaper takes. Extrema give a first guess
//! (logarithmic decrement: S. Rao, Mechanical Vibrations, 5th ed. 2011, section 2.6.3); least
//! squares over all samples gives the result.

mod decay;
mod extrema;

use crate::error::Error;
use crate::identify::student;
use crate::identify::table::Table;
use crate::math;
use decay::{Decay, Samples};

/// JSON path of the text, for errors.
const FIELD: &str = "response";
/// Number of time constants after which nothing is left to fit: exp(-6) is 0.25 %.
const FADED: f64 = 6.0;
/// Number of cycles below which the result gets a remark.
const FEW_CYCLES: f64 = 3.0;
/// Samples per cycle below which the result gets a remark, and below which there is no result.
const FEW_SAMPLES: (f64, f64) = (10.0, 4.0);
/// Thresholds for reporting a second mode: its share of the first mode's amplitude, and the share
/// of the first mode's residual that it explains.
const SECOND: (f64, f64) = (0.03, 0.5);

/// A fit that explains more, with one mode, is not tried about a baseline that drifts.
const STEADY: f64 = 0.9999;
/// A baseline drifts if to know that leaves at most this share of what was left.
const LESS: f64 = 0.8;
/// Share of a signal's range from which on a drift is large.
const DRIFTS: f64 = 0.1;
/// Passes in which the slope of a baseline settles.
const DRIFT_PASSES: usize = 12;
/// A damping ratio this close to zero is none.
const UNDAMPED: f64 = 1e-4;
/// Equal extremes in a row that show a clipped signal, and how many such rows.
const CLIPPED: (usize, usize) = (3, 3);
/// Samples that are so far apart [s], without a unit, are hardly in seconds.
const FAR_APART: f64 = 0.2;

/// A signal over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Signal {
    /// Sample times [s], increasing.
    pub time: Vec<f64>,
    /// The signal; its unit does not matter.
    pub value: Vec<f64>,
    /// Whether the text states the unit of time.
    pub states_unit: bool,
}

impl Mode {
    /// Whether the extrema say the same as the fit: the frequency within 5 %, the damping within a factor of 1.5.
    pub fn decrement_agrees(&self) -> bool {
        let (frequency, damping) = self.decrement;
        let ratio = damping / self.damping.value;
        (frequency / self.frequency.value - 1.0).abs() < 0.05 && (1.0 / 1.5..1.5).contains(&ratio)
    }
}

impl Signal {
    /// Reads rows of time and signal. A first line may name them and give the time's unit:
    /// `time_ms, acceleration`.
    ///
    /// # Errors
    /// [`Error::Text`] with line and column of the first invalid cell.
    pub fn read(text: &str) -> Result<Self, Error> {
        let table = Table::read(text, FIELD)?;
        if table.len() == 0 {
            return Err(table.end_error("a text without numbers", "one row for each instant: time, signal"));
        }
        if table.width != 2 {
            return Err(table.cell_error(0, table.width.min(2), "a row is two numbers: time [s] and signal"));
        }
        let mut unit = 1.0;
        let mut states_unit = false;
        if let Some(words) = table.names.first() {
            states_unit = words.len() > 1;
            unit = match words.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
                ["t" | "time"] | ["t" | "time", "s" | "sec" | "seconds"] => 1.0,
                ["t" | "time", "ms"] => 1e-3,
                ["t" | "time", "us" | "µs" | "μs"] => 1e-6,
                _ => return Err(table.name_error(0, "the first column is the time: time, time_s, time_ms")),
            };
        }
        let (mut time, mut value) = (Vec::with_capacity(table.len()), Vec::with_capacity(table.len()));
        for row in 0..table.len() {
            let numbers = table.row(row);
            if let Some(empty) = numbers.iter().position(|number| number.is_nan()) {
                return Err(table.cell_error(row, empty, "a number, such as 12.5"));
            }
            if time.last().is_some_and(|&before| numbers[0] * unit <= before) {
                return Err(table.cell_error(row, 0, "times must increase from row to row"));
            }
            time.push(numbers[0] * unit);
            value.push(numbers[1]);
        }
        Ok(Self { time, value, states_unit })
    }
}

/// A value with half the width of its 95 % confidence interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The value.
    pub value: f64,
    /// Half the width of the interval.
    pub half: f64,
}

/// A second mode in the signal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Other {
    /// Undamped natural frequency [rad/s].
    pub frequency: f64,
    /// Damping ratio.
    pub damping: f64,
    /// Initial amplitude, as a share of the first mode's.
    pub share: f64,
}

/// An identified vibration mode.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// Undamped natural frequency [rad/s], as the shaper takes it.
    pub frequency: Measured,
    /// Damping ratio.
    pub damping: Measured,
    /// Frequency [rad/s] and damping ratio from the extrema alone, by logarithmic decrement, as a
    /// cross-check.
    pub decrement: (f64, f64),
    /// The part of the signal that was fitted [s].
    pub window: (f64, f64),
    /// Number of cycles in that part.
    pub cycles: f64,
    /// Samples per cycle.
    pub samples_per_cycle: f64,
    /// Share of the signal's variance that the fit explains.
    pub explained: f64,
    /// A second mode, if the signal shows one; it is fitted as well.
    pub other: Option<Other>,
    /// The fit at every instant of the signal; NaN outside the window.
    pub fitted: Vec<f64>,
    /// Passes of the fit, and whether it converged.
    pub passes: (usize, bool),
    /// Reasons to doubt the result: a stable slug and a sentence.
    pub remarks: Vec<(&'static str, String)>,
}

/// Fits the dominant mode, starting at `from` [s] or, by default, at the largest excursion.
///
/// # Errors
/// [`Error::Invalid`] if the vibration is too short, sampled too slowly, or does not decay.
pub fn mode(signal: &Signal, from: Option<f64>) -> Result<Mode, Error> {
    if from.is_none() && drifts(signal) {
        // Where the vibration begins cannot be seen before the drift is out.
        return without_drift(signal, from).map_or_else(|| about_baseline(signal, from, 0.0), Ok);
    }
    let plain = about_baseline(signal, from, 0.0);
    let steady = plain.as_ref().is_ok_and(|mode| mode.explained > STEADY && mode.other.is_none());
    if steady {
        return plain;
    }
    // A baseline that drifts is taken out, if that explains more.
    match without_drift(signal, from) {
        Some(mode)
            if plain.as_ref().is_ok_and(|plain| 1.0 - mode.explained > LESS * (1.0 - plain.explained)) =>
        {
            plain
        }
        Some(mode) if plain.is_ok() || mode.explained > 0.5 => Ok(mode),
        _ => plain,
    }
}

/// Slope of a signal's second half [1/s], where most has died down.
fn late_slope(signal: &Signal) -> f64 {
    let half = signal.time.len() / 2;
    extrema::slope(&signal.time[half..], &signal.value[half..])
}

/// Whether a baseline drifts by more than a tenth of all that the signal does.
fn drifts(signal: &Signal) -> bool {
    let ends =
        |of: &[f64]| of.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(*v), b.max(*v)]);
    let [[from, to], [least, most]] = [ends(&signal.time), ends(&signal.value)];
    late_slope(signal).abs() * (to - from) > DRIFTS * (most - least)
}

/// The same about a baseline that drifts: its slope is that of the second half at first, then that of what is left.
fn without_drift(signal: &Signal, from: Option<f64>) -> Option<Mode> {
    let mut slope = late_slope(signal);
    let mut found = None;
    for _ in 0..DRIFT_PASSES {
        let Ok(mode) = about_baseline(signal, from, slope) else { return found };
        let fitted = || mode.fitted.iter().enumerate().filter(|(_, fitted)| fitted.is_finite());
        let times: Vec<f64> = fitted().map(|(k, _)| signal.time[k]).collect();
        // What the vibration leaves, with the baseline that was taken out.
        let rest: Vec<f64> =
            fitted().map(|(k, fitted)| signal.value[k] - fitted + slope * signal.time[k]).collect();
        let next = extrema::slope(&times, &rest);
        let rested = (next - slope).abs() <= 1e-9 * slope.abs();
        (slope, found) = (next, Some(mode));
        if rested {
            break;
        }
    }
    found
}

/// The mode of a signal less a straight line of this slope [1/s].
fn about_baseline(signal: &Signal, from: Option<f64>, slope: f64) -> Result<Mode, Error> {
    let level: Vec<f64> = signal.time.iter().zip(&signal.value).map(|(t, v)| v - slope * t).collect();
    let signal = &Signal { value: level, ..signal.clone() };
    let all = Samples { time: &signal.time, value: &signal.value };
    let start = match from {
        Some(from) => signal.time.partition_point(|&t| t < from),
        None => extrema::largest(&all),
    };
    let ringing = all.part(start, all.len());
    let guess = guess(&ringing, *signal.time.get(start).unwrap_or(&f64::NAN))?;
    let (mut decay, part, passes) = widening(&ringing, guess);
    let mut rest = part.minus(&decay);
    let explained_by_one = 1.0 - rest.iter().map(|r| r * r).sum::<f64>() / part.variance();
    let mut other = None;
    if let Some(second) = second_mode(&part, &rest, &decay) {
        let (first, second, left) = both_fitted(&part, decay, second);
        (decay, rest) = (first, left);
        let (frequency, damping) = second.undamped();
        other = Some(Other { frequency, damping, share: second.amplitude() / decay.amplitude() });
    }
    if decay.rate <= 0.0 {
        let expected = "a free decay that starts at the step or impact";
        let (_, damping) = decay.undamped();
        let found =
            if damping < -UNDAMPED { "a vibration that grows" } else { "a vibration that does not decay" };
        return Err(Error::invalid(FIELD, found, expected));
    }
    let left: f64 = rest.iter().map(|r| r * r).sum();
    let freedom = part.len().saturating_sub(if other.is_some() { 10 } else { 5 });
    let reach = student::quantile_975(freedom) * (left / freedom.max(1) as f64).sqrt();
    let (frequency, damping) = decay.uncertain(&part, reach);
    let cycles = part.span() * decay.damped / math::TAU;
    let samples_per_cycle = samples_per_cycle(&part, &decay);
    let mut mode = Mode {
        frequency,
        damping,
        decrement: guess.undamped(),
        window: (part.time[0], part.time[part.len() - 1]),
        cycles,
        samples_per_cycle,
        explained: 1.0 - left / part.variance(),
        other,
        fitted: vec![f64::NAN; all.len()],
        passes,
        remarks: vec![],
    };
    for (k, rest) in rest.iter().enumerate() {
        mode.fitted[start + k] = part.value[k] - rest + slope * part.time[k];
    }
    mode.remarks = remarks(&mode, &rest, explained_by_one);
    mode.remarks.extend(oddities(signal, &part));
    Ok(mode)
}

/// The first guess for the vibration that rings from the instant `from` [s].
///
/// # Errors
/// [`Error::Invalid`] if it is too short, or sampled too slowly.
fn guess(ringing: &Samples<'_>, from: f64) -> Result<Decay, Error> {
    let guess = extrema::guess(ringing).ok_or_else(|| {
        Error::invalid(
            FIELD,
            format!("{} samples from {from:.4} s on", ringing.len()),
            "nothing vibrates there for a cycle and a half: give the response after a step or impact, \
             until it has died down",
        )
    })?;
    let samples = samples_per_cycle(ringing, &guess);
    if samples < FEW_SAMPLES.1 {
        return Err(Error::invalid(
            FIELD,
            format!("{samples:.1} samples a cycle"),
            "sampled too slowly to determine the frequency: at least ten samples per cycle",
        ));
    }
    Ok(guess)
}

fn samples_per_cycle(samples: &Samples<'_>, decay: &Decay) -> f64 {
    let cycle = math::TAU / decay.damped;
    samples.len() as f64 * cycle / samples.span()
}

/// Two modes, each fitted to the residual of the other often enough for both to settle, and what
/// they leave of the signal.
fn both_fitted(part: &Samples<'_>, mut first: Decay, mut second: Decay) -> (Decay, Decay, Vec<f64>) {
    for _ in 0..30 {
        let own = part.minus(&second);
        first = Samples { time: part.time, value: &own }.fit(first).0;
        let own = part.minus(&first);
        second = Samples { time: part.time, value: &own }.fit(second).0;
    }
    let own = part.minus(&second);
    let rest = Samples { time: part.time, value: &own }.minus(&first);
    (first, second, rest)
}

/// Fits a few cycles first, then ever longer parts until the vibration has faded, so that the phase
/// never slips by a full turn.
fn widening<'a>(ringing: &Samples<'a>, guess: Decay) -> (Decay, Samples<'a>, (usize, bool)) {
    let (mut decay, mut cycles, mut passes) = (guess, 3.0, 0);
    loop {
        let wanted = cycles * math::TAU / decay.damped;
        let faded = FADED / decay.rate.max(1e-12);
        let span = wanted.min(faded);
        let end = ringing.time.partition_point(|&t| t <= ringing.time[0] + span);
        let part = ringing.part(0, end.max(12).min(ringing.len()));
        let (fitted, more, rested) = part.fit(decay);
        (decay, passes) = (fitted, passes + more);
        if part.len() == ringing.len() || span >= faded {
            return (decay, part, (passes, rested));
        }
        cycles *= 2.0;
    }
}

/// A second damped sinusoid in the residual of the first, if it is worth reporting.
fn second_mode(part: &Samples<'_>, rest: &[f64], first: &Decay) -> Option<Decay> {
    let rest = Samples { time: part.time, value: rest };
    let guess = extrema::guess(&rest)?;
    let (second, _, _) = rest.fit(guess);
    let left: f64 = rest.minus(&second).iter().map(|r| r * r).sum();
    let explains = 1.0 - left / rest.variance();
    let distinct = (second.damped / first.damped - 1.0).abs() > 0.02;
    // What does not turn once within the part is a drift.
    let turns = second.damped * part.span() > math::TAU;
    (distinct && turns && explains > SECOND.1 && second.amplitude() > SECOND.0 * first.amplitude())
        .then_some(second)
}

fn remarks(mode: &Mode, rest: &[f64], explained_by_one: f64) -> Vec<(&'static str, String)> {
    let mut remarks = Vec::new();
    let mut remark = |code, text: String| remarks.push((code, text));
    if let Some(Other { frequency, share, .. }) = mode.other {
        remark(
            "several-modes",
            format!(
                "there is a second mode at {:.2} Hz with {:.0} % of the amplitude; one damped \
                 sinusoid alone explains {:.1} %. A shaper for one mode leaves the other",
                frequency / math::TAU,
                100.0 * share,
                100.0 * explained_by_one
            ),
        );
    }
    if mode.explained < 0.9 {
        remark(
            "poor-fit",
            format!(
                "a damped sinusoid explains only {:.0} % of the signal: more modes, noise or backlash",
                100.0 * mode.explained
            ),
        );
    }
    if mode.cycles < FEW_CYCLES {
        remark("few-cycles", format!("only {:.1} cycles: the damping rests on little data", mode.cycles));
    }
    if mode.samples_per_cycle < FEW_SAMPLES.0 {
        let text = format!(
            "only {:.1} samples per cycle: a vibration faster than half the sampling rate would appear at a lower, wrong frequency",
            mode.samples_per_cycle
        );
        remark("slow-sampling", text);
    }
    let squares: f64 = rest.iter().map(|r| r * r).sum();
    let neighbours: f64 = rest.windows(2).map(|pair| pair[0] * pair[1]).sum();
    if mode.explained < 1.0 - 1e-9 && neighbours > 0.5 * squares {
        remark("not-noise", "the residual is not noise, so the intervals are too narrow".to_owned());
    }
    if !mode.passes.1 {
        remark("not-converged", format!("the fit did not converge in {} passes", mode.passes.0));
    }
    remarks
}

/// Oddities of the signal itself.
fn oddities(signal: &Signal, part: &Samples<'_>) -> Vec<(&'static str, String)> {
    let mut remarks = Vec::new();
    let flat = |extreme: f64| {
        let runs = part.value.chunk_by(|a, b| a == b);
        runs.filter(|run| run[0] == extreme && run.len() >= CLIPPED.0).count()
    };
    let most = part.value.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let least = part.value.iter().copied().fold(f64::INFINITY, f64::min);
    if most > least && flat(most) + flat(least) >= CLIPPED.1 {
        remarks.push((
            "clipped",
            format!(
                "the signal stays at {least:.4} or {most:.4} for several samples in a row: it is clipped, and the damping is wrong. \
                 Start where the peaks are whole, or measure with a wider range"
            ),
        ));
    }
    let steps = signal.time.windows(2).map(|pair| pair[1] - pair[0]);
    let steps = math::rising(steps, |step| *step);
    let step = steps.get(steps.len() / 2).copied().unwrap_or_default();
    if !signal.states_unit && step > FAR_APART {
        remarks.push((
            "time-unit",
            format!(
                "times are taken to be in seconds, so samples are {step:.3} s apart: \
                 if they are milliseconds, name the column time_ms in a first line"
            ),
        ));
    }
    remarks
}
