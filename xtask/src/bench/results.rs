//! The results of the benchmarks, read and laid out as one table.

use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};
use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use serde_json::{Value, json};

/// Median and minimum time [ns].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Time {
    pub(crate) median: f64,
    pub(crate) least: f64,
}

impl Time {
    /// Statistics of times in ms, as the browser's clock reports them.
    fn of_milliseconds(times: &Value) -> Option<Time> {
        let mut times: Vec<f64> = times.as_array()?.iter().filter_map(Value::as_f64).collect();
        times.sort_by(f64::total_cmp);
        let middle = times.len() / 2;
        let median =
            if times.len() % 2 == 1 { times[middle] } else { times.get(middle - 1)?.midpoint(times[middle]) };
        Some(Time { median: median * 1e6, least: times.first()? * 1e6 })
    }

    fn json(self) -> Value {
        json!({ "median_ns": self.median, "least_ns": self.least })
    }
}

/// Native times: by group, then by function.
#[derive(Debug, Default)]
pub(crate) struct Native(BTreeMap<String, BTreeMap<String, Time>>);

impl Native {
    /// Reads criterion's output folder.
    pub(crate) fn read(folder: &Path) -> Result<Native> {
        let mut native = Native::default();
        native.gather(folder)?;
        Ok(native)
    }

    fn gather(&mut self, folder: &Path) -> Result<()> {
        for entry in fs::read_dir(folder).with_context(|| format!("no results in {}", folder.display()))? {
            let path = entry?.path();
            if path.file_name().is_some_and(|name| name == "new") {
                self.take(&path)?;
            } else if path.is_dir() {
                self.gather(&path)?;
            }
        }
        Ok(())
    }

    /// One benchmark: its name, criterion's median, and the minimum time among its samples.
    fn take(&mut self, folder: &Path) -> Result<()> {
        let read =
            |file: &str| -> Result<Value> { Ok(serde_json::from_slice(&fs::read(folder.join(file))?)?) };
        let (what, estimates, sample) =
            (read("benchmark.json")?, read("estimates.json")?, read("sample.json")?);
        let numbers = |key: &str| sample[key].as_array().into_iter().flatten().filter_map(Value::as_f64);
        let least = numbers("times").zip(numbers("iters")).map(|(time, rounds)| time / rounds);
        let time = Time {
            median: estimates["median"]["point_estimate"].as_f64().context("no median")?,
            least: least.fold(f64::INFINITY, f64::min),
        };
        let word = |key: &str| what[key].as_str().unwrap_or_default().to_owned();
        self.0.entry(word("group_id")).or_default().insert(word("function_id"), time);
        Ok(())
    }

    fn of(&self, group: &str, function: &str) -> Option<Time> {
        self.0.get(group)?.get(function).copied()
    }
}

/// Names of the questions, as `armill_bench::questions` has them.
const QUESTIONS: [&str; 5] = [
    "sweep of 20 values",
    "the same on one core",
    "largest depth",
    "every robot, place kept",
    "map of 441 places with p95",
];

/// Everything that was measured.
pub(crate) struct Results {
    pub(crate) conditions: Vec<String>,
    pub(crate) sizes: Vec<usize>,
    pub(crate) native: Native,
    /// Samples and peak bytes, of each size the default job's and then the pocket's.
    pub(crate) memory: Vec<(usize, u64)>,
    pub(crate) chromium: Value,
}

/// The stages in order of execution, as `benches/src/stages.rs` names them.
fn stages() -> impl Iterator<Item = &'static str> {
    let source = include_str!("../../../benches/src/stages.rs");
    source
        .lines()
        .filter_map(|line| line.strip_prefix("    (\"")?.split_once("\", |s|").map(|(name, _)| name))
}

const POSES: [&str; 3] = ["forward", "inverse, every solution", "Jacobian"];

/// Poses in one round of `benches/src/poses.rs`.
const COUNT: f64 = 1000.0;

impl Results {
    fn chromium(&self, size: usize, place: &str) -> Option<Time> {
        Time::of_milliseconds(self.chromium["jobs"][size.to_string()].pointer(place)?)
    }

    fn samples(&self, size: usize) -> u64 {
        self.chromium["jobs"][size.to_string()]["whole"]["samples"].as_u64().unwrap_or_default()
    }

