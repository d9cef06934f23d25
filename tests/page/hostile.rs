//! Hostile use: files that are too long or no files at all, invalid numbers, markup in names, no
//! network, no memory, Workers that die. Each ends in a clear message or a result, and nothing that
//! was typed or dropped is lost.

use crate::browser::{DESKTOP, Page, Result, THESIS, visit};
use crate::common::run;
use crate::{current, number, shows, stale, stopped, text};
use serde_json::{Value, json};

/// Drops a file on the page; `content` is a JavaScript expression for a list of its parts.
pub(crate) async fn drop_file(page: &Page, name: &str, content: &str) -> Result {
    let file = json!(name);
    page.js(&format!(
        "const data = new DataTransfer(); data.items.add(new File({content}, {file})); \
         document.body.dispatchEvent(new DragEvent('drop', {{ dataTransfer: data, bubbles: true, cancelable: true }}))"
    ))
    .await
    .map(|_| ())
}

/// Waits until the page shows this message, in its alert or beside a field.
async fn says(page: &Page, part: &str) -> Result {
    page.wait_for(&format!("document.querySelector('#alert').textContent.includes({})", json!(part)), 60.0)
        .await
}

/// The default job's result is still shown, and the next edit is computed as usual.
async fn goes_on(page: &Page) -> Result {
    assert_eq!(number(page, "before-max").await?, run(&[]).summary().before_mm.both.max);
    page.js("document.getElementById('open-thesis').click()").await?;
    page.type_into("#motion-feed_mm_s", "80").await?;
    shows(page, &run(&[("motion.feed_mm_s", json!(80))])).await?;
    page.js("document.getElementById('open-thesis').click()").await?;
    shows(page, &run(&[])).await
}

#[test]
#[ignore = "takes half a minute: cargo xtask test --heavy"]
fn files_of_fifty_megabytes_are_answered() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        drop_file(page, "image.png", "[new Uint8Array(5e7)]").await?;
        says(page, "“image.png” was not opened: it is not plain text").await?;
        assert_eq!(page.value("#path-kind").await?, "circle");
        drop_file(page, "letter.txt", "['Dear all, this is no program.\\n'.repeat(1.7e6)]").await?;
        stale(page).await?;
        says(page, "Line 1, column 1").await?;
        goes_on(page).await?;
        drop_file(page, "digits.nc", "['G1 X' + '1'.repeat(5e7)]").await?;
        says(page, "within -1e9 and 1e9").await?;
        // The message wraps; the page does not become wider.
        assert_eq!(page.wider().await?, Value::Null);
        goes_on(page).await?;
        drop_file(page, "long.json", "['{\"robot\":' + ' '.repeat(5e7) + '7}']").await?;
        says(page, "“long.json” was not opened").await?;
        goes_on(page).await
    })
}

/// Rows of a million points, a hundredth of a millimetre apart, as a JavaScript expression.
const MILLION: &str =
    "Array.from({ length: 1e6 }, (_, k) => [600, (k % 1e4) / 100 - 50, 100 + Math.floor(k / 1e4) / 100])";

