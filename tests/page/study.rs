//! Questions about the job: asked by few clicks, answered as the script answers them.

use crate::browser::{DESKTOP, PHONE, Page, Result, THESIS, visit};
use crate::common::job_text;
use crate::{current, narrow, number, text};
use armill::study::EveryLoop;
use armill::study::{
    ErrorMeasure, EveryRobot, LargestQuestion, PartPlace, Variation, choices, sweep, tornado,
};
use armill::{Job, Progress};
use serde_json::{Value, json};

/// The thesis's job at few samples, as the page has it.
const COARSE: &str = "0.02";

async fn coarse(page: &Page) -> Result<Job> {
    current(page).await?;
    page.js("document.getElementById('group-motion').open = true").await?;
    page.type_into("#motion-sample_time_s", COARSE).await?;
    current(page).await?;
    Ok(Job::from_json(&job_text(&[("motion.sample_time_s", json!(COARSE.parse::<f64>()?))]))?)
}

/// Waits for an answer that begins so.
async fn answered(page: &Page, begins: &str) -> Result<String> {
    let answer = format!("document.querySelector('#study-answer').textContent.startsWith({})", json!(begins));
    page.wait_for(&answer, 120.0).await?;
    page.wait_for("document.querySelector('#study-cancel').hidden", 10.0).await?;
    text(page, "study-answer").await
}

/// The numbers of a column of the answer's table, null where there is none, beside the head of their row.
async fn column(page: &Page, number: usize) -> Result<Vec<(String, Option<f64>)>> {
    let rows = page
        .js(&format!(
            "return [...document.querySelectorAll('.answer-table tbody tr')].map(row => [row.cells[0].textContent, \
             row.cells[{number}].dataset.value ?? null])"
        ))
        .await?;
    let rows: Vec<(String, Option<String>)> = serde_json::from_value(rows)?;
    // As text: a number of JSON may lose its last bit on the way.
    rows.into_iter().map(|(head, text)| Ok((head, text.map(|text| text.parse()).transpose()?))).collect()
}

/// How deep may I go? Two clicks and a choice.
#[test]
fn the_largest_depth_without_compensation_is_three_clicks_away() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        coarse(page).await?;
        page.js("document.getElementById('group-compensation').open = true").await?;
        page.type_into("#compensation-tolerance_mm", "0.2").await?;
        current(page).await?;
        page.click("#tab-compare").await?;
        page.click("[data-question=largest]").await?;
        page.choose("#study-measure", "uncompensated").await?;
        // What cannot run is said before what it would achieve.
        let said = answered(page, "The arm cannot run this at any of these values: joint 1").await?;
        assert!(said.contains("If it could: Largest axial depth: "), "{said}");
        let ends = page
            .js("return ['from', 'to'].map(end => Number(document.querySelector(`#study-first-${end}`).value))")
            .await?;
        let job = Job::from_json(&job_text(&[
            ("motion.sample_time_s", json!(COARSE.parse::<f64>()?)),
            ("compensation.tolerance_mm", json!(0.2)),
        ]))?;
        let question = format!("cutting.axial_depth_mm={}:{}", ends[0], ends[1]);
        let native = LargestQuestion::read(&question, ErrorMeasure::Uncompensated)?.answer(&job)?;
        assert_eq!(
            number(page, "study-answer").await?.to_bits(),
            native.largest.unwrap().to_bits(),
            "{said}"
        );
        // The curve, its present value and the tolerance are drawn.
        page.wait_for("document.querySelectorAll('.answer-curve svg [data-key]').length >= 5", 10.0).await?;
        // It is used by one click, and undone by another.
        let depth = "Number(document.querySelector('#cutting-axial_depth_mm').value)";
        let before = Job::default().cutting.axial_depth_mm;
        page.click("#study-use").await?;
        page.wait_for(&format!("{depth} < {before} && {depth} > 0"), 5.0).await?;
        page.click("#undo").await?;
        page.wait_for(&format!("{depth} === {before}"), 5.0).await?;
        // The same question beside the field.
        page.click("#tab-overview").await?;
        page.js("document.getElementById('group-cutting').open = true").await?;
        page.click(".limit[aria-label^='Largest axial depth']").await?;
        page.wait_for("!document.querySelector('#panel-compare').hidden", 5.0).await
    })
}

