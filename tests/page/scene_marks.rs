//! What the picture in space marks: the worst place, joints out of range, the tolerance, the arm that must not hide
//! the path; and how it looks in panes of other sizes and in the other theme.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]

use crate::browser::{DESKTOP, Page, Result, THESIS, visit};
use crate::common::program::opened_example;
use crate::common::{column, run};
use crate::{current, shows};
use armill::Report;
use serde_json::{Value, json};

/// Opens the view and waits for the first picture.
async fn open(page: &Page) -> Result {
    current(page).await?;
    page.js("document.getElementById('tab-path').click()").await?;
    page.wait_for("document.querySelector('#scene').dataset.sample === '0'", 30.0).await
}

/// Opens the picture of an example that brings its stock, with the part in it.
async fn open_part(page: &Page, example: &str) -> Result<Report> {
    open(page).await?;
    page.js("document.getElementById('group-path').open = true").await?;
    page.choose("#examples", example).await?;
    page.wait_for("document.querySelector('#scene').dataset.part === 'before'", 60.0).await?;
    let report = run(&opened_example(example));
    shows(page, &report).await?;
    Ok(report)
}

async fn click(page: &Page, css: &str) -> Result {
    page.js(&format!("document.querySelector('#scene {css}').click()")).await.map(|_| ())
}

/// A value that the scene reports.
async fn data(page: &Page, key: &str) -> Result<String> {
    let value = page.js(&format!("return document.querySelector('#scene').dataset['{key}']")).await?;
    Ok(value.as_str().ok_or(format!("the scene reports no {key}"))?.to_owned())
}

/// How many pixels of the canvas hold for an expression of `r`, `g`, `b` and `a`, in the frame that a click leads to.
async fn pixels(page: &Page, css: &str, holds: &str) -> Result<u64> {
    let count = page
        .js(&format!(
            "document.querySelector('#scene {css}').click();
             return new Promise(done => requestAnimationFrame(() => {{
               const canvas = document.querySelector('#scene canvas');
               const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
               copy.drawImage(canvas, 0, 0);
               const {{ data }} = copy.getImageData(0, 0, canvas.width, canvas.height);
               let count = 0;
               for (let i = 0; i < data.length; i += 4) {{
                 const [r, g, b, a] = data.subarray(i, i + 4);
                 if ({holds}) count++;
               }}
               done(count);
             }}))"
        ))
        .await?;
    count.as_u64().ok_or_else(|| "no picture".into())
}

/// Colours of the scale, also through something faint.
const COLOURED: &str = "Math.max(r, g, b) - Math.min(r, g, b) > 60";

#[test]
fn the_worst_place_is_named_and_leads_the_cursor_there() -> Result {
    for example in [None, Some("pocket.nc")] {
        visit(THESIS, DESKTOP, async |page| {
            let report = match example {
                None => {
                    open(page).await?;
                    run(&[])
                }
                Some(example) => open_part(page, example).await?,
            };
            let errors = column(&report, "contour_error_mm");
            let cuts = &report.plan.trajectory.timing.engaged;
            let worst = (0..report.samples())
                .filter(|&k| cuts[k] > 0.0)
                .max_by(|&a, &b| errors[a].total_cmp(&errors[b]))
                .ok_or("nothing cuts")?;
            let marked: usize = data(page, "worst").await?.parse()?;
            assert_eq!(errors[marked], errors[worst], "{marked} is not as bad as {worst}");
            let words = page.text("#scene .worst").await?;
            let (size, place) = words.split_once(", ").ok_or(words.clone())?;
            let size: f64 = size.trim_end_matches(" mm").parse()?;
            // Written to three digits.
            assert!((size - errors[worst]).abs() <= 0.006 * errors[worst], "{words}, not {}", errors[worst]);
            let expected = match example {
                None => format!("{:.2} s", marked as f64 * report.plan.trajectory.sample_time),
                Some(_) => format!("line {}", column(&report, "program_line")[marked]),
            };
            assert_eq!(place, expected);
            // The mark is there, in the last colour of the scale: rgb(207, 122, 0).
            let place = data(page, "worstAt").await?;
            let [x, y] = [0, 1].map(|i| place.split(' ').nth(i).unwrap_or_default());
            let mark = format!(
                "Math.hypot((i / 4) % canvas.width - {x}, Math.floor(i / 4 / canvas.width) - {y}) < 3 \
                 && Math.abs(r - 207) < 8 && Math.abs(g - 122) < 8 && b < 8"
            );
            let drawn = pixels(page, "[data-view=fit]", &mark).await?;
            assert!((12..=36).contains(&drawn), "{drawn} of about 28 pixels at {place}");
            click(page, ".worst").await?;
            page.wait_for(&format!("document.querySelector('#scene').dataset.sample === '{marked}'"), 5.0)
                .await?;
            // What is not shown has no worst place.
            click(page, "[data-path=actual]").await?;
            page.wait_for("document.querySelector('#scene .worst').hidden", 5.0).await?;
            click(page, "[data-path=after]").await?;
            page.wait_for("!document.querySelector('#scene .worst').hidden", 5.0).await
        })?;
    }
    Ok(())
}

