//! A pinned result beside the next one: figures, inputs, curves.

use crate::browser::{DESKTOP, Page, Result, THESIS, visit};
use crate::chart::Chart;
use crate::common::{self, run};
use crate::{current, shows, unfold};
use armill::chart::{ChartOptions, Over, Scaling};
use serde_json::{Value, json};

/// What the cells of a row of figures show of a difference, to the last digit; null where there is none.
async fn differences(page: &Page, row: &str) -> Result<Vec<Option<f64>>> {
    let found = page
        .js(&format!(
            "return [...document.querySelectorAll('#compare-{row} td')].map(cell => \
             cell.dataset.value === undefined ? null : Number(cell.dataset.value))"
        ))
        .await?;
    Ok(serde_json::from_value(found)?)
}

/// The inputs that differ: a label, then a text for each result.
async fn inputs(page: &Page) -> Result<Value> {
    page.js("return [...document.querySelectorAll('#compare tbody:last-of-type tr')].map(row => \
             [...row.cells].map(cell => cell.textContent))")
        .await
}

async fn title(page: &Page) -> Result<String> {
    Ok(serde_json::from_value(page.js("return document.getElementById('compare-title').textContent").await?)?)
}

#[test]
fn a_pinned_result_stands_beside_the_next() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.click("#pin").await?;
        page.click("#tab-compare").await?;
        page.type_into("#motion-feed_mm_s", "50").await?;
        let (a, b) = (run(&[]), run(&[("motion.feed_mm_s", json!(50))]));
        shows(page, &b).await?;
        let (before, after) = (a.summary(), b.summary());
        for (row, difference) in [
            ("before-max", after.before_mm.both.max - before.before_mm.both.max),
            ("expected-p50", after.expected_mm.p50 - before.expected_mm.p50),
            ("expected-p95", after.expected_mm.p95 - before.expected_mm.p95),
            ("duration", after.duration_s - before.duration_s),
        ] {
            assert_eq!(differences(page, row).await?, [None, Some(difference)], "{row}");
        }
        assert_eq!(inputs(page).await?, json!([["Feed", "100 mm/s", "50 mm/s"]]));
        page.click("#back-to-a").await?;
        shows(page, &a).await?;
        assert_eq!(differences(page, "before-max").await?, [None, Some(0.0)]);
        assert_eq!(title(page).await?, "A is pinned. Change an input, and the next result stands beside it.");
        page.click("#unpin").await?;
        assert_eq!(page.js("return document.querySelector('#compare').hidden").await?, true);
        Ok(())
    })
}

#[test]
fn up_to_five_results_are_compared_with_a_chosen_one() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        unfold(page, "cutting").await?;
        let depths = [10.0, 9.0, 8.0, 7.0, 6.0];
        let reports = depths.map(|depth| run(&[("cutting.axial_depth_mm", json!(depth))]));
        for (depth, report) in depths.iter().zip(&reports) {
            page.type_into("#cutting-axial_depth_mm", &depth.to_string()).await?;
            shows(page, report).await?;
            page.click("#pin").await?;
        }
        page.click("#tab-compare").await?;
        page.click("#pin").await?;
        assert_eq!(title(page).await?, "E is this result already.");
        let p50 = |k: usize| reports[k].summary().expected_mm.p50;
        let from_a = |k: usize| (k > 0).then(|| p50(k) - p50(0));
        assert_eq!(
            differences(page, "expected-p50").await?,
            [from_a(0), from_a(1), from_a(2), from_a(3), from_a(4), from_a(4)]
        );
        page.js("document.getElementById('reference-c').click()").await?;
        assert_eq!(differences(page, "expected-p50").await?[0], Some(p50(0) - p50(2)));
        assert_eq!(differences(page, "expected-p50").await?[2], None);
        // Said in words, and said only where it is so.
        let band = |k: usize| (p50(k), reports[k].summary().expected_mm.p95);
        let overlap = band(4).0 <= band(2).1 && band(2).0 <= band(4).1;
        assert_eq!(title(page).await?.contains("bands overlap"), overlap, "{:?} {:?}", band(4), band(2));
        // All of them are drawn, each with its letter at the curve and in the legend in one colour.
        let chart = Chart::open(page, "overview", "before-after").await?;
        chart.wait_for("chart.querySelectorAll('.legend .pinned').length === 4").await?;
        chart.wait_for("chart.querySelectorAll('svg.plot .pinned .series').length === 12").await?;
        let colours = chart
            .js("return [...'abcd'].map(id => { \
                 const colour = css => getComputedStyle(chart.querySelector(css)); \
                 const curve = colour(`svg.plot .pin-${id} .series polyline`).stroke; \
                 return [curve === colour(`.legend .pin-${id} path`).stroke, \
                         curve === colour(`svg.plot .pin-${id} .letter`).fill, curve]; })")
            .await?;
        let colours: Vec<(bool, bool, String)> = serde_json::from_value(colours)?;
        assert!(colours.iter().all(|(legend, letter, _)| *legend && *letter), "{colours:?}");
        let distinct: std::collections::BTreeSet<_> = colours.iter().map(|(_, _, colour)| colour).collect();
        assert_eq!(distinct.len(), 4);
        // A name is kept over a reload, a letter that is free is given again.
        page.js("const name = document.getElementById('name-b'); name.value = 'nine deep'; \
                 name.dispatchEvent(new Event('change', { bubbles: true }))")
            .await?;
        page.click("#tab-compare").await?;
        page.click("#unpin-a").await?;
        page.reload().await?;
        shows(page, &reports[4]).await?;
        page.wait_for("document.querySelectorAll('#compare thead [data-letter]').length === 4", 20.0).await?;
        assert_eq!(page.js("return document.getElementById('name-b').value").await?, "nine deep");
        assert_eq!(page.js("return document.getElementById('pin').textContent").await?, "Pin as A");
        assert_eq!(page.js("return document.getElementById('reference-c').checked").await?, true);
        page.click("#back-to-b").await?;
        shows(page, &reports[1]).await
    })
}

