//! What a measured pass teaches: the command of the next pass, and factors on stiffness and cutting force. Prints one JSON
//! object.
//!
//! ```sh
//! cargo run --release --example learn -- job.json log.csv
//! cargo run --release --example learn -- job.json log.csv --commanded desired --gain 0.7 --save learned.json --command next.csv
//! cargo run --release --example learn -- job.json second.csv --learned learned.json
//! cargo run --release --example learn -- job.json --cuts cuts.csv
//! ```

use armill::learn::frame::FRAMES;
use armill::learn::{
    Commanded, LearnSummary, LearnedCorrection, LearningGain, Log, MeasuredPass, NextPass, PassOptions,
    dynamometer,
};
use armill::units::MM;
use armill::verification::Programs;
use armill::{Error, Job, Progress, Report};
use serde_json::{Value, json};
use std::path::Path;
use std::process::ExitCode;

const USAGE: &str = "learn job.json log.csv [--commanded corrected|desired] [--learned learned.json] [--frame workpiece|base|world] \
                     [--shift s or mm] [--corner hz] [--gain number] [--save learned.json] [--command next.csv] [--program folder]\n\
                     learn job.json --cuts cuts.csv";

/// The files that the job's controller loads, in a folder.
fn write_program(report: &Report, folder: &str) -> Result<(), Failure> {
    let failed = |error: std::io::Error| Failure::Usage(format!("{folder}: {error}"));
    for file in Programs::default().package(report, None)?.files {
        let path = Path::new(folder).join(&file.path);
        std::fs::create_dir_all(path.parent().unwrap_or(Path::new(folder))).map_err(failed)?;
        std::fs::write(path, &file.text).map_err(failed)?;
    }
    Ok(())
}

/// Why nothing is printed: the command line, or the error of the job or the log.
enum Failure {
    Usage(String),
    Refused(Error),
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Refused(error)
    }
}

#[derive(Default)]
struct Asked {
    job: String,
    log: Option<String>,
    cuts: Option<String>,
    desired: bool,
    learned: Option<String>,
    frame: Option<&'static str>,
    shift: Option<f64>,
    corner: Option<f64>,
    gain: Option<f64>,
    save: Option<String>,
    command: Option<String>,
    program: Option<String>,
}

fn read(mut arguments: impl Iterator<Item = String>) -> Result<Asked, String> {
    let mut asked = Asked::default();
    let mut files = Vec::new();
    while let Some(argument) = arguments.next() {
        if !argument.starts_with("--") {
            files.push(argument);
            continue;
        }
        let value = arguments.next().ok_or(format!("{argument} needs a value"))?;
        let number = || {
            let number = value.parse::<f64>().ok().filter(|number| number.is_finite());
            number.ok_or(format!("{argument} needs a number, not {value}"))
        };
        match argument.as_str() {
            "--commanded" => match value.as_str() {
                "corrected" => asked.desired = false,
                "desired" => asked.desired = true,
                _ => return Err(format!("{argument} needs corrected or desired, not {value}")),
            },
            "--frame" => {
                let known = FRAMES.into_iter().find(|name| *name == value);
                asked.frame =
                    Some(known.ok_or(format!("{argument} needs workpiece, base or world, not {value}"))?);
            }
            "--shift" => asked.shift = Some(number()?),
            "--corner" => {
                let corner = number()?;
                if !(0.01..=1000.0).contains(&corner) {
                    return Err(format!("{argument} needs 0.01 to 1000 Hz, not {value}"));
                }
                asked.corner = Some(corner);
            }
            "--gain" => asked.gain = Some(number()?),
            "--learned" => asked.learned = Some(value),
            "--cuts" => asked.cuts = Some(value),
            "--save" => asked.save = Some(value),
            "--command" => asked.command = Some(value),
            "--program" => asked.program = Some(value),
            other => return Err(format!("unknown option {other}")),
        }
    }
    let mut files = files.into_iter();
    asked.job = files.next().ok_or("which job?")?;
    asked.log = files.next();
    if files.next().is_some() || asked.log.is_some() == asked.cuts.is_some() {
        return Err("a job and one log, or a job and --cuts".into());
    }
    Ok(asked)
}

fn file(path: &str) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|error| Failure::Usage(format!("{path}: {error}")))
}

fn write(path: &str, text: &str) -> Result<(), Failure> {
    std::fs::write(path, text).map_err(|error| Failure::Usage(format!("{path}: {error}")))
}

fn answer(asked: &Asked) -> Result<Value, Failure> {
    let job = Job::from_json(&file(&asked.job)?)?;
    let report = armill::run(&job, &mut Progress::none())?;
    if let Some(cuts) = &asked.cuts {
        let cuts = dynamometer::read(&file(cuts)?)?;
        return Ok(json!({ "cut": dynamometer::fit(&report.setup().cut, &cuts)? }));
    }
    let log_file = asked.log.clone().unwrap_or_default();
    let log = Log::read(&file(&log_file)?)?;
    let commanded = match &asked.learned {
        Some(path) => LearnedCorrection::from_json(&file(path)?)?.commanded(&report),
        None => Commanded { corrected: !asked.desired, learned: vec![] },
    };
    let by_length = matches!(log.clock, armill::learn::log::Clock::Length(_));
    let shift = asked.shift.map(|shift| if by_length { shift * MM } else { shift });
    let options = PassOptions { commanded, frame: asked.frame, shift, corner: asked.corner };
    let measured = MeasuredPass::of(&report, &log, &options)?;
    let gain = asked.gain.map_or(Ok(LearningGain::USUAL), LearningGain::new)?;
    let next = if measured.error.is_empty() { None } else { Some(NextPass::of(&report, &measured, gain)?) };
    let summary =
        LearnSummary::of(&report, job.learned.as_ref(), &measured, next.as_ref().map(|next| (next, gain)));
    if let Some(next) = &next {
        let kept = Commanded { corrected: measured.commanded.corrected, learned: next.learned.clone() };
        if let Some(path) = &asked.save {
            write(path, &json!(LearnedCorrection::of(&report, &kept)).to_string())?;
        }
        if let Some(path) = &asked.program {
            write_program(&next.report(&report), path)?;
        }
        if let Some(path) = &asked.command {
            write(path, &next.table(&report))?;
        }
    }
    // The band of the job that has learned, beside what it was.
    let wiser = Job { learned: Some(summary.factors.learned.clone()), ..job };
    let expected = armill::run(&wiser, &mut Progress::none())?.summary().expected_mm;
    let mut answer = json!(summary);
    answer["expected_mm"] = json!({ "before": report.summary().expected_mm, "with_factors": expected });
    Ok(answer)
}

fn main() -> ExitCode {
    let answer = read(std::env::args().skip(1)).map_err(Failure::Usage).and_then(|asked| answer(&asked));
    match answer {
        Ok(answer) => {
            use std::io::Write;
            // A reader that closed the pipe early (`| head`) is not an error.
            let _ =
                writeln!(std::io::stdout(), "{}", serde_json::to_string_pretty(&answer).unwrap_or_default());
            ExitCode::SUCCESS
        }
        Err(Failure::Refused(error)) => {
            eprintln!("{}", json!(error));
            ExitCode::FAILURE
        }
        Err(Failure::Usage(message)) => {
            eprintln!("{}", json!({ "code": "usage", "message": message, "usage": USAGE }));
            ExitCode::from(2)
        }
    }
}
