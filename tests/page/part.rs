//! The part as it is cut: its picture and section, in words, and as files; compared with native runs.

use crate::browser::{DESKTOP, Page, Result, THESIS, visit};
use crate::common::program::opened_example;
use crate::common::{job_text, run};
use crate::{current, narrow, number, shows};
use armill::Report;
use armill::report::PartKind;
use armill::surface::mesh::PartMesh;
use serde_json::{Value, json};

/// Opens an example that brings its stock.
async fn open(page: &Page, example: &str) -> Result<Report> {
    current(page).await?;
    // On a phone the inputs are folded.
    page.js("document.getElementById('inputs').classList.add('open'); \
             document.getElementById('group-path').open = true")
        .await?;
    page.choose("#examples", example).await?;
    page.wait_for("document.querySelector('#stock-kind').value !== 'none'", 20.0).await?;
    let report = run(&opened_example(example));
    shows(page, &report).await?;
    Ok(report)
}

/// Opens the picture and waits for the part in it.
async fn look(page: &Page) -> Result {
    page.wait_for("document.querySelector('#scene').dataset.part === 'before'", 60.0).await
}

/// What the canvas shows in the frame that a click leads to, as a number that hardly two pictures share, and how
/// many of its pixels are clearly blue or orange.
async fn pixels(page: &Page, click: &str) -> Result<(Value, u64)> {
    let seen = page
        .js(&format!(
            "document.querySelector('{click}').click();
             return new Promise(done => requestAnimationFrame(() => {{
               const canvas = document.querySelector('#scene canvas');
               const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
               copy.drawImage(canvas, 0, 0);
               const {{ data }} = copy.getImageData(0, 0, canvas.width, canvas.height);
               let [sum, coloured] = [0, 0];
               for (let i = 0; i < data.length; i += 4) {{
                 sum = (sum * 31 + data[i] + 256 * data[i + 1] + 65536 * data[i + 2]) % 4294967291;
                 if (Math.abs(data[i] - data[i + 2]) > 40) coloured++;
               }}
               done([sum, coloured]);
             }}))"
        ))
        .await?;
    Ok((seen[0].clone(), seen[1].as_u64().ok_or("no picture")?))
}

#[test]
fn the_picture_shows_the_part_before_and_after() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.wait_for("document.querySelector('#scene').dataset.part === 'none'", 30.0).await?;
        let hidden = "return [...document.querySelectorAll('#scene .as-cut, #scene .section-at, #scene .switch.solid')]\
             .every(part => !part.checkVisibility())";
        assert_eq!(page.js(hidden).await?, true, "without a stock there is no part");

        let report = open(page, "pocket.nc").await?;
        look(page).await?;
        let map = report.deviation_map(30_000)?;
        let data = async |key: &str| {
            page.js(&format!("return document.querySelector('#scene').dataset.{key}")).await
        };
        assert_eq!(data("triangles").await?, PartMesh::of(&map).triangles.len().to_string());
        let largest = page.js("return document.querySelector('.deviations .bar').dataset.largest").await?;
        assert_eq!(largest, (map.largest * 1e3).to_string());
        // The part alone: what is left after compensation is far paler, and magnified it is another shape.
        for path in ["desired", "actual", "compensated", "arm"] {
            page.js(&format!("document.querySelector('[data-path={path}]').click()")).await?;
        }
        let (before, coloured) = pixels(page, "[data-side=before]").await?;
        let (after, pale) = pixels(page, "[data-side=after]").await?;
        assert!(before != after && coloured > 10 * pale.max(1), "{coloured} {pale}");
        assert_eq!(data("part").await?, "after");
        let (again, _) = pixels(page, "[data-side=before]").await?;
        assert_eq!(again, before);
        page.choose("#scene .stated select", "1").await?;
        page.wait_for("document.querySelector('#scene').dataset.factor === '1'", 5.0).await?;
        assert_ne!(pixels(page, "[data-side=before]").await?.0, before);
        // Put away, it is gone; a job without a stock has none.
        let (bare, _) = pixels(page, "[data-path=solid]").await?;
        assert_ne!(bare, before);
        page.wait_for("document.querySelector('#scene').dataset.part === 'none'", 5.0).await?;
        page.js("document.getElementById('open-thesis').click()").await?;
        shows(page, &run(&[])).await?;
        assert_eq!(page.js(hidden).await?, true);
        page.wait_for("document.querySelector('#scene').dataset.triangles === '0'", 20.0).await
    })
}

