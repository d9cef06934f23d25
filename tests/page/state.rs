//! Where the inputs come from and where they go: links, the browser's storage, undo and redo.

use crate::browser::{DESKTOP, Key, Page, Result, THESIS, visit};
use crate::common::program::opened_example;
use crate::common::{job_text, run};
use crate::hostile::drop_file;
use crate::{current, shows, stale, text};
use serde_json::json;

/// The fragment that encodes the JSON text of a job, as the page makes it.
async fn fragment(page: &Page, job: &str) -> Result<String> {
    let made =
        page.with_module("job/link", &format!("({{ fragmentOf }}) => fragmentOf({})", json!(job))).await?;
    Ok(made.as_str().unwrap_or_default().to_owned())
}

/// The content of the dialog "Share" in the form `form`, and whether the page's own copy button
/// reports a copy.
async fn shared(page: &Page, form: &str) -> Result<String> {
    page.click("#share").await?;
    page.wait_for("document.querySelector('#share-dialog').open", 5.0).await?;
    page.js(&format!("document.querySelector('#share-{form}').click()")).await?;
    page.wait_for("document.querySelector('#share-text').value", 5.0).await?;
    let value = page.value("#share-text").await?;
    let selected = page
        .js("const text = document.querySelector('#share-text'); return text.value.slice(text.selectionStart, text.selectionEnd)")
        .await?;
    assert_eq!(selected, json!(value));
    page.click("#share-close").await?;
    Ok(value)
}

/// The line at the foot of the page.
async fn notice(page: &Page) -> Result<String> {
    text(page, "notice").await
}

async fn feed(page: &Page) -> Result<String> {
    page.value("#motion-feed_mm_s").await
}

/// Loads the page from scratch, as a bookmark or another page's link would.
async fn open(page: &Page, fragment: &str) -> Result {
    page.js("location.href = 'about:blank'").await?;
    page.wait_for("location.href === 'about:blank'", 10.0).await?;
    page.goto(&format!("/index.html#{fragment}")).await
}

#[test]
fn a_link_gives_the_same_bits_in_a_fresh_profile() -> Result {
    let report = run(&[("motion.feed_mm_s", json!(80)), ("path.radius_mm", json!(250))]);
    let link = std::cell::OnceCell::new();
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.type_into("#motion-feed_mm_s", "80").await?;
        page.type_into("#path-radius_mm", "250").await?;
        shows(page, &report).await?;
        link.set(shared(page, "link").await?.split_once('#').ok_or("no fragment")?.1.to_owned())?;
        Ok(())
    })?;
    let link = link.get().ok_or("no link")?;
    assert!(link.starts_with("job=2."), "{link}");
    visit(&format!("/#{link}"), DESKTOP, async |page| {
        shows(page, &report).await?;
        assert_eq!(notice(page).await?, "", "there was nothing before");
        let address = page.js("return location.hash").await?;
        assert_eq!(address, json!(format!("#{link}")), "the address is the job's until it is changed");
        page.type_into("#motion-feed_mm_s", "90").await?;
        assert_eq!(page.js("return location.hash").await?, json!(""));
        page.reload().await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(90)), ("path.radius_mm", json!(250))])).await
    })
}

#[test]
fn a_link_that_cannot_be_opened_says_why_and_the_example_stands() -> Result {
    let example = armill::run(&armill::Job::opening()?, &mut armill::Progress::none())?;
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.type_into("#motion-feed_mm_s", "70").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(70))])).await?;
        let good = fragment(page, "{}").await?;
        let damaged = format!("{}A{}", &good[..8], &good[9..]);
        let bomb = fragment(page, &format!("{{\"version\":1}}{}", " ".repeat(5_000_000))).await?;
        assert!(bomb.len() < 10_000);
        for (broken, reason) in [
            (good[..good.len() - 2].to_owned(), "cut off or damaged"),
            (damaged, "cut off or damaged"),
            ("job=".to_owned(), "not of the form"),
            ("job=1.a*b".to_owned(), "not of the form"),
            (good.replace("=2.", "=3."), "newer Armill"),
            (bomb, "more than 4 MB"),
            (fragment(page, "{\"motion\":{\"feed_mm_s\":-5}}").await?, "it must be 0.001 to 10000"),
            (fragment(page, "{\"motor\":1}").await?, "motor"),
        ] {
            open(page, &broken).await?;
            shows(page, &example).await?;
            let alert = text(page, "alert").await?;
            assert!(alert.contains(reason) && alert.contains("This is the example"), "{broken}: {alert}");
        }
        // The user's own inputs are one undo away.
        page.click("#undo").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(70))])).await?;
        assert_eq!(text(page, "alert").await?, "");

        // A link pasted into the address of the open page replaces the inputs, a broken one does
        // not.
        let job = fragment(page, "{\"motion\":{\"feed_mm_s\":60}}").await?;
        page.js(&format!("location.hash = '{job}'")).await?;
        page.wait_for("document.querySelector('#motion-feed_mm_s').value === '60'", 10.0).await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(60))])).await?;
        page.js("location.hash = 'job=3.abc'").await?;
        page.wait_for("document.querySelector('#alert').textContent.includes('newer')", 10.0).await?;
        assert_eq!(feed(page).await?, "60");
        assert_eq!(page.js("return location.hash").await?, json!(""));
        page.click("#undo").await?;
        assert_eq!(feed(page).await?, "70");
        Ok(())
    })
}

