//! The page's JavaScript: how it is laid out, its types, which comments state, and its tests in Node.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result, ensure};

use crate::npm;
use crate::site;
use crate::workspace::{root, run};

/// Files of tests in Node, of whatever they test.
const TESTS: &str = "tests/js";

/// Checks that Prettier would change nothing.
///
/// # Errors
/// If it would, or is missing and cannot be fetched.
pub(crate) fn layout() -> Result<()> {
    let prettier = npm::tools()?.join("prettier/bin/prettier.cjs");
    let what = ["--check", "web/js", "tests/**/*.mjs"];
    run(npm::node()?.current_dir(root()?).arg(prettier).args(what)).context(
        "`npx prettier --write web/js 'tests/**/*.mjs'` lays JavaScript out, with the settings in .prettierrc.json",
    )
}

/// Has TypeScript check the types by the settings in `tsconfig.json`. The core's are those of the site.
///
/// # Errors
/// If one does not fit, the site cannot be built, or TypeScript is missing and cannot be fetched.
pub(crate) fn types() -> Result<()> {
    site::build()?;
    let compiler = npm::tools()?.join("typescript/bin/tsc");
    run(npm::node()?.current_dir(root()?).arg(compiler).args(["--project", "tsconfig.json"]))
}

/// Runs the tests in Node, some of them with the core of the site.
///
/// # Errors
/// If one fails, the site cannot be built, or there is no Node.
pub(crate) fn tests() -> Result<()> {
    site::build()?;
    run(npm::node()?.current_dir(root()?).args(["--test", "--test-reporter=spec"]).args(files()?))
}

/// The files with tests. They are named one by one: what Node makes of a folder depends on its version.
fn files() -> Result<Vec<PathBuf>> {
    let list = fs::read_dir(root()?.join(TESTS)).with_context(|| format!("cannot list {TESTS}"))?;
    let mut files: Vec<_> = list.map(|entry| Ok(entry?.path())).collect::<Result<_>>()?;
    files.retain(|file| file.to_string_lossy().ends_with(".test.mjs"));
    files.sort();
    ensure!(!files.is_empty(), "{TESTS} has no tests");
    Ok(files)
}
