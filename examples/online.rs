//! What a loop on top of the path would bring for a job (the default job without a file): a sensor measures force or
//! position, and the controller corrects the arm every cycle. Prints one JSON object. Options change the job's own loop, if
//! it has one.
//!
//! ```sh
//! cargo run --release --example online -- [job.json] --measures force|position|load-side-angle --preset kuka-rsi-4
//! cargo run --release --example online -- [job.json] --measures position --cycle 0.004 --dead-time 0.03 --arm-lag 0.02
//!     [--sensor tracker|camera] [--delays 0:0.2:9]
//!     [--filter 0.01] [--gain 0.1] [--noise-mm 0.01] [--resolution-mm 0.01] [--largest-correction-mm 5] [--seed 1]
//! ```

use armill::online::{Comparison, LoopPreset, Measures, OnlineLoop, OnlineSummary, Sensor, SensorPreset};
use armill::study::ValueRange;
use armill::units::MM;
use armill::{Error, Job, Progress};
use serde_json::{Value, json};
use std::process::ExitCode;

const USAGE: &str = "online [job.json] --measures force|position|load-side-angle [--preset kuka-rsi-4|kuka-rsi-12|abb-egm|staubli-4] \
                     [--sensor tracker|camera] [--cycle s] [--dead-time s] [--arm-lag s] [--filter s] [--delays from:to:count] \
                     [--gain number] [--noise-mm mm] [--resolution-mm mm] [--largest-correction-mm mm] [--seed number]";

/// What is asked on the command line: the loop, changed option by option from that of the job, and dead times to compare.
struct Asked {
    online: OnlineLoop,
    delays: Option<ValueRange>,
}

/// The file that is named, and the options with their values.
fn sorted(mut arguments: impl Iterator<Item = String>) -> Result<(Option<String>, Vec<[String; 2]>), String> {
    let (mut file, mut options) = (None, Vec::new());
    while let Some(argument) = arguments.next() {
        if argument.starts_with('-') {
            let value = arguments.next().ok_or(format!("{argument} needs a value"))?;
            options.push([argument, value]);
        } else if file.replace(argument).is_some() {
            return Err("one job file at a time".into());
        }
    }
    Ok((file, options))
}

impl Asked {
    fn of(options: &[[String; 2]], of_job: Option<OnlineLoop>) -> Result<Self, String> {
        let times = LoopPreset::named("kuka-rsi-4").map_err(|error| error.to_string())?.times;
        let measures = Measures::Force;
        let plain = OnlineLoop { measures, times, sensor: Sensor::IDEAL, gain: None, plants: 0 };
        let online = OnlineLoop { plants: usize::MAX, ..of_job.unwrap_or(plain) };
        let mut asked = Self { online, delays: None };
        if of_job.is_none() && !options.iter().any(|[option, _]| option == "--measures") {
            return Err("--measures force, position or load-side-angle?".into());
        }
        options.iter().try_for_each(|[option, value]| asked.set(option, value))?;
        Ok(asked)
    }

    fn set(&mut self, option: &str, value: &str) -> Result<(), String> {
        let number = || {
            let number = value.parse::<f64>().ok().filter(|number| number.is_finite());
            number.ok_or(format!("{option} needs a number, not {value}"))
        };
        let length = || {
            number().and_then(|mm| {
                if mm >= 0.0 { Ok(mm * MM) } else { Err(format!("{option}: {value}, not negative")) }
            })
        };
        let OnlineLoop { measures, times, sensor, gain, .. } = &mut self.online;
        match option {
            "--measures" => {
                *measures = match value {
                    "force" => Measures::Force,
                    "position" => Measures::Position,
                    "load-side-angle" => Measures::LoadSideAngle,
                    _ => {
                        return Err(format!(
                            "{option} needs force, position or load-side-angle, not {value}"
                        ));
                    }
                }
            }
            "--preset" => *times = LoopPreset::named(value).map_err(|error| error.to_string())?.times,
            "--sensor" => {
                SensorPreset::named(value).map_err(|error| error.to_string())?.put_on(&mut self.online);
            }
            "--delays" => {
                let range = ValueRange::read(&format!("delays={value}"));
                self.delays = Some(range.map_err(|error| error.to_string())?);
            }
            "--cycle" => times.cycle = number()?,
            "--dead-time" => times.dead_time = number()?,
            "--arm-lag" => times.arm_lag = number()?,
            "--filter" => times.filter = number()?,
            "--gain" => *gain = Some(number()?),
            "--noise-mm" => sensor.noise = length()?,
            "--resolution-mm" => sensor.resolution = length()?,
            "--largest-correction-mm" => sensor.largest_correction = length()?,
            "--seed" => {
                sensor.seed =
                    value.parse().map_err(|_| format!("{option} needs a whole number, not {value}"))?
            }
            other => return Err(format!("unknown option {other}")),
        }
        Ok(())
    }

    fn answer(&self, job: &Job) -> Result<Value, Error> {
        let Self { online, delays } = self;
        let report = armill::run(job, &mut Progress::none())?;
        let run = report.looped();
        let mut answer = json!({ "online": run.with(online)?.summary() });
        if let Some(delays) = delays {
            let dead_times: Vec<f64> = (0..delays.count).map(|index| delays.at(index)).collect();
            let row = |(dead_time, compared): (&f64, Comparison)| {
                let OnlineSummary { online, both, helps_below_hz, .. } = compared.summary();
                json!({ "dead_time_s": dead_time, "online": online, "both": both, "helps_below_hz": helps_below_hz })
            };
            let compared = run.by_dead_time(online, &dead_times)?;
            answer["by_delay"] = dead_times.iter().zip(compared).map(row).collect();
        }
        Ok(answer)
    }
}

fn main() -> ExitCode {
    let (file, options) = match sorted(std::env::args().skip(1)) {
        Ok(sorted) => sorted,
        Err(message) => return usage(&message),
    };
    let text = match file.as_deref().map(std::fs::read_to_string) {
        None => Job::default().to_json(),
        Some(Ok(text)) => text,
        Some(Err(error)) => return usage(&format!("{}: {error}", file.unwrap_or_default())),
    };
    let job = Job::from_json(&text).and_then(|job| Ok((OnlineLoop::of(&job)?, job)));
    let (of_job, job) = match job {
        Ok(job) => job,
        Err(error) => return failed(&error),
    };
    let asked = match Asked::of(&options, of_job) {
        Ok(asked) => asked,
        Err(message) => return usage(&message),
    };
    match asked.answer(&job) {
        Ok(answer) => {
            use std::io::Write;
            // A reader that closed the pipe early (`| head`) is not an error.
            let _ =
                writeln!(std::io::stdout(), "{}", serde_json::to_string_pretty(&answer).unwrap_or_default());
            ExitCode::SUCCESS
        }
        Err(error) => failed(&error),
    }
}

fn failed(error: &Error) -> ExitCode {
    eprintln!("{}", json!(error));
    ExitCode::FAILURE
}

fn usage(message: &str) -> ExitCode {
    eprintln!("{}", json!({ "code": "usage", "message": message, "usage": USAGE }));
    ExitCode::from(2)
}
