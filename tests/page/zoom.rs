//! Zooming and panning of charts, by mouse, wheel and fingers.

use crate::browser::{DESKTOP, PHONE, Result, THESIS, visit};
use crate::chart::{CONTROL, Chart, TICKS};
use crate::common::run;
use crate::current;
use serde_json::{Value, json};

#[test]
fn a_box_zooms_all_charts_over_time_and_a_double_click_shows_all() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let chart = Chart::open(page, "error", "combined").await?;
        let other = Chart { page, css: "#chart-error-shaping".into() };
        let whole = chart.ticks().await?;
        assert_eq!(whole.last(), Some(&19.7), "the end of the run");
        chart.drag((0.25, 0.5), (0.5, 0.52)).await?;
        chart.wait_for("chart.classList.contains('zoomed')").await?;
        let zoomed = &format!("Math.min(...{TICKS}) >= 4.5");
        chart.wait_for(zoomed).await?;
        let ticks = chart.ticks().await?;
        let duration = run(&[]).duration();
        assert!(ticks.iter().all(|t| (0.25 * duration - 0.1..0.5 * duration + 0.1).contains(t)), "{ticks:?}");
        other.wait_for(zoomed).await?;
        // Detail appears: the value read is still a sample.
        chart.hover(0.5).await?;
        let values = chart.values().await?;
        assert!((values[0] - 0.375 * duration).abs() < 0.05, "{values:?}");
        // A chart opened only now has the same range.
        let joint = Chart::open(page, "joints", "joint-3").await?;
        assert!(joint.ticks().await?.iter().all(|t| (4.5..10.0).contains(t)));
        // Keys zoom in further about the cursor, and back out to the whole.
        joint.js("chart.querySelector('.drawing').focus()").await?;
        page.press("+").await?;
        joint.wait_for(&format!("Math.max(...{TICKS}) < 9")).await?;
        page.press("0").await?;
        joint.wait_for("!chart.classList.contains('zoomed')").await?;
        let chart = Chart::open(page, "error", "combined").await?;
        // The whole is shown at once and drawn exactly after that.
        chart.wait_for(&format!("Math.max(...{TICKS}) === 19.7")).await?;
        assert_eq!(chart.ticks().await?, whole);
        // A box with some height zooms both axes, in this chart only.
        chart.drag((0.2, 0.1), (0.4, 0.6)).await?;
        chart.wait_for(&format!("Math.min(...{TICKS}) >= 3")).await?;
        let lowest = "Math.min(...[...chart.querySelectorAll('.axis text[text-anchor=end]')].map(t => Number(t.textContent)))";
        chart.wait_for(&format!("{lowest} > 0.4")).await?;
        chart.double_click().await?;
        chart.wait_for("!chart.classList.contains('zoomed')").await?;
        other.wait_for("!chart.classList.contains('zoomed')").await
    })
}

#[test]
fn the_wheel_scrolls_the_page_unless_a_chart_is_meant() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let chart = Chart::open(page, "error", "combined").await?;
        let scrolled = async || page.js("return scrollY").await.map(|y| y.as_f64().unwrap());
        let place = chart.at(0.5, 0.5).await?;
        let before = scrolled().await?;
        chart.mouse("mouseWheel", place, json!({ "deltaX": 0, "deltaY": -120 })).await?;
        page.wait_for(&format!("scrollY < {before}"), 5.0).await?;
        chart.wait_for("!chart.classList.contains('zoomed')").await?;
        page.js("return new Promise(done => setTimeout(done, 400))").await?; // until it has scrolled
        chart.show().await?;
        let before = scrolled().await?;
        let place = chart.at(0.5, 0.5).await?;
        chart
            .mouse("mouseWheel", place, json!({ "deltaX": 0, "deltaY": -240, "modifiers": CONTROL }))
            .await?;
        chart.wait_for("chart.classList.contains('zoomed')").await?;
        assert_eq!(scrolled().await?, before);
        // The point under the pointer has not moved.
        chart.hover(0.5).await?;
        assert!((chart.values().await?[0] - 0.5 * run(&[]).duration()).abs() < 0.05);
        Ok(())
    })
}

#[test]
fn two_fingers_zoom_and_one_scrolls_or_reads() -> Result {
    visit(THESIS, PHONE, async |page| {
        page.devtools("Emulation.setTouchEmulationEnabled", json!({ "enabled": true, "maxTouchPoints": 2 }))
            .await?;
        page.reload().await?;
        current(page).await?;
        let chart = Chart::open(page, "error", "combined").await?;
        let touch = async |kind: &str, points: &[(f64, f64)]| -> Result {
            let points: Vec<_> =
                points.iter().enumerate().map(|(id, (x, y))| json!({ "x": x, "y": y, "id": id })).collect();
            page.devtools("Input.dispatchTouchEvent", json!({ "type": kind, "touchPoints": points }))
                .await
                .map(|_| ())
        };
        // One finger across reads values.
        let y = chart.at(0.5, 0.5).await?.1;
        let x = async |across: f64| chart.at(across, 0.5).await.map(|place| place.0);
        touch("touchStart", &[(x(0.3).await?, y)]).await?;
        for across in [0.4, 0.5, 0.6] {
            touch("touchMove", &[(x(across).await?, y)]).await?;
        }
        touch("touchEnd", &[]).await?;
        chart.wait_for("chart.querySelector('.readout b')").await?;
        let duration = run(&[]).duration();
        chart
            .wait_for(&format!(
                "Math.abs(chart.querySelector('.readout b').dataset.value - {}) < 0.1",
                0.6 * duration
            ))
            .await?;
        // Two fingers apart zoom in.
        touch("touchStart", &[(x(0.45).await?, y)]).await?;
        touch("touchStart", &[(x(0.45).await?, y), (x(0.55).await?, y)]).await?;
        for spread in [0.1, 0.15, 0.2] {
            touch("touchMove", &[(x(0.5 - spread).await?, y), (x(0.5 + spread).await?, y)]).await?;
        }
        touch("touchEnd", &[]).await?;
        chart.wait_for("chart.classList.contains('zoomed')").await?;
        chart.wait_for("chart.querySelector('.drawing').ariaValueMin > 5").await?;
        let ends = chart.js("const d = chart.querySelector('.drawing'); return [Number(d.ariaValueMin), Number(d.ariaValueMax)]").await?;
        let ends: [f64; 2] = serde_json::from_value(ends)?;
        assert!(
            ((ends[0] + ends[1]) / 2.0 - duration / 2.0).abs() < 0.3,
            "about the fingers' middle: {ends:?}"
        );
        assert!((ends[1] - ends[0] - duration / 4.0).abs() < 0.5, "four times as large: {ends:?}");
        chart.tool("Show all").await?;
        chart.wait_for("!chart.classList.contains('zoomed')").await?;
        // The tools are there without hovering, and large enough; nothing is wider than the screen.
        let least = chart
            .js("return Math.min(...[...chart.querySelectorAll('.chart-tools button, \
                 .legend button')].filter(b => b.checkVisibility()).map(b => b.offsetHeight))")
            .await?;
        assert!(least.as_f64().unwrap() >= 24.0, "{least}");
        assert_eq!(page.wider().await?, Value::Null);
        Ok(())
    })
}
