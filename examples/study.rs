//! Answers questions about a job (the default job without a file): how its errors follow one number
//! or choice, or two, how large a number may be, which robot and which choice does it best, which input moves it
//! most, what to measure first. Prints one JSON object, or the rows as CSV.
//!
//! ```sh
//! cargo run --release --example study -- [job.json] --vary cutting.axial_depth_mm=0.5:5:20 [--vary ..]
//! cargo run --release --example study -- [job.json] --vary material.preset=all
//! cargo run --release --example study -- [job.json] --largest cutting.axial_depth_mm=0.1:10 --quantity p95
//! cargo run --release --example study -- [job.json] --robots [--place kept|front|sought]
//! cargo run --release --example study -- [job.json] --choices
//! cargo run --release --example study -- [job.json] --tornado
//! cargo run --release --example study -- [job.json] --measure-first
//! ```

use armill::study::{ErrorMeasure, LargestQuestion, PartPlace, Variation, choices, robots, sweep, tornado};
use armill::{Error, Job, Progress};
use serde_json::{Value, json};
use std::process::ExitCode;

const USAGE: &str = "study [job.json] (--vary path=from:to:count[:log]|path=word,word|path=all [--vary ..] | --largest path=from:to \
                     [--quantity nominal|p95|uncompensated] | --robots [--place kept|front|sought] | --choices | \
                     --tornado | --measure-first) [--csv]";

/// What is asked on the command line.
#[derive(Default)]
struct Asked {
    job: Option<String>,
    vary: Vec<String>,
    largest: Option<String>,
    quantity: Option<String>,
    robots: bool,
    choices: bool,
    tornado: bool,
    measure_first: bool,
    place: Option<String>,
    csv: bool,
}

impl Asked {
    fn read(mut arguments: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut asked = Self::default();
        while let Some(argument) = arguments.next() {
            let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
            match argument.as_str() {
                "--vary" => asked.vary.push(value()?),
                "--largest" => asked.largest = Some(value()?),
                "--quantity" => asked.quantity = Some(value()?),
                "--robots" => asked.robots = true,
                "--choices" => asked.choices = true,
                "--tornado" => asked.tornado = true,
                "--measure-first" => asked.measure_first = true,
                "--place" => asked.place = Some(value()?),
                "--csv" => asked.csv = true,
                other if other.starts_with('-') => return Err(format!("unknown option {other}")),
                _ if asked.job.is_some() => return Err("one job file at a time".into()),
                file => asked.job = Some(file.to_owned()),
            }
        }
        let questions = [
            !asked.vary.is_empty(),
            asked.largest.is_some(),
            asked.robots,
            asked.choices,
            asked.tornado,
            asked.measure_first,
        ];
        match questions.iter().filter(|is_asked| **is_asked).count() {
            1 => Ok(asked),
            _ => Err("one question at a time: --vary, --largest, --robots, --choices, --tornado or \
                      --measure-first"
                .into()),
        }
    }

    fn answer(&self, job: &Job) -> Result<Value, Error> {
        if let Some(text) = &self.largest {
            let quantity = ErrorMeasure::named(self.quantity.as_deref().unwrap_or("p95"))?;
            return Ok(json!(LargestQuestion::read(text, quantity)?.answer(job)?));
        }
        if self.robots {
            let place = PartPlace::named(self.place.as_deref().unwrap_or("kept"))?;
            return Ok(json!({ "robots": robots(job, place)? }));
        }
        if self.choices {
            return Ok(json!({ "choices": choices(job) }));
        }
        if self.tornado {
            return Ok(json!({ "tornado": tornado(&armill::run(job, &mut Progress::none())?) }));
        }
        if self.measure_first {
            let report = armill::run(job, &mut Progress::none())?;
            return Ok(json!({ "measures": report.how_sure().measures }));
        }
        let ranges: Vec<Variation> =
            self.vary.iter().map(|text| Variation::read(text)).collect::<Result<_, _>>()?;
        Ok(json!({ "vary": ranges, "rows": sweep(job, &ranges)? }))
    }
}

fn main() -> ExitCode {
    let asked = match Asked::read(std::env::args().skip(1)) {
        Ok(asked) => asked,
        Err(message) => return usage(&message),
    };
    let text = match asked.job.as_deref().map(std::fs::read_to_string) {
        None => Job::default().to_json(),
        Some(Ok(text)) => text,
        Some(Err(error)) => return usage(&format!("{}: {error}", asked.job.unwrap_or_default())),
    };
    match Job::from_json(&text).and_then(|job| asked.answer(&job)) {
        Ok(answer) => {
            let text = if asked.csv {
                csv(&answer)
            } else {
                serde_json::to_string_pretty(&answer).unwrap_or_default()
            };
            use std::io::Write;
            // A reader that closed the pipe early (`| head`) is not an error.
            let _ = writeln!(std::io::stdout(), "{}", text.trim_end());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{}", json!(error));
            ExitCode::FAILURE
        }
    }
}

/// The rows of an answer: a column for each key that a row of this kind can have.
fn csv(answer: &Value) -> String {
    let numbers = ["value", "second"];
    let rows = |key: &str| answer[key].as_array().map(|rows| rows.iter().collect::<Vec<_>>());
    let with_outcome = |keys: &[&'static str]| keys.iter().copied().chain(OUTCOME).collect::<Vec<_>>();
    let (rows, keys) = if let Some(rows) = rows("robots") {
        (rows, with_outcome(&ARM))
    } else if let Some(rows) = rows("choices") {
        (rows, with_outcome(&["choice", "label"]))
    } else if let Some(bars) = answer["tornado"]["bars"].as_array() {
        (bars.iter().collect(), vec!["input", "factors", "after_mm", "before_mm"])
    } else if let Some(rows) = rows("measures") {
        (rows, vec!["input", "percent", "p95_mm", "sentence"])
    } else if let Some(rows) = rows("rows") {
        let count = answer["vary"].as_array().map_or(1, Vec::len);
        (rows, with_outcome(&numbers[..count]))
    } else {
        (vec![answer], vec!["path", "largest", "quantity", "tolerance_mm", "holds"])
    };
    let cell = |value: &Value| match value {
        Value::Null => String::new(),
        Value::String(text) if text.contains([',', '"', '\n']) => {
            format!("\"{}\"", text.replace('"', "\"\""))
        }
        Value::String(text) => text.clone(),
        // Both ends of a range.
        Value::Array(numbers) => numbers.iter().map(Value::to_string).collect::<Vec<_>>().join(" "),
        other => other.to_string(),
    };
    let line = |row: &Value| keys.iter().map(|key| cell(&row[*key])).collect::<Vec<_>>().join(",");
    let mut text = keys.join(",") + "\n";
    for row in rows {
        text += &line(row);
        text += "\n";
    }
    text
}

/// Keys of an arm.
const ARM: [&str; 10] = [
    "id",
    "name",
    "payload_kg",
    "reach_mm",
    "stiffness",
    "spin_deg",
    "duration_s",
    "force_n",
    "limit_room_deg",
    "singularity_deg",
];
/// Keys of an outcome.
const OUTCOME: [&str; 7] =
    ["before_max_mm", "after_max_mm", "p50_mm", "p95_mm", "verdict_state", "cannot_run", "error"];

fn usage(message: &str) -> ExitCode {
    eprintln!("{}", json!({ "code": "usage", "message": message, "usage": USAGE }));
    ExitCode::FAILURE
}
