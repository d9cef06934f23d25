//! The view Identify in a real browser: measured loads and responses, typed, opened, invalid, put
//! into the job and undone.

use crate::browser::{DESKTOP, PHONE, Page, Result, THESIS, visit};
use crate::current;
use armill::identify::{Convention, measurement, response, stiffness};
use armill::{Job, Report};
use serde_json::Value;

const LOADS: &str = include_str!("../../web/examples/identify-fanuc-r2000ic.csv");
const ROBOT: &str = include_str!("../../web/examples/identify-fanuc-r2000ic.json");
const RESPONSE: &str = include_str!("../../web/examples/identify-response.csv");

async fn open(page: &Page) -> Result {
    current(page).await?;
    page.click("#tab-identify").await
}

/// Clicks an element that may be far down: scrolled into view at once, because the page itself
/// scrolls smoothly.
async fn click(page: &Page, css: &str) -> Result {
    page.js(&format!(
        "document.querySelector('{css}').scrollIntoView({{ block: 'center', behavior: 'instant' }})"
    ))
    .await?;
    page.click(css).await
}

/// The page's current job.
async fn job(page: &Page) -> Result<Value> {
    click(page, "#download-job").await?;
    Ok(serde_json::from_str(&page.downloaded("armill-job.json").await?)?)
}

/// Sets a textarea's text as a paste does: at once.
async fn paste(page: &Page, css: &str, text: &str) -> Result {
    let text = serde_json::to_string(text)?;
    page.js(&format!(
        "const area = document.querySelector('{css}'); area.value = {text}; area.dispatchEvent(new Event('input', {{ bubbles: true }}))"
    ))
    .await
    .map(|_| ())
}

#[test]
fn the_measured_example_becomes_the_job_and_undo_takes_it_back() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        open(page).await?;
        click(page, "#identify-loads-example").await?;
        page.wait_for("document.querySelectorAll('#identified tbody tr').length === 6", 30.0).await?;
        page.wait_for("document.querySelector('#chart-stiffness svg.plot')", 10.0).await?;
        page.screenshot("identify-stiffness.png").await?;
        let robot = armill::setup::robot(&Job::from_json(ROBOT)?)?;
        let native = stiffness::fit(&robot, &measurement::read(LOADS, Convention::CoupledJ3)?.rows)?;
        let explained = format!("explain {:.1} %", 100.0 * native.explained);
        assert!(page.text("#identify .found").await?.contains(&explained));
        let before = page.js("return document.getElementById('fingerprint').textContent").await?;

        click(page, "#use-compliance").await?;
        page.wait_for(
            "document.querySelector('#results').dataset.state === 'computing' || \
             document.querySelector('#notice p')",
            10.0,
        )
        .await?;
        current(page).await?;
        let taken = job(page).await?;
        let compliance = &taken["robot"]["joint_compliance_rad_per_nm"];
        for (i, ours) in native.compliance().into_iter().enumerate() {
            assert!((compliance[i].as_f64().unwrap() / ours - 1.0).abs() < 1e-5, "{compliance}");
        }
        assert_eq!(taken["robot"]["name"], "FANUC R-2000iC, compliance identified from 43 rows");
        let covariance = native.covariance.ok_or("no covariance")?;
        let handed = &taken["uncertainty"]["compliance_covariance"];
        for (i, row) in covariance.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                assert!((handed[i][j].as_f64().unwrap() / value - 1.0).abs() < 1e-9, "{handed}");
            }
        }
        let report: Report = armill::run_json(&taken.to_string(), &mut armill::Progress::none())?;
        let fingerprint = report.fingerprint();
        page.wait_for(
            &format!("document.getElementById('fingerprint').textContent === '{fingerprint}'"),
            30.0,
        )
        .await?;
        assert_eq!(crate::text(page, "expected").await?, report.how_sure().sentence);

        // With another arm it is not that arm's covariance.
        page.js("const arm = document.getElementById('robot-preset'); arm.value = 'kuka-kr-210-2'; \
             arm.dispatchEvent(new Event('change', { bubbles: true }))")
            .await?;
        page.wait_for("!document.getElementById('expected').textContent.includes('covariance')", 20.0)
            .await?;
        current(page).await?;
        click(page, "#undo").await?;
        click(page, "#undo").await?;
        current(page).await?;
        page.wait_for(&format!("document.getElementById('fingerprint').textContent === {before}"), 30.0).await
    })
}

