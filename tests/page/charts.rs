//! The charts in a real browser: filtered, read as tables and exported; values against native runs,
//! bit for bit.

use crate::browser::{DESKTOP, Key, Result, THESIS, visit};
use crate::chart::{Chart, column};
use crate::common::run;
use crate::{current, shows};
use armill::Report;
use armill::chart::{ChartOptions, Scaling};
use serde_json::json;

#[test]
fn series_are_hidden_and_isolated() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let chart = Chart::open(page, "overview", "before-after").await?;
        let pressed = async || {
            chart.js("return [...chart.querySelectorAll('.legend button')].map(b => b.ariaPressed)").await
        };
        assert_eq!(pressed().await?, json!(["true", "true", "true"]));
        for key in ["before", "after-p95"] {
            page.click(&format!("#chart-before-after .legend [data-key={key}]")).await?;
            chart.wait_for(&format!("!chart.querySelector('svg.plot [data-key={key}]')")).await?;
        }
        assert_eq!(pressed().await?, json!(["false", "true", "false"]));
        // The axis follows the remaining curves: 0.042 mm instead of 1.25 mm.
        chart
            .wait_for(
                "[...chart.querySelectorAll('.axis text[text-anchor=end]')].every(t => \
                 /^0$|^0\\.0\\d/.test(t.textContent))",
            )
            .await?;
        chart.hover(0.5).await?;
        assert_eq!(chart.values().await?.len(), 2, "time and the series that is left");
        // By keyboard: the legend is one tab stop, arrows move within it, Shift shows one curve
        // alone, and then all again.
        page.js("document.querySelector('#chart-before-after .legend [data-key=after]').focus()").await?;
        page.press(char::from(Key::Left)).await?;
        let shift_enter =
            format!("{}{}{}", char::from(Key::Shift), char::from(Key::Enter), char::from(Key::Null));
        page.press(&shift_enter).await?;
        chart.wait_for("chart.querySelector('svg.plot [data-key=before]') && !chart.querySelector('svg.plot [data-key=after]')").await?;
        assert_eq!(pressed().await?, json!(["true", "false", "false"]));
        page.press(&shift_enter).await?;
        chart.wait_for("chart.querySelectorAll('svg.plot [data-key]').length === 3").await
    })
}

fn holds(csv: &str, head: &str, columns: &[Vec<f64>]) -> Result {
    let mut rows = csv.lines();
    assert_eq!(rows.next(), Some(head));
    assert_eq!(csv.lines().count(), columns[0].len() + 1);
    for (k, row) in rows.enumerate() {
        for (cell, column) in row.split(',').zip(columns) {
            assert_eq!(cell.parse::<f64>()?.to_bits(), column[k].to_bits(), "row {k}");
        }
    }
    Ok(())
}

#[test]
fn charts_are_taken_away_as_drawing_picture_and_values() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let report = run(&[]);
        let chart = Chart::open(page, "overview", "before-after").await?;
        let save = async |place: usize| -> Result {
            chart.tool("Save the chart").await?;
            page.click(&format!("#chart-before-after .menu button:nth-child({place})")).await
        };
        save(3).await?;
        let keys = ["time_s", "contour_error_mm", "after_contour_error_mm", "after_p95_mm"];
        let columns = keys.map(|key| column(&report, key));
        let head = "time_s,before_mm,after_mm,after_p95_mm";
        holds(&page.downloaded("armill-before-after.csv").await?, head, &columns)?;
        save(1).await?;
        let svg = page.downloaded("armill-before-after.svg").await?;
        for part in [
            ">Contour error before and after compensation</text>",
            ">Before</text>",
            ">After</text>",
            ">Time, s</text>",
            ">Contour error, mm</text>",
            "font-family=",
            "stroke=\"rgb(",
        ] {
            assert!(svg.contains(part), "{part} is missing");
        }
        for part in ["currentColor", "var(--", "class=", "style="] {
            assert!(!svg.contains(part), "{part} needs the page");
        }
        save(2).await?;
        let png = page.downloaded_bytes("armill-before-after.png").await?;
        let number = |from: usize| u32::from_be_bytes(png[from..from + 4].try_into().unwrap());
        assert_eq!(&png[1..4], b"PNG");
        let width = chart.js("return chart.querySelector('svg.plot').clientWidth").await?.as_u64().unwrap();
        assert!(
            u64::from(number(16)) >= 2 * width && number(20) > 400,
            "twice the size: {} x {}",
            number(16),
            number(20)
        );
        Ok(())
    })
}

