//! The browsers and the programs that drive them.

use std::env;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, TcpStream};
use std::path::PathBuf;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail, ensure};

use crate::workspace::{self, program};

/// Debian's packages of the browser and its driver.
const PACKAGES: [&str; 2] = ["chromium", "chromium-driver"];

/// Possible names of the browser on the search path.
const BROWSERS: [&str; 5] =
    ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"];

/// Finds the driver, and installs it and a browser where that is possible.
///
/// # Errors
/// If something is missing and cannot be installed from here; the message names the packages to
/// install.
pub(crate) fn driver() -> Result<PathBuf> {
    if let Some(path) = find() {
        return Ok(path);
    }
    if workspace::may_install() {
        workspace::install(&PACKAGES)?;
    }
    find().with_context(|| {
        let [browser, driver] = PACKAGES;
        format!(
            "the browser tests need Chromium and its driver: install `{browser}` and `{driver}` (Debian's names), \
             or run `cargo xtask test --native`"
        )
    })
}

/// The driver, if there is a browser for it.
fn find() -> Option<PathBuf> {
    // On other systems browsers are not on the search path, and the driver finds them itself.
    let browser = !cfg!(target_os = "linux") || BROWSERS.iter().any(|name| program(name).is_some());
    let driver = env::var_os("CHROMEDRIVER").map(PathBuf::from).or_else(|| program("chromedriver"));
    driver.filter(|_| browser)
}

/// The version of Firefox's driver that is built where there is none.
const GECKODRIVER: &str = "0.37.1";

/// Finds Firefox's driver, and installs the browser and builds the driver where that is possible.
///
/// # Errors
/// If one is missing and cannot be installed from here.
pub(crate) fn geckodriver() -> Result<PathBuf> {
    let firefox = || ["firefox-esr", "firefox"].iter().any(|name| program(name).is_some());
    if !firefox() && workspace::may_install() {
        workspace::install(&["firefox-esr"])?;
    }
    ensure!(firefox(), "these tests need Firefox: install `firefox-esr` (Debian's name)");
    if let Some(path) = env::var_os("GECKODRIVER").map(PathBuf::from).or_else(|| program("geckodriver")) {
        return Ok(path);
    }
    let folder = workspace::root()?.join("target/geckodriver");
    let path = folder.join("bin").join(format!("geckodriver{}", env::consts::EXE_SUFFIX));
    if !path.is_file() {
        let what = ["install", "geckodriver", "--locked", "--version", GECKODRIVER, "--root"];
        workspace::run(workspace::cargo(&what)?.arg(&folder))?;
    }
    Ok(path)
}

/// A running driver; dropping it stops it and its browsers.
pub(crate) struct Driver {
    process: Child,
    port: u16,
}

impl Driver {
    /// Starts the driver on a port of its own choice.
    ///
    /// # Errors
    /// If there is none, or it does not start.
    pub(crate) fn start() -> Result<Driver> {
        Driver::run(Command::new(driver()?).args(["--port=0", "--log-level=SEVERE"]))
    }

    /// The same for Firefox.
    ///
    /// # Errors
    /// As for [`Driver::start`].
    pub(crate) fn start_firefox() -> Result<Driver> {
        Driver::run(Command::new(geckodriver()?).args(["--port=0", "--log=info"]))
    }

    fn run(command: &mut Command) -> Result<Driver> {
        let mut process = command
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .context("cannot start the browser's driver")?;
        let mut lines = BufReader::new(process.stdout.take().context("the driver has no output")?);
        // From here on, an early return stops the process too.
        let mut driver = Driver { process, port: 0 };
        driver.port = announced_port(&mut lines)?;
        // A full pipe would block it.
        thread::spawn(move || std::io::copy(&mut lines, &mut std::io::sink()));
        Ok(driver)
    }

    /// The driver's address.
    pub(crate) fn url(&self) -> String {
        format!("http://127.0.0.1:{}", self.port)
    }

    /// Asks it to quit, which closes the browsers left open by failed tests.
    fn quit(&self) -> std::io::Result<()> {
        let mut stream = TcpStream::connect((Ipv4Addr::LOCALHOST, self.port))?;
        stream.set_read_timeout(Some(Duration::from_secs(5)))?;
        write!(stream, "GET /shutdown HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n")?;
        stream.read_to_end(&mut Vec::new()).map(|_| ())
    }

    fn has_ended_within(&mut self, limit: Duration) -> bool {
        let start = Instant::now();
        while start.elapsed() < limit {
            if !matches!(self.process.try_wait(), Ok(None)) {
                return true;
            }
            thread::sleep(Duration::from_millis(20));
        }
        false
    }
}

impl Drop for Driver {
    fn drop(&mut self) {
        if self.quit().is_err() || !self.has_ended_within(Duration::from_secs(5)) {
            // It may have ended already: then there is nothing left to stop.
            let _ = self.process.kill();
            let _ = self.process.wait();
        }
    }
}

/// Reads until the driver reports its port.
fn announced_port(lines: &mut BufReader<ChildStdout>) -> Result<u16> {
    let mut line = String::new();
    while lines.read_line(&mut line)? > 0 {
        if let Some(port) = port_in(&line) {
            return Ok(port);
        }
        line.clear();
    }
    bail!("the browser's driver ended before it listened")
}

/// The port in "ChromeDriver was started successfully on port 39151.", or in "... Listening on
/// 127.0.0.1:39151".
fn port_in(line: &str) -> Option<u16> {
    let (_, port) = line
        .split_once("started successfully on port ")
        .or_else(|| line.split_once("Listening on ")?.1.split_once(':'))?;
    port.trim_end().trim_end_matches('.').parse().ok()
}

#[cfg(test)]
mod tests {
    use super::port_in;

    #[test]
    fn the_port_is_read_from_the_drivers_greeting() {
        assert_eq!(port_in("ChromeDriver was started successfully on port 39151.\n"), Some(39151));
        assert_eq!(port_in("1796005963000\tgeckodriver\tINFO\tListening on 127.0.0.1:39151\n"), Some(39151));
        assert_eq!(port_in("Starting ChromeDriver 156.0.8078.79 on port 0\n"), None);
        assert_eq!(port_in(""), None);
    }
}
