//! Prints what the page's form is built from, as JSON: `cargo xtask build` makes a file of it, so that the core that every visit loads need
//! not hold it.

use armill::Job;
use armill::job::{fields, presets};
use armill::report::format::FORMATS;
use serde_json::json;
use std::io::{Error, Write, stdout};

fn main() -> Result<(), Error> {
    let form = json!({
        "version": env!("CARGO_PKG_VERSION"), "job": Job::default(),
        "fields": fields::fields(), "presets": presets::presets(), "formats": FORMATS.to_vec(),
    });
    writeln!(stdout(), "{form}")
}
