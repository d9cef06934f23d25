//! Sessions with a browser: what is asked for, and what a driver adds to the standard.

use std::env;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use fantoccini::wd::WebDriverCompatibleCommand;
use serde_json::{Map, Value, json};

use crate::browser::Result;

/// Browser capabilities, shared with wasm-bindgen's test runner.
const CAPABILITIES: &str = include_str!("../../.cargo/webdriver.json");

/// Capabilities of Firefox: downloads go to a folder of choice (2), and nothing is asked.
const FIREFOX: &str = r#"{
    "moz:firefoxOptions": {
        "args": ["-headless"],
        "prefs": { "browser.download.folderList": 2, "browser.download.alwaysOpenPanel": false }
    }
}"#;

/// The browser that a page is opened in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Browser {
    /// With its console and its requests watched.
    Chromium,
    /// Its driver has neither a log nor devices to emulate.
    Firefox,
    /// Its driver has neither, too.
    WebKit,
}

impl Browser {
    /// What a session is asked for, with the folder of its downloads, and the variable that has the
    /// driver's address.
    ///
    /// # Errors
    /// If the capabilities are not JSON, or it is not said which browser to start.
    pub fn session(self, downloads: &Path) -> Result<(Map<String, Value>, &'static str)> {
        let (text, driver) = match self {
            Browser::Chromium => (CAPABILITIES, "ARMILL_WEBDRIVER_URL"),
            Browser::Firefox => (FIREFOX, "ARMILL_FIREFOX_URL"),
            Browser::WebKit => ("{}", "ARMILL_WEBKIT_URL"),
        };
        let mut capabilities: Map<String, Value> = serde_json::from_str(text)?;
        match self {
            Browser::Chromium => {
                capabilities
                    .insert("goog:loggingPrefs".into(), json!({ "browser": "ALL", "performance": "ALL" }));
            }
            Browser::Firefox => {
                capabilities["moz:firefoxOptions"]["prefs"]["browser.download.dir"] = json!(downloads);
            }
            Browser::WebKit => {
                let options =
                    json!({ "binary": setting("ARMILL_WEBKIT_BROWSER")?, "args": ["--automation"] });
                capabilities.insert("webkitgtk:browserOptions".into(), options);
            }
        }
        Ok((capabilities, driver))
    }
}

/// A command specific to ChromeDriver.
#[derive(Debug)]
pub struct Post {
    /// Path below the session's address.
    pub endpoint: &'static str,
    /// JSON.
    pub body: Value,
}

impl WebDriverCompatibleCommand for Post {
    fn endpoint(
        &self,
        base: &url::Url,
        session: Option<&str>,
    ) -> std::result::Result<url::Url, url::ParseError> {
        base.join(&format!("session/{}/{}", session.unwrap_or_default(), self.endpoint))
    }

    fn method_and_body(&self, _: &url::Url) -> (http::Method, Option<String>) {
        (http::Method::POST, Some(self.body.to_string()))
    }
}

/// The address in a network event, if it is about a request.
pub fn requested(event: &Value) -> Option<&str> {
    match event["method"].as_str()? {
        "Network.requestWillBeSent" => event["params"]["request"]["url"].as_str(),
        "Network.webSocketCreated" => event["params"]["url"].as_str(),
        _ => None,
    }
}

/// A folder of these tests in `target`.
pub fn scratch() -> &'static Path {
    Path::new(env!("CARGO_TARGET_TMPDIR"))
}

/// A path in that folder that no other page of these tests has.
pub fn own_folder(name: &str) -> PathBuf {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    scratch().join(format!("{name}-{}-{number}", std::process::id()))
}

/// A variable that `cargo xtask test` sets in the environment.
///
/// # Errors
/// If it is not set.
pub fn setting(name: &str) -> Result<String> {
    env::var(name)
        .map_err(|_| format!("{name} is not set: these tests are started by `cargo xtask test`").into())
}