#[test]
fn what_changed_is_said_row_by_row() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        // Two results that were pinned in this tab, whose third joint differs.
        let arm = |third: f64| json!([1e-6, 2e-6, third, 4e-6, 5e-6, 6e-6]);
        let text = |third| common::job_text(&[("robot.joint_compliance_rad_per_nm", arm(third))]);
        let pin = |letter, third| json!({ "letter": letter, "text": text(third), "name": "" });
        let kept = json!({ "reference": null, "pins": [pin("A", 1.2e-6), pin("B", 2.4e-6)] });
        page.js(&format!("sessionStorage.setItem('armill-pins', {})", json!(kept.to_string()))).await?;
        page.reload().await?;
        current(page).await?;
        page.wait_for("document.querySelectorAll('#compare thead [data-letter]').length === 2", 20.0).await?;
        let found = inputs(page).await?;
        let third = json!(["Joint compliance, row 3", "1.2e-6", "2.4e-6"]);
        assert_eq!(found[2].as_array().unwrap()[..3], third.as_array().unwrap()[..], "{found}");
        let marked = page
            .js("return [...document.querySelectorAll('#compare tbody:last-of-type tr')].map(row => \
                 row.cells[2].className)")
            .await?;
        assert_eq!(marked, json!(["", "", "differs", "", "", ""]), "against A");
        // What cannot be told from nothing has no percentage.
        let words = "return document.getElementById('compare').textContent";
        let words: String = serde_json::from_value(page.js(words).await?)?;
        assert!(!words.contains("\u{2212}<") && !words.contains("+<"), "{words}");
        Ok(())
    })
}

/// The curves in the first chart, and the attribute that holds a curve's course.
const LINES: &str =
    "[...document.querySelectorAll('#chart-before-after svg.plot .series :is(path, polyline)')]";
const OUTLINE: &str = "line.getAttribute('d') ?? line.getAttribute('points')";

/// The outlines of the pinned result's curves in the first chart, or of the shown one's.
async fn outlines(page: &Page, pinned: bool) -> Result<Vec<String>> {
    let found = page
        .js(&format!("return {LINES}.filter(line => Boolean(line.closest('.pinned')) === {pinned}).map(line => {OUTLINE})"))
        .await?;
    Ok(serde_json::from_value(found)?)
}

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn a_pinned_result_is_drawn_with_the_next_and_stays_over_a_reload() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        Chart::open(page, "overview", "before-after").await?;
        page.click("#pin").await?;
        page.click("#tab-compare").await?;
        assert_eq!(outlines(page, true).await?.len(), 0, "A beside itself");
        page.type_into("#motion-feed_mm_s", "60").await?;
        let (a, b) = (run(&[]), run(&[("motion.feed_mm_s", json!(60))]));
        for reloaded in [false, true] {
            if reloaded {
                page.reload().await?;
            }
            shows(page, &b).await?;
            page.wait_for("document.querySelector('#chart-before-after .pinned .series')", 20.0).await?;
            // Both on axes that fit both, as the native core draws them.
            let size = page
                .js("const plot = document.querySelector('#chart-before-after svg.plot'); \
                     return [Number(plot.getAttribute('width')), Number(plot.getAttribute('height'))]")
                .await?;
            let [width, height]: [f64; 2] = serde_json::from_value(size)?;
            // Of different durations they line up by length; the scale is the shown one's.
            let by_length = ChartOptions { over: Over::Length, ..ChartOptions::sized(width, height) };
            let auto = ChartOptions { scaling: Some(Scaling::Auto), ..by_length.clone() };
            let draw = |report, options: &ChartOptions| armill::chart::chart(report, "before-after", options);
            let log = draw(&b, &auto)?.y.log;
            let whole =
                ChartOptions { scaling: Some(if log { Scaling::Log } else { Scaling::Linear }), ..by_length };
            let (first, second) = (draw(&a, &whole)?, draw(&b, &whole)?);
            let joined = |one: (f64, f64), other: (f64, f64)| Some((one.0.min(other.0), one.1.max(other.1)));
            let both = ChartOptions {
                x_range: joined(first.x.full, second.x.full),
                y_range: joined(first.y.full, second.y.full),
                ..whole
            };
            let (of_a, of_b) = (draw(&a, &both)?.svg, draw(&b, &both)?.svg);
            // Figures are shown before charts, which may still belong to a half-typed number.
            let drawn = format!(
                "((a, b) => {LINES}.length >= 4 && {LINES}.every(line => (line.closest('.pinned') ? a : b).includes({OUTLINE})))({}, {})",
                json!(of_a),
                json!(of_b),
            );
            page.wait_for(&drawn, 20.0).await?;
            let (pinned, own) = (outlines(page, true).await?, outlines(page, false).await?);
            assert!(pinned.len() >= 2 && own.len() >= 2, "{} and {} curves", pinned.len(), own.len());
        }
        page.js("scrollTo({ top: 0, behavior: 'instant' })").await?;
        page.click("#tab-compare").await?;
        page.click("#unpin").await?;
        page.wait_for("!document.querySelector('#chart-before-after .pinned .series')", 20.0).await?;
        page.reload().await?;
        shows(page, &b).await?;
        assert_eq!(page.js("return document.querySelector('#compare').hidden").await?, true);
        Ok(())
    })
}