#[test]
fn units_are_chosen_for_axes_values_and_files() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let chart = Chart::open(page, "forces", "force").await?;
        let native = armill::chart::data(
            &run(&[]),
            "force",
            armill::chart::Units { force: armill::chart::ForceUnit::PoundForce, ..Default::default() },
            armill::chart::Over::Time,
        )?;
        page.with_module(
            "page/settings",
            "({ choose }) => { choose('force', 'lbf'); choose('length', 'inch'); }",
        )
        .await?;
        chart.wait_for("chart.querySelector('svg.plot').textContent.includes('Force, lbf')").await?;
        let ticks = chart
            .js("return [...chart.querySelectorAll('.axis text[text-anchor=end]')].map(t => t.textContent)")
            .await?;
        assert!(ticks.as_array().unwrap().contains(&json!("200")), "round in lbf: {ticks}");
        chart.hover(0.4).await?;
        let values = chart.values().await?;
        let sample = native[0].values.iter().position(|t| *t == values[0]).unwrap();
        assert_eq!(values[1..], [1, 2, 3].map(|i| native[i].values[sample]));
        assert!(
            chart
                .js("return chart.querySelector('.readout').textContent")
                .await?
                .as_str()
                .unwrap()
                .contains("lbf")
        );
        chart.tool("Save the chart").await?;
        page.click("#chart-force .menu button:nth-child(3)").await?;
        let all: Vec<_> = native.iter().map(|column| column.values.clone()).collect();
        holds(&page.downloaded("armill-force.csv").await?, "time_s,x_lbf,y_lbf,z_lbf", &all)?;
        let error = Chart::open(page, "error", "error-shaping").await?;
        assert!(
            error
                .js("return chart.querySelector('svg.plot').textContent")
                .await?
                .as_str()
                .unwrap()
                .contains("Contour error, inch")
        );
        page.with_module("page/settings", "({ choose }) => choose('length', 'mm')").await?;
        error.wait_for("chart.querySelector('svg.plot').textContent.includes('Contour error, mm')").await
    })
}

#[test]
fn a_table_stands_for_the_chart() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let report = run(&[]);
        for (view, name, key) in
            [("error", "error-shaping", "shaping_contour_error_mm"), ("path", "path", "desired_x_mm")]
        {
            let chart = Chart::open(page, view, name).await?;
            let height = chart.js("return chart.offsetHeight").await?;
            chart.tool("Table").await?;
            chart
                .wait_for(
                    "chart.querySelector('tbody tr') && !chart.querySelector('.drawing').checkVisibility()",
                )
                .await?;
            assert_eq!(chart.js("return chart.offsetHeight").await?, height, "nothing moves");
            assert!(
                chart
                    .js("return chart.querySelector('caption').textContent")
                    .await?
                    .as_str()
                    .unwrap()
                    .contains("samples")
            );
            let head =
                chart.js("return [...chart.querySelectorAll('thead th')].map(th => th.textContent)").await?;
            assert_eq!(head[0], "Time s");
            let cells = chart
                .js("return [...chart.querySelectorAll('tbody tr')].map(tr => tr.cells[1].dataset.value)")
                .await?;
            let cells: Vec<String> = serde_json::from_value(cells)?;
            let values =
                cells.iter().map(|cell| cell.parse::<f64>()).collect::<std::result::Result<Vec<_>, _>>()?;
            let native = column(&report, key);
            assert!((10..40).contains(&values.len()));
            assert!(values.iter().all(|value| native.contains(value)), "samples");
            for extreme in [f64::max, f64::min] {
                let found = native.iter().copied().reduce(extreme).unwrap();
                assert!(values.contains(&found), "{found} is missing");
            }
            chart.tool("Table").await?;
            chart
                .wait_for(
                    "chart.querySelector('.drawing').checkVisibility() && \
                     !chart.querySelector('.chart-table').checkVisibility()",
                )
                .await?;
        }
        Ok(())
    })
}

/// The chart as the native core draws it, at the size it has on the page.
async fn native(
    chart: &Chart<'_>,
    report: &Report,
    name: &str,
    how: ChartOptions,
) -> Result<armill::chart::Chart> {
    let size = chart
        .js("const plot = chart.querySelector('svg.plot'); \
             return [Number(plot.getAttribute('width')), Number(plot.getAttribute('height'))]")
        .await?;
    let [width, height]: [f64; 2] = serde_json::from_value(size)?;
    Ok(armill::chart::chart(report, name, &ChartOptions { width, height, ..how })?)
}

