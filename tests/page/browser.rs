//! A page in a real browser, driven as a user would: real clicks, real keys.

use std::cell::RefCell;
use std::error::Error;
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::PathBuf;
use std::time::{Duration, Instant};
use std::{fs, thread};

use fantoccini::elements::Element;
use fantoccini::wd::WindowHandle;
use fantoccini::{Client, ClientBuilder, Locator};
use hyper_util::client::legacy::connect::HttpConnector;
use serde_json::{Value, json};
use tokio::runtime::Runtime;
use tokio::time::sleep;

use crate::session::{Browser, Post, own_folder, requested, scratch};

pub use crate::session::setting;
pub use fantoccini::key::Key;

/// The result of a test.
pub type Result<T = ()> = std::result::Result<T, Box<dyn Error>>;

/// Width and height of a page's viewport [CSS px].
pub type Size = (u32, u32);

/// A laptop's viewport.
pub const DESKTOP: Size = (1280, 800);
/// A phone's viewport, held upright.
pub const PHONE: Size = (390, 844);

/// The page with the thesis's job, which the default job is too.
pub const THESIS: &str = "/#example=thesis";

/// Time limit for a download.
const DOWNLOAD: Duration = Duration::from_secs(60);

/// Opens a page of the site, or any page by its whole address, runs a test on it and closes it
/// again. A test that fails leaves a screenshot `failed-<test>.png` and the console's messages in
/// its output.
///
/// # Errors
/// The test's errors, and those of [`Page::close`].
pub fn visit(path: &str, size: Size, test: impl AsyncFnOnce(&Page) -> Result) -> Result {
    visit_in(Browser::Chromium, path, size, test)
}

/// The same in a browser of choice.
///
/// # Errors
/// As for [`visit`].
pub fn visit_in(browser: Browser, path: &str, size: Size, test: impl AsyncFnOnce(&Page) -> Result) -> Result {
    let runtime = Runtime::new()?;
    let page = runtime.block_on(Page::open(browser, path, size))?;
    let outcome = catch_unwind(AssertUnwindSafe(|| runtime.block_on(test(&page))));
    if !matches!(outcome, Ok(Ok(()))) {
        let name = thread::current().name().unwrap_or("test").replace("::", "-");
        let picture = runtime.block_on(page.screenshot(&format!("failed-{name}.png")));
        let console = runtime.block_on(page.console());
        eprintln!("picture: {picture:?}\nconsole: {console:#?}");
    }
    let closed = runtime.block_on(page.close());
    match outcome {
        Ok(result) => result.and(closed),
        Err(panic) => resume_unwind(panic),
    }
}

/// An open page, in a browser of its own.
pub struct Page {
    client: Client,
    browser: Browser,
    /// Scheme, host and port of the site, with a slash at the end; for a file its folder.
    origin: String,
    downloads: PathBuf,
    /// Console lines so far: the driver returns every line only once.
    console: RefCell<Vec<String>>,
    /// Parts of error messages that the test provokes on purpose.
    expected: RefCell<Vec<String>>,
}

impl Page {
    /// Starts a browser and opens a page of the site.
    ///
    /// # Errors
    /// If `cargo xtask test` has not started the site and the driver, or the browser does not
    /// start.
    pub async fn open(browser: Browser, path: &str, size: Size) -> Result<Page> {
        let site = setting("ARMILL_SITE_URL")?;
        let (origin, path) = match path.split_once("://") {
            Some(("file", _)) => path.split_at(path.rfind('/').map_or(0, |end| end + 1)),
            Some((scheme, rest)) => {
                path.split_at(scheme.len() + 3 + rest.find('/').map_or(rest.len(), |end| end + 1))
            }
            None => (site.as_str(), path),
        };
        // Firefox wants the folder of its downloads before it starts, so the session cannot name it.
        let downloads = own_folder("downloads");
        fs::create_dir_all(&downloads)?;
        let (capabilities, driver) = browser.session(&downloads)?;
        let client = ClientBuilder::new(HttpConnector::new())
            .capabilities(capabilities)
            .connect(&setting(driver)?)
            .await?;
        let page = Page {
            client,
            browser,
            origin: origin.to_owned(),
            downloads,
            console: RefCell::default(),
            expected: RefCell::default(),
        };
        page.resize(size).await?;
        if browser == Browser::Chromium {
            let allow = json!({ "behavior": "allow", "downloadPath": page.downloads });
            page.devtools("Browser.setDownloadBehavior", allow).await?;
        }
        page.goto(path).await?;
        Ok(page)
    }

