//! The gallery in the browser: its cards open their jobs, and it reads and looks as it should.

use std::path::Path;

use armill::Progress;
use serde_json::json;

use crate::browser::{DESKTOP, PHONE, Result, setting, visit};
use crate::cards::{cards, job};
use crate::{current, shows};

#[test]
#[ignore = "takes half a minute: cargo xtask test --heavy"]
fn every_card_opens_its_job() -> Result {
    visit("/gallery.html", DESKTOP, async |page| {
        let cards = cards();
        let addresses = page
            .js("return [...document.querySelectorAll('.card h2 a')].map((link) => link.getAttribute('href'))")
            .await?;
        let addresses: Vec<&str> =
            addresses.as_array().into_iter().flatten().filter_map(|a| a.as_str()).collect();
        let links: Vec<_> = cards.iter().map(|card| &card.links[0]).collect();
        assert_eq!(addresses.len(), links.len());
        for (k, (address, (name, words))) in addresses.into_iter().zip(links).enumerate() {
            // Another fragment alone would not load the page again.
            page.goto(&address.replace('#', &format!("?visit={k}#"))).await?;
            let report = armill::run(&job(name), &mut Progress::none())?;
            shows(page, &report).await.map_err(|error| format!("{name} ({words}): {error}"))?;
        }
        // By a click anywhere on a card.
        page.goto("/gallery.html").await?;
        page.js("const image = document.querySelector('#card-climb img'); image.scrollIntoView({ behavior: 'instant' }); \
             const { left, top } = image.getBoundingClientRect(); document.elementFromPoint(left + 50, top + 50).click()")
            .await?;
        current(page).await?;
        assert_eq!(page.value("#job-name").await?, job("climb").name.unwrap_or_default());
        Ok(())
    })
}

#[test]
fn cards_stand_in_two_columns_or_one() -> Result {
    for (size, columns) in [(DESKTOP, 2), (PHONE, 1)] {
        visit("/gallery.html", size, async |page| {
            let lefts = "return new Set([...document.querySelectorAll('.card')].map((card) => card.getBoundingClientRect().left)).size";
            assert_eq!(page.js(lefts).await?, columns);
            assert_eq!(page.wider().await?, json!(null));
            let broken = "return [...document.images].filter((image) => !image.complete || !image.naturalWidth).length";
            page.wait_for("document.readyState === 'complete'", 20.0).await?;
            assert_eq!(page.js(broken).await?, 0);
            Ok(())
        })?;
    }
    Ok(())
}

#[test]
fn axe_finds_nothing() -> Result {
    let axe = std::fs::read_to_string(Path::new(&setting("ARMILL_NPM_TOOLS")?).join("axe-core/axe.min.js"))?;
    for size in [DESKTOP, PHONE] {
        visit("/gallery.html", size, async |page| {
            page.js(&axe).await?;
            for dark in [false, true] {
                page.prefer_dark(dark).await?;
                let found = "return axe.run(document).then(({ violations }) => violations.map(({ id, nodes }) => \
                             [id, nodes.map(({ target }) => target.flat().join(' '))]))";
                assert_eq!(page.js(found).await?, json!([]), "dark: {dark}");
            }
            Ok(())
        })?;
    }
    Ok(())
}