#[test]
fn a_chart_is_read_by_decades_or_in_even_steps() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let report = run(&[]);
        let chart = Chart::open(page, "error", "after-shaping").await?;
        let pressed = "chart.querySelector('[aria-label=\"log scale\"]').ariaPressed";
        // After is far below before, so it starts by decades, the same as natively.
        chart.wait_for(&format!("{pressed} === 'true'")).await?;
        let auto = ChartOptions { scaling: Some(Scaling::Auto), ..ChartOptions::sized(700.0, 300.0) };
        let drawn = native(&chart, &report, "after-shaping", auto).await?;
        let points =
            |svg: &str| svg.split("data-key=\"after\"").nth(1).unwrap().split('"').nth(9).map(String::from);
        let shown = chart.js("return chart.querySelector('svg.plot').outerHTML").await?;
        assert!(points(&drawn.svg).is_some_and(|points| shown.as_str().unwrap().contains(&points)));
        let caption = "return chart.querySelector('figcaption').textContent";
        let caption: String = serde_json::from_value(chart.js(caption).await?)?;
        assert!(caption.contains("drawn at 0.0001"), "{caption}");
        // The cursor's marks stand on the curves, also where an error is zero.
        chart.hover(0.001).await?;
        chart.wait_for("chart.querySelectorAll('.marks circle').length === 2").await?;
        chart.tool("log scale").await?;
        chart.wait_for("[...chart.querySelectorAll('.axis text')].some(t => t.textContent === '0')").await?;
        // It is remembered for each chart, and for no other with the same curves.
        let overview = Chart::open(page, "overview", "before-after").await?;
        overview.wait_for(&format!("{pressed} === 'false'")).await?;
        overview.tool("log scale").await?;
        page.reload().await?;
        current(page).await?;
        let overview = Chart::open(page, "overview", "before-after").await?;
        overview.wait_for(&format!("{pressed} === 'true'")).await?;
        let chart = Chart::open(page, "error", "after-shaping").await?;
        chart.wait_for(&format!("{pressed} === 'false'")).await?;
        let other = Chart { page, css: "#chart-after-both".into() };
        other.wait_for(&format!("{pressed} === 'false'")).await?;
        // What can be negative has no such scale.
        let force = Chart::open(page, "forces", "force").await?;
        let hidden = "return chart.querySelector('[aria-label=\"log scale\"]').hidden";
        assert_eq!(force.js(hidden).await?, true);
        Ok(())
    })
}

/// Chooses what the charts are drawn over.
async fn over(chart: &Chart<'_>, axis: &str) -> Result {
    chart
        .js(&format!(
            "chart.querySelector('[aria-label^=\"Drawn over\"]').click(); \
         [...chart.querySelectorAll('.menu button')].find(b => b.textContent.startsWith('{axis}')).click()"
        ))
        .await
        .map(|_| ())
}

#[test]
fn charts_are_drawn_over_time_length_or_line() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let text = "G21 G90\nG0 X600 Y-60 Z100\nG1 Y20 F1200\nG4 P0.5\nG1 X640 Y60\nM30";
        page.choose("#path-kind", "gcode").await?;
        page.type_into("#path-text", text).await?;
        current(page).await?;
        let report = run(&[("path", json!({ "kind": "gcode", "text": text }))]);
        shows(page, &report).await?;
        let chart = Chart::open(page, "error", "combined").await?;
        // Zoom and cursor in time ...
        chart.drag((0.25, 0.5), (0.5, 0.52)).await?;
        chart.wait_for("chart.classList.contains('zoomed')").await?;
        chart.hover(0.5).await?;
        page.js("return new Promise(done => setTimeout(done, 300))").await?;
        let place = chart.at(0.5, 0.5).await?;
        chart.mouse("mousePressed", place, json!({ "button": "left", "clickCount": 1 })).await?;
        chart.mouse("mouseReleased", place, json!({ "button": "left", "clickCount": 1 })).await?;
        chart.wait_for("chart.querySelector('.readout b')").await?;
        let time = chart.values().await?[0];
        let sample = column(&report, "time_s").iter().position(|t| t.to_bits() == time.to_bits()).unwrap();
        // ... are the same samples over the path, in every chart.
        over(&chart, "Length").await?;
        chart.wait_for("chart.querySelector('svg.plot').textContent.includes('Path length, mm')").await?;
        let at = column(&report, "arc_length_mm")[sample];
        let there = format!("chart.querySelector('.readout b')?.dataset.value === '{at}'");
        chart.wait_for(&there).await?;
        let other = Chart { page, css: "#chart-error-shaping".into() };
        other.wait_for(&there).await?;
        other.wait_for("chart.classList.contains('zoomed')").await?;
        let ends = "const d = chart.querySelector('.drawing'); return [Number(d.ariaValueMin), Number(d.ariaValueMax)]";
        let [from, to]: [f64; 2] = serde_json::from_value(other.js(ends).await?)?;
        let length = column(&report, "arc_length_mm");
        let duration = report.duration();
        let near = |share: f64| length[(share * duration / 0.001).round() as usize];
        // A drag ends within a pixel or two, of about 400.
        assert!((from - near(0.25)).abs() < 1.0 && (to - near(0.5)).abs() < 1.0, "{from} to {to}");
        // Lines have whole numbers, read as those.
        over(&chart, "Line").await?;
        chart.tool("Show all").await?;
        chart.wait_for("chart.querySelector('svg.plot').textContent.includes('Program line')").await?;
        chart.wait_for("!chart.classList.contains('zoomed')").await?;
        assert!(chart.ticks().await?.iter().all(|tick| tick.fract() == 0.0));
        let read = "return chart.querySelector('.readout b').textContent";
        chart.hover(0.9).await?;
        assert_eq!(chart.js(read).await?, "5");
        // A shape has no lines: the charts are over time again, as nothing else was asked of them.
        page.choose("#path-kind", "circle").await?;
        current(page).await?;
        chart.wait_for("chart.querySelector('svg.plot').textContent.includes('Time, s')").await
    })
}

