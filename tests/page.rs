//! The built page in a real browser. `cargo xtask test` builds and serves the page, starts the driver and runs these.

#[path = "page/browser.rs"]
pub mod browser;

use browser::{DESKTOP, Result, visit};

#[test]
fn the_page_opens() -> Result {
    visit("/", DESKTOP, async |page| {
        assert!(page.js("return document.title").await?.as_str().is_some_and(|title| !title.is_empty()));
        Ok(())
    })
}
