//! Writes the path of a job file as a package that a controller loads, and prints how it runs as one JSON
//! object: `{"files":[..],"max_mm":..,"p95_mm":..,"met":..,"duration_s":..,"points":..,"stops":..}`.
//!
//! `cargo run --release --example export -- job.json --out DIR [--controller kuka]`
//!
//! With `--interface kuka-rsi|abb-egm` it writes the correction alone instead, with what the interface needs that adds it to the
//! running desired program, and prints `{"files":[..],"rows":..,"cycle_s":..,"largest_mm":..}`.

use armill::export::post::robot::PackageFile;
use armill::export::superposed::{self, CorrectionTable, Interface};
use armill::setup::Controller;
use armill::units::MM;
use armill::verification::Programs;
use armill::{Error, Progress};
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

const USAGE: &str = "export job.json --out DIR [--controller kuka|abb|staubli|fanuc|gcode|apt|csv], \
     or export job.json --out DIR --interface kuka-rsi|abb-egm";

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let (mut job, mut controller, mut interface, mut out) = (None, None, None, None);
    while let Some(argument) = arguments.next() {
        let slot = match argument.as_str() {
            "--controller" => &mut controller,
            "--interface" => &mut interface,
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
    if interface.is_some() && controller.is_some() {
        return usage("a controller or an interface, not both");
    }
    let exported = match &interface {
        Some(interface) => added(&text, interface, Path::new(&out)),
        None => export(&text, controller.as_deref(), Path::new(&out)),
    };
    match exported {
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
    let mut printed = serde_json::json!(package);
    printed["files"] = write(&package.files, out)?;
    Ok(format!("{printed:#}"))
}

/// Writes the correction of the job `text` for an interface into the folder `out`.
fn added(text: &str, interface: &str, out: &Path) -> Result<String, Failure> {
    let interface = Interface::named(interface).map_err(Failure::Refused)?;
    let report = armill::run_json(text, &mut Progress::none()).map_err(Failure::Refused)?;
    let files = superposed::package(&report, interface).map_err(Failure::Refused)?;
    let table = CorrectionTable::of(&report);
    let printed = serde_json::json!({
        "files": write(&files, out)?,
        "rows": table.rows.len(),
        "cycle_s": table.cycle,
        "largest_mm": table.largest_shift / MM,
    });
    Ok(format!("{printed:#}"))
}

/// Writes files into a folder; their names.
fn write(files: &[PackageFile], out: &Path) -> Result<serde_json::Value, Failure> {
    let written = |error: std::io::Error| Failure::NotWritten(format!("{}: {error}", out.display()));
    std::fs::create_dir_all(out).map_err(written)?;
    for file in files {
        std::fs::write(out.join(&file.path), &file.text).map_err(written)?;
    }
    Ok(files.iter().map(|file| file.path.as_str()).collect())
}

fn usage(message: &str) -> ExitCode {
    eprintln!("{}", serde_json::json!({ "code": "usage", "message": message, "usage": USAGE }));
    ExitCode::FAILURE
}
