//! Paths and arm in space, playback, and the error budget: compared with native runs, driven by
//! real pointers and keys.

use super::browser::{DESKTOP, Key, PHONE, Page, Result, THESIS, visit};
use super::common::run;
use super::{current, number};
use serde_json::json;

/// Opens the view and waits for the first picture.
async fn open(page: &Page) -> Result {
    current(page).await?;
    page.wait_for("document.querySelector('#scene').dataset.sample === '0'", 30.0).await
}

/// A value that the scene reports.
async fn data(page: &Page, key: &str) -> Result<String> {
    let value = page.js(&format!("return document.querySelector('#scene').dataset['{key}']")).await?;
    Ok(value.as_str().ok_or(format!("the scene reports no {key}"))?.to_owned())
}

/// The number of colours on the canvas. Its picture exists only until the browser has shown it, so
/// it is read in the frame that draws it.
async fn colours(page: &Page) -> Result<u64> {
    let count = page
        .js("document.querySelector('#scene [data-view=iso]').click();
             return new Promise(done => requestAnimationFrame(() => {
               const canvas = document.querySelector('#scene canvas');
               const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
               copy.drawImage(canvas, 0, 0);
               const pixels = copy.getImageData(0, 0, canvas.width, canvas.height).data;
               done(new Set(new Uint32Array(pixels.buffer)).size);
             }))")
        .await?;
    Ok(count.as_u64().unwrap_or(0))
}

#[test]
fn the_scene_shows_paths_and_arm_and_can_be_turned() -> Result {
    for (size, dark) in [(DESKTOP, false), (PHONE, true)] {
        visit(THESIS, size, async |page| {
            page.prefer_dark(dark).await?;
            open(page).await?;
            assert!(colours(page).await? > 100, "the picture is blank");
            assert_eq!(data(page, "factor").await?, "20", "as the charts magnify it");
            let report = run(&[]);
            assert_eq!(data(page, "points").await?, report.samples().to_string());

            page.js("document.querySelector('#scene canvas').focus()").await?;
            let (azimuth, distance) = (data(page, "azimuth").await?, data(page, "distance").await?);
            page.press(Key::Right).await?;
            page.press("+").await?;
            page.wait_for(
                &format!("document.querySelector('#scene').dataset.distance !== '{distance}'"),
                5.0,
            )
            .await?;
            let turned = data(page, "azimuth").await?.parse::<f64>()? - azimuth.parse::<f64>()?;
            assert!((turned - 5.0).abs() < 0.02, "{turned} deg");
            page.press("1").await?;
            page.wait_for("document.querySelector('#scene').dataset.elevation === '90.00'", 5.0).await?;
            page.choose("#scene .stated select", "100").await?;
            page.wait_for("document.querySelector('#scene').dataset.factor === '100'", 5.0).await?;
            Ok(())
        })?;
    }
    Ok(())
}

#[test]
fn the_arm_follows_the_cursor_and_play_stops_at_the_end() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        open(page).await?;
        let report = run(&[]);
        let tip = |sample: usize| {
            let frames = report.frames(sample);
            let start = 7 * armill::report::scene::FRAME;
            frames[start..start + 3].iter().map(|v| format!("{v:.6}")).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(data(page, "tip").await?, tip(0));
        // Playback, faster than real time; it stops at the end.
        assert_eq!(
            page.js("return document.querySelector('.player').dataset.playing").await?,
            json!("false")
        );
        page.choose(".player select", "10").await?;
        page.js("document.querySelector('#scene canvas').focus()").await?;
        page.press(" ").await?;
        page.wait_for("Number(document.querySelector('#scene').dataset.sample) > 1000", 10.0).await?;
        page.wait_for("document.querySelector('.player').dataset.playing === 'false'", 30.0).await?;
        let last = report.samples() - 1;
        page.wait_for(&format!("document.querySelector('#scene').dataset.tip === '{}'", tip(last)), 5.0)
            .await?;
        assert_eq!(data(page, "sample").await?, last.to_string());
        assert!(page.text(".player .time").await?.starts_with("19.70"));

        // A pointer coming from the left meets the circle's edge, and the cursor moves there.
        page.js("document.querySelector('#scene [data-view=top]').click()").await?;
        page.wait_for("document.querySelector('#scene').dataset.elevation === '90.00'", 5.0).await?;
        page.js(
            "const canvas = document.querySelector('#scene canvas'), box = canvas.getBoundingClientRect();
             return new Promise(done => {
               let x = 0;
               const step = () => {
                 canvas.dispatchEvent(new PointerEvent('pointermove', { \
                   clientX: box.left + (x += 10), clientY: box.top + box.height / 2 }));
                 if (x < box.width / 2) requestAnimationFrame(step); else done();
               };
               step();
             })",
        )
        .await?;
        page.wait_for(&format!("document.querySelector('#scene').dataset.sample !== '{last}'"), 5.0).await?;
        let sample: usize = data(page, "sample").await?.parse()?;
        page.wait_for(&format!("document.querySelector('#scene').dataset.tip === '{}'", tip(sample)), 5.0)
            .await?;
        Ok(())
    })
}

#[test]
fn the_picture_comes_back_after_the_graphics_were_lost() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        open(page).await?;
        page.js("window.lose = document.querySelector('#scene \
             canvas').getContext('webgl2').getExtension('WEBGL_lose_context'); lose.loseContext()")
            .await?;
        page.wait_for("!document.querySelector('#scene .message').hidden", 5.0).await?;
        page.js("lose.restoreContext()").await?;
        page.wait_for("document.querySelector('#scene .message').hidden", 5.0).await?;
        assert!(colours(page).await? > 100, "the picture stays blank");
        Ok(())
    })
}

#[test]
fn without_webgl_a_message_leads_to_the_charts() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        page.js("HTMLCanvasElement.prototype.getContext = () => null").await?;
        current(page).await?;
        page.wait_for("document.querySelector('#scene .message').textContent.includes('WebGL')", 10.0)
            .await?;
        page.wait_for("document.querySelector('#chart-actual-path svg')", 10.0).await
    })
}

#[test]
fn the_budget_is_the_native_one() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let budget = run(&[]).budget();
        let shown = page
            .js("return [...document.querySelectorAll('#budget-table tbody tr')].map(row => \
                 [...row.querySelectorAll('[data-value]')].map(cell => cell.dataset.value))")
            .await?;
        let (worst, mean) = (budget.worst_mm, budget.mean_mm);
        let mut rows: Vec<[f64; 2]> = (0..6).map(|i| [worst.joints[i], mean.joints[i]]).collect();
        rows.extend([
            [worst.deflection(), mean.deflection()],
            [worst.shaping, mean.shaping],
            [worst.total, mean.total],
        ]);
        // As text: the driver's JSON may lose the last bit of a number.
        let shown: Vec<[String; 2]> = serde_json::from_value(shown)?;
        assert_eq!(shown.len(), rows.len());
        for (shown, row) in shown.iter().zip(rows) {
            assert_eq!([shown[0].parse::<f64>()?, shown[1].parse()?], row);
        }
        assert_eq!(super::text(page, "budget-sentence").await?, budget.sentence);
        assert_eq!(number(page, "before-max").await?, worst.total);
        Ok(())
    })
}
