//! The embedded calculator: embed.html alone, and the element in a page of rustdoc and of mdBook.

use armill::Report;
use serde_json::{Value, json};

use crate::browser::{DESKTOP, Page, Result, setting, visit};
use crate::common::program::opened_example;
use crate::common::run;
use crate::current;

/// Waits until embed.html shows this report.
async fn answers(page: &Page, report: &Report) -> Result {
    let fingerprint = report.fingerprint();
    let shown = format!("document.getElementById('fingerprint').textContent === '{fingerprint}'");
    page.wait_for(&shown, 30.0).await?;
    current(page).await?;
    let cells = listed(page, "#figures td", "dataset.value").await?;
    let cells: Vec<String> = serde_json::from_value(cells)?;
    let cells: Vec<f64> = cells.iter().map(|cell| cell.parse()).collect::<std::result::Result<_, _>>()?;
    let summary = report.summary();
    let (before, after) = (summary.before_mm.both, summary.after_mm);
    assert_eq!(cells, [before.mean, before.max, after.mean, after.max]);
    Ok(())
}

/// The elements of a list that are visible, by an attribute of each.
async fn listed(page: &Page, css: &str, property: &str) -> Result<Value> {
    page.js(&format!("return [...document.querySelectorAll('{css}')].map(each => each.{property})")).await
}

#[test]
fn a_frame_shows_what_its_address_asks_for() -> Result {
    let asked =
        "/embed.html#inputs=motion.feed_mm_s+tool&charts=joints+before-after&theme=dark&preset=al-7075-t6";
    visit(asked, DESKTOP, async |page| {
        let aluminium = ("material", json!({"preset": "al-7075-t6"}));
        answers(page, &run(std::slice::from_ref(&aluminium))).await?;
        let inputs = listed(page, "#form .label[for]", "htmlFor").await?;
        let inputs: Vec<String> = serde_json::from_value(inputs)?;
        assert_eq!(inputs[0], "motion-feed_mm_s");
        assert!(inputs.len() > 1 && inputs[1..].iter().all(|id| id.starts_with("tool-")), "{inputs:?}");
        page.wait_for("document.querySelectorAll('#panel-embed svg .series').length > 8", 20.0).await?;
        let charts = listed(page, "#panel-embed figure", "id").await?;
        let joints = ["joints", "joint-1", "joint-2", "joint-3", "joint-4", "joint-5", "joint-6"];
        let expected: Vec<String> =
            joints.iter().chain(&["before-after"]).map(|name| format!("chart-{name}")).collect();
        assert_eq!(charts, json!(expected));
        let background = "return getComputedStyle(document.body).backgroundColor";
        let dark = page.js(background).await?;
        page.js("delete document.documentElement.dataset.theme").await?;
        assert_ne!(page.js(background).await?, dark);

        page.type_into("#motion-feed_mm_s", "50").await?;
        let changes = [aluminium, ("motion.feed_mm_s", json!(50))];
        answers(page, &run(&changes)).await?;
        assert_eq!(page.js("return localStorage.length").await?, 0, "nothing is stored");
        page.type_into("#motion-feed_mm_s", "-1").await?;
        page.wait_for("document.querySelector('#alert').textContent.includes('0.001 to 10000')", 20.0)
            .await?;
        page.type_into("#motion-feed_mm_s", "50").await?;
        answers(page, &run(&changes)).await?;

        // The link to the whole page takes the inputs along.
        page.wait_for("document.getElementById('open').hash.startsWith('#job=2.')", 10.0).await?;
        let link = page.js("return document.getElementById('open').hash").await?;
        let link = link.as_str().unwrap_or_default();
        page.goto(&format!("index.html{link}")).await?;
        crate::shows(page, &run(&changes)).await?;
        // And in the other direction.
        page.goto(&format!("embed.html{link}&inputs=none&charts=none")).await?;
        answers(page, &run(&changes)).await?;
        assert_eq!(listed(page, "#form .field, figure", "id").await?, json!([]));
        Ok(())
    })
}

