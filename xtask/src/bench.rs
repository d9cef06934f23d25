//! Speed and memory, natively and in Chromium, side by side in one table. Nothing here passes or
//! fails: a time depends as much on the machine as on the code.

mod results;

use std::path::Path;
use std::process::Stdio;
use std::{env, fs};

use anyhow::{Context, Result, ensure};
use serde_json::Value;

use crate::browser;
use crate::browser::Driver;
use crate::server::Server;
use crate::site::{self, core, folder::mirror};
use crate::workspace::{self, cargo, output, run};
use results::{Native, Results};

/// Times everything for the default job with roughly this many samples each, `sizes` separated by
/// commas, and prints one table, which is also written to `target/bench/results.json`.
///
/// # Errors
/// If something does not compile or run.
pub(crate) fn bench(sizes: &str) -> Result<()> {
    let numbers: Vec<usize> = sizes
        .split(',')
        .map(|size| size.parse().with_context(|| format!("`{size}` is not a number of samples")))
        .collect::<Result<_>>()?;
    ensure!(
        numbers.iter().all(|size| (100..=2_000_000).contains(size)),
        "sizes must be from 100 to 2000000 samples"
    );
    let folder = workspace::root()?.join("target/bench");
    let site = page(&folder)?;
    browser::driver()?;
    // Compile everything before timing anything.
    for arguments in [&NATIVE[..], &MEMORY, &BROWSER] {
        run(cargo(&["bench", "--no-run"])?.args(arguments))?;
    }
    let load = load();
    let native = criterion(&folder, sizes)?;
    let memory = memory(sizes)?;
    let chromium = chromium(&folder, &site, sizes)?;
    let results =
        Results { conditions: conditions(&load, &chromium), sizes: numbers, native, memory, chromium };
    fs::write(folder.join("results.json"), serde_json::to_string_pretty(&results.json())?)?;
    println!("\n{results}");
    println!("The same numbers: target/bench/results.json");
    Ok(())
}

const NATIVE: [&str; 5] = ["--locked", "--package", "armill-bench", "--bench", "native"];
const MEMORY: [&str; 5] = ["--locked", "--package", "armill-bench", "--bench", "memory"];
/// A debug build, because it only sends requests and waits.
const BROWSER: [&str; 7] =
    ["--locked", "--package", "armill-bench", "--bench", "browser", "--profile", "dev"];

/// The site with the benchmark's page added.
fn page(folder: &Path) -> Result<std::path::PathBuf> {
    let site = folder.join("site");
    mirror(&site::build()?, &site, &["bench"])?;
    mirror(&workspace::root()?.join("benches/page"), &site.join("bench"), &[site::PKG])?;
    core::make(&workspace::root()?, core::BENCH, &site.join("bench").join(site::PKG))?;
    Ok(site)
}

/// Times by criterion.
fn criterion(folder: &Path, sizes: &str) -> Result<Native> {
    let results = folder.join("criterion");
    if results.exists() {
        fs::remove_dir_all(&results).context("cannot remove the results of an earlier run")?;
    }
    run(cargo(&["bench"])?
        .args(NATIVE)
        .args(["--", "--noplot"])
        .env("CRITERION_HOME", &results)
        .env("ARMILL_BENCH_SAMPLES", sizes))?;
    Native::read(&results)
}

/// Samples and peak memory [bytes] of each size; nothing where the system does not report it.
fn memory(sizes: &str) -> Result<Vec<(usize, u64)>> {
    let mut command = cargo(&["bench", "--quiet"])?;
    let output = command.args(MEMORY).env("ARMILL_BENCH_SAMPLES", sizes).stderr(Stdio::inherit()).output()?;
    let pair = |line: &str| {
        let (samples, bytes) = line.split_once(": ")?;
        Some((samples.parse().ok()?, bytes.parse().ok()?))
    };
    Ok(String::from_utf8_lossy(&output.stdout).lines().filter_map(pair).collect())
}

/// Times in the browser.
fn chromium(folder: &Path, site: &Path, sizes: &str) -> Result<Value> {
    let file = folder.join("browser.json");
    let server = Server::start_anywhere(site)?;
    let driver = Driver::start()?;
    run(cargo(&["bench", "--quiet"])?
        .args(BROWSER)
        .env("ARMILL_SITE_URL", &server.url)
        .env("ARMILL_WEBDRIVER_URL", driver.url())
        .env("ARMILL_BENCH_SAMPLES", sizes)
        .env("ARMILL_BENCH_RESULT", &file))?;
    Ok(serde_json::from_slice(&fs::read(file)?)?)
}

/// The machine's current load: how many programs wanted to run in the last minute.
fn load() -> String {
    let text = fs::read_to_string("/proc/loadavg").unwrap_or_default();
    text.split(' ').next().filter(|load| !load.is_empty()).unwrap_or("unknown").to_owned()
}

/// Where and when the numbers were taken.
fn conditions(load: &str, chromium: &Value) -> Vec<String> {
    let cpu = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = cpu.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let threads = std::thread::available_parallelism().map_or(0, usize::from);
    let agent = chromium["browser"].as_str().unwrap_or_default();
    let version = agent.split(' ').find(|word| word.contains("Chrome/")).unwrap_or("Chromium");
    vec![
        format!(
            "{}, {threads} threads, {}",
            model.map_or("unknown processor", |(_, name)| name),
            env::consts::OS
        ),
        format!("load of the last minute when the first was timed: {load}"),
        format!("{}, {version}", output("rustc", &["--version"]).unwrap_or_default()),
        format!("commit {}", output("git", &["describe", "--always", "--dirty"]).unwrap_or_default()),
    ]
}
