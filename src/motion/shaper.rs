//! Input shapers: impulse sequences that cancel the vibration they start (thesis eqs. 4.12-4.15).
//!
//! A shaper splits every command into a few delayed parts. The delay bends the path, which is what
//! Armill corrects.

use crate::math::{self, PI};
use nalgebra::Vector3;

/// One part of the command: its share and its delay.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impulse {
    /// Share of the command; the shares of a shaper add up to 1.
    pub amplitude: f64,
    /// Delay [s].
    pub time: f64,
}

/// A kind of shaper: a pure function of frequency and damping with its range of validity.
#[derive(Debug, Clone, Copy)]
pub struct ShaperType {
    /// Key used in jobs.
    pub id: &'static str,
    /// Display name.
    pub name: &'static str,
    /// Largest damping ratio for which the formula holds.
    pub damping_max: f64,
    /// Impulses from the undamped natural frequency [rad/s] and the damping ratio.
    pub impulses: fn(f64, f64) -> Vec<Impulse>,
}

/// All kinds of shaper.
///
/// ZV, ZVD, ZVDD: N. Singer, W. Seering, Preshaping Command Inputs to Reduce System Vibration, ASME
/// J. Dyn. Syst. Meas. Control 112 (1990); exact for any damping below 1 (limited to 0.9 here,
/// beyond which nothing vibrates).
///
/// EI: W. Singhose, W. Seering, N. Singer, Residual Vibration Reduction Using Vector Diagrams to
/// Generate Shaped Inputs, ASME J. Mech. Des. 116 (1994), with the damped fit for 5 % residual
/// vibration, given for damping up to 0.3.
pub const TYPES: [ShaperType; 4] = [
    ShaperType {
        id: "zv",
        name: "ZV (zero vibration)",
        damping_max: 0.9,
        impulses: |w, z| binomial(1, w, z),
    },
    ShaperType {
        id: "zvd",
        name: "ZVD (and its derivative)",
        damping_max: 0.9,
        impulses: |w, z| binomial(2, w, z),
    },
    ShaperType {
        id: "zvdd",
        name: "ZVDD (and two derivatives)",
        damping_max: 0.9,
        impulses: |w, z| binomial(3, w, z),
    },
    ShaperType {
        id: "ei",
        name: "EI (extra-insensitive, 5 %)",
        damping_max: 0.3,
        impulses: extra_insensitive,
    },
];

/// The kind with the key `id`.
pub fn kind(id: &str) -> Option<&'static ShaperType> {
    TYPES.iter().find(|kind| kind.id == id)
}

/// Period of the damped vibration T_d [s] (below eq. 4.13).
pub fn damped_period(frequency: f64, damping: f64) -> f64 {
    2.0 * PI / (frequency * (1.0 - damping * damping).sqrt())
}

/// ZV convolved with itself: impulses half a damped period apart with the coefficients of (1 + K)^n
/// (eq. 4.13 for n = 2).
fn binomial(n: u32, frequency: f64, damping: f64) -> Vec<Impulse> {
    let half_period = damped_period(frequency, damping) / 2.0;
    let k = math::exp(-PI * damping / (1.0 - damping * damping).sqrt());
    let mut amplitudes = vec![1.0];
    for _ in 0..n {
        let mut next = vec![0.0; amplitudes.len() + 1];
        for (i, a) in amplitudes.iter().enumerate() {
            next[i] += a / (1.0 + k);
            next[i + 1] += a * k / (1.0 + k);
        }
        amplitudes = next;
    }
    let place = |(i, amplitude)| Impulse { amplitude, time: i as f64 * half_period };
    amplitudes.into_iter().enumerate().map(place).collect()
}

/// EI with a residual vibration of 5 % at the design frequency, which widens the band of low
/// vibration.
fn extra_insensitive(frequency: f64, damping: f64) -> Vec<Impulse> {
    let v = 0.05;
    let z = damping;
    let first = 0.24968 + 0.24961 * v + (0.80008 + 1.23328 * v + (0.49599 + 3.17316 * v) * z) * z;
    let third = 0.25149 + 0.21474 * v + (-0.83249 + 1.41498 * v + (0.85181 - 4.90094 * v) * z) * z;
    let middle = 0.4999
        + (0.46159 + 8.57843 * v) * v * z
        + ((4.26169 - 108.644 * v) * v * z + (1.75601 + 336.989 * v) * v * z * z) * z;
    let period = damped_period(frequency, damping);
    vec![
        Impulse { amplitude: first, time: 0.0 },
        Impulse { amplitude: 1.0 - first - third, time: middle * period },
        Impulse { amplitude: third, time: period },
    ]
}