#[test]
fn a_joint_is_red_where_it_is_out_of_its_range() -> Result {
    // Around its own base the arm turns joints 1 and 3 too far, on a part of the way.
    let report = run(&[]);
    visit(THESIS, DESKTOP, async |page| {
        open(page).await?;
        for path in ["desired", "actual", "compensated"] {
            click(page, &format!("[data-path={path}]")).await?;
        }
        let beyond = |k: usize| -> Vec<usize> {
            let excess = report.joint_excess(k).into_iter().flatten().enumerate();
            excess.filter(|(_, angle)| *angle > 0.0).map(|(i, _)| i + 1).collect()
        };
        let count = report.samples();
        let inside = (0..count).find(|&k| beyond(k).is_empty()).ok_or("never inside")?;
        let outside = (0..count).find(|&k| !beyond(k).is_empty()).ok_or("never outside")?;
        for k in [inside, outside] {
            let time = k as f64 * report.plan.trajectory.sample_time;
            page.with_module("page/cursor", &format!("({{ setCursor }}) => setCursor({time}, 'test')"))
                .await?;
            page.wait_for(&format!("document.querySelector('#scene').dataset.sample === '{k}'"), 5.0).await?;
            let named = beyond(k).iter().map(usize::to_string).collect::<Vec<_>>().join(" ");
            page.wait_for(&format!("document.querySelector('#scene').dataset.beyond === '{named}'"), 5.0)
                .await?;
            let red = pixels(page, "[data-view=all]", "r > 90 && r > 2 * g && r > 2 * b").await?;
            assert_eq!(red > 30, k == outside, "{red} red pixels at {k}: {named:?}");
            let said = page.js("return document.querySelector('#scene .beyond').checkVisibility()").await?;
            assert_eq!(said, k == outside);
        }
        Ok(())
    })
}

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn from_above_the_arm_does_not_hide_the_path() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        open_part(page, "pocket.nc").await?;
        click(page, "[data-path=solid]").await?;
        for view in ["top", "tool"] {
            let seen = pixels(page, &format!("[data-view={view}]"), COLOURED).await?;
            assert_eq!(data(page, "elevation").await?, "90.00", "the tool axis is upright");
            let bare = pixels(page, "[data-path=arm]", COLOURED).await?;
            // 15 % of the arm over it takes less than a tenth of the pixels out of what counts as coloured.
            assert!(bare > 500 && 10 * seen > 9 * bare, "{view}: {seen} of {bare}");
            click(page, "[data-path=arm]").await?;
        }
        // Where one looks from a side and the arm covers nothing it is solid: much of the picture is the arm's.
        click(page, "[data-view=iso]").await?;
        let dark = "Math.max(r, g, b) < 150 && Math.max(r, g, b) - Math.min(r, g, b) < 30";
        let with = pixels(page, "[data-view=all]", dark).await?;
        let without = pixels(page, "[data-path=arm]", dark).await?;
        assert!(with > without + 1000, "{with} {without}");
        Ok(())
    })
}

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn the_tolerance_is_drawn_on_request_and_leaves_the_passes_in_sight() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        open_part(page, "pocket.nc").await?;
        assert_eq!(data(page, "tube").await?, "0.000", "off for a program");
        let ink = "Math.max(r, g, b) < 235";
        page.choose("#scene .stated select", "100").await?;
        for path in ["desired", "actual", "compensated"] {
            click(page, &format!("[data-path={path}]")).await?;
        }
        let bare = pixels(page, "[data-path=solid]", ink).await?;
        let full = pixels(page, "[data-path=tube]", ink).await?;
        assert!(full > bare + 1000, "{full} {bare}");
        let radius: f64 = data(page, "tube").await?.parse()?;
        // Magnified 100 times a tolerance of 0.01 mm is a tube 2 mm wide; the pocket's levels are no farther apart than
        // that, so it is half as wide.
        assert!((radius - 0.5).abs() < 0.01, "{radius}");
        assert_eq!(pixels(page, "[data-path=tube]", ink).await?, bare);

        // Passes of a zigzag are as far apart as it says; the one pass of a circle is far from itself;
        // a rapid move parts two.
        let spacing = async |points: Value| {
            page.with_module("scene/spacing", &format!("({{ spacingOf }}) => String(spacingOf({points}))"))
                .await
        };
        let zigzag: Vec<[f64; 3]> = (0..10)
            .flat_map(|row| {
                let y = 3.0 * f64::from(row);
                let along = (0..=40).map(move |i| [2.0 * f64::from(i), y, 0.0]);
                if row % 2 == 0 { along.collect::<Vec<_>>() } else { along.rev().collect() }
            })
            .collect();
        assert_eq!(spacing(json!(zigzag)).await?, "3");
        let circle: Vec<[f64; 3]> = (0..100)
            .map(|i| std::f64::consts::TAU * f64::from(i) / 100.0)
            .map(|angle| [50.0 * angle.cos(), 50.0 * angle.sin(), 0.0])
            .collect();
        // A circle comes near itself only where it closes.
        let alone: f64 = spacing(json!(circle)).await?.as_str().ok_or("no number")?.parse()?;
        assert!(alone >= 50.0, "{alone}");
        let parted = json!([[0, 0, 0], [50, 0, 0], [100, 0, 0], null, [100, 4, 0], [50, 4, 0], [0, 4, 0]]);
        assert_eq!(spacing(parted).await?, "4");
        Ok(())
    })
}

