//! The page in WebKitGTK: the same bits, the first screen, and one question. `cargo xtask test --webkit` runs these;
//! they need its driver.

use crate::browser::{DESKTOP, Result, visit_in};
use crate::current;
use crate::everywhere;
use crate::session::Browser;

#[test]
#[ignore = "needs WebKitGTK: cargo xtask test --webkit"]
fn webkit_computes_the_same_bits() -> Result {
    everywhere::same_bits(Browser::WebKit)
}

#[test]
#[ignore = "needs WebKitGTK: cargo xtask test --webkit"]
fn webkit_has_picture_and_curve_on_the_first_screen() -> Result {
    everywhere::first_screen(Browser::WebKit)
}

/// Its Workers share the runs.
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
