//! The built page in a real browser, driven like a user. `cargo xtask test` builds and serves the
//! page, starts the driver and runs these tests. Numbers on the page are compared with native runs
//! of the same job, bit for bit.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

#[path = "page/browser.rs"]
pub mod browser;
mod common;
#[path = "gallery/cards.rs"]
mod cards;
#[path = "page/accessibility.rs"]
mod accessibility;
#[path = "page/arm.rs"]
mod arm;
#[path = "page/chart.rs"]
mod chart;
#[path = "page/charts.rs"]
mod charts;
#[path = "page/cursor.rs"]
mod cursor;
#[path = "page/cut.rs"]
mod cut;
#[path = "page/embed.rs"]
mod embed;
#[path = "page/everywhere.rs"]
mod everywhere;
#[path = "page/firefox.rs"]
mod firefox;
#[path = "page/webkit.rs"]
mod webkit;
#[path = "page/first_screen.rs"]
mod first_screen;
#[path = "page/gallery.rs"]
mod gallery;
#[path = "page/hostile.rs"]
mod hostile;
#[path = "page/identify.rs"]
mod identify;
#[path = "page/inputs.rs"]
mod inputs;
#[path = "page/loading.rs"]
mod loading;
#[path = "page/offline.rs"]
mod offline;
#[path = "page/part.rs"]
mod part;
#[path = "page/personas.rs"]
pub mod personas;
#[path = "page/pictures.rs"]
mod pictures;
#[path = "page/pinned.rs"]
mod pinned;
#[path = "page/placement.rs"]
mod placement;
#[path = "page/policy.rs"]
mod policy;
#[path = "page/programs.rs"]
mod programs;
#[path = "page/pushing.rs"]
mod pushing;
#[path = "page/remedies.rs"]
mod remedies;
#[path = "page/robots.rs"]
mod robots;
#[path = "page/scene.rs"]
mod scene;
#[path = "page/scene_marks.rs"]
mod scene_marks;
#[path = "page/session.rs"]
pub mod session;
#[path = "page/standalone.rs"]
mod standalone;
#[path = "page/reading.rs"]
mod reading;
#[path = "page/state.rs"]
mod state;
#[path = "page/study.rs"]
mod study;
#[path = "page/zoom.rs"]
mod zoom;

use armill::Report;
use armill::column::Column;
use armill::export::superposed::{self, Interface};
use armill::report::Statistics;
use armill::setup::Controller;
use armill::verification::Programs;
use browser::{DESKTOP, Key, PHONE, Page, Result, THESIS, visit};
use common::run;
use serde_json::{Value, json};

/// Waits until the page shows the result of its current inputs.
async fn current(page: &Page) -> Result {
    page.wait_for("document.querySelector('#results').dataset.state === 'current'", 60.0).await
}

/// Waits until the page marks its result as outdated.
async fn stale(page: &Page) -> Result {
    page.wait_for("document.querySelector('#results').dataset.state === 'stale'", 60.0).await
}

/// Waits until the page says that a run was stopped.
async fn stopped(page: &Page) -> Result {
    page.wait_for("document.querySelector('#results').dataset.state === 'stopped'", 60.0).await
}

/// Waits until the page, charts drawn for its new size included, is no wider than its screen.
async fn narrow(page: &Page, state: &str) -> Result {
    let fits = "document.documentElement.scrollWidth <= document.documentElement.clientWidth";
    let fitted = page.wait_for(fits, 10.0).await;
    assert_eq!(page.wider().await?, Value::Null, "{state}");
    fitted
}

/// A number of the page in full precision.
async fn number(page: &Page, id: &str) -> Result<f64> {
    let value = page.js(&format!("return document.getElementById('{id}').dataset.value")).await?;
    Ok(value.as_str().ok_or(format!("#{id} shows no number"))?.parse()?)
}

async fn text(page: &Page, id: &str) -> Result<String> {
    let value = page.js(&format!("return document.getElementById('{id}').textContent")).await?;
    Ok(value.as_str().unwrap_or_default().to_owned())
}

/// Opens the group of inputs `name`.
async fn unfold(page: &Page, name: &str) -> Result {
    page.js(&format!("document.getElementById('group-{name}').open = true")).await.map(|_| ())
}

