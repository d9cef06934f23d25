//! The page in WebKitGTK: the same bits, and the first screen. `cargo xtask test --webkit` runs these; they need its
//! driver.

use armill::{Job, Progress};
use serde_json::json;

use crate::browser::{DESKTOP, Result, THESIS, visit_in};
use crate::common::run;
use crate::session::Browser;
use crate::{current, shows};

#[test]
#[ignore = "needs WebKitGTK: cargo xtask test --webkit"]
fn webkit_computes_the_same_bits() -> Result {
    visit_in(Browser::WebKit, THESIS, DESKTOP, async |page| {
        shows(page, &run(&[])).await?;
        page.type_into("#motion-feed_mm_s", "80.5").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80.5))])).await
    })?;
    visit_in(Browser::WebKit, "/", DESKTOP, async |page| {
        shows(page, &armill::run(&Job::opening()?, &mut Progress::none())?).await
    })
}

#[test]
#[ignore = "needs WebKitGTK: cargo xtask test --webkit"]
fn webkit_has_picture_and_curve_on_the_first_screen() -> Result {
    visit_in(Browser::WebKit, "/", DESKTOP, async |page| {
        current(page).await?;
        page.wait_for("document.querySelector('#curve svg .series')", 30.0).await?;
        let seen = page
            .js("return ['.picture', '#curve .drawing', '#verdict', '#expected-p95'].map(css => \
                 document.querySelector(css).getBoundingClientRect().top).every(top => top >= 0 && top < innerHeight)")
            .await?;
        assert_eq!(seen, true);
        assert_eq!(page.wider().await?, serde_json::Value::Null);
        Ok(())
    })
}

/// A question about the job: Workers of this browser share its runs.
#[test]
#[ignore = "needs WebKitGTK: cargo xtask test --webkit"]
fn webkit_answers_a_question() -> Result {
    visit_in(Browser::WebKit, "/", DESKTOP, async |page| {
        current(page).await?;
        page.click("#tab-compare").await?;
        page.click("[data-question=choices]").await?;
        page.wait_for("document.querySelectorAll('.answer-picture svg .series').length > 3", 60.0).await?;
        page.wait_for("document.querySelectorAll('.answer-table .best').length === 1", 10.0).await
    })
}
