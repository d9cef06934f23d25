//! What the page loads, and when: the core once, for one run of the opening job.

use armill::{Job, Report};
use serde_json::{Value, json};

use crate::browser::{DESKTOP, Page, Result, THESIS, visit};
use crate::common::run;
use crate::{shows, stopped, text};

const LINE: &str = "G21 G90 G1 X600 Y0 Z100 F1200\nX640";

/// Runs before the page's own scripts: counts the requests to every Worker, by kind, and the
/// modules sent to it.
const COUNT_QUESTIONS: &str = "\
    window.asked = {}; window.supplied = [];
    window.Worker = class extends Worker {
      postMessage(message, ...rest) {
        if (message.module) supplied.push(message.module);
        else asked[message.kind] = (asked[message.kind] ?? 0) + 1;
        super.postMessage(message, ...rest);
      }
    };";

/// Waits until the charts of the first view are drawn.
async fn charts(page: &Page) -> Result {
    page.wait_for("document.querySelectorAll('#panel-overview figure .series').length >= 3", 20.0).await
}

/// The WebAssembly files that were fetched, by name.
async fn fetched(page: &Page) -> Result<Value> {
    page.js("return performance.getEntriesByType('resource').map(({ name }) => new URL(name).pathname) \
         .filter((name) => name.endsWith('.wasm'))")
        .await
}

/// How often the Workers were asked to compute a job.
async fn runs(page: &Page) -> Result<Value> {
    page.js("return asked.run").await
}

async fn choose_program(page: &Page) -> Result<Report> {
    page.choose("#path-kind", "gcode").await?;
    page.js(&format!(
        "const area = document.getElementById('path-text'); area.value = {}; area.dispatchEvent(new Event('input', {{ bubbles: true }}))",
        json!(LINE)
    ))
    .await?;
    Ok(run(&[("path", json!({ "kind": "gcode", "text": LINE }))]))
}

#[test]
fn a_visit_fetches_the_core_once_and_computes_one_run() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        page.devtools("Page.addScriptToEvaluateOnNewDocument", json!({ "source": COUNT_QUESTIONS })).await?;
        page.reload().await?;
        let core = json!(["/pkg/armill_bg.wasm"]);
        shows(page, &run(&[])).await?;
        charts(page).await?;
        assert_eq!(runs(page).await?, 1);
        assert_eq!(fetched(page).await?, core);

        // Charts, a file, an identification and the thesis's figures come from the same core; none
        // of them computes the job again.
        page.view("joints").await?;
        page.wait_for("document.querySelector('#panel-joints svg .series')", 20.0).await?;
        page.click("#download-columns").await?;
        let file = page.downloaded("armill-columns.csv").await?;
        let native = armill::verification::export(&run(&[]), "columns-csv", &Default::default())?;
        assert!(file == native.text, "the columns differ from the native ones");
        page.click("#tab-identify").await?;
        page.js("document.querySelector('#identify-loads-example').click()").await?;
        page.wait_for("document.querySelector('#chart-stiffness svg.plot')", 30.0).await?;
        page.click("#tab-thesis").await?;
        page.wait_for("document.querySelectorAll('#thesis tbody tr').length >= 10", 30.0).await?;
        assert_eq!(runs(page).await?, 1);

        // A program is another run.
        let program = choose_program(page).await?;
        shows(page, &program).await?;
        page.choose("#export-format", "gcode").await?;
        page.click("#download-program").await?;
        page.downloaded("ARMILL.nc").await?;
        page.js("document.getElementById('open-thesis').click()").await?;
        shows(page, &run(&[])).await?;
        page.click("#undo").await?;
        shows(page, &program).await?;
        assert_eq!(fetched(page).await?, core);
        // Every Worker received the module that was compiled once.
        assert_eq!(page.js("return supplied.length >= 2 && new Set(supplied).size === 1").await?, true);
        Ok(())
    })
}

#[test]
fn the_form_is_built_from_what_the_core_says_of_itself() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        let version =
            page.with_module("core/client", "({ load }) => load().then(({ version }) => version)").await?;
        assert_eq!(version, env!("CARGO_PKG_VERSION"));
        // Compared in the browser, to which 1 and 1.0 are one number.
        for (part, native) in [
            ("job", format!("{{ ...{}, model: {} }}", Job::default().to_json(), armill::model::MODEL)),
            ("fields", serde_json::to_string(&armill::job::fields::fields())?),
            ("presets", serde_json::to_string(&armill::job::presets::presets())?),
        ] {
            let same = format!(
                "({{ load }}) => load().then(({{ {part} }}) => JSON.stringify({part}) === JSON.stringify({native}))"
            );
            assert_eq!(page.with_module("core/client", &same).await?, true, "{part}");
        }
        let ids = page
            .with_module(
                "core/client",
                "({ load }) => load().then(({ formats }) => formats.map(({ id }) => id))",
            )
            .await?;
        assert!(ids.as_array().is_some_and(|ids| ids.contains(&json!("gcode"))), "{ids}");
        Ok(())
    })
}

#[test]
fn a_core_that_does_not_come_is_reported_and_can_be_tried_again() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        page.devtools("Network.enable", json!({})).await?;
        page.devtools("Network.setCacheDisabled", json!({ "cacheDisabled": true })).await?;
        page.devtools("Network.setBlockedURLs", json!({ "urls": ["*/armill_bg.wasm"] })).await?;
        page.expect_error("pkg/armill_bg.wasm");
        page.reload().await?;
        stopped(page).await?;
        let alert = text(page, "alert").await?;
        assert!(alert.starts_with("The core could not be loaded: "), "{alert}");
        // One more failure, then success.
        page.click("#alert button").await?;
        page.wait_for("document.querySelector('#alert button')", 20.0).await?;
        page.devtools("Network.setBlockedURLs", json!({ "urls": [] })).await?;
        page.click("#alert button").await?;
        shows(page, &run(&[])).await?;
        assert_eq!(text(page, "alert").await?, "");
        charts(page).await?;
        let program = choose_program(page).await?;
        shows(page, &program).await
    })
}

/// Runs before the page's own scripts: while `astray` is true, a Worker's script is at the wrong
/// address.
const LEAD_ASTRAY: &str = "\
    window.astray = false;
    window.Worker = class extends Worker {
      constructor(url, options) { super(astray ? new URL('missing.js', url) : url, options); }
    };";

#[test]
fn a_worker_that_does_not_start_is_reported_and_the_last_result_stays() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        page.devtools("Page.addScriptToEvaluateOnNewDocument", json!({ "source": LEAD_ASTRAY })).await?;
        page.reload().await?;
        shows(page, &run(&[])).await?;
        page.expect_error("missing.js");
        page.expect_error("internal error");
        page.expect_error("asked for");
        // The spare Worker computes the lost result again; its replacement does not start.
        page.js("astray = true").await?;
        page.with_module("core/client", "({ trap }) => trap()").await?;
        page.wait_for("document.querySelector('#alert').textContent.includes('started again')", 20.0).await?;
        shows(page, &run(&[])).await?;
        page.type_into("#motion-feed_mm_s", "80").await?;
        stopped(page).await?;
        assert!(text(page, "alert").await?.starts_with("The core could not be loaded: "));
        assert_eq!(text(page, "verdict").await?, run(&[]).verdict());
        assert_eq!(text(page, "status").await?, "Showing the last valid result.");
        page.js("astray = false").await?;
        page.click("#alert button").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80))])).await
    })
}