/// Every figure of the page equals the native report's, to the last bit.
async fn shows(page: &Page, report: &Report) -> Result {
    current(page).await?;
    let summary = report.summary();
    let pairs: [(&str, Statistics); 4] = [
        ("before", summary.before_mm.both),
        ("deflection", summary.before_mm.deflection),
        ("shaping", summary.before_mm.shaping),
        ("compensated", summary.after_mm),
    ];
    for (id, value) in [("expected-p50", summary.expected_mm.p50), ("expected-p95", summary.expected_mm.p95)]
    {
        assert_eq!(number(page, id).await?.to_bits(), value.to_bits(), "#{id}");
    }
    for (id, statistics) in pairs {
        assert_eq!(
            number(page, &format!("{id}-mean")).await?.to_bits(),
            statistics.mean.to_bits(),
            "#{id}-mean"
        );
        assert_eq!(
            number(page, &format!("{id}-max")).await?.to_bits(),
            statistics.max.to_bits(),
            "#{id}-max"
        );
    }
    assert_eq!(number(page, "passes").await? as usize, summary.passes);
    assert_eq!(number(page, "samples").await? as usize, summary.samples);
    assert_eq!(text(page, "verdict").await?, summary.verdict);
    assert_eq!(text(page, "fingerprint").await?, summary.fingerprint);
    Ok(())
}

#[test]
fn opens_with_the_thesis_case_and_follows_the_inputs() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        shows(page, &run(&[])).await?;
        let listed = page
            .js("return [...document.querySelectorAll('#warnings-list li')].map(li => li.dataset.code)")
            .await?;
        let codes: Vec<&str> = run(&[]).warnings.iter().map(|warning| warning.code).collect();
        assert_eq!(listed, json!(codes));

        // Feed: a decimal comma counts. Every figure follows, the mean force does not.
        page.type_into("#motion-feed_mm_s", "80,5").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80.5))])).await?;
        page.type_into("#motion-feed_mm_s", "1e2").await?;
        shows(page, &run(&[])).await?;

        unfold(page, "material").await?;
        page.choose("#material-preset", "al-7075-t6").await?;
        let aluminium = ("material", json!({"preset": "al-7075-t6"}));
        let report = run(std::slice::from_ref(&aluminium));
        shows(page, &report).await?;
        // The page adds up the parts itself: the last bit may differ.
        assert!((number(page, "force").await? - report.mean_force().norm()).abs() < 1e-9);
        assert_eq!(
            number(page, "shaping-max").await?,
            run(&[]).summary().before_mm.shaping.max,
            "the shaper is as it was"
        );

        unfold(page, "shaper").await?;
        page.choose("#shaper-kind", "none").await?;
        shows(page, &run(&[aluminium.clone(), ("shaper", json!("none"))])).await?;
        page.choose("#shaper-kind", "zv").await?;
        let zv = json!({"kind": "zv", "frequency_rad_s": 18, "damping": 0.1});
        shows(page, &run(&[aluminium, ("shaper", zv)])).await?;

        page.js("document.getElementById('open-thesis').click()").await?;
        shows(page, &run(&[])).await
    })
}