#[test]
#[ignore = "takes half a minute: cargo xtask test --heavy"]
fn a_million_points_are_answered_and_survive_a_reload() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        // Coarse samples keep the run short.
        page.type_into("#motion-sample_time_s", "0.02").await?;
        page.type_into("#motion-feed_mm_s", "1000").await?;
        shows(page, &run(&[("motion.sample_time_s", json!(0.02)), ("motion.feed_mm_s", json!(1000))]))
            .await?;
        drop_file(page, "million.csv", &format!("[{MILLION}.map((row) => row.join(',')).join('\\n')]"))
            .await?;
        page.wait_for(
            "document.querySelector('.listing .note').textContent.includes('1\\u202f000\\u202f000 lines')",
            30.0,
        )
        .await?;
        let ended =
            "['current', 'stale', 'stopped'].includes(document.querySelector('#results').dataset.state)";
        page.wait_for(ended, 300.0).await?;
        // The text is kept where the page's small storage would be full, and the other inputs with
        // it.
        let named = "JSON.parse(sessionStorage.getItem('armill-inputs')).state.job.path.text.shelf > 0";
        page.wait_for(named, 30.0).await?;
        assert_eq!(text(page, "notice").await?, "");
        page.reload().await?;
        page.wait_for(
            "document.querySelector('.listing .note').textContent.includes('1\\u202f000\\u202f000 lines')",
            30.0,
        )
        .await?;
        assert_eq!(page.value("#motion-feed_mm_s").await?, "1000");
        page.click("#cancel").await.or_else(|_| Ok::<_, Box<dyn std::error::Error>>(()))?;
        page.js("document.getElementById('open-thesis').click()").await?;
        shows(page, &run(&[])).await
    })
}

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn a_polyline_too_long_for_a_field_is_the_same_path_as_rows() -> Result {
    let points: Vec<[f64; 3]> = (0..6000).map(|k| [600.0, f64::from(k) / 100.0 - 30.0, 100.0]).collect();
    let job = json!({ "motion": { "feed_mm_s": 50 }, "path": { "kind": "polyline", "points_mm": points } });
    let report = run(&[("motion.feed_mm_s", json!(50)), ("path", job["path"].clone())]);
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        drop_file(page, "points.json", &format!("[{}]", json!(job.to_string()))).await?;
        page.wait_for(
            "document.querySelector('#notice').textContent.includes('too many points for a field')",
            20.0,
        )
        .await?;
        current(page).await?;
        assert_eq!(page.value("#path-kind").await?, "csv");
        assert_eq!(number(page, "before-max").await?, report.summary().before_mm.both.max);
        assert_eq!(number(page, "samples").await? as usize, report.samples());
        Ok(())
    })
}

#[test]
fn numbers_that_are_none_and_sizes_beyond_any_robot_are_answered_beside_the_field() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        for (typed, reason) in [
            ("1e6", "it must be 0.001 to 10000 mm"), // a kilometre
            ("0", "it must be 0.001 to 10000 mm"),
            ("NaN", "not a number"),
            ("Infinity", "not a number"),
            ("-1e999", "too large"),
            ("1e-320", "it must be 0.001 to 10000 mm"),
            ("<b>1</b>", "“<b>1</b>” is not a number"),
            ("", "A number is needed"),
        ] {
            page.type_into("#path-radius_mm", typed).await?;
            stale(page).await?;
            says(page, reason).await?;
            assert!(text(page, "path-radius_mm-error").await?.contains(reason), "{typed}");
            assert_eq!(page.value("#path-radius_mm").await?, typed, "what was typed stays");
            assert!(text(page, "alert").await?.len() < 200, "{typed}");
        }
        goes_on(page).await?;
        // Nothing but zeros: reported at the first field, all of them kept.
        let zeros = "[...document.querySelectorAll('#form input.value')].filter((input) => !input.closest('[hidden]') && !input.disabled)";
        page.js(&format!(
            "for (const input of {zeros}) {{ input.value = '0'; input.dispatchEvent(new Event('input', \
             {{ bubbles: true }})) }}"
        ))
        .await?;
        stale(page).await?;
        says(page, "Radius is 0 mm; it must be").await?;
        page.wait_for("localStorage.getItem('armill-inputs')", 10.0).await?;
        page.js("dispatchEvent(new Event('pagehide'))").await?;
        page.reload().await?;
        stale(page).await?;
        assert_eq!(
            page.js(&format!("return {zeros}.every((input) => Number(input.value) === 0)")).await?,
            true
        );
        page.js("document.getElementById('open-thesis').click()").await?;
        shows(page, &run(&[])).await
    })
}

/// Runs if it is ever treated as markup; the policy would block it, so the test looks for the
/// elements too.
const MARKUP: &str = "<img src=x onerror=\"window.intruder=1\"><script>window.intruder=2</script>";