#[test]
fn the_section_is_the_one_at_the_cursor_and_places_lead_there() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        let report = open(page, "pocket.nc").await?;
        let surface = report.summary().surface.ok_or("no surface")?;
        // In words: figures, places, and where they lead.
        for (id, figure) in [
            ("surface-before", surface.worst_before_mm),
            ("surface-after", surface.worst_after_mm),
            ("surface-p95", surface.after_p95_mm),
        ] {
            assert_eq!(Some(number(page, id).await?), figure, "#{id}");
        }
        page.click("#surface > summary").await?;
        let listed =
            "return [...document.querySelectorAll('#surface-list button')].map(each => each.textContent)";
        let sentences: Vec<&str> = surface.worst.iter().map(|place| place.sentence.as_str()).collect();
        assert_eq!(page.js(listed).await?, json!(sentences));

        look(page).await?;
        let at =
            |sample: usize| format!("document.querySelector('.section-at').dataset.sample === '{sample}'");
        page.wait_for(&at(surface.worst[0].sample), 30.0).await?;
        page.js("document.querySelectorAll('#surface-list button')[1].click()").await?;
        page.wait_for(&at(surface.worst[1].sample), 30.0).await?;
        page.wait_for(
            &format!("document.querySelector('#scene').dataset.sample === '{}'", surface.worst[1].sample),
            5.0,
        )
        .await?;
        // The nominal line is the core's; magnified, the others are moved by as much more.
        let map = report.deviation_map(30_000)?;
        let section = report.part_section(&map, surface.worst[1].sample);
        let first = "return document.querySelector('.cross-section .before path').getAttribute('d')\
             .slice(1).split('L').map(point => point.split(' ').map(Number))";
        for factor in [1.0, 50.0] {
            page.choose("#scene .stated select", &factor.to_string()).await?;
            page.wait_for(
                &format!("document.querySelector('.section-at').dataset.factor === '{factor}'"),
                5.0,
            )
            .await?;
            let drawn: Vec<[f64; 2]> = serde_json::from_value(page.js(first).await?)?;
            assert_eq!(drawn.len(), section.nominal.len());
            for (drawn, (nominal, moved)) in drawn.iter().zip(section.nominal.iter().zip(&section.before)) {
                for k in [0, 1] {
                    let place = -(nominal[k] + factor * moved[k]) * 1e3;
                    assert!((drawn[k] - place).abs() < 2e-3, "{} of {place}", drawn[k]);
                }
            }
        }
        Ok(())
    })
}

#[test]
fn the_part_is_taken_away_as_stl() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let offered = "return [...document.querySelectorAll('#export-format option')].filter(each => \
             !each.disabled && each.value.startsWith('part-')).map(each => each.value)";
        assert_eq!(page.js(offered).await?, json!([]), "without a stock there is no part");
        let report = open(page, "face.nc").await?;
        assert_eq!(page.js(offered).await?, json!(["part-before", "part-after", "part-nominal"]));
        for (name, kind) in
            [("before", PartKind::Before), ("after", PartKind::After), ("nominal", PartKind::Nominal)]
        {
            page.choose("#export-format", &format!("part-{name}")).await?;
            page.click("#download-program").await?;
            let file = page.downloaded_bytes(&format!("face-part-{name}.stl")).await?;
            let native = report.simulated_part(kind, None)?;
            let triangles = u32::from_le_bytes(native[80..84].try_into()?) as usize;
            assert!(triangles > 10_000 && file.len() == 84 + 50 * triangles, "{name}: {triangles}");
            assert!(file == native, "{name}");
        }
        // A job without a stock goes back to its controller.
        page.js("document.getElementById('open-thesis').click()").await?;
        shows(page, &run(&[])).await?;
        assert_eq!(page.value("#export-format").await?, "staubli");
        assert_eq!(page.js(offered).await?, json!([]));
        Ok(())
    })
}

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn with_a_part_no_panel_is_wider_than_its_screen() -> Result {
    visit(THESIS, (768, 844), async |page| {
        open(page, "pocket.nc").await?;
        look(page).await?;
        page.js("for (const part of document.querySelectorAll('details')) part.open = true").await?;
        for width in [768, 390, 335] {
            page.resize((width, 844)).await?;
            narrow(page, &width.to_string()).await?;
        }
        Ok(())
    })
}

#[test]
fn nothing_moves_when_the_part_arrives() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        open(page, "pocket.nc").await?;
        page.wait_for("document.querySelector('#chart-actual-path svg')", 20.0).await?;
        let places = "return [...document.querySelectorAll('.picture, #panel-overview .chart-figure')].map(each => \
             each.getBoundingClientRect().top + scrollY)";
        let early = page.js(places).await?;
        page.wait_for("document.querySelector('#scene').dataset.part === 'before'", 60.0).await?;
        page.wait_for("document.querySelector('.cross-section svg')", 30.0).await?;
        assert_eq!(page.js(places).await?, early);
        Ok(())
    })
}

#[test]
fn a_frame_says_what_surface_is_left_and_what_the_feed_rule_gains() -> Result {
    let mut face = opened_example("face.nc");
    face.retain(|(path, _)| *path != "shaper" && !path.starts_with("cutting."));
    face.push(("motion.feed_rule", json!("constant-force")));
    face.push(("cutting.feed_per_tooth_mm", json!("from_feed")));
    let report = run(&face);
    let summary = report.summary();
    let (surface, gain) = (summary.surface.ok_or("no surface")?, summary.feed_rule.ok_or("no rule")?);
    let escaped: String = job_text(&face).bytes().map(|byte| format!("%{byte:02X}")).collect();
    let address = format!("/embed.html#job={escaped}");
    visit(&address, DESKTOP, async |page| {
        current(page).await?;
        assert_eq!(page.text("#feed-gain").await?, gain.sentence);
        let cells = page
            .js("return [...document.querySelectorAll('#feed-figures td[data-value]')].map(each => each.dataset.value)")
            .await?;
        let cells: Vec<String> = serde_json::from_value(cells)?;
        let cells: Vec<f64> = cells.iter().map(|cell| cell.parse()).collect::<std::result::Result<_, _>>()?;
        let figures = [gain.programmed, gain.constant_force].map(|outcome| {
            [outcome.largest_force_n, outcome.mean_force_n, outcome.largest_error_mm, outcome.time_s]
        });
        let rows: Vec<f64> = (0..4).flat_map(|row| [figures[0][row], figures[1][row]]).collect();
        assert_eq!(cells, rows);
        assert_eq!(Some(number(page, "surface-p95").await?), surface.after_p95_mm);
        let first = page.js("return document.querySelector('#surface-list button').textContent").await?;
        assert_eq!(first, surface.worst[0].sentence);
        Ok(())
    })
}
