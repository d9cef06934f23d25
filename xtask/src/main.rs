//! Builds, serves and tests Armill: the only tool a contributor needs.
#![allow(clippy::print_stdout, reason = "a command-line tool prints to standard output")]

mod webkit;
mod workspace;
mod site;
mod docs;
mod npm;
mod javascript;
mod server;
mod browser;
mod checks;
mod fuzz;
mod reproduce;
mod audit;
mod bench;
mod picture;
mod gallery;

use std::env;
use std::process::ExitCode;

use anyhow::{Context, Result, bail};

const USAGE: &str = "\
usage: cargo xtask <command>

  build            build the complete static site in target/site
  serve            build it and serve it on this machine, from port 8080 on
  docs             build the documentation, with the calculator in it, in target/docs
  picture          take the README's picture of the page, docs/page.png
  gallery          take the gallery's pictures, web/gallery/*.webp
  npm              make the package for npm in target/npm
  test             check formatting, lints and types, run all tests: native, in Node, in the browser, through the page
  test --native    only what needs neither Node nor a browser
  test --javascript  only the page's code: its layout, its types, its tests in Node
  test --heavy     the slower tests of the page, pictures and gallery among them: some minutes more
  test --firefox   the page in Firefox: figures, first screen, one program; builds Firefox's driver if there is none
  test --webkit    the page in WebKitGTK: figures, first screen, one question
  bench [samples]  time stages and whole jobs, natively and in Chromium, and kinematics beside other crates: about ten minutes
                   for the sizes 20000,200000,1000000, a minute for one
  audit            check licences and sources of all dependencies, and known vulnerabilities
  reproduce        build the core in two folders and compare the two, byte by byte
  fuzz [target [seconds]]  search for texts that break a reader, the job or an export: each for a minute
";

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[String]) -> Result<()> {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["build"] => site::build().map(|_| ()),
        ["serve"] => server::serve(&site::build()?),
        ["docs"] => docs::build().map(|_| ()),
        ["picture"] => picture::take(),
        ["gallery"] => gallery::take(),
        ["npm"] => npm::package().map(|_| ()),
        ["test"] => checks::all(),
        ["test", "--native"] => checks::native(),
        ["test", "--javascript"] => checks::javascript(),
        ["test", "--heavy"] => checks::heavy(),
        ["test", "--firefox"] => checks::firefox(),
        ["test", "--webkit"] => checks::webkit(),
        ["bench"] => bench::bench("20000,200000,1000000"),
        ["bench", sizes] => bench::bench(sizes),
        ["fuzz"] => fuzz::fuzz(None, 60),
        ["fuzz", target] => fuzz::fuzz(Some(target), 60),
        ["fuzz", target, seconds] => {
            let seconds =
                seconds.parse().with_context(|| format!("`{seconds}` is not a number of seconds"))?;
            fuzz::fuzz(Some(target), seconds)
        }
        ["reproduce"] => reproduce::reproduce(),
        ["audit"] => audit::audit(),
        // Called by cargo for `cargo test --target wasm32-unknown-unknown`, see .cargo/config.toml.
        ["wasm-test-runner", rest @ ..] => checks::run_wasm(rest),
        ["help" | "--help" | "-h"] => {
            print!("{USAGE}");
            Ok(())
        }
        [] => bail!("which command?\n\n{USAGE}"),
        _ => bail!("unknown command `{}`\n\n{USAGE}", words.join(" ")),
    }
}
