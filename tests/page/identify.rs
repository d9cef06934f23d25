//! The views Measure and Evidence in a real browser: measured loads and responses, typed, opened, invalid, put
//! into the job and undone.

use crate::browser::{DESKTOP, PHONE, Page, Result, THESIS, visit};
use crate::{current, narrow};
use armill::evidence;
use armill::identify::{Convention, gear, measurement, response, stiffness};
use armill::{Job, Report};
use serde_json::Value;

const LOADS: &str = include_str!("../../web/examples/identify-fanuc-r2000ic.csv");
const ROBOT: &str = include_str!("../../web/examples/identify-fanuc-r2000ic.json");
const RESPONSE: &str = include_str!("../../web/examples/identify-response.csv");
const GEARS: [&str; 2] = [
    include_str!("../../web/examples/gear-kuka-kr300-a.csv"),
    include_str!("../../web/examples/gear-kuka-kr300-b.csv"),
];

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
        assert_eq!(
            page.js("return document.querySelector('[aria-labelledby=identify-stiffness] .result').hidden")
                .await?,
            false
        );
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
        click(page, "[aria-labelledby=identify-stiffness] .whose button").await?;
        page.wait_for("document.querySelector('#use-compliance')?.textContent.startsWith('Use these')", 10.0)
            .await?;
        paste(page, "#identify-loads", "").await?;
        page.wait_for("document.querySelector('[aria-labelledby=identify-stiffness] .result').hidden", 10.0)
            .await
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

/// A log of a measured pass: the factors that the core finds natively, one click into the job and back, and three files.
#[test]
fn a_measured_pass_teaches_factors_and_the_next_program() -> Result {
    use armill::export::superposed::{self, Interface};
    use armill::learn::{
        Commanded, LearnSummary, LearnedCorrection, LearningGain, Log, MeasuredPass, NextPass, PassOptions,
    };
    use armill::verification::Programs;
    use armill::{Job, Progress};
    visit(&format!("{THESIS}&view=identify"), DESKTOP, async |page| {
        current(page).await?;
        page.click("#learn-log-example").await?;
        page.wait_for("document.querySelector('#learned tbody tr')", 30.0).await?;
        let job = Job::from_json(include_str!("../../web/examples/learn-pass.json"))?;
        let log = Log::read(include_str!("../../web/examples/learn-pass.csv"))?;
        let report = armill::run(&job, &mut Progress::none())?;
        let commanded = Commanded { corrected: true, learned: vec![] };
        let options = PassOptions { commanded, frame: None, shift: None, corner: None };
        let measured = MeasuredPass::of(&report, &log, &options)?;
        let next = NextPass::of(&report, &measured, LearningGain::USUAL)?;
        let summary = LearnSummary::of(&report, None, &measured, Some((&next, LearningGain::USUAL)));
        let rows = page
            .js("return [...document.querySelectorAll('#learned tbody tr')].map(row => row.cells[1].textContent)")
            .await?;
        let shown: Vec<String> = serde_json::from_value(rows)?;
        assert_eq!(shown.len(), summary.factors.factors.len());
        for (shown, factor) in shown.iter().zip(&summary.factors.factors) {
            assert!((shown.parse::<f64>()? / factor.value - 1.0).abs() < 5e-3, "{shown} {}", factor.value);
        }
        let said = page.js("return document.querySelector('section.identify').innerText").await?.to_string();
        for words in &summary.unexplained {
            assert!(said.contains(words.as_str()), "{words}");
        }
        // Every file is what the core makes.
        click(page, "#learn-command").await?;
        assert_eq!(page.downloaded("armill-next-pass.csv").await?, next.table(&report));
        click(page, "#learn-save").await?;
        let kept = Commanded { corrected: true, learned: next.learned.clone() };
        let kept = serde_json::to_string(&LearnedCorrection::of(&report, &kept))?;
        assert_eq!(page.downloaded("armill-learned.json").await?, kept);
        let to_run = next.report(&report);
        click(page, "#learn-package").await?;
        let zip = page.downloaded_bytes("armill-next-pass.zip").await?;
        let zip = String::from_utf8_lossy(&zip);
        for file in &Programs::default().package(&to_run, None)?.files {
            assert!(zip.contains(&file.text), "{}", file.path);
        }
        for interface in Interface::ALL {
            click(page, &format!("#learn-{}", interface.id())).await?;
            let zip = page.downloaded_bytes(&format!("armill-next-pass-{}.zip", interface.id())).await?;
            let zip = String::from_utf8_lossy(&zip);
            for file in &superposed::package(&to_run, interface)? {
                assert!(zip.contains(&file.text), "{}", file.path);
            }
        }
        // A wrong delay is noticed.
        page.type_into("#learn-shift", "2\n").await?;
        let noticed =
            "document.querySelector('section.identify').innerText.includes('alignment looks wrong')";
        page.wait_for(noticed, 30.0).await?;
        page.type_into("#learn-shift", "\u{e003}\n").await?;
        page.wait_for(&format!("!({noticed})"), 30.0).await?;
        narrow(page, "a measured pass").await?;
        // Into the job with its band, and back.
        page.click("#use-factors").await?;
        current(page).await?;
        let known = "document.body.textContent.includes('arm and cut as a measured pass has them')";
        page.wait_for(known, 30.0).await?;
        page.click("#undo").await?;
        current(page).await?;
        page.wait_for(&format!("!({known})"), 30.0).await
    })
}

