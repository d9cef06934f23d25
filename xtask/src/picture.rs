//! The picture of the page in the README, taken with the tutorial's job.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};

use crate::browser::Driver;
use crate::server::Server;
use crate::site::{self, gallery::link};
use crate::workspace;

/// The browser's capabilities, those of the page tests.
const CAPABILITIES: &str = include_str!("../../.cargo/webdriver.json");

/// Width and height [CSS pixels].
const SIZE: (u32, u32) = (1280, 800);

/// How long the page may take; software rendering is slow.
const LIMIT: Duration = Duration::from_secs(60);

/// True once the result is current and its charts are drawn. The page marks a stale or unfinished
/// result in `data-state`.
const READY: &str = "return document.querySelector('#results').dataset.state === 'current' \
                     && document.querySelector('svg .series path') !== null";

/// The built site, open in a browser.
pub(crate) struct Visit {
    server: Server,
    driver: Driver,
    session: String,
}

impl Visit {
    /// Builds the site and starts a browser.
    ///
    /// # Errors
    /// If the site does not build, or there is no browser.
    pub(crate) fn start() -> Result<Visit> {
        let server = Server::start_anywhere(&site::build()?)?;
        let driver = Driver::start()?;
        let capabilities: Value = serde_json::from_str(CAPABILITIES)?;
        let asked = json!({ "capabilities": { "alwaysMatch": capabilities } });
        let session = send(&driver, "POST", "/session", &asked)?;
        let session = session["sessionId"].as_str().context("chromedriver opened no session")?.to_owned();
        Ok(Visit { server, driver, session })
    }

    /// Opens the page with this fragment in a view of this size [CSS pixels], and waits for its result.
    ///
    /// # Errors
    /// If the page shows no result in time.
    pub(crate) fn open(&self, fragment: &str, (width, height): (u32, u32)) -> Result<()> {
        // The window's frame takes some of its size, so the view's own is set.
        let view = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.devtools("Emulation.setDeviceMetricsOverride", view)?;
        // Another fragment alone would not load the page again.
        self.post("/url", json!({ "url": "about:blank" }))?;
        self.post("/url", json!({ "url": format!("{}#{fragment}", self.server.url) }))?;
        let start = Instant::now();
        while self.js(READY)? != json!(true) {
            if start.elapsed() > LIMIT {
                bail!("the page showed no result within {} s", LIMIT.as_secs());
            }
            thread::sleep(Duration::from_millis(100));
        }
        // The accuracy as a program and the remaining charts follow the result.
        thread::sleep(Duration::from_secs(4));
        Ok(())
    }

    /// Runs the body of a JavaScript function in the page and returns its result.
    ///
    /// # Errors
    /// If it throws.
    pub(crate) fn js(&self, body: &str) -> Result<Value> {
        self.post("/execute/sync", json!({ "script": body, "args": [] }))
    }

    /// Takes a picture, as the DevTools protocol's `Page.captureScreenshot` is asked for it.
    ///
    /// # Errors
    /// If the browser takes none.
    pub(crate) fn picture(&self, options: Value) -> Result<Vec<u8>> {
        let picture = self.devtools("Page.captureScreenshot", options)?;
        Ok(BASE64_STANDARD.decode(picture["data"].as_str().context("the browser took no picture")?)?)
    }

    fn devtools(&self, command: &str, parameters: Value) -> Result<Value> {
        self.post("/goog/cdp/execute", json!({ "cmd": command, "params": parameters }))
    }

    fn post(&self, path: &str, body: Value) -> Result<Value> {
        send(&self.driver, "POST", &format!("/session/{}{path}", self.session), &body)
    }
}

/// Opens the page with `docs/bracket.json` and writes `docs/page.png`.
///
/// # Errors
/// If the site does not build, there is no browser, or the page shows no result in time.
pub(crate) fn take() -> Result<()> {
    let root = workspace::root()?;
    let visit = Visit::start()?;
    visit.open(&link(&fs::read_to_string(root.join("docs/bracket.json"))?)?, SIZE)?;
    let bytes = visit.picture(json!({ "format": "png" }))?;
    fs::write(root.join("docs/page.png"), &bytes)?;
    println!("The picture is in docs/page.png ({} kB)", bytes.len() / 1000);
    Ok(())
}

/// Sends one WebDriver command and returns its value.
fn send(driver: &Driver, method: &str, path: &str, body: &Value) -> Result<Value> {
    let url = driver.url();
    let host = url.trim_start_matches("http://");
    let body = if body.is_null() { String::new() } else { body.to_string() };
    let mut stream = TcpStream::connect(host)?;
    stream.set_read_timeout(Some(LIMIT))?;
    write!(
        stream,
        "{method} {path} HTTP/1.1\r\nHost: {host}\r\nContent-Type: application/json\r\n\
         Content-Length: {}\r\n\r\n{body}",
        body.len()
    )?;
    // The driver keeps the connection open, so the reply ends where its length says.
    let mut reply = BufReader::new(stream);
    let mut length = 0;
    loop {
        let mut line = String::new();
        if reply.read_line(&mut line)? == 0 {
            bail!("chromedriver did not answer");
        }
        if line.trim().is_empty() {
            break;
        }
        if let Some((name, value)) = line.split_once(':')
            && name.eq_ignore_ascii_case("content-length")
        {
            length = value.trim().parse()?;
        }
    }
    let mut body = vec![0; length];
    reply.read_exact(&mut body)?;
    let mut reply: Value = serde_json::from_slice(&body)?;
    if let Some(message) = reply["value"]["message"].as_str() {
        bail!("chromedriver: {message}");
    }
    Ok(reply["value"].take())
}