    /// All results for other programs, in ns and bytes.
    pub(crate) fn json(&self) -> Value {
        let native: BTreeMap<_, BTreeMap<_, _>> = (self.native.0.iter())
            .map(|(group, times)| (group, times.iter().map(|(name, time)| (name, time.json())).collect()))
            .collect();
        json!({
            "conditions": self.conditions,
            "native": native,
            "native_peak_bytes": self.peaks(0),
            "native_peak_bytes_pocket": self.peaks(1),
            "browser_ms": self.chromium,
        })
    }

    /// Peak bytes by samples, of the default job (0) or the pocket (1).
    fn peaks(&self, kind: usize) -> serde_json::Map<String, Value> {
        let lines = self.memory.iter().skip(kind).step_by(2);
        lines.map(|(samples, bytes)| (samples.to_string(), json!(bytes))).collect()
    }

    /// The pocket in a stock: reading with engagement, and the whole job.
    fn pockets(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "| a pocket in a stock | moves | reading and engagement, native ms | whole job, native ms | \
             Chromium ms | first | MB native | MB Chromium |"
        )?;
        writeln!(f, "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")?;
        for (i, &size) in self.sizes.iter().enumerate() {
            let pocket = &self.chromium["jobs"][size.to_string()]["pocket"];
            let native = |name: &str| {
                let time = self.native.of(&format!("pocket {size}"), name);
                time.map_or("-".to_owned(), |time| digits(time.median / 1e6))
            };
            let browser = Time::of_milliseconds(&pocket["times"]);
            let mega = |bytes: Option<u64>| bytes.map_or("-".to_owned(), |bytes| digits(bytes as f64 / 1e6));
            writeln!(
                f,
                "| {} samples | {} | {} | {} | {} | {} | {} | {} |",
                pocket["samples"],
                size / 10,
                native("reading and engagement"),
                native("whole job"),
                browser.map_or("-".to_owned(), |time| digits(time.median / 1e6)),
                pocket["first"].as_f64().map_or("-".to_owned(), digits),
                mega(self.memory.get(2 * i + 1).map(|(_, bytes)| *bytes)),
                mega(pocket["bytes"].as_u64())
            )?;
        }
        writeln!(f)
    }

    fn jobs(&self, f: &mut Formatter<'_>, size: usize) -> fmt::Result {
        let samples = self.samples(size);
        let native = |name: &str| self.native.of(&format!("samples {size}"), name);
        writeln!(
            f,
            "| {samples} samples | native ms | least | Chromium ms | least | ratio | native ns per sample |"
        )?;
        writeln!(f, "| --- | ---: | ---: | ---: | ---: | ---: | ---: |")?;
        for stage in stages() {
            let browser = self.chromium(size, &format!("/stages/{stage}"));
            line(f, stage, native(stage), browser, 1e6, samples as f64)?;
        }
        let name = "whole job";
        line(f, name, native(name), self.chromium(size, "/whole/times"), 1e6, samples as f64)?;
        let first = self.chromium["jobs"][size.to_string()]["whole"]["first"].as_f64();
        writeln!(f, "\nThe first run in a fresh Worker: {:.0} ms.\n", first.unwrap_or(f64::NAN))
    }

    fn first_result(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let times = self.chromium["first_result"].as_array().map_or(&[][..], Vec::as_slice);
        let Some((cold, warm)) = times.split_first() else { return Ok(()) };
        if let Some(Time { median, least }) = Time::of_milliseconds(&json!(warm)) {
            writeln!(
                f,
                "From opening the page to its first result: {:.0} ms with nothing cached; \
                 {:.0} ms after that, the median of {} visits, {:.0} ms at least.\n",
                cold.as_f64().unwrap_or(f64::NAN),
                median / 1e6,
                warm.len(),
                least / 1e6
            )?;
        }
        Ok(())
    }

    fn poses(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let native = |name: &str| self.native.of("kinematics", name);
        let ns =
            |time: Option<Time>| time.map_or("-".to_owned(), |time| format!("{:.0}", time.median / COUNT));
        writeln!(f, "| ns a pose | Armill | in Chromium | rs-opw-kinematics | k | rs-opw / Armill |")?;
        writeln!(f, "| --- | ---: | ---: | ---: | ---: | ---: |")?;
        for name in POSES {
            let (ours, opw) = (native(name), native(&format!("rs-opw-kinematics: {name}")));
            let browser = Time::of_milliseconds(&self.chromium["kinematics"][name]);
            let k = native(&format!("k: {}", name.replace("every solution", "nearest")));
            writeln!(
                f,
                "| {name} | {} | {} | {} | {} | {} |",
                ns(ours),
                ns(browser),
                ns(opw),
                ns(k),
                ratio(opw, ours)
            )?;
        }
        writeln!(
            f,
            "\nk's inverse iterates to the nearest solution from one degree away; rs-opw-kinematics takes the Jacobian by differences.\n"
        )
    }

    /// Questions about the default job, natively on all cores.
    fn questions(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "| Question, natively | ms |\n|---|---|")?;
        for name in QUESTIONS {
            if let Some(time) = self.native.of("questions", name) {
                writeln!(f, "| {name} | {:.0} |", time.median / 1e6)?;
            }
        }
        let of = |name: &str| self.native.of("questions", name);
        writeln!(
            f,
            "\nA sweep on one core takes {} times as long.\n",
            ratio(of(QUESTIONS[1]), of(QUESTIONS[0]))
        )
    }

    fn memory(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "| memory at the peak, MB | native | Chromium |")?;
        writeln!(f, "| --- | ---: | ---: |")?;
        for (i, &size) in self.sizes.iter().enumerate() {
            let mega = |bytes: Option<u64>| {
                bytes.map_or("-".to_owned(), |bytes| format!("{:.0}", bytes as f64 / 1e6))
            };
            let chromium = mega(self.chromium["jobs"][size.to_string()]["whole"]["bytes"].as_u64());
            let native = mega(self.memory.get(2 * i).map(|(_, bytes)| *bytes));
            writeln!(f, "| {} samples | {native} | {chromium} |", self.samples(size))?;
        }
        Ok(())
    }
}