/// What the page says when it opens a job whose figures an earlier model gave.
const EARLIER: &str = "Computed with an earlier model; figures differ.";

/// A job with this feed as it was saved by the model of this number, or before there was one.
fn saved(feed: u32, model: Option<u32>) -> String {
    let model = model.map(|model| ("model", json!(model)));
    job_text(&[("motion.feed_mm_s", json!(feed))].into_iter().chain(model).collect::<Vec<_>>())
}

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn what_an_earlier_model_computed_says_so_on_opening() -> Result {
    let of_feed = |feed: u32| run(&[("motion.feed_mm_s", json!(feed))]);
    let kept = "JSON.parse(sessionStorage.getItem('armill-inputs')).state.job";
    visit(THESIS, DESKTOP, async |page| {
        shows(page, &run(&[])).await?;
        assert_eq!(notice(page).await?, "", "the page's own default");
        let says = format!("document.querySelector('#notice').textContent.includes({})", json!(EARLIER));

        // Links.
        for (format, model, earlier) in [(1, None, true), (2, Some(1), true), (2, Some(2), false)] {
            let link = fragment(page, &saved(80, model)).await?;
            let link = link.replace("job=2.", &format!("job={format}."));
            open(page, &link).await?;
            shows(page, &of_feed(80)).await?;
            assert_eq!(notice(page).await?.contains(EARLIER), earlier, "format {format}, model {model:?}");
        }
        let link = shared(page, "link").await?;
        let (_, link) = link.split_once('#').ok_or("no fragment")?;
        let job = page.with_module("job/link", &format!("({{ jobIn }}) => jobIn('{link}')")).await?;
        assert!(job.as_str().is_some_and(|job| job.contains("\"model\":2")), "{job}");

        // Files.
        for model in [None, Some(1)] {
            drop_file(page, "job.json", &json!([saved(60, model)]).to_string()).await?;
            page.wait_for(&says, 20.0).await?;
            page.click("#notice button").await?;
        }
        drop_file(page, "job.json", &json!([saved(70, Some(2))]).to_string()).await?;
        shows(page, &of_feed(70)).await?;
        assert_eq!(notice(page).await?, "");
        drop_file(page, "job.json", &json!([saved(50, Some(3))]).to_string()).await?;
        page.wait_for("document.querySelector('#alert').textContent.includes('1 to 2')", 20.0).await?;
        assert_eq!(feed(page).await?, "70");

        // What this browser kept.
        page.wait_for(&format!("{kept}.motion.feed_mm_s === 70 && {kept}.model === 2"), 10.0).await?;
        page.js("for (const store of [sessionStorage, localStorage]) { \
             const inputs = JSON.parse(store.getItem('armill-inputs')); delete inputs.state.job.model; \
             store.setItem('armill-inputs', JSON.stringify(inputs)); }")
            .await?;
        page.reload().await?;
        shows(page, &of_feed(70)).await?;
        assert_eq!(notice(page).await?, format!("{EARLIER}Close"));
        page.type_into("#motion-feed_mm_s", "90").await?;
        shows(page, &of_feed(90)).await?;
        page.reload().await?;
        shows(page, &of_feed(90)).await?;
        assert_eq!(notice(page).await?, "", "it is of this model now");

        // A frame with a link of before.
        let link = fragment(page, &saved(80, None)).await?;
        page.goto(&format!("embed.html#{link}&inputs=none&charts=none")).await?;
        page.wait_for("document.querySelector('#status').textContent.includes('an earlier model')", 20.0)
            .await
    })
}