#[test]
fn markup_in_names_and_comments_is_text() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let harmless = async || -> Result {
            let found = page
                .js("return [typeof window.intruder, document.querySelectorAll('img[src=x], [onerror]').length, \
                     [...document.scripts].filter((script) => script.textContent.includes('intruder')).length]")
                .await?;
            assert_eq!(found, json!(["undefined", 0, 0]));
            Ok(())
        };
        let program = format!("({MARKUP})\nG21 G90\n(MSG, {MARKUP})\nM8\nG1 X600 Y0 Z100 F1200\nX640\nM30");
        drop_file(page, &format!("{MARKUP}.nc"), &format!("[{}]", json!(program))).await?;
        page.wait_for("document.querySelector('#path-kind').value === 'gcode'", 20.0).await?;
        current(page).await?;
        harmless().await?;
        let first = "({ load }) => load().then(({ presets }) => presets.robots[0])";
        let joints = page.with_module("core/client", first).await?;
        let job = json!({ "robot": {
            "name": MARKUP,
            "modified_dh": joints["modified_dh"],
            "joint_compliance_rad_per_nm": joints["joint_compliance_rad_per_nm"],
        } });
        drop_file(page, &format!("{MARKUP}.json"), &format!("[{}]", json!(job.to_string()))).await?;
        page.wait_for("document.querySelector('#path-kind').value === 'circle'", 20.0).await?;
        current(page).await?;
        let named = "return [...document.querySelectorAll('#group-robot input')].map((input) => input.value)";
        let names = page.js(named).await?;
        assert!(
            names.as_array().is_some_and(|names| names.contains(&json!(MARKUP))),
            "the name as it is: {names}"
        );
        harmless().await?;
        for view in ["path", "joints", "thesis"] {
            page.js(&format!("document.getElementById('tab-{view}').click()")).await?;
        }
        harmless().await?;
        for broken in [
            json!({ "material": { "preset": MARKUP } }),
            json!({ MARKUP: 1 }),
            json!({ "robot": { "preset": MARKUP } }),
        ] {
            page.js("document.querySelector('#alert').replaceChildren()").await?;
            drop_file(page, &format!("{MARKUP}.json"), &format!("[{}]", json!(broken.to_string()))).await?;
            says(page, MARKUP).await?;
            harmless().await?;
        }
        // A link with the same markup.
        let link = page
            .with_module(
                "job/link",
                &format!(
                    "({{ fragmentOf }}) => fragmentOf({})",
                    json!(json!({ "robot": { "preset": MARKUP } }).to_string())
                ),
            )
            .await?;
        page.js("document.querySelector('#alert').replaceChildren()").await?;
        page.js(&format!("location.hash = {link}")).await?;
        says(page, "The job in the link was not opened").await?;
        harmless().await
    })
}

#[test]
fn a_full_storage_is_told_and_nothing_else_suffers() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        for store in ["localStorage", "sessionStorage"] {
            page.js(&format!(
                "for (let size = 1 << 22, k = 0; size > 0; size >>= 1) {{ try {{ \
                 for (;;) {store}.setItem(`other-${{k++}}`, 'x'.repeat(size)); }} catch {{}} }}"
            ))
            .await?;
        }
        page.type_into("#motion-feed_mm_s", "80").await?;
        page.wait_for(
            "document.querySelector('#notice').textContent.includes('storage for the page is full')",
            20.0,
        )
        .await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80))])).await
    })
}

#[test]
fn without_a_network_the_page_goes_on() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        page.expect_error("ERR_INTERNET_DISCONNECTED");
        shows(page, &run(&[])).await?;
        page.wait_for("document.querySelectorAll('#panel-overview figure .series').length >= 3", 30.0)
            .await?;
        page.devtools("Network.enable", json!({})).await?;
        let offline =
            json!({ "offline": true, "latency": 0, "downloadThroughput": -1, "uploadThroughput": -1 });
        page.devtools("Network.emulateNetworkConditions", offline).await?;
        page.type_into("#motion-feed_mm_s", "80").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80))])).await?;
        page.view("joints").await?;
        page.wait_for("document.querySelector('#panel-joints svg .series')", 20.0).await?;
        page.click("#download-columns").await?;
        assert!(page.downloaded("armill-columns.csv").await?.starts_with("time_s,"));
        page.choose("#examples", "pocket.nc").await?;
        says(page, "Examples/pocket.nc could not be loaded").await?;
        assert_eq!(page.value("#path-kind").await?, "circle");
        shows(page, &run(&[("motion.feed_mm_s", json!(80))])).await
    })
}

