//! What the page loads, and when: the small core at first, the full one after the first result.

use crate::browser::{DESKTOP, Page, Result, visit};
use crate::common::run;
use crate::{current, shows, text};
use serde_json::json;

const LINE: &str = "G21 G90 G1 X600 Y0 Z100 F1200\nX640";

/// Waits until the charts of the first view are drawn: by the full core.
async fn charts(page: &Page) -> Result {
    page.wait_for("document.querySelectorAll('#panel-overview figure .series').length >= 3", 20.0).await
}

/// How many times each core was fetched, small and full.
async fn fetched(page: &Page) -> Result<[u64; 2]> {
    let counts = page
        .js("const names = performance.getEntriesByType('resource').map(({ name }) => name).filter((name) => name.endsWith('.wasm')); \
             return ['small', 'full'].map((core) => names.filter((name) => name.endsWith(`/pkg/${core}/armill_bg.wasm`)).length)")
        .await?;
    Ok(serde_json::from_value(counts)?)
}

async fn choose_program(page: &Page) -> Result {
    page.choose("#path-kind", "gcode").await?;
    page.js(&format!(
        "const area = document.getElementById('path-text'); area.value = {}; area.dispatchEvent(new Event('input', {{ bubbles: true }}))",
        json!(LINE)
    ))
    .await?;
    Ok(())
}

#[test]
fn the_first_result_takes_the_small_core_and_the_full_one_follows_once() -> Result {
    visit("/", DESKTOP, async |page| {
        shows(page, &run(&[])).await?;
        charts(page).await?;
        assert_eq!(fetched(page).await?, [1, 1]);
        let waited = page
            .js("const of = (core) => performance.getEntriesByType('resource').find(({ name }) => name.endsWith(`/pkg/${core}/armill_bg.wasm`)); \
                 return of('full').startTime - of('small').responseEnd")
            .await?;
        assert!(waited.as_f64() > Some(0.0), "the full core is fetched {waited} ms after the small one");
        choose_program(page).await?;
        let program = run(&[("path", json!({ "kind": "gcode", "text": LINE }))]);
        shows(page, &program).await?;
        assert_eq!(fetched(page).await?, [1, 1]);
        // From then on the full one answers, in both Workers.
        page.click("#reset").await?;
        shows(page, &run(&[])).await?;
        page.click("#download-columns").await?;
        page.downloaded("armill-columns.csv").await?;
        page.click("#undo").await?;
        shows(page, &program).await?;
        assert_eq!(fetched(page).await?, [1, 1]);
        Ok(())
    })
}

#[test]
fn a_file_of_the_shown_result_comes_from_the_full_core_with_the_same_bits() -> Result {
    visit("/", DESKTOP, async |page| {
        current(page).await?;
        page.click("#download-columns").await?;
        let file = page.downloaded("armill-columns.csv").await?;
        let native = armill::export::export(&run(&[]), "columns-csv", &Default::default())?;
        assert!(file == native.text, "the columns differ from the native ones");
        assert_eq!(fetched(page).await?, [1, 1]);
        // The charts go on from the same run.
        page.click("#tab-joints").await?;
        page.wait_for("document.querySelector('#panel-joints svg .series')", 20.0).await
    })
}

#[test]
fn a_full_core_that_does_not_come_is_told_and_can_be_tried_again() -> Result {
    visit("/", DESKTOP, async |page| {
        page.devtools("Network.enable", json!({})).await?;
        page.devtools("Network.setCacheDisabled", json!({ "cacheDisabled": true })).await?;
        page.devtools("Network.setBlockedURLs", json!({ "urls": ["*/pkg/full/*"] })).await?;
        page.expect_error("pkg/full/armill_bg.wasm");
        page.reload().await?;
        // The small core alone gives the first result; the charts say what they lack.
        shows(page, &run(&[])).await?;
        let lack = "reads programs and writes files could not be loaded";
        let says = format!(
            "document.querySelector('#chart-before-after figcaption').textContent.includes('{lack}')"
        );
        page.wait_for(&says, 20.0).await?;
        choose_program(page).await?;
        page.wait_for("document.querySelector('#alert button')", 20.0).await?;
        let alert = text(page, "alert").await?;
        assert!(alert.contains(lack), "{alert}");
        shows_still(page).await?;
        page.devtools("Network.setBlockedURLs", json!({ "urls": [] })).await?;
        page.click("#alert button").await?;
        shows(page, &run(&[("path", json!({ "kind": "gcode", "text": LINE }))])).await?;
        charts(page).await
    })
}

/// The last good result stays.
async fn shows_still(page: &Page) -> Result {
    crate::stale(page).await?;
    let verdict = text(page, "verdict").await?;
    assert!(verdict.contains(run(&[]).verdict().split(';').next().unwrap_or_default()), "{verdict}");
    Ok(())
}
