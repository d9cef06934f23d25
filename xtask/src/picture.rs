//! The picture of the page in the README, taken with the tutorial's job.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};
use base64::Engine;
use base64::prelude::{BASE64_STANDARD, BASE64_URL_SAFE_NO_PAD};
use flate2::{Compression, write::ZlibEncoder};
use serde_json::{Value, json};

use crate::browser::Driver;
use crate::server::Server;
use crate::site;
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

/// Builds the site, opens it with `docs/bracket.json` and writes `docs/page.png`.
///
/// # Errors
/// If the site does not build, there is no browser, or the page shows no result in time.
pub(crate) fn take() -> Result<()> {
    let root = workspace::root()?;
    let server = Server::start_anywhere(&site::build()?)?;
    let driver = Driver::start()?;
    let capabilities: Value = serde_json::from_str(CAPABILITIES)?;
    let asked = json!({ "capabilities": { "alwaysMatch": capabilities } });
    let session = send(&driver, "POST", "/session", &asked)?;
    let id = session["sessionId"].as_str().context("chromedriver opened no session")?;
    let post = |path: &str, body: Value| send(&driver, "POST", &format!("/session/{id}{path}"), &body);

    // The window's frame takes some of its size, so the view's own is set.
    let view = json!({ "width": SIZE.0, "height": SIZE.1, "deviceScaleFactor": 1, "mobile": false });
    let command = json!({ "cmd": "Emulation.setDeviceMetricsOverride", "params": view });
    post("/goog/cdp/execute", command)?;
    let job = fs::read_to_string(root.join("docs/bracket.json"))?;
    post("/url", json!({ "url": format!("{}#{}", server.url, link(&job)?) }))?;
    let start = Instant::now();
    while post("/execute/sync", json!({ "script": READY, "args": [] }))? != json!(true) {
        if start.elapsed() > LIMIT {
            bail!("the page showed no result within {} s", LIMIT.as_secs());
        }
        thread::sleep(Duration::from_millis(100));
    }
    // The accuracy as a program and the remaining charts follow the result.
    thread::sleep(Duration::from_secs(4));
    let picture = send(&driver, "GET", &format!("/session/{id}/screenshot"), &Value::Null)?;
    let bytes = BASE64_STANDARD.decode(picture.as_str().context("chromedriver took no picture")?)?;
    let file = root.join("docs/page.png");
    fs::write(&file, &bytes)?;
    println!("The picture is in docs/page.png ({} kB)", bytes.len() / 1000);
    Ok(())
}

/// The fragment that opens the page with a job, see `web/js/job/link.js`.
fn link(job: &str) -> Result<String> {
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::default());
    packed.write_all(job.as_bytes())?;
    Ok(format!("job=2.{}", BASE64_URL_SAFE_NO_PAD.encode(packed.finish()?)))
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

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::read::ZlibDecoder;

    #[test]
    fn a_link_holds_the_whole_job() {
        let link = link("{\"version\":1}").unwrap();
        let packed = BASE64_URL_SAFE_NO_PAD.decode(link.strip_prefix("job=2.").unwrap()).unwrap();
        let mut job = String::new();
        ZlibDecoder::new(packed.as_slice()).read_to_string(&mut job).unwrap();
        assert_eq!(job, "{\"version\":1}");
    }
}