#[test]
fn invalid_input_is_answered_beside_the_field_and_the_last_result_stays() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let error = async |id: &str| text(page, &format!("{id}-error")).await;
        let marked = async |id: &str| {
            page.js(&format!(
                "return document.getElementById('{id}').getAttribute('aria-invalid') === 'true'"
            ))
            .await
        };
        for (typed, reason) in
            [("-5", "it must be 0.001 to 10000 mm/s"), ("fast", "not a number"), ("", "needed")]
        {
            page.type_into("#motion-feed_mm_s", typed).await?;
            stale(page).await?;
            assert!(
                error("motion-feed_mm_s").await?.contains(reason),
                "{typed}: {}",
                error("motion-feed_mm_s").await?
            );
            assert_eq!(marked("motion-feed_mm_s").await?, true);
            assert_eq!(
                number(page, "before-max").await?,
                run(&[]).summary().before_mm.both.max,
                "the last result stays"
            );
            assert!(text(page, "status").await?.contains("last valid result"));
            assert_eq!(page.value("#motion-feed_mm_s").await?, typed, "nothing that was typed is lost");
            assert_eq!(page.text("#group-motion .digest").await?, "1 error");
        }
        page.type_into("#motion-acceleration_mm_s2", "quick").await?;
        stale(page).await?;
        assert_eq!(page.text("#group-motion .digest").await?, "2 errors");
        page.type_into("#motion-acceleration_mm_s2", "200").await?;
        page.type_into("#motion-feed_mm_s", "100").await?;
        shows(page, &run(&[])).await?;
        assert_eq!(marked("motion-feed_mm_s").await?, false);
        assert_eq!(error("motion-feed_mm_s").await?, "");

        // Only the core can know this: the tooth would leave before it enters.
        unfold(page, "cutting").await?;
        page.type_into("#cutting-exit_deg", "45").await?;
        stale(page).await?;
        assert!(error("cutting-exit_deg").await?.contains("more than entry_deg = 90"));
        page.type_into("#cutting-exit_deg", "180").await?;
        shows(page, &run(&[])).await?;

        // A component of a vector.
        page.type_into("#path-center_mm-y", "1e9").await?;
        stale(page).await?;
        assert_eq!(marked("path-center_mm-y").await?, true);
        assert_eq!(marked("path-center_mm-x").await?, false);
        Ok(())
    })
}

#[test]
fn an_unreachable_path_says_where() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.type_into("#path-radius_mm", "1500").await?;
        stale(page).await?;
        let alert = text(page, "alert").await?;
        let error = common::refused(&[("path.radius_mm", json!(1500))]).to_string();
        for part in ["sample 0", "from the shoulder", "the arm reaches 200.0 to 1100.0 mm"] {
            assert!(error.contains(part) && alert.contains(part), "{alert}");
        }
        assert_eq!(
            number(page, "before-max").await?,
            run(&[]).summary().before_mm.both.max,
            "the last result stays"
        );
        page.type_into("#path-radius_mm", "250").await?;
        shows(page, &run(&[("path.radius_mm", json!(250))])).await?;
        assert_eq!(text(page, "alert").await?, "");
        Ok(())
    })
}

#[test]
fn every_kind_of_path_is_entered() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let line = json!({"kind":"line","from_mm":[600,-200,100],"to_mm":[600,200,100]});
        page.choose("#path-kind", "line").await?;
        shows(page, &run(&[("path", line)])).await?;
        page.choose("#path-kind", "rectangle").await?;
        page.type_into("#path-corner_radius_mm", "25").await?;
        // The circle's centre is kept.
        let center = page
            .js("return ['x','y','z'].map(a => Number(document.getElementById(`path-center_mm-${a}`).value))")
            .await?;
        let rectangle = json!({"kind":"rectangle","center_mm":center,"width_mm":300,"height_mm":200,"corner_radius_mm":25});
        shows(page, &run(&[("path", rectangle)])).await?;
        page.choose("#path-kind", "csv").await?;
        page.type_into("#path-text", "x;y;z\n600;-100;100\n650;0;110\n600;100;100").await?;
        let rows = json!({"kind":"csv","text":"x;y;z\n600;-100;100\n650;0;110\n600;100;100"});
        shows(page, &run(&[("path", rows)])).await?;
        page.type_into("#path-text", "600,-100,100\n650,zero,110").await?;
        stale(page).await?;
        let error = text(page, "path-text-error").await?;
        assert!(error.to_lowercase().contains("line 2, column 5") && error.contains("zero"), "{error}");
        assert!(page.value("#path-text").await?.contains("zero"), "nothing that was typed is lost");
        page.choose("#path-kind", "circle").await?;
        shows(page, &run(&[])).await
    })
}

#[test]
fn a_trap_is_survived() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        page.expect_error("internal error");
        page.expect_error("asked for");
        current(page).await?;
        page.type_into("#motion-feed_mm_s", "120").await?;
        let job = ("motion.feed_mm_s", json!(120));
        shows(page, &run(std::slice::from_ref(&job))).await?;
        page.with_module("core/client", "({ trap }) => trap()").await?;
        page.wait_for("document.querySelector('#alert').textContent.includes('started again')", 20.0).await?;
        // The job is kept and computed again; the next change works as before.
        assert_eq!(page.value("#motion-feed_mm_s").await?, "120");
        shows(page, &run(&[job])).await?;
        page.type_into("#motion-feed_mm_s", "90").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(90))])).await
    })
}