#[test]
fn a_frame_shows_scene_budget_and_units_if_asked_to() -> Result {
    visit("/embed.html#show=budget+scene&units=inch&inputs=none&charts=none", DESKTOP, async |page| {
        let report = run(&[]);
        answers(page, &report).await?;
        page.wait_for("document.querySelector('#scene canvas').width > 300", 20.0).await?;
        let summary = report.summary();
        assert_eq!(page.text("#budget-sentence").await?, summary.budget.sentence);
        let cells = listed(page, "#figures td", "textContent").await?;
        let first = cells[0].as_str().unwrap_or_default().parse::<f64>()?;
        assert!((first - summary.before_mm.both.mean / 25.4).abs() <= 0.5e-6, "{first}");
        assert_eq!(listed(page, "[data-unit=length]", "textContent").await?, json!(["in", "in", "in", "in"]));
        assert_eq!(page.js("return localStorage.length").await?, 0, "nothing is stored");
        // Feeds as a machinist reads them: 100 mm/s.
        page.goto("embed.html").await?;
        page.goto("embed.html#units=inch+per-minute&inputs=motion.feed_mm_s&charts=forces").await?;
        answers(page, &report).await?;
        let feed = page.value("#motion-feed_mm_s").await?.parse::<f64>()?;
        assert!((feed - 100.0 / 25.4 * 60.0).abs() < 1e-3, "{feed}");
        assert!(page.text("#form .field").await?.contains("in/min"));
        let charts = listed(page, "#panel-embed figure", "id").await?;
        assert!(charts.as_array().is_some_and(|charts| charts.len() > 1), "{charts}");
        page.goto("embed.html").await?;
        answers(page, &report).await?;
        assert_eq!(listed(page, "#scene, #budget", "hidden").await?, json!([true, true]));
        assert_eq!(listed(page, "[data-unit=length]", "textContent").await?, json!(["mm", "mm", "mm", "mm"]));
        Ok(())
    })
}

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn the_room_of_the_budget_is_there_before_the_first_result() -> Result {
    let watch = "window.seen = []; addEventListener('DOMContentLoaded', () => {
        const budget = document.querySelector('.budget');
        const rows = () => document.querySelectorAll('#budget-table tbody tr').length;
        const look = () => budget.offsetHeight && window.seen.push([rows(), budget.offsetHeight]);
        new ResizeObserver(look).observe(budget);
    });";
    // From the other page: only a new document runs the script.
    for (before, address) in
        [("/", "/embed.html#show=budget&inputs=none&charts=none"), ("/embed.html", "/#view=budget")]
    {
        visit(before, DESKTOP, async |page| {
            page.devtools("Page.addScriptToEvaluateOnNewDocument", json!({ "source": watch })).await?;
            page.goto(address).await?;
            page.wait_for("document.querySelectorAll('#budget-table tbody tr').length > 8", 30.0).await?;
            current(page).await?;
            page.js("return new Promise(done => setTimeout(done, 300))").await?;
            let seen: Vec<(usize, u64)> = serde_json::from_value(page.js("return window.seen").await?)?;
            let height = page.js("return document.querySelector('.budget').offsetHeight").await?;
            let height = height.as_u64().unwrap();
            assert_eq!(seen[0].0, 0, "it is seen before the first result");
            assert!(height > 100 && seen.iter().all(|each| each.1 == height), "{address}: {seen:?}");
            // Bars, table and the note on how the parts are counted are the same on both pages.
            let parts = listed(page, ".budget > *, .budget details > *", "localName").await?;
            let parts: Vec<String> = serde_json::from_value(parts)?;
            assert_eq!(parts[1..], ["p", "p", "div", "p", "div", "details", "summary", "table", "p"]);
            Ok(())
        })?;
    }
    Ok(())
}

#[test]
fn what_cannot_be_shown_is_said() -> Result {
    visit("/embed.html#preset=unobtainium", DESKTOP, async |page| {
        let wrong = [
            ("preset=unobtainium", "preset \"unobtainium\", which is not one of staubli-rx90"),
            ("theme=pink", "theme \"pink\", which is not one of auto, light, dark"),
            ("inputs=motion+colour", "inputs \"colour\", which is not one of none, robot"),
            ("show=pie", "show \"pie\", which is not one of none, scene, budget"),
            ("units=inch+furlong", "units \"furlong\", which is not one of mm, inch, N, lbf, per-second"),
            ("charts=pie", "charts \"pie\", which is not one of none, overview, before-after"),
            ("job=1.AAAA", "The link could not be opened"),
            ("job={\"version\":1,\"motion\":{\"feed\":1}}", "feed"),
            ("job={", "JSON"),
        ];
        for (asked, reason) in wrong {
            page.goto("embed.html").await?;
            page.goto(&format!("embed.html#{asked}")).await?;
            let said = format!(
                "document.querySelector('#alert').textContent.includes({})",
                serde_json::to_string(reason)?
            );
            page.wait_for(&said, 20.0).await.map_err(|error| format!("{asked}: {error}"))?;
            let state = page.js("return document.querySelector('#results').dataset.state").await?;
            assert_eq!(state, "stale", "{asked}");
        }
        Ok(())
    })
}

/// The document in the frame of the element that `css` finds, as a JavaScript expression.
fn inside(css: &str) -> String {
    format!("document.querySelector('{css}').shadowRoot.querySelector('iframe').contentDocument")
}

/// Waits until the frame of that element shows this report.
async fn frame_answers(page: &Page, css: &str, report: &Report) -> Result {
    page.js(&format!("document.querySelector('{css}').scrollIntoView()")).await?;
    let (inside, fingerprint) = (inside(css), report.fingerprint());
    let shown = format!(
        "{inside}.getElementById('fingerprint').textContent === '{fingerprint}' && \
         {inside}.getElementById('results').dataset.state === 'current'"
    );
    page.wait_for(&shown, 40.0).await
}

/// Waits until the frame of that element is as high as its content.
async fn fits(page: &Page, css: &str) -> Result {
    let inside = inside(css);
    let fits = format!(
        "Math.abs({inside}.defaultView.frameElement.getBoundingClientRect().height - {inside}.body.getBoundingClientRect().height) <= 1"
    );
    page.wait_for(&fits, 20.0).await
}

