//! The cut on the page: materials with their source, both ways of engagement, the drawing, spindle
//! figures, the wall.

use crate::browser::{DESKTOP, Page, Result, visit};
use crate::common::run;
use crate::{current, shows, text, unfold};
use serde_json::json;

/// A figure of the panel in full precision.
async fn figure(page: &Page, name: &str) -> Result<f64> {
    let find = format!(
        "return [...document.querySelectorAll('#cut-figures div')].find(row => \
         row.textContent.startsWith('{name}')).querySelector('dd').dataset.value"
    );
    Ok(page.js(&find).await?.as_str().ok_or("no figure")?.parse()?)
}

#[test]
fn a_catalogue_material_is_converted_and_says_how_far_to_trust_it() -> Result {
    visit("/", DESKTOP, async |page| {
        current(page).await?;
        unfold(page, "material").await?;
        page.choose("#material-preset", "p2").await?;
        let steel = run(&[("material", json!({"preset": "p2"}))]);
        shows(page, &steel).await?;
        let note = text(page, "material-preset-note").await?;
        assert!(
            note.contains("ISCAR") && note.contains("±30 %") && note.contains("confidence: high"),
            "{note}"
        );
        page.click("#tab-forces").await?;
        assert!(text(page, "cut-material").await?.contains("ISCAR"), "beside the figures too");
        let cut = steel.summary().cut;
        assert_eq!(figure(page, "Made at chip").await?, cut.made_at_chip_mm.unwrap());
        assert_eq!(figure(page, "Spindle power").await?, cut.power_kw);
        assert_eq!(figure(page, "Removal rate").await?, cut.removal_cm3_min);
        // The shares that no catalogue gives can be overridden, and restored.
        page.js("const input = document.getElementById('material-radial_ratio'); input.value = '0.4'; \
             input.dispatchEvent(new Event('input', { bubbles: true }))")
            .await?;
        shows(page, &run(&[("material", json!({"preset": "p2", "radial_ratio": 0.4}))])).await?;
        // User-defined constants start from the catalogue's.
        page.choose("#material-preset", "kienzle").await?;
        let own = json!({"kc11_n_mm2":1500,"mc":0.22,"radial_ratio":0.4,"axial_ratio":0.3,"line":"tangent","chip_thickness_mm":"mean"});
        shows(page, &run(&[("material", own)])).await?;
        page.choose("#material-preset", "table").await?;
        current(page).await?;
        assert_eq!(
            page.js("return document.getElementById('material-kc11_n_mm2').closest('.field').hidden").await?,
            true
        );
        Ok(())
    })
}

#[test]
fn the_engagement_is_drawn_for_both_ways_of_giving_it() -> Result {
    visit("/", DESKTOP, async |page| {
        current(page).await?;
        let said = "return document.querySelector('#cut-sketch svg').getAttribute('aria-label')";
        let before = page.js(said).await?;
        assert!(
            before.as_str().is_some_and(
                |text| text.contains("Climb") && text.contains("90 to 180 deg; radial depth 5 mm")
            ),
            "{before}"
        );
        unfold(page, "cutting").await?;
        // The choice brings its own inputs, with the values shown in the form.
        page.choose("#cutting-engagement", "climb").await?;
        let climb = [("cutting.engagement", json!("climb")), ("cutting.radial_depth_mm", json!(5))];
        shows(page, &run(&climb)).await?;
        assert_eq!(page.js(said).await?, before, "the same cut");
        assert_eq!(
            page.js("return document.getElementById('cutting-entry_deg').closest('.field').hidden").await?,
            true
        );
        page.choose("#cutting-engagement", "conventional").await?;
        let up = [("cutting.engagement", json!("conventional")), ("cutting.radial_depth_mm", json!(5))];
        shows(page, &run(&up)).await?;
        assert!(
            page.js(said)
                .await?
                .as_str()
                .is_some_and(|text| text.contains("Conventional") && text.contains("0 to 90 deg"))
        );
        page.choose("#cutting-engagement", "slot").await?;
        shows(page, &run(&[("cutting.engagement", json!("slot")), ("cutting.radial_depth_mm", json!(5))]))
            .await?;
        assert_eq!(
            page.js("return document.querySelectorAll('#cut-sketch .stays').length").await?,
            2,
            "two walls"
        );
        Ok(())
    })
}

#[test]
fn the_wall_has_both_deviations_and_a_bending_tool_its_part() -> Result {
    visit("/", DESKTOP, async |page| {
        current(page).await?;
        unfold(page, "tool").await?;
        page.choose("#tool-bending", "cantilever").await?;
        let long = run(&[
            ("tool.bending", json!("cantilever")),
            ("tool.stickout_mm", json!(40)),
            ("tool.flute_length_mm", json!(20)),
            ("tool.shank_diameter_mm", json!(10)),
            ("tool.modulus_gpa", json!(600)),
        ]);
        shows(page, &long).await?;
        page.click("#tab-forces").await?;
        assert_eq!(figure(page, "Bends at the tip").await?, long.summary().cut.tool_bending_um_n.unwrap());
        let cells = page
            .js("return [...document.querySelectorAll('#wall-table tbody tr')].map(row => \
             [...row.cells].slice(1, 3).map(cell => cell.dataset.value ?? null))")
            .await?;
        let wall = &long.walls()[0];
        let number =
            |row: usize, cell: usize| cells[row][cell].as_str().and_then(|text| text.parse::<f64>().ok());
        assert_eq!(number(0, 0), Some(wall.mean_force_n));
        assert_eq!(number(0, 1), Some(wall.by_mean_force_mm));
        assert_eq!(number(1, 0), Some(wall.instant_force_n));
        assert_eq!(number(1, 1), Some(wall.at_instant_mm));
        assert_eq!(number(2, 1), Some(wall.at_instant_mm - wall.by_mean_force_mm));
        assert_eq!(
            page.js("return document.querySelectorAll('#budget-table .tool').length").await?,
            2,
            "row and swatch"
        );
        // A ball nose by its keyword.
        page.click("#tool-corner_radius_mm-ball").await?;
        let changed = [
            ("tool.bending", json!("cantilever")),
            ("tool.stickout_mm", json!(40)),
            ("tool.flute_length_mm", json!(20)),
            ("tool.corner_radius_mm", json!("ball")),
        ];
        shows(page, &run(&changed)).await?;
        assert!(text(page, "cut-figures").await?.contains("ball nose"));
        Ok(())
    })
}