/// Iterations of [`Shaper::undo`]: enough to leave 1e-3 of the frequencies that pass the shaper at
/// more than half of their amplitude.
const UNDO_STEPS: usize = 25;
/// What lacks less than this is left as it is [m].
const NEGLIGIBLE: f64 = 1e-11;
/// Samples shaped in one block.
const STRETCH: usize = 256;

/// Values that a shaper can scale and add.
pub trait Shapeable: Copy + std::ops::Add<Output = Self> + std::ops::Mul<f64, Output = Self> {}
impl<T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>> Shapeable for T {}

/// A shaper ready for use, the same for all joints.
#[derive(Debug, Clone, PartialEq)]
pub struct Shaper {
    impulses: Vec<Impulse>,
}

impl Shaper {
    /// No shaping: the command passes unchanged.
    pub fn none() -> Self {
        Self { impulses: vec![Impulse { amplitude: 1.0, time: 0.0 }] }
    }

    /// A shaper of the given kind, for a mode with the undamped natural frequency `frequency`
    /// [rad/s] and the damping ratio `damping`.
    pub fn new(kind: &ShaperType, frequency: f64, damping: f64) -> Self {
        Self { impulses: (kind.impulses)(frequency, damping) }
    }

    /// This shaper for `factor` times the frequency with the same damping: every delay is a share of
    /// the damped period.
    pub fn tuned(&self, factor: f64) -> Self {
        let sooner = |impulse: &Impulse| Impulse { time: impulse.time / factor, ..*impulse };
        Self { impulses: self.impulses.iter().map(sooner).collect() }
    }

    /// The impulses in time order.
    pub fn impulses(&self) -> &[Impulse] {
        &self.impulses
    }

    /// Delay of the last impulse [s]: a shaped command settles this long after the command.
    pub fn duration(&self) -> f64 {
        self.impulses.last().map_or(0.0, |impulse| impulse.time)
    }

    /// Vibration that a shaped step leaves in a mode with this frequency [rad/s] and damping, as a
    /// share of the unshaped step's (N. Singer, W. Seering 1990, eq. 11): 0 at the design frequency
    /// for ZV, ZVD, ZVDD.
    pub fn residual_vibration(&self, frequency: f64, damping: f64) -> f64 {
        let damped = frequency * (1.0 - damping * damping).sqrt();
        let (mut cosine, mut sine) = (0.0, 0.0);
        for Impulse { amplitude, time } in &self.impulses {
            let weight = amplitude * math::exp(damping * frequency * (time - self.duration()));
            let (sin, cos) = math::sin_cos(damped * time);
            cosine += weight * cos;
            sine += weight * sin;
        }
        math::hypot(cosine, sine)
    }

    /// Convolution with a command that is sampled every `sample_time` [s] and constant before its
    /// first sample (eq. 4.14).
    ///
    /// Where an impulse falls between samples, the command is interpolated linearly.
    pub fn apply<T: Shapeable>(&self, command: &[T], sample_time: f64) -> Vec<T> {
        let mut shaped = Vec::with_capacity(command.len());
        stretches(&self.taps(sample_time), command, |_, stretch| shaped.extend_from_slice(stretch));
        shaped
    }

