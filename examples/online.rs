//! What a loop on top of the path would bring for a job (the default job without a file): a sensor measures force or
//! position, and the controller corrects the arm every cycle. Prints one JSON object.
//!
//! ```sh
//! cargo run --release --example online -- [job.json] --measures force|position|load-side-angle --preset kuka-rsi-4
//! cargo run --release --example online -- [job.json] --measures position --cycle 0.004 --dead-time 0.03 --arm-lag 0.02
//!     [--delays 0:0.2:9] [--filter 0.01] [--gain 0.1] [--noise-mm 0.01] [--resolution-mm 0.01] [--largest-correction-mm 5] [--seed 1]
//! ```

use armill::online::{LoopPreset, LoopTimes, Measures, OnlineLoop, OnlineSummary, Sensor, compare};
use armill::study::ValueRange;
use armill::units::MM;
use armill::{Error, Job, Progress};
use serde_json::{Value, json};
use std::process::ExitCode;

const USAGE: &str = "online [job.json] --measures force|position|load-side-angle [--preset kuka-rsi-4|kuka-rsi-12|abb-egm|staubli-4] \
                     [--cycle s] [--dead-time s] [--arm-lag s] [--filter s] [--delays from:to:count] [--gain number] [--noise-mm mm] \
                     [--resolution-mm mm] [--largest-correction-mm mm] [--seed number]";

/// What is asked on the command line: the job's file, the loop, and dead times to compare.
struct Asked {
    file: Option<String>,
    online: OnlineLoop,
    delays: Option<ValueRange>,
}

fn read(mut arguments: impl Iterator<Item = String>) -> Result<Asked, String> {
    let times = LoopPreset::named("kuka-rsi-4").map_err(|error| error.to_string())?.times;
    let (mut file, mut measures, mut delays) = (None, None, None);
    let mut asked = OnlineLoop {
        measures: Measures::Force,
        times,
        sensor: Sensor::IDEAL,
        gain: None,
        plants: usize::MAX,
    };
    while let Some(argument) = arguments.next() {
        if !argument.starts_with('-') {
            if file.replace(argument).is_some() {
                return Err("one job file at a time".into());
            }
            continue;
        }
        let value = arguments.next().ok_or(format!("{argument} needs a value"))?;
        let number = || {
            let number = value.parse::<f64>().ok().filter(|number| number.is_finite());
            number.ok_or(format!("{argument} needs a number, not {value}"))
        };
        let length = || {
            number().and_then(|mm| {
                if mm >= 0.0 { Ok(mm * MM) } else { Err(format!("{argument}: {value}, not negative")) }
            })
        };
        let OnlineLoop { times: LoopTimes { cycle, dead_time, arm_lag, filter }, sensor, gain, .. } =
            &mut asked;
        match argument.as_str() {
            "--measures" => {
                measures = Some(match value.as_str() {
                    "force" => Measures::Force,
                    "position" => Measures::Position,
                    "load-side-angle" => Measures::LoadSideAngle,
                    _ => {
                        return Err(format!(
                            "--measures needs force, position or load-side-angle, not {value}"
                        ));
                    }
                });
            }
            "--preset" => {
                let known = LoopPreset::named(&value).map_err(|error| error.to_string())?.times;
                asked.times = known;
            }
            "--delays" => {
                let range = ValueRange::read(&format!("delays={value}"));
                delays = Some(range.map_err(|error| error.to_string())?);
            }
            "--cycle" => *cycle = number()?,
            "--dead-time" => *dead_time = number()?,
            "--arm-lag" => *arm_lag = number()?,
            "--filter" => *filter = number()?,
            "--gain" => *gain = Some(number()?),
            "--noise-mm" => sensor.noise = length()?,
            "--resolution-mm" => sensor.resolution = length()?,
            "--largest-correction-mm" => sensor.largest_correction = length()?,
            "--seed" => {
                sensor.seed =
                    value.parse().map_err(|_| format!("--seed needs a whole number, not {value}"))?
            }
            other => return Err(format!("unknown option {other}")),
        }
    }
    asked.measures = measures.ok_or("--measures force, position or load-side-angle?")?;
    Ok(Asked { file, online: asked, delays })
}

fn answer(text: &str, Asked { online, delays, .. }: &Asked) -> Result<Value, Error> {
    let report = armill::run(&Job::from_json(text)?, &mut Progress::none())?;
    let mut answer = json!({ "online": compare(&report, online)?.summary() });
    if let Some(delays) = delays {
        let row = |index: usize| -> Result<Value, Error> {
            let dead_time = delays.at(index);
            let times = LoopTimes { dead_time, ..online.times };
            let OnlineSummary { online, both, helps_below_hz, .. } =
                compare(&report, &OnlineLoop { times, ..*online })?.summary();
            Ok(json!({
                "dead_time_s": dead_time, "online": online, "both": both, "helps_below_hz": helps_below_hz,
            }))
        };
        answer["by_delay"] = json!((0..delays.count).map(row).collect::<Result<Vec<_>, _>>()?);
    }
    Ok(answer)
}

fn main() -> ExitCode {
    let asked = match read(std::env::args().skip(1)) {
        Ok(asked) => asked,
        Err(message) => return usage(&message),
    };
    let text = match asked.file.as_deref().map(std::fs::read_to_string) {
        None => Job::default().to_json(),
        Some(Ok(text)) => text,
        Some(Err(error)) => return usage(&format!("{}: {error}", asked.file.unwrap_or_default())),
    };
    match answer(&text, &asked) {
        Ok(answer) => {
            use std::io::Write;
            // A reader that closed the pipe early (`| head`) is not an error.
            let _ =
                writeln!(std::io::stdout(), "{}", serde_json::to_string_pretty(&answer).unwrap_or_default());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{}", json!(error));
            ExitCode::FAILURE
        }
    }
}

fn usage(message: &str) -> ExitCode {
    eprintln!("{}", json!({ "code": "usage", "message": message, "usage": USAGE }));
    ExitCode::from(2)
}
