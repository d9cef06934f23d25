//! The page without a network once it was visited, and what happens when the site changes. The site
//! is served from memory here, under a name that the page does not take for a developer's server.

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::Path;
use std::sync::{Arc, Mutex};
use std::thread;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use crate::browser::{DESKTOP, Page, Result, visit};
use crate::common::run;
use crate::{current, shows};

const WORKER: &str = "service-worker.js";
const CORE: &str = "pkg/armill_bg.wasm";
const PAGE: &str = "index.html";

/// The files of a site, by path.
type Site = BTreeMap<String, Vec<u8>>;

/// The built site.
fn built() -> Result<Site> {
    fn add(folder: &Path, root: &Path, site: &mut Site) -> Result {
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            if path.is_dir() {
                add(&path, root, site)?;
            } else {
                let name = path.strip_prefix(root)?.to_string_lossy().replace('\\', "/");
                site.insert(name, fs::read(&path)?);
            }
        }
        Ok(())
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/site");
    let mut site = Site::new();
    add(&root, &root, &mut site)?;
    Ok(site)
}

/// The site as a later build would make it: another title, and another core that computes the same.
fn later(site: &Site, title: &str) -> Result<Site> {
    let mut next = site.clone();
    let page = String::from_utf8(site[PAGE].clone())?;
    let (head, rest) = page.split_once("<title>").ok_or("no title")?;
    let (_, body) = rest.split_once("</title>").ok_or("no title")?;
    next.insert(PAGE.into(), format!("{head}<title>{title}</title>{body}").into());
    // A custom section, which WebAssembly ignores: its id, its length, and a name of as many letters.
    let length = u8::try_from(title.len())?;
    let section = [&[0, length + 1, length], title.as_bytes()].concat();
    next.get_mut(CORE).ok_or("no core")?.extend(section);

    let hash = |site: &Site, path: &str| BASE64_STANDARD.encode(Sha256::digest(&site[path]));
    let mut script = String::from_utf8(site[WORKER].clone())?;
    for path in [PAGE, CORE] {
        let before = hash(site, path);
        assert!(script.contains(&before), "{path} is kept");
        script = script.replace(&before, &hash(&next, path));
    }
    let (head, rest) = script.split_once("const VERSION = \"").ok_or("no version")?;
    let (_, rest) = rest.split_once('"').ok_or("no version")?;
    next.insert(WORKER.into(), format!("{head}const VERSION = \"{title}\"{rest}").into());
    Ok(next)
}

/// A web server of its own, whose site is swapped while it runs. Without one it hangs up on everybody.
struct Server {
    url: String,
    site: Arc<Mutex<Option<Site>>>,
}

impl Server {
    fn start(site: &Site) -> Result<Server> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?;
        let url = format!("http://armill.localhost:{}/", listener.local_addr()?.port());
        let served = Arc::new(Mutex::new(Some(site.clone())));
        let site = Arc::clone(&served);
        thread::spawn(move || {
            for stream in listener.incoming().flatten() {
                let site = Arc::clone(&served);
                // The browser may hang up first.
                thread::spawn(move || answer(stream, &site).is_ok());
            }
        });
        Ok(Server { url, site })
    }

    fn serve(&self, site: Option<&Site>) {
        *self.site.lock().unwrap() = site.cloned();
    }
}

fn answer(mut stream: TcpStream, site: &Mutex<Option<Site>>) -> std::io::Result<()> {
    let mut lines = BufReader::new(stream.try_clone()?).lines();
    let request = lines.next().transpose()?.unwrap_or_default();
    while lines.next().transpose()?.is_some_and(|line| !line.is_empty()) {}
    let address = request.split(' ').nth(1).unwrap_or_default();
    let path = address.split('?').next().unwrap_or_default().trim_start_matches('/');
    let path = if path.is_empty() { PAGE } else { path };
    let Some(site) = site.lock().unwrap().clone() else { return Ok(()) };
    let Some(body) = site.get(path) else {
        return write!(stream, "HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\nConnection: close\r\n\r\n");
    };
    let kind = match path.rsplit('.').next() {
        Some("html") => "text/html",
        Some("js") => "text/javascript",
        Some("css") => "text/css",
        Some("svg") => "image/svg+xml",
        Some("wasm") => "application/wasm",
        _ => "text/plain",
    };
    let length = body.len();
    write!(
        stream,
        "HTTP/1.1 200 OK\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\nConnection: close\r\n\r\n"
    )?;
    stream.write_all(body)
}

/// Waits until the browser has stored the site, and returns the names of its stores.
async fn stores(page: &Page) -> Result<Value> {
    let script = "return new Promise((done) => { const look = async () => { \
        const registration = await navigator.serviceWorker.getRegistration(); \
        if (registration?.active?.state === 'activated') done(caches.keys()); else setTimeout(look, 50); \
        }; look(); })";
    page.js(script).await
}