/// Runs before the page's own scripts: keeps its Workers where a test can reach them.
const HOLD_WORKERS: &str = "window.workers = []; window.Worker = class extends Worker { constructor(...all) { super(...all); \
     workers.push(this); } }";

/// Shortens the page's wait of thirty seconds to one.
const HASTEN: &str = "; const later = window.setTimeout.bind(window); \
    window.setTimeout = (action, delay, ...rest) => later(action, delay === 30_000 ? 1000 : delay, ...rest)";

#[test]
fn workers_killed_while_they_compute_are_replaced() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        let source = format!("{HOLD_WORKERS}{HASTEN}");
        page.devtools("Page.addScriptToEvaluateOnNewDocument", json!({ "source": source })).await?;
        page.reload().await?;
        current(page).await?;
        page.type_into("#motion-sample_time_s", "2.5e-5").await?;
        page.wait_for("document.querySelector('#results').classList.contains('slow')", 20.0).await?;
        assert!(
            page.js("workers.forEach((worker) => worker.terminate()); return workers.length").await?.as_u64()
                >= Some(2)
        );
        // The browser does not report a killed Worker: the page sees a long run without progress,
        // which can be cancelled.
        page.wait_for("document.querySelector('#status').textContent.startsWith('No progress for')", 20.0)
            .await?;
        page.click("#cancel").await?;
        stopped(page).await?;
        assert!(text(page, "status").await?.contains("Cancelled. Showing the last valid result."));
        assert_eq!(page.value("#motion-sample_time_s").await?, "2.5e-5");
        page.type_into("#motion-sample_time_s", "0.002").await?;
        shows(page, &run(&[("motion.sample_time_s", json!(0.002))])).await
    })
}

/// Runs before the page's own scripts: limits a core to `limit` pages of memory, by a maximum
/// written into its memory section.
const LITTLE_MEMORY: &str = "\
    const number = (bytes, at) => { let [value, shift, byte] = [0, 0, 0]; \
      do { byte = bytes[at++]; value |= (byte & 127) << shift; shift += 7; } while (byte & 128); \
      return [value, at]; };
    const coded = (value) => { const bytes = []; \
      do { bytes.push((value & 127) | (value > 127 ? 128 : 0)); value >>= 7; } while (value); return bytes; };
    WebAssembly.compileStreaming = async (answer) => {
      const bytes = new Uint8Array(await (await answer).arrayBuffer());
      for (let at = 8; at < bytes.length; ) {
        const [size, start] = number(bytes, at + 1);
        if (bytes[at] === 5) {
          const [least] = number(bytes, start + 2);
          const section = [1, 1, ...coded(least), ...coded(least + LIMIT)];
          return WebAssembly.compile(new Uint8Array([...bytes.slice(0, at), 5, \
            ...coded(section.length), ...section, ...bytes.slice(start + size)]));
        }
        at = start + size;
      }
    };";

#[test]
fn memory_that_does_not_suffice_is_told_and_the_inputs_stay() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        page.expect_error("");
        // 40 MB: enough for 20,000 samples, not for 800,000.
        let source = LITTLE_MEMORY.replace("LIMIT", "640");
        page.devtools("Page.addScriptToEvaluateOnNewDocument", json!({ "source": source })).await?;
        page.reload().await?;
        shows(page, &run(&[])).await?;
        page.type_into("#motion-sample_time_s", "2.5e-5").await?;
        says(page, "stopped unexpectedly and was started again; your inputs are kept").await?;
        assert_eq!(page.value("#motion-sample_time_s").await?, "2.5e-5");
        assert_eq!(
            number(page, "before-max").await?,
            run(&[]).summary().before_mm.both.max,
            "the last result stays"
        );
        page.type_into("#motion-sample_time_s", "0.002").await?;
        shows(page, &run(&[("motion.sample_time_s", json!(0.002))])).await
    })
}