#[test]
fn a_response_becomes_the_shaper() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        open(page).await?;
        click(page, "#identify-response-example").await?;
        page.wait_for("document.querySelector('#chart-response svg.plot')", 30.0).await?;
        click(page, "#use-mode").await?;
        current(page).await?;
        let shaper = &job(page).await?["shaper"];
        let native = response::mode(&response::Signal::read(RESPONSE)?, None)?;
        assert!(
            (shaper["frequency_rad_s"].as_f64().unwrap() / native.frequency.value - 1.0).abs() < 1e-5,
            "{shaper}"
        );
        assert!((shaper["damping"].as_f64().unwrap() / native.damping.value - 1.0).abs() < 1e-5, "{shaper}");
        assert_eq!(shaper["kind"], "zvd");
        // The example was made with 18 rad/s and 0.1.
        assert!((native.frequency.value - 18.0).abs() <= native.frequency.half, "{native:?}");
        assert!((native.damping.value - 0.1).abs() <= native.damping.half, "{native:?}");

        // A later start gives another window.
        page.type_into("#identify-from", "0.5\n").await?;
        page.wait_for("[...document.querySelectorAll('#identify .found')].some(p => p.textContent.includes('from 0.500 s'))", 10.0).await
    })
}

#[test]
fn what_is_wrong_is_said_with_its_line_and_the_last_result_stays() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        open(page).await?;
        click(page, "#identify-loads-example").await?;
        page.wait_for("document.querySelectorAll('#identified tbody tr').length === 6", 30.0).await?;
        let broken = LOADS.replace("-0.000538", "half");
        let line = 1 + broken.lines().position(|line| line.contains("half")).unwrap();
        paste(page, "#identify-loads", &broken).await?;
        page.wait_for("document.querySelector('#identify .wrong p')", 10.0).await?;
        let said = page.text("#identify .wrong p").await?;
        assert!(said.starts_with(&format!("Line {line}, column ")) && said.contains("a number"), "{said}");
        assert_eq!(page.js("return document.querySelector('#identify .result').hidden").await?, false);
        click(page, "#identify .wrong button").await?;
        let chosen = page
            .js("const a = document.getElementById('identify-loads'); \
             return a.value.slice(a.selectionStart, a.selectionEnd)")
            .await?;
        assert!(chosen.as_str().unwrap().contains("half"), "{chosen}");

        // The job's own robot gives a result too, with a remark that these postures are not its
        // own.
        paste(page, "#identify-loads", LOADS).await?;
        page.wait_for("!document.querySelector('#identify .wrong p')", 10.0).await?;
        click(page, "#identify .whose button").await?;
        page.wait_for("document.querySelector('#use-compliance')?.textContent.startsWith('Use these')", 10.0)
            .await?;
        paste(page, "#identify-loads", "").await?;
        page.wait_for("document.querySelector('#identify .result').hidden", 10.0).await
    })
}

#[test]
fn it_fits_a_phone() -> Result {
    visit(THESIS, PHONE, async |page| {
        open(page).await?;
        click(page, "#identify-loads-example").await?;
        page.wait_for("document.querySelector('#chart-stiffness svg.plot')", 30.0).await?;
        click(page, "#identify-response-example").await?;
        page.wait_for(
            "document.querySelector('#chart-response svg.plot') && \
             document.querySelector('#chart-stiffness svg.plot')",
            30.0,
        )
        .await?;
        page.screenshot("identify-phone.png").await?;
        assert_eq!(page.wider().await?, Value::Null);
        Ok(())
    })
}
