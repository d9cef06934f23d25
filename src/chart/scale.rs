//! An axis as numbers: its range, and the positions and labels of its ticks.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use super::svg::text_width;
use crate::math;

/// A range of values along one side of a chart, with its ticks; plotters' own search for ticks is
/// not used, because it uses the platform's logarithm, which differs between native and wasm.
#[derive(Clone, Debug)]
pub(super) struct Scale {
    pub(super) min: f64,
    pub(super) max: f64,
    pub(super) log: bool,
    pub(super) floor: Option<f64>,
    pub(super) ticks: Vec<Tick>,
}

/// One tick.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub(super) value: f64,
    pub(super) label: String,
}

/// Outermost position in lengths of the axis: far outside, and still far from overflow.
const FAR: f64 = 1e6;

impl Scale {
    /// A scale without ticks. The range must be finite and increasing, and above zero if `log`, where
    /// values below `floor` count as that.
    pub(super) fn new((min, max): (f64, f64), log: bool, floor: Option<f64>) -> Self {
        Self { min, max, log, floor, ticks: Vec::new() }
    }

    /// With at most `most` ticks (two at least); at whole numbers only if `whole`.
    pub(super) fn with_ticks(mut self, most: usize, whole: bool) -> Self {
        self.ticks = if self.log {
            decade_ticks(self.min, self.max, most)
        } else {
            linear_ticks(self.min, self.max, most, whole)
        };
        self
    }

    /// With as many ticks as have room for their labels side by side on `length` SVG units.
    pub(super) fn with_ticks_across(self, length: f64, whole: bool) -> Self {
        let most = ((length / 56.0) as usize).clamp(2, 12);
        (2..=most)
            .rev()
            .map(|count| self.clone().with_ticks(count, whole))
            .find(|scale| scale.ticks.len() < 2 || scale.label_width() + 16.0 <= scale.spacing() * length)
            .unwrap_or_else(|| self.with_ticks(2, whole))
    }

    /// 2 to 9 times the powers of ten where those alone have labels.
    pub(super) fn minor_ticks(&self) -> Vec<f64> {
        let decades = self.ticks.windows(2).all(|pair| (pair[1].value / pair[0].value - 10.0).abs() < 1e-6);
        if !self.log || self.ticks.len() < 2 || !decades {
            return Vec::new();
        }
        let (low, high) = (math::log10(self.min).floor() as i32, math::log10(self.max).ceil() as i32);
        (low..high)
            .flat_map(|exponent| (2..10).map(move |digits| Decimal { digits, exponent }.value()))
            .filter(|value| (self.min..=self.max).contains(value))
            .collect()
    }

    /// With a tick at the end as well, so that the whole length can be read; a tick too near to it on
    /// `length` SVG units goes.
    pub(super) fn with_end(mut self, length: f64) -> Self {
        let [.., before, last] = &self.ticks[..] else { return self };
        // One digit finer than the steps.
        let exponent = (math::log10(last.value - before.value) + 1e-9).floor() as i32 - 1;
        if self.log || !(-4..6).contains(&exponent) {
            return self;
        }
        let unit = math::pow(10.0, f64::from(exponent.abs()));
        let digits = if exponent < 0 { self.max * unit } else { self.max / unit };
        let end = Tick { value: self.max, label: Decimal::rounded(digits, exponent).text(false) };
        let apart = (self.max - last.value) / (self.max - self.min) * length;
        if end.label == last.label {
            return self;
        }
        if apart < (text_width(&end.label) + text_width(&last.label)) / 2.0 + 8.0 {
            self.ticks.pop();
        }
        self.ticks.push(end);
        self
    }

    /// Position of a value: 0 at the beginning, 1 at the end; NaN where it has none.
    pub(super) fn position(&self, value: f64) -> f64 {
        let place = if self.log {
            let (low, high) = (math::log10(self.min), math::log10(self.max));
            let value = self.floor.map_or(value, |floor| value.max(floor));
            if value > 0.0 { (math::log10(value) - low) / (high - low) } else { f64::NAN }
        } else {
            (value - self.min) / (self.max - self.min)
        };
        if value.is_finite() { place.clamp(-FAR, FAR) } else { f64::NAN }
    }

