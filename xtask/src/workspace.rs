//! The checkout, and the programs run in it.

use std::env;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

/// The target of the browser's code.
pub(crate) const WASM: &str = "wasm32-unknown-unknown";

/// The root folder of the checkout.
///
/// # Errors
/// If this program was not started by cargo, which sets the checkout's path.
pub(crate) fn root() -> Result<PathBuf> {
    let package = env::var_os("CARGO_MANIFEST_DIR").context("start this with `cargo xtask`")?;
    let root = Path::new(&package).parent().context("xtask has no parent folder")?;
    Ok(root.to_path_buf())
}

/// The cargo that started this program, at the root of the checkout.
///
/// # Errors
/// As for [`root`].
pub(crate) fn cargo(arguments: &[&str]) -> Result<Command> {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(arguments).current_dir(root()?);
    Ok(command)
}

/// The folder in which cargo keeps the sources of dependencies.
pub(crate) fn cargo_home() -> Option<PathBuf> {
    let stated = env::var_os("CARGO_HOME").map(PathBuf::from);
    stated.or_else(|| Some(env::home_dir()?.join(".cargo")))
}

/// Runs a program to completion, in this terminal.
///
/// # Errors
/// If it cannot be started, or fails.
pub(crate) fn run(command: &mut Command) -> Result<()> {
    let line = line(command);
    let status = command.status().with_context(|| format!("cannot start `{line}`"))?;
    ensure!(status.success(), "`{line}` failed ({status})");
    Ok(())
}

/// Runs a program silently and returns its output, or nothing if it cannot be started or fails.
pub(crate) fn output(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).stderr(Stdio::null()).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// A program of this name on the search path.
pub(crate) fn program(name: &str) -> Option<PathBuf> {
    let file = format!("{name}{}", env::consts::EXE_SUFFIX);
    env::split_paths(&env::var_os("PATH")?).map(|folder| folder.join(&file)).find(|path| path.is_file())
}

/// Whether system packages can be installed from here: root on Debian or Ubuntu.
pub(crate) fn may_install() -> bool {
    program("apt-get").is_some() && output("id", &["-u"]).as_deref() == Some("0")
}

/// Installs system packages.
///
/// # Errors
/// If apt-get fails.
pub(crate) fn install(packages: &[&str]) -> Result<()> {
    let apt = || Command::new("apt-get");
    run(apt().arg("update"))?;
    let quietly = ["install", "-y", "--no-install-recommends"];
    run(apt().env("DEBIAN_FRONTEND", "noninteractive").args(quietly).args(packages))
}

/// Adds the WebAssembly target to the toolchain in use, if it is missing.
///
/// # Errors
/// If rustup is missing too, or fails.
pub(crate) fn add_wasm_target() -> Result<()> {
    let installed = output("rustc", &["--print", "target-libdir", "--target", WASM]);
    if installed.is_some_and(|folder| Path::new(&folder).is_dir()) {
        return Ok(());
    }
    run(Command::new("rustup").args(["target", "add", WASM]))
        .with_context(|| format!("the Rust toolchain lacks the target {WASM}"))
}

/// Adds rustfmt and clippy to the toolchain in use, if they are missing.
///
/// # Errors
/// If rustup is missing too, or fails.
pub(crate) fn add_linters() -> Result<()> {
    for (component, subcommand) in [("rustfmt", "fmt"), ("clippy", "clippy")] {
        if output("cargo", &[subcommand, "--version"]).is_none() {
            run(Command::new("rustup").args(["component", "add", component]))
                .with_context(|| format!("the Rust toolchain lacks {component}"))?;
        }
    }
    Ok(())
}

/// The command as typed in a shell.
fn line(command: &Command) -> String {
    let program = Path::new(command.get_program()).file_stem().unwrap_or(command.get_program());
    let words: Vec<_> = [program].into_iter().chain(command.get_args()).map(OsStr::to_string_lossy).collect();
    words.join(" ")
}