/// Which robot? Two clicks; the rows are the script's, bit for bit.
#[test]
fn robots_are_compared_by_two_clicks() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        let job = coarse(page).await?;
        page.click("#tab-compare").await?;
        page.click("[data-question=robots]").await?;
        answered(page, "").await?;
        page.wait_for("document.querySelectorAll('.answer-table tbody tr').length > 20", 120.0).await?;
        let rows = column(page, 5).await?;
        let every = EveryRobot::new(&job, PartPlace::Kept)?;
        assert_eq!(rows.len(), every.count());
        for index in (0..every.count()).step_by(16) {
            let native = every.row(index);
            let (_, shown) = rows.iter().find(|(name, _)| *name == native.name).ok_or("no such robot")?;
            assert_eq!(shown.map(f64::to_bits), native.outcome.p95_mm.map(f64::to_bits), "{}", native.name);
        }
        // The least error comes first, and guesses say so.
        let able =
            (0..every.count()).map(|index| every.row(index).outcome).filter(|row| row.cannot_run.is_none());
        let mut able: Vec<f64> = able.filter_map(|row| row.p95_mm).collect();
        able.sort_by(f64::total_cmp);
        let shown: Vec<f64> = rows.iter().take(able.len()).filter_map(|(_, error)| *error).collect();
        assert_eq!(shown, able);
        let stiffness =
            page.js("return [...document.querySelectorAll('td.stiffness')].map(cell => cell.textContent)");
        let stiffness: Vec<String> = serde_json::from_value(stiffness.await?)?;
        assert!(stiffness.iter().any(|word| word == "guessed"));
        page.click(".answer-table [data-key=reach]").await?;
        let reach: Vec<f64> = column(page, 9).await?.into_iter().filter_map(|(_, reach)| reach).collect();
        assert!(
            reach.len() == every.count() && reach[..able.len()].windows(2).all(|pair| pair[0] <= pair[1])
        );
        Ok(())
    })
}

#[test]
fn a_link_asks_again_and_other_questions_are_the_script_s() -> Result {
    let range = "cutting.axial_depth_mm=1:5:5";
    visit(THESIS, PHONE, async |page| {
        page.js("document.querySelector('#inputs-toggle').click()").await?;
        let job = coarse(page).await?;
        page.goto("/gallery.html").await?;
        page.goto(&format!("/index.html#view=compare&ask=sweep~{range}")).await?;
        let said = answered(page, "The arm cannot run this").await?;
        assert!(said.contains("The least error to expect is at axial depth 1 mm: at most "), "{said}");
        let native = sweep(&job, &[Variation::read(range)?])?;
        let shown: Vec<Option<f64>> = column(page, 3).await?.into_iter().map(|(_, value)| value).collect();
        assert_eq!(shown, native.iter().map(|row| row.outcome.p95_mm).collect::<Vec<_>>());
        narrow(page, "an answer").await?;
        page.click("[data-question=tornado]").await?;
        page.wait_for(
            "/^Compliance|^Cutting/.test(document.querySelector('#study-answer').textContent)",
            60.0,
        )
        .await?;
        let bars = tornado(&armill::run(&job, &mut Progress::none())?).bars;
        let shown: Vec<Option<f64>> = column(page, 3).await?.into_iter().map(|(_, value)| value).collect();
        assert_eq!(shown, bars.iter().map(|bar| Some(bar.after_mm[1])).collect::<Vec<_>>());
        page.click("[data-question=measures]").await?;
        answered(page, "M").await?;
        page.click("[data-question=loops]").await?;
        page.wait_for("document.querySelectorAll('.answer-table tbody tr').length === 12", 120.0).await?;
        page.wait_for("document.querySelector('#study-cancel').hidden", 10.0).await?;
        let said = answered(page, "The arm cannot run this").await?;
        assert!(said.contains("With a sensor as well, at best"), "{said}");
        let every = EveryLoop::new(&job)?;
        let native: Vec<_> =
            (0..every.count()).map(|index| every.row(index)).collect::<std::result::Result<_, _>>()?;
        let shown: Vec<Option<f64>> = column(page, 4).await?.into_iter().map(|(_, value)| value).collect();
        assert_eq!(
            shown,
            native.iter().map(|row| row.outcome.both.map(|error| error.p95)).collect::<Vec<_>>()
        );
        narrow(page, "loops").await?;
        page.click("[data-question=choices]").await?;
        page.wait_for("document.querySelectorAll('.answer-table tbody tr').length > 12", 120.0).await?;
        page.wait_for("document.querySelector('#study-cancel').hidden", 10.0).await?;
        let least = choices(&job)
            .into_iter()
            .filter(|row| row.outcome.cannot_run.is_none())
            .filter_map(|row| row.outcome.p95_mm)
            .fold(f64::INFINITY, f64::min);
        let best = page.js("return document.querySelectorAll('.answer-table .best').length").await?;
        assert_eq!(best, json!(u8::from(least.is_finite())));
        let first = column(page, 4).await?.into_iter().find_map(|(_, error)| error);
        assert!(!least.is_finite() || first == Some(least), "{first:?} and {least}");
        narrow(page, "choices").await
    })
}