    /// Width of the widest label [SVG units].
    pub(super) fn label_width(&self) -> f64 {
        self.ticks.iter().map(|tick| text_width(&tick.label)).fold(0.0, f64::max)
    }

    /// Smallest distance between two ticks, in lengths of the axis.
    fn spacing(&self) -> f64 {
        self.ticks
            .windows(2)
            .map(|pair| self.position(pair[1].value) - self.position(pair[0].value))
            .fold(f64::INFINITY, f64::min)
    }
}

impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        (f64::from(from) + f64::from(to - from) * self.position(*value)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            return Vec::new();
        }
        self.ticks.iter().map(|tick| tick.value).collect()
    }

    fn range(&self) -> Range<f64> {
        self.min..self.max
    }
}

impl ValueFormatter<f64> for Scale {
    fn format_ext(&self, value: &f64) -> String {
        self.ticks.iter().find(|tick| tick.value == *value).map(|tick| tick.label.clone()).unwrap_or_default()
    }
}

/// The smallest and the greatest finite value; only positive ones count if `positive`.
pub(super) fn extent(values: impl IntoIterator<Item = f64>, positive: bool) -> Option<(f64, f64)> {
    values.into_iter().filter(|v| v.is_finite() && (!positive || *v > 0.0)).fold(None, |range, v| {
        let (min, max) = range.unwrap_or((v, v));
        Some((v.min(min), v.max(max)))
    })
}

/// A range wide enough to draw: where all values agree but for rounding, some room is added around
/// them.
pub(super) fn widened((min, max): (f64, f64)) -> (f64, f64) {
    let size = min.abs().max(max.abs());
    if max - min > 1e-9 * size && size > 1e-12 {
        return (min, max);
    }
    let room = if size > 1e-12 { 0.1 * size } else { 1.0 };
    (min - room, max + room)
}

/// A number as an integer times a power of ten: exact to print.
#[derive(Clone, Copy)]
struct Decimal {
    digits: i64,
    exponent: i32,
}

impl Decimal {
    /// The nearest to `digits` times the power of ten, without zeros after the point.
    fn rounded(digits: f64, exponent: i32) -> Self {
        let mut decimal = Self { digits: digits.round() as i64, exponent };
        while decimal.exponent < 0 && decimal.digits % 10 == 0 {
            decimal = Self { digits: decimal.digits / 10, exponent: decimal.exponent + 1 };
        }
        decimal
    }

    fn value(self) -> f64 {
        let power = math::pow(10.0, f64::from(self.exponent.abs()));
        if self.exponent < 0 { self.digits as f64 / power } else { self.digits as f64 * power }
    }

    /// As a person writes it, with a true minus sign; `scientific`: as a multiple of a power of
    /// ten.
    fn text(self, scientific: bool) -> String {
        let sign = if self.digits < 0 { "\u{2212}" } else { "" };
        let digits = self.digits.unsigned_abs().to_string();
        let exponent = self.exponent + digits.len() as i32 - 1;
        if self.digits == 0 {
            return "0".into();
        }
        if scientific && exponent != 0 {
            let (first, rest) = digits.split_at(1);
            let rest = rest.trim_end_matches('0');
            let point = if rest.is_empty() { "" } else { "." };
            let power = superscript(exponent);
            return match (first, rest) {
                ("1", "") => format!("{sign}10{power}"),
                _ => format!("{sign}{first}{point}{rest}×10{power}"),
            };
        }
        let places = usize::try_from(-self.exponent).unwrap_or(0);
        let plain = format!("{:.places$}", self.value().abs());
        let (whole, fraction) = plain.split_at(plain.find('.').unwrap_or(plain.len()));
        format!("{sign}{}{fraction}", grouped(whole))
    }
}

/// Digits in groups of three from ten thousand on, with thin spaces (ISO 80000-1).
fn grouped(digits: &str) -> String {
    if digits.len() < 5 {
        return digits.into();
    }
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(digit);
    }
    text
}

/// An exponent in raised digits.
fn superscript(exponent: i32) -> String {
    exponent
        .to_string()
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            c => char::from_u32(u32::from('⁰') + c.to_digit(10).unwrap_or(0)).unwrap_or(c),
        })
        .collect()
}