#[test]
fn the_scale_of_errors_stands_out_from_light_and_dark_paper() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        open(page).await?;
        let surface = "getComputedStyle(document.querySelector('#scene .stage')).backgroundColor";
        let mut seen = Vec::new();
        for dark in [false, true] {
            page.prefer_dark(dark).await?;
            // The paper of the picture is the page's in the very next frame: at its upper right corner.
            let same = page
                .js(&format!(
                    "document.querySelector('#scene [data-view=fit]').click();
                     return new Promise(done => requestAnimationFrame(() => {{
                       const canvas = document.querySelector('#scene canvas');
                       const copy = new OffscreenCanvas(1, 1).getContext('2d');
                       copy.drawImage(canvas, canvas.width - 1, 0, 1, 1, 0, 0, 1, 1);
                       const [r, g, b] = copy.getImageData(0, 0, 1, 1).data;
                       done({surface} === `rgb(${{r}}, ${{g}}, ${{b}})`);
                     }}))"
                ))
                .await?;
            assert_eq!(same, true, "dark: {dark}");
            let paper = page.js(&format!("return {surface}")).await?;
            // Contrast as WCAG 2.2 defines it; 1.4.11 wants 3 for what is to be told apart.
            let least = page
                .with_module(
                    "scene/ramp",
                    &format!(
                        "({{ colour }}) => {{
                           const linear = (v) => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
                           const light = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
                           const paper = light({paper}.match(/\\d+/g).map(Number));
                           const ratio = (own) => (Math.max(own, paper) + 0.05) / (Math.min(own, paper) + 0.05);
                           return Math.min(...Array.from({{ length: 101 }}, (_, i) => ratio(light(colour(i / 100)))));
                         }}"
                    ),
                )
                .await?;
            assert!(least.as_f64() >= Some(3.0), "{least} on {paper}");
            seen.push(paper);
        }
        assert_ne!(seen[0], seen[1]);
        let opaque = page
            .js("return document.querySelector('#scene canvas').getContext('webgl2').getContextAttributes().alpha")
            .await?;
        assert_eq!(opaque, true, "before its first picture a canvas without alpha is black");
        Ok(())
    })
}

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn it_fits_small_and_large_panes() -> Result {
    visit(THESIS, (1280, 900), async |page| {
        open_part(page, "pocket.nc").await?;
        for (width, height) in [(900, 500), (470, 400), (360, 300), (300, 260)] {
            page.js(&format!(
                "const scene = document.querySelector('#scene');
                 document.body.append(scene);
                 for (const [key, value] of Object.entries({{ position: 'fixed', inset: '0 auto auto 0', margin: 0, \
                   width: '{width}px', height: '{height}px' }})) scene.style.setProperty(key, value);"
            ))
            .await?;
            page.wait_for(
                &format!(
                    "Math.abs(document.querySelector('#scene canvas').width - {width} * devicePixelRatio) < 30"
                ),
                10.0,
            )
            .await?;
            click(page, "[data-view=iso]").await?;
            page.js("return new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
                .await?;
            let faults = page
                .js("const scene = document.querySelector('#scene'), whole = scene.getBoundingClientRect();
                     const box = (node) => node.getBoundingClientRect();
                     const visible = (css) => [...scene.querySelectorAll(css)].filter(node => node.checkVisibility());
                     const name = (node) => `${node.className || node.tagName} ${node.textContent}`;
                     const faults = [];
                     const bar = visible('header .sides, header .more');
                     if (new Set(bar.map(node => Math.round(box(node).top))).size > 1) faults.push('the toolbar wraps');
                     for (const node of visible('header button, .player > *, .stage .worst, .stage .scale, .stage select, .as-cut'))
                       if (box(node).left < whole.left || box(node).right > whole.right || box(node).bottom > whole.bottom)
                         faults.push(`${name(node)} leaves the pane`);
                     for (const node of visible('.scale p, .read, .player .time, .deviations p'))
                       if (node.scrollWidth > node.clientWidth + 1) faults.push(`${name(node)} is cut off`);
                     const labels = visible('.labels span, .worst, .stated, .floor, .scale, .part-corner, .beyond');
                     labels.forEach((a, i) => labels.slice(i + 1).forEach(b => {
                       const [p, q] = [box(a), box(b)];
                       if (p.left < q.right - 1 && q.left < p.right - 1 && p.top < q.bottom - 1 && q.top < p.bottom - 1)
                         faults.push(`${name(a)} lies on ${name(b)}`);
                     }));
                     if (box(scene.querySelector('canvas')).height < 120) faults.push('the picture is too low');
                     return faults")
                .await?;
            assert_eq!(faults, json!([]), "{width} by {height}");
        }
        Ok(())
    })
}

#[test]
fn a_stream_of_results_is_taken_over_at_its_pace() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        open(page).await?;
        let calls = page
            .with_module(
                "scene/pace",
                "({ paced }) => new Promise(done => {
                   const seen = [];
                   let state;
                   const take = paced(() => { seen.push(state); if (seen.length > 1) done(seen); }, 60);
                   for (state = 0; state < 50; state++) take();
                   state = 'last';
                 })",
            )
            .await?;
        assert_eq!(calls, json!([0, "last"]), "the first at once, and the last");
        Ok(())
    })
}