    /// The shaped command, with each sample computed on demand.
    pub fn shaped<'a, T: Shapeable>(&self, command: &'a [T], sample_time: f64) -> Shaped<'a, T> {
        Shaped { taps: self.taps(sample_time), command }
    }

    /// The impulses as delays in samples with their shares; a fractional delay is split over two
    /// samples.
    fn taps(&self, sample_time: f64) -> Vec<(usize, f64)> {
        let mut taps = Vec::with_capacity(2 * self.impulses.len());
        for Impulse { amplitude, time } in &self.impulses {
            let delay = time / sample_time;
            let whole = delay.floor();
            let part = delay - whole;
            taps.push((whole as usize, amplitude * (1.0 - part)));
            if part > 0.0 {
                taps.push((whole as usize + 1, amplitude * part));
            }
        }
        taps
    }

    /// The change of a command that changes its shaped form by `wanted`, as closely as the shaper
    /// allows.
    ///
    /// A shaper blocks its design frequency, so it has no full inverse. With S the shaper and S*
    /// the shaper run backwards in time, x is corrected by S*(wanted - S x) a fixed number of times
    /// (L. Landweber, An iteration formula for Fredholm integral equations of the first kind, Amer.
    /// J. Math. 73, 1951). Each time, the residual at a frequency shrinks by the factor 1 - |S|^2.
    /// It never grows, because the amplitudes are positive and add up to 1.
    ///
    /// From sample `moving` (at least 1) on the change is constant: each step holds the value
    /// reached there.
    pub fn undo(&self, wanted: &[Vector3<f64>], sample_time: f64, moving: usize) -> Vec<Vector3<f64>> {
        let taps = self.taps(sample_time);
        let longest = taps.last().map_or(0, |&(delay, _)| delay);
        let (reach, count) = (longest.div_ceil(STRETCH), wanted.len().div_ceil(STRETCH));
        let within = |stretch: usize| stretch * STRETCH..((stretch + 1) * STRETCH).min(wanted.len());
        let mut command = vec![Vector3::zeros(); wanted.len()];
        // What the shaped command lacks, and the most of it in each stretch.
        let mut missing = wanted.to_vec();
        let mut most: Vec<f64> = (0..count).map(|i| largest(&missing[within(i)])).collect();
        let mut more = [Vector3::zeros(); STRETCH];
        for step in 1..=UNDO_STEPS {
            let mut changed = vec![false; count];
            for i in 0..count {
                if most[i..(i + reach + 1).min(count)].iter().all(|most| *most < NEGLIGIBLE) {
                    continue;
                }
                let range = within(i);
                let more = &mut more[..range.len()];
                mixed(&taps, &missing, range.start, more, Tense::Ahead);
                for (command, more) in command[range].iter_mut().zip(more) {
                    *command += *more;
                }
                changed[i] = true;
            }
            let arrived = command[moving - 1];
            command[moving..].fill(arrived);
            let end = (moving - 1) / STRETCH;
            if changed[end..].contains(&true) {
                changed[end..].fill(true);
            }
            if step == UNDO_STEPS {
                break;
            }
            for i in (0..count).filter(|&i| changed[i.saturating_sub(reach)..=i].contains(&true)) {
                let range = within(i);
                let shaped = &mut more[..range.len()];
                mixed(&taps, &command, range.start, shaped, Tense::Past);
                for ((missing, wanted), shaped) in
                    missing[range.clone()].iter_mut().zip(&wanted[range.clone()]).zip(shaped)
                {
                    *missing = wanted - *shaped;
                }
                most[i] = largest(&missing[range]);
            }
        }
        command
    }
}

/// The largest component of any of the vectors.
fn largest(vectors: &[Vector3<f64>]) -> f64 {
    vectors.iter().map(Vector3::amax).fold(0.0, f64::max)
}

/// A shaped command; of joint values, theta_shp of eq. 4.14.
#[derive(Debug, Clone)]
pub struct Shaped<'a, T> {
    taps: Vec<(usize, f64)>,
    command: &'a [T],
}

impl<T: Shapeable> Shaped<'_, T> {
    /// The sample `k`.
    pub fn at(&self, k: usize) -> T {
        self.part_at(k, |sample| *sample)
    }

    /// A part of the sample `k`.
    pub fn part_at<U: Shapeable>(&self, k: usize, part: impl Fn(&T) -> U) -> U {
        let delayed = |delay: usize| part(&self.command[k.saturating_sub(delay)]);
        match self.taps.split_first() {
            Some((&(first, share), rest)) => {
                rest.iter().fold(delayed(first) * share, |sum, &(delay, share)| sum + delayed(delay) * share)
            }
            None => delayed(0),
        }
    }
}

/// Shapes the command in stretches that fit the processor's cache, and calls `take` with the number
/// of each stretch's first sample and the stretch.
fn stretches<T: Shapeable>(taps: &[(usize, f64)], command: &[T], mut take: impl FnMut(usize, &[T])) {
    let Some(&start) = command.first() else { return take(0, command) };
    let mut stretch = [start; STRETCH];
    for from in (0..command.len()).step_by(STRETCH) {
        let stretch = &mut stretch[..STRETCH.min(command.len() - from)];
        mixed(taps, command, from, stretch, Tense::Past);
        take(from, stretch);
    }
}

/// Whether a sample is mixed from those before it, or from those after it (the shaper run backwards
/// in time).
#[derive(Clone, Copy)]
enum Tense {
    Past,
    Ahead,
}

/// Mixes a stretch from sample `from` on. Before its first and after its last sample, the command is
/// constant.
fn mixed<T: Shapeable>(taps: &[(usize, f64)], command: &[T], from: usize, stretch: &mut [T], tense: Tense) {
    let last = command.len() - 1;
    for (number, &(delay, share)) in taps.iter().enumerate() {
        let (source, held) = match tense {
            Tense::Past => (from.saturating_sub(delay), delay.saturating_sub(from)),
            Tense::Ahead => (from + delay, 0),
        };
        let add = |now: &mut T, value: T| {
            *now = if number == 0 { value * share } else { *now + value * share };
        };
        let (before, rest) = stretch.split_at_mut(held.min(stretch.len()));
        for now in before {
            add(now, command[0]);
        }
        let known = &command[source.min(last + 1)..];
        let (within, after) = rest.split_at_mut(known.len().min(rest.len()));
        for (now, value) in within.iter_mut().zip(known) {
            add(now, *value);
        }
        for now in after {
            add(now, command[last]);
        }
    }
}
