//! WebKitGTK and its driver, on a display of their own: unlike the other browsers it needs one.

use std::io::{BufRead, BufReader};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};

use crate::workspace::{self, program};

/// Debian's packages of the driver, which brings a browser, and of the display.
const PACKAGES: [&str; 2] = ["webkit2gtk-driver", "xvfb"];
/// How long the driver may take to listen.
const PATIENCE: Duration = Duration::from_secs(20);

/// A running driver; dropping it stops it, its browsers and the display.
pub(crate) struct WebKitDriver {
    /// The display, then the driver.
    processes: Vec<Child>,
    port: u16,
    /// The browser that it drives.
    pub(crate) browser: PathBuf,
}

impl WebKitDriver {
    /// Installs what is missing where that is possible, and starts it.
    ///
    /// # Errors
    /// If something is missing and cannot be installed from here, or does not start.
    pub(crate) fn start() -> Result<WebKitDriver> {
        if parts().is_none() && workspace::may_install() {
            workspace::install(&PACKAGES)?;
        }
        let [driver, display, browser] = parts().with_context(|| {
            let [driver, display] = PACKAGES;
            format!("these tests need WebKitGTK: install `{driver}` and `{display}` (Debian's names)")
        })?;
        // The driver does not say which port it takes by itself.
        let port = TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?.local_addr()?.port();
        let mut started = WebKitDriver { processes: Vec::new(), port, browser };
        let number = started.display(&display)?;
        let mut command = Command::new(driver);
        command.arg(format!("--port={port}")).env("DISPLAY", format!(":{number}"));
        started.processes.push(quietly(&mut command).spawn().context("cannot start WebKitGTK's driver")?);
        started.wait()?;
        Ok(started)
    }

    /// The driver's address.
    pub(crate) fn url(&self) -> String {
        format!("http://127.0.0.1:{}", self.port)
    }

    /// Starts a display that chooses its own number, and says which.
    fn display(&mut self, program: &PathBuf) -> Result<String> {
        let mut command = Command::new(program);
        command.args(["-displayfd", "1", "-screen", "0", "1600x1200x24", "-nolisten", "tcp"]);
        let mut child =
            quietly(&mut command).stdout(Stdio::piped()).spawn().context("cannot start a display")?;
        let output = child.stdout.take();
        self.processes.push(child);
        let mut line = String::new();
        BufReader::new(output.context("the display has no output")?).read_line(&mut line)?;
        if line.trim().is_empty() {
            bail!("the display ended before it had a number");
        }
        Ok(line.trim().to_owned())
    }

    fn wait(&self) -> Result<()> {
        let start = Instant::now();
        while TcpStream::connect((Ipv4Addr::LOCALHOST, self.port)).is_err() {
            if start.elapsed() > PATIENCE {
                bail!("WebKitGTK's driver does not listen");
            }
            thread::sleep(Duration::from_millis(50));
        }
        Ok(())
    }
}

impl Drop for WebKitDriver {
    fn drop(&mut self) {
        for process in self.processes.iter_mut().rev() {
            // It may have ended already: then there is nothing left to stop.
            let _ = process.kill();
            let _ = process.wait();
        }
    }
}

fn quietly(command: &mut Command) -> &mut Command {
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null())
}

/// Driver, display and browser, if all are there. The browser is not on the search path.
fn parts() -> Option<[PathBuf; 3]> {
    let libraries = std::fs::read_dir("/usr/lib").ok()?.flatten().map(|entry| entry.path());
    let folders = std::iter::once(PathBuf::from("/usr/lib")).chain(libraries);
    let mut browsers = folders.flat_map(|folder| {
        ["webkit2gtk-4.1", "webkit2gtk-4.0"].map(|name| folder.join(name).join("MiniBrowser"))
    });
    Some([program("WebKitWebDriver")?, program("Xvfb")?, browsers.find(|path| path.is_file())?])
}
