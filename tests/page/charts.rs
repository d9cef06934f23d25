//! The charts in a real browser: read, zoomed, filtered and taken away as a person does; values against native runs, bit for bit.

use crate::browser::{DESKTOP, Key, PHONE, Page, Result, visit};
use crate::common::run;
use crate::current;
use armill::Report;
use serde_json::{Value, json};

/// Keys of Chrome's input events.
const CONTROL: u32 = 2;

/// The numbers at the ticks below the plot of `chart`.
const TICKS: &str = "[...chart.querySelectorAll('svg.plot .axis text[text-anchor=middle]')].map(t => Number(t.textContent.replace('\u{2212}', '-'))).filter(Number.isFinite)";

/// A chart on the page.
struct Chart<'a> {
    page: &'a Page,
    css: String,
}

impl<'a> Chart<'a> {
    /// The chart of a view, drawn and in sight.
    async fn open(page: &'a Page, view: &str, name: &str) -> Result<Self> {
        page.js(&format!("document.getElementById('tab-{view}').click()")).await?;
        let chart = Self { page, css: format!("#chart-{name}") };
        let drawn = format!(
            "[...document.querySelectorAll('#panel-{view} .chart-figure')].every(f => f.querySelector('svg.plot')) && document.querySelector('{}')",
            chart.css
        );
        page.wait_for(&drawn, 30.0).await?;
        chart.show().await?;
        Ok(chart)
    }

    async fn show(&self) -> Result {
        let scroll = "scrollIntoView({ block: 'center', behavior: 'instant' })";
        self.page.js(&format!("document.querySelector('{}').{scroll}", self.css)).await.map(|_| ())
    }

    /// Runs a function body with `chart` as the figure.
    async fn js(&self, body: &str) -> Result<Value> {
        self.page.js(&format!("const chart = document.querySelector('{}'); {body}", self.css)).await
    }

    async fn wait_for(&self, condition: &str) -> Result {
        let there = format!(
            "(() => {{ const chart = document.querySelector('{}'); return {condition}; }})()",
            self.css
        );
        self.page.wait_for(&there, 10.0).await
    }

    /// A place on the page [px] by fractions of the plot, from left and from top.
    async fn at(&self, across: f64, down: f64) -> Result<(f64, f64)> {
        let plot = "chart.querySelector('svg.plot clipPath rect').getBBox()";
        let place = self
            .js(&format!(
                "const p = {plot}, d = chart.querySelector('.drawing').getBoundingClientRect(); return [d.left + p.x + 4 + {across} * (p.width - 8), d.top + p.y + 4 + {down} * (p.height - 8)]"
            ))
            .await?;
        Ok(serde_json::from_value(place)?)
    }

    async fn mouse(&self, kind: &str, (x, y): (f64, f64), more: Value) -> Result {
        let mut event = json!({ "type": kind, "x": x, "y": y });
        event.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        self.page.devtools("Input.dispatchMouseEvent", event).await.map(|_| ())
    }

    async fn hover(&self, across: f64) -> Result {
        self.mouse("mouseMoved", self.at(across, 0.5).await?, json!({})).await?;
        self.wait_for("chart.querySelector('.readout b')").await
    }

