//! The search for texts that break Armill: libFuzzer, guided by coverage, on the targets of
//! `tests/fuzz/`.

use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

use anyhow::{Context, Result, bail};

use crate::npm;
use crate::workspace::{cargo, output, root, run};

/// The page's reader of links, which is JavaScript: `tests/fuzz/link.mjs` mutates the links of the
/// corpus at random.
const LINK: &str = "link";

/// The targets of `tests/fuzz/target.rs`, each with a folder in `tests/fuzz/corpus/`.
const TARGETS: [&str; 5] = ["gcode", "apt", "csv", "job", "export"];

/// Flags with which stable Rust reports code coverage to libFuzzer.
const INSTRUMENTED: &str = "-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=3 \
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
    -Cllvm-args=-sanitizer-coverage-trace-compares -Ccodegen-units=16";

/// Searches for some seconds on one target, or on each. Texts that reach new code are added to the
/// corpus; a text that breaks a law ends the search and stays in `target/fuzz/`, as the output
/// says.
///
/// # Errors
/// If a law is broken, or the engine cannot be built, which takes a C++ compiler.
pub(crate) fn fuzz(target: Option<&str>, seconds: u32) -> Result<()> {
    let folder = root()?.join("tests/fuzz");
    if target == Some(LINK) {
        return link(seconds, any_seed());
    }
    let targets = match target {
        Some(target) => vec![*TARGETS.iter().find(|known| **known == target).with_context(|| {
            format!("unknown target {target}; the targets are {} and {LINK}", TARGETS.join(", "))
        })?],
        None => TARGETS.to_vec(),
    };
    let engine = build()?;
    let found = root()?.join("target/fuzz");
    for target in targets {
        println!("\n=== {target}");
        let (kept, fresh) = (folder.join("corpus").join(target), found.join(target));
        fs::create_dir_all(&fresh)?;
        let engine = || {
            let mut command = Command::new(&engine);
            command.env("ARMILL_FUZZ_TARGET", target);
            // Instrumented code is ten times slower, each text is read four times, and others use the machine.
            command.args(["-timeout=120", "-max_len=4096"]);
            command
        };
        let bad = format!("-artifact_prefix={}/{target}-", found.display());
        let limit = format!("-max_total_time={seconds}");
        run(engine().args([bad.as_str(), limit.as_str(), "-print_final_stats=1"]).args([&fresh, &kept]))?;
        // Counting how often code runs would keep thousands of texts that differ in nothing else.
        run(engine().args(["-merge=1", "-use_counters=0"]).args([&kept, &fresh]))?;
    }
    if target.is_none() { link(seconds, any_seed()) } else { Ok(()) }
}

/// Mutates links for some seconds, in Node; the same seed tries the same ones.
///
/// # Errors
/// If a link breaks a law, or there is no Node.
pub(crate) fn link(seconds: u32, seed: u32) -> Result<()> {
    println!("\n=== {LINK}, seed {seed}");
    let words = [seconds, seed].map(|number| number.to_string());
    run(npm::node()?.arg(root()?.join("tests/fuzz/link.mjs")).args(words))
}

/// A different seed every time.
fn any_seed() -> u32 {
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.subsec_nanos())
}

/// Builds the engine, which is not a member of the workspace, with all of Armill instrumented.
fn build() -> Result<PathBuf> {
    let rustc = output("rustc", &["-vV"]).context("rustc does not report its version")?;
    let Some(host) = rustc.lines().find_map(|line| line.strip_prefix("host: ")) else {
        bail!("rustc does not report its host");
    };
    let manifest = ["--manifest-path", "tests/fuzz/engine/Cargo.toml", "--target-dir", "target/fuzz/build"];
    // With an explicit target, the flags do not apply to build scripts.
    run(cargo(&["build", "--release", "--target", host])?.args(manifest).env("RUSTFLAGS", INSTRUMENTED))?;
    Ok(root()?.join("target/fuzz/build").join(host).join("release/fuzz-engine"))
}
