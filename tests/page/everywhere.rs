//! What holds in every browser: the same bits, and the first screen.

use armill::{Job, Progress};
use serde_json::json;

use crate::browser::{DESKTOP, Result, THESIS, visit_in};
use crate::common::run;
use crate::session::Browser;
use crate::{current, shows};

/// The thesis's job, one that is typed, and the opening one have the fingerprints of a native run.
pub(crate) fn same_bits(browser: Browser) -> Result {
    visit_in(browser, THESIS, DESKTOP, async |page| {
        shows(page, &run(&[])).await?;
        page.type_into("#motion-feed_mm_s", "80.5").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80.5))])).await
    })?;
    // In a profile of its own: the page keeps what was typed.
    visit_in(browser, "/", DESKTOP, async |page| {
        shows(page, &armill::run(&Job::opening()?, &mut Progress::none())?).await
    })
}

/// Verdict, figures, picture and curve begin on the first screen, and nothing is wider than it.
pub(crate) fn first_screen(browser: Browser) -> Result {
    visit_in(browser, "/", DESKTOP, async |page| {
        current(page).await?;
        page.wait_for("document.querySelector('#curve svg .series')", 30.0).await?;
        page.wait_for(
            "document.querySelector('#scene').dataset.sample !== undefined \
             || document.querySelector('#scene').textContent.includes('WebGL')",
            30.0,
        )
        .await?;
        // A window has a frame, so the viewport is a little lower than on a laptop.
        let seen = page
            .js("return ['.picture', '#curve .drawing', '#verdict', '#expected-p95'].map(css => \
                 document.querySelector(css).getBoundingClientRect().top).every(top => top >= 0 && top < innerHeight)")
            .await?;
        assert_eq!(seen, true);
        assert_eq!(page.wider().await?, serde_json::Value::Null);
        Ok(())
    })
}