/// The CSV text has exactly these columns, to the last bit.
fn holds(csv: &str, columns: &[Column]) -> Result {
    let mut rows = csv.lines();
    let keys: Vec<&str> = rows.next().ok_or("an empty file")?.split(',').collect();
    assert_eq!(keys, columns.iter().map(|column| column.key.as_str()).collect::<Vec<_>>());
    assert_eq!(csv.lines().count(), columns[0].values.len() + 1);
    for (k, row) in rows.enumerate() {
        assert_eq!(row.split(',').count(), columns.len());
        for (cell, column) in row.split(',').zip(columns) {
            let written = cell.parse::<f64>()?;
            assert_eq!(written.to_bits(), column.values[k].to_bits(), "{} of sample {k}", column.key);
        }
    }
    Ok(())
}

#[test]
fn downloads_hold_the_columns() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let report = run(&[]);
        page.click("#download-columns").await?;
        let native = report.columns();
        holds(&page.downloaded("armill-columns.csv").await?, &native)?;
        page.click("#download-compensated").await?;
        let path: Vec<_> = native
            .into_iter()
            .filter(|column| column.key == "time_s" || column.key.starts_with("compensated_"))
            .collect();
        holds(&page.downloaded("armill-compensated-path.csv").await?, &path)?;
        page.click("#download-job").await?;
        let job = armill::Job::from_json(&page.downloaded("armill-job.json").await?)?;
        assert_eq!(job.model, Some(armill::model::MODEL));
        assert_eq!(armill::run(&job, &mut armill::Progress::none())?.fingerprint(), report.fingerprint());
        Ok(())
    })
}

#[test]
fn every_view_draws_its_charts() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        for view in ["overview", "path", "forces", "deflection", "error", "joints", "shaper"] {
            page.js(&format!("document.getElementById('tab-{view}').click()")).await?;
            let names: Vec<&str> = armill::chart::charts_of(&run(&[]))
                .iter()
                .filter(|entry| entry.view == view)
                .map(|entry| entry.name)
                .collect();
            assert!(!names.is_empty());
            for name in names {
                // One chart is always in sight, above all views.
                let place = if name == "before-after" { "curve".into() } else { format!("panel-{view}") };
                let drawn = format!("document.querySelector('#{place} #chart-{name} svg .series')");
                page.wait_for(&drawn, 30.0).await?;
                let caption = page
                    .js(&format!("return document.querySelector('#chart-{name} figcaption').textContent"))
                    .await?;
                assert!(
                    caption.as_str().is_some_and(|caption| caption.len() > 10),
                    "{name} says what it shows"
                );
            }
        }
        page.click("#tab-thesis").await?;
        page.wait_for("document.querySelectorAll('#thesis tbody tr').length >= 10", 30.0).await?;
        let rows = armill::report::thesis::rows(&run(&[]))?;
        let shown = page
            .js("return [...document.querySelectorAll('#thesis tbody tr')].map(tr => [...tr.cells].slice(0, 4).map(td => td.textContent))")
            .await?;
        let native: Vec<Value> =
            rows.iter().map(|row| json!([row.quantity, row.source, row.printed, row.ours])).collect();
        assert_eq!(shown, json!(native));
        Ok(())
    })
}

