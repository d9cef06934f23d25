//! A pinned result beside the next one: figures, inputs, curves.

use crate::browser::{DESKTOP, Page, Result, THESIS, visit};
use crate::chart::Chart;
use crate::common::run;
use crate::{current, shows};
use armill::chart::ChartOptions;
use serde_json::json;

#[test]
fn a_pinned_result_stands_beside_the_next() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.click("#pin").await?;
        page.type_into("#motion-feed_mm_s", "50").await?;
        let (a, b) = (run(&[]), run(&[("motion.feed_mm_s", json!(50))]));
        shows(page, &b).await?;
        let difference = async |id: &str| {
            let shown = page
                .js(&format!("return document.getElementById('{id}').closest('.number').querySelector('.versus').dataset.value"))
                .await?;
            Ok::<f64, Box<dyn std::error::Error>>(shown.as_str().ok_or("no difference")?.parse()?)
        };
        let (before, after) = (a.summary(), b.summary());
        assert_eq!(difference("before-max").await?, after.before_mm.both.max - before.before_mm.both.max);
        assert_eq!(difference("expected-p50").await?, after.expected_mm.p50 - before.expected_mm.p50);
        assert_eq!(difference("duration").await?, after.duration_s - before.duration_s);
        let rows = page
            .js("return [...document.querySelectorAll('#compare tbody tr')].map(row => \
             [...row.cells].map(cell => cell.textContent))")
            .await?;
        assert_eq!(rows, json!([["Feed", "100 mm/s", "50 mm/s"]]));
        page.click("#back-to-a").await?;
        shows(page, &a).await?;
        assert_eq!(difference("before-max").await?, 0.0);
        page.click("#unpin").await?;
        assert_eq!(page.js("return document.querySelector('.versus') === null && document.querySelector('#compare').hidden").await?, true);
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
fn a_pinned_result_is_drawn_with_the_next_and_stays_over_a_reload() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        Chart::open(page, "overview", "before-after").await?;
        page.click("#pin").await?;
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
            let whole = ChartOptions::sized(width, height);
            let draw = |report, options: &ChartOptions| armill::chart::chart(report, "before-after", options);
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
        page.click("#unpin").await?;
        page.wait_for("!document.querySelector('#chart-before-after .pinned .series')", 20.0).await?;
        page.reload().await?;
        shows(page, &b).await?;
        assert_eq!(page.js("return document.querySelector('#compare').hidden").await?, true);
        Ok(())
    })
}