#[test]
fn a_page_of_rustdoc_holds_the_calculator() -> Result {
    let address = format!("{}rustdoc/armill/index.html", setting("ARMILL_DOCS_URL")?);
    visit(&address, DESKTOP, async |page| {
        let css = "armill-calculator";
        frame_answers(page, css, &run(&[])).await?;
        let inside = inside(css);
        page.wait_for(&format!("{inside}.querySelector('svg .series')"), 20.0).await?;
        fits(page, css).await?;
        // It computes there.
        page.js(&format!(
            "const feed = {inside}.getElementById('motion-feed_mm_s'); feed.value = '60'; \
             feed.dispatchEvent(new Event('input', {{ bubbles: true }}))"
        ))
        .await?;
        frame_answers(page, css, &run(&[("motion.feed_mm_s", json!(60))])).await?;
        // The height follows the content, also when it shrinks.
        let height = format!("{inside}.defaultView.frameElement.getBoundingClientRect().height");
        let high = page.js(&format!("return {height}")).await?.as_f64().unwrap();
        page.js(&format!("document.querySelector('{css}').setAttribute('inputs', 'none')")).await?;
        page.wait_for(&format!("{height} < {high} - 100"), 20.0).await?;
        frame_answers(page, css, &run(&[])).await?;
        fits(page, css).await?;

        // Only messages from our own frame count, and only valid ones.
        let before = page.js(&format!("return {height}")).await?;
        for (source, origin, data) in [
            ("window", "location.origin", "{ type: 'armill-height', height: 777 }"),
            ("frame", "'https://armill.invalid'", "{ type: 'armill-height', height: 777 }"),
            ("frame", "location.origin", "{ type: 'height', height: 777 }"),
            ("frame", "location.origin", "{ type: 'armill-height', height: -5 }"),
            ("frame", "location.origin", "{ type: 'armill-height', height: 1e9 }"),
            ("frame", "location.origin", "{ type: 'armill-height', height: '777' }"),
            ("frame", "location.origin", "null"),
        ] {
            let send = format!(
                "const frame = {inside}.defaultView; dispatchEvent(new MessageEvent('message', \
                 {{ source: {source}, origin: {origin}, data: {data} }}))"
            );
            page.js(&send).await?;
            assert_eq!(page.js(&format!("return {height}")).await?, before, "{source} {origin} {data}");
        }
        page.js(&format!(
            "const frame = {inside}.defaultView; dispatchEvent(new MessageEvent('message', \
             {{ source: frame, origin: location.origin, data: {{ type: 'armill-height', \
             height: 1776.5 }} }}))"
        ))
        .await?;
        assert_eq!(page.js(&format!("return {height}")).await?, 1777.0, "a sound message counts");

        // Other attributes, another job, and no new entry in the reader's history.
        let steps = page.js("return history.length").await?;
        page.js(&format!(
            "document.querySelector('{css}').setAttribute('job', JSON.stringify({{ version: 1, \
             motion: {{ feed_mm_s: 40 }} }}))"
        ))
        .await?;
        frame_answers(page, css, &run(&[("motion.feed_mm_s", json!(40))])).await?;
        assert_eq!(page.js("return history.length").await?, steps);
        page.expect_error("404");
        page.js(&format!("document.querySelector('{css}').setAttribute('job', 'missing.json')")).await?;
        page.wait_for(
            &format!("document.querySelector('{css}').shadowRoot.textContent.includes('404')"),
            10.0,
        )
        .await
    })
}

#[test]
fn a_frame_says_what_stock_its_cut_follows() -> Result {
    visit("/embed.html#preset=face&inputs=cutting&charts=forces", DESKTOP, async |page| {
        let mut face = opened_example("face.nc");
        face.retain(|(path, _)| *path != "shaper" && !path.starts_with("cutting."));
        let report = run(&face);
        answers(page, &report).await?;
        let stock = report.summary().cut.stock.ok_or("no stock")?;
        assert_eq!(page.text("#stock").await?, format!("Engagement from the stock: {stock}."));
        page.wait_for("document.querySelector('#chart-engagement svg .series')", 30.0).await
    })
}

#[test]
fn a_page_of_mdbook_holds_calculators() -> Result {
    let address = format!("{}book/embed.html", setting("ARMILL_DOCS_URL")?);
    visit(&address, DESKTOP, async |page| {
        frame_answers(page, "#default", &run(&[])).await?;
        fits(page, "#default").await?;
        let slot = include_str!("../../docs/slot.json");
        frame_answers(page, "#file", &armill::run_json(slot, &mut armill::Progress::none())?).await?;
        let mut pocket = opened_example("pocket.nc");
        pocket.retain(|(path, _)| *path != "shaper" && !path.starts_with("cutting."));
        pocket.push(("material", json!({"preset": "al-7075-t6"})));
        let pocket = run(&pocket);
        frame_answers(page, "#preset", &pocket).await?;
        let height =
            format!("return {}.defaultView.frameElement.getBoundingClientRect().height", inside("#preset"));
        assert_eq!(page.js(&height).await?, 620.0);
        Ok(())
    })
}