#[test]
fn nothing_typed_is_lost_by_a_reload() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.choose("#path-kind", "csv").await?;
        page.type_into("#path-text", "600,-100,100\n650,0,110\n600,100,100").await?;
        page.choose("#path-kind", "circle").await?;
        page.type_into("#path-center_mm-y", "1e").await?;
        page.type_into("#motion-feed_mm_s", "fast").await?;
        page.reload().await?;
        stale(page).await?;
        assert_eq!(feed(page).await?, "fast");
        assert_eq!(page.value("#path-center_mm-y").await?, "1e");
        assert!(text(page, "motion-feed_mm_s-error").await?.contains("not a number"));
        page.wait_for("document.querySelector('#before-max').dataset.value", 20.0).await?;
        page.type_into("#motion-feed_mm_s", "80").await?;
        page.type_into("#path-center_mm-y", "0").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80))])).await?;
        // The inputs of a kind of path that is not selected are kept too.
        page.choose("#path-kind", "csv").await?;
        assert!(page.value("#path-text").await?.contains("650,0,110"));
        Ok(())
    })
}

#[test]
fn undo_and_redo_go_by_steps_that_make_sense() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let can =
            async |id: &str| page.js(&format!("return !document.getElementById('{id}').disabled")).await;
        assert_eq!((can("undo").await?, can("redo").await?), (json!(false), json!(false)));
        // Five keystrokes in one field are one step.
        page.type_into("#motion-feed_mm_s", "80.25").await?;
        page.type_into("#path-radius_mm", "zero").await?;
        page.choose("#path-kind", "line").await?;
        page.choose("#path-kind", "circle").await?;
        page.click("#undo").await?;
        assert_eq!(page.value("#path-kind").await?, "line");
        page.click("#undo").await?;
        assert_eq!(page.value("#path-radius_mm").await?, "zero", "what was typed wrong comes back too");
        stale(page).await?;
        page.click("#undo").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80.25))])).await?;
        page.click("#undo").await?;
        shows(page, &run(&[])).await?;
        assert_eq!((can("undo").await?, can("redo").await?), (json!(false), json!(true)));

        // By keys, wherever the focus is; only a field being typed into keeps its own undo.
        let keys = |key: &str| format!("{}{key}{}", Key::Control, Key::Null);
        page.press(keys("y")).await?;
        assert_eq!(feed(page).await?, "80.25");
        page.press(keys("z")).await?;
        assert_eq!(feed(page).await?, "100");
        page.press(format!("{}{}z{}", Key::Control, Key::Shift, Key::Null)).await?;
        assert_eq!(feed(page).await?, "80.25");
        page.type_into("#motion-acceleration_mm_s2", "300").await?;
        page.press(keys("z")).await?;
        assert_eq!(feed(page).await?, "80.25");
        assert_eq!(can("redo").await?, json!(false), "a new edit ends what could be redone");
        page.type_into("#motion-acceleration_mm_s2", "300").await?;
        page.press(char::from(Key::Tab)).await?;
        page.press(keys("z")).await?;
        assert_eq!(page.value("#motion-acceleration_mm_s2").await?, "200");
        shows(page, &run(&[("motion.feed_mm_s", json!(80.25))])).await?;
        page.js("document.getElementById('open-thesis').click()").await?;
        shows(page, &run(&[])).await?;
        page.click("#undo").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80.25))])).await
    })
}

#[test]
fn without_storage_the_page_works_and_says_once_that_nothing_is_kept() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        let denied = "for (const name of ['localStorage', 'sessionStorage']) Object.defineProperty(window, \
             name, { get() { throw new DOMException('denied', 'SecurityError'); } });";
        page.devtools("Page.addScriptToEvaluateOnNewDocument", json!({ "source": denied })).await?;
        page.reload().await?;
        current(page).await?;
        assert_eq!(notice(page).await?, "");
        page.type_into("#motion-feed_mm_s", "80").await?;
        page.wait_for("document.querySelector('#notice').textContent.includes('Inputs are not kept')", 10.0)
            .await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80))])).await?;
        page.click("#notice button").await?;
        page.type_into("#motion-feed_mm_s", "90").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(90))])).await?;
        page.js("return new Promise(done => setTimeout(done, 500))").await?;
        assert_eq!(notice(page).await?, "");
        page.click("#undo").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80))])).await
    })
}

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn two_tabs_keep_their_own_inputs() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.type_into("#motion-feed_mm_s", "80").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80))])).await?;
        // A new tab opens with the latest inputs, and from then on the two are independent.
        page.wait_for("localStorage.getItem('armill-inputs')", 10.0).await?;
        let first = page.new_tab("/", DESKTOP).await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80))])).await?;
        page.type_into("#motion-feed_mm_s", "55").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(55))])).await?;
        page.switch_to(first).await?;
        page.wait_for("document.querySelector('#notice').textContent.includes('another tab')", 10.0).await?;
        assert_eq!(feed(page).await?, "80");
        page.reload().await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80))])).await?;
        page.new_tab("/", DESKTOP).await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(55))])).await
    })
}

