//! The most memory a whole job ever holds, in a process of its own for each size in the arguments; `size: bytes` a line.
#![allow(clippy::print_stdout, reason = "a command-line tool speaks on its standard output")]

use std::error::Error;
use std::process::Command;
use std::{env, fs};

use armill_bench::stages::{job, whole};

fn main() -> Result<(), Box<dyn Error>> {
    if let Some(samples) = env::var_os("ARMILL_BENCH_ALONE") {
        let report = whole(&job(samples.to_string_lossy().parse()?))?;
        println!("{}: {}", report.samples(), peak()?);
        return Ok(());
    }
    for samples in env::var("ARMILL_BENCH_SAMPLES")?.split(',') {
        let status = Command::new(env::current_exe()?).env("ARMILL_BENCH_ALONE", samples).status()?;
        if !status.success() {
            return Err(format!("{samples} samples: {status}").into());
        }
    }
    Ok(())
}

/// The largest resident set of this process so far, as Linux counts it [bytes].
fn peak() -> Result<u64, Box<dyn Error>> {
    let status =
        fs::read_to_string("/proc/self/status").map_err(|_| "only Linux tells the peak of a process")?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).ok_or("no VmHWM")?;
    Ok(line.trim().trim_end_matches(" kB").parse::<u64>()? * 1024)
}
