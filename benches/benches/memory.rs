//! Peak memory of a whole job and of one in a stock, in a separate process for each size in the
//! arguments. Prints a line `samples: bytes` for each.
#![allow(clippy::print_stdout, reason = "a command-line tool prints to standard output")]

use std::error::Error;
use std::process::Command;
use std::{env, fs};

use armill_bench::adaptive;
use armill_bench::stages::{job, whole};

fn main() -> Result<(), Box<dyn Error>> {
    if let Some(samples) = env::var_os("ARMILL_BENCH_ALONE") {
        let samples = samples.to_string_lossy().parse()?;
        let pocket = env::var_os("ARMILL_BENCH_POCKET").is_some();
        let report = whole(&if pocket { adaptive::job(samples) } else { job(samples) })?;
        println!("{}: {}", report.samples(), peak()?);
        return Ok(());
    }
    for samples in env::var("ARMILL_BENCH_SAMPLES")?.split(',') {
        for pocket in [None, Some(("ARMILL_BENCH_POCKET", "1"))] {
            let mut alone = Command::new(env::current_exe()?);
            let status = alone.env("ARMILL_BENCH_ALONE", samples).envs(pocket).status()?;
            if !status.success() {
                return Err(format!("{samples} samples: {status}").into());
            }
        }
    }
    Ok(())
}

/// Largest resident set of this process so far, as Linux counts it [bytes].
fn peak() -> Result<u64, Box<dyn Error>> {
    let status =
        fs::read_to_string("/proc/self/status").map_err(|_| "only Linux reports the peak of a process")?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).ok_or("no VmHWM")?;
    Ok(line.trim().trim_end_matches(" kB").parse::<u64>()? * 1024)
}