#[test]
fn by_keyboard_alone() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let focus = async || {
            let id = page.js("return document.activeElement.id || document.activeElement.className").await?;
            Ok::<String, Box<dyn std::error::Error>>(id.as_str().unwrap_or_default().to_owned())
        };
        let tab_to = async |id: &str| -> Result {
            for _ in 0..400 {
                if focus().await? == id {
                    return Ok(());
                }
                page.press(char::from(Key::Tab)).await?;
            }
            Err(format!("#{id} is not reached by Tab").into())
        };
        tab_to("motion-feed_mm_s").await?;
        // Tabbing into a field selects it.
        page.press("70").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(70))])).await?;
        // The help of the next field unfolds; its own description has it in either case.
        tab_to("explain").await?;
        let help = "document.getElementById('motion-acceleration_mm_s2-help').checkVisibility()";
        assert_eq!(page.js(&format!("return {help}")).await?, false);
        page.press(char::from(Key::Enter)).await?;
        page.wait_for(help, 5.0).await?;
        page.js("document.activeElement.blur(); window.scrollTo(0, 0)").await?;
        tab_to("tab-overview").await?;
        page.press(char::from(Key::Right)).await?;
        assert_eq!(focus().await?, "tab-why");
        page.wait_for("document.querySelector('#panel-budget').checkVisibility()", 20.0).await?;
        page.press(char::from(Key::End)).await?;
        assert_eq!(focus().await?, "tab-thesis");
        page.js("document.activeElement.blur(); document.querySelector('.skip').focus()").await?;
        tab_to("download-compensated").await?;
        page.press(char::from(Key::Enter)).await?;
        assert!(page.downloaded("armill-compensated-path.csv").await?.starts_with("time_s,"));
        Ok(())
    })
}

#[test]
fn a_long_run_shows_progress_and_can_be_cancelled() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        // About a million samples: long enough to watch on any machine.
        page.js("window.seen = new Set(); \
             setInterval(() => seen.add(document.querySelector('#progress').value), 20)")
            .await?;
        page.type_into("#motion-sample_time_s", "2e-5").await?;
        page.wait_for("document.querySelector('#results').classList.contains('slow')", 20.0).await?;
        // It advances within a stage too: there are eight of them.
        page.wait_for("seen.size >= 12", 60.0).await?;
        // The page stays responsive: a tab is changed and its charts of the last result are drawn.
        page.view("shaper").await?;
        page.wait_for("document.querySelector('#chart-shaper-step svg')", 30.0).await?;
        // Typing gets a response, and undoing it computes again.
        unfold(page, "tool").await?;
        page.type_into("#tool-flutes", "four").await?;
        page.wait_for(
            "document.getElementById('tool-flutes-error').textContent.includes('not a number')",
            20.0,
        )
        .await?;
        page.type_into("#tool-flutes", "4").await?;
        page.wait_for("document.querySelector('#results').classList.contains('slow')", 20.0).await?;
        let state = page.js("return document.querySelector('#results').dataset.state").await?;
        assert_eq!(state, "computing", "it still runs");
        page.click("#cancel").await?;
        stopped(page).await?;
        assert!(text(page, "status").await?.contains("Cancelled"));
        assert_eq!(number(page, "samples").await? as usize, run(&[]).samples(), "the last result stays");
        page.type_into("#motion-sample_time_s", "0.002").await?;
        shows(page, &run(&[("motion.sample_time_s", json!(0.002))])).await
    })
}

#[test]
fn fits_a_phone_and_the_dark() -> Result {
    visit(THESIS, PHONE, async |page| {
        current(page).await?;
        for view in ["overview", "path", "error", "thesis"] {
            page.js(&format!("document.getElementById('tab-{view}').click()")).await?;
            let wider = page
                .js("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
                .await?;
            assert_eq!(wider, 0, "no sideways scrolling in {view}");
        }
        // The verdict comes first, then the picture; the inputs wait at the foot of the screen.
        let order = page
            .js("scrollTo(0, 0); \
                 const top = css => document.querySelector(css).getBoundingClientRect().top; \
                 return [top('#verdict'), top('.picture'), top('#inputs'), innerHeight]")
            .await?;
        let order: Vec<f64> = serde_json::from_value(order)?;
        assert!(order.is_sorted(), "{order:?}");
        let visible = "return document.getElementById('inputs-body').checkVisibility()";
        assert_eq!(page.js(visible).await?, false);
        page.click("#inputs-toggle").await?;
        assert_eq!(page.js(visible).await?, true);
        let background = "return getComputedStyle(document.body).backgroundColor";
        let light = page.js(background).await?;
        page.prefer_dark(true).await?;
        assert_ne!(page.js(background).await?, light);
        Ok(())
    })
}

#[test]
fn nothing_moves_when_results_arrive() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.js("window.shift = 0; new PerformanceObserver(list => { for (const e of list.getEntries()) \
             window.shift += e.value; }).observe({ type: 'layout-shift', buffered: true })")
            .await?;
        page.wait_for("document.querySelector('#chart-before-after svg')", 20.0).await?;
        page.js("return new Promise(done => setTimeout(done, 300))").await?;
        let shift = page.js("return window.shift").await?.as_f64().unwrap();
        // Browsers call 0.1 good.
        assert!(shift < 0.1, "layout shift {shift}");
        Ok(())
    })
}

