//! Identifies joint compliances from measured loads, or frequency and damping from a measured
//! response, and prints one JSON object.
//!
//! ```sh
//! cargo run --release --example identify -- \
//!     data.csv [--robot preset|job.json] [--joints table|coupled-j3]
//! cargo run --release --example identify -- data.csv --response [--from seconds]
//! cargo run --release --example identify -- data.csv --gear [--predict other.csv]
//! ```

use armill::identify::gear::GearLog;
use armill::identify::{Convention, gear, measurement, response, stiffness, summary};
use armill::{Error, Job};
use std::process::ExitCode;

const USAGE: &str = "identify data.csv [--robot preset|job.json] [--joints table|coupled-j3], \
     or identify data.csv --response [--from seconds], \
     or identify data.csv --gear [--predict other.csv]";

/// Why there is no result to print.
enum Refusal {
    Usage(String),
    Identify(Error),
}

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        Refusal::Identify(error)
    }
}

fn main() -> ExitCode {
    match identify() {
        Ok(found) => {
            use std::io::Write;
            // A reader that closed the pipe early (`| head`) is not an error.
            let _ = writeln!(std::io::stdout(), "{found:#}");
            ExitCode::SUCCESS
        }
        Err(Refusal::Usage(message)) => {
            eprintln!("{}", serde_json::json!({ "code": "usage", "message": message, "usage": USAGE }));
            ExitCode::FAILURE
        }
        Err(Refusal::Identify(error)) => {
            eprintln!("{}", serde_json::json!(error));
            ExitCode::FAILURE
        }
    }
}

fn identify() -> Result<serde_json::Value, Refusal> {
    let mut arguments = std::env::args().skip(1);
    let (mut data, mut robot, mut convention) = (None, None, Convention::Table);
    let (mut is_response, mut from) = (false, None);
    let (mut is_gear, mut other) = (false, None);
    while let Some(argument) = arguments.next() {
        let mut value =
            || arguments.next().ok_or_else(|| Refusal::Usage(format!("{argument} needs a value")));
        match argument.as_str() {
            "--robot" => robot = Some(value()?),
            "--joints" => convention = Convention::of(&value()?)?,
            "--response" => is_response = true,
            "--gear" => is_gear = true,
            "--predict" => other = Some(value()?),
            "--from" => {
                let text = value()?;
                let seconds = text.parse::<f64>().ok().filter(|seconds| seconds.is_finite());
                from = Some(
                    seconds.ok_or_else(|| Refusal::Usage(format!("--from {text} is no time in seconds")))?,
                );
            }
            other if other.starts_with('-') => return Err(Refusal::Usage(format!("unknown option {other}"))),
            _ if data.is_some() => return Err(Refusal::Usage("one file at a time".into())),
            _ => data = Some(argument),
        }
    }
    if other.is_some() && !is_gear {
        return Err(Refusal::Usage("--predict goes with --gear".into()));
    }
    let text = read(&data.ok_or_else(|| Refusal::Usage("which file?".into()))?)?;
    if is_response {
        let mode = response::mode(&response::Signal::read(&text)?, from)?;
        return Ok(serde_json::json!(summary::response(&mode)));
    }
    if is_gear {
        let others =
            other.map(|file| Ok::<_, Refusal>(gear::read_as(&read(&file)?, "other")?)).transpose()?;
        let logs = gear::read(&text)?;
        let common = |others: &Vec<GearLog>| {
            others.iter().any(|other| logs.iter().any(|log| log.joint == other.joint))
        };
        if others.as_ref().is_some_and(|others| !common(others)) {
            return Err(Refusal::Usage("--predict needs a run of the same joint".into()));
        }
        let fitted = logs.iter().map(|log| {
            let other = others.iter().flatten().find(|other| other.joint == log.joint);
            Ok(log.fit()?.summary(other))
        });
        return Ok(serde_json::json!({ "joints": fitted.collect::<Result<Vec<_>, Error>>()? }));
    }
    let job = match robot.as_deref() {
        None => Job::default(),
        Some(file) if file.ends_with(".json") => Job::from_json(&read(file)?)?,
        Some(preset) => {
            Job::from_json(&serde_json::json!({ "version": 1, "robot": { "preset": preset } }).to_string())?
        }
    };
    let robot = armill::setup::robot(&job)?;
    convention.suits(&robot)?;
    let measurements = measurement::read(&text, convention)?;
    let fit = stiffness::fit(&robot, &measurements.rows)?;
    Ok(serde_json::json!(summary::stiffness(&robot, &measurements, &fit)))
}

fn read(file: &str) -> Result<String, Refusal> {
    std::fs::read_to_string(file).map_err(|error| Refusal::Usage(format!("{file}: {error}")))
}