#[test]
fn a_stretch_is_selected_and_read() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let report = run(&[]);
        let chart = Chart::open(page, "error", "after-both").await?;
        chart.tool("Select a stretch by dragging").await?;
        chart.drag((0.2, 0.5), (0.6, 0.5)).await?;
        chart.wait_for("chart.querySelectorAll('.stretch tbody tr').length === 3").await?;
        let range = page.with_module("page/stretch", "({ stretch }) => stretch()").await?;
        let [from, to]: [f64; 2] = serde_json::from_value(range)?;
        let time = column(&report, "time_s");
        let at = |end: f64| time.iter().position(|t| t.to_bits() == end.to_bits()).unwrap();
        let cells = chart
            .js("return [...chart.querySelectorAll('.stretch tbody td')].map(td => Number(td.dataset.value))")
            .await?;
        let cells: Vec<f64> = serde_json::from_value(cells)?;
        for (k, key) in ["contour_error_mm", "after_contour_error_mm", "after_p95_mm"].into_iter().enumerate()
        {
            let values = &column(&report, key)[at(from)..=at(to)];
            let [mean, max, rms, p95] = cells[4 * k..4 * k + 4] else { panic!("{cells:?}") };
            let near = |a: f64, b: f64| (a - b).abs() <= 1e-12 * b.abs(); // sums in another order
            let count = values.len() as f64;
            assert!(near(mean, values.iter().sum::<f64>() / count), "{key}");
            assert_eq!(max, values.iter().copied().fold(f64::MIN, f64::max), "{key}");
            assert!(near(rms * rms, values.iter().map(|v| v * v).sum::<f64>() / count), "{key}");
            // By counting: 95 % are at most that, but for the one it lies between.
            let below = values.iter().filter(|v| **v <= p95).count() as f64;
            assert!((below - 0.95 * count).abs() <= 1.0, "{key}: {below} of {count}");
        }
        let lengths = column(&report, "arc_length_mm");
        let along = lengths[at(to)] - lengths[at(from)];
        let said: String =
            serde_json::from_value(chart.js("return chart.querySelector('.stretch p').textContent").await?)?;
        assert!(said.contains(&format!("{along:.1} mm of the path")), "{said}, {along}");
        // The other charts mark the same stretch, and a plain drag does not zoom meanwhile.
        let other = Chart { page, css: "#chart-combined".into() };
        other.wait_for("chart.querySelector('.marks .selected.on')").await?;
        assert_eq!(chart.js("return chart.classList.contains('zoomed')").await?, false);
        chart.js("chart.querySelector('.stretch header button:last-child').click()").await?;
        other.wait_for("!chart.querySelector('.marks .selected.on')").await?;
        // By keys: S at both ends.
        chart.js("chart.querySelector('.drawing').focus()").await?;
        page.press(char::from(Key::Home)).await?;
        chart.wait_for("chart.querySelector('.readout b').dataset.value === '0'").await?;
        page.press("s").await?;
        page.press(char::from(Key::End)).await?;
        page.press("s").await?;
        chart.wait_for("chart.querySelectorAll('.stretch tbody tr').length === 3 && !chart.querySelector('.stretch').hidden").await?;
        let all = page.with_module("page/stretch", "({ stretch }) => stretch()").await?;
        let all: [f64; 2] = serde_json::from_value(all)?;
        assert_eq!(all, [0.0, time[time.len() - 1]]);
        page.press(char::from(Key::Escape)).await?;
        chart.wait_for("chart.querySelector('.stretch').hidden").await
    })
}