    /// Goes to a page of the site.
    ///
    /// # Errors
    /// If it cannot be loaded.
    pub async fn goto(&self, path: &str) -> Result {
        let url = format!("{}{}", self.origin, path.trim_start_matches('/'));
        Ok(self.client.goto(&url).await?)
    }

    /// Loads the page again.
    ///
    /// # Errors
    /// If that fails.
    pub async fn reload(&self) -> Result {
        Ok(self.client.refresh().await?)
    }

    /// Opens another tab of the same browser, at a page of the site, and returns a handle of the
    /// previous tab.
    ///
    /// # Errors
    /// If the browser does not open one.
    pub async fn new_tab(&self, path: &str, size: Size) -> Result<WindowHandle> {
        let before = self.client.window().await?;
        let tab = self.client.new_window(true).await?;
        self.client.switch_to_window(tab.handle).await?;
        self.resize(size).await?;
        self.goto(path).await?;
        Ok(before)
    }

    /// Goes to an open tab.
    ///
    /// # Errors
    /// If it is closed.
    pub async fn switch_to(&self, tab: WindowHandle) -> Result {
        Ok(self.client.switch_to_window(tab).await?)
    }

    /// Emulates a device: a window cannot be as narrow as a phone.
    ///
    /// # Errors
    /// If the browser refuses.
    pub async fn resize(&self, size: Size) -> Result {
        self.resize_at(size, 1.0).await
    }

    /// The same with so many device pixels for each of CSS.
    ///
    /// # Errors
    /// If the browser refuses.
    pub async fn resize_at(&self, (width, height): Size, scale: f64) -> Result {
        if self.browser != Browser::Chromium {
            return Ok(self.client.set_window_size(width, height).await?);
        }
        let device = json!({ "width": width, "height": height, "deviceScaleFactor": scale, "mobile": false });
        self.devtools("Emulation.setDeviceMetricsOverride", device).await.map(|_| ())
    }

    /// Emulates a preference for dark colours, or for light ones.
    ///
    /// # Errors
    /// If the browser refuses.
    pub async fn prefer_dark(&self, dark: bool) -> Result {
        let value = if dark { "dark" } else { "light" };
        let media = json!({ "features": [{ "name": "prefers-color-scheme", "value": value }] });
        self.devtools("Emulation.setEmulatedMedia", media).await.map(|_| ())
    }

    /// The visible text of the first element that the CSS selector finds.
    ///
    /// # Errors
    /// If there is no such element.
    pub async fn text(&self, css: &str) -> Result<String> {
        Ok(self.element(css).await?.text().await?)
    }

    /// The current value of a form field.
    ///
    /// # Errors
    /// If there is no such field.
    pub async fn value(&self, css: &str) -> Result<String> {
        Ok(self.element(css).await?.prop("value").await?.unwrap_or_default())
    }

    /// Clicks an element.
    ///
    /// # Errors
    /// If there is no such element, or another one covers it.
    pub async fn click(&self, css: &str) -> Result {
        // The driver scrolls smoothly, as the page asks, and does not wait for it; nor does it know what
        // sticks to the edges.
        let place = "document.querySelector(css)?.scrollIntoView({ block: 'center', behavior: 'instant' })";
        // Without JavaScript the driver is left to itself.
        let _ = self.js(&format!("const css = {}; {place}", json!(css))).await;
        self.element(css).await?.click().await.map_err(|error| within(css, error))
    }

    /// Replaces the value of a form field, key by key.
    ///
    /// # Errors
    /// If there is no such field, or it cannot be typed into.
    pub async fn type_into(&self, css: &str, text: &str) -> Result {
        let select_all = format!("{}a{}", Key::Control, Key::Null);
        let field = self.element(css).await?;
        // Firefox does not take what follows a chord in the same call.
        for keys in [select_all.as_str(), if text.is_empty() { "\u{e003}" } else { text }] {
            field.send_keys(keys).await.map_err(|error| within(css, error))?;
        }
        Ok(())
    }