/// Means of five slots: the coefficients that the core fits natively, one click into the job.
#[test]
fn mean_forces_become_the_material() -> Result {
    use armill::learn::dynamometer;
    use armill::setup::Setup;
    visit(&format!("{THESIS}&view=identify"), DESKTOP, async |page| {
        current(page).await?;
        click(page, "#learn-cuts-example").await?;
        page.wait_for("document.querySelectorAll('#fitted-cuts tbody tr').length === 6", 30.0).await?;
        let of = Job::from_json(include_str!("../../web/examples/learn-cuts.json"))?;
        let cuts = dynamometer::read(include_str!("../../web/examples/learn-cuts.csv"))?;
        let fit = dynamometer::fit(&Setup::of(&of, &mut armill::Progress::none())?.cut, &cuts)?;
        click(page, "#use-coefficients").await?;
        current(page).await?;
        let material = &job(page).await?["material"];
        for coefficient in &fit.coefficients {
            let shown = material[coefficient.key].as_f64().unwrap_or_default();
            assert!((shown / coefficient.value - 1.0).abs() < 1e-3, "{}: {shown}", coefficient.key);
        }
        // The series was made from 959, 251 and 146 N/mm2, 15.8, 19.4 and 18.2 N/mm.
        for (coefficient, truth) in fit.coefficients.iter().zip([959.0, 251.0, 146.0, 15.8, 19.4, 18.2]) {
            assert!(
                coefficient.interval.is_some_and(|[low, high]| low < truth && truth < high),
                "{coefficient:?}"
            );
        }
        narrow(page, "cutting coefficients").await
    })
}

/// Encoders behind a gear: the run, another run predicted, the spring put into the job with its interval, and undone.
#[test]
fn a_gear_becomes_the_jobs_joint() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        open(page).await?;
        let before = page.js("return document.getElementById('fingerprint').textContent").await?;
        click(page, "#identify-gear-example").await?;
        page.wait_for("document.querySelector('#chart-gear svg.plot')", 30.0).await?;
        let [a, b] = GEARS.map(|text| gear::read(text).map(|mut logs| logs.remove(0)));
        let native = a?.fit()?.summary(Some(&b?));
        assert_eq!(page.text("[aria-labelledby=identify-gear-title] .found").await?, native.sentence);
        click(page, "#use-gear-3").await?;
        page.wait_for("document.querySelector('#notice p')", 10.0).await?;
        current(page).await?;
        page.wait_for(&format!("document.getElementById('fingerprint').textContent !== {before}"), 30.0)
            .await?;
        let taken = job(page).await?;
        let stiffness = 1.0 / taken["robot"]["joint_compliance_rad_per_nm"][2].as_f64().unwrap();
        assert!((stiffness / native.stiffness_nm_per_rad.unwrap() - 1.0).abs() < 1e-9, "{taken}");
        let own = taken["uncertainty"]["compliance_covariance"][2][2].as_f64().unwrap().sqrt() * stiffness;
        let [low, high] = native.stiffness_interval_nm_per_rad.unwrap();
        assert!((own - stiffness * (1.0 / low - 1.0 / high) / 3.919_928).abs() < 1e-6, "{own}");
        click(page, "#undo").await?;
        page.wait_for(&format!("document.getElementById('fingerprint').textContent === {before}"), 30.0)
            .await?;

        // What is wrong in the other run is said there.
        paste(page, "#identify-gear-other", "time_s,motor_side_q3_deg\n0,half\n").await?;
        page.wait_for("document.querySelector('#identify-gear-other[aria-invalid=true]')", 10.0).await?;
        assert_eq!(
            page.js("return document.getElementById('identify-gear').getAttribute('aria-invalid')").await?,
            "false"
        );
        Ok(())
    })
}

/// The view Evidence computes from the data of others what the core says of them.
#[test]
fn evidence_is_computed_from_measured_data() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.click("#tab-evidence").await?;
        page.wait_for("document.querySelectorAll('#evidence svg.plot').length === 3", 60.0).await?;
        page.screenshot("evidence.png").await?;
        let [a, b] = GEARS;
        let native =
            [evidence::loads(&Job::from_json(ROBOT)?, LOADS)?, evidence::encoders(a, b)?, evidence::slots()];
        for (section, native) in ["loads", "encoders", "slots"].iter().zip(native) {
            let said = page.text(&format!("#evidence-{section} .found")).await?;
            assert_eq!(said, native.sentence);
            let rows = page
                .js(&format!("return document.querySelectorAll('#evidence-{section} tbody tr').length"))
                .await?;
            assert_eq!(rows, native.rows.len());
        }
        Ok(())
    })
}

/// An address opens an example of the view, computed and in sight.
#[test]
fn an_address_opens_an_example_computed() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        for (kind, done) in [
            ("pass", "#chart-learned svg.plot"),
            ("stiffness", "#chart-stiffness svg.plot"),
            ("gear", "#chart-gear svg.plot"),
            ("response", "#chart-response svg.plot"),
            ("cuts", "#fitted-cuts td"),
        ] {
            page.goto("/gallery.html").await?;
            page.goto(&format!("/index.html#measured={kind}&view=identify")).await?;
            page.wait_for(&format!("document.querySelector('{done}')"), 60.0).await?;
            let near = format!(
                "Math.abs(document.querySelector('{done}').closest('.identify').getBoundingClientRect().top) < innerHeight"
            );
            page.wait_for(&near, 10.0).await?;
        }
        Ok(())
    })
}