/// Ticks with their labels, all in the same notation.
fn labelled(decimals: Vec<Decimal>) -> Vec<Tick> {
    let largest = decimals.iter().map(|d| d.value().abs()).fold(0.0, f64::max);
    let scientific = largest > 0.0 && !(1e-3..1e6).contains(&largest);
    decimals.into_iter().map(|d| Tick { value: d.value(), label: d.text(scientific) }).collect()
}

/// Multiples of the smallest step of 1, 2 or 5 times a power of ten that gives at most `most`
/// ticks.
pub(super) fn linear_ticks(min: f64, max: f64, most: usize, whole: bool) -> Vec<Tick> {
    let most = most.max(2);
    let start = math::log10((max - min) / most as f64).floor() as i32;
    let start = if whole { start.max(0) } else { start };
    let steps = (start..).flat_map(|exponent| [1, 2, 5].map(|digits| Decimal { digits, exponent }));
    for step in steps.take(12) {
        // A tick that misses the end by a rounding error still counts.
        let first = (min / step.value() - 1e-9).ceil() as i64;
        let last = (max / step.value() + 1e-9).floor() as i64;
        if last - first < most as i64 {
            let multiples = (first..=last).map(|k| Decimal { digits: k * step.digits, ..step });
            let mut ticks = labelled(multiples.collect());
            ticks.iter_mut().for_each(|tick| tick.value = tick.value.clamp(min, max));
            return ticks;
        }
    }
    Vec::new()
}

/// Powers of ten, thinned to at most `most`, with 2 and 5 times them where there is room. A range
/// that holds fewer than two of these gets ticks as on a linear scale.
fn decade_ticks(min: f64, max: f64, most: usize) -> Vec<Tick> {
    let inside = |d: &Decimal| (min * (1.0 - 1e-9)..=max * (1.0 + 1e-9)).contains(&d.value());
    let (low, high) = (math::log10(min).floor() as i32, math::log10(max).ceil() as i32);
    let choose = |digits: &[i64], every: i32| -> Vec<Decimal> {
        (low..=high)
            .filter(|exponent| exponent.rem_euclid(every) == 0)
            .flat_map(|exponent| digits.iter().map(move |&digits| Decimal { digits, exponent }))
            .filter(inside)
            .collect()
    };
    let fits = |chosen: &Vec<Decimal>| (2..=most.max(2)).contains(&chosen.len());
    let coarser = (1..=high - low).map(|every| choose(&[1], every));
    match std::iter::once(choose(&[1, 2, 5], 1)).chain(coarser).find(fits) {
        Some(chosen) => labelled_logarithmic(chosen),
        None => linear_ticks(min, max, most, false),
    }
}

