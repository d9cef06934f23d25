//! Computes a job file (the default job without one) and prints its summary as one JSON object,
//! together with the accuracy of its path as a program (`as_program`). On request it writes all
//! columns.
//!
//! `cargo run --release --example run -- [job.json] [--columns out.csv]`

use armill::verification::Programs;
use armill::{Error, Job, Progress};
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let (mut job, mut columns) = (None, None);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--columns" => match arguments.next() {
                Some(file) => columns = Some(file),
                None => return usage("--columns needs a file"),
            },
            other if other.starts_with('-') => return usage(&format!("unknown option {other}")),
            _ if job.is_some() => return usage("one job file at a time"),
            file => job = Some(file.to_owned()),
        }
    }
    let text = match job.as_deref().map(std::fs::read_to_string) {
        None => Job::default().to_json(),
        Some(Ok(text)) => text,
        Some(Err(error)) => return usage(&format!("{}: {error}", job.unwrap_or_default())),
    };
    let report = match armill::run_json(&text, &mut Progress::none()) {
        Ok(report) => report,
        Err(error) => return refuse(&error),
    };
    if let Some(file) = columns
        && let Err(error) = std::fs::write(&file, armill::export::csv::columns(&report))
    {
        return usage(&format!("{file}: {error}"));
    }
    let mut summary = serde_json::json!(report.summary());
    summary["as_program"] = match Programs::default().usual_accuracy(&report) {
        Ok(promise) => serde_json::json!(promise),
        Err(error) => serde_json::json!({ "error": error.to_string() }),
    };
    match serde_json::to_string_pretty(&summary) {
        Ok(summary) => {
            use std::io::Write;
            // A reader that closed the pipe early (`| head`) is not an error.
            let _ = writeln!(std::io::stdout(), "{summary}");
            ExitCode::SUCCESS
        }
        Err(error) => usage(&error.to_string()),
    }
}

/// The error as one JSON object on stderr.
fn refuse(error: &Error) -> ExitCode {
    eprintln!("{}", serde_json::json!(error));
    ExitCode::FAILURE
}

fn usage(message: &str) -> ExitCode {
    eprintln!(
        "{}",
        serde_json::json!({ "code": "usage", "message": message, "usage": "run [job.json] [--columns out.csv]" })
    );
    ExitCode::FAILURE
}