/// A sensor among the inputs: the charts of the error say what it would bring.
#[test]
fn a_sensor_among_the_inputs_has_its_charts() -> Result {
    visit(&format!("{THESIS}&view=error"), DESKTOP, async |page| {
        coarse(page).await?;
        let shown = "[...document.querySelectorAll('#panel-error h3')].filter(head => head.checkVisibility())\
                     .map(head => head.textContent)";
        let delay = "What a loop leaves, by its dead time";
        let charts = page.js(&format!("return {shown}")).await?;
        assert!(!charts.to_string().contains(delay), "{charts}");
        page.js("document.getElementById('group-online').open = true").await?;
        page.choose("#online-measures", "position").await?;
        current(page).await?;
        page.wait_for(&format!("{shown}.includes({})", json!(delay)), 20.0).await?;
        let changes = [
            ("motion.sample_time_s", json!(COARSE.parse::<f64>()?)),
            ("online", json!({"measures": "position"})),
        ];
        let report = armill::run(&Job::from_json(&job_text(&changes))?, &mut Progress::none())?;
        let verdict = report.summary().online.map(|online| online.verdict).unwrap_or_default();
        let said = format!("document.getElementById('panel-error').textContent.includes({})", json!(verdict));
        page.wait_for(&said, 20.0).await?;
        narrow(page, "a sensor").await
    })
}

#[test]
fn an_answer_is_cancelled_and_a_wrong_range_is_said() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.click("#tab-compare").await?;
        page.click("[data-question=robots]").await?;
        page.click("#study-cancel").await?;
        page.wait_for("document.querySelector('#study-status').textContent === 'Cancelled.'", 10.0).await?;
        page.click("[data-question=sweep]").await?;
        page.type_into("#study-first-from", "9").await?;
        page.type_into("#study-first-to", "3").await?;
        let says = "document.querySelector('#study-status').textContent.includes('more than')";
        page.wait_for(says, 10.0).await?;
        page.type_into("#study-first-to", "12").await?;
        let value: Value = json!(answered(page, "The arm cannot run this").await?);
        assert!(value.as_str().is_some_and(|said| said.contains("axial depth")), "{value}");
        Ok(())
    })
}

/// Over the words of a choice, and over two things at once: drawn, filtered, saved.
#[test]
fn choices_and_pairs_are_drawn_and_filtered() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        let job = coarse(page).await?;
        page.click("#tab-compare").await?;
        page.click("[data-question=sweep]").await?;
        page.choose("#study-first-number", "shaper.kind").await?;
        page.wait_for("document.querySelectorAll('.answer-picture .series.known').length === 5", 60.0)
            .await?;
        let native = sweep(&job, &[Variation::read("shaper.kind=all")?])?;
        let shown: Vec<Option<f64>> = column(page, 3).await?.into_iter().map(|(_, value)| value).collect();
        assert_eq!(shown, native.iter().map(|row| row.outcome.p95_mm).collect::<Vec<_>>());
        let heads = page
            .js("return [...document.querySelectorAll('.answer-table tbody th')].map(th => th.textContent)");
        assert_eq!(heads.await?, json!(["none", "ZV", "ZVD", "ZVDD", "EI"]));
        page.choose("#study-second-number", "cutting.axial_depth_mm").await?;
        page.type_into("#study-second-from", "1").await?;
        page.type_into("#study-second-to", "4").await?;
        page.wait_for("document.querySelectorAll('.answer-picture .label text').length === 35", 120.0)
            .await?;
        page.wait_for("document.querySelector('#study-cancel').hidden", 60.0).await?;
        let pairs = [Variation::read("shaper.kind=all")?, Variation::read("cutting.axial_depth_mm=1:4:7")?];
        let native = sweep(&job, &pairs)?;
        let shown: Vec<Option<f64>> = column(page, 4).await?.into_iter().map(|(_, value)| value).collect();
        assert_eq!(shown, native.iter().map(|row| row.outcome.p95_mm).collect::<Vec<_>>());
        page.type_into("#study-filter", "ei").await?;
        page.wait_for("document.querySelectorAll('.answer-table tbody tr').length === 7", 5.0).await?;
        assert_eq!(page.text(".answer-filter output").await?, "7 of 35");
        page.click("#study-svg").await?;
        let saved = page.downloaded("armill-answer.svg").await?;
        assert!(saved.contains("ZVDD") && !saved.contains("class=") && !saved.contains("NaN"), "{saved}");
        // The number that is asked about for the tolerance is none of the choices.
        page.click("[data-question=largest]").await?;
        let offered =
            page.js("return [...document.querySelector('#study-first-number').options].map(o => o.value)");
        assert!(!offered.await?.as_array().is_some_and(|paths| paths.contains(&json!("shaper.kind"))));
        Ok(())
    })
}

/// What an embedded calculator cannot answer it does not offer.
#[test]
fn an_embedded_form_offers_no_questions() -> Result {
    visit("/embed.html#show=scene&inputs=motion", DESKTOP, async |page| {
        page.wait_for("document.querySelector('#motion-feed_mm_s')?.checkVisibility()", 30.0).await?;
        let offered = page
            .js("return [...document.querySelectorAll('.head .limit')].some(each => each.checkVisibility())");
        assert_eq!(offered.await?, false);
        Ok(())
    })
}