/// As [`labelled`], but powers of ten are written out while that is short.
fn labelled_logarithmic(decimals: Vec<Decimal>) -> Vec<Tick> {
    let scientific = decimals.iter().any(|d| !(1e-4..=1e5).contains(&d.value()));
    decimals.into_iter().map(|d| Tick { value: d.value(), label: d.text(scientific) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().map(|tick| tick.label.as_str()).collect()
    }

    #[test]
    fn ticks_are_steps_of_1_2_5_inside_the_range() {
        for (min, max) in
            [(0.0, 1.0), (-3.7, 12.2), (0.0013, 0.0018), (1e5, 7e5), (999.9, 1000.1), (-1e-7, 3e-7)]
        {
            for most in 2..12 {
                let ticks = linear_ticks(min, max, most, false);
                assert!((1..=most).contains(&ticks.len()), "{} ticks in {min}..{max}", ticks.len());
                assert!(ticks.iter().all(|t| (min..=max).contains(&t.value)), "{ticks:?} in {min}..{max}");
                if let [a, b, ..] = &ticks[..] {
                    let step = b.value - a.value;
                    let mantissa = step / math::pow(10.0, math::log10(step * 1.000_001).floor());
                    assert!([1.0, 2.0, 5.0].iter().any(|m| (m - mantissa).abs() < 1e-6), "step {step}");
                }
            }
        }
    }

    #[test]
    fn labels_read_well() {
        assert_eq!(
            labels(&linear_ticks(-1.0, 1.0, 5, false)),
            ["\u{2212}1.0", "\u{2212}0.5", "0", "0.5", "1.0"]
        );
        assert_eq!(labels(&linear_ticks(0.0, 20.0, 5, false)), ["0", "5", "10", "15", "20"]);
        assert_eq!(labels(&linear_ticks(8e3, 12e3, 3, false)), ["8000", "10\u{2009}000", "12\u{2009}000"]);
        assert_eq!(labels(&linear_ticks(0.0, 2e-5, 3, false)), ["0", "10⁻⁵", "2×10⁻⁵"]);
        assert_eq!(labels(&linear_ticks(1.4e-5, 1.6e-5, 3, false)), ["1.4×10⁻⁵", "1.5×10⁻⁵", "1.6×10⁻⁵"]);
        assert_eq!(labels(&linear_ticks(0.0, 2.0, 9, true)), ["0", "1", "2"]);
    }

    #[test]
    fn decades_are_thinned_out_or_filled_in() {
        assert_eq!(labels(&decade_ticks(1e-3, 10.0, 6)), ["0.001", "0.01", "0.1", "1", "10"]);
        assert_eq!(labels(&decade_ticks(1e-8, 1.0, 5)), ["10⁻⁸", "10⁻⁶", "10⁻⁴", "10⁻²", "1"]);
        assert_eq!(labels(&decade_ticks(1.0, 10.0, 6)), ["1", "2", "5", "10"]);
        assert_eq!(labels(&decade_ticks(3.1, 3.9, 5)), ["3.2", "3.4", "3.6", "3.8"]);
    }

    #[test]
    fn the_end_has_a_tick_and_nothing_touches_its_label() {
        let ended = |max: f64, most: usize, length: f64| {
            let scale = Scale::new((0.0, max), false, None).with_ticks(most, false).with_end(length);
            labels(&scale.ticks).into_iter().map(String::from).collect::<Vec<_>>()
        };
        assert_eq!(ended(19.702, 5, 600.0), ["0", "5", "10", "15", "19.7"]);
        assert_eq!(ended(20.001, 5, 600.0), ["0", "5", "10", "15", "20"]);
        assert_eq!(ended(15.4, 5, 600.0), ["0", "5", "10", "15.4"], "15 would touch it");
        assert_eq!(ended(20.0, 5, 600.0), ["0", "5", "10", "15", "20"]);
        assert_eq!(ended(0.3721, 4, 600.0), ["0", "0.1", "0.2", "0.3", "0.37"]);
        assert_eq!(ended(12_345.0, 4, 600.0), ["0", "5000", "10\u{2009}000", "12\u{2009}300"]);
    }

    #[test]
    fn minor_ticks_stand_between_labelled_decades_only() {
        let minor = |range, log, most| Scale::new(range, log, None).with_ticks(most, false).minor_ticks();
        let twice = minor((0.1, 10.0), true, 3);
        assert_eq!(twice.len(), 16);
        assert!(twice.contains(&0.2) && twice.contains(&9.0) && !twice.contains(&1.0));
        assert!(minor((0.1, 10.0), true, 9).is_empty(), "2 and 5 have labels");
        assert!(minor((1e-8, 1.0), true, 5).is_empty(), "every other decade");
        assert!(minor((0.1, 10.0), false, 5).is_empty());
    }

    #[test]
    fn degenerate_ranges_are_widened() {
        assert_eq!(widened((0.0, 0.0)), (-1.0, 1.0));
        assert_eq!(widened((5.0, 5.0)), (4.5, 5.5));
        assert_eq!(widened((1.0, 2.0)), (1.0, 2.0));
        assert_eq!(extent([f64::NAN, 3.0, -1.0, f64::INFINITY], false), Some((-1.0, 3.0)));
        assert_eq!(extent([0.0, -1.0, 3.0], true), Some((3.0, 3.0)));
        assert_eq!(extent([], false), None);
    }

    #[test]
    fn positions_far_outside_stay_finite() {
        let scale = Scale::new((0.0, 1e-300), false, None);
        assert_eq!(scale.position(1e300), FAR);
        assert!(scale.position(f64::INFINITY).is_nan());
        assert!(Scale::new((1.0, 10.0), true, None).position(0.0).is_nan());
        assert_eq!(Scale::new((1.0, 10.0), true, Some(1.0)).position(-5.0), 0.0);
    }
}
