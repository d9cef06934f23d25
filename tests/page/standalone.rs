//! The one-file page, opened from disk as by a double click.

use std::path::Path;

use serde_json::json;

use crate::browser::{DESKTOP, Result, visit};
use crate::cards::job;
use crate::common::run;
use crate::{current, shows, text};

/// The address of the file on disk.
pub(crate) fn address() -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/site/standalone.html");
    format!("file://{}#example=thesis", file.display())
}

#[test]
fn the_one_file_page_works_from_disk() -> Result {
    visit(&address(), DESKTOP, async |page| {
        assert_eq!(page.js("return location.protocol").await?, "file:");
        shows(page, &run(&[])).await?;
        page.type_into("#motion-feed_mm_s", "80").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80))])).await?;
        page.wait_for("document.querySelector('#chart-before-after svg .series')", 20.0).await?;
        assert_eq!(page.js("return document.getElementById('share-embed')").await?, json!(null));
        // The examples are inside.
        page.choose("#examples", "rim.csv").await?;
        page.wait_for("document.querySelector('#path-kind').value === 'csv'", 20.0).await?;
        current(page).await?;
        assert_eq!(page.value("#path-kind").await?, "csv");
        assert!(text(page, "understood").await?.contains("the tool axis turns"));
        page.click("#download-compensated").await?;
        assert!(page.downloaded("rim-compensated-path.csv").await?.starts_with("time_s,"));
        // So is the gallery, with its pictures.
        let shown = "return [...document.querySelectorAll('.card img')].filter((image) => image.naturalWidth === 640).length";
        assert_eq!(page.js(shown).await?, 8);
        for name in ["climb", "thesis"] {
            page.js(&format!("document.querySelector('#card-{name} h2 a').click()")).await?;
            shows(page, &armill::run(&job(name), &mut armill::Progress::none())?).await?;
        }
        page.wait_for("scrollY === 0", 10.0).await?;
        Ok(())
    })
}
