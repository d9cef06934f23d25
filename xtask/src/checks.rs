//! Every check that a change has to pass.

use std::thread;
use std::time::Instant;

use anyhow::{Context, Result, anyhow};

use crate::audit;
use crate::browser::{self, Driver};
use crate::docs;
use crate::fuzz;
use crate::javascript;
use crate::npm;
use crate::server::Server;
use crate::site;
use crate::webkit::WebKitDriver;
use crate::workspace::{self, WASM, cargo, run};

/// Runs all checks; stops at the first that fails.
///
/// # Errors
/// If a check fails, or a tool is missing and cannot be installed.
pub(crate) fn all() -> Result<()> {
    before_tests()?;
    // Linking the site's core is the work of one thread for a minute or two, and so are many native tests.
    thread::scope(|scope| {
        let browser = scope.spawn(for_the_browser);
        native_tests()?;
        browser
            .join()
            .map_err(|_| anyhow!("compiling for the browser panicked"))?
            .context("compiling for the browser")
    })?;
    javascript()?;
    step("tests in the browser", || {
        browser::driver()?;
        run(&mut cargo(&["test", "--locked", "--target", WASM, "--test", "web"])?)
    })?;
    step("tests of the npm package", || {
        run(cargo(&["test", "--locked", "--test", "npm"])?
            .env("ARMILL_NPM_PROJECT", npm::project()?)
            .env("ARMILL_NPM_TOOLS", npm::tools()?))
    })?;
    step("changed links", || fuzz::link(3, 41))?;
    step("tests of the page", || page(&[]))
}

/// Runs the tests of the page that take long, which [`all`] leaves out.
///
/// # Errors
/// As for [`all`].
pub(crate) fn heavy() -> Result<()> {
    step("heavy tests of the page", || page(&["--", "--ignored", "--skip", "firefox", "--skip", "webkit"]))
}

/// Serves site and documentation, and drives the page.
fn page(options: &[&str]) -> Result<()> {
    let docs = Server::start_plain(&docs::build()?)?;
    let server = Server::start_anywhere(&site::build()?)?;
    let driver = Driver::start()?;
    run(cargo(&["test", "--locked", "--test", "page"])?
        .args(options)
        .env("ARMILL_SITE_URL", &server.url)
        .env("ARMILL_DOCS_URL", &docs.url)
        .env("ARMILL_NPM_TOOLS", npm::tools()?)
        .env("ARMILL_WEBDRIVER_URL", driver.url()))
}

/// Runs the checks of the page's code that need no browser.
///
/// # Errors
/// As for [`all`].
pub(crate) fn javascript() -> Result<()> {
    step("layout of the JavaScript", javascript::layout)?;
    step("types of the JavaScript", javascript::types)?;
    step("tests in Node", javascript::tests)
}

/// Runs the tests of the page in Firefox.
///
/// # Errors
/// As for [`all`].
pub(crate) fn firefox() -> Result<()> {
    step("tests of the page in Firefox", || {
        let server = Server::start_anywhere(&site::build()?)?;
        let driver = Driver::start_firefox()?;
        // Its driver has one session at a time.
        run(cargo(&["test", "--locked", "--test", "page", "--", "--ignored", "--test-threads=1", "firefox"])?
            .env("ARMILL_SITE_URL", &server.url)
            .env("ARMILL_FIREFOX_URL", driver.url()))
    })
}

/// Runs the tests of the page in WebKitGTK.
///
/// # Errors
/// As for [`all`].
pub(crate) fn webkit() -> Result<()> {
    step("tests of the page in WebKitGTK", || {
        let server = Server::start_anywhere(&site::build()?)?;
        let driver = WebKitDriver::start()?;
        // Its driver has one session at a time.
        run(cargo(&["test", "--locked", "--test", "page", "--", "--ignored", "--test-threads=1", "webkit"])?
            .env("ARMILL_SITE_URL", &server.url)
            .env("ARMILL_WEBKIT_BROWSER", &driver.browser)
            .env("ARMILL_WEBKIT_URL", driver.url()))
    })
}

/// Compiles the site and the tests of the boundary.
fn for_the_browser() -> Result<()> {
    site::build()?;
    run(&mut cargo(&["test", "--locked", "--target", WASM, "--test", "web", "--no-run"])?)
}

/// Runs the checks that need neither Node nor a browser.
///
/// # Errors
/// As for [`all`].
pub(crate) fn native() -> Result<()> {
    before_tests()?;
    native_tests()
}

/// Whatever can be said before a test runs, and the native tests compiled.
fn before_tests() -> Result<()> {
    step("formatting", || {
        workspace::add_linters()?;
        run(&mut cargo(&["fmt", "--all", "--check"])?)
    })?;
    step("lints, native", || {
        lint(&["--workspace", "--all-targets"])?;
        lint(&["--workspace", "--test", "page", "--test", "npm"])
    })?;
    step("lints, WebAssembly", || {
        workspace::add_wasm_target()?;
        lint(&["--target", WASM, "--package", "armill", "--lib", "--test", "web"])
    })?;
    step("licences, sources and known vulnerabilities of dependencies", audit::audit)?;
    step("native tests, compiled", || run(&mut cargo(&["test", "--locked", "--no-run"])?))
}

fn native_tests() -> Result<()> {
    step("native tests", || run(&mut cargo(&["test", "--locked"])?))?;
    step("tests of this tool", || run(&mut cargo(&["test", "--locked", "--package", "xtask"])?))
}

/// Runs one compiled WebAssembly test binary in a headless browser. The arguments are the file and
/// the options that `cargo test` adds; .cargo/config.toml holds the settings.
///
/// # Errors
/// If a test fails, or there is no browser.
pub(crate) fn run_wasm(words: &[&str]) -> Result<()> {
    browser::driver()?;
    let words = words.iter().copied().filter(|word| !is_foreign(word));
    wasm_bindgen_cli::wasm_bindgen_test_runner::run_cli_with_args(
        ["wasm-bindgen-test-runner"].into_iter().chain(words),
    )
}

/// Options of the native test harness that only change its output, and that wasm-bindgen's rejects.
fn is_foreign(word: &str) -> bool {
    matches!(word, "--quiet" | "-q" | "--show-output")
        || word.starts_with("--color=")
        || word.starts_with("--test-threads=")
}

fn lint(what: &[&str]) -> Result<()> {
    run(cargo(&["clippy", "--locked"])?.args(what).args(["--", "--deny", "warnings"]))
}

/// Runs one check under a heading and prints the time it took.
fn step(heading: &str, check: impl FnOnce() -> Result<()>) -> Result<()> {
    println!("\n=== {heading}");
    let start = Instant::now();
    check().with_context(|| heading.to_owned())?;
    println!("=== {heading}: passed in {:.1} s", start.elapsed().as_secs_f64());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::is_foreign;

    #[test]
    fn only_options_about_output_are_dropped() {
        assert!(["--quiet", "-q", "--show-output", "--color=always"].into_iter().all(is_foreign));
        assert!(
            !["target/a.wasm", "a_filter", "--ignored", "--exact", "--nocapture"].into_iter().any(is_foreign)
        );
    }
}
