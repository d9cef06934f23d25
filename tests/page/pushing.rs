//! Dragged numbers: a label is a slider, and results follow while it is dragged.

use crate::browser::{DESKTOP, Page, Result, THESIS, visit};
use crate::common::run;
use crate::{current, shows, unfold};
use serde_json::json;

/// Presses the mouse on a label, moves it by some pixels in steps of one, and releases it.
async fn drag(page: &Page, label: &str, pixels: i32) -> Result {
    let place = page
        .js(&format!(
            "const label = document.querySelector('{label}'); label.scrollIntoView({{ block: 'center' }}); \
             const {{ x, y, height }} = label.getBoundingClientRect(); return [x + 12, y + height / 2]"
        ))
        .await?;
    let [x, y]: [f64; 2] = serde_json::from_value(place)?;
    let mouse = async |kind: &str, by: i32| {
        let event = json!({ "type": kind, "x": x + f64::from(by), "y": y, "button": "left", "buttons": 1, "clickCount": 1 });
        page.devtools("Input.dispatchMouseEvent", event).await
    };
    mouse("mousePressed", 0).await?;
    for by in 1..=pixels.abs() {
        mouse("mouseMoved", by * pixels.signum()).await?;
    }
    mouse("mouseReleased", pixels).await.map(|_| ())
}

#[test]
fn a_label_dragged_sideways_is_a_slider() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        unfold(page, "motion").await?;
        drag(page, "#motion-feed_mm_s-label", -40).await?;
        // Ten steps of one in the last digit but one: 100, 90, then 89 down to 81.
        let reached = page.value("#motion-feed_mm_s").await?;
        assert_eq!(reached, "81");
        shows(page, &run(&[("motion.feed_mm_s", json!(81))])).await?;
        assert!(
            page.js("return document.activeElement.id !== 'motion-feed_mm_s'").await? == json!(true),
            "a drag is no click"
        );
        page.click("#motion-feed_mm_s-label").await?;
        assert_eq!(page.js("return document.activeElement.id").await?, json!("motion-feed_mm_s"));
        Ok(())
    })
}

#[test]
fn a_pushed_number_is_followed_by_previews_and_then_by_all_samples() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        unfold(page, "cutting").await?;
        page.js(
            "window.seen = []; \
             const [samples, taken] = ['samples', 'download-program'].map((id) => document.getElementById(id)); \
             new MutationObserver(() => seen.push([Number(samples.dataset.value), !taken.disabled])) \
               .observe(samples, { attributes: true, attributeFilter: ['data-value'] })",
        )
        .await?;
        drag(page, "#cutting-axial_depth_mm-label", -20).await?;
        let reached: f64 = page.value("#cutting-axial_depth_mm").await?.parse()?;
        let wanted = run(&[("cutting.axial_depth_mm", json!(reached))]);
        shows(page, &wanted).await?;
        // Number of samples, and whether they can be downloaded: those of a preview cannot.
        let seen: Vec<(usize, bool)> = serde_json::from_value(page.js("return seen").await?)?;
        let all = wanted.samples();
        assert!(seen.iter().any(|(samples, _)| (2000..all / 2).contains(samples)), "{seen:?}");
        assert!(seen.iter().all(|(samples, taken)| (*samples == all) == *taken), "{seen:?}");
        assert_eq!(seen.last(), Some(&(all, true)));
        assert_eq!(
            page.js("return document.querySelectorAll('[data-state=preview]').length").await?,
            json!(0)
        );
        Ok(())
    })
}
