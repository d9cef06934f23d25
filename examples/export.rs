//! Writes the path of a job file as a package that a controller loads, and prints how it runs as one JSON
//! object: `{"files":[..],"max_mm":..,"p95_mm":..,"met":..,"duration_s":..,"points":..,"stops":..}`.
//!
//! `cargo run --release --example export -- job.json --out DIR [--controller kuka]`

use armill::setup::Controller;
use armill::verification::Programs;
use armill::{Error, Progress};
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

const USAGE: &str = "export job.json --out DIR [--controller kuka|abb|staubli|fanuc|gcode|apt|csv]";

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let (mut job, mut controller, mut out) = (None, None, None);
    while let Some(argument) = arguments.next() {
        let slot = match argument.as_str() {
            "--controller" => &mut controller,
            "--out" => &mut out,
            other if other.starts_with('-') => return usage(&format!("unknown option {other}")),
            _ if job.is_some() => return usage("one job file at a time"),
            file => {
                job = Some(file.to_owned());
                continue;
            }
        };
        match arguments.next() {
            Some(value) => *slot = Some(value),
            None => return usage(&format!("{argument} needs a value")),
        }
    }
    let (Some(job), Some(out)) = (job, out) else { return usage("a job file and --out are needed") };
    let text = match std::fs::read_to_string(&job) {
        Ok(text) => text,
        Err(error) => return usage(&format!("{job}: {error}")),
    };
    match export(&text, controller.as_deref(), Path::new(&out)) {
        Ok(printed) => {
            // A reader that closed the pipe early (`| head`) is not an error.
            let _ = writeln!(std::io::stdout(), "{printed}");
            ExitCode::SUCCESS
        }
        Err(Failure::Refused(error)) => {
            eprintln!("{}", serde_json::json!(error));
            ExitCode::FAILURE
        }
        Err(Failure::NotWritten(message)) => usage(&message),
    }
}

enum Failure {
    Refused(Error),
    NotWritten(String),
}

/// Writes the files of the job `text` into the folder `out`.
fn export(text: &str, controller: Option<&str>, out: &Path) -> Result<String, Failure> {
    let controller = controller.map(Controller::named).transpose().map_err(Failure::Refused)?;
    let report = armill::run_json(text, &mut Progress::none()).map_err(Failure::Refused)?;
    let package = Programs::default().package(&report, controller).map_err(Failure::Refused)?;
    let written = |error: std::io::Error| Failure::NotWritten(format!("{}: {error}", out.display()));
    std::fs::create_dir_all(out).map_err(written)?;
    for file in &package.files {
        std::fs::write(out.join(&file.path), &file.text).map_err(written)?;
    }
    let mut printed = serde_json::json!(package);
    printed["files"] = package.files.iter().map(|file| file.path.as_str()).collect();
    serde_json::to_string_pretty(&printed).map_err(|error| Failure::NotWritten(error.to_string()))
}

fn usage(message: &str) -> ExitCode {
    eprintln!("{}", serde_json::json!({ "code": "usage", "message": message, "usage": USAGE }));
    ExitCode::FAILURE
}