    /// Chooses an option of a `<select>` by its value; the one behind a searched list is set, as it
    /// is not on show.
    ///
    /// # Errors
    /// If there is no such option.
    pub async fn choose(&self, css: &str, value: &str) -> Result {
        let element = self.element(css).await?;
        if element.prop("hidden").await?.as_deref() != Some("true") {
            return element.select_by_value(value).await.map_err(|error| within(css, error));
        }
        let (select, value) = (json!(css), json!(value));
        let script = format!(
            "const select = document.querySelector({select}); select.value = {value}; \
             select.dispatchEvent(new Event('change', {{ bubbles: true }})); return select.selectedIndex >= 0"
        );
        if self.js(&script).await? == json!(true) {
            Ok(())
        } else {
            Err(format!("{css} has no option {value}").into())
        }
    }

    /// Presses keys one after the other, wherever the focus is: text, [`Key`]s, or both by
    /// `format!`.
    ///
    /// # Errors
    /// If nothing has the focus.
    pub async fn press(&self, keys: impl Display) -> Result {
        Ok(self.client.active_element().await?.send_keys(&keys.to_string()).await?)
    }

    /// Opens one of the pages of the view "Why".
    ///
    /// # Errors
    /// If there is no such page.
    pub async fn view(&self, name: &str) -> Result {
        self.click("#tab-why").await?;
        self.click(&format!("#tab-{name}")).await
    }

    /// Runs the body of a JavaScript function in the page and returns its result; promises are
    /// awaited.
    ///
    /// # Errors
    /// If it throws.
    pub async fn js(&self, body: &str) -> Result<Value> {
        self.client.execute(body, Vec::new()).await.map_err(|error| within(body, error))
    }

    /// Calls a JavaScript function with a module of the page, as `web/js/` has it, and returns its
    /// result.
    ///
    /// # Errors
    /// If it throws, or the page has no such module.
    pub async fn with_module(&self, name: &str, function: &str) -> Result<Value> {
        let scripts = "Promise.all(['./js/start.js', './js/main.js'].map((path) => import(path)))";
        let module = format!(
            "Object.assign({{}}, ...scripts).module_js_{}",
            name.replace(|c: char| !c.is_ascii_alphanumeric(), "_")
        );
        self.js(&format!("return {scripts}.then((scripts) => ({function})({module}))")).await
    }

    /// How many pixels the page is wider than its screen, and the elements that are.
    ///
    /// # Errors
    /// If the browser does not answer.
    pub async fn wider(&self) -> Result<Value> {
        self.js("const root = document.documentElement, over = root.scrollWidth - root.clientWidth; \
             const name = (element) => element.id || element.getAttribute('class') || element.tagName; \
             return over <= 0 ? null : [over, [...document.querySelectorAll('body *')].filter(element => \
             element.checkVisibility() && element.getBoundingClientRect().right > root.clientWidth).map(name)]")
            .await
    }

    /// Waits until a JavaScript expression is true; one that throws is not true yet.
    ///
    /// # Errors
    /// If it does not become true in time.
    pub async fn wait_for(&self, condition: &str, seconds: f64) -> Result {
        let start = Instant::now();
        loop {
            let answer = self.js(&format!("return Boolean({condition})")).await;
            match answer {
                Ok(Value::Bool(true)) => return Ok(()),
                _ if start.elapsed().as_secs_f64() < seconds => sleep(Duration::from_millis(50)).await,
                Ok(_) => return Err(format!("not true within {seconds} s: {condition}").into()),
                Err(error) => return Err(error),
            }
        }
    }

    /// Takes a screenshot of the viewport and returns its path in `target/screenshots`.
    ///
    /// # Errors
    /// If it cannot be taken or stored.
    pub async fn screenshot(&self, file: &str) -> Result<PathBuf> {
        let folder = scratch().with_file_name("screenshots");
        fs::create_dir_all(&folder)?;
        let path = folder.join(file);
        fs::write(&path, self.client.screenshot().await?)?;
        Ok(path)
    }

