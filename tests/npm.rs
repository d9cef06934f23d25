//! The package in `target/npm`, installed and used by a project that has nothing else of this one:
//! in Node, and by TypeScript's compiler. `cargo xtask test` installs it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod common;

use std::env;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// A folder that `cargo xtask test` names in the environment.
fn folder(name: &str) -> PathBuf {
    let folder =
        env::var_os(name).unwrap_or_else(|| panic!("{name} is not set: `cargo xtask test` starts this"));
    folder.into()
}

/// The folder of a project that has the package installed.
fn project() -> PathBuf {
    let project = folder("ARMILL_NPM_PROJECT");
    for file in ["consumer.ts", "run.mjs"] {
        std::fs::copy(Path::new("tests/npm").join(file), project.join(file)).unwrap();
    }
    project
}

/// The output of a program in Node; its messages if it fails.
fn node<S: AsRef<OsStr>>(project: &Path, words: impl IntoIterator<Item = S>) -> String {
    let output = Command::new("node").current_dir(project).args(words).output().expect("Node is needed");
    let text = |bytes| String::from_utf8_lossy(bytes).into_owned();
    assert!(output.status.success(), "{}\n{}", text(&output.stdout), text(&output.stderr));
    text(&output.stdout)
}

#[test]
fn the_package_works_in_node_and_its_types_are_true() {
    let project = project();
    let printed: Value = serde_json::from_str(&node(&project, ["run.mjs"])).unwrap();
    let native = common::run(&[]);
    assert_eq!(printed["fingerprint"], native.fingerprint());
    assert_eq!(printed["samples"], native.samples());
    assert_eq!(printed["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(printed["model"], native.summary().model);
    assert_eq!(printed["refused"]["field"], "motion.feed_mm_s");

    let compiler = folder("ARMILL_NPM_TOOLS").join("typescript/bin/tsc");
    let options = [
        "--ignoreConfig",
        "--strict",
        "--noEmit",
        "--target",
        "es2023",
        "--module",
        "nodenext",
        "--lib",
        "es2023,esnext.disposable,dom",
    ];
    let files = ["consumer.ts", "values.ts"];
    node(&project, [compiler.as_os_str()].into_iter().chain(options.iter().chain(&files).map(OsStr::new)));
}

#[test]
fn the_package_is_complete() {
    let package = project().join("node_modules/armill");
    let mut files: Vec<_> = std::fs::read_dir(&package)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    files.sort();
    assert_eq!(
        files,
        [
            "LICENSE-APACHE",
            "LICENSE-MIT",
            "README.md",
            "armill.d.ts",
            "armill.js",
            "armill_bg.wasm",
            "armill_bg.wasm.d.ts",
            "node.js",
            "package.json"
        ]
    );
    let manifest: Value =
        serde_json::from_str(&std::fs::read_to_string(package.join("package.json")).unwrap()).unwrap();
    assert_eq!(manifest["version"], env!("CARGO_PKG_VERSION"));
}
