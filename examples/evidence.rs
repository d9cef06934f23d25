//! Compares what others measured with what the model says of it, and prints one JSON object.
//!
//! ```sh
//! cargo run --release --example evidence
//! ```

use armill::{Error, Job, evidence};
use std::process::ExitCode;

const ROBOT: &str = include_str!("../web/examples/identify-fanuc-r2000ic.json");
const LOADS: &str = include_str!("../web/examples/identify-fanuc-r2000ic.csv");
const RUNS: [&str; 2] = [
    include_str!("../web/examples/gear-kuka-kr300-a.csv"),
    include_str!("../web/examples/gear-kuka-kr300-b.csv"),
];

fn main() -> ExitCode {
    match compared() {
        Ok(found) => {
            use std::io::Write;
            // A reader that closed the pipe early (`| head`) is not an error.
            let _ = writeln!(std::io::stdout(), "{found:#}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{}", serde_json::json!(error));
            ExitCode::FAILURE
        }
    }
}

fn compared() -> Result<serde_json::Value, Error> {
    let evidence = [
        evidence::loads(&Job::from_json(ROBOT)?, LOADS)?,
        evidence::encoders(RUNS[0], RUNS[1])?,
        evidence::slots(),
    ];
    Ok(serde_json::json!({ "evidence": evidence }))
}
