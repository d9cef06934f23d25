//! The page in Firefox: the same bits, the first screen, and one program to its package.
//! `cargo xtask test --firefox` runs these; they need Firefox and its driver.

use armill::{Job, Progress};
use serde_json::json;

use crate::browser::{DESKTOP, Result, THESIS, visit_in};
use crate::common::run;
use crate::personas::{Person, from_a_pocket_to_a_package};
use crate::session::Browser;
use crate::{current, shows};

#[test]
#[ignore = "needs Firefox: cargo xtask test --firefox"]
fn firefox_computes_the_same_bits() -> Result {
    visit_in(Browser::Firefox, THESIS, DESKTOP, async |page| {
        shows(page, &run(&[])).await?;
        page.type_into("#motion-feed_mm_s", "80.5").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80.5))])).await
    })?;
    // In a profile of its own: the page keeps what was typed.
    visit_in(Browser::Firefox, "/", DESKTOP, async |page| {
        shows(page, &armill::run(&Job::opening()?, &mut Progress::none())?).await
    })
}

#[test]
#[ignore = "needs Firefox: cargo xtask test --firefox"]
fn firefox_has_picture_and_curve_on_the_first_screen() -> Result {
    visit_in(Browser::Firefox, "/", DESKTOP, async |page| {
        current(page).await?;
        page.wait_for("document.querySelector('#curve svg .series')", 30.0).await?;
        page.wait_for(
            "document.querySelector('#scene').dataset.sample !== undefined \
             || document.querySelector('#scene').textContent.includes('WebGL')",
            30.0,
        )
        .await?;
        // A headless window has a frame, so the viewport is a little lower than on a laptop.
        let seen = page
            .js("return ['.picture', '#curve .drawing', '#verdict', '#expected-p95'].map(css => \
                 document.querySelector(css).getBoundingClientRect().top).every(top => top >= 0 && top < innerHeight)")
            .await?;
        assert_eq!(seen, true);
        assert_eq!(page.wider().await?, serde_json::Value::Null);
        Ok(())
    })
}

#[test]
#[ignore = "needs Firefox: cargo xtask test --firefox"]
fn firefox_takes_a_pocket_to_its_package() -> Result {
    visit_in(Browser::Firefox, "/", DESKTOP, async |page| {
        from_a_pocket_to_a_package(&mut Person::at(page)).await
    })
}
