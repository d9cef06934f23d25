//! The core as WebAssembly: compiled, bound to JavaScript, and weighed. There is one, for every
//! page, Worker and package.

use std::ffi::OsStr;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use anyhow::{Context, Result, ensure};
use flate2::Compression;
use flate2::write::GzEncoder;

use crate::workspace::{self, WASM};

/// Cargo's package with the core.
pub(crate) const PACKAGE: &str = "armill";

/// The package with the core and the benchmark's own functions, for `cargo xtask bench` alone.
pub(crate) const BENCH: &str = "armill-bench";

/// The module in the folder that [`make`] fills.
pub(crate) const MODULE: &str = "armill_bg.wasm";

/// Size limits of the core in bytes, as it is and compressed by gzip: every visit fetches it. With the
/// coupling, the feed rule, the surface left, the questions with their charts, the part on the map, the loop of a job, learning
/// from a pass, evidence and the files for interfaces it has 2,620,000 and 1,055,000; these are 1 % more.
/// Raise them only with a reason in CHANGELOG.md.
pub(super) const LIMITS: [usize; 2] = [2_646_000, 1_066_000];

/// Makes the core in `package` from the sources in `root`: `folder` gets the module, its JavaScript
/// side and their types.
///
/// # Errors
/// If it does not compile, or a tool is missing.
pub(crate) fn make(root: &Path, package: &str, folder: &Path) -> Result<()> {
    workspace::add_wasm_target()?;
    bind(&compile(root, package)?, folder).context("wasm-bindgen failed")
}

/// Prints the size of a module, as it is and compressed, and rejects one that exceeds either limit.
///
/// # Errors
/// If it is too large, or cannot be read.
pub(super) fn weigh(module: &Path, [raw_limit, zipped_limit]: [usize; 2]) -> Result<()> {
    let content = fs::read(module).with_context(|| format!("cannot read {}", module.display()))?;
    let (raw, zipped) = (content.len(), compressed(&content)?.len());
    println!("The core has {raw} bytes, {zipped} compressed");
    ensure!(
        raw <= raw_limit && zipped <= zipped_limit,
        "{} has {raw} bytes, {zipped} compressed by gzip; at most {raw_limit} and {zipped_limit} are allowed",
        module.display()
    );
    Ok(())
}

/// The bytes compressed by gzip at its best level.
///
/// # Errors
/// Never: writing to memory does not fail.
pub(super) fn compressed(bytes: &[u8]) -> Result<Vec<u8>> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    Ok(encoder.finish()?)
}

/// Compiles the library of `package` and returns the raw module.
fn compile(root: &Path, package: &str) -> Result<PathBuf> {
    let arguments = ["rustc", "--release", "--locked", "--target", WASM, "--package", package, "--lib"];
    let mut command = workspace::cargo(&arguments)?;
    command.current_dir(root);
    // An explicit folder, because the site has to be found in `target` whatever the environment
    // says.
    command.args(["--target-dir", "target"]);
    if let Some(home) = workspace::cargo_home() {
        // Panic messages name source files: without this machine's home folder the core is the same
        // everywhere.
        let flag = format!("--remap-path-prefix={}=cargo", home.display());
        command.args(["--config", &format!("target.{WASM}.rustflags=['{flag}']")]);
    }
    // Calls that are not inlined cost little where numbers are computed, and save a tenth of the
    // bytes.
    command.args(["--", "-C", "llvm-args=-inline-threshold=75"]);
    workspace::run(&mut command)?;
    Ok(root.join("target").join(WASM).join("release").join(package.replace('-', "_") + ".wasm"))
}

/// Turns the raw module into one with a JavaScript interface, in `folder`.
fn bind(wasm: &Path, folder: &Path) -> Result<()> {
    let outputs = ["armill.js", MODULE, "armill.d.ts"].map(|name| folder.join(name));
    // This program is an input too: it holds wasm-bindgen and the options below.
    let inputs = [wasm.to_path_buf(), std::env::current_exe()?];
    if is_newer(&outputs, &inputs)? {
        return Ok(());
    }
    let options =
        ["--target", "web", "--out-name", "armill", "--remove-name-section", "--remove-producers-section"];
    let mut words = vec![OsStr::new("wasm-bindgen"), wasm.as_os_str()];
    words.extend(options.map(OsStr::new));
    words.extend([OsStr::new("--out-dir"), folder.as_os_str()]);
    wasm_bindgen_cli::wasm_bindgen::run_cli_with_args(words)
}

/// Whether every output exists and is at least as new as every input.
fn is_newer(outputs: &[PathBuf], inputs: &[PathBuf]) -> Result<bool> {
    let changed = |path: &PathBuf| -> Result<SystemTime> {
        let metadata = fs::metadata(path).with_context(|| format!("cannot read {}", path.display()))?;
        Ok(metadata.modified()?)
    };
    let newest = inputs.iter().map(changed).collect::<Result<Vec<_>>>()?.into_iter().max();
    Ok(outputs.iter().all(|output| changed(output).ok() >= newest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    fn age(path: &Path, seconds: u64) {
        let file = fs::File::options().write(true).open(path).unwrap();
        file.set_modified(SystemTime::now() - Duration::from_secs(seconds)).unwrap();
    }

    #[test]
    fn a_file_above_either_limit_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("core.wasm");
        fs::write(&file, [0; 1000]).unwrap();
        assert!(weigh(&file, [1000, 100]).is_ok());
        let refusal = weigh(&file, [999, 100]).unwrap_err().to_string();
        assert!(refusal.contains("has 1000 bytes") && refusal.contains("at most 999 and 100"), "{refusal}");
        assert!(weigh(&file, [1000, 5]).is_err(), "1000 equal bytes compress to some twenty");
        assert!(weigh(&folder.path().join("missing"), [1000, 100]).is_err());
    }

    #[test]
    fn outputs_are_stale_if_one_is_older_or_missing() {
        let folder = tempfile::tempdir().unwrap();
        let [input, old, new, missing] =
            ["input", "old", "new", "missing"].map(|name| folder.path().join(name));
        for (path, seconds) in [(&old, 30), (&input, 20), (&new, 10)] {
            fs::write(path, "").unwrap();
            age(path, seconds);
        }
        let newer = |outputs: &[PathBuf]| is_newer(outputs, std::slice::from_ref(&input)).unwrap();
        assert!(newer(std::slice::from_ref(&new)));
        assert!(!newer(&[new.clone(), old]));
        assert!(!newer(&[new, missing]));
    }
}
