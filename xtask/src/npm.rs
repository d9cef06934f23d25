//! The core as an npm package, and the packages that the tests use.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::site::{self, folder::update};
use crate::workspace::{self, output, program, run};

/// Debian's packages of Node and npm.
const PACKAGES: [&str; 2] = ["nodejs", "npm"];

/// The npm packages that the checks use, with their versions. None needs another package, but for the
/// compiler that TypeScript has for each kind of machine; the page contains none of them.
const TOOLS: [(&str, &str); 3] = [("axe-core", "4.14.1"), ("prettier", "3.10.1"), ("typescript", "7.0.2")];

/// Makes the package in `target/npm` and returns that folder.
///
/// # Errors
/// If the core does not compile, or a file cannot be read or written.
pub(crate) fn package() -> Result<PathBuf> {
    let site = site::build()?;
    let root = workspace::root()?;
    let folder = root.join("target/npm");
    fs::create_dir_all(&folder)?;
    let core = site.join(site::PKG);
    let files = [
        (&core, "armill.js"),
        (&core, "armill.d.ts"),
        (&core, "armill_bg.wasm"),
        (&core, "armill_bg.wasm.d.ts"),
        (&root.join("xtask/npm"), "node.js"),
        (&root.join("xtask/npm"), "README.md"),
        (&root, "LICENSE-APACHE"),
        (&root, "LICENSE-MIT"),
    ];
    for (from, file) in files {
        let file_from = from.join(file);
        let content = fs::read(&file_from).with_context(|| format!("cannot read {}", file_from.display()))?;
        update(&content, &folder.join(file))?;
    }
    let manifest = fs::read_to_string(root.join("xtask/npm/package.json"))?;
    let versioned = manifest.replace("\"0.0.0\"", &format!("\"{}\"", env!("CARGO_PKG_VERSION")));
    ensure!(versioned != manifest, "xtask/npm/package.json has no version to fill in");
    update(versioned.as_bytes(), &folder.join("package.json"))?;
    println!("The package is in target/npm");
    Ok(folder)
}

/// A project in `target/npm-project` that has the package installed, packed as it would be
/// published.
///
/// # Errors
/// If npm is missing, or fails.
pub(crate) fn project() -> Result<PathBuf> {
    let package = package()?;
    let project = workspace::root()?.join("target/npm-project");
    fs::create_dir_all(&project)?;
    fs::write(project.join("package.json"), "{ \"private\": true, \"type\": \"module\" }\n")?;
    run(npm()?.arg("pack").arg(&package).args(["--silent", "--pack-destination"]).arg(&project))?;
    let packed = project.join(format!("armill-{}.tgz", env!("CARGO_PKG_VERSION")));
    install(&project, &[packed.to_string_lossy().as_ref(), "--offline"])?;
    Ok(project)
}

/// The folder with [`TOOLS`], fetched if they are missing.
///
/// # Errors
/// If npm is missing, or cannot fetch them.
pub(crate) fn tools() -> Result<PathBuf> {
    let folder = workspace::root()?.join("target/npm-tools");
    let modules = folder.join("node_modules");
    let missing = TOOLS.iter().any(|(name, version)| !has(&modules.join(name), version));
    if missing {
        fs::create_dir_all(&folder)?;
        fs::write(folder.join("package.json"), "{ \"private\": true }\n")?;
        let names = TOOLS.map(|(name, version)| format!("{name}@{version}"));
        install(&folder, &names.each_ref().map(String::as_str)).with_context(|| {
            format!(
                "{} could not be fetched from the npm registry; `cargo xtask test --native` needs none of them",
                names.join(", ")
            )
        })?;
    }
    Ok(modules)
}

/// Whether a package of this version is in a folder.
fn has(folder: &Path, version: &str) -> bool {
    let manifest = fs::read_to_string(folder.join("package.json")).unwrap_or_default();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap_or_default();
    manifest["version"] == version
}

fn install(folder: &Path, what: &[&str]) -> Result<()> {
    let quietly =
        ["install", "--no-save", "--no-package-lock", "--ignore-scripts", "--no-audit", "--no-fund"];
    run(npm()?.args(quietly).args(["--loglevel=error", "--prefix"]).arg(folder).args(what))
}

/// Node, found or installed.
///
/// # Errors
/// If it is missing and cannot be installed from here.
pub(crate) fn node() -> Result<Command> {
    npm().map(|_| Command::new("node"))
}

/// Finds npm, and installs it and Node where that is possible.
fn npm() -> Result<Command> {
    if (program("node").is_none() || program("npm").is_none()) && workspace::may_install() {
        workspace::install(&PACKAGES)?;
    }
    let version = output("node", &["--version"]).unwrap_or_default();
    let major = version.trim_start_matches('v').split('.').next().and_then(|major| major.parse::<u32>().ok());
    ensure!(
        major.is_some_and(|major| major >= 20) && program("npm").is_some(),
        "the checks of the JavaScript, of the npm package and of accessibility need Node 20 or newer and npm: install \
         `{}` and `{}` (Debian's names), or run `cargo xtask test --native`",
        PACKAGES[0],
        PACKAGES[1]
    );
    Ok(Command::new(program("npm").context("npm is no longer there")?))
}