#[test]
fn programs_come_in_and_go_out() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.choose("#path-kind", "gcode").await?;
        let text =
            "G21 G90\nS4000 M3 M8\nG0 X600 Y-60 Z120\nG1 Z100 F1200\nY20\nG2 X640 Y60 I40\nG1 X700\nM30";
        page.type_into("#path-text", text).await?;
        let report = run(&[(
            "path",
            json!({"kind":"gcode","text":text,"tool_length_offsets_mm":[],"work_offsets_mm":[]}),
        )]);
        shows(page, &report).await?;
        let understood = self::text(page, "understood").await?;
        for part in ["8 lines in mm", "4 that cut, 0 rapid", "M8"] {
            assert!(understood.contains(part), "{understood}");
        }
        // Each exported program equals the native one; several files come as a zip, stored as they are.
        let programs = Programs::default();
        for (id, file) in [("gcode", "ARMILL.nc"), ("kuka", "ARMILL.zip"), ("fanuc", "ARMILL.LS")] {
            let native = programs.package(&report, Some(Controller::named(id)?))?;
            page.choose("#export-format", id).await?;
            // The figure of this very program stands beside the button before it is taken.
            page.wait_for(
                &format!(
                    "document.querySelector('#as-program').textContent.startsWith({:?})",
                    native.sentence
                ),
                30.0,
            )
            .await?;
            page.click("#download-program").await?;
            let bytes = page.downloaded_bytes(file).await?;
            let text = String::from_utf8_lossy(&bytes);
            for part in &native.files {
                assert!(text.contains(&part.text), "{id}: {}", part.path);
            }
            assert!(native.files.len() > 1 || text == native.files[0].text, "{id}");
            page.wait_for(
                &format!("document.querySelector('#status').textContent.startsWith('Saved {file}')"),
                30.0,
            )
            .await?;
        }
        // The correction alone, for what adds it to the desired program.
        for interface in Interface::ALL {
            page.choose("#export-format", interface.id()).await?;
            page.click("#download-program").await?;
            let bytes = page.downloaded_bytes(&format!("armill-{}.zip", interface.id())).await?;
            let text = String::from_utf8_lossy(&bytes);
            for part in &superposed::package(&report, interface)? {
                assert!(text.contains(&part.text), "{}", part.path);
            }
        }
        page.choose("#export-format", "correction-csv").await?;
        page.click("#download-program").await?;
        assert_eq!(page.downloaded("armill-correction.csv").await?, superposed::csv(&report));
        // A mistake is located, and the typed text stays.
        page.type_into("#path-text", "G21 G90\nG0 X600 Y0 Z100\nG41 D1 X610").await?;
        stale(page).await?;
        assert!(self::text(page, "path-text-error").await?.to_lowercase().contains("line 3, column 1"));
        assert!(page.value("#path-text").await?.contains("G41 D1"));
        // The result on the page is that of the program before, so its file cannot be downloaded.
        assert_eq!(page.js("return document.querySelector('#download-program').disabled").await?, true);
        page.click("#alert button").await?;
        let selected = "const area = document.querySelector('#path-text'); \
             return area.value.slice(area.selectionStart, area.selectionEnd)";
        assert_eq!(page.js(selected).await?, "G41 D1 X610");
        // An example opens as its own kind.
        page.choose("#examples", "dome.apt").await?;
        page.wait_for("document.querySelector('#path-kind').value === 'apt'", 20.0).await?;
        current(page).await?;
        assert_eq!(page.value("#path-kind").await?, "apt");
        assert!(self::text(page, "understood").await?.contains("the tool axis turns"));
        Ok(())
    })
}
