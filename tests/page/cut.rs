//! The cut on the page: materials with their source, both ways of engagement, the drawing, spindle
//! figures, the wall.

use crate::browser::{DESKTOP, Page, Result, THESIS, visit};
use crate::common::program::opened_example;
use crate::common::{column, run};
use crate::{current, shows, stale, text, unfold};
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
    visit(THESIS, DESKTOP, async |page| {
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
        page.view("forces").await?;
        assert!(text(page, "cut-material").await?.contains("ISCAR"), "beside the figures too");
        let cut = steel.summary().cut;
        assert_eq!(figure(page, "At chip").await?, cut.made_at_chip_mm.unwrap());
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
    visit(THESIS, DESKTOP, async |page| {
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
    visit(THESIS, DESKTOP, async |page| {
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
        page.view("forces").await?;
        assert_eq!(
            figure(page, "Tip deflection of the tool").await?,
            long.summary().cut.tool_bending_um_n.unwrap()
        );
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

/// Whether the field of an input is hidden.
async fn hides(page: &Page, id: &str) -> Result<bool> {
    let hidden = page.js(&format!("return document.getElementById('{id}').closest('.field').hidden")).await?;
    Ok(hidden == true)
}

#[test]
fn in_a_stock_the_cut_follows_the_program() -> Result {
    let pocket = run(&opened_example("pocket.nc"));
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.view("forces").await?;
        page.wait_for("document.querySelector('#chart-force svg')", 20.0).await?;
        assert_eq!(page.js("return document.querySelectorAll('#chart-engagement').length").await?, 0);
        unfold(page, "path").await?;
        page.choose("#examples", "pocket.nc").await?;
        page.wait_for("document.querySelector('#stock-kind').value === 'box'", 20.0).await?;
        shows(page, &pocket).await?;
        let cut = pocket.summary().cut;
        let stock = cut.stock.clone().ok_or("no stock")?;
        assert!(stock.starts_with("box, 80") && text(page, "cut-stock").await?.contains(&stock));
        assert!(text(page, "cut-drawing").await?.contains("Where the force is largest"));
        assert_eq!(Some(figure(page, "Largest engaged angle").await?), cut.largest_engaged_deg);
        assert_eq!(Some(figure(page, "Removed volume").await?), cut.removed_cm3);
        assert_eq!(Some(figure(page, "Share in the air").await?), cut.air_share);
        // The charts are the columns, bit for bit.
        page.wait_for("document.querySelector('#chart-removal svg .series')", 30.0).await?;
        for (chart, at, key) in [
            ("engagement", 1, "engaged_deg"),
            ("engagement", 2, "entry_deg"),
            ("removal", 1, "removal_cm3_min"),
        ] {
            let data = page
                .with_module(
                    "core/client",
                    &format!(
                        "async ({{ chartData }}) => [...(await chartData('{chart}', {{}}))[{at}].values].map(String)"
                    ),
                )
                .await?;
            // As texts: a parser of JSON may lose the last bit.
            let texts: Vec<String> = serde_json::from_value(data)?;
            let own = column(&pocket, key);
            assert_eq!(texts.len(), own.len());
            assert!(texts.iter().zip(&own).all(|(text, value)| text.parse() == Ok(*value)), "{key}");
        }
        // Corners: on the third ring, at half the diameter across, the straight passes take a right
        // angle; its arcs take more.
        let (lines, engaged) = (column(&pocket, "program_line"), column(&pocket, "engaged_deg"));
        let most = |line: f64| {
            lines
                .iter()
                .zip(&engaged)
                .filter(|(at, _)| **at == line)
                .map(|(_, angle)| *angle)
                .fold(0.0, f64::max)
        };
        let middle = lines.iter().position(|line| *line == 41.0).ok_or("line 41 does not run")?;
        let count = lines.iter().filter(|line| **line == 41.0).count();
        assert!((engaged[middle + count / 2] - 90.0).abs() < 1e-6, "{}", engaged[middle + count / 2]);
        assert!(most(40.0) > 130.0 && most(42.0) > 130.0, "{} {}", most(40.0), most(42.0));
        Ok(())
    })
}

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn the_form_asks_only_for_what_the_engagement_needs() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let engagement = "return [...document.querySelectorAll('#cutting-engagement option')].find(each => \
             each.value === 'from-stock').disabled";
        assert_eq!(page.js(engagement).await?, true, "there is no stock");
        unfold(page, "path").await?;
        page.choose("#examples", "face.nc").await?;
        page.wait_for("document.querySelector('#stock-kind').value === 'box'", 20.0).await?;
        let face = opened_example("face.nc");
        shows(page, &run(&face)).await?;
        unfold(page, "cutting").await?;
        assert_eq!(page.js(engagement).await?, false);
        assert_eq!(page.value("#cutting-engagement").await?, "from-stock");
        let asked =
            ["cutting-axial_depth_mm", "cutting-radial_depth_mm", "cutting-entry_deg", "cutting-exit_deg"];
        for id in asked {
            assert!(hides(page, id).await?, "{id}");
        }
        assert!(text(page, "cutting-engagement-note").await?.contains("come from the stock"));
        // A stated engagement holds until it is given up.
        page.choose("#cutting-engagement", "climb").await?;
        let climb = [("cutting.engagement", json!("climb")), ("cutting.radial_depth_mm", json!(5))];
        let stated = run(&[face.as_slice(), &climb].concat());
        shows(page, &stated).await?;
        assert!(stated.setup().contacts.is_none());
        assert!(!hides(page, asked[0]).await? && !hides(page, asked[1]).await?);
        assert!(text(page, "cutting-engagement-note").await?.contains("stock is not used"));
        page.choose("#cutting-engagement", "from-stock").await?;
        shows(page, &run(&face)).await?;
        // Without a stock, it is as the job states it; nothing is left to fail.
        unfold(page, "stock").await?;
        page.choose("#stock-kind", "none").await?;
        page.wait_for("document.querySelector('#cutting-engagement').value === 'angles'", 5.0).await?;
        let bare: Vec<_> = face.iter().filter(|(path, _)| *path != "stock").cloned().collect();
        shows(page, &run(&bare)).await?;
        // Extents ask for a top that the program does not give.
        page.choose("#stock-kind", "extents").await?;
        stale(page).await?;
        assert!(text(page, "stock-top_mm-error").await?.contains("lowest cut is at 100 mm"));
        page.type_into("#stock-top_mm", "102").await?;
        let extents = [("stock", json!({"kind":"extents","top_mm":102}))];
        shows(page, &run(&[bare.as_slice(), &extents].concat())).await?;
        // An outline has corners of two numbers.
        page.choose("#stock-kind", "outline").await?;
        page.js("const t = document.querySelector('#stock-points_mm'); t.value = '550, -25\\n650, -25\\n600, 25'; \
             t.dispatchEvent(new Event('input', { bubbles: true }))").await?;
        page.type_into("#stock-bottom_mm", "90").await?;
        let outline = [(
            "stock",
            json!({"kind":"outline","points_mm":[[550,-25],[650,-25],[600,25]],"bottom_mm":90,"top_mm":102}),
        )];
        shows(page, &run(&[bare.as_slice(), &outline].concat())).await
    })
}