#[test]
fn a_result_is_shared_in_three_forms() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.type_into("#motion-feed_mm_s", "80").await?;
        let report = run(&[("motion.feed_mm_s", json!(80))]);
        shows(page, &report).await?;
        // The shown job is shared, whatever is being typed.
        page.type_into("#motion-feed_mm_s", "fast").await?;
        stale(page).await?;
        let link = shared(page, "link").await?;
        let markdown = shared(page, "markdown").await?;
        let summary = report.summary();
        let figures = format!(
            "| both, before compensation | {:.4} | {:.4} |",
            summary.before_mm.both.mean, summary.before_mm.both.max
        );
        for part in [
            &format!("**{}**", summary.verdict),
            &figures,
            "- Feed: 80 mm/s (default 100 mm/s)\n\n",
            &format!("({link})"),
            &format!("fingerprint `{}`, model 2\n", summary.fingerprint),
        ] {
            assert!(markdown.contains(part), "{part} is not in {markdown}");
        }
        let frame = shared(page, "embed").await?;
        let source = link.replace("/#", "/embed.html#");
        assert!(frame.starts_with(&format!("<iframe src=\"{source}\"")), "{frame}");

        // Copying: by the page if the browser allows it, or by hand.
        page.click("#share").await?;
        page.js("Object.defineProperty(navigator, 'clipboard', { configurable: true, \
             value: { writeText: async (text) => { window.copied = text; } } })")
            .await?;
        page.click("#share-copy").await?;
        page.wait_for("document.querySelector('#share-dialog .said').textContent === 'Copied.'", 5.0).await?;
        assert_eq!(page.js("return window.copied").await?, json!(link));
        page.js("Object.defineProperty(navigator, 'clipboard', { value: { writeText: async () => { \
             throw new DOMException('denied', 'NotAllowedError'); } } })")
            .await?;
        page.click("#share-copy").await?;
        page.wait_for(
            "document.querySelector('#share-dialog .said').textContent.includes('does not allow')",
            5.0,
        )
        .await?;
        assert_eq!(page.js("return document.activeElement.id").await?, "share-text");
        assert_eq!(page.js("return getSelection().toString()").await?, json!(link));
        page.click("#share-close").await?;

        // A job too long for a link becomes a file.
        let points: Vec<[f64; 3]> = (0..1500)
            .map(|k| [600.0 + 0.1 * f64::from(k), armill::math::sin(f64::from(k) * 0.7) * 50.0, 100.0])
            .collect();
        let rows: Vec<String> = points.iter().map(|[x, y, z]| format!("{x},{y},{z}")).collect();
        page.click("#undo").await?;
        page.choose("#path-kind", "csv").await?;
        page.js(&format!(
            "const text = document.querySelector('#path-text'); text.value = {}; \
             text.dispatchEvent(new Event('input', {{ bubbles: true }}))",
            json!(rows.join("\n"))
        ))
        .await?;
        current(page).await?;
        page.click("#share").await?;
        page.wait_for(
            "document.querySelector('#share-note').textContent.includes('send the job as a file')",
            5.0,
        )
        .await?;
        page.click("#share-file").await?;
        let saved = page.downloaded("armill-job.json").await?;
        assert!(saved.contains(&rows[1400]));
        Ok(())
    })
}

#[test]
fn a_stock_survives_a_link_and_a_reload_and_is_reported() -> Result {
    let report = run(&opened_example("contour.nc"));
    let link = std::cell::OnceCell::new();
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        crate::unfold(page, "path").await?;
        page.choose("#examples", "contour.nc").await?;
        page.wait_for("document.querySelector('#stock-kind').value === 'box'", 20.0).await?;
        shows(page, &report).await?;
        let stock = report.summary().cut.stock.ok_or("no stock")?;
        let said = format!("Engagement from the stock: {stock}. It loses 2.49 cm³");
        let markdown = shared(page, "markdown").await?;
        assert!(
            markdown.contains(&said) && markdown.contains("- Stock: box (default not given)"),
            "{markdown}"
        );
        link.set(shared(page, "link").await?.split_once('#').ok_or("no fragment")?.1.to_owned())?;
        page.reload().await?;
        shows(page, &report).await
    })?;
    visit(&format!("/#{}", link.get().ok_or("no link")?), DESKTOP, async |page| shows(page, &report).await)
}