    async fn drag(&self, from: (f64, f64), to: (f64, f64)) -> Result {
        let (from, to) = (self.at(from.0, from.1).await?, self.at(to.0, to.1).await?);
        self.mouse("mousePressed", from, json!({ "button": "left", "buttons": 1, "clickCount": 1 })).await?;
        for step in 1..=4 {
            let share = f64::from(step) / 4.0;
            let place = (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
            self.mouse("mouseMoved", place, json!({ "button": "left", "buttons": 1 })).await?;
        }
        self.mouse("mouseReleased", to, json!({ "button": "left", "clickCount": 1 })).await
    }

    async fn double_click(&self) -> Result {
        let place = self.at(0.5, 0.5).await?;
        for count in [1, 2] {
            for kind in ["mousePressed", "mouseReleased"] {
                self.mouse(kind, place, json!({ "button": "left", "clickCount": count })).await?;
            }
        }
        Ok(())
    }

    /// Presses a button of the chart's tools.
    async fn tool(&self, label: &str) -> Result {
        self.js(&format!("chart.querySelector('[aria-label=\"{label}\"]').click()")).await.map(|_| ())
    }

    /// The full values that the readout shows: first the one along x.
    async fn values(&self) -> Result<Vec<f64>> {
        let values =
            self.js("return [...chart.querySelectorAll('.readout b')].map(b => b.dataset.value)").await?;
        let texts: Vec<String> = serde_json::from_value(values)?;
        Ok(texts.iter().map(|text| text.parse()).collect::<std::result::Result<_, _>>()?)
    }

    /// The numbers at the ticks below the plot.
    async fn ticks(&self) -> Result<Vec<f64>> {
        let ticks = self.js(&format!("return {TICKS}")).await?;
        Ok(serde_json::from_value(ticks)?)
    }
}

fn column(report: &Report, key: &str) -> Vec<f64> {
    report.columns().into_iter().find(|column| column.key == key).unwrap().values
}

#[test]
fn the_cursor_reads_samples_and_is_one_for_all_charts() -> Result {
    visit("/", DESKTOP, async |page| {
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
            let keys = ["contour_error_mm", "after_contour_error_mm"];
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
        // Away from the chart the cursor goes; a click makes it stay.
        chart.mouse("mouseMoved", (5.0, 5.0), json!({})).await?;
        chart.wait_for("!chart.querySelector('.readout b') && !chart.querySelector('.mark.on')").await?;
        let place = chart.at(0.5, 0.5).await?;
        chart.mouse("mousePressed", place, json!({ "button": "left", "clickCount": 1 })).await?;
        chart.mouse("mouseReleased", place, json!({ "button": "left", "clickCount": 1 })).await?;
        chart.mouse("mouseMoved", (5.0, 5.0), json!({})).await?;
        chart.wait_for("chart.querySelector('.readout b')").await?;
        // It stays in another view, and in space it is a place on each path.
        let pinned = page.with_module("cursor", "({ cursor }) => cursor()").await?;
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
fn a_box_zooms_all_charts_over_time_and_a_double_click_shows_all() -> Result {
    visit("/", DESKTOP, async |page| {
        current(page).await?;
        let chart = Chart::open(page, "error", "combined").await?;
        let other = Chart { page, css: "#chart-error-shaping".into() };
        let whole = chart.ticks().await?;
        assert_eq!(whole.last(), Some(&18.0));
        chart.drag((0.25, 0.5), (0.5, 0.52)).await?;
        chart.wait_for("chart.classList.contains('zoomed')").await?;
        let zoomed = &format!("Math.min(...{TICKS}) >= 4.5");
        chart.wait_for(zoomed).await?;
        let ticks = chart.ticks().await?;
        let duration = run(&[]).duration();
        assert!(ticks.iter().all(|t| (0.25 * duration - 0.1..0.5 * duration + 0.1).contains(t)), "{ticks:?}");
        other.wait_for(zoomed).await?;
        // Detail appears: what is read is still a sample.
        chart.hover(0.5).await?;
        let values = chart.values().await?;
        assert!((values[0] - 0.375 * duration).abs() < 0.05, "{values:?}");
        // A chart that is first looked at now has the same range.
        let joint = Chart::open(page, "joints", "joint-3").await?;
        assert!(joint.ticks().await?.iter().all(|t| (4.5..10.0).contains(t)));
        // Keys zoom in further about the cursor, and out to the whole.
        joint.js("chart.querySelector('.drawing').focus()").await?;
        page.press("+").await?;
        joint.wait_for(&format!("Math.max(...{TICKS}) < 9")).await?;
        page.press("0").await?;
        joint.wait_for("!chart.classList.contains('zoomed')").await?;
        let chart = Chart::open(page, "error", "combined").await?;
        chart.wait_for("!chart.classList.contains('zoomed')").await?;
        assert_eq!(chart.ticks().await?, whole);
        // A box of some height zooms both axes, in this chart only.
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
    visit("/", DESKTOP, async |page| {
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
        // What was under the pointer still is.
        chart.hover(0.5).await?;
        assert!((chart.values().await?[0] - 0.5 * run(&[]).duration()).abs() < 0.05);
        Ok(())
    })
}

#[test]
fn series_are_hidden_and_isolated() -> Result {
    visit("/", DESKTOP, async |page| {
        current(page).await?;
        let chart = Chart::open(page, "overview", "before-after").await?;
        let pressed = async || {
            chart.js("return [...chart.querySelectorAll('.legend button')].map(b => b.ariaPressed)").await
        };
        assert_eq!(pressed().await?, json!(["true", "true"]));
        page.click("#chart-before-after .legend [data-key=before]").await?;
        chart.wait_for("!chart.querySelector('svg.plot [data-key=before]')").await?;
        assert_eq!(pressed().await?, json!(["false", "true"]));
        // The axis follows what is left: 0.0008 mm instead of 1.25 mm.
        chart.wait_for("[...chart.querySelectorAll('.axis text[text-anchor=end]')].every(t => /^0$|10\u{207b}/u.test(t.textContent))").await?;
        chart.hover(0.5).await?;
        assert_eq!(chart.values().await?.len(), 2, "time and the series that is left");
        // By keyboard: the legend is one stop, arrows move in it, Shift shows one alone, and all again.
        page.js("document.querySelector('#chart-before-after .legend [data-key=after]').focus()").await?;
        page.press(char::from(Key::Left)).await?;
        let shift_enter =
            format!("{}{}{}", char::from(Key::Shift), char::from(Key::Enter), char::from(Key::Null));
        page.press(&shift_enter).await?;
        chart.wait_for("chart.querySelector('svg.plot [data-key=before]') && !chart.querySelector('svg.plot [data-key=after]')").await?;
        assert_eq!(pressed().await?, json!(["true", "false"]));
        page.press(&shift_enter).await?;
        chart.wait_for("chart.querySelectorAll('svg.plot [data-key]').length === 2").await
    })
}

#[test]
fn keys_move_the_cursor() -> Result {
    visit("/", DESKTOP, async |page| {
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
        let told = chart.js("return chart.querySelector('.drawing').ariaValueText").await?;
        assert!(
            told.as_str().is_some_and(|told| told.starts_with("Time 0.0") && told.contains("Shaping alone ")),
            "{told}"
        );
        page.press(char::from(Key::Escape)).await?;
        chart.wait_for("!chart.querySelector('.readout b')").await
    })
}

/// The CSV text of a chart holds exactly these columns.
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
    visit("/", DESKTOP, async |page| {
        current(page).await?;
        let report = run(&[]);
        let chart = Chart::open(page, "overview", "before-after").await?;
        let save = async |place: usize| -> Result {
            chart.tool("Save the chart").await?;
            page.click(&format!("#chart-before-after .menu button:nth-child({place})")).await
        };
        save(3).await?;
        let keys = ["time_s", "contour_error_mm", "after_contour_error_mm"];
        let columns = keys.map(|key| column(&report, key));
        holds(&page.downloaded("armill-before-after.csv").await?, "time_s,before_mm,after_mm", &columns)?;
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
    visit("/", DESKTOP, async |page| {
        current(page).await?;
        let chart = Chart::open(page, "forces", "force").await?;
        let native = armill::chart::data(
            &run(&[]),
            "force",
            armill::chart::Units { force: armill::chart::ForceUnit::PoundForce, ..Default::default() },
        )?;
        page.with_module("settings", "({ choose }) => { choose('force', 'lbf'); choose('length', 'inch'); }")
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
        page.with_module("settings", "({ choose }) => choose('length', 'mm')").await?;
        error.wait_for("chart.querySelector('svg.plot').textContent.includes('Contour error, mm')").await
    })
}

#[test]
fn a_table_stands_for_the_chart() -> Result {
    visit("/", DESKTOP, async |page| {
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
            chart.wait_for("chart.querySelector('.drawing').checkVisibility() && !chart.querySelector('.chart-table').checkVisibility()").await?;
        }
        Ok(())
    })
}

#[test]
fn two_fingers_zoom_and_one_scrolls_or_reads() -> Result {
    visit("/", PHONE, async |page| {
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
        // One finger across reads values off.
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
            .js("return Math.min(...[...chart.querySelectorAll('.chart-tools button, .legend button')].filter(b => b.checkVisibility()).map(b => b.offsetHeight))")
            .await?;
        assert!(least.as_f64().unwrap() >= 24.0, "{least}");
        let wider = page
            .js("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
            .await?;
        assert_eq!(wider, 0);
        Ok(())
    })
}

#[test]
fn cursor_and_program_line_lead_to_each_other() -> Result {
    visit("/", DESKTOP, async |page| {
        current(page).await?;
        page.choose("#path-kind", "gcode").await?;
        page.type_into("#path-text", "G21 G90\nG0 X600 Y-60 Z100\nG1 Y20 F1200\nG1 X640 Y60\nM30").await?;
        current(page).await?;
        let chart = Chart::open(page, "overview", "before-after").await?;
        // The caret in a line moves the cursor to where the line starts to run.
        page.js("const text = document.getElementById('path-text'); text.focus(); const at = text.value.indexOf('G1 X640'); text.setSelectionRange(at, at); text.dispatchEvent(new MouseEvent('click', { bubbles: true }))").await?;
        chart
            .wait_for("chart.querySelector('.readout button')?.textContent === 'line 4 of the program'")
            .await?;
        // The way back: the line under the cursor is selected where it was typed.
        chart.show().await?;
        chart.hover(0.3).await?;
        chart
            .wait_for("chart.querySelector('.readout button')?.textContent === 'line 3 of the program'")
            .await?;
        chart.js("chart.querySelector('.drawing').focus()").await?;
        page.press(char::from(Key::Enter)).await?;
        let selected = "const t = document.getElementById('path-text'); return document.activeElement === t && t.value.slice(t.selectionStart, t.selectionEnd)";
        assert_eq!(page.js(selected).await?, "G1 Y20 F1200");
        Ok(())
    })
}
