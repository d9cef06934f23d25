//! Robots on the page: the library by maker, where its numbers come from, a custom arm, its
//! drawing, a place within reach.

use crate::browser::{DESKTOP, Result, THESIS, visit};
use crate::{current, text};
use serde_json::json;

#[test]
fn a_robot_is_picked_doubted_drawn_and_reached() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let pick = "const pick = (value) => { const s = document.getElementById('robot-preset'); \
             s.value = value; s.dispatchEvent(new Event('change', { bubbles: true })); };";
        let groups =
            "return [...document.querySelectorAll('#robot-preset optgroup')].map(group => group.label)";
        assert_eq!(
            page.js(groups).await?,
            json!(["Stäubli", "KUKA", "ABB", "Yaskawa", "FANUC", "My own numbers"])
        );
        page.js("document.querySelector('#group-robot').open = true").await?;
        let drawn = async |tip: &str| {
            page.wait_for(
                &format!("document.querySelector('.arm-view figcaption').textContent.includes('{tip}')"),
                20.0,
            )
            .await
        };
        drawn("tip at 0, 0, 1605 mm").await?;

        page.js(&format!("{pick} pick('kuka-kr-210-r2700-2')")).await?;
        current(page).await?;
        let note = "return document.querySelector('#robot-joint_compliance_rad_per_nm-note').textContent";
        let shown = page.js(note).await?;
        assert!(shown.as_str().is_some_and(|note| note.contains("order of magnitude")), "{shown}");
        drawn("tip at 2915, 0, 760 mm").await?;
        let warnings = page.js("return document.querySelector('#warnings').textContent").await?;
        assert!(warnings.as_str().is_some_and(|text| text.contains("joint stiffness")), "{warnings}");

        // A custom arm starts from the numbers of the previous one, and means the same.
        let verdict = text(page, "verdict").await?;
        page.js(&format!("{pick} pick('opw')")).await?;
        current(page).await?;
        assert_eq!(page.js("return document.getElementById('robot-opw-c2_mm').value").await?, "1150");
        assert_eq!(text(page, "verdict").await?, verdict);

        // Out of reach: the page suggests a place.
        page.js("const x = document.getElementById('path-center_mm-x'); x.value = '9000'; \
             x.dispatchEvent(new Event('input', { bubbles: true }))")
            .await?;
        page.wait_for(
            "document.querySelector('#alert button')?.textContent.startsWith('Place the path')",
            20.0,
        )
        .await?;
        page.click("#alert button").await?;
        page.wait_for("document.querySelector('#alert').textContent === ''", 20.0).await?;
        current(page).await
    })
}