impl Display for Results {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for condition in &self.conditions {
            writeln!(f, "- {condition}")?;
        }
        writeln!(f)?;
        self.first_result(f)?;
        for &size in &self.sizes {
            self.jobs(f, size)?;
        }
        if let [small, .., large] = self.sizes[..] {
            let whole = |size: usize| self.native.of(&format!("samples {size}"), "whole job");
            let chromium = |size: usize| self.chromium(size, "/whole/times");
            let times = self.samples(large) as f64 / self.samples(small).max(1) as f64;
            writeln!(
                f,
                "{times:.1} times the samples take {} times as long natively, {} times in Chromium.\n",
                ratio(whole(large), whole(small)),
                ratio(chromium(large), chromium(small))
            )?;
        }
        self.pockets(f)?;
        self.poses(f)?;
        if let Some(time) = self.native.of("reading", "G-code, plain lines") {
            writeln!(
                f,
                "\n500,000 plain lines of G-code are read in {:.0} ms natively.\n",
                time.median / 1e6
            )?;
        }
        self.questions(f)?;
        self.memory(f)?;
        let drag = |key: &str| self.chromium["drag"][key].as_f64().unwrap_or(f64::NAN);
        writeln!(
            f,
            "\nA number of the default job dragged: {:.0} inputs, {:.0} results, {:.0} drawings of a chart \
             and {:.0} paintings of the page a second; \
             at most {:.0} ms between two paintings.",
            drag("inputs"),
            drag("results"),
            drag("charts"),
            drag("frames"),
            drag("longest_ms")
        )
    }
}

/// One row: medians and minimum times in `unit` ns, and the ratio of Chromium's median to the
/// native one.
fn line(
    f: &mut Formatter<'_>,
    name: &str,
    native: Option<Time>,
    browser: Option<Time>,
    unit: f64,
    samples: f64,
) -> fmt::Result {
    let pair = |time: Option<Time>| match time {
        Some(Time { median, least }) => format!("{} | {}", digits(median / unit), digits(least / unit)),
        None => "- | -".to_owned(),
    };
    let each = native.map_or("-".to_owned(), |time| format!("{:.0}", time.median / samples));
    writeln!(f, "| {name} | {} | {} | {} | {each} |", pair(native), pair(browser), ratio(browser, native))
}

fn ratio(above: Option<Time>, below: Option<Time>) -> String {
    above.zip(below).map_or("-".to_owned(), |(a, b)| format!("{:.2}", a.median / b.median))
}

/// Formats a number with three significant digits.
fn digits(value: f64) -> String {
    let places = if value >= 100.0 {
        0
    } else if value >= 10.0 {
        1
    } else if value >= 1.0 {
        2
    } else {
        3
    };
    format!("{value:.places$}")
}
