//! The cursor of the charts: one sample in all of them and in the program, read and moved as a user
//! does.

use crate::browser::{DESKTOP, Key, Result, THESIS, visit};
use crate::chart::{Chart, column};
use crate::common::run;
use crate::current;
use serde_json::json;

#[test]
fn the_cursor_reads_samples_and_is_one_for_all_charts() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let report = run(&[]);
        let chart = Chart::open(page, "error", "after-both").await?;
        for across in [0.02, 0.31, 0.77] {
            chart.hover(across).await?;
            let duration = report.duration();
            let near = format!(
                "Math.abs(chart.querySelector('.readout b').dataset.value - {}) < 0.05",
                across * duration
            );
            chart.wait_for(&near).await?;
            let values = chart.values().await?;
            let time = column(&report, "time_s");
            let sample = time.iter().position(|t| t.to_bits() == values[0].to_bits()).unwrap();
            let keys = ["contour_error_mm", "after_contour_error_mm", "after_p95_mm"];
            assert_eq!(values[1..], keys.map(|key| column(&report, key)[sample]), "the sample's own values");
            // Another chart over time marks and reads the same instant.
            let other = Chart { page, css: "#chart-combined".into() };
            let same = format!("chart.querySelector('.readout b')?.dataset.value === '{}'", values[0]);
            other.wait_for(&same).await?;
            assert_eq!(other.values().await?[3], values[1]);
            other
                .wait_for(
                    "chart.querySelector('.mark.on') && chart.querySelectorAll('.marks circle').length === 3",
                )
                .await?;
        }
        // Leaving the chart hides the cursor; a click pins it.
        chart.mouse("mouseMoved", (5.0, 5.0), json!({})).await?;
        chart.wait_for("!chart.querySelector('.readout b') && !chart.querySelector('.mark.on')").await?;
        let place = chart.at(0.5, 0.5).await?;
        chart.mouse("mousePressed", place, json!({ "button": "left", "clickCount": 1 })).await?;
        chart.mouse("mouseReleased", place, json!({ "button": "left", "clickCount": 1 })).await?;
        chart.mouse("mouseMoved", (5.0, 5.0), json!({})).await?;
        chart.wait_for("chart.querySelector('.readout b')").await?;
        // It stays in another view, and in space it is a place on each path.
        let pinned = page.with_module("page/cursor", "({ cursor }) => cursor()").await?;
        let space = Chart::open(page, "path", "path").await?;
        space.wait_for("chart.querySelectorAll('.marks circle').length === 1").await?;
        let values = space.values().await?;
        assert_eq!(json!(values[0]), pinned);
        let sample = column(&report, "time_s").iter().position(|t| *t == values[0]).unwrap();
        assert_eq!(values[3], column(&report, "desired_z_mm")[sample]);
        Ok(())
    })
}

#[test]
fn keys_move_the_cursor() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let chart = Chart::open(page, "error", "error-shaping").await?;
        let report = run(&[]);
        let focus = "chart.querySelector('.drawing').focus()";
        chart.js(focus).await?;
        let outline = "return getComputedStyle(chart.querySelector('.drawing')).outlineStyle";
        assert_eq!(chart.js(outline).await?, "solid", "the focus is seen");
        page.press(char::from(Key::End)).await?;
        chart.wait_for("chart.querySelector('.readout b')").await?;
        let last = report.samples() - 1;
        let time = column(&report, "time_s");
        assert_eq!(chart.values().await?, [time[last], column(&report, "shaping_contour_error_mm")[last]]);
        page.press(char::from(Key::Home)).await?;
        chart.wait_for("chart.querySelector('.readout b').dataset.value === '0'").await?;
        // One pixel is many samples; zoomed in far enough it is one.
        page.press(char::from(Key::Right)).await?;
        chart.wait_for("chart.querySelector('.readout b').dataset.value > 0.02").await?;
        page.press("++++++++").await?;
        chart.wait_for("chart.querySelector('.drawing').ariaValueMax < 0.5").await?;
        let before = chart.values().await?[0];
        page.press(char::from(Key::Right)).await?;
        chart
            .wait_for(&format!("Number(chart.querySelector('.readout b').dataset.value) !== {before}"))
            .await?;
        let step = chart.values().await?[0] - before;
        assert!((step - 0.001).abs() < 1e-9, "{step}");
        let spoken = chart.js("return chart.querySelector('.drawing').ariaValueText").await?;
        assert!(
            spoken
                .as_str()
                .is_some_and(|spoken| spoken.starts_with("Time 0.0") && spoken.contains("Shaping alone ")),
            "{spoken}"
        );
        page.press(char::from(Key::Escape)).await?;
        chart.wait_for("!chart.querySelector('.readout b')").await
    })
}

/// The CSV text of a chart holds exactly these columns.

#[test]
fn cursor_and_program_line_lead_to_each_other() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.choose("#path-kind", "gcode").await?;
        page.type_into("#path-text", "G21 G90\nG0 X600 Y-60 Z100\nG1 Y20 F1200\nG1 X640 Y60\nM30").await?;
        current(page).await?;
        let chart = Chart::open(page, "overview", "before-after").await?;
        // The caret in a line moves the cursor to the start of the line's run.
        page.js("const text = document.getElementById('path-text'); text.focus(); \
             const at = text.value.indexOf('G1 X640'); text.setSelectionRange(at, at); \
             text.dispatchEvent(new MouseEvent('click', { bubbles: true }))")
            .await?;
        chart
            .wait_for("chart.querySelector('.readout button')?.textContent === 'line 4 of the program'")
            .await?;
        // In reverse: the line under the cursor is selected in the text field.
        chart.show().await?;
        chart.hover(0.3).await?;
        chart
            .wait_for("chart.querySelector('.readout button')?.textContent === 'line 3 of the program'")
            .await?;
        chart.js("chart.querySelector('.drawing').focus()").await?;
        page.press(char::from(Key::Enter)).await?;
        let selected = "const t = document.getElementById('path-text'); return document.activeElement === t && \
             t.value.slice(t.selectionStart, t.selectionEnd)";
        assert_eq!(page.js(selected).await?, "G1 Y20 F1200");
        Ok(())
    })
}