    /// Waits for a download to complete and returns its text.
    ///
    /// # Errors
    /// If no file of this name arrives in time, or it is not text.
    pub async fn downloaded(&self, file: &str) -> Result<String> {
        Ok(String::from_utf8(self.downloaded_bytes(file).await?)?)
    }

    /// Waits for a download to complete and returns its bytes.
    ///
    /// # Errors
    /// If no file of this name arrives in time.
    pub async fn downloaded_bytes(&self, file: &str) -> Result<Vec<u8>> {
        let path = self.downloads.join(file);
        let start = Instant::now();
        // The browser writes under another name; a file with the final name may exist, empty, until
        // the download is complete.
        while fs::metadata(&path).map_or(0, |file| file.len()) == 0 {
            if start.elapsed() > DOWNLOAD {
                let present: Vec<_> =
                    fs::read_dir(&self.downloads)?.flatten().map(|entry| entry.file_name()).collect();
                return Err(format!("no download named {file}, only {present:?}").into());
            }
            sleep(Duration::from_millis(50)).await;
        }
        Ok(fs::read(path)?)
    }

    /// Everything the console has shown since the page was opened, each line after its level.
    ///
    /// # Errors
    /// If the browser has gone.
    pub async fn console(&self) -> Result<Vec<String>> {
        let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
        let entries = self.log("browser").await?;
        let lines =
            entries.iter().map(|entry| format!("{}: {}", text(&entry["level"]), text(&entry["message"])));
        self.console.borrow_mut().extend(lines);
        Ok(self.console.borrow().clone())
    }

    /// Declares errors on the console and requests with this text as expected: [`Page::close`]
    /// ignores them.
    pub fn expect_error(&self, part: &str) {
        self.expected.borrow_mut().push(part.to_owned());
    }

    /// Closes the browser.
    ///
    /// # Errors
    /// If the console has shown an error, or a request has left the site.
    pub async fn close(self) -> Result {
        let faults = self.faults().await;
        self.client.close().await?;
        fs::remove_dir_all(&self.downloads)?;
        match faults?.as_slice() {
            [] => Ok(()),
            faults => Err(faults.join("\n").into()),
        }
    }

    /// Errors on the console, and requests to other sites. (A worker's requests are not in the log;
    /// the site's policy turns those that leave it into errors on the console.)
    async fn faults(&self) -> Result<Vec<String>> {
        let mut faults = self.console().await?;
        faults.retain(|line| line.starts_with("SEVERE"));
        for entry in self.log("performance").await? {
            let event: Value = serde_json::from_str(entry["message"].as_str().unwrap_or_default())?;
            if let Some(url) = requested(&event["message"]).filter(|url| !self.is_own(url)) {
                faults.push(format!("a request left the site: {url}"));
            }
        }
        let expected = self.expected.take();
        faults.retain(|line| !expected.iter().any(|part| line.contains(part)));
        Ok(faults)
    }

    /// Whether an address belongs to the site, or is inside the page itself.
    fn is_own(&self, url: &str) -> bool {
        url.starts_with(&self.origin)
            || ["data:", "blob:", "about:"].iter().any(|scheme| url.starts_with(scheme))
    }

    async fn element(&self, css: &str) -> Result<Element> {
        self.client.find(Locator::Css(css)).await.map_err(|error| within(css, error))
    }

    /// The entries of a driver's log since it was last read.
    async fn log(&self, kind: &str) -> Result<Vec<Value>> {
        if self.browser != Browser::Chromium {
            return Ok(Vec::new());
        }
        let entries =
            self.client.issue_cmd(Post { endpoint: "se/log", body: json!({ "type": kind }) }).await?;
        Ok(serde_json::from_value(entries)?)
    }

    /// A command of the Chrome DevTools protocol.
    ///
    /// # Errors
    /// If the browser does not know it.
    pub async fn devtools(&self, command: &str, parameters: Value) -> Result<Value> {
        let body = json!({ "cmd": command, "params": parameters });
        Ok(self.client.issue_cmd(Post { endpoint: "goog/cdp/execute", body }).await?)
    }
}

/// An error with its source location.
fn within(place: &str, error: impl Display) -> Box<dyn Error> {
    format!("{place}: {error}").into()
}