/// Has the browser look for another version, and returns whether one is waiting after that.
async fn finds_newer(page: &Page) -> Result<Value> {
    let script = "return navigator.serviceWorker.getRegistration().then(async (registration) => { \
        await registration.update().catch(() => {}); \
        const { installing } = registration; \
        if (installing) await new Promise((done) => { const look = () => \
            ['installed', 'redundant'].includes(installing.state) && done(); \
            installing.addEventListener('statechange', look); look(); }); \
        return Boolean(registration.waiting); })";
    page.js(script).await
}

/// The page shows this title, and the core that it gets is this site's.
async fn is_of(page: &Page, site: &Site, title: &str) -> Result {
    current(page).await?;
    // A job's name may follow the site's.
    let shown = page.js("return document.title").await?;
    let shown = shown.as_str().unwrap_or_default().to_owned();
    assert!(shown.contains(title), "{shown}");
    let core = "return fetch('pkg/armill_bg.wasm').then((answer) => answer.arrayBuffer()).then((core) => core.byteLength)";
    assert_eq!(page.js(core).await?, json!(site[CORE].len()));
    Ok(())
}

/// Leaves the site.
async fn leave(page: &Page) -> Result {
    page.js("location.href = 'about:blank'").await?;
    page.wait_for("location.href === 'about:blank'", 20.0).await
}

#[test]
fn a_visited_page_needs_no_network() -> Result {
    let server = Server::start(&built()?)?;
    visit(&format!("{}?visit=1#example=thesis", server.url), DESKTOP, async |page| {
        page.expect_error(WORKER);
        shows(page, &run(&[])).await?;
        let stores = stores(page).await?;
        assert!(stores.as_array().is_some_and(|names| names.len() == 1), "{stores}");
        server.serve(None);
        page.reload().await?;
        shows(page, &run(&[])).await?;
        page.type_into("#motion-feed_mm_s", "80").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80))])).await?;
        page.choose("#examples", "rim.csv").await?;
        page.wait_for("document.querySelector('#path-kind').value === 'csv'", 20.0).await?;
        current(page).await?;
        page.goto("/index.html?visit=2#example=thesis").await?;
        shows(page, &run(&[])).await?;
        // Embedded pages get the same core, so they are kept too.
        page.goto("/embed.html").await?;
        page.wait_for("document.querySelector('[data-state=current]')", 30.0).await
    })
}

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn page_and_core_are_of_one_version() -> Result {
    let first = built()?;
    let (second, third) = (later(&first, "Second")?, later(&first, "Third")?);
    let server = Server::start(&first)?;
    visit(&server.url, DESKTOP, async |page| {
        current(page).await?;
        stores(page).await?;
        page.reload().await?;
        is_of(page, &first, "Armill").await?;

        // A deployment half way: the list is new, the core is not yet.
        let mut half = second.clone();
        half.insert(CORE.into(), first[CORE].clone());
        server.serve(Some(&half));
        page.expect_error("integrity");
        assert_eq!(finds_newer(page).await?, false);
        page.reload().await?;
        is_of(page, &first, "Armill").await?;

        // The next version waits for the page that is open, and says so.
        server.serve(Some(&second));
        assert_eq!(finds_newer(page).await?, true);
        page.wait_for("document.querySelector('#notice').textContent.includes('newer version')", 20.0)
            .await?;
        page.reload().await?;
        is_of(page, &first, "Armill").await?;
        page.wait_for("document.querySelector('#notice').textContent.includes('newer version')", 20.0)
            .await?;
        page.type_into("#motion-feed_mm_s", "21").await?;
        current(page).await?;

        // It does not come while another tab shows the old one.
        let tab = page.new_tab("/#view=forces", DESKTOP).await?;
        current(page).await?;
        page.wait_for("document.querySelector('#notice').textContent.includes('newer version')", 20.0)
            .await?;
        page.click("#notice button").await?;
        page.wait_for("document.querySelector('#notice').textContent.includes('other tabs')", 20.0).await?;
        is_of(page, &first, "Armill").await?;
        leave(page).await?;
        page.switch_to(tab).await?;
        page.click("#notice button").await?;
        page.wait_for("document.title.includes('Second')", 20.0).await?;
        is_of(page, &second, "Second").await?;
        assert_eq!(page.value("#motion-feed_mm_s").await?, "21", "the inputs are kept");
        let stores = stores(page).await?;
        assert!(
            stores.as_array().is_some_and(|names| names.len() == 1) && stores.to_string().contains("Second"),
            "{stores}"
        );

        // Without a click it comes when the last page is gone.
        server.serve(Some(&third));
        assert_eq!(finds_newer(page).await?, true);
        is_of(page, &second, "Second").await?;
        leave(page).await?;
        page.goto("/").await?;
        is_of(page, &third, "Third").await
    })
}

#[test]
fn a_server_on_this_machine_is_not_kept() -> Result {
    visit("/", DESKTOP, async |page| {
        current(page).await?;
        let registered =
            "return new Promise(requestIdleCallback).then(() => navigator.serviceWorker.getRegistrations())";
        assert_eq!(page.js(&format!("{registered}.then((list) => list.length)")).await?, 0);
        Ok(())
    })
}
